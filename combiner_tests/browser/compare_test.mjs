/**
 * The page of `ninebit compare`, and the report of `ninebit study shadows`: what stands at a pixel, and the trace that
 * explains a wrong one.
 */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { launch, native, program, root } from './support.mjs';

let browser, page, answer, folder;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'ninebit-compare-'));
  answer = native(root, 'compare', 'scenes/index_room.gltf', '--size', '160x120', '--vary', 'index-step=1,2', '-o', folder);
  browser = await launch();
  page = await browser.newPage();
  await page.setViewport({ width: 1280, height: 900 });
  await page.goto(`file://${join(folder, 'index.html')}`);
  await page.waitForSelector('.maps canvas');
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

/** Moves to the middle of a pixel of an element that shows the whole picture inside its border. */
async function pointAt(selector, x, y, on = page, [width, height] = [160, 120]) {
  const element = await on.$(selector);
  await element.scrollIntoView();
  const box = (await element.boxModel()).content;
  const at = [box[0].x + ((x + 0.5) / width) * (box[2].x - box[0].x), box[0].y + ((y + 0.5) / height) * (box[2].y - box[0].y)];
  await on.mouse.move(...at);
  return at;
}

/** What the open trace shows; null: none is open. */
const openTrace = (on) => on.evaluate(() => {
  const dialog = document.querySelector('dialog[open]');
  return dialog && { title: dialog.getAttribute('aria-label'), note: dialog.querySelector('.note')?.textContent,
    command: dialog.querySelector('.command').textContent, text: dialog.querySelector('.text')?.textContent };
});
/** What the program prints for the command of a trace. */
const printed = (command) => execFileSync(program, [...command.replace(/^ninebit /, '').split(' '), '--quiet'], { cwd: root }).toString();

test('a wrong pixel says its values and cause, and a click opens its trace', async () => {
  const [row] = answer.rows;
  const [worst] = row.errors.worst;
  const at = await pointAt('.maps canvas', worst.x, worst.y);
  const said = () => page.$$eval('[role=status]', (lines) => lines[1].textContent);
  assert.match(await said(), new RegExp(`^${row.name}, pixel ${worst.x},${worst.y}: \\d+, \\d+, \\d+, falsely (lit|shadowed): ${worst.cause}$`));
  await page.mouse.click(...at);
  const trace = await openTrace(page);
  assert.equal(trace.title, `${row.name}, pixel ${worst.x},${worst.y}: ${worst.cause}`);
  assert.equal(trace.note, undefined);
  assert.equal(trace.command, worst.command);
  assert.equal(trace.text, printed(worst.command));
  assert.match(trace.text, /the pixel is wrong/);
  await page.keyboard.press('Escape');
  assert.equal(await openTrace(page), null);
  // A pixel that is right has no trace.
  const corner = await pointAt('.maps canvas', 1, 1);
  assert.match(await said(), /pixel 1,1: \d+, \d+, \d+, right$/);
  await page.mouse.click(...corner);
  assert.equal(await openTrace(page), null);
});

test('another wrong pixel gives its own command beside the nearest trace of its cause', async () => {
  const [row] = answer.rows;
  const other = await page.evaluate(async (listed) => {
    const data = JSON.parse(document.getElementById('data').textContent), [width, height] = data.size;
    const picture = new Image();
    picture.src = data.rows[0].wrong_pixels;
    await picture.decode();
    const context = new OffscreenCanvas(width, height).getContext('2d');
    context.drawImage(picture, 0, 0);
    const { data: rgba } = context.getImageData(0, 0, width, height);
    const causeAt = (x, y) => data.causes[rgba[4 * (y * width + x)] & 127];
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        if (causeAt(x, y) !== 'none' && !listed.some((one) => one.x === x && one.y === y)) return { x, y, cause: causeAt(x, y) };
      }
    }
    return null;
  }, row.errors.worst);
  const far = ({ x, y }) => Math.hypot(x - other.x, y - other.y);
  const [worst] = row.errors.worst.filter(({ cause }) => cause === other.cause).sort((one, two) => far(one) - far(two));
  await page.mouse.click(...(await pointAt('.maps canvas', other.x, other.y)));
  const trace = await openTrace(page);
  assert.equal(trace.title, `${row.name}, pixel ${other.x},${other.y}: ${other.cause}`);
  assert.match(trace.note, new RegExp(`nearest one of its cause, pixel ${worst.x},${worst.y}\\.$`));
  assert.equal(trace.command, worst.command.replace(/--pixel \S+/, `--pixel ${other.x},${other.y}`));
  assert.equal(trace.text, printed(worst.command));
  const [close] = await page.$$('dialog[open] button');
  await close.click();
  assert.equal(await openTrace(page), null);
});

