/** Effect files that are dropped with what they name. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { stateOfDropped } from '../../../src/playground/web/effect_drop.js';

const effect = () => ({ ninebit: 'effect', version: 1, profile: 'nv2a', passes: [{ program: 'a.rc1' }] });
const program = new File(['!!RC1.0\nout.rgb = tex0;\n'], 'a.rc1');
const shelf = { embedded: new Map() };

test('a profile.json is the profile of the effect that it was dropped with', async () => {
  const own = { base: 'geforce2', name: 'mine', half: 127 };
  const plain = await stateOfDropped(effect(), 'effect.json', [program], shelf);
  assert.equal(plain.profile, 'nv2a');
  const state = await stateOfDropped(effect(), 'effect.json', [program, new File([JSON.stringify(own)], 'profile.json')], shelf);
  assert.deepEqual({ ...state.profile }, own);
  assert.deepEqual(Object.keys(state.files), ['a.rc1']);
});

test('a profile.json that is not a profile is refused by its name', async () => {
  for (const text of ['{', '[1]', '7']) {
    await assert.rejects(stateOfDropped(effect(), 'effect.json', [program, new File([text], 'profile.json')], shelf), /^Error: profile\.json: /);
  }
});

test('a sources.json of something else is not read; one of an archive is checked', async () => {
  const drop = (/** @type {any} */ sources) => stateOfDropped(effect(), 'effect.json', [program, new File([JSON.stringify(sources)], 'sources.json')], shelf);
  for (const other of [[1], null, 7, { sources: ['a.c'] }, { ninebit: 'other', programs: 7 }]) assert.deepEqual(Object.keys((await drop(other)).files), ['a.rc1']);
  await assert.rejects(drop({ ninebit: 'sources', programs: 7 }), /^Error: sources\.json: it\.programs must be an object/);
});

test('files of an archive are found by their whole paths', async () => {
  const bytes = (/** @type {string} */ text) => new TextEncoder().encode(text);
  /** A shelf that names what it takes by its content. */
  const own = { embedded: new Map([['textures/bricks.png', bytes('the page')]]), take: async (/** @type {File} */ file) => `dropped/${await file.text()}` };
  const files = (/** @type {Record<string, string>} */ texts) => Object.entries(texts).map(([name, text]) => new File([text], name));
  const open = (/** @type {File[]} */ all, /** @type {string} */ folder = '') => stateOfDropped({ ninebit: 'effect', version: 1, passes: [{ program: 'a/p.c' }, { program: './b//p.c' }],
    textures: { one: { source: 'textures/bricks.png' }, two: { source: 'dropped/bricks.png' } } }, `${folder}effect.json`, all, /** @type {any} */ (own));
  const whole = { 'textures/bricks.png': 'the page', 'dropped/bricks.png': 'mine', 'a/p.c': '#include "x.h"\n', 'b/p.c': '#include "../b/x.h"\n//b\n', 'a/x.h': '1', 'b/x.h': '2' };
  for (const folder of ['', 'frame/']) {
    const named = Object.fromEntries(Object.entries(whole).map(([name, text]) => [folder + name, text]));
    const { effect: drawn, files: texts } = await open(files({ ...named, 'other/p.c': 'no', 'bricks.png': 'no' }), folder);
    assert.deepEqual([drawn.textures.one.source, drawn.textures.two.source], ['textures/bricks.png', 'dropped/mine']);
    assert.deepEqual(drawn.passes.map((/** @type {any} */ pass) => pass.program), ['a/p.c', 'b/p.c']);
    assert.deepEqual({ ...texts }, { 'a/p.c': whole['a/p.c'], 'b/p.c': whole['b/p.c'], 'a/x.h': '1', 'b/x.h': '2' });
  }
  const other = await open(files({ ...whole, 'textures/bricks.png': 'not the page' }));
  assert.equal(other.effect.textures.one.source, 'dropped/not the page');
  await assert.rejects(open(files({ 'c/p.c': '1', 'b/p.c': '2' })), /effect\.json: a\/p\.c is not there, but there are c\/p\.c and b\/p\.c/);
});
