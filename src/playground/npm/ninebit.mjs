/**
 * The engine of ninebit for JavaScript: register combiners to the bit, and what is drawn with them. index.d.ts describes
 * it. node.mjs and browser.mjs load the engine each in their way.
 */

/** What the engine refuses, with the place in the text that it is about. */
export class NinebitError extends Error {
  constructor({ message, file, line, column, others }) {
    const place = line ? `${file}:${line}:${column}: ` : file ? `${file}: ` : '';
    super(place + message);
    this.name = 'NinebitError';
    Object.assign(this, { reason: message, file, line, column, others: others ?? [] });
  }
}

const encoder = new TextEncoder();
const decoder = new TextDecoder();

export class Ninebit {
  #engine;

  constructor(engine) {
    this.#engine = engine;
  }

  /** The answer to a request of the engine, and its bytes. */
  ask(request, bytes) {
    const engine = this.#engine;
    if (bytes) {
      const place = engine._ninebit_buffer(bytes.length);
      if (place === 0) throw new NinebitError({ message: `${bytes.length} bytes; expected 1 to ${64 << 20}` });
      engine.HEAPU8.set(bytes, place);
    }
    const text = encoder.encode(JSON.stringify(request));
    const at = engine._malloc(text.length + 1);
    if (at === 0) throw new NinebitError({ message: 'out of memory' });
    engine.HEAPU8.set(text, at);
    engine.HEAPU8[at + text.length] = 0;
    let answer;
    try {
      const from = engine._ninebit_answer(at);
      answer = JSON.parse(decoder.decode(engine.HEAPU8.subarray(from, engine.HEAPU8.indexOf(0, from))));
    } finally {
      engine._free(at);
    }
    if (answer.fault) throw new NinebitError(answer.fault);
    const start = engine._ninebit_bytes();
    return { answer, bytes: engine.HEAPU8.slice(start, start + (answer.bytes ?? 0)) };
  }

  about() {
    return this.ask({ do: 'about' }).answer;
  }

  read(text, { profile, name, files, choice } = {}) {
    return this.ask({ do: 'read', text, profile, name, files, choice }).answer;
  }

  convert(text, to, { profile, name, files, choice } = {}) {
    return this.ask({ do: 'convert', text, to, profile, name, files, choice }).answer.text;
  }

  trace(text, { profile, registers } = {}) {
    return this.ask({ do: 'trace', text, profile, registers }).answer;
  }

  evaluate(text, pictures, { profile, registers } = {}) {
    const entries = Object.entries(pictures);
    const all = new Uint8Array(entries.reduce((sum, [, picture]) => sum + picture.length, 0));
    let at = 0;
    for (const [name, picture] of entries) {
      if (picture.length !== entries[0][1].length) {
        throw new NinebitError({ message: `${name} has ${picture.length} bytes, ${entries[0][0]} ${entries[0][1].length}; expected as many` });
      }
      all.set(picture, at);
      at += picture.length;
    }
    return this.ask({ do: 'evaluate', text, profile, registers, pictures: entries.map(([name]) => name) }, all).bytes;
  }

  put(name, { width, height, data } = {}) {
    if (!(data?.length > 0)) throw new NinebitError({ message: `${name} has no bytes; expected some in data` });
    const kind = width === undefined ? 'file' : 'pixels';
    this.ask({ do: 'put', name, kind, ...(kind === 'pixels' ? { width, height } : {}) }, data);
  }

  draw(effect, { files, choices, profile, size } = {}) {
    const { answer, bytes } = this.ask({ do: 'draw', effect, files, choices, profile, size });
    return { ...answer, data: bytes };
  }

  pixel(x, y) {
    return this.ask({ do: 'pixel', x, y }).answer;
  }
}

/** Loads the engine that `createNinebit` makes of the bytes that `wasm` gives. */
export const loader = (createNinebit, wasm) => async () => new Ninebit(await createNinebit({ wasmBinary: await wasm(), print() {}, printErr() {} }));
