//! Commands for the arm, and its understanding of them.

use crate::arm::{Arm, Shelf};
use crate::digest::Digest;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::ObjectId;
use goodbot::{Agent, AgentError};

/// What a command means: the position of the lifted task, and its objects by their positions.
pub type Meaning = (u8, [usize; 2]);

/// The commands of its lessons.
pub const LESSONS: [(&str, Meaning); 5] = [
    ("put the cup on the red slot", (1, [5, 1])),
    ("put the ball on the yellow slot", (1, [6, 4])),
    ("move to the green slot", (0, [0, 2])),
    ("move to the yellow slot", (0, [0, 4])),
    ("put the ball on the red slot", (1, [6, 1])),
];
pub const UNHEARD: (&str, Meaning) = ("put the cup on the yellow slot", (1, [5, 4]));

pub const START: Shelf = Shelf { arm: 0, things: [1, 2] };

/// The position of the task that is meant.
pub fn intended(agent: &Agent<impl AgentMemory>, (lifted, objects): Meaning) -> Option<usize> {
    agent.tasks().iter().position(|task| {
        let parts = agent.lifted().get(usize::from(task.lifted)).into_iter().flat_map(|lifted| task.propositions(lifted));
        task.lifted == lifted
            && parts.flat_map(|part| part.arguments).map(ObjectId::index).zip(objects).all(|(found, meant)| found == meant)
    })
}

/// Hears each command without its first word, because the lessons that had one word for word tell more than parameters can. Returns the
/// digest of all posteriors, and whether the last command, which was in no lesson, is understood.
pub fn understanding(agent: &mut Agent<impl AgentMemory>, arm: &Arm<'_>) -> Result<(Digest, bool), AgentError> {
    let (mut digest, mut understood) = (Digest::EMPTY, false);
    for (command, meaning) in LESSONS.into_iter().chain([UNHEARD]) {
        agent.hear(arm, &START, command.split_once(' ').map_or(command, |(_, words)| words))?;
        (0..agent.tasks().len()).for_each(|task| digest.take(agent.belief().probability(task)));
        understood = intended(agent, meaning).is_some_and(|task| agent.most_likely() == Some(task));
    }
    Ok((digest, understood))
}
