// What the robot thinks: the tasks' probabilities, the evidence, the words, the dictionary, the trainer's style.
import { $, all, make, percent, state } from './state.js';
import { acted, ranked, tokenWords, wordShown } from './words.js';

const SHOWN_TASKS = 8;

export function renderThoughts() {
  const nothing = state.sessions === 0 && !state.session;
  $('how').hidden = !nothing;
  for (const card of all('.learned')) card.hidden = nothing;
  renderBars();
  renderEvidence();
  renderSupport();
  renderHeat();
  renderStyle();
}

const MARKS = { 'right reward': ['▲', 'for'], 'wrong reward': ['▼', 'against'], 'right punish': ['▼', 'against'], 'wrong punish': ['▲', 'for'] };
const markOf = (evidence, task) => MARKS[evidence.judgements[task] + ' ' + evidence.feedback] || ['·', 'silent on'];

function renderBars() {
  const tasks = ranked();
  const session = state.session;
  $('sure').textContent = session && session.decided
    ? 'It just ' + acted(session.decided.action) + '.' + (state.settings.speed === 'confidence' ? ' Sure of this step, whichever room you mean: ' + percent(session.decided.confidence) + '.' : '')
    : session?.question ? 'It waits for your answer.' : session ? 'It is making a plan …' : 'Tell it something, and its guesses appear here.';
  $('bars').replaceChildren(...tasks.slice(0, SHOWN_TASKS).map((task, rank) => {
    const marks = state.evidence.slice(-12).map(evidence => markOf(evidence, task.index));
    const row = make('li', { class: rank === 0 ? 'best' : '' },
      make('span', { class: 'label' }, task.words),
      make('span', { class: 'value' }, percent(task.probability)),
      make('span', { class: 'track', 'aria-hidden': 'true' }, make('span', { class: 'bar', style: 'width:' + (task.probability * 100).toFixed(1) + '%' })));
    if (marks.length) {
      const count = kind => marks.filter(mark => mark[1] === kind).length;
      row.append(make('span', { class: 'marks', 'aria-hidden': 'true' }, ...marks.map(([sign, kind]) => make('i', { class: kind.slice(0, 3) }, sign))),
        make('span', { class: 'hidden' }, '; last steps: ' + count('for') + ' for it, ' + count('against') + ' against'));
    }
    return row;
  }));
  $('marks').hidden = !tasks.length || !state.evidence.length;
  const rest = tasks.length - SHOWN_TASKS;
  $('rest').textContent = rest > 0 ? 'and ' + rest + ' more, together ' + percent(tasks.slice(SHOWN_TASKS).reduce((sum, task) => sum + task.probability, 0)) : '';
}

const FEEDBACK_WORDS = { reward: 'Good', punish: 'Bad', neutral: '—' };

function renderEvidence() {
  const best = ranked()[0];
  $('steps').replaceChildren(...state.evidence.map((evidence, step) => make('tr', { class: evidence.feedback },
    make('td', {}, step + 1), make('td', {}, acted(evidence.action)), make('td', {}, FEEDBACK_WORDS[evidence.feedback]),
    make('td', {}, best && best.index in evidence.before ? percent(evidence.before[best.index]) + ' → ' + percent(evidence.after[best.index]) : ''))).reverse());
  $('steps-about').textContent = state.evidence.length && best ? 'Last column: how probable “' + best.words + '” was before and after.' : 'Nothing has been judged yet.';
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
  $('support-about').textContent = !known.length ? 'After a command, this shows which word spoke for which task.'
    : state.sessions === 0 ? 'It has learned no word yet, so no word speaks for any task.'
      : 'Each word’s hundred points, shared among the tasks (the five most likely).';
  if (!support || $('support').hidden) return;
  const shares = support.tasks.flat();
  const [weakest, strongest] = [Math.min(...shares), Math.max(...shares)];
  $('support').replaceChildren(
    make('thead', {}, make('tr', {}, make('th', { scope: 'col' }, 'task'), ...support.words.map(word => make('th', { scope: 'col' }, make('span', {}, word))))),
    make('tbody', {}, ...known.map(task => make('tr', {}, make('th', { scope: 'row' }, task.words),
      ...support.words.map((word, at) => cell(support.tasks[at][task.index], weakest, strongest, word + ', ' + task.words))))));
}

export function renderHeat() {
  // The table may be large: it is drawn when it is seen.
  if (!$('heat').closest('details').open) return;
  const older = state.heat.before;
  $('heat-before').disabled = !older || older.words.length === 0;
  const before = $('heat-before').checked && !$('heat-before').disabled;
  const heat = before ? older : state.heat.now;
  const empty = !heat || heat.words.length === 0;
  $('heat').hidden = empty;
  $('heat-about').textContent = empty ? 'It has learned no word yet. After the first session, its dictionary appears here.'
    : 'How many times in a hundred it expects a word (column) for an idea (row), ' + (before ? 'before' : 'after') + ' the last session.';
  if (empty) return;
  const strongest = Math.max(...heat.cells);
  const words = heat.words.map(word => wordShown(word, heat.letters));
  $('heat').replaceChildren(
    make('thead', {}, make('tr', {}, make('th', { scope: 'col' }, 'idea'), ...words.map(word => make('th', { scope: 'col' }, make('span', {}, word))))),
    make('tbody', {}, ...heat.tokens.map((token, row) => make('tr', {}, make('th', { scope: 'row' }, tokenWords(token)),
      ...heat.words.map((_, column) => cell(heat.cells[row * heat.words.length + column], 0, strongest, words[column] + ', given ' + tokenWords(token)))))));
}


function renderStyle() {
  const { learned, good, bad, mistakes, late } = state.belief.trainer;
  $('style-about').textContent = learned ? 'What it believes of you as a trainer. It began with what other people do.'
    : 'It takes you to say Good and Bad alike, and to be silent seven times in ten. In the settings it can learn your style instead.';
  const shares = [['you say something to a right step', good], ['you say something to a wrong step', bad], ['you take a step for the wrong kind', mistakes], ['your word is for a step before the last one', late]];
  $('style').replaceChildren(...(learned ? shares : []).map(([words, share]) => make('li', {},
    make('span', { class: 'label' }, words), make('span', { class: 'value' }, percent(share)),
    make('span', { class: 'track', 'aria-hidden': 'true' }, make('span', { class: 'bar', style: 'width:' + (Number(share) * 100).toFixed(1) + '%' })))));
}
