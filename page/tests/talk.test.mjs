// What people write in the one field: commands, and words to a robot on its way.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, launch, learned, model, open, play, reload, saved, sessions } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const say = async (page, words) => {
  await page.fill('#command', words);
  await page.click('#say-it');
};
// What the robot says: it hears a command in a task of its own.
const says = (page, pattern) => page.waitForFunction(source => new RegExp(source).test(document.querySelector('#say').textContent), pattern.source);

// How commands for the course's tasks are worded: `[color, shape]` of a thing, or none, and the room's color.
const COLORS = { red: 'rot', green: 'grün', blue: 'blau', yellow: 'gelb', purple: 'lila', orange: 'orange', tan: 'beige', teal: 'türkis', magenta: 'pink' };
const SHAPES = { chair: 'den {}en Stuhl', bag: 'die {}e Tasche', backpack: 'den {}en Rucksack', basket: 'den {}en Korb' };
const WORDINGS = {
  en: (thing, room) => (thing ? 'take the ' + thing.join(' ') + ' to the ' + room + ' room' : 'go to the ' + room + ' room'),
  de: (thing, room) => (thing ? 'bring ' + SHAPES[thing[1]].replace('{}', COLORS[thing[0]]) : 'geh') + ' in den ' + COLORS[room] + 'en Raum',
};

// A robot that has learned the meanings of thirty commands, in the page's language, from a log of another one.
async function taught(language = 'en', options = {}) {
  const page = await open(browser, options);
  if (language !== 'en') await page.selectOption('#language', language);
  const posed = await page.evaluate(() => {
    const { teachable, homes } = JSON.parse(window.goodbot.constructor.course(0));
    return teachable.map(({ home, intended }) => ({ home: homes.find(([name]) => name === home)[1], intended }));
  });
  const lines = Array.from({ length: 30 }, (_, at) => posed[at * 7 % posed.length]).flatMap(({ home, intended }) => {
    const [, kind, first, room] = intended.match(/^(\w+)\((\w+),(\w+)\)/);
    const of = name => home.objects.find(object => object.name === name);
    const command = WORDINGS[language](kind === 'blockInRoom' ? [of(first).color, of(first).shape] : null, of(room).color);
    return [{ type: 'session', version: 1, kind: 'feedback', environment: home, command }, { type: 'answer', tasks: [intended], yes: true, eta: 1e-6, others: 1 }, { type: 'end', learn: true }];
  });
  await play(page, 'A');
  await page.setInputFiles('#load-log', { name: 'log.jsonl', mimeType: 'application/jsonl', buffer: Buffer.from(lines.map(line => JSON.stringify(line)).join('\n') + '\n') });
  await learned(page, 30);
  await page.selectOption('#speed', 'step');
  return page;
}

const waits = page => page.getByText('Good or Bad?').waitFor();
const tasks = page => page.evaluate(() => JSON.parse(window.goodbot.belief()).tasks.map(({ name, probability }) => [name, probability]).sort((a, b) => b[1] - a[1]));
const likeliest = async page => (await tasks(page))[0]?.[0];
// Waits until the robot rests at its goal.
async function walk(page) {
  for (let step = 0; step < 60; step += 1) {
    await page.waitForFunction(() => ['waiting', 'paused'].includes(document.body.dataset.phase));
    if (await page.evaluate(() => document.getElementById('finish').classList.contains('big'))) return;
    const count = await page.evaluate(() => document.querySelectorAll('#steps tr').length);
    await page.click('#good');
    await page.waitForFunction(before => document.querySelectorAll('#steps tr').length > before, count);
  }
  assert.fail('the robot did not get there');
}
const roomOf = (page, color) => page.evaluate(wanted => JSON.parse(window.goodbot.scene()).rooms.find(room => room.color === wanted).name, color);

