// Commands, tasks and things in words.
import { parsed, world } from './core.js';
import { listed, named, t } from './language.js';
import { state } from './state.js';

/** @typedef {import('./language.js').Key} Key */

export const ACTIONS = ['north', 'south', 'east', 'west', 'pull', 'noop'];
/** The words for an action that was done.
 * @param {string} action */
export const acted = action => named('did.' + action) || action;

// A colour or a shape in the current language, or else as it was entered. Colours may have a second form.
/** @param {string} color */
export const formsOf = color => (named('color.' + color.toLowerCase()) || color).split('|');
const inForm = (text, thing) => {
  const [m, f] = formsOf(thing.color);
  return text.replace('{m}', m).replace('{f}', f || m).replace('{shape}', shapeWords(thing.shape));
};
export const shapeWords = shape => named('shape.' + shape.toLowerCase()) || shape;
export const colorWords = color => formsOf(color)[0];

/** A room or a block with its article: `form` 0 as an object, 1 as a subject, 2 as a place.
 * @param {{ color: string, shape: string }} thing */
function thingWords(thing, form = 0) {
  const forms = (named('thing.' + thing.shape.toLowerCase()) || t('thing.other')).split('|');
  return inForm(forms[form] || forms[0], thing);
}

/** A room or a block as it is written on the plan.
 * @param {{ color: string, shape: string }} thing */
export const labelWords = thing => inForm(named('label.' + thing.shape.toLowerCase()) || t('label.other'), thing);

const asThing = room => ({ ...room, shape: 'room' });

/** A room or a block by its looks, and by its name if another looks alike.
 * @param {string} name
 * @param {number} form
 * @param {{ rooms: any[], blocks: any[] }} scene */
export function objectWords(name, form = 0, { rooms, blocks } = state.scene) {
  const kind = rooms.some(room => room.name === name) ? rooms.map(asThing) : blocks;
  const thing = kind.find(one => one.name === name);
  if (!thing) return name;
  const alike = kind.filter(one => one.color === thing.color && one.shape === thing.shape).length;
  return thingWords(thing, form) + (alike > 1 ? ' (' + name + ')' : '');
}

/** A task in a person's words, from its name in logs.
 * @param {string} name
 * @param {{ rooms: any[], blocks: any[] }} scene */
export function taskWords(name, scene = state.scene) {
  const object = one => objectWords(one, 0, scene);
  const [goal, clause, places = ''] = name.split(/ (through|avoiding) /);
  const parts = (text, sign) => text.split(sign).map(part => part.match(/^(\w+)\((\w+),(\w+)\)/) || []);
  if (name.startsWith('!')) return t('task.not', { task: taskWords(name.slice(1), scene) });
  const task = listed(parts(goal, ' & ').map(([, kind, first, room]) => (
    kind === 'blockInRoom' ? t('task.take', { thing: object(first), room: object(room) }) : t('task.go', { room: object(room) })
  )), 'and');
  if (!clause) return task;
  const room = listed(parts(places, ' or ').map(([, , , room]) => object(room)), 'or');
  return t(clause === 'through' ? 'task.through' : 'task.avoiding', { task, room });
}

/** @type {Record<string, Key>} */
const WAYS = { any: 'ask.way.any', through: 'ask.way.through', either: 'ask.way.either', avoiding: 'ask.way.avoiding' };

/** A question of the robot as a person hears it.
 * @param {import('goodbot-wasm').Question} question */
export function questionWords({ about, way, objects, choices }) {
  if (about === 'object') return t('ask.object', { thing: objectWords(objects[0]) });
  if (about === 'carrying' || about === 'moving') {
    const question = t(about === 'carrying' ? 'ask.carrying' : 'ask.moving');
    return way ? t('ask.howWay', { question, way: t(WAYS[way]) }) : question;
  }
  if (about === 'task') return t('ask.task', { task: state.belief.tasks[choices[0]].words });
  return t('ask.which');
}

/** The rooms and blocks of a home given as JSON.
 * @param {any} home */
