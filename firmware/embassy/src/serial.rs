//! The serial line over USB: 115,200 baud, 8 bits, no parity, one stop bit. It only sends; embassy has no driver of this chip's.

pub use crate::nrf51::{print_number, say};
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
