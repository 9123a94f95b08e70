//! An update of a robot's program keeps its lessons, whatever its names were.

use goodbot::home::{self, Area, Cell, Home, HomeBuilder, HomeState, Moves};
use goodbot::memory::HomeHeap;
use goodbot::oomdp::{
    Action, ActionKind, Attribute, Carrier, Class, ClassId, Domain, GroundProposition, ObjectId, OneByOne, Proposition, PropositionId,
    Schema, World,
};
use goodbot::session::Weights;
use goodbot::snapshot::{Contents, RestoreError};
use goodbot::symbols::Symbol;
use goodbot::task::LiftedTask;
use goodbot::task::Marker;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_console::migration::{Migrated, Migration};

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

const ROBOT: ClassId = ClassId::new(0);
const ROOM: ClassId = ClassId::new(1);
const DOOR: ClassId = ClassId::new(2);
const BLOCK: ClassId = ClassId::new(3);
const CLASSES: &[Class<'static>] = &[Class::new("agent"), Class::new("room"), Class::new("door"), Class::new("block")];

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

/// Five lessons, each of the task of this kind and this room.
fn lessons(home: &Home<HomeHeap>, start: &HomeState) -> Vec<u8> {
    let mut agent = agent(&home::paper_tasks().unwrap());
    for (command, kind, room) in [
        ("go to the red room", 0, 2),
        ("go to the green room", 0, 1),
        ("take the chair to the red room", 1, 2),
        ("take the chair to the green room", 1, 1),
        ("go to the red room please", 0, 2),
    ] {
        agent.hear(home, start, command).unwrap();
        let name = |object| home.world().objects.name(object);
        let room = format!("room{room}");
        let meant = agent.tasks().iter().position(|task| task.lifted == kind && name(task.bindings[1]) == room).unwrap();
        agent
            .hear_with_prior(home, start, command, |task, _| f32::from(u8::from(task.lifted == kind && name(task.bindings[1]) == room)))
            .unwrap();
        assert!(agent.belief().probability(meant) > 0.9);
        let _ = agent.finish(home).unwrap();
        agent.learn_fully();
    }
    agent.saved().unwrap()
}

/// The probabilities of the kinds and rooms of a command.
fn heard<D: Domain>(domain: &D, start: &D::State, tasks: &[LiftedTask], model: &[u8], command: &str) -> Vec<((String, u8), f32)> {
    let mut agent = agent(tasks);
    agent.restore(model).unwrap();
    agent.learn_fully();
    agent.hear(domain, start, command).unwrap();
    let objects = domain.world().objects;
    let schema = domain.world().schema;
    let subject = |task: &goodbot::task::GroundedTask| schema.parameters(tasks[usize::from(task.lifted)].propositions()[0].proposition)[0];
    let mut all: Vec<_> = (0..agent.tasks().len())
        .map(|position| {
            let task = &agent.tasks()[position];
            ((objects.name(task.bindings[1]).to_owned(), subject(task).index() as u8), agent.belief().probability(position))
        })
        .collect();
    all.sort_by(|one, other| one.0.cmp(&other.0));
    all
}

#[test]
fn renamed_propositions_and_attributes_keep_their_lessons_to_the_bit() {
    let (home, start) = rooms();
    let model = lessons(&home, &start);
    let carriers: [&[Carrier<'static>]; 2] =
        [&[Carrier::new(ROOM, "roomIs"), Carrier::new(BLOCK, "blockIs")], &[Carrier::new(BLOCK, "shape")]];
    let attributes = [Attribute::new("paint", carriers[0]), Attribute::new("shape", carriers[1])];
    let propositions = [
        Proposition::new("robotThere", &[ROBOT, ROOM]),
        Proposition::new("blockInRoom", &[BLOCK, ROOM]),
        Proposition::new("agentInDoor", &[ROBOT, DOOR]),
        Proposition::new("blockInDoor", &[BLOCK, DOOR]),
    ];
    let schema = Schema { classes: CLASSES, attributes: &attributes, propositions: &propositions };
    let version = Version { home: &home, schema, meant: &[0, 1, 2, 3] };
    let before = home::paper_tasks().unwrap();
    let tasks = ["robotThere(?a, ?r)", "blockInRoom(?o, ?r)"].map(|text| LiftedTask::parse(text, &schema).unwrap());
    assert_eq!(agent(&tasks).restore(&model), Err(RestoreError::OtherDomain));
    let migration = Migration {
        from: home::SCHEMA,
        to: schema,
        kinds: [&before, &tasks],
        renamed: &[("agentInRoom", "robotThere"), ("color", "paint")],
    };
    let Migrated { model: new, lost, sessions } = migration.of(&model).unwrap();
    assert_eq!((lost, sessions), (vec![], vec![]));
    let tokens: Vec<_> = Contents::read(&new).unwrap().tokens.iter().collect();
    assert!(tokens.contains(&"robotThere") && tokens.contains(&"paintRed") && !tokens.contains(&"colorRed"), "{tokens:?}");
    for command in ["go to the red room", "take it to the green room", "go please"] {
        assert_eq!(heard(&version, &start, &tasks, &new, command), heard(&home, &start, &before, &model, command));
    }
    let back = Migration {
        from: schema,
        to: home::SCHEMA,
        kinds: [&tasks, &before],
        renamed: &[("robotThere", "agentInRoom"), ("paint", "color")],
    };
    assert_eq!(back.of(&new).unwrap().model, model);
}

#[test]
fn what_moved_is_understood_and_what_is_gone_is_named() {
    let (home, start) = rooms();
    let model = lessons(&home, &start);
    let propositions = [Proposition::new("near", &[ROBOT, BLOCK]), home::SCHEMA.propositions[1], home::SCHEMA.propositions[0]];
    let schema = Schema { propositions: &propositions, ..home::SCHEMA };
    // Nothing is near here.
    let version = Version { home: &home, schema, meant: &[3, 1, 0] };
    let before = home::paper_tasks().unwrap();
    let moved = ["agentInRoom(?a, ?r)", "blockInRoom(?o, ?r)"].map(|text| LiftedTask::parse(text, &schema).unwrap());
    let migration = Migration { from: home::SCHEMA, to: schema, kinds: [&before, &moved], renamed: &[] };
    let Migrated { model: new, lost, sessions } = migration.of(&model).unwrap();
    assert_eq!((lost, sessions), (vec!["agentInDoor".to_owned(), "blockInDoor".to_owned()], vec![]));
    for command in ["go to the red room", "take the chair to the green room"] {
        let (now, then) = (heard(&version, &start, &moved, &new, command), heard(&home, &start, &before, &model, command));
        for ((task, probability), (same, was)) in now.iter().zip(&then) {
            assert!(task == same && (probability - was).abs() < 1e-3, "{command}: {now:?}, {then:?}");
        }
    }
    // A robot that only drives has no use for two of the lessons.
    let drives = &moved[..1];
    let Migrated { lost, sessions, .. } = Migration { kinds: [&before, drives], ..migration }.of(&model).unwrap();
    assert_eq!((lost.last().map(String::as_str), sessions), (Some("blockInRoom"), vec![2, 3]));
    assert_eq!(Migration { from: schema, ..migration }.of(&model), Err(RestoreError::OtherDomain));
    assert_eq!(migration.of(&model[..model.len() - 1]).unwrap_err(), Contents::read(&model[..model.len() - 1]).unwrap_err());
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
        // As it is migrated on a host.
        let migration = Migration { from: of_colors, to: schema, kinds: [&tasks(&of_colors), &tasks(&schema)], renamed: &[] };
        assert_eq!(sorts(&migration.of(&model).unwrap().model), sorts(&restored));
        robot.hear(&new, &start, "go to the red room").unwrap();
    }
}
