// What a class takes home on paper: a certificate and a worksheet, each on one page, in all languages.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';
import { close, launch, open } from './browser.mjs';

const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');
let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// The sheet that a button prints, as text, and how many pages it has.
async function sheet(page, button) {
  await page.evaluate(() => { window.print = () => {}; });
  await page.click(button);
  await page.emulateMedia({ media: 'print' });
  const { violations } = await page.evaluate(() => window.axe.run('#paper', { resultTypes: ['violations'] }));
  assert.deepEqual(violations.map(({ id, nodes }) => id + ' at ' + nodes.map(({ target }) => target)), []);
  const text = await page.innerText('body');
 
  const pages = (await page.pdf({ format: 'A4' })).toString('latin1').match(/\/Type \/Page\b/g).length;
  await page.emulateMedia({ media: 'screen' });
  await page.evaluate(() => window.dispatchEvent(new Event('afterprint')));
  return { text, pages };
}

test('where a class ends, a certificate and the worksheet are printed, each on one page, in all languages', async () => {
  const page = await open(browser, { bypassCSP: true, viewport: { width: 794, height: 1000 } });
  await page.addScriptTag({ path: axe });
  await page.selectOption('#speed', 'once');
  for (let at = 1; at <= 12; at += 1) {
    await page.click(at <= 7 ? '#auto' : '#lesson');
    await page.waitForFunction(done => document.querySelectorAll('#dots :is(.right, .wrong)').length === done && document.body.dataset.phase === 'none', at);
  }
  await page.fill('#robot-name', 'Ада & Bo');
  await page.press('#robot-name', 'Enter');
  for (const language of ['de', 'es', 'fr', 'zh', 'en']) {
    await page.selectOption('#language', language);
    const certificate = await sheet(page, '#print-certificate');
    assert.match(certificate.text, /Ада & Bo/);
    assert.match(certificate.text, /green = /, 'it has the words that were learned');
    assert.match(certificate.text, new RegExp(String(new Date().getFullYear())));
    assert.equal(certificate.pages, 1);
    const worksheet = await sheet(page, '#print-worksheet');
    assert.match(worksheet.text, /A\.[^]*B\.[^]*C\./);
    assert.equal(worksheet.pages, 1);
  }
  assert.match(await page.innerText('body'), /The tour is over/, 'the page itself is there again');
  await close(page);
});

test('a teacher prints the worksheet before the lesson, and without known words there is no certificate', async () => {
  const page = await open(browser, { bypassCSP: true });
  await page.addScriptTag({ path: axe });
  const { text, pages } = await sheet(page, '#worksheet');
  assert.match(text, /Who decides what “lumi” means\?/);
  assert.equal(pages, 1);
  assert.equal(await page.locator('#print-certificate').count(), 0);
  await close(page);
});
