/**
 * The camera of a mesh as three sliders: around it, above it, away from it.
 */
import { element } from './dom.js';

const places = { camera: [0, 0, 3], look_at: [0, 0, 0] };

/** A camera's place in degrees and units from what it looks at. @param {any} scene */
export function orbitOf(scene) {
  const camera = scene.camera ?? places.camera;
  const target = scene.look_at ?? places.look_at;
  const [x, y, z] = camera.map((value, at) => value - target[at]);
  const distance = Math.hypot(x, y, z) || 1;
  const degrees = (angle) => Math.round(angle * 180 / Math.PI);
  return { around: degrees(Math.atan2(x, z)), above: degrees(Math.asin(y / distance)), distance: Math.round(distance * 100) / 100 };
}

/** The camera's place for an orbit. @returns {number[]} rounded, so that a link stays short */
export function cameraOf(scene, { around, above, distance }) {
  const target = scene.look_at ?? places.look_at;
  const [a, b] = [around, above].map((angle) => angle * Math.PI / 180);
  const offset = [Math.sin(a) * Math.cos(b), Math.sin(b), Math.cos(a) * Math.cos(b)];
  return offset.map((part, at) => Math.round((target[at] + part * distance) * 1000) / 1000);
}

/**
 * @param {any} scene
 * @param {(camera: number[]) => void} move
 * @returns {HTMLElement}
 */
export function cameraSliders(scene, move) {
  const orbit = orbitOf(scene);
  const slider = (title, key, min, max, step) => {
    const shown = element('output', {}, orbit[key]);
    const input = element('input', {
      type: 'range', min, max, step,
      oninput: () => {
        orbit[key] = Number(input.value);
        shown.textContent = input.value;
        move(cameraOf(scene, orbit));
      },
    });
    input.value = String(orbit[key]);
    return element('label', { class: 'field' }, element('span', {}, title), element('span', { class: 'slider' }, input, shown));
  };
  return element('div', { class: 'camera' }, slider('Around', 'around', -180, 180, 1), slider('Above', 'above', -85, 85, 1),
    slider('Distance', 'distance', 1, 10, 0.05));
}
