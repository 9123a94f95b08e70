/** The bytes of letters from the page's builder: of 93 from `!` to `~`, without `<`, the first 35 are six bits each, the others seven.
 * @param {string} text */
export function fromLetters(text) {
  const bytes = new Uint8Array(text.length);
  let [held, bits, at] = [0, 0, 0];
  for (const letter of text) {
    const code = letter.charCodeAt(0);
    const number = code - (code > 60 ? 34 : 33);
    const more = number < 35 ? 6 : 7;
    held = held << more | (more > 6 ? number + 35 : number);
    bits += more;
    if (bits > 7) bytes[at++] = held >> (bits -= 8);
  }
  return bytes;
}
