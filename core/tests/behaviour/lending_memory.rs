//! The caller owns the tables and lends them: homes and agents come and go in the same memory, and every refusal gives its reason.

use crate::rooms::Memory;

use goodbot::capacity::Capacity;
use goodbot::feedback::Feedback;
use goodbot::home::{self, Area, Cell, Home, HomeBuilder, HomeState, Moves, Problem};
use goodbot::memory::{AgentArrays, AgentMemory, HomeMemory};
use goodbot::oomdp::{Action, Domain, apply};
use goodbot::planning::Progress;
use goodbot::session::Phase;
use goodbot::{Agent, AgentError, Capacities, Options};

fn rooms<M: HomeMemory>(memory: M, color: &str) -> (Home<M>, HomeState) {
    let mut builder = HomeBuilder::new(memory);
    builder.room("room0", Area::new(0, 0, 8, 4), color).unwrap();
    builder.room("room1", Area::new(0, 4, 8, 8), "green").unwrap();
    builder.door("door0", Area::new(2, 4, 2, 4)).unwrap();
    builder.agent("agent0", Cell::new(4, 2)).unwrap();
    builder.build(Moves::Push).unwrap()
}

fn agent<M: AgentMemory>(memory: M) -> Agent<M> {
    Agent::new(memory, &home::paper_tasks().unwrap(), Options::PAPER).unwrap()
}

#[test]
fn one_home_after_another_lives_in_the_same_memory() {
    let mut memory = Memory::new();
    let mut agent = agent(&mut memory.agent);
    for color in ["red", "blue"] {
        let (home, state) = rooms(&mut memory.home, color);
        agent.hear(&home, &state, "go to the green room").unwrap();
        assert_eq!(home.objects().value(goodbot::oomdp::ObjectId::new(0), home::COLOR), color);
    }
    let (home, _) = rooms(memory.home, "red");
    let (home, _) = rooms(home.into_memory(), "tan");
    assert_eq!(home.objects().value(goodbot::oomdp::ObjectId::new(0), home::COLOR), "tan");
}

#[test]
fn a_home_that_cannot_be_built_gives_its_memory_back() {
    let builder = HomeBuilder::new(Memory::new().home);
    let Err((_, memory)) = builder.try_build(Moves::Push) else { panic!("there is no agent") };
    rooms(memory, "red");
}

#[test]
fn an_agent_is_read_while_it_is_borrowed() {
    let mut memory = Memory::new();
    let (home, state) = rooms(&mut memory.home, "red");
    let mut agent = agent(memory.agent);
    agent.hear(&home, &state, "go to the green room").unwrap();
    let (words, belief) = (agent.language().words(), agent.belief());
    let text = words.iter().map(|(_, word)| word).collect::<Vec<_>>().join(" ");
    assert_eq!((text.as_str(), belief.tasks()), ("go to the green room", agent.tasks().len()));
}

#[test]
fn an_agent_is_shown_in_one_line() {
    let shown = format!("{:?}", agent(Memory::new().agent));
    assert!(!shown.contains('\n') && shown.len() < 600, "{shown}");
}

#[test]
fn a_memory_without_room_for_a_strategy_is_refused_by_name() {
    goodbot::memory! { struct Nobody = Capacities { strategies: 0, ..Capacities::SMALL }; }
    let error = Agent::new(Nobody::new().agent, &home::paper_tasks().unwrap(), Options::PAPER).unwrap_err();
    let AgentError::Capacity(error) = error else { panic!("{error}") };
    assert_eq!((error.capacity, error.limit, error.given), (Capacity::Strategies, 0, 1));
}

goodbot::memory! { struct Few = Capacities { sessions: 4, words: 14, ..Capacities::SMALL }; }

/// Hears and finishes in calls of this budget, with sessions that give way. Returns the number of calls, and the bits of the beliefs and
/// the training data.
fn in_parts(budget: u32) -> (usize, Vec<u32>) {
    let mut memory = Few::new();
    let (home, state) = rooms(&mut memory.home, "red");
    let mut agent: Agent<AgentArrays<Few>> = agent(memory.agent);
    let (mut calls, mut gave_way, mut bits) = (0, 0, Vec::new());
    for command in [
        "go to the green room",
        "please go to the green room now",
        "go to the green room",
        "walk over there",
        "roll on",
        "slip by",
        "go to the green room",
        "come along then",
    ] {
        agent.begin_hearing(&home, &state, command).unwrap();
        while agent.hear_on(&home, budget).unwrap() == Progress::Working {
            assert_eq!(agent.plan(&home, &state, 1), Err(AgentError::NotNow(Phase::Hearing)));
            calls += 1;
        }
        agent.plan_fully(&home, &state).unwrap();
        agent.acted(&home, &state, Action::new(0)).unwrap();
        let _ = agent.feedback(Feedback::Reward).unwrap();
        bits.extend((0..agent.tasks().len()).map(|task| agent.belief().probability(task).to_bits()));
        agent.begin_finishing(&home).unwrap();
        let finished = loop {
            if let Some(finished) = agent.finish_on(&home, budget).unwrap() {
                break finished;
            }
            assert_eq!(agent.plan(&home, &state, 1), Err(AgentError::NotNow(Phase::Finishing)));
            calls += 1;
        };
        gave_way += finished.gave_way.count();
        bits.extend(finished.gave_way.positions().iter().map(|&position| u32::from(position)));
        agent.learn_fully();
    }
    assert!(gave_way > 2, "{gave_way} sessions gave way");
    bits.extend(agent.language().bitext().pairs().iter().map(|pair| pair.weight.to_bits()));
    (calls, bits)
}

