/**
 * Marks over the picture where the combiners lost something: by kind of loss and by stage.
 */
import { choice, element } from './dom.js';
import { Replaced } from './engine_client.js';

/** @typedef {{width: number, height: number, general_combiners: number}} Losses */

/** The kinds of loss: the value of a byte of the engine's planes that has it, 0 for none. @type {Map<string, {title: string, color: number[], of: (byte: number) => number}>} */
const kinds = new Map([
  ['truncated', { title: 'truncated', color: [255, 186, 51], of: (byte) => byte & 1 }],
  ['clamped', { title: 'clamped', color: [255, 77, 77], of: (byte) => byte >> 1 & 1 }],
  ['differs', { title: 'off by ½ code or more', color: [120, 190, 255], of: (byte) => byte >> 2 }],
]);

/** @param {number} stage @param {number} combiners */
const stageTitle = (stage, combiners) => (stage === combiners ? 'the final combiner' : `general combiner ${stage}`);

export class LossesOverlay {
  /**
   * @param {import('./state.js').Store} store
   * @param {import('./live.js').Live} live
   * @param {import('./picture.js').Picture} picture
   * @param {() => void} changed hears that another overlay was chosen
   */
  constructor(store, live, picture, changed) {
    this.store = store;
    this.live = live;
    this.picture = picture;
    this.changed = changed;
    /** What is marked, a key of `kinds`; empty: nothing. */
    this.kind = '';
    /** The number of a stage; empty: any. */
    this.stage = '';
    /** Whether the picture is the effect's. */
    this.visible = true;
    /** Whether the picture changes all the time, so that marks would be those of an older one. */
    this.held = false;
    /** @type {{losses: Losses, planes: Uint8Array}|null} */
    this.found = null;
    this.layer = picture.layer('Where the combiners lost something');
    this.text = element('span', { class: 'quiet', id: 'losses-result', role: 'status' });
    this.stages = element('span');
    this.element = element('div', { class: 'losses', id: 'losses' }, this.kinds(), this.stages, this.text);
  }

  kinds() {
    /** @type {[string, string][]} */
    const options = [['', 'no losses'], ...[...kinds].map(([key, { title }]) => /** @type {[string, string]} */ ([key, title]))];
    const control = choice('Mark', options, this.kind, (value) => this.take(value, this.stage));
    control.querySelector('select').id = 'mark-losses';
    return control;
  }

  /** @param {string} kind @param {string} stage */
  take(kind, stage) {
    this.kind = kinds.has(kind) ? kind : '';
    this.stage = stage;
    this.element.firstChild.replaceWith(this.kinds());
    this.changed();
    this.update();
  }

  /** @param {boolean} visible */
  see(visible) {
    this.visible = visible;
    this.element.hidden = !visible;
    this.update();
  }

  /** Hides the marks until the picture stays. */
  hold() {
    this.held = true;
    this.update();
  }

  async update() {
    const wanted = this.visible && this.kind;
    if (!wanted || this.held) {
      this.layer.hidden = true;
      this.text.textContent = wanted ? 'marked once it pauses' : '';
      this.stages.replaceChildren();
      if (this.visible) this.picture.dim(false);
      return;
    }
    try {
      const { answer, bytes } = await this.live.losses();
      this.found = { losses: answer, planes: bytes };
      this.mark();
    } catch (error) {
      if (error instanceof Replaced || this.held) return;
      this.found = null;
      this.layer.hidden = true;
      this.picture.dim(false);
      this.text.textContent = error instanceof Error ? error.message : String(error);
    }
  }

  mark() {
    if (!this.found || !this.visible || !this.kind || this.held) return;
    const { losses, planes } = this.found;
    const { width, height, general_combiners: combiners } = losses;
    const kind = /** @type {{title: string, color: number[], of: (byte: number) => number}} */ (kinds.get(this.kind));
    if (Number(this.stage) > combiners) this.stage = '';
    const each = width * height;
    const image = new ImageData(width, height);
    const stages = this.stage === '' ? [...Array(combiners + 1).keys()] : [Number(this.stage)];
    let marked = 0, most = 0;
    const values = new Uint8Array(each);
    for (const stage of stages) {
      for (let at = 0; at < each; at++) values[at] = Math.max(values[at], kind.of(planes[stage * each + at]));
    }
    for (const value of values) {
      marked += value ? 1 : 0;
      most = Math.max(most, value);
    }
    for (let at = 0; at < each; at++) {
      if (!values[at]) continue;
      const strength = this.kind === 'differs' ? 0.35 + 0.65 * values[at] / most : 1;
      image.data.set([...kind.color.map((part) => part * strength), 255], at * 4);
    }
    this.layer.width = width;
    this.layer.height = height;
    this.layer.getContext('2d')?.putImageData(image, 0, 0);
    this.layer.hidden = false;
    this.picture.dim(true);
    this.picture.layout();
    this.showStages(combiners);
    const share = (100 * marked / each).toFixed(1);
    const by = this.kind === 'differs' && most ? `, by ${most === 63 ? '63 codes or more' : `${most} ${most === 1 ? 'code' : 'codes'}`} at most` : '';
    this.text.textContent = `${marked.toLocaleString('en')} pixels (${share} %)${by}`;
    this.text.dataset.marked = String(marked);
  }

  /** @param {number} combiners */
  showStages(combiners) {
    if (this.stages.contains(document.activeElement) && this.stages.dataset.combiners === String(combiners)) return;
    this.stages.dataset.combiners = String(combiners);
    /** @type {[string, string][]} */
    const options = [['', 'any stage'], ...[...Array(combiners + 1).keys()].map((stage) => /** @type {[string, string]} */ ([String(stage), stageTitle(stage, combiners)]))];
    const control = choice('in', options, this.stage, (value) => {
      this.stage = value;
      this.changed();
      this.mark();
    });
    control.querySelector('select').id = 'mark-stage';
    this.stages.replaceChildren(control);
  }
}
