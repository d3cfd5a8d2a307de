/**
 * The files of an effect as a person sees them: programs of its passes, what sources include, the effect itself.
 */
import { effectFile, numbered, profileFile, programFile, programIn } from './state.js';

/** @typedef {import('./state.js').State} State */

/** The name of a file without its folders. @param {string} path */
export const fileName = (path) => path.slice(path.lastIndexOf('/') + 1);

/** A path without parts that lead nowhere: a/./b//c/../d is a/b/d. @param {string} path */
export function plainPath(path) {
  /** @type {string[]} */
  const parts = [];
  for (const part of path.split('/')) {
    if (part === '..' && parts.length && parts[parts.length - 1] !== '..') parts.pop();
    else if (part && part !== '.') parts.push(part);
  }
  return parts.join('/');
}

/** The name of the file of sources that an archive holds. */
export const sourcesFile = 'sources.json';

/** Names of programs' files, in the order of the passes. @param {State} state @returns {string[]} */
export const programFiles = ({ effect, files }) => [...new Set(/** @type {string[]} */ (effect.passes.flatMap(
  (/** @type {any} */ { program }) => (typeof program === 'string' ? [programIn(files, program).file] : []))))];

/** All names that have a tab: programs, other texts, the effect. @param {State} state @returns {string[]} */
export const allFiles = (state) => [...new Set([...programFiles(state), ...Object.keys(state.files), effectFile])];

/** Whether a file of that name is below the folder and is not one that the page writes itself. @param {string} name */
export const isBelow = (name) => /^[^/\\\0-\x1f-][^\\\0-\x1f]*$/.test(name) && !name.split('/').some((/** @type {string} */ part) => ['', '.', '..'].includes(part)) &&
  !/^program-\d+\.txt$/.test(name) && ![effectFile, profileFile, sourcesFile, 'picture.png', 'playground.sh'].includes(name);

/** Why a file cannot have a name, in one sentence; `null`: it can. @param {State} state @param {string} name */
export function faultOfName(state, name) {
  if (!isBelow(name) || numbered.test(name) || name.length > 200) {
    return `${JSON.stringify(name)} is not a valid name for a file; expected one such as lights.c or lib/lights.h`;
  }
  return allFiles(state).includes(name) ? `There is a file ${name}; expected another name` : null;
}

/** A name that no file has. @param {State} state @param {string} wanted such as program.rc1 */
export function freeName(state, wanted) {
  const [, stem, ending] = /** @type {RegExpExecArray} */ (/^(.*?)(\.[^.]*)?$/s.exec(wanted));
  for (let number = 1; ; number++) {
    const name = `${stem}${number > 1 ? `-${number}` : ''}${ending ?? ''}`;
    if (!allFiles(state).includes(name)) return name;
  }
}

/** Gives a file another name, in passes and choices, too. @param {State} state @param {string} from @param {string} to */
export function rename(state, from, to) {
  for (const pass of state.effect.passes) {
    if (typeof pass.program !== 'string') continue;
    const { file, number } = programIn(state.files, pass.program);
    if (file === from) pass.program = number ? `${to}#${number}` : to;
  }
  for (const of of [state.files, state.choices]) {
    const all = Object.entries(of);
    for (const [name] of all) delete of[name];
    // The file keeps its place.
    for (const [name, value] of all) of[name === from ? to : name] = value;
  }
}

/** @param {State} state @param {string} name */
export function remove(state, name) {
  delete state.files[name];
  delete state.choices[name];
}

/** Names in quotation marks that a text includes. @param {string} text @returns {string[]} */
export const includedIn = (text) => [...text.matchAll(/^[ \t]*#[ \t]*include[ \t]*"([^"\n]+)"/gm)].map(([, name]) => name.replaceAll('\\', '/').replace(/^(\.\/)+/, ''));

/**
 * The name of a text that stands beside the pass's program, as what that includes does and a header; `undefined`: it does not.
 * @param {State} state
 * @param {string} name of the dropped file
 */
export function besideProgram(state, name) {
  const wanted = Object.values(state.files).flatMap(includedIn).filter((path) => path.split('/').pop() === name);
  const found = wanted.find(isBelow);
  if (wanted.length && !found) throw new Error(`${name}: it is included as ${JSON.stringify(wanted[0])}; expected a name in the program's folder or below, such as "${name}"`);
  const beside = found ?? (/\.(h|hh|hpp|inc|inl)$/i.test(name) && isBelow(name) ? name : undefined);
  return beside && (programFile(state) ?? '').replace(/[^/]*$/, '') + beside;
}

/** What an archive says of programs that were made of sources, so that the page opens the sources again. @param {import('./command_line.js').Converted[]} converted */
export const sourcesOf = (converted) => ({ ninebit: 'sources', version: 1, programs: Object.fromEntries(converted.map(({ from, number, choice, to }) => [to, {
  source: from, ...(number && { number }), ...choice }])) });
