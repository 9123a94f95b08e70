// The visible parts of the page on screens of every size.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { address, close, launch, learned, open, openFirst, play, second, still } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

test('on a phone, every home and all that judges are seen whole in a session', async () => {
  const page = await open(browser, { viewport: { width: 360, height: 640 }, hasTouch: true, isMobile: true });
  for (const home of ['A', 'B', 'C', 'D', 'E', 'F', 'Test']) {
    await play(page, home);
    await page.selectOption('#speed', 'step');
    await page.fill('#command', 'take the purple chair to the green room');
    await page.tap('#say-it');
    await page.getByText('Good or Bad?').waitFor();
    // The robot may have much to say.
    await page.evaluate(() => { document.querySelector('#say strong').textContent = 'Perhaps you mean: take the magenta backpack (block12) to the yellow room (room10)?'; });
    await page.tap('#pause');
    await page.tap('#good');
    const box = async id => page.locator(id).boundingBox();
    const [plan, desk, good, bad, finish] = await Promise.all(['#plan', '.desk', '#good', '#bad', '#finish'].map(box));
    assert.equal(await page.evaluate(() => window.scrollY), 0);
    assert.ok(plan.y >= 0 && plan.y + plan.height <= desk.y, 'home ' + home + ': the plan ends at ' + (plan.y + plan.height) + ', and the buttons begin at ' + desk.y);
    assert.ok(plan.height >= 200 && plan.x >= 0 && plan.x + plan.width <= 360, JSON.stringify(plan));
    for (const button of [good, bad, finish]) assert.ok(button.x >= 0 && button.x + button.width <= 360 && button.y + button.height <= 640, JSON.stringify(button));
    await page.tap('#drop');
  }
  await close(page);
});

for (const [width, height] of [[320, 568], [320, 256], [640, 480], [640, 900], [414, 736], [1280, 720]]) {
  test('in a session, the plan and the buttons are seen together on ' + width + ' by ' + height + ' pixels', async () => {
    const page = await open(browser, { viewport: { width, height } });
    await page.selectOption('#speed', 'step');
    await page.click('#lesson');
    await page.getByText('Good or Bad?').waitFor();
    await still(page);
    const { clipped, scroll, ...boxes } = await page.evaluate(() => {
      const found = Object.fromEntries(['plan', 'good', 'bad', 'finish'].map(id => {
        const { left, right, top, bottom } = document.getElementById(id).getBoundingClientRect();
        return [id, { left, right, top, bottom }];
      }));
      const cut = [...document.querySelectorAll('#train button, #say, #to')].filter(element => element.offsetParent && element.scrollWidth > element.clientWidth + 1);
      return { ...found, clipped: cut.map(element => element.id), scroll: document.documentElement.scrollWidth };
    });
    assert.ok(scroll <= width, 'the page is ' + scroll + ' pixels wide');
    assert.deepEqual(clipped, []);
    for (const [id, { left, right, top, bottom }] of Object.entries(boxes)) {
      assert.ok(left >= -1 && right <= width + 1 && top >= 0 && bottom <= height, id + ' is not seen whole: ' + JSON.stringify(boxes[id]));
    }
    const { plan, good, bad, finish } = boxes;
    for (const each of [good, bad, finish]) assert.ok(each.top >= plan.bottom || each.left >= plan.right || each.right <= plan.left, 'a button covers the plan: ' + JSON.stringify(boxes));
    assert.ok(plan.bottom - plan.top >= Math.min(100, height * 0.3), JSON.stringify(plan));
    await close(page);
  });
}

for (const first of [true, false]) for (const locale of ['de', 'es']) test('on the smallest phone no name lies over another or over a wall, in ' + (first ? 'the first visit: ' : 'the tests: ') + locale, async () => {
  const page = await (first ? openFirst : open)(browser, { viewport: { width: 320, height: 568 }, locale, isMobile: true, hasTouch: true });
  if (!first) await page.locator('#dots button.test').first().click();
  await still(page);
  const over = await page.evaluate(() => {
    const names = [...document.querySelectorAll('#plan :is(.roomname, .blockname)')].filter(name => name.getBoundingClientRect().width);
    const within = document.querySelector('#plan .wall').getBoundingClientRect();
    const boxes = names.map(name => ({ name: name.textContent, box: name.getBoundingClientRect() }));
    return boxes.filter(({ box }, at) => box.left < within.left || box.right > within.right
      || boxes.some((other, there) => there !== at && other.box.left < box.right && box.left < other.box.right && other.box.top < box.bottom && box.top < other.box.bottom)).map(({ name }) => name);
  });
  assert.deepEqual(over, []);
  await close(page);
});

test('on the smallest phone all tabs of the tour are seen whole, and on a small desktop those of free play, in every language', async () => {
  for (const locale of ['de', 'en', 'es', 'fr', 'zh-CN']) {
    const page = await open(browser, { viewport: { width: 320, height: 568 }, locale, isMobile: true, hasTouch: true });
    await page.selectOption('#speed', 'once');
    await page.click('#auto');
    await learned(page, 1);
    const cut = await page.locator('[role=tab]:visible').evaluateAll(tabs => tabs.filter(tab => tab.getBoundingClientRect().right > 320).map(tab => tab.id));
    assert.deepEqual(cut, [], locale);
    await page.setViewportSize({ width: 1280, height: 720 });
    await page.click('[data-mode=play]');
    assert.deepEqual(await page.locator('#tabs').evaluate(tabs => tabs.scrollWidth - tabs.clientWidth), 0, locale);
    await close(page);
  }
});

