/**
 * The page in Chromium, and the native program beside it.
 */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';

export const root = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
export const pageFile = join(root, 'build/playground/index.html');
export const program = join(root, 'build/release/bin/ninebit');
const puppeteer = createRequire(join(root, 'build/playground/npm/package.json'))('puppeteer-core');

const flags = ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync'];
const softwareWebgl = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

/** Chromium with WebGL by software, or with none. */
export function launch({ webgl = true } = {}) {
  const executablePath = execFileSync('which', [process.env.CHROMIUM ?? 'chromium']).toString().trim();
  return puppeteer.launch({ executablePath, args: [...flags, ...(webgl ? softwareWebgl : ['--disable-gpu', '--disable-software-rasterizer'])] });
}

/** Firefox without a screen. @param {string} executablePath */
export const firefox = (executablePath) => puppeteer.launch({ browser: 'firefox', executablePath });

/**
 * Opens the page and waits for its first picture. `page.complaints` are errors of the console, of scripts, dialogs, and
 * requests that leave the page.
 */
export async function openPage(browser, { hash = '', query = '', width = 1280, height = 900, hashes = true, first = 'sepia' } = {}) {
  // A context of its own, as pages of one browser share what it keeps.
  const page = await (await browser.createBrowserContext()).newPage();
  // By time: by frames, a page for which Chromium makes none would wait for ever.
  const waits = page.waitForFunction.bind(page);
  page.waitForFunction = (done, options, ...values) => waits(done, { polling: 20, ...options }, ...values);
  page.complaints = [];
  const complain = (text) => page.complaints.push(text);
  page.on('console', (message) => { if (['error', 'warn'].includes(message.type())) complain(`console: ${message.text()}`); });
  page.on('pageerror', (error) => complain(`error: ${error.message}`));
  page.on('dialog', async (dialog) => {
    complain(`dialog: ${dialog.message()}`);
    await dialog.dismiss();
  });
  page.on('request', (request) => {
    if (!/^(blob:|data:)/.test(request.url()) && request.url().split(/[?#]/)[0] !== `file://${pageFile}`) complain(`request: ${request.url()}`);
  });
  await page.setViewport({ width, height });
  await page.evaluateOnNewDocument((effect, hashed) => {
    if (effect) globalThis.ninebitFirst = effect;
    if (hashed) globalThis.ninebitHashes = true;
  }, first, hashes);
  await page.goto(`file://${pageFile}${query}${hash}`);
  await waitForReady(page);
  return page;
}

/** Waits for the first picture. */
export const waitForReady = (page) => page.waitForFunction(() => document.body?.dataset.ready && globalThis.ninebit, { timeout: 60_000 });

/** The Chromium of a file with tests: it starts with the first that needs it, and is closed after all of them. @type {Promise<any>|undefined} */
let chromium;
function chromiumOfFile(options) {
  if (!chromium) after(async () => { await (await chromium).close(); });
  return chromium ??= launch(options);
}

/** One page for all tests of a file. */
export const onePage = async (options) => openPage(await chromiumOfFile(options));

/** The page of tests that name an effect. @type {Promise<any>|undefined} */
let sharedPage;

/**
 * A test in which nothing complains: pageTest(name, [options], run). It has a page of its own, with options of openPage;
 * with `{ effect }` it shares one with others like it, where the effect is opened from the gallery. A test that opens further
 * pages does so in `page.browser()`.
 */
export function pageTest(name, ...rest) {
  const run = rest.pop(), [{ effect, ...options } = {}] = rest, browser = chromiumOfFile();
  test(name, async (context) => {
    const page = await (effect ? sharedPage ??= openPage(await browser) : openPage(await browser, options));
    const { complaints } = page, pages = page.browserContext();
    if (effect) {
      complaints.length = 0;
      await page.click('#tab-inputs');
      await openEffect(page, effect);
    }
    await run(page, context);
    assert.deepEqual(complaints, []);
    if (!effect) await pages.close();
  });
}

export const hashOf = (page) => page.$eval('#picture', (element) => element.dataset.hash);

/** Waits until the picture has a hash. */
export async function waitForHash(page, hash) {
  try {
    await page.waitForFunction((wanted) => document.getElementById('picture').dataset.hash === wanted, { timeout: 20_000 }, hash);
  } catch {
    assert.equal(await hashOf(page), hash, `the picture's hash; faults: ${await faults(page)}`);
  }
}

/** Presses a key while others are held: press(page, 'Control', 'z'). */
export async function press(page, ...keys) {
  const key = keys.pop();
  for (const held of keys) await page.keyboard.down(held);
  await page.keyboard.press(key);
  for (const held of keys.reverse()) await page.keyboard.up(held);
}

/** Replaces the editor's text by what a keyboard would write. */
export async function type(page, text) {
  await page.focus('.cm-content');
  await press(page, 'Control', 'a');
  await page.keyboard.sendCharacter(text);
}

/** Ctrl-Z in the editor. */
export async function undoInEditor(page, times = 1) {
  await page.focus('.cm-content');
  for (let count = 0; count < times; count++) await press(page, 'Control', 'z');
}

export const editorText = (page) => page.evaluate(() => globalThis.ninebit.page.program.editor.view.state.doc.toString());

/** Waits until a file has a text. */
export const waitForText = (page, text) => page.waitForFunction((wanted) => Object.values(globalThis.ninebit.store.state.files).includes(wanted), {}, text);

/** The message above everything; empty: there is none. */
export const message = (page) => page.$eval('#message', (element) => (element.hidden ? '' : element.textContent));

/** What is wrong, below the editor. */
export const faults = (page) => page.$eval('#faults', ({ textContent }) => textContent);

/** Opens an effect of the gallery as if its card were clicked. */
export async function openEffect(page, name) {
  await page.evaluate(() => document.getElementById('picture').removeAttribute('data-hash'));
  await page.click('#open-gallery');
  await page.click(`[data-effect="${name}"]`);
  await page.waitForFunction(() => document.getElementById('picture').dataset.hash !== undefined, { timeout: 30_000 });
}

/** Follows a link from the page itself. */
export const follow = (page, hash) => page.evaluate((link) => { location.hash = link; }, hash);

/** Shows a file of the effect in the editor. */
export async function openTab(page, file) {
  await page.$$eval('#files [role=tab]', (tabs, wanted) => tabs.find(({ dataset }) => dataset.file === wanted).click(), file);
  await page.waitForFunction((wanted) => document.querySelector('#files [aria-selected=true]').dataset.file === wanted, {}, file);
}

/** Drops files on the picture: pairs of a name and its content, a text, bytes, or a number of zero bytes. */
export function dropOn(page, ...files) {
  const types = { png: 'image/png', jpg: 'image/jpeg', json: 'application/json' };
  const sent = files.map(([name, content]) => [name, types[name.split('.').pop()] ?? '', typeof content === 'number' ? content : Buffer.from(content).toString('base64')]);
  return page.evaluate((all) => {
    const dataTransfer = new DataTransfer();
    for (const [name, type, content] of all) {
      const bytes = typeof content === 'number' ? new Uint8Array(content) : Uint8Array.from(atob(content), (character) => character.charCodeAt(0));
      dataTransfer.items.add(new File([bytes], name, { type }));
    }
    document.getElementById('picture').dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer }));
  }, sent);
}

