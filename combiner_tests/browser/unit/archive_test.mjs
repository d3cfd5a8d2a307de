/** What the page saves: PNG, APNG, ZIP. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { enlarged, png, unpacked, zip } from '../../../src/playground/web/archive.js';
import { decodePng } from '../../../src/playground/web/png.js';

const pixels = (width, height) => Uint8Array.from({ length: width * height * 4 }, (_, at) => at * 37 % 256);
const bytesOf = async (blob) => new Uint8Array(await blob.arrayBuffer());

test('a PNG has the bytes of its picture, alpha included', async () => {
  for (const [width, height] of [[1, 1], [7, 3], [64, 65]]) {
    const found = await decodePng(await bytesOf(await png([pixels(width, height)], width, height)), 1e6);
    assert.deepEqual(found, { width, height, pixels: pixels(width, height) });
  }
});

test('an enlarged picture has blocks', () => {
  const source = pixels(3, 2);
  const large = enlarged(source, 3, 2, 4);
  assert.equal(large.length, 16 * source.length);
  for (let y = 0; y < 8; y++) {
    for (let x = 0; x < 12; x++) {
      const from = (Math.floor(y / 4) * 3 + Math.floor(x / 4)) * 4, to = (y * 12 + x) * 4;
      assert.deepEqual(large.slice(to, to + 4), source.slice(from, from + 4));
    }
  }
  assert.equal(enlarged(source, 3, 2, 1), source);
});

test('an animation has its frames, and its first one is a PNG', async () => {
  const frames = [0, 1, 2].map((n) => pixels(5, 4).map((value) => value ^ n));
  const bytes = await bytesOf(await png(frames, 5, 4, 25));
  assert.deepEqual((await decodePng(bytes, 100)).pixels, frames[0]);
  const names = [];
  const view = new DataView(bytes.buffer);
  for (let at = 8; at < bytes.length; at += 12 + view.getUint32(at)) names.push(String.fromCharCode(...bytes.slice(at + 4, at + 8)));
  assert.deepEqual(names, ['IHDR', 'acTL', 'fcTL', 'IDAT', 'fcTL', 'fdAT', 'fcTL', 'fdAT', 'IEND']);
});

test('a ZIP archive unpacks with another program', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'ninebit-zip-'));
  try {
    const files = [['effect.json', '{}'], ['programs/sepia.rc1', '!!RC1.0\n'], ['dropped/ü.png', 'x'.repeat(70_000)]];
    const file = join(folder, 'a.zip');
    writeFileSync(file, await bytesOf(zip(files.map(([name, text]) => [name, new TextEncoder().encode(text)]))));
    execFileSync('/usr/bin/python3', ['-c', 'import sys, zipfile; z = zipfile.ZipFile(sys.argv[1]); assert z.testzip() is None; z.extractall(sys.argv[2])', file, folder]);
    for (const [name, text] of files) assert.equal(readFileSync(join(folder, name), 'utf8'), text);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test('an archive is unpacked, stored or deflated; a damaged one is refused', async () => {
  const contents = /** @type {[string, Uint8Array][]} */ ([['effect.json', new TextEncoder().encode('{"ninebit": "effect"}')], ['textures/a.png', Uint8Array.from({ length: 300 }, (_, i) => i)]]);
  const stored = new Uint8Array(await zip(contents).arrayBuffer());
  const open = (/** @type {Uint8Array} */ bytes) => unpacked(new File([/** @type {BlobPart} */ (bytes)], 'a.zip'));
  const read = async (/** @type {File[]} */ files) => Promise.all(files.map(async (file) => [file.name, new Uint8Array(await file.arrayBuffer())]));
  const expected = contents;
  assert.deepEqual(await read(await open(stored)), expected);
  const folder = mkdtempSync(join(tmpdir(), 'ninebit-archive-'));
  try {
    execFileSync('/usr/bin/python3', ['-c', `import zipfile\nwith zipfile.ZipFile('${folder}/a.zip', 'w', zipfile.ZIP_DEFLATED) as archive:\n    archive.writestr('effect.json', '{"ninebit": "effect"}')\n    archive.writestr('textures/a.png', bytes(i % 256 for i in range(300)))`]);
    assert.deepEqual(await read(await open(new Uint8Array(readFileSync(`${folder}/a.zip`)))), expected);
  } finally {
    rmSync(folder, { recursive: true });
  }
  const other = new File(['text'], 'a.txt');
  assert.deepEqual(await unpacked(other), [other]);
  for (let size = 4; size < stored.length; size += 7) await assert.rejects(open(stored.slice(0, size)), /a damaged archive: it ends early/);
  for (let at = 4; at < stored.length; at += 3) {
    const changed = stored.slice();
    changed[at] ^= 0xFF;
    // A field that nobody reads may be anything; other changes are found.
    const files = await open(changed).catch((error) => assert.match(String(error), /a\.zip: /));
    if (files) assert.deepEqual(await read(files), expected, `byte ${at}`);
  }
});

/** An archive of one's own settings. @param {string} script Python, which writes into `archive` */
function archiveOf(script) {
  const folder = mkdtempSync(join(tmpdir(), 'ninebit-archive-'));
  try {
    execFileSync('/usr/bin/python3', ['-W', 'ignore', '-c', `import zipfile\nwith zipfile.ZipFile('${folder}/a.zip', 'w', zipfile.ZIP_DEFLATED) as archive:\n    ${script}`]);
    return new Uint8Array(readFileSync(`${folder}/a.zip`));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

test('an archive that the page does not read is refused by the true reason', async () => {
  const refused = (/** @type {Uint8Array} */ bytes, /** @type {RegExp} */ why) => assert.rejects(unpacked(new File([/** @type {BlobPart} */ (bytes)], 'a.zip')), why);
  const twoNames = (/** @type {string} */ a, /** @type {string} */ b) => archiveOf(`archive.writestr('${a}', '1'); archive.writestr('${b}', '2')`);
  await refused(twoNames('a.json', './a.json'), /it has a\.json twice/);
  await refused(twoNames('t/x.png', 't//x.png'), /it has t\/x\.png twice/);
  await refused(twoNames('a.json', '../b.json'), /does not lie in it/);
  const deflated = archiveOf("archive.writestr('a.json', 'text' * 99)"), directory = Buffer.from(deflated).indexOf('PK\x01\x02');
  const changed = (/** @type {number} */ at, /** @type {number[]} */ ...values) => {
    const bytes = deflated.slice();
    bytes.set(values, directory + at);
    return bytes;
  };
  await refused(changed(8, 1), /a\.zip: a\.json is encrypted/);
  await refused(changed(10, 12), /packed in another way/);
  await refused(changed(24, 255, 255, 255, 255), /a\.json is a ZIP64 entry/);
  await refused(changed(24, 1), /a damaged archive: a\.json has other bytes/);
  const end = Buffer.from(deflated).indexOf('PK\x05\x06') - directory;
  await refused(changed(end + 10, 255, 255), /a ZIP64 archive/);
  const large = new File([/** @type {BlobPart} */ (deflated)], 'a.zip');
  Object.defineProperty(large, 'size', { value: 600e6 });
  await assert.rejects(unpacked(large), /a\.zip: it has more than 536 MB/);
  const whole = globalThis.DecompressionStream;
  try {
    globalThis.DecompressionStream = /** @type {any} */ (class { constructor() { throw new TypeError('deflate-raw'); } });
    await refused(deflated, /a\.json: this browser does not unpack it/);
  } finally {
    globalThis.DecompressionStream = whole;
  }
});
