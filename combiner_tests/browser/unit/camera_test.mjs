/** Orbits: a camera's place to angles and back. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { cameraOf, orbitOf } from '../../../src/playground/web/camera.js';

test('angles and distance of a camera', () => {
  assert.deepEqual(orbitOf({ camera: [0, 0, 3], look_at: [0, 0, 0] }), { around: 0, above: 0, distance: 3 });
  assert.deepEqual(orbitOf({ camera: [2, 1, 0], look_at: [0, 1, 0] }), { around: 90, above: 0, distance: 2 });
  assert.deepEqual(orbitOf({ camera: [0, 5, 0], look_at: [0, 1, 0] }), { around: 0, above: 90, distance: 4 });
});

test('a camera at its target has a distance', () => {
  assert.equal(orbitOf({ camera: [1, 1, 1], look_at: [1, 1, 1] }).distance, 1);
});

test('an orbit gives the camera back, to the degree', () => {
  const target = [1, -2, 0.5];
  for (let around = -180; around < 180; around += 15) {
    for (let above = -85; above <= 85; above += 17) {
      const camera = cameraOf({ look_at: target }, { around, above, distance: 4 });
      const found = orbitOf({ camera, look_at: target });
      assert.deepEqual({ ...found, around: (found.around + 360) % 360 }, { around: (around + 360) % 360, above, distance: 4 });
    }
  }
});
