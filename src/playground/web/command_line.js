/**
 * The same with `ninebit`: a shell script that writes the files and runs the program.
 */
import { element, save } from './dom.js';
import { fileIn } from './shelf.js';

/** A word for a shell. @param {string} word */
const quoted = (word) => (/^[\w./,:=-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

/** A file as a here-document whose end the text does not contain. @param {string} name @param {string} text */
function hereDocument(name, text) {
  let end = 'END';
  while (text.split('\n').includes(end)) end += '_';
  return `cat > ${quoted(name)} <<'${end}'\n${text.replace(/\n?$/, '\n')}${end}\n`;
}

/** Whether a file of that name is below the folder and is not one that the script writes itself. @param {string} name */
const isBelow = (name) => /^[^/\\\0-\x1f-][^\\\0-\x1f]*$/.test(name) && !name.split('/').some((/** @type {string} */ part) => ['', '.', '..'].includes(part)) &&
  !/^program-\d+\.txt$/.test(name) && !['effect.json', 'profile.json', 'picture.png', 'playground.sh'].includes(name);

/** The effect and its files by names that lie in one folder. @param {import('./state.js').State} state */
export function inOneFolder({ effect, files }) {
  const names = new Map(Object.keys(files).map((name, at) => [name, isBelow(name) ? name : `program-${at}.txt`]));
  const passes = effect.passes.map((/** @type {any} */ pass) => (names.has(pass.program) ? { ...pass, program: names.get(pass.program) } : pass));
  return { effect: { ...effect, passes }, texts: Object.entries(files).map(([name, text]) => /** @type {[string, string]} */ ([names.get(name), text])) };
}

/**
 * @param {import('./state.js').State} state
 * @param {{x: number, y: number}|null} pixel the last traced pixel
 * @param {import('./live.js').Moment} [moment] of the picture
 * @returns {string}
 */
export function commandsOf(state, pixel, { time, frame } = { time: 0, frame: 0 }) {
  const { profile } = state;
  const { effect, texts } = inOneFolder(state);
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
  const flags = `--profile ${typeof profile === 'string' ? quoted(profile) : 'profile.json'}${time ? ` --time ${time}` : ''}${frame ? ` --frame ${frame}` : ''}`;
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
