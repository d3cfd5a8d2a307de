// A program without a fragment, in the boxes of the same block picture: which registers each unit reads and writes.
import { kEarlyColumns, kFinalColumns, kStageColumns, mappingText, ModelBuilder, productNameOf, productText, registerText } from './trace_model.js';

const kShortNames = {
  primary_color: 'primary', secondary_color: 'secondary', constant_color0: 'const0', constant_color1: 'const1',
  texture0: 'tex0', texture1: 'tex1', texture2: 'tex2', texture3: 'tex3', spare0_plus_secondary_color: 'spare0_plus_secondary',
};
const kScaleMarks = { scale_by_two: '× 2', scale_by_four: '× 4', scale_by_one_half: '÷ 2' };

const shortOf = (name) => kShortNames[name] ?? String(name);
const isUnusedInput = (input) => input.input === 'zero' && input.mapping === 'unsigned_identity';

// The part of its register that a portion's variable reads: colour, alpha, or blue.
function readOf(input, group) {
  if (input.usage === 'blue') return 'blue';
  return input.usage === 'alpha' || group === 'alpha' ? 'alpha' : 'colour';
}

function variableOf(model, letter, group, input) {
  const register = shortOf(input.input);
  const read = readOf(input, group);
  const named = register !== 'zero' && read !== 'colour' ? `.${read}` : '';
  const box = model.box({ id: `${group}-${letter}`, column: 1, group, kind: 'input',
                          title: `${letter} = ${registerText(register)}${named}`, sub: mappingText(input.mapping) });
  return model.part(box, '', [{ label: 'value', parents: [model.wordOf(register, read)] }])[0];
}

class ProgramBuilder extends ModelBuilder {
  // As register(), with words for channels; blue comes from whatever wrote the colour.
  wordOf(register, word) {
    if (register === 'zero') return undefined;
    const holder = this.holders.get(`${register}.${word === 'blue' ? 'colour' : word}`);
    const known = this.now.boxes.find((b) => b.register === register);
    const box = known ?? this.box({ id: `in-${register}`, column: 0, group: 'in', register, kind: 'register', title: registerText(register),
                                    sub: register.startsWith('const') ? 'constant of the program' : 'of the fragment' });
    if (!known) this.part(box, '', []);
    if (holder) box.sub = holder.origin;
    const cell = box.parts[0].cells.find((c) => c.label === word);
    if (cell) return cell;
    const made = { id: `${box.id}/1/${word}`, label: word, box, part: box.parts[0], parents: holder ? [holder.cell] : [] };
    box.parts[0].cells.push(made);
    this.cells.set(made.id, made);
    return made;
  }
}

function productOf(model, group, portion, letters, isDot) {
  const name = letters.toLowerCase();
  const factors = [...letters].map((l) => variableOf(model, l, group, portion[l.toLowerCase()]));
  const box = model.box({ id: `${group}-${name}`, column: 2, group, kind: 'operator', symbol: isDot ? 'dot' : '×',
                          title: productText(letters, isDot), sub: isDot ? 'dot product' : 'product' });
  return model.part(box, '', [{ label: 'value', parents: factors }])[0];
}

function addProgramPortion(model, group, portion, byLowestBit) {
  const out = portion.output;
  const third = out.sum !== 'discard';
  if (out.ab === 'discard' && out.cd === 'discard' && !third) return [];
  const products = {};
  if (third || out.ab !== 'discard') products.ab = productOf(model, group, portion, 'AB', out.ab_dot_product);
  if (third || out.cd !== 'discard') products.cd = productOf(model, group, portion, 'CD', out.cd_dot_product);
  if (third) {
    const test = out.mux_sum ? model.wordOf('spare0', 'alpha') : undefined;
    const box = model.box({ id: `${group}-third`, column: 3, group, kind: 'operator', symbol: out.mux_sum ? '?' : '+',
                            title: out.mux_sum ? 'mux' : 'A·B + C·D', sub: out.mux_sum ? `spare0.a ${byLowestBit ? 'even' : '< ½'}: A·B` : 'sum' });
    products.sum = model.part(box, '', [{ label: 'value', parents: [products.ab, products.cd, test] }])[0];
  }
  const written = [];
  for (const name of ['ab', 'cd', 'sum']) {
    if (out[name] === 'discard') continue;
    const register = shortOf(out[name]);
    const what = productNameOf(name === 'sum' && out.mux_sum ? 'mux' : name, out[`${name}_dot_product`]);
    const steps = [out.bias === 'none' ? '' : '− ½', kScaleMarks[out.scale] ?? '', 'narrow, clamp'].filter(Boolean).join(', ');
    const box = model.box({ id: `${group}-out-${name}`, column: 4, group, kind: 'output', title: `${what} → ${register}${group === 'alpha' ? '.alpha' : ''}`, sub: steps });
    const word = group === 'alpha' ? 'alpha' : 'colour';
    const [cell] = model.part(box, '', [{ label: word, parents: [products[name]] }]);
    written.push({ register, word, cell });
    if (out[`${name}_blue_to_alpha`]) written.push({ register, word: 'alpha', cell });
  }
  return written;
}

