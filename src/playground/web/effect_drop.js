/**
 * An effect file dropped together with the files that it names: what `ninebit gl-run --dump-frame` writes, for one.
 */
import { messageOf } from './dom.js';
import { fileName, includedIn, isBelow, plainPath, sourcesFile } from './files.js';
import { complaint } from './schema.js';
import { fileIn } from './shelf.js';
import { bare, checkedEffect, checkedState, kindOfChoice, mostCharacters, profileFile, programIn, stateOf } from './state.js';

/** The folder of a file with its last slash; empty: none. @param {string} path */
const folderOf = (path) => path.slice(0, path.lastIndexOf('/') + 1);

/** @param {Uint8Array} a @param {Uint8Array} b */
const sameBytes = (a, b) => a.length === b.length && a.every((byte, at) => byte === b[at]);

/** A texture's source is a generated texture or a target where this matches, else one file or six. */
const generated = /^(normalize-cube:|checker:|gradient$|falloff$|target:|depth:)/;

/** Meshes that the engine makes. */
const generatedMesh = /^(sphere:|torus:|plane:|cube$)/;

/**
 * The effect in a text; `undefined`: it is something else, such as a program as JSON.
 * @param {string} text
 */
function effectIn(text) {
  try {
    const found = JSON.parse(text);
    return found?.ninebit === 'effect' ? found : undefined;
  } catch {
    return undefined;
  }
}

/**
 * The first effect among files, with its file.
 * @param {File[]} files
 */
export async function findEffect(files) {
  for (const file of files) {
    if (!/\.json$/i.test(file.name) || file.size > mostCharacters) continue;
    const effect = effectIn(await file.text());
    if (effect) return { file, effect };
  }
  return undefined;
}

/** The schema of what archives say of sources. */
const kindOfSources = {
  type: 'object', required: ['programs'],
  properties: { ninebit: { const: 'sources' }, version: { const: 1 }, programs: { type: 'object', additionalProperties: {
    ...kindOfChoice, required: ['source'], properties: { ...kindOfChoice.properties, source: { type: 'string' }, number: { type: 'integer', minimum: 1 } } } } },
};

/**
 * The file that a path leads to; without one, the only file of that name in any folder, as files that are dropped lose theirs.
 * @param {File[]} files
 * @param {string} path
 */
function fileAt(files, path) {
  const plain = plainPath(path), whole = files.find(({ name }) => name === plain);
  const named = whole ? [whole] : files.filter(({ name }) => fileName(name) === fileName(plain));
  if (named.length > 1) throw new Error(`${plain} is not there, but there are ${named.map(({ name }) => name).join(' and ')}; expected one of that name`);
  return named[0];
}

/**
 * The sources of which an archive's programs were made, by the programs' names.
 * @param {File} [file]
 * @returns {Promise<Map<string, {source: string, number?: number} & import('./state.js').Choice>>}
 */
async function sourcesIn(file) {
  if (!file) return new Map();
  try {
    const found = JSON.parse(await textOf(file));
    // Another file of that name says nothing about this effect.
    if (found?.ninebit !== 'sources') return new Map();
    const wrong = complaint(kindOfSources, found, 'it');
    if (wrong) throw new Error(wrong);
    return new Map(Object.entries(found.programs));
  } catch (error) {
    throw new Error(`${sourcesFile}: ${messageOf(error)}`);
  }
}

/** A pass's program as a file and a number, unless a file has the whole name. @param {string} program @param {File[]} files */
function numberedFile(program, files) {
  if (files.some(({ name }) => fileName(name) === fileName(program))) return { source: program };
  const { file, number } = programIn({}, program);
  return { source: file, number };
}

/** @param {File} file */
async function textOf(file) {
  if (file.size > mostCharacters) throw new Error(`${file.name}: a program has at most ${mostCharacters / 1e6} MB`);
  return file.text();
}

/**
 * The texts of files that programs include, and that those include, by the names by which they are found.
 * @param {Record<string, string>} programs
 * @param {File[]} files
 * @param {string} folder where the programs' names begin
 */
