// Commands that say how: through a room, through one of two, or not through one.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, open, opened, play, reload, saved, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const AVOIDING = 'agentInRoom(agent0,room4) avoiding agentInRoom(agent0,room2)';
const rooms = page => page.evaluate(() => JSON.parse(window.goodbot.scene()).rooms);
const tasks = page => page.evaluate(() => JSON.parse(window.goodbot.belief()).tasks);

// The colours of the rooms that the footprints go through, by the cells where they turn and end.
const walked = async page => {
  const path = (await page.getAttribute('.prints', 'd')).match(/-?[\d.]+/g).map(Number);
  const { bounds } = await page.evaluate(() => JSON.parse(window.goodbot.scene()));
  const cells = [];
  for (let at = 0; at < path.length; at += 2) cells.push([bounds.left + path[at] / 48 - 0.5, bounds.top - path[at + 1] / 48 + 0.5]);
  const inside = ({ left, right, top, bottom }, [x, y]) => x > left && x < right && y > bottom && y < top;
  return new Set((await rooms(page)).filter(room => cells.some(cell => inside(room, cell))).map(room => room.color));
};

test('the tour’s appendix: after two lessons the robot understands which room to keep out of', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.locator('#appendix:visible').waitFor();
  await page.click('#keep-guest');
  await page.getByText('is kept, under').first().waitFor();
  assert.equal(await page.locator('#dots button').count(), 12);
  await page.click('#appendix');
  await page.getByText('Appendix 1').first().waitFor();
  assert.equal(await page.locator('#dots button').count(), 15);
  for (const number of [8, 9]) {
    await page.locator('#auto:visible').click();
    await learned(page, number);
  }
  await page.click('#lesson');
  // The tour is over with this test, and its last verdict is hidden at once.
  await page.getByText(/Appendix 3: understood\. ★ It thought “go to the blue room, but not through the purple room”/).first().waitFor({ state: 'attached' });
  await opened(page, 'Its dictionary');
  assert.ok((await page.locator('#heat tbody th').allTextContents()).includes('going to a room, not through a certain room'));
  await reload(page);
  assert.equal(await page.locator('#dots button').count(), 15, 'the robot still hears ways after a reload');
  assert.ok(await page.locator('#appendix').isHidden());
  await opened(page, 'Your robots');
  for (let back = 0; back < 3; back += 1) await page.click('#undo');
  await page.waitForFunction(() => !window.goodbot.ways());
  assert.equal(await sessions(page), 7);
  await close(page);
});

test('where ways are switched on, a meaning with a way can be picked, and the ghost goes that way', async () => {
  const page = await open(browser);
  await opened(page, 'Settings, keeping, sharing');
  assert.ok(!(await page.isChecked('#set-ways')), 'the paper’s two tasks are what commands mean');
  await page.check('#set-ways');
  await page.waitForFunction(() => window.goodbot.ways() && document.body.dataset.phase === 'none');
  await page.locator('#dots button').nth(12).click();
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  assert.ok((await tasks(page)).length >= 40);
  await page.selectOption('#pick', AVOIDING);
  await page.waitForFunction(() => /go to the green room, but not through the yellow room/.test(document.querySelector('#bars .best .label').textContent));
  assert.ok((await tasks(page)).find(task => task.name === AVOIDING).probability > 0.7);
  await page.waitForFunction(() => document.querySelector('.prints')?.getAttribute('d'));
  const colors = await walked(page);
  assert.ok(colors.has('green') && !colors.has('yellow'), 'the way leads through ' + [...colors]);
  await page.click('#finish');
  await learned(page, 1);
  const log = (await saved(page, '#save-log')).toString().trim().split('\n').map(line => JSON.parse(line));
  assert.deepEqual(log.find(line => line.type === 'answer').tasks, [AVOIDING]);
  await play(page, 'A');
  await page.fill('#command', 'go to the red room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  assert.ok(await page.locator('#pick').isVisible());
  await page.click('#drop');
  await page.uncheck('#set-ways');
  await page.waitForFunction(() => !window.goodbot.ways() && document.body.dataset.phase === 'none');
  assert.equal(await sessions(page), 1, 'what was learned stays');
  await close(page);
});
