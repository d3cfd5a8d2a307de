/**
 * The picture: zoom to pixels with the wheel, the keys + and -, or two buttons; a click or Enter chooses a pixel. Layers
 * lie over it.
 */
import { element, paint } from './dom.js';

const zooms = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32];

/** The steps of the arrow keys. @type {Map<string, [number, number]>} */
const arrows = new Map([['ArrowLeft', [-1, 0]], ['ArrowRight', [1, 0]], ['ArrowUp', [0, -1]], ['ArrowDown', [0, 1]]]);

/** @typedef {{x: number, y: number}} Place counted from the upper left corner */

export class Picture {
  /**
   * @param {HTMLElement} parent
   * @param {(x: number, y: number) => void} choose hears which pixel was chosen
   */
  constructor(parent, choose) {
    this.choose = choose;
    this.zoom = 0; // 0: as large as fits
    /** @type {Place} */
    this.chosen = { x: 0, y: 0 };
    this.width = 0;
    this.height = 0;
    /** RGBA8 of what is shown. @type {Uint8Array|null} */
    this.pixels = null;
    this.canvas = element('canvas', { width: 1, height: 1 });
    /** @type {HTMLCanvasElement[]} */
    this.layers = [];
    this.mark = element('div', { class: 'pixel-mark', hidden: true });
    this.stage = element('div', { class: 'picture-stage' }, this.canvas, this.mark);
    this.scroll = element('div', {
      class: 'picture-scroll', tabindex: 0, role: 'application',
      'aria-label': 'Picture. Arrow keys move the pixel mark, Enter traces the pixel, plus and minus zoom.',
      onkeydown: (/** @type {KeyboardEvent} */ event) => this.key(event), onclick: (/** @type {MouseEvent} */ event) => this.click(event),
      onmousemove: (/** @type {MouseEvent} */ event) => this.say(this.at(event)),
      onwheel: (/** @type {WheelEvent} */ event) => this.wheel(event),
    }, this.stage);
    this.status = element('output', { class: 'quiet', id: 'pixel-status' });
    const button = (/** @type {string} */ text, /** @type {string} */ label, /** @type {() => void} */ run) => element('button', { type: 'button', class: 'small', 'aria-label': label, title: label, onclick: run }, text);
    this.bar = element('div', { class: 'bar' }, button('−', 'Zoom out', () => this.zoomBy(-1)), button('+', 'Zoom in', () => this.zoomBy(1)),
      button('Fit', 'Fit the picture', () => this.setZoom(0)));
    /** Says under which profile the picture is, where that is not the usual one. */
    this.badge = element('p', { class: 'badge', hidden: true });
    parent.append(element('div', { class: 'picture-frame' }, this.scroll, this.badge), this.bar);
    new ResizeObserver(() => this.layout()).observe(this.scroll);
  }

  /** A canvas over the picture, of its size; it is hidden at first. @param {string} label */
  layer(label) {
    const canvas = element('canvas', { width: 1, height: 1, hidden: true, class: 'picture-layer', role: 'img', 'aria-label': label });
    this.layers.push(canvas);
    this.mark.before(canvas);
    this.layout();
    return canvas;
  }

  /** Makes the picture grey and dark, so that layers stand out. @param {boolean} dimmed */
  dim(dimmed) {
    this.canvas.classList.toggle('dimmed', dimmed);
  }

  /** @param {Uint8Array} pixels RGBA8 @param {number} width @param {number} height */
  show(pixels, width, height) {
    this.pixels = pixels;
    this.width = width;
    this.height = height;
    // Alpha is shown as opaque: the trace says what it is.
    const opaque = pixels.slice();
    for (let at = 3; at < opaque.length; at += 4) opaque[at] = 255;
    paint(this.canvas, opaque, width, height);
    if (!this.inside(this.chosen)) this.unmark();
    this.layout();
    this.say(this.chosen);
  }

  /** Takes the mark away: it was on another picture. */
  unmark() {
    this.mark.hidden = true;
    this.chosen = { x: 0, y: 0 };
  }

