// The editor: rooms, doors, blocks and the robot, by pointer on the plan and by numbers in a list.
import { Goodbot, parsed, world } from './core.js';
import { download, readFile } from './files.js';
import { listed, named, t } from './language.js';
import { CELL, Frame, houseDrawing, thingDrawing } from './plan.js';
import * as shelf from './shelf.js';
import { $, all, draw, make, render, state, tell } from './state.js';
import { enterHome } from './stops.js';
import { fromTextMap, toTextMap } from './textmap.js';
import { colorWords, labelWords, objectWords, shapeWords } from './words.js';

const PALETTE = ['red', 'green', 'blue', 'yellow', 'purple', 'orange', 'tan', 'teal', 'magenta'];
const FORMS = ['chair', 'bag', 'backpack', 'basket', 'star'];
const build = {
  /** @type {{ version: number, objects: any[] }} */
  file: { version: 1, objects: [] },
  tool: 'move',
  /** @type {any} */
  chosen: null,
  /** @type {any} */
  drag: null,
  // Whether the pointer was last on the drawing.
  drawing: false,
  /** @type {any} */
  frame: null,
  // The cells that are shown.
  /** @type {any} */
  bounds: null,
  error: '',
  // Why an imported text is no home.
  refused: '',
  // The drawing as it was last kept, and those before and after it, as JSON.
  text: '',
  /** @type {string[]} */
  past: [],
  /** @type {string[]} */
  future: [],
  // The home that was shown when the editor was opened.
  /** @type {any} */
  shown: null,
};

const nameFor = kind => {
  let number = 0;
  while (build.file.objects.some(object => object.name === kind + number)) number += 1;
  return kind + number;
};

const MOST_STEPS_BACK = 60;
// The largest home that the robot has room for is much shorter. The field takes one character more, so that a text that was cut off is
// refused.
const MOST_CHARACTERS = 100000;

/** Goes on with the user's own drawing; the first drawing begins with the home that is shown. */
export function enterBuild() {
  const kept = shelf.read('drawing', {});
  build.shown = parsed(world.environment());
  build.file = kept.file || structuredClone(build.shown);
  [build.past, build.future] = [kept.past || [], kept.future || []];
  build.text = JSON.stringify(build.file);
  [build.chosen, build.bounds] = [null, null];
  check();
}

/** Another tab has drawn: this one goes on from there. */
export function drawnElsewhere() {
  if (state.mode === 'build' && !build.drag) enterBuild();
}

// After every change: it can be undone, and is kept even if it is no home yet.
function changed() {
  const json = JSON.stringify(build.file);
  if (json !== build.text) {
    build.past = [...build.past, build.text].slice(-MOST_STEPS_BACK);
    build.future = [];
  }
  keepDrawing();
}

function keepDrawing() {
  build.text = JSON.stringify(build.file);
  check();
  const home = build.error ? shelf.read('drawing', {}).home : build.file;
  shelf.put('drawing', JSON.stringify({ file: build.file, home, past: build.past, future: build.future }));
}

// The core's faults of a home: a part of its text, and the page's name for it.
const FAULTS = {
  'in a wall': 'outside', 'no cell': 'small', 'or another block': 'crowded', 'beyond -255': 'large', 'more states': 'large', 'no agent;': 'robot', 'agent already': 'robot',
};

// Why a drawing is no home, in words for people: the core's limits have the names of its tables.
function whyNot(error) {
  const [, table = '', n] = error.match(/apacit(?:ies|y)::(\w+) is (\d+)/) || [];
  const [, fault] = Object.entries(FAULTS).find(([part]) => error.includes(part)) || [];
  const [, where = ''] = error.match(/^(.+?): /) || [];
  // In the editor it is called a robot.
  if (fault) return t(/** @type {import('./language.js').Key} */ ('build.why.' + fault), { name: build.file.objects.some(({ name, class: kind }) => name === where && kind === 'agent') ? t('build.robot') : where });
  return named('build.most.' + table.toLowerCase())?.replace('{n}', n) || (/ field |invalid |expected /.test(error) ? t('build.malformed') : error.startsWith('line ') ? t('build.malformed') + ' (' + error + ')' : error);
}

