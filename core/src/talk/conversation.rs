//! The memory of a conversation: the last task, the thing that it moved, the place that it named, and the earlier places of the thing and
//! the robot. Words such as "it", "there" and "back" refer to these. They are facts about objects, as *leftmost* is.

use crate::memory::AgentMemory;
use crate::oomdp::{Domain, GroundProposition, ObjectId, PropositionId, digest};
use crate::session::Agent;
use crate::task::grounded::is_thing;
use crate::task::{GroundedTask, LiftedTask};

/// The memory of a conversation: a few bytes, whatever its length. [`Agent::remember`] updates it after each task that was followed. It
/// outlives sessions, and is about one home: in another it is empty.
///
/// It is a value: a shell that undoes a task restores an earlier copy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Conversation {
    /// The digest of its domain.
    domain: u32,
    last: Option<GroundedTask>,
    thing: Option<ObjectId>,
    place: Option<ObjectId>,
    thing_was: Option<ObjectId>,
    robot_was: Option<ObjectId>,
}

/// A reference of words that need the earlier sentences.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Fact {
    /// The thing that the last task was about: "it".
    MovedLast,
    /// The place that was named last: "there".
    NamedLast,
    /// The place where that thing was before the last task that moved it: "put it back".
    WasThereBefore,
    /// The place where the robot was before the last task: "go back".
    RobotWasThereBefore,
    /// The thing most like the thing of the last task: "the other one".
    OtherOfItsKind,
}

impl Fact {
    /// All facts, in order.
    pub const ALL: [Self; 5] = [Self::MovedLast, Self::NamedLast, Self::WasThereBefore, Self::RobotWasThereBefore, Self::OtherOfItsKind];

    /// The value that words are learned for, in the manner of a [derived fact](Domain::tell_derived).
    pub const fn name(self) -> &'static str {
        match self {
            Self::MovedLast => "movedLast",
            Self::NamedLast => "namedLast",
            Self::WasThereBefore => "wasThereBefore",
            Self::RobotWasThereBefore => "robotWasThereBefore",
            Self::OtherOfItsKind => "otherOfItsKind",
        }
    }
}

/// What words can refer to.
#[derive(Clone, Copy)]
pub(super) enum Before<'c> {
    /// No earlier task.
    Nothing,
    /// The conversation of earlier tasks.
    Known(&'c Conversation),
    /// A part of the same utterance that is not done yet.
    Open,
}

impl Conversation {
    /// An empty conversation.
    pub const NEW: Self = Self { domain: 0, last: None, thing: None, place: None, thing_was: None, robot_was: None };

    /// The same conversation if it is about this domain, else an empty one.
    #[must_use]
    pub fn here<D: Domain>(self, domain: &D) -> Self {
        if self.is_empty() || self.domain == digest(domain) { self } else { Self::NEW }
    }

    /// A conversation from a record: the last task, and the object of each fact. The object of [`Fact::OtherOfItsKind`] follows from the
    /// thing.
    #[must_use]
    pub fn recorded<D: Domain>(domain: &D, last: Option<GroundedTask>, object: impl Fn(Fact) -> Option<ObjectId>) -> Self {
        Self {
            domain: digest(domain),
            last,
            thing: object(Fact::MovedLast),
            place: object(Fact::NamedLast),
            thing_was: object(Fact::WasThereBefore),
            robot_was: object(Fact::RobotWasThereBefore),
        }
    }

    /// The object kept for a fact, as [`recorded`](Self::recorded) takes it.
    pub const fn object(&self, fact: Fact) -> Option<ObjectId> {
        match fact {
            Fact::MovedLast => self.thing,
            Fact::NamedLast => self.place,
            Fact::WasThereBefore => self.thing_was,
            Fact::RobotWasThereBefore => self.robot_was,
            Fact::OtherOfItsKind => None,
        }
    }

    /// Whether nothing is remembered.
    pub const fn is_empty(&self) -> bool {
        self.last.is_none()
    }

    /// The last task.
    pub const fn last(&self) -> Option<&GroundedTask> {
        self.last.as_ref()
    }

    /// The conversation after a task that was begun in the state `before`; `lifted` are the agent's lifted tasks. If the task was done
    /// already, the conversation names its objects, but nothing has moved.
    #[must_use]
    pub fn after<D: Domain>(self, domain: &D, lifted: &[LiftedTask], before: &D::State, task: &GroundedTask) -> Self {
        let Some(kind) = lifted.get(usize::from(task.lifted)) else { return self };
        let (world, mut after) = (domain.world(), self.here(domain));
        (after.domain, after.last) = (digest(domain), Some(*task));
        for part in task.propositions(kind) {
            let Some(place) = place_of(domain, &part) else { continue };
            after.place = Some(place);
            let Some(subject) = part.arguments.first().copied().filter(|&subject| is_thing(&world, subject)) else { continue };
            let was = where_was(domain, part.proposition, subject, before);
            // A thing that stays in its place keeps its earlier place.
            let known = after.thing_was.filter(|_| after.thing == Some(subject));
            after.thing_was = was.filter(|&was| was != place || task.is_negated()).or(known);
            after.thing = Some(subject);
        }
        if !task.is_reached(kind, |part| domain.holds(part, before)) {
            let was = robots(domain, lifted).find_map(|(proposition, robot)| where_was(domain, proposition, robot, before));
            // A robot that has pushed a thing through a door stands in the door, in no place: the thing's goal is near.
            let near = || self.here(domain).place.filter(|&place| after.place != Some(place));
            after.robot_was = was.or_else(near);
        }
        after
    }

