/**
 * The playground: builds the page from its parts and connects them.
 */
import { CommandPanel, commandsOf } from './command_line.js';
import { ConvertPanel } from './convert_panel.js';
import { afterPause, byId, choice, nextFrame, replaceChildren } from './dom.js';
import { acceptDrops } from './drop.js';
import { Engine, Replaced } from './engine_client.js';
import { Gallery } from './gallery.js';
import { GpuPanel } from './gpu_panel.js';
import { InputsPanel } from './inputs_panel.js';
import { Live } from './live.js';
import { addressOf, stateOfAddress } from './permalink.js';
import { Picture } from './picture.js';
import { ProfilesPanel } from './profiles_panel.js';
import { ProgramPane } from './program_pane.js';
import { ShadowPanel } from './shadow_panel.js';
import { keep, keptFiles, keptState } from './kept.js';
import { bytesOf, setFileOrigins, Shelf } from './shelf.js';
import { bare, copied, newState, passOf, stateOf, Store } from './state.js';
import { tabs } from './tabs.js';
import { TracePanel } from './trace_panel.js';

const content = bare(JSON.parse(byId('content').textContent));
const first = () => stateOf(content.effects.sepia ?? Object.values(content.effects)[0], content.programs);

/**
 * Shows a message above everything, or hides it.
 * @param {string|null} text
 * @param {string} [about] "engine": the next drawing takes the message away
 */
function say(text, about = '') {
  byId('message').textContent = text ?? '';
  byId('message').dataset.about = about;
  byId('message').hidden = !text;
}

/** The milliseconds from the page's opening to its first picture, or to the reason why there is none: for the tests. */
function ready() {
  document.body.dataset.ready ??= String(Math.round(performance.now()));
}

/** The engine's script, which the page holds compressed. */
async function engineScript() {
  const stream = new Blob([bytesOf(byId('engine').textContent)]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).text();
}

/** The state of the address, else what was kept, else the first effect; and the steps before it. */
async function firstStore() {
  const faults = [];
  const tried = async (what, get) => {
    try {
      return await get();
    } catch (error) {
      faults.push(`${what} cannot be opened: ${error.message}.`);
      return null;
    }
  };
  const linked = await tried('This link', () => stateOfAddress(location.hash));
  const kept = await tried('What was kept of your work', keptState);
  if (kept?.doubt) faults.push(kept.doubt);
  if (faults.length) say(faults.join('\n'));
  const past = kept?.past ?? [];
  // A link does not take the place of one's work.
  if (linked && kept && JSON.stringify(linked) !== JSON.stringify(kept.state)) past.push(kept.state);
  return new Store(linked ?? kept?.state ?? first(), past);
}

/** Gives the shelf the dropped files of the state and its steps, as far as the browser kept them. */
async function restoreFiles(store, shelf) {
  const named = JSON.stringify([store.state, store.past]);
  const files = await keptFiles((name) => named.includes(JSON.stringify(name).slice(1, -1))).catch(() => []);
  for (const [name, bytes] of files) await shelf.restore(name, bytes).catch((error) => say(`${name} cannot be opened: ${error.message}.`));
}

/** Where nobody waits: an address that a browser refuses, as it does after many, is written after the next change. */
const unwritten = (error) => { if (error.name !== 'SecurityError') throw error; };

/** Where Ctrl-Z is the browser's or the editor's, or nothing's. */
const ownUndo = '.cm-editor, dialog, input:not([type=range]):not([type=color]), textarea';

