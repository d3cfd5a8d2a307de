/** The page draws while controls move, hashes only for the tests, and the keyboard's focus stays. */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { hashOf, launch, nativeHash, openEffect, openPage, stateOf, waitForHash } from './support.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

/** Moves a slider by so many input events, as a hand does; the number of pictures that were shown before it was let go. */
function drag(page, selector, values) {
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

test('a constant is drawn while its slider moves, and the last picture is of its last value', async (context) => {
  const page = await openPage(browser);
  const shown = await drag(page, 'input[aria-label="const0, alpha"]', values);
  context.diagnostic(`${shown} pictures of 60 positions`);
  // A busy machine draws fewer; with a pause after each position there was none.
  assert.ok(shown >= 6, `${shown} pictures`);
  await waitForHash(page, nativeHash(await stateOf(page)));
  await page.close();
});

test('a camera is drawn while it moves', async (context) => {
  const page = await openPage(browser);
  await openEffect(page, 'fresnel');
  await page.waitForSelector('#panel-inputs .camera input');
  const shown = await drag(page, '#panel-inputs .camera input', values);
  context.diagnostic(`${shown} pictures of 60 positions`);
  assert.ok(shown >= 6, `${shown} pictures`);
  await waitForHash(page, nativeHash(await stateOf(page)));
  await page.close();
});

test("a profile's field is drawn while its slider moves, and the slider stays", async (context) => {
  const page = await openPage(browser);
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
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test('drawings have no hash unless a test asks', async () => {
  const page = await openPage(browser, { hashes: false });
  assert.equal(await hashOf(page), '');
  await openEffect(page, 'emboss');
  assert.equal(await hashOf(page), '');
  await page.evaluate(() => {
    globalThis.ninebit.page.live.hash = true;
    return globalThis.ninebit.page.draw();
  });
  assert.match(await hashOf(page), /^[0-9a-f]{64}$/);
  await page.close();
});

/** What has the keyboard's focus, and whether that is the element of the selector now. */
const focused = (page, selector) => page.evaluate((where) => ({
  label: document.activeElement.closest('label')?.querySelector('span')?.textContent ?? document.activeElement.getAttribute('aria-label') ?? document.activeElement.id,
  same: document.activeElement === document.querySelector(where) }), selector);

test("the keyboard's focus stays on the control that was changed", async () => {
  const page = await openPage(browser);
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
    await page.evaluate(() => new Promise((resolve) => { setTimeout(resolve, 400); }));
    assert.deepEqual(await focused(page, '#file-choice select'), { label: 'Pass', same: true }, pass);
  }
  await page.close();
});

test("the keyboard's focus stays in the settings of index shadows, where sliders come and go", async () => {
  const page = await openPage(browser);
  await page.click('#tab-shadow');
  const controls = '#panel-shadow > .shadow-controls';
  await page.waitForFunction(() => document.querySelectorAll('#panel-shadow > .shadow-controls input').length === 4);
  for (const [selector, value] of [[`${controls} select`, 'sphere:48'], [`${controls} label:nth-of-type(4) select`, '128'], [`${controls} select`, 'room']]) {
    await page.focus(selector);
    const { label } = await focused(page, selector);
    await page.select(selector, value);
    await page.waitForFunction(() => document.querySelectorAll('#panel-shadow > .shadow-controls input').length === 4 && /triangles/.test(document.getElementById('shadow-result').textContent));
    await page.evaluate(() => new Promise((resolve) => { setTimeout(resolve, 600); }));
    assert.deepEqual(await focused(page, selector), { label, same: true }, selector);
  }
  await page.close();
});

test("the keyboard's focus stays on sliders that arrow keys move", async () => {
  const page = await openPage(browser);
  await openEffect(page, 'fresnel');
  await page.waitForSelector('#panel-inputs .camera input');
  for (const selector of ['input[aria-label="const0, alpha"]', '#panel-inputs .camera label:nth-of-type(2) input', '#panel-inputs .camera .camera label:nth-of-type(3) input']) {
    await page.focus(selector);
    const { label } = await focused(page, selector);
    const old = await page.$eval(selector, ({ value }) => value);
    for (let n = 0; n < 4; n++) {
      await page.keyboard.press('ArrowLeft');
      await page.evaluate(() => new Promise((resolve) => { setTimeout(resolve, 250); }));
      assert.deepEqual(await focused(page, selector), { label, same: true }, `${selector}, ${n}`);
    }
    assert.notEqual(await page.$eval(selector, ({ value }) => value), old, selector);
  }
  await page.close();
});
