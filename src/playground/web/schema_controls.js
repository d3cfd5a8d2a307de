/**
 * Controls for values of an effect, made from its schema: a choice for words, a field for numbers, lists and texts. A value that the
 * schema refuses stays out of the effect, and a sentence below its field says why.
 */
import effectSchema from '../../../docs/effect.schema.json' with { type: 'json' };
import { choice, element } from './dom.js';
import { complaint } from './schema.js';
import { bare } from './state.js';

/** @param {any} schema with a reference to what it means @returns {any} */
function resolved(schema) {
  if (!schema.$ref) return schema;
  const named = /** @type {any} */ (effectSchema.$defs)[schema.$ref.replace('#/$defs/', '')];
  return { ...named, description: schema.description ?? named.description };
}

/** A key in words. @param {string} key */
const words = (key) => key.replaceAll('_', ' ');

/** What a text means as a number or as an expression that moves. @param {string} text */
const single = (text) => (/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(text) ? Number(text) : text);

/** The parts between commas that no parentheses enclose. @param {string} text */
function parts(text) {
  let depth = 0, from = 0;
  const found = [];
  for (let at = 0; at <= text.length; at++) {
    if (text[at] === '(') depth++;
    else if (text[at] === ')') depth--;
    else if (at === text.length || (text[at] === ',' && depth === 0)) {
      found.push(text.slice(from, at).trim());
      from = at + 1;
    }
  }
  return found;
}

/** The kinds of values that a schema allows. @param {any} schema @returns {any[]} */
const kindsOf = (schema) => (schema.anyOf ? schema.anyOf.map(resolved) : [schema]);

/** The value that a text stands for; `undefined`: none. @param {any} schema @param {string} text */
export function valueOf(schema, text) {
  if (text.trim() === '') return undefined;
  const kinds = kindsOf(schema);
  const list = kinds.find(({ type }) => type === 'array');
  const values = parts(text).map(single);
  if (list && (values.length > 1 || kinds.length === 1)) return values;
  return schema.type === 'string' ? text.trim() : single(text.trim());
}

/** A value as its text. @param {any} value */
const textOf = (value) => (value === undefined ? '' : Array.isArray(value) ? value.join(', ') : String(value));

/** What a control is for and what it takes, in words. @param {any} schema @returns {string} */
function hint(schema) {
  const kinds = kindsOf(schema);
  const { items, minItems } = kinds.find(({ type }) => type === 'array') ?? {};
  const count = items ? `${minItems} values with commas.` : '';
  const { minimum, maximum } = kinds.find(({ type }) => type === 'number' || type === 'integer') ?? {};
  return [schema.description, count, maximum === undefined ? '' : `${minimum} to ${maximum}.`].filter(Boolean).join(' ');
}

/**
 * The text below a control that says what it is for, and that describes it; `null`: there is nothing to say.
 * @param {any} control an input or a select
 * @param {string} path names the control
 * @param {string} text
 */
function helpOf(control, path, text) {
  if (!text) return null;
  const id = `help-${path}`;
  control.setAttribute('aria-describedby', id);
  return element('small', { class: 'help quiet', id }, text);
}

/**
 * @param {string} label
 * @param {string} path names the field, for the keyboard and the tests
 * @param {any} schema
 * @param {any} value
 * @param {(value: any) => void} change takes `undefined` for none
 */
function field(label, path, schema, value, change) {
  const fault = element('small', { class: 'fault', role: 'alert' });
  const input = element('input', { type: 'text', value: textOf(value), placeholder: 'default', 'data-key': path, spellcheck: 'false', autocomplete: 'off', maxlength: 1000,
    onchange: () => {
      const wanted = valueOf(schema, input.value);
      const wrong = wanted === undefined ? null : complaint(schema, wanted, label, effectSchema);
      fault.textContent = wrong ?? '';
      input.setAttribute('aria-invalid', String(Boolean(wrong)));
      if (!wrong) change(wanted);
    } });
  return element('div', {}, element('label', { class: 'field' }, element('span', {}, label), input), helpOf(input, path, hint(schema)), fault);
}

/**
 * @param {string} label
 * @param {string} path
 * @param {any} schema
 * @param {string[]} options
 * @param {string} value
 * @param {(value: string) => void} change
 */
function select(label, path, schema, options, value, change) {
  const made = choice(label, [['', 'default'], ...options.map((option) => /** @type {[string, string]} */ ([option, words(option)]))], value, change);
  const control = made.querySelector('select');
  control.dataset.key = path;
  return element('div', {}, made, helpOf(control, path, schema.description));
}

/** Shows a control as that of a key that is not there. @param {HTMLElement} control */
function empty(control) {
  for (const input of /** @type {NodeListOf<HTMLInputElement|HTMLSelectElement>} */ (control.querySelectorAll('input, select'))) {
    input.value = '';
    input.removeAttribute('aria-invalid');
  }
  for (const fault of control.querySelectorAll('.fault')) fault.textContent = '';
}

/**
 * The controls of some keys of an object.
 * @param {any} schema of the object
 * @param {string[]} keys
 * @param {any} value the object, or `undefined`
 * @param {(edit: (object: any) => void) => void} change edits the object, which is made if it is not there
 * @param {{path?: string, before?: string, options?: Record<string, string[]>}} [more] `before`: a word before each name; `options`: the words of keys that
 *     have some besides the schema's
 * @returns {HTMLElement[]}
 */
export function controlsOf(schema, keys, value, change, { path = '', before = '', options = {} } = {}) {
  return keys.flatMap((key) => {
    const own = resolved(schema.properties[key]);
    const now = value?.[key], label = before + words(key), place = path + key;
    const set = (/** @type {any} */ wanted) => change((object) => {
      if (wanted === undefined) delete object[key];
      else object[key] = wanted;
    });
    const listed = options[key] ?? own.enum;
    if (listed) return select(label, place, own, listed, now ?? '', (wanted) => set(wanted || undefined));
    if (own.type === 'boolean') return select(label, place, own, ['yes', 'no'], now === undefined ? '' : now ? 'yes' : 'no', (wanted) => set(wanted ? wanted === 'yes' : undefined));
    const object = kindsOf(own).find(({ type }) => type === 'object');
    if (!object) return field(label, place, own, now, set);
    const nullable = kindsOf(own).some(({ type }) => type === 'null');
    // With the object, its values go.
    const off = nullable ? select(label, place, own, ['off'], now === null ? 'off' : '', (wanted) => {
      set(wanted ? null : undefined);
      inside.forEach(empty);
    }) : null;
    const inside = controlsOf(object, Object.keys(object.properties), now ?? undefined, (edit) => change((outer) => {
      const inner = outer[key] ?? bare({});
      edit(inner);
      if (Object.keys(inner).length) outer[key] = inner;
      else delete outer[key];
      // A value inside switches the object on.
      if (off) empty(off);
    }), { path: `${place}.`, before: `${label}: ` });
    return off ? [off, ...inside] : inside;
  });
}

/** The schema of a place of the effect. @param {'effect'|'scene'|'texture'|'pass'} place @returns {any} */
export function schemaOf(place) {
  const { properties } = effectSchema;
  return { effect: effectSchema, scene: properties.scene, texture: properties.textures.additionalProperties, pass: properties.passes.items }[place];
}
