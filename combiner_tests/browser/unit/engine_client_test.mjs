/** The engine's client, with a worker that the test answers for. */
import assert from 'node:assert/strict';
import { afterEach, beforeEach, test } from 'node:test';
import { Engine, Fault, Replaced, Stopped } from '../../../src/playground/web/engine_client.js';
import { Flip } from '../../../src/playground/web/flip.js';
import { Live } from '../../../src/playground/web/live.js';

let workers;
let kept;
/** @type {Engine[]} */
const engines = [];

beforeEach(() => {
  workers = [];
  kept = globalThis.Worker;
  globalThis.Worker = class {
    constructor() {
      this.sent = [];
      workers.push(this);
    }

    postMessage(message) { this.sent.push(message); }

    terminate() { this.ended = true; }

    /** Answers the last message. */
    answer(data) { this.onmessage({ data: { id: this.sent.at(-1).id, ...data } }); }
  };
});
afterEach(() => {
  globalThis.Worker = kept;
  // Their time limits would keep Node waiting.
  for (const { timer } of engines.splice(0)) clearTimeout(timer);
});

function engine() {
  const heard = { busy: [], broken: [] };
  const made = new Engine({ scripts: ['a'], wasm: { packed: 'x', size: 8 } }, (busy) => heard.busy.push(busy), (reason) => heard.broken.push(reason));
  engines.push(made);
  workers[0].answer({ answer: {} });
  return { made, heard, worker: workers[0] };
}

test('the first message starts the engine, with its WebAssembly', () => {
  const { worker } = engine();
  assert.equal(worker.sent[0].start, true);
  assert.equal(worker.sent[0].wasm.size, 8);
});

test('requests run one after the other', async () => {
  const { made, worker } = engine();
  const first = made.ask({ do: 'a' }), second = made.ask({ do: 'b' });
  assert.deepEqual(worker.sent.slice(1).map(({ request }) => request.do), ['a']);
  worker.answer({ answer: { n: 1 } });
  assert.equal((await first).answer.n, 1);
  assert.deepEqual(worker.sent.slice(1).map(({ request }) => request.do), ['a', 'b']);
  worker.answer({ answer: { n: 2 } });
  assert.equal((await second).answer.n, 2);
});

test('a newer request of a key takes the place of one that waits', async () => {
  const { made, worker } = engine();
  const running = made.ask({ do: 'a' }, { key: 'k' }), old = made.ask({ do: 'b' }, { key: 'k' }), other = made.ask({ do: 'c' }), newer = made.ask({ do: 'd' }, { key: 'k' });
  await assert.rejects(old, Replaced);
  for (let n = 0; n < 3; n++) worker.answer({ answer: {} });
  await Promise.all([running, other, newer]);
  assert.deepEqual(worker.sent.slice(1).map(({ request }) => request.do), ['a', 'd', 'c']);
});

test('the comparison of Flip and that of the panel do not replace each other', async (context) => {
  const { made, worker } = engine();
  const store = { state: { effect: {}, files: {}, choices: {}, profile: 'nv2a', other: 'geforce2', pass: 0 } };
  const shelf = { async loadFor() {} }, shown = [];
  const live = new Live(store, made, shelf, {});
  const badge = {}, picture = { badge, show: (...planes) => shown.push(planes) };
  context.after(() => delete globalThis.document);
  globalThis.document = { createElement: () => ({ setAttribute() {}, addEventListener() {}, append() {} }) };
  const flip = new Flip(store, live, picture, () => {});
  flip.on = true;
  const trace = made.ask({ do: 'pixel' }), other = flip.update(), panel = live.compare(['nv2a', 'geforce2']);
  await shelf.loadFor();
  worker.answer({ answer: {} });
  await trace;
  for (let n = 0; n < 2; n++) worker.answer({ answer: { width: 1, height: 1, difference: { pixels: 1, max: 2 } }, bytes: new Uint8Array([1, 1, 1, 1, 9, 9, 9, 9, 0, 0, 0, 0]) });
  await Promise.all([other, panel]);
  assert.deepEqual(shown.map(([bytes]) => [...bytes]), [[9, 9, 9, 9]]);
  assert.equal(badge.textContent, 'geforce2: 1 pixels differ, by 2 at most');
});

test('a newer request about the drawing before it waits behind that drawing', async () => {
  const { made, worker } = engine();
  const live = new Live({ state: { effect: {}, files: {}, choices: {}, profile: 'nv2a', pass: 0 } }, made, {}, {});
  const running = made.ask({ do: 'a' }), old = live.losses(), trace = made.ask({ do: 'pixel' });
  live.store.state = { effect: {}, files: {}, choices: {}, profile: 'geforce2', pass: 0 };
  const newer = live.losses();
  await assert.rejects(old, Replaced);
  for (let n = 0; n < 4; n++) worker.answer({ answer: {} });
  await Promise.all([running, trace, newer]);
  assert.deepEqual(worker.sent.slice(1).map(({ request }) => request.do), ['a', 'pixel', 'draw', 'losses']);
  assert.equal(worker.sent.at(-2).request.profile, 'geforce2');
});

test('a refusal is a fault with its place', async () => {
  const { made, worker } = engine();
  const asked = made.ask({ do: 'a' });
  worker.answer({ answer: { fault: { message: 'no', file: 'effect', line: 3, column: 4 } } });
  await assert.rejects(asked, (error) => error instanceof Fault && error.message === 'no' && error.line === 3 && error.others.length === 0);
});

test('after a crash a new worker gets what was put, and what waited runs', async () => {
  const { made, heard, worker } = engine();
  const put = made.put({ name: 'a.png', kind: 'file' }, new Uint8Array(4));
  worker.answer({ answer: { ok: true } });
  await put;
  const broken = made.ask({ do: 'a' }), waiting = made.ask({ do: 'b' });
  worker.answer({ crash: 'out of memory' });
  await assert.rejects(broken, Stopped);
  assert.deepEqual(heard.broken, ['the engine crashed: out of memory']);
  assert.equal(worker.ended, true);
  const [, second] = workers;
  second.answer({ answer: {} });
  assert.deepEqual(second.sent.at(-1).request, { do: 'put', name: 'a.png', kind: 'file' });
  second.answer({ answer: { ok: true } });
  assert.equal(second.sent.at(-1).request.do, 'b');
  second.answer({ answer: { n: 3 } });
  assert.equal((await waiting).answer.n, 3);
});

test('a file that breaks the engine is not put again', async () => {
  const { made, worker } = engine();
  const put = made.put({ name: 'a.glb', kind: 'file' }, new Uint8Array(4));
  worker.answer({ crash: 'unreachable' });
  await assert.rejects(put, Stopped);
  assert.equal(made.kept.size, 0);
});

test('an engine that cannot start says so to everyone', async () => {
  const made = new Engine({ scripts: [], wasm: { packed: '', size: 0 } }, () => {}, () => {});
  const asked = made.ask({ do: 'a' });
  workers[0].answer({ crash: 'no WebAssembly' });
  await assert.rejects(asked, /no WebAssembly/);
  await assert.rejects(made.ask({ do: 'b' }), /no WebAssembly/);
});

test('busy ends once nothing waits', async () => {
  const { made, heard, worker } = engine();
  heard.busy.length = 0;
  const asked = made.ask({ do: 'a' });
  worker.answer({ answer: {} });
  await asked;
  assert.deepEqual(heard.busy, [true, false]);
});
