/**
 * Files that the page writes: pictures as PNG to the bit, animations as APNG, several files as a ZIP archive. Archives are
 * read, too.
 */
import { plainPath } from './files.js';
import { crc32 } from './png.js';

/** Whole numbers as bytes. @param {boolean} little the lowest byte first @param {...[number, number]} fields sizes in bytes, and values */
function bytesOf(little, ...fields) {
  const bytes = new Uint8Array(fields.reduce((sum, [size]) => sum + size, 0));
  const view = new DataView(bytes.buffer);
  let at = 0;
  for (const [size, value] of fields) {
    if (size === 1) view.setUint8(at, value);
    else if (size === 2) view.setUint16(at, value, little);
    else view.setUint32(at, value, little);
    at += size;
  }
  return bytes;
}

/** @param {...[number, number]} fields */
const bigEndian = (...fields) => bytesOf(false, ...fields);
/** @param {...[number, number]} fields */
const littleEndian = (...fields) => bytesOf(true, ...fields);
/** @param {string} text */
const ascii = (text) => new TextEncoder().encode(text);

/** The bytes deflated with zlib's heading. @param {Uint8Array<ArrayBuffer>} bytes */
async function deflated(bytes) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new CompressionStream('deflate'))).arrayBuffer());
}

/** @param {string} name @param {...Uint8Array} data @returns {Uint8Array[]} */
function chunk(name, ...data) {
  const kind = ascii(name);
  const length = data.reduce((sum, part) => sum + part.length, 0);
  return [bigEndian([4, length]), kind, ...data, bigEndian([4, crc32(kind, ...data)])];
}

/** A picture, RGBA8 from the top, enlarged to blocks. @param {Uint8Array} pixels @param {number} width @param {number} height @param {number} times */
export function enlarged(pixels, width, height, times) {
  if (times === 1) return pixels;
  const from = new Uint32Array(pixels.slice().buffer);
  const to = new Uint32Array(width * height * times * times);
  for (let y = 0; y < height * times; y++) {
    for (let x = 0; x < width * times; x++) to[y * width * times + x] = from[Math.floor(y / times) * width + Math.floor(x / times)];
  }
  return new Uint8Array(to.buffer);
}

/** The rows of a picture, each behind its filter (none), deflated. @param {Uint8Array} pixels @param {number} width @param {number} height */
function rowsOf(pixels, width, height) {
  const rows = new Uint8Array((width * 4 + 1) * height);
  for (let y = 0; y < height; y++) rows.set(pixels.subarray(y * width * 4, (y + 1) * width * 4), y * (width * 4 + 1) + 1);
  return deflated(rows);
}

/**
 * One picture as PNG, or several as APNG.
 * @param {Uint8Array[]} frames RGBA8 from the top
 * @param {number} width
 * @param {number} height
 * @param {number} [rate] frames a second
 * @returns {Promise<Blob>}
 */
export async function png(frames, width, height, rate = 30) {
  const parts = [Uint8Array.of(137, 80, 78, 71, 13, 10, 26, 10), ...chunk('IHDR', bigEndian([4, width], [4, height], [1, 8], [1, 6], [1, 0], [1, 0], [1, 0]))];
  if (frames.length > 1) parts.push(...chunk('acTL', bigEndian([4, frames.length], [4, 0])));
  let sequence = 0;
  for (const [number, frame] of frames.entries()) {
    const data = await rowsOf(frame, width, height);
    if (frames.length > 1) parts.push(...chunk('fcTL', bigEndian([4, sequence++], [4, width], [4, height], [4, 0], [4, 0], [2, 1], [2, rate], [1, 0], [1, 0])));
    if (number === 0) parts.push(...chunk('IDAT', data));
    else parts.push(...chunk('fdAT', bigEndian([4, sequence++]), data));
  }
  parts.push(...chunk('IEND'));
  return new Blob(/** @type {BlobPart[]} */ (parts), { type: frames.length > 1 ? 'image/apng' : 'image/png' });
}

/**
 * Files as a ZIP archive, not compressed.
 * @param {[string, Uint8Array][]} files names and contents
 * @returns {Blob}
 */
export function zip(files) {
  /** @type {Uint8Array[]} */
  const parts = [], directory = [];
  let at = 0;
  for (const [name, content] of files) {
    const words = ascii(name);
    // Version 2.0, names in UTF-8, stored; a date that is the same in each archive: 1 January 2000.
    /** @type {[number, number][]} */
    const facts = [[2, 20], [2, 0x800], [2, 0], [2, 0], [2, (20 << 9) | (1 << 5) | 1], [4, crc32(content)], [4, content.length], [4, content.length], [2, words.length], [2, 0]];
    const heading = littleEndian([4, 0x04034B50], ...facts);
    directory.push(littleEndian([4, 0x02014B50], [2, 20], ...facts, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]), words);
    parts.push(heading, words, content);
    at += heading.length + words.length + content.length;
  }
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  const end = littleEndian([4, 0x06054B50], [2, 0], [2, 0], [2, files.length], [2, files.length], [4, size], [4, at], [2, 0]);
  return new Blob(/** @type {BlobPart[]} */ ([...parts, ...directory, end]), { type: 'application/zip' });
}

