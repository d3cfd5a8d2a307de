/**
 * The chosen pixel in one line below the picture: what the program reads there, what it gives, and what was lost.
 */
import { element } from './dom.js';

/** @typedef {{code: number, real: number, ideal: number}} Value */

/** The objects with a key, anywhere in a value. @param {any} value @param {string} key @returns {any[]} */
function having(value, key) {
  if (typeof value !== 'object' || value === null) return [];
  const own = Object.hasOwn(value, key) ? [value] : [];
  return [...own, ...Object.values(value).flatMap((part) => having(part, key))];
}

/** A value's name and codes, with a swatch of its colour. @param {string} name @param {number[]} codes @param {number} one */
function item(name, codes, one) {
  const byte = (/** @type {number} */ code) => Math.round(255 * Math.min(1, Math.max(0, code / one)));
  return element('span', { class: 'strip-item' }, element('span', { class: 'chip', style: `background: rgb(${codes.slice(0, 3).map(byte).join(' ')})` }),
    element('b', {}, name), ` ${codes.join(' ')}`);
}

export class Strip {
  /** @param {HTMLElement} parent @param {(panel: string) => void} open */
  constructor(parent, open) {
    this.parent = parent;
    this.open = open;
    this.clear();
  }

  clear() {
    this.parent.replaceChildren(element('span', { class: 'quiet' }, 'Click a pixel to follow its bits.'));
  }

  /** @param {any} trace @param {{x: number, y: number}} pixel */
  show(trace, pixel) {
    const place = element('b', {}, `(${pixel.x}, ${pixel.y})`);
    if (trace.error || !trace.stages) {
      this.parent.replaceChildren(place, ` ${trace.error?.message ?? 'no program drew here'}`);
      return;
    }
    const read = new Set(having([trace.stages, trace.final], 'register').map(({ register }) => register));
    const inputs = Object.keys(trace.before).filter((name) => read.has(name) && !name.startsWith('spare')).map((name) => item(name, trace.before[name].codes, trace.one));
    const dropped = having([trace.stages, trace.final], 'dropped').filter((step) => step.dropped.units !== 0 && step.dropped.real !== 0).length;
    const cut = having([trace.stages, trace.final], 'cut').filter((step) => step.cut.code !== 0).length;
    /** @type {Value[]} */
    const written = [...trace.final.rgb.map((/** @type {any} */ channel) => channel.written), trace.final.alpha.written];
    const off = Math.max(...written.map(({ code, ideal }) => Math.abs(code - ideal * trace.one)));
    const count = (/** @type {number} */ number, /** @type {string} */ word) => `${number} ${word}${number === 1 ? '' : 's'}`;
    const button = (/** @type {string} */ title, /** @type {string} */ panel) => element('button', { type: 'button', class: 'small', onclick: () => this.open(panel) }, title);
    this.parent.replaceChildren(place, ...inputs, element('span', {}, '→'), item('out', trace.out.codes, trace.one),
      element('span', { class: 'quiet' }, `${off < 0.05 ? 'exact' : `up to ${off.toFixed(1)} codes from exact`}: ${count(dropped, 'truncation')}, ${count(cut, 'clamp')}`),
      button('Trace', 'trace'), button('Sweep', 'sweep'));
  }
}
