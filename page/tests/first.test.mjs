// A first visitor: opens the page and taps, and the robot soon does the meant task. And the cost of a step in the page.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, open, pass, stopTime } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

test('in at most fifteen seconds after the first tap the robot has gone where it was meant to go, and no right word makes it less sure', async () => {
  const page = await open(browser, { viewport: { width: 390, height: 844 }, hasTouch: true });
  await stopTime(page);
  await page.tap('#lesson');
  let passed = 0;
  const sure = [];
  const isThere = () => page.evaluate(() => document.getElementById('say').textContent.startsWith('I am in the green room'));
  for (let steps = 0; passed < 15000 && !await isThere();) {
    await pass(page, 200);
    passed += 200;
    const now = await page.evaluate(() => [document.querySelectorAll('#steps tr').length, document.body.dataset.phase, document.querySelector('#bars .best .label')?.textContent]);
    if (now[1] !== 'waiting' || now[0] < steps) continue;
    if (await isThere()) break;
    // The visitor judges once for each step.
    await page.tap(/green/.test(now[2]) ? '#good' : '#bad');
    sure.push(parseInt((await page.locator('#bars li', { hasText: 'green' }).locator('.value').textContent()).replace('>', ''), 10));
    steps = now[0] + 1;
  }
  assert.ok(await isThere(), await page.textContent('#say'));
  assert.ok(sure.length > 2 && sure.every((share, at) => share >= (sure[at - 1] ?? 0)), String(sure));
  await close(page);
});

test('a step measures no element, reads no robot, and lays the page out six times at most', async () => {
  const page = await open(browser, { reducedMotion: 'no-preference' });
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  const client = await page.context().newCDPSession(page);
  await client.send('Performance.enable');
  const metric = async name => (await client.send('Performance.getMetrics')).metrics.find(one => one.name === name).value;
  await page.evaluate(() => {
    Object.assign(window, { measured: 0, read: 0 });
    const { getBoundingClientRect } = Element.prototype;
    const { getItem } = Storage.prototype;
    Element.prototype.getBoundingClientRect = function () { window.measured += 1; return getBoundingClientRect.call(this); };
    Storage.prototype.getItem = function (key) { window.read += Number(key.startsWith('goodbot.robot.')); return getItem.call(this, key); };
  });
  const before = await metric('LayoutCount');
  const STEPS = 6;
  for (let step = 1; step <= STEPS; step += 1) {
    await page.evaluate(() => document.getElementById('next').click());
    await page.waitForFunction(count => document.querySelectorAll('#steps tr').length === count && document.body.dataset.phase !== 'planning', step);
  }
  const { measured, read } = await page.evaluate(() => ({ measured: window.measured, read: window.read }));
  const layouts = (await metric('LayoutCount')) - before;
  assert.ok(measured <= STEPS, measured + ' elements measured');
  assert.equal(read, 0);
  assert.ok(layouts <= 6 * STEPS, layouts + ' layouts');
  await close(page);
});
