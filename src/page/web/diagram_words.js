// Numbers and sentences of the diagram.

export const kChannelNames = { r: 'red', g: 'green', b: 'blue', a: 'alpha', rgb: 'red, green, blue' };
export const kGlyphs = { truncated: '▾', clamped: '■' };

// A code or wide value: whole, or a half.
export function heldText(value) {
  const held = value.code ?? value.units;
  return Number.isInteger(held) ? String(held) : held.toFixed(1);
}

// Five decimals; a number too small for them has an exponent.
export function realText(x) {
  if (x === 0) return '0';
  return Math.abs(x) < 0.000005 ? x.toExponential(0) : x.toFixed(5);
}

export function differs(value) {
  return realText(value.real) !== realText(value.ideal);
}

const isWide = (value) => value.code === undefined;

export function heldName(value) {
  return isWide(value) ? 'wide' : 'code';
}

function lossText({ kind, by }, one) {
  if (kind === 'clamped') return `the clamp cut ${heldText(by)} (${realText(by.real)})`;
  return `narrowing dropped ${heldText(by)}/${one * one} (${realText(by.real)})`;
}

// [["code", "351"], …] for people, and the loss as a sentence.
export function factsOf(cell, one) {
  const { value } = cell;
  if (!value) return { values: [], loss: '' };
  const unit = isWide(value) ? one * one : one;
  return {
    values: [[heldName(value), `${heldText(value)}/${unit}`], ['real', realText(value.real)], ['ideal', realText(value.ideal)]],
    loss: cell.mark ? lossText(cell.mark, one) : '',
  };
}

export function placeOf(cell) {
  const { box, part } = cell;
  const portion = { rgb: ', RGB portion', alpha: ', alpha portion' }[box.group];
  const place = box.section.title + (box.section.id.startsWith('stage') && portion ? portion : '');
  return { place, what: [box.title, box.sub, part.caption].filter(Boolean).join(', '), channel: kChannelNames[cell.label] ?? cell.label };
}

export function spoken(cell, one) {
  const { what, channel } = placeOf(cell);
  const { values, loss } = factsOf(cell, one);
  if (!values.length) return cell.whole ? what : `${what}, ${channel}`;
  return `${what}, ${channel}: ${values.map(([n, v]) => `${n} ${v}`).join(', ')}${loss ? `; ${loss}` : ''}`;
}
