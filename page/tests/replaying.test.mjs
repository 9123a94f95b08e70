// A link shows a session once more, step by step, and changes none of the visitor's data.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, linkOf, model, open, openIn, opened, play } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// A robot that has learned one lesson and then a session with feedback, and its belief at the end of that session.
async function teacher() {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await learned(page, 1);
  await play(page, 'B');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'go to the red room');
  await page.click('#say-it');
  for (const [at, button] of [[1, '#bad'], [2, '#good'], [3, '#next']]) {
    await page.getByText('Good or Bad?').waitFor();
    await page.click(button);
    await page.waitForFunction(count => document.querySelectorAll('#steps tr').length === count, at);
  }
  await page.getByText('Good or Bad?').waitFor();
  const believed = await page.evaluate(() => window.goodbot.belief());
  const steps = await page.evaluate(() => window.goodbot.log().split('\n').filter(line => line.includes('"step"')).map(line => JSON.parse(line)));
  await page.click('#finish');
  await learned(page, 2);
  await opened(page, 'Charts');
  const { hash } = new URL(await linkOf(page, '#share-session'));
  await page.click('#close-link');
  return { page, hash, believed, steps };
}

test('a link shows a session step by step, as it was, and leaves the visitor’s robot alone', async () => {
  const { page, hash, believed, steps } = await teacher();
  assert.match(hash, /^#session=/);
  assert.ok(hash.length < 4000, hash.length + ' letters');
  const visitor = await open(browser);
  await visitor.selectOption('#speed', 'once');
  await visitor.click('#auto');
  await learned(visitor, 1);
  await visitor.selectOption('#speed', 'step');
  const own = await model(visitor);
  const other = await openIn(visitor.context(), hash);
  assert.equal(await other.textContent('#guest-words'), 'A session of Robot 1: “go to the red room”.');
  assert.equal(await other.evaluate(() => location.hash), '');
  for (const [at, { action, feedback }] of steps.entries()) {
    await other.waitForFunction(count => document.querySelectorAll('#steps tr').length === count && document.body.dataset.phase === 'waiting', at);
    await other.click('#next');
    if (feedback === 'neutral') continue;
    const button = feedback === 'reward' ? '#good' : '#bad';
    await other.waitForFunction(id => document.querySelector(id).getAttribute('aria-pressed') === 'true', button);
    assert.match(await other.textContent('#to'), new RegExp((feedback === 'reward' ? 'Good' : 'Bad') + ': moved'), action);
    await other.evaluate(id => document.querySelector(id).click(), button === '#good' ? '#bad' : '#good');
    await other.keyboard.press('f');
    assert.equal(await other.getAttribute(button, 'aria-pressed'), 'true', 'nobody else judges it');
    await other.click('#next');
  }
  await other.getByText('The robot heard: go to the red room.').first().waitFor();
  const rows = await other.locator('#steps tr').evaluateAll(all => all.map(row => row.className).reverse());
  assert.deepEqual(rows, steps.map(({ feedback }) => feedback));
  const likeliest = JSON.parse(believed).tasks.reduce((best, task) => (task.probability > best.probability ? task : best));
  assert.equal(await other.textContent('#bars .best .value'), Math.round(likeliest.probability * 100) + '%', 'it believes what it believed then');
  assert.equal(await other.evaluate(() => window.goodbot.sessions()), 1, 'and has learned nothing more');
  await other.click('#end-guest');
  await other.getByText('is here again').first().waitFor();
  assert.deepEqual(await model(other), own);
  await visitor.locator('#tab-robots').click();
  assert.equal(await visitor.locator('#robots li').count(), 1);
  await close(visitor);
  await close(page);
});

test('a session’s link that is damaged is refused, and without a session there is none', async () => {
  const { page, hash } = await teacher();
  const letters = [...hash];
  letters[70] = letters[70] === 'A' ? 'B' : 'A';
  for (const bad of [letters.join(''), hash.slice(0, -9), '#session=']) {
    const other = await open(browser, {}, bad);
    assert.match(await other.textContent('#toast'), /link is damaged/, bad.slice(0, 20));
    assert.ok(await other.isVisible('#lesson'), 'and the page works all the same');
    await close(other);
  }
  await page.click('#undo');
  await learned(page, 1);
  await page.click('#undo');
  await page.waitForFunction(() => window.goodbot.sessions() === 0);
  await page.evaluate(() => document.getElementById('share-session').click());
  await page.getByText('There is no log').first().waitFor();
  await close(page);
});
