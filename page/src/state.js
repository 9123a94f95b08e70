// The page's state, in one place, and small tools to make elements.

/**
 * @typedef {import('goodbot-wasm').Scene} Scene
 * @typedef {import('goodbot-wasm').Task & { words: string }} Task
 * @typedef {{ tasks: Task[], trainer: import('goodbot-wasm').TrainerStyle }} Belief
 * @typedef {import('goodbot-wasm').Decided} Decided
 * @typedef {import('goodbot-wasm').Evidence} Evidence
 * @typedef {import('goodbot-wasm').Support} Support
 * @typedef {import('goodbot-wasm').Heat} Heat
 * @typedef {Task & { index: number }} Ranked
 */

/**
 * A session under way.
 * @typedef {object} Session
 * @property {string} command
 * @property {number | null} intended the task of a simulated trainer
 * @property {boolean} looking a test: no feedback
 * @property {Ranked[]} heard the belief at first
 * @property {Decided | null} decided the last step; null before the first, and where the last one was taken back
 * @property {Decided | null} committed the last step whose feedback was taken in
 * @property {string | null} feedback
 * @property {number} rests
 * @property {number} steps
 * @property {number} delay
 * @property {number} since
 * @property {number} began
 * @property {{ at_ms?: number, said_ms?: number }[]} times of its steps and answers, in milliseconds since it began
 * @property {'going' | 'paused' | 'step' | 'over'} pace whether it goes on when its time is over, when it is told to, or with one step until it is paused again
 * @property {(() => void) | null} wake
 * @property {number} soon
 * @property {number} said when the trainer has given feedback to the last step, or 0
 * @property {any[] | undefined} recorded the remaining records of a session from a log that is shown
 * @property {string[]} heardNew the words that were new to the robot
 * @property {import('goodbot-wasm').Question | null} question the open question
 * @property {number} asked when it asked
 * @property {number} answers how many answers it was given
 * @property {string} picked the meaning that the trainer has just picked
 * @property {boolean} affirmed whether the trainer has said that this was it
 * @property {Ranked | null} took the most likely task in the end
 * @property {(() => void) | null} onHeard called when the robot has decided what the command means
 * @property {(() => import('./store.js').Tour) | undefined} tourAfter the tour's progress when it has ended, kept together with what it taught
 * @property {(() => void) | null} onEnd called after its end
 */

export const state = {
  // tour, play or build
  mode: 'tour',
  scene: /** @type {Scene} */ (/** @type {unknown} */ (null)),
  belief: /** @type {Belief} */ (/** @type {unknown} */ ({ tasks: [] })),
  support: /** @type {Support | null} */ (null),
  heat: { now: /** @type {Heat | null} */ (null), before: /** @type {Heat | null} */ (null) },
  // none, planning, asking, waiting, learning or moment: a success is shown
  phase: 'none',
  session: /** @type {Session | null} */ (null),
  evidence: /** @type {Evidence[]} */ ([]),
  // The robot of this tab, as it is kept.
  robot: /** @type {import('./store.js').Robot} */ (/** @type {unknown} */ (null)),
  // The user's own robot, while another is shown.
  mine: /** @type {import('./store.js').Robot | null} */ (null),
  // Whether the robot that is shown came with a link.
  visitor: false,
  // The command of the session that came with it, to be shown.
  shown: '',
  // The game of a secret language: `open` while it is played, `told` when it is over.
  secret: '',
  // The tab of the panel that is shown.
  tab: /** @type {import('./tabs.js').Tab} */ ('thoughts'),
  // What the robot says between two sessions.
  said: /** @type {string[] | null} */ (null),
  // The command that the robot did not begin, such as one for a done task; the user may insist on it.
  already: '',
  // The verdict on the last lesson or test, until the next begins.
  verdict: '',
  // Whether it is bad news.
  failed: false,
  // Whether that lesson has taught another meaning than the tour's.
  astray: false,
  // The progress of long learning, as a text.
  progress: '',
  sessions: 0,
  // `own` is the language that the visitor invents; without one it is the paper's tour.
  tour: { at: 0, done: /** @type {string[]} */ ([]), said: /** @type {Record<string, string>} */ ({}), own: /** @type {import('./invention.js').Invention | null} */ (null), watching: false },
  // Whether the trainer thinks that the next test will be understood: yes, no, or nothing yet.
  guess: '',
  settings: /** @type {Record<string, any>} */ ({
    speed: 'normal', rule: 'linear', style: 'population', questions: true, voice: false, sound: false, speech: true, presenter: false, shortcuts: true, ghost: true, names: true, theme: 'auto', language: 'auto', pull: false, seed: 2014,
    // The tabs that are not shown, with spaces between them.
    hidden: '',
  }),
};

/** Draws the page anew. Whatever changes the state calls it, and the views are drawn from the state alone. */
export let render = () => {};
/** @param {() => void} views draws all views */
export const drawBy = views => { render = views; };

/** @type {Record<string, string>} */
const drawn = {};
/** Whether a part of the page was last drawn from the same values, in the same language.
 * @param {string} part */
export function isDrawn(part, ...values) {
  const before = drawn[part];
  drawn[part] = JSON.stringify([values, document.documentElement.lang]);
  return drawn[part] === before;
}

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

// Tells screen readers a text, and shows it for a moment.
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

// Does long work in parts: calls `part` until it returns something, with a frame now and then so that the page never freezes.
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

/** Lets the page draw and take what is pressed meanwhile, if it has to; in a hidden page too, and without the wait for a frame. */
export const nextTask = () => new Promise(done => {
  const { port1, port2 } = new MessageChannel();
  port1.onmessage = done;
  port2.postMessage(0);
});
