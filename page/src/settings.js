// Settings, shortcuts, and what is kept and shared.
import { world } from './core.js';
import { loadLog } from './logs.js';
import { render } from './render.js';
import { RULES, SPEEDS, finishSession, giveFeedback, heatNow, refresh, stepOnce, stopSession, togglePause, wake } from './session.js';
import { $, KEYS, attempt, make, state, tell } from './state.js';
import { download, hashOf, keep, keepModel, keepSettings, keepTour, keepUndo, kept, loadModel, present, sessionsWord } from './storage.js';
import { enterHome, enterStop } from './tour.js';

const SWITCHES = ['style', 'shortcuts', 'ghost', 'names', 'pull'];

export function renderSettings() {
  const { settings } = state;
  $('speed').value = settings.speed;
  $('rule').value = settings.rule;
  $('rule-field').hidden = settings.speed !== 'confidence';
  for (const name of SWITCHES) $('set-' + name).checked = settings[name];
  $('theme').value = settings.theme;
  document.documentElement.dataset.theme = settings.theme;
  document.body.classList.toggle('no-shortcuts', !settings.shortcuts);
  $('kept').textContent = state.saved ? 'Kept in this browser: ' + sessionsWord() + '.' : 'This browser does not let the page keep anything. Save the model as a file.';
}

export function setUpSettings() {
  for (const [id, options] of /** @type {[string, Record<string, any>][]} */ ([['speed', SPEEDS], ['rule', RULES]])) {
    $(id).append(...Object.entries(options).map(([value, option]) => make('option', { value }, option.label)));
    $(id).addEventListener('change', () => {
      state.settings[id] = $(id).value;
      keepSettings();
      if (state.session && state.session.wake && state.phase === 'waiting' && $(id).value !== 'step') wake(state.session);
      render();
    });
  }
  for (const name of SWITCHES) {
    $('set-' + name).addEventListener('change', () => {
      state.settings[name] = $('set-' + name).checked;
      if (name === 'style') {
        stopSession();
        attempt(() => world.setLearnsStyle(state.settings.style));
        refresh();
      }
      if (name === 'pull') enterHome(world.environment());
      keepSettings();
      render();
    });
  }
  $('theme').addEventListener('change', () => {
    state.settings.theme = $('theme').value;
    keepSettings();
    render();
  });
  $('save-model').addEventListener('click', () => download('robot.goodbot', world.save(), 'application/octet-stream'));
  $('load-model').addEventListener('change', () => loadModel($('load-model')));
  $('load-log').addEventListener('change', () => loadLog($('load-log')));
  $('save-log').addEventListener('click', () => {
    const log = kept(KEYS.log);
    if (log) download('sessions.jsonl', log, 'application/jsonl');
    else tell('There is no log: no session has been learned from here.');
  });
  $('share').addEventListener('click', async () => {
    location.hash = hashOf();
    try {
      await navigator.clipboard.writeText(location.href);
      tell('The link to this home is copied.');
    } catch {
      tell('The address of this page now leads to this home. Copy it from the address bar.');
    }
  });
  $('new-robot').addEventListener('click', () => {
    keepUndo(present());
    newRobot();
    state.tour = { at: 0, done: [], watching: false };
    keepTour();
    if (state.mode === 'tour') enterStop(0);
    render();
    tell('A new robot. It knows no word. (Undo brings the old one back.)');
  });
}

// A robot that has learned nothing, in the same home.
export function newRobot() {
  stopSession();
  attempt(() => world.restart());
  refresh();
  state.evidence = [];
  state.support = null;
  state.heat = { now: heatNow(), before: null };
  keep(KEYS.log, null);
  keepModel();
}

// Single keys, as long as nobody types.
const KEYS_PRESSED = {
  g: () => giveFeedback('reward'), ArrowRight: () => giveFeedback('reward'), b: () => giveFeedback('punish'), ArrowLeft: () => giveFeedback('punish'),
  p: togglePause, n: stepOnce, f: finishSession,
};

export function setUpShortcuts() {
  document.addEventListener('keydown', event => {
    if (!state.settings.shortcuts || event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || !state.session) return;
    if (/** @type {Element} */ (event.target).closest('input:not([type=checkbox]), select, textarea, [role=slider], .scroll, dialog')) return;
    const action = KEYS_PRESSED[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
