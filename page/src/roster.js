// The robots of this browser: the one that learns here, their names, copies, and the deleted ones.
import { expectTrainer, expectedNow } from './believes.js';
import { renderBeside } from './beside.js';
import { attempt, learn, whileLearning, world } from './core.js';
import { ask } from './dialog.js';
import { download, readFile } from './files.js';
import { noWords } from './invention.js';
import { listed, t } from './language.js';
import { readRobot, readStudy } from './link.js';
import { learnFrom } from './logs.js';
import { refresh, takeStock } from './session.js';
import { keepSetting } from './settings.js';
import { put, refused } from './shelf.js';
import { $, make, nextTask, render, state, tell } from './state.js';
import { enterHome, enterStop } from './stops.js';
import { add, change, copy, enterMode, freeName, logOf, newRecord, open, patch, robots, takeModel, travel, unread } from './store.js';
import { saveTable } from './tables.js';
import { isShown } from './tabs.js';
import { leaveSession } from './training.js';
import { sessionsWord, unspaced } from './words.js';

/** @param {import('./store.js').Robot[]} all */
function renderList(all) {
  $('robots').replaceChildren(...all.filter(robot => !robot.deleted).map(robot => {
    const here = robot.id === state.robot.id;
    const name = make('input', { value: robot.name, maxlength: 40, 'aria-label': t('robots.nameOf', robot) });
    name.addEventListener('change', () => rename(robot, name.value));
    return make('li', { class: here ? 'here' : '' }, name, make('small', {}, sessionsWord(robot.sessions)),
      make('button', { type: 'button', class: 'small', 'aria-pressed': String(here), 'aria-label': t(here ? 'robots.hereOf' : 'robots.switchTo', robot), onclick: () => switchTo(robot) }, t(here ? 'robots.here' : 'robots.switch')),
      make('button', { type: 'button', class: 'small quiet', 'aria-label': t('robots.copyOf', robot), onclick: () => copyRobot(robot) }, t('robots.copy')),
      make('button', { type: 'button', class: 'small quiet', 'aria-label': t('robots.deleteOf', robot), onclick: () => deleteRobot(robot) }, t('robots.delete')));
  }));
  renderBeside(all.filter(robot => !robot.deleted));
  const deleted = all.filter(robot => robot.deleted);
  $('deleted').hidden = !deleted.length;
  $('deleted').replaceChildren(t('robots.deleted'), ' ', ...deleted.map(robot => make('button', { type: 'button', class: 'small', onclick: () => bringBack(robot) }, t('robots.back', robot))));
}

/** Shows which robot learns here, and which of its data are not kept. */
export function renderRoster() {
  const guest = state.robot.log !== undefined;
  // The list reads all that is kept of all robots, so it is drawn only where it is seen.
  if (isShown('robots')) renderList(robots());
  $('who').textContent = state.robot.name;
  const lost = refused();
  const kinds = [[/^robot/, t('kept.robot')], [/^log/, t('kept.log')], [/^(drawing|home)/, t('kept.home')], [/^settings/, t('kept.settings')]]
    .filter(([kind]) => lost.some(key => /** @type {RegExp} */ (kind).test(key))).map(([, words]) => words);
  $('unkept').hidden = !kinds.length;
  $('unkept').textContent = kinds.length ? t('kept.not', { what: listed(/** @type {string[]} */ (kinds)) }) : '';
  $('kept').textContent = guest ? t('kept.guest') : lost.some(key => key.startsWith('robot')) ? t('kept.blocked') : t('kept.yes', { sessions: sessionsWord() });
  $('guest').hidden = !guest;
  $('guest-words').textContent = state.shown ? t('guest.session', { name: state.robot.name, command: unspaced(state.shown) }) : state.visitor ? t('guest.visitor', { name: state.robot.name, n: state.heat.now?.words.length || 0 }) : t('guest.shown');
  $('keep-guest').hidden = !guest || state.secret === 'open' || state.sessions === 0 || state.tour.watching;
}

function saveUnread() {
  const found = unread();
  download('unread.json', JSON.stringify(found), 'application/json');
  // Robots stay: a newer page can read them.
  for (const key of Object.keys(found)) if (key.startsWith('unread.')) put(key, null);
  $('unread').hidden = true;
}

