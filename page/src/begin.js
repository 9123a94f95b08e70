// The page's first script: expands the packed parts, and starts the other scripts, which are among them.
import { noRobot as de } from '../languages/de.json';
import { noRobot as en } from '../languages/en.json';
import { noRobot as es } from '../languages/es.json';
import { noRobot as fr } from '../languages/fr.json';
import { noRobot as zh } from '../languages/zh.json';
import { expanded } from './deflate.js';
import { joined } from './joined.js';

/** The bytes of a text of signs, each of which has six bits or seven: the builder's pack.rs says which.
 * @param {string} text */
function fromSigns(text) {
  const bytes = new Uint8Array(text.length);
  let [size, bits, count] = [0, 0, 0];
  for (let at = 0; at < text.length; at += 1) {
    const code = text.charCodeAt(at);
    const place = code - (code > 60 ? 34 : 33);
    const short = place < 35;
    bits = short ? bits << 6 | place : bits << 7 | place + 35;
    count += short ? 6 : 7;
    if (count >= 8) bytes[size++] = bits >> (count -= 8);
  }
  return bytes.subarray(0, size);
}

async function begin() {
  // The robot of the first paint is seen meanwhile. A message also arrives in a hidden page, which gets no frames.
  await new Promise(done => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = done;
    window.addEventListener('load', () => port2.postMessage(0));
  });
  const packed = /** @type {HTMLElement} */ (document.getElementById('packed'));
  const sizes = String(packed.dataset.sizes).split(' ').map(Number);
  const whole = await expanded(fromSigns(String(packed.textContent)));
  let at = 0;
  const parts = sizes.map(size => whole.subarray(at, at += size));
  const [script, body, style, languages] = parts.slice(-4);
  const text = part => new TextDecoder().decode(part);
  const add = (tag, part) => { document.head.append(Object.assign(document.createElement(tag), { textContent: text(part) })); };
  document.body.insertAdjacentHTML('afterbegin', text(body));
  add('style', style);
  add('script', script);
  await /** @type {any} */ (globalThis).goodbotBegin(joined(parts[0], parts.slice(1, 257), parts[257]), text(languages));
}

begin().catch(error => {
  // Without the robot, the page may have no texts but these.
  const texts = { de, en, es, fr, zh };
  const language = navigator.languages.map(one => one.toLowerCase().split('-')[0]).find(one => Object.hasOwn(texts, one)) || 'en';
  document.body.innerHTML = `<p role="alert" lang="${language}">${texts[language]}</p>`;
  document.body.classList.add('ready');
  console.info(error);
});
