import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { close, eachTab, launch, learned, open, opened, play, reload } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const LANGUAGES = { de: ['Deutsch', 'Sag ihm: „geh in den grünen Raum“'], en: ['English', 'Tell it: “go to the green room”'], es: ['Español', 'Dile: «ve a la habitación verde»'], fr: ['Français', 'Dis-lui\u00a0: «\u00a0va dans la pièce verte\u00a0»'], zh: ['中文', '告诉它：“去绿色的房间”'] };

const settled = page => page.evaluate(() => new Promise(done => { requestAnimationFrame(() => setTimeout(done, 50)); }));

test('a language can be chosen, at once and after a reload', async () => {
  const page = await open(browser);
  assert.deepEqual(await page.locator('#language option').allTextContents(), Object.values(LANGUAGES).map(([name]) => name));
  for (const [code, [, tells]] of Object.entries(LANGUAGES)) {
    await page.selectOption('#language', code);
    assert.equal(await page.getAttribute('html', 'lang'), code);
    assert.equal(await page.textContent('#lesson'), tells);
  }
  await reload(page);
  assert.equal(await page.textContent('#lesson'), LANGUAGES.zh[1]);
  await close(page);
});

// Browsers of these languages; for one that the page does not have, it is English.
for (const [locale, code] of [['de-AT', 'de'], ['pt-BR', 'en'], ['es', 'es'], ['fr', 'fr'], ['zh-CN', 'zh']]) {
  test('the tour in a browser of ' + locale + ': the robot learns the words of ' + LANGUAGES[code][0], async () => {
    const page = await open(browser, { locale });
    assert.equal(await page.getAttribute('html', 'lang'), code);
    assert.equal(await page.textContent('#lesson'), LANGUAGES[code][1]);
    await page.selectOption('#speed', 'once');
    await page.click('#watch');
    await page.locator('#card:visible').waitFor();
    const right = await page.locator('#dots .test.right').count();
    assert.ok(right >= 4, right + ' of 5 tests');
    assert.ok((await page.locator('#card li').count()) >= 5);
    await close(page);
  });
}

// All texts that can be read or heard: also names for screen readers, hints, and placeholders.
const said = page => page.evaluate(() => {
  const texts = [document.title];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) if (!node.parentElement.closest('script, style, noscript, cite, [lang=en], pre, #language, kbd')) texts.push(node.textContent);
  for (const element of document.querySelectorAll('[aria-label], [title], [placeholder]')) texts.push(...['aria-label', 'title', 'placeholder'].map(name => element.getAttribute(name) || ''));
  return texts.filter(text => text.trim());
});

test('in Chinese, no English is left anywhere', async () => {
  const page = await open(browser, { locale: 'zh-CN' });
  const look = where => eachTab(page, tab => lookAt(where + ', ' + tab));
  const lookAt = async where => {
    await settled(page);
    const english = (await said(page)).filter(text => /[A-Za-z]{3,}/.test(text.replace(/goodbot(\.hex)?|micro:bit|MICROBIT|WebAssembly|JSON|CSV|USB|MacGlashan|session|step|answer|end|feedback|demonstration/g, '')));
    assert.deepEqual(english, [], where);
  };
  await look('the tour');
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.waitForFunction(() => document.body.dataset.phase === 'waiting');
  await page.click('#good');
  await look('a lesson');
  await page.click('#finish');
  await learned(page, 1);
  await look('after a lesson');
  await page.check('#set-questions');
  // If the trainer is mostly silent, the robot asks.
  await page.selectOption('#believes', 'balanced');
  await page.click('[data-mode=play]');
  await page.selectOption('#home', 'Test');
  await settled(page);
  await look('free play');
  await page.fill('#command', '随便');
  await page.click('#say-it');
  await page.locator('#answers button').first().waitFor();
  await look('a question');
  await page.click('#drop');
  await page.click('#share');
  await lookAt('a link');
  await page.click('#close-link');
  await page.click('#new-robot');
  await settled(page);
  await look('a new robot');
  await close(page);
});

test('Chinese is written without spaces, its words stand upright, and a test knows which lesson it repeats', async () => {
  const page = await open(browser, { locale: 'zh-CN' });
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.waitForFunction(() => document.body.dataset.phase === 'waiting');
  assert.match(await page.textContent('#tour-title'), /“去绿色的房间”/);
  await page.click('#good');
  await page.click('#finish');
  await learned(page, 1);
  assert.equal(await page.textContent('#undo'), '撤销：“去绿色的房间”');
  await page.locator('#tab-words').click();
  assert.equal(await page.locator('.heat thead span').first().evaluate(word => getComputedStyle(word).transform), 'none');
  await page.locator('#dots button.test').nth(2).click();
  assert.match(await page.textContent('#tour-hint'), /这个命令教过它/);
  await close(page);
});

