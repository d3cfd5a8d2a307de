/** What a source leaves to choose: a function, one of its programs, values; in links, archives and on the command line. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { dropOn, faults, hashOf, native, openPage, pageTest, root, stateOf, type, waitForHash } from './support.mjs';

const lights = readFileSync(join(root, 'docs/programs/lights.c'), 'utf8');
const twice = `void draws(void) {
  float c[4] = { 0.25f, 0.5f, 0.75f, 1 };
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
  glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, c);
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_CONSTANT_COLOR0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}
`;

/** Runs the page's script with the native program, and gives the hash of its picture. */
async function hashOfScript(page) {
  await page.click('#tab-command');
  await page.waitForFunction(() => document.querySelector('#panel-command pre').textContent.includes('ninebit draw'));
  await page.evaluate(() => globalThis.ninebit.page.command.update());
  const script = await page.$eval('#panel-command pre', ({ textContent }) => textContent);
  const folder = mkdtempSync(join(tmpdir(), 'ninebit-script-'));
  cpSync(join(root, 'scenes/effects/textures'), join(folder, 'textures'), { recursive: true });
  try {
    const run = script.replace('ninebit draw effect.json', 'ninebit draw effect.json --json');
    const said = execFileSync('bash', ['-ec', run], { cwd: folder, stdio: ['ignore', 'pipe', 'inherit'], env: { ...process.env, PATH: `${join(root, 'build/release/bin')}:${process.env.PATH}` } }).toString();
    return { script, hash: JSON.parse(said.slice(said.indexOf('{'))).hash.color };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const fields = (page) => page.$$eval('#source-choices [data-define]', (all) => all.map(({ dataset, value }) => [dataset.define, value]));

async function define(page, name, value) {
  await page.waitForSelector(`[data-define="${name}"]`);
  await page.focus(`[data-define="${name}"]`);
  await page.keyboard.type(value);
  assert.equal(await page.evaluate(() => document.activeElement.dataset.define), name, 'the field keeps the focus');
}

pageTest('a function is chosen, and values that the engine asks for are given', async (page) => {
  await page.select('#profile-choice select', 'nv2a');
  await type(page, lights);
  await page.waitForSelector('[data-choice="function"]');
  assert.deepEqual(await page.$$eval('[data-choice="function"] option', (all) => all.map(({ value }) => value)), ['', 'R_LightFragments', 'R_DrawLight']);
  assert.deepEqual(await fields(page), []);
  await page.select('[data-choice="function"]', 'R_DrawLight');
  await page.waitForSelector('[data-define="first"]');
  assert.deepEqual(await fields(page), [['first', ''], ['light.color', ''], ['r_lists.integer', '']]);
  for (const [name, value] of [['first', '1'], ['light.color', '1,0.5,0'], ['r_lists.integer', '0']]) await define(page, name, value);
  await page.waitForFunction(() => !document.querySelector('#faults .error') && document.getElementById('picture').dataset.hash);
  const state = await stateOf(page);
  assert.deepEqual(JSON.parse(JSON.stringify(state.choices)), { 'programs/sepia.rc1': { function: 'R_DrawLight', defines: { first: '1', 'light.color': '1,0.5,0', 'r_lists.integer': '0' } } });
  await page.evaluate(() => globalThis.ninebit.page.draw());
  const { script, hash } = await hashOfScript(page);
  assert.match(script, /ninebit convert programs\/sepia\.rc1 --function R_DrawLight --define first=1 --define light\.color=1,0\.5,0 --define r_lists\.integer=0 --profile nv2a --to json/);
  assert.equal(await hashOf(page), hash);

  // The panels read the same.
  await page.click('#tab-convert');
  await page.waitForFunction(() => document.querySelector('#panel-convert pre').textContent.includes('glCombiner'));
  await page.click('#tab-gpu');
  await page.waitForFunction(() => document.querySelector('#gpu-result').dataset.count === '0', { timeout: 20_000 });

  // A link.
  await page.evaluate(() => globalThis.ninebit.page.keep());
  const other = await openPage(page.browser(), { hash: await page.evaluate(() => location.hash) });
  assert.deepEqual(await stateOf(other), state);
  await waitForHash(other, hash);
  assert.deepEqual((await fields(other)).map(([, value]) => value), ['1', '1,0.5,0', '0']);

  // An archive, which `ninebit draw` draws, and which opens with the source.
  const saved = await page.evaluate(async () => (await globalThis.ninebit.page.save.files()).map(([file, bytes]) => [file, [...bytes]]));
  const folder = mkdtempSync(join(tmpdir(), 'ninebit-archive-'));
  for (const [file, content] of saved) {
    mkdirSync(dirname(join(folder, file)), { recursive: true });
    writeFileSync(join(folder, file), Buffer.from(content));
  }
  assert.equal(native(folder, 'draw', 'effect.json', '-o', 'picture.png').hash.color, hash);
  rmSync(folder, { recursive: true });
  await page.click('#new-program');
  await dropOn(page, ...saved.map(([file, content]) => [file.split('/').pop(), content]));
  await waitForHash(page, hash);
  assert.deepEqual(JSON.parse(JSON.stringify((await stateOf(page)).choices)), { 'sepia.rc1': state.choices['programs/sepia.rc1'] });
  assert.equal((await stateOf(page)).files['sepia.rc1'], lights);

  // A value that is taken back is asked for again.
  await page.waitForSelector('[data-define="first"]');
  await page.focus('[data-define="first"]');
  await page.keyboard.press('End');
  await page.keyboard.press('Backspace');
  await page.waitForFunction(() => document.getElementById('faults').textContent.includes("'first'"));
  assert.deepEqual((await fields(page))[0], ['first', '']);
});

pageTest('a program of a function that draws twice is picked by its number', { effect: 'sepia' }, async (page) => {
  await type(page, twice);
  await page.waitForSelector('[data-choice="program"]');
  assert.match(await faults(page), /pick one with #1 to #2/);
  const hashes = [];
  for (const number of ['1', '2']) {
    await page.select('[data-choice="program"]', number);
    await page.waitForFunction((wanted) => globalThis.ninebit.store.state.effect.passes[0].program === wanted, {}, `programs/sepia.rc1#${number}`);
    await page.evaluate(() => globalThis.ninebit.page.draw());
    assert.equal(await page.$('#faults .error'), null);
    const { script, hash } = await hashOfScript(page);
    assert.doesNotMatch(script, /convert/, 'an effect names the number itself');
    assert.equal(await hashOf(page), hash);
    hashes.push(hash);
  }
  assert.notEqual(hashes[0], hashes[1]);
  // The text is still the one that is edited.
  await type(page, twice.replace('0.75f', '0.8f'));
  await page.waitForFunction(() => globalThis.ninebit.store.state.files['programs/sepia.rc1'].includes('0.8f'));
});

pageTest("a condition of a shader asks for its name, and another form for nothing", { effect: 'sepia' }, async (page) => {
  await type(page, 'ps.1.1\ntex t0\n#if BRIGHT\nmov_x2 r0, t0\n#else\nmov r0, t0\n#endif\n');
  await define(page, 'BRIGHT', '1');
  await page.waitForFunction(() => !document.querySelector('#faults .error'));
  await page.evaluate(() => globalThis.ninebit.page.draw());
  const { script, hash } = await hashOfScript(page);
  assert.match(script, /--define BRIGHT=1/);
  assert.equal(await hashOf(page), hash);
  await page.click('#new-program');
  await page.waitForFunction(() => document.getElementById('source-choices').hidden);
});

pageTest('names and values of people are text, and choices of other kinds are refused', async (page) => {
  const evil = '<img src=x onerror=alert(1)>';
  await page.evaluate((name) => {
    const { store } = globalThis.ninebit;
    const state = structuredClone(store.state);
    state.files[name] = '';
    state.choices = { 'programs/sepia.rc1': { function: name, defines: { [name]: name, constructor: '1' } } };
    store.open(state);
  }, evil);
  await page.waitForFunction((name) => document.getElementById('source-choices').textContent.includes(name), {}, evil);
  assert.equal(await page.$$eval('img[src]', (images) => images.length), 0);
  await page.click('#tab-command');
  await page.waitForFunction(() => document.querySelector('#panel-command pre').textContent.includes('--define'));
  assert.match(await page.$eval('#panel-command pre', ({ textContent }) => textContent), /--define '<img src=x onerror=alert\(1\)>=<img/);
});
