// The diagram of one fragment's trace, as the hardware's block picture.
//
//   //   const diagram = traceDiagram(element, trace);  // trace: the object that `ninebit trace --json` prints
//
// It fills the element. The result has step(n) (0: everything is shown), count (the number of steps), remove(), and
// light(ids), which lights boxes by their ids, such as "stage0/rgb-ab", with the wires into them.
// Texts from the trace only ever become text nodes.
import { addStyleOnce, boxElement, legend, make, sectionElements, toolbar, wireElements } from './diagram_elements.js';
import { layOut } from './diagram_layout.js';
import { factsOf, heldText, isSingle, kGlyphs, placeOf, realText } from './diagram_words.js';
import { addEquations, programModel } from './program_model.js';
import { traceModel } from './trace_model.js';

const kValuedWidth = 204;
const kPlainWidth = 158;
const kPaperWidth = 700;  // of A4 between margins of 12 mm

function ancestorsOf(cell) {
  const found = new Set([cell]);
  for (const one of found) for (const parent of one.parents) found.add(parent);
  return found;
}

// The boxes in the order of evaluation; all registers that a combiner reads are one step.
function stepsOf(model) {
  const steps = [];
  for (const section of model.sections) {
    const registers = section.boxes.filter((b) => b.group === 'in');
    if (registers.length) steps.push(registers);
    for (const box of section.boxes) if (box.group !== 'in') steps.push([box]);
  }
  return steps;
}

// The value that a wire leads to: the first one of its box that was computed from the other box.
function readerOf(wire) {
  const cells = wire?.to.parts.flatMap((part) => part.cells);
  return cells?.find((cell) => cell.parents.some((parent) => parent.box === wire.from)) ?? cells?.[0];
}

// A cell's name and value, for the line above the diagram.
function say(said, cell, model) {
  const { place: where, what, channel } = placeOf(cell);
  const { values, loss } = factsOf(cell, model.one);
  const title = make('div');
  title.append(make('span', 'nb-place', where), make('span', '', cell.whole ? what : `${what}, ${channel}`));
  const line = make('div');
  for (const [name, text] of values) {
    const value = make('span', 'nb-value');
    value.append(make('i', '', `${name} `), text);
    line.append(value);
  }
  if (loss) line.append(make('span', `nb-${cell.mark.kind}`, `${kGlyphs[cell.mark.kind]} ${loss}`));
  said.replaceChildren(title, line);
}

// Lights cells; `cell` is the one that was chosen.
function light(root, model, layout, lit, cell) {
  root.classList.toggle('nb-tracing', lit.size > 0);
  const boxes = new Set([...lit].map((c) => c.box));
  for (const one of model.cells.values()) {
    one.element.classList.toggle('nb-lit', lit.has(one));
    one.element.classList.toggle('nb-chosen', one === cell);
  }
  for (const section of model.sections) for (const box of section.boxes) box.element.classList.toggle('nb-lit', boxes.has(box));
  const used = new Set();
  for (const one of lit) for (const parent of one.parents) used.add(`${parent.box.id}>${one.box.id}`);
  for (const wire of layout.wires) wire.element.classList.toggle('nb-lit', used.has(`${wire.from.id}>${wire.to.id}`));
}

class Diagram {
  constructor(container, model, boxWidth, hint, chosen) {
    this.model = model;
    this.heard = chosen ?? (() => {});
    this.hint = hint;
    this.layout = layOut(model, boxWidth);
    this.steps = stepsOf(model);
    this.now = 0;
    this.pinned = null;
    this.root = make('div', 'nb-diagram');
    this.bar = toolbar(this.steps.length);
    if (model.valued) this.bar.bar.append(legend(model));
    this.said = make('div', 'nb-said');
    this.said.setAttribute('role', 'status');
    this.scroll = make('div', 'nb-scroll');
    this.scroll.tabIndex = 0;
    this.scroll.setAttribute('role', 'group');
    this.scroll.setAttribute('aria-label', 'Diagram. Left and right arrow: step. Up and down arrow: choose a value. Escape: show all.');
    const sheet = make('div', 'nb-sheet');
    sheet.style.width = `${this.layout.width}px`;
    sheet.style.height = `${this.layout.height}px`;
    sheet.style.setProperty('--nb-print-zoom', Math.min(1, kPaperWidth / this.layout.width));
    sheet.append(wireElements(this.layout));
    for (const section of model.sections) {
      sheet.append(...sectionElements(section, model, boxWidth), ...section.boxes.map((box) => boxElement(box, model)));
    }
    this.scroll.append(sheet);
    this.root.append(this.bar.bar, this.said, this.scroll);
    container.replaceChildren(this.root);
    this.listen();
    this.step(0);
  }

  listen() {
    this.bar.back.addEventListener('click', () => this.step(this.now - 1));
    this.bar.forward.addEventListener('click', () => this.step(this.now + 1));
    this.bar.all.addEventListener('click', () => this.clear());
    this.bar.range.addEventListener('input', () => this.step(Number(this.bar.range.value)));
    const cellAt = (event) => (event.target.closest?.('.nb-cell') ?? event.target.closest?.('.nb-box'))?.nbCell ?? readerOf(event.target.nbWire);
    this.scroll.addEventListener('pointerover', (event) => { if (event.pointerType !== 'touch' && !this.pinned) this.choose(cellAt(event)); });
    this.scroll.addEventListener('pointerleave', () => { if (!this.pinned) this.choose(undefined); });
    this.scroll.addEventListener('focusin', (event) => { if (cellAt(event)) this.choose(cellAt(event)); });
    this.scroll.addEventListener('click', (event) => {
      const cell = cellAt(event);
      this.pinned = cell && cell !== this.pinned ? cell : null;
      this.choose(cell);
      if (cell) this.chosen = cell;
    });
    this.root.addEventListener('keydown', (event) => this.key(event));
  }

