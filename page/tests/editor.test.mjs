import assert from 'node:assert/strict';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, drag, launch, open, play } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

test('a home drawn by pointer is one that the robot can live in', async () => {
  const page = await open(browser);
  await page.click('[data-mode=build]');
  await page.click('#clear');
  assert.match(await page.textContent('#build-error'), /Draw a room first/);
  await drag(page, 'room', [1, 1], [6, 6]);
  await drag(page, 'agent', [3, 3]);
  await drag(page, 'block', [4, 4]);
  const cells = JSON.parse(await page.evaluate(() => window.goodbot.environment())).objects.map(({ left, right, x }) => [left, right, x]);
  assert.deepEqual(cells.flat().filter(value => value !== undefined).map(value => value - cells[0][0]), [0, 5, 2, 3], 'things stand where the pointer was');
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
  await page.locator('#objects summary', { hasText: 'robot' }).click();
  await page.locator('#objects details[open] label', { hasText: /^x$/ }).locator('input').fill('0');
  await page.keyboard.press('Tab');
  assert.match(await page.textContent('#build-error'), /robot: it stands in a wall or outside every room/);
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

test('a drawing with a legend is the home that the command line reads in it', async () => {
  const page = await open(browser);
  await page.click('[data-mode=build]');
  const drawing = ['#####', '#rrr#', '##+##', '#g@C#', '#####', 'C: blue chair', 'g: teal', ''].join('\n');
  const take = async text => {
    await page.fill('#home-text', text);
    await page.click('#import');
  };
  const objects = async () => JSON.parse(await page.evaluate(() => window.goodbot.environment())).objects;
  const seen = async () => Object.fromEntries((await objects()).map(({ class: kind, name, ...object }) => [name, Object.values(object).join(' ')]));
  await take(drawing);
  await page.getByText('The home is taken over').first().waitFor();
  const home = { room0: '0 0 4 2 teal', room1: '0 2 4 4 red', door0: '2 2 2 2', block0: '3 1 blue chair', agent0: '2 1' };
  assert.deepEqual(await seen(), home);
  await take(drawing + 'room purple 0 2 4 4\nblock tan star 3 1\n');
  await page.waitForFunction(() => /purple/.test(window.goodbot.environment()));
  const noted = { ...home, room1: '0 2 4 4 purple', block0: '3 1 tan star' };
  assert.deepEqual(await seen(), noted, 'a note counts before the legend');
  for (const [text, said] of [
    [drawing.replace('g: teal\n', '').replace('#g@C#', '#z@C#'), /what z means is not said; add a line such as “z: teal”/],
    [drawing + 'room red 0 0 3 3\n', /no room is drawn at 0 0 3 3/],
  ]) {
    await take(text);
    await page.getByText('This text is no home').first().waitFor();
    assert.match(await page.textContent('#toast'), said);
    await page.evaluate(() => { document.getElementById('toast').textContent = document.getElementById('live').textContent = ''; });
  }
  assert.deepEqual(await seen(), noted, 'what is refused changes nothing');
  await close(page);
});

test('a home whose corner is elsewhere comes back from its text map too', async () => {
  const page = await open(browser);
  await page.click('[data-mode=build]');
  await page.fill('#home-text', JSON.stringify({ version: 1, objects: [{ class: 'room', name: 'room0', left: -3, bottom: 5, right: 2, top: 9, color: 'magenta' }, { class: 'block', name: 'block0', x: 0, y: 7, color: 'pink', shape: 'ball' }, { class: 'agent', name: 'agent0', x: -1, y: 6 }] }));
  await page.click('#import');
  await page.waitForFunction(() => /magenta/.test(window.goodbot.environment()));
  await page.click('#export-map');
  await page.click('#import');
  await page.waitForFunction(() => /"left":0/.test(window.goodbot.environment()));
  const objects = JSON.parse(await page.evaluate(() => window.goodbot.environment())).objects;
  assert.deepEqual(objects.map(({ class: kind, name, ...object }) => Object.values(object).join(' ')), ['0 0 5 4 magenta', '3 2 pink ball', '2 1']);
  await close(page);
});

test('things are dragged, rooms resized, and all of it coloured and shaped', async () => {
  const page = await open(browser);
  await play(page, 'D');
  await page.click('[data-mode=build]');
  const objects = async () => Object.fromEntries(JSON.parse(await page.evaluate(() => window.goodbot.environment())).objects.map(object => [object.name, object]));
  const before = await objects();
  const top = Math.max(...Object.values(before).map(object => object.top || 0));
  const cell = ({ x, y }) => [x + 1, top - y + 1];
  const { agent0, room0, block0 } = before;
  await drag(page, 'move', cell(agent0), cell({ x: agent0.x + 1, y: agent0.y }));
  assert.deepEqual((await objects()).agent0, { ...agent0, x: agent0.x + 1 });
  await page.click('#draft', { position: { x: 1, y: 1 } });
  await drag(page, 'move', cell({ x: room0.left + 1, y: room0.bottom + 2 }));
  assert.match(await page.locator('#objects details[open] summary').textContent(), new RegExp(room0.name));
  await drag(page, 'move', cell({ x: room0.right, y: room0.bottom }), cell({ x: room0.right, y: room0.bottom - 2 }));
  assert.equal((await objects()).room0.bottom, room0.bottom - 2);
  await page.locator('#objects details[open] select').selectOption('teal');
  assert.equal((await objects()).room0.color, 'teal');
  await page.locator('#objects summary', { hasText: 'block0' }).click();
  await page.locator('#objects details[open] label', { hasText: 'shape' }).locator('select').selectOption('star');
  await page.locator('#objects details[open] label', { hasText: 'colour' }).locator('select').selectOption('magenta');
  assert.deepEqual((await objects()).block0, { ...block0, shape: 'star', color: 'magenta' });
  await close(page);
});

test('a home is drawn by keyboard alone, from nothing', async () => {
  const page = await open(browser);
  await page.click('[data-mode=build]');
  const press = async (selector, key = 'Enter') => {
    await page.focus(selector);
    await page.keyboard.press(key);
  };
  await press('#clear');
  await press('[data-add=room]');
  await press('[data-add=agent]');
  assert.match(await page.textContent('#build-error'), /Not a home yet: robot: it stands in a wall/);
  const field = page.locator('#objects details[open] label', { hasText: /^x$/ }).locator('input');
  await field.focus();
  for (let step = 0; step < 8 && !/This is a home/.test(await page.textContent('#build-error')); step += 1) {
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Tab');
    await page.keyboard.press('Shift+Tab');
  }
  assert.match(await page.textContent('#build-error'), /This is a home/);
  assert.equal(JSON.parse(await page.evaluate(() => window.goodbot.environment())).objects.length, 2);
  await close(page);
});

test('a file that is no home is refused, and one that is one is taken over', async () => {
  const page = await open(browser);
  await play(page, 'E');
  const home = await page.evaluate(() => window.goodbot.environment());
  await page.click('[data-mode=build]');
  await page.click('#clear');
  const load = buffer => page.setInputFiles('#load-home', { name: 'home.json', mimeType: 'application/json', buffer: Buffer.from(buffer) });
  await load(home.replace('"version":1', '"version":2'));
  await page.getByText('This text is no home').first().waitFor();
  await load(home);
  await page.getByText('The home is taken over').first().waitFor();
  assert.equal(await page.evaluate(() => window.goodbot.environment()), home);
  await close(page);
});

test('a home is drawn by touch alone', async () => {
  const page = await open(browser, { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
  await page.tap('[data-mode=build]');
  const objects = async () => JSON.parse(await page.evaluate(() => window.goodbot.environment())).objects;
  const before = await objects();
  const at = cell => page.evaluate(([column, row]) => {
    const point = new DOMPoint((column + 0.5) * 48, (row + 0.5) * 48).matrixTransform(document.getElementById('draft').getScreenCTM());
    return [point.x, point.y];
  }, cell);
  await page.tap('[data-tool=block]');
  await page.touchscreen.tap(...await at([3, 3]));
  await page.tap('[data-tool=agent]');
  await page.touchscreen.tap(...await at([2, 3]));
  const after = await objects();
  assert.equal(after.length, before.length + 1);
  const [block, robot] = ['block', 'agent'].map(kind => after.findLast(object => object.class === kind));
  assert.deepEqual([block.x - robot.x, block.y - robot.y], [1, 0]);
  await page.getByText('block0').tap();
  await page.locator('#objects details[open] button', { hasText: 'Remove' }).tap();
  assert.equal((await objects()).length, before.length);
  await close(page);
});

test('what is wrong with a drawing is told in the language of the page', async () => {
  const page = await open(browser);
  await page.click('[data-mode=build]');
  await page.click('#clear');
  await drag(page, 'room', [1, 1], [6, 6]);
  await drag(page, 'agent', [3, 3]);
  const said = { en: [/room1: it is too small/, /block0: another thing or the robot stands there/, /too large, or too far away/, /needs exactly one robot/],
    de: [/room1: zu klein/, /block0: dort steht schon/, /zu groß oder zu weit weg/, /genau einen Roboter/],
    fr: [/trop petit/, /il y a déjà/, /trop grand/, /un robot, et un seul/], es: [/demasiado pequeño/, /ya hay/, /demasiado grande/, /exactamente un robot/], zh: [/太小/, /已经有/, /太大/, /正好一个机器人/] };
  for (const [language, [small, crowded, large, robot]] of Object.entries(said)) {
    await page.selectOption('#language', language);
    const error = async wanted => {
      assert.match(await page.textContent('#build-error'), wanted);
      if (language === 'zh') assert.doesNotMatch(await page.textContent('#build-error'), /[a-z]{3,} [a-z]{2,}/);
      await page.click('#build-undo');
    };
    await drag(page, 'room', [2, 2]);
    await error(small);
    await drag(page, 'block', [3, 3]);
    await error(crowded);
    const field = async (at, name, value) => {
      if (!await page.locator(`[data-field="${at}.${name}"]`).isVisible()) await page.locator('#objects summary').nth(at).click();
      await page.locator(`[data-field="${at}.${name}"]`).fill(value);
      await page.locator(`[data-field="${at}.${name}"]`).blur();
    };
    await field(0, 'right', '900');
    await error(large);
    await page.fill('#home-text', '#####\n#rrr#\n#####');
    await page.click('#import');
    assert.match(await page.textContent('#build-error'), robot);
  }
  await close(page);
});

test('a stroke that goes beyond the frame ends at it, and the drawing keeps its scale under the pointer', async () => {
  const page = await open(browser);
  await page.click('[data-mode=build]');
  await page.click('#clear');
  const frame = () => page.evaluate(() => { const { a, e, f } = document.getElementById('draft').getScreenCTM(); return [a, e, f]; });
  await page.click('[data-tool=room]');
  await page.locator('#draft').scrollIntoViewIfNeeded();
  const before = await frame();
  const at = (column, row) => [before[1] + (column + 0.5) * before[0] * 48, before[2] + (row + 0.5) * before[0] * 48];
  await page.mouse.move(...at(1, 1));
  await page.mouse.down();
  await page.mouse.move(...at(13, 5), { steps: 4 });
  await page.mouse.up();
  assert.deepEqual(await frame(), before);
  // The second stroke lands where the pointer is.
  await page.mouse.move(...at(1, 5));
  await page.mouse.down();
  await page.mouse.move(...at(5, 9), { steps: 4 });
  await page.mouse.up();
  assert.deepEqual(await frame(), before);
  const rooms = await page.evaluate(() => JSON.parse(localStorage['goodbot.drawing']).file.objects);
  assert.deepEqual(rooms.map(({ left, top, right, bottom }) => [left, top, right, bottom]), [[0, 8, 9, 4], [0, 4, 4, 0]]);
  // With the next tool there is a margin again.
  const width = () => page.evaluate(() => document.getElementById('draft').viewBox.baseVal.width);
  assert.equal(await width(), 11 * 48);
  await page.click('[data-tool=door]');
  assert.equal(await width(), 12 * 48);
  await close(page);
});
