// The end of the tour: the robot gets a name and dances, and there is a card of it, and after an invented language a clip, to keep and to share.
import { clipOf, clipType, recorded } from './clip.js';
import { world } from './core.js';
import { download } from './files.js';
import { inItsHome, partsOf } from './invention.js';
import { percent, t } from './language.js';
import { clearWords, meaning } from './learned.js';
import { robotLink } from './link.js';
import { picture } from './picture.js';
import { printCertificate, printWorksheet } from './print.js';
import { rename } from './roster.js';
import { shareSecret } from './secret.js';
import { sureness } from './silent.js';
import { $, announce, isDrawn, make, state, tell } from './state.js';
import { isMerry } from './stops.js';
import { logOf } from './store.js';
import { saveTable } from './tables.js';
import { mayCelebrate } from './training.js';
import { quoted, taskWords, unspaced } from './words.js';

const FILE = 'my-robot.png';
// Whether a meaning is so probable that a test counts as understood.
const counts = p => Math.round(p * 100) > 50;
// About as likely as not: a robot that guesses lessons without a word is a little surer of what it guessed.
const isOpen = p => Math.round(p * 100) <= 55;
/** @type {Promise<{ link: string, file: File, address: string }> | null} */
let card = null;

// A link to a file on this machine is of no use to others.
async function makeCard(score) {
  const { own } = state.tour;
  // The card of an invented language is a riddle.
  const link = location.protocol === 'file:' ? '' : await robotLink(own ? { secret: true, ...inItsHome(own) } : {});
  const blob = own ? await picture(state.robot.name, t('own.decode'), partsOf(own).map(([word]) => [word, '']), link, t('own.decode'), isMerry())
    : await picture(state.robot.name, score, clearWords(), link, t('link.meet', state.robot), isMerry());
  const address = await new Promise(done => {
    const reader = new FileReader();
    reader.onload = () => done(reader.result);
    reader.readAsDataURL(blob);
  });
  return { link, file: new File([blob], FILE, { type: 'image/png' }), address };
}

async function keepCard() {
  const made = await card;
  if (made) download(FILE, made.file, 'image/png');
}

// The system's own sheet.
async function shareFile(file, url = '') {
  try {
    await navigator.share({ files: [file], title: t('link.meet', state.robot), ...(url ? { url } : {}) });
  } catch (error) {
    // Closing the sheet is no error.
    if (error.name !== 'AbortError') tell(error.message, true);
  }
}

async function shareCard() {
  const made = await card;
  if (made) await shareFile(made.file, made.link);
}

const canShare = (name, type) => Boolean(navigator.canShare?.({ files: [new File(['.'], name, { type })] }));

/** The robot obeys a sentence that nobody has taught it. It is recorded while it is shown: at once, unless motion is not wanted; then when it is saved.
 * @param {string} type
 * @param {{ home: string, intended: string, command: string }} stop */
async function showClip(type, { home, intended, command }) {
  const said = quoted(unspaced(command));
  const clip = await clipOf(home, intended, said, t('own.decode'));
  const name = FILE.replace('png', type.replace('video/', ''));
  /** @type {Promise<File> | undefined} */
  let made;
  const file = () => (made ??= recorded(clip).then(blob => new File([blob], name, { type })));
  const button = (id, label, action) => make('button', { type: 'button', class: 'small', id, onclick: async () => action(await file()) }, label);
  clip.canvas.setAttribute('role', 'img');
  clip.canvas.setAttribute('aria-label', t('own.means', { command: unspaced(command), task: taskWords(intended) }));
  $('preview').append(clip.canvas, make('div', { class: 'row' }, button('save-clip', t('clip.save'), one => download(name, one, type)),
    canShare(name, type) ? button('share-clip', t('clip.share'), one => shareFile(one)) : null));
  if (mayCelebrate()) file();
}

/** Lets the robot dance once more. */
function dance() {
  const [robot] = /** @type {any} */ ($('plan')).getElementsByClassName('dancing');
  robot?.classList.remove('dancing');
  void robot?.getBoundingClientRect();
  robot?.classList.add('dancing');
}

