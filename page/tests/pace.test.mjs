// A robot with hundreds of lessons keeps the page as quick as a new one.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, open, opened, play } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const LESSONS = 200;

// A log of this many lessons, each with a command of its own, on two of the course's tasks.
const longLog = page => page.evaluate(count => {
  const Robot = window.goodbot.constructor;
  const { homes, teachable } = JSON.parse(Robot.course(0));
  const extra = ['now', 'please', 'robot', 'quickly', 'again', 'there', 'today', 'dear', 'kindly', 'straight', 'just', 'friend', 'little', 'big', 'happy'];
  return Array.from({ length: count }, (_, at) => {
    const { home, command, intended } = teachable[at % 12];
    const said = command + ' ' + extra[at % 15] + ' ' + extra[Math.floor(at / 15) % 15];
    const environment = homes.find(([name]) => name === home)[1];
    return [
      { type: 'session', version: 1, kind: 'feedback', environment, command: said }, { type: 'answer', tasks: [intended], yes: true, eta: 0.05, others: 5 },
      { type: 'end', learn: true }].map(record => JSON.stringify(record)).join('\n');
  }).join('\n') + '\n';
}, LESSONS);

// A robot that has learned that log, in free play.
async function experienced(page) {
  const log = await longLog(page);
  await opened(page, 'Settings, keeping, sharing');
  await page.setInputFiles('#load-log', { name: 'many.jsonl', mimeType: 'application/jsonl', buffer: Buffer.from(log) });
  await page.waitForFunction(count => window.goodbot.sessions() === count && document.body.dataset.phase === 'none', LESSONS);
}

test('after two hundred lessons, what to teach next is sought where it is seen, two lessons at a time', async () => {
  const page = await open(browser);
  await experienced(page);
  await page.evaluate(() => {
    Object.assign(window, { calls: [] });
    const { nextLesson } = Object.getPrototypeOf(window.goodbot);
    Object.getPrototypeOf(window.goodbot).nextLesson = function (lessons, wanted) {
      const began = performance.now();
      const found = nextLesson.call(this, lessons, wanted);
      window.calls.push([lessons.split('\n').length, wanted.split('\n').length, performance.now() - began]);
      return found;
    };
  });
  await play(page, 'A');
  await page.waitForFunction(() => /is to understand|little left/.test(document.getElementById('next-why').textContent));
  const calls = await page.evaluate(() => window.calls);
  for (const [lessons, wanted] of calls) assert.ok(lessons <= 2 && wanted <= 20, lessons + ' lessons for ' + wanted + ' commands at once');
  const times = calls.map(([, , time]) => time).sort((a, b) => a - b);
  console.log(calls.length + ' calls; the longest ' + times.at(-1).toFixed(1) + ' ms, half of them at most ' + times[times.length >> 1].toFixed(1) + ' ms');
  await page.locator('#tab-thoughts').click();
  await page.evaluate(() => {
    window.calls = [];
    Object.assign(document.getElementById('wanted'), { value: 'go to the red room' }).dispatchEvent(new Event('input'));
  });
  await page.waitForTimeout(300);
  assert.deepEqual(await page.evaluate(() => window.calls), [], 'where nobody sees it, it is not worked out');
  await close(page);
});

// Calls of the core that take long, each with the number of the task that makes it.
const inTasks = (page, names) => page.evaluate(all => {
  Object.assign(window, { tasks: Object.fromEntries(all.map(name => [name, []])) });
  // The page ends a task by a message to itself or by a frame.
  let task = 0;
  const counted = (owner, name) => {
    const whole = owner[name];
    owner[name] = function (...values) {
      task += 1;
      return whole.apply(this, values);
    };
  };
  counted(MessagePort.prototype, 'postMessage');
  counted(window, 'requestAnimationFrame');
  for (const name of all) {
    const whole = Object.getPrototypeOf(window.goodbot)[name];
    Object.getPrototypeOf(window.goodbot)[name] = function (...values) {
      window.tasks[name].push(task);
      return whole.apply(this, values);
    };
  }
}, names);

test('a command and the end of a lesson do their work in several parts, because a telephone would stand still for all at once', async () => {
  const page = await open(browser);
  await experienced(page);
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await page.waitForFunction(() => document.getElementById('next-card').ariaBusy === 'false');
  await inTasks(page, ['said', 'listen', 'plan', 'learn', 'save', 'heat', 'hear', 'nextLesson']);
  const slow = await page.context().newCDPSession(page);
  await slow.send('Emulation.setCPUThrottlingRate', { rate: 6 });
  await page.evaluate(() => {
    Object.assign(window, { blocks: [] });
    new PerformanceObserver(list => window.blocks.push(...list.getEntries().map(({ duration }) => duration))).observe({ type: 'longtask' });
  });
  const blocks = async what => console.log(what + ': at most ' + Math.round(Math.max(0, ...await page.evaluate(() => window.blocks.splice(0)))) + ' ms at a time on a machine that is six times slower');
  await page.fill('#command', 'go to the green room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await blocks('a command');
  const heard = await page.evaluate(() => window.tasks);
  assert.ok(heard.said[0] < heard.listen[0] && heard.listen[0] < heard.plan[0], JSON.stringify(heard));
  await page.click('#finish');
  await page.waitForFunction(count => window.goodbot.sessions() === count && document.body.dataset.phase === 'none' && document.getElementById('next-card').ariaBusy === 'false', LESSONS + 1);
  await page.locator('#ideas button').first().waitFor();
  await blocks('the end of a lesson');
  const { save, heat, hear, nextLesson } = await page.evaluate(() => window.tasks);
  assert.ok(save.at(-1) < heat.at(-1), 'the dictionary is read after it is kept: ' + [save, heat]);
  assert.ok(heat.at(-1) < hear[0] && heat.at(-1) < nextLesson[0], 'ideas and the next lesson are sought after that: ' + [heat, hear, nextLesson]);
  await close(page);
});
