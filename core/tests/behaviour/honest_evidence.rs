//! Valid evidence: only exact plans, for the state and the home that they were made for, judge an action.

use goodbot::capacity::{Capacity, CapacityError};
use goodbot::feedback::Feedback;
use goodbot::home::{self, Area, Cell, Home, HomeBuilder, HomeState, Moves};
use goodbot::memory::{AgentHeap, AgentMemory, HomeHeap, HomeMemory};
use goodbot::oomdp::{
    Action, ActionKind, Class, ClassId, Domain, DomainFlaw, GroundProposition, ObjectId, ObjectSet, Objects, OneByOne, Proposition,
    PropositionId, Schema, World, apply,
};
use goodbot::planning::{Judgement, OptimalSet, states_needed};
use goodbot::session::{Evidence, Phase};
use goodbot::task::LiftedTask;
use goodbot::{Agent, AgentError, Capacities, HeapMemory, Options};

/// Two rooms above one, with blocks in the lower.
fn rooms<M: HomeMemory>(memory: M, colors: [&str; 3], blocks: &[Cell]) -> (Home<M>, HomeState) {
    let mut builder = HomeBuilder::new(memory);
    builder.room("room0", Area::new(0, 0, 8, 4), colors[0]).unwrap();
    builder.room("room1", Area::new(0, 4, 4, 8), colors[1]).unwrap();
    builder.room("room2", Area::new(4, 4, 8, 8), colors[2]).unwrap();
    builder.door("door0", Area::new(2, 4, 2, 4)).unwrap();
    builder.door("door1", Area::new(6, 4, 6, 4)).unwrap();
    builder.agent("agent0", Cell::new(4, 1)).unwrap();
    for (position, &cell) in blocks.iter().enumerate() {
        builder.block(&format!("block{position}"), cell, "yellow", "chair").unwrap();
    }
    builder.build(Moves::Push).unwrap()
}

const COLORS: [&str; 3] = ["blue", "green", "red"];

fn memory(states: usize, hashed_states: usize) -> HeapMemory {
    HeapMemory::new(&Capacities { states, hashed_states, ..Capacities::SMALL })
}

fn agent(states: usize, hashed_states: usize) -> Agent<AgentHeap> {
    Agent::new(memory(states, hashed_states).agent, &home::paper_tasks().unwrap(), Options::PAPER).unwrap()
}

/// The position of the task that brings `subject` to `room`.
fn task(agent: &Agent<impl AgentMemory>, home: &Home<impl HomeMemory>, subject: &str, room: &str) -> usize {
    let name = |object| home.world().objects.name(object);
    agent.tasks().iter().position(|task| name(task.bindings[0]) == subject && name(task.bindings[1]) == room).unwrap()
}

fn probabilities(agent: &Agent<impl AgentMemory>) -> Vec<f32> {
    (0..agent.tasks().len()).map(|task| agent.belief().probability(task)).collect()
}

#[test]
fn an_approximate_plan_is_acted_on_and_is_no_evidence() {
    // Memory for the agent alone, not for bounds on the places of the block.
    let (home, start) = rooms(HomeHeap::new(&Capacities::SMALL), COLORS, &[Cell::new(4, 2)]);
    let mut agent = agent(64, 0);
    agent.hear(&home, &start, "go").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    let decision = agent.decide(&home, &start).unwrap();
    let OptimalSet::Approximate(actions) = decision.plan else { panic!("{decision:?}") };
    assert!(actions.contains(decision.action) && decision.action != Action::NOOP);
    assert!((0..4).all(|task| agent.planned().judge(task, decision.action) == Judgement::Unknown));
    let before = probabilities(&agent);
    agent.acted(&home, &start, decision.action).unwrap();
    assert_eq!(agent.feedback(Feedback::Punish), Ok(Evidence::Uninformative));
    assert_eq!(probabilities(&agent), before);
}

#[test]
fn near_goals_are_found_exactly_before_anything_is_approximated() {
    let (home, start) = rooms(HomeHeap::new(&Capacities::SMALL), COLORS, &[Cell::new(4, 2)]);
    // One step from the door of the red room.
    let state = home.placed(&start, &[(home.agent(), Cell::new(6, 3))]).unwrap();
    let mut agent = agent(320, 400);
    agent.hear(&home, &state, "go").unwrap();
    agent.plan_fully(&home, &state).unwrap();
    let near = task(&agent, &home, "agent0", "room2");
    assert_eq!(agent.planned().optimal(near).exact().map(|actions| actions.iter().collect()), Some(vec![Action::new(0)]));
    assert_eq!(agent.planned().distance(near), Some(2));
    // The block's goal is too far for so little memory.
    assert!(!agent.planned().unknown().union(agent.planned().approximate()).is_empty());
}