async function giveName(name) {
  await rename(state.robot, name);
  announce(t('say.iAm', state.robot));
  dance();
}

/** The words that the robot knows, and a picture of it.
 * @param {boolean} over whether the tour is over
 * @param {string} score
 * @param {{ home: string, intended: string, test: boolean }[]} stops the tour's lessons and tests */
export function renderFinale(over, score, stops) {
  $('card').hidden = $('preview').hidden = !over;
  // With ways, there are more tasks in the tests' home than a robot has room for.
  $('worth').hidden = !over || world.ways();
  if (isDrawn('card', over && [state.robot.id, state.robot.name, state.robot.model, score, world.ways(), state.tour.own])) return;
  card = null;
  if (!over) return;
  const made = card = makeCard(score);
  const type = clipType();
  made.then(({ address }) => {
    if (made !== card) return undefined;
    $('preview').replaceChildren(make('img', { src: address, alt: t('card.save') }));
    return state.tour.own && isMerry() && type ? showClip(type, /** @type {any} */ (stops.at(-1))) : undefined;
  }).catch(error => tell(error.message, true));
  const known = clearWords();
  const guest = state.robot.log !== undefined;
  const name = make('input', { id: 'robot-name', 'aria-label': t('card.name'), value: state.robot.name, maxlength: 40, autocomplete: 'off' });
  name.addEventListener('change', () => giveName(name.value));
  $('card').replaceChildren(
    make('div', { class: 'row' },
      state.tour.own && isMerry() ? make('button', { type: 'button', class: 'primary', id: 'decode', onclick: shareSecret }, t('own.decode')) : null,
      guest ? null : make('div', { class: 'field grow' }, make('label', { for: 'robot-name' }, t('card.name')), name),
      make('button', { type: 'button', class: 'small', id: 'save-card', onclick: keepCard }, t('card.save')),
      canShare(FILE, 'image/png') ? make('button', { type: 'button', class: 'small', id: 'share-card', onclick: shareCard }, t('card.share')) : null,
      make('button', { type: 'button', class: 'small', id: 'tour-table', onclick: saveTable }, t('charts.save')),
      known.length ? make('button', { type: 'button', class: 'small', id: 'print-certificate', onclick: () => printCertificate(known) }, t('print.certificate')) : null,
      state.tour.own ? null : make('button', { type: 'button', class: 'small', id: 'print-worksheet', onclick: printWorksheet }, t('print.worksheet'))),
    make('p', {}, t('card.knows', { n: known.length })),
    make('ul', { class: 'chips' }, ...known.map(([word, token]) => make('li', {}, make('b', {}, word), meaning(word, token)))));
  if (!world.ways()) renderWorth(stops);
}

// The worth of the trainer's feedback and answers. Without any there is nothing to compare.
function renderWorth(stops) {
  const isQuiet = !/"feedback":"[rp]|"type":"answer"/.test(logOf(state.robot));
  const all = sureness(stops);
  const only = isQuiet ? [] : all.filter(({ sure, silent }) => counts(sure) && isOpen(silent)).sort((a, b) => b.sure - b.silent - a.sure + a.silent).slice(0, 2);
  const head = [t('card.sure'), t(isQuiet ? 'card.without' : 'card.with'), ...(isQuiet ? [] : [t('card.without')])];
  const row = ({ command, sure, silent }) => make('tr', {}, make('th', { scope: 'row' }, quoted(command)), ...[sure, silent].slice(0, head.length - 1).map(share => make('td', {}, percent(share))));
  $('worth').replaceChildren(make('summary', {}, t(isQuiet ? 'card.quiet' : 'card.silent')), make('table', {},
    make('thead', {}, make('tr', {}, ...head.map(words => make('th', { scope: 'col' }, words)))),
    only.length ? make('tbody', { id: 'only' }, make('tr', {}, make('th', { scope: 'rowgroup', colspan: head.length }, t('card.only', { n: only.length }))), ...only.map(row)) : null,
    make('tbody', {}, ...all.filter(one => one.test && !only.includes(one)).map(row))));
}
