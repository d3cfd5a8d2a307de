// The page's engine on a command line, as answers.cpp is the native one: node answers.mjs ENGINE.js < REQUESTS.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";

const script = resolve(process.argv[2]);
// With the bytes, as this Emscripten's script would ask Node's fetch for a path.
const engine = await createRequire(import.meta.url)(script)({ wasmBinary: readFileSync(script.replace(/js$/, "wasm")) });

function ask(line) {
  const size = engine.lengthBytesUTF8(line) + 1;
  const request = engine._malloc(size);
  engine.stringToUTF8(line, request, size);
  const answer = engine.UTF8ToString(engine._ninebit_answer(request));
  engine._free(request);
  return answer;
}

function hashOfBytes(count) {
  const first = engine._ninebit_bytes();
  let hash = 0x811c9dc5;
  for (let i = 0; i < count; ++i) hash = Math.imul(hash ^ engine.HEAPU8[first + i], 0x01000193);
  return (hash >>> 0).toString(16).padStart(8, "0");
}

for (const line of readFileSync(0, "utf8").split("\n")) {
  if (line === "") continue;
  if (line.startsWith("buffer ")) {
    const count = Number(line.slice(7));
    const first = engine._ninebit_buffer(count);
    for (let i = 0; i < count; ++i) engine.HEAPU8[first + i] = i * 7;
    continue;
  }
  const answer = ask(line);
  console.log(`${answer} ${hashOfBytes(JSON.parse(answer).bytes ?? 0)}`);
}
