/**
 * What a pass reads: mesh, textures and their coordinates, colours, constants.
 */
import { cameraSliders } from './camera.js';
import { choice, element, replaceChildren } from './dom.js';
import { GeneratedPictures, isGenerated } from './generated_pictures.js';
import { fileIn } from './shelf.js';
import { MoreInputs } from './more_inputs.js';
import { bare, passOf } from './state.js';

const vectors = ['uv', 'screen', 'projected', 'position', 'normal', 'from-light', 'light-vector', 'view-vector', 'half-vector',
  'reflection', 'tangent-light-vector', 'tangent-half-vector'];
const coordinates = [...vectors, 'tangent-to-world-x', 'tangent-to-world-y', 'tangent-to-world-z'];
const colours = [...vectors.slice(3), 'color', 'secondary-color', 'lambert', 'index', 'constant:1,1,1', 'constant:0,0,0', 'constant:0.5,0.5,0.5'];
const off = '(off)';

/** Sources whose textures have a steepness. */
const steep = /^(normals|signed-normals|hilo-normals|offsets):/;

/** @param {number} value 0 to 1 */
const hex = (value) => Math.round(Math.min(1, Math.max(0, value)) * 255).toString(16).padStart(2, '0');

export class InputsPanel {
  /**
   * @param {HTMLElement} parent
   * @param {import('./state.js').Store} store
   * @param {import('./shelf.js').Shelf} shelf
   * @param {{textures: string[], meshes: string[], profiles: any[]}} about what the engine offers
   */
  constructor(parent, store, shelf, about) {
    this.parent = parent;
    this.store = store;
    this.shelf = shelf;
    this.about = about;
    this.more = new MoreInputs(store);
    this.generated = new GeneratedPictures(shelf.engine, shelf);
    /** The constants that the program sets itself. @type {Record<string, number[]>} */
    this.ofProgram = {};
    /** Hears of chosen files. @type {((files: File[]) => void)|undefined} */
    this.onfiles = undefined;
    /** Hears that the panel was made anew. */
    this.onshown = () => {};
    /** Where the engine put the camera. @type {{position: number[], target: number[]}|null} */
    this.view = null;
    /** How many pictures there were when the panel was shown: later ones have thumbnails, too. */
    this.pictures = 0;
  }

  /** @param {{position: number[], target: number[]}} view of the last drawing */
  setView(view) {
    const { scene } = this.store.state.effect;
    const moved = JSON.stringify(view) !== JSON.stringify(this.view);
    this.view = view;
    // Where the effect says nothing, the sliders show what the scene's file or the engine chose.
    const chosen = moved && scene?.mesh && !(scene.camera && scene.look_at);
    if (chosen || (this.pictures !== this.shelf.pictures.size && !this.parent.contains(document.activeElement))) this.show();
  }

  /** How many texture units the chip has, by the profile. */
  units() {
    const { profile } = this.store.state;
    const shipped = this.about.profiles.find((/** @type {any} */ { name }) => name === (profile.base ?? profile));
    return profile.texture_units ?? shipped?.fields.find((/** @type {any} */ { name }) => name === 'texture_units')?.value ?? 4;
  }

  /** @param {Record<string, number[]>} constants */
  setConstants(constants) {
    if (JSON.stringify(constants) === JSON.stringify(this.ofProgram)) return;
    this.ofProgram = constants;
    if (!this.parent.contains(document.activeElement)) this.show();
  }

