/**
 * What the page's speed is here, and how it looks: node combiner_tests/browser/figures.mjs FOLDER [figures|pictures]
 *
 * By hand, on a machine that has nothing else to do; no test, as nothing is judged. It prints tables for
 * docs/internals/performance.md and writes screenshots into FOLDER.
 */
import { mkdirSync } from 'node:fs';
import { cpus, loadavg } from 'node:os';
import { join } from 'node:path';
import { setTimeout as pause } from 'node:timers/promises';
import { launch, openEffect, openPage } from './support.mjs';

const [folder, only] = process.argv.slice(2);
if (!folder || (only && !['figures', 'pictures'].includes(only))) {
  process.stderr.write('usage: node combiner_tests/browser/figures.mjs FOLDER [figures|pictures]\n');
  process.exit(2);
}
mkdirSync(folder, { recursive: true });
const print = (line) => process.stdout.write(`${line}\n`);
const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const browser = await launch();

/** The milliseconds to the first picture, in a new context each time. */
async function starts(count) {
  const found = [];
  for (let at = 0; at < count; at++) {
    const page = await openPage(browser, { first: null, hashes: false });
    found.push(Number(await page.evaluate(() => document.body.dataset.ready)));
    await page.close();
  }
  return found;
}

/** The milliseconds from each typed character to the next picture that is shown. */
async function typing(count) {
  const page = await openPage(browser, { first: null, hashes: false });
  await page.evaluate(() => {
    const { picture, program } = globalThis.ninebit.page;
    const { view } = program.editor;
    view.dispatch({ changes: { from: view.state.doc.length, insert: '\n# ' }, selection: { anchor: view.state.doc.length + 3 } });
    const show = picture.show.bind(picture);
    const waits = globalThis.typed = { at: 0, found: [] };
    document.addEventListener('keydown', ({ timeStamp }) => { waits.at = timeStamp; }, true);
    picture.show = (...planes) => {
      show(...planes);
      if (waits.at) waits.found.push(performance.now() - waits.at);
      waits.at = 0;
    };
  });
  await pause(1500);
  await page.focus('.cm-content');
  for (let at = 0; at < count; at++) {
    await page.keyboard.press('abcdefgh'[at % 8]);
    await pause(200);
  }
  const found = await page.evaluate(() => globalThis.typed.found);
  await page.close();
  return found;
}

/** The pictures a second while constant 0 moves before each frame, after a warm-up. @param {any} page */
function rate(page, seconds) {
  return page.evaluate((time) => new Promise((resolve) => {
    const { page: { picture }, store, passOf } = globalThis.ninebit;
    const show = picture.show.bind(picture), begin = performance.now(), warm = 1000;
    let shown = 0, moves = 0;
    picture.show = (...planes) => {
      show(...planes);
      if (performance.now() - begin > warm) shown++;
    };
    const move = () => {
      const spent = performance.now() - begin;
      if (spent > warm + 1000 * time) {
        picture.show = show;
        resolve(shown / time);
        return;
      }
      moves++;
      store.change('inputs', (state) => { passOf(state).constants = { ...passOf(state).constants, const0: [0.3, 0.4, 0.5, moves % 256 / 255] }; });
      requestAnimationFrame(move);
    };
    move();
  }), seconds);
}

async function figures() {
  const [{ model }] = cpus();
  print(`${cpus().length} x ${model}, load ${loadavg()[0].toFixed(1)}, Chromium ${(await browser.version()).replace(/.*\//, '')} without a GPU\n`);
  const all = await starts(5), typed = await typing(25);
  print('| what | median | all |\n|---|---|---|');
  print(`| start | ${(median(all) / 1000).toFixed(2)} s | ${all.map((value) => (value / 1000).toFixed(2)).join(', ')} |`);
  print(`| typed character to picture | ${median(typed).toFixed(0)} ms | ${typed.length} of 25 characters, ${Math.min(...typed).toFixed(0)} to ${Math.max(...typed).toFixed(0)} |\n`);
  const page = await openPage(browser, { hashes: false });
  const names = await page.$$eval('[data-effect]', (cards) => cards.map(({ dataset }) => dataset.effect));
  print('| effect | pictures/s |\n|---|---|');
  const rates = [];
  for (const name of names) {
    await openEffect(page, name);
    await pause(800);
    rates.push(await rate(page, 3));
    print(`| ${name} | ${rates.at(-1).toFixed(0)} |`);
  }
  const reach = (least) => rates.filter((value) => value >= least - 0.5).length;
  print(`\n${names.length} effects: ${reach(60)} reach 60 pictures/s, ${reach(30)} reach 30; load ${loadavg()[0].toFixed(1)}`);
  await page.close();
}

/** @param {string} name @param {any} options of the page @param {string} scheme @param {(page: any) => Promise<any>} prepare */
async function shoot(name, options, scheme, prepare) {
  const page = await openPage(browser, { first: null, hashes: false, ...options });
  await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
  await prepare(page);
  await pause(1500);
  await page.screenshot({ path: join(folder, `${name}-${scheme}.png`) });
  await page.close();
}

const choose = (page, x, y, panel) => page.evaluate((column, row, name) => {
  globalThis.ninebit.page.picture.take({ x: column, y: row });
  if (name) globalThis.ninebit.page.showPanel(name);
}, x, y, panel);

async function pictures() {
  for (const scheme of ['light', 'dark']) {
    for (const [width, height] of [[390, 844], [1280, 720], [1600, 1000]]) await shoot(`first-${width}x${height}`, { width, height }, scheme, async () => {});
    await shoot('sweep', { width: 1280, height: 720 }, scheme, async (page) => {
      await choose(page, 60, 90, 'sweep');
      await page.waitForSelector('#panel-sweep .curve');
    });
    await shoot('overlay', { width: 1280, height: 720 }, scheme, async (page) => {
      await page.select('#mark-losses', 'truncated');
      await page.waitForFunction(() => !globalThis.ninebit.page.losses.layer.hidden);
    });
    await shoot('embed', { width: 900, height: 600, query: '?embed&effect=emboss' }, scheme, (page) => choose(page, 100, 100, 'trace'));
    await shoot('stages', { width: 1600, height: 1000, query: '?effect=diffuse_specular' }, scheme, (page) => choose(page, 60, 128, 'trace'));
    await shoot('inputs', { width: 1280, height: 720, query: '?effect=index_cube' }, scheme, (page) => page.evaluate(() => {
      for (const group of document.querySelectorAll('#panel-inputs .mores details')) group.open = true;
      document.querySelector('#panel-inputs .mores').scrollIntoView();
    }));
  }
}

try {
  if (only !== 'figures') await pictures();
  if (only !== 'pictures') await figures();
} finally {
  await browser.close();
}
