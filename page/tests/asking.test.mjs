import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, open, openIn, opened, pass, play, reload, saved, stopTime } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// A page in which the robot asks: it has heard unknown words in a home with many possible tasks.
async function asked(options = {}) {
  const page = await open(browser, options);
  await opened(page, 'Settings, keeping, sharing');
  await page.check('#set-questions');
  await play(page, 'Test');
  await page.selectOption('#speed', 'once');
  await page.fill('#command', 'abrakadabra');
  await page.click('#say-it');
  await page.locator('#answers button').first().waitFor();
  await page.waitForTimeout(400);
  return page;
}

const log = page => page.evaluate(() => window.goodbot.log().trim().split('\n').map(line => JSON.parse(line)));
const answers = async page => (await log(page)).filter(line => line.type === 'answer');
const belief = page => page.evaluate(() => JSON.parse(window.goodbot.belief()).tasks.map(task => task.probability));

test('the robot asks in its bubble, waits, and an answer tells it what is meant', async () => {
  const page = await asked();
  assert.match(await page.textContent('#say'), /\?/);
  assert.equal(await page.locator('#good').isVisible(), false, 'a question is answered, and no step is judged');
  const before = await belief(page);
  const { tasks } = await page.evaluate(() => JSON.parse(window.goodbot.openQuestion()));
  await stopTime(page);
  await pass(page, 10000);
  assert.deepEqual(await log(page).then(lines => lines.filter(line => line.type === 'step')), [], 'it waits');
  await page.locator('#answers button').first().click();
  await page.waitForFunction(old => JSON.stringify(JSON.parse(window.goodbot.belief()).tasks.map(task => task.probability)) !== old, JSON.stringify(before));
  const [line] = await answers(page);
  assert.equal(line.yes, true);
  assert.equal(line.eta, 0.05);
  const now = await belief(page);
  const named = await page.evaluate(names => JSON.parse(window.goodbot.belief()).tasks.map((task, at) => (names.includes(task.name) ? at : -1)).filter(at => at >= 0), line.tasks);
  assert.ok(named.every(at => tasks.includes(at)));
  const sum = (belief, of) => of.reduce((all, at) => all + belief[at], 0);
  assert.ok(sum(now, named) > sum(before, named) + 0.2, 'what was said yes to is likelier');
  await close(page);
});

test('by keyboard: y and n, 1 to 3, and nothing else answers', async () => {
  const page = await asked();
  await page.evaluate(() => document.activeElement.blur());
  const isChoice = () => page.locator('#answers.which').count();
  for (let count = 1; count <= 2 && await page.locator('#answers').isVisible(); count += 1) {
    await page.waitForTimeout(400);
    await page.keyboard.press(await isChoice() ? 'y' : '1');
    await page.keyboard.press('g');
    assert.equal((await answers(page)).length, count - 1, 'that is no answer to this question');
    const question = await page.getAttribute('#answers', 'data-key');
    await page.keyboard.press(await isChoice() ? '2' : 'n');
    await page.waitForFunction(wanted => window.goodbot.log().split('"answer"').length - 1 === wanted, count);
    await page.waitForFunction(old => document.body.dataset.phase !== 'planning' && document.getElementById('answers').dataset.key !== old, question);
  }
  await close(page);
});

test('a press that comes as the question does is no answer', async () => {
  const page = await open(browser);
  await opened(page, 'Settings, keeping, sharing');
  await page.check('#set-questions');
  await play(page, 'Test');
  await page.fill('#command', 'abrakadabra');
  await page.evaluate(() => new MutationObserver((_, observer) => {
    const button = document.querySelector('#answers button');
    if (button) { observer.disconnect(); button.click(); }
  }).observe(document.getElementById('answers'), { childList: true }));
  await page.click('#say-it');
  await page.locator('#answers button').first().waitFor();
  assert.deepEqual(await answers(page), []);
  await close(page);
});

test('a question may stay unanswered, and is not asked again', async () => {
  const page = await asked();
  const question = await page.textContent('#say strong');
  const choices = await page.locator('#answers').textContent();
  await page.click('#unanswered');
  await page.waitForFunction(() => window.goodbot.log().includes('"step"'));
  assert.deepEqual(await answers(page), []);
  await page.waitForFunction(() => !document.getElementById('answers').hidden || document.getElementById('finish').classList.contains('big'));
  if (await page.locator('#answers').isVisible()) assert.notEqual(await page.textContent('#say strong') + await page.locator('#answers').textContent(), question + choices);
  await close(page);
});

