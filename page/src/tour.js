// The guided tour: its lessons and tests one after the other, with a score.
import { course, world } from './core.js';
import { renderFinale } from './finale.js';
import { named, percent, t } from './language.js';
import { heardWords } from './learned.js';
import { beginGuest, considerWays, endGuest, newRobot } from './roster.js';
import { refresh, stopSession } from './session.js';
import { $, all, announce, make, render, state } from './state.js';
import { commandOf, enterStop, inOwnWords, lengthOfCourse, rightTests, stopAt, stops } from './stops.js';
import { logOf } from './store.js';
import { endWalk, leaveSession, startSession } from './training.js';
import { spaced, understands, unspaced } from './words.js';

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
  const stop = stopAt();
  if (!stop) return;
  if (state.session?.looking) {
    endWalk();
    return;
  }
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
  return t(verdict, { name: nameOf(state.tour.at), task: best.words, sure: percent(best.probability) }) + guess;
}

// Without any feedback it is not known whether the robot was right.
const hasStar = session => session.intended !== null || state.evidence.some(evidence => evidence.feedback !== 'neutral');

// Whether a lesson has taught another meaning than the tour's: the trainer said yes in the wrong place, or let the robot believe it.
const wentAstray = (stop, { intended, took, affirmed }) => !stop.test && intended === null && took.name !== stop.intended && (affirmed || took.probability > 0.5);

/** Lets the tour go on when this session ends. */
export function attend(session) {
  session.onEnd = () => passStop(understands(session.heard[0], stopAt()?.intended), session);
}

// After a lesson or test: on to the next. The verdict stays until that begins.
function passStop(understood, session) {
  const stop = stopAt();
  const astray = wentAstray(stop, session);
  state.tour.done[state.tour.at] = astray ? 'astray' : understood && (stop.test || hasStar(session)) ? 'right' : 'wrong';
  const { said } = state;
  const verdict = astray ? t('tour.astray', { name: nameOf(state.tour.at), command: unspaced(session.command), task: session.took.words }) : verdictOf(stop, session);
  enterStop(state.tour.at + 1);
  [state.said, state.verdict, state.astray, state.failed] = [stop.test ? null : said, verdict, astray, astray || (stop.test && !understood)];
  announce(state.verdict);
  if (state.tour.watching && stopAt()) setTimeout(() => { if (state.tour.watching && !state.session) beginStop(true); }, state.settings.speed === 'once' ? 0 : 900);
  else {
    state.tour.watching = false;
    if (!stopAt()) announce(t('tour.over', { score: scoreWords() }));
    render();
    if (!state.settings.speed.startsWith('once')) $(stopAt() ? 'lesson' : 'onward').focus({ preventScroll: true });
  }
  render();
}

const nameOf = at => (at >= lengthOfCourse() ? t('tour.appendix', { n: at - lengthOfCourse() + 1 })
  : at < course.lessons.length ? t('tour.lesson', { n: at + 1 }) : t('tour.test', { n: at - course.lessons.length + 1 }));
const scoreWords = () => t('tour.score', { right: rightTests(), of: course.tests.length });

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

/** Begins the tour anew, with a new robot. */
export async function restartTour() {
  if (!await leaveSession()) return;
  await newRobot();
  enterStop(0);
}

// In the first lesson one tap is enough; from the second on people say it in their own words.
const mayReword = () => state.tour.at > 0 && Boolean(stopAt());

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
  const { at, done, watching } = state.tour;
  const each = stops();
  const stop = each[at];
  const lessons = course.lessons.length;
  $('tour').hidden = state.mode !== 'tour';
  if (state.mode !== 'tour') return;
  $('dots').dataset.about = t('tour.dotsShort');
  $('dots').replaceChildren(...each.map((one, index) => {
    const status = t(done[index] ? (done[index] === 'right' ? 'tour.status.right' : one.test || done[index] === 'astray' ? 'tour.status.wrong' : 'tour.status.learned') : index === at ? 'tour.status.now' : 'tour.status.later');
    const name = t('tour.dot', { name: nameOf(index), status });
    return make('li', {}, make('button', {
      type: 'button', class: [one.test ? 'test' : 'lesson', index === at ? 'now' : '', done[index] || ''].join(' '), 'aria-current': index === at ? 'step' : null, title: name, 'aria-label': name, onclick: () => jumpTo(index),
    }, done[index] === 'right' ? '★' : done[index] ? (one.test || done[index] === 'astray' ? '✗' : '✓') : one.test ? '?' : index + 1));
  }));
  $('score').textContent = stop && done.length > lessons ? scoreWords() : '';
  if (!stop) {
    $('tour-title').textContent = t('tour.over', { score: scoreWords() });
    $('tour-hint').textContent = t(rightTests() === course.tests.length ? 'tour.allRight' : 'tour.notAll');
  } else {
    const name = stop.appendix ? nameOf(at) : stop.test ? t('tour.testOf', { n: at - lessons + 1, of: course.tests.length }) : t('tour.lessonOf', { n: at + 1, of: lessons });
    // The command is placed as the language wants it, with its words underlined.
    const [before, after] = t('tour.said', { name, command: '\0' }).split('\0');
    $('tour-title').replaceChildren(...(state.session ? [before, ...heardWords(state.session.command), after] : mayReword() ? [before, commandOf(stop), after] : [name]));
    $('tour-hint').textContent = stop.test ? aboutTest(stop) : named('tour.hint.' + (stop.appendix ? 'way' : at + 1)) || '';
  }
  const walking = Boolean(state.session?.looking);
  $('verdict').hidden = !state.verdict || !stop || (Boolean(state.session) && !walking);
  $('verdict').textContent = state.verdict;
  $('verdict').className = state.failed ? 'wrong' : '';
  renderFinale(!stop, scoreWords(), each.filter(one => !one.appendix));
  $('lesson').hidden = !stop || watching || (Boolean(state.session) && !walking);
  $('lesson').textContent = !stop ? '' : walking ? t('tour.skip') : mayReword() ? t(stop.test ? 'tour.askIt' : 'tour.tellIt') : t('tour.tell', { command: commandOf(stop) });
  const idle = Boolean(stop) && !watching && !state.session;
  $('own-way').hidden = !idle || !mayReword();
  $('own-words').placeholder = stop ? inOwnWords(commandOf(stop)) : '';
  $('guess').hidden = !idle || !stop.test;
  for (const button of all('#guess button')) button.setAttribute('aria-pressed', String(button.dataset.guess === state.guess));
  const taught = state.astray && !state.session && state.robot.past.at(-1);
  $('amend').hidden = !taught;
  $('amend').textContent = taught ? t('undo', taught) : '';
  $('onward').hidden = Boolean(stop) || watching;
  $('appendix').hidden = Boolean(stop) || watching || world.ways();
  $('auto').hidden = !stop || stop.test || watching || Boolean(state.session);
  $('watch').hidden = Boolean(state.session) && !watching;
  $('watch').textContent = t(watching ? 'tour.stop' : 'tour.watch');
  $('again').hidden = watching || Boolean(state.session) || (at === 0 && !done.length) || state.robot.log !== undefined;
}
