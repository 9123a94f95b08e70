// The user's own tests: commands that the robot is never taught, and how many of them it understands.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, launch, model, open, opened, play, reload, saved, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function add(page, command, meant) {
  const count = await page.locator('#tests li').count();
  await page.fill('#test-command', command);
  await page.selectOption('#test-meant', { label: meant });
  await page.click('#test-it');
  await page.waitForFunction(wanted => document.querySelectorAll('#tests li').length === wanted, count + 1);
}

// One lesson, in which the trainer picks the meaning.
async function teach(page, command, meant = command) {
  const count = await sessions(page);
  await page.fill('#command', command);
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.selectOption('#pick', { label: meant });
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#finish');
  await page.waitForFunction(before => window.goodbot.sessions() > before && document.body.dataset.phase === 'none', count);
  await page.click('#reset');
}

async function verdicts(page) {
  await page.click('#run-tests');
  await page.waitForFunction(() => document.querySelectorAll('#tests li').length === document.querySelectorAll('#tests li p').length);
  return [await page.textContent('#tests-score'), ...await page.locator('#tests li p').allTextContents()];
}

async function begin() {
  const page = await open(browser, { viewport: { width: 1280, height: 1400 } });
  await page.selectOption('#speed', 'step');
  await play(page, 'A');
  await opened(page, 'Tests of your own');
  return page;
}

test('commands of one’s own show at any time what the robot understands, and teach it nothing', async () => {
  const page = await begin();
  assert.equal(await page.isVisible('#run-tests'), false, 'there is nothing to test at first');
  await add(page, 'go to the green room', 'go to the green room');
  await add(page, 'march to the red room', 'go to the red room');
  await add(page, 'march to the green room', 'go to the red room');
  const [score, ...before] = await verdicts(page);
  assert.equal(score, '0 of 3 tests understood');
  assert.match(before.join('\n'), /Test 1: (a lucky guess|not understood)/);
  assert.equal(await sessions(page), 0);
  for (let round = 0; round < 2; round += 1) for (const color of ['green', 'red']) await teach(page, 'go to the ' + color + ' room');
  assert.equal(await page.locator('#tests li p').count(), 0, 'what was understood before is no answer any more');
  const known = await model(page);
  const scene = await page.evaluate(() => window.goodbot.scene());
  const after = await verdicts(page);
  assert.equal(after[0], '2 of 3 tests understood');
  assert.match(after[1], /Test 1: understood\. ★ It thought “go to the green room”, and was \d+\s?% sure\./);
  assert.match(after[3], /Test 3: not understood\. It thought “go to the green room” \(\d+\s?% sure\)\./);
  assert.deepEqual(await model(page), known);
  assert.equal(await page.evaluate(() => window.goodbot.scene()), scene);
  await reload(page);
  await play(page, 'D');
  await opened(page, 'Tests of your own');
  assert.equal((await verdicts(page))[0], '2 of 3 tests understood', 'each in its own home');
  await page.click('[aria-label="Delete march to the green room"]');
  await page.waitForFunction(() => document.querySelectorAll('#tests li').length === 2);
  assert.equal(await page.inputValue('#test-command'), 'march to the green room', 'what is taken off the list can be put on it again');
  // The robot's table has what was asked, and when: before the first lesson, and after the last, twice.
  await opened(page, 'Charts');
  const lines = String(await saved(page, '#save-table')).trim().split('\r\n');
  assert.deepEqual(lines.map((line, at) => [/,test,/.test(line), at]).filter(([isTest]) => isTest).map(([, at]) => at), [1, 2, 3, ...Array.from({ length: 6 }, (_, at) => lines.length - 6 + at)]);
  assert.match(lines[3], /^3,test,march to the green room,A,"agentInRoom\(agent0,room\d\)",0\.\d+,/);
  await opened(page, 'Your robots');
  await page.click('#new-robot');
  await page.getByText('A new robot, ').first().waitFor();
  await opened(page, 'Tests of your own');
  assert.equal(await page.locator('#tests li').count(), 0, 'they belong to their robot');
  await close(page);
});

