// Expands the LZMA stream without a header that page/builder/src/pack.rs has packed: literals and copies. The probability of a bit is learned
// from earlier bits at the same place of a literal, a length or a distance.

// How many bits of the previous byte predict a literal.
const LC = 3;
const EVEN = 1 << 10;
const even = length => new Uint16Array(length).fill(EVEN);

/** @param {Uint8Array} packed
 * @param {number} size bytes when expanded */
export function expanded(packed, size) {
  const whole = new Uint8Array(size);
  const literals = even(768 << LC);
  const [isCopy, isAgain, isNotLast, isLong, isOlder, isOldest] = Array.from({ length: 6 }, () => even(12));
  const slots = Array.from({ length: 4 }, () => even(64));
  const [near, aligned] = [even(128), even(16)];
  const [lengths, lengthsAgain] = [0, 0].map(() => ({ choice: even(2), short: even(8), middle: even(8), long: even(256) }));
  let [range, code, at] = [2 ** 32 - 1, 0, 0];
  const next = () => { code = (code << 8 | packed[at++]) >>> 0; };
  // The first byte is 0.
  while (at < 5) next();
  // A bit that is 0 in this part of the range.
  const decide = bound => {
    const is = code >= bound ? 1 : 0;
    range = is ? range - bound : bound;
    if (is) code -= bound;
    while (range < 2 ** 24) {
      range = range << 8 >>> 0;
      next();
    }
    return is;
  };
  const bit = (chances, which) => {
    const chance = chances[which];
    const is = decide((range >>> 11) * chance);
    chances[which] = is ? chance - (chance >> 5) : chance + (2048 - chance >> 5);
    return is;
  };

  // `state` stands for the last few symbols: from 7 on the last one was a copy.
  let [state, end] = [0, 0];
  const distances = [0, 0, 0, 0];

  const number = (chances, bits) => {
    let node = 1;
    while (node < 1 << bits) node = node << 1 | bit(chances, node);
    return node - (1 << bits);
  };
  // The lowest bit first.
  const reversed = (chances, bits, offset) => {
    let [node, value] = [1, 0];
    for (let place = 0; place < bits; place += 1) {
      const is = bit(chances, offset + node);
      node = node << 1 | is;
      value |= is << place;
    }
    return value;
  };
  const lengthBy = ({ choice, short, middle, long }) => 2 + (!bit(choice, 0) ? number(short, 3) : !bit(choice, 1) ? 8 + number(middle, 3) : 16 + number(long, 8));
  const distanceFor = length => {
    const slot = number(slots[Math.min(length - 2, 3)], 6);
    if (slot < 4) return slot;
    const bits = (slot >> 1) - 1;
    let distance = (2 | slot & 1) << bits;
    if (slot < 14) return distance + reversed(near, bits, distance - slot);
    for (let place = bits - 1; place > 3; place -= 1) {
      // Both halves are equal.
      range -= range & 1;
      distance += decide(range / 2) << place;
    }
    return distance + reversed(aligned, 4, 0);
  };

  while (end < size) {
    if (!bit(isCopy, state)) {
      // After a copy, the byte is mostly another one than the copy would have continued with.
      const offset = 768 * ((end && whole[end - 1]) >> 8 - LC);
      let [node, model] = [1, state > 6 ? 256 | whole[end - distances[0] - 1] : 0];
      for (let place = 7; place >= 0; place -= 1) {
        const is = bit(literals, offset + (model ? (1 + (model >> place & 1) << 8) + node : node));
        if (is !== (model >> place & 1)) model = 0;
        node = node << 1 | is;
      }
      whole[end++] = node;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let length = 1;
    if (bit(isAgain, state)) {
      const which = !bit(isNotLast, state) ? 0 : !bit(isOlder, state) ? 1 : 2 + bit(isOldest, state);
      const isOne = which === 0 && !bit(isLong, state);
      if (which) distances.unshift(...distances.splice(which, 1));
      if (!isOne) length = lengthBy(lengthsAgain);
      state = (state < 7 ? 8 : 11) + (isOne && state < 7 ? 1 : 0);
    } else {
      length = lengthBy(lengths);
      state = state < 7 ? 7 : 10;
      distances.unshift(distanceFor(length));
      distances.pop();
    }
    for (const last = end + length; end < last; end += 1) whole[end] = whole[end - distances[0] - 1];
  }
  return whole;
}
