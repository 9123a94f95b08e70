// The game of tricking the robot: its lessons always showed two ideas together, so that it takes one for the other. One of several
// further lessons repairs that. Each answer is the core's own.
import { learn, world } from './core.js';
import { listed, percent, t } from './language.js';
import { nameHome } from './play.js';
import { beginGuest, endGuest } from './roster.js';
import { takeStock } from './session.js';
import { $, announce, isDrawn, make, render, state } from './state.js';
import { enterHome } from './stops.js';
import { change, travel } from './store.js';
import { leaveSession, startSession } from './training.js';
import { beliefNow, quoted, spaced, taskWords, understands } from './words.js';

/** @typedef {{ home: string, intended: string, command: string }} Lesson */

// A lesson as written below: the rooms from left to right, the blocks in the middle room, and the block that goes to a room; without a
// block, the robot goes.
/** @typedef {[rooms: string, blocks: string, block: string, room: string]} Written */

const RGY = 'red green yellow';
const GYR = 'green yellow red';
const TWO = 'blue chair,purple bag';
const OTHER = 'purple bag,blue chair';

/** @type {{ taught: Written[], asked: Written, repairs: Written[] }[]} */
const LEVELS = [
  // Everything went to the red room.
  {
    taught: [[RGY, TWO, 'blue chair', 'red'], [GYR, OTHER, 'purple bag', 'red']],
    asked: ['yellow blue green', TWO, 'blue chair', 'green'],
    repairs: [[RGY, TWO, 'purple bag', 'red'], [GYR, TWO, 'purple bag', 'green'], [RGY, TWO, '', 'red']],
  },
  // It never went anywhere by itself.
  {
    taught: [[RGY, TWO, 'blue chair', 'red'], [GYR, OTHER, 'purple bag', 'red'], [RGY, TWO, 'purple bag', 'yellow'], [GYR, TWO, 'blue chair', 'green']],
    asked: [RGY, 'blue chair', '', 'yellow'],
    repairs: [[RGY, TWO, 'blue chair', 'yellow'], [GYR, OTHER, '', 'red'], [GYR, OTHER, 'purple bag', 'green']],
  },
  // What was a chair was blue.
  {
    taught: [[RGY, '', '', 'red'], [GYR, '', '', 'green'], [RGY, TWO, 'blue chair', 'red'], [GYR, OTHER, 'blue chair', 'green']],
    asked: [RGY, 'blue bag,purple chair', 'purple chair', 'red'],
    repairs: [[RGY, TWO, 'blue chair', 'yellow'], [RGY, 'blue bag,purple bag', 'blue bag', 'red'], [RGY, '', '', 'yellow']],
  },
];

/** @param {Written} written
 * @returns {Lesson} */
function lesson([rooms, blocks, block, room]) {
  const [colors, things] = [rooms.split(' '), blocks ? blocks.split(',') : []];
  const goal = 'room' + colors.indexOf(room);
  const scene = {
    rooms: colors.map((color, at) => ({ class: 'room', name: 'room' + at, left: 6 * at, bottom: 0, right: 6 * at + 6, top: 6, color })),
    blocks: things.map((thing, at) => ({ class: 'block', name: 'block' + at, x: 8 + 2 * at, y: 2 + 2 * at, color: thing.split(' ')[0], shape: thing.split(' ')[1] })),
  };
  const doors = [6, 12].map((x, at) => ({ class: 'door', name: 'door' + at, left: x, bottom: 3, right: x, top: 3 }));
  const intended = block ? 'blockInRoom(block' + things.indexOf(block) + ',' + goal + ')' : 'agentInRoom(agent0,' + goal + ')';
  const home = JSON.stringify({ version: 1, objects: [...scene.rooms, ...doors, ...scene.blocks, { class: 'agent', name: 'agent0', x: 7, y: 3 }] });
  return { home, intended, command: taskWords(intended, scene) };
}

/** @type {{ level: number, robot: object, repaired: boolean, says: string[], choices: [string, () => any][] } | null} */
let game = null;

// The trainer gives the meaning: the robot learns from that without a step.
/** @param {Lesson} taught */
async function teach({ home, intended, command }) {
  await change(quoted(command), async () => {
    world.setEnvironment(home);
    world.hear(spaced(command));
    world.answerAs(intended, true, 0.05, beliefNow().tasks.length - 1, '');
    const lines = world.finish();
    await learn();
    return lines;
  });
}

const told = (says, choices) => {
  if (game) Object.assign(game, { says, choices });
  state.tab = 'challenges';
  render();
  announce(says.join(' '));
  $('trick-choices').querySelector('button')?.focus({ preventScroll: true });
  // On a phone the question is below the plan.
  $('trick').scrollIntoView({ block: 'nearest' });
};

/** @param {number} level */
async function beginLevel(level) {
  if (!await leaveSession()) return;
  const taught = LEVELS[level].taught.map(lesson);
  const asked = lesson(LEVELS[level].asked);
  await beginGuest(t('trick.robot'));
  for (const one of taught) await teach(one);
  game = { level, robot: state.robot, repaired: false, says: [], choices: [] };
  enter(asked);
  const says = t('trick.taught', { commands: listed([...new Set(taught.map(one => quoted(one.command)))]) });
  told([t('trick.level', { n: level + 1, of: LEVELS.length }), says], [[t('tour.ask', asked), ask]]);
}

function enter({ home }) {
  enterHome(home);
  nameHome();
  takeStock();
}

// The robot shows how it understands the command.
function ask() {
  if (!game) return;
  const { level, robot } = game;
  const [asked, repairs] = [lesson(LEVELS[level].asked), LEVELS[level].repairs.map(lesson)];
  enter(asked);
  const session = startSession(asked.command, { looking: true });
  if (!session) return;
  const [best] = session.heard;
  Object.assign(game, { says: [], choices: [] });
  render();
  session.onEnd = () => {
    if (game?.robot !== robot) return;
    const thought = t('trick.thought', { task: best.words, sure: percent(best.probability) });
    if (!understands(best, asked.intended)) {
      told([thought, t('trick.which', asked)], repairs.map(one => [one.command, () => repair(one)]));
      return;
    }
    const last = level + 1 === LEVELS.length;
    told([thought, t('trick.right'), last ? t('trick.over') : ''], [last ? [t('guest.end'), endGuest] : [t('trick.next'), () => beginLevel(level + 1)]]);
  };
}

// One more lesson, in place of one that did not help.
/** @param {Lesson} chosen */
async function repair(chosen) {
  if (state.session || !game) return;
  if (game.repaired) await travel('past');
  game.repaired = true;
  await teach(chosen);
  ask();
}

/** Whether this robot is being tricked: then the next lesson would be the answer. */
export const isTricked = () => game?.robot === state.robot;

export function renderTrick() {
  if (game && game.robot !== state.robot) game = null;
  $('trick').hidden = Boolean(state.secret);
  const says = game ? game.says : [t('trick.about')];
  const choices = game ? game.choices : /** @type {[string, () => any][]} */ ([[t('trick.play'), () => beginLevel(0)]]);
  if (isDrawn('trick', says, choices.map(([words]) => words))) return;
  $('trick-say').replaceChildren(...says.filter(Boolean).flatMap((line, at) => (at ? [make('br'), line] : [line])));
  $('trick-choices').replaceChildren(...choices.map(([words, then]) => make('button', { type: 'button', class: 'small', onclick: then }, words)));
}
