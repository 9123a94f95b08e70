// Charts: the robot's belief, step by step, and how sure it was of each command when it heard it, session by session; and both as a table.
import { download } from './files.js';
import { percent, t } from './language.js';
import { sessionLink } from './link.js';
import { share } from './share.js';
import { $, draw, make, state, tell } from './state.js';
import { logOf } from './store.js';
import { isShown } from './tabs.js';
import { ranked } from './words.js';

const [WIDTH, HEIGHT, LEFT, EDGE] = [320, 132, 34, 8];
const SHOWN = 3;

/** Draws lines of probabilities, each in its own style; unknown points are left out.
 * @param {string} id
 * @param {(number | null)[][]} lines
 * @param {string} about */
function chart(id, lines, about) {
  const most = Math.max(1, ...lines.map(line => line.length - 1));
  const x = at => LEFT + at / most * (WIDTH - LEFT - EDGE);
  const y = p => EDGE + (1 - p) * (HEIGHT - 2 * EDGE);
  $(id).setAttribute('viewBox', '0 0 ' + WIDTH + ' ' + HEIGHT);
  $(id).setAttribute('aria-label', about);
  $(id).replaceChildren(
    ...[0, 0.5, 1].flatMap(p => [
      draw('path', { class: 'grid', d: 'M' + LEFT + ' ' + y(p) + 'H' + (WIDTH - EDGE) }),
      draw('text', { x: LEFT - 4, y: y(p) + 4, 'text-anchor': 'end' }, String(100 * p)),
    ]),
    ...lines.map((line, style) => {
      const points = line.flatMap((p, at) => (p === null ? [] : [x(at).toFixed(1) + ' ' + y(p).toFixed(1)]));
      return draw('path', { class: 'line' + style, d: points.length ? 'M' + points.join('L') + (points.length === 1 ? 'h.1' : '') : '' });
    }));
}

// The probability of a task in the current or the last session: before the first step, after each step, and now, since an answer may have
// come after the last step.
const beliefs = task => [state.evidence[0]?.before[task] ?? null, ...state.evidence.map(evidence => evidence.after[task] ?? null), ...(state.session ? [state.belief.tasks[task].probability] : [])];

// For each session that this robot has learned from, how sure it was of the taught task when it heard the command.
const scores = () => Array.from({ length: state.sessions }, (_, at) => state.robot.scores?.[at] ?? null);

export function renderCharts() {
  if (!isShown('steps')) return;
  const tasks = state.evidence.length ? ranked().slice(0, SHOWN) : [];
  $('chart-belief').toggleAttribute('hidden', !tasks.length);
  $('charts-none').hidden = Boolean(tasks.length);
  const last = tasks.map(task => task.words + ' ' + percent(task.probability));
  chart('chart-belief', tasks.map(task => beliefs(task.index)), t('charts.belief') + ': ' + last.join('; '));
  $('chart-tasks').replaceChildren(...tasks.map((task, style) => make('li', { class: 'line' + style }, last[style])));
  const all = scores();
  chart('chart-score', [all], t('charts.score') + ': ' + all.map(p => (p === null ? '–' : percent(p))).join(', '));
}

// The paper that the robot implements.
const CITATION = 'MacGlashan et al. (2014): Training an Agent to Ground Commands with Reward and Punishment';

// A program for tables takes a text that begins like a formula for one, and a formula can read files; an apostrophe says that it is text.
const cell = value => {
  const text = typeof value === 'string' && /^[=+\-@\t\r]/.test(value) ? "'" + value : String(value);
  return /[",\r\n]/.test(text) ? '"' + text.replaceAll('"', '""') + '"' : text;
};

/** The sessions of this robot's log as a table: a line for each step. */
export function saveTable() {
  /** @type {unknown[][]} */
  const rows = [['session', 'command', 'heard', 'step', 'action', 'feedback', 'seed', 'version', 'citation', 'condition', 'consent']];
  const about = () => [state.robot.seeds?.[learned] ?? '', 'goodbot ' + GOODBOT_VERSION, CITATION, state.robot.study?.id ?? '', state.robot.study?.consent ?? ''];
  let [session, step, command, learned] = [0, 0, '', 0];
  for (const line of logOf(state.robot).split('\n').filter(Boolean)) {
    const record = JSON.parse(line);
    if (record.type === 'session') [session, step, command] = [session + 1, 0, record.command];
    if (record.type === 'step') rows.push([session, command, scores()[learned] ?? '', step += 1, record.action, record.feedback ?? '', ...about()]);
    // A session that was ended before its first step is one, too.
    if (record.type === 'end' && !step) rows.push([session, command, scores()[learned] ?? '', '', '', '', ...about()]);
    if (record.type === 'end' && record.learn) learned += 1;
  }
  if (rows.length === 1) tell(t('settings.noLog'));
  else download('goodbot.csv', rows.map(row => row.map(cell).join(',') + '\r\n').join(''), 'text/csv');
}

/** Offers the last session as a link. */
export async function shareSession() {
  const link = await sessionLink();
  if (link) share(link, t('session.share'), t('session.link'));
  else tell(t('settings.noLog'));
}
