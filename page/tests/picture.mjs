// Takes the README's picture: `node picture.mjs FILE`.
import { writeFileSync } from 'node:fs';
import { close, launch, open } from './browser.mjs';
import { dense } from './png.mjs';

const browser = await launch();
const page = await open(browser, { viewport: { width: 1100, height: 800 } });
await page.selectOption('#speed', 'once');
for (let lesson = 1; lesson <= 4; lesson += 1) {
  await page.click('#auto');
  await page.getByText('Lesson ' + (lesson + 1) + ' of 7').waitFor();
}
await page.selectOption('#speed', 'step');
await page.click('#lesson');
for (const word of ['#good', '#bad', '#good', '#good']) {
  await page.getByText('Good or Bad?').waitFor();
  await page.click(word);
  await page.waitForTimeout(900);
}
await page.click('#good');
await page.waitForTimeout(300);
writeFileSync(process.argv[2], dense(await page.screenshot()));
await close(page);
await browser.close();
