// Nothing goes wrong in silence: a changed link, kept data that cannot be read, a voice that leaves the room, a drawing that jumps.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { address, close, drag, launch, learned, linkOf, open, openIn, opened, play, saved, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

test('a link to a home with any one letter changed is refused in words', async () => {
  const page = await open(browser);
  await page.click('[data-mode=play]');
  await opened(page, 'Settings, keeping, sharing');
  const hash = (await linkOf(page, '#share')).slice(address.length);
  const home = await page.evaluate(() => window.goodbot.environment());
  assert.ok(await page.isHidden('#code'), 'no telephone can open a file of this machine');
  await page.click('#close-link');
  for (const at of [7, 20, Math.floor(hash.length / 2), hash.length - 9]) {
    const changed = hash.slice(0, at) + (hash[at] === 'Q' ? 'R' : 'Q') + hash.slice(at + 1);
    await page.evaluate(text => {
      document.getElementById('toast').hidden = true;
      location.hash = text;
    }, changed);
    await page.locator('#toast.wrong:visible').waitFor();
    assert.match(await page.textContent('#toast'), /damaged|newer page/, 'letter ' + at);
    assert.equal(await page.evaluate(() => window.goodbot.environment()), home);
  }
  const whole = await openIn(page.context(), hash);
  assert.equal(await whole.evaluate(() => window.goodbot.environment()), home);
  await close(page);
});

test('what is kept and cannot be read is told, stays, and can be saved as a file', async () => {
  const context = await browser.newContext();
  const page = await openIn(context);
  const kept = { 'goodbot.robot.damaged': '{"version":2,"id":"dam', 'goodbot.log.damaged': 'its lessons', 'goodbot.robot.newer': '{"version":99}', 'goodbot.drawing': '{"file":' };
  await page.evaluate(all => { for (const [key, text] of Object.entries(all)) localStorage.setItem(key, text); }, kept);
  await page.reload();
  await page.waitForSelector('body.ready');
  assert.match(await page.textContent('#unread'), /^3 things saved in this browser cannot be read here/);
  const file = JSON.parse(String(await saved(page, '#unread button')));
  assert.deepEqual([file['robot.damaged'], file['log.damaged'], file['robot.newer'], file['unread.drawing']], Object.values(kept));
  assert.equal(await page.evaluate(() => localStorage.getItem('goodbot.robot.newer')), kept['goodbot.robot.newer'], 'a newer page can still read it');
  assert.equal(await sessions(page), 0);
  await close(page);
});

// A robot with one lesson, in free play.
async function taught(context) {
  const page = await openIn(context);
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await page.fill('#command', 'go to the red room');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#good');
  return page;
}

test('a robot whose model is damaged is told and can be saved as a file, with its lessons', async () => {
  const page = await taught(await browser.newContext());
  await page.click('#finish');
  await learned(page, 1);
  const key = await page.evaluate(() => {
    const [one] = Object.keys(localStorage).filter(name => name.startsWith('goodbot.robot.'));
    localStorage.setItem(one, JSON.stringify({ ...JSON.parse(localStorage.getItem(one)), model: 'AAAAAAAA' }));
    return one.slice('goodbot.'.length);
  });
  await page.reload();
  await page.waitForSelector('body.ready');
  assert.match(await page.textContent('#unread'), /^1 thing saved in this browser cannot be read here/);
  const file = JSON.parse(String(await saved(page, '#unread button')));
  assert.match(file[key], /AAAAAAAA/);
  assert.match(file[key.replace('robot', 'log')], /go to the red room/);
  await close(page);
});

test('a damaged session under way does not vanish in silence, and can be saved as a file', async () => {
  for (const damaged of [text => text.replace(/"action\\?":\\?"\w+/, '"action\\":\\"flies'), text => text.slice(0, 300)]) {
    const page = await taught(await browser.newContext());
    const text = damaged(await page.evaluate(() => sessionStorage.getItem('goodbot.session')));
    assert.notEqual(text, await page.evaluate(() => sessionStorage.getItem('goodbot.session')));
    await page.evaluate(session => sessionStorage.setItem('goodbot.session', session), text);
    await page.reload();
    await page.waitForSelector('body.ready');
    assert.match(await page.textContent('#unread'), /^1 thing saved in this browser cannot be read here/);
    assert.equal(JSON.parse(String(await saved(page, '#unread button')))['unread.session'], text);
    await page.reload();
    await page.waitForSelector('body.ready');
    assert.ok(await page.isHidden('#unread'), 'once it is saved, it is not told again');
    await close(page);
  }
});

test('where all can be read, nothing is told', async () => {
  const page = await open(browser);
  assert.ok(await page.isHidden('#unread'));
  await close(page);
});

test('the page says who may get a voice, and a teacher can switch that off', async () => {
  const context = await browser.newContext();
  const page = await openIn(context, '', () => { Object.assign(window, { webkitSpeechRecognition: class {} }); });
  await page.click('[data-mode=play]');
  assert.ok(await page.isVisible('#speak'));
  assert.match(await page.textContent('footer'), /“Speak”.*may send your voice to its maker/);
  await page.uncheck('#set-speech');
  assert.ok(await page.isHidden('#speak'));
  await page.reload();
  await page.waitForSelector('body.ready');
  await page.click('[data-mode=play]');
  assert.ok(await page.isHidden('#speak'), 'after a reload too');
  await close(page);
});

test('the drawing keeps its scale from stroke to stroke, and an empty one is no error', async () => {
  for (const locale of ['en', 'de']) {
    const page = await open(browser, { locale });
    await page.click('[data-mode=build]');
    await page.click('#clear');
    assert.match(await page.textContent('#build-error'), locale === 'en' ? /^Draw a room first/ : /^Zeichne zuerst/);
    assert.equal(await page.locator('#build-error.wrong').count(), 0);
    const frame = () => page.getAttribute('#draft', 'viewBox');
    const before = await frame();
    await drag(page, 'room', [3, 3], [6, 6]);
    assert.equal(await frame(), before, 'the next stroke lands where it is drawn');
    assert.match(await page.textContent('#build-error'), locale === 'en' ? /^Now put the robot/ : /^Setz jetzt/);
    await drag(page, 'agent', [3, 3]);
    assert.match(await page.textContent('#build-error'), locale === 'en' ? /robot: it stands in a wall/ : /Roboter: steht in einer Wand/);
    await drag(page, 'agent', [4, 4]);
    assert.match(await page.textContent('#build-error'), locale === 'en' ? /^This is a home/ : /Haus/);
    await close(page);
  }
});
