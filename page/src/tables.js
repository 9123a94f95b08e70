// The record of a robot as a table, and such tables read again.
import { fromAddress, toAddress } from './base64.js';
import { course, parsed } from './core.js';
import { expanded, packed } from './deflate.js';
import { download, fileName } from './files.js';
import { t } from './language.js';
import { share } from './share.js';
import { state, tell } from './state.js';
import { logOf } from './store.js';

// The paper that the robot implements.
const CITATION = 'MacGlashan et al. (2014): Training an Agent to Ground Commands with Reward and Punishment';
const COLUMNS = ['session', 'kind', 'command', 'home', 'meant', 'heard', 'understood', 'right', 'guess', 'step', 'action', 'feedback', 'robot', 'seed', 'version', 'citation', 'condition', 'consent'];

// A program for tables takes a text that begins like a formula for one, and a formula can read files; an apostrophe says that it is text.
const FORMULA = /^[=+\-@\t\r]/;
const cell = value => {
  const text = typeof value === 'string' && FORMULA.test(value) ? "'" + value : String(value ?? '');
  return /[",\r\n]/.test(text) ? '"' + text.replaceAll('"', '""') + '"' : text;
};

/** Rows as text, each with values by the names of columns. Excel takes it for UTF-8 only with its mark at the beginning.
 * @param {Record<string, any>[]} rows */
const asText = rows => '\ufeff' + [COLUMNS, ...rows.map(row => COLUMNS.map(column => row[column]))].map(row => row.map(cell).join(',') + '\r\n').join('');

/** @param {string} name
 * @param {Record<string, any>[]} rows */
export const saveRows = (name, rows) => download(name, asText(rows), 'text/csv');

/** The rows of a table, also of one that a program has written with semicolons; `null` if it is no such table.
 * @param {string} text
 * @returns {Record<string, string>[] | null} */
export function rowsOf(text) {
  const separator = /^[^\r\n]*;/.test(text) ? ';' : ',';
  const lines = [['']];
  let quoted = false;
  for (const sign of text.replace(/^\ufeff/, '')) {
    const line = lines[lines.length - 1];
    if (sign === '"') {
      // Two within quotes are one.
      if (!quoted && line[line.length - 1]) line[line.length - 1] += '"';
      quoted = !quoted;
    } else if (quoted || !(sign === separator || sign === '\n' || sign === '\r')) line[line.length - 1] += sign;
    else if (sign === separator) line.push('');
    else if (sign === '\n') lines.push(['']);
  }
  const [head, ...rest] = lines;
  if (!['session', 'kind', 'heard', 'right', 'robot'].every(column => head.includes(column))) return null;
  const value = (line, at) => (FORMULA.test((line[at] || '').slice(1)) ? line[at].replace(/^'/, '') : line[at] || '');
  return rest.filter(line => line.length > 1).map(line => Object.fromEntries(head.map((column, at) => [column, value(line, at)])));
}

// The course's homes have names. Another home is told once in its session.
const homeOf = home => course.homes.find(([, other]) => JSON.stringify(other) === JSON.stringify(home))?.[0];

/** The lessons and tests of this robot: a row for each step of a lesson, or one for all if it has none; and one for each test. */
function record() {
  const { robot } = state;
  const { scores = [], seeds = [], meant = [], asked = [], study } = robot;
  const always = { robot: robot.name, version: 'goodbot ' + GOODBOT_VERSION, citation: CITATION, condition: study?.id, consent: study?.consent };
  /** @type {Record<string, any>[]} */
  const rows = [];
  const waiting = [...asked];
  let [session, step, learned] = [0, 0, 0];
  /** @type {any} */
  let about = {};
  const tests = lessons => {
    while (waiting.length && waiting[0].after <= lessons) {
      const { after, home, ...test } = /** @type {import('./store.js').Asked} */ (waiting.shift());
      rows.push({ ...always, session: session += 1, kind: 'test', home: homeOf(home) ?? JSON.stringify(home), ...test });
    }
  };
  tests(0);
  for (const line of logOf(robot).split('\n').filter(Boolean)) {
    const { type, command, environment, action, feedback, learn } = parsed(line);
    const add = more => {
      rows.push({ ...always, session, kind: 'lesson', ...about, heard: scores[learned], meant: meant[learned], seed: seeds[learned], ...more });
      if (about.home?.startsWith('{')) about.home = '';
    };
    if (type === 'session') [session, step, about] = [session + 1, 0, { command, home: homeOf(environment) ?? JSON.stringify(environment) }];
    if (type === 'step') add({ step: step += 1, action, feedback });
    // A session that was ended before its first step is one, too.
    if (type === 'end' && !step) add({});
    if (type === 'end' && learn) tests(learned += 1);
  }
  tests(Infinity);
  return rows;
}

/** Saves what has been taught and asked, as a table. */
export function saveTable() {
  const rows = record();
  if (rows.length) saveRows(fileName() + '.csv', rows);
  else tell(t('settings.noLog'));
}

const CODE = 'goodbot-table:';

/** Shows that table as a QR code. */
export async function showTable() {
  const rows = record();
  if (rows.length) share(CODE + toAddress(await packed(new TextEncoder().encode(asText(rows)))), t('charts.code'), t('class.photo'), true);
  else tell(t('settings.noLog'));
}

// TypeScript does not know this part of browsers, and Firefox does not have it.
/** @type {any} */
const { BarcodeDetector } = /** @type {any} */ (window);

export const readsPhotos = Boolean(BarcodeDetector);

/** The rows of the tables whose codes are on a photo, without those of damaged codes.
 * @param {Blob} photo */
export async function rowsOn(photo) {
  const codes = await new BarcodeDetector({ formats: ['qr_code'] }).detect(await createImageBitmap(photo));
  const texts = codes.map(({ rawValue }) => rawValue).filter(text => text.startsWith(CODE));
  const all = await Promise.allSettled(texts.map(async text => rowsOf(new TextDecoder().decode(await expanded(fromAddress(text.slice(CODE.length)))))));
  return all.flatMap(one => (one.status === 'fulfilled' ? [one.value] : []));
}
