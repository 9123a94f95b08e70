// Expands what `page/builder` has packed: a raw LZMA stream with three bits of literal context and none of position (lc=3, lp=0, pb=0), which is a tenth
// smaller than what a browser expands by itself. After Igor Pavlov's specification of LZMA, which is in the public domain.

// Where the probabilities of each kind of decision begin.
const [MATCH, REP, REP_0, REP_1, REP_2, REP_0_LONG, SLOT, SPECIAL, ALIGN, LENGTH, REP_LENGTH, LITERAL] = [0, 12, 24, 36, 48, 60, 72, 328, 456, 472, 746, 1024];

/** @param {Uint8Array} packed
 * @param {number} size how many bytes it expands to
 * @returns {Uint8Array} */
export function expandedLzma(packed, size) {
  const whole = new Uint8Array(size);
  const probabilities = new Uint16Array(LITERAL + (0x300 << 3)).fill(1024);
  // The first byte is always 0, the next four begin the code.
  let [range, code, at] = [0xffffffff, new DataView(packed.buffer, packed.byteOffset).getUint32(1), 5];
  const bit = place => {
    const probability = probabilities[place];
    const bound = (range >>> 11) * probability;
    const is = code < bound ? 0 : 1;
    if (is) {
      range -= bound;
      code -= bound;
      probabilities[place] -= probability >> 5;
    } else {
      range = bound;
      probabilities[place] += 2048 - probability >> 5;
    }
    if (range < 0x1000000) {
      range *= 256;
      code = code * 256 + packed[at];
      at += 1;
    }
    return is;
  };
  const tree = (begin, bits) => {
    let node = 1;
    for (let n = 0; n < bits; n += 1) node = node * 2 + bit(begin + node);
    return node - (1 << bits);
  };
  // The lowest bit first.
  const reversed = (begin, bits) => {
    let [node, value] = [1, 0];
    for (let n = 0; n < bits; n += 1) {
      const is = bit(begin + node);
      node = node * 2 + is;
      value |= is << n;
    }
    return value;
  };
  // Bits that are all as probable.
  const direct = bits => {
    let value = 0;
    for (let n = 0; n < bits; n += 1) {
      range = range / 2 >>> 0;
      const is = code < range ? 0 : 1;
      if (is) code -= range;
      value = value * 2 + is;
      if (range < 0x1000000) {
        range *= 256;
        code = code * 256 + packed[at];
        at += 1;
      }
    }
    return value;
  };
  const length = begin => (!bit(begin) ? 2 + tree(begin + 2, 3) : !bit(begin + 1) ? 10 + tree(begin + 10, 3) : 18 + tree(begin + 18, 8));
  const distance = matched => {
    const slot = tree(SLOT + Math.min(matched - 2, 3) * 64, 6);
    if (slot < 4) return slot;
    const bits = (slot >> 1) - 1;
    const high = (2 | slot & 1) * 2 ** bits;
    return high + (slot < 14 ? reversed(SPECIAL + high - slot, bits) : direct(bits - 4) * 16 + reversed(ALIGN, 4));
  };
  let [state, rep0, rep1, rep2, rep3, to] = [0, 0, 0, 0, 0, 0];
  while (to < size) {
    if (!bit(MATCH + state)) {
      const begin = LITERAL + 0x300 * (to ? whole[to - 1] >> 5 : 0);
      let node = 1;
      // After a match, the byte that the match would have gone on with is a hint.
      if (state > 6) {
        let hint = whole[to - rep0 - 1];
        while (node < 256) {
          const expected = hint >> 7 & 1;
          hint <<= 1;
          const is = bit(begin + (1 + expected << 8) + node);
          node = node * 2 + is;
          if (is !== expected) break;
        }
      }
      while (node < 256) node = node * 2 + bit(begin + node);
      whole[to] = node;
      to += 1;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let matched;
    if (!bit(REP + state)) {
      [rep3, rep2, rep1] = [rep2, rep1, rep0];
      matched = length(LENGTH);
      rep0 = distance(matched);
      state = state < 7 ? 7 : 10;
    } else {
      const other = bit(REP_0 + state);
      if (!other && !bit(REP_0_LONG + state)) {
        matched = 1;
        state = state < 7 ? 9 : 11;
      } else {
        if (other && !bit(REP_1 + state)) [rep1, rep0] = [rep0, rep1];
        else if (other && !bit(REP_2 + state)) [rep2, rep1, rep0] = [rep1, rep0, rep2];
        else if (other) [rep3, rep2, rep1, rep0] = [rep2, rep1, rep0, rep3];
        matched = length(REP_LENGTH);
        state = state < 7 ? 8 : 11;
      }
    }
    // What is copied may be what was copied just before.
    for (let end = to + matched; to < end; to += 1) whole[to] = whole[to - rep0 - 1];
  }
  return whole;
}