  key(event) {
    if (event.altKey || event.ctrlKey || event.metaKey || event.target === this.bar.range) return;
    const actions = {
      ArrowLeft: () => this.step(this.now - 1), ArrowRight: () => this.step(this.now + 1),
      ArrowDown: () => this.move(1), ArrowUp: () => this.move(-1), Escape: () => this.clear(),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  }

  // The next or previous value in the order of evaluation gets the focus.
  move(by) {
    const cells = this.steps.flat().flatMap((box) => box.parts.flatMap((part) => part.cells));
    const at = cells.indexOf(this.chosen);
    const next = cells[Math.min(cells.length - 1, Math.max(0, at < 0 ? (by > 0 ? 0 : cells.length - 1) : at + by))];
    this.pinned = next;
    next.element.focus({ preventScroll: true });
    next.element.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }

  choose(cell) {
    if (cell) this.chosen = cell;
    light(this.root, this.model, this.layout, cell ? ancestorsOf(cell) : new Set(), cell);
    this.heard(cell?.box.id);
    if (cell) say(this.said, cell, this.model);
    else this.sayStep();
  }

  // Lights boxes by their ids, unless a value is pinned.
  lightBoxes(ids) {
    if (this.pinned) return;
    const wanted = new Set(ids);
    light(this.root, this.model, this.layout, new Set([...this.model.cells.values()].filter((cell) => wanted.has(cell.box.id))), undefined);
    for (const section of this.model.sections) {
      const box = section.boxes.find(({ id }) => wanted.has(id));
      if (box) return box.element.scrollIntoView({ block: 'nearest', inline: 'nearest' });
    }
  }

  clear() {
    this.pinned = null;
    this.chosen = undefined;
    this.step(0);
  }

  step(to) {
    this.now = Math.min(this.steps.length, Math.max(0, to));
    this.pinned = null;
    const shown = new Set(this.steps.slice(0, this.now).flat());
    const current = new Set(this.now ? this.steps[this.now - 1] : []);
    const pending = (box) => this.now !== 0 && !shown.has(box);
    for (const box of this.steps.flat()) {
      box.element.classList.toggle('nb-pending', pending(box));
      box.element.classList.toggle('nb-current', current.has(box));
    }
    for (const wire of this.layout.wires) wire.element.classList.toggle('nb-pending', pending(wire.from) || pending(wire.to));
    this.bar.back.disabled = this.now === 0;
    this.bar.forward.disabled = this.now === this.steps.length;
    this.bar.range.value = this.now;
    this.bar.text.textContent = this.now ? `step ${this.now} of ${this.steps.length}` : `${this.steps.length} steps`;
    for (const box of current) box.element.scrollIntoView({ block: 'nearest', inline: 'nearest' });
    this.choose(undefined);
  }

  sayStep() {
    if (!this.now) {
      this.said.replaceChildren(make('div', 'nb-place', this.hint));
      return;
    }
    const boxes = this.steps[this.now - 1];
    const title = make('div');
    title.append(make('span', 'nb-place', placeOf(boxes[0].parts[0].cells[0]).place), make('b', '', boxes.map((b) => b.title).join(', ')));
    if (boxes.length === 1) title.append(`, ${boxes[0].sub}`);
    const line = make('div');
    for (const box of boxes.slice(0, 3)) {
      for (const { label, value } of box.parts.at(-1).cells) {
        if (!value) continue;
        const item = make('span', 'nb-value');
        item.append(make('i', '', `${boxes.length > 1 ? `${box.title}.` : ''}${label} `), isSingle(value) ? heldText(value) : `${heldText(value)} (${realText(value.real)})`);
        line.append(item);
      }
    }
    if (boxes.length > 3) line.append('…');
    this.said.replaceChildren(title, line);
  }
}

// Draws `model` in the container; see traceDiagram.
export function drawModel(container, model, boxWidth, hint, chosen) {
  addStyleOnce();
  const diagram = new Diagram(container, model, boxWidth, hint, chosen);
  return {
    count: diagram.steps.length,
    step: (n) => diagram.step(n),
    remove: () => diagram.root.remove(),
    light: (ids) => diagram.lightBoxes(ids),
  };
}

function drawWith(container, model, width, hint, options) {
  if (options.explanation) addEquations(model.sections, options.explanation);
  const drawn = drawModel(container, model, width, hint, options.chosen);
  if (options.maxHeight) container.firstChild.style.setProperty('--nb-max-height', options.maxHeight);
  return drawn;
}

// options: {maxHeight, explanation, chosen}: a CSS length, so that the diagram also scrolls vertically inside its own
// box; the object that `ninebit explain --json` prints, whose equations then stand in the diagram; and a function that
// hears the id of the box that is pointed at, or undefined.
export function traceDiagram(container, trace, options = {}) {
  const hint = 'Point at a value to see what it was computed from. Step with the arrow keys or the buttons.';
  return drawWith(container, traceModel(trace), kValuedWidth, hint, options);
}

// The same picture of a program without a fragment. program: the JSON form that `ninebit convert --to json` prints.
export function programDiagram(container, program, options = {}) {
  const hint = 'Point at a unit to see what it depends on. Step with the arrow keys or the buttons.';
  return drawWith(container, programModel(program), kPlainWidth, hint, options);
}
