// Bytes as text, and files.
import { make } from './state.js';

/** @param {Uint8Array} bytes */
export function toBase64(bytes) {
  let text = '';
  for (let at = 0; at < bytes.length; at += 8192) text += String.fromCharCode(...bytes.subarray(at, at + 8192));
  return btoa(text);
}

/** @param {string} text */
export const fromBase64 = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));

/** Base64 as it may stand in an address.
 * @param {Uint8Array} bytes */
export const toAddress = bytes => toBase64(bytes).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');

/** @param {string} text */
export const fromAddress = text => fromBase64(text.replaceAll('-', '+').replaceAll('_', '/'));

/** @param {string} name
 * @param {BlobPart} content
 * @param {string} type */
export function download(name, content, type) {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = make('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/** The file that was chosen, as text or as bytes; and its name. */
export async function readFile(input, how) {
  const [file] = input.files;
  const content = how === 'bytes' ? await file.arrayBuffer() : await file.text();
  input.value = '';
  return { name: file.name.replace(/\.[^.]*$/, ''), content };
}
