/** The emitted GLSL ES in WebGL 2 gives the emulator's pixels, pass by pass. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { onePage, openEffect } from './support.mjs';

const page = await onePage();

/** The number of pixels that differ, and of those that a pass draws, after a new run. */
async function difference(pass) {
  await page.evaluate((number) => {
    const { store, page: shown } = globalThis.ninebit;
    if (number !== null) store.state.pass = number;
    shown.gpu.result.textContent = '';
    delete shown.gpu.result.dataset.count;
    shown.gpu.update();
  }, pass ?? null);
  // A change of the state asks as well: the last answer is shown.
  await page.waitForFunction(() => document.getElementById('gpu-result').textContent !== '', { timeout: 30_000 });
  return page.$eval('#gpu-result', ({ dataset: { count, drawn }, textContent }) =>
    (count === undefined ? { failed: textContent } : { count: Number(count), drawn: Number(drawn) }));
}

test('no pixel differs, whatever the effect and its pass', async () => {
  await page.click('#tab-gpu');
  const names = await page.$$eval('[data-effect]', (cards) => cards.map((card) => card.dataset.effect));
  let passes = 0;
  for (const name of names) {
    await openEffect(page, name);
    const programs = await page.evaluate(() => globalThis.ninebit.store.state.effect.passes.map(({ program }) => Boolean(program)));
    for (const [pass, has] of programs.entries()) {
      if (!has) continue;
      const { failed, count, drawn } = await difference(pass);
      assert.equal(failed ?? count, 0, `${name}, pass ${pass}`);
      assert.ok(drawn > 1000, `${name}, pass ${pass}: ${drawn} pixels`);
      passes++;
    }
  }
  assert.ok(passes > names.length, `${passes} passes`);
});

test('no pixel differs under other profiles and with other constants', async () => {
  for (const name of ['hemisphere', 'sepia']) {
    await openEffect(page, name);
    for (const profile of ['geforce2', 'nv2a', 'geforce256-8bit', { base: 'nv2a', name: 'mine', final_narrowing: 'toward-zero' }]) {
      await page.evaluate((chosen) => globalThis.ninebit.store.change('profile', (state) => {
        state.profile = chosen;
        state.effect.passes[0].constants = { const0: [0.1, 0.9, 0.4, 1] };
      }), profile);
      const found = await difference();
      assert.equal(found.failed ?? found.count, 0, `${name}: ${JSON.stringify(profile)}`);
    }
  }
});

test('another result is noticed', async () => {
  const found = await page.evaluate(async () => {
    const { gpu, engine } = globalThis.ninebit.page;
    const ask = engine.ask;
    engine.ask = async function changed(request, ...rest) {
      const found = await ask.call(this, request, ...rest);
      if (request.do === 'combiners') found.answer.glsl = found.answer.glsl.replace('/ 255', '/ 254');
      return found;
    };
    // An update that the change before has asked for replaces this one.
    for (let attempt = 0; attempt < 20 && !(Number(gpu.result.dataset.count) > 0); attempt++) {
      delete gpu.result.dataset.count;
      await gpu.update();
    }
    engine.ask = ask;
    return Number(gpu.result.dataset.count);
  });
  assert.ok(found > 0);
});

test('a pass without a program says so', async () => {
  await openEffect(page, 'index_cube');
  assert.match((await difference(0)).failed, /no program/);
});

test('nothing complained', () => assert.deepEqual(page.complaints, []));
