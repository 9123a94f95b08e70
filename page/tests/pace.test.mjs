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

test('after two hundred lessons, what to teach next is sought where it is seen, two lessons at a time', async () => {
  const page = await open(browser);
  const log = await longLog(page);
  await opened(page, 'Settings, keeping, sharing');
  await page.setInputFiles('#load-log', { name: 'many.jsonl', mimeType: 'application/jsonl', buffer: Buffer.from(log) });
  await page.waitForFunction(count => window.goodbot.sessions() === count && document.body.dataset.phase === 'none', LESSONS);
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
