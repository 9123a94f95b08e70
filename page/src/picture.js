// A card with what the robot knows, as a picture that stands by itself.
import { robotDrawing } from './robot.js';
import { draw } from './state.js';
import { ideaWords } from './learned.js';

const STYLE = 'text{font-family:system-ui,sans-serif;fill:#2c3346}.line,.eye,.mouth{fill:none;stroke:#2a2f40;stroke-width:2;stroke-linecap:round}.eye,.mouth{stroke:#8ff0df}.eye.open{stroke-width:4.6}.body{fill:#f9f3e4;stroke:#2a2f40;stroke-width:2}.wheel{fill:#3c4254}.face{fill:#25445a}.lamp{fill:#ffd75e;stroke:#2a2f40}.shadow{opacity:.17}.smile,.frown,.down,.heart{display:none}';

/** @param {string} name
 * @param {string} score
 * @param {[string, string][]} known words and their ideas */
export function picture(name, score, known) {
  const height = 190 + Math.ceil(known.length / 2) * 30;
  const root = draw('svg', { xmlns: 'http://www.w3.org/2000/svg', viewBox: '0 0 640 ' + height, width: 640, height },
    draw('style', {}, STYLE),
    draw('rect', { width: 640, height, rx: 24, fill: '#f6f0e2' }),
    draw('g', { transform: 'translate(90 90) scale(2.4)' }, ...robotDrawing()),
    draw('text', { x: 190, y: 70, 'font-size': 34, 'font-weight': 700 }, name),
    draw('text', { x: 190, y: 110, 'font-size': 21 }, score),
    ...known.map(([word, token], at) => draw('text', { x: at % 2 ? 330 : 36, y: 190 + Math.floor(at / 2) * 30, 'font-size': 18 }, draw('tspan', { 'font-weight': 700 }, word), ': ' + ideaWords(token))));
  return new XMLSerializer().serializeToString(root);
}