#[test]
fn a_dead_end_stays_one_until_somebody_else_moves_things() {
    let (home, start) = rooms(HomeHeap::new(&Capacities::SMALL), COLORS, &[Cell::new(1, 1)]);
    let mut agent = agent(2_560, 0);
    agent.hear(&home, &start, "take the chair to the red room").unwrap();
    let stuck = task(&agent, &home, "block0", "room2");
    agent.plan_fully(&home, &start).unwrap();
    assert!(matches!(agent.planned().optimal(stuck), OptimalSet::DeadEnd(_)));
    let next = agent.acted(&home, &start, Action::new(2)).unwrap();
    agent.plan_fully(&home, &next).unwrap();
    assert!(matches!(agent.planned().optimal(stuck), OptimalSet::DeadEnd(_)), "nothing has moved the block");
    // Somebody carries it out of its corner.
    let carried = home.placed(&next, &[(home.blocks()[0], Cell::new(4, 2))]).unwrap();
    agent.plan_fully(&home, &carried).unwrap();
    assert!(matches!(agent.planned().optimal(stuck), OptimalSet::Toward(_)), "{:?}", agent.planned().optimal(stuck));
}

#[test]
fn a_plan_serves_no_other_state_and_a_session_no_other_home() {
    let (mut one, mut other) = (memory(0, 0), memory(0, 0));
    let (home, start) = rooms(&mut one.home, COLORS, &[]);
    let (painted, same_number) = rooms(&mut other.home, ["blue", "red", "green"], &[]);
    assert_eq!(home.number(&start), painted.number(&same_number));
    let mut agent = agent(2_560, 0);
    agent.hear(&home, &start, "go to the red room").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    let next = apply(&home, &start, Action::new(2)).unwrap();
    assert_eq!(agent.decide(&home, &next), Err(AgentError::NotPlanned));
    assert_eq!(agent.acted(&home, &next, Action::new(2)), Err(AgentError::NotPlanned));
    assert_eq!(agent.decide(&painted, &same_number), Err(AgentError::OtherDomain));
    assert_eq!(agent.plan(&painted, &same_number, 10), Err(AgentError::OtherDomain));
    assert_eq!(agent.hear_again(&painted, &same_number), Err(AgentError::NotNow(Phase::Idle)));
    assert_eq!(agent.finish(&painted), Err(AgentError::OtherDomain));
    assert!(agent.decide(&home, &start).is_ok());
}

#[test]
fn a_session_serves_no_home_of_the_same_objects_in_other_places() {
    let (mut one, mut other) = (memory(0, 0), memory(0, 0));
    let (home, start) = rooms(&mut one.home, COLORS, &[]);
    // The same home, but the two upper rooms have changed places.
    let mut builder = HomeBuilder::new(&mut other.home);
    builder.room("room0", Area::new(0, 0, 8, 4), COLORS[0]).unwrap();
    builder.room("room1", Area::new(4, 4, 8, 8), COLORS[1]).unwrap();
    builder.room("room2", Area::new(0, 4, 4, 8), COLORS[2]).unwrap();
    builder.door("door0", Area::new(2, 4, 2, 4)).unwrap();
    builder.door("door1", Area::new(6, 4, 6, 4)).unwrap();
    builder.agent("agent0", Cell::new(4, 1)).unwrap();
    let (mirrored, same_number) = builder.build(Moves::Push).unwrap();
    assert_eq!((home.number(&start), home.state_count()), (mirrored.number(&same_number), mirrored.state_count()));
    let mut agent = agent(2_560, 0);
    agent.hear(&home, &start, "go to the red room").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    assert_eq!(agent.decide(&mirrored, &same_number), Err(AgentError::OtherDomain));
    assert_eq!(agent.plan(&mirrored, &same_number, 10), Err(AgentError::OtherDomain));
    assert!(agent.decide(&home, &start).is_ok());
}

