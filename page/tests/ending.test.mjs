// Every lesson ends well.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { close, launch, open, pass, sessions, stopTime, toTheGoal } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

test('at the goal one big button says yes, ends and learns', async () => {
  const page = await open(browser, { reducedMotion: 'no-preference' });
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await toTheGoal(page, /green/, good => page.click(good ? '#good' : '#bad'));
  assert.match(await page.textContent('#say'), /I am in the green room/);
  await page.click('#finish');
  await page.getByText('Lesson 2 of 7').waitFor();
  assert.equal(await sessions(page), 1);
  assert.match(await page.textContent('#say'), /New words: go, to, the, green, room/);
  assert.equal(await page.evaluate(() => document.activeElement.id), 'lesson', 'the next useful thing has the focus');
  await close(page);
});

test('after a lesson the robot says which words became clear', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  for (const lesson of [2, 3, 4]) {
    await page.click('#auto');
    await page.getByText('Lesson ' + lesson + ' of 7').waitFor();
  }
  assert.match(await page.textContent('#say'), /Now I know: .*“green” means the colour green/);
  await close(page);
});

test('the tour ends with a card of what the robot knows, and a picture of it to keep', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  assert.match(await page.textContent('#card'), /green the colour green/);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#card button')]);
  const picture = readFileSync(await download.path(), 'utf8');
  assert.match(picture, /^<svg .*5 of 5 tests understood/s);
  await close(page);
});

test('the whole tour is watched in less than a minute', async () => {
  const page = await open(browser, { reducedMotion: 'no-preference' });
  await stopTime(page);
  await page.click('#watch');
  let seconds = 0;
  for (; seconds < 90 && !/The tour is over/.test(await page.textContent('#tour-title')); seconds += 1) await pass(page, 1000);
  console.log('watched in ' + seconds + ' s, and what it takes to plan and to learn');
  assert.ok(seconds > 25 && seconds < 55, seconds + ' s');
  await close(page);
});

test('the dots lead to lessons and tests', async () => {
  const page = await open(browser);
  await page.locator('#dots button').nth(4).click();
  assert.match(await page.textContent('#tour-title'), /Lesson 5 of 7/);
  await page.locator('#dots button').nth(0).click();
  assert.match(await page.textContent('#tour-title'), /Lesson 1 of 7/);
  await close(page);
});
