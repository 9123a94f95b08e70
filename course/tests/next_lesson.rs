//! Does the proposal help? Robots that are taught what it proposes, against others, until they understand 24 commands.
//!
//! `cargo test --workspace --test next_lesson -- --nocapture` writes the table of docs/page.md.

use goodbot::feedback::{SimulatedTrainer, Strategy};
use goodbot::home::Cell;
use goodbot::memory::AgentMemory;
use goodbot::{Agent, Capacities, HeapMemory, Options, home};
use goodbot_course::layout::BlockPlan;
use goodbot_course::next_lesson::{next_lesson, times_heard};
use goodbot_course::{Exercise, HomeName, Homes, Intention, LESSONS, Layout, generator, run_lesson};
use rand_core::Rng;

const ROOMS: [&str; 4] = ["green", "red", "blue", "yellow"];
const BLOCKS: [(&str, &str); 5] = [("blue", "chair"), ("purple", "bag"), ("yellow", "bag"), ("purple", "chair"), ("blue", "bag")];
/// Who needs more lessons is counted with so many.
const MOST: usize = 60;
const ROBOTS: u64 = 60;

/// What a robot is to understand: to go to four rooms, and to take five blocks to each.
fn wanted() -> Vec<Intention> {
    let take = |(color, shape)| ROOMS.map(|room| Intention::take(color, shape, room));
    ROOMS.map(Intention::go).into_iter().chain(BLOCKS.into_iter().flat_map(take)).collect()
}

/// Four rooms in which what is wanted is still to be done, with a block beside the one that is meant.
fn examination(wanted: &Intention) -> Layout {
    let mut layout = Homes::FIXED.test;
    let place = |(color, shape), cell| Some(BlockPlan { cell, color, shape });
    let (red, green, blue) = (Cell::new(6, 2), Cell::new(2, 6), Cell::new(6, 6));
    let meant = wanted.block.unwrap_or(BLOCKS[0]);
    let other = BLOCKS.into_iter().find(|block| block.0 != meant.0 && block.1 != meant.1).unwrap_or(BLOCKS[0]);
    layout.blocks = [place(meant, if wanted.room == "red" { green } else { red }), place(other, blue)];
    if wanted.room == "yellow" {
        layout.agent = Cell::new(5, 1);
    }
    layout
}

/// How lessons are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Choice {
    /// As proposed.
    Proposed,
    /// As proposed, but each in the most crowded home that has what it names.
    InCrowdedHomes,
    /// At random, of all that can be taught.
    AtRandom,
    /// The paper's seven, over and over.
    PaperOrder,
}

fn exercise(home: HomeName, intention: Intention) -> Exercise {
    Exercise { command: intention.to_string().leak(), intention, home }
}

/// How many lessons a robot needs until it understands everything that is wanted.
fn lessons_needed(choice: Choice, seed: u64) -> usize {
    let homes = Homes::FIXED;
    let mut lessons: Vec<Exercise> = match choice {
        Choice::PaperOrder => LESSONS.to_vec(),
        _ => homes.teachable().map(|(home, meant)| exercise(home, meant)).collect(),
    };
    if choice == Choice::InCrowdedHomes {
        lessons.reverse();
    }
    let commands: Vec<&str> = lessons.iter().map(|lesson| lesson.command).collect();
    let wanted: Vec<Exercise> = wanted().into_iter().map(|meant| exercise(HomeName::Test, meant)).collect();
    let texts: Vec<&str> = wanted.iter().map(|exercise| exercise.command).collect();
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    agent.set_strategies(&[(Strategy::BALANCED, 1.0)]).unwrap();
    let (trainer, mut random) = (SimulatedTrainer { strategy: Strategy::BALANCED }, generator(seed));
    for taught in 0..MOST {
        let at = match choice {
            Choice::PaperOrder => taught % lessons.len(),
            Choice::AtRandom => random.next_u32() as usize % lessons.len(),
            _ => next_lesson(&commands, &texts, |word| times_heard(&agent, word)).unwrap().unwrap().lesson,
        };
        let (home, start) = homes.layout(lessons[at].home).build(&mut memory.home).unwrap();
        run_lesson(&mut agent, &home, &start, &lessons[at], &trainer, &mut random, |_, _, _, _| ()).unwrap();
        if wanted.iter().all(|exercise| {
            let (home, start) = examination(&exercise.intention).build(&mut memory.home).unwrap();
            understands(&mut agent, &home, &start, exercise)
        }) {
            return taught + 1;
        }
    }
    MOST
}

fn understands(
    agent: &mut Agent<impl AgentMemory>,
    home: &home::Home<impl goodbot::memory::HomeMemory>,
    start: &home::HomeState,
    exercise: &Exercise,
) -> bool {
    let intended = exercise.pose(agent, home, start).unwrap().unwrap();
    let right = agent.most_likely() == Some(intended) && agent.belief().probability(intended) > 0.5;
    agent.forget();
    right
}

/// The mean, and half of its 95 % interval.
fn mean(counts: &[usize]) -> (f64, f64) {
    let count = counts.len() as f64;
    let mean = counts.iter().sum::<usize>() as f64 / count;
    let squares: f64 = counts.iter().map(|&one| (one as f64 - mean).powi(2)).sum();
    (mean, 1.96 * (squares / (count - 1.0) / count).sqrt())
}

#[test]
fn a_robot_that_is_taught_what_is_proposed_needs_fewer_lessons_than_others() {
    let [proposed, crowded, random, paper] =
        [Choice::Proposed, Choice::InCrowdedHomes, Choice::AtRandom, Choice::PaperOrder].map(|choice| {
            let counts: Vec<usize> = (1..=ROBOTS).map(|seed| lessons_needed(choice, seed)).collect();
            let (mean, interval) = mean(&counts);
            let never = counts.iter().filter(|&&count| count == MOST).count();
            println!("{choice:?}: {mean:.1} ± {interval:.1} lessons, {never} of {ROBOTS} not within {MOST}");
            (mean, interval)
        });
    for (name, other) in [("crowded", crowded), ("random", random), ("paper", paper)] {
        assert!(proposed.0 + proposed.1 < other.0 - other.1, "{proposed:?} proposed, {other:?} {name}");
    }
}