function addProgramFinal(model, program) {
  const f = program.final_combiner;
  const inputs = [f.a, f.b, f.c, f.d, f.g];
  const reads = (name) => inputs.some((input) => shortOf(input.input) === name);
  const origin = 'of the final combiner';
  if (reads('e_times_f') || reads('spare0_plus_secondary')) {
    const names = [reads('e_times_f') && 'E·F', reads('spare0_plus_secondary') && 'colour sum'].filter(Boolean);
    model.section('early', `Final combiner: ${names.join(' and ')}`, kEarlyColumns);
  }
  if (reads('e_times_f')) {
    const product = productOf(model, 'rgb', f, 'EF', false);
    const box = model.box({ id: 'ef-out', column: 4, group: 'rgb', kind: 'output', title: 'E·F', sub: 'narrowed' });
    model.writes('e_times_f', 'colour', model.part(box, '', [{ label: 'colour', parents: [product] }])[0], origin);
  }
  if (reads('spare0_plus_secondary')) {
    const terms = ['spare0', 'secondary'].map((r) => (program[`color_sum_invert_${r}`] ? `(1 − ${r})` : r));
    const box = model.box({ id: 'colour-sum', column: 4, group: 'sum', kind: 'output', title: 'colour sum', sub: terms.join(' + ') });
    const parents = ['spare0', 'secondary'].map((r) => model.wordOf(r, 'colour'));
    model.writes('spare0_plus_secondary', 'colour', model.part(box, '', [{ label: 'colour', parents }])[0], origin);
  }
  model.section('final', 'Final combiner', kFinalColumns);
  const out = (parents, adds = 'add D, clamp') => {
    const box = model.box({ id: 'rgb', column: 4, group: 'rgb', kind: 'result', title: 'out rgb', sub: adds });
    model.part(box, '', [{ label: 'colour', parents }]);
  };
  if ([f.a, f.b, f.c, f.d].every(isUnusedInput)) {
    out([], 'A, B, C, D = zero');
  } else {
    const [a, b, c] = ['A', 'B', 'C'].map((l) => variableOf(model, l, 'rgb', f[l.toLowerCase()]));
    const d = isUnusedInput(f.d) ? undefined : variableOf(model, 'D', 'rgb', f.d);
    const operator = (id, column, title, symbol, parents) => {
      const box = model.box({ id, column, group: 'rgb', kind: 'operator', symbol, title, sub: symbol === '×' ? 'product' : 'mix' });
      return model.part(box, '', [{ label: 'value', parents }])[0];
    };
    const ab = operator('ab', 2, 'A · B', '×', [a, b]);
    const ac = operator('ac', 2, '(1 − A) · C', '×', [a, c]);
    out([operator('mix', 3, 'A·B + (1 − A)·C', '+', [ab, ac]), d], d ? 'add D, clamp' : 'clamp');
  }
  const g = variableOf(model, 'G', 'alpha', f.g);
  const box = model.box({ id: 'alpha', column: 4, group: 'alpha', kind: 'result', title: 'out alpha', sub: 'clamp' });
  model.part(box, '', [{ label: 'alpha', parents: [g] }]);
}

// Puts the equations that `ninebit explain --json` prints above the portions that compute them.
export function addEquations(sections, explanation) {
  const sectionOf = (stage) => sections.find((s) => s.id === (stage === 'final' ? 'final' : `stage${stage}`));
  for (const row of explanation.rows ?? []) {
    const section = sectionOf(row.stage);
    if (!section) continue;
    section.equations ??= {};
    (section.equations[row.portion] ??= []).push({ text: `${row.target} = ${row.expression}`, used: row.used });
  }
  for (const dead of explanation.dead ?? []) {
    const section = sectionOf(dead.stage);
    if (!section) continue;
    const name = dead.portion === 'rgb' ? 'RGB' : 'Alpha';
    section.notes = section.notes.filter((note) => !note.startsWith(name));
    section.notes.push(`${name} portion: ${dead.reason}.`);
  }
}

// The model of a program's canonical JSON form.
export function programModel(program) {
  const model = new ProgramBuilder();
  const count = program.num_general_combiners ?? program.general_combiners.length;
  program.general_combiners.slice(0, count).forEach((stage, i) => {
    model.section(`stage${i}`, `General combiner ${i}`, kStageColumns);
    const written = ['rgb', 'alpha'].flatMap((group) => addProgramPortion(model, group, stage[group], program.mux_by_lowest_bit));
    for (const { register, word, cell } of written) model.writes(register, word, cell, `of general combiner ${i}`);
  });
  addProgramFinal(model, program);
  // A box with one cell is that cell.
  for (const section of model.sections) {
    for (const { parts: [{ cells }], kind } of section.boxes) {
      cells[0].whole = cells.length === 1 && !(kind === 'register' && cells[0].label !== 'colour');
    }
  }
  return { valued: false, sections: model.sections, cells: model.cells };
}
