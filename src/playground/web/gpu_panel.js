/**
 * "Your GPU": the pass's program by the emulator and by WebGL 2 on the same texels, and how many pixels differ.
 */
import { element, paint } from './dom.js';
import { Replaced } from './engine_client.js';
import { runOnGpu } from './gpu.js';
import { passOf, programOf } from './state.js';

const size = 256;
const primary = [204, 102, 51, 255];

/** Texels that pair every byte with every other one: unit 0's red with unit 1's red, and so on. */
function pattern(unit) {
  const pixels = new Uint8Array(size * size * 4);
  for (let y = 0; y < size; y++) {
    for (let x = 0; x < size; x++) {
      const values = [x, y, (x * y + 17) & 255, x ^ y];
      for (let part = 0; part < 4; part++) pixels[(y * size + x) * 4 + part] = values[(part + unit) & 3];
    }
  }
  return pixels;
}

export class GpuPanel {
  /**
   * @param {HTMLElement} parent
   * @param {import('./state.js').Store} store
   * @param {import('./shelf.js').Shelf} shelf
   * @param {{engine: import('./engine_client.js').Engine, profiles: import('./profiles_panel.js').Profile[]}} offered
   */
  constructor(parent, store, shelf, { engine, profiles }) {
    Object.assign(this, { parent, store, shelf, engine, profiles });
    this.result = element('p', { role: 'status', id: 'gpu-result' });
    this.figures = ['The emulator', 'Your GPU', 'Difference'].map((title) => {
      const canvas = element('canvas', { width: 1, height: 1 });
      const caption = element('figcaption', {}, title);
      return { canvas, caption, title };
    });
    parent.append(element('p', { class: 'quiet' }, 'The program as GLSL ES in WebGL 2, on a rectangle where every pixel reads one texel. ',
      'Textures of 256 x 256 texels are the pass’s own; the others are a pattern that pairs every byte with every other.'),
    this.result, element('div', { class: 'trio' }, ...this.figures.map(({ canvas, caption }) => element('figure', {}, canvas, caption))));
  }

  textures() {
    const pass = passOf(this.store.state);
    return [0, 1, 2, 3].map((unit) => {
      const source = this.store.state.effect.textures?.[pass.units?.[unit]?.texture]?.source;
      const picture = this.shelf.pictures.get(source);
      return picture?.width === size && picture.height === size ? picture.pixels : pattern(unit);
    });
  }

  /** A field of the chosen profile. @param {string} name */
  field(name) {
    const { profile } = this.store.state;
    if (typeof profile === 'object' && name in profile) return profile[name];
    const base = typeof profile === 'string' ? profile : profile.base ?? 'geforce2';
    return this.profiles.find((known) => known.name === base)?.fields.find((field) => field.name === name)?.value ?? 0;
  }

  /** The same as an effect: a rectangle, nearest texels, the textures that the program reads. */
  effect(used) {
    const units = [0, 1, 2, 3].map((unit) => (unit === 0 || used.includes(unit) ? { texture: `gpu${unit}`, coordinates: 'uv' } : null));
    while (units.at(-1) === null) units.pop();
    const textures = Object.fromEntries(units.flatMap((unit) => (unit ? [[unit.texture, { source: `gpu/${unit.texture}.png`, filter: 'nearest' }]] : [])));
    const made = { name: 'gpu', draw: 'rectangle', program: 'gpu', units, primary: `constant:${primary.slice(0, 3).map((code) => code / 255).join(',')}` };
    return { ninebit: 'effect', version: 1, size: [size, size], textures, passes: [made] };
  }

  async update() {
    if (this.parent.hidden) return;
    try {
      if (programOf(this.store.state) === undefined) throw new Error('This pass has no program.');
      await this.run();
    } catch (error) {
      if (error instanceof Replaced) return;
      this.result.textContent = error.message;
      for (const { canvas } of this.figures) canvas.getContext('2d').clearRect(0, 0, canvas.width, canvas.height);
    }
  }

  /** The program's text, with the pass's constants in it. */
  async program() {
    const { state } = this.store;
    const { constants } = passOf(state);
    const text = programOf(state);
    if (!constants) return text;
    const { answer } = await this.engine.ask({ do: 'convert', text, profile: state.profile, to: 'json' });
    return JSON.stringify({ ...JSON.parse(answer.text), ...(constants.const0 && { constant_color0: constants.const0 }), ...(constants.const1 && { constant_color1: constants.const1 }) });
  }

  async run() {
    const { state } = this.store;
    const text = await this.program();
    const read = await this.engine.ask({ do: 'read', text, profile: state.profile });
    const textures = this.textures();
    await Promise.all(textures.map((pixels, unit) => this.engine.put({ name: `gpu/gpu${unit}.png`, kind: 'pixels', width: size, height: size }, pixels)));
    const effect = this.effect(read.answer.textures ?? []);
    const emulated = await this.engine.ask({ do: 'draw', effect, files: { gpu: text }, profile: state.profile, hash: false }, { key: 'gpu' });
    const { answer } = await this.engine.ask({ do: 'convert', text, profile: state.profile, to: 'glsl-es' }, { key: 'gpu-convert' });
    const { pixels, framesPerSecond, renderer } = runOnGpu(answer.text, {
      size, textures, primary, fog: [0, 0, 0, this.field('fog_alpha_without_fog')], byteShift: this.field('byte_shift'),
    });
    const difference = new Uint8Array(pixels.length);
    let count = 0;
    for (let at = 0; at < pixels.length; at += 4) {
      let most = 0;
      for (let part = 0; part < 4; part++) most = Math.max(most, Math.abs(pixels[at + part] - emulated.bytes[at + part]));
      if (most) count++;
      difference.fill(Math.min(255, most * 16), at, at + 3);
    }
    [emulated.bytes, pixels, difference].forEach((shown, at) => {
      const opaque = shown.slice();
      for (let alpha = 3; alpha < opaque.length; alpha += 4) opaque[alpha] = 255;
      paint(this.figures[at].canvas, opaque, size, size);
    });
    this.figures[0].caption.textContent = `The emulator: ${Math.round(1000 / Math.max(0.1, emulated.milliseconds))} frames/s`;
    this.figures[1].caption.textContent = `${renderer}: ${Math.round(framesPerSecond)} frames/s`;
    this.result.textContent = `${count.toLocaleString('en')} of ${(size * size).toLocaleString('en')} pixels differ`;
    this.result.dataset.count = String(count);
  }
}
