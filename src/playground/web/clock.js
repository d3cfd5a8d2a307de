/**
 * Plays an effect that moves: a picture a frame of the browser, each at its time; and pauses it.
 */
import { element } from './dom.js';

export class Clock {
  /**
   * @param {import('./live.js').Live} live its moment is what this sets
   * @param {{draw: () => Promise<void>, stopped: () => void}} page `stopped` hears that the last picture stays
   */
  constructor(live, { draw, stopped }) {
    this.live = live;
    this.draw = draw;
    this.stopped = stopped;
    this.playing = false;
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
    this.began = performance.now();
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

  async play() {
    this.playing = true;
    this.mark();
    this.began = performance.now() - 1000 * this.live.moment.time;
    const first = this.live.moment.frame, since = performance.now();
    while (this.playing) {
      this.live.moment = { time: (performance.now() - this.began) / 1000, frame: this.live.moment.frame + 1 };
      await this.draw();
      /** Frames a second since playing began, for the tests. */
      this.rate = 1000 * (this.live.moment.frame - first) / (performance.now() - since);
      await new Promise((resolve) => { requestAnimationFrame(resolve); });
    }
  }

  say() {
    const { time, frame } = this.live.moment;
    this.text.textContent = `${time.toFixed(2)} s, frame ${frame}${this.playing && this.rate ? `, ${this.rate.toFixed(0)} a second` : ''}`;
  }
}
