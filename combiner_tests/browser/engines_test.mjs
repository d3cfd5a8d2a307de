/** The page from the disk in the other engines: Firefox and WebKitGTK. One that is missing is skipped with a sentence. */
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { setTimeout as pause } from 'node:timers/promises';
import { expectedHashes, firefox, pageFile } from './support.mjs';

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

/** What both engines must do. @param {(script: string) => Promise<any>} run runs a function's body in the page */
async function checkPage(run) {
  await patiently(() => run('return document.body?.dataset.ready'));
  assert.equal(await run("return document.getElementById('message').textContent"), '');
  const hash = () => run("return document.getElementById('picture').dataset.hash");
  await run('globalThis.ninebit.page.live.hash = true; return globalThis.ninebit.page.live.draw()');
  assert.equal(await hash(), expectedHashes().dot3_specular);
  // Alpha below 255, a mesh with a normal map, two passes with a depth texture.
  for (const name of ['sepia', 'sprites', 'dot3_specular', 'index_cube']) {
    await run(`document.getElementById('picture').removeAttribute('data-hash'); document.querySelector('[data-effect="${name}"]').click()`);
    assert.equal(await patiently(hash), expectedHashes()[name], name);
  }
  await run('globalThis.ninebit.page.picture.take({ x: 250, y: 250 })');
  assert.match(await patiently(() => run("return globalThis.ninebit.page.trace.trace && document.getElementById('trace-place').textContent")), /^Pixel \(250, 250\)/);
  assert.ok(await run("return document.getElementById('trace').children.length > 0"));
}

test('Firefox', async (context) => {
  const executablePath = found(process.env.FIREFOX ?? 'firefox-esr') ?? found('firefox');
  if (!executablePath) return context.skip('there is no Firefox (Debian: firefox-esr)');
  const browser = await firefox(executablePath);
  try {
    const page = await browser.newPage();
    await page.goto(address);
    await checkPage((script) => page.evaluate(`(() => { ${script} })()`));
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
    await checkPage(page.run);
  } finally {
    await page?.close();
    screen?.close();
    rmSync(home, { recursive: true, force: true });
  }
  return undefined;
});
