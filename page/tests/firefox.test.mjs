// The parts that differ between browsers, once more in Firefox: beginning, input, storage of a page from a disk, tabs, links, files.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { BLOCKED, close, downloaded, firefoxPath, launch, learned, linkOf, model, open, openIn, opened, play, reload, sessions, takeFirefox, toTheGoal } from './browser.mjs';

const skip = firefoxPath ? false : 'there is no Firefox: `cargo xtask test --only page` fetches one, or name it in GOODBOT_FIREFOX';
let browser;
before(async () => {
  if (skip) return;
  takeFirefox();
  browser = await launch();
});
after(() => browser?.close());

test('in Firefox, an error, and a question to a host, would be seen', { skip }, async () => {
  const page = await open(browser);
  await page.goto('about:blank');
  await page.evaluate(() => {
    console.error('wrong');
    return fetch('http://127.0.0.1:18999/').catch(() => {});
  });
  assert.deepEqual(page.complaints.slice(0, 2).sort(), ['asked for http://127.0.0.1:18999/', 'wrong']);
  await page.context().close();
});

test('in Firefox, a lesson by clicks to its goal, the next by keys, and both outlive a reload', { skip }, async () => {
  const page = await open(browser);
  assert.match(await page.evaluate(() => navigator.userAgent), /Firefox/);
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await toTheGoal(page, /green/, good => page.click(good ? '#good' : '#bad'));
  await page.click('#finish');
  await page.getByText('Lesson 2 of 7').waitFor();
  assert.match(await page.textContent('#say'), /New words: go, to, the, green, room/);
  await play(page, 'A');
  await page.fill('#command', 'go to the green room');
  await page.keyboard.press('Enter');
  await page.getByText('Good or Bad?').waitFor();
  await page.focus('#next');
  await toTheGoal(page, /green/, good => page.keyboard.press(good ? 'ArrowRight' : 'b'));
  await page.keyboard.press('f');
  await learned(page, 2);
  const known = await model(page);
  await reload(page);
  assert.equal(await sessions(page), 2);
  assert.deepEqual(await model(page), known);
  await close(page);
});

test('in Firefox, a session under way goes on after a reload', { skip }, async () => {
  const page = await open(browser);
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'go to the red room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#good');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length === 1);
  const believed = await page.evaluate(() => window.goodbot.belief());
  await reload(page);
  await page.getByText('Your session goes on').first().waitFor();
  assert.equal(await page.evaluate(() => window.goodbot.belief()), believed);
  await page.click('#finish');
  await learned(page, 1);
  await close(page);
});

test('in Firefox, two tabs teach one robot', { skip }, async () => {
  const one = await open(browser);
  const two = await openIn(one.context());
  for (const [page, other, lesson] of [[one, two, 1], [two, one, 2]]) {
    await page.selectOption('#speed', 'once');
    await page.click('#auto');
    await learned(page, lesson);
    await learned(other, lesson);
    assert.deepEqual(await model(other), await model(page), 'the other tab has taken it over');
  }
  assert.deepEqual([...one.complaints, ...two.complaints], []);
  await close(one);
});

test('in Firefox, a link brings a robot, a file saves it, and a file brings it back', { skip }, async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await learned(page, 1);
  await opened(page, 'Your robots');
  const { hash } = new URL(await linkOf(page, '#meet'));
  await page.click('#close-link');
  const other = await open(browser, {}, hash);
  assert.match(await other.textContent('#guest-words'), /^Meet Robot 1\. It knows 5 words/);
  assert.deepEqual(await model(other), await model(page));
  await opened(other, 'Settings, keeping, sharing');
  const { name, bytes } = await downloaded(other, '#save-model');
  assert.equal(name, 'Robot-1.goodbot');
  assert.deepEqual(Array.from(bytes), await model(page));
  const third = await open(browser);
  await opened(third, 'Settings, keeping, sharing');
  await third.setInputFiles('#load-model', { name: 'robot.goodbot', mimeType: 'application/octet-stream', buffer: bytes });
  await third.getByText('Saved in this browser: 1 session').waitFor();
  assert.deepEqual(await model(third), await model(page));
  for (const tab of [page, other, third]) await close(tab);
});

test('in Firefox, the tour ends with a card of the robot, and a link opens in its secret language', { skip }, async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.locator('#card:visible').waitFor();
  const { name, bytes } = await downloaded(page, '#save-card');
  assert.deepEqual([name, bytes.toString('latin1', 1, 4), bytes.readUInt32BE(16)], ['my-robot.png', 'PNG', 1080]);
  await page.click('#keep-guest');
  await page.getByText('is kept, under').first().waitFor();
  const { hash } = new URL(await linkOf(page, '#meet-secret'));
  const friend = await open(browser, {}, hash);
  await friend.locator('#secret:visible').waitFor();
  await close(friend);
  await close(page);
});

test('in Firefox, where storage is blocked, the page says so and works', { skip }, async () => {
  const page = await openIn(await browser.newContext(), '', BLOCKED);
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await learned(page, 1);
  assert.match(await page.textContent('#unkept'), /does not keep what the robot has learned/);
  assert.ok(await page.isVisible('#unkept'));
  await close(page);
});