test('while a session is under way nothing is tested', async () => {
  const page = await begin();
  await add(page, 'go to the green room', 'go to the green room');
  await page.fill('#command', 'go to the red room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  const log = await page.evaluate(() => window.goodbot.log());
  assert.ok(await page.isDisabled('#run-tests') && await page.isDisabled('#test-it'));
  assert.equal(await page.evaluate(() => window.goodbot.log()), log);
  await page.click('#drop');
  assert.ok(await page.isEnabled('#run-tests'));
  await close(page);
});

test('tests go to a file and come from one, and what is none is refused with its line', async () => {
  const page = await begin();
  await add(page, 'go to the green room', 'go to the green room');
  await play(page, 'D');
  await add(page, 'bring the chair', 'take the blue chair to the yellow room');
  const file = await saved(page, '#save-tests');
  await opened(page, 'Your robots');
  await page.click('#new-robot');
  await page.getByText('A new robot, ').first().waitFor();
  const load = buffer => page.setInputFiles('#load-tests', { name: 'tests.jsonl', mimeType: 'application/jsonl', buffer });
  await load(Buffer.from(file.toString().replace('"intended":["blockInRoom', '"intended":["blockUnderRoom')));
  await page.getByText('line 3 of this log cannot be used: blockUnderRoom').first().waitFor();
  await load(Buffer.from('\x89PNG'));
  await page.getByText('line 1 of this log cannot be used: it is not from a session log').first().waitFor();
  await load(Buffer.from('{"type":"end","learn":true}\n'));
  await page.getByText('there is no session in this log').first().waitFor();
  await opened(page, 'Tests of your own');
  assert.equal(await page.locator('#tests li').count(), 0);
  await load(file);
  await page.waitForFunction(() => document.querySelectorAll('#tests li').length === 2);
  assert.deepEqual(await saved(page, '#save-tests'), file);
  assert.match(await page.locator('#tests li').last().innerText(), /bring the chair[^]*take the blue chair to the yellow room/);
  await close(page);
});

const program = process.env.GOODBOT_CLI;

test('the command line finds right what the page says is understood', { skip: program ? false : 'GOODBOT_CLI is not set' }, async () => {
  const page = await begin();
  for (const color of ['green', 'red', 'green']) await teach(page, 'go to the ' + color + ' room');
  await page.click('#reset');
  await opened(page, 'Settings, keeping, sharing');
  await page.check('#set-ways');
  await page.waitForFunction(() => window.goodbot.ways() && document.body.dataset.phase === 'none');
  await add(page, 'go to the green room', 'go to the green room');
  await add(page, 'go to the red room', 'go to the red room');
  await add(page, 'go to the red room', 'go to the green room');
  await add(page, 'go to the red room, and keep out of the green one', 'go to the red room, but not through the green room');
  const folder = mkdtempSync(join(tmpdir(), 'goodbot-tests-'));
  const file = (name, content) => (writeFileSync(join(folder, name), content), join(folder, name));
  const [of, tests] = [file('robot.goodbot', await saved(page, '#save-model')), file('tests.jsonl', await saved(page, '#save-tests'))];
  const lines = execFileSync(program, ['evaluate', '--routes', '--json', '--with', of, '--test', tests], { encoding: 'utf8' }).trim().split('\n').map(line => JSON.parse(line));
  const [score, ...said] = await verdicts(page);
  const answers = lines.filter(line => line.type === 'answer');
  assert.deepEqual(said.map(verdict => [/: understood/.test(verdict), verdict.match(/(\d+)\s?% sure/)[1]]),
    answers.map(({ right, probability_predicted: sure }) => [right && sure > 0.5, String(Math.round(100 * sure))]));
  assert.equal(score, '2 of 4 tests understood');
  assert.ok(answers[3].expected.includes(' avoiding '));
  rmSync(folder, { recursive: true });
  await close(page);
});
