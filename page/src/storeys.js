// The tour's appendix: commands that say how, in homes of three storeys.

const LEFT = [0, 4, 8];

// A room below with the robot, three rooms above it, one room above those, and a door wherever two storeys meet.
/** @param {string[]} colors below, left, middle, right, above */
function storeys([below, left, middle, right, above]) {
  const room = (name, color, left, bottom, right) => ({ class: 'room', name, left, bottom, right, top: bottom + 4, color });
  const door = (name, x, y) => ({ class: 'door', name, left: x, bottom: y, right: x, top: y });
  return {
    version: 1,
    objects: [
      room('room0', below, 0, 0, 12),
      ...[left, middle, right].map((color, at) => room('room' + (at + 1), color, LEFT[at], 4, LEFT[at] + 4)),
      room('room4', above, 0, 8, 12),
      ...LEFT.flatMap((x, at) => [door('door' + 2 * at, x + 2, 4), door('door' + (2 * at + 1), x + 2, 8)]),
      { class: 'agent', name: 'agent0', x: 6, y: 2 },
    ],
  };
}

const inRoom = at => 'agentInRoom(agent0,room' + at + ')';

/** Two lessons and a test.
 * @type {{ home: object, intended: string, test: boolean }[]} */
export const APPENDIX = [
  { home: storeys(['red', 'blue', 'yellow', 'purple', 'green']), intended: inRoom(4) + ' avoiding ' + inRoom(2), test: false },
  { home: storeys(['yellow', 'green', 'blue', 'purple', 'red']), intended: inRoom(4) + ' avoiding ' + inRoom(2), test: false },
  { home: storeys(['green', 'red', 'purple', 'yellow', 'blue']), intended: inRoom(4) + ' avoiding ' + inRoom(2), test: true },
];
