/** Index shadows: the pixels and the wrong pixels that the native program counts, while the picture does not wait. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { folderOf, native, onePage, root } from './support.mjs';

const page = await onePage();

/** What `ninebit render --ground-truth` finds in the room at the page's size. */
const rendered = (...flags) => native(root, 'render', 'scenes/index_room.gltf', '-o', folderOf({ files: {}, effect: {} }), '--size', '480x360',
  '--ground-truth', '--profile', 'geforce2', ...flags);

/** Changes what is asked for, as the sliders do. */
const ask = (change) => page.evaluate((changed) => globalThis.ninebit.page.shadow.ask(changed), change);

/** Waits for the count of the picture that is shown; the page does not name the worst pixels. */
async function counted({ worst, ...expected }) {
  assert.ok(worst.length > 0);
  await page.waitForFunction((errors) => document.getElementById('wrong-result').dataset.wrong === errors, { timeout: 30_000 }, JSON.stringify(expected))
    .catch(async () => assert.deepEqual(await page.$eval('#wrong-result', ({ dataset, textContent }) => dataset.wrong ?? textContent), JSON.stringify(expected)));
}

const marked = () => page.evaluate(() => {
  const { overlay } = globalThis.ninebit.page.shadow.wrong;
  const copy = new OffscreenCanvas(overlay.width, overlay.height).getContext('2d', { willReadFrequently: true });
  copy.drawImage(overlay, 0, 0);
  const { data } = copy.getImageData(0, 0, overlay.width, overlay.height);
  return { hidden: overlay.hidden, pixels: data.filter((value, at) => at % 4 === 3 && value > 0).length };
});

test('index shadows have the pixels of `ninebit render`', async () => {
  await page.evaluate(() => globalThis.ninebit.store.change('profile', (state) => { state.profile = 'geforce2'; }));
  await page.click('#tab-shadow');
  await ask({ order: 'file' });
  const { pixels, errors } = rendered();
  const text = `${pixels.shadowed.toLocaleString('en')} pixels in shadow, ${pixels.lit.toLocaleString('en')} lit`;
  await page.waitForFunction((expected) => document.getElementById('shadow-result').textContent.startsWith(expected), {}, text);
  assert.ok(errors.false_shadowed > 1000);
  await counted(errors);
});

test('wrong pixels by rays are those of Embree, with their causes', async () => {
  await ask({ step: 1, map_size: 128 });
  const { errors } = rendered('--index-step', '1', '--map-size', '128');
  assert.ok(errors.by_cause.truncation > 0);
  await counted(errors);
  await ask({ step: 2, map_size: 256, camera: { position: [3, 4, 5], target: [0, 1, 0], fov: 50 } });
  await counted(rendered('--map-size', '256', '--camera', '3,4,5', '--look-at', '0,1,0', '--fov', '50').errors);
});

test('each wrong pixel is marked, and a heat map covers more', async () => {
  const { false_lit: lit, false_shadowed: shadowed } = await page.$eval('#wrong-result', ({ dataset }) => JSON.parse(dataset.wrong));
  assert.equal((await marked()).hidden, true);
  await page.select('#mark-wrong', 'points');
  assert.deepEqual(await marked(), { hidden: false, pixels: lit + shadowed });
  const above = await page.evaluate(() => {
    const { overlay } = globalThis.ninebit.page.shadow.wrong;
    overlay.scrollIntoView({ block: 'center' });
    const { left, top, width, height } = overlay.getBoundingClientRect();
    return document.elementFromPoint(left + width / 2, top + height / 2) === overlay;
  });
  assert.ok(above, 'the marks are over the picture');
  await page.select('#mark-wrong', 'heat');
  const heat = await marked();
  assert.equal(heat.hidden, false);
  assert.ok(heat.pixels > lit + shadowed);
  await page.select('#mark-wrong', '');
});

test('pictures do not wait for a judgement, and the last one is judged', async () => {
  const asked = await page.evaluate(async () => {
    const { shadow } = globalThis.ninebit.page;
    let pictures = 0;
    for (let map = 64; map <= 512; map *= 2) {
      Object.assign(shadow.asked, { map_size: map });
      await shadow.draw();
      pictures += 1;
      if (document.getElementById('wrong-result').dataset.wrong) return `judged before ${map} was shown`;
    }
    return pictures;
  });
  assert.equal(asked, 4);
  await counted(rendered('--camera', '3,4,5', '--look-at', '0,1,0', '--fov', '50').errors);
});

test('counting can be switched off and on', async () => {
  await page.click('#count-wrong');
  await ask({ step: 3 });
  await page.waitForFunction(() => globalThis.ninebit.page.shadow.drawn.step === 3 && !globalThis.ninebit.page.shadow.judge.running);
  assert.equal(await page.$eval('#wrong-result', ({ textContent }) => textContent), '');
  await page.click('#count-wrong');
  await counted(rendered('--index-step', '3', '--camera', '3,4,5', '--look-at', '0,1,0', '--fov', '50').errors);
});

test('a dropped mesh is judged as well', async () => {
  await page.evaluate(async () => {
    const text = 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n';
    const { page: shown } = globalThis.ninebit;
    const scene = await shown.shelf.take(new File([text], 'my.off'));
    shown.shadow.view = null;
    delete shown.shadow.asked.camera;
    shown.shadow.ask({ scene });
  });
  await page.waitForFunction(() => document.getElementById('shadow-result').textContent.includes(' 6 triangles') &&
    document.getElementById('wrong-result').dataset.wrong);
});

test('nothing complained', () => assert.deepEqual(page.complaints, []));
