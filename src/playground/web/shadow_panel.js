/**
 * Index cube shadows: what the main picture shows while this panel is open, with its wrong pixels, and the cube map that
 * the light sees, unfolded.
 */
import { cameraOf, orbitOf } from './camera.js';
import { choice, element, messageOf, paint, replaceChildren } from './dom.js';
import { Replaced } from './engine_client.js';
import { Judge } from './judge.js';
import { WrongPixels } from './wrong_panel.js';

const order = [['neighbour', 'codes that know their neighbours'], ['file', 'the article’s: as in the file']];
/** What is asked for at first. */
const usual = { scene: 'room', step: 2, map_size: 512, order: 'neighbour' };

export class ShadowPanel {
  /**
   * @param {HTMLElement} parent
   * @param {import('./state.js').Store} store
   * @param {import('./shelf.js').Shelf} shelf
   * @param {{engine: import('./engine_client.js').Engine, newEngine: () => import('./engine_client.js').Engine,
   *     meshes: string[], picture: import('./picture.js').Picture, drawn: (pixels: Uint8Array, width: number, height: number) => void,
   *     changed: () => void}} given `drawn` hears of each picture, `changed` that something else is asked for
   */
  constructor(parent, store, shelf, { engine, newEngine, meshes, picture, drawn, changed }) {
    this.parent = parent;
    this.store = store;
    this.shelf = shelf;
    this.engine = engine;
    this.meshes = meshes;
    this.shown = drawn;
    this.changed = changed;
    /** @type {any} */
    this.asked = { ...usual };
    /** The request of the last picture. @type {any} */
    this.drawn = null;
    /** Where the scene's own camera is; known after the first picture. @type {any} */
    this.view = null;
    this.controls = element('div', { class: 'shadow-controls' });
    this.result = element('p', { role: 'status', id: 'shadow-result' });
    this.cube = element('canvas', { width: 1, height: 1 });
    this.wrong = new WrongPixels(picture, () => this.judgeAgain());
    this.judge = new Judge(newEngine, engine, this.wrong);
    parent.append(element('p', { class: 'quiet' }, 'Each polygon has a number, drawn as a colour into a cube map around the light; the register combiners compare. The picture shows the shadows while this panel is open.'),
      this.controls, this.result, this.wrong.element,
      element('figure', {}, this.cube, element('figcaption', {}, 'The index cube, unfolded')));
  }

  /** @param {any} change */
  ask(change) {
    Object.assign(this.asked, change);
    this.changed();
    this.draw();
  }

  show() {
    const scenes = [['room', 'the room'], ...this.meshes, ...this.shelf.meshes().slice(1)];
    const scene = choice('Scene', scenes, this.asked.scene, (value) => {
      this.view = null;
      delete this.asked.camera;
      this.ask({ scene: value });
    });
    const sizes = [64, 128, 256, 512, 1024, 2048].map(String);
    replaceChildren(this.controls, scene, choice('Order', order, this.asked.order, (value) => this.ask({ order: value })),
      slider('Step', { min: 1, max: 4, step: 1, value: this.asked.step }, (value) => this.ask({ step: value })),
      choice('Map size', sizes, String(this.asked.map_size), (value) => this.ask({ map_size: Number(value) })), ...this.camera());
  }

  camera() {
    if (!this.view) return [];
    const scene = { camera: this.view.position, look_at: this.view.target };
    const orbit = orbitOf({ ...scene, camera: this.asked.camera?.position ?? scene.camera });
    /** @param {string} title @param {'around'|'above'|'distance'} key @param {{min: number, max: number, step: number}} range */
    const part = (title, key, range) => slider(title, { ...range, value: orbit[key] }, (value) => {
      orbit[key] = value;
      this.ask({ camera: { position: cameraOf(scene, orbit), target: this.view.target, fov: this.view.fov } });
    });
    const far = Math.max(4, orbit.distance * 2);
    return [part('Around', 'around', { min: -180, max: 180, step: 1 }), part('Above', 'above', { min: -85, max: 85, step: 1 }),
      part('Distance', 'distance', { min: far / 20, max: far, step: far / 200 })];
  }

  update() {
    this.wrong.see(!this.parent.hidden);
    if (this.parent.hidden) {
      this.judge.stop();
      return;
    }
    this.show();
    this.draw();
  }

  /** What is asked for, as a link keeps it; `null`: the usual. @returns {any} */
  settings() {
    return JSON.stringify(this.asked) === JSON.stringify(usual) ? null : this.asked;
  }

  /** Takes settings of a link; the engine says what is wrong with them. @param {any} settings */
  take(settings) {
    this.asked = { ...usual, ...settings };
    this.view = null;
  }

  /** Judges the picture that is shown, or gives that up. */
  judgeAgain() {
    if (this.drawn && this.wrong.wanted) this.judge.ask(this.drawn);
    else this.judge.stop();
  }

  async draw() {
    try {
      const request = { do: 'shadow', size: [480, 360], hash: false, profile: this.store.state.profile, ...this.asked };
      const { answer, bytes, milliseconds } = await this.engine.ask(request, { key: 'shadow' });
      const first = answer.width * answer.height * 4;
      this.shown(bytes.subarray(0, first), answer.width, answer.height);
      paint(this.cube, bytes.subarray(first), answer.cube.width, answer.cube.height);
      this.drawn = structuredClone(request);
      this.wrong.pictureIs(this.drawn);
      this.judgeAgain();
      const { lit, shadowed } = answer.pixels;
      this.result.textContent = `${shadowed.toLocaleString('en')} pixels in shadow, ${lit.toLocaleString('en')} lit; ` +
        `${answer.triangles.toLocaleString('en')} triangles, ${answer.codes_used.toLocaleString('en')} codes; ${milliseconds.toFixed(0)} ms`;
      if (!this.view) {
        this.view = answer.view;
        this.show();
      }
    } catch (error) {
      if (!(error instanceof Replaced)) this.result.textContent = messageOf(error);
    }
  }
}

/**
 * A number with its value beside it.
 * @param {string} title
 * @param {{value: number, min: number, max: number, step: number}} range
 * @param {(value: number) => void} write
 */
function slider(title, { value, ...range }, write) {
  const shown = element('output', {}, value);
  const input = element('input', {
    type: 'range', ...range, oninput: () => {
      shown.textContent = input.value;
      write(Number(input.value));
    },
  });
  input.value = String(value);
  return element('label', { class: 'field' }, element('span', {}, title), element('span', { class: 'slider' }, input, shown));
}
