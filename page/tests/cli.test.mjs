// The command line reads the page's files, and the page reads the command line's: with the real program, which GOODBOT_CLI names.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, drag, launch, learned, model, open, opened, play, saved } from './browser.mjs';

const program = process.env.GOODBOT_CLI;
const skip = program ? false : 'GOODBOT_CLI is not set: the command line is not there to compare with';
const TESTS = ['take the purple chair to the green room', 'take the blue bag to the yellow room', 'go to the green room', 'go to the red room', 'go to the blue room'];
let browser;
let folder;
before(async () => {
  browser = await launch();
  folder = mkdtempSync(join(tmpdir(), 'goodbot-page-'));
});
after(async () => {
  rmSync(folder, { recursive: true });
  await browser.close();
});

const goodbot = (...words) => execFileSync(program, words, { encoding: 'utf8' });

function file(name, content) {
  const path = join(folder, name);
  writeFileSync(path, content);
  return path;
}

// Each task's probability as 32 bits.
function bits(tasks) {
  const number = new Float32Array(1);
  const whole = new Uint32Array(number.buffer);
  return Object.fromEntries(Object.entries(tasks).map(([name, probability]) => {
    number[0] = probability;
    return [name, whole[0].toString(16)];
  }).sort());
}

const beliefAfter = told => (page, command) => page.evaluate(([how, said]) => {
  if (how === 'hear') window.goodbot.hear(said);
  else window.goodbot.listen(said, false);
  const { tasks } = JSON.parse(window.goodbot.belief());
  window.goodbot.forget();
  return Object.fromEntries(tasks.map(({ name, probability }) => [name, probability]));
}, [told, command]);

// What a recorded command tells, and what a visitor says.
const [heard, understood] = ['hear', 'listen'].map(beliefAfter);

async function watchTour(page) {
  await page.selectOption('#speed', 'once');
  await page.click('#watch');
  await page.getByText('The tour is over').first().waitFor();
  await opened(page, 'Settings, keeping, sharing');
}

// The page's current home, by its download.
async function home(page) {
  await page.click('[data-mode=build]');
  return saved(page, '#download-home');
}

test('a model trained in the page answers in the command line with the same bits', { skip }, async () => {
  const page = await open(browser);
  await watchTour(page);
  const trained = file('robot.goodbot', await saved(page, '#save-model'));
  await play(page, 'Test');
  const environment = file('home.json', await home(page));
  const best = [];
  for (const command of TESTS) {
    const answer = JSON.parse(goodbot('ask', '--with', trained, '--environment', environment, '--json', command));
    const here = await understood(page, command);
    assert.ok(Object.keys(here).length >= 5);
    assert.deepEqual(bits(answer.tasks), bits(here), command);
    best.push(Math.max(...Object.values(here)));
  }
  assert.ok(best.filter(probability => probability > 0.6).length >= 3, 'it has learned something: ' + best);
  await close(page);
});

for (const settings of ['roles', 'paper']) {
  test('a model that the command line learned ' + (settings === 'roles' ? 'answers in the page with the same bits' : 'as the paper has it is refused, and says why'), { skip }, async () => {
    const teacher = await open(browser);
    await watchTour(teacher);
    const log = file('sessions.jsonl', await saved(teacher, '#save-log'));
    const learned = join(folder, 'learned.goodbot');
    goodbot('learn', '--learner', settings, '--out', learned, log);
    const page = await open(browser);
    await opened(page, 'Settings, keeping, sharing');
    await page.setInputFiles('#load-model', learned);
    if (settings === 'paper') {
      await page.getByText('Model 2').first().waitFor();
      assert.equal(await page.evaluate(() => window.goodbot.sessions()), 0);
      await close(teacher);
      await close(page);
      return;
    }
    await page.getByText('Saved in this browser: 7 sessions').waitFor();
    await play(page, 'Test');
    const environment = file('home.json', await home(page));
    for (const command of TESTS) {
      const answer = JSON.parse(goodbot('ask', '--with', learned, '--environment', environment, '--json', command));
      assert.deepEqual(bits(await understood(page, command)), bits(answer.tasks), command);
    }
    assert.deepEqual(await saved(page, '#save-model'), readFileSync(learned), 'the page gives back the file that it took');
    await play(page, 'Test');
    await opened(page, 'Its dictionary');
    const words = await page.locator('#heat thead th').allTextContents();
    for (const word of ['chair', 'yellow']) assert.ok(words.includes(word), 'words that nobody said here are shown whole too: ' + words);
    await close(teacher);
    await close(page);
  });
}

