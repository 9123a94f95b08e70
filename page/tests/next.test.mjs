import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, open, opened, play, reload } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// Teaches one command by hand, in the home of that name.
async function teach(page, home, command, count) {
  await play(page, home);
  await page.fill('#command', command);
  await page.click('#say-it');
  await page.waitForFunction(() => document.body.dataset.phase === 'waiting');
  await page.click('#good');
  await page.click('#finish');
  await learned(page, count);
}

// What to teach next is worked out when there is time.
const thoughtOver = page => page.locator('#next-card[aria-busy=false]').waitFor();

test('what to teach next is the lesson with the word that is wanted and was heard least, and it says why', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'step');
  await play(page, 'A');
  assert.equal(await page.locator('#next-card').isVisible(), false, 'there is nothing to propose at first');
  await teach(page, 'A', 'go to the green room', 1);
  await thoughtOver(page);
  assert.match(await page.textContent('#next-why'), /heard that word in 1 session only/);
  await page.fill('#wanted', 'go to the green room\ngo to the yellow room\ntake the purple bag to the yellow room');
  await thoughtOver(page);
  assert.match(await page.textContent('#next-lesson'), /take the purple bag|to the yellow room/);
  assert.match(await page.textContent('#next-why'), /“(yellow|take|purple|bag)” is in \d of the commands .* it has never heard that word/);
  await reload(page);
  assert.match(await page.inputValue('#wanted'), /purple bag/, 'it is kept');
  await close(page);
});

test('what is proposed can be taught at once, in a home that has what it names', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'step');
  await teach(page, 'A', 'go to the green room', 1);
  await page.fill('#wanted', 'take the blue chair to the yellow room');
  await thoughtOver(page);
  const proposed = (await page.textContent('#next-lesson')).match(/“(.*)”/)[1];
  assert.match(proposed, /blue|chair|yellow|take/);
  await page.click('#teach-next');
  await page.getByText('Good or Bad?').waitFor();
  assert.equal(await page.textContent('#heard'), proposed);
  const words = await page.locator('#bars .label').allTextContents();
  assert.ok(words.includes(proposed), 'it can be meant there: ' + words);
  assert.equal(await page.locator('#next-card').isVisible(), false, 'in a session nothing else is proposed');
  await close(page);
});

test('words of one’s own are proposed again, and what was heard often is no lesson any more', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'step');
  for (let count = 1; count <= 6; count += 1) await teach(page, 'A', 'zorp blik', count);
  await thoughtOver(page);
  assert.match(await page.textContent('#next-why'), /little left to teach/);
  assert.equal(await page.locator('#teach-next').isVisible(), false);
  await page.fill('#wanted', 'zorp mung');
  await thoughtOver(page);
  assert.match(await page.textContent('#next-lesson'), /zorp mung/);
  assert.match(await page.textContent('#next-why'), /“mung”/);
  const pasted = await page.evaluate(() => {
    const field = document.getElementById('wanted');
    field.select();
    document.execCommand('insertText', false, 'zorp mung\n'.repeat(3000));
    return field.value.length;
  });
  assert.ok(pasted <= 2000, 'what is pasted is no longer than the page can think over at once: ' + pasted);
  await close(page);
});

test('for a class there is only the plan with Good and Bad, large, and a way back', async () => {
  for (const viewport of [{ width: 1920, height: 1080 }, { width: 1024, height: 768 }]) {
    const page = await open(browser, { viewport });
    await opened(page, 'Settings, keeping, sharing');
    const small = await page.evaluate(() => parseFloat(getComputedStyle(document.getElementById('good')).fontSize));
    await page.check('#set-presenter');
    await page.click('#lesson');
    await page.getByText('Good or Bad?').waitFor();
    for (const id of ['#plan', '#good', '#bad', '#say', '#finish']) {
      const box = await page.locator(id).boundingBox();
      assert.ok(box && box.y >= 0 && box.y + box.height <= viewport.height, id + ' is seen: ' + JSON.stringify(box));
    }
    assert.ok(await page.evaluate(() => parseFloat(getComputedStyle(document.getElementById('good')).fontSize)) > small * 1.3);
    for (const hidden of ['.mind', 'footer', 'nav']) assert.equal(await page.locator(hidden).isVisible(), false, hidden);
    assert.ok((await page.locator('#plan').boundingBox()).height > viewport.height * 0.4);
    await reload(page);
    assert.equal(await page.locator('nav').isVisible(), false, 'after a reload too');
    await page.click('#end-presenter');
    assert.equal(await page.locator('nav').isVisible(), true);
    await close(page);
  }
});
