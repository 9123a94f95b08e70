// Nobody gets stuck: whoever presses only the button that stands out, and answers in whatever way, comes to the end of the tour.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, open, openFirst, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

/** What a visitor says to a robot's step, by its number.
 * @type {Record<string, (step: number) => string>} */
const ANSWERS = { 'always Good': () => '#good', 'always Bad': () => '#bad', 'Good and Bad by turns': step => (step % 2 ? '#bad' : '#good') };

for (const first of [true, false]) for (const [who, answer] of Object.entries(ANSWERS)) {
  test('by the button that stands out alone one comes to the end ' + (first ? 'of a first visit: ' : 'of the tour: ') + who, async () => {
    const page = await (first ? openFirst : open)(browser);
    await page.selectOption('#speed', 'step');
    const pressed = [];
    for (let at = 0; at < 300 && await page.locator('#card').isHidden(); at += 1) {
      await page.waitForFunction(() => !['planning', 'learning'].includes(document.body.dataset.phase));
      // In a lesson one word is said first; then a button stands out again.
      const out = page.locator('dialog[open] .primary, #page button.primary:not([disabled]):visible');
      const count = await out.count();
      assert.ok(count <= 1, 'two buttons stand out after ' + pressed.slice(-4));
      const button = count ? out.first() : page.locator(answer(at));
      pressed.push(count ? await button.innerText() : answer(at));
      assert.ok(await button.isVisible(), 'nothing is left to press after ' + pressed.slice(-4));
      const before = await page.evaluate(() => document.body.innerText);
      await button.click();
      await page.waitForFunction(text => document.body.innerText !== text, before);
    }
    assert.ok(await page.locator('#card').isVisible(), pressed.slice(-6).join());
    const lessons = await sessions(page);
    assert.ok(first ? lessons >= 3 && lessons <= 6 : lessons === 7, lessons + ' lessons');
    assert.equal(await page.locator('button.primary:visible').count(), 1, 'also at the end one thing stands out');
    await close(page);
  });
}
