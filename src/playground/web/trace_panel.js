/**
 * The trace of the chosen pixel, as the diagram of the room `page` draws it.
 */
import { traceDiagram } from '../../page/web/trace_diagram.js';
import { choice } from './dom.js';

/**
 * What the texture-shader stages before the combiners did to the traced fragment, a line a stage; empty: there are none.
 * @param {any} effect
 */
function stageLines(effect) {
  const drawn = (effect.passes ?? []).find(({ name }) => name === effect.pass);
  const stages = drawn?.fragments?.[effect.fragment]?.stages ?? [];
  return stages.map((stage, number) => {
    const line = document.createElement('p');
    line.textContent = `texture stage ${number}: ${stage.text}`;
    return line;
  });
}

export class TracePanel {
  /**
   * @param {HTMLElement} parent
   * @param {HTMLElement} place says which pixel it is
   * @param {(pass: string) => void} choose hears which of the pixel's passes to trace
   */
  constructor(parent, place, choose) {
    Object.assign(this, { parent, place, choose });
    /** The object that `ninebit trace --json` prints. */
    this.trace = null;
  }

  clear() {
    this.trace = null;
    this.parent.replaceChildren();
    this.place.textContent = 'Click a pixel of the picture, or move there with the arrow keys and press Enter.';
  }

  /** @param {any} trace @param {{x: number, y: number}} pixel @param {string} [pass] the one that was chosen */
  show(trace, pixel, pass) {
    this.parent.replaceChildren();
    this.trace = null;
    const where = `Pixel (${pixel.x}, ${pixel.y})`;
    if (trace.error) {
      this.place.textContent = `${where}: ${trace.error.message}`;
      return;
    }
    this.trace = trace;
    const effect = trace.effect ?? {};
    const fragments = (effect.passes ?? []).flatMap((pass) => (pass.fragments ?? []).map((fragment) => `${pass.name}: ${fragment.fate}`));
    this.place.textContent = [where, effect.pass && `pass ${effect.pass}`, ...fragments].filter(Boolean).join(', ');
    const names = (effect.passes ?? []).filter((drawn) => drawn.fragments?.length).map((drawn) => drawn.name);
    if (names.length > 1) this.place.append(' ', choice('Pass', names, pass ?? effect.pass ?? names[0], this.choose));
    this.parent.append(...stageLines(effect));
    if (trace.stages) traceDiagram(this.parent, trace, {});
  }
}
