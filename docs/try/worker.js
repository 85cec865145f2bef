// The beams' own thread: 1000 ticks in a second of simulated time, whatever the display does.
'use strict';

// Told {wasm}, then {open: scene}, {own: [length, thickness, young, density, ends]}, {choose: model}, {place: [x, w]}, {go: [x, w]}, {script}, {pause: bool}, {demonstration: model}.
function beamWorker() {
  const recordSize = 9, modelCount = 7, withMass = 6;
  let beams, target = null, paused = false, last = 0, spent = 0, ticked = 0, unbound = 0;

  const records = (address, count) => new Float64Array(beams.memory.buffer, address, recordSize * count).slice();
  const hasModels = () => Array.from({length: modelCount}, (_, m) => m).filter((m) => beams.page_has(m));

  // [µs] of a tick of each model: the least of some rounds, each of as many strokes as the clock can tell.  A stroke begins by 60 ticks more.
  function times(all) {
    const least = all.map(() => Infinity);
    for (let round = 0; round < 6; ++round)
      all.forEach((model, k) => {
        const begin = performance.now(), count = model === withMass ? 100 : 1000;
        let strokes = 0, now = begin;
        while (now - begin < 3) {
          beams.page_stroke(model, count);
          ++strokes;
          now = performance.now();
        }
        least[k] = Math.min(least[k], 1e3 * (now - begin) / (strokes * (count + 60)));
      });
    return least;
  }

  function opened() {
    const all = hasModels(), errors = all.map((model) => beams.page_error(model)), least = times(all);
    const rows = all.map((model, k) => ({model, error: errors[k], us: least[k]}));
    beams.page_choose(all[0]);
    return {rows, length: beams.page_length(), stiffness: beams.page_stiffness(), reach: beams.page_reach(),
      presses: [beams.page_from(), beams.page_to(), beams.page_depth()], line: line()};
  }

  function line() {
    const count = beams.page_points();
    return Float32Array.from(new Float64Array(beams.memory.buffer, beams.page_line(), 3 * count));
  }

  // Samples of the last ticks, 48 of each; none of a model without mass.
  function heard() {
    const count = beams.page_hear();
    return new Float32Array(beams.memory.buffer, beams.page_samples(), count).slice();
  }

  function run() {
    const now = performance.now();
    if (paused) return void (last = now);
    let due = Math.min(48, Math.floor(now - last));  // what was missed while the browser slept is left out
    last = now - last > 100 ? now : last + due;
    if (due < 1) return;
    const address = target ? beams.page_go(due, target[0], target[1]) : beams.page_demonstrate(due);
    spent += performance.now() - now;
    ticked += due;
    let us = null;
    if (ticked >= 500) us = 1000 * spent / ticked, spent = ticked = 0;
    // The stated bound takes a finer mesh: four times a second.
    let bound = null;
    if ((unbound += due) >= 250) bound = beams.page_bound(), unbound = 0;
    const ticks = records(address, due), points = line(), sound = heard();
    postMessage({ticks, line: points, us, bound, sound}, [ticks.buffer, points.buffer, sound.buffer]);
  }

  function begin() {
    target = null;
    postMessage({opened: opened()});
    if (!last) setInterval(run, 8);
    last = performance.now();
  }

  const told = {
    async wasm(bytes) {
      const none = () => 0;
      const {instance} = await WebAssembly.instantiate(bytes, {
        env: {emscripten_notify_memory_growth: none},
        wasi_snapshot_preview1: {proc_exit: (code) => { throw new Error('the beams have ended: ' + code); }},
      });
      beams = instance.exports;
      if (beams._initialize) beams._initialize();
      postMessage({ready: true});
    },
    open(scene) { beams.page_open(scene), begin(); },
    own(figures) { beams.page_open_own(...figures), begin(); },
    choose: (model) => beams.page_choose(model),
    place: (at) => { target = at; beams.page_place(at[0], at[1]); },
    go: (at) => { target = at; },
    script: () => { target = null; beams.page_rewind(); },
    pause: (yes) => { paused = yes; last = performance.now(); },
    // What is heard once a press has been let go, the hand away at once: a second.
    pluck({scene, x, from, to}) {
      beams.page_open(scene);
      beams.page_choose(withMass);
      beams.page_place(x, from);
      for (let k = 0; k < 400; ++k) beams.page_go(1, x, to), beams.page_hear();
      const samples = [];
      for (let k = 0; k < 1000; ++k) beams.page_go(1, x, from), samples.push(...heard());
      postMessage({plucked: samples});
    },
    // All of a demonstration at once, as native.cpp prints it.
    demonstration({scene, model}) {
      beams.page_open(scene);
      const error = beams.page_error(model);
      beams.page_choose(model);
      beams.page_rewind();
      const forces = [];
      for (let k = 0; k < beams.page_demonstration(); ++k) {
        const tick = records(beams.page_demonstrate(1), 1);
        if (k % 20 === 19) forces.push(tick[4], tick[5]);
      }
      postMessage({demonstration: {scene, model, error, forces}});
    },
  };
  onmessage = ({data}) => {
    for (const [what, value] of Object.entries(data)) told[what](value);
  };
}

// As a blob: so the page works from a folder too, where a browser starts no worker from a file.
function startBeams() {
  const source = new Blob([`(${beamWorker})()`], {type: 'text/javascript'});
  const worker = new Worker(URL.createObjectURL(source));
  worker.postMessage({wasm: Uint8Array.from(atob(hapbeamWasm), (c) => c.charCodeAt(0))});
  return worker;
}
