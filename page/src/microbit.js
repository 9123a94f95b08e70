// To a micro:bit: the program that `cargo xtask microbit` makes, with this robot's model, its home if there is room, and the commands
// that it was taught. `formats/src/microbit.rs` has the layout of the flash, `core/src/storage/mod.rs` that of a slot.
import { world } from './core.js';
import { download, readFile } from './files.js';
import { t } from './language.js';
import { checksum } from './link.js';
import { state, tell } from './state.js';
import { logOf } from './store.js';

const [HOME, SLOTS, END] = [0x3dc00, 0x3e000, 0x40000];
const ERASED = -1;
const MOST_LINE = 64;

// The flash that a file of Intel HEX describes; `null` if it is no such file, or another program.
function flashOf(text) {
  const flash = new Int16Array(END).fill(ERASED);
  let [upper, ended] = [0, false];
  for (const line of text.trim().split(/\s+/)) {
    const bytes = /^:([\dA-F]{2})+$/i.test(line) ? (line.match(/[\dA-F]{2}/gi) || []).map(pair => parseInt(pair, 16)) : [];
    const [count, high, low, kind, ...data] = bytes;
    if (data.length !== count + 1 || sum(bytes) & 255) return null;
    const at = upper + (high << 8 | low);
    if (kind === 0 && at + count > END) return null;
    if (kind === 0) flash.set(data.slice(0, count), at);
    if (kind === 4 || kind === 2) upper = (data[0] << 8 | data[1]) * (kind === 4 ? 0x10000 : 16);
    ended = kind === 1;
  }
  return ended && new TextDecoder('latin1').decode(Uint8Array.from(flash)).includes('goodbot on the micro:bit') ? flash : null;
}

const sum = bytes => bytes.reduce((whole, byte) => whole + byte, 0);

function record(at, kind, data) {
  const bytes = [data.length, at >> 8 & 255, at & 255, kind, ...data];
  return ':' + [...bytes, -sum(bytes) & 255].map(byte => byte.toString(16).padStart(2, '0')).join('').toUpperCase() + '\n';
}

function textOf(flash) {
  let [text, upper] = ['', -1];
  for (let at = 0; at < END;) {
    let to = at;
    while (flash[to] >= 0 && to < at + 16 && (to === at || to & 0xffff)) to += 1;
    if (to > at && at >> 16 !== upper) {
      upper = at >> 16;
      text += record(0, 4, [0, upper]);
    }
    if (to > at) text += record(at, 0, flash.slice(at, to));
    at = Math.max(to, at + 1);
  }
  return text + record(0, 1, []);
}

// Two slots, of which the first has the model.
function slotsWith(model) {
  const slots = new Uint8Array(END - SLOTS).fill(255);
  const header = new DataView(slots.buffer);
  slots.set(new TextEncoder().encode('slot\0\0\0\0'));
  header.setUint32(8, model.length, true);
  header.setUint32(12, checksum(slots.slice(0, 12)), true);
  slots.set(model, 16);
  return slots;
}

/** The board's requests for this home: an object's fields are one, `room room0 0 0 4 4 red`. `null` if the board has no room for the home, or a
 * name is not one word.
 * @param {any} environment the home with its things where they are now
 * @returns {string[] | null} */
export function homeRequests({ objects }) {
  const parts = objects.map(Object.values);
  return world.fitsMicrobit() && parts.flat().every(word => /^\S+$/.test(word)) ? parts.map(words => words.join(' ')) : null;
}

const size = text => new TextEncoder().encode(text).length;

/** Saves the chosen program with this robot in it.
 * @param {HTMLInputElement} input
 * @param {string} name */
export async function toMicrobit(input, name) {
  const { content } = await readFile(input, 'text');
  const flash = flashOf(content);
  if (!flash) {
    tell(t('microbit.noHex'), true);
    return;
  }
  try {
    const model = world.forMicrobit();
    // The requests that the board reads when it starts, as far as there is room.
    let lines = '';
    const add = line => {
      const fits = size(line) <= MOST_LINE && size(lines + line) < SLOTS - HOME && !/\p{Cc}/u.test(line);
      if (fits) lines += line + '\n';
      return fits;
    };
    const home = homeRequests(JSON.parse(world.environment()))?.every(add);
    if (!home) lines = '';
    for (const command of new Set(logOf(state.robot).split('\n').filter(Boolean).map(line => JSON.parse(line).command).filter(Boolean))) add('say ' + command.trim());
    if (lines) {
      flash.fill(ERASED, HOME, SLOTS);
      flash.set(new TextEncoder().encode(lines), HOME);
    }
    flash.set(slotsWith(model), SLOTS);
    download(name + '.hex', textOf(flash), 'text/plain');
    tell(t('microbit.done') + (home ? '' : ' ' + t('microbit.noHome')));
  } catch {
    tell(t('microbit.noRoom'), true);
  }
}