/** Everything that shows the state. */
class Page {
  /**
   * @param {Store} store
   * @param {{engine: Engine, newEngine: () => Engine}} engines the one that draws, and more of them
   * @param {any} about
   */
  constructor(store, { engine, newEngine }, about) {
    this.store = store;
    this.engine = engine;
    setFileOrigins(about.file_origins ?? []);
    this.shelf = new Shelf(engine, content.files);
    this.program = new ProgramPane(store, content.programs);
    this.live = new Live(store, engine, this.shelf, {
      read: (answer) => this.read(answer), drawn: (result) => this.drawn(result), failed: (error) => this.failed(error),
      traced: (trace, pass) => this.trace.show(trace, this.live.pixel, pass),
    });
    this.live.effectText = () => this.program.effectText;
    this.picture = new Picture(byId('picture'), (x, y) => this.chosen(x, y));
    this.trace = new TracePanel(byId('trace'), byId('trace-place'), (pass) => this.live.trace(pass));
    this.inputs = new InputsPanel(byId('panel-inputs'), store, this.shelf, about);
    this.profiles = new ProfilesPanel(byId('panel-profiles'), store, about.profiles ?? [],
      { compare: (profiles) => this.live.compare(profiles), engine });
    this.gpu = new GpuPanel(byId('panel-gpu'), store, this.shelf, engine);
    this.convert = new ConvertPanel(byId('panel-convert'), about.converts_to ?? [], (to) => this.live.convert(to));
    this.shadow = new ShadowPanel(byId('panel-shadow'), store, this.shelf, { engine, newEngine, meshes: about.meshes ?? [] });
    this.command = new CommandPanel(byId('panel-command'), () => commandsOf(store.state, this.live.pixel));
    this.forms = new Map((about.forms ?? []).map(({ name, title }) => [name, title]));
    this.profileNames = (about.profiles ?? []).map(({ name }) => name);
    this.showPanel = tabs(document.querySelector('[role=tablist]'), (name) => this.panelShown(name));
    /** The picture follows each change; panels and the trace follow a pause. */
    this.soon = nextFrame(() => this.draw());
    this.later = afterPause(150, () => this.updatePanels());
    this.link = afterPause(400, () => { this.keep().catch(unwritten); });
    /** The last writing of the address: each waits for the one before, which may have failed. */
    this.writing = Promise.resolve();
    store.listen((what) => this.changed(what));
    store.onstep = (before, navigated) => this.stepped(before, navigated);
    /** Whether the browser did not keep a dropped file. */
    this.fileLost = false;
    this.shelf.onlost = () => {
      this.fileLost = true;
      this.keepWork();
    };
  }

  panelShown(name) {
    if (name === 'profiles') this.profiles.show();
    else if (name === 'inputs') this.inputs.show();
    else if (name === 'trace') this.live.trace();
    else this[name]?.update?.();
  }

  changed(what) {
    this.show(what);
    if (what === 'other') this.profiles.update();
    else {
      this.soon();
      this.later();
    }
    this.link();
  }

  /** Shows a change in the controls. */
  show(what) {
    if (what === 'all') {
      this.live.pixel = null;
      this.program.shows = 'program';
      this.trace.clear();
      this.picture.unmark();
      this.inputs.ofProgram = {};
      this.inputs.view = null;
      this.program.editor.forget();
    }
    if (what === 'all' || (what === 'inputs' && this.program.shows === 'effect')) this.inputs.show();
    if (what === 'all') this.program.show();
    if (what === 'pass') this.inputs.show();
    if (what === 'all') this.showSteps();
    if (what === 'all' || what === 'profile') {
      this.showProfile();
      this.profiles.show();
      if (what === 'profile') this.inputs.show();
    }
  }

  showProfile() {
    const { profile } = this.store.state;
    const name = typeof profile === 'string' ? profile : this.profiles.title();
    replaceChildren(byId('profile-choice'), choice('Profile', this.profileNames, name, (value) => {
      if (this.profileNames.includes(value)) this.store.change('profile', (state) => { state.profile = value; });
    }));
  }

  /** Reads the program and draws. A drawing that still waits gives way to a newer one. */
  async draw() {
    if (this.program.shows === 'program') this.live.read();
    await this.live.draw();
  }

  updatePanels() {
    if (!byId('panel-trace').hidden) this.live.trace();
    for (const panel of [this.profiles, this.gpu, this.convert, this.command, this.shadow]) panel.update();
  }

  read(answer) {
    const notes = (answer.notes ?? []).map((note) => ({ ...note, severity: 'info' }));
    this.program.setFaults('read', [...(answer.faults ?? []), ...notes]);
    byId('form').textContent = answer.form ? `read as: ${this.forms.get(answer.form) ?? answer.form}` : '';
    byId('explanation').textContent = answer.explanation ?? '';
    this.inputs.setConstants(answer.constants ?? {});
  }

  drawn({ answer, bytes, milliseconds }) {
    const warnings = [...answer.warnings ?? [], ...this.shelf.doubtsOf(this.store.state.effect)];
    this.program.setFaults('draw', warnings.map((message) => ({ message, severity: 'info' })));
    if (byId('message').dataset.about === 'engine') say(null);
    this.inputs.setView(answer.view);
    this.picture.show(bytes, answer.width, answer.height);
    byId('picture').dataset.hash = answer.hash?.color ?? '';
    byId('title').textContent = this.store.state.effect.title ?? 'Untitled';
    byId('drawing').textContent = `${answer.width} x ${answer.height}, ${milliseconds.toFixed(1)} ms`;
    ready();
  }

  failed(error) {
    byId('picture').dataset.hash = '';
    byId('drawing').textContent = 'not drawn: the last good picture is below';
    const ofEffect = this.program.shows === 'effect' && error.file === 'effect';
    // The engine's sentences have a place, the schema's has none.
    if (ofEffect) this.program.setFaults('read', []);
    this.program.setFaults('draw', [error, ...error.others ?? []].map(({ file, line, column, message }) => (
      file === 'effect' || !file ? { message, ...(ofEffect && { line, column }) } : { message: `${file}: ${message}` })));
    ready();
  }