export function sceneOf({ objects }) {
  const of = kind => objects.filter(object => object.class === kind);
  return { rooms: of('room'), blocks: of('block') };
}

/** The belief that the robot would have on hearing a command in another home: tasks. It learns nothing from that, and stays in place. No session may be
 * under way.
 * @param {object} home
 * @param {string} command
 * @returns {import('goodbot-wasm').Task[]} */
export const askedIn = (home, command) => parsed(world.asked(JSON.stringify(home), command)).tasks;

/** @template {import('goodbot-wasm').Task} T
 * @param {T[]} tasks */
export const likeliest = tasks => tasks.reduce((best, task) => (task.probability > best.probability ? task : best));

/** Whether a command is understood: the meant task is the most likely, and above 50 % as the page rounds it.
 * @param {import('goodbot-wasm').Task} best
 * @param {string | undefined} meant */
export const understands = (best, meant) => best.name === meant && Math.round(best.probability * 100) > 50;

/** The robot's current belief. */
export function beliefNow() {
  const belief = parsed(world.belief());
  return { ...belief, tasks: belief.tasks.map(task => ({ ...task, words: taskWords(task.name) })) };
}

function roomAt(scene, x, y) {
  const inside = scene.rooms.find(room => x > room.left && x < room.right && y > room.bottom && y < room.top);
  return inside ? thingWords(asThing(inside), 1) : t('plan.doorway');
}

// The floor plan as sentences.
export function describeScene(scene) {
  const at = thing => ({ x: thing.x - scene.bounds.left + 1, y: scene.bounds.top - thing.y + 1, room: roomAt(scene, thing.x, thing.y) });
  return [
    t('plan.robotAt', at(scene.agent)),
    ...scene.blocks.map(block => t('plan.thingAt', { ...at(block), thing: thingWords(block, 1) })),
    ...scene.rooms.map(room => t('plan.room', {
      x0: room.left - scene.bounds.left + 1, x1: room.right - scene.bounds.left + 1, y0: scene.bounds.top - room.top + 1, y1: scene.bounds.top - room.bottom + 1, room: thingWords(asThing(room), 1),
    })),
    ...scene.doors.map(door => t('plan.door', { x: door.left - scene.bounds.left + 1, y: scene.bounds.top - door.top + 1 })),
  ];
}

// The tasks, the most likely first; among equals the one that the robot follows.
export function ranked() {
  const followed = state.session && state.session.decided ? state.session.decided.task : -1;
  return state.belief.tasks.map((task, index) => ({ ...task, index }))
    .sort((a, b) => b.probability - a.probability || Number(b.index === followed) - Number(a.index === followed) || a.index - b.index);
}

// A word; if the robot may have kept only its first letters, with an ellipsis.
export const wordShown = (word, letters) => (letters && [...word].length >= letters ? word + '…' : word);

export const quoted = word => t('say.quoted', { 0: unspaced(word) });

export const sessionsWord = (n = state.sessions) => t('sessions', { n });

// Scripts that are written without spaces between the words.
const UNSPACED = /[\p{Script=Han}\p{Script=Hiragana}\p{Script=Katakana}\p{Script=Thai}\p{Script=Lao}\p{Script=Khmer}\p{Script=Myanmar}]/u;

/** A command in composed letters, with spaces between its words, in any script, and without the invisible signs that isolate words.
 * @param {string} written */
export function spaced(written) {
  const command = written.normalize('NFKC').replace(/[\u2066-\u2069]/g, '').replace(/[‘’ʼ]/g, "'");
  if (!UNSPACED.test(command) || !('Segmenter' in Intl)) return command;
  return [...new Intl.Segmenter(undefined, { granularity: 'word' }).segment(command)].map(part => part.segment.trim()).filter(Boolean).join(' ');
}

/** A command as people write it: `spaced` undone.
 * @param {string} command */
export const unspaced = command => (UNSPACED.test(command) ? command.replaceAll(' ', '') : command);