  show() {
    const { state } = this.store;
    this.pictures = this.shelf.pictures.size;
    const pass = passOf(state);
    const chip = this.units();
    const units = [0, 1, 2, 3].filter((unit) => unit < chip || pass.units?.[unit]).map((unit) => this.unit(unit, pass.units?.[unit] ?? null, chip));
    replaceChildren(this.parent,
      element('div', { class: 'cards' }, ...units,
        element('fieldset', {}, element('legend', {}, 'Vertices'), this.mesh(),
          choice('Primary colour', colours, pass.primary ?? 'constant:1,1,1', (value) => this.edit((/** @type {any} */ now) => { now.primary = value; })),
          choice('Secondary colour', colours, pass.secondary ?? 'constant:0,0,0', (value) => this.edit((/** @type {any} */ now) => { now.secondary = value; }))),
        element('fieldset', {}, element('legend', {}, 'Constants'), this.constant('const0'), this.constant('const1'),
          element('p', { class: 'quiet' }, 'They replace the program’s own constants.'))),
      element('div', { class: 'mores' }, ...this.more.groups(), element('p', { class: 'quiet' }, 'The rest is in the tab effect.json.')),
      element('p', { class: 'quiet' }, 'Drop pictures, a program, or a glTF, OBJ, PLY or OFF file on the page, or ',
        element('label', { class: 'link' }, 'choose one', element('input', { type: 'file', class: 'hidden-file', id: 'choose-file', multiple: true })), '.'));
    this.onshown();
    this.parent.querySelector('#choose-file')?.addEventListener('change', (/** @type {any} */ event) => this.onfiles?.([...event.target.files]));
  }

  /** Fills in the pictures of generated textures, once nothing is more urgent. */
  update() {
    const { state } = this.store;
    for (const place of /** @type {NodeListOf<HTMLElement>} */ (this.parent.querySelectorAll('[data-generated]'))) {
      const unit = passOf(state).units?.[Number(place.dataset.generated)];
      const drawing = this.generated.of(state.effect.textures?.[unit?.texture] ?? {});
      drawing?.then((picture) => { if (picture && place.isConnected) place.replaceWith(thumbnail(picture)); });
    }
  }

  /** @param {(pass: any, effect: any) => void} change */
  edit(change) {
    this.store.change('inputs', (state) => change(passOf(state), state.effect));
  }

  mesh() {
    const { effect } = this.store.state;
    const rectangle = 'rectangle';
    const now = effect.scene?.mesh ?? rectangle;
    const mesh = choice('Mesh', [rectangle, ...this.about.meshes, ...this.shelf.meshes()], now, (value) => {
      this.edit((pass, edited) => {
        // A scene is that of a mesh.
        if (value === rectangle) delete edited.scene;
        else edited.scene = { ...edited.scene, mesh: value };
      });
      this.view = null;
      this.show();
    });
    // A point that moves is where the last picture had it.
    const still = (/** @type {any} */ point, /** @type {any} */ drawn) => (point?.every(Number.isFinite) ? point : drawn);
    const position = still(effect.scene?.camera, this.view?.position), target = still(effect.scene?.look_at, this.view?.target);
    if (now === rectangle || !position || !target) return mesh;
    const rounded = target.map((/** @type {number} */ value) => Math.round(value * 1000) / 1000);
    const camera = cameraSliders({ camera: position, look_at: rounded }, (place) => this.edit((pass, edited) => {
      Object.assign(edited.scene, { camera: place, look_at: edited.scene.look_at ?? rounded });
    }));
    return element('div', { class: 'camera' }, mesh, camera);
  }

