// The floor plan: a drawing as by hand, seen from above.
import { parsed, world } from './core.js';
import { t } from './language.js';
import { blockDrawing, colorOf, robotDrawing } from './robot.js';
import { $, draw, inParts, isDrawn, make, state } from './state.js';
import { isMerry } from './stops.js';
import { describeScene, formsOf, labelWords } from './words.js';

export const CELL = 48;
const LOOK_BUDGET = 4000;
// The outer half of the margin is not shown.
const CUT = CELL / 4;

// A small number that is always the same for the same place, so that the drawing does not flicker.
function wobble(x, y, seed) {
  const mixed = Math.sin(x * 127.1 + y * 311.7 + seed * 74.7) * 43758.5453;
  return (mixed - Math.floor(mixed) - 0.5) * 2;
}

// A line from cell to cell as a hand would draw it.
function stroke(x0, y0, x1, y1, seed, amount) {
  const parts = Math.max(1, Math.round(Math.hypot(x1 - x0, y1 - y0) / (CELL * 1.5)));
  const across = [-(y1 - y0), x1 - x0].map(side => side / (Math.hypot(x1 - x0, y1 - y0) || 1));
  let path = '';
  for (let part = 0; part <= parts; part += 1) {
    const share = part / parts;
    const off = wobble(x0 + (x1 - x0) * share, y0 + (y1 - y0) * share, seed) * amount;
    const point = [x0 + (x1 - x0) * share + across[0] * off, y0 + (y1 - y0) * share + across[1] * off].map(value => value.toFixed(1));
    if (part === 0) path += 'M' + point.join(' ');
    else {
      const middle = share - 0.5 / parts;
      const bend = wobble(x1 + part, y0 - part, seed + 3) * amount;
      path += 'Q' + (x0 + (x1 - x0) * middle + across[0] * bend).toFixed(1) + ' ' + (y0 + (y1 - y0) * middle + across[1] * bend).toFixed(1) + ' ' + point.join(' ');
    }
  }
  return path;
}

// Coordinates on the drawing: north is up, with a margin of half a cell around the walls.
export class Frame {
  constructor(bounds) {
    this.bounds = bounds;
    this.width = (bounds.right - bounds.left + 1) * CELL;
    this.height = (bounds.top - bounds.bottom + 1) * CELL;
  }

  x(x) {
    return (x - this.bounds.left + 0.5) * CELL;
  }

  y(y) {
    return (this.bounds.top - y + 0.5) * CELL;
  }
}

// The walls: runs of wall cells, from middle to middle. `wall(x, y)` says whether a cell is wall.
function wallPaths(frame, wall) {
  const { left, right, bottom, top } = frame.bounds;
  const paths = [];
  const runs = (from, to, at, isWall, line) => {
    let start = null;
    for (let i = from; i <= to + 1; i += 1) {
      if (i <= to && isWall(i)) {
        if (start === null) start = i;
      } else if (start !== null) {
        line(start, i - 1, at);
        start = null;
      }
    }
  };
  // A run that ends at a door goes on to the door's edge.
  const isDoor = (x, y) => frame.door && frame.door(x, y);
  for (let y = bottom; y <= top; y += 1) {
    runs(left, right, y, x => wall(x, y), (x0, x1) => {
      const from = frame.x(x0) - (isDoor(x0 - 1, y) ? CELL / 2 : 0);
      const to = frame.x(x1) + (isDoor(x1 + 1, y) ? CELL / 2 : 0);
      if (to > from) paths.push([from, frame.y(y), to, frame.y(y)]);
    });
  }
  for (let x = left; x <= right; x += 1) {
    runs(bottom, top, x, y => wall(x, y), (y0, y1) => {
      const from = frame.y(y0) + (isDoor(x, y0 - 1) ? CELL / 2 : 0);
      const to = frame.y(y1) - (isDoor(x, y1 + 1) ? CELL / 2 : 0);
      if (from > to) paths.push([frame.x(x), from, frame.x(x), to]);
    });
  }
  return paths;
}

