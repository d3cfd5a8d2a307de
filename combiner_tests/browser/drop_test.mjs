/** Files that are dropped on the page. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { crc32, deflateSync } from 'node:zlib';
import { nativeHash, onePage, root, stateOf, waitForHash } from './support.mjs';

const page = await onePage();

/** The checksum of a PNG chunk; node's zlib has it only in later versions. */
function checksum(bytes) {
  if (crc32) return crc32(bytes);
  let sum = ~0;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; bit++) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum >>> 0;
}

/** A PNG whose colours stay where alpha is 0. */
function picture(side) {
  const rows = [];
  for (let y = 0; y < side; y++) {
    rows.push(0);
    for (let x = 0; x < side; x++) rows.push((x * 37 + y) & 255, (y * 11) & 255, (x ^ y) & 255, (x * 4) & 255);
  }
  const chunk = (name, data) => {
    const body = Buffer.concat([Buffer.from(name), data]);
    const length = Buffer.alloc(4);
    length.writeUInt32BE(data.length);
    const sum = Buffer.alloc(4);
    sum.writeUInt32BE(checksum(body));
    return Buffer.concat([length, body, sum]);
  };
  const header = Buffer.alloc(13);
  header.writeUInt32BE(side, 0);
  header.writeUInt32BE(side, 4);
  header.set([8, 6, 0, 0, 0], 8);
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', header), chunk('IDAT', deflateSync(Buffer.from(rows))),
    chunk('IEND', Buffer.alloc(0))]);
}

/** Drops a file on the picture. `content`: base64, or a number of zero bytes. */
function drop(name, type, content) {
  return page.evaluate(({ file, kind, data }) => {
    const bytes = typeof data === 'number' ? new Uint8Array(data) : Uint8Array.from(atob(data), (character) => character.charCodeAt(0));
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([bytes], file, { type: kind }));
    document.getElementById('picture').dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer }));
  }, { file: name, kind: type, data: content });
}

const message = () => page.$eval('#message', (element) => (element.hidden ? '' : element.textContent));

test('a picture becomes the texture, to the bit, also where alpha is below 255', async () => {
  await page.evaluate(() => globalThis.ninebit.store.change('text', (state) => {
    state.files['programs/sepia.rc1'] = '!!RC1.0\nout.rgb = tex0;\nout.a = tex0.a;\n';
    state.effect.size = [64, 64];
  }));
  const content = picture(64);
  await drop('my picture <b>.png', 'image/png', content.toString('base64'));
  const name = 'dropped/my picture <b>.png';
  await page.waitForFunction((source) => Object.values(globalThis.ninebit.store.state.effect.textures).some((texture) => texture.source === source), {}, name);
  await waitForHash(page, nativeHash(await stateOf(page), { [name]: content }));
});

test('a text becomes the program', async () => {
  const text = '!!RC1.0\nout.rgb = unsigned_invert(tex0);\nout.a = unsigned_invert(zero);\n';
  await drop('program.rc1', '', Buffer.from(text).toString('base64'));
  await page.waitForFunction((wanted) => globalThis.ninebit.store.state.files['programs/sepia.rc1'] === wanted, {}, text);
  assert.equal(await page.evaluate(() => globalThis.ninebit.page.program.editor.view.state.doc.toString()), text);
});

test('a mesh becomes the mesh', async () => {
  const content = readFileSync(join(root, 'scenes/index_room.gltf'));
  await drop('room.gltf', '', content.toString('base64'));
  const name = 'dropped/room.gltf';
  await page.waitForFunction((mesh) => globalThis.ninebit.store.state.effect.scene?.mesh === mesh, {}, name);
  // The room has no texture coordinates.
  await page.evaluate(() => globalThis.ninebit.store.change('inputs', (state) => {
    state.files['programs/sepia.rc1'] = '!!RC1.0\nout.rgb = col0;\nout.a = unsigned_invert(zero);\n';
    Object.assign(state.effect.passes[0], { units: [], primary: 'lambert' });
  }));
  await waitForHash(page, nativeHash(await stateOf(page), { [name]: content, 'dropped/my picture <b>.png': picture(64) }));
});

test('100 MB, a broken picture and a binary file are refused with a message', async () => {
  const before = await stateOf(page);
  const cases = [['large.png', 'image/png', 100_000_000, /large\.png: 100 MB; the page takes 67 MB at most/],
    ['broken.png', 'image/png', Buffer.from('no picture').toString('base64'), /broken\.png: the browser cannot decode it/],
    ['thing.bin', '', 100, /thing\.bin: not a picture, a mesh or a program/]];
  for (const [name, type, content, expected] of cases) {
    await drop(name, type, content);
    await page.waitForFunction((file) => document.getElementById('message').textContent.includes(file), {}, name);
    assert.match(await message(), expected);
  }
  assert.deepEqual(await stateOf(page), before);
});

test('nothing complained', () => assert.deepEqual(page.complaints, []));
