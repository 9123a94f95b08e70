// Kept data: robots with their models, their logs, and the changes that can be undone. Several tabs may use them at once: each takes over
// the lessons of the others, and a session that ends in one is learned on top of those that another learned meanwhile.
import { fromBase64, toBase64 } from './base64.js';
import { expectedNow } from './believes.js';
import { heatNow, learn, whileLearning, world } from './core.js';
import { noWords } from './invention.js';
import { t } from './language.js';
import * as shelf from './shelf.js';
import { state, tell } from './state.js';

const VERSION = 2;
const MOST_STEPS_BACK = 30;
const DAYS_KEPT = 30;

/** @typedef {{ at: number, done: string[], said?: Record<string, string>, own?: import('./invention.js').Invention | null }} Tour the progress of a tour, the user's own words for its commands, and an invented language */

/**
 * A point to which one can go back, or forward again.
 * @typedef {object} Point
 * @property {string} what the change after it, in words
 * @property {string} model
 * @property {number} sessions
 * @property {Tour} tour
 * @property {boolean} [ways]
 * @property {string} [starter]
 * @property {string} [had] the starter that it had in the change: none in the tour
 * @property {number} length how long the log is there
 * @property {string} [rest] the log's lines that come again on the way forward
 */

/** @typedef {{ after: number, home: object, command: string, meant: string, heard: number, understood: string, right: string, guess: string }} Asked a test: after how many lessons, what was meant, how sure of that the robot was, what it understood, and what the trainer guessed */

/**
 * A robot as it is kept. Its log is kept separately.
 * @typedef {object} Robot
 * @property {number} version
 * @property {string} id
 * @property {string} name
 * @property {number} changed
 * @property {number} deleted when it was deleted, or 0
 * @property {string} model
 * @property {number} sessions
 * @property {Tour} tour
 * @property {boolean} [ways] whether commands to it may say how
 * @property {string} [starter] the language of the everyday sentences that it knows; its model is without them
 * @property {(number | null)[]} [scores] for each session, how sure it was of the taught task when it heard the command
 * @property {(number | null)[]} [seeds] for each session, the seed of the robot's choices
 * @property {string[]} [meant] for each session, the task that a tour meant
 * @property {Asked[]} [asked] the tour's tests that it was asked
 * @property {import('./owntests.js').OwnTest[]} [tests] commands that it is tested by
 * @property {{ id: string, consent: string }} [study] the condition of the study that it is for, and when its trainer agreed to take part
 * @property {Point[]} past
 * @property {Point[]} future
 * @property {string} [log] the log of a robot that is not kept
 */

const newId = () => Date.now().toString(36) + Math.floor(Math.random() * 1e9).toString(36);

/** All robots, the oldest first; the deleted ones too.
 * @returns {Robot[]} */
export const robots = () => shelf.keysOf('robot.').map(id => shelf.read('robot.' + id, null)).filter(isRobot).sort((a, b) => (a.id < b.id ? -1 : 1));

const isRobot = robot => Boolean(robot) && robot.version === VERSION && typeof robot.model === 'string' && Array.isArray(robot.past) && Array.isArray(robot.tour?.done);

/** A robot with the current model of the world's robot.
 * @param {string} name
 * @returns {Robot} */
export const newRecord = name => ({
  version: VERSION, id: newId(), name, changed: Date.now(), deleted: 0, model: toBase64(world.save()), sessions: world.sessions(), tour: { at: 0, done: [] }, ways: world.ways(), past: [], future: [],
});

// Before a robot is written it is read, to keep the changes of other tabs. Call this only in `shelf.alone`, while no other tab writes.
/** @param {Robot} robot */
function write(robot) {
  robot.changed = Date.now();
  if (robot.log === undefined) shelf.put('robot.' + robot.id, JSON.stringify(robot));
}

/** The robot as it is kept; `null` if it is not kept.
 * @param {Robot} robot
 * @returns {Robot | null} */
function kept(robot) {
  const stored = robot.log === undefined && shelf.read('robot.' + robot.id, null);
  return isRobot(stored) ? stored : null;
}

/** The sessions that the robot was taught by, as lines.
 * @param {Robot} robot */
export const logOf = robot => robot.log ?? (shelf.get('log.' + robot.id) || '');

function writeLog(robot, log) {
  if (robot.log !== undefined) robot.log = log;
  else shelf.put('log.' + robot.id, log || null);
}

