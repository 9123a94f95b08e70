// Opens the page from a file, and checks that it makes no error and sends nothing to any host.
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { setTimeout as wait } from 'node:timers/promises';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const file = fileURLToPath(new URL('../../dist/goodbot.html', import.meta.url));
export const address = pathToFileURL(file).href;

const FLAGS = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];

export async function launch(...flags) {
  if (second) return second;
  assert.ok(existsSync(file), 'dist/goodbot.html is not there: cargo xtask page');
  const executablePath = process.env.GOODBOT_CHROMIUM || ['/usr/bin/chromium-headless-shell', '/usr/bin/chromium', '/usr/bin/chromium-browser'].find(existsSync);
  assert.ok(executablePath, 'there is no Chromium: `cargo xtask test --only page` fetches one, or name it in GOODBOT_CHROMIUM');
  return chromium.launch({ executablePath, args: [...FLAGS, ...flags] });
}

// Debian's Firefox, a second browser. Without it, its tests are left out.
export const firefoxPath = process.env.GOODBOT_FIREFOX || ['/usr/bin/firefox-esr', '/usr/bin/firefox'].find(existsSync);

// The folder of Firefox's downloads: its driver reports only downloads that come from a visit to another address.
let downloads = '';
// One Firefox for all tests of a file.
/** @type {Promise<import('playwright-core').Browser> | null} */
export let second = null;

/** Makes this file's tests run in Firefox. */
export function takeFirefox() {
  assert.ok(existsSync(file), 'dist/goodbot.html is not there: cargo xtask page');
  downloads = mkdtempSync(join(tmpdir(), 'goodbot-firefox-'));
  process.on('exit', () => rmSync(downloads, { recursive: true }));
  // Its driver is loaded by those files alone that need it.
  second = import('playwright-core-firefox').then(({ firefox }) => firefox.launch({ channel: 'moz-firefox', executablePath: firefoxPath, downloadsPath: downloads }));
}

// A new page with its own storage. `complaints` has its errors. Nothing is animated in it, except in tests of animations: animations take
// a tenth of a core for each page.
export async function open(browser, options = {}, hash = '') {
  return takePaper(await openFirst(browser, options, hash));
}

// A first visit begins with an invented language; most tests take the paper's tour.
export async function takePaper(page) {
  if (await page.isVisible('#own-words')) await page.evaluate(() => document.getElementById('other').click());
  return page;
}

// The same as a first visitor sees it.
export async function openFirst(browser, options = {}, hash = '') {
  // Firefox cannot lay out a page as a phone does; it only has the size.
  const { isMobile, ...others } = options;
  return visit(await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, reducedMotion: 'reduce', ...others, ...(second ? {} : { isMobile }) }), hash);
}

// Questions would interrupt most tests: the tests of questions switch them on. The storage itself must not be read so early: on a slow
// machine Chromium returns an empty one before it knows the page's origin.
const WITHOUT_QUESTIONS = () => {
  const { getItem } = Storage.prototype;
  Storage.prototype.getItem = function (key) { return getItem.call(this, key) ?? (key === 'goodbot.settings' ? '{"questions":false}' : null); };
};

// One more tab of the same browser. `prepare` runs in it before the page does.
export async function openIn(context, hash = '', prepare = null) {
  return takePaper(await visit(context, hash, prepare));
}

