//! Every call with full tables: a home of 912 cells with five blocks and 48 tasks, and a robot that keeps as many sessions as it has room for.
//! Prints the most instructions of each kind of call, with the smallest budgets of the fixed tick.

#![no_std]
#![no_main]

mod board;
mod fault;
#[allow(dead_code, reason = "the whole stack is not told")]
mod stack;

use board::report;
use goodbot::feedback::Feedback;
use goodbot::home::{self, Area, Cell, Home, HomeBuilder, HomeError, HomeState, Moves};
use goodbot::memory::HomeMemory;
use goodbot::planning::Progress;
use goodbot::snapshot::{Restoring, Saving};
use goodbot::{Agent, AgentError, Capacities, Options};

/// Sessions that it keeps.
const SESSIONS: usize = 128;

goodbot::memory! {
    /// The tables of hosts, with fewer states and fewer words, and room for the sessions.
    pub struct RobotMemory = Capacities {
        states: 65_536,
        hashed_states: 0,
        sessions: SESSIONS,
        words: 64,
        word_bytes: 512,
        pairs: SESSIONS * 48,
        sentence_words: SESSIONS * 8,
        translations: 16_384,
        alignments: 16_384,
        ..Capacities::STANDARD
    };
}

static mut MEMORY: RobotMemory = RobotMemory::new();
static mut MODEL: [u8; 128 * 1024] = [0; 128 * 1024];

const COLORS: [&str; 9] = ["red", "green", "blue", "yellow", "pink", "white", "black", "gray", "brown"];
const ROOMS: [&str; 9] = ["room0", "room1", "room2", "room3", "room4", "room5", "room6", "room7", "room8"];
const BLOCKS: [(&str, &str, &str); 5] = [
    ("block0", "red", "bag"),
    ("block1", "green", "chair"),
    ("block2", "blue", "bag"),
    ("block3", "yellow", "chair"),
    ("block4", "pink", "basket"),
];
const VERBS: [&str; 8] = ["go", "drive", "bring", "take", "carry", "move", "push", "roll"];
const THINGS: [&str; 8] = ["bag", "chair", "basket", "yourself", "it", "thing", "seat", "sack"];

/// How many calls of a plan are measured: the whole plan takes hundreds of millions of instructions.
const PLAN_CALLS: u32 = 20_000;

/// The most instructions of one call of a kind.
fn longest<R>(most: &mut u32, call: impl FnOnce() -> R) -> R {
    let began = board::instructions();
    let result = call();
    *most = (board::instructions().wrapping_sub(began) as u32).max(*most);
    result
}

/// Nine rooms of ten by ten cells, in a square.
fn build<M: HomeMemory>(memory: M, most: &mut u32) -> Result<(Home<M>, HomeState), HomeError> {
    let mut builder = HomeBuilder::new(memory);
    for (at, (name, color)) in (0..).zip(ROOMS.into_iter().zip(COLORS)) {
        let (x, y) = (at % 3 * 11, at / 3 * 11);
        builder.room(name, Area::new(x, y, x + 11, y + 11), color)?;
    }
    let doors = ["d0", "d1", "d2", "d3", "d4", "d5", "d6", "d7", "d8", "d9", "da", "db"];
    let places = (0..3).flat_map(|row| (1..3).flat_map(move |wall| [(wall * 11, row * 11 + 5), (row * 11 + 5, wall * 11)]));
    for (name, (x, y)) in doors.into_iter().zip(places) {
        builder.door(name, Area::new(x, y, x, y))?;
    }
    for (at, (name, color, shape)) in (0..).zip(BLOCKS) {
        builder.block(name, Cell::new(3 + at, 3 + at), color, shape)?;
    }
    builder.agent("agent0", Cell::new(1, 1))?;
    while longest(most, || builder.find_cells(1))? == Progress::Working {}
    longest(most, || builder.build(Moves::Push))
}

