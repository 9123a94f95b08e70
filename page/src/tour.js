// The guided tour: the paper's seven lessons and five tests, with a score.
import { download } from './bytes.js';
import { course, world } from './core.js';
import { ideaWords, meanings } from './learned.js';
import { picture } from './picture.js';
import { heardWords, render } from './render.js';
import { beginGuest, endGuest, newRobot } from './roster.js';
import { leaveSession, refresh, startSession, stopSession } from './session.js';
import * as shelf from './shelf.js';
import { $, announce, attempt, make, percent, state } from './state.js';
import { keepTour } from './store.js';

const stops = () => [...course.lessons.map(stop => ({ ...stop, test: false })), ...course.tests.map(stop => ({ ...stop, test: true }))];
export const homeNamed = name => JSON.stringify(course.homes.find(([other]) => other === name)?.[1]);

const HINTS = [
  'It knows no word yet, so it will just try something. Press Good when it goes the right way, Bad when it does not.',
  'A new room, the same house. Does it already know what “room” means?',
  'New colours. It has to ask your thumbs again – but not for long.',
  'By now, “go to the” should be clear.',
  'Something new: there is a chair, and it can be pushed.',
  'A bag this time. It pushes; it cannot pull.',
  'The last lesson. It may well need no correction at all.',
];

const stopAt = () => stops()[state.tour.at];

export function enterStop(at) {
  stopSession();
  [state.said, state.verdict] = [null, ''];
  state.tour.at = Math.max(0, Math.min(at, stops().length));
  const stop = stopAt();
  // After the last test the robot stays where the tests were.
  enterHome(homeNamed(stop ? stop.home : 'Test'));
  keepTour();
  $('command').value = stop ? stop.command : '';
  render();
}

/** Goes to a lesson or test, if a session under way may be left. */
async function jumpTo(at) {
  if (state.tour.watching || !await leaveSession()) return;
  enterStop(at);
  $('lesson').focus();
}

export function enterHome(json) {
  stopSession();
  // In the tour the robot pushes only, as the paper's does.
  if (attempt(() => (world.setEnvironment(json), world.setPulls(state.settings.pull && state.mode !== 'tour'), true)) !== true) return false;
  refresh();
  state.evidence = [];
  state.support = null;
  [state.said, state.already] = [null, ''];
  if (state.mode !== 'tour') shelf.put('home', json);
  return true;
}

// Begins the lesson or test where the tour stands.
export function beginStop(auto) {
  const stop = stopAt();
  if (!stop) return;
  world.reset();
  refresh();
  const session = startSession(stop.command, { intended: stop.test ? null : auto ? stop.intended : null, looking: stop.test });
  if (!session) return;
  const right = attend(session);
  const heard = session.heard[0];
  if (stop.test) announce('Test: ' + stop.command + '. The robot thinks: ' + heard.words + '. ' + (right ? 'Right.' : 'Wrong.'));
}

/** Lets the tour go on when this session ends. Returns whether the command was understood at once: it came first, and more likely than not. */
export function attend(session) {
  const [best] = session.heard;
  const meant = best.name === stopAt()?.intended;
  const understood = meant && best.probability > 0.5;
  session.onEnd = () => passStop(understood, meant, best, session);
  return understood;
}

// The lesson or test is over: on to the next. What came of it stays until that begins.
function passStop(understood, meant, best, session) {
  const stop = stopAt();
  const name = nameOf(state.tour.at);
  // Nobody knows whether it was right where nobody said a word.
  const earned = understood && (stop.test || session.intended !== null || state.evidence.some(evidence => evidence.feedback !== 'neutral'));
  state.tour.done[state.tour.at] = earned ? 'right' : 'wrong';
  const { said } = state;
  enterStop(state.tour.at + 1);
  state.said = said;
  if (!stop.test) state.verdict = name + (earned ? ': understood at once. ★' : ': learned.');
  else if (understood) state.verdict = name + ': understood. ★ It thought “' + best.words + '”, and was ' + percent(best.probability) + ' sure.';
  else if (meant) state.verdict = name + ': a lucky guess. It thought “' + best.words + '”, but was only ' + percent(best.probability) + ' sure: that does not count.';
  else state.verdict = name + ': not understood. It thought “' + best.words + '” (' + percent(best.probability) + ' sure).';
  if (stop.test) state.said = null;
  announce(state.verdict);
  if (state.tour.watching && stopAt()) setTimeout(() => { if (state.tour.watching && !state.session) beginStop(true); }, state.settings.speed === 'once' ? 0 : 900);
  else {
    state.tour.watching = false;
    if (!stopAt()) announce('The tour is over. ' + scoreWords());
    render();
    if (!state.settings.speed.startsWith('once')) $(stopAt() ? 'lesson' : 'onward').focus({ preventScroll: true });
  }
  render();
}