function doorDrawing(frame, door, wall) {
  const group = draw('g', { class: 'door' });
  for (let x = door.left; x <= door.right; x += 1) {
    for (let y = door.bottom; y <= door.top; y += 1) {
      const [cx, cy, half] = [frame.x(x), frame.y(y), CELL / 2];
      const lies = wall(x - 1, y) || wall(x + 1, y);
      group.append(draw('path', {
        d: lies ? 'M' + (cx - half) + ' ' + cy + 'h' + CELL : 'M' + cx + ' ' + (cy - half) + 'v' + CELL, class: 'sill',
      }));
      group.append(draw('path', {
        d: lies ? 'M' + (cx - half + 3) + ' ' + cy + 'v-' + (CELL * 0.62) + 'a' + CELL * 0.62 + ' ' + CELL * 0.62 + ' 0 0 1 ' + CELL * 0.62 + ' ' + CELL * 0.62
          : 'M' + cx + ' ' + (cy - half + 3) + 'h' + (CELL * 0.62) + 'a' + CELL * 0.62 + ' ' + CELL * 0.62 + ' 0 0 1 -' + CELL * 0.62 + ' ' + CELL * 0.62,
        class: 'swing',
      }));
    }
  }
  return group;
}

// The fixed parts: floors, names, doors and walls.
export function houseDrawing(frame, scene) {
  const rows = scene.map.split('\n');
  const character = (x, y) => (rows[frame.bounds.top - y] || '')[x - frame.bounds.left] || ' ';
  const wall = (x, y) => character(x, y) === '#';
  frame.door = (x, y) => scene.doors.some(door => x >= door.left && x <= door.right && y >= door.bottom && y <= door.top);
  const house = draw('g', { class: 'house' });
  for (const room of scene.rooms) {
    const [x0, x1, y0, y1] = [frame.x(room.left), frame.x(room.right), frame.y(room.top), frame.y(room.bottom)];
    house.append(draw('rect', { x: x0, y: y0, width: x1 - x0, height: y1 - y0, class: 'floor', style: '--tint:' + colorOf(room.color) }));
    let hatch = '';
    for (let at = x0 - (y1 - y0) + 14; at < x1; at += 17) {
      const [hx0, hx1] = [Math.max(at, x0), Math.min(at + y1 - y0, x1)];
      if (hx1 > hx0) hatch += stroke(hx0, y1 - (hx0 - at), hx1, y1 - (hx1 - at), at, 1.6);
    }
    house.append(draw('path', { d: hatch, class: 'hatch', style: '--tint:' + colorOf(room.color) }));
  }
  let dots = '';
  for (let y = frame.bounds.bottom; y <= frame.bounds.top; y += 1) {
    for (let x = frame.bounds.left; x <= frame.bounds.right; x += 1) if (!wall(x, y) && character(x, y) !== ' ') dots += 'M' + frame.x(x) + ' ' + frame.y(y) + 'v.1';
  }
  house.append(draw('path', { d: dots, class: 'dots' }));
  for (const door of scene.doors) house.append(doorDrawing(frame, door, wall));
  let [thick, thin] = ['', ''];
  wallPaths(frame, wall).forEach(([x0, y0, x1, y1], index) => {
    thick += stroke(x0, y0, x1, y1, index, 1.3);
    thin += stroke(x0 - 2, y0 + 2, x1 + 2, y1 + 2, index + 50, 2.2);
  });
  house.append(draw('path', { d: thick, class: 'wall' }), draw('path', { d: thin, class: 'wall again' }));
  for (const room of scene.rooms) {
    house.append(draw('text', { x: frame.x(room.left) + 12, y: frame.y(room.top) + 23, class: 'roomname' }, ...roomName(room)));
  }
  return house;
}

// The name of a room: its colour, and the word “room”, which is left out if there is no place for it.
function roomName(room) {
  const name = labelWords({ ...room, shape: 'room' });
  const color = formsOf(room.color).find(form => name.includes(form));
  if (!color) return [name];
  const at = name.indexOf(color);
  const rest = [name.slice(0, at), name.slice(at + color.length)].map(kind => (kind ? draw('tspan', { class: 'kind' }, kind) : null));
  return [rest[0], color, rest[1]];
}

