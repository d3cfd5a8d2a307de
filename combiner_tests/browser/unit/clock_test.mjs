/** The clock of effects that move, with a browser that the test turns. */
import assert from 'node:assert/strict';
import { afterEach, beforeEach, test } from 'node:test';
import { setImmediate } from 'node:timers/promises';
import { Clock } from '../../../src/playground/web/clock.js';

const names = ['document', 'requestAnimationFrame', 'performance'];
let kept, now, frames, live, drawings;

/** Lets everything go on that can. */
const settle = () => setImmediate();

beforeEach(() => {
  kept = names.map((name) => Object.getOwnPropertyDescriptor(globalThis, name));
  now = 0;
  frames = [];
  live = { moment: { time: 0, frame: 0 } };
  drawings = [];
  const part = () => ({ addEventListener() {}, setAttribute() {}, append() {} });
  const given = { document: { createElement: part }, requestAnimationFrame: (run) => frames.push(run), performance: { now: () => now } };
  for (const [name, value] of Object.entries(given)) Object.defineProperty(globalThis, name, { value, configurable: true, writable: true });
});
afterEach(() => names.forEach((name, at) => {
  if (kept[at]) Object.defineProperty(globalThis, name, kept[at]);
  else delete globalThis[name];
}));

const clock = () => new Clock(live, { draw: () => new Promise((resolve) => { drawings.push(resolve); }), started() {}, stopped() {} });

test('pausing and playing during a drawing leaves one loop', async () => {
  const made = clock();
  made.play();
  made.pause();
  made.play();
  for (let turn = 0; turn < 3; turn++) {
    now += 10;
    for (const drawn of drawings.splice(0)) drawn();
    await settle();
    for (const run of frames.splice(0)) run();
    await settle();
    assert.equal(drawings.length, 1);
  }
  made.pause();
});

test('back to time 0 while playing counts the frames anew', async () => {
  const made = clock();
  live.moment = { time: 4, frame: 100 };
  made.play();
  now += 20;
  drawings.pop()();
  await settle();
  assert.equal(made.rate, 50);
  made.rewind();
  now += 10;
  frames.pop()();
  await settle();
  drawings.pop()();
  await settle();
  assert.deepEqual(live.moment, { time: 0.01, frame: 1 });
  assert.equal(made.rate, 100);
  made.pause();
});
