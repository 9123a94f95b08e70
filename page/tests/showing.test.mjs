// The page shows the robot's thoughts.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, open, opened, play, reload, saved } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function lesson(page, number) {
  await page.click('#auto');
  await learned(page, number);
}

async function trained(page) {
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  await page.click('#keep-guest');
  await page.getByText('is kept, under').first().waitFor();
}

async function tell(page, command) {
  await page.selectOption('#speed', 'step');
  await page.fill('#command', command);
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
}

test('the bars are sorted, sum to a hundred, are marked by each step’s evidence, and become charts and a table', async () => {
  const page = await open(browser);
  await play(page, 'D');
  await tell(page, 'take the chair away');
  await page.click('#bad');
  await page.locator('#steps tr').first().waitFor({ state: 'attached' });
  const values = (await page.locator('#bars .value').allTextContents()).map(text => parseInt(text.replace(/\D/g, ''), 10));
  assert.deepEqual(values, [...values].sort((a, b) => b - a));
  assert.ok(Math.abs(values.reduce((a, b) => a + b) - 100) <= values.length, values.join());
  assert.ok(await page.locator('#bars .marks i').count() >= values.length);
  assert.match((await page.locator('#bars .marks').allTextContents()).join(''), /▲|▼/);
  await opened(page, 'Charts');
  assert.equal(await page.locator('#chart-tasks li').count(), 3);
  assert.match(await page.getAttribute('#chart-belief .line0', 'd'), /^M[\d.]+ [\d.]+L/, 'from before the first step to after it');
  const best = (await page.locator('#chart-tasks li').first().textContent());
  assert.match(best, /\d/);
  const start = await page.evaluate(() => JSON.parse(window.goodbot.log().split('\n')[0]).command);
  await page.click('#finish');
  await learned(page, 1);
  assert.match(await page.getAttribute('#chart-score', 'aria-label'), /: \d+%$/);
  const table = (await saved(page, '#save-table')).toString().trim().split('\r\n');
  assert.equal(table[0], 'session,kind,command,home,meant,heard,understood,right,guess,step,action,feedback,robot,seed,version,citation,condition,consent');
  assert.match(table[1], new RegExp('^1,lesson,' + start + ',\\w*,"?[^"]*"?,0\\.\\d+,,,,1,(north|south|east|west|noop),punish,Robot 1,2014,goodbot '));
  await close(page);
});

test('words are shown whole, in the dictionary and in a command', async () => {
  const page = await open(browser);
  await trained(page);
  await opened(page, 'Its dictionary');
  const words = await page.locator('#heat thead th').allTextContents();
  for (const word of ['green', 'yellow', 'purple', 'chair']) assert.ok(words.includes(word), word + ' is not among ' + words);
  assert.ok(!words.some(word => word.includes('…')), 'no word is cut: ' + words);
  await reload(page);
  await opened(page, 'Its dictionary');
  assert.deepEqual(await page.locator('#heat thead th').allTextContents(), words, 'after a reload too');
  await play(page, 'Test');
  await tell(page, 'Please , take the purplish chairs to the green room');
  assert.deepEqual(await page.locator('#support thead th').allTextContents(), ['task', 'please', 'take', 'the', 'purple', 'chairs', 'to', 'the', 'green', 'room']);
  const rows = await page.locator('#support tbody tr').allTextContents();
  assert.match(rows[0], /purple chair to the green room/);
  await close(page);
});

test('the dictionary can be seen as it was before the last session', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await lesson(page, 1);
  await opened(page, 'Its dictionary');
  assert.ok(await page.isDisabled('#heat-before'), 'before the first session there was none');
  const first = await page.locator('#heat').innerText();
  await lesson(page, 2);
  const second = await page.locator('#heat').innerText();
  assert.notEqual(second, first);
  await page.check('#heat-before');
  assert.equal(await page.locator('#heat').innerText(), first);
  await close(page);
});

