// Training by sessions: the robot hears, acts and takes feedback, until the trainer ends the session. The core plans and learns in parts,
// between frames.
import { askTrainer } from './asking.js';
import { speech } from './bubble.js';
import { PLAN_BUDGET, attempt, heatNow, learn, parsed, world } from './core.js';
import { ask } from './dialog.js';
import { percent, t } from './language.js';
import { knowsWords, lessonLearned, unknownWords } from './learned.js';
import { answerRecorded, beginAnew, learnFrom } from './logs.js';
import { goOn, hasWords, isThere, keepSession, logNow, newSession, noteAnswer, pause, refresh, stopSession, timeOfStep, wake } from './session.js';
import { SPEEDS } from './settings.js';
import { put, underWay } from './shelf.js';
import { sound } from './sound.js';
import { $, announce, inParts, nextFrame, nextTask, render, state, tell } from './state.js';
import { enterStop, stopAt } from './stops.js';
import { change, enterMode } from './store.js';
import { acted, beliefNow, quoted, ranked, spaced, taskWords, unspaced } from './words.js';

const RESTS = 3;
// The whole tour is watched in less than a minute.
const WATCH_DELAY = 260;
// The first lessons are short: three of them in less than a minute.
const OWN_DELAY = 1000;
// The verdict of a test is known at once; its way is only shown.
const TEST_DELAY = 500;
const MOST_STEPS = 300;

// The last command that the robot was told.
export let lastCommand = '';

/** Tells the robot a command. If there is nothing to do, it says why, and waits.
 * @param {string} words
 * @param {boolean} insists whether it is a command, whatever the robot takes it for */
export function tellRobot(words, insists = false) {
  stopSession();
  lastCommand = words;
  state.already = '';
  const heard = attempt(() => parsed(world.listen(words, insists)));
  if (heard) follow(heard, words);
  else render();
}

/** After a session: goes on with the rest of the utterance. Returns whether there was one. */
function tellRest() {
  const heard = world.isMore() ? attempt(() => parsed(world.listenOn())) : null;
  if (heard) follow(heard, '');
  return Boolean(heard);
}

/** @param {import('goodbot-wasm').Reaction} heard */
function follow(heard, words) {
  if (heard.begun) begin(heard.command, {});
  else if (heard.negated) remark(t('talk.not'), '');
  else if (heard.verdict === 'done') remark(t('say.done', { task: taskWords(heard.task) }), words);
  else remark(t(heard.verdict === 'none' ? 'talk.none' : 'talk.unsure'), words);
}

// The robot says something between sessions. `words` may still be a command. In a session the text is a short message instead, because
// the robot's bubble says what it does.
export function remark(text, words) {
  if (state.session) {
    $('command').value = '';
    tell(text);
    return;
  }
  state.said = [text, ''];
  state.already = words;
  announce(text);
  render();
  if (words) $('else').focus();
}

// Begins a session. `intended` is the name of a task for a trainer who gives the feedback by itself; `looking` walks without feedback.
/** @param {string} command
 * @param {{ intended?: string | null, looking?: boolean, picked?: string }} how `picked` is the meaning that the trainer gives at once */
export function startSession(command, { intended = null, looking = false, picked = '' } = {}) {
  stopSession();
  command = spaced(command);
  if (attempt(() => (world.hear(command), true)) !== true) {
    render();
    return null;
  }
  return begin(command, { intended, looking, picked });
}

/** Goes on with a session that the robot has begun.
 * @param {string} command
 * @param {{ intended?: string | null, looking?: boolean, picked?: string, recorded?: any[] }} how */
