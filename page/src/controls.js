// Settings, shortcuts, and saving and sharing.
import { answer } from './asking.js';
import { CHOICES, expectTrainer, expectedNow } from './believes.js';
import { attempt, world } from './core.js';
import { download, fileName } from './files.js';
import { names, speakLanguage, t, writePage } from './language.js';
import { homeLink, robotLink } from './link.js';
import { toMicrobit } from './microbit.js';
import { writeHomes } from './play.js';
import { printWorksheet } from './print.js';
import { considerWays, endGuest, keepGuest, loadLog, loadModel, newRobot, nextGroup, relearn, tellUnread } from './roster.js';
import { shareSecret } from './secret.js';
import { setUpSerial } from './serial.js';
import { isThere, refresh, wake } from './session.js';
import { LOOKS, RULES, SPEEDS, TABS, isSetting, keepSetting } from './settings.js';
import { setUpShare, share } from './share.js';
import { sound } from './sound.js';
import { $, all, make, render, state, tell } from './state.js';
import { enterHome, enterStop } from './stops.js';
import { change, giveStarter, logOf, tourNow } from './store.js';
import { finishSession, giveFeedback, leaveSession, stepOnce, takeBack, thatWasIt, togglePause } from './training.js';

const SWITCHES = ['presenter', 'questions', 'voice', 'sound', 'speech', 'shortcuts', 'ghost', 'names', 'pull'];

export function renderSettings() {
  const { settings } = state;
  $('speed').value = settings.speed;
  $('rule').value = settings.rule;
  $('rule-field').hidden = settings.speed !== 'confidence';
  for (const name of SWITCHES) $('set-' + name).checked = settings[name];
  if (state.phase !== 'learning') [$('set-ways').checked, $('set-starter').checked] = [world.ways(), state.robot.starter === document.documentElement.lang];
  for (const tab of TABS) $('show-' + tab).checked = !settings.hidden.split(' ').includes(tab);
  $('theme').value = settings.theme;
  renderBelieves();
  if (document.activeElement !== $('seed')) $('seed').value = settings.seed;
  $('language').value = document.documentElement.lang;
  document.documentElement.dataset.theme = settings.theme;
  document.body.classList.toggle('no-shortcuts', !settings.shortcuts);
}

let typing = false;

function renderBelieves() {
  const { style } = state.settings;
  const own = typing || !CHOICES.includes(style);
  $('believes').value = own ? 'own' : style;
  $('believes-field').hidden = !own;
  if (document.activeElement !== $('strategies')) $('strategies').value = style;
}

// Changes the trainer strategies that the robot expects; a session under way must be left first.
async function believe(text) {
  typing = false;
  if (text !== state.settings.style && await leaveSession()) {
    try {
      await change(t('undo.style'), async () => {
        expectTrainer(text);
        return '';
      });
    } catch (error) {
      tell(error.message, true);
    }
    keepSetting('style', expectedNow());
    refresh();
  }
  render();
}

// Writes the options of the lists, in words.
function writeOptions() {
  for (const [id, prefix, options] of /** @type {[string, string, string[]][]} */ ([['speed', 'speed.', Object.keys(SPEEDS)], ['rule', 'rule.', Object.keys(RULES)], ['theme', 'look.', LOOKS], ['believes', 'believes.', CHOICES]])) {
    $(id).replaceChildren(...options.map(value => make('option', { value }, t(/** @type {import('./language.js').Key} */ (prefix + value)))));
  }
  $('language').replaceChildren(...names().map(([value, name]) => make('option', { value, lang: value }, name)));
}

/** Writes the page anew, in the language of the settings. */
export function takeLanguage() {
  speakLanguage(state.settings.language);
  writePage();
  tellUnread();
  writeOptions();
  writeHomes();
  [state.said, state.verdict] = [null, ''];
  refresh();
  if (state.mode === 'tour' && !state.session && state.phase === 'none') enterStop(state.tour.at);
  render();
}

