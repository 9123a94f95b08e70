// The game of a secret language: a robot that was taught invented words comes by a link. Whoever opens the link finds out what each word
// means, from the robot's actions. Until then the page does not show its thoughts.
import { download } from './files.js';
import { inItsHome, noWords, partsOf } from './invention.js';
import { t } from './language.js';
import { clearWords, ideaWords, meaning } from './learned.js';
import { robotLink } from './link.js';
import { picture } from './picture.js';
import { takeTour } from './roster.js';
import { share } from './share.js';
import { $, announce, isDrawn, make, render, state, tell } from './state.js';
import { rightTests } from './stops.js';
import { leaveSession, startSession } from './training.js';

const MOST_WORDS = 12;

// The words to find out, each with its idea. Of an invented language they are its parts.
const words = (own = state.robot.tour.own) => (own?.take ? partsOf(own) : clearWords().slice(0, MOST_WORDS));

// When the game began, its score, and the most right words so far.
let [began, score, most] = [0, '', -1];

/** The link to this robot as a game. */
export async function shareSecret() {
  // A robot that has not understood its invented language has a riddle only of the words that it knows.
  const own = rightTests() ? state.tour.own : null;
  if (!words(own).length) tell(t('secret.none'), true);
  else share(await robotLink({ secret: true, ...inItsHome(own) }), t('secret.title', state.robot), t('secret.link'));
}

async function sayWord(word) {
  if (!await leaveSession()) return;
  $('command').value = word;
  startSession(word, { looking: true });
}

/** Shows how many words have the right idea chosen. */
function check() {
  const all = words();
  const chosen = [...$('secret-words').querySelectorAll('select')];
  const right = all.map(([, token], at) => chosen[at]?.value === token);
  for (const [at, select] of chosen.entries()) select.closest('li').classList.toggle('right', right[at]);
  const n = right.filter(Boolean).length;
  $('secret-say').textContent = t('secret.found', { n, of: all.length });
  score = t('secret.score', { n, of: all.length, seconds: Math.round((performance.now() - began) / 1000) });
  announce($('secret-say').textContent);
  if (n === all.length) reveal();
  else suggestTheEnd(n <= most);
  most = Math.max(most, n);
}

// Who is no longer coming closer sees how the game ends.
function suggestTheEnd(stuck) {
  for (const [at, button] of [...$('secret-buttons').children].entries()) button.className = 'small ' + (stuck === (at === 1) ? 'primary' : 'quiet');
}

function reveal() {
  state.secret = 'told';
  render();
  announce($('secret-say').textContent);
}

export function renderSecret() {
  document.documentElement.toggleAttribute('data-secret', state.secret === 'open');
  $('secret').hidden = !state.secret;
  if (!state.secret || isDrawn('secret', state.secret, state.robot.id)) return;
  const all = words();
  const told = state.secret === 'told';
  if (!told) [began, score, most] = [performance.now(), '', -1];
  $('secret-say').textContent = t(told ? 'secret.told' : 'secret.about', { name: state.robot.name, n: all.length }) + (told && score ? ' ' + score : '');
  if (told) {
    $('secret-words').replaceChildren(...all.map(([word, token]) => make('li', {}, make('b', {}, word), meaning(word, token))));
    $('secret-buttons').replaceChildren(
      make('button', { type: 'button', class: 'primary', onclick: () => takeTour(noWords()) }, t('own.begin')),
      make('button', { type: 'button', class: 'small', onclick: async () => download('secret-language.png', await picture(state.robot.name, $('secret-say').textContent, all), 'image/png') }, t('card.save')));
    return;
  }
  const ideas = [...new Set((state.heat.now?.tokens || []))].map(token => [token, ideaWords(token)]).sort((a, b) => a[1].localeCompare(b[1]));
  $('secret-words').replaceChildren(...all.map(([word]) => make('li', {},
    make('button', { type: 'button', class: 'small', 'aria-label': t('secret.sayWord', { word }), onclick: () => sayWord(word) }, word), ' ',
    make('select', { 'aria-label': t('secret.meaningOf', { word }), onchange: () => suggestTheEnd(false) }, make('option', { value: '' }, '…'), ...ideas.map(([token, idea]) => make('option', { value: token }, idea))))));
  $('secret-buttons').replaceChildren(
    make('button', { type: 'button', class: 'small primary', onclick: check }, t('secret.check')),
    make('button', { type: 'button', class: 'small quiet', onclick: reveal }, t('secret.giveUp')));
}
