// To the micro:bit: the page writes what `goodbot microbit` writes. GOODBOT_CLI names that program.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, launch, learned, model, open, opened, play, saved } from './browser.mjs';

const program = process.env.GOODBOT_CLI;
const skip = program ? false : 'GOODBOT_CLI is not set: the command line is not there to compare with';
let browser;
let folder;
before(async () => {
  browser = await launch();
  folder = mkdtempSync(join(tmpdir(), 'goodbot-microbit-'));
});
after(async () => {
  rmSync(folder, { recursive: true });
  await browser.close();
});

function file(name, content) {
  const path = join(folder, name);
  writeFileSync(path, content);
  return path;
}

function record(at, kind, data) {
  const bytes = [data.length, at >> 8 & 255, at & 255, kind, ...data];
  return ':' + Buffer.from([...bytes, -bytes.reduce((sum, byte) => sum + byte) & 255]).toString('hex') + '\r\n';
}

// A program with goodbot's mark and 70,000 bytes, in a form that goodbot does not write: in small letters, in lines of 32 bytes that
// cross the border of 64 KiB, the second half before the first.
function foreign() {
  const bytes = Buffer.concat([Buffer.from('....goodbot on the micro:bit; say help'), Buffer.from(Array.from({ length: 70000 }, (_, at) => at * 7 & 255))]);
  const lines = [];
  for (let at = 0; at < bytes.length; at += 32) lines.push([at, bytes.subarray(at, at + 32)]);
  return [1, 0].map(upper => record(0, 4, [0, upper]) + lines.filter(([at]) => at >> 16 === upper).map(([at, data]) => record(at & 0xffff, 0, data)).join('')).join('') + record(0, 1, []);
}

async function exported(page, hex) {
  await opened(page, 'Settings, keeping, sharing');
  const [download] = await Promise.all([page.waitForEvent('download'), page.setInputFiles('#to-microbit', { name: 'goodbot.hex', mimeType: '', buffer: Buffer.from(hex) })]);
  assert.equal(download.suggestedFilename(), 'Robot-1.hex');
  return readFileSync(await download.path(), 'utf8');
}

// The files have half a megabyte: a difference is not printed.
const same = (one, other) => assert.ok(one === other, 'the page and the command line write the same');

async function teach(page) {
  await page.selectOption('#speed', 'once');
  for (const lesson of [1, 2]) {
    await page.click('#auto');
    await learned(page, lesson);
  }
}

// The command line's file for the page's robot, a home and the commands that the robot was taught.
async function byCommand(page, hex, home) {
  await opened(page, 'Settings, keeping, sharing');
  const trained = file('robot.goodbot', await saved(page, '#save-model'));
  const log = (await saved(page, '#save-log')).toString().trim().split('\n').map(line => JSON.parse(line));
  const commands = [...new Set(log.map(each => each.command).filter(Boolean))];
  assert.equal(commands.length, 2);
  const at = home ? ['--home', file('home.json', home)] : [];
  const out = join(folder, 'out.hex');
  execFileSync(program, ['microbit', '--hex', file('in.hex', hex), '--model', trained, ...at, ...commands.flatMap(command => ['--command', command]), '--out', out, '--force'], { stdio: 'ignore' });
  return readFileSync(out, 'utf8');
}

test('a robot that was taught in the page goes onto a micro:bit as by the command line, with its home', { skip }, async () => {
  const page = await open(browser);
  await teach(page);
  await page.evaluate(() => window.goodbot.setEnvironment(JSON.stringify({ version: 1, objects: [
    { class: 'room', name: 'room0', left: 0, bottom: 0, right: 4, top: 4, color: 'red' }, { class: 'room', name: 'room1', left: 4, bottom: 0, right: 8, top: 4, color: 'green' },
    { class: 'door', name: 'door0', left: 4, bottom: 2, right: 4, top: 2 }, { class: 'block', name: 'block0', x: 2, y: 2, color: 'blue', shape: 'chair' }, { class: 'agent', name: 'agent0', x: 1, y: 1 },
  ] })));
  const home = await page.evaluate(() => window.goodbot.environment());
  const hex = foreign();
  const mine = await exported(page, hex);
  same(mine, await byCommand(page, hex, home));
  assert.match(await page.textContent('#live'), /drag the file onto the drive MICROBIT\.$/);
  same(await exported(page, mine), mine);
  await close(page);
});