// Is this a home? If so, the robot lives in it.
function check() {
  build.error = whyNot(Goodbot.check(build.text));
  build.refused = '';
  if (!build.error) enterHome(build.text);
  render();
}

/** @param {'past' | 'future'} from */
function travel(from) {
  const text = build[from].at(-1);
  if (text === undefined) return;
  build[from] = build[from].slice(0, -1);
  const to = from === 'past' ? 'future' : 'past';
  build[to] = [...build[to], build.text];
  build.file = JSON.parse(text);
  build.chosen = null;
  keepDrawing();
}

/** The cells around all rooms, and those of `before`.
 * @param {any[]} objects
 * @param {any} before */
function boundsOf(objects, before = null) {
  const rooms = objects.filter(object => object.class === 'room');
  const all = rooms.length ? rooms : [{ left: 0, bottom: 0, right: 8, top: 8 }];
  const side = (name, pick) => pick(...all.map(room => room[name]));
  const bounds = { left: side('left', Math.min) - 1, bottom: side('bottom', Math.min) - 1, right: side('right', Math.max) + 1, top: side('top', Math.max) + 1 };
  return before ? {
    left: Math.min(bounds.left, before.left), bottom: Math.min(bounds.bottom, before.bottom), right: Math.max(bounds.right, before.right), top: Math.max(bounds.top, before.top),
  } : bounds;
}

// The drawing as it is, even if it is no home.
function draftScene() {
  // The frame only grows, and not from stroke to stroke, so that the drawing does not slide away under the pointer, nor the next stroke land elsewhere.
  if (!build.bounds || !build.drawing) build.bounds = boundsOf(build.file.objects, build.bounds);
  const { bounds } = build;
  const of = kind => build.file.objects.filter(object => object.class === kind);
  const [rooms, doors] = [of('room'), of('door')];
  const holds = (box, x, y) => x >= box.left && x <= box.right && y >= box.bottom && y <= box.top;
  let map = '';
  for (let y = bounds.top; y >= bounds.bottom; y -= 1) {
    for (let x = bounds.left; x <= bounds.right; x += 1) {
      const around = rooms.filter(room => holds(room, x, y));
      const border = around.some(room => x === room.left || x === room.right || y === room.bottom || y === room.top);
      map += !around.length ? ' ' : border && !doors.some(door => holds(door, x, y)) ? '#' : '.';
    }
    map += '\n';
  }
  return { bounds, rooms, doors, blocks: of('block'), agent: of('agent')[0], map };
}

