/** The page draws while controls move, hashes only for the tests, and the keyboard's focus stays. */
import assert from 'node:assert/strict';
import { setTimeout as pause } from 'node:timers/promises';
import { hashOf, nativeHash, openEffect, pageTest, stateOf, waitForHash } from './support.mjs';

/** Moves a slider by so many input events, as a hand does; the number of pictures that were shown before it was let go. */
async function drag(page, selector, values) {
  await page.waitForSelector(selector);
  return page.evaluate(async (where, all) => {
    const { picture } = globalThis.ninebit.page;
    const show = picture.show.bind(picture);
    let shown = 0;
    picture.show = (...planes) => {
      shown++;
      show(...planes);
    };
    const slider = document.querySelector(where);
    for (const value of all) {
      slider.value = String(value);
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      await new Promise((resolve) => { setTimeout(resolve, 16); });
    }
    const before = shown;
    slider.dispatchEvent(new Event('change', { bubbles: true }));
    picture.show = show;
    return before;
  }, selector, values);
}

const values = [...Array(60).keys()];

pageTest('a constant is drawn while its slider moves, and the last picture is of its last value', { effect: 'sepia' }, async (page, context) => {
  const shown = await drag(page, 'input[aria-label="const0, alpha"]', values);
  context.diagnostic(`${shown} pictures of 60 positions`);
  // A busy machine draws fewer; with a pause after each position there was none.
  assert.ok(shown >= 6, `${shown} pictures`);
  await waitForHash(page, nativeHash(await stateOf(page)));
});

pageTest('a camera is drawn while it moves', { effect: 'fresnel' }, async (page, context) => {
  await page.waitForSelector('#panel-inputs .camera input');
  const shown = await drag(page, '#panel-inputs .camera input', values);
  context.diagnostic(`${shown} pictures of 60 positions`);
  assert.ok(shown >= 6, `${shown} pictures`);
  await waitForHash(page, nativeHash(await stateOf(page)));
});

pageTest("a profile's field is drawn while its slider moves, and the slider stays", { effect: 'sepia' }, async (page, context) => {
  await page.click('#tab-profiles');
  await page.waitForFunction(() => [...document.querySelectorAll('.fields input[type=range]')].some((input) => !input.disabled && input.max - input.min > 3));
  const [name, lowest, highest] = await page.evaluate(() => {
    const input = [...document.querySelectorAll('.fields input[type=range]')].find(({ disabled, max, min }) => !disabled && max - min > 3);
    return [input.closest('[data-field]').dataset.field, Number(input.min), Number(input.max)];
  });
  const shown = await drag(page, `[data-field="${name}"] input`, values.map((value) => lowest + value % (highest - lowest + 1)));
  context.diagnostic(`${shown} pictures of 60 positions`);
  assert.ok(shown >= 3, `${shown} pictures`);
  await page.waitForFunction(() => typeof globalThis.ninebit.store.state.profile === 'object');
  await waitForHash(page, nativeHash(await stateOf(page)));
});

pageTest('drawings have no hash unless a test asks', { hashes: false }, async (page) => {
  assert.equal(await hashOf(page), '');
  await openEffect(page, 'emboss');
  assert.equal(await hashOf(page), '');
  await page.evaluate(() => {
    globalThis.ninebit.page.live.hash = true;
    return globalThis.ninebit.page.draw();
  });
  assert.match(await hashOf(page), /^[0-9a-f]{64}$/);
});

/** What has the keyboard's focus, and whether that is the element of the selector now. */
const focused = (page, selector) => page.evaluate((where) => ({
  label: document.activeElement.closest('label')?.querySelector('span')?.textContent ?? document.activeElement.getAttribute('aria-label') ?? document.activeElement.id,
  same: document.activeElement === document.querySelector(where) }), selector);

pageTest("the keyboard's focus stays on the control that was changed", { effect: 'sepia' }, async (page) => {
  const chosen = [['#profile-choice select', 'nv2a'], ['[data-unit="1"] select', 'gradient'], ['#panel-inputs fieldset:not([data-unit]) select', 'sphere:48']];
  for (const [selector, value] of chosen) {
    await page.focus(selector);
    const { label } = await focused(page, selector);
    assert.notEqual(label, '');
    await page.select(selector, value);
    await page.waitForFunction(() => document.getElementById('picture').dataset.hash);
    assert.deepEqual(await focused(page, selector), { label, same: true }, selector);
  }
  await openEffect(page, 'index_cube');
  await page.focus('#file-choice select');
  for (const pass of ['1', '3', '0']) {
    await page.select('#file-choice select', pass);
    await page.waitForFunction((wanted) => globalThis.ninebit.store.state.pass === Number(wanted), {}, pass);
    await pause(400);
    assert.deepEqual(await focused(page, '#file-choice select'), { label: 'Pass', same: true }, pass);
  }
});

pageTest("the keyboard's focus stays in the settings of index shadows, where sliders come and go", { effect: 'sepia' }, async (page) => {
  await page.click('#tab-shadow');
  const controls = '#panel-shadow > .shadow-controls';
  await page.waitForFunction(() => document.querySelectorAll('#panel-shadow > .shadow-controls input').length === 4);
  for (const [selector, value] of [[`${controls} select`, 'sphere:48'], [`${controls} label:nth-of-type(4) select`, '128'], [`${controls} select`, 'room']]) {
    await page.focus(selector);
    const { label } = await focused(page, selector);
    await page.select(selector, value);
    await page.waitForFunction(() => document.querySelectorAll('#panel-shadow > .shadow-controls input').length === 4 && /triangles/.test(document.getElementById('shadow-result').textContent));
    await pause(600);
    assert.deepEqual(await focused(page, selector), { label, same: true }, selector);
  }
});

pageTest("the keyboard's focus stays on sliders that arrow keys move", { effect: 'fresnel' }, async (page) => {
  await page.waitForSelector('#panel-inputs .camera input');
  for (const selector of ['input[aria-label="const0, alpha"]', '#panel-inputs .camera label:nth-of-type(2) input', '#panel-inputs .camera .camera label:nth-of-type(3) input']) {
    await page.focus(selector);
    const { label } = await focused(page, selector);
    const old = await page.$eval(selector, ({ value }) => value);
    for (let n = 0; n < 4; n++) {
      await page.keyboard.press('ArrowLeft');
      await pause(250);
      assert.deepEqual(await focused(page, selector), { label, same: true }, `${selector}, ${n}`);
    }
    assert.notEqual(await page.$eval(selector, ({ value }) => value), old, selector);
  }
});
