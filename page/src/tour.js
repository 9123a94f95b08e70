// The guided tour: its lessons and tests one after the other, with a score.
import { world } from './core.js';
import { renderFinale } from './finale.js';
import { askedFor, goOnUntilSure, invent, noWords, offered } from './invention.js';
import { named, percent, t } from './language.js';
import { heardWords } from './learned.js';
import { beginGuest, considerWays, endGuest, newRobot, takeTour } from './roster.js';
import { refresh, stopSession } from './session.js';
import { sound } from './sound.js';
import { $, all, announce, make, render, state, tell } from './state.js';
import { commandOf, count, enterStop, inOwnWords, lengthOfCourse, rightTests, stopAt, stops } from './stops.js';
import { keepTour, logOf, patch, tourNow } from './store.js';
import { MOMENT, endWalk, leaveSession, mayCelebrate, moment, startSession } from './training.js';
import { quoted, spaced, taskWords, understands, unspaced } from './words.js';
import { renderWordShelf } from './wordshelf.js';

// A test's hint about its command: three of the paper's tests repeat a lesson's command, in another home. Only a log with all of a
// robot's sessions shows what it has heard.
function aboutTest(stop) {
  const log = logOf(state.robot);
  if ((log.match(/"learn":true/g) || []).length < state.sessions) return t('tour.hint.test');
  return t(log.includes(JSON.stringify({ command: spaced(inOwnWords(commandOf(stop))) }).slice(1, -1)) ? 'tour.hint.testTaught' : 'tour.hint.testNew');
}

/** Goes to a lesson or test, if a session under way may be left. */
async function jumpTo(at) {
  if (state.tour.watching || !await leaveSession()) return;
  enterStop(at);
  $('lesson').focus();
}

// Begins the current lesson or test of the tour.
export function beginStop(auto) {
  if (!stopAt()) return;
  if (state.session?.looking) {
    endWalk();
    return;
  }
  const wrong = state.tour.own && invent(state.tour.own, state.tour.at, $('own-words').value);
  if (wrong) {
    tell(wrong, true);
    $('own-words').focus();
    return;
  }
  const stop = stops()[state.tour.at];
  world.reset();
  refresh();
  const own = auto || !mayReword() ? '' : $('own-words').value.trim();
  // Feedback to steps hardly tells ways apart: the simulated trainer picks the meaning.
  const session = startSession(own || inOwnWords(commandOf(stop)), { intended: stop.test ? null : auto ? stop.intended : null, looking: stop.test, picked: stop.appendix && auto && !stop.test ? stop.intended : '' });
  if (!session) return;
  if (own) state.tour.said[commandOf(stop)] = own;
  attend(session);
  if (!stop.test) return;
  // The verdict is known with the first step: nothing in a test changes the belief.
  session.onHeard = () => {
    [state.verdict, state.failed] = [verdictOf(stop, session), !understands(session.heard[0], stop.intended)];
    announce(state.verdict);
  };
}

// The verdict on a test, or on a lesson.
function verdictOf(stop, session) {
  const [best] = session.heard;
  const [understood, meant] = [understands(best, stop.intended), best.name === stop.intended];
  const verdict = !stop.test ? (understood && hasStar(session) ? 'tour.starLesson' : session.affirmed ? 'tour.arrived' : 'tour.plainLesson') : understood ? 'tour.starTest' : meant ? 'tour.luckyTest' : 'tour.wrongTest';
  const guess = stop.test && state.guess ? ' ' + t((state.guess === 'yes') === understood ? 'tour.guessRight' : 'tour.guessWrong') : '';
  return t(verdict, { name: state.tour.own ? quoted(session.command) : nameOf(state.tour.at), task: best.words, sure: percent(best.probability) }) + guess;
}

// Without any feedback it is not known whether the robot was right.
const hasStar = session => session.intended !== null || state.evidence.some(evidence => evidence.feedback !== 'neutral');

// Whether a lesson has taught another meaning than the tour's: the trainer said yes in the wrong place, or let the robot believe it.
const wentAstray = (stop, { intended, took, affirmed }) => !stop.test && intended === null && took.name !== stop.intended && (affirmed || took.probability > 0.5);

/** Lets the tour go on when this session ends. */
export function attend(session) {
  session.tourAfter = () => tourAfter(session);
  session.onEnd = () => passStop(understands(session.heard[0], stopAt()?.intended), session);
}

// The tour's progress when this session has ended.
function tourAfter(session) {
  const stop = stopAt();
  const tour = tourNow();
  const understood = understands(session.heard[0], stop.intended);
  tour.done[tour.at] = wentAstray(stop, session) ? 'astray' : understood && (stop.test || hasStar(session)) ? 'right' : 'wrong';
  tour.at += 1;
  return tour;
}

