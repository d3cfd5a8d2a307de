/**
 * Bytes as a text that an HTML page can hold: seven bits a character of one byte, where base64 has six. The three
 * characters that HTML would change or could end a script with have others in their place.
 */

/** U+0000 becomes another character, carriage returns become line feeds, and < may begin a tag. */
const special = [0, 13, 60], first = 0x100;

/** @param {Uint8Array} bytes @returns {string} */
export function textOfBytes(bytes) {
  /** @type {string[]} */
  const parts = [];
  let held = 0, bits = 0;
  const put = (/** @type {number} */ value) => {
    const at = special.indexOf(value);
    parts.push(String.fromCharCode(at < 0 ? value : first + at));
  };
  for (const byte of bytes) {
    held = held << 8 | byte;
    bits += 8;
    while (bits >= 7) {
      bits -= 7;
      put(held >> bits & 127);
    }
    held &= 127;
  }
  if (bits) put(held << (7 - bits) & 127);
  return parts.join('');
}

/** @param {string} text @returns {Uint8Array} */
export function bytesOfText(text) {
  const bytes = new Uint8Array(Math.floor(text.length * 7 / 8));
  let held = 0, bits = 0, to = 0;
  for (let at = 0; at < text.length; at++) {
    const code = text.charCodeAt(at);
    held = (held << 7 | (code < 128 ? code : special[code - first])) & 0x7FFF;
    bits += 7;
    if (bits < 8) continue;
    bits -= 8;
    bytes[to++] = held >> bits & 255;
  }
  return bytes;
}