#[test]
fn a_word_about_the_last_action_counts_also_while_the_next_plan_is_made() {
    let (home, start) = rooms(HomeHeap::new(&Capacities::SMALL), COLORS, &[Cell::new(4, 2)]);
    let (mut at_once, mut later) = (agent(2_560, 0), agent(2_560, 0));
    for agent in [&mut at_once, &mut later] {
        agent.hear(&home, &start, "go to the red room").unwrap();
        agent.plan_fully(&home, &start).unwrap();
    }
    let next = at_once.acted(&home, &start, Action::new(2)).unwrap();
    assert_eq!(at_once.feedback(Feedback::Reward), Ok(Evidence::Used));
    assert_eq!(later.acted(&home, &start, Action::new(2)), Ok(next));
    let _ = later.plan(&home, &next, 1).unwrap();
    assert_eq!(later.feedback(Feedback::Reward), Ok(Evidence::Used));
    assert_eq!(probabilities(&later), probabilities(&at_once));
    later.plan_fully(&home, &next).unwrap();
    assert_eq!(later.feedback(Feedback::Reward), Ok(Evidence::Used));
    assert_eq!(probabilities(&later), probabilities(&at_once));
}

#[test]
fn of_several_words_about_one_action_the_last_counts_until_the_next_action() {
    let (home, start) = rooms(HomeHeap::new(&Capacities::SMALL), COLORS, &[]);
    let (mut hasty, mut calm) = (agent(2_560, 0), agent(2_560, 0));
    for (agent, words) in [(&mut hasty, &[Feedback::Punish, Feedback::Reward, Feedback::Reward][..]), (&mut calm, &[Feedback::Reward])] {
        agent.hear(&home, &start, "go to the red room").unwrap();
        agent.plan_fully(&home, &start).unwrap();
        assert_eq!(agent.feedback(Feedback::Reward), Err(AgentError::NothingDone));
        let next = agent.acted(&home, &start, Action::new(2)).unwrap();
        for &word in words {
            assert_eq!(agent.feedback(word), Ok(Evidence::Used));
        }
        agent.plan_fully(&home, &next).unwrap();
        agent.acted(&home, &next, Action::new(2)).unwrap();
        assert_eq!(agent.feedback(Feedback::Reward), Ok(Evidence::Used));
    }
    assert_eq!(probabilities(&hasty), probabilities(&calm));
    let red = task(&calm, &home, "agent0", "room2");
    assert!((calm.belief().probability(red) - 81.0 / 82.0).abs() < 1e-5, "two rewards: {:?}", probabilities(&calm));
}

#[test]
fn equal_propositions_compare_equal_and_unused_arguments_are_object_0() {
    let (home, start) = rooms(HomeHeap::new(&Capacities::SMALL), COLORS, &[Cell::new(4, 2)]);
    let lifted = LiftedTask::parse("blockInRoom(?o, ?r)", &home::SCHEMA).unwrap();
    let mut tasks = [goodbot::task::GroundedTask::UNUSED; 4];
    let count = goodbot::task::ground(&home, std::slice::from_ref(&lifted), &start, &mut tasks).unwrap();
    for task in &tasks[..count] {
        let part = task.propositions(&lifted).next().unwrap();
        assert_eq!(part.arguments[2], ObjectId::new(0));
        assert_eq!(part, GroundProposition::new(home::BLOCK_IN_ROOM, &task.bindings[..2]));
    }
}

#[test]
fn two_things_that_have_swapped_places_are_placed_at_once() {
    let (home, start) = rooms(HomeHeap::new(&Capacities::SMALL), COLORS, &[Cell::new(4, 2), Cell::new(2, 2)]);
    let [first, second] = [home.blocks()[0], home.blocks()[1]];
    assert_eq!(home.placed(&start, &[(first, Cell::new(2, 2))]), None, "the other is there");
    let swapped = home.placed(&start, &[(first, Cell::new(2, 2)), (second, Cell::new(4, 2))]).unwrap();
    assert_eq!([first, second].map(|block| home.block_cell(&swapped, block)), [Some(Cell::new(2, 2)), Some(Cell::new(4, 2))]);
}

/// A robot in a ring of many places; the second action costs 2.
struct Ring<'m> {
    objects: Objects<'m>,
    places: u64,
    /// The number of places that `state_count` returns.
    counted: u64,
}

const RING: Schema<'static> =
    Schema { classes: &[Class::new("place")], attributes: &[], propositions: &[Proposition::new("robotAt", &[ClassId::new(0)])] };

impl<'m> Ring<'m> {
    fn of(memory: &'m mut HeapMemory, places: u64, counted: u64) -> Self {
        let mut objects = ObjectSet::new(memory.home.lend().objects);
        objects.add(ClassId::new(0), "goal", &[]).unwrap();
        Self { objects: objects.into_objects(), places, counted }
    }
}

