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
