// The home as a text map: the core's drawing, and a legend of what the letters cannot say.
function toTextMap(scene) {
  const legend = [...scene.rooms.map(room => 'room ' + room.color + ' ' + [room.left, room.bottom, room.right, room.top].join(' ')),
    ...scene.blocks.map(block => 'block ' + block.color + ' ' + block.shape + ' ' + block.x + ' ' + block.y)];
  return scene.map + '\n' + legend.join('\n') + '\n';
}

const LETTERS = { r: 'red', g: 'green', b: 'blue', y: 'yellow', p: 'purple', o: 'orange', t: 'teal', m: 'magenta' };
const CAPITALS = { C: 'chair', B: 'bag', K: 'backpack', S: 'star', A: 'ball' };

// A home from a drawing: '#' wall, '+' doorway, '@' the robot, lower-case letters for a room's colour, capitals for a block. Each room is
// the box around cells that hang together without a door. Throws where the drawing is none.
function fromTextMap(text) {
  const rows = text.split('\n').map(row => row.trimEnd());
  const legend = rows.filter(row => /^(room|block) /.test(row)).map(row => row.split(/\s+/));
  const drawing = rows.filter(row => row && !/^(room|block) /.test(row));
  if (!drawing.length) throw new Error('there is no drawing; write # for walls, + for doors, @ for the robot');
  const height = drawing.length;
  const at = (x, y) => (drawing[height - 1 - y] || '')[x] || ' ';
  const objects = [];
  const seen = new Set();
  const isFloor = (x, y) => !'#+ '.includes(at(x, y));
  const doors = [];
  const blocks = [];
  let agent = null;
  for (let y = 0; y < height; y += 1) {
    for (let x = 0; x < drawing[height - 1 - y].length; x += 1) {
      const letter = at(x, y);
      if (letter === '+') doors.push({ class: 'door', left: x, bottom: y, right: x, top: y });
      if (letter === '@') agent = { class: 'agent', name: 'agent0', x, y };
      if (/[A-Z]/.test(letter)) blocks.push({ class: 'block', x, y, color: 'yellow', shape: CAPITALS[letter] || 'basket' });
      if (!isFloor(x, y) || seen.has(x + ',' + y)) continue;
      const room = { class: 'room', left: x, bottom: y, right: x, top: y, color: '' };
      const open = [[x, y]];
      seen.add(x + ',' + y);
      while (open.length) {
        const [cx, cy] = open.pop();
        Object.assign(room, { left: Math.min(room.left, cx), right: Math.max(room.right, cx), bottom: Math.min(room.bottom, cy), top: Math.max(room.top, cy) });
        room.color = room.color || LETTERS[at(cx, cy)] || '';
        for (const [nx, ny] of [[cx + 1, cy], [cx - 1, cy], [cx, cy + 1], [cx, cy - 1]]) {
          if (isFloor(nx, ny) && !seen.has(nx + ',' + ny)) {
            seen.add(nx + ',' + ny);
            open.push([nx, ny]);
          }
        }
      }
      objects.push({ ...room, left: room.left - 1, bottom: room.bottom - 1, right: room.right + 1, top: room.top + 1, color: room.color || 'red' });
    }
  }
  for (const [kind, color, ...rest] of legend) {
    if (kind === 'room') {
      const [left, bottom, right, top] = rest.map(Number);
      const room = objects.find(each => each.left === left && each.bottom === bottom && each.right === right && each.top === top);
      if (room) room.color = color;
    } else {
      const [shape, x, y] = rest;
      const block = blocks.find(each => each.x === Number(x) && each.y === Number(y));
      if (block) Object.assign(block, { color, shape });
    }
  }
  const named = (list, name) => list.map((each, index) => ({ ...each, name: name + index }));
  return { version: 1, objects: [...named(objects, 'room'), ...named(doors, 'door'), ...named(blocks, 'block'), ...(agent ? [agent] : [])] };
}
