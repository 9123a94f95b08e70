// The next lesson: the one that teaches most of the commands that the robot shall understand in the end, and why.
import { attempt, course, parsed, world } from './core.js';
import { t } from './language.js';
import { nameHome } from './play.js';
import * as shelf from './shelf.js';
import { $, inParts, nextFrame, render, state } from './state.js';
import { enterHome } from './stops.js';
import { logOf } from './store.js';
import { isShown } from './tabs.js';
import { leaveSession, startSession } from './training.js';
import { sceneOf, sessionsWord, spaced, taskWords, unspaced } from './words.js';

/** @typedef {{ command: string, home: string | null }} Lesson a command, and the home to teach it in; null is the robot's current home */

/** All that can be taught in the course's homes, the simplest home first.
 * @returns {Lesson[]} */
function lessonsOfCourse() {
  const found = new Map();
  for (const { home: name, intended } of course.teachable) {
    const home = Object.fromEntries(course.homes)[name];
    const command = taskWords(intended, sceneOf(home));
    if (!found.has(command)) found.set(command, { command, home: JSON.stringify(home) });
  }
  return [...found.values()];
}

// As many commands are looked at: with more, a telephone is busy for seconds, and what was taught long ago changes little.
const MOST_WANTED = 20;

// The commands that this robot has learned from last.
function taught() {
  const sessions = logOf(state.robot).split('\n').filter(line => line.includes('"type":"session"'));
  return [...new Set(sessions.reverse().map(line => attempt(() => parsed(line).command) || ''))].filter(Boolean);
}

function wanted() {
  const own = $('wanted').value.split('\n').map(line => line.trim()).filter(Boolean);
  return (own.length ? own : taught()).slice(0, MOST_WANTED).map(spaced);
}

/** @typedef {{ lesson: Lesson, why: import('goodbot-wasm').NextLesson } | null} Found */

/** The lesson to teach next. The lessons are compared two at a time, with frames between, because all at once would hold up the page.
 * @param {() => boolean} isStale whether the answer is no longer wanted
 * @returns {Promise<Found>} */
async function next(isStale) {
  const all = wanted();
  const ofCourse = lessonsOfCourse();
  const own = all.filter(command => !ofCourse.some(lesson => spaced(lesson.command) === command)).map(command => ({ command, home: null }));
  const lessons = [...ofCourse, ...own];
  /** @type {Found} */
  let best = null;
  if (all.length) {
    await inParts(() => {
      const lesson = lessons.shift();
      if (!lesson || isStale()) return true;
      // Of equal ones the first counts, so the best so far stands first.
      const pair = best ? [best.lesson, lesson] : [lesson];
      const why = attempt(() => parsed(world.nextLesson(pair.map(one => spaced(one.command)).join('\n'), all.join('\n'))));
      if (why === undefined) lessons.length = 0;
      else if (why) best = { lesson: pair[why.lesson], why };
      return false;
    });
  }
  return best;
}

/** @type {Lesson | null} */
let lesson = null;
// What the lesson that is sought depends on.
let sought = '';

export async function renderNext() {
  const hidden = state.mode !== 'play' || Boolean(state.session) || state.phase !== 'none' || state.sessions === 0;
  $('next-card').hidden = hidden;
  if (hidden || !isShown('challenges')) return;
  const key = JSON.stringify([state.robot.id, state.robot.changed, state.sessions, $('wanted').value, document.documentElement.lang]);
  if (key === sought) return;
  sought = key;
  // What stands there is the answer to what was asked before.
  $('next-card').ariaBusy = 'true';
  const isStale = () => key !== sought || Boolean(state.session) || state.phase !== 'none';
  // First the page is drawn.
  await nextFrame();
  const found = await next(isStale);
  if (isStale()) {
    if (key === sought) sought = '';
    return;
  }
  $('next-card').ariaBusy = 'false';
  const well = found?.why.known;
  lesson = found && !well ? found.lesson : null;
  $('next-lesson').hidden = $('teach-next').hidden = !lesson;
  $('next-lesson').textContent = lesson ? t('next.lesson', { command: unspaced(lesson.command) }) : '';
  const { word, needed, heard } = found?.why || { word: '', needed: 0, heard: 0 };
  $('next-why').textContent = !found ? t('next.none') : well ? t('next.well') : t(heard ? 'next.heard' : 'next.new', { word, needed, heard: sessionsWord(heard) });
}

export function setUpNext() {
  $('wanted').value = (shelf.get('wanted') || '').slice(0, $('wanted').maxLength);
  $('wanted').addEventListener('input', () => {
    shelf.put('wanted', $('wanted').value || null);
    renderNext();
  });
  $('teach-next').addEventListener('click', async () => {
    if (!lesson) return;
    const { command, home } = lesson;
    if (!await leaveSession()) return;
    if (home) enterHome(home);
    nameHome();
    $('command').value = command;
    if (!startSession(command)) render();
  });
}
