/**
 * Saving: the picture as PNG, one to one or enlarged; the effect with all its files; an animation.
 */
import { enlarged, png, zip } from './archive.js';
import { inOneFolder } from './command_line.js';
import { choice, element, messageOf, save } from './dom.js';
import { Fault } from './engine_client.js';
import { sourcesFile, sourcesOf } from './files.js';
import { Live } from './live.js';
import { fileIn, roomFile } from './shelf.js';
import { profileFile } from './state.js';

/** The most pixels of one side of a saved picture, and of all frames of an animation together. */
const mostSide = 8192, mostPixels = 1 << 26;

const rate = 30;

export class SavePanel {
  /**
   * @param {HTMLElement} parent
   * @param {import('./state.js').Store} store
   * @param {import('./shelf.js').Shelf} shelf
   * @param {import('./engine_client.js').Engine} engine
   * @param {import('./picture.js').Picture} picture
   */
  constructor(parent, store, shelf, engine, picture) {
    this.parent = parent;
    this.store = store;
    this.shelf = shelf;
    this.engine = engine;
    this.picture = picture;
    this.times = 4;
    this.seconds = 4;
    this.text = element('p', { role: 'status', id: 'save-result' });
    const button = (/** @type {string} */ title, /** @type {string} */ id, /** @type {() => Promise<void>} */ run) => element('button', {
      type: 'button', id, onclick: () => this.run(run) }, title);
    const block = (/** @type {string} */ title, /** @type {any[]} */ ...parts) => element('fieldset', {}, element('legend', {}, title), ...parts);
    parent.append(element('div', { class: 'cards' },
      block('The picture that is shown', button('PNG, pixel for pixel', 'save-png', () => this.savePicture(1)),
        choice('Enlarged', [2, 3, 4, 6, 8, 16].map(String), String(this.times), (value) => { this.times = Number(value); }),
        button('PNG, enlarged', 'save-large', () => this.savePicture(this.times))),
      block('The effect', element('p', { class: 'quiet' }, 'The effect file, its programs, pictures, meshes and profile as one archive: ',
        element('code', {}, 'ninebit draw'), ' draws it, and this page opens it when it is dropped. A ', element('code', {}, 'profile.json'), ' in it is for ', element('code', {}, '--profile'), ' once it is unpacked.'),
        button('ZIP archive', 'save-zip', () => this.saveArchive())),
      block('An animation', element('p', { class: 'quiet' }, `Of an effect that moves, ${rate} frames a second, as APNG.`),
        choice('Seconds', [1, 2, 4, 8].map(String), String(this.seconds), (value) => { this.seconds = Number(value); }),
        button('Animated PNG', 'save-animation', () => this.saveAnimation()))), this.text);
  }

  /** The effect's title as a file's name. */
  name() {
    return (this.store.state.effect.title ?? '').toLowerCase().replace(/[^a-z0-9]+/g, '_').replace(/^_|_$/g, '') || 'picture';
  }

  /** @param {() => Promise<void>} task */
  async run(task) {
    this.text.textContent = '';
    try {
      await task();
    } catch (error) {
      this.text.textContent = error instanceof Error ? error.message : String(error);
    }
  }

  /** @param {number} times */
  async savePicture(times) {
    const { pixels, width, height } = this.picture;
    if (!pixels) throw new Error('There is no picture yet.');
    if (times * Math.max(width, height) > mostSide) throw new Error(`The picture would have ${times * width} x ${times * height} pixels; expected ${mostSide} a side at most.`);
    save(`${this.name()}${times > 1 ? `_x${times}` : ''}.png`, await png([enlarged(pixels, width, height, times)], width * times, height * times));
  }

  async saveArchive() {
    /** @type {string[]} */
    const refused = [];
    const files = await this.files(refused);
    save(`${this.name()}.zip`, zip(files));
    this.text.textContent = refused.join(' ');
  }

  /**
   * The effect with the page's profile, and what it reads, by names that lie in one folder.
   * @param {string[]} [refused] takes a sentence for each program that is left out because the engine refuses its source
   * @returns {Promise<[string, Uint8Array][]>}
   */
  async files(refused = []) {
    const { state } = this.store;
    const { effect, texts, converted } = inOneFolder(state);
    // Without one, `ninebit draw` takes another than the page.
    if (typeof state.profile === 'string') effect.profile = state.profile;
    const mesh = String(effect.scene?.mesh ?? '');
    const inRoom = mesh.endsWith(roomFile) && !this.shelf.bytesOf(mesh);
    if (inRoom) effect.scene = { ...effect.scene, mesh: roomFile };
    const text = (/** @type {any} */ value) => new TextEncoder().encode(typeof value === 'string' ? value : `${JSON.stringify(value, null, 2)}\n`);
    /** @type {[string, Uint8Array][]} */
    const files = [['effect.json', text(effect)], ...texts.map(([name, content]) => /** @type {[string, Uint8Array]} */ ([name, text(content)]))];
    if (typeof state.profile === 'object') files.push([profileFile, text(state.profile)]);
    if (converted.length) files.push([sourcesFile, text(sourcesOf(converted))]);
    for (const { from, number, choice: chosen, to } of converted) {
      const request = { ...Live.program({ ...state, files: Object.fromEntries(texts), choices: { [from]: chosen } }, { program: from }), to: 'json' };
      if (number) request.choice.program = number;
      try {
        files.push([to, text((await this.engine.ask({ ...request, do: 'convert' })).answer.text)]);
      } catch (error) {
        if (!(error instanceof Fault)) throw error;
        refused.push(`The archive is without ${to}, so only this page opens it: ${messageOf(error)}.`);
      }
    }
    const sources = Object.values(effect.textures ?? {}).flatMap((texture) => fileIn(String(/** @type {any} */ (texture)?.source ?? '')).split(','));
    for (const name of new Set([...sources, mesh])) {
      const bytes = this.shelf.bytesOf(name);
      if (bytes) files.push([name, bytes]);
    }
    if (inRoom) files.push([roomFile, await this.shelf.room()]);
    return files;
  }

  async saveAnimation() {
    const { state } = this.store;
    const count = this.seconds * rate;
    /** @type {Uint8Array[]} */
    const frames = [];
    let width = 0, height = 0;
    await this.shelf.loadFor(state.effect);
    for (let frame = 0; frame < count; frame++) {
      const { answer, bytes } = await this.engine.ask(Live.request(state, { time: frame / rate, frame }));
      if (!answer.moves) throw new Error('The effect does not move: no number of it depends on time or frame.');
      ({ width, height } = answer);
      if (width * height * count > mostPixels) throw new Error(`The animation would have ${width * height * count} pixels; expected ${mostPixels} at most.`);
      frames.push(bytes);
      this.text.textContent = `Frame ${frame + 1} of ${count}`;
    }
    save(`${this.name()}.png`, await png(frames, width, height, rate));
    this.text.textContent = `${count} frames were saved.`;
  }
}
