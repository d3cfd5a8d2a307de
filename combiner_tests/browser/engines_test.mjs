/** The page from the disk in the other engines: Firefox and WebKitGTK. One that is missing is skipped with a sentence. */
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { setTimeout as pause } from 'node:timers/promises';
import { addressOf } from '../../src/playground/web/permalink.js';
import { newState } from '../../src/playground/web/state.js';
import { pngOf } from './png_files.mjs';
import { expectedHashes, firefox, nativeHash, pageFile } from './support.mjs';

const address = `file://${pageFile}`;
const found = (name) => {
  try {
    return execFileSync('which', [name], { stdio: ['ignore', 'pipe', 'ignore'] }).toString().trim();
  } catch {
    return null;
  }
};

/** A port that nothing listens to. */
const freePort = () => new Promise((resolve) => {
  const server = createServer().listen(0, '127.0.0.1', () => {
    const { port } = server.address();
    server.close(() => resolve(port));
  });
});

/** Asks until there is an answer. @template T @param {() => Promise<T>} ask @returns {Promise<T>} */
async function patiently(ask, seconds = 60) {
  const end = performance.now() + 1000 * seconds;
  for (;;) {
    const answer = await ask().catch((error) => (performance.now() > end ? Promise.reject(error) : undefined));
    if (answer) return answer;
    if (performance.now() > end) throw new Error(`no answer after ${seconds} s`);
    await pause(100);
  }
}

const program = '!!RC1.0\nout.rgb = tex0;\nout.a = tex0.a;\n';

/**
 * What both engines must do, each as a test of its own, so that there are counts for each engine.
 * @param {import('node:test').TestContext} context
 * @param {{run: (script: string) => Promise<any>, type: (text: string) => Promise<any>, go: (address: string) => Promise<any>}} engine
 *     `run` runs a function's body in the page, `type` types in place of the editor's text, `go` opens an address
 */
async function checkPage(context, { run, type, go }) {
  const ready = async () => {
    await patiently(() => run('return document.body?.dataset.ready && globalThis.ninebit && true'));
    await run('globalThis.ninebit.page.live.hash = true; return globalThis.ninebit.page.live.draw()');
  };
  const hash = () => run("return document.getElementById('picture').dataset.hash");
  const hasHash = (wanted) => patiently(async () => (await hash()) === wanted, 30).catch(async () => assert.equal(await hash(), wanted));
  const state = async () => JSON.parse(await run('return JSON.stringify(globalThis.ninebit.store.state)'));
  const open = (name) => run(`document.getElementById('picture').removeAttribute('data-hash'); document.querySelector('[data-effect="${name}"]').click()`);

  await context.test('it starts from the disk and says nothing', async () => {
    await ready();
    assert.equal(await run("return document.getElementById('message').textContent"), '');
    assert.equal(await hash(), expectedHashes().dot3_specular);
  });
  // Alpha below 255, a mesh with a normal map, two passes with a depth texture.
  for (const name of ['sprites', 'dot3_specular', 'index_cube', 'sepia']) {
    await context.test(`it draws ${name} to the bit`, async () => {
      await open(name);
      await hasHash(expectedHashes()[name]);
    });
  }
  await context.test('a pixel has its trace', async () => {
    await run('globalThis.ninebit.page.picture.take({ x: 40, y: 50 })');
    assert.match(await patiently(() => run("return globalThis.ninebit.page.trace.trace && document.getElementById('trace-place').textContent")), /^Pixel \(40, 50\)/);
    assert.ok(await run("return document.getElementById('trace').children.length > 0"));
  });
  await context.test('a sweep has the code of the trace', async () => {
    await run("globalThis.ninebit.page.showPanel('sweep')");
    await patiently(() => run("const input = document.getElementById('sweep-input'); if (!input) return false; input.value = 'tex0.r'; input.dispatchEvent(new Event('change', { bubbles: true })); return true"));
    await patiently(() => run("return document.getElementById('sweep-place').textContent.endsWith(' tex0.r:') && Number.isInteger(globalThis.ninebit.page.sweep.curves[0]?.at)"));
    const [code, out] = await run('const { sweep: { curves: [{ codes, at }] }, trace } = globalThis.ninebit.page; return [codes[at], trace.trace.out.codes[0]]');
    assert.equal(code, out);
  });
  await context.test('typed text is drawn', async () => {
    await type(program);
    await patiently(async () => (await state()).files['programs/sepia.rc1'] === program, 20).catch(async () => assert.equal((await state()).files['programs/sepia.rc1'], program));
    await hasHash(nativeHash(await state()));
  });
  await context.test('New can be undone', async () => {
    const old = await hash();
    await run("document.getElementById('new-program').click()");
    await hasHash(nativeHash(newState()));
    await run("document.getElementById('undo').click()");
    await hasHash(old);
  });
  await context.test('a later visit has the work', async () => {
    const old = await hash();
    await run('return globalThis.ninebit.page.keep().then(() => true)');
    await go(address);
    await ready();
    assert.equal((await state()).files['programs/sepia.rc1'], program);
    await hasHash(old);
  });
  await context.test('a link opens', async () => {
    const linked = newState();
    linked.files['program.rc1'] = program;
    await go(address + await addressOf(linked));
    await patiently(async () => (await state()).effect.title === 'Untitled');
    await hasHash(nativeHash(linked));
  });
  await context.test('a dropped PNG with alpha is read to the bit', async () => {
    const content = pngOf({ width: 32, height: 16 }, (x, y, c) => (x * 2477 + y * 7919 + c * 104729) >>> 0);
    await run(`const bytes = Uint8Array.from(atob('${content.toString('base64')}'), (character) => character.charCodeAt(0)), dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([bytes], 'alpha.png', { type: 'image/png' }));
      document.getElementById('picture').dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer }))`);
    const name = 'dropped/alpha.png';
    await patiently(async () => JSON.stringify((await state()).effect.textures).includes(name), 20);
    await hasHash(nativeHash(await state(), { [name]: content }));
  });
  await context.test('the embedded page shows an effect', async () => {
    await go(`${address}?embed&effect=emboss`);
    await ready();
    assert.equal(await hash(), expectedHashes().emboss);
    assert.equal(await run("return getComputedStyle(document.querySelector('header')).display"), 'none');
  });
}

