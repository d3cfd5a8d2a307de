/**
 * The tabs above the editor, a file each, and what makes, renames and deletes files.
 */
import { element, replaceChildren } from './dom.js';
import { allFiles, faultOfName, freeName, programFiles, remove, rename } from './files.js';
import { copied, effectFile } from './state.js';

export class FileTabs {
  /**
   * @param {HTMLElement} parent
   * @param {import('./state.js').Store} store
   * @param {{open: (file: string) => void, renamed: (from: string, to: string) => void, removed: (file: string) => void}} hears of what was done
   */
  constructor(parent, store, hears) {
    this.store = store;
    this.hears = hears;
    /** The file that is shown. */
    this.file = '';
    this.list = element('div', { role: 'tablist', 'aria-label': 'Files', onkeydown: (/** @type {KeyboardEvent} */ event) => this.key(event) });
    const button = (/** @type {string} */ id, /** @type {string} */ title, /** @type {string} */ label, /** @type {() => void} */ onclick) => element('button', { type: 'button', class: 'small', id, title, 'aria-label': title, onclick }, label);
    this.rename = button('rename-file', 'Rename this file', '✎', () => this.ask(this.file));
    this.remove = button('delete-file', 'Delete this file', '×', () => this.delete());
    this.tools = element('div', { class: 'file-tools' }, button('new-file', 'New file', '+', () => this.ask(null)), this.rename, this.remove);
    this.input = element('input', { type: 'text', 'aria-label': 'Name of the file', spellcheck: 'false', autocomplete: 'off', maxlength: 200, onkeydown: (/** @type {KeyboardEvent} */ event) => { if (event.key === 'Escape') this.close(); } });
    this.fault = element('span', { class: 'fault', role: 'alert' });
    this.form = element('form', { hidden: true, id: 'file-name', onsubmit: (/** @type {Event} */ event) => {
      event.preventDefault();
      this.named();
    } }, this.input, element('button', { type: 'submit', class: 'small' }, 'OK'),
    element('button', { type: 'button', class: 'small', onclick: () => this.close() }, 'Cancel'), this.fault);
    /** Which file is renamed; `null`: a new one is named. @type {string|null} */
    this.renames = null;
    parent.append(this.list, this.tools, this.form);
  }

  /** @param {string} file the one that is shown */
  show(file) {
    const { state } = this.store;
    if (this.file !== file) this.close();
    this.file = file;
    replaceChildren(this.list, ...allFiles(state).map((name) => element('button', {
      type: 'button', role: 'tab', class: 'file-tab', 'data-file': name, title: name, 'aria-selected': String(name === file), 'aria-controls': 'editor',
      tabindex: name === file ? 0 : -1, onclick: () => this.hears.open(name) }, name.replace(/^.*\/(?=.)/, ''))));
    // The list alone scrolls: on a phone, the page stays where it is.
    const tab = this.list.querySelector('[aria-selected=true]')?.getBoundingClientRect(), list = this.list.getBoundingClientRect();
    if (tab) this.list.scrollLeft += Math.min(0, tab.left - list.left) + Math.max(0, tab.right - list.right);
    // A file that a pass names cannot be deleted.
    this.rename.hidden = !(file in state.files);
    this.remove.hidden = this.rename.hidden || programFiles(state).includes(file);
  }

  /** The arrow keys move between the tabs. @param {KeyboardEvent} event */
  key({ key }) {
    const step = key === 'ArrowRight' ? 1 : key === 'ArrowLeft' ? -1 : 0;
    if (!step) return;
    const all = allFiles(this.store.state);
    this.hears.open(all[(all.indexOf(this.file) + step + all.length) % all.length]);
    this.list.querySelector('[aria-selected=true]').focus();
  }

  /** Asks for a name. @param {string|null} renames */
  ask(renames) {
    this.renames = renames;
    this.input.value = renames ?? freeName(this.store.state, 'program.rc1');
    this.fault.textContent = '';
    this.form.hidden = false;
    this.input.focus();
    this.input.select();
  }

  close() {
    this.form.hidden = true;
  }

  named() {
    const name = this.input.value.trim();
    const { renames } = this;
    if (name === renames) return this.close();
    const fault = faultOfName(this.store.state, name);
    this.fault.textContent = fault ?? '';
    if (fault) return this.input.focus();
    this.close();
    this.step((state) => {
      if (renames === null) state.files[name] = '';
      else rename(state, renames, name);
    }, () => {
      if (renames !== null) this.hears.renamed(renames, name);
    });
    return this.hears.open(name);
  }

  delete() {
    const { file } = this;
    this.step((state) => remove(state, file), () => this.hears.removed(file));
    this.hears.open(programFiles(this.store.state)[0] ?? effectFile);
  }

  /** A change that can be undone as what is opened can. @param {(state: import('./state.js').State) => void} edit @param {() => void} heard before others hear of it */
  step(edit, heard) {
    const before = copied(this.store.state);
    edit(this.store.state);
    heard();
    this.store.change('files', () => {});
    this.store.step(before);
  }
}
