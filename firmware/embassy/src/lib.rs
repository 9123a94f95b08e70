//! A robot as tasks of embassy. What it does goes in small parts, between which every other task has its turn; what buttons say waits in a
//! channel; what it learned is stored over `embedded-storage-async`. A board adds its buttons, its motors and its flash:
//!
//! - `emulated`: an emulated Cortex-M4F, where a simulated person presses the buttons; `cargo xtask test --only firmware` runs it;
//! - `microbit-v2`: a BBC micro:bit of the second version. It is built and was never tried.

#![no_std]
#![deny(missing_docs)]

use embassy_futures::yield_now;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use embassy_time::{Duration, Instant, with_deadline};
use embedded_storage_async::nor_flash::NorFlash;
use goodbot::feedback::Feedback;
use goodbot::home::{Area, Cell, Home, HomeBuilder, HomeError, HomeState, Moves};
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::oomdp::Action;
use goodbot::planning::Progress;
use goodbot::storage::TwoSlotsAsync;
use goodbot::{Agent, AgentError};
use rand_pcg::Pcg32;

goodbot::memory! {
    /// The robot's memory.
    pub struct RobotMemory = goodbot::Capacities::TINY;
}

/// What somebody says by a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Press {
    /// The last action was right.
    Good,
    /// The last action was wrong.
    Bad,
    /// The lesson is over.
    Over,
}

/// Presses that the robot has not taken in yet. Interrupts and other tasks only send to it: the robot itself is used by one task alone.
pub type Presses = Channel<CriticalSectionRawMutex, Press, 4>;

/// From one action to the next.
pub const PACE: Duration = Duration::from_millis(1_500);
/// Bytes of one of the two slots of the flash.
pub const SLOT: u32 = 4 * 1_024;

/// What one part of the work may do, before other tasks have their turn.
const CELLS: u32 = 1;
const EXPANSIONS: u32 = 50;
const LEARN: u32 = 100;

/// A red room below; a green and a blue one above, each behind a door.
///
/// # Errors
/// Where the memory is too small.
pub fn three_rooms<M: HomeMemory>(memory: M) -> Result<(Home<M>, HomeState), HomeError> {
    let mut builder = HomeBuilder::new(memory);
    builder.room("room0", Area::new(0, 0, 8, 4), "red")?;
    builder.room("room1", Area::new(0, 4, 4, 8), "green")?;
    builder.room("room2", Area::new(4, 4, 8, 8), "blue")?;
    builder.door("door0", Area::new(2, 4, 2, 4))?;
    builder.door("door1", Area::new(6, 4, 6, 4))?;
    builder.agent("agent0", Cell::new(4, 2))?;
    builder.build(Moves::Push)
}

/// One lesson: hears the command, acts, takes in what buttons say, and learns. `did` is told of each action and of the states before and
/// after it; there a robot drives its motors, and would return what it senses.
///
/// # Errors
/// What the robot refuses.
pub async fn lesson<M: HomeMemory>(
    agent: &mut Agent<impl AgentMemory>,
    home: &Home<M>,
    start: &HomeState,
    command: &str,
    presses: &Presses,
    random: &mut Pcg32,
    mut did: impl FnMut(Action, &HomeState, &HomeState),
) -> Result<(), AgentError> {
    agent.begin_hearing(home, start, command)?;
    while agent.hear_on(home, CELLS)? == Progress::Working {
        yield_now().await;
    }
    let mut state = *start;
    loop {
        while agent.plan(home, &state, EXPANSIONS)? == Progress::Working {
            yield_now().await;
        }
        let action = agent.decide_by(home, &state, random)?.action;
        let next = agent.acted(home, &state, action)?;
        did(action, &state, &next);
        state = next;
        if is_over(agent, presses).await? {
            break;
        }
    }
    agent.begin_finishing(home)?;
    while agent.finish_on(home, CELLS)?.is_none() {
        yield_now().await;
    }
    learn(agent).await;
    Ok(())
}

/// Takes in what is said of the last action until it is time for the next one. Returns whether the lesson is over.
async fn is_over(agent: &mut Agent<impl AgentMemory>, presses: &Presses) -> Result<bool, AgentError> {
    let until = Instant::now() + PACE;
    while let Ok(press) = with_deadline(until, presses.receive()).await {
        let _ = match press {
            Press::Good => agent.feedback(Feedback::Reward)?,
            Press::Bad => agent.feedback(Feedback::Punish)?,
            Press::Over => return Ok(true),
        };
    }
    Ok(false)
}

/// Learns to the end.
pub async fn learn(agent: &mut Agent<impl AgentMemory>) {
    while agent.learn(LEARN) == Progress::Working {
        yield_now().await;
    }
}

/// Stores what was learned; returns its bytes, or nothing where it could not be stored: the older knowledge is then still there.
pub async fn store<F: NorFlash>(agent: &mut Agent<impl AgentMemory>, slots: &mut TwoSlotsAsync<F>) -> Option<usize> {
    let model = agent.save_in_place().ok()?;
    slots.store(model).await.ok()?;
    Some(model.len())
}

/// Takes back what was stored; returns its bytes, or nothing where there is none.
pub async fn remember<F: NorFlash>(agent: &mut Agent<impl AgentMemory>, slots: &mut TwoSlotsAsync<F>, buffer: &mut [u8]) -> Option<usize> {
    let length = slots.load(buffer).await.ok()??;
    agent.restore(buffer.get(..length)?).ok()?;
    learn(agent).await;
    Some(length)
}
