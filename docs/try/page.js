// What the page shows of the worker's ticks, and what it tells the worker of the pointer.
'use strict';

const $ = (id) => document.getElementById(id);
const canvas = $('stage');
const period = 1e-3, shownSeconds = 5;  // [s]
const noticed = 0.07;  // relative error of a force that a hand notices
const withMass = 6, strobed = 12;
const state = {scene: 3, model: null, facts: null, rest: null, line: null, tick: null, view: null, worst: 1e-6, strobe: [], loud: []};
let side = 1, guided = true, idle = null, history = [], touch = [], before = [], time = 0;

if (typeof hapbeamWasm === 'undefined') {
  $('hint').textContent = 'The beams are not built yet: bash docs/try/build.sh';
  throw new Error('built.js is missing');
}
const worker = startBeams();
worker.onerror = (error) => { $('hint').textContent = 'The beams have stopped: ' + error.message; };
worker.onmessage = ({data}) => {
  if (data.ready) open(state.scene);
  if (data.opened) opened(data.opened);
  if (data.ticks) ticked(data);
  if (data.sound) hear(data.sound);
};

// Scenes and models.

scenes.forEach((scene, index) => {
  const button = document.createElement('button');
  button.type = 'button';
  button.textContent = scene.name;
  button.setAttribute('role', 'radio');
  button.onclick = () => open(index);
  $('scenes').append(button);
});

function open(index) {
  const scene = scenes[index];
  $('own').hidden = !scene.own;
  Object.assign(state, {scene: index, facts: null, tick: null, line: null});
  [...$('scenes').children].forEach((button, k) => button.setAttribute('aria-checked', k === index));
  $('title').textContent = scene.title;
  $('feel').textContent = scene.feel;
  $('models').replaceChildren();
  $('hint').textContent = 'computing …';
  if (scene.own) openOwn();
  else worker.postMessage({open: index});
}

// A beam of one's own: as slender as a beam is, and not more than its models solve.
function openOwn() {
  const {length, thickness, material, ends} = Object.fromEntries(new FormData($('own'))), L = Number(length), t = Number(thickness);
  const low = L / 1000, high = L / 20, mm = (x) => +x.toPrecision(3);
  let wrong = '';
  if (!(L >= 50 && L <= 3000)) wrong = `length ${length} mm: must be 50 to 3000 mm`;
  else if (!(t >= low && t <= high)) wrong = `thickness ${thickness} mm: must be ${mm(low)} to ${mm(high)} mm, a thousandth to a twentieth of the length`;
  $('slender').textContent = wrong;
  if (wrong) return void ($('hint').textContent = 'not a beam yet');
  const figures = [L / 1000, t / 1000, ...material.split(' ').map(Number), Number(ends)];
  Object.assign(scenes[state.scene], drawnOwn(figures));
  worker.postMessage({own: figures});
}
$('own').onchange = () => open(state.scene);
$('own').onsubmit = (event) => event.preventDefault();

// Pages: beside this one in the repository; where a host builds the page, on that host.
for (const link of document.querySelectorAll('a[data-page]'))
  link.href = hapbeamProject ? `${hapbeamProject}/blob/HEAD/${link.dataset.page}` : `../../${link.dataset.page}`;
if (hapbeamProject) Object.assign($('reference'), {hidden: false, href: 'reference/'});

function opened(facts) {
  Object.assign(state, {facts, rest: facts.line, worst: 1e-6});
  guided = true;
  side = 1;
  [history, touch, before, time] = [[], [], [], 0];
  const mm = (m) => `${+(1e3 * m).toPrecision(3)}`;
  const [from, to, depth] = facts.presses;
  $('presses').textContent = `${mm(from)} and ${mm(to)} mm, up to ${mm(depth)} mm deep`;
  for (const {model, error, us} of facts.rows) {
    const row = $('models').insertRow(), [title, kind] = models[model];
    row.dataset.model = model;
    row.innerHTML = `<td><label><input type="radio" name="model" value="${model}"><span>${title}<small>${kind}</small></span></label></td>` +
      `<td${error > noticed ? ' class="bad"' : ''}>${model === withMass ? 'moves' : percent(error)}</td><td>${us.toFixed(us < 10 ? 1 : 0)} µs</td>`;
    row.querySelector('input').onchange = () => choose(model);
  }
  choose(scenes[state.scene].model);
  hint();
}

