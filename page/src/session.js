// The session under way: it is kept after each step, it waits and is woken, and it is stopped.
import { attempt, heatNow, parsed, world } from './core.js';
import { underWay } from './shelf.js';
import { state } from './state.js';
import { beliefNow } from './words.js';

export function refresh() {
  state.scene = parsed(world.scene());
  state.belief = beliefNow();
}

/** Takes stock of the robot: what it has learned, and what it believes now.
 * @param {import('./state.js').Heat | null} before */
export function takeStock(before = null) {
  state.heat = { now: heatNow(), before };
  refresh();
}

/** @param {string} command
 * @param {{ intended?: string | null, looking?: boolean, recorded?: any[] }} how
 * @returns {import('./state.js').Session} */
export function newSession(command, { intended = null, looking = false, recorded = undefined }) {
  const task = state.belief.tasks.findIndex(task => task.name === intended);
  return {
    command, intended: task < 0 ? null : task, looking, recorded, heard: [], decided: null, feedback: null, rests: 0, steps: 0, delay: 0, since: 0,
    committed: null, began: performance.now(), times: [], pace: 'going', wake: null, soon: 0, said: 0, heardNew: [], question: null, asked: 0, answers: 0, picked: '', affirmed: false, took: null, onHeard: null, tourAfter: undefined, onEnd: null,
  };
}

/** Whether the trainer has given feedback or answers in this session that would be lost with it. */
export const hasWords = session => !session.looking && session.intended === null && (session.said || session.answers > 0 || state.evidence.some(evidence => evidence.feedback !== 'neutral'));

/** Whether the robot rests at the goal of the task that it follows. */
export function isThere() {
  const decided = state.session?.decided;
  return Boolean(decided && !state.session?.question && decided.action === 'noop' && decided.plans[decided.task] === 'goal');
}

// Milliseconds since the session began.
const sinceBeginning = (session, moment) => Math.round(moment - session.began);

/** The robot has taken in an answer. */
export function noteAnswer(session) {
  session.answers += 1;
  session.times.push({ said_ms: sinceBeginning(session, performance.now()) });
  state.belief = beliefNow();
  keepSession(session);
}

// The times of the last action and of the feedback to it.
export const timeOfStep = session => ({ at_ms: sinceBeginning(session, session.since), said_ms: session.said ? sinceBeginning(session, session.said) : undefined });

// The session as lines of a log, with the times of its steps and answers.
export function logNow({ times }) {
  let at = 0;
  return world.log().replace(/^{"type":"(?:step|answer)".*/gm, line => {
    at += 1;
    return JSON.stringify({ ...JSON.parse(line), ...times[at - 1] });
  });
}

// Keeps the session after each step, for a reload of this tab.
export function keepSession(session) {
  if (session.looking || session.intended !== null || state.robot.log !== undefined) return;
  const steps = attempt(() => logNow(session).trimEnd().split('\n').slice(0, -1)) || [];
  if (session.said && session.decided) steps.push(JSON.stringify({ type: 'step', action: session.decided.action, feedback: session.feedback, ...timeOfStep(session) }));
  underWay.put(JSON.stringify({ robot: state.robot.id, mode: state.mode, at: state.mode === 'tour' ? state.tour.at : null, home: world.environment(), steps }));
}

// Ends the session under way without learning.
export function stopSession() {
  const session = state.session;
  if (session) {
    session.pace = 'over';
    wake(session);
  }
  state.session = null;
  if (state.phase !== 'learning') state.phase = 'none';
  world.forget();
  if (session) underWay.put(null);
}

export function wake(session) {
  const { wake: resolve } = session;
  session.wake = null;
  if (resolve) resolve();
}

/** Lets the robot go on; if it is paused, for one step. */
export function goOn(session) {
  if (session.pace === 'paused') session.pace = 'step';
  wake(session);
}

// Waits this many milliseconds, or until the session is woken.
export function pause(session, milliseconds) {
  return new Promise(resolve => {
    session.wake = resolve;
    if (milliseconds < Infinity) setTimeout(() => { if (session.wake === resolve) wake(session); }, milliseconds);
  });
}
