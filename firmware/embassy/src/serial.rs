//! The serial line over USB: 115,200 baud, 8 bits, no parity, one stop bit. It only sends; embassy has no driver of this chip's.

use embassy_nrf::pac::UART0;
use embassy_nrf::pac::uart::vals::{Baudrate, Enable};

const SENDS: u32 = 24;

/// Starts the line.
pub fn begin() {
    UART0.pseltxd().write_value(SENDS);
    UART0.baudrate().write(|rate| rate.set_baudrate(Baudrate::Baud115200));
    UART0.enable().write(|enable| enable.set_enable(Enable::Enabled));
    UART0.tasks_starttx().write_value(1);
}

/// Sends a text, and waits until it is sent.
pub fn print(text: &str) {
    for byte in text.bytes() {
        UART0.txd().write(|out| out.set_txd(byte));
        while UART0.events_txdrdy().read() == 0 {}
        UART0.events_txdrdy().write_value(0);
    }
}

/// Sends a number.
pub fn print_number(number: u32) {
    let mut digits = [b'0'; 10];
    let (mut rest, mut length) = (number, 0_usize);
    for digit in digits.iter_mut().rev() {
        *digit = b'0' + (rest % 10) as u8;
        rest /= 10;
        length += 1;
        if rest == 0 {
            break;
        }
    }
    if let Some(text) = digits.get(digits.len().saturating_sub(length)..).and_then(|digits| core::str::from_utf8(digits).ok()) {
        print(text);
    }
}

/// Sends several texts and ends the line.
pub fn say(parts: &[&str]) {
    parts.iter().for_each(|part| print(part));
    print("\r\n");
}
