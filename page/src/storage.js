// What survives a reload: model, log, home and settings, in the browser's storage.
import { world } from './core.js';
import { render } from './render.js';
import { LEARN_BUDGET, RULES, SPEEDS, heatNow, refresh, stopSession } from './session.js';
import { KEYS, attempt, inParts, make, state, tell } from './state.js';

export function keep(key, value) {
  try {
    if (value === null) localStorage.removeItem(key);
    else localStorage.setItem(key, value);
    state.saved = true;
  } catch {
    state.saved = false;
  }
}

export function kept(key) {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

function toBase64(bytes) {
  let text = '';
  for (let at = 0; at < bytes.length; at += 8192) text += String.fromCharCode(...bytes.subarray(at, at + 8192));
  return btoa(text);
}

export const fromBase64 = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));

export function keepModel() {
  const bytes = attempt(() => world.save());
  if (bytes) keep(KEYS.model, toBase64(bytes));
  state.sessions = world.sessions();
}

export function keepSettings() {
  keep(KEYS.settings, JSON.stringify(state.settings));
}

export function appendLog(lines) {
  keep(KEYS.log, (kept(KEYS.log) || '') + lines);
}

// What can be undone, also after a reload.
export const present = () => ({ model: world.save(), log: kept(KEYS.log), tour: { at: state.tour.at, done: [...state.tour.done] } });

export function keepUndo(undo) {
  state.undo = undo;
  keep(KEYS.undo, undo && JSON.stringify({ ...undo, model: toBase64(undo.model) }));
}

export async function restoreAll() {
  const settings = kept(KEYS.settings);
  if (settings) {
    try {
      Object.assign(state.settings, JSON.parse(settings));
    } catch { /* Settings of another version are left alone. */ }
  }
  const model = kept(KEYS.model);
  if (model) {
    try {
      await takeModel(fromBase64(model));
    } catch (error) {
      tell('What this browser kept cannot be used: ' + error.message + '.', true);
    }
  }
  try {
    const undo = JSON.parse(kept(KEYS.undo) || 'null');
    if (undo) state.undo = { ...undo, model: fromBase64(undo.model) };
  } catch { /* Then nothing can be undone. */ }
  try {
    const tour = JSON.parse(kept(KEYS.tour) || 'null');
    if (tour && Array.isArray(tour.done)) Object.assign(state.tour, { at: tour.at | 0, done: tour.done });
  } catch { /* A tour of another version begins anew. */ }
}

export const keepTour = () => keep(KEYS.tour, JSON.stringify({ at: state.tour.at, done: state.tour.done }));

// Files.
export function download(name, content, type) {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = make('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

export const readFile = (input, how) => new Promise((done, failed) => {
  const file = input.files[0];
  input.value = '';
  if (!file) return;
  const reader = new FileReader();
  reader.onload = () => done(reader.result);
  reader.onerror = () => failed(reader.error);
  if (how === 'bytes') reader.readAsArrayBuffer(file);
  else reader.readAsText(file);
});

// Takes over a model, a part at a time; throws where it is none.
export async function takeModel(bytes) {
  world.restore(bytes);
  await inParts(() => world.learn(LEARN_BUDGET));
  state.sessions = world.sessions();
  state.settings.style = world.learnsStyle();
}

export async function loadModel(input) {
  const bytes = new Uint8Array(await readFile(input, 'bytes'));
  stopSession();
  const before = present();
  state.phase = 'learning';
  try {
    await takeModel(bytes);
  } catch (error) {
    tell('This file is no model that can be used: ' + error.message + '. The robot keeps what it knew.', true);
    return;
  } finally {
    state.phase = 'none';
    render();
  }
  keepUndo(before);
  // The log here is of what this robot no longer knows.
  keep(KEYS.log, null);
  state.heat = { now: heatNow(), before: null };
  keepModel();
  refresh();
  render();
  tell('The robot now knows what the file knows: ' + sessionsWord() + '.');
}

export const sessionsWord = () => state.sessions + (state.sessions === 1 ? ' session' : ' sessions');

// The settings that a link carries; the look and the keys are everybody's own.
const SHARED = ['speed', 'rule', 'style', 'pull', 'ghost', 'names'];

// The home and the settings in the address, so that a link is enough to share them.
export function hashOf() {
  const share = { home: JSON.parse(world.environment()), settings: Object.fromEntries(SHARED.map(name => [name, state.settings[name]])) };
  return '#' + toBase64(new TextEncoder().encode(JSON.stringify(share))).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

export function readHash() {
  const text = location.hash.slice(1);
  if (!text) return false;
  try {
    const share = JSON.parse(new TextDecoder().decode(fromBase64(text.replaceAll('-', '+').replaceAll('_', '/'))));
    world.setEnvironment(JSON.stringify(share.home));
    for (const name of SHARED) {
      const value = (share.settings || {})[name];
      const known = { speed: value in SPEEDS, rule: value in RULES }[name];
      if (known || (known === undefined && typeof value === 'boolean')) state.settings[name] = value;
    }
    world.setPulls(state.settings.pull);
    if (state.settings.style !== world.learnsStyle()) world.setLearnsStyle(state.settings.style);
    return true;
  } catch (error) {
    tell('The link could not be read: ' + error.message, true);
    return false;
  }
}
