// What an address carries behind its #: a home with settings.
import { fromAddress, toAddress } from './bytes.js';
import { world } from './core.js';
import { RULES, SPEEDS } from './session.js';
import { state, tell } from './state.js';

// The settings that a link carries; the look and the keys are everybody's own.
const SHARED = ['speed', 'rule', 'style', 'pull', 'ghost', 'names'];

/** The address of this page with the home and the settings. */
export function homeLink() {
  const share = { home: JSON.parse(world.environment()), settings: Object.fromEntries(SHARED.map(name => [name, state.settings[name]])) };
  return location.href.split('#')[0] + '#home=' + toAddress(new TextEncoder().encode(JSON.stringify(share)));
}

/** Whether a setting may have this value.
 * @param {string} name */
export function isSetting(name, value) {
  if (name === 'speed') return Object.hasOwn(SPEEDS, value);
  if (name === 'rule') return Object.hasOwn(RULES, value);
  if (name === 'theme') return ['auto', 'light', 'dark'].includes(value);
  return typeof value === 'boolean';
}

/** Takes what the address carries, and takes it off the address, so that a reload does not undo what was changed since. Returns whether
 * there was something. Other marks behind the #, such as the one of the skip link, are none of ours. */
export function readLink() {
  // Links of earlier versions have no name before the text, which begins with {".
  const [, text] = location.hash.match(/^#(?:home=|(?=eyJ))(.*)$/) || [];
  if (text === undefined) return false;
  history.replaceState(null, '', location.href.split('#')[0]);
  try {
    const share = JSON.parse(new TextDecoder().decode(fromAddress(text)));
    world.setEnvironment(JSON.stringify(share.home));
    for (const name of SHARED) {
      const value = (share.settings || {})[name];
      if (isSetting(name, value)) state.settings[name] = value;
    }
    world.setPulls(state.settings.pull);
    if (state.settings.style !== world.learnsStyle()) world.setLearnsStyle(state.settings.style);
    return true;
  } catch {
    tell('The link is damaged: it may have been cut off. Ask for it once more.', true);
    return false;
  }
}
