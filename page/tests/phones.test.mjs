// On small screens, and with large letters: no button covers another, nothing is cut off, and Good and Bad are there only while there is something to judge.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, open } from './browser.mjs';

const SIZES = [320, 360, 390].map(width => ({ width, height: 800 }));
/** @type {import('playwright-core').Browser[]} */
let browsers;
// The second has the letters of somebody who sees badly: 28 pixels, set in the browser itself.
before(async () => { browsers = [await launch(), await launch('--blink-settings=defaultFontSize=28')]; });
after(() => Promise.all(browsers.map(browser => browser.close())));

// The visible buttons and fields that something else covers, even when they are scrolled to the middle.
const covered = page => page.evaluate(() => [...document.querySelectorAll('#page :is(button, select, input:not([type=file], [type=checkbox]))')].filter(one => one.checkVisibility({ visibilityProperty: true })).flatMap(one => {
  one.scrollIntoView({ block: 'center', inline: 'center' });
  const { left, right, top, bottom } = one.getBoundingClientRect();
  if (right - left < 8) return [];
  const found = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
  return found && (one.contains(found) || found.contains(one) || one.labels?.[0]?.contains(found)) ? [] : [(one.id || one.textContent) + ' under ' + (found?.id || found?.tagName)];
}));

const wide = page => page.evaluate(() => {
  scrollTo(0, 0);
  const width = document.documentElement.clientWidth;
  return document.documentElement.scrollWidth > width ? [...document.querySelectorAll('#page *')].filter(one => one.checkVisibility() && !one.closest('.scroll, #tabs, #ideas, svg') && one.getBoundingClientRect().right > width + 1).map(one => one.id || one.className || one.tagName) : [];
});

for (const large of [false, true]) {
  test('on a phone no button covers another, before, in and after a lesson' + (large ? ', with letters of 28 pixels' : ''), async () => {
    for (const viewport of SIZES) {
      const page = await open(browsers[Number(large)], { viewport, isMobile: !large, hasTouch: true });
      await page.selectOption('#speed', 'step');
      const look = async when => {
        assert.deepEqual(await covered(page), [], when + ' at ' + viewport.width);
        assert.deepEqual(await wide(page), [], when + ' at ' + viewport.width);
      };
      assert.ok(await page.isHidden('#good'), 'there is nothing to judge yet');
      await look('before the first lesson');
      await page.tap('#lesson');
      await page.getByText('Good or Bad?').waitFor();
      await page.evaluate(() => scrollTo(0, 0));
      for (const id of ['#good', '#bad', '#plan']) {
        const box = await page.locator(id).boundingBox();
        assert.ok(box && box.y >= 0 && box.y + box.height <= viewport.height && box.height > 40, id + ' at ' + viewport.width + ': ' + JSON.stringify(box));
      }
      await look('in a lesson');
      await page.tap('#finish');
      await page.getByText('Lesson 2 of 7').first().waitFor();
      await look('after the first lesson');
      await page.tap('[data-mode=play]');
      await look('in free play');
      await close(page);
    }
  });
}