/** The progress of the tour as it is now. */
export const tourNow = () => ({ at: state.tour.at, done: [...state.tour.done], said: { ...state.tour.said }, own: state.tour.own && { ...state.tour.own } });

/** @param {Robot} robot */
const tourOf = ({ tour }) => ({ at: tour.at, done: [...tour.done], said: { ...tour.said }, own: tour.own ? { ...tour.own } : null });

/** @returns {Point} */
const pointNow = what => ({ what, model: state.robot.model, sessions: state.robot.sessions, tour: tourNow(), ways: world.ways(), starter: state.robot.starter, had: world.starter(), length: logOf(state.robot).length });

// The everyday sentences that a robot has now: none in the tour.
const sentencesNow = starter => (state.mode === 'tour' ? '' : starter || '');

/** Gives this tab's robot the everyday sentences of a language; the robot then has to learn.
 * @param {string} starter */
export function giveStarter(starter) {
  state.robot.starter = starter;
  world.setStarter(sentencesNow(starter));
}

/** Enters the tour, free play or the editor. In the tour the robot is without its everyday sentences.
 * @param {string} mode */
export async function enterMode(mode) {
  state.mode = mode;
  if (world.starter() === sentencesNow(state.robot.starter)) return;
  await whileLearning(() => {
    world.setStarter(sentencesNow(state.robot.starter));
    return learn();
  });
  state.heat = { now: heatNow(), before: null };
}

/** Restores a model in a robot, a part at a time; throws if it is none.
 * @param {import('goodbot-wasm').Goodbot} robot
 * @param {Uint8Array} bytes
 * @param {boolean} ways whether commands may say how
 * @param {string | undefined} starter */
export async function restore(robot, bytes, ways, starter) {
  robot.setWays(ways);
  await learn(robot);
  robot.restore(bytes);
  robot.setStarter(sentencesNow(starter));
  await learn(robot);
}

/** Restores a model in this tab's robot; throws if it is none.
 * @param {Uint8Array} bytes
 * @param {boolean} ways whether commands may say how
 * @param {string} starter */
export async function takeModel(bytes, ways = world.ways(), starter = '') {
  await whileLearning(() => restore(world, bytes, ways, starter));
  state.sessions = world.sessions();
  state.settings.style = expectedNow();
}

// Takes over the lessons that another tab has given this robot since it was last read. Returns whether there were any.
async function catchUp() {
  const { robot } = state;
  const stored = kept(robot);
  if (!stored) return false;
  const stale = stored.model !== robot.model || stored.starter !== robot.starter;
  if (stale) await takeModel(fromBase64(stored.model), stored.ways === true, stored.starter);
  Object.assign(robot, stored);
  return stale;
}

/** Takes over the lessons that another tab has given this robot. Returns whether there were any. */
export const othersTaught = () => shelf.alone(state.robot.id, catchUp);

/** Changes the robot's model, on top of the lessons from other tabs: `work(stale)` is told whether there were any, and returns the lines to add
 * to the log. `what` names the change for undo. `tour` is the tour's progress after it: model and progress are kept at once, so that a page that is
 * closed right then has both or neither.
 * @param {string} what
 * @param {(stale: boolean) => Promise<string>} work
 * @param {() => Tour} tour */
export async function change(what, work, tour = tourNow) {
  const { robot } = state;
  await shelf.alone(robot.id, async () => {
    const stale = await catchUp();
    const point = pointNow(what);
    const lines = await work(stale);
    robot.past = [...robot.past, point].slice(-MOST_STEPS_BACK);
    robot.future = [];
    robot.model = toBase64(world.save());
    robot.sessions = state.sessions = world.sessions();
    robot.tour = tour();
    robot.ways = world.ways();
    robot.deleted = 0;
    writeLog(robot, logOf(robot) + lines);
    write(robot);
  });
}

/** Undoes the last change, or redoes it. Returns its name, or undefined if there is none.
 * @param {'past' | 'future'} from
 * @returns {Promise<string | undefined>} */
