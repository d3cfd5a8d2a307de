/** Lines of a program and the boxes of the diagram. */
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import { boxesOfLines } from '../../../src/playground/web/source_lines.js';

test('statements of !!RC1.0 are products, sums and the final combiner', () => {
  const lines = boxesOfLines(`!!RC1.0
# spare0 = tex0;
{
  rgb {
    discard = tex0 * col0;
    discard = tex1 * col1;
    spare0 = sum();
  }
  alpha { spare1 = tex0; }
}
{
  rgb { spare1 = spare0 . tex0; }
}
final_product = spare0 * spare1;
out.rgb = spare0;
out.a = spare1;
`);
  assert.deepEqual(lines[1], []);
  assert.deepEqual(lines[4], ['stage0/rgb-A', 'stage0/rgb-B', 'stage0/rgb-ab', 'stage0/rgb-out-ab']);
  assert.ok(lines[5].includes('stage0/rgb-cd'));
  assert.ok(lines[6].includes('stage0/rgb-third') && lines[6].includes('stage0/rgb-out-sum'));
  assert.ok(lines[8].includes('stage0/alpha-ab'));
  assert.ok(lines[11].includes('stage1/rgb-ab'));
  assert.ok(lines[13].includes('early/ef'));
  assert.ok(lines[14].includes('final/rgb'));
  assert.deepEqual(lines[15], ['final/alpha', 'final/alpha-G']);
});

test('a statement lights all of its lines, and a brace may be on a line of its own', () => {
  const lines = boxesOfLines(`!!RC1.0
final_product = spare0 * spare1;
{
  rgb
  {
    spare0 = tex0;
  }
  alpha # of the texel
  {
    spare1 = tex0
      * col0;
  }
}
out.rgb =
  spare0;
`);
  assert.ok(lines[1].includes('early/ef'));
  assert.ok(lines[5].includes('stage0/rgb-ab'));
  for (const line of [9, 10]) assert.ok(lines[line].includes('stage0/alpha-ab') && !lines[line].includes('stage0/rgb-ab'));
  assert.deepEqual(lines[8], []);
  for (const line of [13, 14]) assert.ok(lines[line].includes('final/rgb'));
});

test('a GL call lights all of its lines, and comments light none', () => {
  const lines = boxesOfLines('/* glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV,\n*/ glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA,\n  GL_VARIABLE_C_NV, GL_TEXTURE0_ARB);\n');
  assert.deepEqual(lines, [[], ['stage1/alpha-C'], ['stage1/alpha-C'], []]);
});

test('GL calls name their boxes', () => {
  const lines = boxesOfLines('glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_C_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);\n' +
    'glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE);\n' +
    'glFinalCombinerInputNV(GL_VARIABLE_E_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);\n');
  assert.deepEqual(lines[0], ['stage1/alpha-C']);
  assert.ok(lines[1].includes('stage0/rgb-out-ab'));
  assert.deepEqual(lines[2], ['early/rgb-E']);
});

test('the n-th arithmetic instruction of a pixel shader is stage n, and + its other portion', () => {
  const groups = (lines) => lines.map((boxes) => [...new Set(boxes.map((box) => box.replace(/-.*/, '')))].join(' '));
  const text = readFileSync(new URL('../../../docs/programs/bump.ps', import.meta.url), 'utf8');
  const instructions = text.split('\n').map((line) => /^\s*(\+?)\s*(dp3|mov|mad)/.exec(line));
  assert.deepEqual(groups(boxesOfLines(text, 2)).map(Boolean), instructions.map(Boolean));
  const shader = 'ps.1.1 ; add r0, t0, t1\n// mul r0, t0, t1\ndef c0, 1, 0, 0, 1\ntex t0\ntexbem t1, t0\ndp3_sat r0.rgb, t0_bx2, v0_bx2\n+mov r0.a, t1\nMAD_x2 r0, r0, t1, c0 + mul r1.a, t0, t1\n';
  assert.deepEqual(groups(boxesOfLines(shader, 2)), ['', '', '', '', '', 'stage0/rgb', 'stage0/alpha', 'stage1/rgb stage1/alpha', '']);
  assert.ok(boxesOfLines(shader)[5].includes('stage0/rgb-ab'));
  assert.deepEqual(groups(boxesOfLines('xps.1.1\nxmma discard.rgb, discard, r0.rgb, t0, v0, t1, v1\nxmma_d2 r1.a, discard.a, discard.a, t0, v0, zero, zero\nxfc zero, zero, zero, r0, zero, zero, r1.a\n', 2)),
    ['', 'stage0/rgb', 'stage1/alpha', 'final/rgb final/ab final/ac final/mix final/alpha early/rgb early/ef', '']);
});

test('instructions that take two stages light both, and where others take more, no line lights', () => {
  const text = 'ps.1.2\ncmp r0, r0.a, t0, t1\nmov r0, t0\n';
  assert.ok(boxesOfLines(text, 3)[1].some((box) => box.startsWith('stage1/')) && boxesOfLines(text, 3)[2].every((box) => box.startsWith('stage2/')));
  assert.deepEqual(boxesOfLines(text, 4), [[], [], [], []]);
});

test('a shader with directives lights nothing, nor one with a test of unknown length', () => {
  const none = (text, stages) => assert.ok(boxesOfLines(text, stages).every((boxes) => boxes.length === 0), text);
  // The program has 3 stages: mov, one for the negative constant, mul.
  none('ps.1.1\ndef c0, 0.5, -0.5, 0.25, 1\ntex t0\n#if SHADED\nmul r1, t0, v0\n#endif\nmov r0, v0\nmul r0, r0, c0\n', 3);
  none('ps.1.2\ncmp r0, r0_bias.a, t0, t1\nmov r0, t0\n', 3);
  none('ps.1.4\ncnd r0, r1, t0, t1\n', 1);
  assert.ok(boxesOfLines('ps.1.1\ncnd r0, r0.a, t0, t1\n', 1)[1].length > 0);
});

test('other forms have none', () => {
  assert.deepEqual(boxesOfLines('{"ninebit": "program"}\n', 1), [[], []]);
});

test("the gallery's programs have boxes, in as many stages as they have blocks", () => {
  const folder = new URL('../../../scenes/effects/programs/', import.meta.url);
  for (const name of readdirSync(folder).filter((file) => file.endsWith('.rc1'))) {
    const text = readFileSync(new URL(name, folder), 'utf8');
    const boxes = boxesOfLines(text).flat();
    const stages = new Set(boxes.filter((box) => box.startsWith('stage')).map((box) => box.split('/')[0]));
    let depth = 0, blocks = 0;
    for (const [brace] of text.replace(/#.*/g, '').matchAll(/[{}]/g)) {
      if (brace === '{' && depth++ === 0) blocks++;
      if (brace === '}') depth--;
    }
    assert.equal(stages.size, blocks, name);
  }
});
