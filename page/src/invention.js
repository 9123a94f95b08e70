// The front door: a language that the visitor invents. A sentence of it has a room's word first, and then what to do. Three lessons teach its four
// parts, and the test joins two parts that no lesson has joined.
import { t } from './language.js';
import { state } from './state.js';
import { askedIn, likeliest, spaced } from './words.js';

/** @typedef {{ red: string, go: string, blue: string, take: string, more: number }} Invention the words of each part, and how many lessons there are beyond three */
/** @typedef {'red' | 'go' | 'blue' | 'take'} Part */

/** A language without words.
 * @returns {Invention} */
export const noWords = () => ({ red: '', go: '', blue: '', take: '', more: 0 });

/** The language of a link: texts, whatever the link has.
 * @returns {Invention} */
export const takeWords = ({ red, go, blue, take }) => ({ red: String(red), go: String(go), blue: String(blue), take: String(take), more: 0 });

// Three rooms in a row, with the bag in the middle one.
/** @param {number} x where the robot stands */
const home = x => JSON.stringify({
  version: 1,
  objects: [
    ...['red', 'yellow', 'blue'].map((color, at) => ({ class: 'room', name: 'room' + at, left: [0, 3, 7][at], bottom: 0, right: [3, 7, 10][at], top: 5, color })),
    ...[[3, 2], [3, 3], [7, 2], [7, 3]].map(([left, bottom], at) => ({ class: 'door', name: 'door' + at, left, bottom, right: left, top: bottom })),
    { class: 'block', name: 'block0', x: 5, y: 3, color: 'purple', shape: 'bag' },
    { class: 'agent', name: 'agent0', x, y: 2 },
  ],
});
// In the test the robot stands in the blue room, from where it has to go around the bag.
const [HOME, AWAY] = [home(5), home(9)];

/** @type {[Part, Part, string][]} */
const LESSONS = [['red', 'go', 'agentInRoom(agent0,room0)'], ['blue', 'go', 'agentInRoom(agent0,room2)'], ['red', 'take', 'blockInRoom(block0,room0)']];
/** @type {[Part, Part, string]} */
const UNHEARD = ['blue', 'take', 'blockInRoom(block0,room2)'];
/** The idea of each part.
 * @type {[Part, string][]} */
const IDEAS = [['red', 'colorRed'], ['blue', 'colorBlue'], ['go', 'agentInRoom'], ['take', 'blockInRoom']];

const stop = (own, [room, act, intended], test) => ({ home: test ? AWAY : HOME, intended, test, appendix: false, command: [own[room], own[act]].join(' ').trim() });

/** The lessons and the test of an invented language.
 * @param {Invention} own */
export const stopsOf = own => [...LESSONS, ...Array(own.more).fill(LESSONS[2])].map(lesson => stop(own, lesson, false)).concat(stop(own, UNHEARD, true));

/** The parts of an invented language, each with its idea.
 * @param {Invention} own
 * @returns {[string, string][]} */
export const partsOf = own => IDEAS.map(([part, idea]) => [own[part], idea]);

/** The parts that a lesson asks for, and those around the field.
 * @param {Invention} own */
export const askedFor = (own, at) => [
  { wanted: !own.red, before: '', after: '' }, { wanted: !own.blue, before: '', after: own.go }, { wanted: !own.take, before: own.red, after: '' },
][at] ?? { wanted: false, before: '', after: '' };

/** Words for a lesson, for who writes none. */
export const offered = at => t('own.words').split('|')[at] ?? '';

/** What a link to an invented language has: it, and the home of its lessons, because there the robot can do whatever a word says.
 * @param {Invention | null | undefined} own */
export const inItsHome = own => (own?.take ? { own, home: JSON.parse(HOME) } : {});

// Each sign of Chinese is a word: no dictionary knows where an invented word ends.
/** @returns {string[]} */
const wordsOf = written => spaced(written.replace(/\p{Script=Han}/gu, ' $& ')).match(/[\p{L}\p{M}\p{N}'’]+/gu) || [];

/** Takes the words for a lesson. Returns what is wrong with them, or nothing.
 * @param {Invention} own
 * @param {string} written */
export function invent(own, at, written) {
  if (!askedFor(own, at).wanted) return '';
  const words = wordsOf(written.trim() || offered(at));
  const known = wordsOf([own.red, own.go, own.blue].join(' ').toLowerCase());
  if (at === 0 ? new Set(words.map(word => word.toLowerCase())).size < 2 : words.every(word => known.includes(word.toLowerCase()))) return t(at === 0 ? 'own.two' : 'own.other');
  if (at === 0) [own.red, own.go] = [words[0], words.slice(1).join(' ')];
  else own[at === 1 ? 'blue' : 'take'] = words.join(' ');
  return '';
}

// It needs some room above one half: the test counts from there.
const [SURE, MOST_MORE] = [0.55, 3];

/** After the last lesson: has it once more, if the robot does not yet know what the test's sentence means. */
export function goOnUntilSure() {
  const { own } = state.tour;
  if (!own?.take || own.more >= MOST_MORE) return;
  const best = likeliest(askedIn(JSON.parse(AWAY), spaced(stop(own, UNHEARD, true).command)));
  if (best.name !== UNHEARD[2] || best.probability < SURE) own.more += 1;
}
