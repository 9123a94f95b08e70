"""A micro:bit V2 with a program on it: `python v2.py goodbot.hex FOLDER`.

No emulator has this board. unicorn runs the processor's instructions, and this file has the parts of the board that the program uses: flash,
pins, serial line, timer. What the board does not have, or would not take, ends the run. FOLDER gets two sockets, as from the emulator of the V1:
`serial`, which is waited for, and `pins`, for three requests of QEMU's protocol `qtest`. The flash has the models of FOLDER's file `slots`.
"""

import pathlib
import select
import socket
import sys
import time

import unicorn
from unicorn import arm_const as arm

PAGE, FLASH, RAM, SLOTS = 4_096, 512 * 1_024, 128 * 1_024, 0x3E000
CLOCK, UART, TIMER, PORTS, NVMC = 0x40000000, 0x40002000, 0x40008000, (0x50000000, 0x50000300), 0x4001E000
# Registers of the serial line, the timer, a port, and the flash's controller; and the one that lets interrupts come.
STARTRX, STARTTX, ENABLE, TXPIN, RXPIN, BAUD = UART, UART + 8, UART + 0x500, UART + 0x50C, UART + 0x514, UART + 0x524
RXD, RXDRDY, RXDRDY_COMES, TXD, TXDRDY = UART + 0x518, UART + 0x108, UART + 0x304, UART + 0x51C, UART + 0x11C
START, COMPARE, TIMER_SETTINGS = TIMER, TIMER + 0x140, [TIMER + at for at in (0x200, 0x304, 0x508, 0x510, 0x540)]
OUT, IN, DIRSET, PIN_CNF = 0x504, 0x510, 0x518, [0x700 + 4 * pin for pin in range(32)]
READY, CONFIG, ERASEPAGE = NVMC + 0x400, NVMC + 0x504, NVMC + 0x508
INTERRUPTS = 0xE000E100
READABLE = {RXD, RXDRDY, TXDRDY, PORTS[0] + IN, READY}
WRITABLE = {CLOCK, STARTRX, STARTTX, ENABLE, TXPIN, RXPIN, BAUD, RXDRDY, RXDRDY_COMES, TXD, TXDRDY, START, COMPARE, *TIMER_SETTINGS}
WRITABLE |= {CONFIG, ERASEPAGE, INTERRUPTS, *(port + at for port in PORTS for at in [OUT, DIRSET, *PIN_CNF])}
# 250 microseconds, with 64 million instructions a second: the timer counts to 250, at 16 MHz / 2^4.
MOMENT, INSTRUCTIONS, SET_TIMER = 0.00025, 16_000, [1, 1 << 16, 0, 4, 250]
SET_LINE = [4, 1, 6, 1, 32 + 8, 0x01D7E000]
# A handler of interrupts returns to here, where no program is.
END = FLASH - 16

cpu = unicorn.Uc(unicorn.UC_ARCH_ARM, unicorn.UC_MODE_THUMB | unicorn.UC_MODE_MCLASS)
cpu.ctl_set_cpu_model(arm.UC_CPU_ARM_CORTEX_M4)
# At first no pin's input is connected.
registers = {READY: 1, **{PORTS[0] + at: 2 for at in PIN_CNF}}
levels = [1] * 32
received, sent = bytearray(), bytearray()


def values(*addresses):
    return [registers.get(at, 0) for at in addresses]


def word(at):
    return int.from_bytes(cpu.mem_read(at, 4), "little")


def read(_cpu, offset, size, base):
    at = base + offset
    assert at in READABLE and size == 4, f"{size} bytes are read at {at:#x}"
    if at == PORTS[0] + IN:
        return sum(level << pin for pin, level in enumerate(levels) if registers[PORTS[0] + PIN_CNF[pin]] & 2 == 0)
    if at == RXD:
        byte = received.pop(0)
        registers[RXDRDY] = int(len(received) > 0)
        return byte
    return registers.get(at, 0)


def write(_cpu, offset, size, value, base):
    at = base + offset
    assert at in WRITABLE and size == 4, f"{value:#x} is written to {size} bytes at {at:#x}"
    if at in (INTERRUPTS, PORTS[0] + DIRSET, PORTS[1] + DIRSET):
        value |= registers.get(at, 0)
    if at == TXD:
        assert values(ENABLE, STARTTX, TXPIN, STARTRX, RXPIN, BAUD) == SET_LINE
        sent.append(value)
        registers[TXDRDY] = 1
    if at == ERASEPAGE:
        assert registers[CONFIG] == 2 and value % PAGE == 0, f"the page at {value:#x} is erased"
        cpu.mem_write(value, b"\xff" * PAGE)
    registers[at] = value


