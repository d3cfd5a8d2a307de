/** The page itself: its size, its widths, its keyboard, and what a crash leaves. */
import assert from 'node:assert/strict';
import { readFileSync, statSync } from 'node:fs';
import { test } from 'node:test';
import { editorText, hashOf, pageFile, pageTest, type, waitForHash } from './support.mjs';

test('one file of at most 2.1 MB that names no other', (context) => {
  const { size } = statSync(pageFile);
  context.diagnostic(`the page has ${size} bytes`);
  assert.ok(size <= 2_100_000, `${size} bytes`);
  const head = readFileSync(pageFile, 'utf8').replace(/<script[^]*?<\/script>/g, '');
  assert.doesNotMatch(head, /\b(src|href)="(?!data:)/);
});

pageTest('the first picture', async (page, context) => {
  const milliseconds = Number(await page.evaluate(() => document.body.dataset.ready));
  assert.ok(milliseconds > 0);
  // A figure, not a limit: the machine may be busy.
  context.diagnostic(`the first picture was there after ${milliseconds} ms`);
});

pageTest('textures that are opened for the first time have their thumbnails', { effect: 'emboss' }, async (page) => {
  await page.waitForSelector('#panel-inputs .texture-thumbnail');
});

pageTest('a phone shows everything without scrolling sideways', { width: 390, height: 844 }, async (page) => {
  for (const tab of ['inputs', 'explain', 'profiles', 'gpu', 'convert', 'command', 'trace']) {
    await page.evaluate((name) => document.getElementById(`tab-${name}`).click(), tab);
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= 390, `${tab}: ${width} pixels wide`);
  }
});

pageTest('every control has a name, and Tab leaves the editor', { effect: 'sepia' }, async (page) => {
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

/** Opens the groups of further inputs. */
const openGroups = (page) => page.evaluate(async () => {
  for (const group of document.querySelectorAll('#panel-inputs details')) group.open = true;
  await new Promise((resolve) => { setTimeout(resolve, 100); });
});

// 3 to 1, as WCAG 2.1 asks of what marks a control (success criterion 1.4.11).
pageTest('the borders of controls stand out in light and dark', { effect: 'sepia' }, async (page) => {
  await openGroups(page);
  for (const scheme of ['light', 'dark']) {
    await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
    const faint = await page.evaluate(() => {
      const codes = (color) => color.match(/[\d.]+/g).map(Number);
      const luminance = (color) => codes(color).slice(0, 3).map((code) => code / 255)
        .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4))
        .reduce((sum, part, at) => sum + part * [0.2126, 0.7152, 0.0722][at], 0);
      const behind = (node) => {
        const color = getComputedStyle(node).backgroundColor;
        return codes(color)[3] === 0 ? behind(node.parentElement) : color;
      };
      const contrast = (a, b) => (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
      return [...document.querySelectorAll('button, select, input:not([type=range], [type=checkbox])')]
        .filter((control) => control.checkVisibility() && parseFloat(getComputedStyle(control).borderTopWidth) > 0)
        .map((control) => ({ name: control.outerHTML.slice(0, 80),
          times: contrast(luminance(getComputedStyle(control).borderTopColor), luminance(behind(control.parentElement))) }))
        .filter(({ times }) => times < 3);
    });
    assert.deepEqual(faint, [], scheme);
  }
});

pageTest('the help of a field of a profile is text, and describes its control', { effect: 'sepia' }, async (page) => {
  await page.click('#tab-profiles');
  await page.waitForFunction(() => document.querySelector('[data-field]'));
  const helps = await page.$$eval('[data-field]', (fields) => fields.map((field) => {
    const input = field.querySelector('select, input');
    return [field.dataset.field, input.getAttribute('aria-label'), document.getElementById(input.getAttribute('aria-describedby'))?.textContent];
  }));
  assert.ok(helps.length > 40);
  for (const [field, name, help] of helps) {
    assert.equal(name, field);
    assert.match(help, /\w+ \w+/, field);
  }
});

pageTest('the help of inputs and of values of a source is text, and describes its control', { effect: 'index_cube' }, async (page) => {
  await openGroups(page);
  const helpsOf = (selector) => page.$$eval(selector, (controls) => controls.map((control) => [control.dataset.key ?? control.dataset.define,
    document.getElementById(control.getAttribute('aria-describedby'))?.textContent, document.querySelectorAll(`[id="${control.getAttribute('aria-describedby')}"]`).length]));
  const keys = await helpsOf('[data-key]');
  assert.ok(keys.length > 45, `${keys.length}`);
  await page.evaluate(() => globalThis.ninebit.store.change('all', (state) => {
    state.files['program.ps'] = 'ps.1.1\n#if SHADED > 1\nmov r0, v0\n#else\nmov r0, c0\n#endif\n';
    state.effect.passes[0].program = 'program.ps';
    state.pass = 0;
  }));
  await page.waitForSelector('[data-define]');
  for (const [name, help, count] of [...keys, ...await helpsOf('[data-define]')]) {
    assert.match(help ?? '', /\w+ \w+/, name);
    assert.equal(count, 1, name);
  }
});

pageTest('completion and help offer the words of the language', { effect: 'sepia' }, async (page) => {
  await page.waitForFunction(() => globalThis.ninebit.page.words > 100);
  await type(page, '!!RC1.0\nout.rgb = unsi');
  await page.keyboard.type('g');
  await page.waitForFunction(() => document.querySelector('.cm-tooltip-autocomplete')?.textContent.includes('unsigned_invert'));
});

pageTest('a crash of the engine shows a message, keeps the text, and the next edit draws', async (page) => {
  const hash = await hashOf(page);
  const text = await page.evaluate(() => globalThis.ninebit.store.state.files['programs/sepia.rc1']);
  await page.evaluate(() => {
    const { engine, page: parts } = globalThis.ninebit;
    parts.live.read();
    engine.worker.dispatchEvent(new ErrorEvent('error', { message: 'memory access out of bounds' }));
  });
  await page.waitForFunction(() => document.getElementById('message').textContent.includes('crashed'));
  assert.equal(await editorText(page), text);
  await type(page, `${text}# once more\n`);
  await waitForHash(page, hash);
});
