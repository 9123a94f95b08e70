//! What a conversation remembers: the last task, the thing that it moved, the place that it named, and where the thing and the robot were
//! before. Words such as "it", "there" and "back" stand for these. They are facts about objects, as *leftmost* is.

use super::recalled::Before;
use crate::memory::AgentMemory;
use crate::oomdp::{Domain, GroundProposition, ObjectId, PropositionId, digest};
use crate::session::Agent;
use crate::task::grounded::is_thing;
use crate::task::{GroundedTask, LiftedTask};

/// The memory of a conversation: some bytes that do not grow. [`Agent::remember`] fills it after each task that was followed. It outlives
/// sessions, and speaks of one home: in another it is empty.
///
/// A shell that takes a task back restores the copy that it made before: it is a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conversation {
    /// The digest of the domain that it speaks of.
    domain: u32,
    last: Option<GroundedTask>,
    thing: Option<ObjectId>,
    place: Option<ObjectId>,
    thing_was: Option<ObjectId>,
    robot_was: Option<ObjectId>,
}

impl Default for Conversation {
    fn default() -> Self {
        Self::NEW
    }
}

/// What a word may stand for that needs the sentences before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
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
    /// What is most like the thing of the last task, and another: "the other one".
    OtherOfItsKind,
}

impl Fact {
    /// All facts, in order.
    pub const ALL: [Self; 5] = [Self::MovedLast, Self::NamedLast, Self::WasThereBefore, Self::RobotWasThereBefore, Self::OtherOfItsKind];

    /// The value that words are learned for, as a [derived fact](Domain::tell_derived).
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

impl Conversation {
    /// Nothing was said yet.
    pub const NEW: Self = Self { domain: 0, last: None, thing: None, place: None, thing_was: None, robot_was: None };

    /// The same, if it speaks of this domain, and an empty one otherwise.
    #[must_use]
    pub fn here<D: Domain + ?Sized>(self, domain: &D) -> Self {
        if self.is_empty() || self.domain == digest(domain) { self } else { Self::NEW }
    }

    /// A conversation from a record: the task that was followed last, and the object that each fact holds of. What is most like the thing
    /// follows from the thing.
    #[must_use]
    pub fn recorded<D: Domain + ?Sized>(domain: &D, last: Option<GroundedTask>, object: impl Fn(Fact) -> Option<ObjectId>) -> Self {
        Self {
            domain: digest(domain),
            last,
            thing: object(Fact::MovedLast),
            place: object(Fact::NamedLast),
            thing_was: object(Fact::WasThereBefore),
            robot_was: object(Fact::RobotWasThereBefore),
        }
    }

    /// The object that a fact is kept for, as [`recorded`](Self::recorded) takes it.
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

    /// The task that was followed last.
    pub const fn last(&self) -> Option<&GroundedTask> {
        self.last.as_ref()
    }

    /// The conversation after a task that was begun in a state, of the lifted tasks of an agent. What is done already is spoken of, and moves
    /// nothing.
    #[must_use]
    pub fn after<D: Domain + ?Sized>(self, domain: &D, lifted: &[LiftedTask], before: &D::State, task: &GroundedTask) -> Self {
        let Some(kind) = lifted.get(usize::from(task.lifted)) else { return self };
        let (world, mut after) = (domain.world(), self.here(domain));
        (after.domain, after.last) = (digest(domain), Some(*task));
        for part in task.propositions(kind) {
            let Some(place) = place_of(domain, &part) else { continue };
            after.place = Some(place);
            let Some(subject) = part.arguments.first().copied().filter(|&subject| is_thing(&world, subject)) else { continue };
            let was = where_was(domain, part.proposition, subject, before);
            // What stays where it is was elsewhere before.
            let known = after.thing_was.filter(|_| after.thing == Some(subject));
            after.thing_was = was.filter(|&was| was != place || task.is_negated()).or(known);
            after.thing = Some(subject);
        }
        if !task.is_reached(kind, |part| domain.holds(part, before)) {
            let was = robots(domain, lifted).find_map(|(proposition, robot)| where_was(domain, proposition, robot, before));
            // Who has pushed a thing through a door stands in it, in no place: where the thing was to be is near.
            let near = || self.here(domain).place.filter(|&place| after.place != Some(place));
            after.robot_was = was.or_else(near);
        }
        after
    }

