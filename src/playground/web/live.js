/**
 * Keeps the page in step with the state: reads the program, draws the picture, traces the chosen pixel.
 */
import { Replaced } from './engine_client.js';
import { passOf, programOf } from './state.js';

export class Live {
  /**
   * @param {import('./state.js').Store} store
   * @param {import('./engine_client.js').Engine} engine
   * @param {import('./shelf.js').Shelf} shelf
   * @param {{read: (answer: any) => void, drawn: (result: any) => void, failed: (error: Error) => void, traced: (trace: any, pass?: string) => void}} view
   */
  constructor(store, engine, shelf, view) {
    Object.assign(this, { store, engine, shelf, view });
    /** The effect's text while it is edited, so that faults have its lines. @type {() => string|null} */
    this.effectText = () => null;
    /** The pixel whose trace is shown. @type {{x: number, y: number}|null} */
    this.pixel = null;
    /** Whether drawings are hashed: the tests ask for it, and it takes longer than many a drawing. */
    this.hash = Boolean(globalThis.ninebitHashes);
  }

  /** The request that draws a state. @param {import('./state.js').State} state */
  static request({ effect, files, profile }) {
    return { do: 'draw', effect, files, profile, hash: false };
  }

  async read() {
    const { state } = this.store;
    const text = programOf(state);
    if (text === undefined) {
      this.view.read({ form: '', faults: [], notes: [], explanation: 'This pass has no program: the primary colour is drawn.', constants: {} });
      return;
    }
    try {
      const { answer } = await this.engine.ask({ do: 'read', text, profile: state.profile }, { key: 'read' });
      this.view.read(answer);
    } catch (error) {
      if (!(error instanceof Replaced)) this.view.read({ form: '', faults: [{ line: error.line, column: error.column, message: error.message }], notes: [], explanation: '', constants: {} });
    }
  }

  async draw() {
    try {
      await this.shelf.loadFor(this.store.state.effect);
      const { effect, ...rest } = Live.request(this.store.state);
      const result = await this.engine.ask({ ...rest, effect: this.effectText() ?? effect, hash: this.hash }, { key: 'draw' });
      this.view.drawn(result);
    } catch (error) {
      if (!(error instanceof Replaced)) this.view.failed(error);
    }
  }

  /**
   * Traces a pixel. The drawing comes first, as the engine traces the last one, whoever asked for it.
   * @param {string} [pass] without it the last pass with a program
   */
  async trace(pass) {
    if (!this.pixel) return;
    try {
      this.engine.ask(Live.request(this.store.state)).catch(() => {});
      const { answer } = await this.engine.ask({ do: 'pixel', ...this.pixel, ...(pass && { pass }) });
      this.view.traced(answer, pass);
    } catch (error) {
      this.view.traced({ error });
    }
  }

  /** @param {any[]} profiles */
  async compare(profiles) {
    const { effect, files } = this.store.state;
    await this.shelf.loadFor(effect);
    return this.engine.ask({ do: 'compare', effect, files, profiles }, { key: 'compare' });
  }

  /** @param {string} to */
  convert(to) {
    const text = programOf(this.store.state);
    if (text === undefined) return Promise.reject(new Error('This pass has no program.'));
    return this.engine.ask({ do: 'convert', text, profile: this.store.state.profile, to }, { key: 'convert' });
  }

  /** The name of the pass as one reads it. */
  passTitle() {
    const pass = passOf(this.store.state);
    return pass.name ?? `pass ${this.store.state.pass}`;
  }
}
