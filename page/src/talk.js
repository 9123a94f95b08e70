// What people say beside commands. The core weighs that against all that a command may be (`Agent::listen`), and needs the role model for it; the
// page's robot has the paper's. Here an utterance counts as talk where all of its words do, and none of them was ever taught.
import { t } from './language.js';
import { WORD } from './learned.js';
import { state } from './state.js';

/** What an utterance is that is no command: `ready` where somebody stops or greets, `judge`, `back`, or `nothing` where it has no word.
 * @param {string} utterance
 * @returns {'ready' | 'judge' | 'back' | 'nothing' | undefined} */
export function talkIn(utterance) {
  const words = utterance.toLowerCase().match(WORD) || [];
  if (!words.length) return 'nothing';
  if (words.some(word => state.heat.now?.words.includes(word))) return undefined;
  return /** @type {const} */ (['ready', 'judge', 'back']).find(kind => {
    const known = t(/** @type {import('./language.js').Key} */ ('talk.' + kind)).split(' ');
    return words.every(word => known.includes(word));
  });
}
