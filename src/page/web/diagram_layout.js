// Places the boxes of a model and routes the wires between them, in pixels.

const kGap = 12;
const kColumnGap = 34;
const kHead = 40;       // title and sub-title of a box
const kRow = 16;
const kCaption = 17;
const kSectionHead = 70;
const kNote = 22;
const kEquation = 20;   // a line of an equation
const kMargin = 36;     // left and right, where wires between sections run
const kBetween = 44;    // between sections

const rowsOf = (part) => part.cells.filter((cell) => !cell.whole).length;

export function boxHeight(box) {
  const parts = box.parts.reduce((sum, part) => sum + (part.caption ? kCaption : 0) + rowsOf(part) * kRow, 0);
  return kHead + parts + (parts ? 8 : 0);
}

// Each box beside the middle of those of its group that it reads, below the one before it in its column.
function placeGroup(boxes, top, left) {
  const bottom = new Map();
  for (const box of boxes) {
    box.x = left(box.column);
    box.h = boxHeight(box);
    const sources = new Set();
    for (const part of box.parts) {
      for (const cell of part.cells) {
        // A texture stage may read the dot product of the next one, which is not placed yet.
        for (const parent of cell.parents) if (parent.box.column < box.column && boxes.includes(parent.box)) sources.add(parent.box);
      }
    }
    for (const parent of box.sources ?? []) if (boxes.includes(parent)) sources.add(parent);
    let y = bottom.get(box.column) ?? top;
    if (sources.size) {
      const middles = [...sources].map((s) => s.y + s.h / 2);
      y = Math.max(y, (Math.min(...middles) + Math.max(...middles)) / 2 - box.h / 2);
    }
    box.y = Math.round(y);
    bottom.set(box.column, box.y + box.h + kGap);
  }
  return Math.max(top, ...bottom.values());
}

// The equations of a group stand above its boxes, beside the registers.
function placeEquations(section, group, top, width) {
  const lines = section.equations?.[group] ?? [];
  let y = top;
  for (const line of lines) {
    const rows = Math.max(1, Math.ceil(([...line.text].length + 12) * 7.6 / width));
    Object.assign(line, { y, width, h: rows * kEquation });
    y += line.h;
  }
  return lines.length ? y + 10 : top;
}

export function layOut(model, boxWidth) {
  const left = (column) => kMargin + column * (boxWidth + kColumnGap);
  let y = 8;
  for (const section of model.sections) {
    section.y = y;
    section.columnX = section.columns.map((_, i) => left(i));
    const top = y + kSectionHead;
    let bottom = placeGroup(section.boxes.filter((b) => b.group === 'in'), top, left);
    let next = top;
    for (const group of ['stages', 'rgb', 'alpha', 'sum']) {
      const boxes = section.boxes.filter((b) => b.group === group);
      if (!boxes.length) continue;
      next = placeEquations(section, group, next, left(5) - kColumnGap - left(1));
      next = placeGroup(boxes, next, left) + kGap;
    }
    bottom = Math.max(bottom, next);
    section.noteY = section.notes.map((_, i) => bottom + i * kNote);
    section.bottom = bottom + section.notes.length * kNote;
    y = section.bottom + kBetween;
  }
  for (const section of model.sections) for (const box of section.boxes) box.w = boxWidth;
  return { width: left(5) - kColumnGap + kMargin, height: y - kBetween + 12, wires: wiresOf(model, left(5) - kColumnGap) };
}

// One wire for each pair of boxes of which one reads the other.
function wiresOf(model, right) {
  const wires = new Map();
  const add = (from, to, extra) => {
    if (from !== to) wires.set(`${from.id}>${to.id}`, { from, to, ...extra });
  };
  for (const section of model.sections) {
    for (const box of section.boxes) {
      if (box.refused) add(box.refused, box, { refused: true });
      for (const parent of box.sources ?? []) add(parent, box);
      for (const part of box.parts) for (const cell of part.cells) for (const parent of cell.parents) add(parent.box, box);
    }
  }
  const incoming = new Map();
  for (const wire of wires.values()) incoming.set(wire.to, [...(incoming.get(wire.to) ?? []), wire]);
  for (const [box, list] of incoming) {
    list.sort((a, b) => a.from.y - b.from.y || a.from.x - b.from.x);
    list.forEach((wire, i) => { wire.endY = box.y + Math.min(box.h - 8, 20) + (i - (list.length - 1) / 2) * 9; });
  }
  let lane = 0;
  for (const wire of wires.values()) wire.path = pathOf(wire, right, () => lane++);
  return [...wires.values()];
}

// Texture stages are as high as their section: a wire to another than the next one runs above the boxes between.
function aboveOf({ from, to, endY }, startX, startY) {
  const r = 4, x = startX + 8 + from.column * r, last = to.x - 8 - from.column * r, y = to.y - 6 - from.column * r;
  const along = Math.sign(last - x) * r;
  return `M${startX} ${startY}H${x - r}Q${x} ${startY} ${x} ${startY - r}V${y + r}Q${x} ${y} ${x + along} ${y}H${last - along}` +
         `Q${last} ${y} ${last} ${y + r}V${endY - r}Q${last} ${endY} ${last + r} ${endY}H${to.x}`;
}

function pathOf(wire, right, nextLane) {
  const { from, to, endY } = wire;
  const startX = from.x + from.w;
  const startY = from.y + 20;
  if (from.section === to.section && to.group === 'stages' && to.column !== from.column + 1) return aboveOf(wire, startX, startY);
  if (from.section === to.section) {
    const bend = Math.max(16, Math.min(60, (to.x - startX) / 2));
    return `M${startX} ${startY}C${startX + bend} ${startY} ${to.x - bend} ${endY} ${to.x} ${endY}`;
  }
  // Down beside the sections on the right, across above the section that reads, down again on the left.
  const lane = nextLane() % 6;
  const outX = right + 7 + lane * 4;
  const inX = 8 + lane * 4;
  const acrossY = to.section.y - 8 - lane * 5;
  const r = 6;
  return `M${startX} ${startY}H${outX - r}Q${outX} ${startY} ${outX} ${startY + r}V${acrossY - r}` +
         `Q${outX} ${acrossY} ${outX - r} ${acrossY}H${inX + r}Q${inX} ${acrossY} ${inX} ${acrossY + r}` +
         `V${endY - r}Q${inX} ${endY} ${inX + r} ${endY}H${to.x}`;
}
