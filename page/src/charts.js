// Charts: the robot's belief, step by step, and how sure it was of each command when it heard it, session by session.
import { percent, t } from './language.js';
import { sessionLink } from './link.js';
import { share } from './share.js';
import { $, draw, make, state, tell } from './state.js';
import { isShown } from './tabs.js';
import { ranked } from './words.js';

const [WIDTH, HEIGHT, LEFT, EDGE] = [320, 132, 34, 8];
const SHOWN = 3;

/** Draws lines of probabilities, each in its own style; unknown points are left out.
 * @param {string} id
 * @param {(number | null)[][]} lines
 * @param {string} about
 * @param {(at: number) => string} style the class of a line */
export function chart(id, lines, about, style = at => 'line' + at) {
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
    ...lines.map((line, at) => {
      const points = line.flatMap((p, step) => (p === null ? [] : [x(step).toFixed(1) + ' ' + y(p).toFixed(1)]));
      return draw('path', { class: style(at), d: points.length ? 'M' + points.join('L') + (points.length === 1 ? 'h.1' : '') : '' });
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

/** Offers the last session as a link. */
export async function shareSession() {
  const link = await sessionLink();
  if (link) share(link, t('session.share'), t('session.link'));
  else tell(t('settings.noLog'));
}
