// The worth of the trainer's feedback: a second robot hears the same lessons without any.
import { Goodbot, LEARN_BUDGET, parsed } from './core.js';
import { state } from './state.js';
import { inOwnWords } from './stops.js';
import { askedIn, sceneOf, taskWords } from './words.js';

/** @typedef {{ home: string, intended: string, test: boolean, command?: string }} Stop */

let [known, about] = [/** @type {[string, number, number][]} */ ([]), ''];

// The probability of the meant task.
const sureOf = (tasks, { intended }) => tasks.find(task => task.name === intended)?.probability ?? 0;

/** For each test its command, and how sure of its meaning this robot is, and one that had the same lessons in silence. No session may be under way.
 * @param {Stop[]} stops
 * @returns {[string, number, number][]} */
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
  known = stops.filter(({ test }) => test).map(stop => {
    const command = commandOf(stop);
    return [command, sureOf(askedIn(JSON.parse(stop.home), command), stop), sureOf(parsed(silent.asked(stop.home, command)).tasks, stop)];
  });
  silent.free();
  about = key;
  return known;
}