export function renderBuild() {
  $('build').hidden = state.mode !== 'build';
  $('draft').toggleAttribute('hidden', state.mode !== 'build');
  if (state.mode !== 'build') return;
  const scene = draftScene();
  const frame = new Frame(scene.bounds);
  build.frame = frame;
  const root = $('draft');
  root.setAttribute('viewBox', '0 0 ' + frame.width + ' ' + frame.height);
  root.style.setProperty('--columns', scene.bounds.right - scene.bounds.left + 1);
  root.style.aspectRatio = frame.width + ' / ' + frame.height;
  let grid = '';
  for (let x = 0; x <= frame.width; x += CELL) grid += 'M' + x + ' 0v' + frame.height;
  for (let y = 0; y <= frame.height; y += CELL) grid += 'M0 ' + y + 'h' + frame.width;
  root.replaceChildren(draw('path', { d: grid, class: 'grid' }), houseDrawing(frame, scene), ...scene.blocks.map(block => thingDrawing(frame, block, false)));
  if (scene.agent) root.append(thingDrawing(frame, scene.agent, true));
  const chosen = build.file.objects[build.chosen];
  if (chosen) {
    const box = boxOf(chosen);
    root.append(draw('rect', {
      x: frame.x(box.left) - CELL / 2, y: frame.y(box.top) - CELL / 2, width: (box.right - box.left + 1) * CELL, height: (box.top - box.bottom + 1) * CELL, class: 'chosen',
    }));
    if (chosen.class === 'room') root.append(draw('circle', { cx: frame.x(chosen.right), cy: frame.y(chosen.bottom), r: 11, class: 'handle' }));
  }
  if (build.drag && build.drag.box) {
    const { box } = build.drag;
    root.append(draw('rect', {
      x: frame.x(box.left) - CELL / 2, y: frame.y(box.top) - CELL / 2, width: (box.right - box.left + 1) * CELL, height: (box.top - box.bottom + 1) * CELL, class: 'chosen',
    }));
  }
  $('build-help').textContent = named('build.help.' + build.tool) || '';
  const closed = build.error ? [] : unreachable(scene);
  const missing = build.refused || !build.error ? '' : !scene.rooms.length ? t('build.noRoom') : !scene.agent ? t('build.noRobot') : '';
  $('build-error').textContent = missing || (build.refused ? t('build.noHome', { why: build.refused }) : build.error ? t('build.notYet', { why: build.error })
    : closed.length ? t('build.closed', { rooms: listed(closed, 'or') }) : t('build.fine'));
  $('build-error').className = missing ? '' : build.refused || build.error || closed.length ? 'wrong' : 'fine';
  // What is to be done next stands out.
  const next = !scene.rooms.length ? 'room' : !scene.agent ? 'agent' : closed.length ? 'door' : build.error ? 'undo' : '';
  for (const tool of all('[data-tool]')) {
    tool.setAttribute('aria-pressed', tool.dataset.tool === build.tool);
    tool.classList.toggle('primary', tool.dataset.tool === next);
  }
  $('build-undo').classList.toggle('primary', next === 'undo');
  $('build-undo').disabled = !build.past.length;
  $('build-redo').disabled = !build.future.length;
  // They keep their places, so that the drawing keeps its own.
  for (const [id, wanted] of /** @type {const} */ ([['move-in', !next], ['take-shown', JSON.stringify(build.shown) !== build.text]])) $(id).style.visibility = wanted ? '' : 'hidden';
  renderObjects();
}

const boxOf = object => (object.class === 'room' || object.class === 'door' ? object : { left: object.x, right: object.x, bottom: object.y, top: object.y });

// The list of objects, with a field for everything that can be changed.
function renderObjects() {
  const active = /** @type {HTMLElement | null} */ (document.activeElement);
  const focused = active && active.dataset.field;
  $('objects').replaceChildren(...build.file.objects.map((object, index) => {
    const title = object.class === 'agent' ? t('build.robot') : object.class === 'door' ? object.name : labelWords({ color: object.color, shape: object.shape || 'room' });
    const row = make('details', { name: 'object', open: index === build.chosen }, make('summary', { 'data-field': index + '.summary' }, title, make('small', {}, ' ' + (title === object.name ? '' : object.name))));
    // Not by the `toggle` event: it comes late, and may be about a row that is gone.
    row.firstChild.addEventListener('click', event => {
      event.preventDefault();
      build.chosen = build.chosen === index ? null : index;
      renderBuild();
    });
    const fields = make('div', { class: 'fields' });
    for (const [field, value] of Object.entries(object)) {
      if (field === 'class') continue;
      const options = { color: PALETTE, shape: FORMS }[field];
      const key = index + '.' + field;
      const input = options
        ? make('select', { 'data-field': key }, ...[...new Set([...options, value])].map(option => make('option', { value: option, selected: option === value }, field === 'color' ? colorWords(option) : shapeWords(option))))
        : make('input', { type: typeof value === 'number' ? 'number' : 'text', value, 'data-field': key });
      input.addEventListener('change', () => {
        object[field] = typeof value === 'number' ? Math.round(Number(input.value)) : input.value;
        build.chosen = index;
        changed();
      });
      fields.append(make('label', {}, named('field.' + field) || field, input));
    }
    fields.append(make('button', { type: 'button', class: 'small', onclick: () => { build.file.objects.splice(index, 1); build.chosen = null; changed(); } }, t('build.remove')));
    row.append(fields);
    return row;
  }));
  if (focused) {
    const again = $('objects').querySelector('[data-field="' + focused + '"]');
    if (again) again.focus();
  }
}

