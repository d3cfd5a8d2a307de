/**
 * The left pane: the tabs of the files, what a source leaves to choose, the editor, the diagnostics as a list.
 */
import { byId, choice, element, messageOf, replaceChildren } from './dom.js';
import { Editor } from './editor.js';
import { allFiles, freeName } from './files.js';
import { FileTabs } from './file_tabs.js';
import { SourceChoices } from './source_choices.js';
import { checkedEffect, effectFile, passOf, programFile, programIn } from './state.js';

export class ProgramPane {
  /**
   * @param {import('./state.js').Store} store
   * @param {Record<string, string>} programs the gallery's programs, for names that an edited effect adds
   */
  constructor(store, programs) {
    this.store = store;
    this.programs = programs;
    /** The file that is shown; `null`: that of the pass. @type {string|null} */
    this.file = null;
    this.effectText = null;
    /** Whether a change comes from the effect's text. */
    this.editing = false;
    /** Files that exist since an edit of the effect names them. @type {Set<string>} */
    this.added = new Set();
    this.editor = new Editor(byId('editor'), (text) => this.edited(text));
    this.tabs = new FileTabs(byId('files'), store, {
      open: (file) => this.openFile(file), renamed: (from, to) => this.editor.rename(from, to), removed: (file) => this.editor.forget(file),
    });
    this.choices = new SourceChoices(byId('source-choices'), store);
    /** Faults of the program or the effect, and of the drawing. @type {Record<'read'|'draw', import('./editor.js').Diagnostic[]>} */
    this.faults = { read: [], draw: [] };
  }

  /** What the editor has: the pass's program, the effect, or a file beside them. */
  get shows() {
    if (this.file === effectFile) return 'effect';
    return this.file === null || this.file === programFile(this.store.state) ? 'program' : 'file';
  }

  /** The name of the file that is shown; empty: the pass has no program. */
  shownFile() {
    return this.file ?? programFile(this.store.state) ?? '';
  }

  /** Shows the text of the state. */
  show() {
    const { state } = this.store;
    const { passes } = state.effect;
    if (this.file !== null && !allFiles(state).includes(this.file)) this.file = null;
    const options = passes.map((/** @type {any} */ pass, /** @type {number} */ at) => [String(at), `${pass.name ?? `pass ${at}`}: ${pass.program ?? 'no program'}`]);
    byId('file-choice').hidden = passes.length < 2;
    replaceChildren(byId('file-choice'), choice('Pass', options, String(state.pass), (chosen) => this.choose(Number(chosen))));
    const file = this.shownFile();
    const isEffect = this.shows === 'effect';
    const text = isEffect ? JSON.stringify(state.effect, null, 2) : state.files[file] ?? '';
    this.tabs.show(file);
    this.editor.open(file, text);
    this.effectText = isEffect ? text : null;
    if (this.shows !== 'program') this.choices.hide();
  }

  /** Edits the program of a pass, and makes that the one that the panels are about. @param {number} pass */
  choose(pass) {
    this.file = null;
    this.faults = { read: [], draw: [] };
    this.store.change('pass', (state) => { state.pass = pass; });
    this.show();
  }

  /** Shows the file that a link names, if there is one. @param {unknown} file */
  look(file) {
    if (typeof file === 'string' && allFiles(this.store.state).includes(file)) this.openFile(file);
  }

  /** Shows a file; that of a program goes with the first pass that has it. @param {string} file */
  openFile(file) {
    const { state } = this.store;
    const pass = state.effect.passes.findIndex((/** @type {any} */ { program }) => typeof program === 'string' && programIn(state.files, program).file === file);
    if (pass >= 0 && file !== effectFile) return this.choose(programFile(state) === file ? state.pass : pass);
    this.file = file;
    this.faults = { read: [], draw: [] };
    this.store.change('pass', () => {});
    return this.show();
  }

  /** @param {string} text */
  edited(text) {
    if (this.shows === 'effect') {
      this.effectText = text;
      this.editedEffect(text);
      return;
    }
    const file = this.shownFile();
    this.store.change('text', (state) => {
      const name = file || freeName(state, 'program.rc1');
      if (!file) passOf(state).program = name;
      state.files[name] = text;
    });
    if (!file) {
      this.editor.rename('', this.shownFile());
      this.show();
    }
  }

  /** @param {string} text */
  editedEffect(text) {
    let effect;
    try {
      effect = checkedEffect(JSON.parse(text));
    } catch (error) {
      this.setFaults('read', [{ message: messageOf(error) }]);
      // The engine reads the text, too, and names the place.
      this.store.change('text', () => {});
      return;
    }
    this.setFaults('read', []);
    this.editing = true;
    this.store.change('inputs', (state) => {
      state.effect = effect;
      state.pass = Math.min(state.pass, Math.max(0, effect.passes.length - 1));
      const named = effect.passes.flatMap((/** @type {any} */ { program }) => (program ? [programIn(state.files, program).file] : []));
      // A name that one types is many names on its way.
      for (const file of this.added) if (!named.includes(file) && state.files[file] === (this.programs[file] ?? '')) delete state.files[file];
      for (const file of named) {
        if (file in state.files) continue;
        state.files[file] = this.programs[file] ?? '';
        this.added.add(file);
      }
    });
    this.editing = false;
    this.tabs.show(effectFile);
  }

  /** What there is to choose in the program. @param {import('./source_choices.js').Offered} answer */
  offer(answer) {
    if (this.shows === 'program') this.choices.show(answer);
  }

  /** @param {'read'|'draw'} of @param {import('./editor.js').Diagnostic[]} faults */
  setFaults(of, faults) {
    this.faults[of] = faults;
    // A program's fault comes from both: from reading it with its place.
    const known = this.faults.read.map(({ message }) => message);
    const all = [...this.faults.read, ...this.faults.draw.filter(({ message }) => !known.some((other) => message.endsWith(other)))];
    this.editor.show(all.filter(({ line }) => line));
    byId('faults').replaceChildren(...all.map(({ line, column, message, severity }) => element('li', {},
      element('button', { type: 'button', class: severity === 'info' ? 'info' : 'error', onclick: () => line && this.editor.go(line, column) },
        line ? `${line}:${column ?? 1}  ` : '', message))));
  }
}