// Keeps what a test has shown, for the table.
function noteTest(stop, { command, heard }, understood) {
  const sure = heard.find(task => task.name === stop.intended)?.probability ?? 0;
  const test = { after: state.sessions, home: JSON.parse(stop.home), command, meant: stop.intended, heard: sure, understood: heard[0].name, right: understood ? 'yes' : 'no', guess: state.guess };
  patch(state.robot, { asked: [...(state.robot.asked || []), test] });
}

// Who only watches is shown the next lesson or test after a shorter while.
const BETWEEN = 900;

// A lesson is a success if the trainer has said something, and the robot has got it.
const isSuccess = (stop, session) => !stop.test && session.took?.name === stop.intended && (session.affirmed || hasStar(session));

// After a lesson or test: on to the next. The verdict stays until that begins.
async function passStop(understood, session) {
  const stop = stopAt();
  const astray = wentAstray(stop, session);
  const { at, done } = tourAfter(session);
  const { said } = state;
  if (stop.test) noteTest(stop, session, understood);
  if (stop.test && understood) sound('goal');
  if (stops()[state.tour.at + 1]?.test) goOnUntilSure();
  const verdict = astray ? t('tour.astray', { name: nameOf(state.tour.at), command: unspaced(session.command), task: session.took.words }) : verdictOf(stop, session);
  const told = [stop.test ? null : said, verdict, astray, astray || (stop.test && !understood)];
  Object.assign(state.tour, { at, done });
  keepTour();
  const glad = isSuccess(stop, session) && mayCelebrate();
  if (glad) {
    [state.said, state.verdict, state.astray, state.failed] = told;
    if (!await moment(state.tour.watching ? BETWEEN : MOMENT) || state.mode !== 'tour') return;
  }
  enterStop(state.tour.at);
  [state.said, state.verdict, state.astray, state.failed] = told;
  announce(state.verdict);
  if (state.tour.watching && stopAt()) setTimeout(() => { if (state.tour.watching && !state.session) beginStop(true); }, state.settings.speed === 'once' || glad ? 0 : BETWEEN);
  else {
    state.tour.watching = false;
    if (!stopAt()) announce(t('tour.over', { score: scoreWords() }));
    render();
    if (!state.settings.speed.startsWith('once')) $(stopAt() ? (state.tour.own && !$('own-way').hidden ? 'own-words' : 'lesson') : $('decode') ? 'decode' : 'onward').focus({ preventScroll: true });
  }
  render();
}

const nameOf = at => (at >= lengthOfCourse() ? t('tour.appendix', { n: at - lengthOfCourse() + 1 })
  : at < count(false) ? t('tour.lesson', { n: at + 1 }) : t('tour.test', { n: at - count(false) + 1 }));
const scoreWords = () => t('tour.score', { right: rightTests(), of: count(true) });

/** Shows the whole tour, with a robot that is only shown: the user's own waits. */
export async function watchTour() {
  if (state.tour.watching) {
    state.tour.watching = false;
    stopSession();
    await endGuest();
    return;
  }
  if (!await leaveSession()) return;
  await beginGuest(t('tour.shownRobot'));
  enterStop(0);
  state.tour.watching = true;
  beginStop(true);
}

/** Goes on with the tour's appendix: commands that say how. */
export async function beginAppendix() {
  await considerWays(true);
  enterStop(lengthOfCourse());
  $('lesson').focus();
}

/** Changes between the visitor's own language and the paper's tour. */
export const changeTour = () => takeTour(state.tour.own ? null : noWords());

/** Begins the tour anew, with a new robot. */
export async function restartTour() {
  if (!await leaveSession()) return;
  await newRobot();
  enterStop(0);
}

// In the first lesson one tap is enough; from the second on people say it in their own words.
const mayReword = () => state.tour.at > 0 && !state.tour.own && Boolean(stopAt());

export function setUpTour() {
  $('own-words').addEventListener('keydown', event => { if (event.key === 'Enter' && !event.isComposing) beginStop(false); });
  for (const button of all('#guess button')) {
    button.addEventListener('click', () => {
      state.guess = button.dataset.guess;
      render();
    });
  }
}

