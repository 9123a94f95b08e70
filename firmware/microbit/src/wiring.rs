//! The differences between the two versions of the board. Their chips, nRF51822 and nRF52833, have all registers that this program uses at
//! the same addresses; the second has one more port of pins.

use nrf51_pac::{FICR, gpio};

/// A version of the board. The pins of the second port are counted on from 32.
#[derive(Debug)]
pub struct Wiring {
    /// Bytes of a page of the flash.
    pub page: u32,
    /// The addresses of the ports.
    ports: &'static [usize],
    /// The pins of buttons A and B, which are on the first port.
    pub buttons: [u8; 2],
    /// The pin that sends to the computer, and the one that receives from it.
    pub serial: [u8; 2],
    /// The rows of lights: the pin of each row, and of each of its columns, with the light there, counted on from the top left. A light is on
    /// while its row is high and its column low.
    pub rows: &'static [(u8, &'static [(u8, u8)])],
}

const PORT_0: usize = 0x5000_0000;
const PORT_1: usize = 0x5000_0300;

static V1: Wiring = Wiring {
    page: 1_024,
    ports: &[PORT_0],
    buttons: [17, 26],
    serial: [24, 25],
    rows: &[
        (13, &[(4, 0), (5, 2), (6, 4), (7, 19), (8, 18), (9, 17), (10, 16), (11, 15), (12, 11)]),
        (14, &[(4, 14), (5, 10), (6, 12), (7, 1), (8, 3), (9, 23), (10, 21)]),
        (15, &[(4, 22), (5, 24), (6, 20), (7, 5), (8, 6), (9, 7), (10, 8), (11, 9), (12, 13)]),
    ],
};

static V2: Wiring = Wiring {
    page: 4_096,
    ports: &[PORT_0, PORT_1],
    buttons: [14, 23],
    serial: [6, 40],
    rows: &[
        (21, &[(28, 0), (11, 1), (31, 2), (37, 3), (30, 4)]),
        (22, &[(28, 5), (11, 6), (31, 7), (37, 8), (30, 9)]),
        (15, &[(28, 10), (11, 11), (31, 12), (37, 13), (30, 14)]),
        (24, &[(28, 15), (11, 16), (31, 17), (37, 18), (30, 19)]),
        (19, &[(28, 20), (11, 21), (31, 22), (37, 23), (30, 24)]),
    ],
};

/// The version that this board is: its chip tells the size of its pages.
pub fn wiring() -> &'static Wiring {
    // SAFETY: the register is always there, and only read.
    let page = unsafe { &*FICR::ptr() }.codepagesize.read().bits();
    if page == V1.page { &V1 } else { &V2 }
}

/// Some pins: a bit each, for both ports.
#[derive(Debug, Default)]
pub struct Pins([u32; 2]);

impl Pins {
    /// Adds a pin.
    pub fn add(&mut self, pin: u8) {
        let [first, second] = &mut self.0;
        *(if pin < 32 { first } else { second }) |= 1 << (pin % 32);
    }

    /// Makes these pins outputs.
    pub fn make_outputs(&self) {
        // SAFETY, here and below: any bits may be written here.
        self.on_each_port(|port, pins| port.dirset.write(|set| unsafe { set.bits(pins) }));
    }

    /// Makes these pins high, and all other outputs low.
    pub fn make_high(&self) {
        self.on_each_port(|port, pins| port.out.write(|out| unsafe { out.bits(pins) }));
    }

    fn on_each_port(&self, write: impl Fn(&gpio::RegisterBlock, u32)) {
        for (&port, &pins) in wiring().ports.iter().zip(&self.0) {
            // SAFETY: this version has a port at this address, and only the lights' module writes to it.
            write(unsafe { &*(port as *const gpio::RegisterBlock) }, pins);
        }
    }
}
