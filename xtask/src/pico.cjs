// Runs a .uf2 on an emulated Raspberry Pi Pico and prints its serial line, until it sleeps for good: `pico.cjs FILE`.
const { RP2040 } = require("rp2040js");
const file = require("fs").readFileSync(process.argv[1]);
const FLASH = 0x10000000;
const NANOSECONDS = 8; // one cycle at 125 MHz
const pico = new RP2040();
pico.logger = { debug() {}, info() {}, warn() {}, error: (name, text) => console.error(name, text) };
for (let block = 0; block < file.length; block += 512) {
    pico.flash.set(file.subarray(block + 32, block + 288), file.readUInt32LE(block + 12) - FLASH);
}
pico.uart[0].onByte = (byte) => process.stdout.write(String.fromCharCode(byte));
pico.onBreak = (code) => { throw new Error(`it stopped at breakpoint ${code}`); };
// The emulator lacks the chip's first loader, which would load the second one from the start of the flash and continue there.
pico.core.SP = 0x20042000;
pico.core.PC = FLASH;
while (!pico.core.waiting) pico.clock.tick(pico.core.executeInstruction() * NANOSECONDS);
