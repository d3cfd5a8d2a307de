/**
 * The gallery: every effect with a thumbnail that the engine draws when the gallery is opened, in the order in which they
 * are best learnt.
 */
import { element, messageOf, paint } from './dom.js';
import { stateOf } from './state.js';

const side = 128;

/** The groups, with the names of their effects; what no group has comes last. @type {[string, string[]][]} */
export const groups = [
  ['Pictures and colours: one pass, one or two combiners', ['sepia', 'threshold', 'night_vision', 'light_map_detail', 'edges', 'blur', 'nibbles']],
  ['Light and bumps: dot products on a mesh', ['emboss', 'dot3_diffuse', 'dot3_specular', 'normalize_cube', 'normalize_steps', 'hemisphere', 'toon', 'fresnel', 'fog']],
  ['Lights and shadows: several passes', ['point_light', 'spot_light', 'index_cube', 'depth16']],
  ['Texture shaders: stages before the combiners', ['water', 'palette', 'brdf_look_up', 'reflective_bumps', 'constant_eye', 'diffuse_specular', 'depth_balls', 'clip_planes']],
  ['Points and lines', ['sprites', 'engraving']],
];

export class Gallery {
  /**
   * @param {HTMLDialogElement} dialog
   * @param {{effects: Record<string, any>, programs: Record<string, string>}} content
   * @param {(state: import('./state.js').State) => Promise<any>} draw
   * @param {(state: import('./state.js').State) => void} open
   */
  constructor(dialog, content, draw, open) {
    this.dialog = dialog;
    this.content = content;
    this.draw = draw;
    this.open = open;
    const grouped = new Set(groups.flatMap(([, names]) => names));
    const others = Object.keys(content.effects).filter((name) => !grouped.has(name));
    const shown = [...groups, .../** @type {[string, string[]][]} */ (others.length ? [['More', others]] : [])];
    this.cards = shown.flatMap(([, names]) => names.filter((name) => Object.hasOwn(content.effects, name)).map((name) => this.card(name)));
    dialog.append(element('div', { class: 'bar' }, element('h2', {}, 'Gallery'),
      element('button', { type: 'button', class: 'small', onclick: () => dialog.close(), 'aria-label': 'Close the gallery' }, 'Close')),
    ...shown.flatMap(([title, names]) => [element('h3', {}, title),
      element('div', { class: 'gallery' }, ...this.cards.filter(({ name }) => names.includes(name)).map(({ button }) => button))]));
    dialog.addEventListener('click', (event) => {
      if (event.target === dialog) dialog.close();
    });
  }

  /** @param {string} name */
  card(name) {
    const effect = this.content.effects[name];
    const canvas = element('canvas', { width: side, height: side, 'aria-hidden': 'true' });
    const button = element('button', { type: 'button', class: 'card', 'data-effect': name, onclick: () => this.take(effect) },
      canvas, element('strong', {}, effect.title ?? name), element('span', { class: 'quiet' }, effect.note ?? ''));
    return { name, effect, canvas, button, drawn: false };
  }

  /** @param {any} effect */
  take(effect) {
    this.dialog.close();
    this.open(stateOf(effect, this.content.programs));
  }

  async show() {
    this.dialog.showModal();
    for (const card of this.cards) {
      if (!this.dialog.open) return;
      if (card.drawn) continue;
      try {
        const state = stateOf(card.effect, this.content.programs);
        const [width, height] = [card.effect.size ?? side].flat();
        const scale = side / Math.min(width, height ?? width);
        state.effect.size = [Math.round(width * scale), Math.round((height ?? width) * scale)];
        const { answer, bytes } = await this.draw(state);
        for (let at = 3; at < bytes.length; at += 4) bytes[at] = 255;
        paint(card.canvas, bytes, answer.width, answer.height);
        card.drawn = true;
      } catch (error) {
        card.canvas.title = messageOf(error);
      }
    }
  }
}