export function thingDrawing(frame, thing, isRobot) {
  const group = draw('g', { class: isRobot ? 'robot' : 'block', 'data-name': thing.name });
  group.style.transform = 'translate(' + frame.x(thing.x) + 'px,' + frame.y(thing.y) + 'px)';
  group.append(...(isRobot ? robotDrawing() : blockDrawing(thing)).filter(part => part !== null));
  if (!isRobot && state.settings.names) group.append(draw('text', { y: 24, class: 'blockname' }, labelWords(thing)));
  return group;
}

// The plan in the page. It is built anew for another home; otherwise things only move.
/** @type {any} */
const plan = { frame: null, things: new Map(), ahead: null, asked: null, decided: null, route: null };

export function renderPlan() {
  const scene = state.scene;
  const root = $('plan');
  if (!isDrawn('plan', scene.bounds, scene.rooms, scene.doors, scene.blocks.map(block => [block.name, block.color, block.shape]), state.settings.names)) {
    plan.frame = new Frame(scene.bounds);
    root.replaceChildren(houseDrawing(plan.frame, scene));
    const [width, height] = [plan.frame.width - 2 * CUT, plan.frame.height - 2 * CUT];
    root.setAttribute('viewBox', [CUT, CUT, width, height].join(' '));
    root.style.setProperty('--columns', scene.bounds.right - scene.bounds.left + 1);
    root.style.aspectRatio = width + ' / ' + height;
    plan.ahead = draw('g', { class: 'ahead' });
    root.append(plan.ahead);
    plan.things = new Map();
    plan.things.set(scene.agent.name, thingDrawing(plan.frame, scene.agent, true));
    for (const block of scene.blocks) plan.things.set(block.name, thingDrawing(plan.frame, block, false));
    plan.asked = draw('g', {});
    root.append(...plan.things.values(), plan.asked);
    // Another home may be of another scale in a plan of the same size.
    fitNames(root);
  }
  for (const thing of [...scene.blocks, scene.agent]) {
    plan.things.get(thing.name).style.transform = 'translate(' + plan.frame.x(thing.x) + 'px,' + plan.frame.y(thing.y) + 'px)';
  }
  renderAhead();
  renderAsked();
  if (!isDrawn('twin', scene)) {
    const lines = describeScene(scene);
    root.setAttribute('aria-label', t('plan.about', { text: lines[0] }));
    $('twin').replaceChildren(...lines.map(line => make('li', {}, line)));
    $('textmap').textContent = scene.map;
  }
  const robot = plan.things.get(scene.agent.name);
  const session = state.session;
  const glad = isMerry() || state.phase === 'moment';
  const feeling = session?.feedback || (glad ? 'reward' : '');
  robot.setAttribute('class', 'robot ' + (glad ? 'dancing ' : '') + ({ reward: 'happy', punish: 'sad' }[feeling] || '') + (state.phase === 'learning' || state.phase === 'planning' ? ' thinking' : '') +
    (session && session.decided ? ' looks-' + session.decided.action : ''));
  robot.style.setProperty('--sure', session && session.decided ? session.decided.confidence.toFixed(2) : 0);
}

// A mark on each of the things that the robot asks about: the number of the answer, or a question mark.
function renderAsked() {
  const question = state.session?.question;
  const marks = question ? question.objects.map((name, at) => {
    const room = state.scene.rooms.find(one => one.name === name);
    const thing = state.scene.blocks.find(one => one.name === name);
    const [x, y] = room ? [plan.frame.x(room.right) - 30, plan.frame.y(room.top) + 30] : thing ? [plan.frame.x(thing.x) + 16, plan.frame.y(thing.y) - 16] : [0, 0];
    return draw('g', { class: 'badge', transform: 'translate(' + x + ' ' + y + ')' }, draw('circle', { r: 15 }), draw('text', { y: 6.5 }, question.objects.length > 1 ? at + 1 : '?'));
  }) : [];
  plan.asked.replaceChildren(...marks);
}

