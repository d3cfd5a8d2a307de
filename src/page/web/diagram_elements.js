// The elements of the diagram. Texts only ever become text nodes.
import { kDiagramStyle } from './diagram_style.js';
import { differs, heldText, isSingle, kGlyphs, realText, spoken } from './diagram_words.js';

const kSvg = 'http://www.w3.org/2000/svg';
export function make(tag, className, text) {
  const element = document.createElement(tag);
  if (className) element.className = className;
  if (text !== undefined) element.textContent = text;
  return element;
}

function place(element, x, y, width, height) {
  element.style.left = `${x}px`;
  element.style.top = `${y}px`;
  if (width !== undefined) element.style.width = `${width}px`;
  if (height !== undefined) element.style.height = `${height}px`;
  return element;
}

export function addStyleOnce() {
  if (document.getElementById('nb-diagram-style')) return;
  const style = make('style', '', kDiagramStyle);
  style.id = 'nb-diagram-style';
  document.head.append(style);
}

function cellElement(cell, model) {
  const element = make('div', 'nb-cell');
  const { value, mark } = cell;
  element.append(make('span', '', cell.label), make('span', 'nb-glyph', mark ? kGlyphs[mark.kind] : ''));
  element.classList.toggle('nb-word', !value);
  if (value) {
    element.append(make('span', 'nb-held', heldText(value)));
    element.classList.toggle('nb-single', isSingle(value));
    if (!isSingle(value)) element.append(make('span', 'nb-real', realText(value.real)), make('span', 'nb-ideal', realText(value.ideal)));
    element.classList.toggle('nb-differs', differs(value));
  }
  if (mark) element.classList.add(`nb-${mark.kind}`);
  element.setAttribute('role', 'img');
  stand(element, cell, model);
  return element;
}

// Lets the element be what is pointed at and focused for the cell.
function stand(element, cell, model) {
  element.tabIndex = -1;
  element.setAttribute('aria-label', spoken(cell, model.one));
  element.nbCell = cell;
  cell.element = element;
}

export function boxElement(box, model) {
  const element = place(make('div', `nb-box nb-${box.kind}`), box.x, box.y, box.w, box.h);
  element.setAttribute('role', 'group');
  element.setAttribute('aria-label', `${box.section.title}: ${box.title}, ${box.sub}`);
  const head = make('header');
  head.append(make('b', '', box.title), make('small', '', box.sub));
  head.title = `${box.title}\n${box.sub}`;
  if (box.symbol) head.append(make('span', box.symbol.length > 1 ? 'nb-symbol nb-long' : 'nb-symbol', box.symbol));
  if (box.bytes) {
    const swatch = make('span', 'nb-swatch');
    swatch.style.background = `rgb(${box.bytes.slice(0, 3).map(Number).join(' ')})`;
    head.append(swatch);
  }
  element.append(head);
  for (const part of box.parts) {
    if (part.caption) {
      const caption = make('div', 'nb-caption');
      caption.append(make('span', '', part.caption));
      const mark = part.cells.find((c) => c.mark)?.mark;
      if (mark) caption.append(make('span', `nb-mark nb-${mark.kind}`, `${kGlyphs[mark.kind]} ${mark.kind}`));
      element.append(caption);
    }
    for (const cell of part.cells) {
      if (cell.whole) stand(element, cell, model);
      else element.append(cellElement(cell, model));
    }
  }
  box.element = element;
  return element;
}

export function sectionElements(section, model, boxWidth) {
  const head = place(make('section', 'nb-section'), section.columnX[0], section.y, undefined, 22);
  head.append(make('h3', '', section.title));
  const elements = [head];
  section.columns.forEach((name, i) => {
    if (!section.boxes.some((box) => box.column === i)) return;
    const column = place(make('div', 'nb-column', name), section.columnX[i], section.y + 28, boxWidth);
    if (model.valued && !section.isPlain) {
      const names = make('div', 'nb-cell');
      names.append(...['', '', section.codeNames?.[i] ?? 'code', 'real', 'ideal'].map((text) => make('span', '', text)));
      column.append(names);
    }
    elements.push(column);
  });
  for (const line of Object.values(section.equations ?? {}).flat()) {
    if (line.y === undefined) continue;
    const equation = place(make('div', 'nb-equation', line.text), section.columnX[1], line.y, line.width, line.h);
    if (!line.used) equation.append(make('i', '', '  unused: nothing reads it'));
    elements.push(equation);
  }
  section.notes.forEach((note, i) => {
    elements.push(place(make('div', 'nb-note', note), section.columnX[1], section.noteY[i]));
  });
  return elements;
}

export function wireElements(layout) {
  const svg = document.createElementNS(kSvg, 'svg');
  svg.setAttribute('class', 'nb-wires');
  svg.setAttribute('width', layout.width);
  svg.setAttribute('height', layout.height);
  svg.setAttribute('aria-hidden', 'true');
  for (const wire of layout.wires) {
    wire.element = document.createElementNS(kSvg, 'path');
    wire.element.setAttribute('d', wire.path);
    if (wire.refused) wire.element.setAttribute('class', 'nb-refused');
    svg.append(wire.element);
  }
  // Wider than what is seen, so that a pointer can take hold of it.
  for (const wire of layout.wires) {
    const hold = document.createElementNS(kSvg, 'path');
    hold.setAttribute('d', wire.path);
    hold.setAttribute('class', 'nb-hold');
    hold.nbWire = wire;
    svg.append(hold);
  }
  return svg;
}

export function toolbar(count) {
  const bar = make('div', 'nb-bar');
  bar.setAttribute('role', 'toolbar');
  bar.setAttribute('aria-label', 'Steps');
  const button = (text, label) => {
    const b = make('button', '', text);
    b.type = 'button';
    b.title = label;
    b.setAttribute('aria-label', label);
    return b;
  };
  const back = button('◀', 'Step back (left arrow)');
  const forward = button('▶', 'Step forward (right arrow)');
  const all = button('Show all', 'Show all steps (Escape)');
  const range = make('input');
  Object.assign(range, { type: 'range', min: 0, max: count, value: 0 });
  range.setAttribute('aria-label', 'Step');
  const text = make('span', 'nb-step');
  bar.append(back, range, forward, text, all);
  return { bar, back, forward, all, range, text };
}

export function legend(model) {
  const list = make('div', 'nb-legend');
  const item = (mark, text, className) => {
    const span = make('span');
    span.append(make('b', className, mark), ` ${text}`);
    list.append(span);
  };
  item('code', `n/${model.one}, products n/${model.one * model.one}`);
  item('ideal', 'exact arithmetic');
  item('▾', 'truncated', 'nb-truncated');
  item('■', 'clamped', 'nb-clamped');
  return list;
}