function percent(part) {
  const digits = 100 * part;
  if (digits >= 0.1) return `${+digits.toPrecision(2)} %`;
  const power = Math.floor(Math.log10(part)), lead = Math.round(part / 10 ** power);
  const up = String(lead === 10 ? power + 1 : power).replace('-', '⁻').replace(/\d/g, (d) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[d]);
  return lead === 1 || lead === 10 ? `10${up}` : `${lead}·10${up}`;
}

function choose(model) {
  state.model = model;
  for (const row of $('models').rows) {
    const chosen = Number(row.dataset.model) === model;
    row.classList.toggle('chosen', chosen);
    row.querySelector('input').checked = chosen;
  }
  Object.assign(state, {strobe: [], loud: []});
  $('second').textContent = model === withMass ? 'Loudness over time' : 'Force against depth';
  $('touches').hidden = model === withMass;
  $('sound').hidden = ![...$('models').rows].some((row) => Number(row.dataset.model) === withMass);
  if (player) player.port.postMessage(null);
  showSound();
  $('bound').textContent = '';
  worker.postMessage({choose: model});
}

// Sound: the worker's samples go to the sound card's own thread.

let audio = null, player = null;
async function listen() {
  audio = new AudioContext({sampleRate: 48000});
  const source = new Blob([`(${soundPlayer})()`], {type: 'text/javascript'});
  await audio.audioWorklet.addModule(URL.createObjectURL(source));
  player = new AudioWorkletNode(audio, 'hapbeam-player', {numberOfInputs: 0, outputChannelCount: [1]});
  player.port.onmessage = ({data}) => { player.counts = data; };
  player.connect(audio.destination);
}
const audible = () => player !== null && audio.state === 'running' && state.model === withMass;
function showSound() {
  $('sound').textContent = audible() ? 'silence' : 'hear it';
  $('sound').setAttribute('aria-pressed', audible());
}
$('sound').onclick = async () => {
  const off = audible();
  if (!player) await listen();
  await (off ? audio.suspend() : audio.resume());
  if (!off && state.model !== withMass) choose(withMass);
  showSound();
};
function hear(samples) {
  if (state.model !== withMass || samples.length === 0) return;
  state.loud.push([time, samples.reduce((most, x) => Math.max(most, Math.abs(x)), 0)]);
  if (state.loud.length > 2000) state.loud = state.loud.slice(1000);
  if (audible()) player.port.postMessage(samples, [samples.buffer]);
}

function hint() {
  $('hint').textContent = guided ? 'press it: with the pointer, a finger or the arrow keys' : '';
}

// The pointer is the hand.

function pointed(event) {
  const box = canvas.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}
// A beam that is magnified is passed beside its ends alone.
function sideOf([px, py], placed) {
  const {view, facts} = state, x = (px - view.left) / view.scale, off = 0.02 * facts.length;
  if (view.magnified === 1) return 1;
  if (placed || x < -off || x > facts.length + off) return py < view.top ? 1 : -1;
  return side;
}
function begin(event) {
  if (!state.facts) return;
  clearTimeout(idle);
  guided = false;
  hint();
  const at = pointed(event);
  side = sideOf(at, true);
  worker.postMessage({place: state.view.scenePlace(...at, side)});
}
function move(event) {
  if (!state.facts) return;
  if (guided) return begin(event);
  const at = pointed(event);
  side = sideOf(at, false);
  worker.postMessage({go: state.view.scenePlace(...at, side)});
}
function end() {
  clearTimeout(idle);
  idle = setTimeout(() => {
    guided = true;
    side = 1;
    worker.postMessage({script: true});
    hint();
  }, 1500);
  if (!state.view || !state.tick) return;
  // Home above the middle; a ball that is below the beam or beside it would be held there.
  const home = [state.facts.length / 2, state.view.scenePlace(0, 0, 1)[1]], [, , x, w] = state.tick;
  const astray = x < 0 || x > state.facts.length || side < 0 || w < 0;
  worker.postMessage(astray && !state.tick[7] ? {place: home} : {go: home});
  side = 1;
}