test('questions can be switched off, and the tour has none', async () => {
  const page = await open(browser);
  assert.equal(await page.locator('#set-questions').isChecked(), false, 'the tests begin so');
  await opened(page, 'Settings, keeping, sharing');
  await page.check('#set-questions');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  assert.equal(await page.locator('#answers').isVisible(), false);
  await page.click('#drop');
  await page.uncheck('#set-questions');
  await play(page, 'Test');
  await page.fill('#command', 'abrakadabra');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  assert.equal(await page.locator('#answers').isVisible(), false);
  await close(page);
});

test('an answer stands in the log, survives a reload, and the log teaches the same', async () => {
  const page = await asked();
  await page.locator('#answers button').first().click();
  await page.waitForFunction(() => window.goodbot.log().includes('"answer"'));
  const before = await belief(page);
  await reload(page);
  await page.getByText('Your session goes on').first().waitFor();
  assert.equal((await answers(page)).length, 1);
  const now = await belief(page);
  assert.equal(now.length, before.length);
  for (const [at, probability] of now.entries()) assert.ok(Math.abs(probability - before[at]) < 1e-3, at + ': ' + probability + ' was ' + before[at]);
  await page.click('#finish');
  await learned(page, 1);
  const heat = await page.evaluate(() => JSON.parse(window.goodbot.heat()));
  await opened(page, 'Settings, keeping, sharing');
  const file = await saved(page, '#save-log');
  assert.match(file.toString(), /"type":"answer"/);
  assert.match(file.toString(), /"rests"/, 'it expects real people');
  await opened(page, 'Your robots');
  await page.click('#new-robot');
  await page.getByText('It knows no word').first().waitFor();
  await page.setInputFiles('#load-log', { name: 'log.jsonl', mimeType: 'application/jsonl', buffer: file });
  await learned(page, 1);
  const again = await page.evaluate(() => JSON.parse(window.goodbot.heat()));
  assert.deepEqual(again.words, heat.words);
  for (const [at, cell] of again.cells.entries()) assert.ok(Math.abs(cell - heat.cells[at]) < 1e-3);
  await close(page);
});

test('what it asks, guesses and answers is said aloud where that is switched on', async () => {
  const context = await browser.newContext();
  await context.addInitScript(() => {
    window.spoken = [];
    Object.defineProperty(window, 'speechSynthesis', { value: { cancel() {}, speak: utterance => window.spoken.push(utterance.text) } });
    window.SpeechSynthesisUtterance = class { constructor(text) { this.text = text; } };
  });
  const page = await openIn(context);
  await opened(page, 'Settings, keeping, sharing');
  await page.check('#set-questions');
  await page.check('#set-voice');
  await play(page, 'Test');
  await page.fill('#command', 'abrakadabra');
  await page.click('#say-it');
  await page.locator('#answers button').first().waitFor();
  const spoken = () => page.evaluate(() => window.spoken.splice(0));
  assert.deepEqual(await spoken(), [await page.textContent('#say strong')]);
  // Its guess, each time that it is another one, and its answers between sessions.
  await page.click('#unanswered');
  await page.locator('#say', { hasText: 'you mean' }).waitFor();
  await page.click('#pause');
  const guesses = await spoken();
  assert.equal(guesses.at(-1), await page.textContent('#say strong'));
  assert.equal(new Set(guesses).size, guesses.length);
  await page.click('#good');
  await page.click('#finish');
  await page.waitForFunction(() => window.goodbot.sessions() === 1 && document.body.dataset.phase === 'none');
  assert.match((await spoken()).join(), /^Thank you\. New words: abrakadabra/);
  await page.fill('#command', '…');
  await page.click('#say-it');
  await page.locator('#say', { hasText: 'no word in that' }).waitFor();
  assert.deepEqual((await spoken()).map(text => text.trim()), ['There is no word in that. Tell me in words what to do.']);
  // Switched off, it is silent.
  await page.uncheck('#set-voice');
  await page.fill('#command', 'abrakadabra');
  await page.click('#say-it');
  await page.locator('#answers button, #good[aria-disabled=false]').first().waitFor();
  assert.deepEqual(await spoken(), []);
  await close(page);
});

for (const viewport of [{ width: 360, height: 640 }, { width: 1280, height: 800 }]) {
  test('the question, the plan and all answers are seen together on ' + viewport.width + ' pixels', async () => {
    const page = await asked({ viewport, hasTouch: viewport.width < 700, isMobile: viewport.width < 700 });
    const [say, plan, group] = await Promise.all(['#say', '#plan', '#answers'].map(id => page.locator(id).boundingBox()));
    assert.ok(say.y >= 0 && plan.height >= 150 && plan.y + plan.height <= group.y + 1, JSON.stringify([say, plan, group]));
    assert.ok(group.y + group.height <= viewport.height, JSON.stringify(group));
    await close(page);
  });
}
