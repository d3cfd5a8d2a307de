/** Nothing is lost: histories of files, steps that are undone, Back, a reload, a crash of the page. */
import assert from 'node:assert/strict';
import { addressOf, opened } from '../../src/playground/web/permalink.js';
import { newState } from '../../src/playground/web/state.js';
import { picture } from './png_files.mjs';
import { dropOn, editorText, follow, hashOf, message, nativeHash, openEffect, pageFile, pageTest, press, stateOf, type, undoInEditor, waitForHash, waitForReady, waitForText } from './support.mjs';

const mine = '!!RC1.0\n# Mine.\nout.rgb = unsigned_invert(tex0);\nout.a = unsigned_invert(zero);\n';
const title = (page) => page.evaluate(() => globalThis.ninebit.store.state.effect.title);
const waitForTitle = (page, wanted) => page.waitForFunction((text) => globalThis.ninebit.store.state.effect.title === text, {}, wanted);
const keep = (page) => page.evaluate(() => globalThis.ninebit.page.keep());

/** A test on a page on which something was typed: `run` gets the page and its state. */
const typedTest = (name, run) => pageTest(name, async (page) => {
  await type(page, mine);
  await waitForText(page, mine);
  await run(page, await stateOf(page));
});

typedTest('Ctrl-Z in the editor stays in its file', async (page) => {
  await openEffect(page, 'emboss');
  const shown = await stateOf(page);
  await undoInEditor(page, 5);
  assert.deepEqual(await stateOf(page), shown);
  // Each file of an effect has its own history.
  await openEffect(page, 'index_cube');
  const passes = (await stateOf(page)).effect.passes.map(({ program }, at) => [program, String(at)]).filter(([program]) => program);
  const [[first, at], [, other]] = passes.filter(([program], index) => passes.findIndex(([same]) => same === program) === index);
  await page.select('#file-choice select', at);
  const old = await editorText(page);
  await type(page, mine);
  await waitForText(page, mine);
  await page.select('#file-choice select', other);
  const second = await editorText(page);
  await undoInEditor(page);
  assert.equal(await editorText(page), second);
  await page.select('#file-choice select', at);
  await undoInEditor(page, 3);
  assert.equal(await editorText(page), old);
  assert.equal((await stateOf(page)).files[first], old);
});

for (const [what, act] of [['New', (page) => page.click('#new-program')], ['the gallery', (page) => openEffect(page, 'emboss')],
  ['a dropped picture', (page) => dropOn(page, ['a.png', picture(16)])],
  ['a dropped program', (page) => dropOn(page, ['a.rc1', '!!RC1.0\nout.rgb = tex0;\n'])],
  ['a link', async (page) => {
    // The page writes its address after a pause.
    await keep(page);
    await follow(page, await addressOf(newState()));
  }]]) {
  typedTest(`${what} can be undone and redone, by the button, by Ctrl-Z and by Back`, async (page, state) => {
    const hash = nativeHash(state);
    await waitForHash(page, hash);
    await act(page);
    await page.waitForFunction((old) => JSON.stringify(globalThis.ninebit.store.state) !== old && globalThis.ninebit.store.past.length === 1, {}, JSON.stringify(state));
    const later = await stateOf(page);
    assert.notDeepEqual(later, state);
    await page.click('#undo');
    assert.deepEqual(await stateOf(page), state);
    assert.equal(await editorText(page), mine);
    await waitForHash(page, hash);
    await page.click('#redo');
    assert.deepEqual(await stateOf(page), later);
    await page.focus('#tab-inputs');
    await press(page, 'Control', 'z');
    assert.deepEqual(await stateOf(page), state);
    await press(page, 'Control', 'Shift', 'z');
    assert.deepEqual(await stateOf(page), later);
    await keep(page);
    await page.evaluate(() => history.back());
    await page.waitForFunction((old) => JSON.stringify(globalThis.ninebit.store.state) === old, {}, JSON.stringify(state));
    await waitForHash(page, hash);
    // Back is a step, too.
    await page.click('#undo');
    assert.deepEqual(await stateOf(page), later);
  });
}

typedTest('edits are no steps of the address, and what is opened is one', async (page) => {
  const length = () => page.evaluate(() => history.length);
  const before = await length();
  await type(page, `${mine}# more\n`);
  await page.select('#profile-choice select', 'nv2a');
  await keep(page);
  assert.equal(await length(), before);
  await openEffect(page, 'emboss');
  await page.waitForFunction((count) => history.length === count, {}, before + 1);
});

