//! The two buttons, polled by a task: their contacts bounce, and the emulator has no pin interrupts.

use embassy_nrf::Peri;
use embassy_nrf::gpio::{AnyPin, Input, Pull};
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use embassy_time::{Duration, Ticker};

/// A message by the buttons.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Press {
    /// B: the last action was right.
    Good,
    /// A: it was wrong.
    Bad,
    /// A and B: the lesson is over.
    End,
}

/// The presses that the robot has not taken yet.
pub static PRESSES: Channel<CriticalSectionRawMutex, Press, 4> = Channel::new();

/// The time between two polls. A press counts when two polls agree.
const LOOK: Duration = Duration::from_millis(10);

/// Polls the buttons for ever; the board pulls their pins up.
#[embassy_executor::task]
pub async fn watch(a: Peri<'static, AnyPin>, b: Peri<'static, AnyPin>) {
    let (a, b) = (Input::new(a, Pull::Up), Input::new(b, Pull::Up));
    let (mut last, mut down) = ((false, false), (false, false));
    let mut ticker = Ticker::every(LOOK);
    loop {
        ticker.next().await;
        let seen = (a.is_low(), b.is_low());
        if seen == last && seen != down {
            let press = match (down, seen) {
                (_, (true, true)) => Some(Press::End),
                ((false, false), (true, false)) => Some(Press::Bad),
                ((false, false), (false, true)) => Some(Press::Good),
                _ => None,
            };
            down = seen;
            if let Some(press) = press {
                PRESSES.send(press).await;
            }
        }
        last = seen;
    }
}
