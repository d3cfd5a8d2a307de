// The diagram's model and layout, against traces that the program prints; and the script of the pages that it writes.
// usage: node diagram_test.mjs NINEBIT SOURCE_DIR
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { gunzipSync } from 'node:zlib';

const [, , ninebit, source] = process.argv;
const web = join(source, 'src/page/web');
const folder = mkdtempSync(join(tmpdir(), 'ninebit-diagram-'));
process.on('exit', () => rmSync(folder, { recursive: true }));

// The modules, where Node takes them for modules whatever the folder's packages say.
for (const name of readdirSync(web).filter((n) => n.endsWith('.js'))) {
  const text = readFileSync(join(web, name), 'utf8');
  writeFileSync(join(folder, name.replace('.js', '.mjs')), text.replace(/(from '\.\/\w+)\.js'/g, "$1.mjs'"));
}
const { traceModel } = await import(join(folder, 'trace_model.mjs'));
const { programModel, addEquations } = await import(join(folder, 'program_model.mjs'));
const { operationText } = await import(join(folder, 'stage_model.mjs'));
const { layOut } = await import(join(folder, 'diagram_layout.mjs'));

const run = (...args) => execFileSync(ninebit, args, { encoding: 'utf8', maxBuffer: 1 << 26, stdio: ['ignore', 'pipe', 'ignore'] });
const boxesOf = (model) => model.sections.flatMap((s) => s.boxes);

function checkModel(model, where) {
  for (const cell of model.cells.values()) {
    for (const parent of cell.parents) assert.equal(model.cells.get(parent.id), parent, `${where}: ${cell.id} has a stray parent`);
  }
  assert.equal(new Set(boxesOf(model).map((b) => b.id)).size, boxesOf(model).length, `${where}: a box twice`);
}

function checkLayout(model, where) {
  const { width, height, wires } = layOut(model, 204);
  const boxes = boxesOf(model);
  boxes.forEach((a, i) => {
    assert.ok(a.x >= 0 && a.x + a.w <= width && a.y >= 0 && a.y + a.h <= height, `${where}: ${a.id} is outside`);
    for (const b of boxes.slice(i + 1)) {
      const apart = a.x + a.w <= b.x || b.x + b.w <= a.x || a.y + a.h <= b.y || b.y + b.h <= a.y;
      assert.ok(apart, `${where}: ${a.id} lies on ${b.id}`);
    }
  });
  for (const wire of wires) assert.ok(!/NaN|undefined/.test(wire.path), `${where}: a wire without a way`);
  return wires;
}

const heldBy = (cell) => cell.value.code ?? cell.value.units ?? cell.value.byte ?? cell.value.number;
const ancestors = (cell) => {
  const found = new Set([cell]);
  for (const one of found) for (const parent of one.parents) found.add(parent);
  return found;
};

// Each value follows from its parents where one step is enough to see it.
function checkTrace(trace, where) {
  const model = traceModel(trace);
  checkModel(model, where);
  const last = (id) => boxesOf(model).find((b) => b.id === id).parts.at(-1).cells.map(heldBy);
  assert.deepEqual([...last('final/rgb'), ...last('final/alpha')], trace.out.codes, where);
  // Codes of real numbers are rounded, so that they need not add up.
  const isWhole = trace.arithmetic === 'integer';
  for (const box of boxesOf(model)) {
    if (box.kind === 'register') {
      for (const cell of box.parts[0].cells) {
        for (const parent of cell.parents) assert.equal(heldBy(parent), heldBy(cell), `${where}: ${cell.id} is not what was written`);
        if (!cell.parents.length && trace.before[box.register]) {
          assert.equal(heldBy(cell), trace.before[box.register].codes['rgba'.indexOf(cell.label)], `${where}: ${cell.id}`);
        }
      }
    }
    for (const part of isWhole ? box.parts : []) {
      for (const cell of part.cells) {
        if (box.title === 'A · B' || box.title === 'C · D') {
          assert.equal(heldBy(cell), cell.parents.map(heldBy).reduce((x, y) => x * y) + 0, `${where}: ${cell.id}`);
        }
        if (box.title === 'A·B + C·D') {
          assert.equal(heldBy(cell), cell.parents.map(heldBy).reduce((x, y) => x + y) + 0, `${where}: ${cell.id}`);
        }
        if (part.caption === 'their sum') {
          assert.equal(heldBy(cell), cell.parents.map(heldBy).reduce((x, y) => x + y) + 0, `${where}: ${cell.id}`);
        }
        if (part.caption === 'into range') {
          assert.equal(Boolean(cell.mark), heldBy(cell) !== heldBy(cell.parents[0]), `${where}: ${cell.id}`);
        }
      }
    }
  }
  checkLayout(model, where);
  return model;
}

let marks = { truncated: 0, clamped: 0 };
let cells = 0;
const effects = readdirSync(join(source, 'scenes/effects')).filter((n) => n.endsWith('.json') && n !== 'expected_hashes.json');
for (const effect of effects) {
  const trace = JSON.parse(run('trace', '--effect', join(source, 'scenes/effects', effect), '--pixel', '128,80', '--json'));
  if (!trace.stages) continue;
  const model = checkTrace(trace, effect);
  cells += model.cells.size;
  for (const cell of model.cells.values()) if (cell.mark) ++marks[cell.mark.kind];
}
assert.ok(effects.length > 15 && cells > 1000 && marks.truncated > 50 && marks.clamped > 2, JSON.stringify({ cells, marks }));

// Texture-shader stages stand before the first combiner with all their values, and the combiners' registers hold their codes.
const stageEffects = { depth_balls: '130,130', diffuse_specular: '60,128', constant_eye: '128,128', palette: '128,128', water: '128,100', clip_planes: '128,128' };
const stageWires = new Set();
for (const [name, pixel] of Object.entries(stageEffects)) {
  const trace = JSON.parse(run('trace', '--effect', join(source, `scenes/effects/${name}.json`), '--pixel', pixel, '--json'));
  const stages = trace.effect.passes.find((pass) => pass.name === trace.effect.pass).fragments[trace.effect.fragment].stages;
  const model = checkTrace(trace, name);
  const [section, next] = model.sections;
  assert.deepEqual([section.title, section.boxes.length], ['Texture shader', 4], name);
  assert.match(next.title, /^(General combiner 0|Final combiner)/, name);
  stages.forEach((stage, i) => {
    const box = section.boxes[i];
    assert.equal(box.title, `${i}: ${operationText(stage.operation)}`);
    const valuesOf = (caption) => box.parts.find((part) => part.caption.startsWith(caption))?.cells.map(heldBy);
    if (stage.operation !== 'none') assert.deepEqual(valuesOf('coordinates'), stage.coordinates, `${name} ${i}`);
    assert.deepEqual(valuesOf('dot product')?.[0], stage.dot, `${name} ${i}`);
    assert.deepEqual(valuesOf('read at'), stage.at, `${name} ${i}`);
    assert.deepEqual(valuesOf('texel of stage'), stage.normal, `${name} ${i}`);
    assert.deepEqual(box.parts.find((part) => /^texel( read)?$/.test(part.caption)).cells.map(heldBy), stage.texel, `${name} ${i}`);
    assert.deepEqual(valuesOf(`tex${i}, read`), stage.codes, `${name} ${i}`);
  });
  for (const { from, to } of layOut(model, 204).wires) if (from.section === section) stageWires.add(`${name}: ${from.id} > ${to.id}`);
}
for (const wire of ['depth_balls: texture/stage0 > texture/stage2', 'depth_balls: texture/stage1 > texture/stage2', 'depth_balls: texture/stage3 > final/in-tex3',
  'diffuse_specular: texture/stage3 > texture/stage2', 'diffuse_specular: texture/stage2 > stage0/in-tex2', 'palette: texture/stage0 > texture/stage1', 'water: texture/stage0 > texture/stage1']) {
  assert.ok(stageWires.has(wire), `no ${wire} in ${[...stageWires].join(', ')}`);
}
assert.ok(!stageWires.has('palette: texture/stage0 > texture/stage2'));

assert.equal(operationText('dot_product_2d'), 'dot product 2D');
assert.equal(operationText('dot_product_diffuse_cube_map'), 'diffuse cube map');

// Random programs with all that the combiners can do, on random registers.
const pack = join(folder, 'pack');
run('vectors', '-o', pack, '--programs', '65', '--fragments', '1', '--profile', 'nv2a', '--quiet');
const random = (() => { let state = 25; return (n) => (state = (state * 48271) % 2147483647) % n; })();
const programs = gunzipSync(readFileSync(join(pack, 'programs.jsonl.gz'))).toString().trim().split('\n');
const kinds = new Set();
programs.forEach((text, i) => {
  const file = join(folder, 'program.json');
  writeFileSync(file, text);
  const set = ['primary', 'secondary', 'tex0', 'tex1', 'spare0', 'fog'].flatMap(
    (name) => ['--set', `${name}=${[0, 0, 0, 0].map(() => random(256)).join(',')}`]);
  for (const profile of ['nv2a', ...({ 0: ['ideal'], 1: ['float-shader'] }[i % 6] ?? [])]) {
    const trace = JSON.parse(run('trace', file, ...set, '--json', '--profile', profile));
    const model = checkTrace(trace, `program ${i}, ${profile}`);
    for (const box of boxesOf(model)) kinds.add(box.title.replace(/ .*/, ''));
  }
  const program = programModel(JSON.parse(text));
  checkModel(program, `program ${i}`);
  checkLayout(program, `program ${i}`);
});
for (const kind of ['mux', 'sum', 'E·F', 'colour', 'out']) assert.ok(kinds.has(kind), `no ${kind} in ${[...kinds]}`);

// A dot product has the name that it has in texts: "·" is a product.
{
  const trace = JSON.parse(run('trace', '--effect', join(source, 'scenes/effects/dot3_specular.json'), '--pixel', '128,80', '--json'));
  const titles = boxesOf(traceModel(trace)).map((box) => box.title);
  assert.ok(titles.some((title) => /^dot\(A, B\) → /.test(title)) && titles.includes('dot(A, B)') && !titles.some((title) => title.includes('•')), titles.join());
}

// The article's program: the output's alpha depends on all three channels of both colours, and on nothing else.
const article = join(source, 'docs/programs/index_compare.gl');
const model = checkTrace(JSON.parse(run('trace', article, '--set', 'primary=102,7,9,0', '--set', 'tex0=100,7,8,255', '--json')), 'article');
const alpha = boxesOf(model).find((b) => b.id === 'final/alpha').parts.at(-1).cells[0];
const sources = [...ancestors(alpha)].filter((c) => c.box.kind === 'register' && !c.parents.length).map((c) => `${c.box.register}.${c.label}`);
assert.deepEqual(sources.sort(), ['primary.b', 'primary.g', 'primary.r', 'tex0.b', 'tex0.g', 'tex0.r']);

for (const name of readdirSync(join(source, 'scenes/effects/programs'))) {
  const file = join(source, 'scenes/effects/programs', name);
  const program = programModel(JSON.parse(run('convert', file, '--to', 'json', '--profile', 'nv2a')));
  addEquations(program.sections, JSON.parse(run('explain', file, '--json', '--profile', 'nv2a')));
  checkModel(program, name);
  checkLayout(program, name);
  assert.ok(program.sections.some((s) => s.equations), name);
}

// The page's script is one script: no name is declared twice, and each function that it calls is there.
for (const verb of ['trace', 'explain']) {
  const page = join(folder, 'page.html');
  run(verb, article, '--quiet', '-o', page);
  const script = /<script type="module">\n([^]*?)<\/script>/.exec(readFileSync(page, 'utf8'))[1];
  const file = join(folder, `${verb}.mjs`);
  writeFileSync(file, script);
  execFileSync(process.execPath, ['--check', file]);
  for (const name of ['layOut', 'traceModel', 'programModel', 'addEquations', 'boxElement', 'traceDiagram', 'programDiagram']) {
    assert.ok(script.includes(`\nfunction ${name}(`), `${verb}: no ${name}`);
  }
}
console.log(`${effects.length} effects, ${cells} values, ${marks.truncated} truncated, ${marks.clamped} clamped: as they should be`);
