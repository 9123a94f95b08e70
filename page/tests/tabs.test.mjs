// One panel with tabs, beside the stage.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, open, play } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const tabs = page => page.locator('#tabs button:visible').evaluateAll(buttons => buttons.map(button => button.id.slice(4)));
const shown = page => page.locator('[role=tabpanel]:visible').evaluateAll(panels => panels.map(panel => panel.id.slice(6)));
const chosen = page => page.locator('#tabs [aria-selected=true]').evaluateAll(buttons => buttons.map(button => button.id.slice(4)));

test('on arrival there are few tabs, and more as there is more to see', async () => {
  const page = await open(browser);
  assert.deepEqual(await tabs(page), ['thoughts', 'robots', 'settings']);
  assert.deepEqual(await shown(page), ['thoughts']);
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  assert.deepEqual(await tabs(page), ['thoughts', 'words', 'steps', 'robots', 'settings']);
  await page.click('#finish');
  await page.getByText('Lesson 2 of 7').first().waitFor();
  await page.click('[data-mode=play]');
  assert.deepEqual([await tabs(page), await shown(page)], [['thoughts', 'words', 'steps', 'challenges', 'robots', 'settings'], ['challenges']], 'what to teach next comes first');
  await page.click('[data-mode=build]');
  assert.deepEqual([await tabs(page), await shown(page)], [['editor', 'settings'], ['editor']]);
  await close(page);
});

test('the arrow keys, Home and End choose a tab, and are no Good or Bad there', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  await page.focus('#tab-thoughts');
  for (const [key, tab] of [['ArrowRight', 'words'], ['End', 'settings'], ['ArrowRight', 'thoughts'], ['ArrowLeft', 'settings'], ['Home', 'thoughts']]) {
    await page.keyboard.press(key);
    assert.deepEqual([await chosen(page), await shown(page)], [[tab], [tab]], key);
    assert.equal(await page.evaluate(() => document.activeElement.id), 'tab-' + tab);
    assert.equal(await page.locator('#tabs button[tabindex="0"]').count(), 1, 'one stop for the Tab key');
  }
  assert.equal(await page.getAttribute('#good', 'aria-pressed'), 'false');
  await close(page);
});

test('in free play a session shows what the robot thinks, and after it what to teach next', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await page.getByText('Lesson 2 of 7').first().waitFor();
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'go to the red room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  assert.deepEqual(await shown(page), ['thoughts']);
  await page.click('#drop');
  assert.deepEqual(await shown(page), ['challenges']);
  await page.click('#tab-words');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  assert.deepEqual(await shown(page), ['words'], 'a tab that somebody chose stays');
  await close(page);
});

test('on a phone every tab can be reached, and the page is no wider for them', async () => {
  for (const locale of ['en', 'de', 'fr', 'es', 'zh-CN']) {
    const page = await open(browser, { locale, viewport: { width: 320, height: 568 } });
    await page.selectOption('#speed', 'once');
    await page.click('#auto');
    await page.waitForFunction(() => window.goodbot.sessions() === 1 && document.body.dataset.phase === 'none');
    await page.click('[data-mode=play]');
    for (const tab of await tabs(page)) {
      await page.click('#tab-' + tab);
      assert.deepEqual(await shown(page), [tab]);
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 320, locale + ', ' + tab);
    }
    await close(page);
  }
});