// After a decision, looks ahead to where the robot is going, a part at a time, while it waits for feedback.
async function lookAhead(session) {
  const { decided } = session;
  Object.assign(plan, { decided, route: null });
  if (!state.settings.ghost) return;
  world.lookAhead(decided.task);
  const stale = () => session.pace === 'over' || session.decided !== decided;
  const found = await inParts(() => (stale() ? 'null' : world.look(LOOK_BUDGET)));
  if (stale()) return;
  plan.route = { session, ...parsed(found) };
  renderAhead();
}

// Footprints on the route of the task that the robot follows, and ghosts of the things at its end.
function renderAhead() {
  const { session } = state;
  if (session?.question || state.phase === 'learning') plan.route = null;
  if (session?.decided && session.decided !== plan.decided) lookAhead(session);
  const { route } = plan;
  if (!state.settings.ghost || !session || route?.session !== session || !(route.cells?.length > 1)) {
    plan.ahead.replaceChildren();
    return;
  }
  let prints = '';
  for (let at = 1; at < route.cells.length; at += 1) {
    const [[x0, y0], [x1, y1]] = [route.cells[at - 1], route.cells[at]];
    const middle = [(plan.frame.x(x0) + plan.frame.x(x1)) / 2, (plan.frame.y(y0) + plan.frame.y(y1)) / 2];
    prints += 'M' + middle.join(' ') + 'v.1';
    if (at < route.cells.length - 1) prints += 'M' + plan.frame.x(x1) + ' ' + plan.frame.y(y1) + 'v.1';
  }
  const here = new Map([...state.scene.blocks, state.scene.agent].map(thing => [thing.name, thing]));
  const moved = route.end.filter(thing => here.get(thing.name)?.x !== thing.x || here.get(thing.name)?.y !== thing.y);
  const ghosts = moved.map(thing => {
    const ghost = thingDrawing(plan.frame, thing, thing.name === state.scene.agent.name);
    ghost.setAttribute('class', ghost.getAttribute('class') + ' ghost');
    return ghost;
  });
  plan.ahead.replaceChildren(draw('path', { d: prints, class: 'prints' }), ...ghosts);
}

// Keeps the names on a drawing readable, however small it is on the screen: at least 12 pixels, and more in the class view.
/** @param {SVGSVGElement} root */
export function fitNames(root) {
  const [shown, drawn] = [root.getBoundingClientRect(), root.viewBox.baseVal];
  const scale = Math.min(shown.width / (drawn?.width || 1), shown.height / (drawn?.height || 1));
  if (scale > 0) root.style.setProperty('--name', Math.max(11, parseFloat(getComputedStyle(document.documentElement).fontSize) * 0.75 / scale).toFixed(1) + 'px');
  root.classList.toggle('short', scale < 0.6);
  root.classList.toggle('tiny', scale < 0.5);
}

/** Fits names and plan to the screen whenever their sizes change. */
export function watchSize() {
  const sizes = new ResizeObserver(entries => { for (const { target } of entries) fitNames(/** @type {SVGSVGElement} */ (target)); });
  for (const id of ['plan', 'draft']) sizes.observe($(id));
  // The bubble has another width at each step; the end of the plan depends only on heights.
  const heights = new Map();
  const around = new ResizeObserver(entries => {
    const changed = entries.filter(({ target, contentRect }) => heights.get(target) !== contentRect.height);
    for (const { target, contentRect } of changed) heights.set(target, contentRect.height);
    if (changed.length) fitPlan();
  });
  for (const element of [$('say'), $('good').closest('.desk'), document.documentElement]) around.observe(element);
  window.addEventListener('resize', fitPlan);
}

// If the buttons are fixed over the page, as on a phone, the plan ends above them.
function fitPlan() {
  const desk = $('good').closest('.desk');
  if (getComputedStyle(desk).position !== 'fixed') {
    $('plan').style.maxHeight = '';
    return;
  }
  const free = window.innerHeight - desk.getBoundingClientRect().height - 14;
  const room = free - ($('plan').getBoundingClientRect().top + window.scrollY);
  // If it begins below the visible part, people scroll to it, and then see all of it.
  $('plan').style.maxHeight = (room < 90 && !state.session ? free - 60 : Math.max(90, room)) + 'px';
}
