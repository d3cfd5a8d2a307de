/**
 * The page: its parts, connected to the state and the engine.
 */
import { CommandPanel, commandsOf } from './command_line.js';
import { Clock } from './clock.js';
import { ConvertPanel } from './convert_panel.js';
import { afterPause, byId, choice, element, messageOf, nextFrame, replaceChildren } from './dom.js';
import { acceptDrops } from './drop.js';
import { Flip } from './flip.js';
import { Gallery } from './gallery.js';
import { GpuPanel } from './gpu_panel.js';
import { InputsPanel } from './inputs_panel.js';
import { keep } from './kept.js';
import { Live } from './live.js';
import { LossesOverlay } from './losses_overlay.js';
import { addressOf, opened } from './permalink.js';
import { Picture } from './picture.js';
import { ProfilesPanel } from './profiles_panel.js';
import { ProgramPane } from './program_pane.js';
import { SavePanel } from './save_panel.js';
import { ShadowPanel } from './shadow_panel.js';
import { setFileOrigins, Shelf } from './shelf.js';
import { copied, newState } from './state.js';
import { Strip } from './strip.js';
import { SweepPanel } from './sweep_panel.js';
import { tabs } from './tabs.js';
import { TracePanel } from './trace_panel.js';

/** @typedef {import('./state.js').State} State */

/**
 * Shows a message above everything, or hides it.
 * @param {string|null} text
 * @param {string} [about] "engine": the next drawing takes the message away
 */
export function say(text, about = '') {
  byId('message').textContent = text ?? '';
  byId('message').dataset.about = about;
  byId('message').hidden = !text;
}

/** The milliseconds from the page's opening to its first picture, or to the reason why there is none: for the tests. */
function ready() {
  document.body.dataset.ready ??= String(Math.round(performance.now()));
}

/** Where nobody waits: an address that a browser refuses, as it does after many, is written after the next change. @param {Error} error */
const unwritten = (error) => { if (error.name !== 'SecurityError') throw error; };

/** Where Ctrl-Z is the browser's or the editor's, or nothing's. */
const ownUndo = '.cm-editor, dialog, input:not([type=range]):not([type=color]), textarea';
/** Where letters are typed. */
const typed = '.cm-editor, dialog, input:not([type=range], [type=checkbox], [type=color]), select, textarea';

/** Whether the things to try were hidden before. */
const triesKey = 'ninebit-playground-tries';

