// What the page says is true and plain.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, drag, launch, open, opened, pass, play, sessions, stopTime } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function tell(page, command) {
  await page.selectOption('#speed', 'step');
  await page.fill('#command', command);
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
}

// A robot that has watched the whole tour.
async function trained(page) {
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  await page.click('#keep-guest');
  await page.getByText('is kept, under').first().waitFor();
}

test('what is suggested can be done and is not done yet, in every home', async () => {
  const page = await open(browser);
  for (const home of ['A', 'B', 'C', 'D', 'E', 'F', 'Test']) {
    await play(page, home);
    await page.locator('#ideas button').nth(1).waitFor();
    const ideas = await page.locator('#ideas button').allTextContents();
    assert.ok(ideas.length >= 2, home + ': ' + ideas);
    const here = await page.evaluate(() => {
      const { agent, rooms } = JSON.parse(window.goodbot.scene());
      return rooms.find(room => agent.x > room.left && agent.x < room.right && agent.y > room.bottom && agent.y < room.top).color;
    });
    assert.ok(!ideas.includes('go to the ' + here + ' room'), home + ': the robot is in the ' + here + ' room already');
    assert.equal(new Set(ideas).size, ideas.length);
  }
  await page.locator('#ideas button').first().click();
  await page.getByText('Good or Bad?').waitFor();
  await close(page);
});

test('what is done already is answered with “That is done already”', async () => {
  const page = await open(browser);
  await trained(page);
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'go to the blue room');
  await page.click('#say-it');
  await page.getByText('That is done already: go to the blue room. Was that it, or did you mean something else?').first().waitFor();
  assert.equal(await page.locator('#steps tr').count(), 0, 'there is nothing to do');
  await close(page);
});

test('unknown words are underlined and named, in any script', async () => {
  const page = await open(browser);
  await trained(page);
  await play(page, 'A');
  await tell(page, 'go to the coffee room');
  assert.match(await page.textContent('#say'), /I do not know “coffee”/);
  assert.deepEqual(await page.locator('#heard u').allTextContents(), ['coffee']);
  assert.match(await page.textContent('#heard'), /go to the coffee room/);
  await page.click('#drop');
  const sentence = '请你现在马上走到最里面那个绿色的大房间里去吧';
  await tell(page, sentence);
  // The robot takes each sign for a word, whatever a dictionary says.
  const underlined = async () => (await page.locator('#heard u').allTextContents()).join('');
  assert.equal(await underlined(), sentence);
  await page.click('#finish');
  await page.waitForFunction(() => window.goodbot.sessions() === 8 && document.body.dataset.phase === 'none');
  await tell(page, '走到绿色的房间');
  assert.equal(await underlined(), '', 'what was said before is known');
  await page.click('#drop');
  await tell(page, '走到绿色的浴室');
  assert.equal(await underlined(), '浴室');
  assert.match(await page.textContent('#say'), /I do not know “浴”, “室”/);
  assert.equal(await page.textContent('#heard'), '走到绿色的浴室');
  await close(page);
});

test('a robot that knows nothing does not say so of each word', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await tell(page, 'go to the red room');
  assert.equal(await page.locator('#heard u').count(), 0);
  await close(page);
});

test('there is one number of certainty, and it says for what', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await tell(page, 'go to the red room');
  assert.match(await page.textContent('#say'), /\d+\s?% sure of it/);
  assert.match(await page.textContent('#to'), /^It (moved (up|down|left|right)|stayed where it was)\. Good or Bad\?$/, 'and no child needs to know where north is');
  assert.ok(!/%/.test(await page.textContent('#sure')), 'and no second one beside it');
  await close(page);
});

test('a star is earned by a word and a clear guess', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#finish');
  await page.getByText('Lesson 2 of 7').waitFor();
  assert.match(await page.locator('#dots button').first().textContent(), /✓/);
  assert.match(await page.textContent('#verdict'), /Lesson 1: learned/);
  await close(page);
});

test('a test ends with a verdict that stays, and the next step beside it', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  for (let lesson = 1; lesson <= 7; lesson += 1) {
    await page.click('#auto');
    await page.getByText(lesson < 7 ? 'Lesson ' + (lesson + 1) + ' of 7' : 'Test 1 of 5').first().waitFor();
  }
  await page.click('#lesson');
  await page.getByText('Test 2 of 5').first().waitFor();
  await stopTime(page);
  await pass(page, 10000);
  assert.match(await page.textContent('#verdict'), /Test 1: (understood|a lucky guess|not understood).*sure/);
  assert.ok(await page.isVisible('#lesson'));
  await close(page);
});

