/**
 * Bundles the playground into one file: node build.mjs ENGINE OUTPUT.html NPM_FOLDER
 *
 * NPM_FOLDER has the packages of package.json; ENGINE.js and ENGINE.wasm are Emscripten's.
 */
import { readdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

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

/** The gallery: effects, their programs, their pictures by the names that effects give them. */
function gallery() {
  const content = { effects: {}, programs: {}, files: {} };
  const read = (name) => readFileSync(join(effectsFolder, name));
  for (const name of readdirSync(effectsFolder).sort()) {
    if (!name.endsWith('.json') || name === 'expected_hashes.json') continue;
    content.effects[name.replace('.json', '')] = JSON.parse(read(name).toString());
  }
  for (const name of readdirSync(join(effectsFolder, 'programs')).sort()) {
    content.programs[`programs/${name}`] = read(`programs/${name}`).toString();
  }
  for (const name of readdirSync(join(effectsFolder, 'textures')).sort()) {
    content.files[`textures/${name}`] = read(`textures/${name}`).toString('base64');
  }
  return content;
}

/** JSON that cannot end its script element. */
const inScript = (value) => JSON.stringify(value).replaceAll('<', '\\u003c');

const parts = {
  STYLE: readFileSync(join(here, 'style.css'), 'utf8'),
  CONTENT: inScript(gallery()),
  ENGINE: readFileSync(`${engine}.js`, 'utf8'),
  WASM: gzipSync(readFileSync(`${engine}.wasm`), { level: 9 }).toString('base64'),
  WORKER: await bundled('engine_worker.js'),
  SCRIPT: await bundled('main.js'),
};
for (const name of ['ENGINE', 'WORKER', 'SCRIPT']) {
  if (/<\/script/i.test(parts[name])) throw new Error(`${name} would end its own element`);
}
const page = readFileSync(join(here, 'page.html'), 'utf8').replace(/\/\*(STYLE|CONTENT|ENGINE|WASM|WORKER|SCRIPT)\*\//g, (_, name) => parts[name]);
if (page.length > most) throw new Error(`the page has ${page.length} bytes; expected ${most} at most`);
writeFileSync(`${output}.part`, page);
renameSync(`${output}.part`, output);
process.stdout.write(`${output}: ${(Buffer.byteLength(page) / 1e6).toFixed(2)} MB\n`);