/** The most files of an archive, and the most bytes that it unpacks to. */
const mostFiles = 4096, mostUnpacked = 512 * 1024 * 1024;

/**
 * @param {Uint8Array} packed
 * @param {number} size of the content
 * @returns {Promise<Uint8Array<ArrayBuffer>|undefined>} `undefined`: it is damaged
 */
async function inflated(packed, size) {
  let stream, bytes;
  try {
    stream = new DecompressionStream('deflate-raw');
  } catch {
    throw new Error('this browser does not unpack it; unpack the archive and drop its files');
  }
  try {
    bytes = new Uint8Array(size);
  } catch {
    throw new Error(`there is no memory for its ${size} bytes`);
  }
  const reader = new Blob([/** @type {BlobPart} */ (packed)]).stream().pipeThrough(stream).getReader();
  for (let at = 0; ;) {
    const part = await reader.read().catch(() => undefined);
    if (!part || at + (part.value?.length ?? 0) > size) return undefined;
    if (part.done) return bytes.subarray(0, at);
    bytes.set(part.value, at);
    at += part.value.length;
  }
}

/**
 * The files of a ZIP archive, whose names are their paths in it; any other file as it is.
 * @param {File} file
 * @returns {Promise<File[]>}
 */
export async function unpacked(file) {
  if (await file.slice(0, 4).text() !== 'PK\x03\x04') return [file];
  const refused = (/** @type {string} */ why) => new Error(`${file.name}: ${why}`);
  const wrong = (/** @type {string} */ what) => refused(`a damaged archive: ${what}`);
  if (file.size > mostUnpacked) throw refused(`it has more than ${Math.floor(mostUnpacked / 1e6)} MB`);
  const bytes = new Uint8Array(await file.arrayBuffer()), view = new DataView(bytes.buffer);
  let end = bytes.length - 22;
  while (end >= 0 && view.getUint32(end, true) !== 0x06054B50) end--;
  if (end < 0) throw wrong('it ends early');
  const count = view.getUint16(end + 10, true), directory = view.getUint32(end + 16, true);
  if (count === 0xFFFF || directory === 0xFFFFFFFF) throw refused('it is a ZIP64 archive, which the page does not read');
  if (count > mostFiles) throw refused(`the page takes at most ${mostFiles} files of an archive`);
  /** @type {Map<string, File>} */
  const files = new Map();
  for (let number = 0, at = directory, total = 0; number < count; number++) {
    if (at + 46 > end || view.getUint32(at, true) !== 0x02014B50) throw wrong('its directory is not whole');
    const flags = view.getUint16(at + 8, true), method = view.getUint16(at + 10, true), crc = view.getUint32(at + 16, true);
    const packedSize = view.getUint32(at + 20, true), size = view.getUint32(at + 24, true), local = view.getUint32(at + 42, true);
    const named = bytes.subarray(at + 46, at + 46 + view.getUint16(at + 28, true));
    at += 46 + named.length + view.getUint16(at + 30, true) + view.getUint16(at + 32, true);
    if (at > end) throw wrong('its directory is not whole');
    const name = new TextDecoder().decode(named);
    if (name.endsWith('/')) continue;
    const path = plainPath(name);
    if (!path || name.startsWith('/') || /[\\\0]/.test(name) || name.split('/').includes('..')) throw refused(`it names ${JSON.stringify(name)}, which does not lie in it`);
    if (files.has(path)) throw refused(`it has ${path} twice`);
    if (flags & 1) throw refused(`${name} is encrypted`);
    if ([packedSize, size, local].includes(0xFFFFFFFF)) throw refused(`${name} is a ZIP64 entry, which the page does not read`);
    if (method !== 0 && method !== 8) throw refused(`${name} is packed in another way than by deflate`);
    total += size;
    if (total > mostUnpacked) throw refused(`it has more than ${Math.floor(mostUnpacked / 1e6)} MB unpacked`);
    if (local + 30 > bytes.length || view.getUint32(local, true) !== 0x04034B50) throw wrong(`${name} is not there`);
    const itsName = bytes.subarray(local + 30, local + 30 + view.getUint16(local + 26, true));
    if (itsName.length !== named.length || itsName.some((byte, i) => byte !== named[i])) throw wrong(`${name} has another name in its heading`);
    const first = local + 30 + itsName.length + view.getUint16(local + 28, true);
    if (first + packedSize > bytes.length) throw wrong(`${name} ends early`);
    const packed = bytes.subarray(first, first + packedSize);
    const content = method === 0 ? packed : await inflated(packed, size).catch((error) => { throw refused(`${name}: ${error.message}`); });
    if (content?.length !== size || crc32(content) !== crc) throw wrong(`${name} has other bytes than it should`);
    files.set(path, new File([/** @type {BlobPart} */ (content)], path, { type: /\.png$/i.test(path) ? 'image/png' : '' }));
  }
  return [...files.values()];
}
