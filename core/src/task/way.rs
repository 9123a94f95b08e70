//! Ways: path constraints of a task, which must hold before its goal counts as reached.

use super::{GroundedTask, LiftedTask};
use crate::oomdp::GroundProposition;

/// The part of a task that a proposition belongs to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Part {
    /// It belongs to the goal, the last one if there are several.
    #[default]
    Goal,
    /// It belongs to an earlier goal, the one at this position.
    Before(u8),
    /// It is one of the alternatives of the clause `through` at this position.
    Through(u8),
    /// It must not hold before the end.
    Avoiding,
}

/// A kind of clause of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Clause {
    /// `through`: one of the alternatives holds at some time.
    Through,
    /// `avoiding`: none of the alternatives holds before the end.
    Avoiding,
}

/// The progress of a task's way, or the mark of a negated task, which has no way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct WayState(u8);

/// Bits 0 to 2: the clauses `through` that were met. Bits 3 and 4: the number of earlier goals reached.
const PASSED: u8 = 7;
const STAGE: u32 = 3;
const STAGES: u8 = 3 << STAGE;
/// The task is negated.
const NEGATED: u8 = 1 << 5;
/// The task was done once.
const ENDED: u8 = 1 << 6;
/// Something to be avoided has happened.
const BROKEN: u8 = 1 << 7;

impl WayState {
    /// Before the first state.
    pub const START: Self = Self(0);

    /// The task is negated: it must not hold, at any time.
    #[cfg(feature = "talk")]
    pub(crate) const NEGATED: Self = Self(NEGATED);

    /// Whether the task is negated.
    pub const fn is_negated(self) -> bool {
        cfg!(feature = "talk") && self.0 & NEGATED != 0
    }

    /// The progress at the start of a session.
    pub(crate) const fn at_start(self) -> Self {
        if cfg!(feature = "talk") { Self(self.0 & NEGATED) } else { Self::START }
    }

    /// Whether the task was done once. Its way then requires nothing more.
    pub(crate) const fn has_ended(self) -> bool {
        self.0 & ENDED != 0
    }

    /// Whether something to be avoided has happened: the task has become impossible.
    pub const fn is_broken(self) -> bool {
        self.0 & BROKEN != 0
    }

    /// The number of earlier goals reached.
    pub const fn stage(self) -> u8 {
        (self.0 & STAGES) >> STAGE
    }

    /// Whether a clause `through` was met.
    pub(crate) const fn has_passed(self, clause: u8) -> bool {
        self.0 & PASSED & (1_u8.wrapping_shl(clause as u32)) != 0
    }

    const fn passing(self, clause: u8) -> Self {
        Self(self.0 | 1_u8.wrapping_shl(clause as u32) & PASSED)
    }

    const fn at_next_stage(self) -> Self {
        Self(self.0 + (1 << STAGE))
    }
}

/// The way of a grounded task: path constraints, which must hold before its goal counts as reached.
///
/// | text | meaning for a course of states up to its last one | as a formula |
/// |---|---|---|
/// | `goal through P` | P holds in one of them, the last included | F(P & F goal) |
/// | `goal through P or Q` | P or Q holds in one of them | F((P or Q) & F goal) |
/// | `goal avoiding P` | P holds in none before the last | (not P) U goal |
/// | `first then goal` | `first` holds in one of them, and the goal there or later | F(first & F goal) |
///
/// A way is a small automaton, whose state is a [`WayState`]. It advances with each state that the robot reaches, the first included.
#[derive(Clone, Copy, Debug)]
pub struct Way<'l> {
    lifted: &'l LiftedTask,
    task: GroundedTask,
}

impl<'l> Way<'l> {
    /// The way of a task; `lifted` is its lifted task.
    pub const fn of(task: &GroundedTask, lifted: &'l LiftedTask) -> Self {
        Self { lifted, task: *task }
    }

    /// Whether the task has no way.
    pub fn is_none(&self) -> bool {
        !self.lifted.has_way()
    }