test('the command line accepts a home drawn in the editor, and the session log', { skip }, async () => {
  const page = await open(browser);
  await watchTour(page);
  const log = file('sessions.jsonl', await saved(page, '#save-log'));
  await page.click('[data-mode=build]');
  await page.click('#clear');
  for (const [tool, ...cells] of [['room', [1, 1], [7, 5]], ['agent', [3, 3]], ['block', [5, 3]]]) await drag(page, tool, ...cells);
  const drawn = await saved(page, '#download-home');
  assert.deepEqual(JSON.parse(drawn).objects.map(object => object.class), ['room', 'agent', 'block']);
  goodbot('check', file('drawn.json', drawn), log);
  assert.equal(goodbot('replay', '--json', log).split('\n').filter(line => line.includes('"step":0')).length, 7);
  assert.throws(() => execFileSync(program, ['check', file('drawn.json', drawn.toString().replace('"agent"', '"agents"'))], { stdio: 'ignore' }));
  await close(page);
});

// Pull, a recorded prior, strategies, a session that goes on, and a demonstration.
const HOME = {
  version: 1, objects: [{ class: 'room', name: 'room0', left: 0, bottom: 0, right: 6, top: 4, color: 'red' }, { class: 'room', name: 'room1', left: 0, bottom: 4, right: 6, top: 8, color: 'green' },
    { class: 'door', name: 'door0', left: 3, bottom: 4, right: 3, top: 4 }, { class: 'block', name: 'block0', x: 1, y: 2, color: 'blue', shape: 'bag' }, { class: 'agent', name: 'agent0', x: 2, y: 2 }],
};
const RECORDED = [
  {
    type: 'session', version: 1, id: 'one', kind: 'feedback', environment: HOME, command: 'Fetch the bag !', intended: ['blockInRoom(block0,room1)'], actions: ['north', 'south', 'east', 'west', 'pull'],
    prior: { 'agentInRoom(agent0,room1)': 0.375, 'blockInRoom(block0,room1)': 0.625 },
    strategies: [{ name: 'balanced', mu_plus: 0.75, mu_minus: 0.75, epsilon: 0.1, prior: 0.5 }, { name: 'strict', mu_plus: 0.85, mu_minus: 0.3, epsilon: 0.05, prior: 0.5 }],
  },
  { type: 'step', action: 'pull', feedback: 'reward' }, { type: 'step', action: 'east', feedback: 'neutral' }, { type: 'step', action: 'north', feedback: 'punish' },
  { type: 'end', learn: true },
  { type: 'session', version: 1, kind: 'feedback', environment: HOME, command: 'Fetch the bag !', continues: true, actions: ['north', 'south', 'east', 'west', 'pull'] },
  { type: 'step', action: 'pull', feedback: 'reward' },
  { type: 'end', learn: true },
  { type: 'session', version: 1, kind: 'demonstration', environment: HOME, command: 'walk into the green room' },
  ...['east', 'north', 'north', 'north'].map(action => ({ type: 'step', action })),
  { type: 'end', learn: true },
];
const lines = records => records.map(record => JSON.stringify(record)).join('\n') + '\n';