test('a home that has no room on a micro:bit stays here, and the page says so', { skip }, async () => {
  const page = await open(browser);
  await teach(page);
  await page.evaluate(() => window.goodbot.setEnvironment(JSON.stringify({ version: 1, objects: [
    { class: 'room', name: 'room0', left: 0, bottom: 0, right: 12, top: 12, color: 'red' }, { class: 'agent', name: 'agent0', x: 1, y: 1 },
  ] })));
  const hex = foreign();
  same(await exported(page, hex), await byCommand(page, hex, null));
  assert.match(await page.textContent('#live'), /This home has no room there/);
  await close(page);
});

test('the program itself is taken', { skip: existsSync(new URL('../../dist/goodbot.hex', import.meta.url)) ? skip : 'dist/goodbot.hex is not there: cargo xtask microbit' }, async () => {
  const page = await open(browser);
  await teach(page);
  await play(page, 'Test');
  const hex = readFileSync(new URL('../../dist/goodbot.hex', import.meta.url), 'utf8');
  same(await exported(page, hex), await byCommand(page, hex, await page.evaluate(() => window.goodbot.environment())));
  await close(page);
});

const REFUSED = {
  en: /This is not goodbot\.hex/, de: /Das ist nicht goodbot\.hex/, fr: /Ce n’est pas goodbot\.hex/, es: /Este no es goodbot\.hex/, zh: /这不是 goodbot\.hex/,
};

test('what is no such program is refused in every language', async () => {
  const page = await open(browser);
  const whole = foreign();
  const rubbish = ['', 'rubbish', '{}', whole.slice(0, whole.length / 2), whole.slice(0, -13), whole.replace('7', '8'), whole + ':', record(0, 0, [1, 2]) + record(0, 1, []), record(0, 4, [0, 4]) + record(0, 0, [1]) + record(0, 1, [])];
  const known = await model(page);
  await opened(page, 'Settings, keeping, sharing');
  for (const [language, said] of Object.entries(REFUSED)) {
    await page.selectOption('#language', language);
    for (const text of language === 'en' ? rubbish : rubbish.slice(1, 2)) {
      await page.evaluate(() => { document.getElementById('live').textContent = ''; });
      await page.setInputFiles('#to-microbit', { name: 'goodbot.hex', mimeType: '', buffer: Buffer.from(text) });
      await page.waitForFunction(() => document.getElementById('live').textContent);
      assert.match(await page.textContent('#live'), said, text.slice(0, 30));
    }
  }
  assert.deepEqual(await model(page), known);
  await close(page);
});

test('a robot that knows more than a micro:bit holds is refused, and why', async () => {
  const page = await open(browser);
  // It waits after each step: nothing moves under the pointer.
  await page.selectOption('#speed', 'step');
  await play(page, 'Test');
  for (let lesson = 1; lesson <= 8; lesson += 1) {
    await page.click('#reset');
    await page.fill('#command', 'go to the ' + 'red green blue yellow orange pink teal grey'.split(' ')[lesson - 1] + ' place ' + 'one two three four five six seven eight'.split(' ')[lesson - 1]);
    await page.click('#say-it');
    await page.waitForFunction(() => !document.getElementById('good').disabled);
    await page.click('#good');
    await page.click('#finish');
    await learned(page, lesson);
  }
  await opened(page, 'Settings, keeping, sharing');
  await page.setInputFiles('#to-microbit', { name: 'goodbot.hex', mimeType: '', buffer: Buffer.from(foreign()) });
  await page.waitForFunction(() => /no room on a micro:bit/.test(document.getElementById('live').textContent));
  await close(page);
});

test('a file can be dropped onto its button', async () => {
  const page = await open(browser);
  await opened(page, 'Settings, keeping, sharing');
  const [download] = await Promise.all([page.waitForEvent('download'), page.evaluate(text => {
    const files = new DataTransfer();
    files.items.add(new File([text], 'goodbot.hex'));
    document.querySelector('label:has(#to-microbit)').dispatchEvent(new DragEvent('drop', { dataTransfer: files, bubbles: true, cancelable: true }));
  }, foreign())]);
  assert.match(readFileSync(await download.path(), 'utf8'), /^:020000040000FA\n/);
  await close(page);
});
