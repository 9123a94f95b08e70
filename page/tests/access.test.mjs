import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';
import { address, close, downloaded, eachTab, launch, linkOf, open, opened, openFirst, openIn, pass, play, reload, still, stopTime, teachInvention } from './browser.mjs';

const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');
let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// The elements that a finger must hit, as a selector.
const TARGETS = 'button:not(#dots button), select, summary, .check, .button, textarea, input:not([type=checkbox], [type=file])';

// Checks the page as it is now, light and dark, wide and narrow.
const check = (page, where) => eachTab(page, tab => checkTab(page, where + ', ' + tab));

async function checkTab(page, where) {
  for (const width of [1280, 360]) {
    await page.setViewportSize({ width, height: 800 });
    // The dark page differs only in its colours, which are the same at any width.
    for (const colorScheme of width === 360 ? ['light'] : ['light', 'dark']) {
      await page.emulateMedia({ colorScheme });
      await still(page);
      const rules = colorScheme === 'dark' ? { runOnly: ['color-contrast'] } : {};
      const { violations } = await page.evaluate(only => window.axe.run(document, { resultTypes: ['violations'], ...only }), rules);
      const said = violations.flatMap(violation => violation.nodes.map(node => [where, colorScheme, width, violation.id, 'at', node.target, node.failureSummary].join(' ')));
      assert.deepEqual(said, []);
    }
    const [wide, small] = await page.evaluate(targets => [document.documentElement.scrollWidth, [...document.querySelectorAll(targets)].filter(element => {
      const box = element.getBoundingClientRect();
      return element.offsetParent && (box.height < 43.5 || box.width < 43.5);
    }).map(element => element.outerHTML.slice(0, 90))], TARGETS);
    assert.ok(wide <= width, where + ': the page is ' + wide + ' pixels wide');
    assert.deepEqual(small, [], where + ': too small to touch');
  }
}

test('axe finds nothing to object to in an invented language, from its second lesson to its end, and in the game that it makes', async () => {
  const page = await openFirst(browser, { bypassCSP: true });
  await page.addScriptTag({ path: axe });
  await teachInvention(page, async meant => {
    if (!meant.test('red')) await checkTab(page, 'the third lesson');
  });
  await page.click('#lesson');
  await page.getByText('Skip the walk').waitFor();
  await checkTab(page, 'the test');
  await page.click('#lesson');
  await page.locator('#decode').waitFor();
  await checkTab(page, 'the end');
  const { hash } = new URL(await linkOf(page, '#decode'));
  const friend = await open(browser, { bypassCSP: true }, hash);
  await friend.addScriptTag({ path: axe });
  await checkTab(friend, 'the game');
  await friend.locator('#secret-buttons .quiet').click();
  await checkTab(friend, 'after the game');
  await close(friend);
  await page.click('#close-link');
  const { bytes } = await downloaded(page, '#tour-table');
  await page.setInputFiles('#open-class', ['one.csv', 'two.csv'].map(name => ({ name, mimeType: 'text/csv', buffer: bytes })));
  await page.locator('#class[open]').waitFor();
  await checkTab(page, 'a class');
  await close(page);
});

test('axe finds nothing to object to, light and dark, wide and narrow', async () => {
  const page = await openFirst(browser, { bypassCSP: true, reducedMotion: 'no-preference' });
  await page.addScriptTag({ path: axe });
  await check(page, 'first visit');
  await page.click('#other');
  await check(page, 'tour');
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  await check(page, 'after the tour');
  await page.click('#end-guest');
  await play(page, 'F');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'take the yellow bag to the red room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await check(page, 'in a session');
  await page.click('[data-mode=build]');
  await check(page, 'editor');
  await page.click('#clear');
  await page.setInputFiles('#load-model', { name: 'robot.goodbot', mimeType: 'application/octet-stream', buffer: Buffer.from('none') });
  await page.getByText('This file is not a usable model').first().waitFor();
  await check(page, 'a drawing that is no home, and a model that is none');
  await close(page);
});

