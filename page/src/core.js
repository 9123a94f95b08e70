// The robot's core, in WebAssembly: one world with one robot, and the course.
import { Goodbot, initSync } from 'goodbot-wasm';
import { t } from './language.js';
import { inParts, render, state, tell } from './state.js';

export const PLAN_BUDGET = 20000;
export const LEARN_BUDGET = 60000;

/** @type {Goodbot} */
export let world;
/** @type {import('goodbot-wasm').Course} */
export let course;

export { Goodbot };

/** @type {(text: string) => any} */
export const parsed = text => JSON.parse(text);

/** Starts the core. Throws if the browser cannot run it.
 * @param {Uint8Array} module */
export function startCore(module) {
  initSync({ module });
  world = new Goodbot(2014);
  course = parsed(Goodbot.course(0));
}

// Runs a call that the core may refuse; a refusal is told, and the result is then undefined.
export function attempt(action) {
  try {
    return action();
  } catch (error) {
    // The core says it in English, and names the limit by its name in Rust.
    tell(/::(WORDS_PER_COMMAND|NAME_BYTES) /.test(error.message) ? t('talk.tooLong') : /has no word/.test(error.message) ? t('talk.nothing') : error.message, true);
    return undefined;
  }
}

/** Has a robot learn its training data, a part at a time. */
export const learn = (robot = world) => inParts(() => robot.learn(LEARN_BUDGET));

/** Does work in which the robot learns. The page says so, and takes no command meanwhile.
 * @template T
 * @param {() => Promise<T>} work
 * @returns {Promise<T>} */
export async function whileLearning(work) {
  const before = state.phase;
  // The work that began to learn also ends it, even if this work takes longer: the page never stays in that phase.
  if (before === 'learning') return work();
  state.phase = 'learning';
  render();
  try {
    return await work();
  } finally {
    state.phase = before;
  }
}

export const heatNow = () => parsed(world.heat());