async function included(programs, files, folder) {
  const all = /** @type {Record<string, string>} */ (bare({}));
  const waiting = Object.entries(programs);
  for (const [from, text] of waiting) {
    for (const path of includedIn(text)) {
      const name = plainPath(folderOf(from) + path);
      if (name in programs || name in all || !isBelow(name)) continue;
      const file = fileAt(files, folder + name);
      if (!file) continue;
      all[name] = await textOf(file);
      waiting.push([name, all[name]]);
    }
  }
  return all;
}

/**
 * The state of an effect whose files are the others that were dropped: they are found by their paths from the effect's folder,
 * else by their names. A profile.json in the folder is its profile.
 * @param {any} effect
 * @param {string} name of the effect's file
 * @param {File[]} files
 * @param {import('./shelf.js').Shelf} shelf
 * @returns {Promise<import('./state.js').State>}
 */
export async function stateOfDropped(effect, name, files, shelf) {
  try {
    checkedEffect(effect);
  } catch (error) {
    throw new Error(`${name}: ${messageOf(error)}`);
  }
  const folder = folderOf(name);
  const own = (/** @type {string} */ file) => files.find((candidate) => candidate.name === folder + file);
  const find = (/** @type {string} */ path) => {
    let file;
    try {
      file = fileAt(files, folder + path);
    } catch (error) {
      throw new Error(`${name}: ${messageOf(error)}`);
    }
    if (!file) throw new Error(`${name}: drop the file ${fileName(path)}, which it names, together with it`);
    return file;
  };
  const shelved = async (/** @type {string} */ path) => {
    const there = shelf.embedded.get(path), file = own(plainPath(path));
    // A file may have the name of one of the page's and other bytes.
    if (!there || (file && !sameBytes(there, new Uint8Array(await file.arrayBuffer())))) return shelf.take(file ?? find(path));
    return path;
  };
  const programs = /** @type {Record<string, string>} */ (bare({})), choices = /** @type {Record<string, import('./state.js').Choice>} */ (bare({}));
  /** The file of each program. @type {Map<string, File>} */
  const taken = new Map();
  const sources = await sourcesIn(own(sourcesFile));
  for (const pass of effect.passes) {
    if (typeof pass?.program !== 'string') continue;
    const { source: path, number = 0, ...choice } = sources.get(pass.program) ?? numberedFile(pass.program, files);
    const file = find(path);
    const below = file.name.startsWith(folder) ? file.name.slice(folder.length) : '';
    const key = isBelow(below) ? below : fileName(file.name);
    if ((taken.get(key) ?? file) !== file) throw new Error(`${name}: ${taken.get(key)?.name} and ${file.name} would both be ${key}; expected other names`);
    taken.set(key, file);
    pass.program = number ? `${key}#${number}` : key;
    programs[key] = await textOf(file);
    if (Object.keys(choice).length) choices[key] = bare(choice);
  }
  Object.assign(programs, await included(programs, files, folder));
  for (const texture of Object.values(effect.textures ?? {})) {
    const source = String(texture?.source ?? '');
    if (generated.test(source)) continue;
    const paths = fileIn(source), names = [];
    for (const path of paths.split(',')) names.push(await shelved(path));
    texture.source = source.slice(0, source.length - paths.length) + names.join(',');
  }
  const mesh = effect.scene?.mesh;
  if (typeof mesh === 'string' && !generatedMesh.test(mesh)) effect.scene.mesh = await shelved(mesh);
  const state = { ...stateOf(effect, programs), files: programs, choices };
  const profile = own(profileFile);
  if (!profile) return state;
  if (profile.size > mostCharacters) throw new Error(`${profileFile}: a profile has at most ${mostCharacters / 1e6} MB`);
  try {
    return checkedState({ ...state, profile: JSON.parse(await profile.text()) });
  } catch (error) {
    throw new Error(`${profileFile}: ${messageOf(error)}`);
  }
}
