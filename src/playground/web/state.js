/**
 * What the page shows, as plain data: an effect, the texts of its programs, and the choices beside them.
 *
 * @typedef {object} State
 * @property {any} effect the JSON of an effect file
 * @property {Record<string, string>} files the effect's programs by name
 * @property {number} pass which pass the panels are about
 * @property {string|object} profile a name, or the JSON of a profile file
 * @property {string} other the profile to compare with, or "arithmetic"
 */

/** The name under which the editor offers the effect itself. */
export const effectFile = 'effect.json';

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
  return {
    effect: {
      ninebit: 'effect', version: 1, title: 'Untitled', size: [256, 256],
      textures: { tex0: { source: 'checker:64', filter: 'nearest' } },
      passes: [{ name: 'draw', program: 'program.rc1', units: [{ texture: 'tex0', coordinates: 'uv' }] }],
    },
    files: { 'program.rc1': newProgram }, pass: 0, profile: 'nv2a', other: 'geforce256-8bit',
  };
}

/**
 * The state that opens an effect of the gallery.
 * @param {any} effect
 * @param {Record<string, string>} programs all programs of the gallery by name
 * @returns {State}
 */
export function stateOf(effect, programs) {
  const files = {};
  for (const pass of effect.passes) if (pass.program) files[pass.program] = programs[pass.program] ?? '';
  const first = Math.max(0, effect.passes.findIndex((pass) => pass.program));
  return { effect: structuredClone(effect), files, pass: first, profile: effect.profile ?? 'geforce2', other: 'geforce256-8bit' };
}

/**
 * A state from an address or from nowhere good: what is missing or of another kind is an error in words.
 * @param {any} found
 * @returns {State}
 */
export function checkedState(found) {
  const object = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);
  if (!object(found) || !object(found.effect) || !Array.isArray(found.effect.passes) || !found.effect.passes.every(object)) {
    throw new Error('the address holds no effect with passes');
  }
  if (!object(found.files) || !Object.values(found.files).every((text) => typeof text === 'string')) {
    throw new Error('the address holds programs that are not texts');
  }
  const pass = Number.isInteger(found.pass) && found.pass >= 0 && found.pass < found.effect.passes.length ? found.pass : 0;
  const profile = typeof found.profile === 'string' || object(found.profile) ? found.profile : 'nv2a';
  const other = typeof found.other === 'string' ? found.other : 'geforce256-8bit';
  return { effect: found.effect, files: { ...found.files }, pass, profile, other };
}

/** The pass that the panels are about. @param {State} state */
export const passOf = (state) => state.effect.passes[state.pass] ?? state.effect.passes[0] ?? {};

/** The text of that pass's program, or `undefined`. @param {State} state */
export const programOf = (state) => state.files[passOf(state).program];

/** A size as a pair. @param {State} state @returns {[number, number]} */
export function sizeOf(state) {
  const size = state.effect.size ?? 512;
  return Array.isArray(size) ? [size[0], size[1]] : [size, size];
}

/** The state, and who wants to hear of its changes. */
export class Store {
  /** @param {State} state */
  constructor(state) {
    this.state = state;
    /** @type {((what: string) => void)[]} */
    this.listeners = [];
  }

  /** @param {(what: string) => void} listener `what`: "all", "text", "inputs", "profile" or "pass" */
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
    this.state = state;
    for (const listener of this.listeners) listener('all');
  }
}
