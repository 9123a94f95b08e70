import assert from 'node:assert/strict';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, launch, open, play } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// Presses at one cell of the drawing and lets go at another. Cells count from the drawing's north-west corner.
async function drag(page, tool, from, to = from) {
  await page.click('[data-tool=' + tool + ']');
  const box = await page.locator('#draft').boundingBox();
  const columns = Number(await page.evaluate(() => document.getElementById('draft').viewBox.baseVal.width / 48));
  const size = box.width / columns;
  const at = ([column, row]) => [box.x + (column + 0.5) * size, box.y + (row + 0.5) * size];
  await page.mouse.move(...at(from));
  await page.mouse.down();
  await page.mouse.move(...at(to), { steps: 4 });
  await page.mouse.up();
}

test('a home drawn by pointer is one that the robot can live in', async () => {
  const page = await open(browser);
  await page.click('[data-mode=build]');
  await page.click('#clear');
  assert.match(await page.textContent('#build-error'), /Not a home yet: there is no agent/);
  await drag(page, 'room', [1, 1], [6, 6]);
  await drag(page, 'agent', [3, 3]);
  await drag(page, 'block', [4, 4]);
  assert.match(await page.textContent('#build-error'), /This is a home/);
  await page.click('#export-json');
  const json = await page.inputValue('#home-text');
  assert.equal(JSON.parse(json).objects.length, 3);
  assert.equal(await page.evaluate(() => window.goodbot.environment()), json);
  const folder = process.env.GOODBOT_PAGE_EXPORT;
  if (folder) {
    mkdirSync(folder, { recursive: true });
    writeFileSync(join(folder, 'home.json'), json);
  }
  await close(page);
});

test('an invalid drawing says why, and the robot stays where it was', async () => {
  const page = await open(browser);
  await page.click('[data-mode=build]');
  const old = await page.evaluate(() => window.goodbot.environment());
  await page.getByText('robot', { exact: false }).locator('xpath=ancestor-or-self::summary').click();
  await page.locator('#objects details[open] label', { hasText: /^x$/ }).locator('input').fill('0');
  await page.keyboard.press('Tab');
  assert.match(await page.textContent('#build-error'), /agent0: it stands in a wall or outside every room/);
  assert.equal(await page.evaluate(() => window.goodbot.environment()), old);
  await close(page);
});

test('a home goes out as a text map and comes back', async () => {
  const page = await open(browser);
  await play(page, 'D');
  await page.click('[data-mode=build]');
  const old = JSON.parse(await page.evaluate(() => window.goodbot.environment()));
  await page.click('#export-map');
  await page.click('#import');
  await page.getByText('The home is taken over').first().waitFor();
  const again = JSON.parse(await page.evaluate(() => window.goodbot.environment()));
  const sorted = home => home.objects.map(({ name, ...object }) => JSON.stringify(object)).sort();
  assert.deepEqual(sorted(again), sorted(old));
  await close(page);
});
