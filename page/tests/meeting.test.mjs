// The robot is the link.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, linkOf, model, open, openIn, opened, play, reload, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// A robot called “blue team” that has learned two lessons, and the part of its link behind the #.
async function teacher() {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  for (const lesson of [2, 3]) {
    await page.click('#auto');
    await page.getByText('Lesson ' + lesson + ' of 7').waitFor();
  }
  await play(page, 'E');
  await opened(page, 'Your robots');
  await page.fill('#robots input', 'blue team');
  await page.keyboard.press('Tab');
  const { hash } = new URL(await linkOf(page, '#meet'));
  return { page, hash };
}

test('a link brings a robot with its name, its words and its home, and the visitor’s own stay as they are', async () => {
  const { page, hash } = await teacher();
  assert.ok(await page.isHidden('#code'), 'no telephone can open a file of this machine');
  await page.click('#close-link');
  const visitor = await open(browser);
  await visitor.selectOption('#speed', 'once');
  await visitor.click('#auto');
  await visitor.getByText('Lesson 2 of 7').waitFor();
  const own = await model(visitor);
  const other = await openIn(visitor.context(), hash);
  assert.match(await other.textContent('#guest-words'), /^Meet blue team\. It knows 6 words/);
  assert.deepEqual(await model(other), await model(page));
  assert.equal(await other.evaluate(() => window.goodbot.environment()), await page.evaluate(() => window.goodbot.environment()));
  assert.equal(await other.evaluate(() => location.hash), '');
  await other.fill('#command', 'go to the red room');
  await other.selectOption('#speed', 'step');
  await other.click('#say-it');
  await other.getByText('Good or Bad?').waitFor();
  await other.click('#good');
  await other.click('#finish');
  await other.waitForFunction(() => window.goodbot.sessions() === 3 && document.body.dataset.phase === 'none');
  await other.click('#end-guest');
  await other.waitForFunction(() => window.goodbot.sessions() === 1);
  assert.deepEqual(await model(other), own);
  await reload(visitor);
  assert.deepEqual(await model(visitor), own);
  await visitor.locator('#tab-robots').click();
  assert.equal(await visitor.locator('#robots li').count(), 1, 'a visitor is not kept unasked');
  await close(visitor);
  await close(page);
});

test('a robot that has visited is kept where somebody says so', async () => {
  const { page, hash } = await teacher();
  const other = await open(browser, {}, hash);
  await other.click('#keep-guest');
  await other.getByText('is kept, under').first().waitFor();
  await reload(other);
  assert.equal(await sessions(other), 2);
  assert.equal(await other.textContent('#who'), 'blue team');
  await close(other);
  await close(page);
});

test('a link that is damaged, cut off or from a newer page is refused, and says so', async () => {
  const { page, hash } = await teacher();
  const letters = [...hash];
  letters[60] = letters[60] === 'A' ? 'B' : 'A';
  for (const [bad, said] of [[letters.join(''), /damaged/], [hash.slice(0, -7), /damaged/], ['#robot=', /damaged/], ['#robot=CQAA', /newer page/]]) {
    const other = await open(browser, {}, bad);
    assert.match(await other.textContent('#toast'), said, bad.slice(0, 20));
    assert.equal(await sessions(other), 0);
    assert.ok(await other.isVisible('#lesson'), 'and the page works all the same');
    await close(other);
  }
  await close(page);
});
