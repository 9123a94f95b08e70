// The browser's storage. Texts that it refuses are held in this tab, so that they can still be used and saved as files.
const PREFIX = 'goodbot.';

/** @type {Map<string, string | null>} */
const held = new Map();

/** Keeps a text, or removes it if `value` is null. Returns whether the browser took it.
 * @param {string} key
 * @param {string | null} value */
export function put(key, value) {
  try {
    if (value === null) localStorage.removeItem(PREFIX + key);
    else localStorage.setItem(PREFIX + key, value);
    held.delete(key);
    return true;
  } catch {
    held.set(key, value);
    return false;
  }
}

/** @param {string} key
 * @returns {string | null} */
export function get(key) {
  if (held.has(key)) return held.get(key) ?? null;
  try {
    return localStorage.getItem(PREFIX + key);
  } catch {
    return null;
  }
}

/** The keys with this beginning, without it.
 * @param {string} beginning */
export function keysOf(beginning) {
  const keys = [...held.keys()].filter(key => held.get(key) !== null);
  try {
    for (let at = 0; at < localStorage.length; at += 1) {
      const key = localStorage.key(at) || '';
      if (key.startsWith(PREFIX)) keys.push(key.slice(PREFIX.length));
    }
  } catch { /* Then there are only those that are held. */ }
  return [...new Set(keys)].filter(key => key.startsWith(beginning) && get(key) !== null).map(key => key.slice(beginning.length));
}

/** The keys that the browser refused to keep. */
export const refused = () => [...held.keys()].filter(key => held.get(key) !== null);

/** The value of a JSON text, or `otherwise` if there is none that can be read.
 * @param {string} key
 * @param {any} otherwise */
export function read(key, otherwise) {
  try {
    return JSON.parse(get(key) || '') ?? otherwise;
  } catch {
    return otherwise;
  }
}

/** Texts that belong to this tab alone, and survive its reload. */
export const ofTab = {
  /** @param {string} key */
  get(key) {
    try {
      return sessionStorage.getItem(PREFIX + key);
    } catch {
      return null;
    }
  },
  /** @param {string} key
   * @param {string | null} value */
  put(key, value) {
    try {
      if (value === null) sessionStorage.removeItem(PREFIX + key);
      else sessionStorage.setItem(PREFIX + key, value);
    } catch { /* A reload then begins anew. */ }
  },
};

// The name of this page, as long as it is open.
const here = Date.now().toString(36) + Math.random().toString(36).slice(2);

/** Lets the other tabs know that this page is open. */
export function beHere() {
  navigator.locks?.request(PREFIX + 'here.' + here, () => new Promise(() => { /* As long as the page is open. */ })).catch(() => { /* Then no tab resumes its session. */ });
}

/** The session of a tab: it is kept for a reload, and for the next tab if this one is closed or the browser ends. */
export const underWay = {
  /** @param {string | null} value */
  put(value) {
    ofTab.put('session', value);
    if (value !== null) put('session', JSON.stringify({ here, value }));
    else if (read('session', {}).here === here) put('session', null);
  },
  /** The session of this tab, or else that of a closed one; `closed` says which.
   * @returns {Promise<{ value: string | null, closed: boolean }>} */
  async get() {
    const own = ofTab.get('session');
    const left = own ? {} : read('session', {});
    try {
      const open = left.value && (await navigator.locks.query()).held?.some(({ name }) => name === PREFIX + 'here.' + left.here);
      return { value: own || (open ? null : left.value ?? null), closed: !own };
    } catch {
      // Without locks nobody knows whether the other tab is still open.
      return { value: own, closed: !own };
    }
  },
};

/** Calls `changed` with the key when another tab has kept something.
 * @param {(key: string) => void} changed */
export function watch(changed) {
  window.addEventListener('storage', event => {
    if (event.key === null) changed('');
    else if (event.key.startsWith(PREFIX)) changed(event.key.slice(PREFIX.length));
  });
}

/** Does `work` while no other tab does work of this name.
 * @template T
 * @param {string} name
 * @param {() => Promise<T>} work
 * @returns {Promise<T>} */
export async function alone(name, work) {
  let begun = false;
  const begin = () => {
    begun = true;
    return work();
  };
  try {
    if (navigator.locks) return await navigator.locks.request(PREFIX + name, begin);
  } catch (error) {
    // A browser that blocks storage may block locks too.
    if (begun) throw error;
  }
  return work();
}
