/**
 * An effect file dropped together with the files that it names: what `ninebit gl-run --dump-frame` writes, for one.
 */
import { messageOf } from './dom.js';
import { fileIn } from './shelf.js';
import { bare, checkedEffect, checkedState, mostCharacters, profileFile, stateOf } from './state.js';

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
  const shelved = async (/** @type {string} */ path) => (path in shelf.embedded ? path : shelf.take(find(path)));
  const programs = /** @type {Record<string, string>} */ (bare({}));
  for (const pass of effect.passes) {
    if (typeof pass?.program !== 'string') continue;
    const file = find(pass.program);
    if (file.size > mostCharacters) throw new Error(`${file.name}: a program has at most ${mostCharacters / 1e6} MB`);
    pass.program = file.name;
    programs[file.name] = await file.text();
  }
  for (const texture of Object.values(effect.textures ?? {})) {
    const source = String(texture?.source ?? '');
    if (generated.test(source)) continue;
    const paths = fileIn(source), names = [];
    for (const path of paths.split(',')) names.push(await shelved(path));
    texture.source = source.slice(0, source.length - paths.length) + names.join(',');
  }
  const mesh = effect.scene?.mesh;
  if (typeof mesh === 'string' && !generatedMesh.test(mesh)) effect.scene.mesh = await shelved(mesh);
  const state = stateOf(effect, programs);
  const own = files.find((file) => file.name === profileFile);
  if (!own) return state;
  if (own.size > mostCharacters) throw new Error(`${profileFile}: a profile has at most ${mostCharacters / 1e6} MB`);
  try {
    return checkedState({ ...state, profile: JSON.parse(await own.text()) });
  } catch (error) {
    throw new Error(`${profileFile}: ${messageOf(error)}`);
  }
}
