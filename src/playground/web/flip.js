/**
 * The picture under the other profile, in place of the usual one: a button, and the key F.
 */
import { Replaced } from './engine_client.js';
import { element, messageOf } from './dom.js';

/** The engine's word for the same chip with exact combiners. */
export const exactCombiners = 'arithmetic';

/** A profile to compare with as one reads it. @param {string} other */
export const titleOfOther = (other) => (other === exactCombiners ? 'exact combiners' : other);

export class Flip {
  /**
   * @param {import('./state.js').Store} store
   * @param {import('./live.js').Live} live
   * @param {import('./picture.js').Picture} picture
   * @param {() => void} usual shows the usual picture
   */
  constructor(store, live, picture, usual) {
    this.store = store;
    this.live = live;
    this.picture = picture;
    this.usual = usual;
    this.on = false;
    /** Hears that the other picture will be shown. */
    this.onshow = () => {};
    this.button = element('button', {
      type: 'button', class: 'small', id: 'flip', 'aria-pressed': 'false', title: 'Show the picture under the other profile (F)', onclick: () => this.toggle(),
    }, 'Flip');
  }

  toggle() {
    this.set(!this.on);
  }

  /** @param {boolean} on */
  set(on) {
    if (on === this.on) return;
    if (on) this.onshow();
    this.on = on;
    this.button.setAttribute('aria-pressed', String(on));
    if (on) this.update();
    else {
      this.picture.badge.hidden = true;
      this.usual();
    }
  }

  /** Draws the other picture anew. */
  async update() {
    if (!this.on) return;
    const { profile, other } = this.store.state;
    const { badge } = this.picture;
    try {
      const { answer, bytes } = await this.live.compare([profile, other], 'flip');
      if (!this.on) return;
      const part = answer.width * answer.height * 4;
      this.picture.show(bytes.slice(part, 2 * part), answer.width, answer.height);
      const { pixels, max } = answer.difference;
      badge.textContent = `${titleOfOther(other)}: ${pixels.toLocaleString('en')} pixels differ, by ${max} at most`;
    } catch (error) {
      if (error instanceof Replaced || !this.on) return;
      badge.textContent = `${titleOfOther(other)}: ${messageOf(error)}`;
    }
    badge.hidden = false;
  }
}
