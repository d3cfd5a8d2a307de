/**
 * The trace of the chosen pixel, as the diagram of the room `page` draws it.
 */
import { traceDiagram } from '../../page/web/trace_diagram.js';

export class TracePanel {
  /** @param {HTMLElement} parent @param {HTMLElement} place says which pixel it is */
  constructor(parent, place) {
    Object.assign(this, { parent, place });
    /** The object that `ninebit trace --json` prints. */
    this.trace = null;
  }

  clear() {
    this.trace = null;
    this.parent.replaceChildren();
    this.place.textContent = 'Click a pixel of the picture, or move there with the arrow keys and press Enter.';
  }

  /** @param {any} trace @param {{x: number, y: number}} pixel */
  show(trace, pixel) {
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
    this.place.textContent = [where, effect.pass && `pass ${effect.pass}`, ...fragments].filter(Boolean).join(' · ');
    if (trace.stages) traceDiagram(this.parent, trace, {});
  }
}
