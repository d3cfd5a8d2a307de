// The values of a trace as cells, in the boxes of the hardware's block picture: what the diagram draws.
//
// A model is {one, arithmetic, sections}. A section (the texture shader, a general combiner, or the final combiner) has
// boxes; a box stands in a column of a group ("stages", "in" for registers, "rgb", "alpha") and has parts; a part has
// cells, one for each channel or component. A cell's parents are the cells that its value was computed from, so ancestors
// are found by following them.
import { addTextureStages } from './stage_model.js';

const kScaleText = { none: '', scale_by_two: '× 2', scale_by_four: '× 4', scale_by_one_half: '÷ 2' };
const kMappingText = {
  unsigned_identity: 'max(0, x)', unsigned_invert: '1 − max(0, x)', expand_normal: '2·max(0, x) − 1',
  expand_negate: '1 − 2·max(0, x)', half_bias_normal: 'max(0, x) − ½', half_bias_negate: '½ − max(0, x)',
  signed_identity: 'x, unchanged', signed_negate: '−x',
};
const kSpecialRegister = { e_times_f: 'E·F', spare0_plus_secondary: 'colour sum' };

export function mappingText(mapping) {
  return kMappingText[mapping] ?? String(mapping).replaceAll('_', ' ');
}

export function registerText(register) {
  return kSpecialRegister[register] ?? String(register);
}

// Collects boxes and cells; knows which cell holds a register's component now.
export class ModelBuilder {
  constructor() {
    this.sections = [];
    this.cells = new Map();
    this.holders = new Map();  // "spare0.a" → {cell, origin}: what wrote it last
  }

  section(id, title, columns) {
    this.now = { id, title, columns, boxes: [], notes: [] };
    this.sections.push(this.now);
    return this.now;
  }

  box(fields) {
    const box = { parts: [], section: this.now, ...fields, id: `${this.now.id}/${fields.id}` };
    this.now.boxes.push(box);
    return box;
  }

  // Adds a part whose cells are made of {label, value, parents, mark?}; returns the cells.
  part(box, caption, rows) {
    const part = { caption, cells: [] };
    box.parts.push(part);
    for (const row of rows) {
      const cell = { ...row, id: `${box.id}/${box.parts.length}/${row.label}`, box, part,
                     parents: (row.parents ?? []).filter(Boolean) };
      part.cells.push(cell);
      this.cells.set(cell.id, cell);
    }
    return part.cells;
  }

  // The cell of this section's box for a register's component, which is made at its first use; undefined for zero.
  register(register, component, value) {
    if (register === 'zero') return undefined;
    let box = this.now.boxes.find((b) => b.register === register);
    if (!box) {
      const constant = register.startsWith('const');
      box = this.box({ id: `in-${register}`, column: 0, group: 'in', register, kind: 'register', parts: [],
                       title: registerText(register), sub: constant ? 'constant of the program' : 'of the fragment' });
      this.part(box, '', []);
    }
    const part = box.parts[0];
    const known = part.cells.find((c) => c.label === component);
    if (known) return known;
    const holder = this.holders.get(`${register}.${component}`);
    if (holder) box.sub = holder.origin;
    const cell = { id: `${box.id}/1/${component}`, label: component, value, box, part, parents: holder ? [holder.cell] : [] };
    part.cells.push(cell);
    part.cells.sort((a, b) => 'rgba'.indexOf(a.label) - 'rgba'.indexOf(b.label));
    this.cells.set(cell.id, cell);
    return cell;
  }

  writes(register, component, cell, origin) {
    this.holders.set(`${register}.${component}`, { cell, origin });
  }

  // A variable in all channels: its register's cells, and the box that maps them. Returns the mapped cells.
  variable(letter, group, inputs) {
    const { register, mapping } = inputs[0];
    const component = inputs[0].component;
    const isOne = register !== 'zero' && inputs.every((i) => i.component === component);
    const suffix = isOne ? { a: '.alpha', b: '.blue' }[component] ?? '' : '';
    const box = this.box({ id: `${group}-${letter}`, column: 1, group, kind: 'input', letter,
                           title: `${letter} = ${registerText(register)}${suffix}`, sub: mappingText(mapping) });
    if (register === 'zero' && inputs.length > 1) {
      const [cell] = this.part(box, '', [{ label: 'rgb', value: inputs[0].mapped }]);
      return inputs.map(() => cell);
    }
    return this.part(box, '', inputs.map((input) => ({
      label: input.channel, value: input.mapped,
      parents: [this.register(register, input.component, input.read)],
    })));
  }
}