  chosen(x, y) {
    this.live.pixel = { x, y };
    this.showPanel('trace');
  }

  /** Writes a state into the address, or into one behind it. @param {'replaceState'|'pushState'} [how] */
  writeAddress(state = this.store.state, how = 'replaceState') {
    const written = copied(state);
    this.writing = this.writing.catch(() => {}).then(async () => history[how](null, '', await addressOf(written)));
    return this.writing;
  }

  /** A step that a person took: Back returns to the state before it. */
  stepped(before, navigated) {
    this.link.cancel();
    if (!navigated) {
      this.writeAddress(before).catch(unwritten);
      this.writeAddress(this.store.state, 'pushState').catch(unwritten);
    }
    this.keepWork();
    this.showSteps();
  }

  keep() {
    this.keepWork();
    return this.writeAddress();
  }

  /** Keeps the work, and says how much of it is kept. */
  keepWork() {
    const kept = keep(this.store);
    const lost = [...kept === 'state' ? ['the steps before it'] : [], ...this.fileLost ? ['a file that you dropped'] : []];
    byId('kept').textContent = kept === 'nothing' ? 'This browser does not keep your work: copy the link.'
      : `Your work is kept in this browser${lost.length ? `, without ${lost.join(' and without ')}` : ''}.`;
  }

  showSteps() {
    byId('undo').disabled = this.store.past.length === 0;
    byId('redo').disabled = this.store.future.length === 0;
  }

  async copyLink() {
    try {
      await this.writeAddress();
    } catch (error) {
      say(`The link cannot be written: ${error.message}.`);
      return;
    }
    const { length } = location.href;
    const dropped = [...this.shelf.dropped.keys()].some((name) => JSON.stringify(this.store.state.effect).includes(JSON.stringify(name).slice(1, -1)));
    try {
      await navigator.clipboard.writeText(location.href);
      say(null);
      byId('copy-link').textContent = `Copied: ${length} characters`;
    } catch {
      byId('copy-link').textContent = 'It is in the address bar';
    }
    if (dropped) say('The link does not hold the files that you dropped: whoever opens it sees the program without them.');
    setTimeout(() => { byId('copy-link').textContent = 'Copy link'; }, 3000);
  }

  listen() {
    const draw = async (state) => {
      await this.shelf.loadFor(state.effect);
      return this.engine.ask(Live.request(state));
    };
    const open = (state, navigated = false) => {
      say(null);
      this.store.open(state, navigated);
    };
    const undo = (how) => {
      say(null);
      this.store[how]();
    };
    byId('undo').addEventListener('click', () => undo('undo'));
    byId('redo').addEventListener('click', () => undo('redo'));
    document.addEventListener('keydown', (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== 'z' || event.target.closest?.(ownUndo)) return;
      event.preventDefault();
      undo(event.shiftKey ? 'redo' : 'undo');
    });
    window.addEventListener('pagehide', () => keep(this.store));
    const gallery = new Gallery(byId('gallery'), content, draw, open);
    byId('open-gallery').addEventListener('click', () => gallery.show());
    byId('new-program').addEventListener('click', () => open(newState()));
    byId('copy-link').addEventListener('click', () => this.copyLink());
    byId('cancel').addEventListener('click', () => this.engine.restart('the engine was stopped'));
    acceptDrops({ store: this.store, shelf: this.shelf, inputs: this.inputs, editor: () => this.program.show(), open }, say);
    window.addEventListener('hashchange', async () => {
      this.link.cancel();
      try {
        const state = await stateOfAddress(location.hash);
        if (state) open(state, true);
      } catch (error) {
        say(`This link cannot be opened: ${error.message}.`);
      }
    });
  }
}

/** Shows that the engine works, once it has for a while. */
function busyMark() {
  let timer = 0;
  return (busy) => {
    clearTimeout(timer);
    if (busy) timer = setTimeout(() => { byId('cancel').hidden = false; }, 500);
    else byId('cancel').hidden = true;
  };
}

async function start() {
  const scripts = [await engineScript(), '\n', byId('worker').textContent];
  const engine = new Engine(scripts, busyMark(), (reason) => say(`${reason}. The text is kept; the next edit draws again.`, 'engine'));
  const newEngine = () => new Engine(scripts, () => {}, () => {});
  const store = await firstStore();
  const { answer: about } = await engine.ask({ do: 'about' });
  byId('version').textContent = `ninebit ${about.version ?? ''}`;
  const page = new Page(store, { engine, newEngine }, about);
  await restoreFiles(store, page.shelf);
  page.listen();
  page.showPanel('inputs');
  // For the console and the tests.
  globalThis.ninebit = { store, engine, page, passOf };
  page.show('all');
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
