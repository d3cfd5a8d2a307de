/** PNG files of any kind, written for the tests. */
import { crc32, deflateSync } from 'node:zlib';

/** The checksum of a chunk; node's zlib has it only in later versions. */
function checksum(bytes) {
  if (crc32) return crc32(bytes);
  let sum = ~0;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; bit++) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum >>> 0;
}

export function chunk(name, data) {
  const body = Buffer.concat([Buffer.from(name), Buffer.from(data)]);
  const length = Buffer.alloc(4);
  length.writeUInt32BE(data.length);
  const sum = Buffer.alloc(4);
  sum.writeUInt32BE(checksum(body));
  return Buffer.concat([length, body, sum]);
}

/** A row without its filter. */
function packed(samples, depth) {
  const row = Buffer.alloc(Math.ceil(samples.length * depth / 8));
  samples.forEach((sample, at) => {
    if (depth === 16) row.writeUInt16BE(sample, 2 * at);
    else row[at * depth >> 3] |= sample << (8 - depth - (at * depth & 7));
  });
  return row;
}

const paeth = (a, b, c) => [a, b, c].reduce((best, one) => (Math.abs(a + b - c - one) < Math.abs(a + b - c - best) ? one : best));

/** The row with a filter, behind its number. */
function filtered(type, row, above, step) {
  const out = Buffer.from([type, ...row]);
  for (let at = 0; at < row.length; at++) {
    const [a, b, c] = [row[at - step] ?? 0, above[at] ?? 0, above[at - step] ?? 0];
    out[at + 1] = row[at] - [0, a, b, (a + b) >> 1, paeth(a, b, c)][type];
  }
  return out;
}

const adam7 = [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];

/**
 * @param {{width: number, height: number, depth?: number, type?: number, interlaced?: boolean, palette?: number[], transparent?: number[]}} kind
 *   `type`: 0 grey, 2 RGB, 3 palette, 4 grey with alpha, 6 RGBA; `transparent`: the bytes of the chunk tRNS
 * @param {(x: number, y: number, channel: number) => number} sample reduced to the depth
 */
export function pngOf({ width, height, depth = 8, type = 6, interlaced = false, palette, transparent }, sample) {
  const channels = { 0: 1, 2: 3, 3: 1, 4: 2, 6: 4 }[type];
  const rows = [];
  for (const [left, top, across, down] of interlaced ? adam7 : [[0, 0, 1, 1]]) {
    let above = Buffer.alloc(0);
    for (let y = top; y < height && left < width; y += down) {
      const samples = [];
      for (let x = left; x < width; x += across) for (let c = 0; c < channels; c++) samples.push(sample(x, y, c) % 2 ** depth);
      const row = packed(samples, depth);
      rows.push(filtered(y % 5, row, above, Math.max(1, channels * depth / 8)));
      above = row;
    }
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([depth, type, 0, 0, interlaced ? 1 : 0], 8);
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', header), palette ? chunk('PLTE', palette) : Buffer.alloc(0),
    transparent ? chunk('tRNS', transparent) : Buffer.alloc(0), chunk('IDAT', deflateSync(Buffer.concat(rows))), chunk('IEND', [])]);
}

/** A square RGBA picture whose colours stay where alpha is 0. */
export const picture = (side) => pngOf({ width: side, height: side }, (x, y, c) => [(x * 37 + y) & 255, (y * 11) & 255, (x ^ y) & 255, (x * 4) & 255][c]);
