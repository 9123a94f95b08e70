// The beginning.
import { setUpBuild } from './build.js';
import { startCore, world } from './core.js';
import { nameHome, setMode, setUpPlay } from './play.js';
import { render } from './render.js';
import { robotDrawing } from './robot.js';
import { finishSession, finishWithoutLearning, giveFeedback, heatNow, refresh, stepOnce, stopSession, togglePause, undoSession } from './session.js';
import { setUpSettings, setUpShortcuts } from './settings.js';
import { setUpSpeech } from './speech.js';
import { $, KEYS, all, attempt, state } from './state.js';
import { fromBase64, kept, readHash, restoreAll } from './storage.js';
import { renderHeat } from './thoughts.js';
import { beginStop, enterStop, restartTour, watchTour } from './tour.js';

function setUp() {
  $('logo').append(...robotDrawing());
  setUpPlay();
  setUpSettings();
  setUpShortcuts();
  setUpSpeech();
  setUpBuild();
  for (const button of all('button[data-mode]')) button.addEventListener('click', () => setMode(button.dataset.mode));
  for (const [id, action] of Object.entries({
    good: () => giveFeedback('reward'), bad: () => giveFeedback('punish'), pause: togglePause, next: stepOnce, finish: finishSession,
    drop: finishWithoutLearning, undo: undoSession, lesson: () => beginStop(false), auto: () => beginStop(true), watch: watchTour, again: restartTour,
    onward: () => setMode('play'),
  })) $(id).addEventListener('click', action);
  $('heat-before').addEventListener('change', renderHeat);
  $('heat').closest('details').addEventListener('toggle', renderHeat);
  window.addEventListener('hashchange', () => {
    if (readHash()) {
      stopSession();
      state.mode = 'play';
      refresh();
      render();
    }
  });
}

async function main() {
  startCore(fromBase64($('module').textContent.trim()), Number($('module').dataset.size));
  // For the curious, at the browser's console, and for tests.
  Object.assign(window, { goodbot: world });
  await restoreAll();
  const own = kept(KEYS.home);
  if (own) attempt(() => world.setEnvironment(own));
  if (readHash()) state.mode = 'play';
  if (state.settings.style !== world.learnsStyle()) attempt(() => world.setLearnsStyle(state.settings.style));
  state.heat = { now: heatNow(), before: null };
  refresh();
  setUp();
  if (state.mode === 'tour') enterStop(state.tour.at);
  else nameHome();
  render();
  document.body.classList.add('ready');
}

main().catch(error => {
  $('say').textContent = 'This browser cannot run the robot: ' + error.message;
});
