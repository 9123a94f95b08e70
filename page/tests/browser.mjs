// Opens the page from a file, and watches that it makes no error and asks no other host for anything.
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { setTimeout as wait } from 'node:timers/promises';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';
import { firefox } from 'playwright-core-firefox';

const file = fileURLToPath(new URL('../../dist/goodbot.html', import.meta.url));
export const address = pathToFileURL(file).href;

const FLAGS = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];

export async function launch() {
  if (second) return second;
  assert.ok(existsSync(file), 'dist/goodbot.html is not there: cargo xtask page');
  const executablePath = process.env.GOODBOT_CHROMIUM || ['/usr/bin/chromium-headless-shell', '/usr/bin/chromium', '/usr/bin/chromium-browser'].find(existsSync);
  assert.ok(executablePath, 'there is no Chromium: `cargo xtask test --only page` fetches one, or name it in GOODBOT_CHROMIUM');
  return chromium.launch({ executablePath, args: FLAGS });
}

// Debian's Firefox, or none where there is none: it is a second browser, and those tests are then left out.
export const firefoxPath = process.env.GOODBOT_FIREFOX || ['/usr/bin/firefox-esr', '/usr/bin/firefox'].find(existsSync);

// Where Firefox puts what it downloads: its driver tells only of downloads that come from a visit to another address.
let downloads = '';
// One Firefox for all tests of a file.
/** @type {Promise<import('playwright-core').Browser> | null} */
export let second = null;

/** From now on this file's tests run in Firefox. */
export function takeFirefox() {
  assert.ok(existsSync(file), 'dist/goodbot.html is not there: cargo xtask page');
  downloads = mkdtempSync(join(tmpdir(), 'goodbot-firefox-'));
  process.on('exit', () => rmSync(downloads, { recursive: true }));
  second = firefox.launch({ channel: 'moz-firefox', executablePath: firefoxPath, downloadsPath: downloads });
}

// A page of its own, with a storage of its own. `complaints` is what went wrong in it. Nothing moves in it by itself, which takes a tenth of a
// core for each page, but where a test is about what moves.
export async function open(browser, options = {}, hash = '') {
  // Firefox has no phone's way to lay out a page, only its size.
  const { isMobile, ...others } = options;
  return openIn(await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, reducedMotion: 'reduce', ...others, ...(second ? {} : { isMobile }) }), hash);
}

// Questions come in the middle of what most tests are about: those that are about questions switch them on. The storage itself must not be
// asked for so early: on a slow machine Chromium hands out an empty one to who asks before it knows whose page this is.
const WITHOUT_QUESTIONS = () => {
  const { getItem } = Storage.prototype;
  Storage.prototype.getItem = function (key) { return getItem.call(this, key) ?? (key === 'goodbot.settings' ? '{"questions":false}' : null); };
};

// One more tab of the same browser. `prepare` runs in it before the page does.
export async function openIn(context, hash = '', prepare = null) {
  const page = await context.newPage();
  // Several files of tests run at once, and on a slow machine the whole tour takes its time.
  page.setDefaultTimeout(60000);
  await page.addInitScript(WITHOUT_QUESTIONS);
  if (prepare) await page.addInitScript(prepare);
  page.complaints = [];
  page.on('console', message => { if (message.type() === 'error' || message.type() === 'warning') page.complaints.push(message.text()); });
  page.on('pageerror', error => page.complaints.push(String(error)));
  page.on('request', request => { if (!/^(file|data|blob):/.test(request.url())) page.complaints.push('asked for ' + request.url()); });
  // Who looks for something that stands in a tab chooses the tab first.
  for (const name of ['click', 'tap', 'check', 'uncheck', 'fill', 'selectOption']) {
    // Firefox is driven without fingers.
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

// Until nothing moves any more, but for what always does.
export const still = page => page.evaluate(async () => {
  const frame = () => new Promise(done => { requestAnimationFrame(() => setTimeout(done)); });
  const moving = () => document.getAnimations().filter(({ effect }) => effect.target.id !== 'wait' && effect.getComputedTiming().endTime < Infinity && effect.getComputedTiming().progress !== null);
  do await frame(); while (moving().length);
});

// From now on time stands still in the page, and goes on by `pass` alone.
export async function stopTime(page) {
  await page.clock.install();
  await page.clock.pauseAt(Date.now() + 60000);
}

export const pass = (page, milliseconds) => page.clock.runFor(milliseconds);

// Until the robot has learned from so many sessions.
export const learned = (page, count) => page.waitForFunction(wanted => window.goodbot.sessions() === wanted && document.body.dataset.phase === 'none', count);

export const sessions = page => page.evaluate(() => window.goodbot.sessions());

// Judges each step by whether the robot takes the command for what is meant, until it says that it is there.
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

// Free play in the home of that name.
export async function play(page, home) {
  await page.click('[data-mode=play]');
  await page.selectOption('#home', home);
}

// Looks at each tab that is offered now.
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

// Presses at one cell of the drawing and lets go at another. Cells count from the drawing's north-west corner.
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

// What a button downloads: its name and its bytes.
export async function downloaded(page, button) {
  if (!downloads) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  }
  for (const name of readdirSync(downloads)) rmSync(join(downloads, name), { recursive: true });
  await page.click(button);
  for (let attempt = 0; attempt < 600; attempt += 1) {
    // Firefox makes an empty file first, and moves what it got into its place.
    const [name] = readdirSync(downloads).filter(each => !each.endsWith('.part'));
    const bytes = name ? readFileSync(join(downloads, name)) : '';
    if (bytes.length) return { name, bytes };
    await wait(50);
  }
  return assert.fail('nothing was downloaded');
}

export const saved = async (page, button) => (await downloaded(page, button)).bytes;
