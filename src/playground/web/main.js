/**
 * The playground: opens what the address or the browser has, starts the engine, and shows the page.
 */
import { byId, messageOf } from './dom.js';
import { Engine, Replaced } from './engine_client.js';
import { keptFiles, keptState } from './kept.js';
import { Page, say } from './page.js';
import { opened } from './permalink.js';
import { bare, passOf, stateOf, Store } from './state.js';
import { bytesOfText } from './text_bytes.js';

const asked = new URLSearchParams(location.search);
/** In a frame of another page: picture, editor and trace alone, and nothing is kept. */
const embedded = asked.has('embed');

/** The gallery: effects, programs, pictures. @type {any} */
let content;

/** Unpacks the gallery. */
async function unpackContent() {
  const packed = new Blob([/** @type {BlobPart} */ (bytesOfText(byId('content').textContent))]);
  content = bare(await new Response(packed.stream().pipeThrough(new DecompressionStream('deflate-raw'))).json());
  content.files = pictureFiles(content.files);
}

/** The page's pictures by their names. @param {Record<string, number>} sizes in the order of their bytes @returns {Map<string, Uint8Array>} */
function pictureFiles(sizes) {
  const all = bytesOfText(byId('pictures').textContent);
  let at = 0;
  return new Map(Object.entries(sizes).map(([name, size]) => [name, all.subarray(at, at += size)]));
}

/** The effect that is there at first: the one that the address names; the tests have their own. */
function first() {
  const name = asked.get('effect') ?? /** @type {any} */ (globalThis).ninebitFirst ?? 'dot3_specular';
  return stateOf(content.effects[name] ?? content.effects.dot3_specular, content.programs);
}

/** The engine: its scripts, and its WebAssembly, packed. */
function engineProgram() {
  const { textContent: packed, dataset } = byId('wasm');
  return { scripts: [byId('engine').textContent, '\n', byId('worker').textContent], wasm: { packed, size: Number(dataset.size) } };
}

/** The state of the address, else what was kept, else the first effect; the steps before it; and what is looked at. */
async function firstStore() {
  /** @type {string[]} */
  const faults = [];
  /** @template T @param {string} what @param {() => T|Promise<T>} get @returns {Promise<T|null>} */
  const tried = async (what, get) => {
    try {
      return await get();
    } catch (error) {
      faults.push(`${what} cannot be opened: ${messageOf(error)}.`);
      return null;
    }
  };
  const linked = await tried('This link', () => opened(location.hash));
  const kept = embedded ? null : await tried('What was kept of your work', keptState);
  if (kept?.doubt) faults.push(kept.doubt);
  if (faults.length) say(faults.join('\n'));
  const past = kept?.past ?? [];
  // A link does not take the place of one's work.
  if (linked && kept && JSON.stringify(linked.state) !== JSON.stringify(kept.state)) past.push(kept.state);
  const named = Object.hasOwn(content.effects, asked.get('effect') ?? '') ? first() : null;
  if (!linked && named && kept) past.push(kept.state);
  return { store: new Store(linked?.state ?? named ?? kept?.state ?? first(), past), view: linked?.view ?? {} };
}

/**
 * Gives the shelf the dropped files of the state and its steps, as far as the browser kept them.
 * @param {Store} store
 * @param {import('./shelf.js').Shelf} shelf
 */
async function restoreFiles(store, shelf) {
  const named = JSON.stringify([store.state, store.past]);
  const files = await keptFiles((name) => named.includes(JSON.stringify(name).slice(1, -1))).catch(() => []);
  for (const [name, bytes] of files) await shelf.restore(name, bytes).catch((error) => say(`${name} cannot be opened: ${error.message}.`));
}

/** Shows that the engine works, once it has for a while. */
function busyMark() {
  /** @type {ReturnType<typeof setTimeout>} */
  let timer;
  return (/** @type {boolean} */ busy) => {
    clearTimeout(timer);
    if (busy) timer = setTimeout(() => { byId('cancel').hidden = false; }, 500);
    else byId('cancel').hidden = true;
  };
}

async function start() {
  document.body.classList.toggle('embed', embedded);
  const program = engineProgram();
  const engine = new Engine(program, busyMark(), (reason) => say(`${reason}. The text is kept; the next edit draws again.`, 'engine'));
  const newEngine = () => new Engine(program, () => {}, () => {});
  await unpackContent();
  const { store, view } = await firstStore();
  const { answer: about } = await engine.ask({ do: 'about' });
  byId('version').textContent = `ninebit ${about.version ?? ''}`;
  const page = new Page({ store, content, engine, newEngine, about, embedded });
  if (!embedded) await restoreFiles(store, page.shelf);
  page.listen();
  page.showPanel(embedded ? 'trace' : 'inputs');
  // For the console and the tests.
  /** @type {any} */ (globalThis).ninebit = { store, engine, page, passOf };
  page.show('all');
  page.look(view);
  page.link();
  // The words can wait for the first picture.
  await page.draw();
  page.updatePanels();
  const { answer } = await engine.ask({ do: 'vocabulary' });
  page.program.editor.setWords(answer.words ?? []);
  page.words = answer.words?.length ?? 0;
}

start().catch((error) => {
  if (!(error instanceof Replaced)) say(`The playground cannot start: ${error.message}.`);
});
