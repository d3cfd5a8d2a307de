/**
 * What a browser keeps of one's work: the state and the steps before it in localStorage, dropped files in IndexedDB.
 */
import { checkedState, mostSteps } from './state.js';

const key = 'ninebit-playground';
const version = 1;

/**
 * Keeps the state; if there is too little room, without the steps.
 * @param {import('./state.js').Store} store
 * @returns {boolean} whether the browser took it
 */
export function keep({ state, past }) {
  for (const steps of [past, []]) {
    try {
      localStorage.setItem(key, JSON.stringify({ version, state, past: steps }));
      return true;
    } catch {
      // No room, or a browser that keeps nothing.
    }
  }
  return false;
}

/**
 * What was kept; `null`: nothing. What cannot be opened is an error in words.
 * @returns {{state: import('./state.js').State, past: import('./state.js').State[]}|null}
 */
export function keptState() {
  let text;
  try {
    text = localStorage.getItem(key);
  } catch {
    return null;
  }
  if (!text) return null;
  const found = JSON.parse(text);
  if (found.version !== version) throw new Error('another version of this page wrote it');
  return { state: checkedState(found.state), past: found.past.slice(-mostSteps).map(checkedState) };
}

/** The result of a request of IndexedDB. @param {IDBRequest} request @returns {Promise<any>} */
const resultOf = (request) => new Promise((resolve, reject) => {
  request.onsuccess = () => resolve(request.result);
  request.onerror = () => reject(request.error);
});

/** @param {IDBTransactionMode} mode */
async function files(mode) {
  const opened = indexedDB.open(key, version);
  opened.onupgradeneeded = () => opened.result.createObjectStore('files');
  return (await resultOf(opened)).transaction('files', mode).objectStore('files');
}

/** @param {string} name @param {Uint8Array} bytes */
export async function keepFile(name, bytes) {
  await resultOf((await files('readwrite')).put(bytes, name));
}

/**
 * The kept files for which `wanted` is true; the others are forgotten.
 * @param {(name: string) => boolean} wanted
 * @returns {Promise<[string, Uint8Array][]>}
 */
export async function keptFiles(wanted) {
  const store = await files('readwrite');
  const names = await resultOf(store.getAllKeys());
  const found = [];
  for (const name of names) {
    if (wanted(name)) found.push([name, await resultOf(store.get(name))]);
    else store.delete(name);
  }
  return found;
}
