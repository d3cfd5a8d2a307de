/**
 * The texels of a PNG file, to the bit: a browser's own decoder may multiply colours by alpha or manage them.
 * PNG specification, third edition: https://www.w3.org/TR/png-3/
 */

const signature = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];

/** Channels and depths of each colour type. */
const types = new Map([[0, { channels: 1, depths: [1, 2, 4, 8, 16] }], [2, { channels: 3, depths: [8, 16] }], [3, { channels: 1, depths: [1, 2, 4, 8] }],
  [4, { channels: 2, depths: [8, 16] }], [6, { channels: 4, depths: [8, 16] }]]);

/** The first column, first row and their steps of Adam7's passes. */
const adam7 = [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];

/** @param {Uint8Array} bytes */
export const isPng = (bytes) => signature.every((byte, at) => bytes[at] === byte);

const table = Uint32Array.from({ length: 256 }, (_, byte) => {
  let sum = byte;
  for (let bit = 0; bit < 8; bit++) sum = sum & 1 ? 0xedb88320 ^ (sum >>> 1) : sum >>> 1;
  return sum;
});

/** CRC-32, the checksum of PNG and of ZIP. @param {Uint8Array[]} parts */
export function crc32(...parts) {
  let sum = ~0;
  for (const part of parts) for (const byte of part) sum = table[(sum ^ byte) & 255] ^ (sum >>> 8);
  return ~sum >>> 0;
}

/** @typedef {{IHDR: Uint8Array|null, PLTE: Uint8Array|null, tRNS: Uint8Array|null, IDAT: Uint8Array[]}} Chunks */

/** The chunks that decide texels. @param {Uint8Array} bytes */
function chunksOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  /** @type {Chunks} */
  const chunks = { IHDR: null, PLTE: null, tRNS: null, IDAT: [] };
  for (let at = signature.length; at + 12 <= bytes.length;) {
    const end = at + 8 + view.getUint32(at);
    const name = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    if (end + 4 > bytes.length) break;
    if (name === 'IEND') return chunks;
    if (name in chunks) {
      if (crc32(bytes.subarray(at + 4, end)) !== view.getUint32(end)) throw new Error(`the checksum of its chunk ${name} is wrong`);
      const data = bytes.subarray(at + 8, end);
      if (name === 'IDAT') chunks.IDAT.push(data);
      else chunks[/** @type {'IHDR'|'PLTE'|'tRNS'} */ (name)] = data;
    }
    at = end + 4;
  }
  throw new Error('it ends early');
}

/** @param {Uint8Array[]} parts @param {number} size */
async function inflated(parts, size) {
  const out = new Uint8Array(size);
  const reader = new Blob(/** @type {BlobPart[]} */ (parts)).stream().pipeThrough(new DecompressionStream('deflate')).getReader();
  let at = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done && at === size) return out;
    if (done || at + value.length > size) throw new Error('it has more or fewer texels than its header says');
    out.set(value, at);
    at += value.length;
  }
}

/** Undoes a row's filter. @param {number} type @param {Uint8Array} row @param {Uint8Array} above @param {number} step the bytes of a texel */
function unfilter(type, row, above, step) {
  if (type > 4) throw new Error(`${type} is not a filter`);
  for (let at = 0; at < row.length; at++) {
    const a = at >= step ? row[at - step] : 0, b = above[at], c = at >= step ? above[at - step] : 0;
    if (type === 1) row[at] += a;
    else if (type === 2) row[at] += b;
    else if (type === 3) row[at] += (a + b) >> 1;
    else if (type === 4) {
      const [da, db, dc] = [Math.abs(b - c), Math.abs(a - c), Math.abs(a + b - 2 * c)];
      row[at] += da <= db && da <= dc ? a : db <= dc ? b : c;
    }
  }
}

