// Puts the core's module together, out of the parts that the page’s builder sorted it into: see page/builder/src/module.rs.

/** How many bytes `number` takes, seven bits each.
 * @param {number[]} into
 * @param {number} number */
function write(into, number) {
  for (; number > 127; number >>>= 7) into.push(number & 127 | 128);
  into.push(number);
}

/** The module of these parts: what stands before its code, what stands behind it, and the streams of the code.
 * @param {Uint8Array[]} parts */
export function moduleOf([before, after, ...streams]) {
  const [OPERATIONS, LOCALS, CONSTANTS, OFFSETS, CALLS] = [0, 1, 2, 3, 4];
  const at = streams.map(() => 0);
  /** @type {number[]} */
  let body = [];
  const byte = stream => {
    const value = streams[stream][at[stream]];
    at[stream] += 1;
    body.push(value);
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
  const times = (count, then) => { for (let i = 0; i < count; i += 1) then(); };
  const operand = () => number(OPERATIONS);

  const instruction = () => {
    const code = byte(OPERATIONS);
    if (code === 0x0e) times(operand() + 1, operand);
    else if (code >= 0x28 && code <= 0x3e) {
      operand();
      number(OFFSETS);
    } else if (code >= 0x20 && code <= 0x22) number(LOCALS);
    else if (code === 0x10 || code === 0x11) times(code - 0x0f, () => number(CALLS));
    else if (code === 0x41 || code === 0x42) number(CONSTANTS);
    else if (code === 0x43 || code === 0x44) times(code === 0x43 ? 4 : 8, () => byte(CONSTANTS));
    else if (code === 0xfc) {
      const further = operand();
      times(further < 8 ? 0 : further > 14 || further % 2 ? 1 : 2, operand);
    } else if (code > 1 && code < 5 || code === 0x0c || code === 0x0d || code > 0x22 && code < 0x27 || code === 0x3f || code === 0x40 || code === 0xd0 || code === 0xd2) operand();
    return code;
  };

  /** @type {number[]} */
  const functions = [];
  let count = 0;
  for (; at[OPERATIONS] < streams[OPERATIONS].length; count += 1) {
    body = [];
    times(operand(), () => {
      operand();
      byte(OPERATIONS);
    });
    for (let depth = 1; depth > 0;) {
      const code = instruction();
      depth += Number(code > 1 && code < 5) - Number(code === 0x0b);
    }
    write(functions, body.length);
    for (const one of body) functions.push(one);
  }
  /** @type {number[]} */
  const counted = [];
  write(counted, count);
  /** @type {number[]} */
  const section = [10];
  write(section, counted.length + functions.length);
  return new Uint8Array([...before, ...section, ...counted, ...functions, ...after]);
}
