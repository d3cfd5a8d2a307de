/**
 * The trace of the chosen pixel, as the diagram of the room `page` draws it. A line of the program lights up its boxes, and
 * a box its lines.
 */
import { traceDiagram } from '../../page/web/trace_diagram.js';
import { choice } from './dom.js';
import { boxesOfLines } from './source_lines.js';
import { passOf, programOf } from './state.js';

export class TracePanel {
  /**
   * @param {HTMLElement} parent
   * @param {HTMLElement} place says which pixel it is
   * @param {(pass: string) => void} choose hears which of the pixel's passes to trace
   * @param {(lines: number[]) => void} light hears which lines of the program a box is about, counted from 1
   */
  constructor(parent, place, choose, light) {
    this.parent = parent;
    this.place = place;
    this.choose = choose;
    this.light = light;
    /** The object that `ninebit trace --json` prints. @type {any} */
    this.trace = null;
    /** @type {{light: (ids: string[]) => void}|null} */
    this.diagram = null;
    /** The boxes of each line of the traced program, if it is the one that is edited. @type {string[][]} */
    this.lines = [];
  }

  clear() {
    this.trace = null;
    this.diagram = null;
    this.lines = [];
    this.parent.replaceChildren();
    this.place.textContent = 'Click a pixel of the picture, or move there with the arrow keys and press Enter.';
  }

  /**
   * @param {any} trace
   * @param {{x: number, y: number}} pixel
   * @param {string|undefined} pass the one that was chosen
   * @param {import('./state.js').State} state
   */
  show(trace, pixel, pass, state) {
    this.parent.replaceChildren();
    this.trace = null;
    this.diagram = null;
    const where = `Pixel (${pixel.x}, ${pixel.y})`;
    if (trace.error) {
      this.place.textContent = `${where}: ${trace.error.message}`;
      return;
    }
    this.trace = trace;
    const effect = trace.effect ?? {};
    const passes = /** @type {any[]} */ (effect.passes ?? []);
    const fragments = passes.flatMap(({ name, fragments: drawn }) => (drawn ?? []).map((/** @type {any} */ fragment) => `${name}: ${fragment.fate}`));
    this.place.textContent = [where, effect.pass && `pass ${effect.pass}`, ...fragments].filter(Boolean).join(', ');
    const names = passes.filter((drawn) => drawn.fragments?.length).map((drawn) => drawn.name);
    if (names.length > 1) this.place.append(' ', choice('Pass', names, pass ?? effect.pass ?? names[0], this.choose));
    if (!trace.stages) return;
    this.lines = this.linesOf(effect.pass, state, trace.stages.length);
    const diagram = document.createElement('div');
    this.parent.append(diagram);
    this.diagram = traceDiagram(diagram, trace, { chosen: (/** @type {string|undefined} */ box) => this.chosen(box) });
  }

  /** @param {string|null} pass @param {import('./state.js').State} state @param {number} stages of the traced program */
  linesOf(pass, state, stages) {
    const names = state.effect.passes.map((/** @type {any} */ { name }, /** @type {number} */ at) => name ?? `pass ${at + 1}`);
    const traced = state.effect.passes[names.indexOf(pass)];
    const { program } = passOf(state);
    return traced && program && traced.program === program ? boxesOfLines(programOf(state) ?? '', stages) : [];
  }

  /** @param {string|undefined} box */
  chosen(box) {
    this.light(box ? this.lines.flatMap((boxes, at) => (boxes.includes(box) ? [at + 1] : [])) : []);
  }

  /** Lights the boxes of a line of the program, counted from 1. @param {number} line */
  lightLine(line) {
    const boxes = this.lines[line - 1] ?? [];
    if (this.lines.length) this.diagram?.light(boxes);
  }
}
