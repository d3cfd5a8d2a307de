/** States that no one would write by hand: each is drawn, or gets one clear sentence. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { addressOf } from '../../src/playground/web/permalink.js';
import { newState } from '../../src/playground/web/state.js';
import { clickPixel, editorText, faults, follow, hashOf, message, nativeHash, openEffect, openTab, pageTest, root, stateOf, type, waitForHash } from './support.mjs';

const names = ['__proto__', 'constructor', 'toString', 'hasOwnProperty'];
const linksOf = (states) => Promise.all(states.map((state) => addressOf(state)));

const named = await linksOf(names.map((name) => {
  const state = newState();
  state.files = { [name]: '!!RC1.0\nout.rgb = unsigned_invert(tex0);\nout.a = unsigned_invert(zero);\n' };
  state.effect.textures = { [name]: state.effect.textures.tex0 };
  state.effect.passes = [{ name, program: name, units: [{ texture: name, coordinates: 'uv' }] }];
  return state;
}));
pageTest('programs, textures and passes may have the names of what objects have', { hash: named[0] }, async (page) => {
  for (const [at, name] of names.entries()) {
    await follow(page, named[at]);
    await page.waitForFunction((wanted) => globalThis.ninebit.store.state.effect.passes[0].program === wanted, {}, name);
    assert.equal(await message(page), '');
    const state = await stateOf(page);
    await waitForHash(page, nativeHash(state));
    assert.equal(await editorText(page), state.files[name]);
    for (const tab of ['inputs', 'trace', 'explain', 'profiles', 'gpu', 'convert', 'command']) await page.click(`#tab-${tab}`);
    await type(page, '!!RC1.0\nout.rgb = tex0;\nout.a = unsigned_invert(zero);\n');
    await page.waitForFunction((key) => globalThis.ninebit.store.state.files[key].includes('= tex0;'), {}, name);
    await waitForHash(page, nativeHash(await stateOf(page)));
  }
});

const missing = await linksOf(names.map((name) => {
  const state = newState();
  state.effect.passes[0].program = name;
  return state;
}));
pageTest('a program that is missing and has such a name is a fault and no function', { hash: missing[0] }, async (page) => {
  for (const [at, name] of names.entries()) {
    await follow(page, missing[at]);
    await page.waitForFunction((wanted) => globalThis.ninebit.store.state.effect.passes[0].program === wanted &&
      document.getElementById('faults').textContent.includes(`${wanted}: is not among the files`), {}, name);
  }
});

const wrong = [[(state) => { state.effect.passes[0].constants = { const0: 5 }; }, 'passes[0].constants.const0 must be a list'],
  [(state) => { state.effect.scene = { camera: 'x' }; }, 'scene.camera must be a list'],
  [(state) => { state.effect.passes = [null]; }, 'passes[0] must be an object'],
  [(state) => { state.effect.passes[0].name = {}; }, 'passes[0].name must be a string'],
  [(state) => { state.effect.title = ['a']; }, 'title must be a string'],
  [(state) => { state.pass = -1; }, 'pass is -1; expected 0 or more'],
  [(state) => { state.profile = JSON.parse('{"a":'.repeat(2000) + '1' + '}'.repeat(2000)); }, 'the profile is nested more than 64 levels deep'],
  [(state) => { state.files = { a: {} }; }, 'files.a must be a string']];
const refused = await linksOf(wrong.map(([change]) => {
  const state = newState();
  change(state);
  return state;
}));
pageTest('links with values of the wrong kind get one sentence and the first effect', { hash: refused[0] }, async (page) => {
  const first = await stateOf(page);
  assert.equal(first.effect.title, 'Sepia');
  for (const [at, [, sentence]] of wrong.entries()) {
    await follow(page, refused[at]);
    await page.waitForFunction((text) => document.getElementById('message').textContent === text, {}, `This link cannot be opened: ${sentence}.`);
    assert.notEqual(await hashOf(page), '');
    assert.deepEqual(await stateOf(page), first);
  }
});

pageTest('typing such values keeps the last state and names the place', { effect: 'sepia' }, async (page) => {
  await openTab(page, 'effect.json');
  const old = await stateOf(page);
  const cases = [[(effect) => { effect.passes = [null]; }, /^\d+:\d+ .*must be an object/], [(effect) => { effect.passes[0].constants = { const0: 5 }; }, /^\d+:\d+ .*const0/],
    [(effect) => { effect.scene = { camera: 'x' }; }, /^\d+:\d+ .*camera/], [(effect) => { effect.passes[0].program = {}; }, /^\d+:\d+ .*program/]];
  for (const [change, expected] of cases) {
    const effect = structuredClone(old.effect);
    change(effect);
    await type(page, JSON.stringify(effect, null, 2));
    await page.waitForFunction((pattern) => new RegExp(pattern).test(document.getElementById('faults').textContent), {}, expected.source);
    assert.deepEqual(await stateOf(page), old);
    await type(page, JSON.stringify(old.effect, null, 2));
    await page.waitForFunction(() => document.getElementById('faults').children.length === 0);
  }
  await type(page, '{"ninebit": "effect",\n  "version": }');
  await page.waitForFunction(() => /^2:\d+ /.test(document.getElementById('faults').textContent));
});

pageTest('Chinese text is quoted as it is', { effect: 'sepia' }, async (page) => {
  await type(page, '!!RC1.0\nout.rgb = 颜色;\n');
  await page.waitForFunction(() => document.getElementById('faults').textContent.includes("'颜色'"));
});

pageTest('the mark leaves with its effect, and Ctrl with the wheel leaves it on its pixel', { effect: 'sepia' }, async (page) => {
  await clickPixel(page, 20, 30);
  const marked = () => page.evaluate(() => {
    const { mark, chosen } = globalThis.ninebit.page.picture;
    return { hidden: mark.hidden, ...chosen };
  });
  assert.deepEqual(await marked(), { hidden: false, x: 20, y: 30 });
  await page.keyboard.down('Control');
  await page.mouse.wheel({ deltaY: -100 });
  await page.mouse.move(700, 400);
  await page.mouse.wheel({ deltaY: -100 });
  await page.keyboard.up('Control');
  await page.waitForFunction(() => globalThis.ninebit.page.picture.zoom > 0);
  assert.deepEqual(await marked(), { hidden: false, x: 20, y: 30 });
  await openEffect(page, 'emboss');
  assert.equal((await marked()).hidden, true);
});

pageTest("the room's camera sliders begin where its camera is, and a degree is a small step", { effect: 'sepia' }, async (page) => {
  const room = { 'index_room.gltf': readFileSync(join(root, 'scenes/index_room.gltf')) };
  await page.evaluate(() => globalThis.ninebit.store.change('inputs', (state) => {
    state.files['programs/sepia.rc1'] = '!!RC1.0\nout.rgb = col0;\nout.a = unsigned_invert(zero);\n';
    Object.assign(state.effect.passes[0], { units: [], primary: 'lambert' });
    state.effect.scene = { mesh: 'index_room.gltf' };
  }));
  await waitForHash(page, nativeHash(await stateOf(page), room));
  const view = await page.evaluate(() => globalThis.ninebit.page.inputs.view);
  const [around, , distance] = await page.$$eval('#panel-inputs .camera input', (sliders) => sliders.map(({ value }) => Number(value)));
  const away = Math.hypot(...view.position.map((value, at) => value - view.target[at]));
  assert.ok(away > 3.5 && Math.abs(distance - away) < away / 50, `the slider says ${distance}, the camera is ${away} away`);
  await page.$eval('#panel-inputs .camera input', (slider, value) => {
    slider.value = String(value);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }, around + 1);
  const { camera } = (await stateOf(page)).effect.scene;
  const moved = Math.hypot(...camera.map((value, at) => value - view.position[at]));
  assert.ok(moved < away / 20, `it moved by ${moved} of ${away}`);
  await waitForHash(page, nativeHash(await stateOf(page), room));
});

pageTest('the inputs have as many texture units as the chip', { effect: 'sepia' }, async (page) => {
  const legends = () => page.$$eval('#panel-inputs legend', (all) => all.map(({ textContent }) => textContent).filter((text) => text.startsWith('Texture')));
  assert.deepEqual(await legends(), ['Texture 0', 'Texture 1']);
  await page.select('#profile-choice select', 'nv2a');
  assert.equal((await legends()).length, 4);
  await page.evaluate(() => globalThis.ninebit.store.change('profile', (state) => { state.profile = { base: 'geforce2', name: 'mine', texture_units: 3 }; }));
  assert.equal((await legends()).length, 3);
});

pageTest('another source of a texture leaves nothing that the engine refuses', { effect: 'dot3_specular' }, async (page) => {
  await page.evaluate(() => globalThis.ninebit.page.inputs.setSource(0, 'textures/bricks.png'));
  await waitForHash(page, nativeHash(await stateOf(page)));
});

pageTest('warnings of a drawing are shown, and all faults of it', { effect: 'sepia' }, async (page) => {
  await type(page, '!!RC1.0\nout.rgb = tex1 * const0;\nout.a = unsigned_invert(zero);\n');
  await page.waitForFunction(() => /tex1|unit 1|texture 1/i.test(document.getElementById('faults').textContent));
  assert.notEqual(await hashOf(page), '');
  // A fault of the drawing that comes after one of the text is shown, too.
  await type(page, '!!RC1.0\nout.rgb = bogus;\n');
  await page.waitForFunction(() => document.getElementById('faults').textContent.includes('bogus'));
  await page.evaluate(() => globalThis.ninebit.store.change('inputs', (state) => { state.effect.scene = { mesh: 'sphere:999999' }; }));
  await page.waitForFunction(() => /bogus[^]*at most \d+ segments/.test(document.getElementById('faults').textContent));
  assert.equal((await faults(page)).match(/bogus/g).length, 1);
});

pageTest('the message about a crash leaves with the next picture', { effect: 'sepia' }, async (page) => {
  // At once: a picture that was asked for before takes the message away.
  const said = await page.evaluate(() => {
    globalThis.ninebit.page.live.read();
    globalThis.ninebit.engine.worker.dispatchEvent(new ErrorEvent('error', { message: 'memory access out of bounds' }));
    return document.getElementById('message').textContent;
  });
  assert.match(said, /crashed/);
  await page.evaluate(() => globalThis.ninebit.store.change('text', () => {}));
  await page.waitForFunction(() => document.getElementById('message').hidden);
});
