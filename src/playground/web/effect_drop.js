/**
 * An effect file dropped together with the files that it names: what `ninebit gl-run --dump-frame` writes, for one.
 */
import { messageOf } from './dom.js';
import { includedIn, isBelow, programIn, sourcesFile } from './files.js';
import { complaint } from './schema.js';
import { fileIn } from './shelf.js';
import { bare, checkedEffect, checkedState, kindOfChoice, mostCharacters, profileFile, stateOf } from './state.js';

/** @param {string} path */
const fileName = (path) => path.split('/').pop();

/** A texture's source is a generated texture or a target where this matches, else one file or six. */
const generated = /^(normalize-cube:|checker:|gradient$|falloff$|target:|depth:)/;

/** Meshes that the engine makes. */
const generatedMesh = /^(sphere:|torus:|plane:|cube$)/;

/**
 * The effect in a text; `undefined`: it is something else, such as a program as JSON.
 * @param {string} text
 */
export function effectIn(text) {
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
 * The sources of which an archive's programs were made, by the programs' names.
 * @param {File[]} files
 * @returns {Promise<Map<string, {source: string, number?: number} & import('./state.js').Choice>>}
 */
async function sourcesIn(files) {
  const file = files.find(({ name }) => name === sourcesFile);
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
  if (files.some(({ name }) => name === fileName(program))) return { source: program };
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
 */
export async function included(programs, files) {
  const all = /** @type {Record<string, string>} */ (bare({}));
  const waiting = Object.values(programs);
  for (const text of waiting) {
    for (const name of includedIn(text)) {
      const file = files.find((candidate) => candidate.name === fileName(name));
      if (!file || name in programs || name in all || !isBelow(name)) continue;
      all[name] = await textOf(file);
      waiting.push(all[name]);
    }
  }
  return all;
}

/**
 * The state of an effect whose files are the others that were dropped: they are found by their names without folders. A
 * profile.json among them is its profile.
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
  const find = (/** @type {string} */ path) => {
    const file = files.find((candidate) => candidate.name === fileName(path));
    if (!file) throw new Error(`${name}: drop the file ${fileName(path)}, which it names, together with it`);
    return file;
  };
  const shelved = async (/** @type {string} */ path) => (shelf.embedded.has(path) ? path : shelf.take(find(path)));
  const programs = /** @type {Record<string, string>} */ (bare({})), choices = /** @type {Record<string, import('./state.js').Choice>} */ (bare({}));
  const sources = await sourcesIn(files);
  for (const pass of effect.passes) {
    if (typeof pass?.program !== 'string') continue;
    const { source: path, number = 0, ...choice } = sources.get(pass.program) ?? numberedFile(pass.program, files);
    const file = find(path);
    pass.program = number ? `${file.name}#${number}` : file.name;
    programs[file.name] = await textOf(file);
    if (Object.keys(choice).length) choices[file.name] = bare(choice);
  }
  Object.assign(programs, await included(programs, files));
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
  const own = files.find((file) => file.name === profileFile);
  if (!own) return state;
  if (own.size > mostCharacters) throw new Error(`${profileFile}: a profile has at most ${mostCharacters / 1e6} MB`);
  try {
    return checkedState({ ...state, profile: JSON.parse(await own.text()) });
  } catch (error) {
    throw new Error(`${profileFile}: ${messageOf(error)}`);
  }
}
