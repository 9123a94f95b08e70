//! The robot's task. Hearing, planning, ending a lesson and learning go in small parts, and after each the other tasks run.

use crate::buttons::{PRESSES, Press};
use crate::flash::Flash;
use crate::nrf51::{self, SLOT, START};
use crate::serial::{print, print_number, say};
use crate::stack;
use embassy_futures::yield_now;
use embassy_nrf::{Peri, peripherals};
use embassy_time::{Duration, with_timeout};
use goodbot::feedback::Feedback;
use goodbot::home::{Area, Cell, HomeBuilder, HomeState, Moves, paper_tasks};
use goodbot::memory::{AgentArrays, HomeArrays};
use goodbot::oomdp::{Action, Domain};
use goodbot::planning::Progress;
use goodbot::session::Evidence;
use goodbot::storage::TwoSlotsAsync;
use goodbot::{AgentError, Capacities, Options};
use rand_pcg::Pcg32;

/// The commands, one a lesson; after the last comes the first.
const COMMANDS: [&str; 4] =
    ["go to the green room", "go to the blue room", "take the chair to the green room", "take the chair to the blue room"];

/// How long it waits for feedback.
const PATIENCE: Duration = Duration::from_secs(4);

/// The budget of one part of the work: about ten milliseconds.
const PLAN: u32 = 50;
const LEARN: u32 = 100;

/// Less than the smallest preset, whose homes are twice as large: the other tasks need some of the RAM.
const CAPACITIES: Capacities = Capacities {
    cells: 20,
    states: 512,
    sessions: 6,
    commands: 40,
    command_tokens: 272,
    pairs: 72,
    sentence_words: 42,
    translations: 240,
    alignments: 384,
    ..Capacities::TINY
};

goodbot::memory! {
    struct RobotMemory = CAPACITIES;
}

type Agent = goodbot::Agent<AgentArrays<RobotMemory>>;
type Home = goodbot::home::Home<&'static mut HomeArrays<RobotMemory>>;

static mut AGENT: Agent = Agent::without_tasks(RobotMemory::new().agent);
static mut ROOMS: HomeArrays<RobotMemory> = RobotMemory::new().home;

struct Robot {
    agent: &'static mut Agent,
    home: Home,
    start: HomeState,
    slots: TwoSlotsAsync<Flash>,
    random: Pcg32,
}

/// Lives for ever, or says why it cannot.
#[embassy_executor::task]
pub async fn live(controller: Peri<'static, peripherals::NVMC>) {
    let Err(problem) = try_to_live(Flash::new(controller)).await;
    say(&["error: ", problem]);
}

async fn try_to_live(flash: Flash) -> Result<core::convert::Infallible, &'static str> {
    // SAFETY: there is one such task, and nothing else touches the statics.
    let (agent, rooms) = unsafe { (&mut *(&raw mut AGENT), &mut *(&raw mut ROOMS)) };
    let tasks = paper_tasks().map_err(|_| "the tasks cannot be read")?;
    agent.set_tasks(&tasks, Options { done: Options::SELDOM_DONE, ..Options::DEFAULT }).map_err(text)?;
    let (home, start) = house(rooms).ok_or("this is no home")?;
    let slots = TwoSlotsAsync::new(flash, START, SLOT).map_err(|_| "the slots do not lie as they must")?;
    let mut robot = Robot { agent, home, start, slots, random: Pcg32::new(1, 1) };
    robot.remember().await?;
    for command in COMMANDS.into_iter().cycle() {
        robot.lesson(command).await?;
        robot.learn().await;
        robot.store().await?;
    }
    Err("there are no commands")
}

/// A red room above; a green and a blue one below, each behind a door; a yellow chair in the red one.
fn house(rooms: &'static mut HomeArrays<RobotMemory>) -> Option<(Home, HomeState)> {
    let mut home = HomeBuilder::new(rooms);
    home.room("room0", Area::new(0, 3, 6, 6), "red").ok()?;
    home.room("room1", Area::new(0, 0, 3, 3), "green").ok()?;
    home.room("room2", Area::new(3, 0, 6, 3), "blue").ok()?;
    home.door("door0", Area::new(2, 3, 2, 3)).ok()?;
    home.door("door1", Area::new(4, 3, 4, 3)).ok()?;
    home.block("block0", Cell::new(3, 4), "yellow", "chair").ok()?;
    home.agent("agent0", Cell::new(1, 5)).ok()?;
    home.build(Moves::Push).ok()
}

