// The user's own tests of the robot: commands, each with its meaning. It never learns from them. They are kept with it, and can be saved as
// labelled sessions of a log, which `goodbot evaluate --test` reads.
import { attempt, parsed, world } from './core.js';
import { download, readFile } from './files.js';
import { percent, t } from './language.js';
import { recordOf } from './logs.js';
import { $, inParts, isDrawn, make, render, state, tell } from './state.js';
import { patch } from './store.js';
import { isShown } from './tabs.js';
import { askedIn, likeliest, sceneOf, spaced, taskWords, understands } from './words.js';

/** @typedef {{ home: object, command: string, meant: string }} OwnTest */

/** @returns {OwnTest[]} */
const tests = () => state.robot.tests || [];

const keep = all => patch(state.robot, { tests: all });

// The result of each test; valid until the robot learns something.
let results = { of: '', verdicts: /** @type {string[]} */ ([]), right: 0 };
const knowledge = () => JSON.stringify([state.robot.id, state.robot.model, world.starter(), tests(), document.documentElement.lang]);

const idle = () => !state.session && state.phase === 'none';

// Tests one command after the other, until something else begins.
async function run() {
  const of = knowledge();
  const verdicts = [];
  /** @type {import('./store.js').Asked[]} */
  const asked = [];
  let right = 0;
  await inParts(() => {
    const test = tests()[verdicts.length];
    if (!test || !idle()) return true;
    const tasks = askedIn(test.home, test.command);
    const best = likeliest(tasks);
    const understood = understands(best, test.meant);
    right += Number(understood);
    asked.push({ after: state.sessions, ...test, heard: tasks.find(({ name }) => name === test.meant)?.probability ?? 0, understood: best.name, right: understood ? 'yes' : 'no', guess: '' });
    verdicts.push(t(understood ? 'tour.starTest' : best.name === test.meant ? 'tour.luckyTest' : 'tour.wrongTest', {
      name: t('tour.test', { n: verdicts.length + 1 }), task: taskWords(best.name, sceneOf(test.home)), sure: percent(best.probability),
    }));
    return false;
  });
  if (of !== knowledge() || verdicts.length < tests().length) return;
  results = { of, verdicts, right };
  await patch(state.robot, { asked: [...(state.robot.asked || []), ...asked] });
  render();
  tell($('tests-score').textContent);
}

// Offers all tasks that a command may mean in the home that is shown.
function offer() {
  const home = parsed(world.environment());
  if (isDrawn('meanings', home, world.ways())) return;
  const tasks = attempt(() => askedIn(home, '?a')) || [];
  $('test-meant').replaceChildren(make('option', { value: '' }, '…'), ...tasks.map(({ name }) => make('option', { value: name }, taskWords(name, sceneOf(home)))));
}

export function renderOwnTests() {
  $('test-it').disabled = $('run-tests').disabled = !idle();
  if (!isShown('challenges')) return;
  if (idle()) offer();
  const all = tests();
  const known = results.of === knowledge();
  $('run-tests').hidden = $('save-tests').hidden = !all.length;
  $('tests-score').textContent = known ? t('tour.score', { right: results.right, of: all.length }) : '';
  $('tests').replaceChildren(...all.map((test, at) => make('li', {},
    make('b', {}, test.command), make('span', {}, taskWords(test.meant, sceneOf(test.home))),
    make('button', { type: 'button', class: 'small quiet', 'aria-label': t('robots.deleteOf', { name: test.command }), onclick: () => remove(at) }, t('robots.delete')),
    known ? make('p', {}, results.verdicts[at]) : null)));
}

// Takes a test off the list; its command stays in the field, so that it can be changed and added again.
async function remove(at) {
  const [test] = tests().slice(at);
  await keep(tests().filter((_, index) => index !== at));
  $('test-command').value = test.command;
  render();
  $('test-command').focus();
}

// The tasks of a way, as in a log.
const wayOf = (clause, places) => (clause === 'through' ? { through: [places.split(' or ')] } : { avoiding: places.split(' or ') });

/** @param {OwnTest} test */
function lines({ home, command, meant }) {
  const [goal, clause, places] = meant.split(/ (through|avoiding) /);
  const session = { type: 'session', version: 1, kind: 'labelled', environment: home, command, intended: goal.split(' & '), ...(clause ? wayOf(clause, places) : {}) };
  return [session, { type: 'end', learn: false }].map(line => JSON.stringify(line) + '\n').join('');
}

/** A session of a log as a test; null if its meaning is not given. Throws if the robot cannot be tested by it.
 * @returns {OwnTest | null} */
function asTest({ type, environment: home, command, intended, through, avoiding }) {
  if (type !== 'session' || !intended) return null;
  const meant = intended.join(' & ') + (through ? ' through ' + through[0].join(' or ') : avoiding ? ' avoiding ' + avoiding.join(' or ') : '');
  if (!askedIn(home, command).some(task => task.name === meant)) throw new Error(meant);
  return { home, command, meant };
}

async function load(input) {
  const { content } = await readFile(input, 'text');
  if (!idle()) return;
  const found = [];
  let number = 0;
  try {
    for (const line of content.split('\n')) {
      number += 1;
      const test = line.trim() ? asTest(recordOf(line)) : null;
      if (test) found.push(test);
    }
  } catch (error) {
    tell(t('log.line', { n: number, why: error.message }), true);
    return;
  }
  if (!found.length) tell(t('log.empty'), true);
  await keep([...tests(), ...found]);
  render();
}

export function setUpOwnTests() {
  $('add-test').addEventListener('submit', async event => {
    event.preventDefault();
    const [home, command, meant] = [parsed(world.environment()), spaced($('test-command').value.trim()), $('test-meant').value];
    if (!command || !meant || !idle() || !attempt(() => askedIn(home, command))) return;
    await keep([...tests(), { home, command, meant }]);
    $('test-command').value = '';
    render();
    $('test-command').focus();
  });
  $('run-tests').addEventListener('click', run);
  $('save-tests').addEventListener('click', () => download('tests.jsonl', tests().map(lines).join(''), 'application/jsonl'));
  $('load-tests').addEventListener('change', () => load($('load-tests')));
}