typedTest('a reload, a new visit and a crash of the page give the work back, with its steps and its files', async (page) => {
  await dropOn(page, ['a.png', picture(16)]);
  await page.waitForFunction(() => globalThis.ninebit.store.past.length === 1 && globalThis.ninebit.page.shelf.dropped.size === 1);
  const state = await stateOf(page);
  const hash = nativeHash(state, { 'dropped/a.png': picture(16) });
  await waitForHash(page, hash);
  assert.match(await page.$eval('footer', ({ textContent }) => textContent), /Your work is kept in this browser/);
  for (const again of [() => page.reload(), () => page.goto('about:blank').then(() => page.goto(`file://${pageFile}`))]) {
    await again();
    await waitForReady(page);
    assert.deepEqual(await stateOf(page), state);
    await waitForHash(page, hash);
  }
  await page.click('#undo');
  assert.equal(await editorText(page), mine);
  await page.click('#redo');
  await keep(page);
  assert.deepEqual(page.complaints, []);
  // A crash of the page: it hears nothing of it.
  const second = await page.browserContext().newPage();
  await second.evaluateOnNewDocument(() => { globalThis.ninebitHashes = true; });
  await page.goto('chrome://crash').catch(() => {});
  await second.goto(`file://${pageFile}`);
  await waitForReady(second);
  assert.deepEqual(await stateOf(second), state);
  await waitForHash(second, hash);
});

typedTest('a link does not take the place of what was kept', async (page, state) => {
  await keep(page);
  await page.goto('about:blank');
  await page.goto(`file://${pageFile}${await addressOf(newState())}`);
  await waitForReady(page);
  assert.equal(await title(page), 'Untitled');
  await page.click('#undo');
  assert.deepEqual(await stateOf(page), state);
});

/** Opens the page anew with another text in the browser's storage. */
async function reopen(page, text) {
  await page.evaluate((kept) => {
    const set = Storage.prototype.setItem;
    // The page keeps its state as it is left.
    Storage.prototype.setItem = () => {};
    set.call(localStorage, 'ninebit-playground', kept);
  }, text);
  await page.goto('about:blank');
  await page.goto(`file://${pageFile}`);
  await waitForReady(page);
}

const stored = (page, name) => page.evaluate((key) => localStorage.getItem(key), name);
const keptNames = (page) => page.evaluate(() => new Promise((resolve) => {
  const opened = indexedDB.open('ninebit-playground');
  opened.onsuccess = () => {
    const found = opened.result.transaction('files').objectStore('files').getAllKeys();
    found.onsuccess = () => {
      opened.result.close();
      resolve(found.result);
    };
  };
}));
const drop = async (page, name) => {
  const count = await page.evaluate(() => globalThis.ninebit.store.past.length);
  await dropOn(page, [name, picture(16)]);
  await page.waitForFunction((before) => globalThis.ninebit.store.past.length > before, {}, count);
};
const kept = (page) => page.$eval('#kept', ({ textContent }) => textContent);

for (const [text, expected] of [['{', /What was kept of your work cannot be opened/], ['{"version": 9}', /another version of this page wrote it/],
  ['{"version": 1, "state": {"effect": {"passes": [null]}, "files": {}}}', /cannot be opened: .*/]]) {
  pageTest(`what was kept and cannot be opened gets a message, and stays: ${text}`, async (page) => {
    await drop(page, 'a.png');
    await reopen(page, text);
    assert.match(await message(page), expected);
    assert.match(await message(page), /stays in localStorage as ninebit-playground-unreadable/);
    assert.notEqual(await hashOf(page), '');
    await keep(page);
    assert.equal(await stored(page, 'ninebit-playground-unreadable'), text);
    // Nor do its files go at a later visit.
    await page.reload();
    await waitForReady(page);
    assert.equal(await message(page), '');
    assert.equal(await stored(page, 'ninebit-playground-unreadable'), text);
    assert.deepEqual(await keptNames(page), ['dropped/a.png']);
  });
}

typedTest('a step that cannot be opened does not take the others along', async (page, state) => {
  const good = { ...newState(), pass: 0 };
  const text = JSON.stringify({ version: 1, state, past: [good, { effect: { passes: [null] }, files: {} }, null] });
  await reopen(page, text);
  assert.match(await message(page), /Some steps before your work cannot be opened; their text stays in localStorage as ninebit-playground-unreadable/);
  assert.deepEqual(await stateOf(page), state);
  assert.equal(await stored(page, 'ninebit-playground-unreadable'), text);
  assert.equal(await page.evaluate(() => globalThis.ninebit.store.past.length), 1);
  await page.click('#undo');
  assert.equal(await title(page), 'Untitled');
});

