/** Addresses: they give the state back, and bad ones get a message. */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { hashOf, launch, openPage, stateOf, type } from './support.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const message = (page) => page.$eval('#message', (element) => (element.hidden ? '' : element.textContent));

test('an address gives the whole state back', async () => {
  const first = await openPage(browser);
  await type(first, '!!RC1.0\n# Grün, "quoted", <b>bold</b>\nout.rgb = tex0;\nout.a = unsigned_invert(zero);\n');
  await first.waitForFunction(() => Object.values(globalThis.ninebit.store.state.files).some((text) => text.includes('Grün')));
  // The page writes it after a pause.
  await first.evaluate(() => globalThis.ninebit.page.writeAddress());
  await first.waitForFunction(() => document.getElementById('faults').children.length === 0 && document.getElementById('picture').dataset.hash);
  const hash = await first.evaluate(() => location.hash);
  assert.match(hash, /^#1\.[\w-]+$/);
  assert.ok(hash.length < 2000, `${hash.length} characters`);
  const second = await openPage(browser, { hash });
  assert.deepEqual(await stateOf(second), await stateOf(first));
  assert.equal(await hashOf(second), await hashOf(first));
  assert.deepEqual([...first.complaints, ...second.complaints], []);
});

test('bad addresses get a message and the first effect', async () => {
  const cases = [['#2.abc', /version 2; this page reads versions up to 1/], ['#1.abc', /damaged/], ['#nonsense', /not one that this page has written/],
    ['#1.', /damaged/], [`#1.${'A'.repeat(5000)}`, /damaged/]];
  for (const [hash, expected] of cases) {
    const page = await openPage(browser, { hash });
    assert.match(await message(page), expected, hash.slice(0, 20));
    assert.notEqual(await hashOf(page), '');
    assert.deepEqual(page.complaints, []);
    await page.close();
  }
});

test('markup in titles, names and texts is shown and not run', async () => {
  const page = await openPage(browser);
  const evil = '<img src=x onerror=alert(1)><script>alert(2)</script>';
  await page.evaluate((name) => {
    const { store } = globalThis.ninebit;
    const state = structuredClone(store.state);
    state.effect.title = name;
    state.effect.passes[0].name = name;
    state.files = { [`${name}.rc1`]: `!!RC1.0\n${name}\n` };
    state.effect.passes[0].program = `${name}.rc1`;
    store.replace(state);
  }, evil);
  await page.waitForFunction(() => document.getElementById('faults').children.length > 0);
  for (const tab of ['inputs', 'trace', 'explain', 'profiles', 'gpu', 'convert', 'command']) await page.click(`#tab-${tab}`);
  await page.waitForFunction((name) => document.getElementById('panel-command').textContent.includes(name), {}, evil);
  // CodeMirror has pictures of its own, without a source.
  assert.equal(await page.$$eval('img[src]', (images) => images.length), 0);
  assert.ok((await page.$eval('#file-choice', (element) => element.textContent)).includes(evil));
  assert.deepEqual(page.complaints, []);
});
