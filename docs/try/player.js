// What plays the beams' samples, in the sound card's own thread.
'use strict';

// Told Float32Array of samples, or null: silence.  Tells {played, missed, lost} a few times in a second.
function soundPlayer() {
  const ahead = 2400, most = 9600;  // samples that wait before it begins, and at most: 50 and 200 ms
  class Player extends AudioWorkletProcessor {
    constructor() {
      super();
      Object.assign(this, {waiting: [], at: 0, count: 0, playing: false, played: 0, missed: 0, lost: 0, blocks: 0});
      this.port.onmessage = ({data}) => {
        if (!data) return Object.assign(this, {waiting: [], at: 0, count: 0, playing: false});
        this.waiting.push(data), this.count += data.length;
        while (this.count > most) this.lost += this.drop();
      };
    }
    drop() {
      const left = this.waiting.shift().length - this.at;
      this.at = 0, this.count -= left;
      return left;
    }
    next() {
      const first = this.waiting[0], x = first[this.at++];
      if (this.at === first.length) this.waiting.shift(), this.at = 0;
      --this.count;
      return x;
    }
    process(inputs, [[to]]) {
      if (!this.playing) this.playing = this.count >= ahead;
      for (let k = 0; this.playing && k < to.length; ++k) {
        if (this.count === 0) this.missed += to.length - k, this.playing = false;
        else to[k] = Math.tanh(0.5 * this.next()), ++this.played;
      }
      if (++this.blocks % 64 === 0) this.port.postMessage({played: this.played, missed: this.missed, lost: this.lost});
      return true;
    }
  }
  registerProcessor('hapbeam-player', Player);
}
