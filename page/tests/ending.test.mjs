// Every lesson ends well.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { after, before, test } from 'node:test';
import { close, launch, open, openFirst, pass, play, sessions, stopTime, takePaper, teachInvention, toTheGoal } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

test('at the goal one big button says yes, ends and learns', async () => {
  const page = await open(browser, { reducedMotion: 'no-preference' });
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await toTheGoal(page, /green/, good => page.click(good ? '#good' : '#bad'));
  assert.match(await page.textContent('#say'), /I am in the green room/);
  await page.click('#finish');
  await page.getByText('Lesson 2 of 7').waitFor();
  assert.equal(await sessions(page), 1);
  assert.match(await page.textContent('#say'), /New words: go, to, the, green, room/);
  assert.equal(await page.evaluate(() => document.activeElement.id), 'lesson', 'the next useful thing has the focus');
  await close(page);
});

test('after a lesson the robot says which words became clear', async () => {
  const page = await open(browser);
  await page.selectOption('#speed', 'once');
  const said = [];
  for (const lesson of [2, 3, 4]) {
    await page.click('#auto');
    await page.getByText('Lesson ' + lesson + ' of 7').waitFor();
    said.push(await page.textContent('#say'));
  }
  // Each word is told once, when it has become clear.
  assert.match(said.join(' '), /Now I know: .*“green” means the colour green/);
  await close(page);
});

// A tour of one's own to its end, by the auto-trainer.
async function finished(page) {
  await page.selectOption('#speed', 'once');
  for (let at = 1; at <= 12; at += 1) {
    await page.click(at <= 7 ? '#auto' : '#lesson');
    await page.waitForFunction(done => document.querySelectorAll('#dots :is(.right, .wrong)').length === done && document.body.dataset.phase === 'none', at);
  }
  await page.locator('#card:visible').waitFor();
}

test('at the end Good and Bad make room for the plan, and the next thing is seen whole; in the class view all is seen', async () => {
  const page = await open(browser, { viewport: { width: 1280, height: 720 } });
  await finished(page);
  assert.ok(await page.locator('#good').isHidden());
  assert.ok(await page.evaluate(() => document.getElementById('onward').getBoundingClientRect().bottom <= innerHeight));
  await page.check('#set-presenter');
  const tall = [];
  for (const language of ['en', 'de', 'es', 'fr', 'zh']) {
    await page.evaluate(code => {
      const select = document.getElementById('language');
      select.value = code;
      select.dispatchEvent(new Event('change'));
    }, language);
    const height = await page.evaluate(() => document.documentElement.scrollHeight);
    if (height > 720) tall.push(language + ': ' + height);
  }
  assert.deepEqual(tall, []);
  assert.ok(await page.locator('#card li').evaluateAll(all => all.every(one => parseFloat(getComputedStyle(one).fontSize) >= 12)), 'the class reads what the words mean');
  await page.click('#end-presenter');
  await page.click('[data-mode=play]');
  assert.ok(await page.locator('#good').isVisible());
  await close(page);
});

// A PNG file's width and height.
const sizeOf = png => [png.subarray(1, 4).toString(), png.readUInt32BE(16), png.readUInt32BE(20)];

test('the tour ends with a name, a dance and a card of what the robot knows', async () => {
  const page = await open(browser, { reducedMotion: 'no-preference' });
  await finished(page);
  assert.match(await page.textContent('#card'), /green = the colour green/);
  const dancing = () => page.evaluate(() => document.getAnimations().some(({ animationName }) => animationName === 'dance'));
  assert.ok(await dancing());
  await page.fill('#robot-name', 'Rusty');
  await page.press('#robot-name', 'Enter');
  await page.getByText('I am Rusty!').first().waitFor();
  assert.equal((await page.textContent('#say')).trim(), 'I am Rusty!');
  assert.equal((await page.innerText('body')).match(/5 of 5|all five/g).length, 1, 'the score is told once');
  assert.equal(await page.locator('#card li', { hasText: 'chair' }).textContent(), 'chair', 'a chair is a chair');
  assert.ok(await dancing());
  await page.reload();
  await page.waitForSelector('body.ready');
  assert.equal(await page.inputValue('#robot-name'), 'Rusty', 'the name stays');
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-card')]);
  assert.equal(download.suggestedFilename(), 'my-robot.png');
  const [kind, width, height] = sizeOf(readFileSync(await download.path()));
  assert.deepEqual([kind, width], ['PNG', 1080]);
  assert.ok(height > 800, String(height));
  await close(page);
});