function begin(command, { intended = null, looking = false, picked = '', recorded = undefined }) {
  refresh();
  state.support = attempt(() => parsed(world.support()));
  state.evidence = [];
  $('command').value = '';
  const session = newSession(command, { intended, looking, recorded });
  session.heard = ranked();
  session.picked = picked;
  state.session = session;
  [state.said, state.verdict, state.already, state.astray] = [null, '', '', false];
  session.heardNew = knowsWords() ? unknownWords() : [...new Set(state.support?.words)];
  keepSession(session);
  go(session);
  if (!state.tour.watching && state.settings.speed !== 'once') {
    // On a small screen the plan and the buttons matter now; with a keyboard, the focus does.
    window.scrollTo({ top: 0 });
    $(looking && state.mode === 'tour' ? 'lesson' : 'good').focus({ preventScroll: true });
  }
  return session;
}

/** Shows a session from a link, step by step: the same actions and the same feedback. The robot learns nothing from that.
 * @param {any[] | undefined} records */
export function showSession(records) {
  if (!records || attempt(() => (beginAnew(records[0]), true)) !== true) return;
  const session = begin(records[0].command, { looking: true, recorded: records.slice(1) });
  session.onEnd = () => {
    const [{ words, probability }] = ranked();
    state.said = [t('told.heard', { command: unspaced(session.command), task: words, sure: percent(probability) }), ''];
    render();
  };
}

/** Whether the session under way may be left: asks, if the trainer has said something in it. */
export async function leaveSession() {
  const { session } = state;
  // The moment of a success ends, and the tour goes on.
  if (state.phase === 'moment') state.mode === 'tour' ? enterStop(state.tour.at) : stopSession();
  if (state.phase === 'learning') {
    tell(t('judge.learning'));
    return false;
  }
  if (!session) return true;
  if (!hasWords(session)) {
    stopSession();
    return true;
  }
  if (session.pace !== 'paused' && !session.question) togglePause();
  const answer = await ask(t('leave.ask', { command: unspaced(session.command) }), { learn: t('leave.learn'), drop: t('leave.drop'), stay: t('leave.stay') });
  if (answer === 'learn') await finishSession();
  else if (answer === 'drop') stopSession();
  return answer !== 'stay';
}

/** Resumes the session that was under way when this tab was reloaded, or another one closed. Returns whether there was one.
 * @param {(session: import('./state.js').Session) => void} attend lets the tour go on when it ends */
export async function takeUpSession(attend) {
  /** @type {import('./state.js').Session} */
  let session;
  const { value, closed } = await underWay.get();
  try {
    const kept = JSON.parse(value || 'null');
    if (!kept || kept.robot !== state.robot.id) return false;
    // A session without steps is not resumed from a tab that was closed.
    if (closed && kept.steps.length < 2) return false;
    const [first, ...steps] = kept.steps.map(parsed);
    await enterMode(kept.mode);
    if (kept.at !== null && kept.at !== state.tour.at) return false;
    beginAnew(first);
    session = newSession(first.command, {});
    refresh();
    session.heard = ranked();
    state.support = parsed(world.support());
    for (const step of steps) {
      const { at_ms, said_ms } = step;
      session.times.push({ at_ms, said_ms });
      session.began = performance.now() - (said_ms ?? at_ms ?? 0);
      if (step.type === 'answer') {
        answerRecorded(step);
        session.answers += 1;
        continue;
      }
      await inParts(() => world.plan(PLAN_BUDGET));
      world.drawFrom(state.settings.seed, session.steps);
      world.act(step.action);
      state.evidence.push(parsed(world.judge(step.feedback)));
      session.steps += 1;
    }
  } catch {
    // It is damaged, and is told as such.
    put('unread.session', value);
    underWay.put(null);
    stopSession();
    return false;
  }
  refresh();
  keepSession(session);
  session.pace = 'paused';
  state.session = session;
  if (state.mode === 'tour') attend(session);
  go(session);
  tell(t('session.goesOn'));
  return true;
}

