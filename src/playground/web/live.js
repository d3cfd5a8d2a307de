/**
 * Keeps the page in step with the state: reads the program, draws the picture, traces the chosen pixel.
 */
import { Replaced } from './engine_client.js';
import { passOf, programIn, programOf } from './state.js';

/** When the picture is drawn. @typedef {{time: number, frame: number}} Moment */

/** Choices without empty values, which say that nothing is chosen. @param {Record<string, import('./state.js').Choice>} choices */
const readable = (choices) => Object.fromEntries(Object.entries(choices).map(([file, { function: name, defines = {} }]) => [file, {
  ...(name && { function: name }), defines: Object.fromEntries(Object.entries(defines).filter(([key, value]) => key && value)) }]));

/** @param {unknown} error @returns {any} */
const asError = (error) => (error instanceof Error ? error : new Error(String(error)));

export class Live {
  /**
   * @param {import('./state.js').Store} store
   * @param {import('./engine_client.js').Engine} engine
   * @param {import('./shelf.js').Shelf} shelf
   * @param {{read: (answer: any) => void, drawn: (result: any) => void, failed: (error: any) => void, traced: (trace: any, pass?: string) => void}} view
   */
  constructor(store, engine, shelf, view) {
    this.store = store;
    this.engine = engine;
    this.shelf = shelf;
    this.view = view;
    /** The effect's text while it is edited, so that faults have its lines. @type {() => string|null} */
    this.effectText = () => null;
    /** The pixel whose trace is shown. @type {{x: number, y: number}|null} */
    this.pixel = null;
    /** @type {Moment} */
    this.moment = { time: 0, frame: 0 };
    /** Whether drawings are hashed: the tests ask for it, and it takes longer than many a drawing. */
    this.hash = Boolean(/** @type {any} */ (globalThis).ninebitHashes);
  }

  /** The request that draws a state. @param {import('./state.js').State} state @param {Moment} [moment] */
  static request({ effect, files, choices, profile }, { time, frame } = { time: 0, frame: 0 }) {
    return { do: 'draw', effect, files, choices: readable(choices), profile, time, frame, hash: false };
  }

  /**
   * What a request about a pass's program says of it.
   * @param {import('./state.js').State} state
   * @param {any} [pass]
   */
  static program(state, pass = passOf(state)) {
    const { file, number } = programIn(state.files, pass.program ?? '');
    const text = state.files[file] ?? '';
    const { [file]: choice } = readable(state.choices);
    // An included file may include others.
    return { text, name: file, profile: state.profile, choice: { ...choice, ...(number && { program: number }) }, ...(/#\s*include/.test(text) && { files: state.files }) };
  }

  async read() {
    const { state } = this.store;
    if (programOf(state) === undefined) {
      this.view.read({ form: '', faults: [], notes: [], explanation: 'This pass has no program: the primary colour is drawn.', constants: {} });
      return;
    }
    try {
      const { answer } = await this.engine.ask({ do: 'read', ...Live.program(state) }, { key: 'read' });
      this.view.read(answer);
    } catch (caught) {
      const error = asError(caught);
      if (!(error instanceof Replaced)) this.view.read({ form: '', faults: [{ line: error.line, column: error.column, message: error.message }], notes: [], explanation: '', constants: {} });
    }
  }

  async draw() {
    try {
      await this.shelf.loadFor(this.store.state.effect);
      const { effect, ...rest } = Live.request(this.store.state, this.moment);
      const result = await this.engine.ask({ ...rest, effect: this.effectText() ?? effect, hash: this.hash }, { key: 'draw' });
      this.view.drawn(result);
    } catch (error) {
      if (!(error instanceof Replaced)) this.view.failed(asError(error));
    }
  }

  /** Draws the state, so that the engine's next answer is about it, whoever asked for the last drawing. */
  prepare() {
    this.engine.ask(Live.request(this.store.state, this.moment)).catch(() => {});
  }

  /** An answer about the state's drawing, and none of an older state: a newer one of its kind waits behind its own drawing. @param {any} request */
  askPrepared(request) {
    const key = request.do;
    this.engine.ask(Live.request(this.store.state, this.moment), { key: `drawing for ${key}`, last: true }).catch(() => {});
    return this.engine.ask(request, { key, last: true });
  }

  /**
   * Traces a pixel.
   * @param {string} [pass] without it the last pass with a program
   */
  async trace(pass) {
    if (!this.pixel) return;
    try {
      this.prepare();
      const { answer } = await this.engine.ask({ do: 'pixel', ...this.pixel, ...(pass && { pass }) });
      this.view.traced(answer, pass);
    } catch (error) {
      this.view.traced({ error: asError(error) });
    }
  }

  /**
   * An output of the chosen pixel for each byte of an input.
   * @param {{input: string, output: string, stage?: number, pass?: string, profiles: any[]}} what
   */
  async sweep(what) {
    return (await this.askPrepared({ do: 'sweep', ...this.pixel, ...what })).answer;
  }

  /** Where the combiners of the pass that is edited lost something. */
  async losses() {
    return this.askPrepared({ do: 'losses', pass: this.store.state.pass });
  }

  /**
   * The picture under two profiles.
   * @param {any[]} profiles
   * @param {string} [key] who asks: a newer comparison replaces only those of the same
   */
  async compare(profiles, key = 'compare') {
    const { effect, files, choices } = this.store.state;
    await this.shelf.loadFor(effect);
    return this.engine.ask({ do: 'compare', effect, files, choices: readable(choices), profiles, ...this.moment }, { key });
  }

  /** @param {string} to */
  convert(to) {
    const { state } = this.store;
    if (programOf(state) === undefined) return Promise.reject(new Error('This pass has no program.'));
    return this.engine.ask({ do: 'convert', ...Live.program(state), to }, { key: 'convert' });
  }
}