// The arrow keys lead the hand, half a picture in a second; space lets go.
const held = new Set(), ways = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
let led = null, drawn = 0;
canvas.onkeydown = (event) => {
  if (event.key === ' ' || event.key === 'Escape') held.clear(), led = null, end(), event.preventDefault();
  if (!ways[event.key] || !state.tick) return;
  event.preventDefault();
  if (!held.size) {
    clearTimeout(idle);
    led = guided ? [state.facts.length / 2, state.view.scenePlace(0, 0, 1)[1]] : [state.tick[0], state.tick[1]];
    if (guided) worker.postMessage({place: led});
    guided = false, hint();
  }
  held.add(event.key);
};
canvas.onkeyup = (event) => held.delete(event.key);
canvas.onblur = () => { if (led) held.clear(), led = null, end(); };
function lead(now) {
  const seconds = Math.min(0.05, (now - drawn) / 1000);
  drawn = now;
  if (!led || !held.size) return;
  const [x0, x1, w0, w1] = scenes[state.scene].view, {magnified} = state.view;
  for (const key of held) {
    led[0] = Math.min(x1, Math.max(x0, led[0] + 0.25 * (x1 - x0) * seconds * ways[key][0]));
    led[1] = Math.min(w1, Math.max(w0, led[1] + 0.5 * (w1 - w0) * seconds * ways[key][1] / magnified));
  }
  worker.postMessage({go: [...led]});
}
canvas.onpointerdown = (event) => {
  if (event.pointerType === 'mouse') return;
  canvas.setPointerCapture(event.pointerId);
  begin(event);
};
canvas.onpointerenter = (event) => { if (event.pointerType === 'mouse') begin(event); };
canvas.onpointermove = (event) => { if (event.pointerType === 'mouse' || canvas.hasPointerCapture(event.pointerId)) move(event); };
canvas.onpointerleave = (event) => { if (event.pointerType === 'mouse') end(); };
canvas.onpointerup = canvas.onpointercancel = (event) => { if (event.pointerType !== 'mouse') end(); };
document.onvisibilitychange = () => worker.postMessage({pause: document.hidden});

// Ticks.

function ticked({ticks, line, us, bound}) {
  if (!state.facts) return;
  for (let k = 0; k < ticks.length; k += 9) {
    const [, , , , fx, fw, depth, pressing] = ticks.subarray(k, k + 9), force = Math.hypot(fx, fw);
    time += period;
    if (Math.round(time / period) % 4 === 0) history.push([time, force]);
    if (pressing && !(state.tick && state.tick[7]) && touch.length > 20) before = touch;
    if (pressing && !(state.tick && state.tick[7])) touch = [];
    if (pressing && touch.length < 20000) touch.push([1e3 * depth, force]);
    state.tick = ticks.subarray(k, k + 9);
  }
  const first = history.findIndex(([t]) => t > time - shownSeconds);
  if (first > 500) history = history.slice(first);
  state.line = line;
  if (state.model === withMass) {
    state.strobe.push(line);
    if (state.strobe.length > strobed) state.strobe.shift();
  }
  if (bound !== null) $('bound').textContent = bound >= 1 ? '± 100 % or more' : bound >= 0 ? `± ${bound > 0 ? percent(bound) : '0 %'}` : '';
  if (us !== null) $('now').textContent = `${us.toFixed(1)} µs`;
}