    /// What words can point back at.
    pub(super) const fn before(&self) -> Before<'_> {
        if self.is_empty() { Before::Nothing } else { Before::Known(self) }
    }

    /// Whether a fact holds of an object.
    pub fn holds<D: Domain + ?Sized>(&self, domain: &D, fact: Fact, object: ObjectId) -> bool {
        match fact {
            Fact::MovedLast => self.thing == Some(object),
            Fact::NamedLast => self.place == Some(object),
            Fact::WasThereBefore => self.thing_was == Some(object),
            Fact::RobotWasThereBefore => self.robot_was == Some(object),
            Fact::OtherOfItsKind => self.thing.is_some_and(|thing| is_other(domain, thing, object)),
        }
    }

    /// Whether a fact holds of any object.
    pub fn knows<D: Domain + ?Sized>(&self, domain: &D, fact: Fact) -> bool {
        domain.world().objects.iter().any(|(object, _)| self.holds(domain, fact, object))
    }

    /// Tells the facts of an object.
    #[cfg(feature = "derived")]
    pub(crate) fn tell<D: Domain + ?Sized>(&self, domain: &D, object: ObjectId, tell: &mut dyn FnMut(&str)) {
        if !self.is_empty() {
            Fact::ALL.into_iter().filter(|&fact| self.holds(domain, fact, object)).for_each(|fact| tell(fact.name()));
        }
    }
}

/// The last argument of a proposition about something and its place.
fn place_of<D: Domain + ?Sized>(domain: &D, part: &GroundProposition) -> Option<ObjectId> {
    let last = domain.world().schema.parameters(part.proposition).len().checked_sub(1).filter(|&last| last > 0)?;
    part.arguments.get(last).copied()
}

/// Where something was: the place that a proposition held with.
fn where_was<D: Domain + ?Sized>(domain: &D, proposition: PropositionId, subject: ObjectId, state: &D::State) -> Option<ObjectId> {
    let world = domain.world();
    let [_, class] = *world.schema.parameters(proposition) else { return None };
    world
        .objects
        .of_class(class)
        .find(|&place| place != subject && domain.holds(&GroundProposition::new(proposition, &[subject, place]), state))
}

/// The robots, with the propositions that tell their place: what no words tell apart.
fn robots<D: Domain + ?Sized>(domain: &D, lifted: &[LiftedTask]) -> impl Iterator<Item = (PropositionId, ObjectId)> {
    let world = domain.world();
    lifted.iter().flat_map(LiftedTask::propositions).filter_map(move |part| {
        let [class, _] = *world.schema.parameters(part.proposition) else { return None };
        let robot = world.objects.of_class(class).next().filter(|&object| !is_thing(&world, object))?;
        Some((part.proposition, robot))
    })
}

/// Whether an object is another of a thing's kind: of its class, and no third has more values in common with it.
fn is_other<D: Domain + ?Sized>(domain: &D, thing: ObjectId, object: ObjectId) -> bool {
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
    /// What is remembered of the conversation.
    pub const fn conversation(&self) -> &Conversation {
        &self.conversation
    }

    /// Goes on with a conversation, as it was when it was copied, or with [`Conversation::NEW`].
    pub const fn resume(&mut self, conversation: Conversation) {
        self.conversation = conversation;
    }

    /// Remembers a task that was followed from a state on. [`listen`](Self::listen) then knows what "it", "there", "back", "the other one", "the
    /// same" and "again" stand for, in the words of its table. With the feature `derived`, the descriptions of tasks tell the [facts](Fact), so that
    /// other words are learned for them. An agent that is not told of tasks has no facts, and understands as it did without them.
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
    pub fn remember<D: Domain + ?Sized>(&mut self, domain: &D, before: &D::State, task: &GroundedTask) {
        self.conversation = self.conversation.after(domain, &self.lifted, before, task);
    }
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use crate::home::{Area, Cell, HomeBuilder, Moves, paper_tasks};
    use crate::{Capacities, HeapMemory, Options};
    use std::format;
    use std::string::String;
    use std::vec::Vec;

    /// What an agent remembers after tasks, each with what it moves and where to. Three rooms in a row, red, blue and green, have a red chair, a
    /// blue bag and a green chair in them, in this order. The robot begins in the red room.
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
