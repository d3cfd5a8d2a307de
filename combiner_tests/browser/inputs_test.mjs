/** Controls for what an effect says, made from its schema, and pictures of generated textures. */
import assert from 'node:assert/strict';
import { hashOf, nativeHash, openTab, pageTest, stateOf, waitForHash } from './support.mjs';

const openGroups = (page) => page.evaluate(() => {
  for (const group of document.querySelectorAll('details.more')) group.open = true;
});

/** Writes a value into a field, or chooses it. */
async function set(page, key, value) {
  const field = `[data-key="${key}"]`;
  await page.waitForSelector(field);
  if (await page.$eval(field, ({ localName }) => localName === 'select')) return void await page.select(field, value);
  await page.$eval(field, (input, text) => {
    input.value = text;
    input.dispatchEvent(new Event('change'));
  }, value);
}

pageTest('pass, tests, fog, scene and picture are edited by controls, with the native picture', { effect: 'sepia' }, async (page) => {
  const before = await stateOf(page);
  await page.select('#panel-inputs fieldset:not([data-unit]) select', 'torus:48');
  await openGroups(page);
  const steps = [
    [['pass.cull', 'front']], [['pass.polygon_mode', 'line'], ['pass.line_width', '2']], [['pass.color_mask', 'rg']],
    [['pass.depth', 'off'], ['pass.blend.source', 'one'], ['pass.blend.destination', 'one']], [['pass.depth.function', 'greater'], ['pass.clear.depth', '0']],
    [['pass.alpha_test.function', 'never']], [['pass.alpha_test.function', ''], ['pass.stencil.function', 'never'], ['pass.stencil.reference', '3']],
    [['pass.stencil.function', ''], ['pass.stencil.reference', ''], ['pass.clear.color', '0.25, 0.5, 0.75, 1']], [['effect.depth_stencil', 'w16']], [['scene.fov', '20']], [['scene.look_at', '0.2, 0, 0']],
    [['effect.size', '64, 32'], ['effect.color_format', 'r5g6b5']], [['texture0.lod_bias', '2'], ['texture0.border_color', '1, 0, 0, 1']],
  ];
  const hashes = new Set([await hashOf(page)]);
  for (const step of steps) {
    for (const [key, value] of step) await set(page, key, value);
    const hash = nativeHash(await stateOf(page));
    await waitForHash(page, hash);
    hashes.add(hash);
  }
  assert.ok(hashes.size > steps.length - 2, `${hashes.size} pictures`);
  const { effect } = await stateOf(page);
  assert.equal('stencil' in effect.passes[0], false, 'an object whose last key goes, goes');
  assert.deepEqual(effect.size, [64, 32]);
  assert.equal(effect.depth_stencil, 'w16');
  for (const key of ['pass.cull', 'pass.polygon_mode', 'pass.line_width', 'pass.color_mask', 'pass.depth', 'pass.blend.source', 'pass.blend.destination', 'pass.clear.depth', 'pass.clear.color',
    'scene.fov', 'scene.look_at', 'effect.color_format', 'effect.depth_stencil', 'texture0.lod_bias', 'texture0.border_color', 'pass.depth.function']) await set(page, key, '');
  await set(page, 'effect.size', '256, 256');
  await page.select('#panel-inputs fieldset:not([data-unit]) select', 'rectangle');
  assert.deepEqual(await stateOf(page), before);
});

pageTest('what the schema refuses stays out, with a sentence; an expression moves', { effect: 'sepia' }, async (page) => {
  const before = await stateOf(page);
  await openGroups(page);
  for (const [key, value, expected] of [['pass.line_width', '99', /line width is 99; expected 0\.125 to 64/], ['pass.line_width', 'x', /line width must be a number/],
    ['pass.clear.color', '1, 2', /clear: color has 2 values; expected 4/], ['effect.size', '0', /size is 0; expected 1 to 16384/], ['pass.polygon_stipple', '12', /must match/]]) {
    await set(page, key, value);
    const { text, invalid } = await page.$eval(`[data-key="${key}"]`, (input) => ({ text: input.closest('div').textContent, invalid: input.getAttribute('aria-invalid') }));
    assert.match(text, expected);
    assert.equal(invalid, 'true');
    assert.deepEqual(await stateOf(page), before);
  }
  await set(page, 'pass.line_width', '');
  assert.equal(await page.$eval('[data-key="pass.line_width"]', (input) => input.getAttribute('aria-invalid')), 'false');
  assert.match(await page.$eval('[data-group="Scene and light"]', ({ textContent }) => textContent), /choose a mesh/);
  await page.select('#panel-inputs fieldset:not([data-unit]) select', 'sphere:48');
  await set(page, 'scene.light', 'min(1, time), 2, sin(time * 2)');
  assert.deepEqual((await stateOf(page)).effect.scene.light, ['min(1, time)', 2, 'sin(time * 2)']);
  await page.waitForFunction(() => !document.querySelector('.clock').hidden);
  // The groups stay open, and show what is typed into the effect.
  await openTab(page, 'effect.json');
  await page.evaluate(() => {
    const { view } = globalThis.ninebit.page.program.editor;
    const effect = JSON.parse(view.state.doc.toString());
    effect.passes[0].cull = 'back';
    view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: JSON.stringify(effect) } });
  });
  await page.waitForFunction(() => document.querySelector('[data-key="pass.cull"]').value === 'back');
  // And the effect's text what is chosen.
  await set(page, 'pass.color_mask', 'g');
  const shown = await page.evaluate(() => JSON.parse(globalThis.ninebit.page.program.editor.view.state.doc.toString()));
  assert.equal(shown.passes[0].color_mask, 'g');
  assert.deepEqual(shown, (await stateOf(page)).effect);
  await waitForHash(page, nativeHash(await stateOf(page)));
});

pageTest('generated textures have pictures, which leave the drawing as it is', { effect: 'sepia' }, async (page) => {
  const thumbnail = () => page.$eval('[data-unit="0"] canvas', (canvas) => [...canvas.getContext('2d').getImageData(0, 0, 64, 64).data]);
  for (const [source, check] of [
    ['checker:256', (at) => { assert.deepEqual(at(2, 2), [255, 255, 255, 255]); assert.deepEqual(at(10, 2), [51, 51, 51, 255]); }],
    ['gradient', (at) => { assert.ok(at(60, 30)[0] > at(4, 30)[0] + 100); }],
    ['normalize-cube:64', (at) => { assert.deepEqual(at(1, 1).slice(0, 3), [0, 0, 0]); assert.ok(at(32, 32)[2] > 200); }],
    ['normals:textures/bricks_height.png', (at) => { assert.ok(at(32, 32)[2] > 100); }]]) {
    await page.select('[data-unit="0"] select', source);
    await page.waitForSelector('[data-unit="0"] canvas');
    const pixels = await thumbnail();
    check((x, y) => pixels.slice(4 * (64 * y + x), 4 * (64 * y + x) + 4));
    const hash = nativeHash(await stateOf(page));
    await waitForHash(page, hash);
    // The engine's last drawing is still that of the page.
    const { answer } = await page.evaluate(() => globalThis.ninebit.engine.ask({ do: 'pixel', x: 200, y: 200 }));
    assert.equal(answer.fault, undefined);
  }
});