test('on a phone the dance is seen first', async () => {
  const page = await open(browser, { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
  await finished(page);
  await page.evaluate(() => scrollTo(0, 0));
  const { top, bottom } = await page.evaluate(() => document.querySelector('#plan .robot').getBoundingClientRect());
  assert.ok(top > 0 && bottom < 844 / 2, JSON.stringify([top, bottom]));
  await close(page);
});

test('where motion is not wanted, the robot smiles and does not dance', async () => {
  const page = await open(browser, { reducedMotion: 'reduce' });
  await finished(page);
  assert.equal(await page.locator('#plan .robot.happy').count(), 1);
  assert.ok(!(await page.evaluate(() => document.getAnimations().length)));
  await close(page);
});

test('from a server, the card has a code that a phone can read, and the system’s sheet gets card and link', async () => {
  const server = createServer((_, answer) => answer.end(readFileSync(new URL('../../dist/goodbot.html', import.meta.url))));
  await new Promise(done => { server.listen(0, '127.0.0.1', done); });
  const { port } = /** @type {import('node:net').AddressInfo} */ (server.address());
  const page = await (await browser.newContext()).newPage();
  await page.addInitScript(() => {
    navigator.canShare = () => true;
    navigator.share = async data => { window.given = data; };
  });
  await page.goto('http://127.0.0.1:' + port + '/');
  await page.waitForSelector('body.ready');
  await takePaper(page);
  await finished(page);
  await page.click('#share-card');
  await page.waitForFunction(() => window.given);
  const { url, title, widest } = await page.evaluate(async () => {
    const { files: [file], url: link, title: name } = window.given;
    const image = await createImageBitmap(file);
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    // The marks in the corners of a code are dark and light as 1 : 1 : 3 : 1 : 1.
    let square = 0;
    for (let y = 0; y < image.height; y += 1) {
      const runs = [0];
      for (let x = 1; x < image.width; x += 1) {
        const [now, then] = [x, x - 1].map(at => data[(y * image.width + at) * 4] < 128);
        if (now === then) runs[runs.length - 1] += 1;
        else runs.push(1);
      }
      for (let at = 0; at + 4 < runs.length; at += 1) {
        const [a, b, c, d, e] = runs.slice(at, at + 5);
        if (a > 1 && a === b && a === d && a === e && c === 3 * a) square = Math.max(square, a);
      }
    }
    return { url: link, title: name, widest: square };
  });
  assert.match(url, /^http:\/\/127\.0\.0\.1:\d+\/#robot=/);
  assert.match(title, /^Meet /);
  assert.ok(widest >= 4, 'a square of the code is ' + widest + ' pixels wide');
  await page.context().close();
  server.close();
});

test('the whole tour is watched in less than a minute', async () => {
  const page = await open(browser, { reducedMotion: 'no-preference' });
  await stopTime(page);
  await page.click('#watch');
  let seconds = 0;
  for (; seconds < 90 && !/The tour is over/.test(await page.textContent('#tour-title')); seconds += 1) await pass(page, 1000);
  console.log('watched in ' + seconds + ' s, and what it takes to plan and to learn');
  assert.ok(seconds > 25 && seconds < 55, seconds + ' s');
  await close(page);
});

test('the dots lead to lessons and tests', async () => {
  const page = await open(browser);
  await page.locator('#dots button').nth(4).click();
  assert.match(await page.textContent('#tour-title'), /Lesson 5 of 7/);
  await page.locator('#dots button').nth(0).click();
  assert.match(await page.textContent('#tour-title'), /Lesson 1 of 7/);
  await close(page);
});

test('a success has its moment: the robot is glad where it has got to, a new word flies to the known ones, and the next lesson begins by itself', async () => {
  const page = await openFirst(browser, { reducedMotion: 'no-preference' });
  await page.selectOption('#speed', 'step');
  for (const meant of [/red/, /blue/]) {
    await page.click('#lesson');
    await toTheGoal(page, meant, good => page.click(good ? '#good' : '#bad'));
    const at = await page.evaluate(() => JSON.parse(window.goodbot.scene()).agent.x);
    const began = await page.evaluate(() => performance.now());
    await page.click('#finish');
    await page.waitForFunction(() => document.body.dataset.phase === 'moment');
    assert.equal(await page.locator('#plan .robot.happy.dancing').count(), 1);
    assert.equal(await page.evaluate(() => JSON.parse(window.goodbot.scene()).agent.x), at, 'it is still where it has got to');
    assert.ok(await page.isHidden('#lesson') && await page.isVisible('#verdict'));
    const flying = () => page.evaluate(() => document.getAnimations().filter(({ effect }) => effect.target.closest('#word-shelf')).length);
    // One lesson cannot tell the words apart; with the second they are clear.
    if (meant.test('blue')) assert.equal(await flying(), 2);
    await page.waitForFunction(() => document.body.dataset.phase === 'none');
    const took = await page.evaluate(() => performance.now()) - began;
    assert.ok(took > 1400 && took < 6000, took + ' ms');
    assert.ok(await page.isVisible('#own-words'));
  }
  assert.deepEqual(await page.locator('#word-shelf b').allTextContents(), ['blip', 'zot']);
  await close(page);
});

test('whoever goes elsewhere in the moment of a success stays there, and the tour has gone on', async () => {
  const page = await open(browser, { reducedMotion: 'no-preference' });
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await toTheGoal(page, /green/, good => page.click(good ? '#good' : '#bad'));
  await page.click('#finish');
  await page.waitForFunction(() => document.body.dataset.phase === 'moment');
  await page.click('[data-mode=build]');
  await page.waitForFunction(() => document.body.dataset.phase === 'none');
  assert.ok(await page.isVisible('#draft'));
  await page.click('[data-mode=tour]');
  assert.match(await page.textContent('#tour-title'), /Lesson 2 of 7/);
  // So does who changes the robot in that moment, also if it then learns for longer.
  await page.click('#lesson');
  await toTheGoal(page, /red/, good => page.click(good ? '#good' : '#bad'));
  await page.click('#finish');
  await page.waitForFunction(() => document.body.dataset.phase === 'moment');
  await page.evaluate(() => {
    const robot = Object.getPrototypeOf(window.goodbot);
    const { learn } = robot;
    const until = performance.now() + 2000;
    robot.learn = function (budget) { return performance.now() > until && learn.call(this, budget); };
    document.getElementById('set-ways').click();
  });
  await page.waitForTimeout(4000);
  assert.equal(await page.evaluate(() => document.body.dataset.phase), 'none');
  assert.match(await page.textContent('#tour-title'), /Lesson 3 of 7/);
  assert.match(await page.evaluate(() => window.goodbot.environment()), /"color":"blue"/, 'it is in the home of that lesson');
  await close(page);
});

test('the card is seen before it is saved, and a long name fits on it; that of an invented language is a riddle', async () => {
  const page = await openFirst(browser);
  await teachInvention(page);
  await page.click('#lesson');
  await page.getByText('Skip the walk').waitFor();
  await page.click('#lesson');
  const seen = () => page.getAttribute('#preview img', 'src');
  await page.locator('#preview img').waitFor();
  const before = await seen();
  await page.fill('#robot-name', 'W'.repeat(40));
  await page.press('#robot-name', 'Enter');
  await page.waitForFunction(src => document.querySelector('#preview img').getAttribute('src') !== src, before);
  // Between the edge of the card and its frame nothing is drawn, nor is there within the frame where the name ends.
  const dark = await page.evaluate(async () => {
    const image = document.querySelector('#preview img');
    await image.decode();
    const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight);
    const context = canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    const count = (x, width) => [...context.getImageData(x, 500, width, 110).data].filter((value, at) => at % 4 === 0 && value < 120).length;
    return [count(34, 40), count(540, 400), count(image.naturalWidth - 74, 40)];
  });
  assert.equal(dark[0] + dark[2], 0, 'the name is cut off: ' + dark);
  assert.ok(dark[1] > 0, 'the name is there');
  await close(page);
});

test('in the moment of a success the plan keeps its size, on a small phone too', async () => {
  const page = await open(browser, { viewport: { width: 360, height: 640 }, reducedMotion: 'no-preference' });
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await toTheGoal(page, /green/, good => page.click(good ? '#good' : '#bad'));
  const before = await page.locator('#plan').boundingBox();
  await page.click('#finish');
  await page.waitForFunction(() => document.body.dataset.phase === 'moment');
  const now = await page.locator('#plan').boundingBox();
  assert.deepEqual([now.width, now.height], [before.width, before.height]);
  await close(page);
});

test('one known word is one word, in each language that tells one from many', async () => {
  const page = await open(browser);
  await page.evaluate(() => { window.goodbot.heat = () => JSON.stringify({ words: ['mokka'], tokens: ['colorRed'], cells: [0.9], idle: [0.1], letters: 0 }); });
  await page.selectOption('#speed', 'once');
  await page.check('#set-starter');
  await page.locator('#dots button').last().click();
  await page.click('#lesson');
  for (const [language, words] of [['de', 'Er kennt 1 Wort gut:'], ['fr', 'Il connaît bien 1 mot :'], ['es', 'Conoce bien 1 palabra:'], ['en', 'It knows 1 word well:']]) {
    await page.selectOption('#language', language);
    assert.equal((await page.locator('#card p').first().textContent()).replaceAll('\u00a0', ' '), words);
  }
  await close(page);
});

test('a lesson in free play that succeeds has its moment too: the robot is glad, and the words that became clear fly to the known ones', async () => {
  const page = await open(browser, { reducedMotion: 'no-preference' });
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  const known = () => page.locator('#word-shelf b').allTextContents();
  for (let lesson = 0; lesson < 5 && !(await known()).length; lesson += 1) {
    const [command, meant] = lesson % 2 ? ['mokka zot', /green/] : ['blip zot', /red/];
    await page.click('#reset');
    await page.fill('#command', command);
    await page.click('#say-it');
    await toTheGoal(page, meant, good => page.click(good ? '#good' : '#bad'));
    await page.click('#good');
    await page.waitForFunction(() => document.body.dataset.phase === 'moment');
    assert.equal(await page.locator('#plan .robot.happy.dancing').count(), 1);
    const flying = await page.evaluate(() => document.getAnimations().filter(({ effect }) => effect.target.closest('#word-shelf')).length);
    assert.equal(flying, (await known()).length);
    await page.waitForFunction(() => document.body.dataset.phase === 'none');
  }
  assert.ok((await known()).length && await page.isVisible('#word-shelf'));
  // Whoever speaks in that moment is heard at once.
  await page.fill('#command', 'blip zot');
  await page.click('#say-it');
  await toTheGoal(page, /red/, good => page.click(good ? '#good' : '#bad'));
  await page.click('#good');
  await page.waitForFunction(() => document.body.dataset.phase === 'moment');
  await page.fill('#command', 'mokka zot');
  await page.click('#say-it');
  await page.getByText('Good or Bad?').waitFor();
  await page.waitForTimeout(1700);
  assert.ok(await page.isVisible('#finish'), 'and the lesson is not disturbed');
  await close(page);
});
