/**
 * Wrong pixels of index shadows, counted by rays in a worker of its own: the engine that draws does not wait for it.
 */

/** Rows that are judged at once. Between two bands a newer request, or the end of it, is heard. */
const band = 32;

/** For so many milliseconds a judgement that is out of date goes on, so that there are counts while one moves. */
const patience = 1000;

/**
 * @typedef {{false_lit: number, false_shadowed: number, by_cause: Record<string, number>}} Errors
 * @typedef {{width: number, height: number, errors: Errors, causes: string[], pixels: {lit: number, shadowed: number}}} Judgement
 */

export class Judge {
  /**
   * @param {() => import('./engine_client.js').Engine} newEngine called when the first rendering is judged
   * @param {import('./engine_client.js').Engine} drawing the engine that draws, which has the dropped meshes
   * @param {{progress: (share: number) => void, judged: (request: any, judgement: Judgement, plane: Uint8Array) => void,
   *     failed: (error: Error) => void}} view `plane`: the number of a cause for each pixel, plus 128 if it is falsely lit
   */
  constructor(newEngine, drawing, view) {
    this.newEngine = newEngine;
    this.drawing = drawing;
    this.view = view;
    /** The one that judges, once there is something to judge. @type {import('./engine_client.js').Engine|undefined} */
    this.engine = undefined;
    /** The next request. @type {any} */
    this.wanted = null;
    this.on = true;
    this.running = false;
    /** What was put into the engine, by name. @type {Map<string, any>} */
    this.sent = new Map();
  }

  /** Judges what a request for shadows draws, after what is being judged. @param {any} request */
  ask(request) {
    this.on = true;
    this.wanted = request;
    if (!this.running) this.run();
  }

  /** Gives up what is being judged. */
  stop() {
    this.on = false;
    this.wanted = null;
  }

  async run() {
    this.running = true;
    while (this.wanted) {
      const request = this.wanted;
      this.wanted = null;
      try {
        await this.judge(request);
      } catch (error) {
        if (this.on && !this.wanted) this.view.failed(error instanceof Error ? error : new Error(String(error)));
      }
    }
    this.running = false;
  }

  /** The engine, with the mesh of a request. @param {any} request */
  async ready({ scene }) {
    this.engine ??= this.newEngine();
    const entry = this.drawing.kept.get(scene);
    if (entry && this.sent.get(scene) !== entry) {
      await this.engine.put(entry.request, entry.bytes);
      this.sent.set(scene, entry);
    }
    return this.engine;
  }

  /** @param {any} request */
  async judge(request) {
    const engine = await this.ready(request);
    const begin = performance.now();
    let { answer, bytes } = await engine.ask({ ...request, do: 'judge' });
    while (!answer.errors) {
      if (!this.on || (this.wanted && performance.now() - begin > patience)) return;
      this.view.progress(answer.judged / answer.height);
      ({ answer, bytes } = await engine.ask({ do: 'judge_rows', rows: band }));
    }
    if (this.on) this.view.judged(request, answer, bytes);
  }
}