test('axe finds nothing to object to at any of the twelve stops of the tour, before it and in it', async () => {
  const page = await open(browser, { bypassCSP: true });
  await page.addScriptTag({ path: axe });
  await page.selectOption('#speed', 'step');
  for (let at = 0; at < 12; at += 1) {
    await page.setViewportSize({ width: 1280, height: 800 });
    await page.locator('#dots button').nth(at).click();
    await checkTab(page, 'stop ' + (at + 1));
    await page.click('#lesson');
    await page.locator('#bad[aria-disabled=false], #lesson:has-text("Skip the walk")').first().waitFor();
    await checkTab(page, 'in stop ' + (at + 1));
    // A test ends, and a lesson is left.
    if (at > 6) await page.click('#lesson');
    else await page.click('#drop');
    await page.locator('body:not([data-session])').waitFor();
  }
  await close(page);
});

test('the floor plan is there in words, and what happens is told', async () => {
  const page = await open(browser, { reducedMotion: 'reduce' });
  await opened(page, 'Settings, keeping, sharing');
  await page.getByText('The floor plan in words').click();
  assert.match(await page.textContent('#twin'), /The robot is at column 5, row 7, in the blue room/);
  assert.match(await page.textContent('#textmap'), /#########/);
  await page.click('#lesson');
  await page.waitForFunction(() => /The robot (moved|stayed)/.test(document.getElementById('live').textContent));
  await close(page);
});

test('a first-time visitor sees one sentence and one button to begin with', async () => {
  for (const viewport of [{ width: 1280, height: 800 }, { width: 360, height: 640 }]) {
    const page = await open(browser, { viewport });
    assert.match(await page.textContent('#tour-hint'), /Good for a right step, Bad for a wrong one/);
    const button = await page.locator('#lesson').boundingBox();
    assert.match(await page.textContent('#lesson'), /Tell it: “go to the green room”/);
    assert.ok(button.y + button.height < viewport.height * 0.8, JSON.stringify(button));
    assert.equal(await page.locator('button.primary:visible').count(), 1, 'only one button stands out');
    await close(page);
  }
});

test('light and dark can be chosen', async () => {
  const page = await open(browser, { colorScheme: 'light' });
  const ground = () => page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  const light = await ground();
  await page.selectOption('#theme', 'dark');
  assert.notEqual(await ground(), light);
  await reload(page);
  assert.notEqual(await ground(), light, 'after a reload too');
  await close(page);
});

test('nothing moves by itself where motion is not wanted', async () => {
  const page = await open(browser, { reducedMotion: 'reduce' });
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  assert.deepEqual(await page.evaluate(() => document.getAnimations().map(animation => animation.effect.target.id)), ['wait'], 'but how long it waits is information');
  await close(page);
});

test('forced colours show where one is and which word was said', async () => {
  const page = await open(browser, { forcedColors: 'active' });
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'go to the red room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#pause');
  const ground = selector => page.evaluate(found => getComputedStyle(document.querySelector(found)).backgroundColor, selector);
  const silent = await ground('#good');
  await page.click('#good');
  await page.waitForSelector('#good[aria-pressed=true]');
  assert.notEqual(await ground('#good'), silent);
  assert.notEqual(await ground('nav [data-mode=play]'), await ground('nav [data-mode=tour]'));
  await close(page);
});

test('what is told stays in the live region, and is told again when it is said again', async () => {
  const page = await open(browser);
  await stopTime(page);
  await page.click('#good', { force: true });
  assert.ok(await page.isVisible('#toast'));
  await pass(page, 6000);
  assert.ok(await page.isHidden('#toast'));
  assert.match(await page.textContent('#live'), /first tell the robot/);
  await close(page);
});

test('without JavaScript or WebAssembly there is one clear sentence and no dead button', async () => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const plain = await context.newPage();
  await plain.goto(address);
  assert.equal(await plain.locator('button:visible').count(), 0);
  assert.match(await plain.locator('body').innerText(), /^The robot runs in this page, and needs JavaScript\.[^.]*\.$/);
  await context.close();
  for (const [locale, sentence] of [['en-GB', /^This browser cannot run the robot\.[^.]*\.$/], ['de-AT', /^Dieser Browser kann den Roboter nicht ausführen\.[^.]*\.$/]]) {
    const other = await browser.newContext({ locale });
    const page = await openIn(other, '', () => { delete window.WebAssembly; });
    assert.match(await page.locator('body').innerText(), sentence);
    assert.equal(await page.locator('button:visible').count(), 0);
    await other.close();
  }
});