async function visit(context, hash = '', prepare = null) {
  const page = await context.newPage();
  // Several test files run at once, and on a slow machine the whole tour takes long.
  page.setDefaultTimeout(60000);
  await page.addInitScript(WITHOUT_QUESTIONS);
  if (prepare) await page.addInitScript(prepare);
  page.complaints = [];
  page.on('console', message => { if (message.type() === 'error' || message.type() === 'warning') page.complaints.push(message.text()); });
  page.on('pageerror', error => page.complaints.push(String(error)));
  page.on('request', request => { if (!/^(file|data|blob):/.test(request.url())) page.complaints.push('asked for ' + request.url()); });
  // To find an element in a tab, the tab is chosen first.
  for (const name of ['click', 'tap', 'check', 'uncheck', 'fill', 'selectOption']) {
    // Firefox's driver has no taps.
    const plain = page[name === 'tap' && second ? 'click' : name].bind(page);
    page[name] = async (selector, ...others) => {
      const tab = await page.evaluate(wanted => {
        const panel = /^[#[.\w]/.test(wanted) && !/[>=]{2}|:has-text|:visible/.test(wanted) && document.querySelector(wanted)?.closest('[role=tabpanel][hidden]');
        return panel ? panel.getAttribute('aria-labelledby') : '';
      }, selector);
      if (tab) await page.locator('#' + tab).click();
      return plain(selector, ...others);
    };
  }
  await page.goto(address + hash);
  await page.waitForSelector('body.ready');
  return page;
}

// For `openIn`: a browser that refuses to keep anything.
export const BLOCKED = () => {
  for (const name of ['localStorage', 'sessionStorage']) Object.defineProperty(window, name, { get() { throw new DOMException('blocked', 'SecurityError'); } });
};

export async function close(page) {
  assert.deepEqual(page.complaints, []);
  await page.context().close();
}

export const model = page => page.evaluate(() => Array.from(window.goodbot.save()));

export async function reload(page) {
  await page.reload();
  await page.waitForSelector('body.ready');
}

// Waits until nothing moves any more, except endless animations.
export const still = page => page.evaluate(async () => {
  const frame = () => new Promise(done => { requestAnimationFrame(() => setTimeout(done)); });
  const moving = () => document.getAnimations().filter(({ effect }) => effect.target.id !== 'wait' && effect.getComputedTiming().endTime < Infinity && effect.getComputedTiming().progress !== null);
  do await frame(); while (moving().length);
});

// Stops the time in the page; from now on only `pass` moves it.
export async function stopTime(page) {
  await page.clock.install();
  await page.clock.pauseAt(Date.now() + 60000);
}

export const pass = (page, milliseconds) => page.clock.runFor(milliseconds);

// Waits until the robot has learned this many sessions.
export const learned = (page, count) => page.waitForFunction(wanted => window.goodbot.sessions() === wanted && document.body.dataset.phase === 'none', count);

export const sessions = page => page.evaluate(() => window.goodbot.sessions());

// Judges each step by whether the robot follows the meant task, until it says that it is there.
export async function toTheGoal(page, meant, judge) {
  for (let step = 0; step < 40; step += 1) {
    await page.getByText('Good or Bad?').waitFor();
    if (/Yes, that was it/.test(await page.textContent('#finish'))) return;
    const count = await page.evaluate(() => document.querySelectorAll('#steps tr').length);
    await judge(meant.test(await page.textContent('#bars .best .label')));
    await page.waitForFunction(before => document.querySelectorAll('#steps tr').length > before, count);
  }
  assert.fail('the robot did not get there');
}

// The three lessons of an invented language, judged step by step; `after` each of them gets what was meant.
export async function teachInvention(page, after = async () => {}) {
  await page.selectOption('#speed', 'step');
  for (const meant of [/red/, /blue/, /bag to the red/]) {
    await page.click('#lesson');
    await toTheGoal(page, meant, good => page.click(good ? '#good' : '#bad'));
    await page.click('#finish');
    await page.waitForFunction(() => document.body.dataset.phase === 'none');
    await after(meant);
  }
}

// Free play in the home of that name.
export async function play(page, home) {
  await page.click('[data-mode=play]');
  await page.selectOption('#home', home);
}

// Calls `look` for each tab that is offered now.
export async function eachTab(page, look) {
  await page.evaluate(() => { for (const details of document.querySelectorAll('#in-words, #objects details')) details.open = true; });
  const tabs = await page.locator('#tabs button:visible').evaluateAll(buttons => buttons.map(button => button.id));
  for (const tab of tabs) {
    await page.locator('#' + tab).click();
    await look(tab);
  }
  if (!tabs.length) await look('no tab');
}

export const opened = async (page, title) => {
  // The tab whose panel has that title.
  const panel = page.locator('[role=tabpanel]', { has: page.getByRole('heading', { name: title, includeHidden: true }) });
  await page.click('#' + await panel.getAttribute('aria-labelledby'));
  await page.evaluate(() => new Promise(done => { requestAnimationFrame(() => setTimeout(done)); }));
};

// Presses on one cell of the drawing and releases on another. Cells count from the drawing's north-west corner.
export async function drag(page, tool, from, to = from) {
  await page.click('[data-tool=' + tool + ']');
  await page.locator('#draft').scrollIntoViewIfNeeded();
  const [fx, fy, tx, ty] = await page.evaluate(([start, end]) => [start, end].flatMap(([column, row]) => {
    const point = new DOMPoint((column + 0.5) * 48, (row + 0.5) * 48).matrixTransform(document.getElementById('draft').getScreenCTM());
    return [point.x, point.y];
  }), [from, to]);
  await page.mouse.move(fx, fy);
  await page.mouse.down();
  await page.mouse.move(tx, ty, { steps: 4 });
  await page.mouse.up();
}

// The link that a button shows: making it takes a moment.
export async function linkOf(page, button) {
  await page.click(button);
  await page.locator('#shared[open]').waitFor();
  return page.inputValue('#link');
}

// The download of a button: its name and its bytes.
export async function downloaded(page, button) {
  if (!downloads) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  }
  for (const name of readdirSync(downloads)) rmSync(join(downloads, name), { recursive: true });
  await page.click(button);
  for (let attempt = 0; attempt < 600; attempt += 1) {
    // Firefox makes an empty file first, and then moves the download to its place.
    const [name] = readdirSync(downloads).filter(each => !each.endsWith('.part'));
    const bytes = name ? readFileSync(join(downloads, name)) : '';
    if (bytes.length) return { name, bytes };
    await wait(50);
  }
  return assert.fail('nothing was downloaded');
}

export const saved = async (page, button) => (await downloaded(page, button)).bytes;
