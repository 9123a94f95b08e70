// The home as a text map: the core's drawing, and notes on colours and shapes, which letters cannot say. Cells count from the drawing's
// south-west corner.

import { t } from './language.js';

export function toTextMap(scene) {
  const { left, bottom } = scene.bounds;
  const notes = [...scene.rooms.map(room => ['room', room.color, room.left - left, room.bottom - bottom, room.right - left, room.top - bottom]),
    ...scene.blocks.map(block => ['block', block.color, block.shape, block.x - left, block.y - bottom])];
  return scene.map + '\n' + notes.map(note => note.join(' ') + '\n').join('');
}

const LETTERS = {
  r: 'red', g: 'green', b: 'blue', y: 'yellow', p: 'purple', o: 'orange', t: 'tan', '.': 'red',
  C: 'yellow chair', B: 'yellow bag', K: 'yellow backpack', S: 'yellow star', A: 'yellow ball',
};

// Checks that a drawing has only the signs of a map, and at most one robot.
function checkSigns(drawing) {
  let robots = 0;
  drawing.forEach((row, index) => {
    [...row].forEach((letter, column) => {
      const where = t('map.where', { y: index + 1, x: column + 1 });
      if (!/[#+@ .a-zA-Z]/.test(letter)) throw new Error(t('map.sign', { letter, where }));
      robots += Number(letter === '@');
      if (robots > 1) throw new Error(t('map.second', { where }));
    });
  });
}

// A home from a drawing: '#' wall, '+' doorway, '@' the robot, lower-case letters for a room's colour, capitals for a block. Lines below
// say what letters mean ('b: blue', 'B: yellow bag'); notes on single things overrule them. Each room is the box around cells that are
// connected without a door. Throws if the drawing is no home.
export function fromTextMap(text) {
  const drawing = [];
  const said = { ...LETTERS };
  const notes = {};
  for (const row of text.split('\n').map(line => line.trimEnd()).filter(Boolean)) {
    const letter = row.match(/^(\S)\s*:\s*(.*)/);
    const note = row.replace(/\s+/g, ' ').match(/^(room|block) (.*?)((?: -?\d+)+)$/);
    if (letter) said[letter[1]] = letter[2];
    else if (note) notes[note[1] + note[3]] = note[2];
    else drawing.push(row);
  }
  if (!drawing.length) throw new Error(t('map.empty'));
  // The note on a thing, or else the meaning of its letter.
  const meaning = (kind, place, letter, example) => {
    const key = [kind, ...place].join(' ');
    const found = notes[key] || said[letter];
    delete notes[key];
    if (!found) throw new Error(t('map.letter', { letter, example }));
    return found;
  };
  const height = drawing.length;
  checkSigns(drawing);
  const at = (x, y) => (drawing[height - 1 - y] || '')[x] || ' ';
  const objects = [];
  const seen = new Set();
  const isFloor = (x, y) => !'#+ '.includes(at(x, y));
  const doors = [];
  const blocks = [];
  /** @type {object | null} */
  let agent = null;
  for (let y = 0; y < height; y += 1) {
    for (let x = 0; x < drawing[height - 1 - y].length; x += 1) {
      const letter = at(x, y);
      if (letter === '+') doors.push({ class: 'door', left: x, bottom: y, right: x, top: y });
      if (letter === '@') agent = { class: 'agent', name: 'agent0', x, y };
      if (/[A-Z]/.test(letter)) {
        const [color, shape] = meaning('block', [x, y], letter, 'yellow chair').split(/\s+/);
        blocks.push({ class: 'block', x, y, color, shape });
      }
      if (!isFloor(x, y) || seen.has(x + ',' + y)) continue;
      let [left, bottom, right, top, floor] = [x, y, x, y, '.'];
      /** @type {any[]} */
      const open = [[x, y]];
      seen.add(x + ',' + y);
      while (open.length) {
        const [cx, cy] = open.pop();
        [left, bottom, right, top] = [Math.min(left, cx), Math.min(bottom, cy), Math.max(right, cx), Math.max(top, cy)];
        if (/[a-z]/.test(at(cx, cy))) {
          if (floor !== '.' && floor !== at(cx, cy)) throw new Error(t('map.colors', { one: floor, other: at(cx, cy) }));
          floor = at(cx, cy);
        }
        for (const [nx, ny] of [[cx + 1, cy], [cx - 1, cy], [cx, cy + 1], [cx, cy - 1]]) {
          if (isFloor(nx, ny) && !seen.has(nx + ',' + ny)) {
            seen.add(nx + ',' + ny);
            open.push([nx, ny]);
          }
        }
      }
      const box = [left - 1, bottom - 1, right + 1, top + 1];
      objects.push({ class: 'room', left: box[0], bottom: box[1], right: box[2], top: box[3], color: meaning('room', box, floor, 'teal') });
    }
  }
  const [idle] = Object.keys(notes);
  if (idle) throw new Error(t('map.idle', { kind: idle.split(' ')[0], place: idle.split(' ').slice(1).join(' ') }));
  const named = (list, name) => list.map((each, index) => ({ ...each, name: name + index }));
  return { version: 1, objects: [...named(objects, 'room'), ...named(doors, 'door'), ...named(blocks, 'block'), ...(agent ? [agent] : [])] };
}