/** Says what the page cannot read of what is kept here, and offers it as a file. It stays kept. */
export function tellUnread() {
  const found = unread();
  const { length } = Object.keys(found).filter(key => !key.startsWith('log'));
  $('unread').hidden = !length;
  $('unread').replaceChildren(make('span', {}, t('kept.unread', { n: length })),
    make('button', { type: 'button', class: 'small', onclick: saveUnread }, t('kept.saveUnread')));
}

function shown() {
  takeStock();
  state.evidence = [];
  state.support = null;
  if (state.mode === 'tour') enterStop(state.tour.at);
  render();
}

/** @param {import('./store.js').Robot} robot */
export async function switchTo(robot) {
  if (robot.id === state.robot.id || !await leaveSession()) return;
  try {
    await open(robot);
  } catch (error) {
    tell(t('robots.cannot', { name: robot.name, why: error.message }), true);
    tellUnread();
    return;
  }
  shown();
  tell(t('robots.learnsHere', robot));
}

/** @param {import('./store.js').Robot} robot
 * @param {string} name */
export async function rename(robot, name) {
  const given = name.trim().slice(0, 40) || robot.name;
  await patch(robot, { name: given });
  if (robot.id === state.robot.id) state.robot.name = given;
  render();
}

async function copyRobot(robot) {
  const twin = copy(robot, freeName(robot.name));
  render();
  tell(t('robots.copied', { twin: twin.name, name: robot.name }));
}

async function deleteRobot(robot) {
  const here = robot.id === state.robot.id;
  if (here && !await leaveSession()) return;
  await patch(robot, { deleted: Date.now() });
  if (here) {
    const next = robots().filter(other => !other.deleted).at(-1);
    if (next) await open(next);
    else await newRobot();
    shown();
  }
  render();
  tell(t('robots.isDeleted', robot));
}

async function bringBack(robot) {
  await patch(robot, { deleted: 0 });
  render();
  tell(t('robots.isBack', robot));
}

// The world's robot has learned nothing, and knows the paper's two tasks.
function restart() {
  world.restart();
  world.setWays(false);
}

/** A new robot, which has learned nothing, becomes the one of this tab, for the same kind of tour. The others stay. */
export async function newRobot() {
  restart();
  const robot = newRecord(freeName(t('robots.first')));
  robot.tour.own = state.tour.own && noWords();
  add(robot);
  await open(robot);
  shown();
  tell(t('robots.isNew', robot));
}

/** The next group of a class: the table of this robot is saved, and an empty one takes its place. The old one can be brought back. */
export async function nextGroup() {
  if (!await leaveSession()) return;
  saveTable();
  await patch(state.robot, { deleted: Date.now() });
  state.tour.said = {};
  await newRobot();
}

/** Begins with a robot that is shown and not kept, unless the user asks for it. The user's own robot waits. */
export async function beginGuest(name) {
  restart();
  const mine = state.robot.log === undefined ? state.robot : state.mine;
  const robot = { ...newRecord(name), log: '' };
  await open(robot);
  state.mine = mine;
  [state.visitor, state.secret, state.shown] = [false, '', ''];
}

/** The robot of a link visits: the user's own robot waits. A robot that its trainer takes along is one more of the user's own. Returns the visitor, if there
 * is one. */
export async function meet() {
  const visitor = await readRobot();
  if (!visitor) return null;
  const mine = state.robot;
  try {
    await beginGuest(visitor.name);
    state.mode = visitor.mode;
    await takeModel(visitor.model, visitor.ways, visitor.starter);
    Object.assign(state.robot, newRecord(visitor.name), { log: '', starter: visitor.starter });
    state.robot.tour.own = visitor.own;
    state.settings.pull = visitor.pull;
    world.setEnvironment(JSON.stringify(visitor.home));
    world.setPulls(visitor.pull);
  } catch {
    state.mode = 'tour';
    await open(mine);
    tell(t('guest.cannot'), true);
    return null;
  }
  if (visitor.tour) {
    const robot = { ...newRecord(freeName(visitor.name)), starter: visitor.starter, tour: visitor.tour };
    add(robot);
    await open(robot);
    refresh();
    tell(t('robots.isHere', robot));
    return visitor;
  }
  state.visitor = true;
  state.secret = visitor.secret ? 'open' : '';
  state.shown = visitor.session?.[0].command ?? '';
  refresh();
  return visitor;
}

/** Takes part in the study of the address, if the visitor agrees: with a new robot, from the beginning of the tour. Returns whether there was a
 * study. */
