/**
 * The profile: a named one or one of one's own, field by field; and two profiles side by side with their difference.
 */
import { choice, element, messageOf, paint, replaceChildren } from './dom.js';
import { Replaced } from './engine_client.js';

/**
 * @typedef {{name: string, value: any, evidence: string, help: string, read: boolean, choices?: string[], range?: [number, number]}} Field
 * @typedef {{name: string, summary: string, fields: Field[]}} Profile
 */

/** The engine's word for the same chip with exact combiners. */
const ARITHMETIC = 'arithmetic';

export class ProfilesPanel {
  /**
   * @param {HTMLElement} parent
   * @param {import('./state.js').Store} store
   * @param {Profile[]} profiles
   * @param {{compare: (profiles: any[]) => Promise<any>, engine: import('./engine_client.js').Engine}} asks
   */
  constructor(parent, store, profiles, { compare, engine }) {
    this.parent = parent;
    this.store = store;
    this.profiles = profiles;
    this.compare = compare;
    this.engine = engine;
    this.result = element('p', { role: 'status', id: 'difference-count' });
    this.canvases = [0, 1, 2].map(() => element('canvas', { width: 1, height: 1 }));
    this.captions = [0, 1, 2].map(() => element('figcaption'));
    this.fields = element('div', { class: 'fields' });
    this.coupled = element('p', { role: 'status', id: 'coupled-fields' });
    this.other = element('div');
    /** Values of fields that wait for the edits before. @type {Map<string, any>} */
    this.waiting = new Map();
    this.editing = Promise.resolve();
    /** Whether a field's slider moves: the fields are not shown anew under the pointer. */
    this.dragged = false;
    this.others = [[ARITHMETIC, 'exact combiners'], ...profiles.map(({ name }) => name)];
    parent.append(element('div', { class: 'bar' }, this.other, this.result),
      element('div', { class: 'trio' }, ...this.canvases.map((canvas, at) => element('figure', {}, canvas, this.captions[at]))),
      element('details', { open: true }, element('summary', {}, 'A profile of your own'),
        element('p', { class: 'quiet' }, 'Change a field: the picture and the trace follow. Fields that depend on it change with it. The evidence of each field stands beside it.'),
        this.coupled, this.fields));
  }

  /** The profile's name as one reads it. */
  title() {
    const { profile } = this.store.state;
    return typeof profile === 'string' ? profile : `${profile.base ?? 'geforce2'}, changed`;
  }

  show() {
    // Not under the pointer.
    if (this.dragged) return;
    const { state } = this.store;
    replaceChildren(this.other, choice('Compare with', this.others, state.other, (value) => this.store.change('other', (now) => { now.other = value; })));
    this.showFields(state.profile);
    this.update();
  }

  /** The fields of the profile, with the ranges that they have in it. @param {any} profile */
  async showFields(profile) {
    try {
      const { answer } = await this.engine.ask({ do: 'profile', profile }, { key: 'profile' });
      if (this.dragged) return;
      const base = this.profiles.find(({ name }) => name === (profile.base ?? profile));
      replaceChildren(this.fields, ...answer.fields.map((/** @type {Field} */ field, /** @type {number} */ at) => this.field(field, base?.fields[at])));
    } catch (error) {
      if (!(error instanceof Replaced)) this.fields.replaceChildren(element('p', {}, messageOf(error)));
    }
  }

  /**
   * Changes a field, and what depends on it, after the edits before; of several values of a field that wait, the last.
   * @param {string} field
   * @param {any} value
   */
  edit(field, value) {
    this.waiting.set(field, value);
    this.editing = this.editing.then(() => this.editNow(field));
    return this.editing;
  }

  /** @param {string} field */
  async editNow(field) {
    if (!this.waiting.has(field)) return;
    const value = this.waiting.get(field);
    this.waiting.delete(field);
    try {
      const { answer } = await this.engine.ask({ do: 'edit_profile', profile: this.store.state.profile, field, value });
      const others = answer.coupled.map((/** @type {any} */ other) => `${other.name} ${other.value}`);
      this.coupled.textContent = others.length ? `With ${field} ${value} also changed: ${others.join(', ')}.` : '';
      this.store.change('profile', (now) => { now.profile = answer.profile; });
    } catch (error) {
      this.coupled.textContent = messageOf(error);
      this.show();
    }
  }

  /** @param {boolean} dragged */
  hold(dragged) {
    const ended = this.dragged && !dragged;
    this.dragged = dragged;
    if (ended) this.show();
  }

  /** @param {Field} field @param {Field} [base] the same field of the profile that this one was made of */
  field({ name, value, evidence, choices, range, help, read }, base) {
    const write = (/** @type {any} */ edited) => this.edit(name, edited);
    let control;
    if (choices?.length) control = choice(name, choices, String(value), write);
    else if (typeof value === 'boolean') control = choice(name, ['true', 'false'], String(value), (text) => write(text === 'true'));
    else control = slider(name, Number(value), range ?? [0, 1], write, (dragged) => this.hold(dragged));
    control.dataset.field = name;
    if (base && base.value !== value) control.classList.add('changed');
    if (read === false || (range && range[0] === range[1])) control.querySelector('select, input').disabled = true;
    control.append(element('small', { class: 'quiet' }, evidence));
    if (help) {
      const input = control.querySelector('select, input');
      input.setAttribute('aria-label', name);
      input.setAttribute('aria-describedby', `help-profile-${name}`);
      control.append(element('small', { class: 'help quiet', id: `help-profile-${name}` }, help));
    }
    return control;
  }

  async update() {
    if (this.parent.hidden) return;
    const { state } = this.store;
    try {
      const { answer, bytes } = await this.compare([state.profile, state.other]);
      const { width, height } = answer;
      const part = width * height * 4;
      this.canvases.forEach((canvas, at) => paint(canvas, opaque(bytes.subarray(at * part, (at + 1) * part)), width, height));
      [this.title(), state.other === ARITHMETIC ? 'exact combiners' : state.other, 'difference'].forEach((text, at) => { this.captions[at].textContent = text; });
      const { pixels, max } = answer.difference;
      const share = (100 * pixels / (width * height)).toFixed(2);
      this.result.textContent = `${pixels.toLocaleString('en')} of ${(width * height).toLocaleString('en')} pixels differ (${share} %), by ${max} of 255 at most`;
    } catch (error) {
      if (!(error instanceof Replaced)) this.result.textContent = messageOf(error);
    }
  }
}

/**
 * A number as a slider.
 * @param {string} name @param {number} value @param {[number, number]} range
 * @param {(value: number) => void} write
 * @param {(dragged: boolean) => void} hold hears when the slider begins to move and when it is let go
 */
function slider(name, value, [lowest, highest], write, hold) {
  const shown = element('output', {}, value);
  let written = value;
  const take = () => {
    if (Number(input.value) === written) return;
    written = Number(input.value);
    shown.textContent = input.value;
    write(written);
  };
  const letGo = () => {
    take();
    hold(false);
  };
  const input = element('input', {
    type: 'range', min: lowest, max: highest, onpointerup: letGo, onblur: letGo, onchange: letGo, oninput: () => {
      hold(true);
      take();
    },
  });
  input.value = String(value);
  return element('label', { class: 'field' }, element('span', {}, name), element('span', { class: 'slider' }, input, shown));
}

/** @param {Uint8Array} pixels */
function opaque(pixels) {
  const copy = pixels.slice();
  for (let at = 3; at < copy.length; at += 4) copy[at] = 255;
  return copy;
}