export async function travel(from) {
  const { robot } = state;
  let what;
  await shelf.alone(robot.id, async () => {
    await catchUp();
    const point = robot[from].at(-1);
    if (!point) return;
    const here = pointNow(point.what);
    const log = logOf(robot);
    await takeModel(fromBase64(point.model), point.ways === true, point.starter);
    robot[from] = robot[from].slice(0, -1);
    if (from === 'past') {
      here.rest = log.slice(point.length);
      robot.future = [...robot.future, here];
      writeLog(robot, log.slice(0, point.length));
    } else {
      robot.past = [...robot.past, here];
      writeLog(robot, log + point.rest);
    }
    robot.model = point.model;
    robot.sessions = state.sessions;
    robot.tour = point.tour;
    Object.assign(robot, { ways: point.ways, starter: point.starter || '' });
    Object.assign(state.tour, tourOf(robot), { said: state.tour.said });
    write(robot);
    what = point.what;
  });
  return what;
}

/** Changes fields that are not learned, such as the name or the progress of the tour, and keeps the lessons from other tabs.
 * @param {Robot} robot
 * @param {Partial<Robot>} fields */
export async function patch(robot, fields) {
  Object.assign(robot, fields);
  await shelf.alone(robot.id, async () => write(Object.assign(kept(robot) || robot, fields)));
  Object.assign(robot, fields);
}

export const keepTour = () => patch(state.robot, { tour: tourNow() });

// The keys of the robots whose models turned out to be damaged.
const damagedModels = new Set();

/** Makes this the robot of this tab: restores its model in the world. Throws if it is damaged.
 * @param {Robot} robot */
export async function open(robot) {
  const key = 'robot.' + robot.id;
  damagedModels.add(key);
  await takeModel(fromBase64(robot.model), robot.ways === true, robot.starter);
  damagedModels.delete(key);
  state.robot = robot;
  state.secret = '';
  state.tour = { ...tourOf(robot), watching: false };
  if (robot.log !== undefined) return;
  shelf.ofTab.put('robot', robot.id);
  shelf.put('last', robot.id);
}

/** Keeps a robot that is new.
 * @param {Robot} robot
 * @param {string} log */
export function add(robot, log = '') {
  delete robot.log;
  write(robot);
  writeLog(robot, log);
}

/** A copy of a robot, of another name.
 * @param {Robot} robot
 * @param {string} name */
export function copy(robot, name) {
  const twin = { ...structuredClone(robot), id: newId(), name };
  const log = logOf(robot);
  add(twin, log);
  return twin;
}

/** The first name that no robot has.
 * @param {string} name */
export function freeName(name) {
  const taken = new Set(robots().filter(robot => !robot.deleted).map(robot => robot.name));
  let free = name;
  for (let number = 2; taken.has(free); number += 1) free = name.replace(/ \d+$/, '') + ' ' + number;
  return free;
}

/** What is kept here and cannot be read, because it is damaged or a newer page wrote it: the keys, and their texts as they are.
 * @returns {Record<string, string | null>} */
export function unread() {
  const isRead = key => {
    const value = shelf.read(key, null);
    return key.startsWith('robot.') ? isRobot(value) : value !== null;
  };
  // These would be written over.
  for (const key of ['drawing', 'settings', 'session'].filter(one => shelf.get(one) !== null && !isRead(one))) {
    shelf.put('unread.' + key, shelf.get(key));
    shelf.put(key, null);
  }
  const damaged = shelf.keysOf('').filter(key => key.startsWith('unread.') || damagedModels.has(key) || (key.startsWith('robot.') && !isRead(key)));
  return Object.fromEntries(damaged.flatMap(key => [key, key.replace(/^robot/, 'log')]).map(key => [key, shelf.get(key)]).filter(([, text]) => text));
}

/** Whether lessons or drawings would be lost because the browser does not keep them. */
export const wouldBeLost = () => shelf.refused().some(key => /^(drawing$|log\.)/.test(key) || (key.startsWith('robot.') && shelf.read(key, {}).sessions > 0));

/** Opens the robot that this tab or else this browser used last, or a new one. */
export async function openLast() {
  for (const robot of robots()) {
    if (robot.deleted && Date.now() - robot.deleted > DAYS_KEPT * 864e5) for (const key of ['robot.', 'log.']) shelf.put(key + robot.id, null);
  }
  const all = robots().filter(robot => !robot.deleted);
  const wanted = [shelf.ofTab.get('robot'), shelf.get('last')];
  const choice = wanted.map(id => all.find(robot => robot.id === id)).find(Boolean) || all.at(-1);
  if (choice) {
    try {
      await open(choice);
      return;
    } catch (error) {
      tell(t('robots.older', choice), true);
    }
  }
  const fresh = newRecord(freeName(t('robots.first')));
  fresh.tour.own = noWords();
  add(fresh);
  await open(fresh);
}
