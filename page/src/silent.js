// The worth of the trainer's feedback: a second robot hears the same lessons without any.
import { Goodbot, LEARN_BUDGET, course, parsed } from './core.js';
import { state } from './state.js';
import { inOwnWords } from './stops.js';
import { askedIn, sceneOf, taskWords } from './words.js';

/** @typedef {{ home: string, intended: string, test: boolean, command?: string }} Stop */
/** @typedef {{ command: string, test: boolean, sure: number, silent: number }} Sureness how sure of a command's meaning this robot is, and one that had the same lessons in silence */

let [known, about] = [/** @type {Sureness[]} */ ([]), ''];

// The probability of the meant task.
const sureOf = (tasks, { intended }) => tasks.find(task => task.name === intended)?.probability ?? 0;

/** The tests and the other commands that a tour's tests could have. No session may be under way.
 * @param {Stop[]} stops
 * @returns {Sureness[]} */
export function sureness(stops) {
  const key = [state.robot.model, document.documentElement.lang].join();
  if (about === key) return known;
  const commandOf = stop => stop.command ?? inOwnWords(taskWords(stop.intended, sceneOf(JSON.parse(stop.home))));
  const silent = new Goodbot(state.settings.seed);
  for (const stop of stops.filter(({ test }) => !test)) {
    silent.setEnvironment(stop.home);
    silent.hear(commandOf(stop));
    silent.finish();
    while (!silent.learn(LEARN_BUDGET));
  }
  const tests = stops.filter(({ test }) => test);
  const others = state.tour.own ? stops : course.teachable.filter(({ home }) => home === 'Test').map(({ intended }) => ({ home: tests[0].home, intended, test: false }));
  const all = new Map();
  for (const stop of [...tests, ...others]) {
    const command = commandOf(stop);
    if (!all.has(command)) all.set(command, { command, test: stop.test, sure: sureOf(askedIn(JSON.parse(stop.home), command), stop), silent: sureOf(parsed(silent.asked(stop.home, command)).tasks, stop) });
  }
  known = [...all.values()];
  silent.free();
  about = key;
  return known;
}
