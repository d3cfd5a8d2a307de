/**
 * What the page shows, as plain data: an effect, the texts of its programs, and the choices beside them.
 *
 * @typedef {object} State
 * @property {any} effect the JSON of an effect file
 * @property {Record<string, string>} files the effect's programs by name, and what they include
 * @property {Record<string, Choice>} choices how programs are read whose texts leave a choice, by their files
 * @property {number} pass which pass the panels are about
 * @property {any} profile a name, or the JSON of a profile file
 * @property {string} other the profile to compare with, or "arithmetic"
 *
 * @typedef {{function?: string, defines?: Record<string, string>}} Choice the function of a source, and values that a source or a
 *     pixel shader does not give
 */

import effectSchema from '../../../docs/effect.schema.json' with { type: 'json' };
import { complaint } from './schema.js';

/** The name under which the editor offers the effect itself. */
export const effectFile = 'effect.json';

/** The name of a profile of one's own among an effect's files. */
export const profileFile = 'profile.json';

/** The number behind the name of a program in a source or a log. */
export const numbered = /^(.+)#(\d{1,9})$/;

/**
 * A pass's program as its file and, of FILE#N, the number; a file of the whole name goes before.
 * @param {Record<string, unknown>} files
 * @param {string} program
 * @returns {{file: string, number: number}} 0: there is none
 */
export function programIn(files, program) {
  const found = program in files ? null : numbered.exec(program);
  return found ? { file: found[1], number: Number(found[2]) } : { file: program, number: 0 };
}

/** The profile to compare with: each effect can be drawn with exact combiners. */
const defaultOther = 'arithmetic';

/** How deep values may be nested: an effect has fewer than 10 levels, and what walks through them has a limit. */
const mostLevels = 64;

/**
 * The value with objects that inherit nothing: `__proto__` and `constructor` are names like others in them.
 * @template T
 * @param {T} value JSON, which is changed
 * @param {string} [name] the value in the sentence that refuses one that is nested too deep
 * @param {number} [levels] how many more there may be
 * @returns {T}
 */
export function bare(value, name = 'a value', levels = mostLevels) {
  if (typeof value !== 'object' || value === null) return value;
  if (levels === 0) throw new Error(`${name} is nested more than ${mostLevels} levels deep`);
  if (!Array.isArray(value)) Object.setPrototypeOf(value, null);
  for (const inner of Object.values(value)) bare(inner, name, levels - 1);
  return value;
}

/** A copy of JSON whose objects inherit nothing. @template T @param {T} value @returns {T} */
export const copied = (value) => bare(structuredClone(value));

/** The largest texts that the page takes from an address or a file. */
export const mostCharacters = 1_000_000;

const newProgram = `!!RC1.0
# The texture, times the primary colour.
{
  rgb {
    spare0 = tex0 * col0;
  }
}
out.rgb = spare0;
out.a = unsigned_invert(zero);
`;

/** An effect of one pass on a rectangle. @returns {State} */
export function newState() {
  return bare({
    effect: {
      ninebit: 'effect', version: 1, title: 'Untitled', size: [256, 256],
      textures: { tex0: { source: 'checker:64', filter: 'nearest' } },
      passes: [{ name: 'draw', program: 'program.rc1', units: [{ texture: 'tex0', coordinates: 'uv' }] }],
    },
    files: { 'program.rc1': newProgram }, choices: {}, pass: 0, profile: 'nv2a', other: defaultOther,
  });
}

/**
 * The state that opens an effect of the gallery.
 * @param {any} effect
 * @param {Record<string, string>} programs all programs of the gallery by name
 * @returns {State}
 */
export function stateOf(effect, programs) {
  const files = Object.create(null);
  for (const { program } of effect.passes) {
    if (!program) continue;
    const { file } = programIn(programs, program);
    files[file] = programs[file] ?? '';
  }
  const first = Math.max(0, effect.passes.findIndex((/** @type {any} */ pass) => pass.program));
  return { effect: copied(effect), files, choices: Object.create(null), pass: first, profile: effect.profile ?? 'geforce2', other: defaultOther };
}

