// From the second lesson on people say it in their own words, and guess before a test whether it will be understood.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, open, reload, saved } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function lesson(page, number) {
  await page.click('#auto');
  await learned(page, number);
}

test('the first lesson is one tap; from the second on the words are one’s own', async () => {
  const page = await open(browser);
  assert.ok(await page.isHidden('#own-way'));
  await page.selectOption('#speed', 'once');
  await lesson(page, 1);
  await page.selectOption('#speed', 'step');
  assert.match(await page.textContent('#tour-title'), /Lesson 2 of 7: “go to the red room”/, 'what is meant is said');
  assert.doesNotMatch(await page.textContent('#lesson'), /red/, 'no button has a sentence of ours');
  await page.fill('#own-words', 'zap to rosso');
  await page.press('#own-words', 'Enter');
  await page.getByText('Good or Bad?').waitFor();
  assert.match(await page.textContent('#tour-title'), /zap to rosso/);
  await page.click('#good');
  await page.click('#finish');
  await learned(page, 2);
  const words = await page.evaluate(() => JSON.parse(window.goodbot.heat()).words);
  assert.ok(words.includes('zap') && words.includes('rosso'), String(words));
  await reload(page);
  await page.locator('#dots button').nth(1).click();
  assert.equal(await page.getAttribute('#own-words', 'placeholder'), 'zap to rosso', 'they are proposed again, also after a reload');
  await close(page);
});

test('an emoji is no way to say it: the page says so in its language, and the next tap takes our words', async () => {
  const page = await open(browser, { locale: 'de' });
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await learned(page, 1);
  await page.fill('#own-words', '😀');
  await page.click('#lesson');
  await page.getByText('Darin ist kein Wort.').first().waitFor();
  await page.fill('#own-words', '');
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.getByText('Gut oder schlecht?').waitFor();
  assert.match(await page.textContent('#tour-title'), /geh in den roten Raum/);
  await close(page);
});

test('who has no words of their own takes ours by one tap', async () => {
  const page = await open(browser);
  await page.locator('#dots button').nth(1).click();
  await page.selectOption('#speed', 'step');
  assert.equal(await page.getAttribute('#own-words', 'placeholder'), 'go to the red room');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  assert.match(await page.textContent('#heard'), /go to the red room/);
  await close(page);
});

test('before a test one may guess, and the verdict says whether that was right', async () => {
  const page = await open(browser);
  await page.locator('#dots button').nth(7).click();
  await page.selectOption('#speed', 'once');
  await page.click('[data-guess=no]');
  assert.equal(await page.getAttribute('[data-guess=no]', 'aria-pressed'), 'true');
  await page.click('#lesson');
  await page.waitForFunction(() => document.querySelectorAll('#dots .wrong').length === 1);
  assert.match(await page.textContent('#verdict'), /(a lucky guess|not understood).*You guessed right\.$/);
  await page.click('[data-guess=yes]');
  await page.click('#lesson');
  await page.waitForFunction(() => document.querySelectorAll('#dots .wrong').length === 2);
  assert.match(await page.textContent('#verdict'), /You had guessed otherwise\.$/);
  await page.click('#lesson');
  await page.waitForFunction(() => document.querySelectorAll('#dots .wrong').length === 3);
  assert.doesNotMatch(await page.textContent('#verdict'), /guessed/, 'nobody has to guess');
  await close(page);
});

test('the table has the seed of each session, the version and what to cite', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await lesson(page, 1);
  await page.click('#tab-steps');
  const [head, first] = (await saved(page, '#save-table')).toString().trim().split('\r\n');
  assert.equal(head, 'session,kind,command,home,meant,heard,understood,right,guess,step,action,feedback,robot,seed,version,citation,condition,consent');
  assert.match(first, /,2014,goodbot \d+\.\d+\.\d+,MacGlashan et al\./);
  await close(page);
});
