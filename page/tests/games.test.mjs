// The game of a secret language.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';
import { address, close, launch, linkOf, open, openIn, opened } from './browser.mjs';

const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');
let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function axeClean(page, where) {
  await page.addScriptTag({ path: axe });
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  assert.deepEqual(violations.flatMap(violation => violation.nodes.map(node => where + ': ' + violation.id + ' at ' + node.target)), []);
}

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
