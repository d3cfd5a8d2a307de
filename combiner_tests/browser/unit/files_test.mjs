/** The files of an effect: their order, names, renaming, and what sources include. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { commandsOf, inOneFolder } from '../../../src/playground/web/command_line.js';
import { allFiles, besideProgram, faultOfName, freeName, includedIn, isBelow, remove, rename } from '../../../src/playground/web/files.js';
import { bare, checkedState, programFile, programIn } from '../../../src/playground/web/state.js';

const state = () => bare({
  effect: { ninebit: 'effect', version: 1, passes: [{ program: 'b.c#2' }, {}, { program: 'a.rc1' }, { program: 'b.c' }] },
  files: { 'x.h': '', 'a.rc1': '', 'b.c': '' }, choices: { 'b.c': { function: 'f', defines: { 'it is': "o'clock" } } }, pass: 0, profile: 'nv2a', other: 'geforce2',
});

test('programs come first, then what is beside them, then the effect', () => {
  assert.deepEqual(allFiles(state()), ['b.c', 'a.rc1', 'x.h', 'effect.json']);
  assert.equal(programFile(state()), 'b.c');
});

test('a number behind a name is no part of it, unless a file has the whole name', () => {
  assert.deepEqual(programIn({ 'b.c': '' }, 'b.c#12'), { file: 'b.c', number: 12 });
  assert.deepEqual(programIn({ 'b.c#12': '' }, 'b.c#12'), { file: 'b.c#12', number: 0 });
  assert.deepEqual(programIn({}, 'b.c#'), { file: 'b.c#', number: 0 });
});

test('a name goes everywhere that its file is named', () => {
  const renamed = state();
  rename(renamed, 'b.c', 'lib/c.c');
  assert.deepEqual(renamed.effect.passes.map(({ program }) => program), ['lib/c.c#2', undefined, 'a.rc1', 'lib/c.c']);
  assert.deepEqual(Object.keys(renamed.files), ['x.h', 'a.rc1', 'lib/c.c']);
  assert.equal(renamed.choices['lib/c.c'].function, 'f');
  remove(renamed, 'lib/c.c');
  assert.deepEqual(Object.keys(renamed.choices), []);
});

test('names that a folder cannot have are refused', () => {
  for (const name of ['', '/a', '../a', 'a/../b', 'a//b', 'a\\b', '-a', 'a\n', 'effect.json', 'sources.json', 'program-3.txt']) assert.equal(isBelow(name), false, name);
  assert.match(faultOfName(state(), 'a#1') ?? '', /is not a valid name for a file/);
  assert.match(faultOfName(state(), 'x.h') ?? '', /There is a file x\.h/);
  assert.equal(faultOfName(state(), '__proto__'), null);
  assert.equal(freeName(state(), 'a.rc1'), 'a-2.rc1');
  assert.equal(freeName(state(), 'new'), 'new');
});

test('includes in quotation marks are found', () => {
  assert.deepEqual(includedIn('#include "a.h"\n # include\t"lib\\\\b.h"\n#include <c.h>\n// #include "d.h"\n#include "./e.h"\n'), ['a.h', 'lib//b.h', 'e.h']);
});

test('the script converts what an effect cannot name, and names the rest', () => {
  const script = commandsOf(state(), null);
  assert.match(script, /^ninebit convert 'b\.c#2' --function f --define 'it is=o'\\''clock' --profile nv2a --to json -o b\.c-2\.json$/m);
  assert.match(script, /^ninebit convert b\.c --function f /m);
  assert.deepEqual(inOneFolder(state()).effect.passes.map(({ program }) => program), ['b.c-2.json', undefined, 'a.rc1', 'b.c.json']);
  const plain = { ...state(), choices: {} };
  assert.deepEqual(inOneFolder(plain).effect.passes.map(({ program }) => program), ['b.c#2', undefined, 'a.rc1', 'b.c']);
  assert.doesNotMatch(commandsOf(plain, null), /convert/);
});

test('what a source is converted to takes the name of no other file', () => {
  const choice = { function: 'f' };
  for (const [files, programs, expected] of [[['effect'], ['effect'], ['effect.program.json']], [['sources'], ['sources'], ['sources.program.json']],
    [['profile'], ['profile'], ['profile.program.json']], [['a', 'a.json'], ['a'], ['a.program.json']],
    [['a', 'a-1'], ['a#1', 'a-1'], ['a-1.json', 'a-1.program.json']]]) {
    const named = bare({ ...state(), effect: { passes: programs.map((program) => ({ program })) }, files: Object.fromEntries(files.map((name) => [name, ''])),
      choices: Object.fromEntries(files.map((name) => [name, choice])) });
    assert.deepEqual(inOneFolder(named).converted.map(({ to }) => to), expected);
  }
});

test('a dropped text stands beside the program if that includes it, or if it is a header', () => {
  const including = (/** @type {string} */ text, program = 'src/b.c') => bare({ ...state(), effect: { passes: [{ program }] }, files: { [program]: text } });
  assert.equal(besideProgram(including('#include "lib/lights.h"\n'), 'lights.h'), 'src/lib/lights.h');
  assert.equal(besideProgram(including('#include "../lights.c"\n#include "lights.c"\n'), 'lights.c'), 'src/lights.c');
  assert.equal(besideProgram(including(''), 'lights.h'), 'src/lights.h');
  assert.equal(besideProgram(including(''), 'lights.c'), undefined);
  for (const name of ['../common/lights.h', '/lights.h', 'a/../lights.h']) {
    assert.throws(() => besideProgram(including(`#include "${name}"\n`), 'lights.h'), { message: `lights.h: it is included as ${JSON.stringify(name)}; expected a name in the program's folder or below, such as "lights.h"` });
  }
});

test('choices of other kinds are errors in words, and a state without them has none', () => {
  const old = state();
  delete old.choices;
  assert.deepEqual(Object.keys(checkedState(structuredClone(old)).choices), []);
  for (const [choices, expected] of [[7, /choices must be an object/], [{ a: 7 }, /choices\.a must be an object/], [{ a: { function: 7 } }, /function must be a string/],
    [{ a: { defines: { b: 1 } } }, /defines\.b must be a string/], [{ a: { other: 1 } }, /unknown key "other"/]]) assert.throws(() => checkedState({ ...structuredClone(old), choices }), expected);
});