// The title of a product's box, and its name where a portion writes it: a dot product as the texts write it.
export const productText = ([first, second], isDot) => (isDot ? `dot(${first}, ${second})` : `${first} · ${second}`);
export const productNameOf = (name, isDot) => (isDot ? productText(name.toUpperCase(), true) : { ab: 'A·B', cd: 'C·D' }[name] ?? name);

function isLost(value) {
  return value !== undefined && value.real !== 0;
}

const truncated = (dropped) => (isLost(dropped) ? { kind: 'truncated', by: dropped } : undefined);
const clamped = (cut) => (isLost(cut) ? { kind: 'clamped', by: cut } : undefined);

function inputsOf(channels, name) {
  return channels.map((c) => ({ ...c[name], channel: c.channel }));
}

// A product and, with a dot product, its sum over the channels. Returns the cells that the portion goes on with.
function addProduct(model, group, channels, name, letters, isDot) {
  const factors = [...letters].map((l) => model.variable(l, group, inputsOf(channels, l.toLowerCase())));
  const box = model.box({ id: `${group}-${name}`, column: 2, group, kind: 'operator', symbol: isDot ? 'dot' : '×',
                          title: productText(letters, isDot), sub: isDot ? 'dot product' : 'product' });
  const products = model.part(box, isDot ? 'products' : '', channels.map((c, i) => ({
    label: c.channel, value: c[`${name}_product`], parents: factors.map((f) => f[i]) })));
  if (!isDot) return products;
  return model.part(box, 'their sum', channels.map((c) => ({ label: c.channel, value: c[name], parents: products })));
}

function addThird(model, stage, group, channels, output, products) {
  const isMux = output === 'mux';
  const box = model.box({ id: `${group}-third`, column: 3, group, kind: 'operator', symbol: isMux ? '?' : '+',
                          title: isMux ? 'mux' : 'A·B + C·D', sub: 'sum' });
  let chosen = [products.ab, products.cd];
  let test;
  if (isMux) {
    test = model.register('spare0', 'a', stage.spare0_alpha);
    chosen = [products[stage.mux_takes]];
    box.refused = products[stage.mux_takes === 'cd' ? 'ab' : 'cd']?.[0]?.box;
    const takesCd = stage.mux_takes === 'cd';
    const condition = stage.mux_by_lowest_bit ? (takesCd ? 'odd' : 'even') : takesCd ? '≥ ½' : '< ½';
    box.sub = `spare0.a ${condition}: ${takesCd ? 'C·D' : 'A·B'}`;
    if (stage.mux_takes !== stage.ideal_mux_takes) box.sub += takesCd ? ', ideal A·B' : ', ideal C·D';
  }
  return model.part(box, '', channels.map((c, i) => ({
    label: c.channel, value: c.outputs.find((o) => o.output === output).wide,
    parents: [...chosen.map((p) => p?.[i]), test] })));
}

function addOutput(model, stage, group, portion, name, from) {
  const outputs = portion.channels.map((c) => ({ ...c.outputs.find((o) => o.output === name), channel: c.channel }));
  const register = outputs[0].target.split('.')[0];
  const what = productNameOf(name, portion[`${name}_dot_product`]);
  const blueToAlpha = Boolean(portion[`${name}_blue_to_alpha`]);
  const box = model.box({ id: `${group}-out-${name}`, column: 4, group, kind: 'output', title: `${what} → ${register}${group === 'alpha' ? '.alpha' : ''}`,
                          sub: blueToAlpha ? 'red, green, blue; blue also to alpha' : group === 'alpha' ? 'alpha' : 'red, green, blue' });
  const add = (caption, key, cells, mark = () => undefined) => model.part(box, caption, outputs.map((o, i) => ({
    label: o.channel, value: o[key], parents: [cells[i]], mark: mark(o) })));
  let cells = from;
  if (portion.bias !== 'none') cells = add('− ½', 'biased', cells);
  if (outputs[0].narrowed_before_scale) cells = add('narrowed first', 'narrowed_before_scale', cells);
  if (portion.scale !== 'none') cells = add(kScaleText[portion.scale], 'scaled', cells);
  cells = add('narrowed', 'narrowed', cells, (o) => truncated(o.dropped));
  if (outputs.some((o) => isLost(o.cut) || o.cut.ideal !== 0)) cells = add('into range', 'written', cells, (o) => clamped(o.cut));
  return { register, cells, blueToAlpha };
}