impl Domain for Ring<'_> {
    type State = u64;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        World { schema: RING, objects: self.objects }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        const { &[ActionKind::new("on", 1), ActionKind::new("back", 2)] }
    }

    fn step(&self, state: &u64, action: Action) -> Option<u64> {
        match action.index() {
            0 => Some((state + 1) % self.places),
            1 => Some((state + self.places - 1) % self.places),
            _ => None,
        }
    }

    fn holds(&self, _proposition: &GroundProposition, state: &u64) -> bool {
        *state == self.places / 2
    }

    fn state_count(&self) -> u64 {
        self.counted
    }

    fn number(&self, state: &u64) -> u64 {
        *state
    }

    fn numbered(&self, number: u64) -> u64 {
        number
    }
}

fn on_ring(states: usize, hashed_states: usize) -> Agent<AgentHeap> {
    let tasks = [LiftedTask::single(PropositionId::new(0), &RING).unwrap()];
    Agent::new(memory(states, hashed_states).agent, &tasks, Options::PAPER).unwrap()
}

#[test]
fn a_robot_whose_states_do_not_fit_is_refused_by_name_and_number() {
    let mut ring_memory = memory(0, 0);
    let ring = Ring::of(&mut ring_memory, 15_000, 15_000);
    let needed = states_needed(&ring).unwrap();
    assert!(needed > 16_384, "an action that costs 2 takes more room: {needed}");
    for (states, hashed, fits) in [(15_000, 0, false), (16_384 - 64, 0, false), (needed - 64, 0, false), (needed, 0, true), (640, 64, true)]
    {
        let mut agent = on_ring(states, hashed);
        let heard = agent.hear(&ring, &0, "go");
        if fits {
            assert_eq!(heard, Ok(()));
            agent.plan_fully(&ring, &0).unwrap();
            assert_eq!(agent.planned().distance(0), (hashed == 0).then_some(7_500));
        } else {
            let limit = states.next_multiple_of(64);
            assert_eq!(heard, Err(CapacityError::new(Capacity::States, limit, needed).into()));
        }
    }
}

#[test]
fn a_robot_of_more_states_than_any_memory_is_refused_at_once() {
    let mut ring_memory = memory(0, 0);
    let ring = Ring::of(&mut ring_memory, 1 << 52, 1 << 52);
    assert!(states_needed(&ring).unwrap() > 1 << 52);
}

#[test]
fn a_state_whose_number_is_not_below_the_count_is_refused() {
    let mut ring_memory = memory(0, 0);
    let ring = Ring::of(&mut ring_memory, 40, 40);
    let mut agent = on_ring(128, 0);
    assert_eq!(agent.hear(&ring, &40, "go"), Err(AgentError::StateNumber));
    assert_eq!(agent.hear(&ring, &39, "go"), Ok(()));
    assert_eq!(agent.plan(&ring, &40, 50), Err(AgentError::StateNumber));
    assert_eq!(agent.plan_fully(&ring, &39), Ok(()));
}

#[test]
fn an_action_that_leads_to_no_counted_state_is_named_by_the_plan() {
    let mut ring_memory = memory(0, 0);
    let ring = Ring::of(&mut ring_memory, 40, 30);
    let mut agent = on_ring(128, 0);
    agent.hear(&ring, &25, "go").unwrap();
    let flaw = DomainFlaw::Number { number: 30, count: 30, from: Some((29, Action::new(0))) };
    assert_eq!(agent.plan_fully(&ring, &25), Err(flaw.into()));
    assert!(flaw.to_string().starts_with("a state has the number 30, and state_count is 30 (action 0 leads to it from state 29); "));
}

#[test]
fn tasks_of_another_robot_are_refused() {
    let mut ring_memory = memory(0, 0);
    let ring = Ring::of(&mut ring_memory, 40, 40);
    let mut agent = agent(128, 0);
    assert_eq!(agent.hear(&ring, &0, "go"), Err(AgentError::OtherVocabulary));
}

#[test]
fn states_that_cannot_be_counted_ask_for_a_hash_table() {
    let mut ring_memory = memory(0, 0);
    let ring = Ring::of(&mut ring_memory, u64::MAX, u64::MAX);
    let mut agent = on_ring(640, 0);
    let refused = agent.hear(&ring, &0, "go").unwrap_err();
    assert_eq!(refused.to_string(), "no room: Capacities::hashed_states is 0, and 1 or more were given; raise it");
}

#[test]
fn what_is_fixed_is_not_to_be_raised() {
    let long = CapacityError::new(Capacity::NameBytes, 48, 69);
    assert_eq!(
        long.to_string(),
        "no room: capacity::NAME_BYTES is 48, and 69 or more were given; it is fixed: give fewer, or shorter ones"
    );
}
