// The npm package as its users have it: installed into an empty folder, which GOODBOT_INSTALLED names.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

const folder = String(process.env.GOODBOT_INSTALLED);
const installed = join(folder, 'node_modules/goodbot');

// The example of its README, as a file beside the installed package.
const example = join(folder, 'example.mjs');
const [, code] = readFileSync(join(installed, 'README.md'), 'utf8').split(/```js\n|```\n/);
writeFileSync(example, code);

/** @param {string} file */
function runs(file) {
  const run = spawnSync(process.execPath, [file], { encoding: 'utf8' });
  assert.equal(run.status, 0, run.stderr);
  assert.equal(run.stdout.match(/^(north|south|east|west|noop)$/gm)?.length, 12);
  assert.match(run.stdout, /tasks/);
}

test('the example of its README runs', () => runs(example));

test('a bundler makes one file of the example, which runs where the package is not', async () => {
  const { build } = await import('../../page/node_modules/esbuild/lib/main.js');
  const elsewhere = mkdtempSync(join(tmpdir(), 'goodbot-bundled-'));
  try {
    for (const [platform, format] of [['node', 'esm'], ['browser', 'iife']]) {
      const outfile = join(elsewhere, `${platform}.${format === 'esm' ? 'mjs' : 'cjs'}`);
      const { warnings } = await build({ entryPoints: [example], bundle: true, minify: true, platform, format, outfile, logLevel: 'silent' });
      assert.deepEqual(warnings, []);
      runs(outfile);
    }
  } finally {
    rmSync(elsewhere, { recursive: true });
  }
});

test('what is learned comes back, and a wrong file is refused with a reason', async () => {
  const { Goodbot } = await import(join(installed, 'index.js'));
  const taught = new Goodbot(1);
  taught.setEnvironment(JSON.stringify(JSON.parse(Goodbot.course(0)).homes[0][1]));
  taught.hear('go to the red room');
  taught.finish();
  while (!taught.learn(1000));
  const other = new Goodbot(1);
  other.restore(taught.save());
  while (!other.learn(1000));
  assert.equal(other.sessions(), 1);
  assert.deepEqual(other.save(), taught.save());
  assert.throws(() => other.restore(new Uint8Array(9)), /model/);
});

test('its command shows the page to this machine', async () => {
  const server = spawn(process.execPath, [join(installed, 'bin/goodbot.mjs'), '--no-open'], { stdio: ['ignore', 'pipe', 'inherit'] });
  try {
    const [said] = await server.stdout.setEncoding('utf8').take(1).toArray();
    const address = String(said.match(/http:\S+/));
    const page = await fetch(address);
    assert.match(await page.text(), /<title>/);
    assert.equal((await fetch(`${address}other`)).status, 404);
  } finally {
    server.kill();
  }
});

test('its command says how it is used', () => {
  const run = given => spawnSync(process.execPath, [join(installed, 'bin/goodbot.mjs'), ...given], { encoding: 'utf8' });
  for (const wrong of [['--colour'], ['--port', 'home'], ['--port', '99999'], ['--port', '1.5']]) {
    const { status, stderr } = run(wrong);
    assert.equal(status, 2);
    assert.match(stderr, /usage: goodbot/);
  }
  const { status, stdout } = run(['--help']);
  assert.equal(status, 0);
  assert.match(stdout, /^usage: goodbot/);
});
