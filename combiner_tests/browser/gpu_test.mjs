/** The emitted GLSL ES in WebGL 2 gives the emulator's pixels. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { onePage, openEffect } from './support.mjs';

const page = await onePage();

/** The number of pixels that differ, after a new run. */
async function difference() {
  return page.evaluate(async () => {
    const { gpu } = globalThis.ninebit.page;
    delete gpu.result.dataset.count;
    await gpu.update();
    return gpu.result.dataset.count ?? gpu.result.textContent;
  });
}

test('no pixel differs, whatever the effect', async () => {
  await page.click('#tab-gpu');
  const names = await page.$$eval('[data-effect]', (cards) => cards.map((card) => card.dataset.effect));
  for (const name of names) {
    await openEffect(page, name);
    assert.equal(await difference(), '0', name);
  }
});

test('no pixel differs under other profiles and with other constants', async () => {
  await openEffect(page, 'sepia');
  for (const profile of ['geforce2', 'nv2a', 'geforce256-8bit', { base: 'nv2a', name: 'mine', final_narrowing: 'toward-zero' }]) {
    await page.evaluate((chosen) => globalThis.ninebit.store.change('profile', (state) => {
      state.profile = chosen;
      state.effect.passes[0].constants = { const0: [0.1, 0.9, 0.4, 1] };
    }), profile);
    assert.equal(await difference(), '0', JSON.stringify(profile));
  }
});

test('nothing complained', () => assert.deepEqual(page.complaints, []));