async function go(session) {
  const { recorded } = session;
  // A robot of many lessons has taken long to hear the command. In the tour what stood there before is gone at once.
  if (state.mode === 'play') await nextTask();
  while (session.pace !== 'over') {
    takePick(session);
    while (recorded?.[0]?.type === 'answer') {
      attempt(() => answerRecorded(recorded.shift()));
      state.belief = beliefNow();
    }
    state.phase = 'planning';
    const slow = setTimeout(render, 40);
    await inParts(() => session.pace === 'over' || attempt(() => world.plan(PLAN_BUDGET)) !== false);
    clearTimeout(slow);
    if (session.pace === 'over') return undefined;
    const answered = await askTrainer(session);
    if (session.pace === 'over') return undefined;
    if (answered) continue;
    world.drawFrom(state.settings.seed, session.steps);
    const step = recorded?.shift();
    if (recorded && !step) return endWalk();
    const decided = attempt(() => parsed(world.act(step?.action)));
    if (!decided) return stopSession(), render();
    session.decided = decided;
    if (!session.steps && !session.answers) heardAs(session);
    session.feedback = null;
    session.said = 0;
    refresh();
    state.phase = 'waiting';
    session.since = performance.now();
    const auto = session.intended !== null || session.looking;
    const delay = waitOf(session, auto);
    session.delay = delay;
    render();
    if (delay > 300) announce(t('told.did', { did: acted(decided.action), speech: speech().join(' ') }));
    if (step || (session.intended !== null && !session.looking)) {
      if (delay > 0) await pause(session, delay * 0.55);
      if (session.pace === 'over') return undefined;
      if (step) session.feedback = step.feedback;
      else if (!session.said) session.feedback = world.simulatedFeedback(session.intended);
      render();
      if (delay > 0 && step?.feedback !== 'neutral') await pause(session, delay * 0.45);
      else if (session.steps % 8 === 0) await nextFrame();
    } else {
      if (delay > 0) await pause(session, delay);
      else await nextFrame();
    }
    if (session.pace === 'over') return undefined;
    while (session.pace === 'paused') {
      render();
      await pause(session, Infinity);
    }
    if (session.pace === 'over') return undefined;
    if (session.pace === 'step') session.pace = 'paused';
    // The step was taken back.
    if (!session.decided) continue;
    commit(session);
    if (await ended(session)) return undefined;
  }
  return undefined;
}

// What the robot understood is told when it has decided: among equally likely tasks, only then it is known which one it follows.
function heardAs(session) {
  session.heard = ranked();
  const [best] = session.heard;
  if (state.secret !== 'open') announce(t('told.heard', { command: session.command, task: best.words, sure: percent(best.probability) }));
  session.onHeard?.();
}

// The probability that a meaning is picked by mistake.
const PICKED_WRONG = 0.05;

// The trainer has picked a meaning: between two steps, as in a log, that is an answer.
function takePick(session) {
  const { picked } = session;
  session.picked = '';
  const others = Math.max(1, Math.min(state.belief.tasks.length - 1, 255));
  if (!picked || attempt(() => (world.answerAs(picked, true, PICKED_WRONG, others, ''), true)) !== true) return;
  noteAnswer(session);
}

/** Whether a meaning can be picked now. */
const mayPick = () => {
  const { session } = state;
  return Boolean(session?.decided && !session.looking && !session.question && session.intended === null && state.phase === 'waiting');
};

/** The trainer picks the meaning among the robot's tasks.
 * @param {string} name */
export function pick(name) {
  const { session } = state;
  if (!session || !mayPick() || !name) return;
  session.picked = name;
  goOn(session);
}

// At its goal the robot waits for the trainer; otherwise as long as the speed says.
function waitOf(session, auto) {
  const { action, confidence } = session.decided;
  const delay = SPEEDS[state.settings.speed](confidence);
  if (state.tour.watching) return state.settings.speed === 'once' ? 0 : WATCH_DELAY;
  if (session.looking && state.mode === 'tour') return Math.min(delay, TEST_DELAY);
  if (auto) return state.settings.speed === 'step' ? Infinity : Math.min(delay, 2600);
  if (action === 'noop') return Infinity;
  if (state.settings.speed === 'once') return 120;
  return state.settings.speed === 'normal' && state.mode === 'tour' && state.tour.own ? Math.min(delay, OWN_DELAY) : delay;
}