  scale() {
    if (this.zoom > 0) return this.zoom;
    const around = 28; // the space that style.css keeps around the picture
    const room = Math.min((this.scroll.clientWidth - around) / this.width, (this.scroll.clientHeight - around) / this.height);
    return room >= 2 ? Math.floor(room) : room;
  }

  layout() {
    if (!this.width) return;
    const scale = this.scale();
    for (const canvas of [this.canvas, ...this.layers]) {
      canvas.style.width = `${this.width * scale}px`;
      canvas.style.height = `${this.height * scale}px`;
      canvas.style.imageRendering = Number.isInteger(scale) ? 'pixelated' : 'auto';
    }
    const side = Math.max(scale, 5);
    const shift = (scale - side) / 2;
    Object.assign(this.mark.style, {
      left: `${this.chosen.x * scale + shift}px`, top: `${this.chosen.y * scale + shift}px`, width: `${side}px`, height: `${side}px`,
    });
  }

  /** @param {MouseEvent} event @returns {Place} */
  at(event) {
    const box = this.canvas.getBoundingClientRect();
    return {
      x: Math.floor((event.clientX - box.left) / box.width * this.width),
      y: Math.floor((event.clientY - box.top) / box.height * this.height),
    };
  }

  /** @param {Place} place */
  inside({ x, y }) {
    return this.pixels !== null && x >= 0 && y >= 0 && x < this.width && y < this.height;
  }

  /** Shows the colour of a pixel. @param {Place} place */
  say(place) {
    if (!this.pixels || !this.inside(place)) return;
    const from = (place.y * this.width + place.x) * 4;
    this.status.textContent = `(${place.x}, ${place.y}) = ${[...this.pixels.subarray(from, from + 4)].join(' ')}`;
  }

  /** @param {MouseEvent} event */
  click(event) {
    const place = this.at(event);
    if (this.inside(place)) this.take(place);
  }

  /** Marks a pixel. @param {Place} place */
  put(place) {
    this.mark.hidden = false;
    this.chosen = place;
    this.layout();
    this.say(place);
  }

  /** Marks a pixel and says that it was chosen. @param {Place} place */
  take(place) {
    this.put(place);
    this.choose(place.x, place.y);
  }

  /** A bright pixel, as one looks at first. @returns {Place} */
  brightest() {
    const pixels = this.pixels ?? new Uint8Array(4);
    let best = 0;
    let most = -1;
    for (let at = 0; at < pixels.length; at += 4) {
      const light = pixels[at] + pixels[at + 1] + pixels[at + 2];
      if (light > most && light < 3 * 250) [best, most] = [at / 4, light];
    }
    return { x: best % this.width, y: Math.floor(best / this.width) };
  }

  /** @param {number} steps @param {Place} [around] */
  zoomBy(steps, around) {
    const now = this.scale();
    const larger = zooms.findIndex((zoom) => zoom > now + 1e-6);
    const smaller = zooms.findLastIndex((zoom) => zoom < now - 1e-6);
    const found = steps > 0 ? (larger < 0 ? zooms.length - 1 : larger) : Math.max(0, smaller);
    this.setZoom(zooms[found], around);
  }

  /** @param {number} zoom @param {Place} [around] the pixel that comes into the middle */
  setZoom(zoom, around = this.chosen) {
    this.zoom = zoom;
    this.layout();
    const scale = this.scale();
    this.scroll.scrollLeft = around.x * scale - this.scroll.clientWidth / 2;
    this.scroll.scrollTop = around.y * scale - this.scroll.clientHeight / 2;
  }

  /** @param {WheelEvent} event */
  wheel(event) {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const place = this.at(event);
    this.zoomBy(event.deltaY < 0 ? 1 : -1, this.inside(place) ? place : undefined);
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const steps = arrows.get(event.key);
    if (steps) {
      const place = { x: this.chosen.x + steps[0], y: this.chosen.y + steps[1] };
      if (!this.inside(place)) return;
      this.put(place);
    } else if (event.key === 'Enter') this.take(this.chosen);
    else if (event.key === '+' || event.key === '=') this.zoomBy(1);
    else if (event.key === '-') this.zoomBy(-1);
    else return;
    event.preventDefault();
  }
}
