// The records of a session log: the robot learns from its sessions one after the other.
import { NO_LAG, restsAsMoves } from './believes.js';
import { PLAN_BUDGET, learn, world } from './core.js';
import { t } from './language.js';
import { inParts, nextFrame, render, state } from './state.js';
import { ACTIONS } from './words.js';

const LOG_FIELDS = {
  session: ['type', 'version', 'id', 'kind', 'environment', 'command', 'intended', 'before', 'through', 'avoiding', 'actions', 'prior', 'strategies', 'continues', 'utterance', 'after', 'conversation', 'closed_words'],
  step: ['type', 'action', 'feedback', 'at_ms', 'said_ms'],
  answer: ['type', 'tasks', 'yes', 'eta', 'others', 'words', 'said_ms'],
  end: ['type', 'learn'],
};

/** A line of a log, read. Throws if it is of another kind of file.
 * @param {string} line
 * @returns {any} */
export function recordOf(line) {
  try {
    const record = JSON.parse(line);
    if (record.type) return record;
  } catch { /* No JSON, or `null`. */ }
  throw new Error(t('log.type'));
}

/** Throws if a line of a log is wrong, and says why. */
export function checkRecord(record) {
  const fields = LOG_FIELDS[record.type];
  if (!fields) throw new Error(t('log.type'));
  const strange = Object.keys(record).find(field => !fields.includes(field));
  if (strange) throw new Error(t('log.field', { name: strange }));
  if (record.type === 'session' && record.version !== 1) throw new Error(t('log.version'));
  if (record.type === 'session' && !['feedback', 'demonstration'].includes(record.kind)) throw new Error(t('log.kind'));
  const action = (record.actions || []).find(name => !ACTIONS.includes(name));
  if (action) throw new Error(t('log.action', { name: action }));
}

const numbersOf = one => [one.mu_plus, one.mu_minus, one.epsilon, one.prior, ...(one.lags || NO_LAG), ...(one.rests || restsAsMoves(one.mu_plus, one.mu_minus, one.epsilon))];

/** @returns {[string, boolean, number, number, string]} */
const ofAnswer = ({ tasks, yes, eta, others, words }) => [tasks.join('\n'), yes, eta, others ?? 1, words || ''];
// The beginning of a session in which the robot listened.
/** @returns {[string, string | undefined, string]} */
const ofListening = ({ utterance, after, conversation }) => [utterance, after, Object.entries(conversation || {}).flat().join('\n')];

/** Takes in an answer of a log. */
export const answerRecorded = record => world.answerAs(...ofAnswer(record));

/** Begins a session of this page's own log anew. */
export function beginAnew(record) {
  world.setPulls((record.actions || []).includes('pull'));
  world.setEnvironment(JSON.stringify(record.environment));
  if (record.strategies) world.setStrategies(Float32Array.from(record.strategies.flatMap(numbersOf)));
  if (record.utterance) world.listenAs(...ofListening(record));
  else world.hear(record.command);
}

// Probabilities in any unit: the largest becomes 1, so that single precision never makes all of them 0.
const inUnit = numbers => numbers.map(number => number / Math.max(...numbers));

// Begins a recorded session; `last` is the session before.
function tellBeginning(record, last) {
  const same = last && last.command === record.command && JSON.stringify(last.environment) === JSON.stringify(record.environment);
  if (record.continues && !same) throw new Error(t('log.continues'));
  world.setPulls((record.actions || []).includes('pull'));
  world.beginRecorded(JSON.stringify(record.environment), record.command, record.kind === 'demonstration', record.continues === true);
  if (record.strategies) {
    const shares = inUnit(record.strategies.map(one => one.prior));
    world.recordedStrategies(Float32Array.from(record.strategies.flatMap((one, at) => [...numbersOf(one), shares[at]])));
  }
  if (record.utterance) world.recordedListening(...ofListening(record));
  if (record.closed_words !== undefined) world.recordedClosedWords(record.closed_words);
  if (record.prior) world.recordedPrior(Object.keys(record.prior).join('\n'), Float32Array.from(inUnit(Object.values(record.prior))));
}

// Replays the lines, and returns those of sessions that were learned, with the sessions that they continue.
export async function learnFrom(lines) {
  /** @type {string[]} */
  const learned = [];
  /** @type {any} */
  let [session, last] = [null, null];
  /** @type {string[][]} */
  let [own, unlearned] = [[], []];
  let [number, shown] = [0, 0];
  for (const line of lines) {
    number += 1;
    if (!line.trim()) continue;
    try {
      const record = recordOf(line);
      checkRecord(record);
      own.push(line);
      if ((record.type === 'session') !== (session === null)) throw new Error(t(session ? 'log.noEnd' : 'log.noBeginning'));
      if (record.type === 'session') {
        tellBeginning(record, last);
        session = record;
        if (!record.continues) unlearned = [];
        own = [line];
      } else if (record.type === 'answer') {
        world.recordedAnswer(...ofAnswer(record));
      } else if (record.type === 'step') {
        world.recordedStep(record.action, record.feedback || '');
      } else {
        await inParts(() => world.replayOn(PLAN_BUDGET, record.learn));
        if (record.learn) {
          await learn();
          learned.push(...unlearned, ...own);
          unlearned = [];
        } else unlearned.push(...own);
        [session, last] = [null, session];
        state.sessions = world.sessions();
        state.progress = t('say.line', { n: number, of: lines.length });
        if (performance.now() - shown > 100) {
          render();
          await nextFrame();
          shown = performance.now();
        }
      }
    } catch (error) {
      throw new Error(t('log.line', { n: number, why: error.message }));
    }
  }
  if (session) throw new Error(t('log.lastOpen'));
  if (!last) throw new Error(t('log.empty'));
  return learned;
}