impl Robot {
    /// Restores the stored model, and trains it.
    async fn remember(&mut self) -> Result<(), &'static str> {
        let Some((at, length)) = self.slots.find().await.map_err(|_| "the flash cannot be read")? else {
            say(&["nothing is stored"]);
            return Ok(());
        };
        let model = nrf51::model(at, length).ok_or("the flash cannot be read")?;
        self.takes_back(model)?;
        tell("stored: ", length as u32, " bytes");
        self.learn().await;
        Ok(())
    }

    /// One command, until somebody ends the lesson.
    async fn lesson(&mut self, command: &str) -> Result<(), &'static str> {
        let mut state = self.start;
        say(&["hears: ", command]);
        self.begin(&state, command)?;
        while self.hears_on()? == Progress::Working {
            yield_now().await;
        }
        loop {
            while self.plans_on(&state)? == Progress::Working {
                yield_now().await;
            }
            self.act(&mut state)?;
            match with_timeout(PATIENCE, PRESSES.receive()).await {
                Ok(Press::Good) => self.judge(Feedback::Reward, "good")?,
                Ok(Press::Bad) => self.judge(Feedback::Punish, "bad")?,
                Ok(Press::End) => break,
                Err(_) => say(&["nothing was said"]),
            }
        }
        self.end()?;
        while self.ends_on()? == Progress::Working {
            yield_now().await;
        }
        Ok(())
    }

    // Functions of their own, so that the stack of one call is free before the next.

    #[inline(never)]
    fn begin(&mut self, state: &HomeState, command: &str) -> Result<(), &'static str> {
        self.agent.begin_hearing(&self.home, state, command).map_err(text)
    }

    #[inline(never)]
    fn hears_on(&mut self) -> Result<Progress, &'static str> {
        self.agent.hear_on(&self.home, 1).map_err(text)
    }

    #[inline(never)]
    fn plans_on(&mut self, state: &HomeState) -> Result<Progress, &'static str> {
        self.agent.plan(&self.home, state, PLAN).map_err(text)
    }

    #[inline(never)]
    fn act(&mut self, state: &mut HomeState) -> Result<(), &'static str> {
        let action = self.agent.decide_with(&self.home, state, &mut self.random).map_err(text)?.action;
        *state = self.agent.acted(&self.home, state, action).map_err(text)?;
        self.tell_what_was_done(action, state);
        Ok(())
    }

    #[inline(never)]
    fn end(&mut self) -> Result<(), &'static str> {
        self.agent.begin_finishing(&self.home).map_err(text)
    }

    #[inline(never)]
    fn ends_on(&mut self) -> Result<Progress, &'static str> {
        let Some(finished) = self.agent.finish_on(&self.home, 1).map_err(text)? else { return Ok(Progress::Working) };
        if finished.gave_way.count() > 0 {
            tell("", finished.gave_way.count() as u32, " older lessons gave way to this one");
        }
        Ok(Progress::Done)
    }

    #[inline(never)]
    fn learns_on(&mut self) -> Progress {
        self.agent.learn(LEARN)
    }

    #[inline(never)]
    fn takes_back(&mut self, model: &[u8]) -> Result<(), &'static str> {
        self.agent.restore(model).map_err(|_| "what is stored is damaged, or another robot's")
    }

    fn tell_what_was_done(&self, action: Action, state: &HomeState) {
        print("did ");
        print(self.home.actions().get(action.index()).filter(|_| action != Action::NOOP).map_or("nothing", |kind| kind.name));
        for &thing in [self.home.agent()].iter().chain(self.home.blocks()) {
            let cell = self.home.block_cell(state, thing).unwrap_or_else(|| self.home.agent_cell(state));
            say_place(self.home.objects().name(thing), cell);
        }
        say(&[""]);
    }

    fn judge(&mut self, feedback: Feedback, word: &str) -> Result<(), &'static str> {
        let evidence = self.agent.feedback(feedback).map_err(text)?;
        say(&[word, if evidence == Evidence::Used { "" } else { ": that says nothing about the last action" }]);
        Ok(())
    }

    async fn learn(&mut self) {
        while self.learns_on() == Progress::Working {
            yield_now().await;
        }
        tell("lessons ", self.agent.language().bitext().sessions() as u32, "");
        tell("statics ", stack::statics(), "");
        tell("deepest stack ", stack::deepest(), "");
    }

    async fn store(&mut self) -> Result<(), &'static str> {
        let model = self.agent.save_in_place().map_err(|_| "what was learned cannot be stored")?;
        let length = model.len() as u32;
        self.slots.store(model).await.map_err(|_| "the flash did not keep what was learned; the older knowledge is still there")?;
        tell("stored ", length, " bytes");
        Ok(())
    }
}

fn say_place(name: &str, cell: Cell) {
    print("; ");
    print(name);
    for number in [cell.x, cell.y] {
        print(" ");
        print_number(number);
    }
}

fn tell(before: &str, number: u32, after: &str) {
    print(before);
    print_number(number as i32);
    say(&[after]);
}

/// The text for an error.
fn text(error: AgentError) -> &'static str {
    match error {
        AgentError::NoTask => "there is nothing to do here: every task is done already",
        AgentError::Capacity(full) => {
            say(&["full: ", full.capacity.name()]);
            "a table is full; raise it in CAPACITIES"
        }
        _ => "the robot was asked for what it cannot do now",
    }
}
