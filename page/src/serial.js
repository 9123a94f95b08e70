// A micro:bit at the USB cable, by Web Serial: it goes along in each lesson of the page, and its own lessons can be fetched. Its requests are
// in `firmware/microbit/src/request.rs`.
import { learn, whileLearning, world } from './core.js';
import { t } from './language.js';
import { homeRequests } from './microbit.js';
import { takeStock } from './session.js';
import { $, render, state, tell } from './state.js';
import { change } from './store.js';
import { leaveSession } from './training.js';
import { sessionsWord } from './words.js';

// TypeScript does not know Web Serial.
/** @type {any} */
const { serial } = /** @type {any} */ (navigator);
const MADE_BY = 0x0d28;
const MOST_WAIT = 5000;

/** @type {WritableStreamDefaultWriter<Uint8Array> | null} */
let writer = null;
/** The request that waits for its answer.
 * @type {{ lines: string[], done: (lines: string[]) => void, failed: (error: Error) => void } | null} */
let pending = null;
/** The answer to the last request: the next request waits for it, and fails with it.
 * @type {Promise<string[]>} */
let last = Promise.resolve([]);
/** The requests of the last lesson.
 * @type {string[]} */
let sent = [];
/** The session that the micro:bit could not do.
 * @type {import('./state.js').Session | null} */
let refused = null;

/** @param {string} request */
function ask(request) {
  last = last.then(() => new Promise((done, failed) => {
    pending = { lines: [], done, failed };
    writer?.write(new TextEncoder().encode(request + '\n')).catch(failed);
  }));
  return last;
}

// A line from the board.
function take(line) {
  if (!pending) return;
  const { lines, done, failed } = pending;
  const [, why] = line.match(/^error: (.*)/) || [];
  if (line !== 'ok' && !why) lines.push(line);
  else pending = null;
  if (line === 'ok') done(lines);
  if (why) failed(new Error('micro:bit: ' + why));
}

// Reads until the board is unplugged, or the reader is cancelled.
async function listen(port, reader, piped) {
  let text = '';
  try {
    for (;;) {
      const { value, done } = await reader.read();
      if (done) break;
      const lines = (text + value).split(/\r?\n/);
      text = lines.pop() || '';
      lines.forEach(take);
    }
  } catch {
    // It is unplugged.
  }
  writer?.releaseLock();
  writer = null;
  await piped;
  await port.close().catch(() => {});
  const error = new Error(t('serial.lost'));
  pending?.failed(error);
  if (connected()) fail(error);
  show(false);
}

const connected = () => !$('serial-fetch').hidden;

function show(on) {
  $('serial').hidden = !serial || on;
  $('serial-fetch').hidden = !on;
  $('serial-none').hidden = Boolean(serial);
}

function fail(error) {
  [last, pending, sent, refused] = [Promise.resolve([]), null, [], state.session];
  tell(error.message, true);
}

async function connect() {
  try {
    const port = await serial.requestPort({ filters: [{ usbVendorId: MADE_BY }] });
    await port.open({ baudRate: 115200 });
    writer = port.writable.getWriter();
    const decoder = new TextDecoderStream();
    const piped = port.readable.pipeTo(decoder.writable).catch(() => {});
    const reader = decoder.readable.getReader();
    const over = listen(port, reader, piped);
    const leave = () => reader.cancel().catch(() => {});
    const silent = setTimeout(leave, MOST_WAIT);
    try {
      await ask('help');
    } catch {
      leave();
      await over;
      throw new Error(t('serial.silent'));
    } finally {
      clearTimeout(silent);
    }
    refused = null;
    show(true);
    $('serial-fetch').focus();
    tell(t('serial.on'));
  } catch (error) {
    // Whoever has chosen no board knows that.
    if (error.name !== 'NotFoundError') fail(error);
  }
}

// The session so far, as requests; `null` if the board cannot do it.
/** @param {import('./state.js').Session} session */
function requests({ command, decided, committed, feedback, said }) {
  const home = homeRequests(JSON.parse(world.log().split('\n')[0]).environment);
  if (!home) return null;
  const steps = state.evidence.map(step => [step.action, step.feedback]);
  if (decided && decided !== committed) steps.push([decided.action, said && feedback || '']);
  const words = { reward: ['good'], punish: ['bad'] };
  const done = steps.flatMap(([action, word]) => ['act ' + action, ...words[word] || []]);
  return ['pace 0', 'begin', ...home, 'build', 'say ' + command, ...done, ...state.phase === 'learning' ? ['finish'] : []];
}

/** Has the micro:bit do what the session under way has done since the last call. If a step or a word was taken back, it does the whole session
 * anew. */
export function followSession() {
  const { session } = state;
  if (!connected() || !session || session === refused || !world.teaches()) return;
  const wanted = requests(session);
  if (!wanted) {
    fail(new Error(t('microbit.noHome')));
    return;
  }
  const at = sent.length - 1;
  // The last word counts.
  if (/^(good|bad),(good|bad)$/.test(sent[at] + ',' + wanted[at]) && sent[at] !== wanted[at]) sent.pop();
  if (sent.some((request, place) => wanted[place] !== request)) sent = [];
  for (const request of wanted.slice(sent.length)) {
    sent.push(request);
    ask(request);
  }
  const now = last;
  now.catch(error => { if (last === now) fail(error); });
}

// Adds the lessons of the micro:bit to the robot's own.
async function fetchLessons() {
  if (!await leaveSession()) return;
  await whileLearning(async () => {
    try {
      // A lesson that was left here is left there too.
      if (sent.length && sent.at(-1) !== 'finish') ask('again');
      sent = [];
      const digits = (await ask('model')).filter(line => /^([\da-f]{2})+$/.test(line)).join('');
      const bytes = Uint8Array.from(digits.match(/../g) || [], pair => parseInt(pair, 16));
      let n = 0;
      await change('micro:bit', async () => {
        try {
          n = world.join(bytes);
        } finally {
          await learn();
        }
        return '';
      });
      tell('micro:bit: +' + sessionsWord(n));
    } catch (error) {
      fail(error);
    }
  });
  takeStock(state.heat.now);
  render();
}

export function setUpSerial() {
  show(false);
  $('serial').addEventListener('click', connect);
  $('serial-fetch').addEventListener('click', fetchLessons);
}
