/**
 * Which boxes of the trace's diagram a line of a program's source is about: for !!RC1.0, and for GL calls.
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

/** @param {string[]} lines @returns {string[][]} */
function ofRc10(lines) {
  let depth = 0, stage = -1, group = '', products = 0;
  return lines.map((line) => {
    /** @type {string[]} */
    const boxes = [];
    for (const [word] of line.replace(/#.*/, '').matchAll(/[{}]|\brgb\b(?=\s*\{)|\balpha\b(?=\s*\{)|[^{};]+;/g)) {
      if (word === '{') {
        depth++;
        if (depth === 1) stage++;
        products = 0;
      } else if (word === '}') depth--;
      else if (word === 'rgb' || word === 'alpha') group = word;
      else if (depth === 2 && /=/.test(word)) boxes.push(...boxesOf(`stage${stage}`, group, /\b(sum|mux)\s*\(/.test(word) ? 'sum' : products++ === 0 ? 'ab' : 'cd'));
      else if (depth === 0 && /^\s*out\s*\./.test(word)) boxes.push(...finalBoxes(/^\s*out\s*\.\s*a\b/.test(word)));
      else if (depth === 0 && /^\s*final_product\s*=/.test(word)) boxes.push(...earlyBoxes);
    }
    return boxes;
  });
}

/** @param {string[]} lines @returns {string[][]} */
function ofGlCalls(lines) {
  return lines.map((line) => {
    const input = /glCombinerInputNV\s*\(\s*GL_COMBINER(\d)_NV\s*,\s*GL_(RGB|ALPHA)\s*,\s*GL_VARIABLE_([ABCD])_NV/.exec(line);
    if (input) return [`stage${input[1]}/${input[2].toLowerCase()}-${input[3]}`];
    const output = /glCombinerOutputNV\s*\(\s*GL_COMBINER(\d)_NV\s*,\s*GL_(RGB|ALPHA)/.exec(line);
    if (output) return ['ab', 'cd', 'sum', 'mux'].map((name) => `stage${output[1]}/${output[2].toLowerCase()}-out-${name}`);
    const final = /glFinalCombinerInputNV\s*\(\s*GL_VARIABLE_([A-G])_NV/.exec(line);
    if (!final) return [];
    return [final[1] === 'G' ? 'final/alpha-G' : `${final[1] > 'D' ? 'early' : 'final'}/rgb-${final[1]}`];
  });
}

/**
 * The ids of boxes for each line, the first line first; empty lists where a line computes nothing, or in other forms.
 * @param {string} text
 * @returns {string[][]}
 */
export function boxesOfLines(text) {
  const lines = text.split('\n');
  if (/^\s*!!RC1\.0/.test(text)) return ofRc10(lines);
  if (/gl(Final)?CombinerInputNV/.test(text)) return ofGlCalls(lines);
  return lines.map(() => []);
}
