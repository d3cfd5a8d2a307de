/**
 * The wrong pixels of a picture: their count, and marks over the picture.
 */
import { causeColors, causeHelp, wrongPixels } from '../../page/web/wrong_pixels.js';
import { choice, element } from './dom.js';

const marks = [['', 'not marked'], ['points', 'in the colour of their cause'], ['heat', 'as a heat map']];
const grouped = (/** @type {number} */ number) => number.toLocaleString('en');

export class WrongPixels {
  /**
   * @param {import('./picture.js').Picture} picture the marks are over it
   * @param {() => void} changed hears that counting was switched on or off
   */
  constructor(picture, changed) {
    this.canvas = picture;
    /** Whether the picture is the one whose pixels are counted. */
    this.visible = false;
    /** Whether to count. */
    this.wanted = true;
    this.marks = '';
    /** The request of the picture that is shown. @type {any} */
    this.picture = null;
    /** The last judgement. @type {{request: any, judgement: import('./judge.js').Judgement, plane: Uint8Array}|null} */
    this.last = null;
    this.text = element('p', { role: 'status', id: 'wrong-result' });
    this.legend = element('ul', { class: 'legend', hidden: true });
    const box = element('input', { type: 'checkbox', id: 'count-wrong', onchange: () => this.switchTo(box.checked, changed) });
    box.checked = true;
    const shown = choice('Wrong pixels', marks, '', (value) => {
      this.marks = value;
      this.mark();
    });
    shown.querySelector('select').id = 'mark-wrong';
    this.element = element('div', { class: 'wrong' }, element('div', { class: 'shadow-controls' },
      element('label', { class: 'field' }, box, element('span', {}, 'Count wrong pixels by rays')), shown), this.text, this.legend);
    this.overlay = picture.layer('Wrong pixels');
  }

  /** @param {boolean} visible */
  see(visible) {
    this.visible = visible;
    this.mark();
  }

  /** @param {boolean} wanted @param {() => void} changed */
  switchTo(wanted, changed) {
    this.wanted = wanted;
    this.last = null;
    delete this.text.dataset.wrong;
    this.text.textContent = '';
    this.mark();
    changed();
  }

  /** Hears which picture is shown: marks of another one go. @param {any} request */
  pictureIs(request) {
    this.picture = request;
    delete this.text.dataset.wrong;
    this.mark();
  }

  /** @param {number} share of the rows that are judged */
  progress(share) {
    const before = this.last ? `${this.sentence(this.last.judgement)} ` : '';
    this.text.textContent = `${before}(judging: ${Math.round(share * 100)} %)`;
  }

  /** @param {Error} error */
  failed(error) {
    this.last = null;
    this.text.textContent = `Wrong pixels are not counted: ${error.message}`;
  }

  /** @param {any} request @param {import('./judge.js').Judgement} judgement @param {Uint8Array} plane */
  judged(request, judgement, plane) {
    this.last = { request, judgement, plane };
    this.text.textContent = this.sentence(judgement);
    if (request === this.picture) this.text.dataset.wrong = JSON.stringify(judgement.errors);
    this.mark();
  }

  /** @param {import('./judge.js').Judgement} judgement */
  sentence({ errors, pixels }) {
    const wrong = errors.false_lit + errors.false_shadowed;
    const share = (100 * wrong / Math.max(1, pixels.lit + pixels.shadowed)).toFixed(2);
    const causes = Object.entries(errors.by_cause).filter(([, count]) => count).map(([name, count]) => `${grouped(count)} ${name}`);
    return `${grouped(wrong)} wrong pixels (${share} % of the scene): ${grouped(errors.false_lit)} falsely lit, ` +
      `${grouped(errors.false_shadowed)} falsely shadowed${causes.length ? `; ${causes.join(', ')}` : ''}.`;
  }

  mark() {
    const current = Boolean(this.visible && this.marks && this.last && this.last.request === this.picture);
    this.overlay.hidden = !current;
    if (this.visible) this.canvas.dim(current);
    this.legend.hidden = !current || this.marks !== 'points';
    if (!current || !this.last) return;
    const { judgement, plane } = this.last;
    const painter = wrongPixels(judgement.width, judgement.height, judgement.causes);
    const row = { plane };
    const heat = () => {
      const density = painter.densityOf(row, 0);
      return painter.heatOf(density, density.reduce((most, value) => Math.max(most, value), 1e-9));
    };
    const drawn = this.marks === 'points' ? painter.pointsOf(row, 0) : heat();
    this.overlay.width = judgement.width;
    this.overlay.height = judgement.height;
    this.overlay.getContext('2d').drawImage(drawn, 0, 0);
    const found = Object.entries(judgement.errors.by_cause).filter(([, count]) => count);
    this.legend.replaceChildren(...found.map(([name]) => element('li', {}, element('span', { class: 'chip', style: `background: ${causeColors[name]}` }),
      element('b', {}, name), ` ${causeHelp[name] ?? ''}`)));
  }
}
