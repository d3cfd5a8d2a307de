// The installed package in Node and in Chromium, beside the native program.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { test } from 'node:test';

import { load, NinebitError } from 'ninebit';
import { answers, EFFECT, picture, PROGRAM } from './answers.mjs';

function native(...words) {
  const done = spawnSync(process.env.NINEBIT_PROGRAM, words, { encoding: 'utf8' });
  assert.equal(done.status, 0, done.stderr);
  return done.stdout;
}

/** What `ninebit eval` gives for rows of codes. */
function evaluated(columns, rows, ...flags) {
  writeFileSync('rows.csv', [columns, ...rows].map((row) => row.join(',')).join('\n') + '\n');
  const lines = native('eval', 'program.rc1', '--inputs', 'rows.csv', ...flags).trim().split('\n');
  const at = ['r', 'g', 'b', 'a'].map((c) => lines[0].split(',').indexOf(`out.${c}`));
  return lines.slice(1).flatMap((line) => at.map((i) => Number(line.split(',')[i])));
}

const four = (name) => ['r', 'g', 'b', 'a'].map((c) => `${name}.${c}`);
const texels = (bytes) => Array.from({ length: bytes.length / 4 }, (_, i) => [...bytes.slice(4 * i, 4 * i + 4)]);

test('Node gives what the native program gives', async () => {
  writeFileSync('program.rc1', PROGRAM);
  const found = answers(await load());
  const tex0 = texels(picture(64, 1)), primary = texels(picture(64, 2));
  assert.deepEqual(found.evaluated, evaluated([...four('tex0'), ...four('primary')], tex0.map((t, i) => [...t, ...primary[i]])));
  assert.deepEqual(found.other, evaluated([...four('tex0'), ...four('primary')], tex0.map((t) => [...t, 9, 99, 200, 255]), '--profile', 'nv2a'));
  assert.equal(found.converted, native('convert', 'program.rc1', '--to', 'gl'));
  assert.equal(found.form, 'rc10');
  writeFileSync('effect.json', JSON.stringify({ ...EFFECT, passes: [{ ...EFFECT.passes[0], program: 'program.rc1' }] }));
  const traced = JSON.parse(native('trace', '--effect', 'effect.json', '--pixel', '0,0', '--json'));
  assert.deepEqual(found.pixel.stages, traced.stages);
  assert.deepEqual(found.size, [32, 16]);
  assert.equal(found.drawn.length, 4 * 32 * 16);
  const drawing = (await load()).ask({ do: 'draw', effect: EFFECT, files: { 'mine.rc1': PROGRAM }, hash: true }).answer;
  assert.equal(drawing.hash.color, JSON.parse(native('draw', 'effect.json', '--json', '-o', 'effect.png')).hash.color);
});

test('refusals have their place', async () => {
  const found = answers(await load());
  assert.equal(found.refusal[0], 'NinebitError');
  assert.equal(found.refusal[1], 2);
  const ninebit = await load();
  assert.throws(() => ninebit.evaluate(PROGRAM, { tex0: picture(4, 1), tex1: picture(5, 1) }), NinebitError);
  assert.throws(() => ninebit.draw({ ninebit: 'effect' }), NinebitError);
});

test('Chromium gives what Node gives', async (context) => {
  const chromium = process.env.CHROMIUM ?? 'chromium';
  if (spawnSync(chromium, ['--version']).status !== 0) return context.skip('there is no Chromium');
  const page = '<!doctype html><script type="importmap">{"imports": {"ninebit": "/node_modules/ninebit/browser.mjs"}}</script>' +
      '<body><script type="module" src="/browser_page.mjs"></script>';
  let found;
  const answered = new Promise((done) => { found = done; });
  const server = createServer((request, response) => {
    const name = new URL(request.url, 'http://x').pathname;
    if (name === '/') return response.setHeader('content-type', 'text/html').end(page);
    if (name === '/answers') {
      let text = '';
      request.on('data', (piece) => { text += piece; }).on('end', () => found(JSON.parse(text)));
      return response.end();
    }
    try {
      const content = readFileSync(`.${name}`);
      response.setHeader('content-type', 'text/javascript').end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  const child = spawn(chromium, ['--headless', '--no-sandbox', '--disable-gpu', '--user-data-dir=profile',
    `http://127.0.0.1:${server.address().port}/`], { stdio: 'ignore' });
  const limit = setTimeout(() => found('no answer within a minute'), 60000);
  const inPage = await answered;
  clearTimeout(limit);
  const ended = new Promise((done) => child.on('close', done));
  child.kill();
  await ended;
  server.close();
  assert.deepEqual(inPage, JSON.parse(JSON.stringify(answers(await load()))));
});
