// The robot's thoughts: the tasks' probabilities, the evidence, the words, the dictionary, the trainer's style.
import { renderCharts } from './charts.js';
import { world } from './core.js';
import { percent, t } from './language.js';
import { asWritten, ideaWords } from './learned.js';
import { $, all, isDrawn, make, state } from './state.js';
import { isShown } from './tabs.js';
import { acted, ranked, wordShown } from './words.js';

const SHOWN_TASKS = 8;

export function renderThoughts() {
  const nothing = state.sessions === 0 && !state.session;
  $('how').hidden = !nothing;
  for (const card of all('.learned')) card.hidden = nothing;
  renderBars();
  renderPick();
  renderEvidence();
  renderSupport();
  renderHeat();
  renderCharts();
  renderStyle();
}

const MARKS = { 'right reward': ['▲', 'for'], 'wrong reward': ['▼', 'against'], 'right punish': ['▼', 'against'], 'wrong punish': ['▲', 'for'] };
const markOf = (evidence, task) => MARKS[evidence.judgements[task] + ' ' + evidence.feedback] || ['·', 'silent on'];

function renderBars() {
  const tasks = ranked();
  const session = state.session;
  $('sure').textContent = session && session.decided
    ? t('thoughts.just', { did: acted(session.decided.action) }) + (state.settings.speed === 'confidence' ? ' ' + t('thoughts.stepSure', { sure: percent(session.decided.confidence) }) : '')
    : session?.question ? t('thoughts.asking') : session ? t('thoughts.planning') : t('thoughts.nothing');
  $('bars').replaceChildren(...tasks.slice(0, SHOWN_TASKS).map((task, rank) => {
    const marks = state.evidence.slice(-12).map(evidence => markOf(evidence, task.index));
    const row = make('li', { class: rank === 0 ? 'best' : '' },
      make('span', { class: 'label' }, task.words),
      make('span', { class: 'value' }, percent(task.probability)),
      make('span', { class: 'track', 'aria-hidden': 'true' }, make('span', { class: 'bar', style: 'width:' + (task.probability * 100).toFixed(1) + '%' })));
    if (marks.length) {
      const count = kind => marks.filter(mark => mark[1] === kind).length;
      row.append(make('span', { class: 'marks', 'aria-hidden': 'true' }, ...marks.map(([sign, kind]) => make('i', { class: kind.slice(0, 3) }, sign))),
        make('span', { class: 'hidden' }, t('thoughts.last', { for: count('for'), against: count('against') })));
    }
    return row;
  }));
  $('marks').hidden = !tasks.length || !state.evidence.length;
  const rest = tasks.length - SHOWN_TASKS;
  $('rest').textContent = rest > 0 ? t('thoughts.rest', { n: rest, sure: percent(tasks.slice(SHOWN_TASKS).reduce((sum, task) => sum + task.probability, 0)) }) : '';
}

// The list of all tasks that the command may mean, to pick from.
function renderPick() {
  const { session } = state;
  $('pick').closest('.field').hidden = !session || session.looking || session.intended !== null || (state.mode === 'tour' && !world.ways());
  if (isDrawn('pick', session?.began)) return;
  $('pick').replaceChildren(make('option', { value: '' }, '…'), ...state.belief.tasks.map(({ name, words }) => make('option', { value: name }, words)));
}

export const feedbackWord = feedback => (feedback === 'reward' ? t('train.good') : feedback === 'punish' ? t('train.bad') : '—');

function renderEvidence() {
  const best = ranked()[0];
  $('steps').replaceChildren(...state.evidence.map((evidence, step) => make('tr', { class: evidence.feedback },
    make('td', {}, step + 1), make('td', {}, acted(evidence.action)), make('td', {}, feedbackWord(evidence.feedback)),
    make('td', {}, best && best.index in evidence.before ? percent(evidence.before[best.index]) + ' → ' + percent(evidence.after[best.index]) : ''))).reverse());
  $('steps-about').textContent = state.evidence.length && best ? t('steps.about', { task: best.words }) : t('steps.none');
}

function cell(value, weakest, strongest, title) {
  const strength = strongest > weakest ? (value - weakest) / (strongest - weakest) : 0;
  // The middle tones are left out: neither dark nor light letters can be read on them.
  const hot = strength > 0.5;
  return make('td', { style: '--heat:' + (hot ? 44 + 56 * strength : 70 * strength).toFixed(0) + '%', class: hot ? 'hot' : '', title }, Math.round(value * 100));
}

function renderSupport() {
  const { support } = state;
  const known = support && state.belief.tasks.length ? ranked().slice(0, 5) : [];
  $('support').hidden = known.length === 0 || state.sessions === 0;
  $('support-about').textContent = t(!known.length ? 'support.before' : state.sessions === 0 ? 'support.none' : 'support.about');
  if (!support || $('support').hidden) return;
  const shares = support.tasks.flat();
  const [weakest, strongest] = [Math.min(...shares), Math.max(...shares)];
  $('support').replaceChildren(
    make('thead', {}, make('tr', {}, make('th', { scope: 'col' }, t('support.task')), ...support.words.map(word => make('th', { scope: 'col' }, make('span', {}, asWritten(word)))))),
    make('tbody', {}, ...known.map(task => make('tr', {}, make('th', { scope: 'row' }, task.words),
      ...support.words.map((word, at) => cell(support.tasks[at][task.index], weakest, strongest, word + ', ' + task.words))))));
}

export function renderHeat() {
  // The table may be large: it is drawn only when it is visible.
  if (!isShown('words')) return;
  const older = state.heat.before;
  $('heat-before').disabled = !older || older.words.length === 0;
  const before = $('heat-before').checked && !$('heat-before').disabled;
  const heat = before ? older : state.heat.now;
  const empty = !heat || heat.words.length === 0;
  $('heat').hidden = empty;
  $('heat-about').textContent = t(empty ? 'heat.none' : before ? 'heat.aboutBefore' : 'heat.aboutAfter');
  if (empty) return;
  const strongest = Math.max(...heat.cells);
  const words = heat.words.map(word => wordShown(asWritten(word), heat.letters));
  $('heat').replaceChildren(
    make('thead', {}, make('tr', {}, make('th', { scope: 'col' }, t('heat.idea')), ...words.map(word => make('th', { scope: 'col' }, make('span', {}, word))))),
    make('tbody', {}, ...heat.tokens.map((token, row) => make('tr', {}, make('th', { scope: 'row' }, ideaWords(token)),
      ...heat.words.map((_, column) => cell(heat.cells[row * heat.words.length + column], 0, strongest, t('heat.cell', { word: words[column], idea: ideaWords(token) })))))));
}

function renderStyle() {
  const { learned, good, bad, mistakes, late } = state.belief.trainer;
  $('style-about').textContent = t(learned ? 'style.learned' : 'style.fixed');
  const shares = [[t('style.good'), good], [t('style.bad'), bad], [t('style.mistakes'), mistakes], [t('style.late'), late]];
  $('style').replaceChildren(...shares.map(([words, share]) => make('li', {},
    make('span', { class: 'label' }, words), make('span', { class: 'value' }, percent(share)),
    make('span', { class: 'track', 'aria-hidden': 'true' }, make('span', { class: 'bar', style: 'width:' + (Number(share) * 100).toFixed(1) + '%' })))));
}
