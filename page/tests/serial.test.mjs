// A micro:bit at the USB cable: a simulated port, behind which a few lines answer as the firmware does, or the firmware itself in an emulator.
// GOODBOT_QEMU names that one; `dist/goodbot.hex` is the firmware.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { setTimeout as wait } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { close, launch, learned, openIn, opened, play, saved, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// The port. `window.board` is the test's end of it: what was asked, how to answer, and how to unplug it.
function simulated() {
  let toPage;
  const board = {
    asked: [], chosen: null, baudRate: 0, answer: () => ['ok'],
    // Text comes in pieces of any length.
    says(text) { for (const part of text.match(/[^]{1,5}/g)) toPage.enqueue(new TextEncoder().encode(part)); },
    takes(request) {
      board.asked.push(request);
      const lines = board.answer(request);
      if (lines.length) board.says(lines.map(line => line + '\r\n').join(''));
    },
    unplug() { toPage.error(new DOMException('The device has been lost.', 'NetworkError')); },
  };
  const port = {
    async open({ baudRate }) {
      if (port.readable) throw new DOMException('The port is already open.', 'InvalidStateError');
      board.baudRate = baudRate;
      port.readable = new ReadableStream({ start(controller) { toPage = controller; } });
      port.writable = new WritableStream({ write(bytes) { board.takes(new TextDecoder().decode(bytes).trimEnd()); } });
    },
    async close() {
      if (port.writable.locked) throw new TypeError('The port is still written to.');
      port.readable = port.writable = null;
    },
  };
  Object.defineProperty(navigator, 'serial', { value: { async requestPort({ filters }) {
    board.chosen = filters;
    if (board.none) throw new DOMException('No port selected by the user.', 'NotFoundError');
    return port;
  } } });
  window.board = board;
}

const SETTINGS = 'Settings, keeping, sharing';
const openWith = async prepare => openIn(await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, reducedMotion: 'reduce' }), '', prepare);
const told = (page, wanted) => page.waitForFunction(text => document.getElementById('toast').textContent.includes(text), wanted);
const asked = page => page.evaluate(() => window.board.asked);

async function connected() {
  const page = await openWith(simulated);
  await play(page, 'Test');
  await page.selectOption('#speed', 'step');
  await page.click('#serial');
  await told(page, 'Connected.');
  return page;
}

async function command(page, words) {
  await page.fill('#command', words);
  await page.click('#say-it');
  await acted(page, 1);
  // Otherwise the robot goes on by itself soon after a word.
  await page.click('#pause');
}

// Waits until the robot has taken this many steps.
const acted = (page, count) => page.waitForFunction(wanted => document.querySelectorAll('#steps tr').length === wanted - 1 && document.body.dataset.phase !== 'planning' && document.getElementById('good').getAttribute('aria-disabled') === 'false', count);

async function step(page, word, count) {
  await page.click('#' + word);
  await page.click('#next');
  await acted(page, count);
}

// A session of a log as the requests that do the same on the board.
function requestsOf([{ environment, command: words }, ...steps]) {
  const word = { reward: ['good'], punish: ['bad'], neutral: [] };
  return ['pace 0', 'begin', ...environment.objects.map(object => Object.values(object).join(' ')), 'build', 'say ' + words, ...steps.filter(({ type }) => type === 'step').flatMap(({ action, feedback }) => ['act ' + action, ...word[feedback]]), 'finish'];
}

async function loggedRequests(page) {
  await opened(page, SETTINGS);
  return requestsOf((await saved(page, '#save-log')).toString().trim().split('\n').map(line => JSON.parse(line)));
}

test('where the browser has no serial ports, the page says so, and that the file works everywhere', async () => {
  const page = await openWith(() => Object.defineProperty(navigator, 'serial', { value: undefined }));
  await opened(page, SETTINGS);
  assert.ok(await page.isVisible('label:has(#to-microbit)'));
  assert.ok(await page.isHidden('#serial'));
  assert.match(await page.innerText('#serial-none'), /file works everywhere/);
  await close(page);
});