  /** @param {number} number @param {any} unit @param {number} chip how many units the chip has */
  unit(number, unit, chip) {
    const { effect } = this.store.state;
    const texture = effect.textures?.[unit?.texture];
    const files = this.shelf.names();
    const title = (/** @type {string} */ name) => name.replace(/^([a-z0-9-]+:)?(textures|dropped)\//, '$1');
    const sources = [off, ...this.about.textures, ...[...files, ...files.map((name) => `normals:${name}`)].map((name) => [name, title(name)])];
    const source = String(texture?.source ?? '');
    const picture = isGenerated(source) ? undefined : this.shelf.pictures.get(fileIn(source));
    const rows = [choice('Texture', sources, texture?.source ?? off, (value) => this.setSource(number, value))];
    if (texture) {
      rows.push(
        this.sampler('Filter', 'filter', ['nearest', 'linear', 'bilinear-mipmap', 'trilinear'], texture),
        this.sampler('Wrap', 'wrap', ['repeat', 'clamp', 'clamp-to-edge', 'mirrored-repeat', 'clamp-to-border'], texture),
        choice('Coordinates', coordinates, unit.coordinates ?? 'uv', (value) => this.edit((pass) => { pass.units[number].coordinates = value; })),
        this.more.ofTexture(number, texture));
    }
    return element('fieldset', { 'data-unit': number }, element('legend', {}, number < chip ? `Texture ${number}` : `Texture ${number}: the chip has ${chip} units`), picture ? thumbnail(picture) : texture ? element('span', { 'data-generated': number, hidden: true }) : null, ...rows);
  }

  /**
   * A choice of how a texture is sampled; the default depends on its source.
   * @param {string} title
   * @param {string} key
   * @param {string[]} words
   * @param {any} texture
   */
  sampler(title, key, words, texture) {
    return choice(title, [['', 'default'], ...words], texture[key] ?? '', (value) => this.edit(() => {
      if (value) texture[key] = value;
      else delete texture[key];
    }));
  }

  /** @param {number} number @param {string} source */
  setSource(number, source) {
    this.edit((pass, effect) => {
      pass.units = [0, 1, 2, 3].map((unit) => pass.units?.[unit] ?? null);
      if (source === off) {
        pass.units[number] = null;
      } else {
        effect.textures ??= bare({});
        const used = pass.units[number]?.texture ?? `tex${number}`;
        // Another pass may read the texture: it keeps its source.
        const shared = effect.passes.some((/** @type {any} */ other) => (other.units ?? []).some((/** @type {any} */ unit, /** @type {number} */ at) => unit?.texture === used && (other !== pass || at !== number)));
        const name = shared ? `${used}-${number}` : used;
        effect.textures[name] = { ...effect.textures[used], source };
        // The engine refuses the key for other sources.
        if (!steep.test(source)) delete effect.textures[name].steepness;
        pass.units[number] = { coordinates: 'uv', ...pass.units[number], texture: name };
      }
      while (pass.units.length > 0 && pass.units.at(-1) === null) pass.units.pop();
    });
    this.show();
  }

  /** @param {string} name */
  constant(name) {
    const pass = passOf(this.store.state);
    const set = pass.constants?.[name];
    if (set && !set.every(Number.isFinite)) return element('p', { class: 'quiet' }, element('code', {}, name), ' moves: ', set.join(', '));
    const value = set ?? this.ofProgram[name] ?? [0, 0, 0, 0];
    const write = (/** @type {number[]} */ edited) => {
      this.edit((now) => { now.constants = { ...now.constants, [name]: edited }; });
      own.hidden = false;
    };
    const current = () => passOf(this.store.state).constants?.[name] ?? this.ofProgram[name] ?? [0, 0, 0, 0];
    const well = element('input', {
      type: 'color', value: `#${value.slice(0, 3).map(hex).join('')}`, 'aria-label': `${name}, colour`, 'data-constant': name,
      oninput: () => {
        const parts = [1, 3, 5].map((at) => parseInt(well.value.slice(at, at + 2), 16) / 255);
        write([...parts, current()[3]]);
      },
    });
    const alpha = element('input', {
      type: 'range', min: 0, max: 255, 'aria-label': `${name}, alpha`,
      oninput: () => {
        shown.textContent = alpha.value;
        write([...current().slice(0, 3), Number(alpha.value) / 255]);
      },
    });
    alpha.value = String(Math.round(value[3] * 255));
    const shown = element('output', {}, alpha.value);
    const own = element('button', {
      type: 'button', class: 'small', hidden: !set, title: `Use the program’s ${name}`,
      onclick: () => {
        this.edit((now) => {
          delete now.constants?.[name];
          if (Object.keys(now.constants ?? {}).length === 0) delete now.constants;
        });
        this.show();
      },
    }, 'reset');
    return element('div', { class: 'constant' }, element('code', {}, name), well, element('label', {}, 'alpha ', alpha, shown), own);
  }
}

/** A small picture of a texture. @param {{width: number, height: number, pixels: Uint8Array}} picture */
function thumbnail({ width, height, pixels }) {
  const canvas = element('canvas', { class: 'texture-thumbnail', 'aria-hidden': 'true' });
  canvas.width = width;
  canvas.height = height;
  const opaque = new Uint8ClampedArray(pixels);
  for (let at = 3; at < opaque.length; at += 4) opaque[at] = 255;
  canvas.getContext('2d')?.putImageData(new ImageData(opaque, width, height), 0, 0);
  return canvas;
}
