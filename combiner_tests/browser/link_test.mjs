/** Addresses: they give the state back, and bad ones get a message. */
import assert from 'node:assert/strict';
import { follow, hashOf, message, openPage, pageTest, stateOf, type, waitForText } from './support.mjs';

pageTest('an address gives the whole state back', async (first) => {
  const text = '!!RC1.0\n# Grün, "quoted", <b>bold</b>\nout.rgb = tex0;\nout.a = unsigned_invert(zero);\n';
  await type(first, text);
  await waitForText(first, text);
  // The page writes it after a pause.
  await first.evaluate(() => globalThis.ninebit.page.writeAddress());
  await first.waitForFunction(() => document.getElementById('faults').children.length === 0 && document.getElementById('picture').dataset.hash);
  const hash = await first.evaluate(() => location.hash);
  assert.match(hash, /^#1\.[\w-]+$/);
  assert.ok(hash.length < 2000, `${hash.length} characters`);
  const second = await openPage(first.browser(), { hash });
  assert.deepEqual(await stateOf(second), await stateOf(first));
  assert.equal(await hashOf(second), await hashOf(first));
  assert.deepEqual(second.complaints, []);
});

// Their sentences: unit/permalink_test.mjs.
pageTest('bad addresses get a message and the first effect, as the page opens and later', { hash: '#1.abc' }, async (page) => {
  const first = await stateOf(page);
  assert.equal(first.effect.title, 'Sepia');
  assert.match(await message(page), /damaged/);
  for (const [hash, expected] of [['#2.abc', 'version 2; this page reads versions up to 1'], ['#1.', 'damaged'],
    ['#nonsense', 'not one that this page has written'], [`#1.${'A'.repeat(5000)}`, 'damaged']]) {
    await follow(page, hash);
    await page.waitForFunction((words) => document.getElementById('message').textContent.includes(words), {}, expected);
    assert.notEqual(await hashOf(page), '');
    assert.deepEqual(await stateOf(page), first);
  }
});

pageTest('markup in titles, names and texts is shown and not run', async (page) => {
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
});