function addObject(kind, box) {
  const color = PALETTE[build.file.objects.filter(object => object.class === kind).length % PALETTE.length];
  const add = object => {
    build.file.objects.push(object);
    build.chosen = build.file.objects.length - 1;
  };
  if (kind === 'room') add({ class: 'room', name: nameFor('room'), ...box, color });
  else if (kind === 'door') add({ class: 'door', name: nameFor('door'), ...box });
  else if (kind === 'block') add({ class: 'block', name: nameFor('block'), x: box.left, y: box.bottom, color, shape: FORMS[build.file.objects.length % FORMS.length] });
  else {
    const agent = build.file.objects.findIndex(object => object.class === 'agent');
    if (agent >= 0) {
      Object.assign(build.file.objects[agent], { x: box.left, y: box.bottom });
      build.chosen = agent;
    } else add({ class: 'agent', name: 'agent0', x: box.left, y: box.bottom });
  }
  changed();
}

/** @param {number} dx
 * @param {number} dy */
function shift(object, before, dx, dy) {
  for (const [field, d] of /** @type {[string, number][]} */ ([['x', dx], ['left', dx], ['right', dx], ['y', dy], ['bottom', dy], ['top', dy]])) if (field in object) object[field] = before[field] + d;
}

// A room takes along its doors and the things in it: each of them, and a copy of it from before.
function movesAlong(index) {
  const room = build.file.objects[index];
  if (!room || room.class !== 'room') return [];
  const inside = box => box.left >= room.left && box.right <= room.right && box.bottom >= room.bottom && box.top <= room.top;
  return build.file.objects.filter(object => object !== room && object.class !== 'room' && inside(boxOf(object))).map(object => [object, { ...object }]);
}

// The rooms that the robot cannot get into, by their colours.
function unreachable(scene) {
  const rows = scene.map.split('\n');
  const isFloor = (x, y) => (rows[scene.bounds.top - y] || '')[x - scene.bounds.left] === '.';
  const seen = new Set();
  const open = [[scene.agent.x, scene.agent.y]];
  for (let cell = open.pop(); cell; cell = open.pop()) {
    const [x, y] = cell;
    if (seen.has(x + ',' + y) || !isFloor(x, y)) continue;
    seen.add(x + ',' + y);
    open.push([x + 1, y], [x - 1, y], [x, y + 1], [x, y - 1]);
  }
  const entered = room => [...seen].some(cell => {
    const [x, y] = cell.split(',').map(Number);
    return x > room.left && x < room.right && y > room.bottom && y < room.top;
  });
  return scene.rooms.filter(room => !entered(room)).map(room => objectWords(room.name));
}

function parsedHome(text) {
  try {
    return JSON.parse(text);
  } catch {
    throw new Error(t('build.badJson'));
  }
}

function cellUnder(event) {
  const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform($('draft').getScreenCTM().inverse());
  const { left, right, bottom, top } = build.frame.bounds;
  const cell = { x: left + Math.floor(x / CELL), y: top - Math.floor(y / CELL) };
  // What is drawn ends at the frame.
  return build.tool === 'move' ? cell : { x: Math.max(left, Math.min(right, cell.x)), y: Math.max(bottom, Math.min(top, cell.y)) };
}

// The object on a cell: things before doors before rooms.
function objectAt({ x, y }) {
  const holds = box => x >= box.left && x <= box.right && y >= box.bottom && y <= box.top;
  for (const kinds of [['agent', 'block'], ['door'], ['room']]) {
    const found = build.file.objects.findIndex(object => kinds.includes(object.class) && holds(boxOf(object)));
    if (found >= 0) return found;
  }
  return null;
}

const span = (a, b) => ({ left: Math.min(a.x, b.x), bottom: Math.min(a.y, b.y), right: Math.max(a.x, b.x), top: Math.max(a.y, b.y) });

