/**
 * Files dropped on the page: pictures become textures, meshes the effect's mesh, texts the program. An effect file opens
 * with the files that it names, also from an archive.
 */
import { unpacked } from './archive.js';
import { mostBytes } from './decode_picture.js';
import { findEffect, stateOfDropped } from './effect_drop.js';
import { messageOf } from './dom.js';
import { besideProgram, fileName, freeName } from './files.js';
import { meshEnding } from './shelf.js';
import { copied, mostCharacters, passOf, programFile } from './state.js';

/**
 * @param {File} file
 * @param {number} unit the texture unit that a picture is for
 * @param {{store: import('./state.js').Store, shelf: import('./shelf.js').Shelf, inputs: import('./inputs_panel.js').InputsPanel, editor: () => void}} page
 */
async function take(file, unit, { store, shelf, inputs, editor }) {
  if (file.size > mostBytes) {
    throw new Error(`${file.name}: ${Math.round(file.size / 1e6)} MB; the page takes ${Math.round(mostBytes / 1e6)} MB at most`);
  }
  if (file.type.startsWith('image/')) {
    inputs.setSource(unit, await shelf.take(file));
  } else if (meshEnding.test(file.name)) {
    const name = await shelf.take(file);
    store.change('inputs', (/** @type {import('./state.js').State} */ { effect }) => { effect.scene = { ...effect.scene, mesh: name }; });
    inputs.show();
  } else {
    if (file.size > mostCharacters) throw new Error(`${file.name}: a program has at most ${mostCharacters / 1e6} MB`);
    const text = await file.text();
    if (text.includes('\0')) throw new Error(`${file.name}: not a picture, a mesh or a program; expected a picture such as PNG, a glTF, OBJ, PLY or OFF file, or a text`);
    store.change('text', (/** @type {import('./state.js').State} */ state) => {
      const beside = besideProgram(state, fileName(file.name));
      const name = beside ?? programFile(state) ?? freeName(state, 'program.rc1');
      if (!beside) passOf(state).program ??= name;
      state.files[name] = text;
    });
    editor();
  }
}

/**
 * @param {{store: import('./state.js').Store, shelf: import('./shelf.js').Shelf, inputs: import('./inputs_panel.js').InputsPanel, editor: () => void, open: (state: import('./state.js').State) => void}} page
 *   `editor` shows the state's text
 * @param {(message: string|null) => void} say shows what went wrong
 */
export function acceptDrops(page, say) {
  /** @param {File[]} dropped @param {number} unit */
  const takeAll = async (dropped, unit) => {
    /** @type {File[]} */
    let files;
    try {
      files = (await Promise.all(dropped.map(unpacked))).flat();
      const found = await findEffect(files);
      if (found) return page.open(await stateOfDropped(found.effect, found.file.name, files, page.shelf));
    } catch (error) {
      return say(messageOf(error));
    }
    const before = copied(page.store.state);
    /** @type {string[]} */
    const faults = [];
    for (const [number, file] of files.entries()) {
      try {
        await take(file, Math.min(3, unit + number), page);
      } catch (error) {
        faults.push(messageOf(error));
      }
    }
    if (faults.length < files.length) page.store.step(before);
    return say(faults.join('\n') || null);
  };
  // A drop waits for the one before: each is a step of its own.
  let last = Promise.resolve();
  const inTurn = (/** @type {File[]} */ files, /** @type {number} */ unit) => { last = last.then(() => takeAll(files, unit)); };
  page.inputs.onfiles = (/** @type {File[]} */ files) => inTurn(files, 0);
  const { body } = document;
  document.addEventListener('dragover', (event) => {
    event.preventDefault();
    body.classList.add('dropping');
  });
  document.addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) body.classList.remove('dropping');
  });
  // Before the editor's own handler, which would insert the file as text.
  document.addEventListener('drop', (event) => {
    body.classList.remove('dropping');
    const files = [...event.dataTransfer?.files ?? []];
    if (files.length === 0) return;
    event.preventDefault();
    event.stopPropagation();
    inTurn(files, Number(/** @type {Element} */ (event.target).closest?.('[data-unit]')?.getAttribute('data-unit') ?? 0));
  }, { capture: true });
}
