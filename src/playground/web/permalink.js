/**
 * The state in the page's address: `#1.` and the JSON, deflated, in the alphabet of base64url. 1 is the version.
 */
import { bare, checkedState, mostCharacters } from './state.js';

const version = 1;

/** @param {Blob} blob @param {'compress'|'decompress'} what */
async function through(blob, what) {
  const stream = what === 'compress' ? new CompressionStream('deflate-raw') : new DecompressionStream('deflate-raw');
  const reader = blob.stream().pipeThrough(stream).getReader();
  const parts = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return new Blob(parts);
    size += value.length;
    if (size > mostCharacters * 4) throw new Error('the address unpacks to more than a program needs');
    parts.push(value);
  }
}

/**
 * The address's part from `#` on.
 * @param {import('./state.js').State} state
 * @param {any} [view] what is looked at: the pixel, the tab, settings of panels
 * @returns {Promise<string>}
 */
export async function addressOf(state, view) {
  const written = view && Object.keys(view).length ? { ...state, view } : state;
  const packed = new Uint8Array(await (await through(new Blob([JSON.stringify(written)]), 'compress')).arrayBuffer());
  let binary = '';
  for (const byte of packed) binary += String.fromCharCode(byte);
  return `#${version}.${btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')}`;
}

/**
 * The state of an address, and what is looked at; `null` where there is none. Anything else is an error in words.
 * @param {string} hash
 * @returns {Promise<{state: import('./state.js').State, view: any}|null>}
 */
export async function opened(hash) {
  if (hash.length < 2) return null;
  const match = /^#(\d+)\.([A-Za-z0-9_-]*)$/.exec(hash);
  if (!match) throw new Error('the address is not one that this page has written');
  if (Number(match[1]) > version) {
    throw new Error(`the address is of version ${match[1]}; this page reads versions up to ${version}: open it in a newer playground`);
  }
  if (Number(match[1]) < 1 || match[2].length > mostCharacters) throw new Error('the address is damaged or too long');
  let found;
  try {
    const binary = atob(match[2].replaceAll('-', '+').replaceAll('_', '/'));
    const bytes = Uint8Array.from(binary, (character) => character.charCodeAt(0));
    found = JSON.parse(await (await through(new Blob([bytes]), 'decompress')).text());
  } catch {
    throw new Error('the address is damaged: part of it is missing or changed');
  }
  const view = typeof found?.view === 'object' && found.view !== null ? bare(found.view, 'what the link looks at') : {};
  return { state: checkedState(found), view };
}