test('a guess that is right by luck does not count, and the page says so', async () => {
  const page = await open(browser);
  await page.locator('#dots button').nth(7).click();
  await page.selectOption('#speed', 'once');
  for (let at = 1; at <= 5; at += 1) {
    await page.click('#lesson');
    await page.waitForFunction(done => document.querySelectorAll('#dots .right, #dots .wrong').length === done, at);
    assert.match(await page.textContent('#verdict'), /a lucky guess.*does not count|not understood/);
  }
  assert.match(await page.textContent('#tour-title'), /0 of 5 tests understood/);
  await close(page);
});

test('a word can be taken back, by the same button or by a key', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await tell(page, 'go to the red room');
  await page.click('#pause');
  await stopTime(page);
  await page.click('#good');
  await page.click('#good');
  assert.equal(await page.getAttribute('#good', 'aria-pressed'), 'true', 'a double tap is one word');
  await pass(page, 700);
  await page.click('#good');
  assert.equal(await page.getAttribute('#good', 'aria-pressed'), 'false');
  await page.keyboard.press('B');
  assert.equal(await page.getAttribute('#bad', 'aria-pressed'), 'true', 'Caps Lock does not matter');
  await page.keyboard.press('Backspace');
  assert.equal(await page.getAttribute('#bad', 'aria-pressed'), 'false');
  await page.click('#next');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length === 1);
  assert.match(await page.textContent('#steps tr'), /—/);
  await close(page);
});

test('a text map refuses signs that it does not know, and rooms of two colours', async () => {
  const page = await open(browser);
  await page.click('[data-mode=build]');
  for (const [drawing, said] of [
    [['#####', '#r*@#', '#####'], /“\*” \(line 2, column 3\) is no sign of a map/],
    [['#####', '#rz@#', '#####'], /one room has two colours, r and z/],
    [['#####', '#rg@#', '#####'], /one room has two colours, r and g/],
    [['#####', '#@r@#', '#####'], /there is a second @/],
    [['{"version":1,'], /a bracket, a quote or a comma/],
    [['{"version":1,"objects":[{"class":"room"}]}'], /something in it is missing, misspelt/],
  ]) {
    await page.fill('#home-text', drawing.join('\n'));
    await page.click('#import');
    await page.waitForFunction(() => /This text is no home/.test(document.getElementById('toast').textContent));
    assert.match(await page.textContent('#toast'), said);
    await page.evaluate(() => { document.getElementById('toast').textContent = ''; });
  }
  await close(page);
});

test('a room that is moved takes its doors along and what stands in it, and rooms without a way in are named', async () => {
  const page = await open(browser);
  await page.click('[data-mode=build]');
  await page.fill('#home-text', ['#####', '#rrr#', '#rBr#', '##+##', '#g@g#', '#ggg#', '#####', ''].join('\n'));
  await page.click('#import');
  await page.getByText('This is a home. The robot is in it.').waitFor();
  const objects = () => page.evaluate(() => Object.fromEntries(JSON.parse(localStorage['goodbot.drawing']).file.objects.map(object => [object.class + (object.color || ''), object])));
  const before_ = await objects();
  await drag(page, 'move', [2, 2], [4, 2]);
  const after_ = await objects();
  for (const [name, field] of [['roomred', 'left'], ['door', 'left'], ['blockyellow', 'x']]) assert.equal(after_[name][field] - before_[name][field], 2, name);
  assert.equal(after_.agent.x, before_.agent.x);
  await page.click('#build-undo');
  await page.getByText('door0').click();
  await page.locator('#objects details[open] button', { hasText: 'Remove' }).click();
  assert.match(await page.textContent('#build-error'), /cannot get into the red room/);
  await close(page);
});

test('the ending shows two commands that only feedback could tell, and says why', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  const only = page.locator('#only');
  assert.match(await only.textContent(), /Only your words could tell these: in the lessons more than one thing could be meant/);
  const rows = await only.locator('tr:has(td)').evaluateAll(all => all.map(row => [...row.cells].slice(1).map(cell => parseInt(cell.textContent, 10))));
  assert.equal(rows.length, 2);
  for (const [taught, silent] of rows) assert.ok(taught > 50 && silent <= 55, JSON.stringify(rows));
  await close(page);
});
