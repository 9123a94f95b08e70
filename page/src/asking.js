// The robot's questions: when an answer teaches it more than its next steps, it asks, and waits.
import { attempt, parsed, world } from './core.js';
import { listed, t } from './language.js';
import { noteAnswer, pause, wake } from './session.js';
import { $, announce, inParts, make, render, state } from './state.js';
import { objectWords, questionWords } from './words.js';

const BUDGET = 4000;
// An answer within this many milliseconds is ignored: it may be a late press of Good.
const TOO_SOON = 350;

/** Asks, if that is worth more than the next steps: only in free play, and only if questions are switched on. Returns whether there was an
 * answer; the robot may also be told to go on without one.
 * @param {import('./state.js').Session} session */
export async function askTrainer(session) {
  if (!state.settings.questions || state.mode !== 'play' || session.looking || session.intended !== null) return false;
  const found = await inParts(() => (session.pace === 'over' ? 'null' : attempt(() => world.question(BUDGET)) ?? 'null'));
  /** @type {import('goodbot-wasm').Question | null} */
  const question = session.pace === 'over' ? null : parsed(found);
  if (!question) return false;
  Object.assign(session, { question, asked: performance.now(), delay: 0 });
  state.phase = 'asking';
  const focused = document.activeElement;
  render();
  announce([questionWords(question), listed(['', ...choicesOf(question)].slice(choicesOf(question).length ? 1 : 0), 'or')].join(' '));
  if (focused === $('good') || focused === $('bad')) $('answers').focus({ preventScroll: true });
  const before = session.answers;
  await pause(session, Infinity);
  session.question = null;
  return session.answers > before;
}

/** The trainer's answer: `yes`, `no` (none of these, if there are choices), or the number of a choice.
 * @param {string} given */
export function answer(given) {
  const session = state.session;
  if (!session?.question || performance.now() - session.asked < TOO_SOON) return;
  if (given !== 'no' && (given === 'yes') === isChoice(session.question)) return;
  if (Number(given) > choicesOf(session.question).length) return;
  if (attempt(() => world.answer(given)) === undefined) return;
  session.question = null;
  noteAnswer(session);
  goOn(session);
}

function goOn(session) {
  wake(session);
  if ($('answers').contains(document.activeElement)) $('good').focus({ preventScroll: true });
}

const isChoice = question => question.about === 'whichObject' || question.about === 'whichTask';

/** The choices, without "none of these".
 * @param {import('goodbot-wasm').Question} question
 * @returns {string[]} */
const choicesOf = ({ about, objects, choices }) => (about === 'whichObject' ? objects.map(name => objectWords(name, 1))
  : about === 'whichTask' ? choices.map(task => state.belief.tasks[task].words) : []);

export function renderQuestion() {
  const session = state.session;
  const question = session?.question;
  $('answers').hidden = !question;
  $('good').closest('.judge').hidden = Boolean(question);
  const key = question ? JSON.stringify(question) + document.documentElement.lang : '';
  if (!session || !question || $('answers').dataset.key === key) {
    if (!question) $('answers').dataset.key = '';
    return;
  }
  $('answers').dataset.key = key;
  $('answers').setAttribute('aria-label', questionWords(question));
  const button = (given, letter, words) => make('button', { type: 'button', 'data-answer': given, onclick: () => answer(given) }, make('span', {}, words), make('kbd', {}, letter));
  const choices = choicesOf(question);
  $('answers').className = choices.length ? 'which' : '';
  $('answers').replaceChildren(
    ...choices.map((words, at) => button(String(at + 1), at + 1, words)),
    ...(choices.length ? [button('no', 'n', t('ask.none'))] : [button('yes', 'y', t('ask.yes')), button('no', 'n', t('ask.no'))]),
    make('button', { type: 'button', class: 'quiet', id: 'unanswered', onclick: () => goOn(session) }, t('ask.skip')));
}