// The core takes in the feedback to the last action. A robot that is only watched takes in nothing: silence would be evidence, and might
// send it to and fro.
function commit(session) {
  const evidence = session.looking && !session.recorded ? world.unjudged() : attempt(() => parsed(world.judge(session.feedback || 'neutral')));
  if (evidence) state.evidence.push(evidence);
  else if (!session.looking) return;
  session.committed = session.decided;
  session.times.push(timeOfStep(session));
  session.steps += 1;
  session.rests = session.decided.action === 'noop' ? session.rests + 1 : 0;
  session.said = 0;
  state.belief = beliefNow();
  keepSession(session);
}

// Whether a session that runs by itself is over.
async function ended(session) {
  if (session.recorded || (session.intended === null && !session.looking)) return false;
  const plan = session.decided.plans[session.looking ? session.decided.task : session.intended];
  const there = plan === 'goal' && session.rests >= (session.looking ? 1 : RESTS);
  if (!there && plan !== 'dead end' && session.steps < MOST_STEPS) return false;
  if (session.looking) endWalk();
  else await finishSession();
  return true;
}

/** Ends the walk of a robot that is only watched: it has arrived, or the user skips it. */
export function endWalk() {
  const { session } = state;
  stopSession();
  render();
  session?.onEnd?.();
}

// The trainer's feedback to the last action. The last word before the next action counts.
export function giveFeedback(feedback) {
  const session = state.session;
  if (!session) tell(t('judge.nothing'));
  if (!session || session.looking || !session.decided || session.question || state.phase === 'planning' || state.phase === 'learning') return;
  // At the goal Good is yes.
  if (feedback === 'reward' && session.intended === null && isThere()) {
    thatWasIt();
    return;
  }
  // The same word once more takes it back; a double tap does not.
  if (session.said && session.feedback === feedback && performance.now() - session.said > 600) {
    takeBack();
    return;
  }
  if (!session.said || session.feedback !== feedback) session.said = performance.now();
  session.feedback = feedback;
  sound(feedback === 'reward' ? 'good' : 'bad');
  keepSession(session);
  announce(t('judge.given', { word: t(feedback === 'reward' ? 'train.good' : 'train.bad'), did: acted(session.decided.action) }));
  render();
  const waits = session.decided.action === 'noop' || state.settings.speed === 'step';
  if (waits && session.pace !== 'paused' && session.intended === null && !session.looking) {
    clearTimeout(session.soon);
    session.soon = window.setTimeout(() => wake(session), 450);
  }
}

/** Withdraws the feedback to the last step. */
export function takeBack() {
  const session = state.session;
  if (!session || !session.said || session.question || state.phase === 'learning') return;
  clearTimeout(session.soon);
  session.feedback = null;
  session.said = 0;
  keepSession(session);
  announce(t('judge.back'));
  render();
}

/** Takes back the feedback to the last step, or else that step, and waits. */
export function takeStepBack() {
  const session = state.session;
  if (session?.said) takeBack();
  if (!session || session.looking || session.question || state.phase !== 'waiting') return;
  const pending = Boolean(session.decided);
  if (!attempt(() => world.takeBack())) return;
  if (!pending) {
    session.steps -= 1;
    state.evidence.pop();
    // One for each line of the session's log, without its first and its last.
    session.times.length = world.log().trimEnd().split('\n').length - 2;
  }
  Object.assign(session, { decided: null, pace: 'paused', rests: 0 });
  refresh();
  keepSession(session);
  announce(t('judge.back'));
  wake(session);
}