    /// The way's propositions, without the goal's, in the order of the text.
    pub fn parts(&self) -> impl Iterator<Item = (Part, GroundProposition)> + use<'l> {
        let task = self.task;
        self.lifted.way().map(move |(part, proposition)| (part, task.grounded(proposition)))
    }

    /// The number of earlier goals.
    pub(crate) fn stages(&self) -> u8 {
        let positions = self.lifted.way().map(|(part, _)| if let Part::Before(position) = part { position.saturating_add(1) } else { 0 });
        positions.max().unwrap_or(0)
    }

    /// The clauses `through` that are still to be met.
    pub fn pending(&self, state: WayState) -> impl Iterator<Item = u8> + use<'l> {
        let lifted = self.lifted;
        let has = move |clause: &u8| lifted.way().any(|(part, _)| part == Part::Through(*clause));
        (0..3).filter(has).filter(move |&clause| !state.has_passed(clause))
    }

    /// Whether only the goal is left, with nothing to avoid: the task is then like one without a way.
    pub(crate) fn is_finished(&self, state: WayState) -> bool {
        let open = |(part, _)| match part {
            Part::Goal => false,
            Part::Before(position) => position >= state.stage(),
            Part::Through(clause) => !state.has_passed(clause),
            Part::Avoiding => true,
        };
        state.has_ended() || !self.lifted.way().any(open)
    }

    /// The propositions of one part.
    fn parts_of(&self, wanted: Part) -> impl Iterator<Item = GroundProposition> + use<'l> {
        self.parts().filter(move |&(part, _)| part == wanted).map(|(_, proposition)| proposition)
    }

    /// Whether something to be avoided holds.
    pub fn is_violated(&self, holds: impl Fn(&GroundProposition) -> bool) -> bool {
        self.parts_of(Part::Avoiding).any(|part| holds(&part))
    }

    /// Whether only the goal is left to reach.
    pub fn leads_to_goal(&self, state: WayState) -> bool {
        state.stage() == self.stages() && self.pending(state).next().is_none()
    }

    /// Marks the clauses and earlier goals that hold in a state as done. `holds` evaluates propositions in the state.
    #[must_use]
    pub fn pass(&self, mut now: WayState, holds: impl Fn(&GroundProposition) -> bool) -> WayState {
        for clause in self.pending(now) {
            if self.parts_of(Part::Through(clause)).any(|part| holds(&part)) {
                now = now.passing(clause);
            }
        }
        while now.stage() < self.stages() && self.parts_of(Part::Before(now.stage())).all(|part| holds(&part)) {
            now = now.at_next_stage();
        }
        now
    }

    /// The progress of the way after a state. `holds` evaluates propositions in the state.
    #[must_use]
    pub fn advance(&self, now: WayState, holds: impl Fn(&GroundProposition) -> bool) -> WayState {
        if self.is_none() || now.has_ended() || now.is_broken() {
            return now;
        }
        let now = self.pass(now, &holds);
        if self.leads_to_goal(now) && self.task.propositions(self.lifted).all(|part| holds(&part)) {
            WayState(now.0 | ENDED)
        } else if self.is_violated(&holds) {
            WayState(now.0 | BROKEN)
        } else {
            now
        }
    }

    /// Whether another task has the same way and the same progress: one search then serves both.
    pub(crate) fn is_shared_with(&self, other: &Way<'_>) -> bool {
        self.task.way == other.task.way && self.parts().eq(other.parts())
    }

    /// The number of different states that the way can be in before its goal.
    pub(crate) fn layers(&self) -> u8 {
        self.layer(WayState(PASSED | self.stages() << STAGE)).saturating_add(1)
    }

    /// The position of a state among the way's layers.
    pub(crate) fn layer(&self, state: WayState) -> u8 {
        let clauses = self.pending(WayState::START).count() as u32;
        let passed = state.0 & PASSED & 1_u8.wrapping_shl(clauses).wrapping_sub(1);
        state.stage().wrapping_shl(clauses) | passed
    }

    /// The state of a layer.
    pub(crate) fn of_layer(&self, layer: u8) -> WayState {
        let clauses = self.pending(WayState::START).count() as u32;
        WayState(layer & 1_u8.wrapping_shl(clauses).wrapping_sub(1) | layer.wrapping_shr(clauses) << STAGE)
    }

    /// Whether the way adds no constraint in this start state: a part of it is done already, or something to be avoided holds. `holds`
    /// evaluates propositions in the state. The result is whether [`advance`](Self::advance) changes the first progress, found in one pass,
    /// because a command asks it of every task.
    pub fn is_idle(&self, holds: impl Fn(&GroundProposition) -> bool) -> bool {
        let (mut is_through, mut has_first, mut is_first_reached) = (false, false, true);
        for (part, proposition) in self.parts() {
            match part {
                Part::Before(stage) => {
                    has_first = true;
                    is_first_reached = is_first_reached && (stage > 0 || holds(&proposition));
                }
                Part::Through(_) | Part::Avoiding if holds(&proposition) => return true,
                Part::Through(_) => is_through = true,
                Part::Avoiding | Part::Goal => {}
            }
        }
        if is_through || has_first || self.is_none() {
            return has_first && is_first_reached;
        }
        self.task.propositions(self.lifted).all(|part| holds(&part))
    }

    /// Whether another grounding of the lifted task, with its objects in order, means the same: alternatives and clauses commute.
    pub(crate) fn is_twin(&self) -> bool {
        let parts = || self.lifted.way().zip(self.parts()).map(|((_, lifted), (part, ground))| (part, lifted, ground));
        let alone = |part: Part| parts().filter(|&(other, ..)| other == part).count() == 1;
        let exchangeable = |a: Part, b: Part| match (a, b) {
            (Part::Through(one), Part::Through(other)) => one == other || alone(a) && alone(b),
            (Part::Avoiding, Part::Avoiding) => true,
            _ => false,
        };
        parts().enumerate().any(|(position, (part, lifted, ground))| {
            parts().skip(position.saturating_add(1)).any(|(other, lifted_other, ground_other)| {
                let differ = || lifted.variables.iter().zip(&lifted_other.variables).filter(|(a, b)| a != b);
                exchangeable(part, other)
                    && ground.proposition == ground_other.proposition
                    && differ().all(|(&a, &b)| self.lifted.uses(a) == 1 && self.lifted.uses(b) == 1)
                    && ground.arguments > ground_other.arguments
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::home::SCHEMA;
    use crate::oomdp::ObjectId;

    #[test]
    fn a_way_is_idle_if_the_first_state_changes_its_progress() {
        let texts = [
            "agentInRoom(?a, ?r)",
            "agentInRoom(?a, ?r) avoiding agentInRoom(?a, ?q)",
            "agentInRoom(?a, ?r) through agentInRoom(?a, ?q)",
            "agentInRoom(?a, ?r) through agentInRoom(?a, ?q) or agentInRoom(?a, ?s)",
            "agentInRoom(?a, ?r) through agentInRoom(?a, ?q) avoiding agentInRoom(?a, ?s)",
            "agentInRoom(?a, ?q) then agentInRoom(?a, ?r)",
            "agentInRoom(?a, ?q) & blockInRoom(?o, ?q) then agentInRoom(?a, ?r)",
            "agentInRoom(?a, ?q) then agentInRoom(?a, ?s) then agentInRoom(?a, ?r)",
            "agentInRoom(?a, ?q) then agentInRoom(?a, ?r) avoiding agentInRoom(?a, ?s)",
        ];
        for text in texts {
            let lifted = LiftedTask::parse(text, &SCHEMA).unwrap();
            let mut task = GroundedTask { lifted: 0, ..GroundedTask::UNUSED };
            task.bindings.iter_mut().zip(0..).for_each(|(slot, object)| *slot = ObjectId(object));
            let way = Way::of(&task, &lifted);
            for state in 0..16_u32 {
                // Each state has other propositions that hold.
                let holds = |part: &GroundProposition| state >> (part.arguments[1].0 % 4) & 1 == 1;
                let changes = !way.is_none() && way.advance(WayState::START, holds) != WayState::START;
                assert_eq!(way.is_idle(holds), changes, "{text} {state:b}");
            }
        }
    }
}