test('words to a robot on its way judge, stop, take back and turn it round', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await say(page, 'go to the red room');
  await waits(page);
  await say(page, 'good job');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length > 0);
  assert.match(await page.evaluate(() => window.goodbot.log()), /"feedback":"reward"/);
  await waits(page);
  const where = () => page.evaluate(() => JSON.stringify(JSON.parse(window.goodbot.scene()).agent));
  const before = await where();
  await say(page, 'undo');
  await page.waitForFunction(() => document.body.dataset.phase === 'paused');
  assert.notEqual(await where(), before, 'the step is taken back');
  await page.click('#pause');
  await waits(page);
  await say(page, 'no!');
  await page.waitForFunction(() => window.goodbot.log().includes('"punish"'));
  await waits(page);
  await say(page, 'undo');
  await page.waitForFunction(() => document.body.dataset.phase === 'paused');
  await say(page, 'undo');
  await page.waitForFunction(() => !window.goodbot.log().includes('"punish"'));
  await page.click('#pause');
  await waits(page);
  await say(page, 'stop');
  await page.waitForFunction(() => document.body.dataset.phase === 'paused');
  await say(page, 'stop');
  await page.waitForFunction(() => document.body.dataset.phase === 'none');
  assert.equal(await sessions(page), 0, 'nothing was learned');
  await close(page);
});

test('“good job” at the goal ends the session, and words that came with a button are praise', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await say(page, 'go to the red room');
  await waits(page);
  await page.fill('#command', 'flub wib');
  await page.click('#good');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length > 0);
  await waits(page);
  await say(page, 'flub');
  await page.waitForFunction(() => (window.goodbot.log().match(/"reward"/g) || []).length === 2);
  await walk(page);
  await say(page, 'good job');
  await learned(page, 1);
  await close(page);
});

test('what is too long is refused in the page’s words, whatever makes it so', async () => {
  const page = await open(browser, { locale: 'de' });
  await play(page, 'A');
  for (const words of ['geh in den '.repeat(30) + 'roten Raum', 'ge' + 'h'.repeat(90) + ' in den roten Raum']) {
    await say(page, words);
    await page.getByText('Das ist zu lang für den Roboter').first().waitFor();
    await page.evaluate(() => { document.getElementById('toast').textContent = ''; });
  }
  assert.equal(await sessions(page), 0);
  await close(page);
});

test('a prohibition is no command for it', async () => {
  const page = await taught();
  const red = await roomOf(page, 'red');
  await say(page, 'don’t go to the red room');
  await says(page, /what I must not do, so I wait/);
  assert.ok(await page.isHidden('#finish'), 'it is not there, and stays');
  await say(page, 'go to the red room');
  await walk(page);
  await page.click('#finish');
  await learned(page, 31);
  await say(page, 'leave the red room');
  await waits(page);
  assert.equal(await likeliest(page), '!agentInRoom(agent0,' + red + ')');
  await walk(page);
  await page.click('#finish');
  await page.waitForFunction(() => document.body.dataset.phase === 'none');
  assert.equal(await sessions(page), 31, 'nothing is learned from that');
  await close(page);
});

test('one command after the other, each a session of its own, and words that point back', async () => {
  const page = await taught();
  const [first, second] = [await roomOf(page, 'red'), await roomOf(page, 'green')];
  await page.click('#reset');
  await say(page, 'go to the red room and then to the green room');
  await waits(page);
  assert.match(await page.textContent('#heard'), /^go to the red room$/);
  assert.equal(await likeliest(page), `agentInRoom(agent0,${first})`);
  await walk(page);
  await page.click('#finish');
  await page.waitForFunction(() => window.goodbot.sessions() === 31 && document.body.dataset.phase === 'waiting');
  assert.equal(await likeliest(page), `agentInRoom(agent0,${second})`);
  // A reload in the middle of the second part loses nothing, to the bit.
  await page.click('#good');
  await page.waitForFunction(() => document.querySelectorAll('#steps tr').length > 0);
  await waits(page);
  const believed = JSON.stringify(await tasks(page));
  await reload(page);
  assert.equal(JSON.stringify(await tasks(page)), believed);
  await page.click('#pause');
  await walk(page);
  await page.click('#finish');
  await learned(page, 32);
  await say(page, 'go back');
  await waits(page);
  assert.equal(await likeliest(page), `agentInRoom(agent0,${first})`, 'where it was before');
  await walk(page);
  await page.click('#finish');
  await page.waitForFunction(() => document.body.dataset.phase === 'none');
  // Its log teaches another robot the same, to the bit.
  const [log, bytes] = [await saved(page, '#save-log'), await model(page)];
  const other = await open(browser);
  await other.setInputFiles('#load-log', { name: 'log.jsonl', mimeType: 'application/jsonl', buffer: log });
  await learned(other, await sessions(page));
  assert.deepEqual(await model(other), bytes);
  await close(other);
  await close(page);
});

