// A class: each robot's table has its lessons and tests, and many tables are opened as one.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { address, close, downloaded, launch, learned, linkOf, open, openIn, opened, play, reload, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const fields = line => [...line.matchAll(/(?:^|,)("(?:[^"]|"")*"|[^,]*)/g)].map(([, field]) => field.replace(/^"|"$/g, '').replaceAll('""', '"'));

// A robot of this name after one lesson, and two tests with a guess each.
async function taught(page, name) {
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await learned(page, 1);
  await opened(page, 'Your robots');
  await page.fill('#robots .here input', name);
  await page.keyboard.press('Tab');
  await page.locator('#who', { hasText: name.trim() }).waitFor({ state: 'attached' });
  for (const [at, guess] of [[7, 'no'], [8, 'yes']]) {
    await page.locator('#dots button').nth(at).click();
    await page.click('[data-guess=' + guess + ']');
    await page.click('#lesson');
    await page.waitForFunction(() => document.querySelector('#dots .now')?.getAttribute('aria-label') && document.body.dataset.phase === 'none');
  }
  await opened(page, 'Charts');
  return downloaded(page, '#save-table');
}

test('a robot’s table has its name, its lessons and its tests with guesses; formulas in it are text, and Excel knows its letters', async () => {
  const page = await open(browser);
  const { name, bytes } = await taught(page, '=Zoë 1');
  assert.equal(name, 'Zoë-1.csv');
  assert.deepEqual([...bytes.subarray(0, 3)], [0xef, 0xbb, 0xbf]);
  const [head, ...rows] = bytes.toString().slice(1).trim().split('\r\n').map(fields);
  const of = column => rows.map(row => row[head.indexOf(column)]);
  assert.deepEqual([...new Set(of('robot'))], ["'=Zoë 1"]);
  const steps = of('kind').filter(kind => kind === 'lesson').length;
  assert.ok(steps > 1 && of('step')[steps - 1] === String(steps));
  assert.deepEqual(of('kind').slice(steps), ['test', 'test']);
  assert.deepEqual([...new Set(of('home'))], ['A', 'Test']);
  assert.deepEqual(of('guess').slice(steps), ['no', 'yes']);
  assert.deepEqual(of('session').slice(-3), ['1', '2', '3']);
  assert.match(rows.at(-1).join(), /blockInRoom\(block\d/);
  assert.ok(/agentInRoom\(agent0/.test(rows[0].join()), 'what the lesson meant');
  for (const sure of of('heard').slice(steps)) assert.ok(Number(sure) > 0 && Number(sure) < 1, sure);
  assert.deepEqual(of('right').slice(steps), ['no', 'no']);
  await close(page);
});

test('twenty-five tables are one table and one plot; what is no such table is named and left out', async () => {
  const page = await open(browser);
  const { bytes } = await taught(page, 'Ada');
  const text = bytes.toString();
  const files = Array.from({ length: 25 }, (_, at) => ({ name: 'robot' + at + '.csv', mimeType: 'text/csv', buffer: Buffer.from(text.replaceAll(',Ada,', ',"Ada, ""the ' + at + '.""",')) }));
  // A program for tables writes semicolons where the comma is for decimals.
  files[3].buffer = Buffer.from(text.replaceAll(/"[^"]*"/g, 'x').replaceAll(',', ';').replaceAll(';Ada;', ';<b>Bea;'));
  files.push({ name: 'notes.csv', mimeType: 'text/csv', buffer: Buffer.from('a,b\r\n1,2\r\n') });
  await page.setInputFiles('#open-class', files);
  await page.locator('#class[open]').waitFor();
  assert.match(await page.textContent('#toast'), /no tables of robots: notes\.csv/);
  assert.ok(await page.evaluate(() => document.getElementById('class').scrollTop === 0), 'the plot is seen first');
  const names = await page.locator('#class-table tbody th').allTextContents();
  assert.equal(names.length, 25);
  assert.deepEqual([names[0], names[3]], ['Ada, "the 0."', '<b>Bea']);
  const [, , lessons, , tests, , guesses] = await page.locator('#class-table tbody tr').first().locator('> *').allTextContents();
  assert.deepEqual([lessons, tests, guesses], ['1', '0 / 2', '1 / 2']);
  assert.equal(await page.locator('#class-chart .each').count(), 25);
  assert.match(await page.getAttribute('#class-chart', 'aria-label'), /: \d+%, \d+%, \d+%$/);
  const whole = await downloaded(page, '#save-class');
  assert.equal(whole.name, 'class.csv');
  const lines = whole.bytes.toString().trim().split('\r\n');
  assert.equal(lines.length, 25 * (text.trim().split('\r\n').length - 1) + 1);
  assert.equal(lines[0], text.trim().split('\r\n')[0]);
  await page.click('#close-class');
  await close(page);
});

test('a table is a QR code, too, and photos of codes are opened like tables', async () => {
  const page = await open(browser);
  await taught(page, 'Ada');
  await page.click('#show-table');
  await page.locator('#shared[open] #code').waitFor();
  const code = await page.inputValue('#link');
  assert.match(code, /^goodbot-table:/);
  assert.ok(await page.isHidden('#copy-link'), 'it is no link');
  await page.click('#close-link');
  await close(page);
  // Chromium reads codes on telephones and on some computers only, so that a reader of this test's own stands in for it. What stands on a photo is its bytes.
  const teacher = await openIn(await browser.newContext(), '', () => {
    Object.assign(window, {
      createImageBitmap: photo => photo.text(),
      BarcodeDetector: class {
        async detect(text) {
          if (text === 'damaged') throw new Error('no image');
          return text.split(' ').map(rawValue => ({ rawValue }));
        }
      },
    });
  });
  await opened(teacher, 'Settings, keeping, sharing');
  assert.match(await teacher.getAttribute('#open-class', 'accept'), /image/);
  const photo = (name, text) => ({ name, mimeType: 'image/jpeg', buffer: Buffer.from(text) });
  await teacher.setInputFiles('#open-class', [photo('two.jpg', code + ' https://example.org ' + code), photo('garden.jpg', 'flowers'), photo('half.jpg', code.slice(0, 90)), photo('dark.jpg', 'damaged')]);
  await teacher.locator('#class[open]').waitFor();
  assert.match(await teacher.textContent('#toast'), /no tables of robots: garden\.jpg, half\.jpg, dark\.jpg/);
  assert.deepEqual(await teacher.locator('#class-table tbody th').allTextContents(), ['Ada', 'Ada']);
  const [, , lessons, , tests] = await teacher.locator('#class-table tbody tr').first().locator('> *').allTextContents();
  assert.deepEqual([lessons, tests], ['1', '0 / 2']);
  await close(teacher);
});

test('for the next group one tap saves the table and empties the robot, its lessons and its tests', async () => {
  const page = await open(browser);
  await taught(page, 'Ada');
  await opened(page, 'Settings, keeping, sharing');
  const { name, bytes } = await downloaded(page, '#next-group');
  assert.equal(name, 'Ada.csv');
  assert.match(bytes.toString(), /,test,/);
  await page.locator('#toast', { hasText: 'It knows no word' }).waitFor();
  assert.equal(await sessions(page), 0);
  assert.match(await page.textContent('#tour-title'), /Lesson 1 of 7/);
  assert.equal(await page.locator('#dots .right, #dots .wrong').count(), 0);
  await opened(page, 'Your robots');
  assert.equal(await page.locator('#robots li').count(), 1);
  assert.match(await page.textContent('#deleted'), /Ada/, 'by mistake it is not lost');
  // A group that did nothing has no table.
  await page.click('#next-group');
  await page.locator('#toast', { hasText: 'It knows no word' }).waitFor();
  await close(page);
});

test('a link for a class fixes home, language and tabs, and a reload does not undo it', async () => {
  const page = await open(browser);
  await play(page, 'C');
  await page.selectOption('#language', 'fr');
  await page.locator('#tab-settings').click();
  for (const tab of ['words', 'steps', 'robots']) await page.uncheck('#show-' + tab);
  assert.deepEqual(await page.locator('#tabs button:visible').evaluateAll(all => all.map(({ id }) => id)), ['tab-thoughts', 'tab-challenges', 'tab-settings']);
  const hash = (await linkOf(page, '#share-class')).slice(address.length);
  assert.match(hash, /^#home=/);
  const home = await page.evaluate(() => window.goodbot.environment());
  const pupil = await openIn(await browser.newContext(), hash);
  for (let times = 0; times < 2; times += 1) {
    assert.equal(await pupil.getAttribute('html', 'lang'), 'fr');
    assert.equal(await pupil.textContent('#good b'), 'Bien');
    await pupil.click('[data-mode=play]');
    assert.equal(await pupil.evaluate(() => window.goodbot.environment()), home);
    assert.deepEqual(await pupil.locator('#tabs button:visible').evaluateAll(all => all.map(({ id }) => id)), ['tab-thoughts', 'tab-challenges', 'tab-settings']);
    await reload(pupil);
  }
  // A page that is open already takes it too; a link to a home alone leaves language and tabs as they are.
  const other = await openIn(await browser.newContext());
  await other.evaluate(text => { location.hash = text; }, hash);
  await other.waitForFunction(() => document.documentElement.lang === 'fr');
  assert.ok(await other.locator('#tab-words').isHidden());
  await page.click('#close-link');
  const plain = (await linkOf(page, '#share')).slice(address.length);
  const friend = await openIn(await browser.newContext(), plain);
  assert.equal(await friend.getAttribute('html', 'lang'), 'en');
  assert.equal(await friend.locator('#tab-robots:visible').count(), 1);
  for (const one of [pupil, other, friend]) await close(one);
  await close(page);
});
