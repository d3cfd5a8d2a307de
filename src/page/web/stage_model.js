// The texture-shader stages of a traced fragment as boxes before the first general combiner: a box a stage, side by side.
// trace_model.js explains boxes, parts and cells.

// The stages of the fragment that a trace is about, from an effect or from values that were given; none where texture shaders
// are off. The depth is one that they replace.
export function textureStagesOf(trace) {
  if (trace.texture_shader) return { stages: trace.texture_shader.stages, depth: trace.texture_shader.depth ?? undefined };
  const { passes = [], pass, fragment } = trace.effect ?? {};
  const drawn = passes.find(({ name }) => name === pass)?.fragments?.[fragment];
  return { stages: drawn?.stages ?? [], depth: drawn?.depth_replaced ? drawn.depth : undefined };
}

const kRead = { offset: 'bg', dependent_ar: 'ar', dependent_gb: 'gb' };

// The components of the other stage's texel that move a place, and whether the stage's own coordinates count.
function readsOf(operation) {
  const [, letters] = Object.entries(kRead).find(([name]) => operation.startsWith(name)) ?? [];
  return { letters: letters ?? '', own: !operation.startsWith('dependent') };
}

// An operation in words: "dot product 2D". A long name goes without "dot product", which its box has anyway.
export function operationText(operation) {
  const text = operation.replaceAll('_', ' ').replace(/\b([123])d\b/, '$1D');
  return text.length > 22 ? text.replace('dot product ', '') : text;
}

function subTitleOf({ operation, inconsistent, previous }) {
  if (inconsistent) return 'inconsistent: gives 0';
  if (previous !== undefined) return `reads the texel of stage ${previous}`;
  return operation === 'none' ? 'off' : 'reads its own coordinates';
}

const numbers = (labels, values) => [...labels].map((label, i) => ({ label, value: { number: values[i] } }));
const bytes = (values) => [...'rgba'].map((label, i) => ({ label, value: { byte: values[i] } }));
const reading = (rows, parents) => rows.map((row, i) => ({ ...row, parents: parents(i, row.label) }));
const chosen = (cells, letters) => cells.filter(({ label }) => letters.includes(label));

// The cells that a place depends on; dot products of later stages are added once they are there.
function parentsOfPlace(stage, parts, number) {
  const { operation, dot_products: dots, previous } = stage;
  if (dots) {
    const cells = dots.flatMap((k) => parts[k]?.dot ?? []);
    // The eye is the q of three stages, or a constant.
    const isEye = operation.includes('reflect') && !operation.includes('const_eye');
    return isEye ? [...cells, ...dots.flatMap((k) => chosen(parts[k]?.coordinates ?? [], 'q'))] : cells;
  }
  const { coordinates } = parts[number];
  if (previous === undefined) return coordinates;
  const { letters, own } = readsOf(operation);
  return [...own ? chosen(coordinates, 'st') : [], ...chosen(parts[previous].texel, letters)];
}

function addStageBox(model, trace, stage, number, parts, depth) {
  const { operation } = stage;
  const box = model.box({ id: `stage${number}`, column: number, group: 'stages', kind: operation === 'none' ? 'input' : 'stage',
                          title: `${number}: ${operationText(operation)}`, sub: subTitleOf(stage) });
  const add = (caption, rows, parents = () => []) => model.part(box, caption, reading(rows, parents));
  const own = parts[number] = { coordinates: [] };
  if (operation !== 'none') own.coordinates = add('coordinates', numbers('strq', stage.coordinates));
  if (stage.normal) {
    const normal = add(`texel of stage ${stage.previous} as a vector`, numbers('xyz', stage.normal), () => parts[stage.previous].texel);
    own.dot = add('dot product', [{ label: 'dot', value: { number: stage.dot } }], () => [...chosen(own.coordinates, 'str'), ...normal]);
  }
  let from = operation === 'pass_through' ? own.coordinates : [];
  if (stage.at) {
    const places = parentsOfPlace(stage, parts, number);
    own.at = add('read at', numbers('str', stage.at), () => places);
    const same = stage.fetched.every((byte, i) => byte === stage.texel[i]);
    own.texel = from = add(same ? 'texel read' : 'fetched', bytes(stage.fetched), () => own.at);
    // The luminance scales red, green and blue.
    const luminance = (i) => (i < 3 && operation.endsWith('_scale') ? parts[stage.previous].texel.slice(0, 1) : []);
    if (!same) own.texel = from = add('texel', bytes(stage.texel), (i) => [from[i], ...luminance(i)]);
  } else {
    own.texel = add('texel', bytes(stage.texel), (i) => [from[i]]);
  }
  if (depth !== undefined && operation === 'dot_product_depth_replace') {
    add('replaced depth', [{ label: 'z', value: { number: depth } }], () => stage.dot_products.flatMap((k) => parts[k].dot ?? []));
  }
  const register = `tex${number}`;
  const held = trace.before[register];
  const codes = add(`${register}, read by the combiners`, [...'rgba'].map((label, i) => (
    { label, value: { code: held.codes[i], real: held.real[i], ideal: held.ideal[i] } })), (i) => [own.texel[i]]);
  for (const cell of codes) model.writes(register, cell.label, cell, `of texture stage ${number}`);
}

export function addTextureStages(model, trace) {
  const { stages, depth } = textureStagesOf(trace);
  if (!stages.length) return;
  model.section('texture', 'Texture shader', [...stages.map((_, number) => `stage ${number}`), '']);
  model.now.isPlain = true;
  const parts = [];
  stages.forEach((stage, number) => addStageBox(model, trace, stage, number, parts, depth));
  stages.forEach(({ dot_products: dots }, number) => {
    const ahead = (dots ?? []).filter((k) => k > number).flatMap((k) => parts[k].dot ?? []);
    for (const cell of parts[number].at ?? []) cell.parents.push(...ahead);
  });
}
