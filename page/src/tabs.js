// One panel beside the stage, with tabs. Which tabs there are depends on the mode, and on whether the robot knows anything.
import { knowsWords } from './learned.js';
import { $, all, render, state } from './state.js';

/** @typedef {'thoughts' | 'words' | 'steps' | 'challenges' | 'robots' | 'editor' | 'settings'} Tab */

// A robot that knows nothing has no words and no steps to show.
/** @type {() => Tab[]} */
function offered() {
  if (state.mode === 'build') return ['editor', 'settings'];
  const nothing = !knowsWords() && !state.session;
  const hidden = state.settings.hidden.split(' ');
  /** @type {Tab[]} */
  const all = [...(/** @type {Tab[]} */ (nothing ? ['thoughts'] : ['thoughts', 'words', 'steps'])), ...(/** @type {Tab[]} */ (state.mode === 'play' ? ['challenges'] : [])), 'robots', 'settings'];
  return all.filter(tab => !hidden.includes(tab));
}

/** Whether a tab's panel is visible: large tables and charts are drawn only then.
 * @param {Tab} tab */
export const isShown = tab => !$('panel').hidden && !$('panel-' + tab).hidden;

/** @param {Tab} tab */
export function showTab(tab) {
  state.tab = tab;
  render();
}

let taught = false;

export function renderTabs() {
  // In free play, the challenges give way to the robot's thoughts while a session is under way.
  const teaching = Boolean(state.session && !state.session.looking);
  if (state.mode === 'play' && taught !== teaching && state.tab === (teaching ? 'challenges' : 'thoughts')) state.tab = teaching ? 'thoughts' : 'challenges';
  taught = teaching;
  // The game of a secret language hides the thoughts.
  $('panel').hidden = state.secret === 'open';
  const tabs = offered();
  if (!tabs.includes(state.tab)) state.tab = tabs[0];
  for (const button of all('#tabs button')) {
    const tab = button.id.slice(4);
    const chosen = tab === state.tab;
    button.hidden = !tabs.includes(tab);
    button.setAttribute('aria-selected', chosen);
    button.tabIndex = chosen ? 0 : -1;
    $('panel-' + tab).hidden = !chosen;
  }
}

export function setUpTabs() {
  for (const button of all('#tabs button')) button.addEventListener('click', () => showTab(button.id.slice(4)));
  $('tabs').addEventListener('keydown', event => {
    const tabs = offered();
    const at = tabs.indexOf(state.tab);
    const to = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: tabs.length - 1 }[event.key];
    if (to === undefined) return;
    // In a session these keys are Bad and Good elsewhere.
    event.preventDefault();
    showTab(tabs[(to + tabs.length) % tabs.length]);
    $('tab-' + state.tab).focus();
  });
}
