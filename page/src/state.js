// The page's state, in one place, and small tools to make elements.
const KEYS = { model: 'goodbot.model', log: 'goodbot.log', settings: 'goodbot.settings', home: 'goodbot.home', own: 'goodbot.own', tour: 'goodbot.tour', undo: 'goodbot.undo' };

const state = {
  // tour, play or build
  mode: 'tour',
  scene: null,
  belief: { tasks: [], strategies: [] },
  support: null,
  heat: { now: null, before: null },
  // none, planning, waiting, paused or learning
  phase: 'none',
  session: null,
  route: null,
  evidence: [],
  // The model, the log and the tour before the last session.
  undo: null,
  // What is being learned from, where that takes a while.
  progress: '',
  sessions: 0,
  saved: true,
  tour: { at: 0, done: [], watching: false },
  settings: {
    speed: 'normal', rule: 'linear', style: false, shortcuts: true, ghost: true, names: true, theme: 'auto', pull: false,
  },
};

// The robot's world: the core, in WebAssembly. Set in main.js.
let world = null;

const $ = id => document.getElementById(id);

function make(tag, attributes, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

function draw(tag, attributes, ...children) {
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

const percent = p => (p > 0 && p < 0.005 ? '< 1' : p < 1 && p > 0.995 ? '> 99' : Math.round(p * 100)) + '\u00a0%';

// Tells those who listen, and shows it for a moment to those who look.
let toastTimer = 0;
function tell(text, wrong = false) {
  announce(text);
  const toast = $('toast');
  toast.textContent = text;
  toast.className = wrong ? 'wrong' : '';
  toast.hidden = false;
  clearTimeout(toastTimer);
  toastTimer = setTimeout(() => { toast.hidden = true; }, wrong ? 9000 : 4500);
}

function announce(text) {
  $('live').textContent = text;
}

// Runs what the core may refuse; the refusal is told, and the answer is then undefined.
function attempt(action) {
  try {
    return action();
  } catch (error) {
    tell(error.message, true);
    return undefined;
  }
}

// Long work in parts, `part` until it gives something, with a frame now and then so that the page never stands still.
async function inParts(part) {
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

const nextFrame = () => new Promise(done => {
  // A hidden page gets no frames, but should go on.
  const timer = setTimeout(done, 60);
  requestAnimationFrame(() => { clearTimeout(timer); done(); });
});
