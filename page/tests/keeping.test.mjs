import assert from 'node:assert/strict';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, launch, learned, linkOf, model, open, opened, pass, play, reload, saved, sessions, stopTime } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function teach(page) {
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await learned(page, 1);
}

test('a reload keeps the model', async () => {
  const page = await open(browser);
  await teach(page);
  const old = await model(page);
  await reload(page);
  await page.getByText('I have learned from 1 session').waitFor();
  assert.deepEqual(await model(page), old);
  await close(page);
});

test('undo forgets the last session', async () => {
  const page = await open(browser);
  const old = await model(page);
  await teach(page);
  assert.notDeepEqual(await model(page), old);
  assert.match(await page.textContent('#undo'), /^Undo: “go to the green room”$/);
  await page.click('#undo');
  await page.getByText('Undone: “go to the green room”').first().waitFor();
  assert.deepEqual(await model(page), old);
  await close(page);
});

test('undo works after a reload too, and goes back to the lesson', async () => {
  const page = await open(browser);
  const old = await model(page);
  await teach(page);
  assert.match(await page.textContent('#tour-title'), /Lesson 2/);
  await reload(page);
  assert.notDeepEqual(await model(page), old);
  await page.click('#undo');
  await page.getByText('Undone: “go to the green room”').first().waitFor();
  assert.deepEqual(await model(page), old);
  assert.match(await page.textContent('#tour-title'), /Lesson 1/);
  assert.ok(await page.isHidden('#undo'), 'there is nothing more to undo');
  await close(page);
});

test('a model goes out as a file and comes back into another page', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  await opened(page, 'Settings, keeping, sharing');
  const bytes = await saved(page, '#save-model');
  const log = await saved(page, '#save-log');
  assert.equal(log.toString().split('\n').filter(line => line.includes('"type":"session"')).length, 7);
  const other = await open(browser);
  await opened(other, 'Settings, keeping, sharing');
  await other.setInputFiles('#load-model', { name: 'robot.goodbot', mimeType: 'application/octet-stream', buffer: bytes });
  await other.getByText('Saved in this browser: 7 sessions').waitFor();
  assert.deepEqual(await model(other), Array.from(bytes));
  // For the host's tests: this model's belief on a command, to the last bit.
  const folder = process.env.GOODBOT_PAGE_EXPORT;
  if (folder) {
    mkdirSync(folder, { recursive: true });
    const command = 'take the purple chair to the green room';
    const [belief, environment] = await other.evaluate(said => {
      const course = JSON.parse(window.goodbot.constructor.course(0));
      const home = JSON.stringify(course.homes.find(([name]) => name === 'Test')[1]);
      window.goodbot.setEnvironment(home);
      window.goodbot.hear(said);
      return [window.goodbot.belief(), home];
    }, command);
    writeFileSync(join(folder, 'model.goodbot'), bytes);
    writeFileSync(join(folder, 'sessions.jsonl'), log);
    writeFileSync(join(folder, 'asked.json'), JSON.stringify({ command, environment, belief: JSON.parse(belief) }));
  } else console.log('GOODBOT_PAGE_EXPORT is not set: nothing is written for the host’s tests');
  await close(page);
  await close(other);
});

test('a session log teaches another page the same', async () => {
  const page = await open(browser);
  await teach(page);
  await opened(page, 'Settings, keeping, sharing');
  const log = await saved(page, '#save-log');
  const other = await open(browser);
  await opened(other, 'Settings, keeping, sharing');
  const load = buffer => other.setInputFiles('#load-log', { name: 'sessions.jsonl', mimeType: 'application/jsonl', buffer });
  await load(log);
  await other.getByText('The robot has gone through the log').first().waitFor();
  const learned = await model(page);
  assert.deepEqual(await model(other), learned);
  await load(Buffer.from(log.toString().replace('"noop"', '"fly"')));
  await other.getByText('fly is no action here').first().waitFor();
  await load(Buffer.from('null'));
  await other.getByText('line 1 of this log cannot be used: it is not from a session log').first().waitFor();
  assert.deepEqual(await model(other), learned);
  await close(page);
  await close(other);
});

test('a log with a table of closed words of its own is heard with that table', async () => {
  const [page, other] = [await open(browser), await open(browser)];
  const home = await page.evaluate(() => JSON.parse(window.goodbot.environment()));
  const command = 'nix go to the red room';
  const session = more => [{ type: 'session', version: 1, kind: 'feedback', environment: home, command, ...more }, { type: 'step', action: 'noop', feedback: 'neutral' }, { type: 'end', learn: true }];
  const load = async (tab, lines, told) => {
    await opened(tab, 'Settings, keeping, sharing');
    await tab.setInputFiles('#load-log', { name: 'log.jsonl', mimeType: 'application/jsonl', buffer: Buffer.from(lines.map(line => JSON.stringify(line)).join('\n') + '\n') });
    await tab.getByText(told).first().waitFor();
  };
  // With "nix" as a negation, the same words forbid that room, and teach no command.
  await load(page, [...session({ command: 'go to the red room' }), ...session({ utterance: command, closed_words: 'negation: nix' })], 'The robot has gone through the log');
  await load(other, [...session({ command: 'go to the red room' }), ...session({ utterance: command })], 'The robot has gone through the log');
  assert.deepEqual([await sessions(page), await sessions(other)], [1, 2]);
  assert.notDeepEqual(await model(page), await model(other));
  await load(page, session({ closed_words: 'colour: nix' }), 'line 1 of this log cannot be used: “closed_words” is no table of words');
  for (const tab of [page, other]) await close(tab);
});

