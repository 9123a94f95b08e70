// What the page says when something ends: at the goal Good is yes, what failed is not celebrated, and one robot does not mean two things.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, open, opened, play, sessions, toTheGoal } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

test('at the goal Good is yes: the lesson ends, and the robot learns', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await toTheGoal(page, /green/, good => page.click(good ? '#good' : '#bad'));
  await page.click('#good');
  await page.getByText('Lesson 2 of 7').first().waitFor();
  assert.equal(await sessions(page), 1);
  assert.match(await page.textContent('#verdict'), /Lesson 1: (it got there|understood at once)/);
  // The same by its key, and in free play.
  await play(page, 'A');
  await page.fill('#command', 'go to the green room');
  await page.click('#say-it');
  await toTheGoal(page, /green/, good => page.click(good ? '#good' : '#bad'));
  await page.keyboard.press('g');
  await learned(page, 2);
  await close(page);
});

test('at a goal that is not meant, Bad sends the robot on', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await toTheGoal(page, /red/, good => page.click(good ? '#good' : '#bad'));
  for (let times = 0; times < 6 && /I am in the red room/.test(await page.textContent('#say')); times += 1) {
    const count = await page.locator('#steps tr').count();
    await page.click('#bad');
    await page.waitForFunction(before => document.querySelectorAll('#steps tr').length > before && document.body.dataset.phase === 'waiting', count);
  }
  assert.doesNotMatch(await page.textContent('#say'), /I am in the red room/);
  assert.equal(await sessions(page), 0);
  await close(page);
});

// Asks each test, and skips the robot's walk. Returns what the page said about each in its verdict, bubble and live region, and the verdict's colour.
async function ask(page) {
  const said = [];
  await page.evaluate(() => {
    window.told = [];
    new MutationObserver(() => window.told.push(document.getElementById('live').textContent)).observe(document.getElementById('live'), { childList: true });
  });
  for (let at = 1; at <= 5; at += 1) {
    await page.evaluate(() => { window.told = []; });
    await page.click('#lesson');
    await page.getByText('Skip the walk').waitFor();
    await page.locator('#verdict:visible').waitFor();
    said.push(await page.evaluate(() => ({ verdict: document.getElementById('verdict').textContent, bubble: document.getElementById('say').textContent, live: window.told, wrong: document.getElementById('verdict').classList.contains('wrong') })));
    await page.click('#lesson');
    await page.waitForFunction(done => document.querySelectorAll('#dots .test.right, #dots .test.wrong').length === done, at);
  }
  return said;
}

test('of a robot that was taught nothing, verdict, bubble and live region name the same guess; no test is green, and nothing is celebrated', async () => {
  const page = await open(browser);
  await page.locator('#dots button').nth(7).click();
  for (const { verdict, bubble, live, wrong } of await ask(page)) {
    const task = verdict.match(/“(.*)”/)[1];
    assert.ok(bubble.includes(task), verdict + ' / ' + bubble);
    for (const text of live) for (const other of text.match(/(?:go|take) to? ?the .*? room/g) || []) assert.ok(task.includes(other.replace(/^.*the /, '')), verdict + ' / ' + text);
    assert.ok(wrong, verdict);
  }
  await page.locator('#card:visible').waitFor();
  assert.match(await page.textContent('#tour-title'), /0 of 5/);
  assert.equal(await page.locator('#plan .robot.happy, #plan .robot.dancing').count(), 0);
  await close(page);
});

test('a lesson that went wrong is not told in the colour of a success; one word is one word', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await toTheGoal(page, /red/, good => page.click(good ? '#good' : '#bad'));
  await page.click('#good');
  await page.getByText('went wrong').first().waitFor();
  assert.ok(await page.locator('#verdict.wrong').isVisible());
  await close(page);
});

test('until the robot has decided, its bubble names none of the tasks that are still equally likely', async () => {
  const page = await open(browser);
  await play(page, 'A');
  // A home or a machine in which planning takes long.
  await page.evaluate(() => {
    const { plan } = Object.getPrototypeOf(window.goodbot);
    window.goodbot.plan = budget => (window.slow === false ? plan.call(window.goodbot, budget) : false);
  });
  await page.fill('#command', 'blip zot');
  await page.click('#say-it');
  await page.getByText('It is making a plan').waitFor();
  assert.equal((await page.textContent('#say')).trim(), 'Thinking it over …');
  await page.evaluate(() => { window.slow = false; });
  await page.locator('#say', { hasText: 'you mean: go to the' }).waitFor();
  await close(page);
});