test('a ghost stands where the robot is heading, unless it is switched off', async () => {
  const page = await open(browser);
  await play(page, 'D');
  await tell(page, 'take the blue chair to the yellow room');
  await page.waitForSelector('.ghost', { state: 'attached' });
  assert.ok(await page.locator('.ghost').count() >= 1);
  assert.ok((await page.getAttribute('.prints', 'd')).length > 0);
  const best = await page.textContent('#bars .best .label');
  const color = best.match(/(\w+) room/)[1];
  const inside = await page.evaluate(name => {
    const cells = [...document.querySelectorAll('.ghost')].map(ghost => ghost.style.transform.match(/[\d.]+/g).map(Number));
    const { bounds, rooms } = JSON.parse(window.goodbot.scene());
    const room = rooms.find(one => one.color === name);
    return cells.map(([x, y]) => [bounds.left + x / 48 - 0.5, bounds.top - y / 48 + 0.5]).some(([x, y]) => x > room.left && x < room.right && y > room.bottom && y < room.top);
  }, color);
  assert.ok(inside, 'no ghost is in the ' + color + ' room');
  await opened(page, 'Settings, keeping, sharing');
  await page.uncheck('#set-ghost');
  assert.equal(await page.locator('.ghost').count(), 0);
  await close(page);
});

test('a robot that learns its trainer’s style shows what it believes of it', async () => {
  const page = await open(browser);
  await opened(page, 'Settings, keeping, sharing');
  assert.equal(await page.inputValue('#believes'), 'population', 'it expects real people');
  await page.selectOption('#speed', 'step');
  await play(page, 'A');
  await tell(page, 'go to the red room');
  await opened(page, 'You as a trainer');
  const before = await page.locator('#style .value').allTextContents();
  assert.equal(before.length, 4);
  for (let step = 1; step <= 6; step += 1) {
    await page.click('#bad');
    await page.waitForFunction(count => document.querySelectorAll('#steps tr').length >= count, step);
    await page.getByText('Good or Bad?').waitFor();
  }
  const now = await page.locator('#style .value').allTextContents();
  assert.ok(parseFloat(now[1]) > parseFloat(before[1]), 'who says Bad six times says more than others: ' + now + ', before ' + before);
  await page.click('#drop');
  await page.selectOption('#believes', 'punish-only');
  await page.waitForFunction(() => /does not learn your style/.test(document.getElementById('style-about').textContent));
  assert.deepEqual((await page.locator('#style .value').allTextContents()).map(parseFloat), [30, 95, 10, 0]);
  await close(page);
});

test('colours are named, not only shown, and names on things can be switched off', async () => {
  const page = await open(browser);
  await play(page, 'D');
  assert.deepEqual((await page.locator('#plan .roomname').allTextContents()).sort(), ['green room', 'red room', 'yellow room']);
  assert.deepEqual(await page.locator('#plan .blockname').allTextContents(), ['blue chair']);
  await opened(page, 'Settings, keeping, sharing');
  await page.getByText('The floor plan in words').click();
  assert.match(await page.textContent('#twin'), /At column \d+, row \d+, in the \w+ room: the blue chair/);
  await opened(page, 'Settings, keeping, sharing');
  await page.uncheck('#set-names');
  assert.equal(await page.locator('#plan .blockname').count(), 0);
  assert.equal(await page.locator('#plan .roomname').count(), 3);
  await close(page);
});

test('a robot that pulls takes a bag out of a corner', async () => {
  const page = await open(browser);
  await opened(page, 'Settings, keeping, sharing');
  await page.click('[data-mode=build]');
  const home = ['#######', '#B....#', '#.@...#', '#.....#', '###+###', '#ggggg#', '#ggggg#', '#######', ''].join('\n');
  await page.fill('#home-text', home);
  await page.click('#import');
  await page.getByText('The home is taken over').first().waitFor();
  await page.click('[data-mode=play]');
  const plans = async () => {
    await page.selectOption('#speed', 'step');
    await tell(page, 'take the bag to the green room');
    const words = await page.locator('#bars .label').allTextContents();
    await page.click('#drop');
    return page.evaluate(() => {
      const { goodbot } = window;
      goodbot.reset();
      goodbot.hear('take the bag');
      while (!goodbot.plan(1e6));
      const { plans } = JSON.parse(goodbot.act());
      const { tasks } = JSON.parse(goodbot.belief());
      goodbot.reset();
      return plans[tasks.findIndex(task => /bag|block/.test(task.name))];
    }).then(plan => [plan, words.length]);
  };
  assert.equal((await plans())[0], 'dead end', 'by pushing alone, it stays in its corner');
  await page.check('#set-pull');
  assert.equal((await plans())[0], 'toward');
  await close(page);
});
