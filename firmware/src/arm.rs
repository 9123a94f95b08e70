//! A robot of one's own: the arm of the library's examples, taught on the controller. Prints what it cost; exits with 0 where it understands a
//! command that it never heard.

#![no_std]
#![no_main]

mod board;
#[path = "../../core/examples/arm/domain.rs"]
mod domain;
mod fault;
mod memory;
#[allow(dead_code, reason = "the whole stack is not told")]
mod stack;

use board::report;
use domain::{Arm, Shelf};
use goodbot::feedback::Feedback;
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::oomdp::{Domain, ObjectId};
use goodbot::{Agent, Options};
use goodbot_course::lesson::{Lesson, Turn};
use goodbot_course::{CourseError, Trainer, generator};
use goodbot_drill::SEED;

static mut MEMORY: memory::RobotMemory = memory::RobotMemory::new();

/// Commands, and what they mean: the position of the lifted task, and its objects by their positions.
const LESSONS: [(&str, (u8, [usize; 2])); 5] = [
    ("put the cup on the red slot", (1, [5, 1])),
    ("put the ball on the yellow slot", (1, [6, 4])),
    ("move to the green slot", (0, [0, 2])),
    ("move to the yellow slot", (0, [0, 4])),
    ("put the ball on the red slot", (1, [6, 1])),
];
const UNHEARD: (&str, (u8, [usize; 2])) = ("put the cup on the yellow slot", (1, [5, 4]));

/// Judges every action, and rightly.
struct Attentive;

impl Trainer for Attentive {
    fn feedback<R: rand_core::Rng + ?Sized>(&self, correct: bool, _: &mut R) -> Feedback {
        if correct { Feedback::Reward } else { Feedback::Punish }
    }
}

/// The position of the task that is meant.
fn intended(agent: &Agent<impl AgentMemory>, (lifted, objects): (u8, [usize; 2])) -> Option<usize> {
    agent.tasks().iter().position(|task| {
        let parts = agent.lifted().get(usize::from(task.lifted)).into_iter().flat_map(|lifted| task.propositions(lifted));
        task.lifted == lifted
            && parts.flat_map(|part| part.arguments).map(ObjectId::index).zip(objects).all(|(found, meant)| found == meant)
    })
}

/// Teaches all lessons. Returns whether the command that was never heard is understood.
fn course(agent: &mut Agent<impl AgentMemory>, arm: &Arm<'_>) -> Result<bool, CourseError> {
    let (start, mut random) = (Shelf { arm: 0, things: [1, 2] }, generator(SEED));
    for (command, meaning) in LESSONS {
        agent.hear(arm, &start, command)?;
        let mut lesson = Lesson::meaning(&start, intended(agent, meaning).ok_or(CourseError::NotPosed)?);
        while let Turn::Acted(_) = lesson.step(agent, arm, &Attentive, &mut random)? {}
        let _ = agent.finish(arm)?;
        agent.learn_fully();
    }
    let (command, meaning) = UNHEARD;
    agent.hear(arm, &start, command)?;
    Ok(intended(agent, meaning).is_some_and(|task| agent.most_likely() == Some(task)))
}

#[board::entry]
fn main() -> ! {
    board::start_counter(board::MOST_PERIOD);
    // SAFETY: this function runs once, and nothing else touches the static.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    let (Ok(arm), Ok(tasks)) = (Arm::new(memory.home.lend().objects), Arm::tasks()) else { board::exit(2) };
    // Borrow the `Result`: moving the value out would copy it on the stack.
    let mut made = Agent::new(&mut memory.agent, &tasks, Options::DEFAULT);
    let Ok(agent) = made.as_mut() else { board::exit(2) };
    let understood = course(agent, &arm);
    report("instructions", board::instructions() as u32);
    report("states", arm.state_count() as u32);
    report("statics", stack::statics());
    report("stack", stack::deepest());
    board::exit(if understood == Ok(true) { 0 } else { 1 })
}