/// A command by its number: all commands together have many words, each in several of them.
fn command(number: usize) -> heapless::String<64> {
    let mut text = heapless::String::new();
    let pick = |words: &[&'static str], at: usize| words.get(at % words.len()).copied().unwrap_or("");
    for word in
        [pick(&VERBS, number), "the", pick(&COLORS, number / 3), pick(&THINGS, number / 8), "to", "the", pick(&COLORS, number), "room"]
    {
        let _ = text.push_str(word);
        let _ = text.push(' ');
    }
    text
}

fn run(memory: &mut RobotMemory, model: &mut [u8]) -> Result<u32, AgentError> {
    let no_task = AgentError::NoTask;
    let [mut built, mut begun, mut heard, mut planned, mut decided, mut acted] = [0; 6];
    let [mut ended, mut learned, mut saved, mut restored] = [0; 4];
    let made = build(&mut memory.home, &mut built);
    let (home, start) = made.as_ref().map_err(|_| no_task)?;
    report("build", built);
    let tasks = home::paper_tasks().map_err(|_| no_task)?;
    let mut agent = Agent::new(&mut memory.agent, &tasks, Options::DEFAULT)?;
    for number in 0..SESSIONS {
        agent.hear(home, start, &command(number))?;
        agent.finish_for_later(home)?;
    }
    // One more session, for which an older one gives way.
    longest(&mut begun, || agent.begin_hearing(home, start, &command(SESSIONS)))?;
    while longest(&mut heard, || agent.hear_on(home, 1))? == Progress::Working {}
    longest(&mut ended, || agent.begin_finishing(home))?;
    while longest(&mut ended, || agent.finish_on(home, 1))?.is_none() {}
    report("finish", ended);
    while longest(&mut learned, || agent.learn(16)) == Progress::Working {}
    let mut saving = Saving::new();
    let length = loop {
        if let Some(length) = longest(&mut saved, || agent.save_on(&mut saving, model, 1)).map_err(|_| no_task)? {
            break length;
        }
    };
    report("save", saved);
    report("model", length as u32);
    let mut restoring = Restoring::of(model.get(..length).unwrap_or(&[]));
    while longest(&mut restored, || agent.restore_on(&mut restoring, 1)).map_err(|_| no_task)? == Progress::Working {}
    report("restore", restored);
    while longest(&mut learned, || agent.learn(16)) == Progress::Working {}
    report("learn", learned);
    longest(&mut begun, || agent.begin_hearing(home, start, &command(7)))?;
    while longest(&mut heard, || agent.hear_on(home, 1))? == Progress::Working {}
    report("begin-hearing", begun);
    report("hear", heard);
    let mut calls = 0;
    while calls < PLAN_CALLS && longest(&mut planned, || agent.plan(home, start, 8))? == Progress::Working {
        calls += 1;
    }
    report("plan", planned);
    agent.plan_fully(home, start)?;
    let decision = longest(&mut decided, || agent.decide(home, start))?;
    longest(&mut acted, || agent.acted(home, start, decision.action))?;
    for feedback in [Feedback::Reward, Feedback::Punish] {
        let _ = longest(&mut acted, || agent.feedback(feedback))?;
    }
    report("decide", decided);
    report("act", acted);
    Ok(agent.tasks().len() as u32)
}

#[board::entry]
fn main() -> ! {
    board::start_counter(board::MOST_PERIOD);
    // SAFETY: this function runs once, and nothing else touches the statics.
    let (memory, model) = unsafe { (&mut *(&raw mut MEMORY), &mut *(&raw mut MODEL)) };
    let outcome = run(memory, model);
    report("statics", stack::statics());
    report("stack", stack::deepest());
    match outcome {
        Ok(tasks) => {
            report("tasks", tasks);
            board::exit(if tasks == 48 { 0 } else { 1 })
        }
        Err(error) => {
            if let AgentError::Capacity(full) = error {
                board::print(full.capacity.name());
                report("-asked", full.given as u32);
            }
            board::exit(2)
        }
    }
}