test('a drag opens no trace, wherever it ends', async () => {
  const [row] = answer.rows;
  const { x, y } = row.errors.worst.find(({ cause }) => cause === 'joint');  // wrong in both pictures
  for (const selector of ['.swipe', '.maps canvas']) {
    await pointAt(selector, 80, 60);
    await page.mouse.down();
    const at = await pointAt(selector, x, y);
    await page.mouse.up();
    assert.equal(await openTrace(page), null, selector);
    await page.mouse.click(...at);
    assert.match((await openTrace(page)).title, new RegExp(`pixel ${x},${y}: joint$`), selector);
    await page.keyboard.press('Escape');
  }
});

test('the keyboard reaches all traces', async () => {
  const [row] = answer.rows;
  const buttons = await page.$$('.maps figure:first-child .traces button');
  assert.equal(buttons.length, row.errors.worst.length);
  await buttons[1].focus();
  await page.keyboard.press('Enter');
  assert.equal((await openTrace(page)).command, row.errors.worst[1].command);
  assert.equal(await page.evaluate(() => document.activeElement.textContent), 'Close');
  await page.keyboard.press('Enter');
  assert.equal(await openTrace(page), null);
  assert.equal(await page.evaluate(() => document.activeElement.textContent), `${row.errors.worst[1].cause} ${row.errors.worst[1].x},${row.errors.worst[1].y}`);
});

test('the error pictures of a report say the same', async () => {
  const out = join(folder, 'shadows');
  const size = [400, 300];
  const { worst } = native(root, 'study', 'shadows', 'scenes/index_room.gltf', '--size', size.join('x'), '--map-sizes', '32,64', '-o', out);
  const report = await browser.newPage();
  await report.setViewport({ width: 380, height: 900 });  // the pictures are shown smaller than they are
  await report.goto(`file://${join(out, 'report.html')}`);
  await report.waitForSelector('#picture-1 [role=status]');
  // The best point's picture comes first, and then the worst one's: the smaller map.
  const one = worst.find(({ point }) => point === 0);
  assert.ok(await report.$eval('#picture-1 img', (picture) => picture.clientWidth < picture.naturalWidth));
  const at = await pointAt('#picture-1 img', one.x, one.y, report, size);
  const said = await report.$eval('#picture-1 [role=status]', (line) => line.textContent);
  assert.match(said, new RegExp(`^The worst point: .*, pixel ${one.x},${one.y}: \\d+, \\d+, \\d+, falsely (lit|shadowed): ${one.cause}$`));
  await report.mouse.click(...at);
  // A click has a whole place on the screen, where a pixel of the picture is smaller.
  const trace = await openTrace(report), pixel = /--pixel (\d+),(\d+)/;
  assert.equal(trace.command.replace(pixel, ''), one.command.replace(pixel, ''));
  const [, x, y] = pixel.exec(trace.command);
  assert.ok(Math.abs(x - one.x) <= 1 && Math.abs(y - one.y) <= 1, `${trace.command}: ${one.x},${one.y}`);
  assert.match(trace.text, /the pixel is wrong/);
  await report.keyboard.press('Escape');
  const listed = worst.filter(({ point }) => point === 0);
  assert.equal((await report.$$('#picture-1 .traces button')).length, listed.length);
  await report.click('#picture-1 .traces button');
  assert.equal((await openTrace(report)).text, printed(listed[0].command));
  await report.close();
});

test('on A4, nothing is wider than the paper, and tables are whole', async () => {
  const report = join(folder, 'report');
  native(root, 'study', 'index-steps', '--profile', 'float-shader', '-o', report);
  for (const file of [join(folder, 'index.html'), join(report, 'report.html')]) {
    const paper = await browser.newPage();
    await paper.emulateMediaType('print');
    await paper.setViewport({ width: 703, height: 1000 });  // 186 mm
    await paper.goto(`file://${file}`);
    await paper.waitForSelector('table');
    const wide = await paper.$$eval('body *', (all) => all.filter((one) => one.getClientRects().length > 0 && !one.closest('svg, .swipe') &&
      one.getBoundingClientRect().right > document.documentElement.clientWidth + 1).map((one) => `${one.tagName}.${one.className}`));
    assert.deepEqual(wide, [], file);
    assert.deepEqual(await paper.$$eval('table.cut', (tables) => tables.filter((table) => [...table.tBodies[0].rows].some((row) => row.offsetHeight === 0)).length), 0);
    await paper.close();
  }
});

test('the two pictures are told apart at the divider', async () => {
  const said = () => page.$$eval('[role=status]', (lines) => lines[0].textContent);
  await pointAt('.swipe', 20, 60);
  assert.ok((await said()).startsWith(`${answer.rows[0].name}, pixel 20,60: `));
  await pointAt('.swipe', 140, 60);
  assert.ok((await said()).startsWith(`${answer.rows[1].name}, pixel 140,60: `));
});
