// Two trainers, one sentence, two meanings.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, model, open, opened, play } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// A lesson in which the trainer picks the meaning at once.
async function teach(page, command, meant, count) {
  await page.fill('#command', command);
  await page.click('#say-it');
  await page.waitForFunction(() => document.body.dataset.phase === 'waiting');
  await page.selectOption('#pick', { label: meant });
  await page.waitForFunction(() => /^9\d%|> 99/.test(document.querySelector('#bars .best .value').textContent));
  await page.click('#finish');
  await learned(page, count);
}

const robotAt = answer => answer.locator('.robot').evaluate(robot => robot.style.transform);

test('two robots that were taught differently take one sentence side by side for two things', async () => {
  const page = await open(browser, { reducedMotion: 'no-preference' });
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await opened(page, 'Your robots');
  assert.ok(await page.isHidden('#beside'), 'one robot has nothing beside it');
  await teach(page, 'lumi', 'go to the red room', 1);
  await opened(page, 'Your robots');
  await page.click('#new-robot');
  await page.getByText('A new robot, Robot 2').first().waitFor();
  await teach(page, 'lumi', 'go to the green room', 1);
  await opened(page, 'Your robots');
  const known = await model(page);
  await page.evaluate(() => {
    const { animate } = Element.prototype;
    Object.assign(window, { walks: 0 });
    Element.prototype.animate = function (...how) {
      if (this.matches('.robot')) window.walks += 1;
      return animate.apply(this, how);
    };
  });
  await page.fill('#beside-command', 'lumi');
  await page.click('#ask-beside button');
  const answers = page.locator('#beside-answers li');
  await answers.nth(1).waitFor();
  const [here, other] = await answers.all();
  assert.match(await here.textContent(), /^Robot 2.*go to the green room.*\d+% sure/);
  assert.match(await other.textContent(), /^Robot 1.*go to the red room.*\d+% sure/);
  assert.match(await page.textContent('#live'), /lumi.*Robot 2: .*green room.*Robot 1: .*red room/);
  const [left, right] = await Promise.all([here, other].map(answer => answer.boundingBox()));
  assert.ok(left.y === right.y && left.x + left.width < right.x, 'they stand side by side');
  assert.notEqual(await robotAt(here), await robotAt(other));
  assert.equal(await page.evaluate(() => window.walks), 2, 'each walks there');
  assert.deepEqual(await model(page), known, 'nobody learns from that');
  await teach(page, 'lumi', 'go to the green room', 2);
  await opened(page, 'Your robots');
  assert.equal(await answers.count(), 0, 'an answer from before a lesson is gone');
  await page.fill('#beside-command', '?!');
  await page.click('#ask-beside button');
  await page.getByText('There is no word in that').first().waitFor();
  await close(page);
});