/** Everything that shows the state. */
export class Page {
  /**
   * @param {{store: import('./state.js').Store, content: any, engine: import('./engine_client.js').Engine,
   *     newEngine: () => import('./engine_client.js').Engine, about: any, embedded: boolean}} given `engine` draws,
   *     `newEngine` makes more of them
   */
  constructor({ store, content, engine, newEngine, about, embedded }) {
    this.store = store;
    this.content = content;
    this.engine = engine;
    this.embedded = embedded;
    setFileOrigins(about.file_origins ?? []);
    this.shelf = new Shelf(engine, content.files);
    this.program = new ProgramPane(store, content.programs);
    this.live = new Live(store, engine, this.shelf, {
      read: (answer) => this.read(answer), drawn: (result) => this.drawn(result), failed: (error) => this.failed(error),
      traced: (trace, pass) => this.traced(trace, pass),
    });
    this.live.effectText = () => this.program.effectText;
    this.forms = new Map((about.forms ?? []).map((/** @type {any} */ { name, title }) => [name, title]));
    this.profileNames = /** @type {string[]} */ ((about.profiles ?? []).map((/** @type {any} */ { name }) => name));
    /** How many words the editor completes, once it does. */
    this.words = 0;
    this.picture = new Picture(byId('picture'), (x, y) => this.chosen(x, y));
    /** What the picture shows: the effect, or index shadows. @type {'effect'|'shadow'} */
    this.mode = 'effect';
    /** The last picture of each. @type {Map<string, {pixels: Uint8Array, width: number, height: number}>} */
    this.pictures = new Map();
    this.flip = new Flip(this.store, this.live, this.picture, () => this.showPicture());
    this.losses = new LossesOverlay(this.store, this.live, this.picture, () => this.link());
    this.clock = new Clock(this.live, { draw: () => this.live.draw(), started: () => this.started(), stopped: () => this.stopped() });
    this.flip.onshow = () => this.clock.pause();
    this.picture.bar.append(this.flip.button, this.losses.element);
    byId('below').prepend(this.clock.element, this.picture.status);
    this.strip = new Strip(byId('strip'), (name) => this.showPanel(name));
    const { shelf, live, picture } = this;
    const changed = () => this.link();
    // Only the lines of a program have boxes, not those of the effect's JSON.
    const ofProgram = (/** @type {() => void} */ light) => { if (this.program.shows === 'program') light(); };
    this.trace = new TracePanel(byId('trace'), byId('trace-place'), (pass) => live.trace(pass), (lines) => ofProgram(() => this.program.editor.light(lines)));
    this.program.editor.onmove = (line) => ofProgram(() => this.trace.lightLine(line));
    this.inputs = new InputsPanel(byId('panel-inputs'), store, shelf, about);
    this.profiles = new ProfilesPanel(byId('panel-profiles'), store, about.profiles ?? [],
      { compare: (/** @type {any[]} */ profiles) => live.compare(profiles), engine });
    this.gpu = new GpuPanel(byId('panel-gpu'), store, shelf, engine, live);
    this.convert = new ConvertPanel(byId('panel-convert'), about.converts_to ?? [], (to) => live.convert(to));
    this.shadow = new ShadowPanel(byId('panel-shadow'), store, shelf, {
      engine, newEngine, meshes: about.meshes ?? [], picture, changed,
      drawn: (pixels, width, height) => {
        this.keepPicture('shadow', pixels, width, height);
        byId('drawing').textContent = `${width} x ${height}`;
      },
    });
    this.sweep = new SweepPanel(byId('panel-sweep'), store, live, { profiles: this.profileNames, choosePixel: () => this.chooseBright('sweep'), changed });
    this.command = new CommandPanel(byId('panel-command'), () => commandsOf(store.state, live.pixel, live.moment));
    this.save = new SavePanel(byId('panel-save'), store, shelf, engine, picture);
    this.showPanel = tabs(/** @type {HTMLElement} */ (document.querySelector('#panels [role=tablist]')), (name) => this.panelShown(name));
    /** The picture follows each change; panels and the trace follow a pause. */
    this.soon = nextFrame(() => this.draw());
    this.later = afterPause(150, () => this.updatePanels());
    this.inputs.onshown = afterPause(200, () => this.inputs.update());
    this.link = afterPause(400, () => { this.keep().catch(unwritten); });
    /** The last writing of the address: each waits for the one before, which may have failed. @type {Promise<void>} */
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

  /** The panel that is open. */
  panel() {
    return document.querySelector('#panels [aria-selected=true]')?.getAttribute('data-panel') ?? 'inputs';
  }

  /** @param {string} name */
  panelShown(name) {
    this.setMode(name === 'shadow' ? 'shadow' : 'effect');
    if (name === 'profiles') this.profiles.show();
    else if (name === 'inputs') this.inputs.show();
    else if (name === 'trace') this.live.trace();
    else /** @type {any} */ (this)[name]?.update?.();
    this.link?.();
  }

  /** @param {'effect'|'shadow'} mode */
  setMode(mode) {
    byId('mode-effect').setAttribute('aria-pressed', String(mode === 'effect'));
    byId('mode-shadow').setAttribute('aria-pressed', String(mode === 'shadow'));
    if (mode === this.mode) return;
    this.mode = mode;
    if (mode === 'shadow') this.clock.pause();
    this.flip.set(false);
    this.flip.button.disabled = mode === 'shadow';
    this.picture.dim(false);
    this.picture.unmark();
    this.losses.see(mode === 'effect');
    if (mode === 'effect') this.shadow.update();
    if (mode === 'effect' && this.live.pixel) this.picture.put(this.live.pixel);
    byId('strip').hidden = mode === 'shadow';
    this.clock.element.hidden ||= mode === 'shadow';
    this.showTitle();
    this.showPicture();
    if (mode === 'effect') this.soon?.();
  }

  showTitle() {
    byId('title').textContent = this.mode === 'shadow' ? 'Index shadows' : this.store.state.effect.title ?? 'Untitled';
    byId('title').title = byId('title').textContent;
  }

  /** @param {'effect'|'shadow'} mode @param {Uint8Array} pixels @param {number} width @param {number} height */
  keepPicture(mode, pixels, width, height) {
    this.pictures.set(mode, { pixels, width, height });
    if (mode === this.mode && !this.flip.on) this.picture.show(pixels, width, height);
  }

  showPicture() {
    const last = this.pictures.get(this.mode);
    if (last) this.picture.show(last.pixels, last.width, last.height);
  }

  /** @param {string} what */
  changed(what) {
    this.show(what);
    if (what === 'other') {
      this.profiles.update();
      this.flip.update();
      this.sweep.update();
    } else {
      this.soon();
      this.later();
    }
    this.link();
  }

  /** Shows a change in the controls. @param {string} what */
  show(what) {
    if (what === 'all') {
      this.live.pixel = null;
      this.clock.reset();
      this.program.file = null;
      this.trace.clear();
      this.strip.clear();
      this.sweep.clear();
      this.picture.unmark();
      this.inputs.ofProgram = {};
      this.inputs.view = null;
      this.program.editor.forget();
      this.program.choices.forget();
    }
    if (what === 'all' || (what === 'inputs' && this.program.editing)) this.inputs.show();
    // Controls change the effect's text, where that is shown.
    if (what === 'inputs' && this.program.shows === 'effect' && !this.program.editing) this.program.show();
    if (what === 'all') this.program.show();
    if (what === 'files' || what === 'choices') this.program.show();
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
    if (this.program.shows !== 'effect') this.live.read();
    await this.live.draw();
  }

  /** While an effect plays, neither the other profile's picture nor the marks would be those of its moment. */
  started() {
    this.flip.set(false);
    this.losses.hold();
  }

  stopped() {
    this.losses.held = false;
    this.updatePanels();
  }

  updatePanels() {
    if (this.clock.playing) return;
    if (this.live.pixel) this.live.trace();
    this.losses.update();
    this.flip.update();
    for (const panel of [this.profiles, this.gpu, this.convert, this.command, this.shadow, this.sweep]) panel.update();
  }

  /** @param {any} answer */
  read(answer) {
    const notes = (answer.notes ?? []).map((/** @type {any} */ note) => ({ ...note, severity: 'info' }));
    const all = [...(answer.faults ?? []), ...notes];
    // Places are those of the program's own text.
    const placed = this.program.shows === 'program';
    this.program.setFaults('read', placed ? all : all.map((fault) => ({ ...fault, line: undefined, column: undefined })));
    this.program.offer(answer);
    byId('form').textContent = answer.form ? `read as: ${this.forms.get(answer.form) ?? answer.form}` : '';
    byId('explanation').textContent = answer.explanation ?? '';
    this.inputs.setConstants(answer.constants ?? {});
  }

  /** @param {{answer: any, bytes: Uint8Array, milliseconds: number}} result */
  drawn({ answer, bytes, milliseconds }) {
    const warnings = [...answer.warnings ?? [], ...this.shelf.doubtsOf(this.store.state.effect)];
    this.program.setFaults('draw', warnings.map((message) => ({ message, severity: 'info' })));
    if (byId('message').dataset.about === 'engine') say(null);
    this.inputs.setView(answer.view);
    this.keepPicture('effect', bytes, answer.width, answer.height);
    this.clock.show(answer.moves && this.mode === 'effect');
    byId('picture').dataset.hash = answer.hash?.color ?? '';
    this.showTitle();
    byId('drawing').textContent = `${answer.width} x ${answer.height}, ${milliseconds.toFixed(1)} ms`;
    ready();
  }

  /** @param {any} error */
  failed(error) {
    byId('picture').dataset.hash = '';
    byId('drawing').textContent = 'not drawn: the last good picture is below';
    this.clock.pause();
    const ofEffect = this.program.shows === 'effect' && error.file === 'effect';
    // The engine's sentences have a place, the schema's has none.
    if (ofEffect) this.program.setFaults('read', []);
    this.program.setFaults('draw', [error, ...error.others ?? []].map(({ file, line, column, message }) => (
      file === 'effect' || !file ? { message, ...(ofEffect && { line, column }) } : { message: `${file}: ${message}` })));
    ready();
  }

  /** @param {any} trace @param {string} [pass] */
  traced(trace, pass) {
    const { pixel } = this.live;
    if (!pixel) return;
    this.sweep.pass = trace.effect?.pass ?? undefined;
    this.trace.show(trace, pixel, pass, this.store.state);
    this.strip.show(trace, pixel);
  }

  /** @param {number} x @param {number} y */
  chosen(x, y) {
    if (this.mode === 'shadow') return;
    this.live.pixel = { x, y };
    if (this.panel() === 'sweep') {
      this.live.trace();
      this.sweep.update();
      this.link();
    } else this.showPanel('trace');
    byId('panels').scrollTop = 0;
    // One below the other, as on a phone, the picture comes to the upper edge, so that the trace is in view, too.
    if (byId('panels').offsetTop > byId('picture-pane').offsetTop) byId('picture-pane').scrollIntoView({ block: 'start' });
  }

  /** Chooses a bright pixel, if none is chosen, and opens a panel. @param {string} panel */
  chooseBright(panel) {
    this.showPanel('inputs');
    if (!this.live.pixel) {
      const place = this.picture.brightest();
      this.picture.put(place);
      this.live.pixel = place;
      this.live.trace();
    }
    this.showPanel(panel);
  }

  /** What is looked at, for links. */
  view() {
    const { pixel } = this.live;
    const tab = this.panel(), shadow = this.shadow.settings(), sweep = this.sweep.settings();
    return {
      ...(pixel && { pixel: [pixel.x, pixel.y] }), ...(tab !== 'inputs' && { tab }), ...(shadow && { shadow }), ...(sweep && { sweep }),
      ...(this.program.file !== null && { file: this.program.file }),
      ...(this.losses.kind && { losses: [this.losses.kind, this.losses.stage] }), ...(this.flip.on && { flip: true }),
    };
  }

  /** Looks at what a link says; what cannot be is left out. @param {any} view */
  look(view) {
    const { pixel, tab, shadow, sweep, losses, flip, file } = view ?? {};
    if (!this.embedded) this.program.look(file); // a frame has no tabs: it could not go back to the program
    if (typeof shadow === 'object' && shadow !== null) this.shadow.take(shadow);
    this.sweep.take(sweep);
    if (Array.isArray(losses)) this.losses.take(String(losses[0]), /^\d$/.test(losses[1]) ? losses[1] : '');
    if (Array.isArray(pixel) && pixel.length === 2 && pixel.every((value) => Number.isInteger(value) && value >= 0)) {
      const [x, y] = pixel;
      this.live.pixel = { x, y };
      this.picture.put({ x, y });
    }
    if (typeof tab === 'string') this.showPanel(tab);
    if (flip === true) this.flip.set(true);
  }

  /** Writes a state into the address, or into one behind it. @param {State} [state] @param {'replaceState'|'pushState'} [how] */
  writeAddress(state = this.store.state, how = 'replaceState') {
    const written = copied(state);
    const view = state === this.store.state ? this.view() : undefined;
    this.writing = this.writing.catch(() => {}).then(async () => history[how](null, '', await addressOf(written, view)));
    return this.writing;
  }

  /** A step that a person took: Back returns to the state before it. @param {State} before @param {boolean} navigated */
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
    // A frame of another page does not write over one's work.
    if (this.embedded) return;
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
      say(`The link cannot be written: ${messageOf(error)}.`);
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
    const draw = async (/** @type {State} */ state) => {
      await this.shelf.loadFor(state.effect);
      return this.engine.ask(Live.request(state));
    };
    const open = (/** @type {State} */ state, navigated = false) => {
      say(null);
      this.store.open(state, navigated);
    };
    const undo = (/** @type {'undo'|'redo'} */ how) => {
      say(null);
      this.store[how]();
    };
    byId('undo').addEventListener('click', () => undo('undo'));
    byId('redo').addEventListener('click', () => undo('redo'));
    document.addEventListener('keydown', (event) => this.key(event, undo));
    if (!this.embedded) window.addEventListener('pagehide', () => keep(this.store));
    const gallery = new Gallery(byId('gallery'), this.content, draw, open);
    byId('open-gallery').addEventListener('click', () => gallery.show());
    byId('new-program').addEventListener('click', () => open(newState()));
    byId('copy-link').addEventListener('click', () => this.copyLink());
    byId('cancel').addEventListener('click', () => this.engine.restart('the engine was stopped'));
    byId('mode-effect').addEventListener('click', () => { if (this.mode !== 'effect') this.showPanel('inputs'); });
    byId('mode-shadow').addEventListener('click', () => this.showPanel('shadow'));
    this.listenToTries();
    acceptDrops({ store: this.store, shelf: this.shelf, inputs: this.inputs, editor: () => this.program.show(), open }, say);
    window.addEventListener('hashchange', async () => {
      this.link.cancel();
      try {
        const found = await opened(location.hash);
        if (!found) return;
        open(found.state, true);
        this.look(found.view);
      } catch (error) {
        say(`This link cannot be opened: ${messageOf(error)}.`);
      }
    });
  }

