// No work is lost: tabs, reloads, robots, undo, storage that is blocked or full.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { BLOCKED, close, drag, launch, linkOf, model, open, openIn, opened, play, reload, saved, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// One session in the present home, with one word.
async function teach(page, command, speed = 'step') {
  await begin(page, command, speed);
  const count = await sessions(page);
  await page.click('#finish');
  await page.waitForFunction(before => window.goodbot.sessions() > before && document.body.dataset.phase === 'none', count);
}

async function begin(page, command, speed = 'step') {
  // The robot may already be at the goal.
  await page.click('#reset');
  await page.selectOption('#speed', speed);
  await page.fill('#command', command);
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#pause');
  await page.click('#good');
}

const home = page => page.evaluate(() => window.goodbot.environment());
const log = async page => {
  await opened(page, 'Settings, keeping, sharing');
  return (await saved(page, '#save-log')).toString();
};
const commands = text => text.trim().split('\n').map(line => JSON.parse(line)).filter(record => record.type === 'session').map(record => record.command);
const answer = (page, key) => page.click('#ask [data-answer=' + key + ']');

test('two tabs teach one robot, and it learns from both', async () => {
  const one = await open(browser);
  await play(one, 'A');
  const two = await openIn(one.context());
  await play(two, 'B');
  await begin(one, 'go to the red room');
  await teach(two, 'go to the blue room');
  // The other tabs see kept data a moment later.
  await one.waitForFunction(() => Object.entries(localStorage).some(([key, kept]) => key.startsWith('goodbot.robot.') && JSON.parse(kept).sessions === 1));
  await one.click('#finish');
  await one.waitForFunction(() => window.goodbot.sessions() === 2 && document.body.dataset.phase === 'none');
  assert.deepEqual(commands(await log(one)), ['go to the blue room', 'go to the red room']);
  await two.waitForFunction(() => window.goodbot.sessions() === 2 && document.body.dataset.phase === 'none');
  assert.deepEqual(await model(two), await model(one), 'the other tab has taken it over');
  await reload(one);
  assert.equal(await sessions(one), 2);
  await close(one);
});

test('two tabs that finish at the same moment teach one robot both lessons, again and again', async () => {
  const one = await open(browser);
  await play(one, 'A');
  const two = await openIn(one.context());
  await play(two, 'B');
  const said = [];
  for (let round = 1; round <= 5; round += 1) {
    const both = ['red', 'blue'].map(color => 'go to the ' + color + ' room, ' + round);
    said.push(...both);
    await Promise.all([one, two].map((page, at) => begin(page, both[at])));
    // Each tab presses the button by its own clock, at the same moment.
    const moment = Date.now() + 400;
    await Promise.all([one, two].map(page => page.evaluate(at => { while (Date.now() < at) { /* Wait. */ } document.getElementById('finish').click(); }, moment)));
    for (const page of [one, two]) await page.waitForFunction(count => window.goodbot.sessions() === count && document.body.dataset.phase === 'none', 2 * round);
  }
  assert.deepEqual(commands(await log(one)).sort(), said.sort());
  assert.deepEqual(await model(two), await model(one));
  await close(one);
});

test('a tab that writes down a name while another learns leaves what that one learned', async () => {
  const one = await open(browser);
  await play(one, 'A');
  const two = await openIn(one.context());
  await opened(two, 'Your robots');
  for (const color of ['red', 'green', 'red', 'green', 'red', 'green']) {
    await begin(one, 'go to the ' + color + ' room');
    const renamed = two.evaluate(async () => {
      for (let count = 0; count < 40; count += 1) {
        const name = document.querySelector('#robots input');
        name.value = 'Robot ' + count;
        name.dispatchEvent(new Event('change'));
        await new Promise(done => { setTimeout(done, 5); });
      }
    });
    await one.click('#finish');
    await renamed;
    await one.waitForFunction(() => !document.body.hasAttribute('data-session') && document.body.dataset.phase === 'none');
  }
  await reload(one);
  assert.equal(await sessions(one), 6);
  await close(one);
});

