// The part of an address after its #: a home with settings, a robot with its model, a session of it, or a study.
import { fromAddress, fromBase64, toAddress } from './base64.js';
import { expectTrainer, expectedNow } from './believes.js';
import { world } from './core.js';
import { expanded, packed } from './deflate.js';
import { takeWords } from './invention.js';
import { t } from './language.js';
import { checkRecord } from './logs.js';
import { isSetting, keepSetting } from './settings.js';
import { put } from './shelf.js';
import { state, tell } from './state.js';
import { logOf } from './store.js';

// The settings in a link; the look and the keys are everybody's own.
const SHARED = ['speed', 'rule', 'questions', 'style', 'pull', 'ghost', 'names', 'speech', 'seed'];

// A link for a class has these too, and they are kept.
const OF_CLASS = ['language', 'hidden'];

/** The address of this page with the home and the settings.
 * @param {boolean} forClass also with the language and the tabs */
export function homeLink(forClass = false) {
  const settings = { ...state.settings, language: document.documentElement.lang };
  const share = { home: JSON.parse(world.environment()), settings: Object.fromEntries((forClass ? [...SHARED, ...OF_CLASS] : SHARED).map(name => [name, settings[name]])) };
  return location.href.split('#')[0] + '#home=' + toAddress(checked(new TextEncoder().encode(JSON.stringify(share))));
}

// What an address has: a version, a checksum, and then a home and settings as JSON, or a robot, packed: the length of a JSON text, that text and
// the model.
const VERSION = 1;
// Versions are counted one by one, so a first byte beyond this one is damage.
const LAST_VERSION = 31;

/** The checksum CRC-32 of bytes.
 * @param {Uint8Array} bytes */
export function checksum(bytes) {
  let sum = ~0;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; bit += 1) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum >>> 0;
}

/** @param {Uint8Array} content */
function checked(content) {
  const bytes = new Uint8Array(5 + content.length);
  new DataView(bytes.buffer).setUint32(1, checksum(content));
  bytes[0] = VERSION;
  bytes.set(content, 5);
  return bytes;
}

/** The content of an address. Throws, with the text for people, if a newer page wrote it, or if it is damaged.
 * @param {string} text */
function unchecked(text) {
  const damaged = new Error(t('link.damaged'));
  try {
    const bytes = fromAddress(text);
    const content = bytes.slice(5);
    if (bytes[0] > VERSION && bytes[0] <= LAST_VERSION) damaged.message = t('link.newer');
    else if (bytes[0] === VERSION && new DataView(bytes.buffer).getUint32(1) === checksum(content)) return content;
  } catch { /* It is damaged. */ }
  throw damaged;
}

/** The address of this page with this tab's robot: its model, name, home and settings.
 * @param {{ secret?: boolean, own?: import('./invention.js').Invention | null, home?: object, session?: any[], starter?: string, tour?: import('./store.js').Tour, mode?: string }} more `secret`: the visitor is to find out its words; `own`: an invented language; `home`: another home than the current one; `session`: the records of a log, to be shown; `tour` and `mode`: its trainer goes on elsewhere
 * @param {string} known its model, as it is kept */
export async function robotLink(more = {}, known = state.robot.model) {
  const about = new TextEncoder().encode(JSON.stringify({ name: state.robot.name, home: JSON.parse(world.environment()), pull: state.settings.pull, ways: world.ways(), starter: state.robot.starter, ...more }));
  const model = fromBase64(known);
  const whole = new Uint8Array(2 + about.length + model.length);
  whole.set([about.length >> 8, about.length & 255]);
  whole.set(about, 2);
  whole.set(model, 2 + about.length);
  return location.href.split('#')[0] + (more.session ? '#session=' : '#robot=') + toAddress(checked(await packed(whole)));
}

/** The link to the last session that this robot learned from, with the robot's model from before. `undefined` if there is none, or if it came from a log
 * with others. */
