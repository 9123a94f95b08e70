// In languages that are longer or shorter than English, everything fits, and axe-core finds no fault.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';
import { close, eachTab, launch, learned, open, still } from './browser.mjs';

const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');
let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

for (const [code, width] of [['de', 360], ['es', 360], ['fr', 360], ['zh', 360], ['de', 1280], ['fr', 1280]]) {
  // The page is built alike in all languages: for axe, only a longer language and another script can differ.
  const hasAxe = width === 360 && ['de', 'zh'].includes(code);
  test('everything fits in ' + code + ', ' + width + ' pixels wide' + (hasAxe ? ', and axe finds nothing to object to' : ''), async () => {
    const page = await open(browser, { locale: code, viewport: { width, height: 800 }, bypassCSP: true });
    const check = where => eachTab(page, tab => checkTab(where + ', ' + tab));
    const checkTab = async where => {
      await still(page);
      const { violations } = hasAxe ? await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] })) : { violations: [] };
      assert.deepEqual(violations.flatMap(violation => violation.nodes.map(node => where + ': ' + violation.id + ' at ' + node.target)), []);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= width, where + ': the page is ' + wide + ' pixels wide');
      const cut = await page.evaluate(() => [...document.querySelectorAll('button, #say, #to')].filter(element => element.offsetParent && !element.closest('#ideas') && element.scrollWidth > element.clientWidth + 1).map(element => element.textContent));
      assert.deepEqual(cut, [], where + ': cut off');
    };
    await page.addScriptTag({ path: axe });
    await check('tour');
    await page.selectOption('#speed', 'step');
    await page.click('#lesson');
    await page.waitForFunction(() => document.body.dataset.phase === 'waiting');
    await check('lesson');
    await page.click('#good');
    await page.click('#finish');
    await learned(page, 1);
    await page.click('[data-mode=play]');
    await page.locator('#next-lesson:visible').waitFor();
    await check('next lesson');
    await page.click('#teach-next');
    await page.waitForFunction(() => document.body.dataset.phase === 'waiting');
    await page.check('#set-presenter');
    await check('class view');
    await page.click('#end-presenter');
    await page.click('#drop');
    await page.click('[data-mode=build]');
    await check('build');
    await close(page);
  });
}