export async function joinStudy() {
  const study = readStudy();
  if (!study || !await leaveSession()) return false;
  const { id, consent, settings } = study;
  const own = consent?.[document.documentElement.lang] ?? consent?.en ?? consent;
  if (await ask(typeof own === 'string' ? own : t('study.consent'), { yes: t('study.agree'), no: t('ask.no') }) === 'no') return true;
  try {
    expectTrainer(settings.style ?? state.settings.style);
  } catch {
    tell(t('link.damaged'), true);
    return true;
  }
  for (const [name, value] of Object.entries(settings)) keepSetting(name, value);
  state.mode = 'tour';
  state.tour.own = null;
  await newRobot();
  await patch(state.robot, { study: { id, consent: new Date().toISOString() } });
  return true;
}

/** Goes back to the user's own robot. */
export async function endGuest() {
  if (!await leaveSession() || !state.mine) return;
  await open(robots().find(robot => robot.id === state.mine?.id) || state.mine);
  shown();
  tell(t('robots.isHere', state.robot));
}

/** Begins a tour: that of an invented language, or the paper's. A robot that has learned something stays as it is, and a new one takes the tour.
 * @param {import('./invention.js').Invention | null} own */
export async function takeTour(own) {
  if (!await leaveSession()) return;
  if (state.robot.log !== undefined && state.mine) await open(state.mine);
  await enterMode('tour');
  state.tour = { at: 0, done: [], said: {}, own, watching: false };
  if (state.sessions) await newRobot();
  enterStop(0);
  $(own ? 'own-words' : 'lesson').focus();
}

/** Keeps a robot that was only shown. */
export async function keepGuest() {
  const log = logOf(state.robot);
  const robot = { ...state.robot, name: freeName(state.robot.name), tour: { at: state.tour.at, done: [...state.tour.done], own: state.tour.own } };
  add(robot, log);
  await open(robot);
  render();
  tell(t('robots.isKept', robot));
}

/** Adds a robot with the model of a file. */
export async function loadModel(input) {
  const { content, name } = await readFile(input, 'bytes');
  if (!await leaveSession()) return;
  try {
    await takeModel(new Uint8Array(/** @type {ArrayBuffer} */ (content)));
    const robot = newRecord(freeName(name));
    add(robot);
    await open(robot);
    tell(t('robots.fromFile', { name: robot.name, sessions: sessionsWord() }));
  } catch (error) {
    // The sentence itself says that it is no model.
    tell(t('robots.noModel', { why: /not a goodbot/.test(error.message) ? '' : ' (' + error.message + ')' }), true);
    return;
  } finally {
    refresh();
    render();
  }
  shown();
}

/** The robot learns from a log. */
export async function loadLog(input) {
  const { content, name } = await readFile(input, 'text');
  if (!await leaveSession()) return;
  const home = world.environment();
  await whileLearning(async () => {
    try {
      await change(t('undo.log', { name }), async () => {
        const learned = await learnFrom(content.trimEnd().split('\n'));
        return learned.length ? learned.join('\n') + '\n' : '';
      });
      tell(t('log.done', { sessions: sessionsWord() }));
    } catch (error) {
      world.forget();
      await learn();
      await open(state.robot);
      tell(t('log.failed', { why: error.message }), true);
    }
  });
  state.progress = '';
  state.settings.style = expectedNow();
  enterHome(home);
  takeStock();
  render();
}

/** Sets whether commands to this robot may say how. */
export const considerWays = value => relearn(t('undo.ways'), () => world.setWays(value));

/** Changes the robot so that it learns its training data anew.
 * @param {string} what
 * @param {() => void} work */
export async function relearn(what, work) {
  await whileLearning(() => change(what, async () => {
    attempt(work);
    await learn();
    return '';
  }));
  takeStock();
}

/** Undoes the last change, or redoes it.
 * @param {'past' | 'future'} from */
export async function undo(from) {
  if (state.session || state.phase === 'learning') return;
  let what;
  try {
    what = await whileLearning(async () => {
      const name = await travel(from);
      await nextTask();
      return name;
    });
  } catch (error) {
    tell(t('undo.cannot', { why: error.message }), true);
  }
  if (what === undefined) {
    render();
    return;
  }
  [state.said, state.verdict] = [null, ''];
  shown();
  tell(t(from === 'past' ? 'undo.done' : 'redo.done', { what, sessions: sessionsWord() }));
}
