// A study by a link: people agree before the first lesson, and the table tells their condition.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, open, openIn, reload, saved, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const linkOf = study => '#study=' + encodeURIComponent(JSON.stringify(study));
const rowsOf = async page => (await saved(page, '#save-table')).toString().trimEnd().split('\r\n').map(line => line.split(','));

test('who agrees gets a new robot and the study’s settings, and each session has its condition and the time of consent', async () => {
  const one = await open(browser);
  await one.selectOption('#speed', 'once');
  await one.click('#auto');
  await learned(one, 1);
  const page = await openIn(one.context(), linkOf({ id: 'B: "few, words"', settings: { speed: 'fast', seed: 7, style: 'balanced' } }));
  assert.match(await page.textContent('#ask-text'), /^This is a study\..*Do you take part\?$/);
  assert.equal(await page.evaluate(() => location.hash), '');
  const began = new Date().toISOString();
  await page.click('[data-answer=yes]');
  await page.getByText('Lesson 1 of 7').first().waitFor();
  assert.equal(await sessions(page), 0);
  assert.deepEqual([await page.inputValue('#speed'), await page.inputValue('#seed'), await page.inputValue('#believes')], ['fast', '7', 'balanced']);
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await learned(page, 1);
  await reload(page);
  assert.deepEqual([await page.inputValue('#seed'), await page.inputValue('#believes')], ['7', 'balanced'], 'a reload keeps them');
  const [head, row] = (await saved(page, '#save-table')).toString().split('\r\n');
  assert.match(head, /,seed,version,citation,condition,consent$/);
  const time = row.split(',').at(-1);
  assert.ok(row.includes(',7,goodbot ') && row.endsWith(',"B: ""few, words""",' + time), row);
  assert.ok(time >= began && time <= new Date().toISOString(), time);
  await close(one);
});

test('who does not agree keeps their robot and settings, and their table has no condition', async () => {
  const page = await open(browser, {}, linkOf({ id: 'A', consent: 'Ours:\nyes?', settings: { speed: 'slow' } }));
  assert.equal(await page.textContent('#ask-text'), 'Ours:\nyes?');
  await page.keyboard.press('Escape');
  await page.locator('#tab-robots').click();
  assert.equal(await page.locator('#robots li').count(), 1);
  assert.equal(await page.inputValue('#speed'), 'normal');
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await learned(page, 1);
  const [, row] = await rowsOf(page);
  assert.deepEqual(row.slice(-2), ['', '']);
  await close(page);
});

test('the text of consent is in the visitor’s language', async () => {
  const consent = { en: 'In English', fr: 'En français' };
  for (const [locale, own, said] of [['de-DE', undefined, /^Dies ist eine Studie/], ['fr-FR', undefined, /^Ceci est une étude/], ['es-ES', undefined, /^Esto es un estudio/], ['zh-CN', undefined, /^这是一项研究/],
    ['fr-FR', consent, /^En français$/], ['es-ES', consent, /^In English$/]]) {
    const page = await open(browser, { locale }, linkOf({ id: 'A', consent: own }));
    assert.match(await page.textContent('#ask-text'), said);
    await close(page);
  }
});

test('a study’s link with a mistake is refused, and nobody is asked', async () => {
  for (const bad of ['#study=', '#study=%7B', linkOf({}), linkOf({ id: ' ' }), linkOf({ id: 'A', settings: { speed: 'quick' } }), linkOf({ id: 'A', settings: { theme: 'dark' } }), linkOf(null)]) {
    const page = await open(browser, {}, bad);
    assert.match(await page.textContent('#toast'), /link is damaged/, bad);
    assert.equal(await page.locator('#ask[open]').count(), 0);
    await close(page);
  }
  const page = await open(browser, {}, linkOf({ id: 'A', settings: { style: '2,2,2' } }));
  await page.click('[data-answer=yes]');
  await page.getByText('link is damaged').first().waitFor();
  await page.locator('#tab-robots').click();
  assert.equal(await page.locator('#robots li').count(), 1);
  await close(page);
});