test('several robots have names, and can be switched, copied, deleted and brought back', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await teach(page, 'go to the red room');
  const known = await model(page);
  await opened(page, 'Your robots');
  await page.fill('#robots input', 'blue team');
  await page.keyboard.press('Tab');
  await page.waitForFunction(() => document.getElementById('who').textContent === 'blue team');
  await page.click('#new-robot');
  await page.getByText('A new robot, Robot 1').first().waitFor();
  assert.equal(await sessions(page), 0);
  await page.click('[aria-label="Copy blue team"]');
  assert.deepEqual(await page.locator('#robots input').evaluateAll(inputs => inputs.map(input => input.value)), ['blue team', 'Robot 1', 'blue team 2']);
  await page.click('[aria-label="Switch to blue team 2"]');
  await page.waitForFunction(() => document.getElementById('who').textContent === 'blue team 2');
  assert.deepEqual(await model(page), known);
  await teach(page, 'go to the red room');
  await page.click('[aria-label="Switch to blue team"]');
  await page.waitForFunction(() => document.getElementById('who').textContent === 'blue team');
  assert.deepEqual(await model(page), known, 'a copy learns by itself');
  await page.click('[aria-label="Delete blue team"]');
  await page.waitForFunction(() => document.getElementById('who').textContent !== 'blue team');
  await reload(page);
  await opened(page, 'Your robots');
  await page.getByText('Bring back blue team').click();
  await page.click('[aria-label="Switch to blue team"]');
  await page.waitForFunction(() => document.getElementById('who').textContent === 'blue team');
  assert.deepEqual(await model(page), known);
  assert.deepEqual(commands(await log(page)), ['go to the red room']);
  await close(page);
});

test('undo goes back through many sessions, and forward again, also after a reload', async () => {
  const page = await open(browser);
  await play(page, 'A');
  const models = [await model(page)];
  for (const color of ['red', 'green', 'red']) {
    await teach(page, 'go to the ' + color + ' room');
    models.push(await model(page));
  }
  const whole = await log(page);
  await reload(page);
  for (const [at, color] of [[2, 'red'], [1, 'green'], [0, 'red']]) {
    assert.equal(await page.textContent('#undo'), 'Undo: “go to the ' + color + ' room”');
    await page.click('#undo');
    await page.getByText('Undone: “go to the ' + color + ' room”').first().waitFor();
    assert.deepEqual(await model(page), models[at]);
  }
  assert.ok(await page.isHidden('#undo'));
  await reload(page);
  for (let at = 1; at <= 3; at += 1) {
    await page.click('#redo');
    await page.waitForFunction(count => window.goodbot.sessions() === count && document.body.dataset.phase === 'none', at);
    assert.deepEqual(await model(page), models[at]);
  }
  assert.equal(await log(page), whole);
  await close(page);
});

test('a session under way survives a reload, with the words that were said', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await begin(page, 'go to the red room');
  await page.click('#next');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length === 1);
  const believed = await page.evaluate(() => window.goodbot.belief());
  await reload(page);
  await page.getByText('Your session goes on').first().waitFor();
  assert.equal(await page.evaluate(() => document.querySelectorAll('#steps tr').length), 1);
  assert.equal(await page.evaluate(() => window.goodbot.belief()), believed);
  assert.equal(await page.textContent('#heard'), 'go to the red room');
  await page.click('#finish');
  await page.waitForFunction(() => window.goodbot.sessions() === 1 && document.body.dataset.phase === 'none');
  await reload(page);
  assert.ok(await page.isHidden('#finish'), 'a session that is over is over');
  await close(page);
});

test('a lesson under way survives a reload, and the tour goes on after it', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#good');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length === 1);
  await reload(page);
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#finish');
  await page.getByText('Lesson 2 of 7').waitFor();
  await close(page);
});