  /** @param {KeyboardEvent} event @param {(how: 'undo'|'redo') => void} undo */
  key(event, undo) {
    const target = /** @type {Element} */ (event.target);
    const key = event.key.toLowerCase();
    if ((event.ctrlKey || event.metaKey) && key === 'z' && !target.closest?.(ownUndo)) {
      event.preventDefault();
      undo(event.shiftKey ? 'redo' : 'undo');
    } else if (key === 'f' && !event.ctrlKey && !event.metaKey && !event.altKey && this.mode === 'effect' && !target.closest?.(typed)) {
      event.preventDefault();
      this.flip.toggle();
      this.link();
    }
  }

  listenToTries() {
    try {
      byId('tries').hidden = this.embedded || localStorage.getItem(triesKey) !== null;
    } catch {
      byId('tries').hidden = this.embedded;
    }
    byId('try-trace').addEventListener('click', () => this.chooseBright('trace'));
    byId('try-flip').addEventListener('click', () => {
      this.showPanel('inputs');
      this.flip.toggle();
    });
    byId('try-sweep').addEventListener('click', () => this.chooseBright('sweep'));
    byId('hide-tries').addEventListener('click', () => {
      byId('tries').hidden = true;
      try {
        localStorage.setItem(triesKey, 'hidden');
      } catch {
        // They are there again at the next visit.
      }
    });
    byId('strip').addEventListener('click', () => byId('panels').scrollIntoView({ block: 'nearest' }));
    const whole = element('a', { id: 'whole', target: '_blank', rel: 'noopener', href: location.pathname }, 'Open in the playground');
    whole.addEventListener('click', () => { whole.href = `${location.pathname}${location.hash}`; });
    byId('strip').after(whole);
  }
}
