// What people say in the one field: commands, and words to a robot on its way. The core tells which is which.
import { answer } from './asking.js';
import { parsed, world } from './core.js';
import { t } from './language.js';
import { WORD, spaced } from './learned.js';
import { render } from './render.js';
import { begin, finishWithoutLearning, giveFeedback, keepSession, leaveSession, noteAnswer, startSession, stopSession, takeStepBack, thatWasIt, togglePause, undo, wake } from './session.js';
import { $, announce, attempt, state, tell } from './state.js';
import { beliefNow, taskWords } from './words.js';

/** What is answered where nothing is under way.
 * @type {Record<string, import('./language.js').Key>} */
const IDLE = { unjudged: 'judge.nothing', undo: 'undo.nothing', unchanged: 'talk.unchanged' };

// The command that was told last.
let last = '';

/** Says something, wherever things stand.
 * @param {string} written */
export async function say(written) {
  const words = spaced(written).trim();
  if (state.secret === 'open') {
    startSession(words, { looking: true });
    return;
  }
  if (state.phase === 'learning') return;
  if (!words.match(WORD)) {
    remark(t('talk.nothing'), '');
    return;
  }
  const said = attempt(() => world.said(words));
  if (said === undefined) return;
  const { session } = state;
  if (said === 'command' || (said === 'again' && last)) {
    if (await leaveSession()) tellRobot(said === 'again' ? last : words);
  } else if (session) toTheRobot(session, said, words);
  else if (said === 'undo' && state.robot.past.length) undo('past');
  // It may be a command all the same, in a secret language.
  else remark(t(IDLE[said] || 'say.ready'), words);
}

// What is said to a robot on its way.
function toTheRobot(session, said, words) {
  $('command').value = '';
  const judges = said === 'reward' || said === 'punish';
  if (said === 'finish') thatWasIt();
  else if (said === 'correction') correct(session, words);
  else if (judges && session.given && session.feedback === said) return;
  else if (judges) giveFeedback(said);
  else if (said === 'stop') (session.paused ? finishWithoutLearning : togglePause)();
  else if (said === 'undo') takeStepBack();
  else if (/^(yes|no|\d+)$/.test(said) && session.question) answer(said);
  else if (said === 'unjudged') announce(t('judge.nothing'));
}

/** Judges by a button. What is written in the field is said along with it: such words are praise or blame from then on.
 * @param {string} feedback */
export function judge(feedback) {
  const words = $('command').value.trim();
  if (state.session?.decided && words && state.mode === 'play') {
    attempt(() => world.learnVoice(words, feedback));
    $('command').value = '';
  }
  giveFeedback(feedback);
}

// Words turn the robot round. Where it asks or waits, it goes on.
function correct(session, words) {
  if (session.looking || attempt(() => (world.correct(words), true)) !== true) return;
  session.answers += 1;
  noteAnswer(session);
  session.stepping = session.paused;
  state.belief = beliefNow();
  keepSession(session);
  wake(session);
}

/** Tells the robot a command. Where there is nothing to do, it says why, and waits.
 * @param {string} words
 * @param {boolean} insists whether it is a command, whatever the robot takes it for */
export function tellRobot(words, insists = false) {
  stopSession();
  last = words;
  state.already = '';
  const heard = attempt(() => parsed(world.listen(words, insists)));
  if (heard) follow(heard, words);
  else render();
}

/** A session is over: goes on with what is still to come of what was said. Returns whether there was something. */
export function tellRest() {
  const heard = world.isMore() ? attempt(() => parsed(world.listenOn())) : null;
  if (heard) follow(heard, '');
  return Boolean(heard);
}

/** @param {import('goodbot-wasm').Heard} heard */
function follow(heard, words) {
  if (heard.begun) begin(heard.command, {});
  else if (heard.negated) remark(t('talk.not'), '');
  else if (heard.verdict === 'done') remark(t('say.done', { task: taskWords(heard.task) }), words);
  else remark(t(heard.verdict === 'none' ? 'talk.none' : 'talk.unsure'), words);
}

// The robot says something while nothing is asked of it. `words` may be a command all the same. On its way its bubble says what it does: it would
// say the rest when nobody thinks of it any more.
function remark(text, words) {
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
