/**
 * The camera of a mesh as three sliders: around it, above it, away from it.
 */
import { element } from './dom.js';

/** A camera's place in degrees and units from what it looks at. @param {{camera: number[], look_at: number[]}} scene */
export function orbitOf({ camera, look_at: target }) {
  const [x, y, z] = camera.map((value, at) => value - target[at]);
  const distance = Math.hypot(x, y, z) || 1;
  const degrees = (/** @type {number} */ angle) => Math.round(angle * 180 / Math.PI);
  return { around: degrees(Math.atan2(x, z)), above: degrees(Math.asin(y / distance)), distance: Math.round(distance * 100) / 100 };
}

/**
 * The camera's place for an orbit.
 * @param {{look_at: number[]}} scene
 * @returns {number[]} rounded, so that a link stays short
 * @param {{around: number, above: number, distance: number}} orbit
 */
export function cameraOf({ look_at: target }, orbit) {
  const { around, above, distance } = orbit;
  const [a, b] = [around, above].map((angle) => angle * Math.PI / 180);
  const offset = [Math.sin(a) * Math.cos(b), Math.sin(b), Math.cos(a) * Math.cos(b)];
  return offset.map((part, at) => Math.round((target[at] + part * distance) * 1000) / 1000);
}

/**
 * @param {{camera: number[], look_at: number[]}} scene where the camera is now
 * @param {(camera: number[]) => void} move
 * @returns {HTMLElement}
 */
export function cameraSliders(scene, move) {
  const orbit = orbitOf(scene);
  const far = Math.max(10, Math.ceil(orbit.distance * 2));
  /** @param {string} title @param {'around'|'above'|'distance'} key @param {number} min @param {number} max @param {number} step */
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
    slider('Distance', 'distance', far / 20, far, far / 200));
}
