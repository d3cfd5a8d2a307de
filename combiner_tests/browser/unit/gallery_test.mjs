/** The gallery's groups have every effect, once. */
import assert from 'node:assert/strict';
import { readdirSync } from 'node:fs';
import { test } from 'node:test';
import { groups } from '../../../src/playground/web/gallery.js';

test('each effect is in one group', () => {
  const files = readdirSync(new URL('../../../scenes/effects/', import.meta.url)).filter((name) => name.endsWith('.json') && name !== 'expected_hashes.json');
  assert.deepEqual(groups.flatMap(([, names]) => names).sort(), files.map((name) => name.replace('.json', '')).sort());
});
