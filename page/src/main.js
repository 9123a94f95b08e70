// Sets up the page.
import { setUpBeside } from './beside.js';
import { drawnElsewhere, setUpBuild } from './build.js';
import { shareSession } from './charts.js';
import { setUpCollector } from './collector.js';
import { setUpSettings, setUpShortcuts, takeLanguage } from './controls.js';
import { attempt, startCore, whileLearning, world } from './core.js';
import { speakLanguage, takeLanguages, writePage } from './language.js';
import { readLink } from './link.js';
import { setUpNext } from './next.js';
import { setUpOwnTests } from './owntests.js';
import { watchSize } from './plan.js';
import { nameHome, setMode, setUpPlay } from './play.js';
import { renderPage } from './render.js';
import { robotDrawing } from './robot.js';
import { joinStudy, meet, tellUnread, undo } from './roster.js';
import { isThere, takeStock } from './session.js';
import { restoreSettings } from './settings.js';
import * as shelf from './shelf.js';
import { $, all, drawBy, render, state } from './state.js';
import { enterStop } from './stops.js';
import { enterMode, openLast, othersTaught, wouldBeLost } from './store.js';
import { saveTable, showTable } from './tables.js';
import { setUpTabs } from './tabs.js';
import { judge } from './talk.js';
import { renderHeat } from './thoughts.js';
import { attend, beginAppendix, beginStop, changeTour, restartTour, setUpTour, watchTour } from './tour.js';
import { finishSession, finishWithoutLearning, leaveSession, pick, showSession, stepOnce, takeUpSession, thatWasIt, togglePause } from './training.js';
import { setUpSpeech } from './voice.js';

function setUp() {
  drawBy(renderPage);
  $('logo').append(...robotDrawing());
  setUpPlay();
  setUpSettings();
  setUpShortcuts();
  setUpSpeech();
  setUpBuild();
  setUpNext();
  setUpOwnTests();
  setUpTabs();
  setUpCollector();
  setUpBeside();
  setUpTour();
  watchSize();
  for (const button of all('button[data-mode]')) button.addEventListener('click', () => setMode(button.dataset.mode));
  for (const [id, action] of Object.entries({
    good: () => judge('reward'), bad: () => judge('punish'), pause: togglePause, next: stepOnce, finish: () => (isThere() ? thatWasIt() : finishSession()),
    drop: finishWithoutLearning, undo: () => undo('past'), redo: () => undo('future'), lesson: () => beginStop(false), auto: () => beginStop(true), watch: watchTour,
    again: restartTour, other: changeTour, amend: () => undo('past'), onward: () => setMode('play'), 'move-in': () => setMode('play'), appendix: beginAppendix,
  })) $(id).addEventListener('click', action);
  $('pick').addEventListener('change', () => pick($('pick').value));
  $('heat-before').addEventListener('change', renderHeat);
  $('save-table').addEventListener('click', saveTable);
  $('show-table').addEventListener('click', showTable);
  $('share-session').addEventListener('click', shareSession);
  window.addEventListener('hashchange', async () => {
    if (!await leaveSession() || await joinStudy()) return;
    const isHome = readLink();
    const visitor = isHome ? null : await meet();
    if (!isHome && !visitor) return;
    await enterMode(visitor?.mode ?? 'play');
    if (isHome) takeLanguage();
    takeStock();
    showMode();
    render();
    showSession(visitor?.session);
  });
  shelf.watch(async key => {
    if (key === 'robot.' + state.robot.id && !state.session && state.phase === 'none') await takeOver();
    if (key === 'drawing') drawnElsewhere();
    if (key.startsWith('robot.')) render();
  });
  // Data that the browser does not keep are lost with the page.
  window.addEventListener('beforeunload', event => { if (wouldBeLost()) event.preventDefault(); });
}

function showMode() {
  if (state.mode === 'tour') enterStop(state.tour.at);
  else nameHome();
}

// Another tab has taught the robot of this one.
async function takeOver() {
  const taught = await whileLearning(othersTaught);
  if (taught) takeStock();
  const { at, done } = state.robot.tour;
  if (at === state.tour.at && done.join() === state.tour.done.join()) return;
  Object.assign(state.tour, { done: [...done], own: state.robot.tour.own ?? null });
  if (state.mode === 'tour') enterStop(at);
  else state.tour.at = at;
}

// Begins with the unpacked parts: the core's module, and the texts of all languages.
async function begin(module, languages) {
  takeLanguages(languages);
  restoreSettings();
  speakLanguage(state.settings.language);
  writePage();
  startCore(module);
  tellUnread();
  // For the curious, at the browser's console, and for tests.
  Object.assign(window, { goodbot: world });
  shelf.beHere();
  await openLast();
  const home = shelf.get('home');
  if (home) attempt(() => world.setEnvironment(home));
  if (readLink()) {
    speakLanguage(state.settings.language);
    writePage();
    await enterMode('play');
  }
  const visited = await meet();
  takeStock();
  setUp();
  if (visited || !await takeUpSession(attend)) showMode();
  tellUnread();
  render();
  document.body.classList.add('ready');
  showSession(visited?.session);
  await joinStudy();
}

// For page/src/begin.js.
Object.assign(globalThis, { goodbotBegin: begin });
