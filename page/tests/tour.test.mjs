// The tour tells the truth about its lessons and tests.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, linkOf, open, opened, saved, sessions, toTheGoal } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function silentLessons(page) {
  for (let lesson = 1; lesson <= 7; lesson += 1) {
    await page.click('#lesson');
    await page.getByText('Good or Bad?').waitFor();
    await page.click('#finish');
    await page.getByText(lesson < 7 ? 'Lesson ' + (lesson + 1) + ' of 7' : 'Test 1 of 5').first().waitFor();
  }
}

// Begins a test, and skips the robot's walk.
async function ask(page, at) {
  await page.click('#lesson');
  await page.getByText('Skip the walk').waitFor();
  await page.click('#lesson');
  await page.waitForFunction(done => document.querySelectorAll('#dots .test.right, #dots .test.wrong').length === done, at);
}

test('a test says whether its command was taught: three of five repeat a lesson in another home', async () => {
  const page = await open(browser);
  assert.match(await page.textContent('#say'), /know no word/);
  await page.locator('#dots button').nth(9).click();
  assert.match(await page.textContent('#tour-hint'), /never heard this command/, 'a robot that was taught nothing');
  await page.locator('#dots button').first().click();
  await silentLessons(page);
  const hints = [];
  for (let at = 1; at <= 5; at += 1) {
    hints.push(await page.textContent('#tour-hint'));
    await ask(page, at);
  }
  for (const hint of hints.slice(0, 2)) assert.match(hint, /It has never heard this command/);
  for (const hint of hints.slice(2)) assert.match(hint, /It was taught this command/);
  await close(page);
});

test('a robot from a model file, whose lessons nobody knows here, is not said to have heard nothing', async () => {
  const page = await open(browser);
  await page.click('#auto');
  await page.getByText('Lesson 2 of 7').waitFor();
  await opened(page, 'Settings, keeping, sharing');
  const model = await saved(page, '#save-model');
  await page.setInputFiles('#load-model', { name: 'other.goodbot', mimeType: 'application/octet-stream', buffer: model });
  await page.getByText('A new robot from the file').first().waitFor();
  await page.locator('#dots button').nth(7).click();
  assert.match(await page.textContent('#tour-hint'), /^It gets no feedback now: does it understand\?$/);
  await close(page);
});

test('“Finish and learn” is outlined until something was said', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  const filled = () => page.evaluate(() => {
    const color = id => getComputedStyle(document.getElementById(id)).backgroundColor;
    return color('finish') !== color('pause');
  });
  assert.equal(await filled(), false);
  await page.click('#pause');
  await page.click('#bad');
  await page.mouse.move(0, 0);
  assert.equal(await filled(), true);
  await close(page);
});

test('“50 % sure” is not understood, and who said nothing is told so at the end, with one figure for each test', async () => {
  const page = await open(browser);
  await silentLessons(page);
  const verdicts = [];
  for (let at = 1; at <= 5; at += 1) {
    await ask(page, at);
    verdicts.push(await page.textContent('#verdict'));
  }
  for (const verdict of verdicts) {
    const sure = Number(verdict.match(/(\d+)% sure/)[1]);
    assert.equal(/: understood/.test(verdict), sure > 50 && !/not understood/.test(verdict), verdict);
  }
  const table = page.locator('#tour table');
  assert.ok(await table.isVisible(), 'nobody has to unfold it');
  assert.match(await page.textContent('#tour'), /You said neither Good nor Bad/);
  const rows = await table.locator('tbody tr').evaluateAll(all => all.map(row => [...row.cells].slice(1).map(cell => cell.textContent)));
  assert.deepEqual(rows.map(row => row.length), [1, 1, 1, 1, 1]);
  assert.doesNotMatch(await table.locator('thead').textContent(), /with you/);
  for (const [language, told] of [['de', /weder Gut noch Schlecht/], ['es', /ni Bien ni Mal/], ['fr', /ni Bien ni Mal/], ['zh', /没有说过好/]]) {
    await page.selectOption('#language', language);
    assert.match(await page.textContent('#tour'), told);
  }
  await close(page);
});

test('a test asks nothing that nobody can answer, and says from the beginning that it takes no feedback', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#dots li:nth-child(8) button');
  await page.evaluate(() => {
    const said = [];
    const look = () => { if (document.body.hasAttribute('data-session')) said.push(document.getElementById('to').textContent, document.getElementById('say').textContent); };
    new MutationObserver(look).observe(document.body, { subtree: true, childList: true });
    Object.assign(window, { said });
  });
  await page.click('#lesson');
  await page.locator('#verdict:visible').waitFor();
  await page.waitForFunction(() => !document.body.hasAttribute('data-session'));
  const said = await page.evaluate(() => window.said);
  assert.ok(said.includes('A test: no feedback.'));
  assert.ok(said.some(text => /^(I am in|Done)/.test(text)), said.join(' '));
  assert.deepEqual(said.filter(text => /Was that it|Your word goes/.test(text)), []);
  await close(page);
});

