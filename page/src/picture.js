// A card with the words that the robot knows, as a picture of its own.
import { meaning } from './learned.js';
import { robotDrawing } from './robot.js';
import { squares } from './share.js';
import { draw } from './state.js';

const FONT = 'Quicksand,Nunito,"Segoe UI",Roboto,"Noto Sans",system-ui,sans-serif';
export const STYLE = 'text{font-family:' + FONT + ';fill:#2c3346}.line,.eye,.mouth{fill:none;stroke:#2a2f40;stroke-width:2;stroke-linecap:round}.eye,.mouth{stroke:#8ff0df}.body{fill:#f9f3e4;stroke:#2a2f40;stroke-width:2}.wheel{fill:#3c4254}.face{fill:#25445a}.lamp{fill:#ffd75e;stroke:#2a2f40}.heart{fill:#e0526a;stroke:#2a2f40}.shadow{opacity:.17}.open,.frown,.down{display:none}';
const [WIDTH, MIDDLE, EDGE] = [1080, 540, 64];
const CONFETTI = ['#d8504d', '#4c9f6b', '#4a80c4', '#e6b840', '#8f64b3', '#e2863c'];
// Pixels of each square of the code: a phone reads it from a screen.
const SQUARE = 4;

const pen = /** @type {CanvasRenderingContext2D} */ (document.createElement('canvas').getContext('2d'));

/** How wide a text is. */
function widthOf(text, size, weight = 400) {
  pen.font = weight + ' ' + size + 'px ' + FONT;
  return pen.measureText(text).width;
}

// As large as there is room for.
const fitted = (size, room, width) => Math.min(size, size * room / width);
const line = (text, y, size, weight = 400) => draw('text', { x: MIDDLE, y, 'text-anchor': 'middle', 'font-size': fitted(size, WIDTH - 3 * EDGE, widthOf(text, size, weight)), 'font-weight': weight }, text);

/** Words and their ideas in rows, each word in a frame.
 * @param {[string, string][]} known
 * @param {number} top */
function chips(known, top) {
  const [size, high] = [30, 62];
  const rows = /** @type {{ width: number, chips: { word: string, idea: string, width: number, letters: number }[] }[]} */ ([]);
  for (const [word, token] of known) {
    // In a riddle the words stand alone.
    const idea = token && meaning(word, token);
    const wide = widthOf(word, size, 700) + widthOf(idea, size);
    const width = Math.min(WIDTH - 2 * EDGE, wide + 40);
    if (!rows.length || rows[rows.length - 1].width + width > WIDTH - 2 * EDGE) rows.push({ width: 0, chips: [] });
    const row = rows[rows.length - 1];
    row.chips.push({ word, idea, width, letters: fitted(size, width - 40, wide) });
    row.width += width + 14;
  }
  return {
    height: rows.length * (high + 14),
    drawn: rows.flatMap((row, at) => {
      let x = MIDDLE - (row.width - 14) / 2;
      return row.chips.map(({ word, idea, width, letters }) => {
        const y = top + at * (high + 14);
        const chip = draw('g', {}, draw('rect', { x, y, width, height: high, rx: 20, fill: '#fffdf7', stroke: '#d9cfba', 'stroke-width': 3 }),
          draw('text', { x: x + width / 2, y: y + 41, 'text-anchor': 'middle', 'font-size': letters }, draw('tspan', { 'font-weight': 700 }, word), idea));
        x += width + 14;
        return chip;
      });
    }),
  };
}

/** @param {string} name
 * @param {string} score
 * @param {[string, string][]} known words and their ideas; without these it is a riddle
 * @param {string} [link] the address where others meet this robot, for a QR code
 * @param {string} [meet] the text above the code
 * @param {boolean} [merry] whether there is something to celebrate
 * @returns {Promise<Blob>} a PNG file */
export async function picture(name, score, known, link = '', meet = '', merry = true) {
  const words = chips(known, 690);
  const code = link ? squares(link) : null;
  // On whole pixels, with a quiet zone of four squares.
  const side = code ? (code.size + 8) * SQUARE * Math.max(1, Math.floor(360 / ((code.size + 8) * SQUARE))) : 0;
  const below = 690 + words.height + 40;
  const height = below + (code ? 60 + side + EDGE : 30);
  const [left, under] = [Math.round(MIDDLE - side / 2), Math.round(below + 30)];
  const root = draw('svg', { xmlns: 'http://www.w3.org/2000/svg', viewBox: '0 0 ' + WIDTH + ' ' + height, width: WIDTH, height },
    draw('style', {}, STYLE),
    draw('rect', { width: WIDTH, height, fill: '#f6f0e2' }),
    draw('rect', { x: 24, y: 24, width: WIDTH - 48, height: height - 48, rx: 44, fill: '#fffaf0', stroke: '#2c3346', 'stroke-width': 5 }),
    // Confetti around the robot.
    ...Array.from({ length: merry ? 42 : 0 }, (_, at) => [70 + (at * 397) % (WIDTH - 140), 70 + (at * 211) % 420]).filter(([x]) => Math.abs(x - MIDDLE) > 185).map(([x, y], at) => draw('rect', {
      width: 20, height: 11, rx: 4, fill: CONFETTI[at % CONFETTI.length], opacity: 0.75, transform: 'translate(' + x + ' ' + y + ') rotate(' + (at * 67) % 180 + ')',
    })),
    draw('g', { transform: 'translate(' + MIDDLE + ' 315) scale(7.2)' }, ...robotDrawing()),
    line(name, 585, 84, 700),
    line(score, 640, 38),
    ...words.drawn,
    ...(code ? [line(meet, below, 34, 700), draw('rect', { x: left, y: under, width: side, height: side, fill: '#fff' }),
      draw('path', { d: code.path, fill: '#000', 'shape-rendering': 'crispEdges', transform: 'translate(' + left + ' ' + under + ') scale(' + side / (code.size + 8) + ') translate(4 4)' })] : []));
  const image = await rasterized(root);
  const canvas = Object.assign(document.createElement('canvas'), { width: WIDTH, height });
  canvas.getContext('2d')?.drawImage(image, 0, 0);
  return new Promise((done, failed) => { canvas.toBlob(blob => (blob ? done(blob) : failed(new Error('PNG'))), 'image/png'); });
}

/** A drawing that canvases take.
 * @param {SVGElement} root */
export async function rasterized(root) {
  const image = new Image();
  // A name may have characters that XML forbids: with them there would be no picture.
  const xml = new XMLSerializer().serializeToString(root).replace(/[^\t\n\r -\uD7FF\uE000-\uFFFD\u{10000}-\u{10FFFF}]/gu, '\uFFFD');
  image.src = 'data:image/svg+xml,' + encodeURIComponent(xml);
  await image.decode();
  return image;
}
