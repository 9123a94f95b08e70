//! The two buttons. A long press means neither good nor bad.

use crate::wiring::wiring;
use nrf51_pac::Peripherals;

/// A press shorter than this, in milliseconds, is only a contact that bounces.
const SHORTEST: u32 = 20;
/// A press of at least this many milliseconds is a long one.
const LONG: u32 = 800;

/// What somebody did with the buttons.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Press {
    /// A alone.
    A,
    /// B alone.
    B,
    /// Both at one time.
    Both,
    /// A long press of either, reported while it is still held.
    Long,
}

/// What is pressed, and since when.
#[derive(Debug)]
pub struct Buttons {
    since: Option<u32>,
    a: bool,
    b: bool,
    told: bool,
}

impl Buttons {
    /// Makes the pins inputs; the board pulls them up.
    pub fn begin(board: &Peripherals) -> Self {
        for pin in wiring().buttons {
            if let Some(pin) = board.GPIO.pin_cnf.get(usize::from(pin)) {
                pin.write(|pin| pin.dir().input().input().connect().pull().pullup());
            }
        }
        Self { since: None, a: false, b: false, told: false }
    }

    /// Polls the buttons; to be called often.
    pub fn poll(&mut self, board: &Peripherals, now: u32) -> Option<Press> {
        let (a, b) = down(board);
        if !a && !b {
            let held = now.wrapping_sub(self.since.take()?);
            return match (self.a, self.b) {
                _ if self.told || held < SHORTEST => None,
                (true, true) => Some(Press::Both),
                (true, false) => Some(Press::A),
                _ => Some(Press::B),
            };
        }
        let Some(since) = self.since else {
            *self = Self { since: Some(now), a, b, told: false };
            return None;
        };
        (self.a, self.b) = (self.a || a, self.b || b);
        let long = !self.told && self.a != self.b && now.wrapping_sub(since) >= LONG;
        self.told |= long;
        long.then_some(Press::Long)
    }
}

fn down(board: &Peripherals) -> (bool, bool) {
    let pins = board.GPIO.in_.read().bits();
    let [a, b] = wiring().buttons.map(|pin| pins >> (pin % 32) & 1 == 0);
    (a, b)
}