test('a micro:bit does a lesson with the same steps and the same words', async () => {
  const page = await connected();
  assert.deepEqual(await page.evaluate(() => [window.board.chosen, window.board.baudRate]), [[{ usbVendorId: 0x0d28 }], 115200]);
  assert.ok(await page.isHidden('#serial-none'));
  await command(page, 'go to the red room');
  await step(page, 'good', 2);
  await step(page, 'bad', 3);
  await page.click('#good');
  await page.click('#finish');
  await learned(page, 1);
  assert.deepEqual(await asked(page), ['help', ...await loggedRequests(page)]);
  await close(page);
});

test('the last word counts on the micro:bit too, and after a step taken back it does the session anew', async () => {
  const page = await connected();
  await command(page, 'go to the red room');
  await page.click('#good');
  await page.click('#bad');
  await page.click('#next');
  await acted(page, 2);
  const before = await asked(page);
  assert.deepEqual(before.slice(-4).map(request => request.split(' ')[0]), ['act', 'good', 'bad', 'act']);
  assert.equal(before.filter(request => request === 'begin').length, 1);
  await page.fill('#command', 'undo');
  await page.click('#say-it');
  await page.waitForFunction(() => window.board.asked.filter(request => request === 'begin').length === 2);
  await close(page);
});

test('what the micro:bit cannot do is told, and the lesson goes on without it', async () => {
  const page = await connected();
  await page.evaluate(() => { window.board.answer = request => [request === 'build' ? 'error: there are too many cells and blocks' : 'ok']; });
  await command(page, 'go to the red room');
  await told(page, 'micro:bit: there are too many cells and blocks');
  const before = await asked(page);
  assert.equal(before.at(-1), 'build');
  await step(page, 'good', 2);
  await page.click('#finish');
  await learned(page, 1);
  assert.deepEqual(await asked(page), before);
  // The next lesson is tried again.
  await page.evaluate(() => { window.board.answer = () => ['ok']; });
  await page.click('#reset');
  await command(page, 'go to the blue room');
  await page.waitForFunction(() => window.board.asked.includes('say go to the blue room'));
  await close(page);
});

test('a home that has no room on the micro:bit is told', async () => {
  const page = await connected();
  await page.evaluate(() => window.goodbot.setEnvironment(JSON.stringify({ version: 1, objects: [
    { class: 'room', name: 'room0', left: 0, bottom: 0, right: 12, top: 12, color: 'red' }, { class: 'room', name: 'room1', left: 12, bottom: 0, right: 16, top: 4, color: 'blue' },
    { class: 'door', name: 'door0', left: 12, bottom: 2, right: 12, top: 2 }, { class: 'agent', name: 'agent0', x: 1, y: 1 },
  ] })));
  await page.fill('#command', 'go to the blue room');
  await page.click('#say-it');
  await told(page, 'This home has no room there');
  assert.deepEqual(await asked(page), ['help']);
  await close(page);
});

test('an unplugged micro:bit is noticed, the page goes on, and it can be connected again', async () => {
  const page = await connected();
  await command(page, 'go to the red room');
  await page.evaluate(() => window.board.unplug());
  await told(page, 'The micro:bit is unplugged');
  await step(page, 'good', 2);
  await page.click('#finish');
  await learned(page, 1);
  await opened(page, SETTINGS);
  assert.ok(await page.isHidden('#serial-fetch'));
  await page.click('#serial');
  await told(page, 'Connected.');
  await close(page);
});

test('a board without a robot is told, and so is one that stays silent; whoever chooses none hears nothing', async () => {
  const page = await openWith(simulated);
  await page.evaluate(() => { window.board.none = true; });
  await page.click('#serial');
  await page.evaluate(() => { Object.assign(window.board, { none: false, answer: () => [] }); });
  assert.equal(await page.textContent('#toast'), '');
  await page.click('#serial');
  await told(page, 'No robot answers there.');
  await page.evaluate(() => { document.getElementById('toast').textContent = ''; window.board.answer = () => ['error: unknown']; });
  await page.click('#serial');
  await told(page, 'No robot answers there.');
  await page.evaluate(() => { window.board.answer = () => ['ok']; });
  await page.click('#serial');
  await told(page, 'Connected.');
  await close(page);
});

const digits = bytes => bytes.map(byte => byte.toString(16).padStart(2, '0')).join('').match(/.{1,64}/g);

