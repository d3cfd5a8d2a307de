/** Links: what is written is what is read, and everything else is an error in words. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { addressOf, opened } from '../../../src/playground/web/permalink.js';
import { newState } from '../../../src/playground/web/state.js';

const plain = (value) => JSON.parse(JSON.stringify(value));

test('a state comes back from its address', async () => {
  const state = newState();
  const address = await addressOf(state);
  assert.match(address, /^#1\.[A-Za-z0-9_-]+$/);
  assert.ok(address.length < 600, `${address.length} characters`);
  assert.deepEqual(plain((await opened(address)).state), plain(state));
});

test('what is looked at comes back, and a link without it has none', async () => {
  const view = { pixel: [3, 4], tab: 'sweep', shadow: { step: 3 } };
  assert.deepEqual(plain((await opened(await addressOf(newState(), view))).view), view);
  assert.deepEqual(plain((await opened(await addressOf(newState()))).view), {});
  assert.equal(await addressOf(newState(), {}), await addressOf(newState()));
});

test('there is no state where there is no link', async () => {
  assert.equal(await opened(''), null);
  assert.equal(await opened('#'), null);
});

test('other addresses are errors in words', async () => {
  const good = await addressOf(newState());
  for (const [address, expected] of [['#x', /not one that this page has written/], ['#2.AAAA', /of version 2; this page reads versions up to 1/],
    ['#0.AAAA', /damaged or too long/], [good.slice(0, -20), /part of it is missing or changed/], ['#1.', /part of it is missing/],
    [`#1.${'A'.repeat(1_000_001)}`, /damaged or too long/]]) {
    await assert.rejects(opened(address), expected, address.slice(0, 40));
  }
});

test('a small address that unpacks to too much is refused', async () => {
  const bomb = { ...newState(), files: { 'a.rc1': ' '.repeat(5_000_000) } };
  await assert.rejects(opened(await addressOf(bomb)), /part of it is missing or changed/);
});

test('names such as __proto__ are names', async () => {
  const state = newState();
  state.files.__proto__ = 'text';
  const { state: found } = await opened(await addressOf(state));
  assert.equal(Object.getPrototypeOf(found.files), null);
});
