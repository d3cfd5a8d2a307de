/**
 * The gallery: every effect with a thumbnail that the engine draws when the gallery is opened.
 */
import { element, paint } from './dom.js';
import { stateOf } from './state.js';

const side = 128;

export class Gallery {
  /**
   * @param {HTMLDialogElement} dialog
   * @param {{effects: Record<string, any>, programs: Record<string, string>}} content
   * @param {(state: import('./state.js').State) => Promise<any>} draw
   * @param {(state: import('./state.js').State) => void} open
   */
  constructor(dialog, content, draw, open) {
    Object.assign(this, { dialog, content, draw, open });
    this.cards = Object.entries(content.effects).map(([name, effect]) => {
      const canvas = element('canvas', { width: side, height: side, 'aria-hidden': 'true' });
      const button = element('button', { type: 'button', class: 'card', 'data-effect': name, onclick: () => this.take(effect) },
        canvas, element('strong', {}, effect.title ?? name), element('span', { class: 'quiet' }, effect.note ?? ''));
      return { name, effect, canvas, button, drawn: false };
    });
    dialog.append(element('div', { class: 'bar' }, element('h2', {}, 'Gallery'),
      element('button', { type: 'button', class: 'small', onclick: () => dialog.close(), 'aria-label': 'Close the gallery' }, 'Close')),
    element('div', { class: 'gallery' }, ...this.cards.map(({ button }) => button)));
    dialog.addEventListener('click', (event) => {
      if (event.target === dialog) dialog.close();
    });
  }

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
        card.canvas.title = error.message;
      }
    }
  }
}
