// Takes the README's picture, in the middle of the fifth lesson: `node picture.mjs FILE`.
import { writeFileSync } from 'node:fs';
import { close, launch, open } from './browser.mjs';
import { dense } from './png.mjs';

const browser = await launch();
const page = await open(browser, { viewport: { width: 1280, height: 746 } });
await page.selectOption('#speed', 'once');
for (let lesson = 1; lesson <= 4; lesson += 1) {
  await page.click('#auto');
  await page.getByText('Lesson ' + (lesson + 1) + ' of 7').waitFor();
}
await page.selectOption('#speed', 'step');
await page.click('#lesson');
for (let step = 0; step < 3; step += 1) {
  await page.getByText('Good or Bad?').waitFor();
  const meant = await page.textContent('#bars .best .label');
  await page.click(/chair to the yellow/.test(meant) ? '#good' : '#bad');
  await page.waitForTimeout(900);
}
// The heart is shown while the feedback waits for the next step.
await page.click('#pause');
await page.click('#good');
await page.waitForTimeout(230);
writeFileSync(process.argv[2], dense(await page.screenshot()));
await close(page);
await browser.close();
