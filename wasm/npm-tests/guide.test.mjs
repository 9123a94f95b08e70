// The guide as its readers have it: unpacked, and opened from a file. GOODBOT_GUIDE names its folder, GOODBOT_CHROMIUM a browser.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { chromium } from '../../page/node_modules/playwright-core/index.mjs';

let browser;
before(async () => { browser = await chromium.launch({ executablePath: process.env.GOODBOT_CHROMIUM, args: ['--headless', '--no-sandbox', '--disable-gpu'] }); });
after(() => browser.close());

const opened = async (javaScriptEnabled = true) => {
  const page = await (await browser.newContext({ javaScriptEnabled })).newPage();
  await page.goto(pathToFileURL(join(String(process.env.GOODBOT_GUIDE), 'how-it-works.html')).href);
  return page;
};
const beliefs = page => page.$$eval('#belief [data-probability]', rows => rows.map(row => Number(row.dataset.probability)));

test('the belief moves as the reader says good, bad and nothing, and begins again', async () => {
  const page = await opened();
  assert.deepEqual(await beliefs(page), [0.25, 0.25, 0.25, 0.25]);
  await page.click('#belief >> text=Good bot');
  const praised = await beliefs(page);
  assert.ok(Math.abs(praised.reduce((sum, part) => sum + part, 0) - 1) < 1e-5 && Math.max(...praised) > 0.3, String(praised));
  await page.click('#belief >> text=say nothing');
  // With this trainer silence tells nothing.
  (await beliefs(page)).forEach((part, task) => assert.ok(Math.abs(part - praised[task]) < 1e-5));
  await page.click('#belief >> text=Bad bot');
  assert.notDeepEqual(await beliefs(page), praised);
  await page.click('#belief >> text=Again');
  assert.deepEqual(await beliefs(page), [0.25, 0.25, 0.25, 0.25]);
});

test('without scripts a still picture is there', async () => {
  const page = await opened(false);
  assert.ok(await page.$eval('#belief img', image => image.complete && image.naturalWidth > 0));
});
