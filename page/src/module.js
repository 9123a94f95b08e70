// Puts the core's module together, out of the parts that the page’s builder sorted it into: see page/builder/src/module.rs.

/** The module of these parts: what stands before its code, what stands behind it, and the streams of the code.
 * @param {Uint8Array[]} parts */
export function moduleOf([before, after, ...streams]) {
  const [OPERATIONS, LOCALS, CONSTANTS, OFFSETS, CALLS] = [0, 1, 2, 3, 4];
  const at = new Uint32Array(streams.length);
  const length = streams.reduce((sum, stream) => sum + stream.length, 0);
  // A function is never larger than the streams together, and its size takes five bytes at most; it has two operations at least.
  const body = new Uint8Array(length);
  const functions = new Uint8Array(length + 3 * streams[OPERATIONS].length);
  let [inBody, inFunctions, count] = [0, 0, 0];

  const byte = stream => {
    const value = streams[stream][at[stream]];
    at[stream] += 1;
    body[inBody] = value;
    inBody += 1;
    return value;
  };
  const number = stream => {
    let [value, shift, last] = [0, 0, 128];
    for (; last > 127; shift += 7) {
      last = byte(stream);
      value |= (last & 127) << shift;
    }
    return value;
  };
  const numbers = (many, stream) => { for (let i = 0; i < many; i += 1) number(stream); };

  // Copies an instruction, and returns what it begins with.
  const instruction = () => {
    const code = byte(OPERATIONS);
    if (code >= 0x20 && code <= 0x22) number(LOCALS);
    else if (code >= 0x28 && code <= 0x3e) {
      number(OPERATIONS);
      number(OFFSETS);
    } else if (code === 0x41 || code === 0x42) number(CONSTANTS);
    else if (code === 0x43 || code === 0x44) for (let i = code === 0x43 ? 4 : 8; i > 0; i -= 1) byte(CONSTANTS);
    else if (code === 0x10 || code === 0x11) numbers(code - 0x0f, CALLS);
    else if (code === 0x0e) numbers(number(OPERATIONS) + 1, OPERATIONS);
    else if (code === 0xfc) {
      const further = number(OPERATIONS);
      numbers(further < 8 ? 0 : further > 14 || further % 2 ? 1 : 2, OPERATIONS);
    } else if (code > 1 && code < 5 || code === 0x0c || code === 0x0d || code > 0x22 && code < 0x27 || code === 0x3f || code === 0x40 || code === 0xd0 || code === 0xd2) number(OPERATIONS);
    return code;
  };

  for (; at[OPERATIONS] < streams[OPERATIONS].length; count += 1) {
    inBody = 0;
    for (let locals = number(OPERATIONS); locals > 0; locals -= 1) {
      number(OPERATIONS);
      byte(OPERATIONS);
    }
    for (let depth = 1; depth > 0;) {
      const code = instruction();
      depth += Number(code > 1 && code < 5) - Number(code === 0x0b);
    }
    const size = inSevens(inBody);
    functions.set(size, inFunctions);
    functions.set(body.subarray(0, inBody), inFunctions + size.length);
    inFunctions += size.length + inBody;
  }
  const counted = inSevens(count);
  const section = [10, ...inSevens(counted.length + inFunctions), ...counted];
  const module = new Uint8Array(before.length + section.length + inFunctions + after.length);
  let end = 0;
  for (const part of [before, section, functions.subarray(0, inFunctions), after]) {
    module.set(part, end);
    end += part.length;
  }
  return module;
}

/** A number in bytes of seven bits each.
 * @param {number} value */
function inSevens(value) {
  const bytes = [];
  for (; value > 127; value >>>= 7) bytes.push(value & 127 | 128);
  return [...bytes, value];
}
