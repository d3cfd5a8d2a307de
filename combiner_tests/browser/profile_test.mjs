/** A profile of one's own: one move of a control gives a valid profile, and the native picture. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { hashOf, nativeHash, onePage, openEffect, stateOf, waitForHash } from './support.mjs';

const page = await onePage();

/** The control of a field. */
const control = (name) => page.evaluateHandle((field) => [...document.querySelectorAll('#panel-profiles .fields label')]
  .find((label) => label.querySelector('span').textContent === field).querySelector('input, select'), name);

const saidOf = () => page.$eval('#coupled-fields', ({ textContent }) => textContent);

test('byte_shift takes the codes along that depend on it', async () => {
  await openEffect(page, 'sepia');
  await page.evaluate(() => globalThis.ninebit.store.change('profile', (state) => { state.profile = 'nv2a'; }));
  await page.click('#tab-profiles');
  await page.waitForFunction(() => document.querySelectorAll('#panel-profiles .fields label').length > 20);
  // Fields that are shown anew between focus and key would lose the key: all answers of before are there after this one.
  await page.evaluate(() => globalThis.ninebit.engine.ask({ do: 'about' }));
  const before = await hashOf(page);
  await (await control('byte_shift')).press('ArrowRight');
  await page.waitForFunction(() => document.getElementById('coupled-fields').textContent !== '');
  assert.equal(await saidOf(), 'With byte_shift 1 also changed: one 127, lowest -128, lowest_output -127, half 64, expand_offset 127.');
  const state = await stateOf(page);
  assert.equal(state.profile.one, 127);
  const hash = nativeHash(state);
  assert.notEqual(hash, before);
  await waitForHash(page, hash);
  assert.equal(await page.$eval('#faults', (list) => list.children.length), 0);
});

test('a range follows, and the way back ends at the shipped profile', async () => {
  await page.waitForFunction(() => [...document.querySelectorAll('#panel-profiles .fields label')]
    .some((label) => label.querySelector('span').textContent === 'half' && label.querySelector('input').max === '127'));
  await (await control('byte_shift')).press('ArrowLeft');
  await page.waitForFunction(() => globalThis.ninebit.store.state.profile === 'nv2a');
});

test('another arithmetic drops the fields that it does not read', async () => {
  await page.waitForFunction(() => document.querySelector('[data-field="half"] input').max === '255');
  await (await control('half')).press('ArrowLeft');
  await page.waitForFunction(() => globalThis.ninebit.store.state.profile.half === 127);
  await page.evaluate(() => { delete document.getElementById('picture').dataset.hash; });
  await (await control('arithmetic')).select('float32');
  await page.waitForFunction(() => globalThis.ninebit.store.state.profile.arithmetic === 'float32');
  assert.deepEqual((await stateOf(page)).profile, { base: 'nv2a', name: 'mine', arithmetic: 'float32' });
  await waitForHash(page, nativeHash(await stateOf(page)));
  assert.match(await saidOf(), /half 128/);
});

test('nothing complained', () => assert.deepEqual(page.complaints, []));
