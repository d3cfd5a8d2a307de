/** The page itself: its size, its widths, its keyboard, and what a crash leaves. */
import assert from 'node:assert/strict';
import { readFileSync, statSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { hashOf, launch, openEffect, openPage, pageFile, type, waitForHash } from './support.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

test('one file of at most 5 MB that names no other', () => {
  assert.ok(statSync(pageFile).size <= 5 * 1024 * 1024);
  const head = readFileSync(pageFile, 'utf8').replace(/<script[^]*?<\/script>/g, '');
  assert.doesNotMatch(head, /\b(src|href)="(?!data:)/);
});

test('the first picture', async (context) => {
  const page = await openPage(browser);
  const milliseconds = Number(await page.evaluate(() => document.body.dataset.ready));
  assert.ok(milliseconds > 0);
  // A figure, not a limit: the machine may be busy.
  context.diagnostic(`the first picture was there after ${milliseconds} ms`);
  assert.deepEqual(page.complaints, []);
});

test('textures that are opened for the first time have their thumbnails', async () => {
  const page = await openPage(browser);
  await openEffect(page, 'emboss');
  await page.waitForSelector('#panel-inputs .texture-thumbnail');
  assert.deepEqual(page.complaints, []);
});

test('a phone shows everything without scrolling sideways', async () => {
  const page = await openPage(browser, { width: 390, height: 844 });
  for (const tab of ['inputs', 'explain', 'profiles', 'gpu', 'convert', 'command', 'trace']) {
    await page.evaluate((name) => document.getElementById(`tab-${name}`).click(), tab);
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= 390, `${tab}: ${width} pixels wide`);
  }
  assert.deepEqual(page.complaints, []);
});

test('every control has a name, and Tab leaves the editor', async () => {
  const page = await openPage(browser);
  const nameless = await page.$$eval('button, select, input, [role=tab]', (controls) => controls.filter((control) =>
    !(control.getAttribute('aria-label') || control.textContent.trim() || control.closest('label')?.textContent.trim())).map((control) => control.outerHTML));
  assert.deepEqual(nameless, []);
  await page.focus('.cm-content');
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => Boolean(document.activeElement.closest('.cm-content'))), false);
  await page.focus('#tab-inputs');
  await page.keyboard.press('ArrowRight');
  assert.equal(await page.$eval('#tab-trace', (tab) => tab.getAttribute('aria-selected')), 'true');
});

test('completion and help offer the words of the language', async () => {
  const page = await openPage(browser);
  await page.waitForFunction(() => globalThis.ninebit.page.words > 100);
  await type(page, '!!RC1.0\nout.rgb = unsi');
  await page.keyboard.type('g');
  await page.waitForFunction(() => document.querySelector('.cm-tooltip-autocomplete')?.textContent.includes('unsigned_invert'));
  assert.deepEqual(page.complaints, []);
});

test('a crash of the engine shows a message, keeps the text, and the next edit draws', async () => {
  const page = await openPage(browser);
  const hash = await hashOf(page);
  const text = await page.evaluate(() => globalThis.ninebit.store.state.files['programs/sepia.rc1']);
  await page.evaluate(() => {
    const { engine, page: parts } = globalThis.ninebit;
    parts.live.read();
    engine.worker.dispatchEvent(new ErrorEvent('error', { message: 'memory access out of bounds' }));
  });
  await page.waitForFunction(() => document.getElementById('message').textContent.includes('crashed'));
  assert.equal(await page.evaluate(() => globalThis.ninebit.page.program.editor.view.state.doc.toString()), text);
  await type(page, `${text}# once more\n`);
  await waitForHash(page, hash);
});
