// Prints the milliseconds of one benchmark in WebAssembly, the quickest of nine: node wasm.mjs MODULE POSITION
import { readFileSync } from 'node:fs';

const [file, position] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(file), {});
const { prepare, run } = instance.exports;
prepare(Number(position));
const time = (times) => {
  const begin = performance.now();
  run(times);
  return performance.now() - begin;
};
// Often enough that the clock's resolution does not matter and the compiler has optimized.
let times = 1;
while (time(times) < 20 && times < 1 << 20) times *= 2;
console.log(Math.min(...Array.from({ length: 9 }, () => time(times) / times)));
