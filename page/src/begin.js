// The page's beginning: expands what is packed into it, and lets its scripts begin. It is a script by itself; the others are packed.
import { fromBase64 } from './base64.js';
import { unpack } from './unpack.js';

const packed = /** @type {HTMLElement} */ (document.getElementById('packed'));
const sizes = String(packed.dataset.sizes).split(' ').map(Number);
const whole = unpack(fromBase64(String(packed.textContent).trim()), sizes.reduce((sum, size) => sum + size));
let at = 0;
const parts = sizes.map(size => whole.slice(at, at += size));
const [style, body, script, languages] = parts.splice(0, 4).map(part => new TextDecoder().decode(part));
document.body.insertAdjacentHTML('afterbegin', body);
for (const [tag, text] of [['style', style], ['script', script]]) {
  const element = document.createElement(tag);
  element.textContent = text;
  document.head.append(element);
}
/** @type {any} */ (globalThis).goodbotPage.begin(parts, languages);