test('a tab, a setting and another robot ask before they end a session in which something was said', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await opened(page, 'Your robots');
  await opened(page, 'Settings, keeping, sharing');
  for (const leave of [() => page.click('[data-mode=tour]'), () => page.click('#set-pull'), () => page.click('#new-robot')]) {
    await begin(page, 'go to the red room');
    await leave();
    assert.match(await page.textContent('#ask'), /A session is under way: “go to the red room”/);
    await answer(page, 'stay');
    assert.ok(await page.isVisible('#finish'), 'the session goes on');
    await page.waitForFunction(() => !document.getElementById('set-pull').checked);
    await page.click('#drop');
  }
  await begin(page, 'go to the red room');
  await page.click('[data-mode=build]');
  await answer(page, 'learn');
  await page.waitForSelector('body[data-mode=build]');
  assert.equal(await sessions(page), 1);
  await close(page);
});

test('watching the tour leaves one’s own robot alone, and the shown one can be kept', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await teach(page, 'go to the red room');
  const own = await model(page);
  await page.click('[data-mode=tour]');
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  assert.equal(await sessions(page), 7);
  assert.match(await page.textContent('#guest'), /only shown/);
  await page.click('#end-guest');
  await page.waitForFunction(() => window.goodbot.sessions() === 1);
  assert.deepEqual(await model(page), own);
  assert.match(await page.textContent('#tour-title'), /Lesson 1/);
  await page.click('#watch');
  await page.waitForFunction(() => window.goodbot.sessions() >= 2);
  await reload(page);
  assert.deepEqual(await model(page), own, 'what was only shown is gone after a reload, and one’s own is there');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  await page.click('#keep-guest');
  await reload(page);
  assert.equal(await sessions(page), 7);
  await opened(page, 'Your robots');
  await page.click('[aria-label="Switch to Robot 1"]');
  await page.waitForFunction(() => window.goodbot.sessions() === 1);
  assert.deepEqual(await model(page), own);
  await close(page);
});

test('who watches can stop, and is never left with half a session', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'slow');
  await page.click('#watch');
  await page.getByText('Good or Bad?').or(page.getByText('You said')).first().waitFor();
  assert.ok(await page.isHidden('#drop') && await page.isHidden('#finish'));
  await page.click('#watch');
  await page.waitForFunction(() => !document.body.hasAttribute('data-session'));
  assert.equal(await page.textContent('#watch'), 'Watch the whole tour');
  assert.ok(await page.isHidden('#guest'));
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  await close(page);
});

test('beginning the tour again takes a new robot and keeps the old one', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await page.getByText('Lesson 2 of 7').waitFor();
  const old = await model(page);
  await page.click('#again');
  await page.getByText('Lesson 1 of 7').waitFor();
  assert.equal(await sessions(page), 0);
  await opened(page, 'Your robots');
  await page.click('[aria-label="Switch to Robot 1"]');
  await page.getByText('Lesson 2 of 7').waitFor();
  assert.deepEqual(await model(page), old);
  await close(page);
});

test('after the last test and a reload there is a home to go on in', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  await page.click('#keep-guest');
  await reload(page);
  assert.match(await page.textContent('#tour-title'), /The tour is over: 5 of 5/);
  await page.click('#onward');
  assert.ok(await page.locator('#plan .roomname').count() >= 3);
  const ideas = await page.locator('#ideas button').allTextContents();
  assert.equal(new Set(ideas).size, ideas.length);
  await close(page);
});

test('one’s own home outlives lessons, drafts that are none yet outlive a tab change, and both can be undone', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await page.click('[data-mode=build]');
  await page.click('#clear');
  await drag(page, 'room', [1, 1], [6, 6]);
  await drag(page, 'agent', [3, 3]);
  const own = await home(page);
  await play(page, 'D');
  const lesson = await home(page);
  await page.click('[data-mode=build]');
  assert.equal(await home(page), own, 'Build goes on with one’s own');
  await page.click('#take-shown');
  assert.equal(await home(page), lesson);
  await page.click('#build-undo');
  assert.equal(await home(page), own);
  await page.click('#clear');
  await page.click('[data-mode=play]');
  await page.selectOption('#home', 'own');
  assert.equal(await home(page), own, 'a draft that is no home yet does not replace the home');
  await page.click('[data-mode=build]');
  assert.match(await page.textContent('#build-error'), /Draw a room first/);
  await reload(page);
  await page.click('[data-mode=build]');
  assert.match(await page.textContent('#build-error'), /Draw a room first/, 'the draft is there after a reload');
  await page.locator('#build-title').click();
  await page.keyboard.press('Control+z');
  assert.match(await page.textContent('#build-error'), /This is a home/);
  assert.equal(await home(page), own);
  await page.click('#build-redo');
  assert.match(await page.textContent('#build-error'), /Draw a room first/);
  await close(page);
});

