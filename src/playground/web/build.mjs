/**
 * Bundles the playground into one file: node build.mjs ENGINE OUTPUT.html NPM_FOLDER
 *
 * NPM_FOLDER has the packages of package.json; ENGINE.js and ENGINE.wasm are Emscripten's.
 */
import { execFileSync } from 'node:child_process';
import { readdirSync, readFileSync, renameSync, statSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';
import { textOfBytes } from './text_bytes.js';

const [engine, output, npm] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const effectsFolder = resolve(here, '../../../scenes/effects');
const { build } = createRequire(resolve(npm, 'package.json'))('esbuild');
const most = 2_100_000;

/** A module and what it imports as one script. */
async function bundled(name) {
  const { outputFiles } = await build({
    entryPoints: [join(here, name)], bundle: true, minify: true, write: false, format: 'iife', target: 'es2022',
    nodePaths: [resolve(npm, 'node_modules')], legalComments: 'inline', charset: 'utf8',
  });
  return outputFiles[0].text;
}

/** The gallery: effects, their programs, sizes of their pictures by the names that effects give them, and the pictures one after the other. */
function gallery() {
  const content = { effects: {}, programs: {}, files: {} }, pictures = [];
  const read = (name) => readFileSync(join(effectsFolder, name));
  for (const name of readdirSync(effectsFolder).sort()) {
    if (!name.endsWith('.json') || name === 'expected_hashes.json') continue;
    content.effects[name.replace('.json', '')] = JSON.parse(read(name).toString());
  }
  for (const name of readdirSync(join(effectsFolder, 'programs')).sort()) {
    content.programs[`programs/${name}`] = read(`programs/${name}`).toString();
  }
  for (const name of readdirSync(join(effectsFolder, 'textures')).sort()) {
    pictures.push(read(`textures/${name}`));
    content.files[`textures/${name}`] = pictures.at(-1).length;
  }
  return { content, pictures: textOfBytes(Buffer.concat(pictures)) };
}

/** A file packed with LZMA by Python, which Emscripten needs anyway: Node has none. */
function packed(file) {
  const script = 'import lzma, sys; sys.stdout.buffer.write(lzma.compress(open(sys.argv[1], "rb").read(), format=lzma.FORMAT_ALONE, preset=9 | lzma.PRESET_EXTREME))';
  return execFileSync('/usr/bin/python3', ['-c', script, file], { maxBuffer: 1 << 28 });
}

const { content, pictures } = gallery();
const parts = {
  STYLE: readFileSync(join(here, 'style.css'), 'utf8'),
  CONTENT: textOfBytes(deflateRawSync(JSON.stringify(content), { level: 9 })),
  PICTURES: pictures,
  ENGINE: readFileSync(`${engine}.js`, 'utf8'),
  WASM: textOfBytes(packed(`${engine}.wasm`)),
  SIZE: String(statSync(`${engine}.wasm`).size),
  WORKER: await bundled('engine_worker.js'),
  SCRIPT: await bundled('main.js'),
};
for (const name of ['ENGINE', 'WORKER', 'SCRIPT']) {
  if (/<\/script/i.test(parts[name])) throw new Error(`${name} would end its own element`);
}
const page = readFileSync(join(here, 'page.html'), 'utf8').replace(/\/\*(STYLE|CONTENT|PICTURES|ENGINE|WASM|SIZE|WORKER|SCRIPT)\*\//g, (_, name) => parts[name]);
const bytes = Buffer.byteLength(page);
if (bytes > most) throw new Error(`the page has ${bytes} bytes; expected ${most} at most`);
writeFileSync(`${output}.part`, page);
renameSync(`${output}.part`, output);
process.stdout.write(`${output}: ${(bytes / 1e6).toFixed(2)} MB\n`);
