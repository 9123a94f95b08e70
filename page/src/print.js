// What a class takes home on paper, one page each: a certificate of what the robot has learned, and the worksheet of the lesson plan.
import { t } from './language.js';
import { meaning } from './learned.js';
import { robotDrawing } from './robot.js';
import { $, draw, make, state } from './state.js';

function print(...parts) {
  $('paper').replaceChildren(...parts);
  // Whoever prints the page itself later gets that.
  window.addEventListener('afterprint', () => $('paper').replaceChildren(), { once: true });
  window.print();
}

// A field to write in with a pen: the line is the style's.
const blank = label => make('p', { class: 'blank' }, label);
const texts = (/** @type {import('./language.js').Key} */ key) => t(key).split('|');
const title = (tag, words) => make(tag, {}, words);
const row = (first, columns) => make('tr', {}, make('th', { scope: 'row' }, first), ...Array.from({ length: columns }, () => make('td', {})));
const table = (heads, rows) => make('table', {}, make('thead', {}, make('tr', {}, ...heads.map(words => (words ? make('th', { scope: 'col' }, words) : make('td', {}))))), make('tbody', {}, ...rows));

/** Prints the robot's name, and the words that it has learned.
 * @param {[string, string][]} known words and their ideas */
export function printCertificate(known) {
  print(title('h1', t('print.certificate')), draw('svg', { viewBox: '-24 -30 48 54', class: 'robot' }, ...robotDrawing()), make('h2', {}, make('bdi', {}, state.robot.name)),
    make('p', {}, t('print.taught')), make('ul', { class: 'chips' }, ...known.map(([word, token]) => make('li', {}, make('b', {}, word), meaning(word, token)))),
    blank(t('print.teacher')), make('p', {}, new Date().toLocaleDateString(document.documentElement.lang, { dateStyle: 'long' })));
}

/** Prints the worksheet, to be filled in. */
export function printWorksheet() {
  const [about, before, after] = texts('print.a');
  const [tests, ...heads] = texts('print.b');
  const [shared, none, head, ...rest] = texts('print.c');
  const robots = rest.slice(0, -1);
  print(title('h1', t('print.worksheet')), make('div', { class: 'row' }, ...texts('print.group').map(blank)),
    title('h2', about), ...[before, after].map(label => make('p', { class: 'blank tall' }, label)),
    title('h2', tests), table(heads, [1, 2, 3, 4, 5].map(number => row(number, heads.length - 1))),
    title('h2', shared), table([none, head], robots.map(label => row(label, 1))), ...rest.slice(-1).map(blank));
}
