// The strategies that the robot expects of its trainer, by the names and numbers that the command line takes.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, launch, open, opened, play, reload, saved } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// The numbers of the strategies; none if the robot expects real people.
const expected = page => page.evaluate(() => [...window.goodbot.strategies()].map(number => Number(number.toFixed(3))));
const settings = page => opened(page, 'Settings, keeping, sharing');

// Enters the user's own numbers.
async function own(page, text) {
  await page.selectOption('#believes', 'own');
  await page.fill('#strategies', text);
  await page.keyboard.press('Enter');
}

test('what the robot expects of its trainer can be chosen, outlives a reload, and can be undone', async () => {
  const page = await open(browser);
  await settings(page);
  assert.equal(await page.inputValue('#believes'), 'population');
  assert.equal(await page.isVisible('#strategies'), false);
  for (const [name, numbers] of [['balanced', [0.7, 0.7, 0.1]], ['reward-only', [0.05, 0.7, 0.1]], ['punish-only', [0.7, 0.05, 0.1]]]) {
    await page.selectOption('#believes', name);
    await page.waitForFunction(wanted => [...window.goodbot.strategies()][1]?.toFixed(2) === wanted, numbers[1].toFixed(2));
    assert.deepEqual(await expected(page), [...numbers, 1, 1, 0, 0, ...numbers, 0], 'no word is late, and rests are judged as moves');
  }
  await reload(page);
  await settings(page);
  assert.equal(await page.inputValue('#believes'), 'punish-only');
  await opened(page, 'Your robots');
  await page.click('#new-robot');
  await page.getByText('A new robot, ').first().waitFor();
  assert.equal(await page.inputValue('#believes'), 'punish-only', 'a new robot expects what the one before expected');
  await page.selectOption('#believes', 'population');
  await page.waitForFunction(() => window.goodbot.strategies().length === 0);
  await page.click('#undo');
  await page.waitForFunction(() => window.goodbot.strategies().length === 11);
  assert.equal(await page.inputValue('#believes'), 'punish-only');
  await close(page);
});

test('numbers may be late, and several, each with its weight; what is none is refused with the reason', async () => {
  const page = await open(browser);
  await settings(page);
  const late = [0.9, 0.85, 0.2, 1, 0.8, 0.15, 0.05, 0.9, 0.85, 0.2, 0];
  await own(page, '0.9,0.85,0.2,0.8,0.15,0.05');
  await page.waitForFunction(() => window.goodbot.strategies().length === 11);
  assert.deepEqual(await expected(page), late);
  for (const [text, why] of [['0.7,1.7,0.1', 'mu- must be a number from 0 to 1'], ['0.7,,0.1', 'mu- must be a number'], ['0.7,0.7', 'mu+, mu−, epsilon'], ['kind', 'mu+, mu−, epsilon'], ['balanced*-1; punish-only', 'the probability of strategy 0 is']]) {
    await own(page, text);
    await page.locator('#toast.wrong', { hasText: why }).waitFor();
    assert.deepEqual(await expected(page), late, text);
    await page.evaluate(() => { document.getElementById('toast').hidden = true; });
  }
  await own(page, '0.9,0.85,0.2,1,0,0,0.5,0.95,0.1,1');
  await page.waitForFunction(() => window.goodbot.strategies().at(-1) === 1);
  assert.deepEqual((await expected(page)).slice(-4), [0.5, 0.95, 0.1, 1], 'what is said to rests');
  await own(page, 'balanced*3; 0.7,0.05,0.1');
  await page.waitForFunction(() => window.goodbot.strategies().length === 22);
  assert.deepEqual(await expected(page), [0.7, 0.7, 0.1, 0.75, 1, 0, 0, 0.7, 0.7, 0.1, 0, 0.7, 0.05, 0.1, 0.25, 1, 0, 0, 0.7, 0.05, 0.1, 0]);
  await page.evaluate(() => document.activeElement.blur());
  await reload(page);
  await settings(page);
  assert.deepEqual([await page.inputValue('#believes'), await page.inputValue('#strategies')], ['own', 'balanced*0.75; punish-only*0.25']);
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'go to the red room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await opened(page, 'You as a trainer');
  const bad = async () => parseFloat((await page.locator('#style .value').allTextContents())[1]);
  const before = await bad();
  for (let step = 1; step <= 5; step += 1) {
    await page.click('#bad');
    await page.waitForFunction(count => document.querySelectorAll('#steps tr').length >= count, step);
    await page.getByText('Good or Bad?').waitFor();
  }
  assert.ok(await bad() > before, 'of several, it learns which one its trainer is');
  await close(page);
});

const program = process.env.GOODBOT_CLI;

test('the command line believes the same of a session, told to expect the same', { skip: program ? false : 'GOODBOT_CLI is not set' }, async () => {
  const page = await open(browser);
  await settings(page);
  await page.selectOption('#believes', 'reward-only');
  await page.waitForFunction(() => window.goodbot.strategies().length === 11);
  await play(page, 'D');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'take the blue chair to the yellow room');
  await page.click('#say-it');
  for (const [step, word] of [['1', '#good'], ['2', '#next'], ['3', '#bad']]) {
    await page.getByText('Good or Bad?').waitFor();
    await page.click(word);
    await page.waitForFunction(count => document.querySelectorAll('#steps tr').length >= count, Number(step));
  }
  await page.getByText('Good or Bad?').waitFor();
  const { log, tasks } = await page.evaluate(() => ({ log: window.goodbot.log(), tasks: JSON.parse(window.goodbot.belief()).tasks }));
  const folder = mkdtempSync(join(tmpdir(), 'goodbot-believes-'));
  // The page's log has the strategies; here they are given on the command line instead.
  writeFileSync(join(folder, 'log.jsonl'), log.replace(/,"strategies":\[.*?\]/, ''));
  assert.match(log, /"mu_plus":0\.05,"mu_minus":0\.7/);
  const beliefs = believes => execFileSync(program, ['replay', '--json', '--believes', believes, join(folder, 'log.jsonl')], { encoding: 'utf8' }).trim().split('\n').map(line => JSON.parse(line));
  const last = believes => beliefs(believes).filter(belief => belief.tasks).at(-1).tasks;
  const here = Object.fromEntries(tasks.map(({ name, probability }) => [name, probability]));
  assert.deepEqual(rounded(last('0.05,0.7,0.1')), rounded(here));
  assert.notDeepEqual(rounded(last('paper')), rounded(here));
  rmSync(folder, { recursive: true });
  await close(page);
});

const rounded = tasks => Object.fromEntries(Object.entries(tasks).map(([name, probability]) => [name, Math.fround(probability)]).sort());
