/**
 * "Your GPU": the pass's program by the emulator and by WebGL 2 on the same fragments, and how many pixels differ.
 */
import { element, messageOf, paint } from './dom.js';
import { Replaced } from './engine_client.js';
import { registers, runOnGpu } from './gpu.js';
import { Live } from './live.js';
import { programOf } from './state.js';

/** The parts of the engine's answer about a pass's combiners. @param {{width: number, height: number}} size @param {Uint8Array} bytes */
function fragmentsOf({ width, height }, bytes) {
  const values = width * height * 4;
  const inputs = registers.map((name, at) => new Int16Array(bytes.buffer, at * values * 2, values));
  const rest = registers.length * values * 2;
  return { width, height, inputs, output: bytes.subarray(rest, rest + values), drawn: bytes.subarray(rest + values) };
}

/** Pixels for a canvas: opaque where something was drawn, the top row first. @param {Uint8Array} pixels @param {{width: number, height: number, drawn: Uint8Array}} fragments */
function upright(pixels, { width, height, drawn }) {
  const out = new Uint8Array(pixels.length);
  for (let y = 0; y < height; y++) {
    const from = (height - 1 - y) * width * 4;
    out.set(pixels.subarray(from, from + width * 4), y * width * 4);
    for (let x = 0; x < width; x++) out[(y * width + x) * 4 + 3] = drawn[from / 4 + x] ? 255 : 0;
  }
  return out;
}

export class GpuPanel {
  /**
   * @param {HTMLElement} parent
   * @param {import('./state.js').Store} store
   * @param {import('./shelf.js').Shelf} shelf
   * @param {import('./engine_client.js').Engine} engine
   * @param {Live} live its moment is the picture's
   */
  constructor(parent, store, shelf, engine, live) {
    this.parent = parent;
    this.store = store;
    this.shelf = shelf;
    this.engine = engine;
    this.live = live;
    this.turn = 0;
    this.result = element('p', { role: 'status', id: 'gpu-result' });
    this.figures = ['The emulator', 'Your GPU', 'Difference'].map((title) => {
      const canvas = element('canvas', { width: 1, height: 1 });
      const caption = element('figcaption', {}, title);
      return { canvas, caption, title };
    });
    parent.append(element('p', { class: 'quiet' }, 'The pass’s program as GLSL ES in WebGL 2. The emulator’s rasterizer gives both the registers of each fragment, ',
      'so this compares the combiners. Blending and the alpha test come after them.'),
    this.result, element('div', { class: 'trio' }, ...this.figures.map(({ canvas, caption }) => element('figure', {}, canvas, caption))));
  }

  async update() {
    if (this.parent.hidden) return;
    const turn = ++this.turn;
    try {
      if (programOf(this.store.state) === undefined) throw new Error('This pass has no program.');
      await this.run(() => turn === this.turn);
    } catch (error) {
      if (error instanceof Replaced || turn !== this.turn) return;
      this.result.textContent = messageOf(error);
      delete this.result.dataset.count;
      for (const { canvas } of this.figures) canvas.getContext('2d').clearRect(0, 0, canvas.width, canvas.height);
    }
  }

  /** @param {() => boolean} current whether nothing newer was asked for */
  async run(current) {
    const { state } = this.store;
    const { effect, pass } = state;
    await this.shelf.loadFor(effect);
    const { moment } = this.live;
    const request = { ...Live.request(state, moment), hash: undefined, do: 'combiners', pass };
    const { answer, bytes } = await this.engine.ask(request, { key: 'gpu' });
    const picture = await this.engine.ask(Live.request(state, moment), { key: 'gpu-draw' });
    if (!current()) return;
    const fragments = fragmentsOf(answer, bytes);
    const { pixels, framesPerSecond, renderer } = runOnGpu(answer.glsl, { ...fragments, byteShift: answer.byte_shift });
    const difference = new Uint8Array(pixels.length);
    let count = 0;
    for (let pixel = 0; pixel < fragments.drawn.length; pixel++) {
      if (!fragments.drawn[pixel]) continue;
      let most = 0;
      for (let at = 4 * pixel; at < 4 * pixel + 4; at++) most = Math.max(most, Math.abs(pixels[at] - fragments.output[at]));
      if (most) count++;
      difference.fill(Math.min(255, most * 16), 4 * pixel, 4 * pixel + 3);
    }
    [fragments.output, pixels, difference].forEach((shown, at) => {
      paint(this.figures[at].canvas, upright(shown, fragments), fragments.width, fragments.height);
    });
    const rate = Math.round(1000 / Math.max(0.1, picture.milliseconds));
    this.figures[0].caption.textContent = `The emulator; ${rate.toLocaleString('en')} whole pictures/s`;
    this.figures[1].caption.textContent = `${renderer}; this pass’s combiners ${Math.round(framesPerSecond).toLocaleString('en')} times/s`;
    this.result.textContent = `Pass ${answer.pass}: ${count.toLocaleString('en')} of ${answer.drawn.toLocaleString('en')} pixels differ`;
    this.result.dataset.count = String(count);
    this.result.dataset.drawn = String(answer.drawn);
  }
}