// The larger part of what was shown lately, so that axes do not jump.
let forceTop = 1, depthTop = 1;
function draw(now) {
  requestAnimationFrame(draw);
  const {facts, line, tick} = state;
  if (!facts || !line || !tick) return;
  const scene = scenes[state.scene];
  state.view = new View(scene, canvas, facts.reach);
  lead(now);
  const {view} = state, {c} = contextOf(canvas);
  const [hx, hw, ax, aw, fx, fw, , pressing, status] = tick, force = Math.hypot(fx, fw);

  // The beam as it lies untouched.
  path(c, Array.from({length: state.rest.length / 3}, (_, k) => view.line(state.rest[3 * k], state.rest[3 * k + 1])));
  c.setLineDash([7, 6]);
  c.strokeStyle = colour.faint;
  c.lineWidth = 1;
  c.stroke();
  c.setLineDash([]);

  // Where it was a moment ago.
  state.strobe.forEach((was, age) => {
    path(c, Array.from({length: was.length / 3}, (_, k) => view.line(was[3 * k], was[3 * k + 1])));
    c.strokeStyle = colour.blue;
    c.globalAlpha = 0.4 * (age + 1) / strobed;
    c.stroke();
  });
  c.globalAlpha = 1;

  for (let k = 2; k < line.length; k += 3) state.worst = Math.max(state.worst, line[k]);
  const at = drawBeam(c, view, line, state.worst);
  drawSupport(c, at[0], scene.ends[0], false);
  drawSupport(c, at[at.length - 1], scene.ends[1], true);

  const hand = view.place(hx, hw, side), ball = view.place(ax, aw, side);
  drawBall(c, ball, view.ball);
  drawSpring(c, ball, hand);
  if (force > 0) {
    const length = 90 * force / forceTop + 14;
    drawArrow(c, ball, length * fx / force, -length * fw / force);
  }
  drawHand(c, hand);

  const lag = Math.hypot(hx - ax, hw - aw);
  $('force').value = force < 100 ? force.toFixed(2) : force.toFixed(0);
  $('lag').textContent = pressing ? `lag ${(1e3 * lag).toFixed(1)} mm on a spring of ${+(facts.stiffness / 1e3).toPrecision(2)} N/mm` : 'not touched';
  $('status').textContent = statusText[status];
  $('scale').textContent = (view.magnified === 1 ? 'true to scale' : `displacements × ${view.magnified}`) +
    `; colour: bending strain, at most ${+(1e6 * state.worst).toPrecision(2)} µm/m`;

  const lately = history.filter(([t]) => t > time - shownSeconds);
  const most = Math.max(...lately.map(([, f]) => f), 1e-3);
  forceTop = roundUp(1.05 * Math.max(most, ...touch.map(([, f]) => f)));
  drawCurves($('time'), [{points: lately.map(([t, f]) => [t - time, f]), colour: colour.vermilion, width: 2, dot: true}],
    {x0: -shownSeconds, x1: 0, top: forceTop, xUnit: 's', yUnit: 'N', xLabels: [-5, -4, -3, -2, -1, 0]});
  if (state.model === withMass) {
    const loud = state.loud.filter(([t]) => t > time - shownSeconds);
    return drawCurves($('depth'), [{points: loud.map(([t, x]) => [t - time, x]), colour: colour.blue, width: 2, dot: true}],
      {x0: -shownSeconds, x1: 0, top: roundUp(Math.max(0.01, ...loud.map(([, x]) => x))), xUnit: 's', yUnit: '', xLabels: [-5, -4, -3, -2, -1, 0]});
  }
  depthTop = roundUp(Math.max(1, ...touch.map(([d]) => d), ...before.map(([d]) => d)));
  drawCurves($('depth'), [{points: before, colour: colour.pale, width: 2}, {points: touch, colour: colour.blue, width: 2.2, dot: true}],
    {x0: 0, x1: depthTop, top: roundUp(1.05 * Math.max(1e-3, ...touch.map(([, f]) => f), ...before.map(([, f]) => f))),
      xUnit: 'mm', yUnit: 'N', xLabels: [0, depthTop / 2, depthTop]});
}
requestAnimationFrame(draw);