test('the lessons of a class’s robots come together in one, each once', async () => {
  const models = [];
  for (const words of ['go to the red room', 'walk into the green room']) {
    const page = await openWith(null);
    await play(page, 'Test');
    await page.selectOption('#speed', 'step');
    await command(page, words);
    await page.click('#good');
    await page.click('#finish');
    await learned(page, 1);
    models.push(digits(await page.evaluate(() => Array.from(window.goodbot.forMicrobit()))));
    await close(page);
  }
  const page = await connected();
  const fetched = async (model, news, count) => {
    await page.evaluate(lines => { window.board.answer = request => (request === 'model' ? [...lines, 'ok'] : ['ok']); }, model);
    await page.click('#serial-fetch');
    await told(page, 'micro:bit: +' + news + ' session');
    await learned(page, count);
  };
  await fetched(models[0], 1, 1);
  await fetched(models[1], 1, 2);
  await fetched(models[0], 0, 2);
  const words = await page.evaluate(() => JSON.parse(window.goodbot.heat()).words);
  assert.ok(words.includes('red') && words.includes('green'), words.join());
  await page.click('#undo');
  await page.click('#undo');
  await learned(page, 1);
  await close(page);
});

test('a model that cannot be used, and a lesson under way there, are told and change nothing', async () => {
  const page = await connected();
  for (const [answer, said] of [[['error: a lesson is under way; say `finish` or `again` first'], 'micro:bit: a lesson is under way'], [['00ff', 'ok'], 'model']]) {
    await page.evaluate(lines => { window.board.answer = () => lines; }, answer);
    await page.click('#serial-fetch');
    await told(page, said);
    await learned(page, 0);
  }
  await close(page);
});

const hex = fileURLToPath(new URL('../../dist/goodbot.hex', import.meta.url));
const emulator = process.env.GOODBOT_QEMU;

// The emulator's line. Its file is there a moment before anybody listens.
async function lineOf(socket) {
  for (;;) {
    const line = connect(socket);
    try {
      await once(line, 'connect');
      return line;
    } catch (error) {
      if (!['ENOENT', 'ECONNREFUSED'].includes(error.code)) throw error;
      await wait(20);
    }
  }
}

test('the firmware itself does a lesson along with the page, and hands over what it learned', { skip: !emulator || !existsSync(hex) ? 'GOODBOT_QEMU is not set, or dist/goodbot.hex is not there: cargo xtask microbit' : false }, async () => {
  const folder = mkdtempSync(join(tmpdir(), 'goodbot-serial-'));
  const socket = join(folder, 'line');
  const board = spawn(emulator, ['-M', 'microbit', '-display', 'none', '-monitor', 'none', '-device', 'loader,file=' + hex, '-serial', 'unix:' + socket + ',server=on,wait=on'], { stdio: 'ignore' });
  try {
    const line = await lineOf(socket);
    const page = await openWith(simulated);
    await page.exposeFunction('toBoard', request => { line.write(request + '\n'); });
    line.on('data', bytes => page.evaluate(text => { window.heard = (window.heard || '') + text; if (window.board.chosen) window.board.says(text); }, bytes.toString()).catch(() => {}));
    await page.waitForFunction(() => /nothing is stored/.test(window.heard || ''));
    await page.evaluate(() => { window.board.answer = request => { window.toBoard(request); return []; }; });
    await play(page, 'Test');
    await page.selectOption('#speed', 'step');
    await page.click('#serial');
    await told(page, 'Connected.');
    await command(page, 'go to the red room');
    await step(page, 'good', 2);
    await page.click('#good');
    await page.click('#finish');
    await learned(page, 1);
    await page.waitForFunction(() => /stored \d+ bytes\s+ok\s+$/.test(window.heard));
    const heard = await page.evaluate(() => window.heard);
    assert.doesNotMatch(heard, /error/);
    // The robot there was in the same places as the one here.
    const wanted = (await loggedRequests(page)).filter(request => /^act/.test(request)).map(request => request.slice(4).replace('noop', 'nothing'));
    assert.deepEqual(heard.match(/(?<=did )\w+/g), wanted);
    await page.click('#new-robot');
    await page.waitForFunction(() => window.goodbot.sessions() === 0);
    await page.click('#serial-fetch');
    await told(page, 'micro:bit: +1 session');
    assert.equal(await sessions(page), 1);
    await close(page);
  } finally {
    board.kill();
    rmSync(folder, { recursive: true });
  }
});
