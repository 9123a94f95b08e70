//! A small school: homes of four rooms, the paper's seven lessons and five tests, and a trainer who answers by a strategy.

use goodbot::feedback::Strategy;
use goodbot::home::{Area, Cell, Home, HomeBuilder, HomeState, Moves};
use goodbot::memory::AgentMemory;
use goodbot::memory::HomeMemory;
use goodbot::planning::{Judgement, OptimalSet};
use goodbot::task::GroundedTask;
use goodbot::{Agent, AgentError, Capacities, HeapMemory};
use goodbot_course::SimulatedTrainer;
use rand_pcg::Pcg32;

/// A block: its colour and shape.
pub type Block = (&'static str, &'static str);

/// A command with its home and its meaning.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// The command.
    pub command: String,
    /// The colours of the four rooms; the agent starts in the first.
    pub rooms: [&'static str; 4],
    /// The blocks, at most two, the first in the first room and the second in the second.
    pub blocks: Vec<Block>,
    /// Which block is meant, if any, and which room.
    pub intended: (Option<usize>, usize),
}

fn lesson(command: &str, rooms: [&'static str; 4], blocks: &[Block], intended: (Option<usize>, usize)) -> Lesson {
    Lesson { command: command.to_owned(), rooms, blocks: blocks.to_vec(), intended }
}

/// The paper's seven training commands.
pub fn lessons() -> Vec<Lesson> {
    vec![
        lesson("go to the green room", ["blue", "red", "green", "yellow"], &[], (None, 2)),
        lesson("go to the red room", ["blue", "red", "green", "yellow"], &[], (None, 1)),
        lesson("go to the blue room", ["red", "yellow", "blue", "green"], &[], (None, 2)),
        lesson("go to the yellow room", ["red", "yellow", "purple", "green"], &[], (None, 1)),
        lesson("take the blue chair to the yellow room", ["red", "yellow", "green", "blue"], &[("blue", "chair")], (Some(0), 1)),
        lesson("take the purple bag to the blue room", ["green", "blue", "red", "yellow"], &[("purple", "bag")], (Some(0), 1)),
        lesson("take the yellow bag to the red room", ["green", "blue", "red", "yellow"], &[("yellow", "bag")], (Some(0), 2)),
    ]
}

/// The paper's five test commands, all in one home.
pub fn tests() -> Vec<Lesson> {
    let blocks = [("purple", "chair"), ("blue", "bag")];
    let rooms = ["purple", "green", "yellow", "red"];
    let blue = ["purple", "green", "blue", "red"];
    vec![
        lesson("take the purple chair to the green room", rooms, &blocks, (Some(0), 1)),
        lesson("take the blue bag to the yellow room", rooms, &blocks, (Some(1), 2)),
        lesson("go to the green room", rooms, &blocks, (None, 1)),
        lesson("go to the red room", rooms, &blocks, (None, 3)),
        lesson("go to the blue room", blue, &blocks, (None, 2)),
    ]
}

impl Lesson {
    /// The home: four rooms of nine cells, two and two, with a door between each two neighbours.
    pub fn home<M: HomeMemory>(&self, memory: M) -> (Home<M>, HomeState) {
        self.home_in_order(&(0..11).collect::<Vec<_>>(), memory)
    }

    /// The same home, its objects added in another order: 0 to 3 are the rooms, 4 to 7 the doors, 8 and 9 the blocks, 10 the agent. Objects
    /// that `order` leaves out come last.
    pub fn home_in_order<M: HomeMemory>(&self, order: &[usize], memory: M) -> (Home<M>, HomeState) {
        let mut builder = HomeBuilder::new(memory);
        let corners = [(0, 0), (4, 0), (0, 4), (4, 4)];
        let gaps = [(4, 2), (4, 6), (2, 4), (6, 4)];
        let cells = [Cell::new(2, 2), Cell::new(6, 2)];
        let rest = (0..11).filter(|object| !order.contains(object));
        for object in order.iter().copied().chain(rest) {
            match object {
                0..4 => {
                    let (x, y) = corners[object];
                    builder.room(&format!("room{object}"), Area::new(x, y, x + 4, y + 4), self.rooms[object]).expect("a room");
                }
                4..8 => {
                    let (x, y) = gaps[object - 4];
                    builder.door(&format!("door{}", object - 4), Area::new(x, y, x, y)).expect("a door");
                }
                8..10 => {
                    let Some((color, shape)) = self.blocks.get(object - 8) else { continue };
                    builder.block(&format!("block{}", object - 8), cells[object - 8], color, shape).expect("a block");
                }
                _ => {
                    builder.agent("agent0", Cell::new(1, 1)).expect("an agent");
                }
            }
        }
        builder.build(Moves::PushAndPull).expect("a home")
    }

    /// The position of the intended task among the agent's.
    pub fn intended(&self, agent: &Agent<impl AgentMemory>) -> usize {
        // Rooms come first, doors next, then blocks and the agent; `objects` names them by their order of arrival.
        let (block, room) = self.intended;
        let is_it = |task: &GroundedTask| {
            let first = task.bindings[0].index();
            task.bindings[1].index() == room
                && usize::from(task.lifted) == usize::from(block.is_some())
                && block.is_none_or(|block| first == 8 + block)
        };
        agent.tasks().iter().position(is_it).expect("the intended task is possible")
    }
}

/// Trains the agent by one lesson to its end: three times doing nothing at the goal, a dead end, or a hundred steps.
///
/// # Errors
/// An error of the agent.
pub fn train(agent: &mut Agent<impl AgentMemory>, lesson: &Lesson, trainer: Strategy, random: &mut Pcg32) -> Result<(), AgentError> {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, mut state) = lesson.home(&mut memory.home);
    let trainer = SimulatedTrainer { strategy: trainer };
    agent.hear(&home, &state, &lesson.command)?;
    let intended = lesson.intended(agent);
    let mut at_goal = 0;
    for _ in 0..100 {
        agent.plan_fully(&home, &state)?;
        let decision = agent.decide_with(&home, &state, random)?;
        let optimal = agent.planned().optimal(intended);
        let correct = optimal.judge(decision.action) == Judgement::Correct;
        let word = trainer.feedback(correct, random);
        state = agent.acted(&home, &state, decision.action)?;
        let _ = agent.feedback(word)?;
        if optimal == OptimalSet::Goal && correct {
            at_goal += 1;
        }
        if at_goal == 3 || matches!(optimal, OptimalSet::DeadEnd(_)) {
            break;
        }
    }
    let _ = agent.finish(&home)?;
    agent.learn_fully();
    Ok(())
}

/// How many of the five tests the agent understands: the intended task is the most likely one on hearing the command.
pub fn tests_passed(agent: &mut Agent<impl AgentMemory>) -> usize {
    tests().iter().filter(|test| understands(agent, test)).count()
}

/// Whether the intended task is the most likely one on hearing the command.
pub fn understands(agent: &mut Agent<impl AgentMemory>, lesson: &Lesson) -> bool {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = lesson.home(&mut memory.home);
    agent.hear(&home, &state, &lesson.command).expect("a test is heard");
    let intended = lesson.intended(agent);
    let understood =
        (0..agent.tasks().len()).all(|task| task == intended || agent.belief().weight(intended).exceeds(agent.belief().weight(task)));
    agent.forget();
    understood
}

/// The posterior over the tasks on hearing a lesson's command, bit by bit.
pub fn posterior_bits(agent: &mut Agent<impl AgentMemory>, lesson: &Lesson) -> Vec<u32> {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = lesson.home(&mut memory.home);
    agent.hear(&home, &state, &lesson.command).expect("a test is heard");
    let bits = (0..agent.tasks().len()).map(|task| agent.belief().probability(task).to_bits()).collect();
    agent.forget();
    bits
}