const nameOf = at => (at < course.lessons.length ? 'Lesson ' + (at + 1) : 'Test ' + (at - course.lessons.length + 1));
const rightTests = () => course.tests.filter((_, at) => state.tour.done[course.lessons.length + at] === 'right').length;
const scoreWords = () => rightTests() + ' of ' + course.tests.length + ' tests understood';

/** Shows the whole tour, with a robot that is only shown: one's own waits. */
export async function watchTour() {
  if (state.tour.watching) {
    state.tour.watching = false;
    stopSession();
    await endGuest();
    return;
  }
  if (!await leaveSession()) return;
  await beginGuest('A shown robot');
  enterStop(0);
  state.tour.watching = true;
  beginStop(true);
}

/** The tour from the beginning, with one more robot. */
export async function restartTour() {
  if (!await leaveSession()) return;
  await newRobot();
  enterStop(0);
}

export function renderTour() {
  const { at, done, watching } = state.tour;
  const all = stops();
  const stop = all[at];
  const lessons = course.lessons.length;
  $('tour').hidden = state.mode !== 'tour';
  if (state.mode !== 'tour') return;
  $('dots').replaceChildren(...all.map((each, index) => {
    const status = done[index] ? (done[index] === 'right' ? 'understood at once' : each.test ? 'not understood' : 'learned') : index === at ? 'now' : 'to come';
    const name = (each.test ? 'Test ' + (index - lessons + 1) : 'Lesson ' + (index + 1)) + ': ' + status;
    return make('li', {}, make('button', {
      type: 'button', class: [each.test ? 'test' : 'lesson', index === at ? 'now' : '', done[index] || ''].join(' '), 'aria-current': index === at ? 'step' : null, title: name, 'aria-label': name, onclick: () => jumpTo(index),
    }, done[index] === 'right' ? '★' : done[index] ? (each.test ? '✗' : '✓') : each.test ? '?' : index + 1));
  }));
  $('score').textContent = stop && done.length > lessons ? scoreWords() : '';
  if (!stop) {
    $('tour-title').textContent = 'The tour is over: ' + scoreWords() + '.';
    $('tour-hint').textContent = rightTests() === course.tests.length ? 'Your robot understands commands that it has never heard. Now say what you like, in the free play.'
      : 'Some words are still unclear to it. Train on in the free play, or begin the tour again.';
  } else {
    const name = stop.test ? 'Test ' + (at - lessons + 1) + ' of ' + course.tests.length : 'Lesson ' + (at + 1) + ' of ' + lessons;
    $('tour-title').replaceChildren(...(state.session ? [name + ': “', ...heardWords(state.session.command), '”'] : [name]));
    $('tour-hint').textContent = stop.test ? 'It has never heard this command. It gets no feedback now: does it understand?' : HINTS[at];
  }
  $('verdict').hidden = !state.verdict || Boolean(state.session);
  $('verdict').textContent = state.verdict;
  renderCard(!stop);
  $('lesson').hidden = !stop || watching || Boolean(state.session);
  $('lesson').textContent = stop ? (stop.test ? 'Ask: “' : 'Tell it: “') + stop.command + '”' : '';
  $('onward').hidden = Boolean(stop) || watching;
  $('auto').hidden = !stop || stop.test || watching || Boolean(state.session);
  $('watch').hidden = Boolean(state.session) && !watching;
  $('watch').textContent = watching ? 'Stop watching' : 'Watch the whole tour';
  $('again').hidden = watching || Boolean(state.session) || (at === 0 && !done.length) || state.robot.log !== undefined;
}

// The end of the tour: what the robot knows, and a picture of it to keep.
function renderCard(over) {
  $('card').hidden = !over;
  if (!over) return;
  const known = [...meanings(state.heat.now)];
  $('card').replaceChildren(
    make('p', {}, 'It knows ' + known.length + ' words well: '),
    make('ul', {}, ...known.map(([word, token]) => make('li', {}, make('b', {}, word), ' ' + ideaWords(token)))),
    make('button', { type: 'button', class: 'small', onclick: () => download('my-robot.svg', picture(state.robot.name, scoreWords(), known), 'image/svg+xml') }, 'Save this as a picture'));
}
