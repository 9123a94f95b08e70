import type { Goodbot } from './goodbot_wasm.js';

/**
 * `<goodbot-trainer>`, the trainer page in any site. `src` is the address of `goodbot.html`, on the same site; without it, the file beside this
 * module. `language` is one of `en`, `de`, `es`, `fr` and `zh`; without it, the page chooses as in a window of its own.
 */
export class GoodbotTrainer extends HTMLElement {
  /** The robot in the page; undefined until the event `goodbot-ready`. */
  readonly robot: Goodbot | undefined;
  /** Its model, as bytes for `Goodbot.restore`, a file, or another shell. */
  readonly model: Uint8Array | undefined;
}

/** What the robot believes of the command under way. */
export interface BeliefEvent {
  tasks: { name: string; probability: number }[];
}

declare global {
  interface HTMLElementTagNameMap {
    'goodbot-trainer': GoodbotTrainer;
  }
  interface HTMLElementEventMap {
    /** The page is ready. */
    'goodbot-ready': CustomEvent<{ sessions: number }>;
    /** A session was learned from or taken back, or another robot came. `log` has the events of the latest session, a line of JSON for each. */
    'goodbot-session': CustomEvent<{ sessions: number; log: string }>;
    'goodbot-belief': CustomEvent<BeliefEvent>;
    /** The page cannot be followed. */
    'goodbot-error': CustomEvent<{ reason: string }>;
  }
}