test('Firefox', async (context) => {
  const executablePath = found(process.env.FIREFOX ?? 'firefox-esr') ?? found('firefox');
  if (!executablePath) return context.skip('there is no Firefox (Debian: firefox-esr)');
  const browser = await firefox(executablePath);
  try {
    const page = await browser.newPage();
    await page.goto(address);
    await checkPage(context, {
      run: (script) => page.evaluate(`(() => { ${script} })()`),
      go: (where) => page.goto(where),
      type: async (text) => {
        await page.focus('.cm-content');
        await page.keyboard.down('Control');
        await page.keyboard.press('a');
        await page.keyboard.up('Control');
        await page.keyboard.type(text);
      },
    });
  } finally {
    await browser.close();
  }
  return undefined;
});

/** A page in WebKitGTK's MiniBrowser, by WebDriver. @param {string} driver @param {string} browser */
async function openWebkit(driver, browser, env) {
  const port = await freePort();
  const process = spawn(driver, [`--port=${port}`, '--host=127.0.0.1'], { env, stdio: 'ignore' });
  const ask = async (method, path, body) => {
    const answer = await fetch(`http://127.0.0.1:${port}${path}`, { method, body: body && JSON.stringify(body) });
    const { value } = await answer.json();
    if (!answer.ok) throw new Error(value.message);
    return value;
  };
  await patiently(() => ask('GET', '/status'), 10);
  const capabilities = { alwaysMatch: { 'webkitgtk:browserOptions': { binary: browser, args: ['--automation'] } } };
  const { sessionId } = await ask('POST', '/session', { capabilities });
  const session = `/session/${sessionId}`;
  await ask('POST', `${session}/url`, { url: address });
  return {
    run: (script) => ask('POST', `${session}/execute/sync`, { script, args: [] }),
    go: (where) => ask('POST', `${session}/url`, { url: where }),
    type: async (text) => {
      const element = Object.values(await ask('POST', `${session}/element`, { using: 'css selector', value: '.cm-content' }))[0];
      await ask('POST', `${session}/element/${element}/click`, {});
      const control = '\uE009', enter = '\uE007';
      const press = (key) => ['keyDown', 'keyUp'].map((event) => ({ type: event, value: key === '\n' ? enter : key }));
      const all = [{ type: 'keyDown', value: control }, ...press('a'), { type: 'keyUp', value: control }];
      await ask('POST', `${session}/actions`, { actions: [{ type: 'key', id: 'keyboard', actions: [...all, ...[...text].flatMap(press)] }] });
    },
    close: () => ask('DELETE', session).catch(() => {}).finally(() => process.kill()),
  };
}

/** A screen without a screen. */
async function openScreen() {
  const display = `:${90 + globalThis.process.pid % 400}`;
  const screen = spawn('Xvfb', [display, '-screen', '0', '1280x1024x24', '-nolisten', 'tcp'], { stdio: 'ignore' });
  await patiently(async () => existsSync(`/tmp/.X11-unix/X${display.slice(1)}`), 10);
  return { display, close: () => screen.kill() };
}

test('WebKitGTK', async (context) => {
  const driver = found('WebKitWebDriver');
  const browser = readdirSync('/usr/lib').flatMap((name) => ['4.0', '4.1'].map((version) => `/usr/lib/${name}/webkit2gtk-${version}/MiniBrowser`)).find(existsSync);
  if (!driver || !browser) return context.skip('there is no WebKitGTK with its driver (Debian: webkit2gtk-driver)');
  if (!process.env.DISPLAY && !found('Xvfb')) return context.skip('WebKitGTK needs a screen (Debian: xvfb)');
  const screen = process.env.DISPLAY ? null : await openScreen();
  const home = mkdtempSync(join(tmpdir(), 'ninebit-webkit-'));
  const env = { ...process.env, HOME: home, XDG_RUNTIME_DIR: home, LIBGL_ALWAYS_SOFTWARE: '1', ...(screen && { DISPLAY: screen.display }) };
  let page;
  try {
    page = await openWebkit(driver, browser, env);
    await checkPage(context, page);
  } finally {
    await page?.close();
    screen?.close();
    rmSync(home, { recursive: true, force: true });
  }
  return undefined;
});
