// The words that the robot knows, between the lessons of a tour and in free play. Those that have just become clear fly there from its bubble.
import { clearWords, meaning } from './learned.js';
import { $, isDrawn, make, state } from './state.js';

const FLIGHT = 1100;
// The newest words: the dictionary has all.
const MOST_WORDS = 12;

/** @param {boolean} wanted whether there are lessons or tests to come */
export function renderWordShelf(wanted) {
  const shelf = $('word-shelf');
  if (isDrawn('word-shelf', wanted && [state.mode, state.robot.id, state.robot.changed, state.sessions])) return;
  $(state.mode === 'tour' ? 'card' : 'ideas').before(shelf);
  const known = wanted ? clearWords().slice(-MOST_WORDS) : [];
  const before = new Set([...shelf.children].map(one => one.dataset.word));
  shelf.hidden = !known.length;
  shelf.replaceChildren(...known.map(([word, token]) => make('li', { 'data-word': word }, make('b', {}, word), meaning(word, token))));
  if (state.phase !== 'moment') return;
  const bubble = $('say').getBoundingClientRect();
  for (const one of [...shelf.children].filter(each => !before.has(each.dataset.word))) {
    const place = one.getBoundingClientRect();
    const from = 'translate(' + (bubble.left + bubble.width / 2 - place.left - place.width / 2) + 'px,' + (bubble.top + bubble.height / 2 - place.top) + 'px)';
    one.animate([{ transform: from + ' scale(.6)', opacity: 0 }, { transform: from + ' scale(1.7)', opacity: 1, offset: 0.35 }, { transform: 'none' }], { duration: FLIGHT, easing: 'ease-in-out' });
  }
}
