/** How the page holds the engine: LZMA, and bytes as text. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import { unpackLzma } from '../../../src/playground/web/lzma.js';
import { bytesOfText, textOfBytes } from '../../../src/playground/web/text_bytes.js';

const pack = (bytes, filter) => new Uint8Array(execFileSync('/usr/bin/python3', ['-c',
  `import lzma, sys; sys.stdout.buffer.write(lzma.compress(sys.stdin.buffer.read(), format=lzma.FORMAT_ALONE, filters=[${filter}]))`],
{ input: bytes, maxBuffer: 1 << 28 }));
const filters = ['{"id": lzma.FILTER_LZMA1, "preset": 9 | lzma.PRESET_EXTREME}', '{"id": lzma.FILTER_LZMA1, "lc": 0, "lp": 4, "pb": 0}', '{"id": lzma.FILTER_LZMA1, "lc": 4, "lp": 0, "pb": 4}'];

/** Numbers that repeat each time. */
function random(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state >>> 8;
  };
}

test('LZMA unpacks what Python packs', () => {
  const next = random(7);
  const noise = Uint8Array.from({ length: 5000 }, () => next());
  const words = new TextEncoder().encode('register combiner '.repeat(3000));
  // Repeats at many distances, also far ones.
  const mixed = new Uint8Array(300_000);
  for (let at = 0; at < mixed.length; at++) mixed[at] = next() % 50 ? mixed[Math.max(0, at - 1 - next() % 290_000)] : next();
  for (const bytes of [Uint8Array.of(1), noise, words, mixed, new Uint8Array(100_000)]) {
    for (const filter of filters) assert.deepEqual(unpackLzma(pack(bytes, filter), bytes.length), bytes);
  }
});

test('a packed text that is damaged is an error', () => {
  const bytes = new TextEncoder().encode('register combiner '.repeat(100));
  const packed = pack(bytes, filters[0]);
  assert.throws(() => unpackLzma(packed.slice(0, 25), bytes.length), /ends early|damaged/);
  let found = 0;
  for (let at = 13; at < packed.length - 6; at++) {
    const wrong = packed.slice();
    wrong[at] ^= 0x55;
    try {
      if (Buffer.compare(unpackLzma(wrong, bytes.length), bytes) !== 0) found++;
    } catch {
      found++;
    }
  }
  assert.ok(found > packed.length - 30);
});

test('bytes as text come back, without what HTML changes', () => {
  const next = random(1);
  for (const length of [0, 1, 6, 7, 8, 9, 20_000]) {
    const bytes = Uint8Array.from({ length }, () => next());
    const text = textOfBytes(bytes);
    assert.doesNotMatch(text, /[\0\r<]/);
    assert.deepEqual(bytesOfText(text), bytes);
  }
});