// For the named elements: where they are, whether anything covers them, and how wide the page is.
const seen = (page, ids) => page.evaluate(names => ({
  scroll: document.documentElement.scrollWidth,
  boxes: Object.fromEntries(names.map(id => {
    const element = document.getElementById(id);
    const { left, right, top, bottom } = element.getBoundingClientRect();
    const on = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
    return [id, { left, right, top, bottom, covered: !element.contains(on) }];
  })),
}), ids);

// The home of the first visit is twice as wide as it is high.
for (const first of [true, false]) for (const [width, height, least, settings] of [[320, 568, 180, '{}'], [360, 640, 200, '{}'], [390, 844, 300, '{}'], [1280, 720, 400, '{}'], [1280, 720, 500, '{"presenter":true}'], [1920, 1080, 700, '{}']]) {
  test('on arrival at ' + width + ' by ' + height + ' pixels, what begins and the plan are seen whole, and Good and Bad where they are not in the way' + (settings === '{}' ? '' : ', in the class view too') + (first ? '' : ', and in the tour of the paper'), async () => {
    const page = await (first ? openFirst : open)(browser, { viewport: { width, height } });
    await page.evaluate(kept => localStorage.setItem('goodbot.settings', kept), settings);
    await page.reload();
    await page.waitForSelector('body.ready');
    await still(page);
    // On a phone there is nothing to judge yet.
    const wide = width > 860;
    const { scroll, boxes } = await seen(page, ['lesson', ...(first ? ['own-words'] : []), 'plan', ...(wide ? ['good', 'bad'] : [])]);
    assert.equal(await page.isVisible('#good'), wide);
    assert.ok(scroll <= width, 'the page is ' + scroll + ' pixels wide');
    for (const [id, box] of Object.entries(boxes)) assert.ok(box.left >= 0 && box.right <= width && box.top >= 0 && box.bottom <= height && !box.covered, id + ': ' + JSON.stringify(box));
    const { plan, good } = boxes;
    assert.ok(!good || plan.bottom <= good.top || plan.right <= good.left, 'the plan is above the buttons or beside them: ' + JSON.stringify(boxes));
    assert.ok(plan.bottom - plan.top >= (first && !wide ? 0.45 * width : least), 'the plan is ' + (plan.bottom - plan.top) + ' pixels high');
    await close(page);
  });
}

test('the class view fits on the screen, whatever its size', async () => {
  const page = await open(browser);
  await page.evaluate(() => localStorage.setItem('goodbot.settings', '{"presenter":true}'));
  await page.reload();
  await page.waitForSelector('body.ready');
  const tall = [];
  for (const [width, height] of [[1024, 768], [1280, 720], [1366, 768], [1920, 1080], [2560, 1440], [768, 1024], [375, 667]]) {
    await page.setViewportSize({ width, height });
    await still(page);
    const scroll = await page.evaluate(() => document.documentElement.scrollHeight);
    if (scroll > height) tall.push(width + ' by ' + height + ': ' + scroll);
  }
  assert.deepEqual(tall, []);
  await page.setViewportSize({ width: 1280, height: 720 });
  await page.evaluate(() => document.querySelector('[data-mode=play]').click());
  await page.fill('#command', 'go there');
  await page.keyboard.press('Enter');
  await page.getByText('Go on without an answer').click();
  await page.getByText('Good or Bad?').waitFor();
  await still(page);
  const { finish, plan } = (await seen(page, ['finish', 'plan'])).boxes;
  assert.ok(finish.bottom <= 720 && !finish.covered && plan.bottom <= 720, JSON.stringify({ finish, plan }));
  await close(page);
});

test('on arrival there are three lines to read at most, and the foot of the page is seen whole, in every language', async () => {
  const page = await openFirst(browser, { viewport: { width: 1280, height: 720 } });
  const languages = ['en', 'de', 'es', 'fr', 'zh'];
  // At last in the tour of the paper.
  for (const [at, language] of [...languages, ...languages].entries()) {
    if (at === languages.length) await page.click('#other');
    await page.selectOption('#language', language);
    await still(page);
    const { lines, bottom } = await page.evaluate(() => {
      const texts = [...document.querySelectorAll('main :is(p, li)')].filter(element => element.checkVisibility() && !element.closest('footer') && !element.querySelector('button') && element.textContent.trim());
      const range = document.createRange();
      const linesOf = element => {
        range.selectNodeContents(element);
        const tops = [...range.getClientRects()].map(({ bottom: end }) => end).sort((a, b) => a - b);
        return tops.filter((end, at) => !at || end - tops[at - 1] > 8).length;
      };
      return { lines: texts.map(element => [element.textContent, linesOf(element)]), bottom: document.querySelector('footer').getBoundingClientRect().bottom };
    });
    assert.ok(lines.reduce((sum, [, count]) => sum + count, 0) <= 3, language + ': ' + JSON.stringify(lines));
    assert.ok(bottom <= 720, language + ': the foot ends at ' + bottom);
  }
  await close(page);
});

