// Numbers and sentences of the diagram.

export const kChannelNames = { r: 'red', g: 'green', b: 'blue', a: 'alpha', rgb: 'red, green, blue' };
export const kGlyphs = { truncated: '▾', clamped: '■' };

// What is held: a code or wide value, whole or a half; a byte of a texel; a number with six digits.
export function heldText(value) {
  if (isSingle(value)) return value.byte !== undefined ? String(value.byte) : numberText(value.number);
  const held = value.code ?? value.units;
  return Number.isInteger(held) ? String(held) : held.toFixed(1);
}

// Whether a value is one number, which has no real and ideal one beside it.
export const isSingle = (value) => value.byte !== undefined || value.number !== undefined;

// JSON has no words for infinite numbers and NaN: they come as null.
const numberText = (x) => (x === null ? 'not finite' : String(Number(x.toPrecision(6))));

// Five decimals; a number too small for them has an exponent.
export function realText(x) {
  if (x === 0) return '0';
  return Math.abs(x) < 0.000005 ? x.toExponential(0) : x.toFixed(5);
}

export function differs(value) {
  return !isSingle(value) && realText(value.real) !== realText(value.ideal);
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
  if (isSingle(value)) return { values: [[value.byte !== undefined ? 'byte' : 'number', heldText(value)]], loss: '' };
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
