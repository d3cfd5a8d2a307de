/**
 * What a program's text leaves open: which function of a source sets the combiners, which of its programs is meant, and values
 * that the text does not give.
 */
import { choice, element, replaceChildren } from './dom.js';
import { bare, passOf, programFile, programIn } from './state.js';

/** What the engine says there is. @typedef {{functions?: {name: string, line: number, helper: boolean, needs: string[]}[], programs?: number, needs?: string[]}} Offered */

/** Functions as one chooses them: by the name, with the line where two have one name. @param {Offered} offered @returns {[string, string, string[]][]} value, title and needs */
function functionsOf({ functions = [] }) {
  const known = functions.filter(({ name }) => name);
  return known.map(({ name, line, helper, needs }) => {
    const twice = known.filter((other) => other.name === name).length > 1;
    return [twice ? `${name}:${line}` : name, `${name}, line ${line}${helper ? ', called by another' : ''}`, needs];
  });
}

/** The id of the text that describes the fields of values. */
const helpOfValues = 'help-define';

export class SourceChoices {
  /**
   * @param {HTMLElement} parent
   * @param {import('./state.js').Store} store
   */
  constructor(parent, store) {
    this.parent = parent;
    this.store = store;
    /** What is shown, as a text. */
    this.shown = '';
    /** The file and the function of the fields, and their names. */
    this.of = '';
    /** @type {string[]} */
    this.names = [];
  }

  /** Another state may have other values for the same names: the fields are made anew. */
  forget() {
    this.shown = '';
  }

  hide() {
    this.forget();
    this.parent.hidden = true;
  }

  /** Shows what there is to choose in the program of the pass. @param {Offered} offered */
  show(offered) {
    const { state } = this.store;
    const file = programFile(state);
    if (file === undefined) return this.hide();
    const { function: chosen = '', defines = {} } = state.choices[file] ?? {};
    const { number } = programIn(state.files, passOf(state).program);
    const all = functionsOf(offered);
    const roots = (offered.functions ?? []).filter(({ helper }) => !helper);
    const needs = offered.needs ?? all.find(([value]) => value === chosen)?.[2] ?? (roots.length === 1 ? roots[0].needs : []);
    // A value that is half typed may hide what else is needed: while one types, no field goes.
    const typing = this.of === JSON.stringify([file, chosen]) && this.parent.contains(document.activeElement);
    const names = [...new Set([...Object.keys(defines), ...needs, ...typing ? this.names : []])].sort();
    this.of = JSON.stringify([file, chosen]);
    this.names = names;
    const programs = Math.max(offered.programs ?? 1, number);
    const asks = [all.map(([value, title]) => [value, title]), programs, names];
    const shown = JSON.stringify([file, chosen, number, asks]);
    if (shown === this.shown) return undefined;
    this.shown = shown;
    const controls = [];
    if (all.length > 1 || chosen) {
      const options = [['', 'none'], ...all.map(([value, title]) => [value, title])];
      controls.push(named('function', choice('Function', options, chosen, (value) => this.edit(file, (now) => { now.function = value; }))));
    }
    if (programs > 1) {
      const options = [['0', 'none'], ...Array.from({ length: Math.min(programs, 1000) }, (_, at) => [String(at + 1), `#${at + 1}`])];
      controls.push(named('program', choice('Program', options, String(number), (value) => this.pick(file, Number(value)))));
    }
    controls.push(...names.map((name) => this.field(file, name, defines[name] ?? '')));
    if (names.length) controls.push(element('small', { class: 'help quiet', id: helpOfValues }, 'Values: a number, an enumerant, an expression, or several numbers with commas.'));
    this.parent.hidden = controls.length === 0;
    replaceChildren(this.parent, ...controls);
    return undefined;
  }

  /** @param {string} file @param {string} name @param {string} value */
  field(file, name, value) {
    const input = element('input', { type: 'text', value, 'data-define': name, placeholder: 'value', spellcheck: 'false', autocomplete: 'off', maxlength: 1000,
      'aria-describedby': helpOfValues, oninput: () => this.edit(file, (now) => {
        now.defines ??= bare({});
        if (input.value.trim()) now.defines[name] = input.value.trim();
        else delete now.defines[name];
      }) });
    return element('label', { class: 'field define' }, element('code', {}, name), ' = ', input);
  }

  /** @param {string} file @param {number} number */
  pick(file, number) {
    this.store.change('choices', (state) => { passOf(state).program = number ? `${file}#${number}` : file; });
  }

  /** @param {string} file @param {(choice: import('./state.js').Choice) => void} edit */
  edit(file, edit) {
    this.store.change('choices', ({ choices }) => {
      const now = choices[file] ?? bare({});
      edit(now);
      if (!now.function) delete now.function;
      if (Object.keys(now.defines ?? {}).length === 0) delete now.defines;
      if (Object.keys(now).length) choices[file] = now;
      else delete choices[file];
    });
  }
}

/** @param {string} name @param {any} label of a choice */
function named(name, label) {
  label.querySelector('select').dataset.choice = name;
  return label;
}