for (const [width, height, least] of [[320, 568, 140], [360, 740, 200]]) test('on a phone of ' + width + ' by ' + height + ' pixels, between two lessons, the plan and what begins the next are seen whole, without Good and Bad', async () => {
  const page = await open(browser, { viewport: { width, height } });
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  await page.click('#good');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length === 1 && document.body.dataset.phase === 'waiting');
  await page.click('#finish');
  await page.waitForFunction(() => window.goodbot.sessions() === 1 && document.body.dataset.phase === 'none');
  await still(page);
  const { scroll, boxes } = await seen(page, ['plan', 'lesson']);
  assert.ok(await page.isHidden('#good'));
  assert.ok(scroll <= width, 'the page is ' + scroll + ' pixels wide');
  for (const [id, box] of Object.entries(boxes)) assert.ok(box.left >= 0 && box.right <= width && box.top >= 0 && box.bottom <= height && !box.covered, id + ': ' + JSON.stringify(box));
  assert.ok(boxes.plan.bottom <= boxes.lesson.top && boxes.plan.bottom - boxes.plan.top >= least, JSON.stringify(boxes));
  await page.setViewportSize({ width: 740, height: 360 });
  assert.equal((await seen(page, ['lesson'])).boxes.lesson.covered, false, 'in landscape neither');
  await page.setViewportSize({ width: 430, height: 932 });
  await still(page);
  const { lesson, plan } = (await seen(page, ['lesson', 'plan'])).boxes;
  assert.ok(!lesson.covered && plan.bottom - plan.top >= 380 && plan.bottom < lesson.top, 'on a large phone: ' + JSON.stringify({ lesson, plan }));
  await page.setViewportSize({ width: 1024, height: 768 });
  assert.ok((await page.locator('#dots').boundingBox()).height < 40, 'all lessons and tests are on one line');
  await close(page);
});

test('on a wide screen the page uses the width, Good and Bad are alone on their line, and stay where they are while the panel is read', async () => {
  const page = await open(browser, { viewport: { width: 1920, height: 1080 } });
  const { right } = await page.locator('#tour').boundingBox().then(({ x, width }) => ({ right: x + width }));
  assert.ok(right > 1850, 'the content ends at ' + right);
  await page.selectOption('#speed', 'step');
  await page.click('#lesson');
  await page.getByText('Good or Bad?').waitFor();
  const { good, pause } = (await seen(page, ['good', 'pause'])).boxes;
  assert.ok(pause.top >= good.bottom, JSON.stringify({ good, pause }));
  await page.setViewportSize({ width: 1280, height: 720 });
  await page.evaluate(() => window.scrollTo(0, 400));
  const { boxes } = await seen(page, ['good', 'bad', 'finish', 'plan']);
  for (const [id, box] of Object.entries(boxes)) assert.ok(box.top >= 0 && box.bottom <= 720 && !box.covered, id + ': ' + JSON.stringify(box));
  await close(page);
});

test('the robot is drawn before anything is unpacked', { skip: second && 'scripts cannot be switched off in this Firefox' }, async () => {
  const context = await browser.newContext({ javaScriptEnabled: false, viewport: { width: 400, height: 600 } });
  const page = await context.newPage();
  await page.goto(address);
  const drawn = await page.locator('#first').boundingBox();
  assert.ok(drawn.width >= 100 && drawn.height >= 100 && drawn.x > 0 && drawn.y > 0, JSON.stringify(drawn));
  await context.close();
  const ready = await open(browser);
  assert.ok(await ready.isHidden('#first'), 'and gives way to the page');
  await close(ready);
});

test('no text is smaller than 12 pixels, in a large home neither', async () => {
  for (const width of [320, 1280]) {
    const page = await open(browser, { viewport: { width, height: 700 } });
    await play(page, 'Test');
    await page.selectOption('#speed', 'step');
    await page.fill('#command', 'go to the red room');
    await page.click('#say-it');
    await page.getByText('Good or Bad?').waitFor();
    await page.click('#good');
    await still(page);
    const find = () => page.evaluate(() => {
      const scale = element => (element.ownerSVGElement ? element.getScreenCTM().a : 1);
      const texts = [...document.querySelectorAll('body *')].filter(element => [...element.childNodes].some(node => node.nodeType === 3 && node.textContent.trim()) && element.getClientRects().length && !element.closest('script, style, .hidden'));
      return texts.filter(element => parseFloat(getComputedStyle(element).fontSize) * scale(element) < 11.9).map(element => element.outerHTML.slice(0, 80));
    });
    // The plan gets its size after the bubble, and the names get theirs after the plan.
    let small = await find();
    for (let frames = 0; small.length && frames < 20; frames += 1) {
      await still(page);
      small = await find();
    }
    assert.deepEqual(small, [], width + ' pixels');
    await close(page);
  }
});
