// Puts the code of the module together again, which the builder's split.rs has split by operation.

// How many numbers follow an operation. Two operations have a list of them, and one says how many.
const COUNTS = new Uint8Array(256);
for (const [first, last] of [[0x02, 0x04], [0x0c, 0x0d], [0x10, 0x11], [0x20, 0x26], [0x28, 0x42], [0xd0, 0xd0], [0xd2, 0xd2]]) COUNTS.fill(1, first, last + 1);
COUNTS[0x11] = 2;
const [JUMPS, CHOICE, MORE] = [0x0e, 0x1c, 0xfc];

/** @param {Uint8Array} before what stands before the code
 * @param {Uint8Array[]} parts by the number of an operation, what follows it; the last three have the alignments, what stands before the operations, and these
 * @param {Uint8Array} behind */
export function joined(before, parts, behind) {
  const code = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  const places = new Uint32Array(parts.length);
  let size = 0;
  const byte = part => (code[size++] = parts[part][places[part]++]);
  const number = part => {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const bits = byte(part);
      value |= (bits & 127) << shift;
      if (bits < 128) return value;
    }
  };
  for (let functions = number(254); functions--;) {
    const length = number(254);
    const end = size + length;
    for (let kinds = number(254); kinds--;) {
      number(254);
      byte(254);
    }
    while (size < end) {
      const operation = byte(255);
      // An access to memory.
      if (operation > 0x27 && operation < 0x3f) number(253);
      let more = COUNTS[operation];
      if (operation === JUMPS) more = number(operation) + 1;
      if (operation === CHOICE) more = number(operation);
      if (operation === MORE) {
        const which = number(operation);
        more = which < 8 ? 0 : which < 15 && which % 2 === 0 ? 2 : 1;
      }
      while (more--) number(operation);
      // A constant with a point.
      if (operation === 0x43 || operation === 0x44) for (let bytes = (operation - 0x42) * 4; bytes--;) byte(operation);
    }
  }
  const module = new Uint8Array(before.length + size + behind.length);
  module.set(before);
  module.set(code, before.length);
  module.set(behind, before.length + size);
  return module;
}
