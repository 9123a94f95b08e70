// The page in words: what a screen reader reads, and what the status line says.
import { questionWords } from './asking.js';
import { unknownWords } from './learned.js';
import { percent, state } from './state.js';

export const ACTIONS = { north: 'moved north', south: 'moved south', east: 'moved east', west: 'moved west', pull: 'pulled', noop: 'stayed where it is' };
export const acted = action => ACTIONS[action] || action;

function roomAt(scene, x, y) {
  const inside = scene.rooms.find(room => x > room.left && x < room.right && y > room.bottom && y < room.top);
  return inside ? 'the ' + inside.color + ' room' : 'a doorway';
}

// The floor plan as sentences.
export function describeScene(scene) {
  const at = thing => 'column ' + (thing.x - scene.bounds.left + 1) + ', row ' + (scene.bounds.top - thing.y + 1) + ', in ' + roomAt(scene, thing.x, thing.y);
  const lines = ['The robot is at ' + at(scene.agent) + '.'];
  for (const block of scene.blocks) lines.push('The ' + block.color + ' ' + block.shape + ' is at ' + at(block) + '.');
  for (const room of scene.rooms) {
    lines.push('The ' + room.color + ' room spans columns ' + (room.left - scene.bounds.left + 1) + ' to ' + (room.right - scene.bounds.left + 1) +
      ' and rows ' + (scene.bounds.top - room.top + 1) + ' to ' + (scene.bounds.top - room.bottom + 1) + ', walls included.');
  }
  for (const door of scene.doors) lines.push('A door is at column ' + (door.left - scene.bounds.left + 1) + ', row ' + (scene.bounds.top - door.top + 1) + '.');
  return lines;
}

// The tasks, the most likely first; among equals the one that the robot follows.
export function ranked() {
  const followed = state.session && state.session.decided ? state.session.decided.task : -1;
  return state.belief.tasks.map((task, index) => ({ ...task, index }))
    .sort((a, b) => b.probability - a.probability || Number(b.index === followed) - Number(a.index === followed) || a.index - b.index);
}

// roomIsGreen becomes “room is green”.
export const tokenWords = token => token.replace(/([A-Z])/g, ' $1').toLowerCase();

// A word of which the robot may have kept the first letters only.
export const wordShown = (word, letters) => (letters && [...word].length >= letters ? word + '…' : word);

/** A room or a block by its looks, and by its name where another looks alike.
 * @param {string} name */
export function objectWords(name) {
  const { rooms, blocks } = state.scene;
  const kind = rooms.some(room => room.name === name) ? rooms.map(room => ({ ...room, shape: 'room' })) : blocks;
  const looks = thing => thing.color + ' ' + thing.shape;
  const thing = kind.find(one => one.name === name);
  if (!thing) return name;
  return looks(thing) + (kind.filter(one => looks(one) === looks(thing)).length > 1 ? ' (' + name + ')' : '');
}

// What the robot says of itself.
export function speech() {
  const session = state.session;
  if (state.phase === 'learning') return ['Thinking it over …', state.progress || 'I am learning from our session.'];
  if (!session) {
    if (state.said) return state.said;
    if (state.sessions === 0) return ['Hello! I know no word yet.', 'Tell me something, and judge me while I try.'];
    return ['Ready. Tell me what to do.', 'I have learned from ' + sessionsWord() + '.'];
  }
  const best = ranked()[0];
  if (!best) return ['…', ''];
  const unknown = unknownWords();
  const strange = unknown.length ? ' I do not know ' + unknown.map(word => '“' + word + '”').join(', ') + '.' : '';
  if (session.question) return [questionWords(session.question), strange.trim()];
  if (session.decided && session.decided.action === 'noop') {
    const plan = session.decided.plans[session.decided.task];
    if (plan === 'goal' && session.steps === 0) return ['I am there already: ' + best.words + '.', 'Was that it, or did you mean something else?' + strange];
    if (plan === 'goal') return ['Here I am: ' + best.words + '.', 'Was that it?' + strange];
    if (plan === 'dead end') return ['I am stuck.', 'From here I cannot ' + best.words + ' any more.'];
    return ['I am lost.', 'This home is too large for me to plan that.'];
  }
  const sure = best.probability > 0.8 ? 'You mean' : best.probability > 0.45 ? 'I think you mean' : 'Perhaps you mean';
  return [sure + ': ' + best.words + (sure === 'You mean' ? '.' : '?'), percent(best.probability) + ' sure of it.' + strange];
}

/** Whether the robot rests where it believes to be meant. */
export function isThere() {
  const decided = state.session?.decided;
  return Boolean(decided && !state.session?.question && decided.action === 'noop' && decided.plans[decided.task] === 'goal');
}

export const sessionsWord = () => state.sessions + (state.sessions === 1 ? ' session' : ' sessions');
