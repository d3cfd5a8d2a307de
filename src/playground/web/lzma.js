/**
 * Unpacks LZMA, as `lzma` and `xz --format=lzma` write it: a quarter smaller than what browsers unpack themselves. The
 * format: a range coder whose probabilities adapt, over literals and matches with lengths and distances.
 */

/** A probability is of 11 bits; it moves by a 32nd of its way. */
const start = 1 << 10, moves = 5;

/** @param {number} count */
const probabilities = (count) => new Uint16Array(count).fill(start);

class RangeDecoder {
  /** @param {Uint8Array} bytes @param {number} at */
  constructor(bytes, at) {
    this.bytes = bytes;
    this.at = at + 1; // the first byte is zero
    this.range = 0xFFFFFFFF;
    this.code = 0;
    for (let count = 0; count < 4; count++) this.code = (this.code << 8 | bytes[this.at++]) >>> 0;
  }

  normalize() {
    if (this.range >= 0x1000000) return;
    if (this.at >= this.bytes.length) throw new Error('the packed engine ends early');
    this.range = (this.range << 8) >>> 0;
    this.code = (this.code << 8 | this.bytes[this.at++]) >>> 0;
  }

  /** @param {Uint16Array} all @param {number} index @returns {number} 0 or 1 */
  bit(all, index) {
    const probability = all[index];
    const bound = (this.range >>> 11) * probability;
    if (this.code < bound) {
      this.range = bound;
      all[index] = probability + ((2048 - probability) >> moves);
      this.normalize();
      return 0;
    }
    this.range = (this.range - bound) >>> 0;
    this.code = (this.code - bound) >>> 0;
    all[index] = probability - (probability >> moves);
    this.normalize();
    return 1;
  }

  /** Bits of one half each, the highest first. @param {number} count */
  direct(count) {
    let value = 0;
    for (let left = count; left > 0; left--) {
      this.range >>>= 1;
      const set = this.code >= this.range ? 1 : 0;
      if (set) this.code = (this.code - this.range) >>> 0;
      value = value << 1 | set;
      this.normalize();
    }
    return value;
  }

  /** A number of so many bits, the highest first, by a tree of probabilities. @param {Uint16Array} all @param {number} from @param {number} count */
  tree(all, from, count) {
    let node = 1;
    for (let left = count; left > 0; left--) node = node << 1 | this.bit(all, from + node);
    return node - (1 << count);
  }

  /** The same, the lowest bit first. @param {Uint16Array} all @param {number} from @param {number} count */
  reverseTree(all, from, count) {
    let node = 1, value = 0;
    for (let at = 0; at < count; at++) {
      const bit = this.bit(all, from + node);
      node = node << 1 | bit;
      value |= bit << at;
    }
    return value;
  }
}

/** The length of a match: 2 to 273. */
class Length {
  constructor() {
    this.choice = probabilities(2);
    this.low = probabilities(16 << 3);
    this.middle = probabilities(16 << 3);
    this.high = probabilities(256);
  }

  /** @param {RangeDecoder} coder @param {number} position */
  read(coder, position) {
    if (!coder.bit(this.choice, 0)) return 2 + coder.tree(this.low, position << 3, 3);
    if (!coder.bit(this.choice, 1)) return 10 + coder.tree(this.middle, position << 3, 3);
    return 18 + coder.tree(this.high, 0, 8);
  }
}

/**
 * @param {Uint8Array} packed with the heading of 13 bytes; the size need not be in it
 * @param {number} size of the result, in bytes
 * @returns {Uint8Array<ArrayBuffer>}
 */
export function unpackLzma(packed, size) {
  const facts = packed[0];
  const contextBits = facts % 9, lowBits = Math.floor(facts / 9) % 5, positionMask = (1 << Math.floor(facts / 45)) - 1;
  const coder = new RangeDecoder(packed, 13);
  const out = new Uint8Array(size);
  const literals = probabilities(0x300 << (contextBits + lowBits));
  const isMatch = probabilities(12 << 4), isRepeat = probabilities(12), isRepeat0 = probabilities(12), isRepeat1 = probabilities(12);
  const isRepeat2 = probabilities(12), isLong0 = probabilities(12 << 4);
  const slots = probabilities(4 << 6), middles = probabilities(128), aligned = probabilities(16);
  const lengths = new Length(), repeated = new Length();
  let state = 0, at = 0;
  /** The last four distances, the newest first. */
  let [d0, d1, d2, d3] = [1, 1, 1, 1];

  const literal = () => {
    const before = at > 0 ? out[at - 1] : 0;
    const from = 0x300 * (((at & ((1 << lowBits) - 1)) << contextBits) + (before >> (8 - contextBits)));
    let node = 1;
    if (state >= 7) {
      // After a match, the byte there says what is likely, until a bit differs.
      let matched = out[at - d0];
      while (node < 0x100) {
        const wanted = matched >> 7 & 1;
        matched <<= 1;
        const bit = coder.bit(literals, from + ((1 + wanted) << 8) + node);
        node = node << 1 | bit;
        if (bit !== wanted) break;
      }
    }
    while (node < 0x100) node = node << 1 | coder.bit(literals, from + node);
    out[at++] = node & 0xFF;
    state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
  };

  const distance = (/** @type {number} */ length) => {
    const slot = coder.tree(slots, Math.min(length - 2, 3) << 6, 6);
    if (slot < 4) return slot + 1;
    const bits = (slot >> 1) - 1;
    const high = (2 | slot & 1) << bits;
    if (slot < 14) return 1 + high + coder.reverseTree(middles, high - slot, bits);
    return 1 + ((high >>> 0) + coder.direct(bits - 4) * 16 + coder.reverseTree(aligned, 0, 4));
  };

  while (at < size) {
    const position = at & positionMask;
    if (!coder.bit(isMatch, (state << 4) + position)) {
      literal();
      continue;
    }
    let length;
    if (!coder.bit(isRepeat, state)) {
      length = lengths.read(coder, position);
      [d3, d2, d1] = [d2, d1, d0];
      d0 = distance(length);
      state = state < 7 ? 7 : 10;
    } else {
      if (!coder.bit(isRepeat0, state)) {
        if (!coder.bit(isLong0, (state << 4) + position)) {
          if (d0 > at) throw new Error('the packed engine is damaged');
          out[at] = out[at - d0];
          at++;
          state = state < 7 ? 9 : 11;
          continue;
        }
      } else if (!coder.bit(isRepeat1, state)) [d0, d1] = [d1, d0];
      else if (!coder.bit(isRepeat2, state)) [d0, d1, d2] = [d2, d0, d1];
      else [d0, d1, d2, d3] = [d3, d0, d1, d2];
      length = repeated.read(coder, position);
      state = state < 7 ? 8 : 11;
    }
    if (d0 > at || at + length > size) throw new Error('the packed engine is damaged');
    for (const end = at + length; at < end; at++) out[at] = out[at - d0];
  }
  return out;
}
