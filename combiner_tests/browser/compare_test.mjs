/**
 * The page of `ninebit compare`, and the report of `ninebit study shadows`: what stands at a pixel, and the command that
 * explains a wrong one.
 */
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { launch, native, root } from './support.mjs';

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

test('a wrong pixel says its values and cause, and a click gives its command', async () => {
  const [row] = answer.rows;
  const [worst] = row.errors.worst;
  const at = await pointAt('.maps canvas', worst.x, worst.y);
  const said = () => page.$$eval('[role=status]', (lines) => lines[1].textContent);
  assert.match(await said(), new RegExp(`^${row.name}, pixel ${worst.x},${worst.y}: \\d+, \\d+, \\d+, falsely (lit|shadowed): ${worst.cause}$`));
  await page.mouse.click(...at);
  const command = await page.$$eval('.command', (all) => all[1].textContent);
  assert.equal(command, worst.command);
  assert.equal(native(root, ...command.replace(/^ninebit /, '').split(' ')).command, 'trace');
  // A pixel that is right has no command.
  const corner = await pointAt('.maps canvas', 1, 1);
  assert.match(await said(), /pixel 1,1: \d+, \d+, \d+, right$/);
  await page.mouse.click(...corner);
  assert.equal(await page.$$eval('.command', (all) => all[1].hidden), true);
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
  const command = await report.$eval('#picture-1 .command', ({ textContent }) => textContent), pixel = /--pixel (\d+),(\d+)/;
  assert.equal(command.replace(pixel, ''), one.command.replace(pixel, ''));
  const [, x, y] = pixel.exec(command);
  assert.ok(Math.abs(x - one.x) <= 1 && Math.abs(y - one.y) <= 1, `${command}: ${one.x},${one.y}`);
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
