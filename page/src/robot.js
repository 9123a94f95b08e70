// The robot and the things it moves, as drawings. Each is centred on 0, 0 in a cell of 48.
import { draw } from './state.js';

const COLORS = {
  red: '#d8504d', green: '#4c9f6b', blue: '#4a80c4', yellow: '#e6b840', purple: '#8f64b3', orange: '#e2863c', tan: '#c8a679', teal: '#369c9b',
  magenta: '#c94f91', pink: '#e48fb1', brown: '#8a6242', white: '#f4f1ea', black: '#3a3d45', grey: '#8d929c', gray: '#8d929c',
};
export const colorOf = name => COLORS[name.toLowerCase()] || '#8d929c';

export function robotDrawing() {
  return [
    draw('ellipse', { cx: 0, cy: 19, rx: 17, ry: 4, class: 'shadow' }),
    draw('g', { class: 'bob' },
      draw('path', { d: 'M-18 3q-3 5 0 11h5V3zM18 3q3 5 0 11h-5V3z', class: 'wheel' }),
      draw('path', { d: 'M0-15v-5', class: 'line' }),
      draw('circle', { cx: 0, cy: -21.5, r: 3, class: 'lamp' }),
      draw('path', { d: 'M-11-15.5Q0-17 11-15.2q4.500.2 4.7 5Q16.4 0 15.5 11q-.3 5.6-5.4 6Q0 18.2-10 17q-5.3-.4-5.6-6Q-16.5 0-15.7-10q.2-5.2 4.7-5.500z', class: 'body' }),
      draw('path', { d: 'M-8.5-10.500Q0-11.5 8.5-10.500q3 .2 3.2 3Q12-3 11.600.3q-.2 3-3.2 3.200Q0 4.3-8.4 3.500q-3-.2-3.2-3.200Q-12-3-11.7-7.500q.2-2.8 3.2-3z', class: 'face' }),
      draw('g', { class: 'eyes' },
        draw('path', { d: 'M-5.2-4.600v.1M5.2-4.600v.1', class: 'eye open' }),
        draw('path', { d: 'M-7.4-3.600q2.2-3 4.4 0M3-3.600q2.2-3 4.4 0', class: 'eye smile' }),
        draw('path', { d: 'M-7.2-5.600l4 1.600M7.2-5.600l-4 1.600', class: 'eye frown' }),
        draw('path', { d: 'M-3 .2q3 2 6 0', class: 'mouth up' }),
        draw('path', { d: 'M-3 1.600q3-2 6 0', class: 'mouth down' })),
      draw('path', { d: 'M-6 9.500h3M-1.5 9.500h3M3 9.500h3', class: 'line thin' })),
    draw('path', { d: 'M0-26q-9-6-5-10t5 1q1-5 5-1t-5 10z', class: 'heart' }),
  ];
}

const SHAPES = {
  chair: ['M-9-13Q0-14.5 9-13l1 8.500Q0-3-10-4.500z', 'M-11-3Q0-4.2 11-3q1.5 6 .5 11Q0 9.5-11.5 8q-1-5.500.5-11z', 'M-9.5 8.500l-1 6M9.5 8.500l1 6'],
  bag: ['M-12-3Q0-4.5 12-3q2.5 8 2 14Q0 13.5-14 11q-.5-6 2-14z', '', 'M-6-3q-1-10 6-10t6 10M-2 2q2 1.5 4 0'],
  backpack: ['M-10-6q1-8 10-8t10 8q2 9 1 17Q0 13-11 11q-1-8 1-17z', 'M-7 3Q0 2 7 3l.5 7Q0 11.5-7.5 10z', 'M-3.5-14q0-3.5 3.5-3.500t3.5 3.500M-5-4Q0-5 5-4'],
  basket: ['M-13-3Q0-4.5 13-3l-3 13Q0 12.5-10 10z', '', 'M-9-3.500Q-7-14 0-14t9 10.500M-12 1.500Q0 3 12 1.500M-11 6Q0 7.5 11 6M-5-3l1.5 14M5-3L3.5 11'],
  star: ['M0-14l4 9 10 .8-7.6 6.400L9 12 0 6.8-9 12l2.6-9.800L-14-4.2-4-5z', '', ''],
  ball: ['M0-12A12 12 0 1 1-.1-12z', '', 'M-7-6Q0-2 7-6M-7 6Q0 2 7 6'],
};
const BOX = ['M-11-9Q0-10.5 11-9q1.5 10 .5 20Q0 12.5-11.5 11q-1-10 .5-20z', '', 'M-11-2Q0-3.5 11-2M0-10v21'];

export function blockDrawing(block) {
  const [main, second, lines] = SHAPES[block.shape.toLowerCase()] || BOX;
  return [
    draw('ellipse', { cx: 0, cy: 13, rx: 14, ry: 3.5, class: 'shadow' }),
    draw('path', { d: main, class: 'solid', fill: colorOf(block.color) }),
    second ? draw('path', { d: second, class: 'solid', fill: colorOf(block.color) }) : null,
    lines ? draw('path', { d: lines, class: 'line' }) : null,
  ];
}
