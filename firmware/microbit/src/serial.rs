//! The serial line over USB: 115,200 baud, 8 bits, no parity, one stop bit. The interrupt keeps received bytes until they are read.

pub use crate::nrf51::{print_number, say};
use crate::wiring::wiring;
use core::sync::atomic::{AtomicBool, AtomicU8, Ordering::Relaxed};
use nrf51_pac::{Interrupt, NVIC, Peripherals, UART0, interrupt};

/// The longest line, in bytes.
const LONGEST: usize = 64;

/// The received line. The interrupt fills it to its end; then it is the main program's until that has read it.
static LINE: [AtomicU8; LONGEST] = [const { AtomicU8::new(0) }; LONGEST];
static LENGTH: AtomicU8 = AtomicU8::new(0);
static WHOLE: AtomicBool = AtomicBool::new(false);
static TOO_LONG: AtomicBool = AtomicBool::new(false);
/// More came before the line was read.
static TOO_FAST: AtomicBool = AtomicBool::new(false);

/// Starts the line.
pub fn begin(board: &Peripherals) {
    let line = &board.UART0;
    // SAFETY, here and below: the registers of this peripheral, with values from its manual.
    let [sends, receives] = wiring().serial.map(u32::from);
    line.pseltxd.write(|pin| unsafe { pin.bits(sends) });
    line.pselrxd.write(|pin| unsafe { pin.bits(receives) });
    line.baudrate.write(|rate| rate.baudrate().baud115200());
    line.enable.write(|enable| enable.enable().enabled());
    line.intenset.write(|interrupts| interrupts.rxdrdy().set());
    line.tasks_startrx.write(|task| unsafe { task.bits(1) });
    line.tasks_starttx.write(|task| unsafe { task.bits(1) });
    // SAFETY: the handler below shares nothing but atomics with the rest.
    unsafe { NVIC::unmask(Interrupt::UART0) };
}

#[interrupt]
fn UART0() {
    // SAFETY: only this handler reads the received bytes and their event.
    let line = unsafe { Peripherals::steal() }.UART0;
    while line.events_rxdrdy.read().bits() != 0 {
        line.events_rxdrdy.write(|event| unsafe { event.bits(0) });
        take(line.rxd.read().bits() as u8);
    }
}

fn take(byte: u8) {
    let (length, ends) = (LENGTH.load(Relaxed), matches!(byte, b'\r' | b'\n'));
    if WHOLE.load(Relaxed) {
        // If a line ends with two characters, the second means nothing.
        TOO_FAST.store(TOO_FAST.load(Relaxed) || !ends, Relaxed);
    } else if ends {
        WHOLE.store(length > 0, Relaxed);
    } else if let Some(slot) = LINE.get(usize::from(length)) {
        slot.store(byte, Relaxed);
        LENGTH.store(length.wrapping_add(1), Relaxed);
    } else {
        TOO_LONG.store(true, Relaxed);
    }
}

/// Hands over the received line, or its fault. Does nothing before a line is complete.
pub fn read(take: impl FnOnce(Result<&str, &'static str>)) {
    if !WHOLE.load(Relaxed) {
        return;
    }
    let mut bytes = [0; LONGEST];
    for (byte, came) in bytes.iter_mut().zip(&LINE) {
        *byte = came.load(Relaxed);
    }
    let text = bytes.get(..usize::from(LENGTH.load(Relaxed))).and_then(|bytes| core::str::from_utf8(bytes).ok());
    let (too_fast, too_long) = (TOO_FAST.load(Relaxed), TOO_LONG.load(Relaxed));
    // The next line may come as soon as the answer to this one is sent, so room is made for it before.
    TOO_FAST.store(false, Relaxed);
    TOO_LONG.store(false, Relaxed);
    LENGTH.store(0, Relaxed);
    WHOLE.store(false, Relaxed);
    take(match text {
        _ if too_fast => Err("more was said before the answer came; say one line at a time"),
        _ if too_long => Err("a line has at most 64 bytes; say it with fewer"),
        Some(text) => Ok(text),
        None => Err("a line is text in UTF-8"),
    });
}

/// Sends a text, and waits until it is sent.
pub fn print(text: &str) {
    text.bytes().for_each(send);
}

fn send(byte: u8) {
    // SAFETY: only the main program sends.
    let line = unsafe { &*UART0::ptr() };
    line.txd.write(|out| unsafe { out.bits(u32::from(byte)) });
    while line.events_txdrdy.read().bits() == 0 {}
    line.events_txdrdy.write(|event| unsafe { event.bits(0) });
}

/// Sends a line of bytes, two hexadecimal digits each.
pub fn print_digits(bytes: &[u8]) {
    for &byte in bytes {
        for digit in [byte >> 4, byte & 15] {
            send(if digit < 10 { b'0' + digit } else { b'a' - 10 + digit });
        }
    }
    say(&[]);
}
