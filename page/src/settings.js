// The settings: their values, and how they are kept.
import { names } from './language.js';
import * as shelf from './shelf.js';
import { state } from './state.js';

// How many milliseconds the robot waits after a step.
/** @type {Record<string, (sure: number) => number>} */
export const SPEEDS = {
  step: () => Infinity, slow: () => 2600, normal: () => 1400, fast: () => 400, once: () => 0, confidence: sure => 350 + 2900 * RULES[state.settings.rule](sure),
};

// How long the robot waits, from 0 to 1: the less sure it is of its next action, the longer (the authors' three rules).
export const RULES = {
  linear: sure => 1 - sure, sigmoid: sure => 1 / (1 + Math.exp(12 * (sure - 0.6))), threshold: sure => (sure < 0.7 ? 1 : 0),
};

/** The tabs that need not be shown. */
export const TABS = ['thoughts', 'words', 'steps', 'challenges', 'robots'];

export const LOOKS = ['auto', 'light', 'dark'];

/** Whether a setting may have this value.
 * @param {string} name */
export function isSetting(name, value) {
  if (name === 'speed') return Object.hasOwn(SPEEDS, value);
  if (name === 'rule') return Object.hasOwn(RULES, value);
  if (name === 'theme') return LOOKS.includes(value);
  if (name === 'language') return names().some(([code]) => code === value);
  if (name === 'seed') return Number.isInteger(value) && value >= 0 && value < 2 ** 32;
  if (name === 'hidden') return typeof value === 'string' && value.split(' ').every(tab => !tab || TABS.includes(tab));
  if (name === 'style' && typeof value === 'string') return true;
  return typeof value === 'boolean';
}

/** Sets and keeps one setting alone: another tab may have changed others.
 * @param {string} name */
export function keepSetting(name, value) {
  state.settings[name] = value;
  shelf.put('settings', JSON.stringify({ ...shelf.read('settings', {}), [name]: value }));
}

/** Restores the kept settings, as far as this version knows them. */
export function restoreSettings() {
  for (const [name, value] of Object.entries(shelf.read('settings', {}))) {
    if (name in state.settings && isSetting(name, value)) state.settings[name] = value;
  }
}
