/**
 * The left pane: which text is edited, the editor, the diagnostics as a list.
 */
import { byId, choice, element, messageOf, replaceChildren } from './dom.js';
import { Editor } from './editor.js';
import { checkedEffect, effectFile, passOf } from './state.js';

export class ProgramPane {
  /**
   * @param {import('./state.js').Store} store
   * @param {Record<string, string>} programs the gallery's programs, for names that an edited effect adds
   */
  constructor(store, programs) {
    this.store = store;
    this.programs = programs;
    this.shows = 'program';
    this.effectText = null;
    this.editor = new Editor(byId('editor'), (text) => this.edited(text));
    /** Faults of the program or the effect, and of the drawing. @type {Record<'read'|'draw', import('./editor.js').Diagnostic[]>} */
    this.faults = { read: [], draw: [] };
  }

  /** Shows the text of the state. */
  show() {
    const { state } = this.store;
    const passes = state.effect.passes.map((/** @type {any} */ pass, /** @type {number} */ at) => [String(at), `${pass.name ?? `pass ${at}`}: ${pass.program ?? 'no program'}`]);
    const value = this.shows === 'effect' ? effectFile : String(state.pass);
    replaceChildren(byId('file-choice'), choice('Edit', [...passes, [effectFile, 'the effect itself (JSON)']], value, (chosen) => this.choose(chosen)));
    const text = this.shows === 'effect' ? JSON.stringify(state.effect, null, 2) : state.files[passOf(state).program] ?? '';
    this.editor.open(this.shows === 'effect' ? effectFile : `program ${passOf(state).program ?? ''}`, text);
    this.effectText = this.shows === 'effect' ? text : null;
  }

  /** @param {string} value */
  choose(value) {
    this.shows = value === effectFile ? 'effect' : 'program';
    this.faults = { read: [], draw: [] };
    this.store.change('pass', (state) => { if (value !== effectFile) state.pass = Number(value); });
    this.show();
  }

  /** @param {string} text */
  edited(text) {
    if (this.shows === 'effect') {
      this.effectText = text;
      this.editedEffect(text);
      return;
    }
    this.store.change('text', (state) => { state.files[passOf(state).program ??= 'program.rc1'] = text; });
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
    this.store.change('inputs', (state) => {
      state.effect = effect;
      state.pass = Math.min(state.pass, Math.max(0, effect.passes.length - 1));
      for (const { program } of effect.passes) if (program) state.files[program] ??= this.programs[program] ?? '';
    });
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
