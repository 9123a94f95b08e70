// A robot goes along to another device: as a link, or as text that is pasted there.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { fileURLToPath } from 'node:url';
import { after, before, test } from 'node:test';
import { close, launch, linkOf, model, open, openFirst, play, reload, sessions, teachInvention } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// A tour of which two lessons are done.
async function begun() {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  for (const lesson of [2, 3]) {
    await page.click('#auto');
    await page.getByText('Lesson ' + lesson + ' of 7').waitFor();
  }
  return page;
}

test('a robot goes on elsewhere where it was: what it has learned, its name and its tour; and it is told what stays', async () => {
  const page = await begun();
  await page.click('#tab-robots');
  await page.fill('#robots input', 'Kiki');
  await page.press('#robots input', 'Enter');
  const { hash } = new URL(await linkOf(page, '#along'));
  console.log(hash.length + ' letters');
  assert.match(await page.textContent('#shared-about'), /brings what Kiki has learned, its home and how far the tour is\. The session log, the table, tests of your own and the settings stay here\./);
  const other = await openFirst(browser, {}, hash);
  assert.match(await other.textContent('#tour-title'), /Lesson 3 of 7/);
  assert.equal(await other.locator('#dots .right, #dots .wrong').count(), await page.locator('#dots .right, #dots .wrong').count());
  assert.ok(await other.isHidden('#guest'), 'it is no visitor');
  assert.deepEqual(await model(other), await model(page));
  await reload(other);
  assert.match(await other.textContent('#tour-title'), /Lesson 3 of 7/);
  await other.selectOption('#speed', 'once');
  await other.click('#auto');
  await other.getByText('Lesson 4 of 7').waitFor();
  assert.equal(await sessions(other), 3);
  await other.click('#tab-robots');
  assert.deepEqual(await other.locator('#robots input').evaluateAll(all => all.map(one => one.value)), ['Robot 1', 'Kiki']);
  await close(other);
  await close(page);
});

test('the code is pasted on a device without a web address, as a whole link or its end; a damaged one is told', async () => {
  const page = await begun();
  await play(page, 'C');
  const link = await linkOf(page, '#along');
  for (const text of [link, link.replace(/.*#robot=/, '')]) {
    const other = await open(browser);
    await other.fill('#along-code', text.slice(0, -9));
    await other.press('#along-code', 'Enter');
    await other.getByText('The link is damaged').first().waitFor();
    assert.equal(await sessions(other), 0);
    await other.fill('#along-code', text);
    await other.press('#along-code', 'Enter');
    await other.waitForFunction(() => window.goodbot.sessions() === 2);
    assert.equal(await other.evaluate(() => window.goodbot.environment()), await page.evaluate(() => window.goodbot.environment()), 'in free play the home comes along');
    assert.equal(await other.inputValue('#along-code'), '');
    await close(other);
  }
  await close(page);
});

test('an invented language goes along with its words', async () => {
  const page = await openFirst(browser);
  await teachInvention(page);
  const { hash } = new URL(await linkOf(page, '#along'));
  const other = await openFirst(browser, {}, hash);
  assert.equal(await other.textContent('#tour-title'), await page.textContent('#tour-title'));
  await close(other);
  await close(page);
});

test('from a web address the code is a QR code, too, or it says that it is too long for one', async () => {
  const html = readFileSync(fileURLToPath(new URL('../../dist/goodbot.html', import.meta.url)));
  const server = createServer((_, response) => response.writeHead(200, { 'content-type': 'text/html; charset=utf-8' }).end(html));
  await new Promise(done => { server.listen(0, '127.0.0.1', done); });
  const page = await begun();
  page.complaints = { push() {} };
  await page.goto('http://127.0.0.1:' + server.address().port + '/');
  await page.waitForSelector('body.ready');
  await page.click('#along');
  await page.locator('#shared[open]').waitFor();
  const [isDrawn, about, link] = [await page.isVisible('#code'), await page.textContent('#shared-about'), await page.inputValue('#link')];
  assert.equal(isDrawn, link.length <= 2200);
  assert.equal(/too long for a QR code/.test(about), !isDrawn);
  await page.context().close();
  server.close();
});