export async function sessionLink() {
  const log = logOf(state.robot);
  const before = state.robot.past.findLast(point => point.length < log.length);
  const records = before ? log.slice(before.length).trimEnd().split('\n').map(line => JSON.parse(line)) : [];
  const session = records.filter(({ type }) => type !== 'end').map(({ at_ms, said_ms, ...record }) => record);
  return before && records.length === session.length + 1 ? robotLink({ session, starter: before.had }, before.model) : undefined;
}

// How far a tour is, whatever the link has.
const takeTour = ({ at, done, said, own }) => ({
  at: at >>> 0, done: [...done].map(one => (/^(right|wrong|astray)$/.test(one) ? String(one) : '')), own: own ? { ...takeWords(own), more: Math.min(3, own.more >>> 0) } : null,
  said: Object.fromEntries(Object.entries(said).map(([command, words]) => [command, String(words)])),
});

/** The robot in the address, which is removed from it; `null` if there is none, or if it is damaged, which is told.
 * @returns {Promise<{ name: string, home: object, pull: boolean, ways: boolean, starter: string, secret: boolean, own: import('./invention.js').Invention | null, session: any[] | undefined, tour: import('./store.js').Tour | null, mode: string, model: Uint8Array } | null>} */
export async function readRobot() {
  const text = takeOff('robot|session');
  if (text === undefined) return null;
  try {
    const whole = await expanded(unchecked(text));
    const length = whole[0] << 8 | whole[1];
    const { name, home, pull, ways, starter, secret, own, session, tour, mode } = JSON.parse(new TextDecoder().decode(whole.slice(2, 2 + length)));
    session?.forEach(checkRecord);
    return { name: String(name).slice(0, 40) || t('robots.some'), home, pull: pull === true, ways: ways === true, starter: String(starter || ''), secret: secret === true, own: own ? takeWords(own) : null, session, tour: tour ? takeTour(tour) : null, mode: tour && mode === 'tour' ? mode : 'play', model: whole.slice(2 + length) };
  } catch (error) {
    tell(error.message === t('link.newer') ? error.message : t('link.damaged'), true);
    return null;
  }
}

/** The study in the address, which is removed from it: its condition, the text that people agree to, and settings. `null` if there is none, or if
 * something in it is wrong, which is told.
 * @returns {{ id: string, consent: any, settings: Record<string, any> } | null} */
export function readStudy() {
  const text = takeOff('study');
  if (text === undefined) return null;
  try {
    const { id, consent, settings = {} } = JSON.parse(decodeURIComponent(text));
    if (typeof id === 'string' && id.trim() && Object.entries(settings).every(([name, value]) => SHARED.includes(name) && isSetting(name, value))) return { id, consent, settings };
  } catch { /* Then it is damaged, too. */ }
  tell(t('link.damaged'), true);
  return null;
}

// The text of this name in the address, which is removed from it, so that a reload does not undo later changes. Other names after the #,
// such as that of the skip link, are left alone.
function takeOff(name) {
  const [, text] = location.hash.match('^#(?:' + name + ')=(.*)$') || [];
  if (text !== undefined) history.replaceState(null, '', location.href.split('#')[0]);
  return text;
}

/** Takes the home and the settings from the address. Returns whether there were any. */
export function readLink() {
  const text = takeOff('home');
  if (text === undefined) return false;
  try {
    const share = JSON.parse(new TextDecoder().decode(unchecked(text)));
    world.setEnvironment(JSON.stringify(share.home));
    for (const name of SHARED) {
      const value = (share.settings || {})[name];
      if (isSetting(name, value)) state.settings[name] = value;
    }
    for (const name of OF_CLASS) if (isSetting(name, share.settings?.[name])) keepSetting(name, share.settings[name]);
    put('class', share.settings?.language ? JSON.stringify(share.home) : null);
    world.setPulls(state.settings.pull);
    const { style } = state.settings;
    if (style !== expectedNow()) expectTrainer(style);
    return true;
  } catch (error) {
    state.settings.style = expectedNow();
    tell(error.message === t('link.newer') ? error.message : t('link.damaged'), true);
    return false;
  }
}
