import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, linkOf, model, open, openFirst, opened, play, reload } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

test('the tour to its end with the auto-trainer: five of five', async () => {
  const page = await open(browser, { reducedMotion: 'no-preference' });
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  assert.match(await page.textContent('#tour-title'), /5 of 5 tests understood/);
  assert.equal(await page.evaluate(() => window.goodbot.sessions()), 7);
  await close(page);
});

test('a session by keyboard alone teaches the robot', async () => {
  const page = await openFirst(browser);
  const focus = async id => {
    for (let press = 0; press < 60; press += 1) {
      if (await page.evaluate(() => document.activeElement.id) === id) return;
      await page.keyboard.press('Tab');
    }
    assert.fail('#' + id + ' cannot be reached by the Tab key');
  };
  await page.keyboard.press('Tab');
  await page.keyboard.press('Tab');
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.dataset.mode), 'play');
  await page.keyboard.press('Enter');
  await focus('command');
  await page.keyboard.type('go to the red room');
  await page.keyboard.press('Enter');
  await page.keyboard.press('p');
  await page.getByText('Good or Bad?').waitFor();
  await page.keyboard.press('b');
  await page.keyboard.press('ArrowRight');
  await page.getByText('You said Good').waitFor();
  await page.keyboard.press('n');
  await page.getByText('Good or Bad?').waitFor();
  await opened(page, 'Step by step');
  assert.match(await page.textContent('#steps tr'), /Good/, 'of several words, the last counts');
  await focus('next');
  await page.keyboard.press('f');
  await learned(page, 1);
  await close(page);
});

test('with the same seed, home and words a new robot takes the same steps, also from a link and after a reload', async () => {
  const page = await open(browser);
  const steps = async (page, reloaded = 0) => {
    await play(page, 'Test');
    await page.selectOption('#speed', 'step');
    await page.fill('#command', 'abrakadabra');
    await page.click('#say-it');
    for (let count = 1; count <= 12; count += 1) {
      await page.getByText('Good or Bad?').waitFor();
      if (count === reloaded) {
        await reload(page);
        await page.getByText('Good or Bad?').waitFor();
      }
      await page.click('#next');
      await page.waitForFunction(wanted => document.querySelectorAll('#steps tr').length === wanted, count);
    }
    const log = await page.evaluate(() => window.goodbot.log());
    await page.click('#drop');
    return log.match(/"action":"\w+"/g).join(' ');
  };
  const seed = async value => {
    await opened(page, 'Settings, keeping, sharing');
    await page.fill('#seed', value);
    await page.keyboard.press('Tab');
  };
  await seed('7');
  const seven = await steps(page);
  await seed('8');
  assert.notEqual(await steps(page), seven);
  await seed('-1');
  assert.equal(await page.inputValue('#seed'), '8', 'what is no seed is not taken');
  await seed('7');
  assert.equal(await steps(page, 2), seven);
  await opened(page, 'Settings, keeping, sharing');
  const { hash } = new URL(await linkOf(page, '#share'));
  await page.click('#close-link');
  assert.equal(await steps(page), seven);
  const other = await open(browser, {}, hash);
  assert.equal(await other.inputValue('#seed'), '7');
  assert.equal(await steps(other), seven);
  await close(page);
  await close(other);
});

test('shortcuts that are switched off do nothing', async () => {
  const page = await open(browser);
  await opened(page, 'Settings, keeping, sharing');
  await page.uncheck('#set-shortcuts');
  await play(page, 'A');
  await page.fill('#command', 'go to the red room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('g');
  assert.match(await page.textContent('#to'), /Good or Bad?/);
  await close(page);
});

test('a session by touch alone, on a screen 360 pixels wide', async () => {
  const page = await open(browser, { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
  await page.tap('[data-mode=play]');
  await page.tap('#command');
  await page.fill('#command', 'go to the green room');
  await page.tap('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.tap('#pause');
  await page.tap('#good');
  await page.getByText('You said Good').waitFor();
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 360, 'the page is ' + wide + ' pixels wide');
  await page.tap('#finish');
  await learned(page, 1);
  await close(page);
});

test('finishing without learning leaves the model as it was', async () => {
  const page = await open(browser);
  await play(page, 'D');
  await page.selectOption('#speed', 'fast');
  const old = await model(page);
  await page.fill('#command', 'take the blue chair to the yellow room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#bad');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length > 1);
  await page.click('#drop');
  await page.getByText('Finished without learning').first().waitFor();
  assert.deepEqual(await model(page), old);
  await close(page);
});

test('a pause while the robot still plans takes no word for a step that is over', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'go to the red room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  // The next plan takes as long as this test needs.
  await page.evaluate(() => {
    const { plan } = Object.getPrototypeOf(window.goodbot);
    Object.assign(window, { isHeldUp: true });
    Object.getPrototypeOf(window.goodbot).plan = function (budget) { return !window.isHeldUp && plan.call(this, budget); };
  });
  await page.click('#next');
  await page.waitForSelector('body[data-phase=planning]');
  for (const label of ['Go on', 'Pause']) {
    await page.click('#pause');
    assert.equal(await page.textContent('#pause'), label);
    assert.equal(await page.getAttribute('body', 'data-phase'), 'planning');
    assert.equal(await page.getAttribute('#good', 'aria-disabled'), 'true');
  }
  await page.keyboard.press('g');
  await page.click('#pause');
  await page.evaluate(() => { window.isHeldUp = false; });
  await page.getByText('Good or Bad?').waitFor();
  assert.equal(await page.getAttribute('#good', 'aria-pressed'), 'false');
  assert.equal(await page.textContent('#pause'), 'Go on', 'it is paused at the next step');
  await close(page);
});
