/** Files that are dropped on the page. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { picture } from './png_files.mjs';
import { dropOn, editorText, message, nativeHash, onePage, root, stateOf, waitForHash } from './support.mjs';

const page = await onePage();

const drop = (...files) => dropOn(page, ...files);

test('a picture becomes the texture, to the bit, also where alpha is below 255', async () => {
  await page.evaluate(() => globalThis.ninebit.store.change('text', (state) => {
    state.files['programs/sepia.rc1'] = '!!RC1.0\nout.rgb = tex0;\nout.a = tex0.a;\n';
    state.effect.size = [64, 64];
  }));
  const content = picture(64);
  await drop(['my picture <b>.png', content]);
  const name = 'dropped/my picture <b>.png';
  await page.waitForFunction((source) => Object.values(globalThis.ninebit.store.state.effect.textures).some((texture) => texture.source === source), {}, name);
  await waitForHash(page, nativeHash(await stateOf(page), { [name]: content }));
});

test('a text becomes the program', async () => {
  const text = '!!RC1.0\nout.rgb = unsigned_invert(tex0);\nout.a = unsigned_invert(zero);\n';
  await drop(['program.rc1', text]);
  await page.waitForFunction((wanted) => globalThis.ninebit.store.state.files['programs/sepia.rc1'] === wanted, {}, text);
  assert.equal(await editorText(page), text);
});

test('a mesh becomes the mesh', async () => {
  const content = readFileSync(join(root, 'scenes/index_room.gltf'));
  await drop(['room.gltf', content]);
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
  const cases = [['large.png', 100_000_000, /large\.png: 100 MB; the page takes 67 MB at most/],
    ['broken.png', 'no picture', /broken\.png: the browser cannot decode it/],
    ['thing.bin', 100, /thing\.bin: not a picture, a mesh or a program/]];
  for (const [name, content, expected] of cases) {
    await drop([name, content]);
    await page.waitForFunction((file) => document.getElementById('message').textContent.includes(file), {}, name);
    assert.match(await message(page), expected);
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
  const files = [['draw-001.json', effect], ['draw-001.ply', mesh], ['draw-001.texel0.png', picture(32)]];
  await drop(...files);
  await page.waitForFunction(() => document.getElementById('message').textContent.includes('draw-001'));
  assert.match(await message(page), /draw-001\.json: drop the file program-001\.gl, which it names, together with it/);
  await drop(...files, ['program-001.gl', program]);
  await page.waitForFunction(() => globalThis.ninebit.store.state.effect.title === 'Captured');
  await waitForHash(page, nativeHash(await stateOf(page), { 'dropped/draw-001.ply': Buffer.from(mesh), 'dropped/draw-001.texel0.png': picture(32) }));
});

test('several files that cannot be used are all named', async () => {
  await drop(['one.bin', 100], ['two.bin', 100]);
  await page.waitForFunction(() => /one\.bin: not a picture[^]*two\.bin: not a picture/.test(document.getElementById('message').textContent));
});

test('an effect file that its schema does not allow gets one sentence', async () => {
  const before = await stateOf(page);
  for (const [passes, expected] of [[[null], 'bad.json: passes[0] must be an object'], [[{ program: {} }], 'bad.json: passes[0].program must be a string']]) {
    await drop(['bad.json', JSON.stringify({ ninebit: 'effect', version: 1, passes })]);
    await page.waitForFunction((text) => document.getElementById('message').textContent === text, {}, expected);
  }
  assert.deepEqual(await stateOf(page), before);
});