function addPortion(model, stage, group) {
  const portion = stage[group];
  const { channels } = portion;
  if (!portion.writes) {
    model.now.notes.push(`${group === 'rgb' ? 'RGB' : 'Alpha'} portion: writes nothing.`);
    return [];
  }
  const products = {};
  if (channels[0].ab) products.ab = addProduct(model, group, channels, 'ab', 'AB', portion.ab_dot_product);
  if (channels[0].cd) products.cd = addProduct(model, group, channels, 'cd', 'CD', portion.cd_dot_product);
  return channels[0].outputs.map(({ output }) => {
    const isThird = output === 'sum' || output === 'mux';
    const from = isThird ? addThird(model, stage, group, channels, output, products) : products[output];
    return addOutput(model, stage, group, portion, output, from);
  });
}

export const kStageColumns = ['registers', 'inputs, mapped', 'products', 'sum or mux', 'scale, narrow, clamp'];
export const kEarlyColumns = ['registers', 'inputs, mapped', 'products', '', 'narrow, clamp'];
const kCodeNames = ['code', 'code', 'wide', 'wide', 'code'];
export const kFinalColumns = ['registers', 'inputs, mapped', 'products', 'mix', 'add, clamp'];

// Both portions read the registers before either writes.
function addStage(model, stage) {
  model.section(`stage${stage.stage}`, `General combiner ${stage.stage}`, kStageColumns);
  model.now.codeNames = kCodeNames;
  const written = ['rgb', 'alpha'].flatMap((group) => addPortion(model, stage, group));
  for (const { register, cells, blueToAlpha } of written) {
    const origin = `of general combiner ${stage.stage}`;
    for (const cell of cells) model.writes(register, cell.label, cell, origin);
    const blue = cells.find((c) => c.label === 'b');
    if (blueToAlpha && blue) model.writes(register, 'a', blue, origin);
  }
}

// The terms of the colour sum. A trace does not say which of its terms the program inverts, but their values do.
function colorSumText(rgb, last, one) {
  const code = (register, i) => Math.max(0, last[register].codes[i]);
  const terms = [['spare0', 'secondary'], ['(1 − spare0)', 'secondary'], ['spare0', '(1 − secondary)'], ['(1 − spare0)', '(1 − secondary)']];
  const term = (text, i) => (text.startsWith('(') ? one - code(text.slice(5, -1), i) : code(text, i));
  const found = terms.find(([x, y]) => rgb.every((c, i) => Math.abs(term(x, i) + term(y, i) - c.color_sum.unclamped.code) <= 1));
  return (found ?? terms[0]).join(' + ');
}

// E·F and the colour sum, which A to D and G may read.
function addEarlyFinal(model, trace) {
  const { rgb } = trace.final;
  if (!rgb[0].e_times_f && !rgb[0].color_sum) return;
  const last = trace.stages.length ? trace.stages[trace.stages.length - 1].after : trace.before;
  const names = [rgb[0].e_times_f && 'E·F', rgb[0].color_sum && 'colour sum'].filter(Boolean);
  model.section('early', `Final combiner: ${names.join(' and ')}`, kEarlyColumns);
  model.now.codeNames = kCodeNames;
  if (rgb[0].e_times_f) {
    const [e, f] = ['E', 'F'].map((l) => model.variable(l, 'rgb', inputsOf(rgb, l.toLowerCase())));
    const product = model.box({ id: 'ef', column: 2, group: 'rgb', kind: 'operator', symbol: '×', title: 'E · F', sub: 'product' });
    const products = model.part(product, '', rgb.map((c, i) => ({
      label: c.channel, value: c.e_times_f.product, parents: [e[i], f[i]] })));
    const out = model.box({ id: 'ef-out', column: 4, group: 'rgb', kind: 'output', title: 'E·F', sub: 'for A, B, C, D' });
    const cells = model.part(out, 'narrowed', rgb.map((c, i) => ({
      label: c.channel, value: c.e_times_f.narrowed, parents: [products[i]], mark: truncated(c.e_times_f.dropped) })));
    for (const cell of cells) model.writes('e_times_f', cell.label, cell, 'of the final combiner');
  }
  if (rgb[0].color_sum) {
    const value = (register, c) => {
      const k = 'rgba'.indexOf(c);
      const v = last[register];
      return { code: v.codes[k], real: v.real[k], ideal: v.ideal[k] };
    };
    const box = model.box({ id: 'colour-sum', column: 4, group: 'sum', kind: 'output', title: 'colour sum',
                            sub: colorSumText(rgb, last, trace.one) });
    const sums = model.part(box, 'sum', rgb.map((c) => ({
      label: c.channel, value: c.color_sum.unclamped,
      parents: ['spare0', 'secondary'].map((r) => model.register(r, c.channel, value(r, c.channel))) })));
    const isCut = (c) => c.color_sum.clamped.real !== c.color_sum.unclamped.real;
    const difference = ({ unclamped: u, clamped: v }) => ({ code: u.code - v.code, real: u.real - v.real, ideal: u.ideal - v.ideal });
    const cells = rgb.some(isCut)
      ? model.part(box, 'into range', rgb.map((c, i) => ({ label: c.channel, value: c.color_sum.clamped, parents: [sums[i]],
                                                        mark: clamped(difference(c.color_sum)) })))
      : sums;
    for (const cell of cells) model.writes('spare0_plus_secondary', cell.label, cell, 'of the final combiner');
  }
}