    /// The memory that words can refer to.
    pub(super) const fn before(&self) -> Before<'_> {
        if self.is_empty() { Before::Nothing } else { Before::Known(self) }
    }

    /// Whether a fact holds of an object.
    pub fn holds<D: Domain>(&self, domain: &D, fact: Fact, object: ObjectId) -> bool {
        match fact {
            Fact::MovedLast => self.thing == Some(object),
            Fact::NamedLast => self.place == Some(object),
            Fact::WasThereBefore => self.thing_was == Some(object),
            Fact::RobotWasThereBefore => self.robot_was == Some(object),
            Fact::OtherOfItsKind => self.thing.is_some_and(|thing| is_other(domain, thing, object)),
        }
    }

    /// Whether a fact holds of any object.
    pub fn knows<D: Domain>(&self, domain: &D, fact: Fact) -> bool {
        domain.world().objects.iter().any(|(object, _)| self.holds(domain, fact, object))
    }

    /// Passes each fact of an object to `tell`.
    #[cfg(feature = "ways")]
    pub(crate) fn tell<D: Domain>(&self, domain: &D, object: ObjectId, tell: &mut dyn FnMut(&str)) {
        if !self.is_empty() {
            Fact::ALL.into_iter().filter(|&fact| self.holds(domain, fact, object)).for_each(|fact| tell(fact.name()));
        }
    }
}

/// The place in a proposition about a subject and its place: the last argument.
pub(super) fn place_of<D: Domain>(domain: &D, part: &GroundProposition) -> Option<ObjectId> {
    let last = domain.world().schema.parameters(part.proposition).len().checked_sub(1).filter(|&last| last > 0)?;
    part.arguments.get(last).copied()
}

/// The place of a subject in this state, by this proposition.
fn where_was<D: Domain>(domain: &D, proposition: PropositionId, subject: ObjectId, state: &D::State) -> Option<ObjectId> {
    let world = domain.world();
    let [_, class] = *world.schema.parameters(proposition) else { return None };
    world
        .objects
        .of_class(class)
        .find(|&place| place != subject && domain.holds(&GroundProposition::new(proposition, &[subject, place]), state))
}

/// The robots, with the propositions for their place: objects that no words tell apart.
fn robots<D: Domain>(domain: &D, lifted: &[LiftedTask]) -> impl Iterator<Item = (PropositionId, ObjectId)> {
    let world = domain.world();
    lifted.iter().flat_map(LiftedTask::propositions).filter_map(move |part| {
        let [class, _] = *world.schema.parameters(part.proposition) else { return None };
        let robot = world.objects.of_class(class).next().filter(|&object| !is_thing(&world, object))?;
        Some((part.proposition, robot))
    })
}

/// Whether an object is the other one of a thing's kind: of its class, and at least as many values in common with it as any other.
fn is_other<D: Domain>(domain: &D, thing: ObjectId, object: ObjectId) -> bool {
    let world = domain.world();
    let class = |object| world.objects.get(object).map(|object| object.class);
    let values = || 0..world.schema.attributes.len();
    let alike = |other: ObjectId| {
        let same = |&attribute: &usize| {
            let value = world.objects.value(other, attribute);
            !value.is_empty() && value == world.objects.value(thing, attribute)
        };
        values().filter(same).count()
    };
    let mut others = world.objects.iter().map(|(id, _)| id).filter(|&other| other != thing && class(other) == class(thing));
    object != thing && class(object) == class(thing) && others.all(|other| alike(other) <= alike(object))
}

impl<M: AgentMemory> Agent<M> {
    /// The memory of the conversation.
    pub const fn conversation(&self) -> &Conversation {
        &self.conversation
    }

    /// Continues from an earlier copy of the conversation, or from [`Conversation::NEW`].
    pub const fn resume(&mut self, conversation: Conversation) {
        self.conversation = conversation;
    }

