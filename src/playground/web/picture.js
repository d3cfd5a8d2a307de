/**
 * The picture: zoom to pixels with the wheel, the keys + and -, or two buttons; a click or Enter chooses a pixel.
 */
import { element, paint } from './dom.js';

const zooms = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32];

export class Picture {
  /**
   * @param {HTMLElement} parent
   * @param {(x: number, y: number) => void} choose hears which pixel was chosen, counted from the upper left corner
   */
  constructor(parent, choose) {
    this.choose = choose;
    this.zoom = 0; // 0: as large as fits
    this.chosen = { x: 0, y: 0 };
    this.canvas = element('canvas', { width: 1, height: 1 });
    this.mark = element('div', { class: 'pixel-mark', hidden: true });
    this.stage = element('div', { class: 'picture-stage' }, this.canvas, this.mark);
    this.scroll = element('div', {
      class: 'picture-scroll', tabindex: 0, role: 'application',
      'aria-label': 'Picture. Arrow keys move the pixel mark, Enter traces the pixel, plus and minus zoom.',
      onkeydown: (event) => this.key(event), onclick: (event) => this.click(event),
      onmousemove: (event) => this.say(this.at(event)),
      onwheel: (event) => this.wheel(event),
    }, this.stage);
    this.status = element('output', { class: 'quiet', id: 'pixel-status' });
    const button = (text, label, run) => element('button', { type: 'button', class: 'small', 'aria-label': label, title: label, onclick: run }, text);
    this.bar = element('div', { class: 'bar' }, button('−', 'Zoom out', () => this.zoomBy(-1)), button('+', 'Zoom in', () => this.zoomBy(1)),
      button('Fit', 'Fit the picture', () => this.setZoom(0)), this.status);
    parent.append(this.scroll, this.bar);
    new ResizeObserver(() => this.layout()).observe(this.scroll);
  }

  /** @param {Uint8Array} pixels RGBA8 */
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
    return room >= 1 ? Math.floor(room) : room;
  }

  layout() {
    if (!this.width) return;
    const scale = this.scale();
    this.canvas.style.width = `${this.width * scale}px`;
    this.canvas.style.height = `${this.height * scale}px`;
    this.canvas.style.imageRendering = scale >= 1 ? 'pixelated' : 'auto';
    const side = Math.max(scale, 5);
    const shift = (scale - side) / 2;
    Object.assign(this.mark.style, {
      left: `${this.chosen.x * scale + shift}px`, top: `${this.chosen.y * scale + shift}px`, width: `${side}px`, height: `${side}px`,
    });
  }

  at(event) {
    const box = this.canvas.getBoundingClientRect();
    return {
      x: Math.floor((event.clientX - box.left) / box.width * this.width),
      y: Math.floor((event.clientY - box.top) / box.height * this.height),
    };
  }

  inside({ x, y }) {
    return this.pixels && x >= 0 && y >= 0 && x < this.width && y < this.height;
  }

  say(place) {
    if (!this.inside(place)) return;
    const from = (place.y * this.width + place.x) * 4;
    this.status.textContent = `(${place.x}, ${place.y}) = ${[...this.pixels.subarray(from, from + 4)].join(' ')}`;
  }

  click(event) {
    const place = this.at(event);
    if (this.inside(place)) this.take(place);
  }

  take(place) {
    this.mark.hidden = false;
    this.chosen = place;
    this.layout();
    this.say(place);
    this.choose(place.x, place.y);
  }

  zoomBy(steps, around) {
    const now = this.scale();
    const larger = zooms.findIndex((zoom) => zoom > now + 1e-6);
    const smaller = zooms.findLastIndex((zoom) => zoom < now - 1e-6);
    const found = steps > 0 ? (larger < 0 ? zooms.length - 1 : larger) : Math.max(0, smaller);
    this.setZoom(zooms[found], around);
  }

  /** @param {number} zoom @param {{x: number, y: number}} [around] the pixel that comes into the middle */
  setZoom(zoom, around = this.chosen) {
    this.zoom = zoom;
    this.layout();
    const scale = this.scale();
    this.scroll.scrollLeft = around.x * scale - this.scroll.clientWidth / 2;
    this.scroll.scrollTop = around.y * scale - this.scroll.clientHeight / 2;
  }

  wheel(event) {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const place = this.at(event);
    this.zoomBy(event.deltaY < 0 ? 1 : -1, this.inside(place) ? place : undefined);
  }

  key(event) {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (steps) {
      const place = { x: this.chosen.x + steps[0], y: this.chosen.y + steps[1] };
      if (!this.inside(place)) return;
      this.chosen = place;
      this.mark.hidden = false;
      this.layout();
      this.say(place);
    } else if (event.key === 'Enter') this.take(this.chosen);
    else if (event.key === '+' || event.key === '=') this.zoomBy(1);
    else if (event.key === '-') this.zoomBy(-1);
    else return;
    event.preventDefault();
  }
}