/** The robot has reached the meant goal: that is good, and the session is over. */
export async function thatWasIt() {
  const session = state.session;
  if (!session || !session.decided || session.looking || session.question) return;
  Object.assign(session, { feedback: 'reward', said: performance.now(), affirmed: true });
  sound('goal');
  await finishSession();
}

export function togglePause() {
  const session = state.session;
  if (!session || session.question) return;
  session.pace = session.pace === 'paused' ? 'going' : 'paused';
  if (session.pace === 'going') wake(session);
  announce(t(session.pace === 'paused' ? 'judge.paused' : 'judge.goingOn'));
  render();
}

export function stepOnce() {
  const session = state.session;
  if (!session || !session.decided || session.question) return;
  if (state.settings.speed !== 'step') session.pace = 'paused';
  goOn(session);
}

// Finish and learn.
export async function finishSession() {
  const session = state.session;
  if (!session || session.looking || state.phase === 'learning') return;
  if (session.decided && state.evidence.length === session.steps && session.feedback && session.said) commit(session);
  session.pace = 'over';
  clearTimeout(session.soon);
  wake(session);
  const heat = heatNow();
  session.took = ranked()[0] || null;
  // How sure it was, when it heard the command, of the task that is the most likely in the end.
  const sure = session.heard.find(task => task.index === session.took?.index)?.probability ?? null;
  const own = attempt(() => logNow(session).replace('"learn":false', '"learn":true'));
  if (own === undefined) {
    stopSession();
    render();
    return;
  }
  const teaches = world.teaches();
  state.phase = 'learning';
  render();
  try {
    // A negated command, and "again", have no words to learn.
    if (!teaches) {
      world.finish();
      await learn();
    } else await change(quoted(session.command), async stale => {
      // Another tab has taught this robot meanwhile: this session is learned on top of that.
      if (stale) {
        const home = world.environment();
        await learnFrom(own.trimEnd().split('\n'));
        world.setEnvironment(home);
      } else {
        world.finish();
        await learn();
      }
      const { robot } = state;
      robot.scores = Object.assign([...(robot.scores || [])], { [world.sessions() - 1]: sure });
      robot.seeds = Object.assign([...(robot.seeds || [])], { [world.sessions() - 1]: state.settings.seed });
      robot.meant = Object.assign([...(robot.meant || [])], { [world.sessions() - 1]: state.mode === 'tour' ? stopAt()?.intended ?? '' : '' });
      return own;
    }, session.tourAfter);
  } catch (error) {
    tell(t('session.failed', { why: error.message }), true);
  }
  underWay.put(null);
  // All that follows a lesson would take too long at once.
  await nextTask();
  state.heat = { now: heatNow(), before: heat };
  const learned = teaches ? lessonLearned(session.heardNew) : '';
  await nextTask();
  state.said = [t('say.thanks'), learned];
  state.session = null;
  state.phase = 'none';
  $('command').value = session.command;
  const more = tellRest();
  if (session.onEnd) {
    session.onEnd();
    return;
  }
  if (learned) tell(t('learned.told', { text: learned }));
  if (more || (learned && session.affirmed && mayCelebrate() && !await moment(MOMENT))) return;
  render();
}

// How many milliseconds a success is shown.
export const MOMENT = 1500;

/** Whether a success is shown: not where motion is not wanted, because nothing is shown there that takes time. */
export const mayCelebrate = () => state.settings.speed !== 'once' && !matchMedia('(prefers-reduced-motion: reduce)').matches;

/** The robot is glad where it has got to, and the words that have become clear fly to the others. Returns false if the user goes elsewhere meanwhile.
 * @param {number} milliseconds */
export async function moment(milliseconds) {
  state.phase = 'moment';
  render();
  await new Promise(done => { setTimeout(done, milliseconds); });
  if (state.phase !== 'moment') return false;
  state.phase = 'none';
  return true;
}

export function finishWithoutLearning() {
  if (!state.session || state.tour.watching) return;
  $('command').value = state.session.command;
  stopSession();
  render();
  tell(t('session.dropped'));
}