test('while a log is gone through, nothing else changes the robot', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await teach(page, 'go to the red room');
  const session = await log(page);
  await opened(page, 'Your robots');
  // The button is pressed as soon as the robot learns: the log is short.
  await page.evaluate(() => {
    const observer = new MutationObserver(() => {
      if (document.body.dataset.phase !== 'learning') return;
      observer.disconnect();
      document.getElementById('new-robot').click();
      document.querySelector('[data-mode=build]').click();
      document.body.dataset.pressed = 'yes';
    });
    observer.observe(document.body, { attributes: true });
  });
  await page.setInputFiles('#load-log', { name: 'long.jsonl', mimeType: 'application/jsonl', buffer: Buffer.from(session.repeat(120)) });
  await page.waitForSelector('body[data-pressed=yes]');
  await page.getByText('The robot has gone through the log').first().waitFor();
  const count = await sessions(page);
  assert.ok(count > 1);
  assert.equal(commands(await log(page)).length, 121);
  assert.equal(await page.locator('#robots li').count(), 1);
  await reload(page);
  assert.equal(await sessions(page), count);
  await close(page);
});

const FULL = () => {
  const { setItem } = Storage.prototype;
  Storage.prototype.setItem = function (key, value) {
    if (/goodbot\.log/.test(key)) throw new DOMException('full', 'QuotaExceededError');
    setItem.call(this, key, value);
  };
};

test('where storage is blocked, the page says so, and the log can be saved', async () => {
  const context = await browser.newContext({ acceptDownloads: true });
  const page = await openIn(context, '', BLOCKED);
  await opened(page, 'Settings, keeping, sharing');
  await page.uncheck('#set-questions');
  await play(page, 'A');
  await teach(page, 'go to the red room');
  assert.match(await page.textContent('#unkept'), /does not keep what the robot has learned, how it was taught/);
  assert.ok(await page.isVisible('#unkept'));
  assert.deepEqual(commands(await log(page)), ['go to the red room']);
  await page.click('#undo');
  await page.waitForFunction(() => window.goodbot.sessions() === 0);
  await close(page);
});

test('where only the log finds no room, the page says just that', async () => {
  const context = await browser.newContext({ acceptDownloads: true });
  const page = await openIn(context, '', FULL);
  await play(page, 'A');
  assert.ok(await page.isHidden('#unkept'));
  await teach(page, 'go to the red room');
  assert.match(await page.textContent('#unkept'), /does not keep how it was taught:/);
  assert.deepEqual(commands(await log(page)), ['go to the red room']);
  await close(page);
});

test('the skip link is no link to share, and an unknown setting stops nothing', async () => {
  const page = await open(browser, {}, '#main');
  await page.evaluate(() => localStorage.setItem('goodbot.settings', '{"speed":"warp","rule":7,"names":false}'));
  await reload(page);
  assert.ok(await page.isHidden('#toast'));
  assert.equal(await page.inputValue('#speed'), 'normal');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  await opened(page, 'Settings, keeping, sharing');
  assert.ok(!await page.isChecked('#set-names'), 'what is known of the settings counts');
  await close(page);
});

test('a link is taken once: what is changed after it outlives a reload', async () => {
  const page = await open(browser);
  await play(page, 'E');
  await opened(page, 'Settings, keeping, sharing');
  const { hash } = new URL(await linkOf(page, '#share'));
  const other = await open(browser, {}, hash);
  await other.selectOption('#speed', 'fast');
  await reload(other);
  assert.equal(await other.inputValue('#speed'), 'fast');
  await close(page);
  await close(other);
});
