// The robot, in Node, in browsers and in bundlers alike: the module is a text, so nobody has to fetch it.
import { Goodbot, initSync } from './goodbot_wasm.js';
import module from './module.js';

initSync({ module: Uint8Array.from(atob(module), letter => letter.charCodeAt(0)) });

export { Goodbot };
