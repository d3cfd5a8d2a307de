/** Completion of an effect's JSON by its schema. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { effectOffers } from '../../../src/playground/web/effect_completion.js';

const labels = (text) => effectOffers(text)?.offers.map(({ label }) => label) ?? null;

test('keys of the object, without those that are there', () => {
  assert.ok(labels('{').includes('passes'));
  const second = labels('{"title": "x", ');
  assert.ok(second.includes('size') && !second.includes('title'));
  assert.ok(labels('{"passes": [{"name": "a, {b", ').includes('program'));
  assert.deepEqual(labels('{"passes": [{"constants": {"const0": [1, 0, 0, 1], '), ['const1', 'combiners']);
  assert.ok(labels('{"textures": {"mine": {').includes('source'));
  assert.deepEqual(labels('{"textures": {'), []);
  assert.ok(labels('{"passes": [{"units": [null, {').includes('coordinates'));
});

test('words of a value', () => {
  assert.deepEqual(labels('{"textures": {"mine": {"source": "a", "filter": '), ['nearest', 'linear', 'bilinear-mipmap', 'trilinear']);
  assert.deepEqual(labels('{"passes": [{"draw": "'), ['mesh', 'rectangle']);
  assert.deepEqual(labels('{"targets": {"t": {"cube": '), ['true', 'false']);
  assert.deepEqual(labels('{"title": '), []);
});

test('what is offered begins at the word or its quotation mark', () => {
  assert.equal(effectOffers('{"pas').from, 1);
  assert.equal(effectOffers('{pas').from, 1);
  assert.equal(effectOffers('{"passes": [{"draw": "me').from, 21);
});

test('there is nothing outside of the object', () => {
  assert.equal(labels(''), null);
  assert.equal(labels('{}'), null);
});
