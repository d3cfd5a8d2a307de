/**
 * What a browser keeps of one's work: the state and the steps before it in localStorage, dropped files in IndexedDB.
 */
import { messageOf } from './dom.js';
import { checkedState, mostSteps } from './state.js';

const key = 'ninebit-playground';
/** Of the text in localStorage. */
const version = 1;
/** Of the database of files. */
const filesVersion = 1;
/** Where the text goes if this page cannot read it: the next `keep` would write over it. */
const unreadableKey = `${key}-unreadable`;

/**
 * Keeps the state; if there is too little room, without the steps.
 * @param {import('./state.js').Store} store
 * @returns {'all'|'state'|'nothing'} what the browser took
 */
export function keep({ state, past }) {
  for (const steps of [past, []]) {
    try {
      localStorage.setItem(key, JSON.stringify({ version, state, past: steps }));
      return steps === past ? 'all' : 'state';
    } catch {
      // No room, or a browser that keeps nothing.
    }
  }
  return 'nothing';
}

/** Moves a text that cannot be read whole; where it is, in words. A copy beside it might have no room. @param {string} text */
function setAside(text) {
  localStorage.removeItem(key);
  localStorage.setItem(unreadableKey, text);
  return `stays in localStorage as ${unreadableKey}`;
}

/**
 * What was kept; `null`: nothing. What cannot be opened is an error in words; a step that cannot be is left out. In both
 * cases the text is set aside.
 * @returns {{state: import('./state.js').State, past: import('./state.js').State[], doubt: string}|null} `doubt`: what is
 *     left out
 */
export function keptState() {
  let text;
  try {
    text = localStorage.getItem(key);
  } catch {
    return null;
  }
  if (!text) return null;
  let found;
  try {
    found = JSON.parse(text);
    if (found.version !== version) throw new Error('another version of this page wrote it');
    found.state = checkedState(found.state);
  } catch (error) {
    throw new Error(`${messageOf(error)}; its text ${setAside(text)}`);
  }
  const steps = Array.isArray(found.past) ? found.past.slice(-mostSteps) : [null];
  const past = steps.flatMap((/** @type {any} */ step) => {
    try {
      return [checkedState(step)];
    } catch {
      return [];
    }
  });
  const doubt = past.length < steps.length ? `Some steps before your work cannot be opened; their text ${setAside(text)}.` : '';
  return { state: found.state, past, doubt };
}

/** The result of a request of IndexedDB. @param {IDBRequest} request @returns {Promise<any>} */
const resultOf = (request) => new Promise((resolve, reject) => {
  request.onsuccess = () => resolve(request.result);
  request.onerror = () => reject(request.error);
});

/** @param {IDBTransactionMode} mode */
async function files(mode) {
  const opened = indexedDB.open(key, filesVersion);
  opened.onupgradeneeded = () => {
    if (!opened.result.objectStoreNames.contains('files')) opened.result.createObjectStore('files');
  };
  const database = await resultOf(opened);
  // Else a later version of this page would wait for this one.
  database.onversionchange = () => database.close();
  return database.transaction('files', mode).objectStore('files');
}

/** @param {string} name @param {Uint8Array} bytes */
export async function keepFile(name, bytes) {
  const store = await files('readwrite');
  const { transaction } = store;
  store.put(bytes, name);
  // A full disk may show only as the transaction ends.
  await new Promise((resolve, reject) => {
    transaction.oncomplete = resolve;
    transaction.onabort = () => reject(transaction.error);
  });
}

/**
 * Whether no other tab has the page open; from now on this one counts in the others. A browser that cannot tell: no.
 * @returns {Promise<boolean>}
 */
const alone = () => new Promise((resolve) => {
  const held = async () => {
    const locks = await navigator.locks.query();
    resolve((locks.held ?? []).filter(({ name }) => name === key).length === 1);
    // Held as long as the page lives.
    await new Promise(() => {});
  };
  if (!navigator.locks) resolve(false);
  else navigator.locks.request(key, { mode: 'shared' }, held).catch(() => resolve(false));
});

/**
 * The kept files for which `wanted` is true. The others are forgotten, unless another tab or a text set aside may need them.
 * @param {(name: string) => boolean} wanted
 * @returns {Promise<[string, Uint8Array][]>}
 */
export async function keptFiles(wanted) {
  const forgets = await alone() && localStorage.getItem(unreadableKey) === null;
  const store = await files('readwrite');
  const names = await resultOf(store.getAllKeys());
  /** @type {[string, Uint8Array][]} */
  const found = [];
  for (const name of names) {
    if (wanted(name)) found.push([name, await resultOf(store.get(name))]);
    else if (forgets) store.delete(name);
  }
  return found;
}
