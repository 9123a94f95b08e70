// The picture in docs/how-it-works.md: a belief that moves as the reader says good, bad or nothing. It is the robot of the npm package, in the
// first lesson of docs/examples/sessions.jsonl. Without this script, a still picture stays.
import { Goodbot } from 'goodbot';
import sessions from '../../docs/examples/sessions.jsonl';

const { environment, command } = JSON.parse(sessions.split('\n', 1)[0]);
// The paper's balanced trainer, for certain, as in the page's text: mu+, mu-, epsilon; no lags; rests judged as moves.
const BALANCED = new Float32Array([0.7, 0.7, 0.1, 1, 1, 0, 0, 0.7, 0.7, 0.1, 0]);
const WORDS = [['Good bot', 'reward'], ['Bad bot', 'punish'], ['say nothing', 'neutral']];
const STEPS = 40;

const figure = document.getElementById('belief');
const made = (name, text = '', style = '') => Object.assign(document.createElement(name), { textContent: text, style });

let robot = new Goodbot(1);
let steps = 0;

/** The robot's next step, which nobody has judged yet. */
function step() {
  while (!robot.plan(10000));
  steps += 1;
  return JSON.parse(robot.act()).action;
}

function begin() {
  robot = new Goodbot(1);
  steps = 0;
  robot.setStrategies(BALANCED);
  robot.setEnvironment(JSON.stringify(environment));
  robot.hear(command);
  draw([]);
}

/** The name of a task in the page's text. */
function named(task) {
  const color = environment.objects.find(({ name }) => task.endsWith(`${name})`))?.color ?? task;
  return (task.startsWith('block') ? 'chair to ' : 'go to ') + color;
}

/** Shows the belief, then does the next step; `said` has the steps and the words before. */
function draw(said) {
  const { tasks } = JSON.parse(robot.belief());
  const action = steps < STEPS ? step() : '';
  const rows = tasks.map(({ name, probability }) => {
    const row = made('div', '', 'display:flex;align-items:center;gap:0.5em');
    const bar = made('span', '', `display:inline-block;height:0.9em;background:#3a7bd5;width:${(probability * 14).toFixed(2)}em`);
    row.append(made('span', named(name), 'width:9em'), made('span', probability.toFixed(3), 'width:3.5em;font-variant-numeric:tabular-nums'), bar);
    row.dataset.probability = String(probability);
    return row;
  });
  const buttons = made('div', '', 'margin-top:0.6em');
  for (const [text, feedback] of action ? WORDS : []) {
    const button = made('button', text, 'margin-right:0.6em');
    button.onclick = () => {
      robot.judge(feedback);
      draw([...said, `${action}: ${text}`]);
    };
    buttons.append(button);
  }
  const again = made('button', 'Again');
  again.onclick = begin;
  buttons.append(again);
  const asked = action ? `It went ${action}. What do you say?` : 'That was long. Begin again.';
  const map = made('pre', JSON.parse(robot.scene()).map);
  figure.replaceChildren(made('p', `"${command}"`), map, ...rows, made('p', said.slice(-3).join(', ')), made('p', asked), buttons);
}

if (figure) begin();
