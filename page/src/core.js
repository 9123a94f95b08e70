// The robot's core, in WebAssembly: one world with one robot, and the course.
import { Goodbot, initSync } from 'goodbot-wasm';
import { unpack } from './unpack.js';

/** @type {Goodbot} */
export let world;
/** @type {import('goodbot-wasm').Course} */
export let course;

export { Goodbot };

/** @type {(text: string) => any} */
export const parsed = text => JSON.parse(text);

/** Starts the core from its packed bytes. Throws where the browser cannot run it.
 * @param {Uint8Array} packed
 * @param {number} size */
export function startCore(packed, size) {
  initSync({ module: unpack(packed, size) });
  world = new Goodbot(2014);
  course = parsed(Goodbot.course(0));
}
