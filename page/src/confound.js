// What always came together in the robot's own training, so that it cannot tell which word means which: every chair was blue.
import { parsed } from './core.js';
import { spaced } from './learned.js';
import { state } from './state.js';
import { logOf } from './store.js';
import { askedIn, formsOf, likeliest, sceneOf } from './words.js';

/** What a session taught: which thing was to go to which room, by their looks; of a session about the robot alone the room alone.
 * @typedef {{ color: string, shape: string, room: string, command: string, home: string, intended: string }} Taught */

// Enough to see what always comes together, and few enough to wait for.
const MOST_SESSIONS = 60;

/** What the robot's own sessions taught, as it understands them now.
 * @returns {Taught[]} */
export function taughtHere() {
  const sessions = [];
  let session = null;
  for (const line of logOf(state.robot).split('\n').filter(Boolean)) {
    const record = parsed(line);
    if (record.type === 'session') session = record;
    if (record.type === 'end' && record.learn && session) sessions.push(session);
  }
  return sessions.slice(-MOST_SESSIONS).flatMap(({ environment, command }) => {
    const { name, probability } = likeliest(askedIn(environment, command));
    const [, thing, place] = name.match(/^\w+InRoom\((\w+),(\w+)\)$/) || [];
    const { rooms, blocks } = sceneOf(environment);
    const room = rooms.find(one => one.name === place)?.color;
    const { color = '', shape = '' } = blocks.find(one => one.name === thing) || {};
    return probability > 0.5 && room ? [{ color, shape, room, command: spaced(command), home: JSON.stringify(environment), intended: name }] : [];
  });
}

/** Lessons with two looks that never came one without the other, in two sessions at least; and the colour to change, that of the thing or of the room,
 * for them to come apart.
 * @param {Taught[]} all
 * @returns {{ lesson: Taught, part: 'color' | 'room' }[]} */
export function confounds(all) {
  const carried = all.filter(({ color, shape, room }) => [color, shape, room].every(look => /^\S+$/.test(look)) && color !== room);
  return /** @type {const} */ ([['shape', 'color'], ['color', 'room'], ['shape', 'room']]).flatMap(([one, part]) => carried.flatMap(lesson => {
    const touched = carried.filter(other => other[one] === lesson[one] || other[part] === lesson[part]);
    const together = touched.every(other => other[one] === lesson[one] && other[part] === lesson[part]);
    return touched[0] === lesson && touched.length > 1 && together ? [{ lesson, part }] : [];
  }));
}

/** A command with another colour in the place of one; nothing where its words do not have that one, in the language of the page.
 * @param {string} command
 * @param {string} from
 * @param {string} to */
export function recoloured(command, from, to) {
  const words = command.split(' ');
  for (const [at, form] of [...formsOf(from).entries()].sort((a, b) => b[1].length - a[1].length)) {
    const found = words.findIndex(word => word.toLowerCase().startsWith(form));
    if (found < 0) continue;
    const forms = formsOf(to);
    words[found] = (forms[at] || forms[0]) + words[found].slice(form.length);
    return words.join(' ');
  }
  return '';
}
