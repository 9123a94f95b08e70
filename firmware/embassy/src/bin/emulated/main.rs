//! The robot on an emulated Cortex-M4F. A simulated person presses the buttons; a heart beats meanwhile and notes how late it was. Exits with 0
//! where a robot that has only what was stored understands both commands.

#![no_std]
#![no_main]

mod flash;
mod time;

use embassy_executor::Spawner;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;
use embassy_time::{Duration, Instant, Ticker, Timer};
use flash::Flash;
use goodbot::home::{Cell, paper_tasks};
use goodbot::oomdp::Action;
use goodbot::storage::TwoSlotsAsync;
use goodbot::{Agent, Options};
use goodbot_embassy::{Press, Presses, RobotMemory, SLOT, lesson, remember, store, three_rooms};
use rand_pcg::Pcg32;
use semihosting::{println, process::exit};

static mut MEMORY: RobotMemory = RobotMemory::new();
static mut MODEL: [u8; 2_048] = [0; 2_048];
static PRESSES: Presses = Presses::new();
/// What the person sees the robot do.
static SEEN: Signal<CriticalSectionRawMutex, Seen> = Signal::new();

/// An action, as the person takes it.
#[derive(Clone, Copy)]
enum Seen {
    Nearer,
    Rested,
    Wrong,
}

/// Commands, and a cell of the room that is meant.
const LESSONS: [(&str, Cell); 2] = [("go to the green room", Cell::new(2, 5)), ("go to the blue room", Cell::new(6, 5))];

/// Somebody at the buttons, who takes a fifth of a second to press one, and ends the lesson when the robot has rested three times.
#[embassy_executor::task]
async fn person() {
    let mut rests = 0;
    loop {
        let seen = SEEN.wait().await;
        Timer::after(Duration::from_millis(200)).await;
        rests = if let Seen::Rested = seen { rests + 1 } else { 0 };
        PRESSES.send(if let Seen::Wrong = seen { Press::Bad } else { Press::Good }).await;
        if rests == 3 {
            rests = 0;
            PRESSES.send(Press::Over).await;
        }
    }
}

static LATEST: core::sync::atomic::AtomicU32 = core::sync::atomic::AtomicU32::new(0);

/// Beats every twenty milliseconds, as a control loop would.
#[embassy_executor::task]
async fn heart() {
    let beat = Duration::from_millis(20);
    let (mut ticker, mut due) = (Ticker::every(beat), Instant::now() + beat);
    loop {
        ticker.next().await;
        let late = Instant::now().saturating_duration_since(due).as_millis() as u32;
        LATEST.fetch_max(late, core::sync::atomic::Ordering::Relaxed);
        due += beat;
    }
}

#[embassy_executor::main]
async fn main(spawner: Spawner) {
    time::begin();
    if let (Ok(person), Ok(heart)) = (person(), heart()) {
        spawner.spawn(person);
        spawner.spawn(heart);
    }
    let right = run().await;
    println!("right {}\nlatest-beat {}", right.unwrap_or(0), LATEST.load(core::sync::atomic::Ordering::Relaxed));
    exit(if right == Some(LESSONS.len()) { 0 } else { 1 })
}

/// All lessons, each stored; then a robot that has only that. Returns how many commands it understands.
async fn run() -> Option<usize> {
    // SAFETY: this function runs once, and nothing else touches the statics.
    let (memory, model) = unsafe { (&mut *(&raw mut MEMORY), &mut *(&raw mut MODEL)) };
    let (home, start) = three_rooms(&mut memory.home).ok()?;
    let mut slots = TwoSlotsAsync::new(Flash::new(), 0, SLOT).ok()?;
    let tasks = paper_tasks().ok()?;
    let mut random = Pcg32::new(1, 1);
    {
        let mut agent = Agent::new(&mut memory.agent, &tasks, Options::DEFAULT).ok()?;
        for (command, meant) in LESSONS.iter().chain(&LESSONS) {
            let away = |state| {
                let Cell { x, y } = home.agent_cell(state);
                (x - meant.x).abs() + (y - meant.y).abs()
            };
            let did = |action: Action, before: &_, after: &_| {
                let seen = match (away(before), away(after)) {
                    (0, _) if action == Action::NOOP => Seen::Rested,
                    (before, after) if after < before => Seen::Nearer,
                    _ => Seen::Wrong,
                };
                SEEN.signal(seen);
            };
            lesson(&mut agent, &home, &start, command, &PRESSES, &mut random, did).await.ok()?;
            println!("stored {}", store(&mut agent, &mut slots).await?);
        }
    }
    // The power was gone: another robot, and the same flash.
    let mut agent = Agent::new(&mut memory.agent, &tasks, Options::DEFAULT).ok()?;
    println!("remembered {}", remember(&mut agent, &mut slots, model).await?);
    let mut right = 0;
    for (task, (command, _)) in LESSONS.iter().enumerate() {
        agent.hear(&home, &start, command).ok()?;
        right += usize::from(agent.most_likely() == Some(task));
        agent.forget();
    }
    Some(right)
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    exit(101)
}
