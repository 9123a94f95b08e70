// Nothing is lost unseen: a page that keeps nothing asks before it is closed, the session of a closed tab is resumed, two tabs share the
// progress of the tour, and a drawing that is no home is refused in words.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { BLOCKED, close, launch, open, openIn, play, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

async function begin(page) {
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
}

test('where nothing is kept, a page that has taught its robot asks before it goes', async () => {
  const context = await browser.newContext();
  const page = await openIn(context, '', BLOCKED);
  let asked = 0;
  page.on('dialog', async dialog => {
    assert.equal(dialog.type(), 'beforeunload');
    asked += 1;
    await dialog.accept();
  });
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await page.getByText('Lesson 2 of 7').waitFor();
  await page.reload();
  await page.waitForSelector('body.ready');
  assert.equal(asked, 1);
  await page.click('#again:visible, #lesson');
  await page.reload();
  await page.waitForSelector('body.ready');
  assert.equal(asked, 1, 'a robot that was taught nothing is no loss');
  await close(page);
});

test('where all is kept, nobody is asked', async () => {
  const page = await open(browser);
  page.on('dialog', dialog => assert.fail(dialog.type()));
  await page.selectOption('#speed', 'once');
  await page.click('#auto');
  await page.getByText('Lesson 2 of 7').waitFor();
  await page.reload();
  await page.waitForSelector('body.ready');
  await close(page);
});

test('a session whose tab was closed goes on in the next one, if a step of it was done', async () => {
  const one = await open(browser);
  await begin(one);
  await one.click('#pause');
  await one.click('#bad');
  const other = await openIn(one.context());
  assert.ok(await other.isVisible('#lesson'), 'as long as its tab is open, it is there');
  await other.close();
  await one.close();
  const two = await openIn(other.context());
  await two.getByText('Your session goes on where it was').first().waitFor();
  await two.getByText('You said Bad').or(two.locator('#steps tr.punish')).first().waitFor({ state: 'attached' });
  assert.match(await two.textContent('#tour-title'), /Lesson 1 of 7: “go to the green room”/);
  await two.click('#finish');
  await two.getByText('Lesson 2 of 7').waitFor();
  await two.close();
  const three = await openIn(other.context());
  assert.ok(await three.isVisible('#lesson'), 'what has ended does not come back');
  await begin(three);
  await three.close();
  const four = await openIn(other.context());
  assert.ok(await four.isVisible('#lesson'), 'what only began is not taken up');
  await begin(four);
  await four.click('#next');
  await four.waitForFunction(() => document.querySelectorAll('#steps tr').length === 1);
  await four.close();
  const five = await openIn(other.context());
  await five.getByText('Your session goes on where it was').first().waitFor();
  assert.equal(await five.locator('#steps tr').count(), 1, 'a step that nobody judged is one, too');
  await close(five);
});

test('two tabs stand at the same lesson of the tour', async () => {
  const one = await open(browser);
  const two = await openIn(one.context());
  await one.selectOption('#speed', 'once');
  await one.click('#auto');
  await one.getByText('Lesson 2 of 7').waitFor();
  await two.getByText('Lesson 2 of 7').waitFor();
  await two.selectOption('#speed', 'once');
  await two.click('#auto');
  await two.getByText('Lesson 3 of 7').waitFor();
  await one.getByText('Lesson 3 of 7').waitFor();
  assert.equal(await sessions(one), 2);
  await close(one);
});

test('a home that is too large is refused in plain words, `null` is no drawing, and an endless text is refused at once', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await page.click('[data-mode=build]');
  const refuse = async (text, why) => {
    await page.evaluate(value => { document.getElementById('home-text').value = value; }, text);
    const took = await page.evaluate(() => {
      const began = performance.now();
      document.getElementById('import').click();
      return performance.now() - began;
    });
    await page.waitForFunction(() => !document.getElementById('toast').hidden);
    assert.match(await page.textContent('#toast'), why);
    assert.match(await page.textContent('#build-error'), why, 'and nothing beside it says that it is a home');
    assert.doesNotMatch(await page.textContent('#build-error'), /Capacit|This is a home/);
    await page.evaluate(() => { document.getElementById('toast').hidden = true; });
    return took;
  };
  const room = (at, size = 4) => ({ class: 'room', name: 'room' + at, left: size * at, bottom: 0, right: size * at + size, top: size, color: 'red' });
  const agent = { class: 'agent', name: 'agent0', x: 1, y: 1 };
  const home = (...objects) => JSON.stringify({ version: 1, objects });
  await refuse(home(...Array.from({ length: 100 }, (_, at) => room(at, 2)), agent), /too many objects.*at most \d+/);
  await refuse(home(room(0, 60), agent), /floor is too large: it has at most \d+ cells/);
  const blocks = Array.from({ length: 30 }, (_, at) => ({ class: 'block', name: 'block' + at, x: 1 + at % 7, y: 2 + Math.floor(at / 7), color: 'red', shape: 'bag' }));
  await refuse(home(room(0, 8), ...blocks, agent), /too many things: there are at most \d+/);
  for (const text of ['null', '[1, 2]', '"home"', '7']) await refuse(text, /no home: something in it/);
  await refuse('[]', /“Show as JSON” shows how it is written \(line 1: is a list; write an object\)/);
  await page.selectOption('#language', 'de');
  await refuse('[]', /etwas darin fehlt.*\(line 1: is a list; write an object\)/);
  await page.selectOption('#language', 'en');
  const took = await refuse('#rrr#'.repeat(600000), /too long: a home has at most \d+ characters/);
  assert.ok(took < 2000, took + ' ms');
  await page.fill('#home-text', home(room(0), agent));
  await page.click('#import');
  await page.getByText('This is a home. The robot is in it.').waitFor();
  await close(page);
});
