/** Controls made of the schema: what texts in fields stand for, and objects that may be off. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { controlsOf, schemaOf, valueOf } from '../../../src/playground/web/schema_controls.js';
import { enter } from './small_dom.mjs';

const number = { type: 'number' }, moving = { anyOf: [{ type: 'number' }, { type: 'string' }] };
const three = { type: 'array', items: moving, minItems: 3, maxItems: 3 };
const size = { anyOf: [{ type: 'integer' }, { type: 'array', items: { type: 'integer' }, minItems: 2, maxItems: 2 }] };

test('a text is a number, an expression, a list or nothing', () => {
  for (const [schema, text, expected] of [[number, ' 0.5 ', 0.5], [number, '', undefined], [number, '1e2', 100], [number, '-.5', -0.5], [number, '1..2', '1..2'],
    [moving, 'sin(time)', 'sin(time)'], [three, '1, max(time, 2), 3', [1, 'max(time, 2)', 3]], [three, '1', [1]], [size, '64', 64], [size, '64,32', [64, 32]],
    [{ type: 'string' }, '10,01', '10,01'], [{ type: 'string' }, '10', '10']]) assert.deepEqual(valueOf(schema, text), expected, text);
});

test('each place has a schema', () => {
  for (const [place, key] of [['effect', 'passes'], ['scene', 'mesh'], ['texture', 'source'], ['pass', 'blend']]) assert.ok(schemaOf(place).properties[key], place);
});

test('an object that may be off has a value inside, or is off, in the controls as in the effect', () => {
  const pass = /** @type {any} */ ({});
  const [off, ...inside] = controlsOf(schemaOf('pass'), ['depth'], pass, (edit) => edit(pass)).map((control) => control.querySelector('select, input'));
  const first = inside.find(({ dataset }) => dataset.key === 'depth.function');
  enter(off, 'off');
  assert.equal(pass.depth, null);
  enter(first, 'less');
  assert.deepEqual({ ...pass.depth }, { function: 'less' });
  assert.equal(off.value, '');
  enter(off, 'off');
  assert.equal(pass.depth, null);
  assert.equal(first.value, '');
  enter(off, '');
  assert.deepEqual(pass, {});
});
