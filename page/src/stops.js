// The stops of the guided tour: the paper's seven lessons and five tests, and an appendix; and the homes that the robot enters.
import { attempt, course, world } from './core.js';
import { refresh, stopSession } from './session.js';
import * as shelf from './shelf.js';
import { $, render, state } from './state.js';
import { keepTour } from './store.js';
import { APPENDIX } from './storeys.js';
import { taskWords } from './words.js';

// The course's commands are the current language's words for their tasks.
export const homeNamed = name => JSON.stringify(course.homes.find(([other]) => other === name)?.[1]);
const ofCourse = (stop, test) => ({ home: homeNamed(stop.home), intended: stop.intended, test, appendix: false });
// The appendix is for robots to which commands may say how.
export const stops = () => [
  ...course.lessons.map(stop => ofCourse(stop, false)), ...course.tests.map(stop => ofCourse(stop, true)),
  ...(world.ways() ? APPENDIX.map(stop => ({ ...stop, home: JSON.stringify(stop.home), appendix: true })) : []),
];
export const lengthOfCourse = () => course.lessons.length + course.tests.length;

export const stopAt = () => stops()[state.tour.at];
// The home must be that of the lesson or test.
export const commandOf = stop => taskWords(stop.intended);

/** A command of the tour in the user's own words, if there are any.
 * @param {string} command */
export const inOwnWords = command => state.tour.said[command] || command;

/** How many of the tour's tests the robot has understood. */
export const rightTests = () => course.tests.filter((_, at) => state.tour.done[course.lessons.length + at] === 'right').length;

/** Whether the tour has come to its end, and nothing else is going on. */
export const isOver = () => state.mode === 'tour' && !state.session && !stopAt();

/** Whether it came to a good end: there is nothing to celebrate where most tests failed. */
export const isMerry = () => isOver() && 2 * rightTests() > course.tests.length;

export function enterStop(at) {
  stopSession();
  [state.said, state.verdict, state.astray, state.guess] = [null, '', false, ''];
  $('own-words').value = '';
  state.tour.at = Math.max(0, Math.min(at, stops().length));
  const stop = stopAt();
  // After the last test the robot stays where the tests were.
  enterHome(stop ? stop.home : homeNamed('Test'));
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
