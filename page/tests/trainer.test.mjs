// <goodbot-trainer>: the page inside another page.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { after, before, test } from 'node:test';
import { launch } from './browser.mjs';

const files = { '/trainer.js': ['../../wasm/npm/trainer.js', 'text/javascript'], '/goodbot.html': ['../../dist/goodbot.html', 'text/html'] };
const SITE = `<!DOCTYPE html><title>a site</title><style>button { display: none }</style>
<script type="module" src="trainer.js"></script><goodbot-trainer language="de"></goodbot-trainer>`;
let browser, server, site;
before(async () => {
  browser = await launch();
  server = createServer((request, answer) => {
    const [file, type] = files[request.url] ?? [];
    answer.setHeader('content-type', type ?? 'text/html').end(file ? readFileSync(new URL(file, import.meta.url)) : SITE);
  });
  await new Promise(done => { server.listen(0, '127.0.0.1', done); });
  site = 'http://127.0.0.1:' + server.address().port + '/';
});
after(() => Promise.all([browser.close(), server.close()]));

// The events that the site gets, in order.
async function visit() {
  const page = await (await browser.newContext({ locale: 'en-GB', reducedMotion: 'reduce' })).newPage();
  await page.addInitScript(() => {
    window.heard = [];
    for (const name of ['ready', 'session', 'belief', 'error']) document.addEventListener('goodbot-' + name, ({ detail }) => window.heard.push([name, detail]));
  });
  await page.goto(site);
  return page;
}
const heard = (page, name) => page.evaluate(wanted => window.heard.filter(([event]) => event === wanted).map(([, detail]) => detail), name);

test('a site hears what its robot believes and when it has learned', async () => {
  const page = await visit();
  await page.waitForFunction(() => window.heard.some(([name]) => name === 'ready'));
  assert.deepEqual(await heard(page, 'ready'), [{ sessions: 0 }]);
  const inside = page.frameLocator('goodbot-trainer iframe');
  assert.match(await inside.locator('#tour-hint').textContent(), /„geh in den roten Raum“/, 'in the language that the site asks for');
  await inside.locator('#lesson').click();
  await page.waitForFunction(() => window.heard.some(([name, { tasks }]) => name === 'belief' && tasks.length > 1));
  const before = (await heard(page, 'belief')).length;
  await inside.locator('#good').click();
  await page.waitForFunction(count => window.heard.filter(([name]) => name === 'belief').length > count, before);
  const { tasks } = (await heard(page, 'belief')).at(-1);
  assert.ok(Math.abs(tasks.reduce((sum, { probability }) => sum + probability, 0) - 1) < 1e-4, JSON.stringify(tasks));
  await inside.locator('#finish').click();
  await page.waitForFunction(() => window.heard.some(([name]) => name === 'session'));
  const [{ sessions, log }] = await heard(page, 'session');
  assert.equal(sessions, 1);
  assert.equal(JSON.parse(log.split('\n')[0]).type, 'session');
  const [first] = await page.evaluate(() => [...document.querySelector('goodbot-trainer').model]);
  assert.equal(typeof first, 'number');
  assert.deepEqual(await heard(page, 'error'), []);
  await page.context().close();
});

test('taken out and put in again, it is there once', async () => {
  const page = await visit();
  await page.waitForFunction(() => window.heard.some(([name]) => name === 'ready'));
  await page.evaluate(() => { const [trainer] = document.getElementsByTagName('goodbot-trainer'); trainer.remove(); document.body.append(trainer); });
  await page.waitForFunction(() => window.heard.filter(([name]) => name === 'ready').length === 2);
  assert.equal(await page.locator('goodbot-trainer iframe').count(), 1);
  await page.context().close();
});

test('a page of another site is told of as an error that says what to do', async () => {
  const page = await visit();
  const other = site.replace('127.0.0.1', 'localhost');
  await page.waitForFunction(() => window.heard.some(([name]) => name === 'ready'));
  await page.evaluate(address => document.querySelector('goodbot-trainer').setAttribute('src', address), other + 'goodbot.html');
  await page.waitForFunction(() => window.heard.some(([name]) => name === 'error'));
  assert.match((await heard(page, 'error'))[0].reason, /copy goodbot\.html/);
  await page.context().close();
});