export function setUpSettings() {
  writeOptions();
  for (const id of ['speed', 'rule']) {
    $(id).addEventListener('change', () => {
      keepSetting(id, $(id).value);
      if (state.session && state.session.wake && state.phase === 'waiting' && $(id).value !== 'step') wake(state.session);
      render();
    });
  }
  for (const name of SWITCHES) {
    $('set-' + name).addEventListener('change', async () => {
      const value = $('set-' + name).checked;
      if (name === 'pull' && !await leaveSession()) return render();
      keepSetting(name, value);
      if (name === 'pull') enterHome(world.environment());
      if (name === 'sound') sound('good');
      return render();
    });
  }
  $('believes').addEventListener('change', () => {
    typing = $('believes').value === 'own';
    if (!typing) return believe($('believes').value);
    render();
    return $('strategies').select();
  });
  $('strategies').addEventListener('change', () => believe($('strategies').value));
  $('set-ways').addEventListener('change', async () => {
    const value = $('set-ways').checked;
    if (await leaveSession()) await considerWays(value);
    render();
  });
  $('set-starter').addEventListener('change', async () => {
    const starter = $('set-starter').checked ? document.documentElement.lang : '';
    if (await leaveSession()) await relearn(t('undo.starter'), () => giveStarter(starter));
    render();
  });
  $('theme').addEventListener('change', () => {
    keepSetting('theme', $('theme').value);
    render();
  });
  $('seed').addEventListener('change', () => {
    if (isSetting('seed', $('seed').valueAsNumber)) keepSetting('seed', $('seed').valueAsNumber);
    $('seed').value = state.settings.seed;
  });
  $('end-presenter').addEventListener('click', () => {
    keepSetting('presenter', false);
    render();
  });
  $('language').addEventListener('change', () => {
    keepSetting('language', $('language').value);
    takeLanguage();
  });
  for (const tab of TABS) {
    $('show-' + tab).addEventListener('change', () => {
      keepSetting('hidden', TABS.filter(one => !$('show-' + one).checked).join(' '));
      render();
    });
  }
  $('save-model').addEventListener('click', () => {
    const bytes = attempt(() => world.save());
    if (bytes) download(fileName() + '.goodbot', bytes, 'application/octet-stream');
  });
  $('load-model').addEventListener('change', () => loadModel($('load-model')));
  $('to-microbit').addEventListener('change', () => toMicrobit($('to-microbit'), fileName()));
  setUpSerial();
  for (const label of all('label.button')) {
    // A file can be dropped there too.
    label.addEventListener('dragover', event => event.preventDefault());
    label.addEventListener('drop', event => {
      event.preventDefault();
      if (!event.dataTransfer.files.length) return;
      label.control.files = event.dataTransfer.files;
      label.control.dispatchEvent(new Event('change'));
    });
  }
  $('load-log').addEventListener('change', () => loadLog($('load-log')));
  $('save-log').addEventListener('click', () => {
    const log = logOf(state.robot);
    if (log) download(fileName() + '.jsonl', log, 'application/jsonl');
    else tell(t('settings.noLog'));
  });
  $('share').addEventListener('click', () => share(homeLink(), t('settings.link'), t('link.home')));
  $('share-class').addEventListener('click', () => share(homeLink(true), t('class.link'), t('class.linkAbout')));
  $('meet').addEventListener('click', async () => share(await robotLink(), t('link.meet', state.robot), t('link.robot')));
  $('meet-secret').addEventListener('click', shareSecret);
  $('along').addEventListener('click', async () => share(await robotLink({ tour: tourNow(), mode: state.mode }), state.robot.name, t('along.about', state.robot), true));
  $('along-code').addEventListener('change', () => {
    const text = $('along-code').value.trim();
    $('along-code').value = '';
    // The whole link, or its end.
    if (text) location.hash = 'robot=' + text.replace(/^.*#robot=/, '');
  });
  setUpShare();
  $('new-robot').addEventListener('click', async () => {
    if (await leaveSession()) await newRobot();
  });
  $('next-group').addEventListener('click', nextGroup);
  $('worksheet').addEventListener('click', printWorksheet);
  $('keep-guest').addEventListener('click', keepGuest);
  $('end-guest').addEventListener('click', endGuest);
}

// Single keys, while no field has the focus.
const KEYS_PRESSED = {
  g: () => giveFeedback('reward'), ArrowRight: () => giveFeedback('reward'), b: () => giveFeedback('punish'), ArrowLeft: () => giveFeedback('punish'),
  p: togglePause, n: stepOnce, f: () => (isThere() ? thatWasIt() : finishSession()), Backspace: takeBack,
};

// Keys for the answers to a question.
const ANSWERS = { y: 'yes', n: 'no', 1: '1', 2: '2', 3: '3' };

export function setUpShortcuts() {
  document.addEventListener('keydown', event => {
    if (!state.settings.shortcuts || event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || !state.session) return;
    if (/** @type {Element} */ (event.target).closest('input:not([type=checkbox]), select, textarea, [role=slider], .scroll, dialog')) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const action = state.session.question && key in ANSWERS ? () => answer(ANSWERS[key]) : KEYS_PRESSED[key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
