/** Pictures are decoded to the bit without WebGL, and what is not exact says so. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { pngOf } from './png_files.mjs';
import { dropOn, expectedHashes, faults, hashOf, nativeHash, onePage, openEffect, stateOf, waitForHash } from './support.mjs';

const page = await onePage({ webgl: false });

test('this browser has no WebGL, and draws the golden pictures', async () => {
  assert.equal(await page.evaluate(() => new OffscreenCanvas(1, 1).getContext('webgl2')), null);
  for (const name of ['dot3_specular', 'sprites', 'emboss']) {
    await openEffect(page, name);
    assert.equal(await hashOf(page), expectedHashes()[name], name);
  }
});

const sides = { width: 32, height: 16 };
const some = (x, y, c) => (x * 2477 + y * 7919 + c * 104729) >>> 0;
const palette = [...Array(48).keys()].map((at) => at * 5);
const files = {
  'RGBA of 8 bits': pngOf(sides, some),
  'RGBA of 8 bits, interlaced': pngOf({ ...sides, interlaced: true }, some),
  'RGBA of 16 bits': pngOf({ ...sides, depth: 16 }, some),
  'RGB of 16 bits with one transparent colour': pngOf({ ...sides, depth: 16, type: 2, transparent: [0, 8, 0, 9, 0, 10] }, (x, y, c) => ((x + y) % 3 ? some(x, y, c) : 8 + c)),
  'RGB with one transparent colour, interlaced': pngOf({ ...sides, type: 2, interlaced: true, transparent: [0, 8, 0, 9, 0, 10] }, (x, y, c) => ((x + y) % 3 ? some(x, y, c) : 8 + c)),
  'grey of 1 bit': pngOf({ ...sides, depth: 1, type: 0 }, some),
  'grey of 2 bits, interlaced': pngOf({ ...sides, depth: 2, type: 0, interlaced: true }, some),
  'grey of 4 bits with a transparent one': pngOf({ ...sides, depth: 4, type: 0, transparent: [0, 7] }, some),
  'grey of 16 bits': pngOf({ ...sides, depth: 16, type: 0 }, some),
  'grey with alpha': pngOf({ ...sides, type: 4 }, some),
  'palette of 4 bits with alpha': pngOf({ ...sides, depth: 4, type: 3, palette, transparent: [0, 100, 200] }, some),
  'palette of 2 bits, interlaced': pngOf({ ...sides, depth: 2, type: 3, palette, interlaced: true }, some),
};

for (const [kind, content] of Object.entries(files)) {
  test(`a PNG is decoded as the native program does: ${kind}`, async () => {
    await openEffect(page, 'sepia');
    await page.evaluate(() => globalThis.ninebit.store.change('text', (state) => {
      state.files['programs/sepia.rc1'] = '!!RC1.0\nout.rgb = tex0;\nout.a = tex0.a;\n';
      state.effect.size = [64, 64];
    }));
    await dropOn(page, [`${kind}.png`, content]);
    const name = `dropped/${kind.replaceAll(',', '_')}.png`;
    await page.waitForFunction((source) => Object.values(globalThis.ninebit.store.state.effect.textures).some((texture) => texture.source === source), {}, name);
    await waitForHash(page, nativeHash(await stateOf(page), { [name]: content }));
    assert.doesNotMatch(await faults(page), /may differ/);
  });
}

test('a picture that the browser decodes says that it is not exact', async () => {
  const jpeg = await page.evaluate(async () => {
    const canvas = new OffscreenCanvas(16, 16);
    canvas.getContext('2d').fillRect(0, 0, 8, 8);
    return [...new Uint8Array(await (await canvas.convertToBlob({ type: 'image/jpeg' })).arrayBuffer())];
  });
  await dropOn(page, ['photo.jpg', jpeg]);
  await page.waitForFunction(() => /photo\.jpg: the browser decoded it.*may differ from what ninebit draws/.test(document.getElementById('faults').textContent));
  await openEffect(page, 'dot3_specular');
  await page.waitForFunction(() => !document.getElementById('faults').textContent.includes('may differ'));
});

test('nothing complained', () => assert.deepEqual(page.complaints, []));
