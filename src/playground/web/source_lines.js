/**
 * Which boxes of the trace's diagram a line of a program's source is about: for !!RC1.0, GL calls and pixel shaders.
 */

/** The boxes of a product, a sum, or a whole portion. @param {string} section @param {string} group @param {string} part */
function boxesOf(section, group, part) {
  const inputs = part === 'ab' ? ['A', 'B'] : ['C', 'D'];
  if (part === 'sum') return ['third', 'out-sum', 'out-mux'].map((name) => `${section}/${group}-${name}`);
  return [...inputs, part, `out-${part}`].map((name) => `${section}/${group}-${name}`);
}

/** The boxes of the final combiner that compute a portion. @param {boolean} alpha */
const finalBoxes = (alpha) => (alpha ? ['final/alpha', 'final/alpha-G'] : [...'ABCD'].map((letter) => `final/rgb-${letter}`).concat(['final/ab', 'final/ac', 'final/mix', 'final/rgb']));
const earlyBoxes = ['early/rgb-E', 'early/rgb-F', 'early/ef', 'early/ef-out'];

/** The text with spaces in the place of what matches, so that the rest stays where it is. @param {string} text @param {RegExp} pattern */
const without = (text, pattern) => text.replace(pattern, (found) => found.replace(/[^\n]/g, ' '));

/**
 * Boxes by line: those of a statement on each line that it has a part of.
 * @param {string} text
 * @param {RegExp} pattern of a statement or a brace
 * @param {(statement: RegExpMatchArray) => string[]} boxesIn
 * @returns {string[][]}
 */
function byLine(text, pattern, boxesIn) {
  /** @type {string[][]} */
  const lines = text.split('\n').map(() => []);
  const lineAt = (/** @type {number} */ offset) => text.slice(0, offset).split('\n').length - 1;
  for (const found of text.matchAll(pattern)) {
    const boxes = boxesIn(found);
    if (boxes.length === 0) continue;
    const [statement] = found, end = found.index + statement.length;
    for (let line = lineAt(end - statement.trimStart().length); line <= lineAt(end); line++) lines[line].push(...boxes);
  }
  return lines;
}

/** @param {string} text @returns {string[][]} */
function ofRc10(text) {
  let depth = 0, stage = -1, group = '', products = 0;
  return byLine(without(text, /^\s*!!RC1\.0|#.*/g), /[{}]|\brgb\b(?=\s*\{)|\balpha\b(?=\s*\{)|[^{};]+;/g, ([word]) => {
    if (word === '{') {
      depth++;
      if (depth === 1) stage++;
      products = 0;
    } else if (word === '}') depth--;
    else if (word === 'rgb' || word === 'alpha') group = word;
    else if (depth === 2 && /=/.test(word)) return boxesOf(`stage${stage}`, group, /\b(sum|mux)\s*\(/.test(word) ? 'sum' : products++ === 0 ? 'ab' : 'cd');
    else if (depth === 0 && /^\s*out\s*\./.test(word)) return finalBoxes(/^\s*out\s*\.\s*a\b/.test(word));
    else if (depth === 0 && /^\s*final_product\s*=/.test(word)) return earlyBoxes;
    return [];
  });
}

/** @param {string} text @returns {string[][]} */
function ofGlCalls(text) {
  return byLine(without(text, /\/\*[^]*?\*\/|\/\/.*/g), /\bgl(?:Final)?Combiner(?:In|Out)putNV\s*\([^;)]*/g, ([call]) => {
    const input = /glCombinerInputNV\s*\(\s*GL_COMBINER(\d)_NV\s*,\s*GL_(RGB|ALPHA)\s*,\s*GL_VARIABLE_([ABCD])_NV/.exec(call);
    if (input) return [`stage${input[1]}/${input[2].toLowerCase()}-${input[3]}`];
    const output = /glCombinerOutputNV\s*\(\s*GL_COMBINER(\d)_NV\s*,\s*GL_(RGB|ALPHA)/.exec(call);
    if (output) return ['ab', 'cd', 'sum', 'mux'].map((name) => `stage${output[1]}/${output[2].toLowerCase()}-out-${name}`);
    const final = /glFinalCombinerInputNV\s*\(\s*GL_VARIABLE_([A-G])_NV/.exec(call);
    if (!final) return [];
    return [final[1] === 'G' ? 'final/alpha-G' : `${final[1] > 'D' ? 'early' : 'final'}/rgb-${final[1]}`];
  });
}

/** An instruction of a pixel shader that becomes a general combiner, or xfc: `+`, its name, and its operands. */
const arithmetic = /(\+\s*)?\b(mov|add|sub|mul|mad|lrp|dp3|dp4|cnd|cmp|xmma|xmmc|xdm|xdd|xfc)(?:_\w+)*\s+([^\n+]*)/gi;
/** How many operands are written, where it is not one. @type {Record<string, number>} */
const written = { xmma: 3, xmmc: 3, xdm: 2, xdd: 2 };

/** The portions that an instruction writes, by the masks of what it writes. @param {string} name @param {string} operands */
function portionsOf(name, operands) {
  const masks = operands.split(',').slice(0, written[name] ?? 1).flatMap((target) => /\.\s*(\w+)/.exec(target)?.[1] ?? []);
  if (masks.length === 0 || masks.some((mask) => /^(rgba|xyzw)$/i.test(mask))) return ['rgb', 'alpha'];
  return [...masks.some((mask) => /[rgbxyz]/i.test(mask)) ? ['rgb'] : [], ...masks.some((mask) => /[aw]/i.test(mask)) ? ['alpha'] : []];
}

/** Directives, which may leave lines out, and tests whose number of stages depends on more than their line. */
const uncertain = /^\s*#|\bcnd(?:_\w+)*\s+[^,\n]*,(?!\s*r0\.a\s*,)|\bcmp(?:_\w+)*\s+[^,\n]*,[^,\n]*_(?:bias|bx2)/im;

/**
 * Each arithmetic instruction is a stage, and one with + is of the stage before it; cmp and dp4 are two.
 * @param {string} text
 * @param {number} [stages] how many the program has: where constants or dot products take more, no line is known
 */
function ofPixelShader(text, stages) {
  let stage = -1;
  const code = without(text, /\/\*[^]*?\*\/|(\/\/|;).*/g);
  if (uncertain.test(code)) return text.split('\n').map(() => []);
  const lines = byLine(code, arithmetic, ([, joined, word, operands]) => {
    const name = word.toLowerCase();
    if (name === 'xfc') return [...finalBoxes(false), ...finalBoxes(true), ...earlyBoxes];
    const first = joined ? stage : stage + 1;
    stage = joined ? stage : first + (name === 'cmp' || name === 'dp4' ? 1 : 0);
    const own = [...new Set([first, stage])];
    return own.flatMap((number) => portionsOf(name, operands).flatMap((group) => ['ab', 'cd', 'sum'].flatMap((part) => boxesOf(`stage${number}`, group, part))));
  });
  return stages === undefined || stages === stage + 1 ? lines : lines.map(() => []);
}

/**
 * The ids of boxes for each line, the first line first; empty lists where a line computes nothing, or in other forms.
 * @param {string} text
 * @param {number} [stages] how many general combiners the program has
 * @returns {string[][]}
 */
export function boxesOfLines(text, stages) {
  if (/^\s*!!RC1\.0/.test(text)) return ofRc10(text);
  if (/gl(Final)?CombinerInputNV/.test(text)) return ofGlCalls(text);
  if (/^\s*(x?ps[._]1[._]\d|!!PS1\.0)/im.test(text)) return ofPixelShader(text, stages);
  return text.split('\n').map(() => []);
}