test('a command may be in any language, whatever the page speaks', async () => {
  const page = await open(browser, { locale: 'de' });
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', '빨간 방으로 가');
  await page.click('#say-it');
  await page.waitForFunction(() => document.body.dataset.phase === 'waiting');
  await page.click('#finish');
  await learned(page, 1);
  const { words } = await page.evaluate(() => JSON.parse(window.goodbot.heat()));
  assert.ok(words.includes('빨간'), words.join(' '));
  await close(page);
});

test('a language that is changed in a session leaves the session as it is', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'go to the red room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#good');
  await opened(page, 'Step by step');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length > 0);
  await page.selectOption('#language', 'fr');
  assert.match(await page.textContent('#bars'), /va dans la pièce rouge/);
  assert.ok(await page.locator('#steps tr').count() > 0);
  await close(page);
});

// English and Chinese write 51%; German and Spanish have a space before the sign, French a narrow one.
for (const [locale, form] of [['en', /\d%/], ['zh-CN', /\d%/], ['de', /\d\u00a0%/], ['es', /\d\u00a0%/], ['fr', /\d\u202f%/]]) {
  test('shares of a hundred are written as ' + locale + ' writes them', async () => {
    const page = await open(browser, { locale });
    await page.selectOption('#speed', 'step');
    await page.click('#lesson');
    await page.locator('#finish:visible').waitFor();
    assert.match(await page.textContent('#say'), form);
    assert.match(await page.locator('#bars .value').first().textContent(), form);
    await close(page);
  });
}

test('German nouns keep the capital that they were written with', async () => {
  const page = await open(browser, { locale: 'de' });
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await page.locator('#verdict:visible').waitFor();
  assert.match(await page.textContent('#say'), /Neue Wörter: geh, in, den, grünen, Raum\./);
  await page.click('#tab-words');
  await settled(page);
  const words = await page.locator('#heat thead th span').allTextContents();
  assert.ok(words.includes('Raum') && words.includes('geh') && !words.includes('raum'), String(words));
  await close(page);
});

test('a robot at its goal says where it is, and in German in the dative', async () => {
  const page = await open(browser, { locale: 'de' });
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  for (let step = 0; step < 40 && !/genau!/.test(await page.textContent('#finish')); step += 1) {
    await page.locator('#finish:visible').waitFor();
    await page.click('#next');
    await page.waitForTimeout(60);
  }
  assert.match(await page.textContent('#say'), /^Ich bin im (grünen|roten) Raum\./);
  await close(page);
});

test('words that are written from right to left stand in the order of the sentence around them, and so do names', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'שלום חדר');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#finish');
  await learned(page, 1);
  // Where a text is seen: its distance from the left.
  const left = (element, text) => page.evaluate(([id, wanted]) => {
    const nodes = document.createTreeWalker(document.getElementById(id), NodeFilter.SHOW_TEXT);
    for (let node = nodes.nextNode(); node; node = nodes.nextNode()) {
      const at = node.data.indexOf(wanted);
      if (at < 0) continue;
      const range = document.createRange();
      range.setStart(node, at);
      range.setEnd(node, at + wanted.length);
      return range.getBoundingClientRect().left;
    }
    return NaN;
  }, [element, text]);
  assert.match(await page.textContent('#say'), /New words: /);
  assert.ok(await left('say', 'שלום') < await left('say', 'חדר'), await page.textContent('#say'));
  // What the robot learns has no invisible signs in it.
  assert.deepEqual(await page.evaluate(() => JSON.parse(window.goodbot.heat()).words), ['שלום', 'חדר']);
  await page.locator('#tab-robots').click();
  await page.fill('#robots .here input', 'רובוט');
  await page.locator('#robots .here input').blur();
  await page.locator('#robots .here button', { hasText: 'Copy' }).click();
  await page.locator('#toast', { hasText: 'knows what' }).waitFor();
  await page.locator('#robots li:not(.here) button', { hasText: 'Delete' }).click();
  await page.locator('#toast', { hasText: 'is deleted' }).waitFor();
  assert.equal(await page.textContent('#toast'), '\u2068רובוט 2\u2069 is deleted. “Bring back” is below the list.');
  await close(page);
});

test('no text has a word that sounds wrong to somebody who grew up with the language', () => {
  // Each with what would be natural: exercise, should or must, whoever.
  for (const [language, wrong] of [['de', /Sitzung/], ['en', /\bshall\b|\bno model that|^Who opens|^Kept in this/], ['fr', /^Qui ouvre/], ['es', /^Ideas$/]]) {
    const texts = Object.entries(JSON.parse(readFileSync(new URL(`../languages/${language}.json`, import.meta.url), 'utf8')));
    assert.deepEqual(texts.filter(([, text]) => wrong.test(text.other ?? text)).map(([key, text]) => [language, key, text]), []);
  }
});