def write_flash(_cpu, _access, at, size, value, _data):
    assert registers[CONFIG] == 1 and size == 4 and at % 4 == 0 and at >= SLOTS, f"{value:#x} is written to the flash at {at:#x}"
    assert word(at) & value == value, f"the flash at {at:#x} is not erased"


def load(hex_file):
    upper = 0
    for line in hex_file.read_text().splitlines():
        record = bytes.fromhex(line[1:])
        count, at, kind, data = record[0], int.from_bytes(record[1:3], "big"), record[3], record[4:-1]
        assert line[0] == ":" and count == len(data) <= 32 and sum(record) % 256 == 0, line
        if kind == 0:
            cpu.mem_write(upper + at, data)
        elif kind == 4:
            upper = int.from_bytes(data, "big") << 16
    # By these DAPLink, which loads programs into the board, tells those for a V1 alone.
    assert any(word(4 * vector) for vector in (4, 5, 6)), "The application image is not compatible with the target."


def run(at):
    cpu.emu_start(at | 1, END, count=INSTRUCTIONS)
    return cpu.reg_read(arm.UC_ARM_REG_PC)


def interrupt(number):
    if registers.get(INTERRUPTS, 0) >> number & 1:
        before = cpu.context_save()
        cpu.reg_write(arm.UC_ARM_REG_SP, cpu.reg_read(arm.UC_ARM_REG_SP) - 32)
        cpu.reg_write(arm.UC_ARM_REG_LR, END | 1)
        assert run(word(4 * (16 + number))) == END
        cpu.context_restore(before)


def answer(request):
    name, *words = request.split()
    if name == "set_irq_in":
        levels[int(words[-2])] = int(words[-1])
        return "OK\n"
    if name == "readl":
        # Whatever the address, the outputs of both ports.
        outputs = [registers.get(port + OUT, 0) & registers.get(port + DIRSET, 0) for port in PORTS]
        return f"OK {outputs[1] << 32 | outputs[0]:#x}\n"
    assert name == "read", request
    return f"OK 0x{cpu.mem_read(int(words[0], 16), int(words[1], 16)).hex()}\n"


hex_file, folder = map(pathlib.Path, sys.argv[1:])
for base, size in ((0, FLASH), (0x20000000, RAM), (0x10000000, 4_096)):
    cpu.mem_map(base, size)
for base, size in ((CLOCK, 0x20000), (PORTS[0], 4_096), (0xE000E000, 4_096)):
    cpu.mmio_map(base, size, read, base, write, base)
cpu.mem_write(0, b"\xff" * FLASH)
# The chip tells the size of its pages.
cpu.mem_write(0x10000010, PAGE.to_bytes(4, "little"))
load(hex_file)
if (folder / "slots").exists():
    cpu.mem_write(SLOTS, (folder / "slots").read_bytes())
cpu.hook_add(unicorn.UC_HOOK_MEM_WRITE, write_flash, begin=0, end=FLASH - 1)

with socket.socket(socket.AF_UNIX) as serial_server, socket.socket(socket.AF_UNIX) as pins_server:
    serial_server.bind(str(folder / "serial"))
    serial_server.listen()
    pins_server.bind(str(folder / "pins"))
    pins_server.listen()
    serial, pins = serial_server.accept()[0], pins_server.accept()[0]

cpu.reg_write(arm.UC_ARM_REG_SP, word(0))
at, due = word(4), time.monotonic()
while True:
    at = run(at)
    # While the program sleeps (`wfi`), its clock is this machine's.
    is_asleep = cpu.mem_read(at - 2, 2) == b"\x30\xbf"
    now = time.monotonic()
    due = max(due + MOMENT, now)
    for line in select.select([serial, pins], [], [], due - now if is_asleep else 0)[0]:
        came = line.recv(4_096)
        if not came:
            sys.exit()
        if line is pins:
            pins.sendall("".join(map(answer, came.decode().splitlines())).encode())
        else:
            received += came
    if received and registers.get(RXDRDY_COMES) == 4:
        registers[RXDRDY] = 1
        interrupt(2)
    if START in registers:
        assert values(*TIMER_SETTINGS) == SET_TIMER
        registers[COMPARE] = 1
        interrupt(8)
        assert registers[COMPARE] == 0
    if sent:
        serial.sendall(sent)
        sent.clear()
