/** What is chosen of a source: controls that follow the state, and archives of what cannot be converted. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Fault, Stopped } from '../../../src/playground/web/engine_client.js';
import { SavePanel } from '../../../src/playground/web/save_panel.js';
import { SourceChoices } from '../../../src/playground/web/source_choices.js';
import { bare, Store } from '../../../src/playground/web/state.js';
import { enter, made } from './small_dom.mjs';

const stateWith = (/** @type {any} */ choice) => bare({
  effect: { ninebit: 'effect', version: 1, passes: [{ program: 'lights.c' }] }, files: { 'lights.c': 'text' }, choices: { 'lights.c': choice }, pass: 0, profile: 'nv2a', other: 'arithmetic',
});
const offered = { functions: [{ name: 'draw', line: 1, helper: false, needs: ['first'] }, { name: 'other', line: 9, helper: false, needs: [] }], programs: 1 };

test('a chosen function can be taken back, whether or not the text has it', () => {
  for (const answer of [{}, { functions: [{ name: '', line: 1, helper: false, needs: [] }], programs: 1 }, offered]) {
    const store = new Store(stateWith({ function: 'gone' })), parent = made('div');
    new SourceChoices(parent, store).show(answer);
    assert.equal(parent.hidden, false);
    const select = parent.querySelector('select');
    assert.equal(select.value, 'gone');
    enter(select, '');
    assert.deepEqual(Object.keys(store.state.choices), []);
  }
});

test('after another state is opened, its values are shown', () => {
  const store = new Store(stateWith({ function: 'draw', defines: { first: '1' } })), parent = made('div');
  const choices = new SourceChoices(parent, store);
  store.listen((what) => { if (what === 'all') choices.forget(); });
  const field = () => parent.querySelector('input');
  choices.show(offered);
  store.open(stateWith({ function: 'draw', defines: { first: '1' } }));
  choices.show(offered);
  enter(field(), '2');
  assert.equal(store.state.choices['lights.c'].defines.first, '2');
  choices.show(offered);
  assert.equal(field().value, '2');
  store.undo();
  choices.show(offered);
  assert.equal(store.state.choices['lights.c'].defines.first, '1');
  assert.equal(field().value, '1');
});

test('an archive has all but the program that the engine refuses, and says so', async () => {
  const archive = (/** @type {Error} */ error, /** @type {string[]} */ refused) => SavePanel.prototype.files.call(/** @type {any} */ ({
    store: { state: stateWith({ function: 'draw' }) }, shelf: { bytesOf: () => undefined }, engine: { ask: () => Promise.reject(error) } }), refused);
  const refused = /** @type {string[]} */ ([]);
  const files = await archive(new Fault({ message: "'first' is not known" }), refused);
  assert.deepEqual(files.map(([name]) => name), ['effect.json', 'lights.c', 'sources.json']);
  assert.deepEqual(refused, ["The archive is without lights.c.json, so only this page opens it: 'first' is not known."]);
  await assert.rejects(archive(new Stopped('the engine was stopped'), []), Stopped);
});
