/**
 * The profile: a named one or one of one's own, field by field; and two profiles side by side with their difference.
 */
import { choice, element, paint } from './dom.js';
import { Replaced } from './engine_client.js';

/**
 * @typedef {{name: string, value: any, evidence: string, help: string, read: boolean, choices?: string[], range?: [number, number]}} Field
 * @typedef {{name: string, summary: string, fields: Field[]}} Profile
 */

export class ProfilesPanel {
  /**
   * @param {HTMLElement} parent
   * @param {import('./state.js').Store} store
   * @param {Profile[]} profiles
   * @param {(profiles: any[]) => Promise<any>} compare asks the engine
   */
  constructor(parent, store, profiles, compare) {
    Object.assign(this, { parent, store, profiles, compare });
    const names = profiles.map(({ name }) => name);
    this.result = element('p', { role: 'status', id: 'difference-count' });
    this.canvases = [0, 1, 2].map(() => element('canvas', { width: 1, height: 1 }));
    this.captions = [0, 1, 2].map(() => element('figcaption'));
    this.fields = element('div', { class: 'fields' });
    this.other = element('div');
    this.names = names;
    parent.append(element('div', { class: 'bar' }, this.other, this.result),
      element('div', { class: 'trio' }, ...this.canvases.map((canvas, at) => element('figure', {}, canvas, this.captions[at]))),
      element('details', { open: true }, element('summary', {}, 'A profile of your own'),
        element('p', { class: 'quiet' }, 'Change a field: the picture and the trace follow. The evidence of each field stands beside it.'), this.fields));
  }

  /** The profile's name as one reads it. */
  title() {
    const { profile } = this.store.state;
    return typeof profile === 'string' ? profile : `${profile.base ?? 'geforce2'}, changed`;
  }

  show() {
    const { state } = this.store;
    this.other.replaceChildren(choice('Compare with', this.names, state.other, (value) => this.store.change('other', (now) => { now.other = value; })));
    const base = typeof state.profile === 'string' ? state.profile : state.profile.base ?? 'geforce2';
    const known = this.profiles.find(({ name }) => name === base);
    this.fields.replaceChildren(...(known?.fields ?? []).map((field) => this.field(field, base)));
    this.update();
  }

  field({ name, value, evidence, choices, range, help, read }, base) {
    const { profile } = this.store.state;
    const own = typeof profile === 'object' && name in profile ? profile[name] : value;
    const write = (edited) => this.store.change('profile', (now) => {
      const made = typeof now.profile === 'string' ? { base, name: 'mine' } : { ...now.profile };
      if (String(edited) === String(value)) delete made[name];
      else made[name] = edited;
      now.profile = Object.keys(made).some((key) => key !== 'base' && key !== 'name') ? made : base;
    });
    const changed = String(own) !== String(value);
    let control;
    if (choices?.length) control = choice(name, choices, String(own), write);
    else if (typeof value === 'boolean') control = choice(name, ['true', 'false'], String(own), (text) => write(text === 'true'));
    else control = slider(name, Number(own), range, write);
    control.title = help ?? '';
    if (changed) control.classList.add('changed');
    if (read === false || (range && range[0] === range[1])) control.querySelector('select, input').disabled = true;
    control.append(element('small', { class: 'quiet' }, evidence));
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
      [this.title(), state.other, 'difference'].forEach((text, at) => { this.captions[at].textContent = text; });
      const { pixels, max } = answer.difference;
      const share = (100 * pixels / (width * height)).toFixed(2);
      this.result.textContent = `${pixels.toLocaleString('en')} of ${(width * height).toLocaleString('en')} pixels differ (${share} %), by ${max} of 255 at most`;
    } catch (error) {
      if (!(error instanceof Replaced)) this.result.textContent = error.message;
    }
  }
}

/** A number as a slider. @param {string} name @param {number} value @param {[number, number]} range */
function slider(name, value, [lowest, highest], write) {
  const shown = element('output', {}, value);
  const input = element('input', {
    type: 'range', min: lowest, max: highest, oninput: () => { shown.textContent = input.value; }, onchange: () => write(Number(input.value)),
  });
  input.value = String(value);
  return element('label', { class: 'field' }, element('span', {}, name), element('span', { class: 'slider' }, input, shown));
}

function opaque(pixels) {
  const copy = pixels.slice();
  for (let at = 3; at < copy.length; at += 4) copy[at] = 255;
  return copy;
}