/** The schema of a choice. */
export const kindOfChoice = {
  type: 'object', additionalProperties: false,
  properties: { function: { type: 'string' }, defines: { type: 'object', additionalProperties: { type: 'string' } } },
};

/** A state's schema, beside the effect's own. */
const kindOfState = {
  type: 'object', required: ['effect', 'files'],
  properties: {
    files: { type: 'object', additionalProperties: { type: 'string' } },
    choices: { type: 'object', additionalProperties: kindOfChoice },
    pass: { type: 'integer', minimum: 0 },
    profile: { anyOf: [{ type: 'string' }, { type: 'object', properties: { base: { type: 'string' }, name: { type: 'string' } } }] },
    other: { type: 'string' },
  },
};

/** The effect, if its schema allows it; else an error in one sentence. @param {any} found */
export function checkedEffect(found) {
  const wrong = complaint(effectSchema, found, 'the effect');
  if (wrong) throw new Error(wrong.replace(/^the effect[.]/, ''));
  return bare(found, 'the effect');
}

/**
 * A state from an address, a file or storage, if it may be used; else an error in one sentence.
 * @param {any} found
 * @returns {State}
 */
export function checkedState(found) {
  const wrong = complaint(kindOfState, found, 'the state');
  if (wrong) throw new Error(wrong.replace(/^the state[.]/, ''));
  const { effect, files, choices = {}, pass = 0, profile = 'nv2a', other = defaultOther } = found;
  checkedEffect(effect);
  bare(profile, 'the profile');
  const state = { effect, files: bare(files), choices: bare(choices), pass: pass < effect.passes.length ? pass : 0, profile, other };
  return Object.setPrototypeOf(state, null);
}

/** The pass that the panels are about. @param {State} state */
export const passOf = (state) => state.effect.passes[state.pass] ?? state.effect.passes[0] ?? {};

/** The file of the program of the pass that the panels are about, or `undefined`. @param {State} state @returns {string|undefined} */
export function programFile(state) {
  const { program } = passOf(state);
  return typeof program === 'string' ? programIn(state.files, program).file : undefined;
}

/** The text of that pass's program, or `undefined`. @param {State} state @returns {string|undefined} */
export const programOf = (state) => state.files[programFile(state) ?? ''];

/** So many steps can be undone. */
export const mostSteps = 20;

/** The state, who wants to hear of its changes, and the steps that can be undone: what opens, drops and links replace. */
export class Store {
  /** @param {State} state @param {State[]} [past] */
  constructor(state, past = []) {
    this.state = bare(state);
    this.past = past;
    /** @type {State[]} */
    this.future = [];
    /** @type {((what: string) => void)[]} */
    this.listeners = [];
    /** Hears of each step. @type {(before: State, navigated: boolean) => void} */
    this.onstep = () => {};
  }

  /** @param {(what: string) => void} listener `what`: "all", "text", "inputs", "profile", "pass", "files", "choices" or "other" */
  listen(listener) {
    this.listeners.push(listener);
  }

  /** @param {string} what @param {(state: State) => void} edit */
  change(what, edit) {
    edit(this.state);
    for (const listener of this.listeners) listener(what);
  }

  /** @param {State} state */
  replace(state) {
    this.state = bare(state);
    for (const listener of this.listeners) listener('all');
  }

  /**
   * Takes note of a step.
   * @param {State} before
   * @param {boolean} [navigated] whether the address has changed already
   */
  step(before, navigated = false) {
    this.past = [...this.past, before].slice(-mostSteps);
    this.future = [];
    this.onstep(before, navigated);
  }

  /** Replaces the state in a step. @param {State} state @param {boolean} [navigated] */
  open(state, navigated) {
    const before = copied(this.state);
    this.replace(state);
    this.step(before, navigated);
  }

  undo() {
    this.swap(this.past, this.future);
  }

  redo() {
    this.swap(this.future, this.past);
  }

  /** @param {State[]} from @param {State[]} to */
  swap(from, to) {
    const state = from.pop();
    if (!state) return;
    to.push(copied(this.state));
    this.replace(state);
  }
}
