// A link to copy, and the same as a QR code.
import { generate } from 'lean-qr/nano';
import { t } from './language.js';
import { $, draw, tell } from './state.js';

// The most letters of a QR code that a phone still reads from a screen.
const MOST_LETTERS = 2200;

/** Shows a link, with a button that copies it.
 * @param {string} link
 * @param {string} title
 * @param {string} about
 * @param {boolean} pasted whether the other page takes it as text, too */
export function share(link, title, about, pasted = false) {
  $('shared-title').textContent = title;
  const more = pasted ? (squares(link) ? '' : t('along.long')) : location.protocol === 'file:' ? t('link.file') : '';
  $('shared-about').textContent = (about + ' ' + more).trim();
  $('link').value = link;
  // A table is no address: only its code is of use.
  $('link').closest('.field').hidden = $('copy-link').hidden = !link.includes('://') && Boolean(squares(link));
  drawCode(link);
  $('shared').showModal();
}

/** A link as a QR code: how many squares wide, and the black ones as a path. `null` if it is too long for a phone.
 * @param {string} link */
export function squares(link) {
  if (link.length > MOST_LETTERS) return null;
  const code = generate(link);
  let path = '';
  for (let y = 0; y < code.size; y += 1) for (let x = 0; x < code.size; x += 1) if (code.get(x, y)) path += 'M' + x + ' ' + y + 'h1v1h-1z';
  return { size: code.size, path };
}

function drawCode(link) {
  // A telephone cannot open a file of this machine.
  const code = link.startsWith('file:') ? null : squares(link);
  $('code').toggleAttribute('hidden', !code);
  if (!code) return;
  $('code').setAttribute('viewBox', '-4 -4 ' + (code.size + 8) + ' ' + (code.size + 8));
  $('code').replaceChildren(draw('rect', { x: -4, y: -4, width: code.size + 8, height: code.size + 8, fill: '#fff' }), draw('path', { d: code.path, fill: '#000', 'shape-rendering': 'crispEdges' }));
}

export function setUpShare() {
  $('copy-link').addEventListener('click', async () => {
    try {
      await navigator.clipboard.writeText($('link').value);
      $('shared').close();
      tell(t('link.copied'));
    } catch {
      $('link').focus();
      $('link').select();
    }
  });
  $('close-link').addEventListener('click', () => $('shared').close());
}
