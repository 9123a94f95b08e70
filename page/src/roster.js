// The robots of this browser: which one learns here, their names, copies, and the deleted ones.
import { readFile } from './bytes.js';
import { world } from './core.js';
import { render } from './render.js';
import { heatNow, leaveSession, refresh } from './session.js';
import { readRobot } from './link.js';
import { refused } from './shelf.js';
import { $, make, state, tell } from './state.js';
import { add, copy, freeName, logOf, newRecord, open, patch, robots, takeModel } from './store.js';
import { enterStop } from './tour.js';
import { sessionsWord } from './words.js';

const sessionsOf = robot => robot.sessions + (robot.sessions === 1 ? ' session' : ' sessions');

/** Says who learns here, and what of it is not kept. */
export function renderRoster() {
  const guest = state.robot.log !== undefined;
  const all = robots();
  $('who').textContent = state.robot.name;
  $('robots').replaceChildren(...all.filter(robot => !robot.deleted).map(robot => {
    const here = robot.id === state.robot.id;
    const name = make('input', { value: robot.name, maxlength: 40, 'aria-label': 'Name of ' + robot.name });
    name.addEventListener('change', () => rename(robot, name.value));
    return make('li', { class: here ? 'here' : '' }, name, make('small', {}, sessionsOf(robot)),
      make('button', { type: 'button', class: 'small', 'aria-pressed': String(here), 'aria-label': (here ? 'Learns here: ' : 'Switch to ') + robot.name, onclick: () => switchTo(robot) }, here ? 'Learns here' : 'Switch'),
      make('button', { type: 'button', class: 'small quiet', 'aria-label': 'Copy ' + robot.name, onclick: () => copyRobot(robot) }, 'Copy'),
      make('button', { type: 'button', class: 'small quiet', 'aria-label': 'Delete ' + robot.name, onclick: () => deleteRobot(robot) }, 'Delete'));
  }));
  const deleted = all.filter(robot => robot.deleted);
  $('deleted').hidden = !deleted.length;
  $('deleted').replaceChildren('Deleted, and kept for thirty days: ', ...deleted.map(robot => make('button', { type: 'button', class: 'small', onclick: () => bringBack(robot) }, 'Bring back ' + robot.name)));
  const lost = refused();
  const kinds = [[/^robot/, 'what the robot has learned'], [/^log/, 'how it was taught'], [/^(drawing|home)/, 'your home'], [/^settings/, 'your settings']]
    .filter(([kind]) => lost.some(key => /** @type {RegExp} */ (kind).test(key))).map(([, words]) => words);
  $('unkept').hidden = !kinds.length;
  $('unkept').textContent = kinds.length ? 'This browser does not keep ' + kinds.join(', ') + ': its storage is blocked or full. Save it as a file before you leave (under “Settings, keeping, sharing”).' : '';
  $('kept').textContent = guest ? 'This robot is not kept.' : lost.some(key => key.startsWith('robot')) ? 'Not kept: save the model as a file.' : 'Kept in this browser: ' + sessionsWord() + '.';
  $('guest').hidden = !guest;
  $('guest-words').textContent = state.visitor ? 'Meet ' + state.robot.name + '. It knows ' + (state.heat.now?.words.length || 0) + ' words. It is a visitor, and your robots are as they were.' : 'This robot is only shown. Yours waits.';
  $('keep-guest').hidden = !guest || state.sessions === 0 || state.tour.watching;
}

function shown() {
  refresh();
  state.evidence = [];
  state.support = null;
  state.heat = { now: heatNow(), before: null };
  if (state.mode === 'tour') enterStop(state.tour.at);
  render();
}

/** @param {import('./store.js').Robot} robot */
export async function switchTo(robot) {
  if (robot.id === state.robot.id || !await leaveSession()) return;
  try {
    await open(robot);
  } catch (error) {
    tell('“' + robot.name + '” cannot be used here: ' + error.message + '. It stays kept.', true);
    return;
  }
  shown();
  tell(robot.name + ' learns here now.');
}

function rename(robot, name) {
  const given = name.trim().slice(0, 40) || robot.name;
  patch(robot, { name: given });
  if (robot.id === state.robot.id) state.robot.name = given;
  render();
}

async function copyRobot(robot) {
  const twin = copy(robot, freeName(robot.name));
  render();
  tell(twin.name + ' knows what ' + robot.name + ' knows.');
}

async function deleteRobot(robot) {
  const here = robot.id === state.robot.id;
  if (here && !await leaveSession()) return;
  patch(robot, { deleted: Date.now() });
  if (here) {
    const next = robots().filter(other => !other.deleted).at(-1);
    if (next) await open(next);
    else await newRobot();
    shown();
  }
  render();
  tell(robot.name + ' is deleted. “Bring back” is below the list.');
}

function bringBack(robot) {
  patch(robot, { deleted: 0 });
  render();
  tell(robot.name + ' is back.');
}

/** A robot that has learned nothing becomes the one of this tab. The others stay. */
export async function newRobot() {
  world.restart();
  const robot = newRecord(freeName('Robot 1'));
  add(robot);
  await open(robot);
  shown();
  tell('A new robot, ' + robot.name + '. It knows no word. The others are under “Your robots”.');
}

/** A robot that is shown and not kept, unless somebody says so. `home` is the one that waits. */
export async function beginGuest(name) {
  world.restart();
  const mine = state.robot.log === undefined ? state.robot : state.mine;
  const robot = { ...newRecord(name), log: '' };
  await open(robot);
  state.mine = mine;
  state.visitor = false;
}

/** The robot of a link visits: one's own waits. Returns whether it has come. */
export async function meet() {
  const visitor = await readRobot();
  if (!visitor) return false;
  const mine = state.robot;
  try {
    await beginGuest(visitor.name);
    await takeModel(visitor.model);
    Object.assign(state.robot, newRecord(visitor.name), { log: '' });
    state.mode = 'play';
    state.settings.pull = visitor.pull;
    world.setEnvironment(JSON.stringify(visitor.home));
    world.setPulls(visitor.pull);
  } catch {
    await open(mine);
    state.mode = 'tour';
    tell('The robot of this link cannot be used here. Ask for the link once more.', true);
    return false;
  }
  state.visitor = true;
  refresh();
  return true;
}

/** Back to one's own robot. */
export async function endGuest() {
  if (!await leaveSession() || !state.mine) return;
  await open(robots().find(robot => robot.id === state.mine?.id) || state.mine);
  shown();
  tell(state.robot.name + ' is here again.');
}

/** The robot that was only shown becomes one of one's own. */
export async function keepGuest() {
  const log = logOf(state.robot);
  const robot = { ...state.robot, name: freeName(state.robot.name), tour: { at: state.tour.at, done: [...state.tour.done] } };
  add(robot, log);
  await open(robot);
  render();
  tell(robot.name + ' is kept, under “Your robots”.');
}

/** A model from a file is one more robot. */
export async function loadModel(input) {
  const { content, name } = await readFile(input, 'bytes');
  if (!await leaveSession()) return;
  state.phase = 'learning';
  render();
  try {
    await takeModel(new Uint8Array(/** @type {ArrayBuffer} */ (content)));
    const robot = newRecord(freeName(name));
    add(robot);
    await open(robot);
    tell('A new robot from the file, ' + robot.name + ', knows ' + sessionsWord() + '. The others are under “Your robots”.');
  } catch (error) {
    tell('This file is no model that can be used: ' + error.message + '. The robot keeps what it knew.', true);
    return;
  } finally {
    state.phase = 'none';
    refresh();
    render();
  }
  shown();
}
