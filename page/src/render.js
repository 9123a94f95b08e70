// Draws all views.
import { renderQuestion } from './asking.js';
import { speech } from './bubble.js';
import { renderBuild } from './build.js';
import { renderSettings } from './controls.js';
import { t } from './language.js';
import { heardWords } from './learned.js';
import { renderNext } from './next.js';
import { renderOwnTests } from './owntests.js';
import { renderPlan } from './plan.js';
import { renderIdeas } from './play.js';
import { renderRoster } from './roster.js';
import { renderSecret } from './secret.js';
import { followSession } from './serial.js';
import { hasWords, isThere } from './session.js';
import { $, all, make, state } from './state.js';
import { renderTabs } from './tabs.js';
import { feedbackWord, renderThoughts } from './thoughts.js';
import { renderTour } from './tour.js';
import { maySpeak, speak } from './voice.js';
import { acted } from './words.js';

// The animation of the time that the robot still waits.
/** @type {Animation | undefined} */
let waiting;

export function renderPage() {
  const session = state.session;
  const focused = /** @type {any} */ (document.activeElement);
  const busy = state.phase === 'learning';
  document.body.dataset.mode = state.mode;
  document.body.dataset.phase = state.phase === 'waiting' && session?.pace === 'paused' ? 'paused' : state.phase;
  document.documentElement.toggleAttribute('data-presenter', state.settings.presenter && state.mode !== 'build');
  document.body.toggleAttribute('data-session', Boolean(session));
  for (const button of all('button[data-mode]')) button.setAttribute('aria-pressed', button.dataset.mode === state.mode);
  renderTabs();
  renderPlan();
  renderTour();
  renderBuild();
  renderThoughts();
  renderNext();
  renderOwnTests();
  renderSecret();
  renderRoster();
  renderSettings();
  const [head, rest] = speech();
  $('say').replaceChildren(make('strong', {}, head), ' ', make('span', {}, rest));
  // In a session the numbers after its guess change with each step.
  speak(busy ? '' : session ? (session.decided || session.question ? head : '') : state.said ? (head + ' ' + rest).trim() : '');
  const elsewhere = Boolean(state.already) && !session;
  $('else').hidden = !elsewhere;
  // One thing stands out: in a session its end, in a game the game.
  $('else').classList.toggle('primary', elsewhere);
  $('say-it').classList.toggle('primary', !session && !elsewhere && !state.secret);
  $('tell').hidden = state.mode !== 'play' || state.secret === 'open';
  $('train').hidden = state.mode === 'build';
  $('plan').parentElement.hidden = state.mode === 'build';
  $('command').placeholder = t(session ? 'tell.on' : 'tell.placeholder');
  $('heard').hidden = !session;
  if (session) $('heard').replaceChildren(...heardWords(session.command));
  $('say-it').disabled = busy;
  $('speak').hidden = !maySpeak();
  const active = session && session.decided && state.phase !== 'planning' && !busy && !session.looking && !session.question;
  for (const id of ['good', 'bad']) {
    $(id).setAttribute('aria-disabled', !active);
    const given = Boolean(session && session.feedback === (id === 'good' ? 'reward' : 'punish'));
    $(id).setAttribute('aria-pressed', given);
    $(id).querySelector('small').textContent = given && session?.decided ? acted(session.decided.action === 'noop' ? 'stayed' : session.decided.action) : '';
  }
  const to = session?.looking && !session.recorded ? t('told.testTold') : !session || !session.decided ? t('train.to') : session.recorded ? t(/^[rp]/.test(session.feedback || '') ? 'judge.given' : 'it', { word: feedbackWord(session.feedback), did: acted(session.decided.action) }) :
    t(session.feedback === 'reward' ? 'train.saidGood' : session.feedback === 'punish' ? 'train.saidBad' : 'train.silent', { it: t('it', { did: acted(session.decided.action) }) });
  $('to').replaceChildren(to);
  $('pause').textContent = t(session?.pace === 'paused' ? 'train.goOn' : 'train.pause');
  $('pause').disabled = $('next').disabled = !session || busy;
  for (const id of ['pause', 'next']) $(id).hidden = !session || Boolean(session.question);
  for (const id of ['finish', 'drop']) $(id).hidden = !session || session.looking || state.tour.watching;
  $('finish').textContent = t(isThere() ? 'train.thatWasIt' : 'train.finish');
  $('finish').classList.toggle('big', isThere());
  // A trainer who has said nothing yet is not asked to end.
  $('finish').classList.toggle('primary', Boolean(session) && (isThere() || hasWords(session)));
  $('finish').disabled = $('drop').disabled = !session || busy || Boolean(session && session.looking);
  for (const [id, points] of /** @type {const} */ ([['undo', state.robot.past], ['redo', state.robot.future]])) {
    const point = points.at(-1);
    $(id).hidden = !point || Boolean(session) || busy;
    $(id).textContent = point ? t(id, { what: point.what.length > 44 ? point.what.slice(0, 43) + '…' : point.what }) : '';
    $(id).title = points.length > 1 ? t('undo.steps', { n: points.length }) : '';
  }
  for (const element of all('.place')) element.hidden = Boolean(session);
  $('choose').hidden = $('home').value !== 'random' || Boolean(session);
  renderIdeas();
  renderQuestion();
  followSession();
  waiting?.cancel();
  if (session && state.phase === 'waiting' && session.delay > 300 && session.delay < Infinity && session.pace !== 'paused') {
    waiting = $('wait').animate([{ transform: 'scaleX(0)' }, { transform: 'scaleX(1)' }], { duration: session.delay, delay: session.since - performance.now(), fill: 'both' });
  }
  // The focus does not stay on a button that is gone.
  if (focused && focused !== document.body && (focused.disabled || focused.closest('[hidden]'))) (session?.question ? $('answers') : session ? $('good') : $('lesson').offsetParent ? $('lesson') : $('command').offsetParent ? $('command') : $('main')).focus({ preventScroll: true });
}
