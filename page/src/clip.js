// A clip of some seconds: the robot does what a sentence of an invented language says. The browser records it from a canvas.
import { Goodbot, parsed, world } from './core.js';
import { rasterized, STYLE } from './picture.js';
import { Frame, houseDrawing } from './plan.js';
import { blockDrawing, robotDrawing } from './robot.js';
import { draw } from './state.js';

const [WIDTH, TOP, BOTTOM] = [720, 96, 64];
// In milliseconds: before the first step, for all steps, and after the last one. Together they are less than five seconds.
const [BEFORE, STEPS, AFTER] = [600, 3100, 900];
// A film without pictures has fewer bytes. The browser packs pictures so often, and is waited for so long, in milliseconds.
const [EMPTY, EVERY, LONGEST] = [1000, 500, 20000];
const INK = '#2c3346';
const HOUSE = '.floor{fill:var(--tint);opacity:.32}.hatch{fill:none;stroke:var(--tint);opacity:.3}.wall{fill:none;stroke:#2c3346;stroke-width:8;stroke-linecap:round}.again,.dots,.swing,.roomname,.heart{display:none}.sill{stroke:#fffaf0;stroke-width:9}.solid{stroke:#2a2f40;stroke-width:2}';

/** What the browser records, if it can.
 * @returns {string | undefined} */
export const clipType = () => (typeof MediaRecorder === 'function' && 'captureStream' in HTMLCanvasElement.prototype ? ['video/webm', 'video/mp4'].find(type => MediaRecorder.isTypeSupported(type)) : undefined);

/** The cells of the robot and of the things on its shortest way to a task, the first before the first step.
 * @param {string} home
 * @param {string} task
 * @param {boolean} ways whether the robot may be told how to go */
export function walk(home, task, ways) {
  const robot = new Goodbot(0);
  try {
    robot.setEnvironment(home);
    robot.setWays(ways);
    robot.setPulls(world.pulls());
    const scene = parsed(robot.scene());
    robot.hear('a');
    robot.lookAhead(parsed(robot.belief()).tasks.findIndex(({ name }) => name === task));
    let route = '';
    while (!route) route = robot.look(20000);
    const places = [{ robot: [scene.agent.x, scene.agent.y], blocks: scene.blocks.map(({ x, y }) => [x, y]) }];
    // To a task that leads nowhere from here it takes no step.
    for (const cell of parsed(route)?.cells.slice(1) || []) {
      const before = places[places.length - 1];
      const pushed = cell.map((to, axis) => to - before.robot[axis]);
      places.push({ robot: cell, blocks: before.blocks.map(at => (at.join() === cell.join() ? at.map((from, axis) => from + pushed[axis]) : at)) });
    }
    return { scene, places };
  } finally {
    robot.free();
  }
}

/** Shows the clip once on a canvas.
 * @param {string} home
 * @param {string} task what the robot does
 * @param {string} above what it is told
 * @param {string} below */
export async function clipOf(home, task, above, below) {
  const { scene, places } = walk(home, task, world.ways());
  const frame = new Frame(scene.bounds);
  const scale = WIDTH / frame.width;
  const height = TOP + frame.height * scale + BOTTOM;
  const drawing = (x, y, width, height, zoom, ...parts) => rasterized(draw('svg', { xmlns: 'http://www.w3.org/2000/svg', viewBox: [x, y, width, height].join(' '), width: width * scale * zoom, height: height * scale * zoom }, draw('style', {}, STYLE + HOUSE), ...parts));
  const [house, robot, ...things] = await Promise.all([
    drawing(0, 0, frame.width, frame.height, 1, houseDrawing(frame, scene)), drawing(-26, -26, 52, 52, 1.35, ...robotDrawing()), ...scene.blocks.map(block => drawing(-20, -20, 40, 40, 1.25, ...blockDrawing(block))),
  ]);
  const canvas = Object.assign(document.createElement('canvas'), { width: WIDTH, height });
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  const write = (text, size, y) => {
    pen.font = '700 ' + size + 'px system-ui,sans-serif';
    pen.fillText(text, WIDTH / 2, y, WIDTH - 40);
  };
  /** @param {number} share how much of the way is done
   * @param {number} passed milliseconds */
  const show = (share, passed) => {
    pen.fillStyle = '#fffaf0';
    pen.fillRect(0, 0, WIDTH, height);
    pen.drawImage(house, 0, TOP);
    pen.fillStyle = INK;
    pen.textAlign = 'center';
    write(above, 46, 64);
    write(below, 28, height - 22);
    const at = Math.min(share, 1) * (places.length - 1);
    const [from, to] = [places[Math.floor(at)], places[Math.ceil(at)]];
    const put = (image, one, other, lift = 0) => {
      const [x, y] = one.map((start, axis) => start + (other[axis] - start) * (at % 1));
      pen.drawImage(image, frame.x(x) * scale - image.width / 2, TOP + frame.y(y) * scale - image.height / 2 - lift);
    };
    things.forEach((thing, which) => put(thing, from.blocks[which], to.blocks[which]));
    // It hops for joy where it has arrived. Browsers record a picture only if it differs from the one before.
    put(robot, from.robot, to.robot, Math.abs(Math.sin(passed / 150)) * (share < 1 ? 3 : 14));
  };
  const play = () => new Promise(done => {
    const began = performance.now();
    const next = () => {
      const passed = performance.now() - began;
      if (passed >= BEFORE + STEPS + AFTER) return done(undefined);
      show(Math.max(0, passed - BEFORE) / STEPS, passed);
      return requestAnimationFrame(next);
    };
    next();
  });
  show(1, 0);
  return { canvas, play };
}

/** Records a clip while it is shown.
 * @param {{ canvas: HTMLCanvasElement, play: () => Promise<void> }} clip
 * @returns {Promise<Blob>} */
export async function recorded({ canvas, play }) {
  const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: clipType(), videoBitsPerSecond: 1500000 });
  /** @type {Blob[]} */
  const parts = [];
  // A busy machine is behind with its pictures, and those that it has not packed when it is stopped are lost.
  const packed = new Promise(done => {
    recorder.ondataavailable = ({ data }) => {
      parts.push(data);
      if (new Blob(parts).size > EMPTY) done(undefined);
    };
    setTimeout(done, LONGEST);
  });
  const ended = new Promise(done => { recorder.onstop = done; });
  recorder.start(EVERY);
  await play();
  await packed;
  recorder.stop();
  await ended;
  return new Blob(parts, { type: recorder.mimeType });
}
