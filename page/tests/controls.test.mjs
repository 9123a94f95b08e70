// The trainer's controls: pace, pause, feedback, speech.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { address, close, launch, open, pass, play, reload, stopTime } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function tell(page, command) {
  await page.fill('#command', command);
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
}

const steps = page => page.evaluate(() => document.querySelectorAll('#steps tr').length);
const sure = async page => Number((await page.textContent('#sure')).match(/(\d+)\s?%/)[1]) / 100;
const wait = page => page.evaluate(() => document.getElementById('wait').getAnimations()[0]?.effect.getTiming().duration);

const RULES = {
  linear: c => 350 + 2900 * (1 - c),
  sigmoid: c => 350 + 2900 / (1 + Math.exp(12 * (c - 0.6))),
  threshold: c => (c < 0.7 ? 3250 : 350),
};

for (const [rule, expected] of Object.entries(RULES)) {
  test('by confidence, ' + rule + ': the less sure the robot is, the longer it waits', async () => {
    const page = await open(browser);
    await play(page, 'A');
    assert.ok(await page.isHidden('#rule'));
    await page.selectOption('#speed', 'confidence');
    assert.deepEqual(await page.locator('#rule option').allTextContents(), Object.keys(RULES));
    await page.selectOption('#rule', rule);
    await stopTime(page);
    await page.fill('#command', 'go to the red room');
    await page.click('#say-it');
    const waits = [];
    for (let step = 0; step < 4; step += 1) {
      await page.getByText('Good or Bad?').waitFor();
      const [confidence, milliseconds] = [await sure(page), await wait(page)];
      // The page shows whole hundredths, never more than 0.99, and no bar where it hardly waits.
      const [least, most] = [confidence > 0.985 ? 1 : confidence + 0.006, confidence - 0.006].map(expected);
      if (milliseconds) assert.ok(milliseconds > least - 1 && milliseconds < most + 1, rule + ' at ' + confidence + ': ' + milliseconds);
      waits.push([confidence, milliseconds || 0]);
      await page.click('#good');
      await page.click('#next');
      if (step === 0) await page.click('#pause');
    }
    const [first] = waits;
    const surest = waits.reduce((best, each) => (each[0] > best[0] ? each : best));
    assert.ok(surest[0] > first[0] && surest[1] < first[1], JSON.stringify(waits));
    await close(page);
  });
}

test('of several words to one step the last counts, and the button shows what it went to', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await page.selectOption('#speed', 'slow');
  await stopTime(page);
  await tell(page, 'go to the red room');
  for (const button of ['#good', '#bad', '#good', '#bad']) await page.click(button);
  assert.equal(await page.getAttribute('#bad', 'aria-pressed'), 'true');
  assert.equal(await page.getAttribute('#good', 'aria-pressed'), 'false');
  const action = (await page.textContent('#to')).match(/It (.*)\. You said Bad/)[1];
  assert.equal(await page.textContent('#bad small'), action);
  assert.equal(await page.textContent('#good small'), '');
  assert.equal(await steps(page), 0);
  await pass(page, 2600);
  assert.equal(await steps(page), 1);
  assert.match(await page.locator('#steps tr').first().textContent(), new RegExp('1' + action + 'Bad'));
  await close(page);
});

test('a paused robot stays; one step is one step', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await page.selectOption('#speed', 'fast');
  await stopTime(page);
  await tell(page, 'go to the red room');
  await pass(page, 400);
  assert.equal(await steps(page), 1, 'by itself it goes on');
  await page.click('#pause');
  await pass(page, 5000);
  assert.equal(await steps(page), 1);
  await page.click('#next');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length > 1);
  await pass(page, 5000);
  assert.equal(await steps(page), 2);
  await close(page);
});

test('slow, normal and fast differ in how long the robot waits', async () => {
  const page = await open(browser);
  await play(page, 'A');
  const waits = [];
  await stopTime(page);
  for (const speed of ['slow', 'normal', 'fast']) {
    await page.selectOption('#speed', speed);
    await tell(page, 'go to the red room');
    waits.push(await wait(page));
    await page.click('#drop');
  }
  assert.deepEqual(waits, [2600, 1400, 400]);
  await close(page);
});

test('a test of the tour takes no feedback', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  for (let lesson = 1; lesson <= 7; lesson += 1) {
    await page.click('#auto');
    await page.getByText(lesson < 7 ? 'Lesson ' + (lesson + 1) + ' of 7' : 'Test 1 of 5').first().waitFor();
  }
  await page.selectOption('#speed', 'slow');
  await stopTime(page);
  await page.click('#lesson');
  await page.getByText('A test: no feedback.').waitFor();
  await page.keyboard.press('g');
  await page.click('#bad', { force: true });
  assert.deepEqual([await page.getAttribute('#good', 'aria-pressed'), await page.getAttribute('#bad', 'aria-pressed')], ['false', 'false']);
  const before = await page.evaluate(() => window.goodbot.belief());
  await pass(page, 600);
  assert.equal(await page.evaluate(() => window.goodbot.belief()), before);
  assert.equal(await page.locator('#steps tr').count(), 0, 'nothing was judged, and silence neither');
  await close(page);
});

