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

/** Drops files on the picture. `content`: base64, or a number of zero bytes. */
function dropAll(files) {
  return page.evaluate((all) => {
    const dataTransfer = new DataTransfer();
    for (const { name, type, content } of all) {
      const bytes = typeof content === 'number' ? new Uint8Array(content) : Uint8Array.from(atob(content), (character) => character.charCodeAt(0));
      dataTransfer.items.add(new File([bytes], name, { type }));
    }
    document.getElementById('picture').dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer }));
  }, files);
}

const drop = (name, type, content) => dropAll([{ name, type, content }]);

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

test('an effect file opens with the files that it names', async () => {
  const effect = JSON.stringify({
    ninebit: 'effect', version: 1, title: 'Captured', profile: 'geforce2', size: [32, 32],
    scene: { mesh: 'draw-001.ply', camera: [0, 0, 3], look_at: [0, 0, 0], fov: 36.86989764584402, light: [-1, 1, 1] },
    textures: { texel0: { source: 'draw-001.texel0.png', filter: 'nearest', wrap: 'clamp-to-edge' } },
    passes: [{ name: 'glBegin', program: 'program-001.gl', primary: 'color', shade: 'flat', depth: null,
      units: [{ texture: 'texel0', coordinates: 'screen' }] }],
  });
  const program = 'glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_INVERT_NV, GL_RGB);\n';
  const mesh = ['ply', 'format ascii 1.0', 'element vertex 4', 'property float x', 'property float y', 'property float z',
    'property uchar red', 'property uchar green', 'property uchar blue', 'property uchar alpha', 'element face 1',
    'property list uchar int vertex_indices', 'end_header', '-1 -1 0 200 90 10 255', '0.5 -1 0 200 90 10 255',
    '0.5 0.5 0 200 90 10 255', '-1 0.5 0 200 90 10 255', '4 0 1 2 3', ''].join('\n');
  const base64 = (text) => Buffer.from(text).toString('base64');
  const files = [
    { name: 'draw-001.json', type: 'application/json', content: base64(effect) },
    { name: 'draw-001.ply', type: '', content: base64(mesh) },
    { name: 'draw-001.texel0.png', type: 'image/png', content: picture(32).toString('base64') },
  ];
  await dropAll(files);
  await page.waitForFunction(() => document.getElementById('message').textContent.includes('draw-001'));
  assert.match(await message(), /draw-001\.json: drop the file program-001\.gl, which it names, together with it/);
  await dropAll([...files, { name: 'program-001.gl', type: '', content: base64(program) }]);
  await page.waitForFunction(() => globalThis.ninebit.store.state.effect.title === 'Captured');
  await waitForHash(page, nativeHash(await stateOf(page), { 'dropped/draw-001.ply': Buffer.from(mesh), 'dropped/draw-001.texel0.png': picture(32) }));
});
