/** The keyboard's focus where children are replaced. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { made } from './small_dom.mjs';
import { element, replaceChildren } from '../../../src/playground/web/dom.js';

const control = (name, key) => element('input', { 'aria-label': name, ...(key && { 'data-key': key }) });

test('the focus goes to the control of the same name, wherever it stands now', () => {
  const parent = made('div');
  replaceChildren(parent, control('Scene'), control('Order'), control('Size', 'size'), control('Step'), control('Step'));
  const focusOf = (...children) => {
    replaceChildren(parent, ...children);
    return parent.children.indexOf(globalThis.document.activeElement);
  };
  parent.children[1].focus();
  assert.equal(focusOf(control('More'), control('Scene'), control('Order'), control('Width', 'size'), control('Step'), control('Step')), 2);
  parent.children[3].focus();
  assert.equal(focusOf(control('Height', 'size'), control('Step'), control('Step')), 0, 'a key is the name');
  parent.children[2].focus();
  assert.equal(focusOf(control('Scene'), control('Step'), control('Scene'), control('Step')), 3, 'the second of two of one name');
  assert.equal(focusOf(control('Other'), control('Other'), control('Another'), control('Last')), 3, 'none of the name: that at its place');
});

test('without the focus inside, none comes', () => {
  const parent = made('div');
  replaceChildren(parent, control('Scene'));
  globalThis.document.activeElement = null;
  replaceChildren(parent, control('Scene'));
  assert.equal(globalThis.document.activeElement, null);
});
