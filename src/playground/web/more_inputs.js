/**
 * What else an effect says, group by group: of the picture, the scene, a pass and its tests. Each group is closed at first.
 */
import { element } from './dom.js';
import { programFiles } from './files.js';
import { controlsOf, schemaOf } from './schema_controls.js';
import { passOf } from './state.js';

/** Titles, places and keys. @type {[string, 'effect'|'scene'|'pass', string[]][]} */
const groups = [
  ['This pass', 'pass', ['program', 'draw', 'view', 'target', 'shade', 'cull', 'color_mask', 'polygon_mode', 'point_size', 'line_width', 'polygon_smooth', 'line_smooth',
    'polygon_stipple', 'polygon_offset']],
  ['Depth, tests and blending', 'pass', ['depth', 'alpha_test', 'stencil', 'blend']],
  ['Fog and clearing', 'pass', ['fog', 'clear']],
  ['Scene and light', 'scene', ['up', 'look_at', 'fov', 'light', 'light_type', 'light_target', 'spot_angle', 'light_color']],
  ['Picture', 'effect', ['title', 'size', 'color_format', 'depth_stencil']],
];

/** What further controls of a texture are for. */
const ofTexture = ['steepness', 'border_color', 'border_texels', 'cylinder_wrap', 'color_key', 'compare', 'lod_bias'];

export class MoreInputs {
  /** @param {import('./state.js').Store} store */
  constructor(store) {
    this.store = store;
    /** Titles of the groups that are open. @type {Set<string>} */
    this.opened = new Set();
  }

  /** @param {string} title @param {() => HTMLElement[]} controls made once the group is open */
  group(title, controls) {
    const body = element('div', { class: 'more-fields' });
    const fill = () => body.replaceChildren(...controls());
    const open = this.opened.has(title);
    if (open) fill();
    return element('details', { open, class: 'more', 'data-group': title, ontoggle: (/** @type {any} */ { target }) => {
      if (target.open === this.opened.has(title)) return;
      if (target.open) {
        this.opened.add(title);
        fill();
      } else this.opened.delete(title);
    } }, element('summary', {}, title), body);
  }

  /** The groups of the effect and the pass. @returns {HTMLElement[]} */
  groups() {
    return groups.map(([title, place, keys]) => this.group(title, () => {
      const { state } = this.store;
      const { effect } = state;
      if (place === 'scene' && !effect.scene?.mesh) return [element('p', { class: 'quiet' }, 'A rectangle has no scene: choose a mesh above.')];
      const of = { effect, scene: effect.scene, pass: passOf(state) }[place];
      const options = /** @type {Record<string, string[]>} */ (place === 'pass' ? { program: [...new Set([...programFiles(state), ...Object.keys(state.files)])], target: ['picture', ...Object.keys(effect.targets ?? {})] } : {});
      return controlsOf(schemaOf(place), keys, of, (edit) => this.edit(place, edit), { path: `${place}.`, options });
    }));
  }

  /** The group of a texture. @param {number} unit @param {any} texture of the effect */
  ofTexture(unit, texture) {
    return this.group(`More of texture ${unit}`, () => controlsOf(schemaOf('texture'), ofTexture, texture, (edit) => this.store.change('inputs', () => edit(texture)), { path: `texture${unit}.` }));
  }

  /** @param {'effect'|'scene'|'pass'} place @param {(object: any) => void} edit */
  edit(place, edit) {
    // Another program means another text in the editor.
    const old = passOf(this.store.state).program;
    this.store.change('inputs', (state) => {
      const { effect } = state;
      edit({ effect, scene: effect.scene, pass: passOf(state) }[place]);
    });
    if (passOf(this.store.state).program !== old) this.store.change('files', () => {});
  }
}
