// A question that must be answered before something is given up.
import { $, make } from './state.js';

/** Asks, and returns the key of the answer; the last one if the dialog is closed without an answer.
 * @param {string} question
 * @param {Record<string, string>} answers key and label; the first is the answer of most people
 * @returns {Promise<string>} */
export function ask(question, answers) {
  const dialog = $('ask');
  const keys = Object.keys(answers);
  return new Promise(done => {
    dialog.replaceChildren(
      make('p', { id: 'ask-text' }, question),
      make('div', { class: 'row' }, ...keys.map((key, at) => make('button', { type: 'button', class: at === 0 ? 'primary' : '', 'data-answer': key, onclick: () => dialog.close(key) }, answers[key]))));
    dialog.returnValue = '';
    dialog.addEventListener('close', () => done(keys.includes(dialog.returnValue) ? dialog.returnValue : keys[keys.length - 1]), { once: true });
    dialog.showModal();
  });
}
