/**
 * Plays an effect that moves: a picture a frame of the browser, each at its time; and pauses it.
 */
import { element } from './dom.js';

export class Clock {
  /**
   * @param {import('./live.js').Live} live its moment is what this sets
   * @param {{draw: () => Promise<void>, started: () => void, stopped: () => void}} page `started` hears that pictures follow each
   *     other, `stopped` that the last one stays
   */
  constructor(live, { draw, started, stopped }) {
    this.live = live;
    this.draw = draw;
    this.started = started;
    this.stopped = stopped;
    this.playing = false;
    /** The number of the last play(): the loop of an earlier one ends, even if it awaits a picture meanwhile. */
    this.turn = 0;
    /** When time 0 was, in the browser's milliseconds. */
    this.began = 0;
    /** Since when frames are counted, and the first one's number. */
    this.since = 0;
    this.first = 0;
    /** Frames a second since then. */
    this.rate = 0;
    this.button = element('button', { type: 'button', class: 'small', id: 'play', 'aria-pressed': 'false', onclick: () => this.toggle() }, 'Play');
    this.start = element('button', { type: 'button', class: 'small', id: 'rewind', title: 'Back to time 0', onclick: () => this.rewind() }, '0 s');
    this.text = element('output', { class: 'quiet', id: 'moment' });
    this.element = element('span', { class: 'clock', hidden: true }, this.button, this.start, this.text);
  }

  /** Hears whether the effect that was drawn moves. @param {boolean} moves */
  show(moves) {
    this.element.hidden = !moves;
    if (!moves) this.pause();
    this.say();
  }

  /** Another effect begins at its start. */
  reset() {
    this.pause();
    this.live.moment = { time: 0, frame: 0 };
  }

  rewind() {
    this.live.moment = { time: 0, frame: 0 };
    this.count();
    if (!this.playing) this.draw().then(this.stopped);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.mark();
    this.stopped();
  }

  mark() {
    this.button.textContent = this.playing ? 'Pause' : 'Play';
    this.button.setAttribute('aria-pressed', String(this.playing));
  }

  /** Counts frames from the moment on. */
  count() {
    this.since = performance.now();
    this.began = this.since - 1000 * this.live.moment.time;
    this.first = this.live.moment.frame;
    this.rate = 0;
  }

  async play() {
    const turn = ++this.turn;
    this.playing = true;
    this.mark();
    this.started();
    this.count();
    while (this.playing && turn === this.turn) {
      this.live.moment = { time: (performance.now() - this.began) / 1000, frame: this.live.moment.frame + 1 };
      await this.draw();
      const milliseconds = performance.now() - this.since;
      if (milliseconds > 0 && turn === this.turn) this.rate = 1000 * (this.live.moment.frame - this.first) / milliseconds;
      await new Promise((resolve) => { requestAnimationFrame(resolve); });
    }
  }

  say() {
    const { time, frame } = this.live.moment;
    this.text.textContent = `${time.toFixed(2)} s, frame ${frame}${this.playing && this.rate ? `, ${this.rate.toFixed(0)} a second` : ''}`;
  }
}
