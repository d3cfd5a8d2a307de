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
