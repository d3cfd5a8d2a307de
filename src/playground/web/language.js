/**
 * Highlighting, completion and hover help for all forms of programs, from the engine's vocabulary.
 *
 * @typedef {{word: string, kind: string, help: string}} Word
 */
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from '@codemirror/language';
import { hoverTooltip } from '@codemirror/view';
import { tags } from '@lezer/highlight';
import { element } from './dom.js';

/** @type {Record<string, string>} */
const styles = { 'gl-constant': 'atom', 'gl-function': 'keyword', rc10: 'keyword', ps: 'keyword', profile: 'atom', json: 'propertyName' };

/**
 * Reads one token and says how it looks: comments, numbers, quoted words, known words.
 * @param {import('@codemirror/language').StringStream} stream
 * @param {{comment: boolean, json: boolean, shader: boolean, start: boolean}} state
 * @param {Map<string, string>} kinds
 * @returns {string|null}
 */
function token(stream, state, kinds) {
  if (state.comment) {
    if (stream.skipTo('*/')) {
      stream.match('*/');
      state.comment = false;
    } else {
      stream.skipToEnd();
    }
    return 'comment';
  }
  if (stream.eatSpace()) return null;
  if (stream.match('/*')) {
    state.comment = true;
    return 'comment';
  }
  if (stream.match('//') || (stream.peek() === '#' && !state.json) || (stream.peek() === ';' && state.shader)) {
    stream.skipToEnd();
    return 'comment';
  }
  if (stream.match(/^!!\S+/)) return 'meta';
  if (stream.match(/^[px]ps?\.\d(\.\d)?/i)) {
    state.shader = true;
    return 'meta';
  }
  if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) return stream.match(/^\s*:/, false) ? 'propertyName' : 'string';
  if (stream.match(/^(0x[0-9a-f]+|[-+]?\d+\.?\d*(e[-+]?\d+)?f?)/i)) return 'number';
  if (stream.match(/^[A-Za-z_]\w*/)) {
    const kind = kinds.get(stream.current().toLowerCase());
    return kind ? styles[kind] ?? 'keyword' : /^(tex|const|col|spare|v|r|c|t)\d|^(fog|zero|one|out|discard)$/.test(stream.current()) ? 'variableName' : null;
  }
  if (state.start && stream.match(/^[{[]/)) state.json = true;
  else stream.next();
  state.start = false;
  return null;
}

/** @param {Word[]} words */
function streamLanguage(words) {
  const kinds = new Map(words.map(({ word, kind }) => [word.toLowerCase(), kind]));
  return StreamLanguage.define({
    startState: () => ({ comment: false, json: false, shader: false, start: true }),
    token: (stream, state) => token(stream, state, kinds),
    languageData: { commentTokens: { line: '//' } },
  });
}

const look = HighlightStyle.define([
  { tag: tags.comment, color: 'var(--quiet)', fontStyle: 'italic' },
  { tag: tags.keyword, color: 'var(--code-keyword)' },
  { tag: tags.atom, color: 'var(--code-atom)' },
  { tag: tags.number, color: 'var(--code-number)' },
  { tag: [tags.string, tags.propertyName], color: 'var(--code-string)' },
  { tag: tags.variableName, color: 'var(--code-register)' },
  { tag: tags.meta, color: 'var(--quiet)', fontWeight: '600' },
]);

/** The word of a text around a place, or `null`. @param {string} text @param {number} at */
function wordAround(text, at) {
  let from = at;
  let to = at;
  while (from > 0 && /[\w.-]/.test(text[from - 1])) from--;
  while (to < text.length && /[\w.-]/.test(text[to])) to++;
  return from < to ? { from, to, word: text.slice(from, to) } : null;
}

/** @param {Word[]} words */
function hover(words) {
  const help = new Map(words.map((entry) => [entry.word.toLowerCase(), entry]));
  return hoverTooltip((view, at) => {
    const line = view.state.doc.lineAt(at);
    const found = wordAround(line.text, at - line.from);
    const parts = found ? [found.word, ...found.word.split(/[.-]/)] : [];
    const entry = parts.map((part) => help.get(part.toLowerCase())).find((candidate) => candidate?.help);
    if (!found || !entry) return null;
    const dom = element('div', { class: 'hover-help' }, element('strong', {}, entry.word), ' ', entry.help);
    return { pos: line.from + found.from, end: line.from + found.to, above: true, create: () => ({ dom }) };
  });
}

/** @param {Word[]} words */
function completionSource(words) {
  const options = words.map(({ word, kind, help }) => ({ label: word, type: kind === 'gl-function' ? 'function' : 'keyword', detail: kind, info: help || undefined }));
  return (/** @type {import('@codemirror/autocomplete').CompletionContext} */ context) => {
    const before = context.matchBefore(/[\w!.]+/);
    if (!before || (before.to - before.from < 2 && !context.explicit)) return null;
    return { from: before.from, options, validFor: /^[\w!.]*$/ };
  };
}

/**
 * All of it as extensions of an editor.
 * @param {Word[]} words
 */
export function programLanguage(words) {
  const language = streamLanguage(words);
  return [language, language.data.of({ autocomplete: completionSource(words) }), syntaxHighlighting(look), hover(words)];
}
