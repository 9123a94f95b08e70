// What is said beside commands is no room.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, open, play, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const say = async (page, words) => {
  await page.fill('#command', words);
  await page.click('#say-it');
};

test('“stop”, “good” and “hello” are no commands; who means one can say so', async () => {
  const page = await open(browser);
  await play(page, 'A');
  for (const [words, answer] of [['stop', /Ready\. Tell me what to do/], ['Hello, robot!', /Ready\./], ['good', /Nothing to judge yet/], ['bad robot', /Nothing to judge yet/], ['😀', /There is no word in that/], ['?!', /There is no word in that/]]) {
    await say(page, words);
    assert.match(await page.textContent('#say'), answer, words);
    assert.ok(await page.isHidden('#finish'), words + ' begins no session');
  }
  await say(page, 'good');
  await page.click('#else');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#finish');
  await learned(page, 1);
  await page.click('#reset');
  await say(page, 'good');
  await page.getByText('Good or Bad?').waitFor();
  await close(page);
});

test('“undo” takes back the last session', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await say(page, 'undo');
  assert.ok(await page.isHidden('#finish'), 'there is nothing to undo, and nothing to do');
  await say(page, 'go to the red room');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#finish');
  await learned(page, 1);
  await say(page, 'undo');
  await learned(page, 0);
  assert.equal(await sessions(page), 0);
  await close(page);
});

test('talk is known in the language of the page', async () => {
  const page = await open(browser);
  await play(page, 'A');
  for (const [language, words] of [['de', ['halt', 'nein', 'gut']], ['fr', ['arrête', 'non', 'bien']], ['es', ['alto', 'no', 'bien']], ['zh', ['停', '不好', '好']]]) {
    await page.selectOption('#language', language);
    for (const word of words) {
      await say(page, word);
      assert.ok(await page.isVisible('#else'), language + ': ' + word);
      assert.ok(await page.isHidden('#finish'), language + ': ' + word);
    }
  }
  await close(page);
});
