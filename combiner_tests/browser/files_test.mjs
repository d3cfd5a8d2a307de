/** Files under tabs: edits and undo belong to each; new, renamed and deleted files; links, the kept state, archives, headers. */
import assert from 'node:assert/strict';
import { dropOn, editorText, nativeHash, openEffect, openPage, openTab, pageTest, stateOf, type, undoInEditor, waitForHash, waitForReady } from './support.mjs';

const brown = '!!RC1.0\nconst0 = (0.5, 0.25, 0, 1);\nout.rgb = const0;\nout.a = unsigned_invert(zero);\n';
const source = '#include "lib/register.h"\nvoid set(void) {\n  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);\n'
  + '  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, REGISTER, GL_UNSIGNED_IDENTITY_NV, GL_RGB);\n}\n';

const tabs = (page) => page.$$eval('#files [role=tab]', (all) => all.map(({ dataset }) => dataset.file));
const chosen = (page) => page.$eval('#files [aria-selected=true]', ({ dataset }) => dataset.file);
const waitForFile = (page, file, content) => page.waitForFunction((name, wanted) => globalThis.ninebit.store.state.files[name] === wanted, {}, file, content);

/** Gives the name that the page asks for. */
async function name(page, button, wanted) {
  await page.click(button);
  await page.$eval('#file-name input', (input, value) => { input.value = value; }, wanted);
  await page.focus('#file-name input');
  await page.keyboard.press('Enter');
}

pageTest('each file of an effect has a tab, and edits and undo belong to it', { effect: 'index_cube' }, async (page) => {
  const state = await stateOf(page);
  const programs = [...new Set(state.effect.passes.flatMap(({ program }) => program ?? []))];
  assert.ok(programs.length > 1);
  assert.deepEqual(await tabs(page), [...programs, 'effect.json']);
  assert.equal(await chosen(page), programs[0]);
  await type(page, brown);
  await waitForFile(page, programs[0], brown);
  await openTab(page, programs[1]);
  assert.equal(await editorText(page), state.files[programs[1]]);
  assert.equal((await stateOf(page)).effect.passes[(await stateOf(page)).pass].program, programs[1]);
  await undoInEditor(page);
  assert.equal(await editorText(page), state.files[programs[1]]);
  assert.equal((await stateOf(page)).files[programs[0]], brown);
  await page.focus('#files [aria-selected=true]');
  await page.keyboard.press('ArrowLeft');
  assert.equal(await chosen(page), programs[0]);
  await undoInEditor(page, 3);
  assert.equal(await editorText(page), state.files[programs[0]]);
  await page.focus('#files [aria-selected=true]');
  await page.keyboard.press('ArrowLeft');
  assert.equal(await chosen(page), 'effect.json');
  assert.deepEqual(JSON.parse(await editorText(page)), state.effect);
});

pageTest('a new file, another name and a deletion are steps; a file that a pass names stays', async (page) => {
  await page.click('#new-program');
  assert.equal(await page.$eval('#delete-file', ({ hidden }) => hidden), true);
  const before = await stateOf(page);
  await name(page, '#new-file', 'other.rc1');
  assert.deepEqual(await tabs(page), ['program.rc1', 'other.rc1', 'effect.json']);
  assert.equal(await chosen(page), 'other.rc1');
  await type(page, brown);
  await waitForFile(page, 'other.rc1', brown);
  for (const bad of ['../a', 'program.rc1', 'effect.json', '/a', 'a#2', '', 'a/../b', 'profile.json']) {
    await name(page, '#rename-file', bad);
    assert.notEqual(await page.$eval('#file-name .fault', ({ textContent }) => textContent), '', bad);
    await page.keyboard.press('Escape');
  }
  await name(page, '#rename-file', '__proto__');
  assert.deepEqual(await tabs(page), ['program.rc1', '__proto__', 'effect.json']);
  assert.equal(await editorText(page), brown);
  await undoInEditor(page);
  await waitForFile(page, '__proto__', '');
  await type(page, brown);
  // The pass takes it.
  await page.evaluate(() => { document.querySelector('[data-group="This pass"]').open = true; });
  await page.waitForSelector('[data-key="pass.program"]');
  await page.select('[data-key="pass.program"]', '__proto__');
  await page.waitForFunction(() => document.getElementById('picture').dataset.hash);
  await waitForHash(page, nativeHash(await stateOf(page)));
  await openTab(page, 'program.rc1');
  await page.click('#delete-file');
  assert.deepEqual(await tabs(page), ['__proto__', 'effect.json']);
  await page.click('#undo');
  assert.deepEqual(await tabs(page), ['__proto__', 'program.rc1', 'effect.json']);
  await page.click('#undo');
  await page.click('#undo');
  assert.deepEqual(await stateOf(page), before);
  await name(page, '#rename-file', 'mine/a.rc1');
  assert.equal((await stateOf(page)).effect.passes[0].program, 'mine/a.rc1');
  await waitForHash(page, nativeHash(await stateOf(page)));
});