typedTest('files are forgotten once no state names them and no other tab is open', async (page, state) => {
  const text = JSON.stringify({ version: 1, state, past: [] });
  await drop(page, 'a.png');
  const second = await page.browserContext().newPage();
  await second.goto(`file://${pageFile}`);
  await waitForReady(second);
  await reopen(second, text);
  assert.deepEqual(await stateOf(second), state);
  assert.deepEqual(await keptNames(second), ['dropped/a.png']);
  await page.close();
  await reopen(second, text);
  assert.deepEqual(await keptNames(second), []);
  await second.close();
});

for (const [what, spoil] of [
  ['is refused', () => { IDBObjectStore.prototype.put = () => { throw new DOMException('full', 'QuotaExceededError'); }; }],
  ['fails as it is committed', () => {
    const { put } = IDBObjectStore.prototype;
    IDBObjectStore.prototype.put = function aborted(...words) {
      const request = put.apply(this, words);
      request.addEventListener('success', () => this.transaction.abort());
      return request;
    };
  }]]) {
  typedTest(`a dropped file whose keeping ${what} is reported, and stays so`, async (page) => {
    await drop(page, 'a.png');
    assert.equal(await kept(page), 'Your work is kept in this browser.');
    await page.evaluate(spoil);
    await drop(page, 'b.png');
    await keep(page);
    assert.equal(await kept(page), 'Your work is kept in this browser, without a file that you dropped.');
    await openEffect(page, 'emboss');
    assert.equal(await kept(page), 'Your work is kept in this browser, without a file that you dropped.');
    assert.deepEqual(await keptNames(page), ['dropped/a.png']);
  });
}

typedTest('a browser that has room for the state alone says so', async (page) => {
  await page.evaluate(() => {
    const { setItem } = Storage.prototype;
    Storage.prototype.setItem = function full(name, text) {
      if (JSON.parse(text).past.length) throw new DOMException('full', 'QuotaExceededError');
      setItem.call(this, name, text);
    };
  });
  await openEffect(page, 'emboss');
  assert.equal(await kept(page), 'Your work is kept in this browser, without the steps before it.');
  assert.equal(JSON.parse(await stored(page, 'ninebit-playground')).state.effect.title, 'Emboss');
});

typedTest('an address that the browser refuses once is written the next time', async (page) => {
  await keep(page);
  await page.evaluate(() => {
    history.replaceState = () => {
      throw new DOMException('too often', 'SecurityError');
    };
  });
  await page.click('#copy-link');
  await page.waitForFunction(() => document.getElementById('message').textContent === 'The link cannot be written: too often.');
  assert.equal(await page.$eval('#copy-link', ({ textContent }) => textContent), 'Copy link');
  // Where nobody waits, it is no error.
  await page.evaluate(() => globalThis.ninebit.store.change('text', () => {}));
  await new Promise((resolve) => { setTimeout(resolve, 1000); });
  assert.deepEqual(page.complaints, []);
  await page.evaluate(() => {
    delete history.replaceState;
    globalThis.ninebit.store.change('other', (state) => { state.other = 'geforce3'; });
  });
  await keep(page);
  assert.equal((await opened(await page.evaluate(() => location.hash))).state.other, 'geforce3');
});

typedTest('Ctrl-Z in a text field is its own', async (page) => {
  await openEffect(page, 'emboss');
  const fields = ['text', 'number', 'range'];
  await page.evaluate((types) => {
    for (const type of types) document.body.append(Object.assign(document.createElement('input'), { type, id: `field-${type}` }));
  }, fields);
  for (const field of fields) {
    await page.focus(`#field-${field}`);
    await press(page, 'Control', 'z');
    assert.equal(await page.evaluate(() => globalThis.ninebit.store.past.length), field === 'range' ? 0 : 1, field);
  }
});

pageTest('a browser that keeps nothing says so, and works', async (page) => {
  await page.evaluate(() => { Storage.prototype.setItem = () => { throw new DOMException('full', 'QuotaExceededError'); }; });
  await type(page, mine);
  await page.waitForFunction(() => document.getElementById('kept').textContent.includes('does not keep your work'));
  await openEffect(page, 'emboss');
  await waitForTitle(page, 'Emboss');
});

typedTest('a file of the same name and other content does not take the place of the first', async (page) => {
  for (const side of [16, 32, 16]) await dropOn(page, ['a.png', picture(side)]);
  await page.waitForFunction(() => globalThis.ninebit.store.past.length === 3);
  assert.deepEqual(await page.evaluate(() => [...globalThis.ninebit.page.shelf.dropped.keys()]), ['dropped/a.png', 'dropped/a 2.png']);
  assert.equal(Object.values((await stateOf(page)).effect.textures).at(-1).source, 'dropped/a.png');
  await page.click('#undo');
  await waitForHash(page, nativeHash(await stateOf(page), { 'dropped/a 2.png': picture(32), 'dropped/a.png': picture(16) }));
});
