// Free play: any command in any home, and the change between tour, free play and editor.
import { enterBuild } from './build.js';
import { Goodbot, course, parsed, world } from './core.js';
import { t } from './language.js';
import { ideas } from './learned.js';
import { refresh } from './session.js';
import * as shelf from './shelf.js';
import { $, isDrawn, make, nextFrame, render, state } from './state.js';
import { enterHome, enterStop, homeNamed } from './stops.js';
import { enterMode } from './store.js';
import { say } from './talk.js';
import { leaveSession, tellRobot } from './training.js';

let searches = 0;

// Commands that make sense here, for people who do not know what to say.
export async function renderIdeas() {
  $('ideas').hidden = Boolean(state.session) || state.secret === 'open';
  if (state.session || state.phase !== 'none' || state.mode !== 'play' || state.secret === 'open') return;
  if (isDrawn('ideas', state.scene, world.pulls())) return;
  $('ideas').replaceChildren();
  const search = searches += 1;
  const isStale = () => search !== searches || Boolean(state.session) || state.phase !== 'none' || state.mode !== 'play' || state.secret === 'open';
  // First the page is drawn.
  await nextFrame();
  const found = await ideas(isStale);
  if (isStale()) {
    // They are sought anew when nothing else goes on.
    if (search === searches) isDrawn('ideas');
    return;
  }
  $('ideas').replaceChildren(...found.map(idea => make('button', { type: 'button', class: 'idea', onclick: () => { $('command').value = idea; say(idea); } }, idea)));
}

export async function setMode(mode) {
  if (mode === state.mode || state.tour.watching || !await leaveSession()) return;
  await enterMode(mode);
  state.tab = mode === 'build' ? 'editor' : mode === 'play' && state.sessions ? 'challenges' : 'thoughts';
  if (mode === 'build') enterBuild();
  else if (mode === 'tour') enterStop(state.tour.at);
  else {
    // A link for a class may have fixed the home.
    enterHome(shelf.get('class') ?? world.environment());
    nameHome();
    render();
  }
}

// Chooses the current home on the list.
export function nameHome() {
  const home = world.environment();
  const known = course.homes.find(([, other]) => JSON.stringify(other) === home);
  $('home').value = known ? known[0] : home === JSON.stringify(shelf.read('drawing', {}).home) ? 'own' : 'random';
}

/** Writes the list of homes. */
export function writeHomes() {
  const { value } = $('home');
  $('home').replaceChildren(...course.homes.map(([name]) => make('option', { value: name }, name === 'Test' ? t('home.tests') : t('home.course', { name }))),
    make('option', { value: 'random' }, t('home.random')), make('option', { value: 'own' }, t('home.own')));
  if (value) $('home').value = value;
}

export function setUpPlay() {
  writeHomes();
  const choose = async () => {
    const { value } = $('home');
    if (!await leaveSession()) return;
    if (value === 'own') {
      const own = shelf.read('drawing', {}).home;
      if (own) enterHome(JSON.stringify(own));
      else setMode('build');
    } else if (value === 'random') {
      const { homes } = parsed(Goodbot.course(1 + Math.floor(Math.random() * 4e9)));
      enterHome(JSON.stringify(homes[Math.floor(Math.random() * homes.length)][1]));
    } else enterHome(homeNamed(value));
    render();
  };
  $('home').addEventListener('change', choose);
  $('choose').addEventListener('click', choose);
  $('tell').addEventListener('submit', event => {
    event.preventDefault();
    // Who has no words is offered some.
    const idea = $('ideas').firstChild?.textContent;
    if (!$('command').value && idea && !state.session) $('command').value = idea;
    else say($('command').value);
  });
  $('else').addEventListener('click', () => tellRobot(state.already, true));
  $('reset').addEventListener('click', async () => {
    if (!await leaveSession()) return;
    world.reset();
    refresh();
    render();
  });
}
