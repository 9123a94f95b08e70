// The tables of a class, each of one robot, as one table and one plot.
import { chart } from './charts.js';
import { listed, percent, t } from './language.js';
import { $, make, tell } from './state.js';
import { readsPhotos, rowsOf, rowsOn, saveRows } from './tables.js';

/** @type {Record<string, string>[]} */
let all = [];

const mean = numbers => (numbers.length ? numbers.reduce((sum, one) => sum + one, 0) / numbers.length : null);

/** What a table says of its robot.
 * @param {Record<string, string>[]} rows */
function summary(rows) {
  // The first row of each session has what is true of the whole session.
  const sessions = rows.filter((row, at) => row.session !== rows[at - 1]?.session);
  const tests = sessions.filter(({ kind }) => kind === 'test');
  const guesses = tests.filter(({ guess }) => guess);
  const of = (part, whole) => (whole.length ? part.length + ' / ' + whole.length : '–');
  const sure = mean(tests.map(({ heard }) => Number(heard)));
  return {
    line: sessions.map(({ heard }) => (heard === '' ? null : Number(heard))),
    cells: [rows[0].robot, rows[0].condition, sessions.length - tests.length, rows.filter(({ feedback }) => /^[rp]/.test(feedback)).length,
      of(tests.filter(({ right }) => right === 'yes'), tests), sure === null ? '–' : percent(sure), of(guesses.filter(({ guess, right }) => guess === right), guesses)],
  };
}

/** Opens the tables of a class.
 * @param {File[]} files */
async function collect(files) {
  // What no browser can read as a photo has no table, like any other file.
  const read = await Promise.all(files.map(async file => ({ name: file.name, found: file.type.startsWith('image/') ? await rowsOn(file).catch(() => []) : [rowsOf(await file.text())] })));
  const tablesOf = ({ found }) => found.flatMap(rows => (rows?.length ? [rows] : []));
  const other = read.filter(one => !tablesOf(one).length).map(({ name }) => name);
  if (other.length) tell(t('class.other', { names: listed(other) }), true);
  const tables = read.flatMap(tablesOf);
  if (!tables.length) return;
  all = tables.flat();
  const robots = tables.map(summary);
  const lines = robots.map(({ line }) => line);
  const average = Array.from({ length: Math.max(...lines.map(line => line.length)) }, (_, at) => mean(lines.map(line => line[at] ?? null).filter(one => one !== null)));
  chart('class-chart', [...lines, average], t('charts.score') + ': ' + average.map(p => (p === null ? '–' : percent(p))).join(', '), at => (at < lines.length ? 'each' : 'line0'));
  $('class-table').replaceChildren(
    make('thead', {}, make('tr', {}, ...t('class.columns').split('|').map(words => make('th', { scope: 'col' }, words)))),
    make('tbody', {}, ...robots.map(({ cells: [name, ...cells] }) => make('tr', {}, make('th', { scope: 'row' }, make('bdi', {}, name)), ...cells.map(one => make('td', {}, one))))));
  $('class').showModal();
}

export function setUpCollector() {
  if (readsPhotos) $('open-class').accept += ',image/*';
  $('open-class').addEventListener('change', async () => {
    const files = [...$('open-class').files];
    $('open-class').value = '';
    await collect(files);
  });
  $('save-class').addEventListener('click', () => saveRows('class.csv', all));
  $('close-class').addEventListener('click', () => $('class').close());
}
