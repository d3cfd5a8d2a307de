/**
 * The editor: CodeMirror with the programs' language and the engine's diagnostics under their lines.
 *
 * @typedef {{line?: number, column?: number, length?: number, message: string, severity?: 'error'|'info'}} Diagnostic
 */
import { autocompletion, closeBrackets, completionKeymap } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap } from '@codemirror/commands';
import { bracketMatching } from '@codemirror/language';
import { lintGutter, lintKeymap, setDiagnostics } from '@codemirror/lint';
import { highlightSelectionMatches, searchKeymap } from '@codemirror/search';
import { Compartment, EditorState, StateEffect, StateField } from '@codemirror/state';
import { Decoration, drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from '@codemirror/view';
import { effectOffers } from './effect_completion.js';
import { programLanguage } from './language.js';
import { effectFile } from './state.js';

/** Marks lines, by their numbers from 1. */
const markLines = /** @type {import('@codemirror/state').StateEffectType<number[]>} */ (StateEffect.define());

/** The marked lines. */
const markedLines = StateField.define({
  create: () => Decoration.none,
  update(marks, transaction) {
    let found = marks.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (!effect.is(markLines)) continue;
      const { doc } = transaction.state;
      const lines = effect.value.filter((line) => line <= doc.lines);
      found = Decoration.set(lines.map((line) => Decoration.line({ class: 'cm-lit' }).range(doc.line(line).from)));
    }
    return found;
  },
  provide: (field) => EditorView.decorations.from(field),
});

export class Editor {
  /**
   * @param {HTMLElement} parent
   * @param {(text: string) => void} changed hears of every edit by the user
   */
  constructor(parent, changed) {
    this.language = new Compartment();
    this.words = programLanguage([]);
    this.silent = false;
    /** The file that is shown; each has its own history. @type {string|null} */
    this.file = /** @type {string|null} */ (null);
    /** @type {Map<string|null, EditorState>} */
    this.kept = new Map();
    /** Hears into which line the cursor was moved. @type {(line: number) => void} */
    this.onmove = () => {};
    const listener = EditorView.updateListener.of((update) => {
      const line = (/** @type {EditorState} */ state) => state.doc.lineAt(state.selection.main.head).number;
      if (update.selectionSet && update.view.hasFocus && line(update.state) !== line(update.startState)) this.onmove(line(update.state));
      if (update.docChanged && !this.silent) changed(update.state.doc.toString());
    });
    // One list for all calls: the editor compares them.
    const effectWords = [{ autocomplete: (/** @type {import('@codemirror/autocomplete').CompletionContext} */ context) => this.completeEffect(context) }];
    // Tab leaves the editor, so that the keyboard alone suffices: Control-] and Control-[ indent.
    this.extensions = () => [
      lineNumbers(), history(), drawSelection(), bracketMatching(), closeBrackets(), highlightActiveLine(),
      highlightSelectionMatches(), autocompletion(), EditorState.languageData.of(() => effectWords), lintGutter(), EditorView.lineWrapping, EditorState.tabSize.of(2),
      keymap.of([...defaultKeymap, ...historyKeymap, ...searchKeymap, ...completionKeymap, ...lintKeymap]),
      this.language.of(this.words), markedLines, EditorView.contentAttributes.of({ 'aria-label': 'Program' }), listener,
    ];
    this.view = new EditorView({ parent, state: this.fresh('') });
  }

  /** A text without a history. @param {string} text */
  fresh(text) {
    return EditorState.create({ doc: text, extensions: this.extensions() });
  }

  /** @param {import('./language.js').Word[]} words */
  setWords(words) {
    this.words = programLanguage(words);
    this.view.dispatch({ effects: this.language.reconfigure(this.words) });
  }

  /** Forgets the history of a file, or all: other files are opened. @param {string} [file] */
  forget(file) {
    if (file !== undefined) {
      if (file === this.file) this.file = null;
      this.kept.delete(file);
      return;
    }
    this.file = null;
    this.kept.clear();
    this.view.setState(this.fresh(''));
  }

  /** A file has another name, and keeps its history. @param {string} from @param {string} to */
  rename(from, to) {
    if (this.file === from) this.file = to;
    const kept = this.kept.get(from);
    this.kept.delete(from);
    if (kept) this.kept.set(to, kept);
  }

  /** Shows a file. A change of the text that is shown can be undone in the editor. @param {string} file @param {string} text */
  open(file, text) {
    if (file !== this.file) {
      if (this.file !== null) this.kept.set(this.file, this.view.state);
      const kept = this.kept.get(file);
      this.file = file;
      this.view.setState(kept?.doc.toString() === text ? kept : this.fresh(text));
      this.view.dispatch({ effects: this.language.reconfigure(this.words) });
      this.show([]);
      return;
    }
    if (text === this.view.state.doc.toString()) return;
    this.silent = true;
    this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text } });
    this.silent = false;
    this.show([]);
  }

  /** Completes the effect's JSON, where that is shown. @param {import('@codemirror/autocomplete').CompletionContext} context */
  completeEffect(context) {
    if (this.file !== effectFile || !(context.explicit || context.matchBefore(/["\w]/))) return null;
    const found = effectOffers(context.state.sliceDoc(0, context.pos));
    if (!found?.offers.length) return null;
    // A closing quotation mark that was put there goes with the word.
    const after = context.state.sliceDoc(context.pos, context.pos + 1) === '"' ? 1 : 0;
    return { from: found.from, to: context.pos, filter: true, options: found.offers.map(({ label, apply, detail }) => ({
      label: `"${label}"`, displayLabel: label, info: detail, type: 'property',
      apply: (/** @type {EditorView} */ view) => view.dispatch({ changes: { from: found.from, to: view.state.selection.main.head + after, insert: apply }, selection: { anchor: found.from + apply.length } }),
    })) };
  }

  /** Lights lines, by their numbers from 1. @param {number[]} lines */
  light(lines) {
    this.view.dispatch({ effects: markLines.of(lines) });
  }

  /** @param {Diagnostic[]} diagnostics */
  show(diagnostics) {
    const { doc } = this.view.state;
    const placed = diagnostics.map(({ line, column, length, message, severity }) => {
      const place = doc.line(Math.min(Math.max(1, line || 1), doc.lines));
      const from = Math.min(place.from + Math.max(0, (column || 1) - 1), place.to);
      const word = /^[\w.]+/.exec(doc.sliceString(from, place.to))?.[0].length ?? 1;
      const to = Math.min(from + (length || word), place.to);
      // A place at the line's end has nothing to underline but the last character.
      return { from: from === to ? Math.max(place.from, from - 1) : from, to, message, severity: severity ?? 'error' };
    });
    placed.sort((a, b) => a.from - b.from);
    this.view.dispatch(setDiagnostics(this.view.state, placed));
  }

  /** Moves to a place and into the editor. @param {number} line @param {number} [column] */
  go(line, column) {
    const { doc } = this.view.state;
    const place = doc.line(Math.min(Math.max(1, line || 1), doc.lines));
    const at = Math.min(place.from + Math.max(0, (column || 1) - 1), place.to);
    this.view.dispatch({ selection: { anchor: at }, scrollIntoView: true });
    this.view.focus();
  }
}