/** The header's facts, checked. @param {Chunks} chunks */
function headerOf({ IHDR, PLTE }) {
  if (IHDR?.length !== 13) throw new Error('its header is missing');
  const view = new DataView(IHDR.buffer, IHDR.byteOffset, 13);
  const [width, height] = [view.getUint32(0), view.getUint32(4)];
  const [depth, type, compression, filter, interlace] = IHDR.subarray(8);
  const kind = types.get(type);
  if (!kind?.depths.includes(depth) || compression || filter || interlace > 1) throw new Error('its header has a value that PNG does not have');
  if (width === 0 || height === 0) throw new Error('it has no texels');
  if (type === 3 && !PLTE) throw new Error('its palette is missing');
  return { width, height, depth, type, channels: kind.channels, passes: interlace ? adam7 : [[0, 0, 1, 1]] };
}

/**
 * A function that writes the RGBA bytes of a texel whose samples are given.
 * @param {{depth: number, type: number, channels: number}} header
 * @param {Chunks} chunks
 */
function writer({ depth, type, channels }, { PLTE, tRNS }) {
  const most = 2 ** depth - 1;
  const byte = (/** @type {number} */ sample) => Math.round(sample * 255 / most);
  const key = tRNS && type < 3 ? [...Array(channels).keys()].map((at) => tRNS[2 * at] << 8 | tRNS[2 * at + 1]) : null;
  return (/** @type {Uint16Array} */ samples, /** @type {Uint8Array} */ out, /** @type {number} */ to) => {
    if (type === 3) {
      const [index] = samples;
      if (!PLTE || 3 * index + 2 >= PLTE.length) throw new Error(`its palette has no colour ${index}`);
      out.set(PLTE.subarray(3 * index, 3 * index + 3), to);
      out[to + 3] = tRNS?.[index] ?? 255;
      return;
    }
    const grey = channels < 3;
    for (let c = 0; c < 3; c++) out[to + c] = byte(samples[grey ? 0 : c]);
    if (channels % 2 === 0) out[to + 3] = byte(samples[channels - 1]);
    else out[to + 3] = key?.every((value, at) => value === samples[at]) ? 0 : 255;
  };
}

/**
 * Samples of 16 bits are rounded to 8, as `ninebit` does it.
 * @param {Uint8Array} bytes
 * @param {number} mostTexels
 * @returns {Promise<{width: number, height: number, pixels: Uint8Array}>} RGBA8, rows from the top
 */
export async function decodePng(bytes, mostTexels) {
  const chunks = chunksOf(bytes);
  const header = headerOf(chunks);
  const { width, height, depth, channels } = header;
  if (width * height > mostTexels) throw new RangeError(`it has ${width} x ${height} texels; expected ${mostTexels} at most`);
  const passes = header.passes.map(([x, y, across, down]) => {
    const columns = Math.ceil((width - x) / across), rows = columns > 0 ? Math.ceil((height - y) / down) : 0;
    return { x, y, across, down, columns, rows: Math.max(0, rows), line: Math.ceil(columns * channels * depth / 8) };
  });
  const data = await inflated(chunks.IDAT, passes.reduce((sum, { rows, line }) => sum + rows * (1 + line), 0));
  const pixels = new Uint8Array(width * height * 4);
  const write = writer(header, chunks);
  const step = Math.max(1, channels * depth / 8);
  const samples = new Uint16Array(channels);
  let at = 0;
  for (const { x, y, across, down, columns, rows, line } of passes) {
    let above = new Uint8Array(line);
    for (let r = 0; r < rows; r++, at += 1 + line) {
      const row = data.subarray(at + 1, at + 1 + line);
      unfilter(data[at], row, above, step);
      for (let column = 0; column < columns; column++) {
        for (let c = 0; c < channels; c++) {
          const n = column * channels + c;
          if (depth === 8) samples[c] = row[n];
          else if (depth === 16) samples[c] = row[2 * n] << 8 | row[2 * n + 1];
          else samples[c] = row[n * depth >> 3] >> (8 - depth - (n * depth & 7)) & (2 ** depth - 1);
        }
        write(samples, pixels, 4 * ((y + r * down) * width + x + column * across));
      }
      above = row;
    }
  }
  return { width, height, pixels };
}