test('what is done already, and what the robot cannot do, begins no session', async () => {
  const page = await taught();
  await say(page, 'go to the red room');
  await walk(page);
  await page.click('#finish');
  await learned(page, 31);
  await say(page, 'go to the red room');
  await says(page, /That is done already/);
  await say(page, 'what a lovely morning outside my friend');
  await says(page, /nothing that I can do here|not sure/);
  assert.ok(await page.isHidden('#finish'));
  await page.click('#else');
  await waits(page);
  await close(page);
});

test('“no, the blue one” turns the robot round, and the log keeps the words', async () => {
  const page = await taught();
  await say(page, 'go to the red room');
  await waits(page);
  const [green, red] = [await roomOf(page, 'green'), await roomOf(page, 'red')];
  assert.equal(await likeliest(page), `agentInRoom(agent0,${red})`);
  await say(page, 'no, the green one');
  await page.waitForFunction(() => window.goodbot.log().includes('"words":"no, the green one"'));
  await waits(page);
  assert.equal(await likeliest(page), `agentInRoom(agent0,${green})`);
  const believed = JSON.stringify(await tasks(page));
  await reload(page);
  assert.equal(JSON.stringify(await tasks(page)), believed);
  await close(page);
});

test('German: a prohibition, one command after the other, a correction, praise', async () => {
  const page = await taught('de');
  const [red, green] = [await roomOf(page, 'red'), await roomOf(page, 'green')];
  await say(page, 'geh nicht in den roten Raum');
  await says(page, /soll ich nicht tun/);
  await say(page, 'geh in den roten Raum und dann in den grünen Raum');
  await page.waitForFunction(() => document.body.dataset.phase === 'waiting');
  assert.equal(await likeliest(page), `agentInRoom(agent0,${red})`);
  await say(page, 'nein, den grünen');
  await page.waitForFunction(() => window.goodbot.log().includes('"words"'));
  assert.equal(await likeliest(page), `agentInRoom(agent0,${green})`);
  await page.waitForFunction(() => document.body.dataset.phase === 'waiting');
  await say(page, 'gut gemacht');
  await page.waitForFunction(() => /"feedback":"reward"/.test(window.goodbot.log()));
  await close(page);
});

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
  await waits(page);
  await close(page);
});

test('an emoji alone, while the robot walks, is answered at once, and not when the session is over', async () => {
  const page = await open(browser);
  await play(page, 'A');
  await page.selectOption('#speed', 'step');
  await say(page, 'go to the red room');
  await waits(page);
  const bubble = await page.textContent('#say');
  await say(page, '👍');
  assert.match(await page.textContent('#live'), /There is no word in that/);
  assert.ok(await page.isVisible('#toast'), 'who looks sees it too');
  assert.equal(await page.inputValue('#command'), '', 'the field is free for words');
  assert.equal(await page.textContent('#say'), bubble);
  await page.click('#drop');
  await page.waitForFunction(() => document.body.dataset.phase === 'none');
  assert.doesNotMatch(await page.textContent('#say'), /There is no word in that/);
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

test('what would change something is no command where nothing was before, in every language', async () => {
  const page = await open(browser);
  await play(page, 'A');
  for (const [language, nothing, undone, sentences, undo] of [
    ['en', /nothing to change yet/, /nothing to undo/, ['no, the other one', 'No, the blue one!', 'forget it', 'put it back'], 'undo'],
    ['de', /nichts zu ändern/, /nichts rückgängig/, ['nein, den anderen', 'vergiss es', 'leg es zurück'], 'rückgängig'],
    ['es', /nada que cambiar/, /nada que deshacer/, ['no, el otro'], 'deshaz'],
    ['fr', /rien à changer/, /rien à annuler/, ['non, l’autre'], 'annule'],
    ['zh', /还没有可以改的/, null, ['不，另一个', '忘了吧', '放回去'], ''],
  ]) {
    await page.selectOption('#language', language);
    for (const words of sentences) {
      await say(page, words);
      assert.match(await page.textContent('#say'), nothing, words);
      assert.ok(await page.isHidden('#finish'), words + ' begins no session');
    }
    if (!undone) continue;
    await say(page, undo);
    assert.match(await page.textContent('#say'), undone, undo);
  }
  await page.selectOption('#language', 'en');
  await say(page, 'no, the other one');
  await page.click('#else');
  await waits(page);
  await page.click('#drop');
  await say(page, 'no, go to the red room');
  await waits(page);
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
