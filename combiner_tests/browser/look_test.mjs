/** What the page says it is: the first look, the layout, the strip, flip, marks of losses, links of what is looked at, embed. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { setTimeout as pause } from 'node:timers/promises';
import { addressOf } from '../../src/playground/web/permalink.js';
import { decodePng } from '../../src/playground/web/png.js';
import { newState } from '../../src/playground/web/state.js';
import { choosePixel, clickPixel, editorText, expectedHashes, folderOf, hashOf, native, nativeTrace, openEffect, openPage, openTab, pageTest, root, stateOf, type, waitForHash, waitForReady, waitForTrace } from './support.mjs';

const boxOf = (page, selector) => page.$eval(selector, (node) => {
  const { left, top, right, bottom } = node.getBoundingClientRect();
  return { left, top, right, bottom };
});

pageTest('it opens with the bump-mapped torus, one sentence and three things to try', { first: null }, async (page) => {
  assert.equal(await hashOf(page), expectedHashes().dot3_specular);
  assert.match(await page.$eval('#purpose', ({ textContent }) => textContent), /^[A-Z][^.]*[.]?[^.]*\.$/);
  await page.click('#try-trace');
  await waitForTrace(page);
  await page.click('#try-flip');
  await page.waitForFunction(() => !document.querySelector('.badge').hidden);
  assert.match(await page.$eval('.badge', ({ textContent }) => textContent), /^exact combiners: 18,677 pixels differ, by 6/);
  await page.click('#try-sweep');
  await page.waitForSelector('#panel-sweep .curve');
  await page.click('#hide-tries');
  await page.reload();
  await waitForReady(page);
  assert.equal(await page.$eval('#tries', ({ hidden }) => hidden), true);
});

pageTest('editor, picture and inspector are side by side from 1200 pixels, and a click shows the trace where one looks', async (page) => {
  for (const [width, height] of [[1200, 700], [1280, 720], [1600, 1000]]) {
    await page.setViewport({ width, height });
    await openEffect(page, 'sepia');
    const [editor, picture, panels] = await Promise.all(['#editor-pane', '#picture-pane', '#panels'].map((selector) => boxOf(page, selector)));
    assert.ok(editor.right < picture.left && picture.right < panels.left, `${width}`);
    assert.ok(Math.max(editor.bottom, picture.bottom, panels.bottom) <= height, `${width} x ${height}`);
    await page.click('#tab-inputs');
    await clickPixel(page, 128, 128);
    await waitForTrace(page);
    for (const selector of ['#strip', '#trace .nb-box']) {
      const box = await boxOf(page, selector);
      assert.ok(box.top >= 0 && box.bottom <= height && box.left < width - 100, `${selector} at ${width} x ${height}: ${JSON.stringify(box)}`);
    }
    assert.ok(await page.evaluate(() => document.documentElement.scrollHeight <= innerHeight), `${width} scrolls`);
  }
});

pageTest('on a phone a click brings the strip and the trace into view', { width: 390, height: 844 }, async (page) => {
  await choosePixel(page, 100, 100);
  const [picture, strip, diagram] = await Promise.all(['#picture canvas', '#strip', '#trace .nb-diagram'].map((selector) => boxOf(page, selector)));
  assert.ok(picture.top >= 0 && strip.bottom < 844 && diagram.top < 800, JSON.stringify({ picture, strip, diagram }));
  const columns = await page.evaluate(() => {
    document.getElementById('open-gallery').click();
    return getComputedStyle(document.querySelector('.gallery')).gridTemplateColumns.split(' ').length;
  });
  assert.equal(columns, 2);
});

pageTest('the strip has the values of the native trace', { effect: 'sepia' }, async (page) => {
  await choosePixel(page, 60, 70);
  const expected = nativeTrace(await stateOf(page), 60, 70);
  const text = await page.$eval('#strip', ({ textContent }) => textContent);
  assert.ok(text.includes(`tex0 ${expected.before.tex0.codes.join(' ')}`) && text.includes(`out ${expected.out.codes.join(' ')}`), text);
});

pageTest('F flips between the profiles, and the picture is the other profile’s', async (page) => {
  const sums = () => page.evaluate(() => globalThis.ninebit.page.picture.pixels.reduce((sum, value, at) => (sum * 31 + value * (at % 97)) % 1_000_003, 7));
  const usual = await sums();
  await page.evaluate(() => globalThis.ninebit.store.change('other', (state) => { state.other = 'nv2a'; }));
  await page.focus('.picture-scroll');
  await page.keyboard.press('f');
  await page.waitForFunction(() => document.querySelector('.badge').textContent.startsWith('nv2a'));
  const flipped = await sums();
  assert.notEqual(flipped, usual);
  const difference = native(folderOf(await stateOf(page)), 'draw', 'effect.json', '--profile', (await stateOf(page)).profile, '--difference', 'nv2a', '-o', 'a.png').difference;
  assert.ok((await page.$eval('.badge', ({ textContent }) => textContent)).includes(`${difference.pixels.toLocaleString('en')} pixels differ`));
  await page.keyboard.press('f');
  await page.waitForFunction(() => document.querySelector('.badge').hidden);
  assert.equal(await sums(), usual);
  // Not where one types.
  await page.focus('.cm-content');
  await page.keyboard.press('f');
  assert.equal(await page.$eval('#flip', (button) => button.getAttribute('aria-pressed')), 'false');
});

pageTest('while one types, Flip shows each picture of the other profile, with a pixel chosen and the profiles open', async (page) => {
  await page.evaluate(() => globalThis.ninebit.store.change('other', (state) => { state.other = 'nv2a'; }));
  await choosePixel(page, 60, 70);
  await page.click('#tab-profiles');
  await page.click('#flip');
  await page.waitForFunction(() => document.querySelector('.badge').textContent.startsWith('nv2a'));
  for (const scale of ['    scale_by_two();\n', '']) {
    await type(page, `!!RC1.0\n{\n  rgb {\n    discard = tex0 * col0;\n    discard = tex0 * tex0;\n    spare0 = sum();\n${scale}  }\n}\nout.rgb = spare0;\nout.a = unsigned_invert(zero);\n`);
    const state = await stateOf(page);
    const folder = folderOf(state);
    native(folder, 'draw', 'effect.json', '--profile', state.other, '-o', 'a.png');
    const { pixels } = await decodePng(new Uint8Array(readFileSync(`${folder}/a.png`)), 1 << 20);
    const colors = (bytes) => bytes.filter((_, at) => at % 4 !== 3);
    const wanted = colors([...pixels]);
    for (const end = performance.now() + 10_000; ;) {
      const shown = colors(await page.evaluate(() => [...globalThis.ninebit.page.picture.pixels]));
      const wrong = shown.filter((value, at) => value !== wanted[at]).length;
      if (wrong === 0 && shown.length === wanted.length) break;
      assert.ok(performance.now() < end, `${wrong} values are not those of ${state.other}`);
    }
  }
});

pageTest('the texture-shader stages stand in the diagram before the first combiner, with the values of the native trace', { effect: 'diffuse_specular' }, async (page) => {
  await choosePixel(page, 60, 128);
  const state = await stateOf(page);
  const { effect } = nativeTrace(state, 60, 128);
  const { stages } = effect.passes[0].fragments[effect.fragment];
  const shown = await page.$$eval('#trace .nb-box[aria-label^="Texture shader"]', (boxes) => boxes.map((box) => ({
    title: box.querySelector('b').textContent, values: [...box.querySelectorAll('.nb-held')].map(({ textContent }) => textContent) })));
  assert.deepEqual(shown.map(({ title }) => title), ['0: texture 2D', '1: dot product', '2: diffuse cube map', '3: reflect cube map']);
  const text = (value) => String(Number(value.toPrecision(6)));
  stages.forEach((stage, at) => {
    for (const value of [...stage.coordinates, ...stage.normal ?? [], ...stage.dot === undefined ? [] : [stage.dot], ...stage.at ?? [], ...stage.texel, ...stage.codes]) {
      assert.ok(shown[at].values.includes(text(value)), `${value} in ${shown[at].values}`);
    }
  });
  assert.equal(await page.$eval('#trace .nb-section h3', ({ textContent }) => textContent), 'Texture shader');
  // A click on a wire chooses the box that it leads to, which is lit with what it reads.
  const [from, x, y] = await page.evaluate(() => {
    const hold = [...document.querySelectorAll('#trace .nb-hold')].find(({ nbWire }) => nbWire.from.id === 'texture/stage2' && nbWire.to.section.id === 'stage0');
    hold.scrollIntoView({ block: 'center', inline: 'center' });
    // A place of the wire that no other part of the diagram covers.
    const length = hold.getTotalLength(), toScreen = hold.getScreenCTM();
    const places = Array.from({ length: 19 }, (_, i) => hold.getPointAtLength(length * (i + 1) / 20).matrixTransform(toScreen));
    const free = places.find((place) => document.elementFromPoint(place.x, place.y) === hold);
    return [hold.nbWire.to.id, free?.x, free?.y];
  });
  assert.ok(x !== undefined, 'the wire can be met');
  await page.mouse.click(x, y);
  const lit = await page.evaluate(() => [...document.querySelectorAll('#trace .nb-box.nb-lit')].map((box) => box.getAttribute('aria-label')));
  assert.match(from, /^stage0\/in-tex2$/);
  assert.ok(lit.some((label) => label.startsWith('Texture shader: 2:')) && lit.some((label) => label.startsWith('General combiner 0: tex2')), lit.join('; '));
});

pageTest('marks of losses are those of the traces, by stage', { effect: 'dot3_specular' }, async (page) => {
  await page.select('#mark-losses', 'clamped');
  await page.waitForFunction(() => document.getElementById('losses-result').dataset.marked);
  const all = Number(await page.$eval('#losses-result', ({ dataset }) => dataset.marked));
  await page.select('#mark-stage', '0');
  const first = Number(await page.$eval('#losses-result', ({ dataset }) => dataset.marked));
  assert.ok(first <= all && all > 100, `${first} of ${all}`);
  const layer = await page.evaluate(() => {
    const { layer: canvas } = globalThis.ninebit.page.losses;
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const marked = [];
    for (let at = 3; at < data.length; at += 4) if (data[at]) marked.push((at - 3) / 4);
    return marked;
  });
  assert.equal(layer.length, first);
  const state = await stateOf(page);
  const cut = (pixel) => nativeTrace(state, pixel % 256, Math.floor(pixel / 256)).stages[0].rgb.channels.some(({ outputs }) => outputs.some((output) => output.cut.code !== 0));
  for (const pixel of [layer[0], layer[Math.floor(layer.length / 2)]].filter((found) => found !== undefined)) assert.ok(cut(pixel), `${pixel}`);
  await page.select('#mark-losses', '');
  await page.waitForFunction(() => globalThis.ninebit.page.losses.layer.hidden);
});

pageTest('a sweep has the codes of the native program, and the exact value', { effect: 'sepia' }, async (page) => {
  await choosePixel(page, 40, 50);
  await page.click('#tab-sweep');
  await page.waitForSelector('#sweep-input');
  await page.select('#sweep-input', 'tex0.r');
  await page.waitForFunction(() => globalThis.ninebit.page.sweep.input === 'tex0.r' && document.getElementById('sweep-place').textContent.endsWith(' tex0.r:'));
  const { codes, exact, at, one } = await page.evaluate(() => globalThis.ninebit.page.sweep.curves[0]);
  const state = await stateOf(page);
  const trace = nativeTrace(state, 40, 50);
  assert.equal(codes[at], trace.out.codes[0]);
  assert.equal(exact[at], trace.final.rgb[0].written.ideal);
  const folder = folderOf(state);
  for (const byte of [0, 100, 255]) {
    const [, g, b, a] = trace.before.tex0.codes;
    const found = native(folder, 'trace', state.effect.passes[0].program, '--profile', state.profile, '--set', `tex0=${byte},${g},${b},${a}`);
    assert.equal(codes[byte], found.out.codes[0], `${byte} of ${one}`);
  }
  await page.$eval('.plot', (plot) => plot.focus());
  await page.keyboard.press('ArrowRight');
  assert.match(await page.$eval('#sweep-value', ({ textContent }) => textContent), new RegExp(`^tex0.r = ${at + 1}: `));
});

pageTest('a link keeps the pixel, the tab, the sweep, the marks and the settings of index shadows', async (page) => {
  await page.evaluate(() => {
    const { page: shown } = globalThis.ninebit;
    shown.picture.take({ x: 33, y: 44 });
    shown.shadow.ask({ step: 3, map_size: 128 });
    shown.losses.take('truncated', '0');
  });
  await page.click('#tab-sweep');
  await page.waitForSelector('#sweep-output');
  await page.evaluate(() => globalThis.ninebit.page.keep());
  const hash = await page.evaluate(() => location.hash);
  const other = await openPage(page.browser(), { hash });
  await other.waitForSelector('#sweep-output');
  const found = await other.evaluate(() => {
    const { page: shown } = globalThis.ninebit;
    return { pixel: shown.live.pixel, tab: shown.panel(), shadow: shown.shadow.asked, losses: [shown.losses.kind, shown.losses.stage], marked: !shown.picture.mark.hidden };
  });
  assert.deepEqual(found, { pixel: { x: 33, y: 44 }, tab: 'sweep', shadow: { scene: 'room', step: 3, map_size: 128, order: 'neighbour' }, losses: ['truncated', '0'], marked: true });
  assert.deepEqual(other.complaints, []);
});

const views = [{ pixel: 'x', tab: 3, shadow: 7, sweep: [], losses: {}, flip: 'yes' }, { pixel: [1e9, -1], tab: 'nothing', shadow: { step: 'x', map_size: 1e9 }, losses: ['__proto__', '9'] },
  { pixel: [5000, 5000], tab: 'sweep', sweep: { input: '<b>', output: 'x.y', stage: '7' } }, { tab: 'shadow', shadow: { nonsense: 1 } }];
for (const view of views) {
  pageTest(`what a link says to look at may be anything: ${JSON.stringify(view)}`, { hash: await addressOf(newState(), view) }, async (page) => {
    assert.notEqual(await hashOf(page), '');
  });
}

pageTest('index shadows are a mode of the picture, the neighbour order first', { effect: 'sepia' }, async (page) => {
  await page.click('#mode-shadow');
  await page.waitForFunction(() => document.getElementById('shadow-result').textContent.includes('pixels in shadow'));
  const { width, height, order } = await page.evaluate(() => ({ ...globalThis.ninebit.page.shadow.asked, width: globalThis.ninebit.page.picture.width, height: globalThis.ninebit.page.picture.height }));
  assert.deepEqual([width, height, order], [480, 360, 'neighbour']);
  await page.click('#mode-effect');
  await page.waitForFunction(() => globalThis.ninebit.page.picture.width === 256);
});

pageTest('a line of the program lights its boxes, and a box its lines', { effect: 'sepia' }, async (page) => {
  await choosePixel(page, 60, 70);
  const lines = await page.evaluate(() => globalThis.ninebit.page.trace.lines);
  const line = lines.findIndex((boxes) => boxes.some((box) => box.startsWith('stage0/rgb-'))) + 1;
  await page.evaluate((number) => globalThis.ninebit.page.trace.lightLine(number), line);
  assert.ok(await page.$$eval('#trace .nb-box.nb-lit', (boxes) => boxes.length) > 0);
  const lit = await page.evaluate((box) => {
    globalThis.ninebit.page.trace.chosen(box);
    return [...document.querySelectorAll('.cm-lit')].map(({ textContent }) => textContent);
  }, lines[line - 1].find((box) => box.endsWith('-ab') || box.endsWith('-third')));
  assert.ok(lit.length >= 1);
});

pageTest('embedded, there are picture, editor and trace, and nothing is kept', { query: '?embed&effect=emboss', width: 900, height: 600 }, async (page) => {
  assert.equal(await hashOf(page), expectedHashes().emboss);
  const shown = await page.evaluate(() => [...document.querySelectorAll('header, footer, #tries, [role=tab]')].filter((node) => node.checkVisibility()).map(({ id, tagName }) => id || tagName));
  assert.deepEqual(shown, ['tab-trace', 'tab-sweep', 'tab-explain']);
  await page.evaluate(() => globalThis.ninebit.page.keep());
  assert.equal(await page.evaluate(() => localStorage.length), 0);
  assert.match(await page.$eval('#whole', ({ textContent }) => textContent), /Open in the playground/);
  // It has no tabs: a link that was copied beside another file shows the program, too.
  assert.equal(await page.evaluate(() => {
    const { page: shown } = globalThis.ninebit;
    shown.look({ file: 'effect.json' });
    return shown.program.shows;
  }), 'program');
});

pageTest('an effect that moves plays and pauses, and each picture is that of its time', { effect: 'sepia' }, async (page, context) => {
  assert.equal(await page.$eval('.clock', ({ hidden }) => hidden), true);
  await openEffect(page, 'dot3_specular');
  assert.equal(await page.$eval('.clock', ({ hidden }) => hidden), false);
  await page.click('#play');
  await page.waitForFunction(() => globalThis.ninebit.page.live.moment.frame >= 8);
  context.diagnostic(`${(await page.evaluate(() => globalThis.ninebit.page.clock.rate)).toFixed(1)} pictures a second`);
  await page.click('#play');
  const { time, frame } = await page.evaluate(async () => {
    const { page: shown } = globalThis.ninebit;
    shown.live.moment = { time: 1.25, frame: 30 };
    await shown.live.draw();
    return shown.live.moment;
  });
  const state = await stateOf(page);
  await waitForHash(page, native(folderOf(state), 'draw', 'effect.json', '--profile', state.profile, '--time', String(time), '--frame', String(frame), '-o', 'a.png').hash.color);
  await page.click('#rewind');
  await waitForHash(page, expectedHashes().dot3_specular);
});

pageTest('pictures, effects and animations are saved', { effect: 'night_vision' }, async (page) => {
  const saved = (selector) => page.evaluate(async (where) => {
    const kept = URL.createObjectURL;
    const blob = new Promise((resolve) => {
      URL.createObjectURL = (content) => {
        resolve(content);
        return kept.call(URL, content);
      };
    });
    document.querySelector(where).click();
    const bytes = new Uint8Array(await (await blob).arrayBuffer());
    URL.createObjectURL = kept;
    return { size: bytes.length, head: [...bytes.slice(0, 8)], names: new TextDecoder('latin1').decode(bytes).match(/(effect\.json|programs\/\w+\.rc1|textures\/\w+\.png|acTL|fcTL)/g) };
  }, selector);
  await page.click('#tab-save');
  const picture = await saved('#save-png'), large = await saved('#save-large'), archive = await saved('#save-zip');
  assert.deepEqual(picture.head, [137, 80, 78, 71, 13, 10, 26, 10]);
  assert.ok(large.size > picture.size);
  assert.deepEqual(new Set(archive.names), new Set(['effect.json', 'programs/night_vision.rc1', 'textures/photograph.png', 'textures/detail.png']));
  await page.evaluate(() => { globalThis.ninebit.page.save.seconds = 1; });
  const animation = await saved('#save-animation');
  assert.equal(animation.names.filter((name) => name === 'fcTL').length, 30);
  await page.waitForFunction(() => document.getElementById('save-result').textContent === '30 frames were saved.');
});

pageTest('an archive has the profile and the room, and its files draw what the page shows', { effect: 'fog' }, async (page) => {
  await page.evaluate(() => globalThis.ninebit.store.change('profile', (state) => { state.profile = 'nv2a'; }));
  const files = await page.evaluate(async () => (await globalThis.ninebit.page.save.files()).map(([name, bytes]) => [name, new TextDecoder().decode(bytes)]));
  const texts = new Map(files);
  assert.equal(JSON.parse(texts.get('effect.json')).profile, 'nv2a');
  assert.equal(texts.get('index_room.gltf'), readFileSync(`${root}/scenes/index_room.gltf`, 'utf8'));
});

pageTest('while an effect plays, the usual picture is shown without marks', async (page) => {
  await openEffect(page, 'dot3_specular');
  await page.select('#mark-losses', 'truncated');
  await page.waitForFunction(() => !globalThis.ninebit.page.losses.layer.hidden);
  await page.click('#flip');
  await page.click('#play');
  await page.waitForFunction(() => globalThis.ninebit.page.live.moment.frame >= 3);
  assert.equal(await page.evaluate(() => globalThis.ninebit.page.flip.on), false);
  assert.equal(await page.evaluate(() => globalThis.ninebit.page.losses.layer.hidden), true);
  await page.click('#flip');
  assert.equal(await page.evaluate(() => globalThis.ninebit.page.clock.playing), false);
  await page.waitForFunction(() => !globalThis.ninebit.page.losses.layer.hidden);
});

pageTest('the editor completes an effect by its schema', { effect: 'sepia' }, async (page) => {
  await openTab(page, 'effect.json');
  await page.focus('.cm-content');
  await page.evaluate(() => {
    const { view } = globalThis.ninebit.page.program.editor;
    const at = view.state.doc.toString().indexOf('"name"');
    view.dispatch({ selection: { anchor: at } });
  });
  await page.keyboard.type('"polygon_m');
  await page.waitForFunction(() => document.querySelector('.cm-tooltip-autocomplete')?.textContent.includes('polygon_mode'));
  // What has just come into view is not taken yet.
  await pause(300);
  await page.keyboard.press('Enter');
  const text = await editorText(page);
  assert.ok(text.includes('"polygon_mode": "name"'), text.slice(0, 600));
});

// axe-core: the rules of WCAG 2.1, A and AA.
pageTest('axe finds no fault', { width: 1280, height: 720 }, async (page, context) => {
  const axe = readFileSync(`${root}/build/playground/npm/node_modules/axe-core/axe.min.js`, 'utf8');
  for (const scheme of ['light', 'dark']) {
    await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
    await choosePixel(page, 60, 70);
    for (const tab of ['inputs', 'sweep', 'profiles', 'shadow', 'save', 'trace']) {
      await page.evaluate((name) => document.getElementById(`tab-${name}`).click(), tab);
      await pause(300);
      // The page's policy forbids scripts from elsewhere, so this one is evaluated by the debugger.
      const faults = await page.evaluate(`${axe}; axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa'] })
        .then(({ violations }) => violations.map(({ id, impact, nodes }) => id + ' (' + impact + '): ' + nodes.map(({ target }) => target.join(' ')).slice(0, 3).join(', ')))`);
      context.diagnostic(`${scheme}, ${tab}: ${faults.length} faults`);
      assert.deepEqual(faults, [], `${scheme}, ${tab}`);
    }
  }
});

