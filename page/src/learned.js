// The robot's dictionary in words: the meaning of each word.
import { parsed, world } from './core.js';
import { listed, named, t } from './language.js';
import { inParts, make, state } from './state.js';
import { logOf } from './store.js';
import { beliefNow, colorWords, quoted, shapeWords, unspaced } from './words.js';

// A word means an idea if its probability for the idea is at least this, and this many times its probability for the next idea, and for
// no idea at all: a word such as “the”, which is in every command, is as probable without any idea.
const OFTEN = 0.3;
const AHEAD = 2;

/** The words with a clear meaning, each with its idea.
 * @param {import('./state.js').Heat | null} heat
 * @returns {Map<string, string>} */
export function meanings(heat) {
  const found = new Map();
  if (!heat) return found;
  heat.words.forEach((word, column) => {
    const ranked = heat.tokens.map((token, row) => ({ token, value: heat.cells[row * heat.words.length + column] })).sort((a, b) => b.value - a.value);
    const [best, next] = ranked;
    if (best && best.value >= OFTEN && best.value >= AHEAD * Math.max(next?.value || 0, heat.idle[column])) found.set(word, best.token);
  });
  return found;
}

/** A word: letters, marks, digits and apostrophes. */
export const WORD = /[\p{L}\p{M}\p{N}'’]+/gu;
let [written, writtenIn] = [/** @type {Map<string, string>} */ (new Map()), ''];

/** A word as it was written in a command. The robot keeps only small letters, but German nouns have a capital. The first word of a command is left
 * out, because its capital says nothing.
 * @param {string} word */
export function asWritten(word) {
  const key = [state.robot.id, state.robot.changed].join();
  const wordsOf = command => (command?.match(WORD) || []).slice(1);
  if (writtenIn !== key) {
    writtenIn = key;
    written = new Map();
    for (const [, json] of logOf(state.robot).matchAll(/"command":("(?:[^"\\]|\\.)*")/g)) for (const one of wordsOf(parsed(json))) written.set(one.toLowerCase(), one);
  }
  return wordsOf(state.session?.command).findLast(one => one.toLowerCase() === word) || written.get(word) || word;
}

/** The words with a clear meaning, as they were written, each with its idea.
 * @returns {[string, string][]} */
export const clearWords = () => [...meanings(state.heat.now)].map(([word, token]) => [asWritten(word), token]);

// roomIsGreen becomes “room is green”: names of ideas that the page has no words for.
const tokenWords = token => token.replace(/([A-Z])/g, ' $1').toLowerCase();

/** An idea in a person's words.
 * @param {string} token */
export function ideaWords(token) {
  const [, kind, value] = token.match(/^(color|shape)(.+)$/) || [];
  if (kind === 'color') return t('idea.color', { 0: colorWords(value.toLowerCase()) });
  if (kind === 'shape') return t('idea.shape', { 0: shapeWords(value.toLowerCase()) });
  // A kind of task with a way: agentInRoom01!agentInRoom02 avoids, > goes through.
  const [, goal, way] = token.match(/^([a-z]+)\d+(\D.*)$/i) || [];
  if (way) return t('idea.way', { goal: named('idea.' + goal), way: t(way[0] === '!' ? 'ask.way.avoiding' : way.split('>').length > 2 ? 'ask.way.either' : 'ask.way.through') });
  return named('idea.' + token) || tokenWords(token);
}

/** The meaning of a word, unless the word is its own meaning: a chair is a chair.
 * @param {string} word
 * @param {string} token */
export function meaning(word, token) {
  const idea = ideaWords(token);
  return idea === t('idea.shape', { 0: word }) ? '' : ' = ' + idea;
}

/** The effect of the last session, as a sentence: the words that became clear, or else the new words.
 * @param {string[]} heardNew the words of the command that were new */
export function lessonLearned(heardNew) {
  const [before, now] = [meanings(state.heat.before), meanings(state.heat.now)];
  const clear = [...now].filter(([word, token]) => before.get(word) !== token);
  if (clear.length) return t('learned.nowKnown', { list: listed(clear.map(([word, token]) => (meaning(asWritten(word), token) ? t('learned.means', { word: asWritten(word), idea: ideaWords(token) }) : quoted(asWritten(word))))) });
  if (heardNew.length) return t('learned.newWords', { words: listed(heardNew.map(asWritten)) });
  return now.size ? t('learned.surer', { words: listed([...now.keys()].map(asWritten)) }) : t('learned.onceMore');
}

/** Whether the robot knows any word. */
export const knowsWords = () => state.sessions > 0 || Boolean(world.starter());

/** The words of the command under way that the robot has not learned from. */
export const unknownWords = () => (state.support && knowsWords() ? [...new Set(state.support.words.filter((_, at) => !state.support?.known[at]))] : []);

/** A command, with unknown words underlined. The robot's words are its own: in a script without spaces, hardly more than single signs.
 * @param {string} command */
export function heardWords(command) {
  const unknown = new Set(unknownWords());
  const words = [...new Set(state.support?.words)].sort((a, b) => b.length - a.length);
  const inSpaced = unspaced(command) === command;
  const underlined = word => (unknown.has(word.toLowerCase()) ? make('u', { title: t('unknownWord') }, word) : word);
  return command.split(/([^\p{L}\p{M}\p{N}'’]+)/u).flatMap(part => {
    if (inSpaced || unknown.has(part.toLowerCase())) return [underlined(part)];
    const parts = [];
    for (let rest = part.trim(); rest;) {
      const word = words.find(one => rest.toLowerCase().startsWith(one)) ?? [...rest][0];
      parts.push(underlined(rest.slice(0, word.length)));
      rest = rest.slice(word.length);
    }
    return parts;
  });
}

const hasWay = task => / (through|avoiding) /.test(task.name);

// Milliseconds: a task that takes longer to look at is no idea.
const LONGEST_LOOK = 25;

/** Commands for some tasks that are possible here and not yet done, in the robot's own words. They are sought one task at a time, until the answer is no longer
 * wanted.
 * @param {() => boolean} isStale
 * @returns {Promise<string[]>} */
export async function ideas(isStale) {
  const found = { agent: /** @type {string[]} */ ([]), block: /** @type {string[]} */ ([]), way: /** @type {string[]} */ ([]) };
  let at = -1;
  await inParts(() => {
    if (isStale()) return true;
    try {
      world.hear('?a');
      const { tasks } = beliefNow();
      const started = performance.now();
      while (performance.now() - started < LONGEST_LOOK) {
        at += 1;
        if (at === tasks.length) return true;
        const kind = hasWay(tasks[at]) ? 'way' : tasks[at].name.startsWith('agent') ? 'agent' : 'block';
        if (tasks[at].words.includes('(') || found[kind].length === (kind === 'agent' ? 2 : 1)) continue;
        world.lookAhead(at);
        let route = '';
        while (!route && performance.now() - started < 2 * LONGEST_LOOK) route = world.look(500);
        const cells = route && parsed(route)?.cells;
        if (cells && cells.length > 1) found[kind].push(tasks[at].words);
      }
    } catch {
      // A home without tasks has nothing to suggest.
      return true;
    } finally {
      world.forget();
    }
    return false;
  });
  return [...found.agent.slice(0, 1), ...found.block, ...found.way, ...found.agent.slice(1)];
}