/** Chooses a pixel, and waits for its trace. */
export async function choosePixel(page, x, y) {
  await page.evaluate((column, row) => {
    globalThis.ninebit.page.trace.trace = null;
    globalThis.ninebit.page.picture.take({ x: column, y: row });
  }, x, y);
  await waitForTrace(page);
}
export const waitForTrace = (page) => page.waitForFunction(() => globalThis.ninebit.page.trace.trace?.stages && document.querySelector('#strip .strip-item'));

/** Clicks a pixel of the picture, counted from the upper left corner. */
export async function clickPixel(page, x, y) {
  const place = await page.$eval('#picture canvas', (canvas, column, row) => {
    canvas.scrollIntoView({ block: 'center' });
    const box = canvas.getBoundingClientRect();
    return { x: box.left + (column + 0.5) * box.width / canvas.width, y: box.top + (row + 0.5) * box.height / canvas.height };
  }, x, y);
  await page.mouse.click(place.x, place.y);
}

/** The page's state as data. */
export const stateOf = (page) => page.evaluate(() => structuredClone(globalThis.ninebit.store.state));

const folders = [];
process.on('exit', () => folders.forEach((folder) => rmSync(folder, { recursive: true, force: true })));

/** A folder with the state's files and the gallery's pictures, for the native program. */
export function folderOf(state, more = {}) {
  const folder = mkdtempSync(join(tmpdir(), 'ninebit-browser-'));
  folders.push(folder);
  cpSync(join(root, 'scenes/effects/textures'), join(folder, 'textures'), { recursive: true });
  for (const [name, content] of Object.entries({ ...state.files, ...more, 'effect.json': JSON.stringify(state.effect) })) {
    mkdirSync(dirname(join(folder, name)), { recursive: true });
    writeFileSync(join(folder, name), content);
  }
  if (typeof state.profile === 'object') writeFileSync(join(folder, 'profile.json'), JSON.stringify(state.profile));
  return folder;
}

const profileOf = (state) => (typeof state.profile === 'object' ? 'profile.json' : state.profile);

/** What the native program prints, as an object. */
export function native(folder, ...words) {
  return JSON.parse(execFileSync(program, [...words, '--json'], { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'], maxBuffer: 1 << 28 }));
}

/** The hash that the native program gives the state's picture. */
export const nativeHash = (state, more) => native(folderOf(state, more), 'draw', 'effect.json', '--profile', profileOf(state), '-o', 'picture.png').hash.color;

/** The native trace of a pixel. */
export const nativeTrace = (state, x, y) => native(folderOf(state), 'trace', '--effect', 'effect.json', '--profile', profileOf(state), '--pixel', `${x},${y}`);

/** The messages of `ninebit validate` on a text. */
export function nativeFaults(text, profile) {
  const folder = folderOf({ files: { 'program.txt': text }, effect: {} });
  try {
    return execFileSync(program, ['validate', 'program.txt', '--profile', profile], { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'] }).toString();
  } catch (error) {
    return `${error.stdout}${error.stderr}`;
  }
}

export const expectedHashes = () => JSON.parse(readFileSync(join(root, 'scenes/effects/expected_hashes.json'), 'utf8'));
