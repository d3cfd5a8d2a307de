/**
 * The page's side of the engine: requests one after the other, a time limit, and a new worker after a crash.
 */

/** What the engine said is wrong with a request. */
export class Fault extends Error {
  /** @param {{message: string, file?: string, line?: number, column?: number, others?: any[]}} fault */
  constructor(fault) {
    super(fault.message);
    this.file = fault.file;
    this.line = fault.line;
    this.column = fault.column;
    this.others = fault.others ?? [];
  }
}

/** A request that a newer one of the same kind has replaced: nobody waits for it. */
export class Replaced extends Error {}

/** The engine crashed, took too long or was stopped. */
export class Stopped extends Error {}

const limit = 20_000;

export class Engine {
  /**
   * @param {{scripts: string[], wasm: {packed: string, size: number}}} program the engine's and the worker's scripts: together they are the
   *     worker, as WebKit imports nothing into a worker of a page from the disk
   * @param {(busy: boolean) => void} busy hears when work begins and ends
   * @param {(reason: string) => void} broken hears why the engine started anew
   */
  constructor(program, busy, broken) {
    this.program = program;
    this.busy = busy;
    this.broken = broken;
    /** @type {any[]} */
    this.waiting = [];
    /** @type {any} */
    this.running = null;
    this.number = 0;
    /** @type {ReturnType<typeof setTimeout>|undefined} */
    this.timer = undefined;
    /** Why the engine cannot start. @type {string|null} */
    this.dead = null;
    /** What was put in, to be put in again after a crash. @type {Map<string, {request: any, bytes: Uint8Array}>} */
    this.kept = new Map();
    /** @type {Worker|null} */
    this.worker = null;
    this.start();
  }

  start() {
    const address = URL.createObjectURL(new Blob(this.program.scripts, { type: 'text/javascript' }));
    const worker = new Worker(address);
    this.worker = worker;
    URL.revokeObjectURL(address);
    worker.onmessage = ({ data }) => this.finished(data);
    worker.onerror = (event) => {
      event.preventDefault();
      this.restart(`the engine crashed: ${event.message || 'out of memory'}`);
    };
    const first = [{ start: true }, ...this.kept.values()];
    for (const entry of first.reverse()) {
      this.waiting.unshift({ ...entry, resolve() {}, reject() {} });
    }
    this.next();
  }

  /**
   * The engine's answer. `bytes` of the answer is its binary part; `milliseconds` the time in the engine.
   * @param {any} request
   * @param {{key?: string, bytes?: Uint8Array, last?: boolean}} [options] `key`: an older request of the same key is given up,
   *     and this one takes its place; with `last`, it waits behind all others, as it is about the drawing that was asked for before it
   * @returns {Promise<{answer: any, bytes: Uint8Array, milliseconds: number}>}
   */
  ask(request, { key, bytes, last = false } = {}) {
    return new Promise((resolve, reject) => {
      if (this.dead) {
        reject(new Stopped(this.dead));
        return;
      }
      const entry = { request, bytes, key, resolve, reject };
      const old = key ? this.waiting.findIndex((other) => other.key === key) : -1;
      if (old >= 0) this.waiting[old].reject(new Replaced());
      // At its place: at the end, requests that are replaced often would never come.
      if (old >= 0 && !last) this.waiting[old] = entry;
      else {
        if (old >= 0) this.waiting.splice(old, 1);
        this.waiting.push(entry);
      }
      this.next();
    });
  }

  /** Puts a picture or a file into the engine under a name. @param {any} request @param {Uint8Array} bytes */
  put(request, bytes) {
    const entry = { request: { do: 'put', ...request }, bytes };
    this.kept.set(request.name, entry);
    return this.ask(entry.request, { bytes });
  }

  next() {
    if (this.running || this.waiting.length === 0) {
      if (!this.running) this.busy(false);
      return;
    }
    this.running = this.waiting.shift();
    this.running.id = ++this.number;
    const { id, request, bytes, start } = this.running;
    this.timer = setTimeout(() => this.restart(`the engine took longer than ${limit / 1000} s and was stopped`), limit);
    this.busy(true);
    this.worker?.postMessage({ id, request, bytes, start, wasm: start && this.program.wasm });
  }

  /** @param {any} data */
  finished(data) {
    if (!this.running || data.id !== this.running.id) return;
    if (data.crash) {
      this.restart(`the engine crashed: ${data.crash}`);
      return;
    }
    clearTimeout(this.timer);
    const { resolve, reject } = this.running;
    this.running = null;
    if (data.answer.fault) reject(new Fault(data.answer.fault));
    else resolve(data);
    this.next();
  }

  /** Gives up what runs and starts anew; everything that waited still runs. @param {string} reason */
  restart(reason) {
    clearTimeout(this.timer);
    this.worker?.terminate();
    this.broken(reason);
    const broken = this.running;
    this.running = null;
    broken?.reject(new Stopped(reason));
    if (broken?.start) {
      this.dead = reason;
      for (const entry of this.waiting) entry.reject(new Stopped(reason));
      this.waiting = [];
      this.busy(false);
      return;
    }
    if (broken?.request?.do === 'put') this.kept.delete(broken.request.name);
    this.start();
  }
}