test('the log says when each step was done and each word was said, also after a reload, and the times teach nothing', async () => {
  const page = await open(browser);
  await play(page, 'D');
  await page.selectOption('#speed', 'step');
  await stopTime(page);
  await page.fill('#command', 'take the blue chair to the yellow room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await pass(page, 800);
  await page.click('#bad');
  await pass(page, 500);
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length === 1);
  await pass(page, 250);
  await page.click('#next');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length === 2);
  await reload(page);
  await page.clock.resume();
  await page.getByText('Your session goes on').first().waitFor();
  await page.click('#good');
  await page.click('#finish');
  await learned(page, 1);
  await opened(page, 'Settings, keeping, sharing');
  const log = (await saved(page, '#save-log')).toString();
  const [first, second, third] = log.trim().split('\n').map(line => JSON.parse(line)).filter(line => line.type === 'step').map(line => [line.feedback, line.at_ms, line.said_ms]);
  assert.deepEqual(first, ['punish', 0, 800]);
  assert.deepEqual(second, ['neutral', 1250, undefined]);
  assert.equal(third[0], 'reward');
  assert.ok(third[1] >= 1250 && third[2] >= third[1], third.join());
  const other = await open(browser);
  await opened(other, 'Settings, keeping, sharing');
  await other.setInputFiles('#load-log', { name: 'sessions.jsonl', mimeType: 'application/jsonl', buffer: Buffer.from(log) });
  await learned(other, 1);
  assert.deepEqual(await model(other), await model(page));
  assert.equal((await saved(other, '#save-log')).toString(), log);
  const timeless = await open(browser);
  await opened(timeless, 'Settings, keeping, sharing');
  await timeless.setInputFiles('#load-log', { name: 'sessions.jsonl', mimeType: 'application/jsonl', buffer: Buffer.from(log.replace(/,"(at|said)_ms":\d+/g, '')) });
  await learned(timeless, 1);
  assert.deepEqual(await model(timeless), await model(page));
  for (const each of [page, other, timeless]) await close(each);
});

test('a damaged model file is refused, and the old model stays', async () => {
  const page = await open(browser);
  await teach(page);
  const old = await model(page);
  await opened(page, 'Settings, keeping, sharing');
  const damaged = Buffer.from(old);
  damaged[Math.floor(damaged.length / 2)] ^= 0x40;
  for (const buffer of [damaged, Buffer.from('no model at all'), Buffer.from(old.slice(0, -3))]) {
    await page.setInputFiles('#load-model', { name: 'robot.goodbot', mimeType: 'application/octet-stream', buffer });
    await page.getByText('This file is not a usable model').first().waitFor();
    assert.deepEqual(await model(page), old);
    await page.evaluate(() => { document.getElementById('toast').hidden = true; document.getElementById('live').textContent = ''; });
  }
  await close(page);
});

test('a link carries the home and the settings', async () => {
  const page = await open(browser);
  await play(page, 'E');
  await page.selectOption('#speed', 'confidence');
  await page.selectOption('#rule', 'threshold');
  await opened(page, 'Settings, keeping, sharing');
  await page.selectOption('#believes', 'punish-only');
  await page.check('#set-pull');
  await page.uncheck('#set-ghost');
  const { hash } = new URL(await linkOf(page, '#share'));
  assert.equal(await page.evaluate(() => location.hash), '', 'the page stays where it is');
  await page.click('#close-link');
  const home = await page.evaluate(() => window.goodbot.environment());
  const other = await open(browser, {}, hash);
  assert.equal(await other.evaluate(() => window.goodbot.environment()), home);
  assert.equal(await other.getAttribute('nav [data-mode=play]', 'aria-pressed'), 'true');
  assert.deepEqual([await other.inputValue('#speed'), await other.inputValue('#rule'), await other.inputValue('#home')], ['confidence', 'threshold', 'E']);
  const switches = await Promise.all(['pull', 'ghost', 'names'].map(name => other.isChecked('#set-' + name)));
  assert.deepEqual(switches, [true, false, true]);
  assert.equal(await other.inputValue('#believes'), 'punish-only');
  assert.deepEqual(await other.evaluate(() => [window.goodbot.strategies()[1].toFixed(2), window.goodbot.pulls()]), ['0.05', true]);
  const broken = await open(browser, {}, '#home=no-link-at-all');
  assert.match(await broken.textContent('#toast'), /The link is damaged/);
  assert.ok(await broken.isVisible('#lesson'), 'and the page works all the same');
  await close(broken);
  await close(page);
  await close(other);
});
