// The robot's bubble: what it says about itself.
import { listed, percent, t } from './language.js';
import { asWritten, knowsWords, unknownWords } from './learned.js';
import { state } from './state.js';
import { isOver } from './stops.js';
import { objectWords, questionWords, quoted, ranked, sessionsWord, taskWords } from './words.js';

// The robot's words at its goal: its room, or else the done task.
const hereWords = (name, task) => {
  const [, room] = name.match(/^agentInRoom\(\w+,(\w+)\)$/) || [];
  return room ? t('say.here', { room: objectWords(room, 2) }) : t('say.carriedOut', { task });
};

/** What a robot says of the task that it takes for the most likely, and how sure it is.
 * @param {import('goodbot-wasm').Task} best */
export function guess({ name, probability }) {
  const said = probability > 0.8 ? 'say.sure' : probability > 0.45 ? 'say.think' : 'say.perhaps';
  return [t(said, { task: taskWords(name) }), t('say.howSure', { sure: percent(probability) })];
}

/** What the robot says about itself: the main sentence, and the rest.
 * @returns {[string, string]} */
export function speech() {
  const session = state.session;
  if (state.phase === 'learning') return [t('say.thinking'), state.progress || t('say.learning')];
  if (!session) {
    // A robot that is only shown has no name of its own.
    if (isOver()) return [t(state.robot.log === undefined ? 'say.iAm' : 'say.thanks', state.robot), ''];
    if (state.said) return /** @type {[string, string]} */ (state.said);
    // What to do in a first visit stands beside the plan.
    if (state.sessions === 0) return [t(knowsWords() ? 'say.ready' : 'say.hello'), state.mode === 'tour' && state.tour.own ? '' : t('say.helloMore')];
    return [t('say.ready'), t('say.learnedFrom', { sessions: sessionsWord() })];
  }
  const best = ranked()[0];
  const unknown = unknownWords();
  const strange = unknown.length ? ' ' + t('say.strange', { words: listed(unknown.map(word => quoted(asWritten(word)))) }) : '';
  if (session.question) return [questionWords(session.question), strange.trim()];
  if (state.secret === 'open') return [t('secret.going'), ''];
  // Among equally likely tasks it is not known yet which one it follows.
  if (!session.decided || !best) return [t('say.thinking'), strange.trim()];
  const task = best.words;
  if (session.decided.action === 'noop') {
    const plan = session.decided.plans[session.decided.task];
    // In a test nobody can answer.
    const asked = key => (session.looking ? '' : t(key));
    if (plan === 'goal' && session.steps === 0) return [t('say.done', { task }), asked('say.doneMore') + strange];
    if (plan === 'goal') return [hereWords(best.name, task), asked('say.hereMore') + strange];
    if (plan === 'dead end') return [t('say.stuck'), t('say.stuckMore', { task })];
    return [t('say.lost'), t('say.lostMore')];
  }
  const [head, rest] = guess(best);
  return [head, rest + strange];
}