#[test]
fn hearing_and_finishing_in_parts_gives_the_same_bits_whatever_the_budget() {
    let (calls, whole) = in_parts(u32::MAX);
    assert_eq!(calls, 0);
    for budget in [1, 7, 20] {
        let (calls, bits) = in_parts(budget);
        assert!(calls > 1, "{calls} calls of budget {budget}");
        assert_eq!(bits, whole);
    }
}

#[test]
fn finishing_says_which_sessions_gave_way_and_usage_how_full_the_tables_are() {
    goodbot::memory! { struct Two = Capacities { sessions: 2, ..Capacities::SMALL }; }
    let mut memory = Two::new();
    let (home, state) = rooms(&mut memory.home, "red");
    let mut agent = agent(memory.agent);
    let mut gave_way = Vec::new();
    for _ in 0..3 {
        agent.hear(&home, &state, "go to the green room").unwrap();
        let gone = agent.finish(&home).unwrap().gave_way;
        gave_way.push((gone.positions().to_vec(), gone.full(), gone.to_string()));
        agent.learn_fully();
    }
    let full = "older sessions that gave way: 1, the last because Capacities::sessions is full; raise it to keep them";
    let none = || (vec![], None, "no session gave way".to_owned());
    assert_eq!(gave_way, [none(), none(), (vec![0], Some(Capacity::Sessions), full.to_owned())]);
    assert_eq!((agent.usage().sessions, agent.most_used().sessions, agent.capacities().sessions), (2, 2, 2));
    assert_eq!(agent.most_used().fits_in(&agent.capacities().at_least(agent.usage())), Ok(()));
}

#[test]
fn who_leaves_an_environment_has_no_task_of_it_any_more() {
    let mut memory = Memory::new();
    let (home, state) = rooms(&mut memory.home, "red");
    let mut agent = agent(memory.agent);
    agent.hear(&home, &state, "go to the green room").unwrap();
    agent.leave();
    assert!(agent.tasks().is_empty() && agent.most_likely().is_none());
    assert_eq!(agent.hear_again(&home, &state), Err(AgentError::NotNow(Phase::Idle)));
}

#[cfg(feature = "alloc")]
#[test]
fn too_few_tasks_are_told_how_many_a_command_may_mean() {
    let mut roomy = goodbot::HeapMemory::new(&Capacities::SMALL);
    let (home, state) = rooms(&mut roomy.home, "red");
    let mut able = agent(&mut roomy.agent);
    able.hear(&home, &state, "go to the green room").unwrap();
    let tasks = able.tasks().len();
    let mut small = goodbot::HeapMemory::new(&Capacities { tasks: 0, ..Capacities::SMALL });
    let refused = agent(&mut small.agent).hear(&home, &state, "go to the green room");
    assert_eq!(refused, Err(AgentError::Capacity(goodbot::capacity::CapacityError::new(Capacity::Tasks, 0, tasks))));
}

#[test]
fn a_home_that_is_built_in_parts_is_the_same_whatever_the_budget() {
    // The result of every step from every state identifies the home, together with its objects.
    fn steps(budget: Option<u32>) -> (usize, Vec<Option<u64>>) {
        let mut memory = Memory::new();
        let mut builder = HomeBuilder::new(&mut memory.home);
        let mut parts = 0;
        builder.room("room0", Area::new(0, 0, 8, 4), "red").unwrap();
        if budget.is_some() {
            // Adding an object restarts the search.
            while builder.find_cells(3).unwrap() == Progress::Working {}
        }
        builder.room("room1", Area::new(0, 4, 8, 8), "green").unwrap();
        builder.door("door0", Area::new(2, 4, 2, 4)).unwrap();
        builder.block("block0", Cell::new(6, 2), "blue", "chair").unwrap();
        builder.agent("agent0", Cell::new(4, 2)).unwrap();
        if let Some(budget) = budget {
            while builder.find_cells(budget).unwrap() == Progress::Working {
                parts += 1;
            }
        }
        let (home, _) = builder.build(Moves::Push).unwrap();
        let actions = [0, 1, 2, 3].map(Action::new);
        let step = |state: u64| actions.map(|action| apply(&home, &home.numbered(state), action).map(|next| home.number(&next)));
        (parts, (0..home.state_count()).flat_map(step).collect())
    }
    let (_, whole) = steps(None);
    assert!(whole.iter().flatten().count() > 4_000);
    for (budget, least) in [(0, 100), (1, 100), (7, 15), (u32::MAX, 0)] {
        let (parts, in_parts) = steps(Some(budget));
        assert_eq!(in_parts, whole);
        assert!(parts >= least, "{parts} parts of {budget}");
    }
    // Without a room there is no cell to find.
    assert_eq!(HomeBuilder::new(Memory::new().home).find_cells(1).unwrap_err().problem, Problem::NoRoom);
}