const isPlainZero = (input) => input.register === 'zero' && input.mapping === 'unsigned_identity';

function addFinalColor(model, trace) {
  const { rgb } = trace.final;
  const bytes = trace.out.bytes.slice(0, 3);
  const result = (sub) => model.box({ id: 'rgb', column: 4, group: 'rgb', kind: 'result', title: 'out rgb', sub, bytes });
  if (['a', 'b', 'c', 'd'].every((l) => isPlainZero(rgb[0][l]))) {
    model.part(result('A, B, C, D = zero'), '', rgb.map((v) => ({ label: v.channel, value: v.written })));
    return;
  }
  const variable = (letter) => model.variable(letter, 'rgb', inputsOf(rgb, letter.toLowerCase()));
  const [a, b, c] = ['A', 'B', 'C'].map(variable);
  const addsD = !isPlainZero(rgb[0].d);
  const d = addsD ? variable('D') : [];
  const product = (id, title, key, factors) => {
    const box = model.box({ id, column: 2, group: 'rgb', kind: 'operator', symbol: '×', title, sub: 'product' });
    return model.part(box, '', rgb.map((v, i) => ({ label: v.channel, value: v[key], parents: factors.map((f) => f[i]) })));
  };
  const ab = product('ab', 'A · B', 'ab', [a, b]);
  const ac = product('ac', '(1 − A) · C', 'one_minus_a_times_c', [a, c]);
  const mixBox = model.box({ id: 'mix', column: 3, group: 'rgb', kind: 'operator', symbol: '+', title: 'A·B + (1 − A)·C', sub: 'mix' });
  const mix = model.part(mixBox, '', rgb.map((v, i) => ({ label: v.channel, value: v.mix, parents: [ab[i], ac[i]] })));
  const narrowed = model.part(mixBox, 'narrowed', rgb.map((v, i) => ({
    label: v.channel, value: v.narrowed, parents: [mix[i]], mark: truncated(v.dropped) })));
  const out = result(`bytes ${bytes.join(', ')}`);
  const sums = model.part(out, addsD ? '+ D' : 'D = zero', rgb.map((v, i) => ({ label: v.channel, value: v.sum, parents: [narrowed[i], d[i]] })));
  if (rgb.some((v) => isLost(v.cut) || v.cut.ideal !== 0)) {
    model.part(out, 'into range', rgb.map((v, i) => ({ label: v.channel, value: v.written, parents: [sums[i]], mark: clamped(v.cut) })));
  }
}

function addFinal(model, trace) {
  addEarlyFinal(model, trace);
  const { alpha } = trace.final;
  model.section('final', 'Final combiner', kFinalColumns);
  model.now.codeNames = kCodeNames;
  addFinalColor(model, trace);
  const g = model.variable('G', 'alpha', [{ ...alpha.g, channel: 'a' }]);
  const last = model.box({ id: 'alpha', column: 4, group: 'alpha', kind: 'result', title: 'out alpha', sub: `byte ${trace.out.bytes[3]}` });
  model.part(last, '', [{ label: 'a', value: alpha.written, parents: [g[0]], mark: clamped(alpha.cut) }]);
}

// The model of the object that `ninebit trace --json` prints.
export function traceModel(trace) {
  const model = new ModelBuilder();
  addTextureStages(model, trace);
  for (const stage of trace.stages) addStage(model, stage);
  addFinal(model, trace);
  return { one: trace.one, arithmetic: trace.arithmetic, valued: true, sections: model.sections, cells: model.cells };
}
