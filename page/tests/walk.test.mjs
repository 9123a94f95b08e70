// Nobody gets stuck: whoever presses only the button that stands out, and answers in whatever way, comes to the end of the tour.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { address, close, drag, launch, linkOf, open, openFirst, play, sessions, teachInvention } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

/** What a visitor says to a robot's step, by its number.
 * @type {Record<string, (step: number) => string>} */
const ANSWERS = { 'always Good': () => '#good', 'always Bad': () => '#bad', 'Good and Bad by turns': step => (step % 2 ? '#bad' : '#good'), silence: () => '#next' };

/** Presses the one button that stands out, or else the first answer that there is, and tells its words; '' at the end: of the tour, or of the
 * first lesson of free play. Looking and pressing are one step, because on a busy machine another thing might stand out in between.
 * @param {import('playwright-core').Page} page
 * @param {string[]} answers
 * @param {boolean} tour */
async function press(page, answers, tour) {
  const pressed = await page.waitForFunction(([choices, isTour]) => {
    if (['planning', 'learning', 'moment'].includes(String(document.body.dataset.phase))) return null;
    /** @type {(selector: string) => HTMLElement[]} */
    const seen = selector => [...document.querySelectorAll(selector)].filter(button => button.checkVisibility());
    if (isTour ? seen('#card').length : window.goodbot.sessions()) return [''];
    const out = seen('dialog[open] .primary, #page button.primary:not([disabled])');
    if (out.length > 1) throw new Error('these stand out: ' + out.map(button => button.innerText));
    const button = out[0] ?? choices.flatMap(seen)[0];
    if (!button) return null;
    button.scrollIntoView({ block: 'center', behavior: 'instant' });
    const { x, y, width, height } = button.getBoundingClientRect();
    if (!button.contains(document.elementFromPoint(x + width / 2, y + height / 2))) return null;
    const shown = [button.innerText || button.id, document.body.innerText];
    button.click();
    return shown;
  }, /** @type {const} */ ([answers, tour]));
  const [words, before] = await pressed.jsonValue();
  // Each press in the tour changes what is seen.
  if (tour && words) await page.waitForFunction(text => document.body.innerText !== text, before);
  return words;
}

for (const first of [true, false]) for (const [who, answer] of Object.entries(ANSWERS)) {
  test('by the button that stands out alone one comes to the end ' + (first ? 'of a first visit: ' : 'of the tour: ') + who, async () => {
    const page = await (first ? openFirst : open)(browser);
    await page.selectOption('#speed', 'step');
    const pressed = [];
    // In a lesson one word is said first; then a button stands out again.
    while (pressed.at(-1) !== '' && pressed.length < 300) pressed.push(await press(page, [answer(pressed.length)], true));
    assert.ok(await page.locator('#card').isVisible(), pressed.slice(-6).join());
    const lessons = await sessions(page);
    assert.ok(first ? lessons >= 3 && lessons <= 6 : lessons === 7, lessons + ' lessons');
    assert.equal(await page.locator('button.primary:visible').count(), 1, 'also at the end one thing stands out');
    await close(page);
  });
}

// The one button that stands out, or none where an answer or a stroke is wanted.
async function outstanding(page) {
  await page.waitForFunction(() => !['planning', 'learning', 'moment'].includes(document.body.dataset.phase));
  const out = page.locator('dialog[open] .primary, #page button.primary:not([disabled]):visible');
  const all = await out.allInnerTexts();
  assert.ok(all.length <= 1, 'these stand out: ' + all.join());
  return all.length ? out.first() : null;
}

for (const questions of [false, true]) for (const [who, answer] of Object.entries(ANSWERS)) {
  test('in free play the button that stands out leads to a lesson that is learned' + (questions ? ', with questions: ' : ': ') + who, async () => {
    const page = await open(browser);
    if (questions) await page.check('#set-questions');
    await play(page, 'Test');
    await page.selectOption('#speed', 'step');
    // Also where the robot's tests are at hand.
    await page.locator('#tab-challenges').click();
    await page.fill('#test-command', 'go to the red room');
    await page.selectOption('#test-meant', { index: 1 });
    await page.click('#test-it');
    await page.locator('#tests li').waitFor();
    const pressed = [];
    while (pressed.at(-1) !== '' && pressed.length < 120) pressed.push(await press(page, ['#answers button:nth-of-type(' + (pressed.length % 2 + 1) + ')', answer(pressed.length)], false));
    assert.equal(await sessions(page), 1);
    assert.ok(await outstanding(page));
    await close(page);
  });
}

test('in the game of a secret language the button that stands out leads to its end', async () => {
  const page = await openFirst(browser);
  await teachInvention(page);
  await page.selectOption('#speed', 'once');
  await page.click('#lesson');
  const hash = (await linkOf(page, '#decode')).slice(address.length);
  const friend = await open(browser, {}, hash);
  await friend.selectOption('#speed', 'once');
  await friend.locator('#secret-words button').first().click();
  for (let at = 0; at < 6 && await friend.locator('#secret-words select').count(); at += 1) await (await outstanding(friend)).click();
  assert.equal(await friend.locator('#secret-words select').count(), 0);
  assert.equal(await (await outstanding(friend)).innerText(), 'Invent a language');
  for (const one of [friend, page]) await close(one);
});

test('while a home is drawn, what is to be done next stands out, up to free play in it', async () => {
  const page = await open(browser);
  await page.click('[data-mode=build]');
  assert.equal(await (await outstanding(page)).innerText(), 'Now say what you like', 'the home that was shown');
  await page.click('#clear');
  for (const [tool, from, to] of [['Room', [1, 1], [4, 4]], ['Robot', [2, 2]]]) {
    const next = await outstanding(page);
    assert.equal(await next.innerText(), tool);
    // What is pressed looks otherwise than what is to be pressed.
    const colors = await page.locator('[data-tool]').evaluateAll(tools => tools.map(tool => getComputedStyle(tool).backgroundColor));
    const color = await next.evaluate(tool => getComputedStyle(tool).backgroundColor);
    assert.equal(colors.filter(one => one === color).length, 1);
    await next.click();
    const place = () => page.locator('#draft').boundingBox();
    const before = await place();
    await drag(page, await next.getAttribute('data-tool'), from, to);
    assert.deepEqual(await place(), before, 'a stroke does not move the drawing');
  }
  await drag(page, 'room', [4, 1], [8, 4]);
  assert.equal(await (await outstanding(page)).innerText(), 'Door', 'a room without a way in');
  await drag(page, 'block', [2, 2]);
  assert.equal(await (await outstanding(page)).innerText(), 'Undo', 'what cannot be');
  await (await outstanding(page)).click();
  await drag(page, 'door', [4, 2]);
  await (await outstanding(page)).click();
  assert.equal(await page.getAttribute('body', 'data-mode'), 'play');
  assert.equal(await (await outstanding(page)).innerText(), 'Tell the robot');
  await close(page);
});
