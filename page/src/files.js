// Saves and opens files.
import { make, state } from './state.js';

/** The robot's name, made fit for a file's name. */
export const fileName = () => state.robot.name.replace(/[^\p{L}\p{N}]+/gu, '-').replace(/^-|-$/g, '') || 'robot';

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