test('what feedback was worth is seen at the end, and all steps are a table with one click', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  assert.equal((await page.textContent('#say')).trim(), 'Thank you.', 'a robot that is only shown has no name of its own');
  const worth = page.locator('#tour table');
  assert.ok(await worth.isVisible(), 'nobody has to unfold it');
  assert.match(await worth.locator('thead').textContent(), /with you.*without a word/);
  const rows = await worth.locator('tbody tr:has(td)').evaluateAll(all => all.map(row => [...row.cells].slice(1).map(cell => parseInt(cell.textContent, 10))));
  const sum = column => rows.reduce((total, row) => total + row[column], 0);
  assert.ok(sum(0) > sum(1), JSON.stringify(rows));
  const table = (await saved(page, '#tour-table')).toString().trim().split('\r\n');
  assert.equal(table[0], 'session,kind,command,home,meant,heard,understood,right,guess,step,action,feedback,robot,seed,version,citation,condition,consent');
  assert.equal(new Set(table.filter(line => /^\d+,lesson,/.test(line)).map(line => parseInt(line, 10))).size, 7, 'all seven lessons');
  assert.match(table.at(-1), /^12,test,/, 'and five tests');
  await close(page);
});

test('yes in the wrong room is not “learned”: the page says what went wrong, and offers to undo it', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await toTheGoal(page, /red/, good => page.click(good ? '#good' : '#bad'));
  assert.match(await page.textContent('#say'), /I am in the red room/);
  await page.click('#finish');
  await page.getByText('Lesson 2 of 7').waitFor();
  assert.match(await page.textContent('#verdict'), /went wrong.*“go to the green room” for “go to the red room”/);
  assert.match(await page.locator('#dots button').first().textContent(), /✗/);
  await page.click('#amend');
  await page.getByText('Lesson 1 of 7').waitFor();
  assert.equal(await sessions(page), 0);
  assert.ok(await page.isHidden('#amend'));
  await close(page);
});

test('a test tells its verdict at once, believes the same all the way, and its walk can be skipped', async () => {
  const page = await open(browser);
  await page.locator('#dots button').nth(7).click();
  // A robot that knows nothing finds all tasks equally likely: silence must not make it turn around.
  await page.click('#lesson');
  await page.getByText('Skip the walk').waitFor();
  assert.match(await page.textContent('#verdict'), /Test 1: (understood|a lucky guess|not understood).*% sure/);
  const belief = () => page.evaluate(() => JSON.parse(window.goodbot.belief()).tasks.map(task => task.probability).join());
  const first = await belief();
  const began = Date.now();
  const seen = new Set([first]);
  while (Date.now() - began < 2500 && await page.isVisible('text=Skip the walk')) {
    const now = await belief();
    if (now) seen.add(now);
    await page.waitForTimeout(60);
  }
  assert.equal(seen.size, 1, 'silence is no evidence in a test');
  if (await page.isVisible('text=Skip the walk')) await page.click('#lesson');
  await page.getByText('Test 2 of 5').first().waitFor();
  assert.match(await page.textContent('#verdict'), /Test 1: /);
  await close(page);
});

test('the table has every session, also those that were ended at their first step', async () => {
  const page = await open(browser);
  await silentLessons(page);
  await opened(page, 'Charts');
  const lines = String(await saved(page, '#save-table')).trim().split('\r\n');
  assert.equal(lines.length, 8);
  assert.match(lines[1], /^1,lesson,go to the green room,A,"agentInRoom\(agent0,room\d\)",0\.\d+,,,,,,,Robot 1,2014,goodbot /);
  await close(page);
});

test('“the” stands in every command and means nothing, in the secret language neither', async () => {
  const page = await open(browser);
  // A trainer who answers each question: first a thing, then a room.
  const log = await page.evaluate(() => {
    const Robot = window.goodbot.constructor;
    const course = JSON.parse(Robot.course(0));
    const robot = new Robot(1);
    const lessons = ['E go to the blue room', 'A go to the red room', 'Test go to the blue room', 'C go to the yellow room', 'E take the purple bag to the blue room', 'C go to the yellow room',
      'E take the purple bag to the red room', 'D take the blue chair to the green room'];
    return lessons.map(each => course.teachable.find(({ home, command }) => each === home + ' ' + command)).map(lesson => {
      robot.setEnvironment(JSON.stringify(course.homes.find(([name]) => name === lesson.home)[1]));
      robot.hear(lesson.command);
      while (!robot.plan(20000));
      for (let answers = 0; answers < 2; answers += 1) robot.answerAs(lesson.intended, true, 0.05, 5, '');
      const lines = robot.finish();
      while (!robot.learn(60000));
      return lines;
    }).join('');
  });
  await opened(page, 'Settings, keeping, sharing');
  await page.setInputFiles('#load-log', { name: 'answers.jsonl', mimeType: 'application/jsonl', buffer: Buffer.from(log) });
  await page.getByText('The robot has gone through the log').first().waitFor();
  await opened(page, 'Your robots');
  const { hash } = new URL(await linkOf(page, '#meet-secret'));
  const other = await open(browser, {}, hash);
  const words = await other.locator('#secret-words button').allTextContents();
  assert.ok(words.includes('take') && words.includes('blue'), String(words));
  assert.ok(!words.includes('the'), String(words));
  await close(page);
  await close(other);
});
