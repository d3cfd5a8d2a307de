/**
 * A sweep: an output of the chosen pixel's combiners for each byte of one input, with the exact value and another
 * profile beside it, and below it the distances from the exact value in codes.
 */
import { choice, element, replaceChildren } from './dom.js';
import { Replaced } from './engine_client.js';
import { exactCombiners } from './flip.js';

/** @typedef {{profile: string, one: number, at: number|null, codes: number[], values: number[], exact: number[]}} Curve */
/** @typedef {{stage: number|null, register: string, components: string}} Written */

const namespace = 'http://www.w3.org/2000/svg';
/** The plot's sides, and the space for its numbers. */
const width = 560, left = 46, right = 12, tall = 240, low = 110, top = 12, gap = 30;

/** @param {string} name @param {Record<string, string|number>} attributes @param {string} [text] */
function svg(name, attributes, text) {
  const made = document.createElementNS(namespace, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  if (text !== undefined) made.textContent = text;
  return made;
}

/** @param {number} byte */
const xOf = (byte) => left + (width - left - right) * byte / 255;

/** Round numbers from the lowest to the highest. @param {number} lowest @param {number} highest */
function ticks(lowest, highest) {
  const span = highest - lowest;
  const step = [0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10, 25, 50, 100].find((size) => span / size <= 5) ?? 250;
  const found = [];
  for (let at = Math.ceil(lowest / step - 1e-9); at * step <= highest + 1e-9; at++) found.push(at * step);
  return found;
}

/** A part of the plot: its axis and its lines. */
class Axes {
  /** @param {number} from the upper edge @param {number} height @param {number} lowest @param {number} highest */
  constructor(from, height, lowest, highest) {
    this.yOf = (/** @type {number} */ value) => from + height * (highest - value) / (highest - lowest);
    this.group = svg('g', {});
    for (const tick of ticks(lowest, highest)) {
      const y = this.yOf(tick);
      this.group.append(svg('line', { x1: left, x2: width - right, y1: y, y2: y, class: tick === 0 ? 'axis' : 'grid' }),
        svg('text', { x: left - 6, y: y + 4, 'text-anchor': 'end' }, String(Number(tick.toFixed(2)))));
    }
  }

  /** @param {number[]} values one for each byte @param {string} name of the line's class @param {boolean} stepped */
  line(values, name, stepped) {
    let path = '';
    values.forEach((value, byte) => {
      const y = this.yOf(value).toFixed(2);
      path += byte === 0 ? `M${xOf(0).toFixed(2)} ${y}` : stepped ? `H${xOf(byte - 0.5).toFixed(2)}V${y}` : `L${xOf(byte).toFixed(2)} ${y}`;
    });
    this.group.append(svg('path', { d: stepped ? `${path}H${xOf(255).toFixed(2)}` : path, class: `curve ${name}`, fill: 'none' }));
  }
}

export class SweepPanel {
  /**
   * @param {HTMLElement} parent
   * @param {import('./state.js').Store} store
   * @param {import('./live.js').Live} live
   * @param {{profiles: string[], choosePixel: () => void, changed: () => void}} given
   */
  constructor(parent, store, live, { profiles, choosePixel, changed }) {
    this.parent = parent;
    this.store = store;
    this.live = live;
    this.profiles = profiles;
    this.changed = changed;
    this.input = '';
    this.output = 'out.r';
    this.stage = '';
    /** The other profile; empty: the one to compare with, if it is a profile. */
    this.beside = '';
    /** The pass of the last trace. @type {string|undefined} */
    this.pass = undefined;
    /** @type {Curve[]} */
    this.curves = [];
    this.controls = element('div', { class: 'shadow-controls' });
    this.plot = /** @type {any} */ (svg('svg', { viewBox: `0 0 ${width} ${top + tall + gap + low + 44}`, class: 'plot', role: 'img', tabindex: 0 }));
    this.plot.addEventListener('pointermove', (/** @type {PointerEvent} */ event) => this.point(event));
    this.plot.addEventListener('pointerdown', (/** @type {PointerEvent} */ event) => this.point(event));
    this.plot.addEventListener('keydown', (/** @type {KeyboardEvent} */ event) => this.key(event));
    this.place = element('p', { role: 'status', id: 'sweep-place' });
    this.value = element('output', { id: 'sweep-value' });
    this.byte = 0;
    this.first = element('p', {}, 'A sweep starts from a pixel of the picture: ', element('button', { type: 'button', class: 'small', id: 'sweep-start', onclick: choosePixel }, 'take a bright one'), ' or click one.');
    this.body = element('div', { hidden: true }, this.controls, this.place, element('div', { class: 'sweep' }, this.plot), this.value);
    parent.append(this.first, this.body);
  }

  clear() {
    this.pass = undefined;
    this.first.hidden = false;
    this.body.hidden = true;
  }

  /** The profiles of the curves: the page's, and the other one. */
  profilesOf() {
    const { profile, other } = this.store.state;
    const beside = this.beside || (other !== exactCombiners ? other : '');
    return beside && beside !== profile ? [profile, beside] : [profile];
  }

  async update() {
    if (this.parent.hidden || !this.live.pixel) return;
    const ask = (/** @type {string} */ input) => this.live.sweep({
      input, output: this.output, profiles: this.profilesOf(), ...(this.stage !== '' && { stage: Number(this.stage) }), ...(this.pass && { pass: this.pass }),
    });
    try {
      let answer = await ask(this.input || 'tex0.rgb');
      // A first look shows something that changes.
      const offered = answer.inputs;
      if (!this.input && offered.length) {
        this.input = `${offered[0]}.rgb`;
        answer = await ask(this.input);
      }
      this.show(answer);
    } catch (error) {
      if (error instanceof Replaced) return;
      this.first.hidden = true;
      this.body.hidden = false;
      this.plot.replaceChildren();
      this.value.textContent = '';
      this.place.textContent = error instanceof Error ? error.message : String(error);
      // What was chosen for another program may not be there.
      if (this.stage !== '' || this.output !== 'out.r') {
        this.stage = '';
        this.output = 'out.r';
        this.update();
      }
    }
  }

  /** @param {{inputs: string[], outputs: Written[], curves: Curve[]}} answer */
  show({ inputs, outputs, curves }) {
    this.first.hidden = true;
    this.body.hidden = false;
    this.curves = curves;
    const again = (/** @type {() => void} */ change) => {
      change();
      this.changed();
      this.update();
    };
    const parts = inputs.flatMap((name) => ['rgb', 'r', 'g', 'b', 'a'].map((part) => `${name}.${part}`));
    /** @type {[string, string][]} */
    const places = outputs.flatMap(({ stage, register, components }) => [...components].map((part) => /** @type {[string, string]} */ ([
      `${stage ?? ''}/${register}.${part}`, stage === null ? `${register}.${part}` : `combiner ${stage}: ${register}.${part}`])));
    const input = choice('Input', parts, this.input, (value) => again(() => { this.input = value; }));
    input.querySelector('select').id = 'sweep-input';
    const output = choice('Output', places.reverse(), `${this.stage}/${this.output}`, (value) => again(() => { [this.stage, this.output] = value.split('/'); }));
    output.querySelector('select').id = 'sweep-output';
    const beside = choice('Beside it', [['', 'the profile to compare with'], ...this.profiles.map((name) => /** @type {[string, string]} */ ([name, name]))], this.beside,
      (value) => again(() => { this.beside = value; }));
    replaceChildren(this.controls, input, output, beside);
    this.byte = curves[0].at ?? this.byte;
    const { x, y } = /** @type {{x: number, y: number}} */ (this.live.pixel);
    this.place.textContent = `Pixel (${x}, ${y}), all other inputs as they are there. ${this.output} for each byte of ${this.input}:`;
    this.draw();
  }

  draw() {
    const [own, other] = this.curves;
    const values = this.curves.flatMap((curve) => [...curve.values, ...curve.exact]);
    const lowest = Math.min(0, ...values), highest = Math.max(lowest + 0.05, ...values);
    const distance = (/** @type {Curve} */ curve) => curve.values.map((value, byte) => (value - curve.exact[byte]) * curve.one);
    const distances = this.curves.flatMap(distance);
    const upper = new Axes(top, tall, lowest, highest);
    const lower = new Axes(top + tall + gap, low, Math.min(-1, ...distances), Math.max(1, ...distances));
    upper.line(own.exact, 'exact', false);
    if (other) {
      upper.line(other.values, 'other', true);
      lower.line(distance(other), 'other', true);
    }
    upper.line(own.values, 'own', true);
    lower.line(distance(own), 'own', true);
    const foot = top + tall + gap + low;
    const names = svg('g', {});
    for (const byte of [0, 64, 128, 192, 255]) names.append(svg('text', { x: xOf(byte), y: foot + 16, 'text-anchor': 'middle' }, String(byte)));
    names.append(svg('text', { x: left, y: top + tall + gap - 8 }, 'minus exact, in codes'));
    let at = left;
    for (const [name, title] of [['own', own.profile], ...(other ? [['other', other.profile]] : []), ['exact', 'exact']]) {
      names.append(svg('line', { x1: at, x2: at + 22, y1: foot + 34, y2: foot + 34, class: `curve ${name}` }), svg('text', { x: at + 28, y: foot + 38 }, title));
      at += 40 + 8 * title.length;
    }
    this.cursor = svg('line', { x1: 0, x2: 0, y1: top, y2: foot, class: 'cursor' });
    this.plot.replaceChildren(upper.group, lower.group, names, this.cursor);
    this.say();
  }

  /** @param {PointerEvent} event */
  point(event) {
    const box = this.plot.getBoundingClientRect();
    const x = (event.clientX - box.left) / box.width * width;
    this.move(Math.round((x - left) / (width - left - right) * 255));
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (!step) return;
    event.preventDefault();
    this.move(this.byte + step);
  }

  /** @param {number} byte */
  move(byte) {
    this.byte = Math.min(255, Math.max(0, byte));
    this.say();
  }

  /** The values at the byte that is pointed at. */
  say() {
    const [own, other] = this.curves;
    if (!own) return;
    this.cursor?.setAttribute('transform', `translate(${xOf(this.byte)})`);
    const number = (/** @type {number} */ value) => value.toFixed(5);
    const of = (/** @type {Curve} */ curve) => `${curve.profile} ${curve.codes[this.byte]} = ${number(curve.values[this.byte])}`;
    this.value.textContent = [`${this.input} = ${this.byte}${this.byte === own.at ? ' (as it is)' : ''}: ${of(own)}`, ...(other ? [of(other)] : []),
      `exact ${number(own.exact[this.byte] * own.one)} codes = ${number(own.exact[this.byte])}`].join(' · ');
    this.plot.setAttribute('aria-label', this.value.textContent);
  }

  /** What is chosen, as a link keeps it. */
  settings() {
    return this.input ? { input: this.input, output: this.output, stage: this.stage, beside: this.beside } : null;
  }

  /** Takes settings of a link. @param {any} settings */
  take(settings) {
    for (const key of /** @type {const} */ (['input', 'output', 'stage', 'beside'])) {
      if (typeof settings?.[key] === 'string' && /^[\w.-]{0,40}$/.test(settings[key])) this[key] = settings[key];
    }
  }
}
