// The two games: tricking the robot, and a secret language.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';
import { address, close, launch, linkOf, open, openIn, opened, play, sessions } from './browser.mjs';

const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');
let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function axeClean(page, where) {
  await page.addScriptTag({ path: axe });
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  assert.deepEqual(violations.flatMap(violation => violation.nodes.map(node => where + ': ' + violation.id + ' at ' + node.target)), []);
}

const choices = page => page.locator('#trick-choices button');
const many = (page, count) => page.waitForFunction(wanted => document.querySelectorAll('#trick-choices button').length === wanted && document.body.dataset.phase === 'none', count);

// Presses a choice, and waits until new choices replace the old ones.
const pick = async (page, choice, count) => {
  await page.evaluate(() => document.querySelectorAll('#trick-choices button').forEach(button => button.setAttribute('data-old', '')));
  await choice.click();
  await page.waitForFunction(wanted => document.querySelectorAll('#trick-choices button:not([data-old])').length === wanted
    && document.body.dataset.phase === 'none', count);
};

test('a badly taught robot is tricked, one lesson repairs that, and another does not, whichever side the adjectives stand', async () => {
  const page = await open(browser, { bypassCSP: true, viewport: { width: 360, height: 740 } });
  await page.selectOption('#speed', 'once');
  await play(page, 'A');
  const own = await sessions(page);
  for (const code of ['en', 'fr']) {
    await page.selectOption('#language', code);
    await page.click('#tab-challenges');
    await choices(page).click();
    for (const level of [1, 2, 3]) {
      await page.locator('#trick-say', { hasText: new RegExp('^\\D*' + level + '\\D+3') }).waitFor();
      await many(page, 1);
      await pick(page, choices(page), 3);
      if (code === 'en') {
        assert.ok(await choices(page).last().evaluate(choice => choice.getBoundingClientRect().bottom <= innerHeight), 'the question comes into view');
        if (level === 1) await axeClean(page, 'trick');
        await page.locator('#wanted').dispatchEvent('input');
        assert.equal(await page.isVisible('#next-card'), false, 'the next lesson would be the answer');
        const before = await sessions(page);
        await pick(page, choices(page).first(), 3);
        assert.equal(await sessions(page), before + 1, 'one lesson more');
        await pick(page, choices(page).last(), 3);
        assert.equal(await sessions(page), before + 1, 'in place of the one that did not help');
      }
      await pick(page, choices(page).nth(1), 1);
      if (level < 3) await choices(page).click();
    }
    await choices(page).click();
    await page.locator('#guest').waitFor({ state: 'hidden' });
    assert.equal(await sessions(page), own, 'one’s own robot is as it was');
  }
  await close(page);
});

test('a secret language is passed on by a link and found out from what the robot does', async () => {
  const page = await open(browser, { locale: 'de' });
  await page.selectOption('#language', 'en');
  await opened(page, 'Your robots');
  await page.click('#meet-secret');
  await page.getByText('No word of it is clear yet').first().waitFor();
  await page.selectOption('#speed', 'once');
  // Words that the friend does not know: those of another language.
  await page.selectOption('#language', 'de');
  await page.click('#watch');
  await page.locator('#card:visible').waitFor();
  await page.selectOption('#language', 'en');
  await page.click('#keep-guest');
  await page.getByText('is kept, under').first().waitFor();
  const link = await linkOf(page, '#meet-secret');
  assert.match(await page.textContent('#shared-about'), /finds out what its words mean/);
  await page.click('#close-link');

  const friend = await openIn(await browser.newContext({ bypassCSP: true, viewport: { width: 360, height: 800 } }), link.slice(address.length));
  await friend.locator('#secret:visible').waitFor();
  assert.equal(await friend.locator('.learned:visible').count(), 0, 'its thoughts are not told');
  const words = await friend.locator('#secret-words button').allTextContents();
  assert.ok(words.length >= 5 && words.includes('grünen'), words.join());
  await axeClean(friend, 'secret language');
  assert.ok(await friend.evaluate(() => document.documentElement.scrollWidth <= 360), 'nothing is wider than a phone');
  await friend.selectOption('#speed', 'step');
  await friend.locator('#secret-words button', { hasText: 'grünen' }).click();
  await friend.locator('body[data-session]').waitFor();
  const [plan, desk] = [await friend.locator('#plan').boundingBox(), await friend.locator('.desk').boundingBox()];
  assert.ok(plan.y > 0 && plan.y + plan.height < desk.y, 'on a phone it is seen what the robot does: ' + JSON.stringify({ plan, desk }));
  await friend.selectOption('#speed', 'once');
  await friend.waitForFunction(() => document.body.dataset.phase === 'none');
  assert.doesNotMatch(await friend.textContent('#live'), /green room/);
  const chosen = friend.locator('#secret-words li', { has: friend.getByRole('button', { name: 'grünen' }) }).locator('select');
  await chosen.selectOption({ label: 'the colour red' });
  await friend.click('#secret-buttons button');
  await friend.getByText('0 of ' + words.length + ' words are right').first().waitFor();
  await chosen.selectOption({ label: 'the colour green' });
  await friend.click('#secret-buttons button');
  await friend.getByText('1 of ' + words.length + ' words are right').first().waitFor();
  await friend.locator('#secret-buttons .quiet').click();
  assert.match(await friend.locator('#secret-words').innerText(), /grünen\s+= the colour green/);
  assert.ok(await friend.locator('.learned:visible').count() > 0, 'now its thoughts may be seen');
  await friend.click('#end-guest');
  await friend.locator('#secret').waitFor({ state: 'hidden' });
  assert.deepEqual(friend.complaints, []);
  await close(page);
});
