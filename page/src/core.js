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

/** What is packed into the page: the core's module, and after it the texts of the interface as JSON.
 * @param {Uint8Array} packed
 * @param {Record<string, string>} sizes */
export function readParts(packed, { module, texts }) {
  const whole = unpack(packed, Number(module) + Number(texts));
  return { module: whole.slice(0, Number(module)), languages: parsed(new TextDecoder().decode(whole.slice(Number(module)))) };
}

/** Starts the core. Throws where the browser cannot run it.
 * @param {Uint8Array} module */
export function startCore(module) {
  initSync({ module });
  world = new Goodbot(2014);
  course = parsed(Goodbot.course(0));
}
