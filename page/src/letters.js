/** The bytes of letters from the page's builder. Of the 93 letters from `!` to `~` without `<`, the first 35 are six bits each, the others seven.
 * @param {string} text */
export function fromLetters(text) {
  const bytes = new Uint8Array(text.length);
  let [held, bits, at] = [0, 0, 0];
  for (let place = 0; place < text.length; place += 1) {
    const code = text.charCodeAt(place);
    const number = code - (code > 60 ? 34 : 33);
    const isSix = number < 35;
    held = isSix ? held << 6 | number : held << 7 | number + 35;
    bits += isSix ? 6 : 7;
    if (bits > 7) bytes[at++] = held >> (bits -= 8);
  }
  return bytes;
}
