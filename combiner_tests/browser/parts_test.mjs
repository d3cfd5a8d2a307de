/** Parts of the page that need no browser: the schema, states, addresses, the camera, the script. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { cameraOf, orbitOf } from '../../src/playground/web/camera.js';
import { commandsOf } from '../../src/playground/web/command_line.js';
import { Engine } from '../../src/playground/web/engine_client.js';
import { addressOf, opened } from '../../src/playground/web/permalink.js';
import { keywords } from '../../src/playground/web/schema.js';
import { Shelf } from '../../src/playground/web/shelf.js';
import { checkedEffect, checkedState, newState } from '../../src/playground/web/state.js';
import { root } from './support.mjs';

const schema = JSON.parse(readFileSync(join(root, 'docs/effect.schema.json'), 'utf8'));
const effectsFolder = join(root, 'scenes/effects');

test('every keyword of the effect schema is read', () => {
  const found = new Set();
  const walk = (part) => {
    for (const [key, value] of Object.entries(part)) {
      if (!['$schema', 'title', 'description'].includes(key)) found.add(key);
      if (['properties', '$defs'].includes(key)) Object.values(value).forEach(walk);
      else if (key === 'anyOf') value.forEach(walk);
      else if (typeof value === 'object' && !Array.isArray(value)) walk(value);
    }
  };
  walk(schema);
  assert.deepEqual([...found].filter((key) => !keywords.includes(key)), []);
  assert.ok(found.size > 10);
});

test('the schema allows the gallery', () => {
  const names = readdirSync(effectsFolder).filter((name) => name.endsWith('.json') && name !== 'expected_hashes.json');
  assert.ok(names.length > 25);
  for (const name of names) checkedEffect(JSON.parse(readFileSync(join(effectsFolder, name), 'utf8')));
});

test('what is wrong with an effect is one sentence', () => {
  const effect = (change) => ({ ninebit: 'effect', version: 1, passes: [{}], ...change });
  const cases = [
    [{ passes: [null] }, 'passes[0] must be an object'],
    [{ passes: [] }, 'passes has 0 values; expected 1 to 256'],
    [{ passes: 'x' }, 'passes must be a list'],
    [{ passes: [{ constants: { const0: 5 } }] }, 'passes[0].constants.const0 must be a list'],
    [{ passes: [{ constants: { const0: [1, 2, true, 4] } }] }, 'passes[0].constants.const0[2] must be a number or a string'],
    [{ passes: [{ constants: { const0: [1] } }] }, 'passes[0].constants.const0 has 1 values; expected 4'],
    [{ passes: [{ program: {} }] }, 'passes[0].program must be a string'],
    [{ passes: [{ units: [{ texture: {} }] }] }, 'passes[0].units[0].texture must be null or a string'],
    [{ passes: [{ units: [5] }] }, 'passes[0].units[0] must be null or an object'],
    [{ passes: [{ depth: { function: 'les' } }] },
      'passes[0].depth.function must be "never", "less", "equal", "lequal", "greater", "notequal", "gequal" or "always"'],
    [{ scene: { camera: 'x' } }, 'scene.camera must be a list'],
    [{ scene: { fov: 500 } }, 'scene.fov is 500; expected 0.01 to 170'],
    [{ size: 'large' }, 'size must be a whole number or a list'],
    [{ textures: JSON.parse('{"__proto__": 1}') }, 'textures.__proto__ must be an object'],
    [{ textures: { 'a b': {} } }, 'textures["a b"] has no "source"'],
    [JSON.parse('{"constructor": 1}'), /^the effect has the unknown key "constructor"; the keys here are "?ninebit/],
    [{ version: 2 }, 'version must be 1'],
  ];
  for (const [change, message] of cases) assert.throws(() => checkedEffect(effect(change)), { message }, JSON.stringify(change));
  assert.throws(() => checkedEffect(null), { message: 'the effect must be an object' });
  for (const [state, message] of [[5, 'the state must be an object'], [{ effect: effect({}) }, 'the state has no "files"'],
    [{ effect: effect({}), files: { a: 1 } }, 'files.a must be a string'],
    [{ effect: effect({}), files: {}, profile: 7 }, 'profile must be a string or an object'],
    [{ effect: effect({}), files: {}, pass: -1 }, 'pass is -1; expected 0 or more'],
    [{ effect: effect({ passes: [null] }), files: {} }, 'passes[0] must be an object']]) {
    assert.throws(() => checkedState(state), { message }, JSON.stringify(state));
  }
  const deep = (levels) => JSON.parse('{"a":'.repeat(levels) + '1' + '}'.repeat(levels));
  assert.ok(checkedState({ effect: effect({}), files: {}, profile: deep(64) }));
  for (const levels of [65, 50_000]) assert.throws(() => checkedState({ effect: effect({}), files: {}, profile: deep(levels) }), { message: 'the profile is nested more than 64 levels deep' });
  assert.throws(() => checkedEffect(effect({ scene: { floor: deep(50_000) } })), { message: 'the effect is nested more than 64 levels deep' });
  assert.equal(checkedState({ effect: effect({}), files: {}, profile: deep(60) }).profile.b, undefined);
});

test('an address gives names back that objects have themselves', async () => {
  const state = newState();
  for (const name of ['__proto__', 'constructor', 'toString']) state.files[name] = `# ${name}\n`;
  state.effect.passes[0].program = '__proto__';
  const { state: found } = await opened(await addressOf(state));
  assert.deepEqual(Object.entries(found.files), Object.entries(state.files));
  assert.equal(found.files.hasOwnProperty, undefined);
  assert.equal(found.files.__proto__, '# __proto__\n');
});

test('an orbit gives the camera back', () => {
  for (const [camera, target] of [[[0, 0, 3], [0, 0, 0]], [[3, 4, 5], [1, 1, 1]], [[-7.5, 2, 1], [0, 2, 0]]]) {
    const scene = { camera, look_at: target };
    cameraOf(scene, orbitOf(scene)).forEach((value, at) => assert.ok(Math.abs(value - camera[at]) < 0.1, `${camera}`));
  }
});

test('the script writes no file outside its folder, and the programs stay with their passes', () => {
  const names = ['../outside.rc1', '/tmp/ninebit-outside.rc1', 'a/../../outside.rc1', '-rf', 'effect.json', 'programs/fine.rc1', 'line\nbreak', 'program-0.txt',
    '__proto__', "it's $(touch outside).rc1", './here.rc1'];
  const state = newState();
  state.effect.passes = names.map((program) => ({ program }));
  state.files = Object.create(null);
  for (const name of names) state.files[name] = `# ${JSON.stringify(name)}\nEND\n`;
  const top = mkdtempSync(join(tmpdir(), 'ninebit-script-'));
  try {
    const folder = join(top, 'folder');
    mkdirSync(folder);
    const script = commandsOf(state, { x: 1, y: 2 }, { time: 0, frame: 0 }).replace(/^ninebit .*$/gm, '');
    execFileSync('bash', ['-e', '-c', script], { cwd: folder });
    assert.deepEqual(readdirSync(top), ['folder']);
    const effect = JSON.parse(readFileSync(join(folder, 'effect.json'), 'utf8'));
    effect.passes.forEach(({ program }, at) => assert.equal(readFileSync(join(folder, program), 'utf8'), state.files[names[at]]));
    assert.equal(effect.passes[5].program, 'programs/fine.rc1');
  } finally {
    rmSync(top, { recursive: true, force: true });
  }
});

/** A worker that answers everything but one kind of request. */
class SlowWorker {
  postMessage({ id, request }) {
    if (request?.do !== 'hang') setTimeout(() => this.onmessage?.({ data: { id, answer: {} } }));
  }

  terminate() {
    this.onmessage = null;
  }
}

test('what waits to be put into an engine that is stopped is put into the next one', async () => {
  globalThis.Worker = SlowWorker;
  const engine = new Engine([], () => {}, () => {});
  const hanging = assert.rejects(engine.ask({ do: 'hang' }), /stopped/);
  const put = engine.put({ name: 'a' }, new Uint8Array(1));
  // The engine starts first.
  await new Promise((resolve) => { setTimeout(resolve, 20); });
  engine.restart('stopped');
  await hanging;
  let timer;
  const late = new Promise((_, reject) => { timer = setTimeout(() => reject(new Error('it was never put')), 2000); });
  await Promise.race([put, late]);
  clearTimeout(timer);
});

test('a file of the page that could not be put is put again', async () => {
  let broken = true;
  const shelf = new Shelf({ put: () => (broken ? Promise.reject(new Error('stopped')) : Promise.resolve()) }, new Map([['a.obj', new Uint8Array(1)]]));
  await assert.rejects(shelf.load('a.obj'), /stopped/);
  broken = false;
  await shelf.load('a.obj');
});
