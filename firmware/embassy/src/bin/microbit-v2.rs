//! The robot on a BBC micro:bit of the second version (nRF52833): button B is good, A is bad, both together end the lesson. It hears two
//! commands in turn, and walks in its mind: where the action leads to, a robot's motors would drive.

#![no_std]
#![no_main]

use embassy_embedded_hal::adapter::BlockingAsync;
use embassy_executor::Spawner;
use embassy_futures::select::{Either, select};
use embassy_nrf::gpio::{Input, Pull};
use embassy_nrf::nvmc::Nvmc;
use embassy_time::Timer;
use goodbot::home::paper_tasks;
use goodbot::storage::TwoSlotsAsync;
use goodbot::{Agent, Options};
use goodbot_embassy::{Press, Presses, RobotMemory, SLOT, lesson, remember, store, three_rooms};
use rand_pcg::Pcg32;

/// Where the two slots are: the linker keeps the program from here.
const SLOTS: u32 = 512 * 1_024 - 2 * SLOT;
/// Contacts tremble for so long.
const TREMBLE: u64 = 30;

static mut MEMORY: RobotMemory = RobotMemory::new();
static mut MODEL: [u8; 2_048] = [0; 2_048];
static PRESSES: Presses = Presses::new();

/// Waits for presses, and passes them on.
#[embassy_executor::task]
async fn buttons(mut a: Input<'static>, mut b: Input<'static>) {
    loop {
        let first = select(a.wait_for_low(), b.wait_for_low()).await;
        Timer::after_millis(TREMBLE).await;
        let press = match first {
            _ if a.is_low() && b.is_low() => Press::Over,
            Either::First(()) => Press::Bad,
            Either::Second(()) => Press::Good,
        };
        PRESSES.send(press).await;
        a.wait_for_high().await;
        b.wait_for_high().await;
        Timer::after_millis(TREMBLE).await;
    }
}

#[embassy_executor::main]
async fn main(spawner: Spawner) {
    let board = embassy_nrf::init(Default::default());
    if let Ok(buttons) = buttons(Input::new(board.P0_14, Pull::Up), Input::new(board.P0_23, Pull::Up)) {
        spawner.spawn(buttons);
    }
    let flash = BlockingAsync::new(Nvmc::new(board.NVMC));
    // SAFETY: this function runs once, and nothing else touches the statics.
    let (memory, model) = unsafe { (&mut *(&raw mut MEMORY), &mut *(&raw mut MODEL)) };
    let (Ok((home, start)), Ok(mut slots), Ok(tasks)) =
        (three_rooms(&mut memory.home), TwoSlotsAsync::new(flash, SLOTS, SLOT), paper_tasks())
    else {
        return;
    };
    let Ok(mut agent) = Agent::new(&mut memory.agent, &tasks, Options::DEFAULT) else { return };
    let _ = remember(&mut agent, &mut slots, model).await;
    let mut random = Pcg32::new(1, 1);
    for command in ["go to the green room", "go to the blue room"].iter().cycle() {
        let did = |_, _: &_, _: &_| {};
        if lesson(&mut agent, &home, &start, command, &PRESSES, &mut random, did).await.is_ok() {
            let _ = store(&mut agent, &mut slots).await;
        }
    }
}

/// Nothing here panics that a restart would not mend.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    cortex_m::peripheral::SCB::sys_reset()
}
