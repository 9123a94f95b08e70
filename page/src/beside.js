// One sentence, several robots: what each of them does when it hears it, side by side. Robots that were taught differently do different things.
import { fromBase64 } from './base64.js';
import { guess } from './bubble.js';
import { walk } from './clip.js';
import { Goodbot, attempt, parsed, world } from './core.js';
import { Frame, fitNames, houseDrawing, thingDrawing } from './plan.js';
import { $, announce, draw, isDrawn, make, state } from './state.js';
import { restore } from './store.js';
import { mayCelebrate } from './training.js';
import { likeliest, quoted, spaced } from './words.js';

// More would be too small to see on a telephone.
const MOST_ROBOTS = 4;
// Milliseconds for a step.
const STEP = 350;

/** @type {import('./store.js').Robot[]} */
let all = [];
let searches = 0;

/** The most likely task to a robot that hears a command in the current home. Nobody learns from that.
 * @param {import('./store.js').Robot} robot
 * @param {string} command */
async function taskOf({ model, ways, starter }, command) {
  const mind = new Goodbot(state.settings.seed);
  try {
    mind.setPulls(world.pulls());
    await restore(mind, fromBase64(model), ways === true, starter);
    return likeliest(parsed(mind.asked(world.environment(), command)).tasks);
  } catch (error) {
    return attempt(() => { throw error; });
  } finally {
    mind.free();
  }
}

// The home with the robot on its way to a task; where motion is not wanted, at its end.
function wayTo(task, ways) {
  const { scene, places } = walk(world.environment(), task, ways);
  const frame = new Frame(scene.bounds);
  const put = (thing, isRobot, cells) => {
    const [x, y] = cells[cells.length - 1];
    const drawn = thingDrawing(frame, { ...thing, x, y }, isRobot);
    if (mayCelebrate()) drawn.animate(cells.map(([x, y]) => ({ transform: 'translate(' + frame.x(x) + 'px,' + frame.y(y) + 'px)' })), STEP * cells.length);
    return drawn;
  };
  return draw('svg', { viewBox: [0, 0, frame.width, frame.height].join(' '), 'aria-hidden': 'true' }, houseDrawing(frame, scene),
    ...scene.blocks.map((block, which) => put(block, false, places.map(({ blocks }) => blocks[which]))), put(scene.agent, true, places.map(place => place.robot)));
}

async function askAll() {
  const command = spaced($('beside-command').value.trim() || $('beside-command').placeholder);
  const asked = all;
  const search = searches += 1;
  const told = [];
  const heard = [];
  for (const robot of asked) {
    const task = await taskOf(robot, command);
    // It could not hear the command, and said why.
    if (task) heard.push([robot, task]);
  }
  if (asked !== all || search !== searches) return;
  $('beside-answers').replaceChildren(...heard.map(([robot, task]) => {
    const [head, rest] = guess(task);
    told.push(robot.name + ': ' + head);
    return make('li', {}, make('b', {}, robot.name), wayTo(task.name, robot.ways === true), make('p', {}, head, ' ', make('small', {}, rest)));
  }));
  for (const svg of $('beside-answers').querySelectorAll('svg')) fitNames(svg);
  announce(quoted(command) + ' ' + told.join(' '));
}

/** @param {import('./store.js').Robot[]} robots those of the list */
export function renderBeside(robots) {
  const others = robots.filter(({ id }) => id !== state.robot.id).sort((one, other) => other.changed - one.changed);
  $('beside').hidden = !others.length;
  $('beside-command').placeholder = $('command').value || $('ideas').firstChild?.textContent || '';
  const asked = [state.robot, ...others].slice(0, MOST_ROBOTS);
  if (isDrawn('beside', asked.map(({ id, changed }) => [id, changed]), world.environment(), world.pulls())) return;
  all = asked;
  $('beside-answers').replaceChildren();
}

export function setUpBeside() {
  $('ask-beside').addEventListener('submit', event => {
    event.preventDefault();
    askAll();
  });
}
