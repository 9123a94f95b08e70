// What survives a reload: model, log, home and settings, in the browser's storage.
function keep(key, value) {
  try {
    if (value === null) localStorage.removeItem(key);
    else localStorage.setItem(key, value);
    state.saved = true;
  } catch {
    state.saved = false;
  }
}

function kept(key) {
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

const fromBase64 = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));

function keepModel() {
  const bytes = attempt(() => world.save());
  if (bytes) keep(KEYS.model, toBase64(bytes));
  state.sessions = world.sessions();
}

function keepSettings() {
  keep(KEYS.settings, JSON.stringify(state.settings));
}

function appendLog(lines) {
  keep(KEYS.log, (kept(KEYS.log) || '') + lines);
}

function restoreAll() {
  const settings = kept(KEYS.settings);
  if (settings) {
    try {
      Object.assign(state.settings, JSON.parse(settings));
    } catch { /* Settings of another version are left alone. */ }
  }
  const model = kept(KEYS.model);
  if (model) {
    attempt(() => takeModel(fromBase64(model)));
  }
  try {
    const tour = JSON.parse(kept(KEYS.tour));
    if (tour && Array.isArray(tour.done)) Object.assign(state.tour, { at: tour.at | 0, done: tour.done });
  } catch { /* A tour of another version begins anew. */ }
}

const keepTour = () => keep(KEYS.tour, JSON.stringify({ at: state.tour.at, done: state.tour.done }));

// Files.
function download(name, content, type) {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = make('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

const readFile = (input, how) => new Promise((done, failed) => {
  const file = input.files[0];
  input.value = '';
  if (!file) return;
  const reader = new FileReader();
  reader.onload = () => done(reader.result);
  reader.onerror = () => failed(reader.error);
  if (how === 'bytes') reader.readAsArrayBuffer(file);
  else reader.readAsText(file);
});

// Takes over a model; throws where it is none.
function takeModel(bytes) {
  world.restore(bytes);
  while (!world.learn(LEARN_BUDGET));
  state.sessions = world.sessions();
  state.settings.style = world.learnsStyle();
}

async function loadModel(input) {
  const bytes = new Uint8Array(await readFile(input, 'bytes'));
  stopSession();
  const before = world.save();
  try {
    takeModel(bytes);
  } catch (error) {
    tell('This file is no model that can be used: ' + error.message + '. The robot keeps what it knew.', true);
    return;
  }
  state.undo = { model: before, log: kept(KEYS.log) };
  state.heat = { now: heatNow(), before: null };
  keepModel();
  render();
  tell('The robot now knows what the file knows: ' + sessionsWord() + '.');
}

// Goes through the sessions of a log and learns from them, one after the other.
async function loadLog(input) {
  const lines = (await readFile(input, 'text')).split('\n').filter(line => line.trim());
  stopSession();
  const before = { model: world.save(), log: kept(KEYS.log) };
  const home = world.environment();
  state.phase = 'learning';
  render();
  let number = 0;
  try {
    for (const line of lines) {
      number += 1;
      const record = JSON.parse(line);
      if (record.type === 'session') {
        const strange = ['prior', 'continues', 'actions'].find(field => field in record) || (record.kind !== 'feedback' && 'kind');
        if (strange) throw new Error('the page cannot go through a session with this “' + strange + '”; the command line can');
        world.setEnvironment(JSON.stringify(record.environment));
        if (record.strategies && !world.learnsStyle()) world.setLearnsStyle(true);
        world.hear(record.command);
      } else if (record.type === 'step') {
        while (!world.plan(PLAN_BUDGET)) await nextFrame();
        world.actAs(record.action);
        world.judge(record.feedback);
      } else if (record.learn) {
        appendLog(world.finish());
        while (!world.learn(LEARN_BUDGET)) await nextFrame();
      } else world.forget();
    }
    tell('The robot has gone through the log.');
  } catch (error) {
    takeModel(before.model);
    keep(KEYS.log, before.log);
    tell('Line ' + number + ' of this log cannot be used: ' + error.message + '. The robot knows what it knew before.', true);
  }
  state.phase = 'none';
  state.undo = before;
  state.settings.style = world.learnsStyle();
  world.setEnvironment(home);
  state.heat = { now: heatNow(), before: null };
  keepModel();
  refresh();
  render();
}

const sessionsWord = () => state.sessions + (state.sessions === 1 ? ' session' : ' sessions');

// The home and the settings in the address, so that a link is enough to share them.
function hashOf() {
  const share = { home: JSON.parse(world.environment()), settings: { speed: state.settings.speed, rule: state.settings.rule, style: state.settings.style } };
  return '#' + toBase64(new TextEncoder().encode(JSON.stringify(share))).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

function readHash() {
  const text = location.hash.slice(1);
  if (!text) return false;
  try {
    const share = JSON.parse(new TextDecoder().decode(fromBase64(text.replaceAll('-', '+').replaceAll('_', '/'))));
    world.setEnvironment(JSON.stringify(share.home));
    const { speed, rule, style } = share.settings || {};
    if (speed in SPEEDS) state.settings.speed = speed;
    if (rule in RULES) state.settings.rule = rule;
    if (typeof style === 'boolean') state.settings.style = style;
    return true;
  } catch (error) {
    tell('The link could not be read: ' + error.message, true);
    return false;
  }
}
