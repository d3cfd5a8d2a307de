/**
 * The same with `ninebit`: a shell script that writes the files and runs the program.
 */
import { element, save } from './dom.js';
import { isBelow } from './files.js';
import { fileIn } from './shelf.js';
import { programIn } from './state.js';

/** A word for a shell. @param {string} word */
const quoted = (word) => (/^[\w./,:=-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

/** A file as a here-document whose end the text does not contain. @param {string} name @param {string} text */
function hereDocument(name, text) {
  let end = 'END';
  while (text.split('\n').includes(end)) end += '_';
  return `cat > ${quoted(name)} <<'${end}'\n${text.replace(/\n?$/, '\n')}${end}\n`;
}

/** A program whose text leaves a choice, read as chosen. @typedef {{from: string, number: number, choice: import('./state.js').Choice, to: string}} Converted */

/** The file and the number as `ninebit` takes them. @param {{from: string, number: number}} program */
const nameOf = ({ from, number }) => (number ? `${from}#${number}` : from);

/**
 * The effect and its files by names that lie in one folder. Effects cannot name functions or values: where some are chosen, the
 * effect names what the program is converted to.
 * @param {import('./state.js').State} state
 * @returns {{effect: any, texts: [string, string][], converted: Converted[]}} `converted`: with names as in `texts`
 */
export function inOneFolder({ effect, files, choices }) {
  const names = new Map(Object.keys(files).map((name, at) => [name, isBelow(name) ? name : `program-${at}.txt`]));
  /** @type {Map<string, Converted>} */
  const converted = new Map();
  const passes = effect.passes.map((/** @type {any} */ pass) => {
    if (typeof pass.program !== 'string') return pass;
    const { file, number } = programIn(files, pass.program);
    const from = names.get(file);
    if (from === undefined) return pass;
    const program = nameOf({ from, number });
    const { [file]: choice } = choices;
    if (!choice?.function && Object.keys(choice?.defines ?? {}).length === 0) return { ...pass, program };
    if (!converted.has(program)) {
      let to = `${from}${number ? `-${number}` : ''}.json`;
      const taken = [...names.values(), ...[...converted.values()].map((other) => other.to)];
      while (taken.includes(to) || !isBelow(to)) to = to.replace(/json$/, 'program.json');
      converted.set(program, { from, number, choice, to });
    }
    return { ...pass, program: converted.get(program)?.to };
  });
  const texts = Object.entries(files).map(([name, text]) => /** @type {[string, string]} */ ([names.get(name), text]));
  return { effect: { ...effect, passes }, texts, converted: [...converted.values()] };
}

/** The flags that name what is chosen. @param {import('./state.js').Choice} choice */
const flagsOf = ({ function: name, defines = {} }) => [...name ? [`--function ${quoted(name)}`] : [],
  ...Object.entries(defines).map(([key, value]) => `--define ${quoted(`${key}=${value}`)}`)].join(' ');

/**
 * @param {import('./state.js').State} state
 * @param {{x: number, y: number}|null} pixel the last traced pixel
 * @param {import('./live.js').Moment} [moment] of the picture
 * @returns {string}
 */
export function commandsOf(state, pixel, { time, frame } = { time: 0, frame: 0 }) {
  const { profile } = state;
  const { effect, texts, converted } = inOneFolder(state);
  const name = 'effect.json';
  const folders = [...new Set(texts.map(([file]) => file).filter((file) => file.includes('/')).map((file) => file.replace(/\/[^/]*$/, '')))];
  const lines = [];
  if (folders.length) lines.push(`mkdir -p ${folders.map(quoted).join(' ')}\n`);
  for (const [file, text] of texts) lines.push(hereDocument(file, text));
  lines.push(hereDocument(name, JSON.stringify(effect, null, 2)));
  if (typeof profile === 'object') lines.push(hereDocument('profile.json', JSON.stringify(profile, null, 2)));
  const sources = Object.values(effect.textures ?? {}).map((texture) => String(texture?.source ?? ''));
  const pictures = sources.filter((source) => /\.\w+$/.test(source)).map(fileIn);
  if (effect.scene?.mesh && /\.\w+$/.test(effect.scene.mesh)) pictures.push(effect.scene.mesh);
  for (const picture of pictures) lines.push(`# Needs ${picture.replaceAll('\n', ' ')}; the gallery's files are in scenes/effects.\n`);
  const own = `--profile ${typeof profile === 'string' ? quoted(profile) : 'profile.json'}`;
  for (const program of converted) lines.push(`ninebit convert ${quoted(nameOf(program))} ${flagsOf(program.choice)} ${own} --to json -o ${quoted(program.to)}\n`);
  const flags = `${own}${time ? ` --time ${time}` : ''}${frame ? ` --frame ${frame}` : ''}`;
  lines.push(`ninebit draw ${name} ${flags} -o picture.png\n`);
  if (pixel) lines.push(`ninebit trace --effect ${name} ${flags} --pixel ${pixel.x},${pixel.y}\n`);
  return lines.join('');
}

export class CommandPanel {
  /** @param {HTMLElement} parent @param {() => string} commands */
  constructor(parent, commands) {
    this.parent = parent;
    this.commands = commands;
    this.text = element('pre', { tabindex: 0, 'aria-label': 'Commands' });
    const button = (/** @type {string} */ title, /** @type {() => void} */ run) => element('button', { type: 'button', class: 'small', onclick: run }, title);
    parent.append(element('div', { class: 'bar' }, element('span', { class: 'quiet' }, 'The same picture with the program ninebit:'),
      button('Copy', () => navigator.clipboard?.writeText(this.text.textContent)),
      button('Save as playground.sh', () => save('playground.sh', this.text.textContent))), this.text);
  }

  update() {
    if (!this.parent.hidden) this.text.textContent = this.commands();
  }
}
