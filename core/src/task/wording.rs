//! The order in which a task is worded: earlier goals, the goal, the clauses `through`, and the clause `avoiding`.

use super::{GroundedTask, LiftedTask, Part};
use crate::capacity::PROPOSITIONS_PER_TASK;
use crate::oomdp::{GroundProposition, World};
use core::fmt;

/// The separators between the parts of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wording {
    and: &'static str,
    then: &'static str,
    through: &'static str,
    or: &'static str,
    avoiding: &'static str,
}

/// A piece of a task's wording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece<T> {
    /// The text between two propositions, or before one.
    Between(&'static str),
    /// A proposition, and the part that it belongs to.
    Proposition(Part, T),
}

impl Wording {
    /// As files write it: `agentInRoom(agent0,room0) avoiding agentInRoom(agent0,room2)`.
    pub const FILES: Self = Self { and: " & ", then: " then ", through: " through ", or: " or ", avoiding: " avoiding " };
    /// As people say it: `go to the green room, but not through the red room`.
    pub const PEOPLE: Self = Self { and: " and ", then: ", then ", through: ", through ", or: " or ", avoiding: ", but not through " };

    /// Passes the pieces of a task to `give`, in order; `parts` are those of a [lifted](super::LiftedTask::parts) or a
    /// [grounded](super::GroundedTask::parts) task.
    ///
    /// ```
    /// use goodbot::home::SCHEMA;
    /// use goodbot::task::{LiftedTask, Piece, Wording};
    /// let task = LiftedTask::parse("agentInRoom(?a, ?goal) avoiding agentInRoom(?a, ?not)", &SCHEMA)?;
    /// let mut kind = String::new();
    /// Wording::FILES.tell(task.parts(), |piece| match piece {
    ///     Piece::Between(sign) => kind.push_str(sign),
    ///     Piece::Proposition(_, part) => kind.push_str(SCHEMA.proposition_name(part.proposition)),
    /// });
    /// assert_eq!(kind, "agentInRoom avoiding agentInRoom");
    /// # Ok::<(), goodbot::task::TaskTextError>(())
    /// ```
    pub fn tell<T>(&self, parts: impl Iterator<Item = (Part, T)> + Clone, mut give: impl FnMut(Piece<T>)) {
        let mut list = |wanted: Part, before: &'static str, between: &'static str| {
            let mut sign = before;
            for (part, proposition) in parts.clone().filter(|&(part, _)| part == wanted) {
                if !sign.is_empty() {
                    give(Piece::Between(sign));
                }
                give(Piece::Proposition(part, proposition));
                sign = between;
            }
        };
        let most = PROPOSITIONS_PER_TASK as u8;
        let mut before = "";
        for stage in 0..most {
            list(Part::Before(stage), before, self.and);
            before = self.then;
        }
        let has_stages = parts.clone().any(|(part, _)| matches!(part, Part::Before(_)));
        list(Part::Goal, if has_stages { self.then } else { "" }, self.and);
        for clause in 0..most {
            list(Part::Through(clause), self.through, self.or);
        }
        list(Part::Avoiding, self.avoiding, self.or);
    }
}

/// A grounded task as files write it, such as `blockInRoom(block0,room1)` or `!blockInRoom(block0,room1)`: see
/// [`Agent::task_text`](crate::Agent::task_text).
#[derive(Clone, Copy, Debug)]
pub struct TaskText<'a> {
    task: &'a GroundedTask,
    lifted: &'a LiftedTask,
    world: World<'a>,
}

impl<'a> TaskText<'a> {
    /// The text of a task that grounds `lifted` among the objects of `world`.
    pub const fn new(task: &'a GroundedTask, lifted: &'a LiftedTask, world: World<'a>) -> Self {
        Self { task, lifted, world }
    }

    fn write(&self, f: &mut fmt::Formatter<'_>, part: &GroundProposition) -> fmt::Result {
        f.write_str(self.world.schema.proposition_name(part.proposition))?;
        let parameters = self.world.schema.parameters(part.proposition).len();
        for (position, &object) in part.arguments.iter().take(parameters).enumerate() {
            f.write_str(if position > 0 { "," } else { "(" })?;
            f.write_str(self.world.objects.name(object))?;
        }
        f.write_str(")")
    }
}

impl fmt::Display for TaskText<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut written = if self.task.is_negated() { f.write_str("!") } else { Ok(()) };
        Wording::FILES.tell(self.task.parts(self.lifted), |piece| {
            if written.is_ok() {
                written = match piece {
                    Piece::Between(sign) => f.write_str(sign),
                    Piece::Proposition(_, part) => self.write(f, &part),
                };
            }
        });
        written
    }
}

/// Whether a text is the task's text. Spaces do not matter.
impl PartialEq<str> for TaskText<'_> {
    fn eq(&self, text: &str) -> bool {
        let mut rest = Rest(text.chars());
        fmt::Write::write_fmt(&mut rest, format_args!("{self}")).is_ok() && rest.next().is_none()
    }
}

/// The rest of a text after a match of the text written so far.
struct Rest<'t>(core::str::Chars<'t>);

impl Rest<'_> {
    fn next(&mut self) -> Option<char> {
        self.0.find(|letter| *letter != ' ')
    }
}

impl fmt::Write for Rest<'_> {
    fn write_str(&mut self, written: &str) -> fmt::Result {
        let is_next = written.chars().filter(|letter| *letter != ' ').all(|letter| self.next() == Some(letter));
        if is_next { Ok(()) } else { Err(fmt::Error) }
    }
}
