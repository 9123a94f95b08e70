// What people write in the one field: commands, and words to a robot on its way. The core tells which is which.
import { answer } from './asking.js';
import { parsed, world } from './core.js';
import { t } from './language.js';
import { WORD, spaced } from './learned.js';
import { render } from './render.js';
import { begin, finishWithoutLearning, giveFeedback, keepSession, leaveSession, noteAnswer, startSession, stopSession, takeStepBack, thatWasIt, togglePause, undo, wake } from './session.js';
import { $, announce, attempt, state, tell } from './state.js';
import { beliefNow, taskWords } from './words.js';

/** The answers while no session is under way.
 * @type {Record<string, import('./language.js').Key>} */
const IDLE = { unjudged: 'judge.nothing', undo: 'undo.nothing', unchanged: 'talk.unchanged' };

// The last command.
let last = '';

/** Says something, in or between sessions.
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
  // It may still be a command, in a secret language.
  else remark(t(IDLE[said] || 'say.ready'), words);
}

// Handles words to a robot on its way.
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

/** Judges by a button. Words in the field are said along with it: the robot learns them as praise or blame.
 * @param {string} feedback */
export function judge(feedback) {
  const words = $('command').value.trim();
  if (state.session?.decided && words && state.mode === 'play') {
    attempt(() => world.learnVoice(words, feedback));
    $('command').value = '';
  }
  giveFeedback(feedback);
}

// Corrects the robot by words. If it asks or waits, it goes on.
function correct(session, words) {
  if (session.looking || attempt(() => (world.correct(words), true)) !== true) return;
  session.answers += 1;
  noteAnswer(session);
  session.stepping = session.paused;
  state.belief = beliefNow();
  keepSession(session);
  wake(session);
}

/** Tells the robot a command. If there is nothing to do, it says why, and waits.
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

/** After a session: goes on with the rest of the utterance. Returns whether there was one. */
export function tellRest() {
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
