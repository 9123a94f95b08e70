// Puts the code of the module together again, which the builder's split.rs has split by operation.

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
      const memory = operation > 0x27 && operation < 0x3f;
      if (memory) number(253);
      let more = memory || operation > 1 && operation < 5 || [0x0c, 0x0d, 0x10, 0x3f, 0x40, 0x41, 0x42, 0xd0, 0xd2].includes(operation) || operation > 0x1f && operation < 0x27 ? 1 : 0;
      if (operation === 0x11) more = 2;
      if (operation === 0x0e) more = number(operation) + 1;
      if (operation === 0x1c) more = number(operation);
      if (operation === 0xfc) {
        const which = number(operation);
        more = which < 8 ? 0 : which < 15 && which % 2 === 0 ? 2 : 1;
      }
      while (more--) number(operation);
      if (operation === 0x43 || operation === 0x44) for (let bytes = (operation - 0x42) * 4; bytes--;) byte(operation);
    }
  }
  const module = new Uint8Array(before.length + size + behind.length);
  module.set(before);
  module.set(code, before.length);
  module.set(behind, before.length + size);
  return module;
}
