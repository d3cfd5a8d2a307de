/**
 * The engine in its worker, behind the engine's own script, which defines `createNinebit`. One request in, one answer out;
 * the first message starts the engine and holds its WebAssembly, packed.
 *
 * A request is `{id, request, bytes?}`; an answer is `{id, answer, bytes?}`, or `{id, crash}` with what broke.
 */

import { unpackLzma } from './lzma.js';
import { bytesOfText } from './text_bytes.js';

/** @type {{engine: any}} */
const state = { engine: null };

const worker = /** @type {any} */ (self);

/** A text in the engine's memory, ended by a zero. @param {string} text @returns {number} */
function textInMemory(text) {
  const { engine } = state;
  const bytes = new TextEncoder().encode(text);
  const at = engine._malloc(bytes.length + 1);
  engine.HEAPU8.set(bytes, at);
  engine.HEAPU8[at + bytes.length] = 0;
  return at;
}

/** The text at a place of the engine's memory. @param {number} at */
function textAt(at) {
  const { HEAPU8 } = state.engine;
  return new TextDecoder().decode(HEAPU8.subarray(at, HEAPU8.indexOf(0, at)));
}

/** One call of the engine. @param {any} request @param {Uint8Array} [bytes] @returns {{answer: any, bytes?: Uint8Array}} */
function answer(request, bytes) {
  const { engine } = state;
  if (bytes) {
    const place = engine._ninebit_buffer(bytes.length);
    if (place === 0) return { answer: { fault: { message: `${bytes.length} bytes are more than the engine takes` } } };
    engine.HEAPU8.set(bytes, place);
  }
  const at = textInMemory(JSON.stringify(request));
  const text = textAt(engine._ninebit_answer(at));
  engine._free(at);
  const found = JSON.parse(text);
  if (!found.bytes) return { answer: found };
  const from = engine._ninebit_bytes();
  return { answer: found, bytes: engine.HEAPU8.slice(from, from + found.bytes) };
}

worker.onmessage = async (/** @type {MessageEvent} */ { data }) => {
  try {
    if (data.start) {
      state.engine = await worker.createNinebit({ wasmBinary: unpackLzma(bytesOfText(data.wasm.packed), data.wasm.size), print() {}, printErr() {} });
      worker.postMessage({ id: data.id, answer: {} });
      return;
    }
    const begin = performance.now();
    const found = answer(data.request, data.bytes);
    const message = { id: data.id, milliseconds: performance.now() - begin, ...found };
    worker.postMessage(message, found.bytes ? [found.bytes.buffer] : []);
  } catch (error) {
    worker.postMessage({ id: data.id, crash: String(error instanceof Error ? error.message : error).slice(0, 500) });
  }
};