export function setUpBuild() {
  const root = $('draft');
  for (const event of ['pointerdown', 'keydown']) document.addEventListener(event, ({ target }) => { build.drawing = root.contains(target); }, true);
  root.addEventListener('pointerdown', event => {
    event.preventDefault();
    root.setPointerCapture(event.pointerId);
    const cell = cellUnder(event);
    if (build.tool === 'move') {
      const chosen = build.file.objects[build.chosen];
      const resizing = chosen && chosen.class === 'room' && cell.x === chosen.right && cell.y === chosen.bottom;
      if (!resizing) build.chosen = objectAt(cell);
      build.drag = { from: cell, resizing, before: build.chosen === null ? null : { ...build.file.objects[build.chosen] }, along: resizing ? [] : movesAlong(build.chosen) };
    } else build.drag = { from: cell, box: span(cell, cell) };
    renderBuild();
  });
  root.addEventListener('pointermove', event => {
    if (!build.drag) return;
    const cell = cellUnder(event);
    const { from, before, resizing, box } = build.drag;
    if (box) build.drag.box = build.tool === 'room' || build.tool === 'door' ? span(from, cell) : span(cell, cell);
    else if (before) {
      const object = build.file.objects[build.chosen];
      const [dx, dy] = [cell.x - from.x, cell.y - from.y];
      if (resizing) Object.assign(object, { right: Math.max(before.left + 2, before.right + dx), bottom: Math.min(before.top - 2, before.bottom + dy) });
      else for (const [moved, from] of [[object, before], ...build.drag.along]) shift(moved, from, dx, dy);
    }
    renderBuild();
  });
  root.addEventListener('pointerup', () => {
    const { drag } = build;
    build.drag = null;
    if (drag && drag.box) addObject(build.tool, drag.box);
    else if (drag && drag.before) changed();
  });
  root.addEventListener('pointercancel', () => {
    build.drag = null;
    changed();
  });
  for (const tool of all('[data-tool]')) tool.addEventListener('click', () => { build.tool = tool.dataset.tool; renderBuild(); });
  for (const button of all('[data-add]')) {
    button.addEventListener('click', () => {
      const bounds = boundsOf(build.file.objects);
      const x = bounds.right - 1;
      const kind = button.dataset.add;
      addObject(kind, kind === 'room' ? { left: x, bottom: bounds.bottom + 1, right: x + 4, top: bounds.bottom + 5 } : { left: x, bottom: bounds.bottom + 3, right: x, top: bounds.bottom + 3 });
      const field = $('objects').querySelector('.fields [data-field^="' + build.chosen + '."]');
      if (field) field.focus();
    });
  }
  $('clear').addEventListener('click', () => { build.file = { version: 1, objects: [] }; [build.chosen, build.bounds] = [null, null]; changed(); });
  $('build-undo').addEventListener('click', () => travel('past'));
  $('build-redo').addEventListener('click', () => travel('future'));
  $('take-shown').addEventListener('click', () => { build.file = structuredClone(build.shown); [build.chosen, build.bounds] = [null, null]; changed(); });
  document.addEventListener('keydown', event => {
    if (state.mode !== 'build' || !(event.ctrlKey || event.metaKey) || /** @type {Element} */ (event.target).closest('input, textarea')) return;
    const key = event.key.toLowerCase();
    if (key !== 'z' && key !== 'y') return;
    event.preventDefault();
    travel(key === 'y' || event.shiftKey ? 'future' : 'past');
  });
  $('export-json').addEventListener('click', () => { $('home-text').value = JSON.stringify(build.file); });
  $('export-map').addEventListener('click', () => { $('home-text').value = toTextMap(build.error ? draftScene() : state.scene); });
  $('download-home').addEventListener('click', () => download('home.json', JSON.stringify(build.file), 'application/json'));
  const take = text => {
    try {
      if (text.length > MOST_CHARACTERS) throw new Error(t('build.tooLong', { n: MOST_CHARACTERS }));
      // A text that is JSON of any kind, even `null`, is no drawing.
      const isJson = /^\s*([{["\d-]|(null|true|false)\s*$)/.test(text);
      const file = isJson ? parsedHome(text) : fromTextMap(text);
      const error = Goodbot.check(JSON.stringify(file));
      if (error) throw new Error(whyNot(error));
      build.file = file;
      [build.chosen, build.bounds] = [null, null];
      changed();
      tell(t('build.taken'));
    } catch (error) {
      build.refused = error.message;
      renderBuild();
      tell(t('build.noHome', { why: error.message }), true);
    }
  };
  $('import').addEventListener('click', () => take($('home-text').value));
  $('load-home').addEventListener('change', async () => {
    const text = (await readFile($('load-home'), 'text')).content;
    if (text.length <= MOST_CHARACTERS) $('home-text').value = text;
    take(text);
  });
}
