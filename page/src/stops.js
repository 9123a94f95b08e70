// The stops of the guided tour: the paper's seven lessons and five tests, and an appendix; and the homes that the robot enters.
import { attempt, course, world } from './core.js';
import { stopsOf } from './invention.js';
import { refresh, stopSession } from './session.js';
import * as shelf from './shelf.js';
import { $, render, state } from './state.js';
import { keepTour } from './store.js';
import { APPENDIX } from './storeys.js';
import { taskWords } from './words.js';

/** @type {Map<string, string>} */
const homes = new Map();
/** @param {string} name */
export function homeNamed(name) {
  if (!homes.size) for (const [other, home] of course.homes) homes.set(other, JSON.stringify(home));
  return homes.get(name) || '';
}
const ofCourse = (stop, test) => ({ home: homeNamed(stop.home), intended: stop.intended, test, appendix: false });
// The appendix is for robots to which commands may say how.
const stopsOfCourse = () => [
  ...course.lessons.map(stop => ofCourse(stop, false)), ...course.tests.map(stop => ofCourse(stop, true)),
  ...(world.ways() ? APPENDIX.map(stop => ({ ...stop, home: JSON.stringify(stop.home), appendix: true })) : []),
];
export const lengthOfCourse = () => count(false) + count(true);

export const stopAt = () => stops()[state.tour.at];
/** The tour's lessons and tests: those of the visitor's own language, or the paper's. */
export const stops = () => (state.tour.own ? stopsOf(state.tour.own) : stopsOfCourse());
/** How many of them there are, without the appendix. */
export const count = test => stops().filter(stop => stop.test === test && !stop.appendix).length;

// The course's commands are the current language's words for their tasks; the home must be that of the lesson or test.
export const commandOf = stop => stop.command ?? taskWords(stop.intended);

/** A command of the tour in the user's own words, if there are any.
 * @param {string} command */
export const inOwnWords = command => state.tour.said[command] || command;

/** How many of the tour's tests the robot has understood. */
export const rightTests = () => stops().filter((stop, at) => stop.test && !stop.appendix && state.tour.done[at] === 'right').length;

/** Whether the tour has come to its end, and nothing else is going on. */
export const isOver = () => state.mode === 'tour' && !state.session && !stopAt();

/** Whether it came to a good end: there is nothing to celebrate where most tests failed. */
export const isMerry = () => isOver() && 2 * rightTests() > count(true);

export function enterStop(at) {
  stopSession();
  [state.said, state.verdict, state.astray, state.guess] = [null, '', false, ''];
  $('own-words').value = '';
  state.tour.at = Math.max(0, Math.min(at, stops().length));
  const stop = stopAt();
  // After the last test all stays where it is.
  const home = (stop ?? stops().filter(one => !one.appendix).at(-1))?.home;
  if (stop || world.environment() !== home) enterHome(home);
  else refresh();
  keepTour();
  $('command').value = stop ? commandOf(stop) : '';
  render();
}

export function enterHome(json) {
  stopSession();
  // In the tour the robot pushes only, as the paper's does.
  if (attempt(() => (world.setEnvironment(json), world.setPulls(state.settings.pull && state.mode !== 'tour'), true)) !== true) return false;
  refresh();
  state.evidence = [];
  state.support = null;
  [state.said, state.already] = [null, ''];
  if (state.mode !== 'tour') shelf.put('home', json);
  return true;
}