export function renderTour() {
  const { at, done, watching, own } = state.tour;
  $('tour').hidden = state.mode !== 'tour';
  renderWordShelf(state.mode === 'play' ? state.secret !== 'open' : Boolean(stopAt()));
  if (state.mode !== 'tour') return;
  const each = stops();
  const stop = each[at];
  const lessons = count(false);
  $('dots').dataset.about = own ? '' : t('tour.dotsShort');
  $('dots').replaceChildren(...each.map((one, index) => {
    const status = t(done[index] ? (done[index] === 'right' ? 'tour.status.right' : one.test || done[index] === 'astray' ? 'tour.status.wrong' : 'tour.status.learned') : index === at ? 'tour.status.now' : 'tour.status.later');
    const name = t('tour.dot', { name: nameOf(index), status });
    return make('li', {}, make('button', {
      type: 'button', class: [one.test ? 'test' : 'lesson', index === at ? 'now' : '', done[index] || ''].join(' '), 'aria-current': index === at ? 'step' : null, title: name, 'aria-label': name, disabled: own && index > done.length, onclick: () => jumpTo(index),
    }, done[index] === 'right' ? '★' : done[index] ? (one.test || done[index] === 'astray' ? '✗' : '✓') : one.test ? '?' : index + 1));
  }));
  $('score').textContent = stop && done.length > lessons ? scoreWords() : '';
  const asked = own && stop && !stop.test ? askedFor(own, at) : null;
  if (own && !stop) {
    $('tour-title').textContent = t(rightTests() ? 'own.done' : 'own.notYet');
    $('tour-hint').textContent = state.verdict;
  } else if (own && asked?.wanted && !state.session) {
    const task = t('own.invent', { task: taskWords(stop.intended) });
    $('tour-title').textContent = at ? task : t('own.title');
    $('tour-hint').textContent = at ? t(at === 1 ? 'own.hint.1' : 'own.hint.2') : task + ' ' + t('tour.hint.1');
  } else if (own && stop) {
    const [before, after] = t('own.means', { command: '\0', task: taskWords(stop.intended) }).split('\0');
    $('tour-title').replaceChildren(before, ...heardWords(state.session?.command ?? spaced(commandOf(stop))), after);
    $('tour-hint').textContent = stop.test ? aboutTest(stop) : t('own.again');
  } else if (!stop) {
    $('tour-title').textContent = t('tour.over', { score: scoreWords() });
    $('tour-hint').textContent = t(rightTests() === count(true) ? 'tour.allRight' : 'tour.notAll');
  } else {
    const name = stop.appendix ? nameOf(at) : stop.test ? t('tour.testOf', { n: at - lessons + 1, of: count(true) }) : t('tour.lessonOf', { n: at + 1, of: lessons });
    // The command is placed as the language wants it, with its words underlined.
    const [before, after] = t('tour.said', { name, command: '\0' }).split('\0');
    $('tour-title').replaceChildren(...(state.session ? [before, make('bdi', {}, ...heardWords(state.session.command)), after] : mayReword() ? [before, commandOf(stop), after] : [name]));
    $('tour-hint').textContent = stop.test ? aboutTest(stop) : named('tour.hint.' + (stop.appendix ? 'way' : at + 1)) || '';
  }
  const walking = Boolean(state.session?.looking);
  $('verdict').hidden = !state.verdict || !stop || (Boolean(state.session) && !walking);
  $('verdict').textContent = state.verdict;
  $('verdict').className = state.failed ? 'wrong' : '';
  renderFinale(!stop, scoreWords(), each.filter(one => !one.appendix));
  $('lesson').hidden = !stop || watching || state.phase === 'moment' || (Boolean(state.session) && !walking);
  $('lesson').textContent = !stop ? '' : walking ? t('tour.skip') : own || mayReword() ? t(stop.test ? 'tour.askIt' : 'tour.tellIt') : t('tour.tell', { command: commandOf(stop) });
  const glad = state.phase === 'moment';
  const idle = Boolean(stop) && !watching && !state.session && !glad;
  $('tour-title').hidden = $('tour-hint').hidden = glad;
  $('own-way').hidden = !idle || !(asked ? asked.wanted : mayReword());
  $('own-words').placeholder = asked ? offered(at) : stop ? inOwnWords(commandOf(stop)) : '';
  [$('own-before').textContent, $('own-after').textContent] = [unspaced(asked?.before ?? ''), unspaced(asked?.after ?? '')];
  $('guess').hidden = !idle || !stop.test || Boolean(own);
  for (const button of all('#guess button')) button.setAttribute('aria-pressed', String(button.dataset.guess === state.guess));
  const taught = state.astray && !state.session && state.robot.past.at(-1);
  $('amend').hidden = !taught;
  $('amend').textContent = taught ? t('undo', taught) : '';
  $('onward').hidden = Boolean(stop) || watching;
  $('onward').classList.toggle('primary', !own);
  $('appendix').hidden = Boolean(stop) || watching || world.ways() || Boolean(own);
  $('auto').hidden = !stop || stop.test || !idle || Boolean(own);
  $('watch').hidden = Boolean(own) || glad || (Boolean(state.session) && !watching);
  $('other').hidden = watching || glad || Boolean(state.session);
  $('other').textContent = t(own ? 'own.paper' : 'own.begin');
  $('watch').textContent = t(watching ? 'tour.stop' : 'tour.watch');
  $('again').hidden = watching || glad || Boolean(state.session) || (own ? Boolean(stop) : at === 0 && !done.length) || state.robot.log !== undefined;
  $('again').classList.toggle('primary', Boolean(own && !stop) && !rightTests());
}