    /// Remembers a task that was followed from the state `before`. [`listen`](Self::listen) then resolves "it", "there", "back", "the other
    /// one", "the same" and "again", as far as its table has these words. With the feature `ways`, the descriptions of tasks contain the
    /// [facts](Fact), so that other words are learned for them. Without this call the agent has no facts, and understands as without them.
    ///
    /// ```
    /// use goodbot::talk::Fact;
    /// use goodbot::{Agent, HeapMemory, Options, home::{self, Area, Cell, HomeBuilder, Moves}};
    /// let mut memory = HeapMemory::new(&goodbot::Capacities::SMALL);
    /// let mut builder = HomeBuilder::new(&mut memory.home);
    /// builder.room("room0", Area::new(0, 0, 8, 4), "red")?;
    /// builder.room("room1", Area::new(0, 4, 8, 8), "green")?;
    /// builder.door("door0", Area::new(4, 4, 4, 4))?;
    /// builder.agent("agent0", Cell::new(4, 2))?;
    /// let (home, state) = builder.build(Moves::Push)?;
    /// let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// agent.hear(&home, &state, "go to the green room")?;
    /// let task = agent.tasks()[0];
    /// agent.remember(&home, &state, &task);
    /// let room = home.objects().find("room0").ok_or("no room")?;
    /// assert!(agent.conversation().holds(&home, Fact::RobotWasThereBefore, room));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn remember<D: Domain>(&mut self, domain: &D, before: &D::State, task: &GroundedTask) {
        self.conversation = self.conversation.after(domain, &self.lifted, before, task);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::home::{Area, Cell, HomeBuilder, Moves, paper_tasks};
    use crate::{Capacities, HeapMemory, Options};
    use std::format;
    use std::string::String;
    use std::vec::Vec;

    /// The memory of an agent after these tasks; each comes with the object that it moves and its new cell. Three rooms in a row, red, blue
    /// and green, have a red chair, a blue bag and a green chair in them, in this order. The robot begins in the red room.
    fn remembered(tasks: &[(&str, &str, Cell)]) -> Vec<String> {
        let mut memory = HeapMemory::new(&Capacities::STANDARD);
        let mut builder = HomeBuilder::new(&mut memory.home);
        for (room, left) in [("red", 0), ("blue", 6), ("green", 12)] {
            builder.room(room, Area::new(left, 0, left + 6, 6), room).unwrap();
        }
        for (name, left) in [("door0", 6), ("door1", 12)] {
            builder.door(name, Area::new(left, 3, left, 3)).unwrap();
        }
        builder.agent("robot", Cell::new(1, 3)).unwrap();
        for (name, left, color, shape) in [("chair0", 3, "red", "chair"), ("bag", 9, "blue", "bag"), ("chair1", 15, "green", "chair")] {
            builder.block(name, Cell::new(left, 3), color, shape).unwrap();
        }
        let (home, mut state) = builder.build(Moves::Push).unwrap();
        let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        for (text, thing, cell) in tasks {
            agent.listen(&home, &state, "do it", crate::talk::ClosedWords::NONE).unwrap();
            let task = agent.tasks()[agent.task_named(&home, text).unwrap()];
            agent.remember(&home, &state, &task);
            state = home.placed(&state, &[(home.objects().find(thing).unwrap(), *cell)]).unwrap();
        }
        let conversation = *agent.conversation();
        let home = &home;
        let facts = |(object, _)| {
            let name = home.objects().name(object);
            Fact::ALL
                .into_iter()
                .filter(move |&fact| conversation.holds(home, fact, object))
                .map(move |fact| format!("{name} {}", fact.name()))
        };
        home.objects().iter().flat_map(facts).collect()
    }

    #[test]
    fn where_the_robot_went_is_there_and_where_it_came_from_is_back() {
        let went = ("agentInRoom(robot,green)", "robot", Cell::new(14, 3));
        assert_eq!(remembered(&[went]), ["red robotWasThereBefore", "green namedLast"]);
        let on = ("agentInRoom(robot,blue)", "robot", Cell::new(8, 3));
        assert_eq!(remembered(&[went, on]), ["blue namedLast", "green robotWasThereBefore"]);
    }

    #[test]
    fn what_was_moved_is_it_and_its_like_is_the_other_one() {
        let moved = ("blockInRoom(chair0,blue)", "chair0", Cell::new(7, 3));
        let facts = ["red wasThereBefore", "red robotWasThereBefore", "blue namedLast", "chair0 movedLast", "chair1 otherOfItsKind"];
        assert_eq!(remembered(&[moved]), facts);
        let went = ("agentInRoom(robot,green)", "robot", Cell::new(14, 3));
        let facts = ["red wasThereBefore", "red robotWasThereBefore", "green namedLast", "chair0 movedLast", "chair1 otherOfItsKind"];
        assert_eq!(remembered(&[moved, went]), facts, "going somewhere moves nothing else");
    }

    #[test]
    fn what_is_done_already_is_spoken_of_and_moves_nothing() {
        let went = ("agentInRoom(robot,blue)", "robot", Cell::new(8, 3));
        let still = ("blockInRoom(bag,blue)", "robot", Cell::new(8, 3));
        let facts = ["red robotWasThereBefore", "blue namedLast", "chair0 otherOfItsKind", "bag movedLast", "chair1 otherOfItsKind"];
        assert_eq!(remembered(&[went, still]), facts);
    }

    #[test]
    fn nothing_is_remembered_before_the_first_task() {
        assert!(remembered(&[]).is_empty() && Conversation::NEW.is_empty());
    }
}
