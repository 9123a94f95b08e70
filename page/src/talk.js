// What people write in the one field: commands, and words to a robot on its way. The core tells which is which.
import { answer } from './asking.js';
import { attempt, world } from './core.js';
import { t } from './language.js';
import { WORD } from './learned.js';
import { undo } from './roster.js';
import { goOn, noteAnswer } from './session.js';
import { $, announce, nextTask, state } from './state.js';
import { finishWithoutLearning, giveFeedback, lastCommand, leaveSession, remark, startSession, takeStepBack, tellRobot, thatWasIt, togglePause } from './training.js';
import { spaced } from './words.js';

/** The answers while no session is under way.
 * @type {Record<string, import('./language.js').Key>} */
const IDLE = { unjudged: 'judge.nothing', undo: 'undo.nothing', unchanged: 'talk.unchanged' };

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
  if (said === 'command' || (said === 'again' && lastCommand)) {
    // To hear a command takes as long as to find out that it is one.
    await nextTask();
    if (await leaveSession()) tellRobot(said === 'again' ? lastCommand : words);
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
  else if (judges && session.said && session.feedback === said) return;
  else if (judges) giveFeedback(said);
  else if (said === 'stop') (session.pace === 'paused' ? finishWithoutLearning : togglePause)();
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
  noteAnswer(session);
  goOn(session);
}