test('Good and Bad say why they do nothing before a command', async () => {
  const page = await open(browser);
  await page.click('#good', { force: true });
  assert.match(await page.textContent('#toast'), /first tell the robot what to do/);
  await close(page);
});

for (const [has, how] of [[true, 'where the browser has it'], [false, 'and not where it has not']]) {
  test('speech is offered ' + how, async () => {
    const context = await browser.newContext();
    const page = await context.newPage();
    await page.addInitScript(offered => {
      delete window.webkitSpeechRecognition;
      delete window.SpeechRecognition;
      if (!offered) return;
      window.SpeechRecognition = class {
        start() {
          this.onresult({ results: [[{ transcript: 'Go to the RED room' }]] });
          this.onend();
        }
      };
    }, has);
    await page.goto(address);
    await page.waitForSelector('body.ready');
    await page.click('[data-mode=play]');
    assert.equal(await page.isVisible('#speak'), has);
    if (has) {
      await page.click('#speak');
      assert.equal(await page.inputValue('#command'), 'go to the red room');
    }
    await context.close();
  });
}

test('a large home never stops the page', async () => {
  const page = await open(browser);
  const [rooms, blocks] = [[], []];
  for (let at = 0; at < 4; at += 1) rooms.push({ class: 'room', name: 'room' + at, left: 12 * (at % 2), bottom: 12 * (at >> 1), right: 12 * (at % 2) + 12, top: 12 * (at >> 1) + 12, color: ['red', 'green', 'blue', 'yellow'][at] });
  for (const [at, [x, y]] of [[3, 3], [9, 5]].entries()) blocks.push({ class: 'block', name: 'block' + at, x, y, color: 'blue', shape: ['bag', 'chair'][at] });
  const doors = [[12, 6], [6, 12], [12, 18], [18, 12]].map(([x, y], at) => ({ class: 'door', name: 'door' + at, left: x, right: x, bottom: y, top: y }));
  await page.click('[data-mode=build]');
  await page.fill('#home-text', JSON.stringify({ version: 1, objects: [...rooms, ...doors, ...blocks, { class: 'agent', name: 'agent0', x: 5, y: 5 }] }));
  await page.click('#import');
  await page.getByText('The home is taken over').first().waitFor();
  await page.click('[data-mode=play]');
  await page.evaluate(() => {
    let last = performance.now();
    window.longest = 0;
    const frame = () => {
      const now = performance.now();
      window.longest = Math.max(window.longest, now - last);
      last = now;
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  });
  const started = Date.now();
  await page.fill('#command', 'take the bag to the yellow room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.waitForTimeout(1500);
  const [whole, longest] = [Date.now() - started, await page.evaluate(() => window.longest)];
  console.log('planned and looked ahead in ' + whole + ' ms; the longest frame took ' + Math.round(longest) + ' ms');
  assert.ok(longest < whole / 2, longest + ' of ' + whole + ' ms in one go');
  await close(page);
});

test('Good, Bad and the goal have tones of their own, which are off until they are switched on, and stay so', async () => {
  const page = await open(browser);
  await page.evaluate(() => {
    window.heard = [];
    const { start } = OscillatorNode.prototype;
    OscillatorNode.prototype.start = function (when) {
      window.heard.push(this.frequency.value);
      return start.call(this, when);
    };
  });
  const heard = () => page.evaluate(() => window.heard.splice(0));
  await play(page, 'A');
  await tell(page, 'go to the red room');
  await page.click('#bad');
  assert.deepEqual(await heard(), [], 'nothing is heard at first');
  assert.ok(!await page.isChecked('#set-sound'));
  await page.check('#set-sound');
  const good = await heard();
  assert.ok(good.length, 'the switch gives an example');
  await page.click('#good');
  assert.deepEqual(await heard(), good);
  await page.click('#bad');
  const bad = await heard();
  assert.ok(bad.length && bad[0] > bad[1] && good[0] < good[1], 'Good goes up, and Bad goes down');
  await page.click('#drop');
  await page.click('[data-mode=tour]');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  for (let step = 0; step < 40 && !/Yes, that was it/.test(await page.textContent('#finish')); step += 1) await page.click('#next');
  await heard();
  await page.click('#good');
  const goal = await heard();
  assert.ok(goal.length && goal.join() !== good.join(), 'the goal has another tone than Good');
  await reload(page);
  assert.ok(await page.isChecked('#set-sound'));
  await close(page);
});
