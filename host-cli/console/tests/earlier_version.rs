//! An update of a robot's program keeps its lessons.

use goodbot::home::{self, Area, Cell, Home, HomeBuilder, HomeState, Moves};
use goodbot::memory::HomeHeap;
use goodbot::oomdp::{
    Action, ActionKind, Attribute, Carrier, ClassId, Domain, GroundProposition, ObjectId, OneByOne, PropositionId, Schema, World,
};
use goodbot::session::Weights;
use goodbot::snapshot::Contents;
use goodbot::symbols::Symbol;
use goodbot::task::LiftedTask;
use goodbot::task::Marker;
use goodbot::{Agent, Capacities, HeapMemory, Options};

/// A home whose names are those of another version.
struct Version<'v> {
    home: &'v Home<HomeHeap>,
    schema: Schema<'v>,
    /// Which of a home's propositional functions each is.
    meant: &'v [u8],
}

impl Domain for Version<'_> {
    type State = HomeState;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        World { schema: self.schema, objects: self.home.world().objects }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        self.home.actions()
    }

    fn step(&self, state: &HomeState, action: Action) -> Option<HomeState> {
        self.home.step(state, action)
    }

    fn holds(&self, proposition: &GroundProposition, state: &HomeState) -> bool {
        let meant = PropositionId::new(self.meant[proposition.proposition.index()]);
        self.home.holds(&GroundProposition { proposition: meant, ..*proposition }, state)
    }

    fn state_count(&self) -> u64 {
        self.home.state_count()
    }

    fn number(&self, state: &HomeState) -> u64 {
        self.home.number(state)
    }

    fn numbered(&self, number: u64) -> HomeState {
        self.home.numbered(number)
    }

    fn tell_derived(&self, state: &HomeState, object: ObjectId, tell: &mut dyn FnMut(&str)) {
        self.home.tell_derived(state, object, tell);
    }
}

const BLOCK: ClassId = ClassId::new(3);

/// A green room and a red one above a blue one, with the robot and a yellow chair.
fn rooms() -> (Home<HomeHeap>, HomeState) {
    let mut builder = HomeBuilder::new(HomeHeap::new(&Capacities::SMALL));
    builder.room("room0", Area::new(0, 0, 8, 4), "blue").unwrap();
    builder.room("room1", Area::new(0, 4, 4, 8), "green").unwrap();
    builder.room("room2", Area::new(4, 4, 8, 8), "red").unwrap();
    builder.door("door0", Area::new(2, 4, 2, 4)).unwrap();
    builder.door("door1", Area::new(6, 4, 6, 4)).unwrap();
    builder.agent("agent0", Cell::new(4, 1)).unwrap();
    builder.block("block0", Cell::new(4, 2), "yellow", "chair").unwrap();
    builder.build(Moves::Push).unwrap()
}

fn agent(tasks: &[LiftedTask]) -> Agent<goodbot::memory::AgentHeap> {
    Agent::new(HeapMemory::new(&Capacities::STANDARD).agent, tasks, Options { weights: Weights::Belief, ..Options::DEFAULT }).unwrap()
}

/// Each group of a machine command: its sort of values, and the first value's token.
fn sorts(model: &[u8]) -> Vec<(u8, String)> {
    let contents = Contents::read(model).unwrap();
    let tokens: Vec<_> = contents.tokens.iter().collect();
    let mut sorts = Vec::new();
    for command in contents.commands.iter() {
        for pair in command.windows(2) {
            if let Some(Marker { sort, .. }) = Marker::of(Symbol::new(pair[0])) {
                sorts.push((sort, tokens[usize::from(pair[1])].to_owned()));
            }
        }
    }
    sorts
}

#[test]
fn facts_of_old_lessons_are_not_taken_for_values_of_an_attribute_that_was_added() {
    let (home, start) = rooms();
    let tasks = |schema: &Schema<'_>| ["agentInRoom(?a, ?r)", "blockInRoom(?o, ?r)"].map(|text| LiftedTask::parse(text, schema).unwrap());
    let of_colors = Schema { attributes: &home::SCHEMA.attributes[..1], ..home::SCHEMA };
    let home = home.with_derived(true);
    let old = Version { home: &home, schema: of_colors, meant: &[0, 1, 2, 3] };
    let mut learner = agent(&tasks(&of_colors));
    for command in ["go to the red room", "take the chair to the green room"] {
        learner.hear(&old, &start, command).unwrap();
        let _ = learner.finish(&old).unwrap();
        learner.learn_fully();
    }
    let model = learner.saved().unwrap();
    let is_fact = |token: &str| token.starts_with("is");
    assert!(sorts(&model).iter().any(|(sort, token)| *sort == 2 && is_fact(token)));
    // The next version tells shapes too, and a later one two attributes more: facts find no room beside four.
    let carriers = [Carrier::new(BLOCK, "made")];
    let third =
        [home::SCHEMA.attributes[0], home::SCHEMA.attributes[1], Attribute::new("made", &carriers), Attribute::new("use", &carriers)];
    for attributes in [home::SCHEMA.attributes, &third] {
        let schema = Schema { attributes, ..home::SCHEMA };
        let new = Version { home: &home, schema, meant: &[0, 1, 2, 3] };
        let mut robot = agent(&tasks(&schema));
        robot.hear(&new, &start, "go").unwrap();
        robot.restore_earlier(&new, &model).unwrap();
        robot.learn_fully();
        let restored = robot.saved().unwrap();
        for (sort, token) in sorts(&restored) {
            assert_eq!(usize::from(sort) == attributes.len() * 2, is_fact(&token), "{sort} {token}");
        }
        robot.hear(&new, &start, "go to the red room").unwrap();
    }
}
