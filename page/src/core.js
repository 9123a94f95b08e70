// The robot's core, in WebAssembly: one world with one robot, and the course.
import { Goodbot, initSync } from 'goodbot-wasm';

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
