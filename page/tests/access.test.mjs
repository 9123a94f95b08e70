import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';
import { close, launch, open, play } from './browser.mjs';

const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');
let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function check(page, where) {
  await page.evaluate(() => { for (const details of document.querySelectorAll('.mind > details, .stage > details')) details.open = true; });
  await page.waitForTimeout(400);
  await page.addScriptTag({ path: axe });
  const { violations } = await page.evaluate(() => window.axe.run(document));
  const said = violations.flatMap(violation => violation.nodes.map(node => where + ': ' + violation.id + ' at ' + node.target + ' ' + node.failureSummary));
  assert.deepEqual(said, []);
}

for (const colorScheme of ['light', 'dark']) {
  for (const width of [1280, 360]) {
    test('axe finds nothing to object to, ' + colorScheme + ', ' + width + ' pixels wide', async () => {
      const page = await open(browser, { colorScheme, viewport: { width, height: 800 }, bypassCSP: true });
      await check(page, 'tour');
      await page.selectOption('#speed', 'once');
      await page.click('#watch');
      await page.getByText('The tour is over').first().waitFor({ timeout: 60000 });
      await check(page, 'after the tour');
      await play(page, 'F');
      await page.selectOption('#speed', 'step');
      await page.fill('#command', 'take the yellow bag to the red room');
      await page.click('#say-it');
      await page.getByText('Good or Bad?').waitFor();
      await check(page, 'in a session');
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= width, 'the page is ' + wide + ' pixels wide');
      await page.click('[data-mode=build]');
      await check(page, 'editor');
      await close(page);
    });
  }
}

test('the floor plan is there in words, and what happens is told', async () => {
  const page = await open(browser, { reducedMotion: 'reduce' });
  await page.getByText('The floor plan in words').click();
  assert.match(await page.textContent('#twin'), /The robot is at column 5, row 7, in the blue room/);
  assert.match(await page.textContent('#textmap'), /#########/);
  await page.click('#lesson');
  await page.waitForFunction(() => /The robot (moved|stayed)/.test(document.getElementById('live').textContent));
  await close(page);
});
