// A robot that knows everyday English.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, linkOf, model, open, openIn, opened, play, reload, saved, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const COMMAND = 'go to the red room';
const starter = page => page.evaluate(() => window.goodbot.starter());
const idle = (page, wanted) => page.waitForFunction(language => window.goodbot.starter() === language && document.body.dataset.phase === 'none', wanted);

// A page in free play whose robot knows everyday English.
async function halfTaught() {
  const page = await open(browser);
  await play(page, 'A');
  await page.check('#set-starter');
  await idle(page, 'en');
  return page;
}

// The belief on a command, the likeliest task first.
const believed = page => page.evaluate(said => {
  window.goodbot.hear(said);
  const { tasks } = JSON.parse(window.goodbot.belief());
  window.goodbot.forget();
  return tasks.sort((one, other) => other.probability - one.probability);
}, COMMAND);

// One lesson: the robot is told that its first guess is right.
async function teach(page, count) {
  await page.selectOption('#speed', 'step');
  await page.fill('#command', COMMAND);
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#good');
  await page.click('#finish');
  await learned(page, count);
  await page.click('#reset');
}

test('a robot that knows everyday English is sure of a common sentence at once, and after a reload believes the same', async () => {
  const page = await open(browser);
  await play(page, 'Test');
  assert.ok(!(await page.isChecked('#set-starter')));
  assert.ok((await believed(page))[0].probability < 0.5);
  const alone = await model(page);
  await page.check('#set-starter');
  await idle(page, 'en');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', COMMAND);
  await page.click('#say-it');
  await page.getByText('You mean: go to the red room.', { exact: true }).waitFor();
  assert.equal(await page.locator('#heard u').count(), 0, 'no word is new to it');
  await page.click('#drop');
  const known = await believed(page);
  assert.deepEqual([await sessions(page), await model(page)], [0, alone], 'these sentences are no lessons of its own');
  await reload(page);
  await play(page, 'Test');
  await idle(page, 'en');
  assert.deepEqual(await believed(page), known);
  assert.ok(await page.isChecked('#set-starter'));
  await page.click('#undo');
  await page.getByText('Undone: the change of “knows everyday English”').first().waitFor();
  assert.ok(!(await page.isChecked('#set-starter')));
  assert.ok((await believed(page))[0].probability < 0.5);
  await page.click('#redo');
  await idle(page, 'en');
  assert.deepEqual(await believed(page), known);
  await page.selectOption('#language', 'de');
  assert.ok(!(await page.isChecked('#set-starter')), 'it knows no everyday German');
  await page.check('#set-starter');
  await idle(page, 'de');
  await close(page);
});

test('the page says that the robot learns, and takes no command, whatever makes it learn', async () => {
  const page = await halfTaught();
  await page.evaluate(() => {
    const { goodbot } = window;
    const learn = goodbot.learn.bind(goodbot);
    window.phases = new Set();
    goodbot.learn = budget => {
      window.phases.add(document.body.dataset.phase);
      return learn(budget);
    };
  });
  const phases = () => page.evaluate(() => [...window.phases]);
  for (const [button, language] of [['#undo', ''], ['#redo', 'en'], ['[data-mode=tour]', ''], ['[data-mode=play]', 'en']]) {
    await page.evaluate(() => window.phases.clear());
    await page.click(button);
    await idle(page, language);
    assert.deepEqual(await phases(), ['learning'], button);
  }
  await close(page);
});

test('the tour is without everyday English', async () => {
  const [page, other] = [await halfTaught(), await open(browser)];
  await page.click('[data-mode=tour]');
  for (const each of [page, other]) {
    await each.selectOption('#speed', 'once');
    await each.click('#auto');
    await learned(each, 1);
  }
  assert.equal(await starter(page), '');
  assert.deepEqual(await model(page), await model(other));
  await reload(page);
  assert.equal(await starter(page), '');
  await play(page, 'A');
  await idle(page, 'en');
  assert.equal(await sessions(page), 1);
  await page.click('#new-robot');
  await page.getByText('I know no word yet').waitFor();
  assert.equal(await starter(page), '', 'a new robot knows nothing');
  await close(page);
  await close(other);
});

test('a log, a link and another tab bring back what a robot with everyday English learned', async () => {
  const page = await halfTaught();
  await teach(page, 1);
  await teach(page, 2);
  const [own, known] = [await model(page), await believed(page)];
  const log = await saved(page, '#save-log');
  const other = await halfTaught();
  await other.setInputFiles('#load-log', { name: 'log.jsonl', mimeType: 'application/jsonl', buffer: log });
  await other.getByText('The robot has gone through the log').first().waitFor();
  assert.deepEqual([await model(other), await believed(other)], [own, known]);
  await close(other);
  await opened(page, 'Your robots');
  const { hash } = new URL(await linkOf(page, '#meet'));
  await page.click('#close-link');
  const visitor = await open(browser, {}, hash);
  assert.deepEqual([await model(visitor), await believed(visitor)], [own, known]);
  await visitor.click('#keep-guest');
  await visitor.getByText('is kept, under').first().waitFor();
  await reload(visitor);
  await play(visitor, 'A');
  await idle(visitor, 'en');
  assert.deepEqual(await believed(visitor), known);
  await close(visitor);
  const tab = await openIn(page.context());
  await play(tab, 'A');
  await idle(tab, 'en');
  assert.deepEqual(await believed(tab), known);
  await tab.uncheck('#set-starter');
  await idle(page, '');
  assert.deepEqual([await model(page), await sessions(page)], [own, 2]);
  await page.click('#undo');
  await idle(page, 'en');
  await page.click('#undo');
  await learned(page, 1);
  assert.equal(await starter(page), 'en');
  await close(page);
});
