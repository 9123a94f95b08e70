// The texts of the interface, in the language that the browser prefers or somebody has chosen. They are in page/languages, one file each.
import { make } from './state.js';

/** @typedef {keyof typeof import('../languages/en.json')} Key */

/** @type {Record<string, Record<string, any>>} */
let languages = {};
/** @type {Record<string, any>} */
let texts = {};
let plural = new Intl.PluralRules('en');

/** Takes all languages, as page/builder/src/languages.rs writes them: names on a line each, then, after an empty line, each language's
 * code and its texts in the order of the names. The texts after those have numbers as names.
 * @param {string} all */
export function takeLanguages(all) {
  const [names, ...blocks] = all.split('\n\n').map(block => block.split('\n'));
  languages = Object.fromEntries(blocks.map(([code, ...texts]) => [code, Object.fromEntries(texts.map((text, at) => (
    [names[at] ?? at - names.length, text.startsWith('{"') ? JSON.parse(text) : text]
  )))]));
}

/** The languages: code and name. */
export const names = () => Object.entries(languages).map(([code, all]) => [code, all.name]);

/** Switches to this language; if the page does not have it, to the first of the browser's languages that it has.
 * @param {string} code */
export function speakLanguage(code) {
  const preferred = [code, ...(navigator.languages || [navigator.language])].map(one => String(one).toLowerCase().split('-')[0]);
  const chosen = preferred.find(one => Object.hasOwn(languages, one)) || 'en';
  texts = languages[chosen];
  plural = new Intl.PluralRules(chosen);
  document.documentElement.lang = chosen;
}

// Letters that are written from right to left.
const FROM_THE_RIGHT = /[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc\u{10800}-\u{10fff}\u{1e800}-\u{1efff}]/u;
// So that they do not turn the sentence round them, they stand between two invisible signs. Those of a part are enough for the whole.
const isolated = value => (FROM_THE_RIGHT.test(value) && !/\u2068/.test(value) ? '\u2068' + value + '\u2069' : value);

/** A text, with values for the names in braces. If it depends on a number, that is `n`.
 * @param {Key} key
 * @param {Record<string, any>} values */
export function t(key, values = {}) {
  const found = texts[key];
  const text = typeof found === 'object' ? found[plural.select(values.n)] ?? found.other : found;
  return text.replace(/\{(\w+)\}/g, (whole, name) => isolated(values[name] ?? whole));
}

/** A probability. */
export const percent = p => t('percent', { n: p > 0 && p < 0.005 ? '< 1' : p < 1 && p > 0.995 ? '> 99' : Math.round(p * 100) });

/** The text of a name that comes from elsewhere, such as a colour; `undefined` if there is none.
 * @param {string} key
 * @returns {string | undefined} */
export const named = key => (typeof texts[key] === 'string' ? texts[key] : undefined);

/** Several parts as one text, as the language joins them.
 * @param {string[]} parts
 * @param {Key} last the word before the last one */
export const listed = (parts, last = 'listOf') => parts.reduce((list, part, at) => (last !== 'listOf' && at === parts.length - 1 ? list + t(last) + part : t('listOf', { 0: list, 1: part })));

/** A text with its emphasis, as nodes.
 * @param {string} text */
function rich(text) {
  return text.split(/(<(?:b|em|cite)>.*?<\/\w+>)/).map(part => {
    const [, tag, inside] = part.match(/^<(\w+)>(.*)<\/\w+>$/) || [];
    return tag ? make(tag, tag === 'cite' ? { lang: 'en' } : {}, inside) : part;
  });
}

/** Writes the fixed texts of the page. */
export function writePage() {
  document.title = t('title');
  for (const element of document.querySelectorAll('[data-t]')) element.replaceChildren(...rich(t(/** @type {Key} */ (element.getAttribute('data-t')))));
  for (const attribute of ['aria-label', 'title', 'placeholder']) {
    for (const element of document.querySelectorAll('[data-t-' + attribute + ']')) element.setAttribute(attribute, t(/** @type {Key} */ (element.getAttribute('data-t-' + attribute))));
  }
}