test('a log with all that logs may say teaches the page what it teaches the command line', { skip }, async () => {
  const page = await open(browser);
  await opened(page, 'Settings, keeping, sharing');
  await page.setInputFiles('#load-log', file('recorded.jsonl', lines(RECORDED)));
  await page.getByText('The robot has gone through the log').first().waitFor();
  const asked = 'fetch the green bag';
  await page.evaluate(json => { window.goodbot.setPulls(true); window.goodbot.setEnvironment(json); }, JSON.stringify(HOME));
  const here = await heard(page, asked);
  const question = { type: 'session', version: 1, id: 'asked', kind: 'feedback', environment: HOME, command: asked, actions: RECORDED[0].actions };
  const log = file('asked.jsonl', lines([...RECORDED, question, { type: 'end', learn: false }]));
  const beliefs = goodbot('replay', '--json', '--learner', 'roles', log).trim().split('\n').map(line => JSON.parse(line));
  const answer = beliefs.find(belief => belief.session === 'asked' && belief.step === 0);
  assert.deepEqual(bits(here), bits(answer.tasks));
  assert.notEqual(here['blockInRoom(block0,room1)'], here['agentInRoom(agent0,room1)']);
  const kept = (await saved(page, '#save-log')).toString();
  assert.equal(kept, lines(RECORDED), 'what was learned from is kept as it was');
  await close(page);
});

test('a log of commands that say how teaches the command line what it taught the page', { skip }, async () => {
  const page = await open(browser);
  await opened(page, 'Settings, keeping, sharing');
  await page.selectOption('#believes', 'balanced');
  await page.check('#set-ways');
  await page.waitForFunction(() => window.goodbot.ways() && document.body.dataset.phase === 'none');
  await page.selectOption('#speed', 'once');
  for (const lesson of [1, 2]) {
    await page.locator('#dots button').nth(11 + lesson).click();
    await page.click('#auto');
    await learned(page, lesson);
  }
  const kept = (await saved(page, '#save-log')).toString();
  const asked = 'go to the purple room through the red room';
  const environment = await page.evaluate(() => JSON.parse(window.goodbot.environment()));
  const here = await heard(page, asked);
  const question = { type: 'session', version: 1, id: 'asked', kind: 'feedback', environment, command: asked };
  const log = file('ways.jsonl', kept + lines([question, { type: 'end', learn: false }]));
  const beliefs = goodbot('replay', '--json', '--routes', '--every-session', log).trim().split('\n').map(line => JSON.parse(line));
  assert.deepEqual(bits(here), bits(beliefs.find(belief => belief.session === 'asked' && belief.step === 0).tasks));
  assert.ok(Object.keys(here).length >= 40);
  const trained = file('ways.goodbot', await saved(page, '#save-model'));
  const answer = JSON.parse(goodbot('ask', '--with', trained, '--routes', '--environment', file('ways.json', JSON.stringify(environment)), '--json', asked));
  assert.deepEqual(bits(answer.tasks), bits(await understood(page, asked)));
  await close(page);
});

test('a log that is at fault teaches nothing, and its line is named', async () => {
  const page = await open(browser);
  await opened(page, 'Settings, keeping, sharing');
  const old = await model(page);
  const with_ = (at, change) => RECORDED.map((record, index) => (index === at ? { ...record, ...change } : record));
  for (const [records, said] of [
    [with_(0, { prior: { 'agentInRoom(agent0,room9)': 1 } }), /line 1 .*room9.*no task/],
    [with_(0, { mood: 'good' }), /line 1 .*no field “mood”/],
    [with_(5, { command: 'other' }), /line 6 .*does not stand before it/],
    [with_(10, { action: 'fly' }), /line 11 .*fly is no action/],
    [RECORDED.slice(0, 3), /the last session of this log has no end/],
  ]) {
    await page.setInputFiles('#load-log', { name: 'bad.jsonl', mimeType: 'application/jsonl', buffer: Buffer.from(lines(records)) });
    await page.waitForFunction(() => /Nothing was learned/.test(document.getElementById('live').textContent));
    assert.match(await page.textContent('#live'), said);
    assert.deepEqual(await model(page), old);
    await page.evaluate(() => { document.getElementById('live').textContent = ''; });
  }
  await close(page);
});
