/**
 * The program in every other form, each under a tab, with a button that copies it.
 */
import { element, messageOf } from './dom.js';
import { Replaced } from './engine_client.js';

export class ConvertPanel {
  /**
   * @param {HTMLElement} parent
   * @param {{name: string, title: string}[]} forms that the engine writes
   * @param {(to: string) => Promise<any>} convert asks the engine
   */
  constructor(parent, forms, convert) {
    this.parent = parent;
    this.convert = convert;
    this.to = 'gl';
    this.text = element('pre', { tabindex: 0, 'aria-label': 'Converted program' });
    this.buttons = forms.map(({ name: form, title }) => element('button', {
      type: 'button', class: 'small', 'data-form': form, 'aria-pressed': form === this.to, onclick: () => this.choose(form),
    }, title));
    const copy = element('button', { type: 'button', class: 'small', onclick: () => navigator.clipboard?.writeText(this.text.textContent) }, 'Copy');
    parent.append(element('div', { class: 'bar' }, ...this.buttons, copy), this.text);
  }

  /** @param {string} form */
  choose(form) {
    this.to = form;
    for (const button of this.buttons) button.setAttribute('aria-pressed', String(button.dataset.form === form));
    this.update();
  }

  async update() {
    if (this.parent.hidden) return;
    try {
      const { answer } = await this.convert(this.to);
      this.text.textContent = answer.text;
    } catch (error) {
      if (!(error instanceof Replaced)) this.text.textContent = messageOf(error);
    }
  }
}
