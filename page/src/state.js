// The page's state, in one place, and small tools to make elements.
import { t } from './language.js';

/**
 * @typedef {import('goodbot-wasm').Scene} Scene
 * @typedef {import('goodbot-wasm').Task & { words: string }} Task
 * @typedef {{ tasks: Task[], trainer: import('goodbot-wasm').TrainerStyle }} Belief
 * @typedef {import('goodbot-wasm').Decided} Decided
 * @typedef {import('goodbot-wasm').Evidence} Evidence
 * @typedef {import('goodbot-wasm').Support} Support
 * @typedef {import('goodbot-wasm').Heat} Heat
 * @typedef {import('goodbot-wasm').Route} Route
 * @typedef {Task & { index: number }} Ranked
 */

/**
 * A session under way.
 * @typedef {object} Session
 * @property {string} command
 * @property {number | null} intended the task of a trainer who gives the feedback by itself
 * @property {boolean} looking a test: no feedback
 * @property {Ranked[]} heard what it believed at first
 * @property {Decided | null} decided
 * @property {string | null} feedback
 * @property {boolean} given whether the trainer has said a word on the last action
 * @property {number} rests
 * @property {number} steps
 * @property {number} delay
 * @property {number} since
 * @property {number} began
 * @property {{ at_ms?: number, said_ms?: number }[]} times of its steps and answers, in milliseconds since it began
 * @property {boolean} paused
 * @property {boolean} stepping
 * @property {(() => void) | null} wake
 * @property {number} soon
 * @property {number} said when the word on the last step was said
 * @property {any[] | undefined} recorded what is still to come of a session that is shown: records of a log
 * @property {string[]} heardNew the words that were new to the robot
 * @property {import('goodbot-wasm').Question | null} question what the robot asks, and waits for
 * @property {number} asked when it asked
 * @property {number} answers how many answers it was given
 * @property {string} picked the meaning that the trainer has just picked
 * @property {boolean} affirmed whether the trainer has said that this was it
 * @property {Ranked | null} took what it takes the command for in the end
 * @property {boolean} undone whether its last step was taken back, and the next is still to come
 * @property {boolean} over
 * @property {(() => void) | null} onEnd what comes after it
 * @property {(() => void) | null} onLearn what comes before it is learned from
 */

export const state = {
  // tour, play or build
  mode: 'tour',
  scene: /** @type {Scene} */ (/** @type {unknown} */ (null)),
  belief: /** @type {Belief} */ (/** @type {unknown} */ ({ tasks: [] })),
  support: /** @type {Support | null} */ (null),
  heat: { now: /** @type {Heat | null} */ (null), before: /** @type {Heat | null} */ (null) },
  // none, planning, asking, waiting, paused or learning
  phase: 'none',
  session: /** @type {Session | null} */ (null),
  route: /** @type {Route | null} */ (null),
  evidence: /** @type {Evidence[]} */ ([]),
  // The robot of this tab, as it is kept.
  robot: /** @type {import('./store.js').Robot} */ (/** @type {unknown} */ (null)),
  // One's own robot, while another is shown.
  mine: /** @type {import('./store.js').Robot | null} */ (null),
  // Whether the robot that is shown came with a link.
  visitor: false,
  // The command of the session that came with it, to be shown.
  shown: '',
  // The game of a secret language: `open` while it is played, `told` when it is over.
  secret: '',
  // The tab of the panel that is shown.
  tab: /** @type {import('./tabs.js').Tab} */ ('thoughts'),
  // What the robot says while nothing is asked of it.
  said: /** @type {string[] | null} */ (null),
  // The command that the robot takes for done already.
  already: '',
  // What came of the lesson or test before, until the next begins.
  verdict: '',
  // Whether that lesson has taught another meaning than the tour's.
  astray: false,
  // What is being learned from, where that takes a while.
  progress: '',
  sessions: 0,
  tour: { at: 0, done: /** @type {string[]} */ ([]), said: /** @type {Record<string, string>} */ ({}), watching: false },
  // Whether the trainer thinks that the next test will be understood: yes, no, or nothing yet.
  guess: '',
  settings: /** @type {Record<string, any>} */ ({
    speed: 'normal', rule: 'linear', style: 'population', questions: true, voice: false, presenter: false, shortcuts: true, ghost: true, names: true, theme: 'auto', language: 'auto', pull: false, seed: 2014,
  }),
};

/** @type {(id: string) => any} */
export const $ = id => document.getElementById(id);
/** @type {(selector: string) => Iterable<any>} */
export const all = selector => document.querySelectorAll(selector);

export function make(tag, attributes, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

export function draw(tag, attributes, ...children) {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.flat().filter(child => child !== null && child !== undefined));
  return element;
}

export const percent = p => t('percent', { n: p > 0 && p < 0.005 ? '< 1' : p < 1 && p > 0.995 ? '> 99' : Math.round(p * 100) });

// Tells those who listen, and shows it for a moment to those who look.
let toastTimer = 0;
export function tell(text, wrong = false) {
  announce(text);
  const toast = $('toast');
  toast.textContent = text;
  toast.className = wrong ? 'wrong' : '';
  toast.hidden = false;
  clearTimeout(toastTimer);
  toastTimer = setTimeout(() => { toast.hidden = true; }, wrong ? 9000 : 4500);
}

export function announce(text) {
  $('live').textContent = text;
}

// Runs what the core may refuse; the refusal is told, and the answer is then undefined.
export function attempt(action) {
  try {
    return action();
  } catch (error) {
    // The core names the limit by its name in Rust.
    tell(/::(WORDS_PER_COMMAND|NAME_BYTES) /.test(error.message) ? t('talk.tooLong') : error.message, true);
    return undefined;
  }
}

// Long work in parts, `part` until it gives something, with a frame now and then so that the page never stands still.
export async function inParts(part) {
  let started = performance.now();
  for (;;) {
    const done = part();
    if (done) return done;
    if (performance.now() - started > 12) {
      await nextFrame();
      started = performance.now();
    }
  }
}

export const nextFrame = () => /** @type {Promise<void>} */ (new Promise(done => {
  // A hidden page gets no frames, but should go on.
  const timer = setTimeout(done, 60);
  requestAnimationFrame(() => { clearTimeout(timer); done(); });
}));
