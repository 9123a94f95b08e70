// Expands the module: an LZMA stream without a header, with two bits of literal context and none of position (lc = 2, lp = pb = 0),
// as the page’s builder writes it. It is a fifth denser than what browsers expand by themselves. The names are those of the format's specification.

export function unpack(packed, size) {
  const out = new Uint8Array(size);
  const half = count => new Uint16Array(count).fill(1024);
  const [isMatch, isRep, isRepG0, isRepG1, isRepG2, isRep0Long] = Array.from({ length: 6 }, () => half(12));
  const [literals, slots, special, align] = [half(0x300 << 2), half(4 << 6), half(128), half(16)];
  const lengths = () => ({ choice: half(2), low: half(8), mid: half(8), high: half(256) });
  const [matchLength, repLength] = [lengths(), lengths()];
  // In an array of whole numbers: a variable of that size would be made anew each time.
  const [RANGE, CODE] = [0, 1];
  const coder = Uint32Array.of(2 ** 32 - 1, 0);
  let at = 5;
  for (let byte = 1; byte < 5; byte += 1) coder[CODE] = coder[CODE] << 8 | packed[byte];

  const normalise = () => {
    if (coder[RANGE] < 2 ** 24) {
      coder[RANGE] <<= 8;
      coder[CODE] = coder[CODE] << 8 | packed[at];
      at += 1;
    }
  };
  const bit = (odds, index) => {
    const bound = (coder[RANGE] >>> 11) * odds[index];
    const one = coder[CODE] >= bound;
    if (one) {
      coder[RANGE] -= bound;
      coder[CODE] -= bound;
      odds[index] -= odds[index] >> 5;
    } else {
      coder[RANGE] = bound;
      odds[index] += (2048 - odds[index]) >> 5;
    }
    normalise();
    return Number(one);
  };
  const tree = (odds, from, bits) => {
    let node = 1;
    for (let i = 0; i < bits; i += 1) node = node << 1 | bit(odds, from + node);
    return node - (1 << bits);
  };
  const reversed = (odds, from, bits) => {
    let [node, value] = [1, 0];
    for (let i = 0; i < bits; i += 1) {
      const next = bit(odds, from + node);
      node = node << 1 | next;
      value |= next << i;
    }
    return value;
  };
  const direct = bits => {
    let value = 0;
    for (let i = 0; i < bits; i += 1) {
      coder[RANGE] >>>= 1;
      const one = coder[CODE] >= coder[RANGE];
      if (one) coder[CODE] -= coder[RANGE];
      value = value << 1 | Number(one);
      normalise();
    }
    return value;
  };
  const lengthOf = odds => {
    if (!bit(odds.choice, 0)) return tree(odds.low, 0, 3);
    return bit(odds.choice, 1) ? 16 + tree(odds.high, 0, 8) : 8 + tree(odds.mid, 0, 3);
  };
  const distanceOf = length => {
    const slot = tree(slots, Math.min(length, 3) << 6, 6);
    if (slot < 4) return slot;
    const bits = (slot >> 1) - 1;
    const least = (2 | slot & 1) << bits;
    return least + (slot < 14 ? reversed(special, least - slot, bits) : (direct(bits - 4) << 4) + reversed(align, 0, 4));
  };

  let [state, position] = [0, 0];
  let [rep0, rep1, rep2, rep3] = [0, 0, 0, 0];
  while (position < size) {
    if (!bit(isMatch, state)) {
      const from = 0x300 * (position ? out[position - 1] >> 6 : 0);
      let symbol = 1;
      if (state > 6) {
        let match = out[position - rep0 - 1];
        let same = true;
        while (same && symbol < 256) {
          const wanted = match >> 7 & 1;
          match <<= 1;
          const next = bit(literals, from + (1 + wanted << 8) + symbol);
          symbol = symbol << 1 | next;
          same = next === wanted;
        }
      }
      while (symbol < 256) symbol = symbol << 1 | bit(literals, from + symbol);
      out[position] = symbol;
      position += 1;
      state = state < 4 ? 0 : state - (state < 10 ? 3 : 6);
      continue;
    }
    let length = 0;
    if (!bit(isRep, state)) {
      [rep3, rep2, rep1] = [rep2, rep1, rep0];
      length = lengthOf(matchLength) + 2;
      state = state < 7 ? 7 : 10;
      rep0 = distanceOf(length - 2);
    } else {
      const older = bit(isRepG0, state);
      if (older) {
        let distance = rep1;
        if (bit(isRepG1, state)) {
          distance = rep2;
          if (bit(isRepG2, state)) [distance, rep3] = [rep3, rep2];
          rep2 = rep1;
        }
        [rep1, rep0] = [rep0, distance];
      }
      const long = older || bit(isRep0Long, state);
      length = long ? lengthOf(repLength) + 2 : 1;
      state = state < 7 ? (long ? 8 : 9) : 11;
    }
    for (; length > 0; length -= 1) {
      out[position] = out[position - rep0 - 1];
      position += 1;
    }
  }
  return out;
}