pageTest('a source reads its header from its tab; links and what is kept have both', async (page) => {
  await dropOn(page, ['set.c', source], ['register.h', '#define REGISTER GL_CONSTANT_COLOR0_NV\n']);
  await page.waitForFunction(() => Object.keys(globalThis.ninebit.store.state.files).length === 2);
  assert.deepEqual(await tabs(page), ['programs/sepia.rc1', 'programs/lib/register.h', 'effect.json']);
  const first = nativeHash(await stateOf(page));
  await waitForHash(page, first);
  await openTab(page, 'programs/lib/register.h');
  await type(page, '#define REGISTER GL_TEXTURE0_ARB\n');
  const second = nativeHash({ ...await stateOf(page) });
  assert.notEqual(second, first);
  await waitForHash(page, second);
  const state = await stateOf(page);
  // An error has no place in the header, whose line it would not be.
  await type(page, '#define REGISTER GL_TEXTURE7_ARB\n');
  await page.waitForFunction(() => document.getElementById('faults').textContent !== '');
  assert.equal(await page.$('.cm-lintRange-error'), null);
  await type(page, '#define REGISTER GL_TEXTURE0_ARB\n');
  await waitForHash(page, second);
  await page.evaluate(() => globalThis.ninebit.page.keep());
  const hash = await page.evaluate(() => globalThis.location.hash);
  const other = await openPage(page.browser(), { hash });
  assert.deepEqual(await stateOf(other), state);
  assert.equal(await chosen(other), 'programs/lib/register.h');
  await waitForHash(other, second);
  await page.evaluate(() => history.replaceState(null, '', location.pathname));
  await page.reload();
  await waitForReady(page);
  assert.deepEqual(await stateOf(page), state);
});

pageTest('an archive opens again with its header, and an archive of before, too', async (page) => {
  const files = [['effect.json', JSON.stringify({ ninebit: 'effect', version: 1, size: 16, profile: 'nv2a', passes: [{ program: 'programs/set.c', primary: 'constant:1,0.5,0' }] })],
    ['set.c', source], ['register.h', '#define REGISTER GL_PRIMARY_COLOR_NV\n']];
  await dropOn(page, ...files);
  await page.waitForFunction(() => globalThis.ninebit.store.state.files['lib/register.h']);
  const state = await stateOf(page);
  await waitForHash(page, nativeHash(state));
  const saved = await page.evaluate(async () => (await globalThis.ninebit.page.save.files()).map(([file, bytes]) => [file, new TextDecoder().decode(bytes)]));
  assert.deepEqual(saved.map(([file]) => file).sort(), ['effect.json', 'lib/register.h', 'set.c']);
  await page.click('#new-program');
  await dropOn(page, ...saved.map(([file, content]) => [file.split('/').pop(), content]));
  await page.waitForFunction(() => globalThis.ninebit.store.state.files['lib/register.h']);
  assert.deepEqual(await stateOf(page), state);
});

pageTest('a name that is typed into the effect leaves no files on its way', async (page) => {
  await openTab(page, 'effect.json');
  await page.evaluate(() => {
    const { view } = globalThis.ninebit.page.program.editor;
    const at = view.state.doc.toString().indexOf('programs/sepia.rc1');
    view.dispatch({ selection: { anchor: at, head: at + 'programs/sepia.rc1'.length } });
  });
  await page.focus('.cm-content');
  await page.keyboard.type('mine.rc1');
  await page.waitForFunction(() => globalThis.ninebit.store.state.effect.passes[0].program === 'mine.rc1');
  assert.deepEqual(await tabs(page), ['mine.rc1', 'programs/sepia.rc1', 'effect.json']);
});

pageTest('on a phone, tabs scroll in their row, and the page stays where it is', { width: 390, height: 844 }, async (page) => {
  await openEffect(page, 'index_cube');
  assert.equal(await page.evaluate(() => window.scrollY), 0);
  await page.evaluate(() => globalThis.ninebit.store.change('files', (state) => {
    for (let number = 0; number < 20; number++) state.files[`a_long_name_${number}.h`] = '';
  }));
  assert.equal(await page.evaluate(() => window.scrollY), 0);
  await openTab(page, 'effect.json');
  const { left, right, scrolled } = await page.$eval('#files [aria-selected=true]', (tab) => ({ left: tab.getBoundingClientRect().left, right: tab.getBoundingClientRect().right, scrolled: tab.parentElement.scrollLeft }));
  assert.ok(left >= 0 && right <= 390 && scrolled > 0, `${left} to ${right}`);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 390);
});
