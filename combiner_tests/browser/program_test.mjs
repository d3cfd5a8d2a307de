/** What is typed, drawn and traced is what the native program draws and traces. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { clickPixel, expectedHashes, faults, hashOf, nativeFaults, nativeHash, nativeTrace, onePage, openEffect, stateOf, type, waitForHash } from './support.mjs';

const page = await onePage();

const brighter = `!!RC1.0
const0 = (0.2, 0.7, 0.1, 1.0);
{
  rgb {
    spare0 = tex0 * const0;
    scale_by_two();
  }
}
out.rgb = spare0;
out.a = unsigned_invert(zero);
`;

test('typing a program changes the picture to the native one', async () => {
  const old = await hashOf(page);
  await type(page, brighter);
  await page.waitForFunction((text) => globalThis.ninebit.store.state.files['programs/sepia.rc1'] === text, {}, brighter);
  const hash = nativeHash(await stateOf(page));
  assert.notEqual(hash, old);
  await waitForHash(page, hash);
});

test('an error is underlined at its column, and the last picture stays', async () => {
  const broken = brighter.replace('tex0 * const0', 'tex0 * bogus');
  await type(page, broken);
  await page.waitForSelector('.cm-lintRange-error');
  const place = await page.evaluate(() => {
    const { view } = globalThis.ninebit.page.program.editor;
    const mark = document.querySelector('.cm-lintRange-error');
    const at = view.posAtDOM(mark, 0);
    const line = view.state.doc.lineAt(at);
    return { text: mark.textContent, line: line.number, column: at - line.from + 1 };
  });
  assert.deepEqual(place, { text: 'bogus', line: 5, column: 21 });
  assert.match(nativeFaults(broken, 'geforce2'), /program\.txt:5:21: /);
  assert.match(await faults(page), /^5:21 /);
  assert.equal(await page.$eval('#picture canvas', (canvas) => canvas.width), 256);
});

test('a click gives the trace of `ninebit trace --json`', async () => {
  await type(page, brighter);
  await page.waitForFunction(() => document.getElementById('faults').children.length === 0 && document.getElementById('picture').dataset.hash);
  await clickPixel(page, 20, 30);
  await page.waitForFunction(() => globalThis.ninebit.page.trace.trace);
  const trace = await page.evaluate(() => globalThis.ninebit.page.trace.trace);
  const expected = nativeTrace(await stateOf(page), 20, 30);
  trace.effect.file = expected.effect.file;
  assert.deepEqual(trace, expected);
  assert.notEqual(await page.$eval('#trace', (element) => element.textContent), '');
});

test('the keyboard moves the mark and traces', async () => {
  await page.focus('.picture-scroll');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => document.getElementById('trace-place').textContent.startsWith('Pixel (21, 30)'));
});

test('a pixel that several passes drew shows the trace of each', async () => {
  await openEffect(page, 'index_cube');
  await clickPixel(page, 300, 240);
  await page.waitForFunction(() => globalThis.ninebit.page.trace.trace?.effect.pass === 'shadow');
  await page.select('#trace-place select', 'comparison');
  await page.waitForFunction(() => globalThis.ninebit.page.trace.trace?.effect.pass === 'comparison');
  assert.equal(await page.$eval('#trace-place select', ({ value }) => value), 'comparison');
  await page.select('#trace-place select', 'lit');
  await page.waitForFunction(() => globalThis.ninebit.page.trace.trace && !globalThis.ninebit.page.trace.trace.stages);
});

test('every effect of the gallery has its golden hash, and the comparison that is chosen at first works for it', async () => {
  await page.click('#tab-profiles');
  const names = await page.$$eval('[data-effect]', (cards) => cards.map((card) => card.dataset.effect));
  assert.ok(names.length >= 15, `${names.length} effects`);
  for (const name of names) {
    await page.evaluate(() => { document.getElementById('difference-count').textContent = ''; });
    await openEffect(page, name);
    assert.equal(await hashOf(page), expectedHashes()[name], name);
    await page.waitForFunction(() => document.getElementById('difference-count').textContent);
    assert.match(await page.$eval('#difference-count', ({ textContent }) => textContent), /^[\d,]+ of [\d,]+ pixels differ/, name);
  }
  await page.click('#tab-inputs');
});

test('a constant, a mesh, a colour and a field of the profile change the picture as they do natively', async () => {
  await openEffect(page, 'sepia');
  await page.evaluate(() => {
    const { store, passOf } = globalThis.ninebit;
    store.change('inputs', (state) => {
      passOf(state).constants = { const1: [0.5, 1, 0.25, 1] };
      state.effect.scene = { mesh: 'sphere:48' };
    });
    store.change('profile', (state) => { state.profile = { base: 'nv2a', name: 'mine', general_narrowing: 'nearest-halves-up' }; });
  });
  await waitForHash(page, nativeHash(await stateOf(page)));
});

test('nothing complained', () => assert.deepEqual(page.complaints, []));
