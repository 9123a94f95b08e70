//! Algorithm 1 step by step: hearing, deciding, believing and learning, and the refusals.

use crate::rooms::{self, Memory, robot};
use goodbot::capacity::{Capacity, CapacityError};
use goodbot::feedback::{BeliefError, Feedback, Strategy};
use goodbot::home::{self, Cell, Home, HomeState, Moves};
use goodbot::memory::{AgentArrays, AgentMemory, HomeArrays, HomeMemory};
use goodbot::oomdp::{Action, Domain, apply};
use goodbot::planning::{OptimalSet, Progress};
use goodbot::session::{Evidence, Phase};
use goodbot::{Agent, AgentError, Capacities, Options};
use rand_pcg::Pcg32;

fn begun(block: Option<Cell>) -> (Home<HomeArrays<Memory>>, HomeState, Agent<AgentArrays<Memory>>) {
    robot(Memory::new().agent, block, Options::PAPER)
}

/// The agent does an action, and the trainer gives feedback. Returns the state that the action leads to.
fn told(
    agent: &mut Agent<impl AgentMemory>,
    home: &Home<impl HomeMemory>,
    state: &HomeState,
    action: Action,
    feedback: Feedback,
) -> HomeState {
    let next = agent.acted(home, state, action).unwrap();
    assert_eq!(agent.feedback(feedback), Ok(Evidence::Used));
    next
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
fn before_any_learning_every_task_of_a_kind_is_as_likely_as_the_other() {
    let (home, start, mut agent) = begun(Some(Cell::new(4, 2)));
    agent.hear(&home, &start, "take the chair to the red room").unwrap();
    assert_eq!(probabilities(&agent), [0.25; 4]);
}

#[test]
fn reward_and_punishment_tell_the_intended_task() {
    let (home, mut state, mut agent) = begun(None);
    agent.hear(&home, &state, "go to the red room").unwrap();
    let red = task(&agent, &home, "agent0", "room2");
    agent.plan_fully(&home, &state).unwrap();
    state = told(&mut agent, &home, &state, Action::new(2), Feedback::Reward);
    // East is right for the red room alone: 0.27 against 0.03.
    assert!((agent.belief().probability(red) - 0.9).abs() < 1e-6);
    agent.plan_fully(&home, &state).unwrap();
    let decision = agent.decide(&home, &state).unwrap();
    assert_eq!(decision.task, red);
}

#[test]
fn silence_says_nothing_where_right_and_wrong_actions_are_met_with_it_equally() {
    let (home, start, mut agent) = begun(Some(Cell::new(4, 2)));
    agent.hear(&home, &start, "go").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    let _ = told(&mut agent, &home, &start, Action::new(0), Feedback::Neutral);
    assert_eq!(probabilities(&agent), [0.25; 4]);
}

#[test]
fn planning_and_learning_in_small_parts_give_the_same_as_in_one_go() {
    let run = |parts: bool| {
        let (home, mut state, mut agent) = begun(Some(Cell::new(4, 2)));
        let mut trace = vec![];
        for command in ["take the chair to the red room", "go to the green room"] {
            agent.hear(&home, &state, command).unwrap();
            for _ in 0..12 {
                if parts {
                    while agent.plan(&home, &state, 3).unwrap() == Progress::Working {}
                } else {
                    agent.plan_fully(&home, &state).unwrap();
                }
                let decision = agent.decide(&home, &state).unwrap();
                let feedback = if trace.len() % 3 == 0 { Feedback::Punish } else { Feedback::Reward };
                state = told(&mut agent, &home, &state, decision.action, feedback);
                trace.push(probabilities(&agent));
            }
            let _ = agent.finish(&home).unwrap();
            if parts {
                while agent.learn(1) == Progress::Working {}
            } else {
                agent.learn_fully();
            }
        }
        trace
    };
    assert_eq!(run(true), run(false));
}

#[cfg(feature = "alloc")]
#[test]
fn a_plan_with_frozen_pieces_is_the_same_whatever_the_budget() {
    let capacities = Capacities { states: 2_000, hashed_states: 0, ..Capacities::SMALL };
    let plans = |budget: u32| {
        let (mut memory, mut rooms_memory) = (goodbot::HeapMemory::new(&capacities), Memory::new());
        let mut builder = rooms::begun(&mut rooms_memory.home);
        builder.block("block0", Cell::new(4, 2), "yellow", "chair").unwrap();
        builder.block("block1", Cell::new(6, 2), "pink", "bag").unwrap();
        let (home, start) = builder.build(Moves::Push).unwrap();
        let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), Options::PAPER).unwrap();
        agent.hear(&home, &start, "take the chair to the red room").unwrap();
        let mut calls = 1;
        while agent.plan(&home, &start, budget).unwrap() == Progress::Working {
            calls += 1;
        }
        let plan = agent.planned();
        let all: Vec<_> = (0..agent.tasks().len()).map(|task| (plan.optimal(task), plan.distance(task))).collect();
        (calls, all)
    };
    let (calls, whole) = plans(u32::MAX);
    assert!(whole.iter().any(|(set, _)| matches!(set, OptimalSet::Approximate(_))), "{whole:?}");
    assert_eq!(calls, 1);
    for budget in [1, 8, 50] {
        let (calls, parts) = plans(budget);
        assert!(calls > 10, "{calls} calls of budget {budget}");
        assert_eq!(parts, whole);
    }
}

#[test]
fn a_block_in_a_corner_is_a_dead_end_and_stays_one() {
    let (home, start, mut agent) = begun(Some(Cell::new(1, 1)));
    agent.hear(&home, &start, "take the chair to the red room").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    let stuck = task(&agent, &home, "block0", "room2");
    let OptimalSet::DeadEnd(actions) = agent.planned().optimal(stuck) else { panic!("the corner holds it") };
    assert_eq!(actions.len(), 5, "four moves and doing nothing are equally good");
    assert_eq!(agent.planned().distance(stuck), None);
}

#[cfg(feature = "alloc")]
#[test]
fn a_search_that_finds_no_room_says_that_it_does_not_know_and_takes_no_evidence() {
    let capacities = Capacities { states: 0, ..Capacities::SMALL };
    let mut memory = goodbot::HeapMemory::new(&capacities);
    let (home, start, mut agent) = robot(&mut memory.agent, Some(Cell::new(4, 2)), Options::PAPER);
    agent.hear(&home, &start, "go").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    assert!((0..4).all(|task| agent.planned().optimal(task) == OptimalSet::Unknown));
    assert_eq!(agent.decide(&home, &start).unwrap().action, Action::NOOP);
    agent.acted(&home, &start, Action::new(0)).unwrap();
    assert_eq!(agent.feedback(Feedback::Reward), Ok(Evidence::Uninformative));
    assert_eq!(probabilities(&agent), [0.25; 4]);
}

#[cfg(feature = "alloc")]
#[test]
fn a_home_too_large_for_the_memory_is_planned_for_as_far_as_it_goes_and_says_so() {
    let capacities = Capacities { states: 320, ..Capacities::SMALL };
    let (home, start, mut exact) = begun(Some(Cell::new(4, 2)));
    let mut memory = goodbot::HeapMemory::new(&capacities);
    let (_, _, mut bounded) = robot(&mut memory.agent, None, Options::PAPER);
    bounded.hear(&home, &start, "go").unwrap();
    bounded.plan_fully(&home, &start).unwrap();
    exact.hear(&home, &start, "go").unwrap();
    exact.plan_fully(&home, &start).unwrap();
    let (bounded, exact) = (bounded.planned(), exact.planned());
    assert!(exact.approximate().is_empty() && exact.unknown().is_empty());
    for task in 0..4 {
        // The agent's plan is exact, or made for a block that stands still; the block's goal is out of reach here.
        match bounded.optimal(task) {
            OptimalSet::Unknown => assert!(bounded.unknown().contains(task)),
            OptimalSet::Approximate(_) => {
                assert!(bounded.approximate().contains(task));
                assert!(bounded.distance(task) >= exact.distance(task), "with less allowed, no way is shorter");
            }
            known => assert_eq!((known, bounded.distance(task)), (exact.optimal(task), exact.distance(task))),
        }
    }
    assert!(!bounded.unknown().is_empty() && bounded.unknown().iter().count() < 4);
}

#[test]
fn several_strategies_are_told_apart_by_how_the_trainer_speaks() {
    let (home, start, mut agent) = begun(None);
    agent.set_strategies(&[(Strategy::REWARD_ONLY, 0.5), (Strategy::PUNISH_ONLY, 0.5)]).unwrap();
    agent.hear(&home, &start, "go").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    for _ in 0..4 {
        let _ = told(&mut agent, &home, &start, Action::new(0), Feedback::Reward);
    }
    assert!(agent.belief().strategy_probability(0) > 0.9);
    // A new command starts with the present belief about the trainer.
    agent.hear(&home, &start, "go").unwrap();
    assert!(agent.belief().strategy_probability(0) > 0.9);
    assert_eq!(probabilities(&agent), [0.5; 2]);
}

#[test]
fn feedback_that_nobody_could_give_is_ignored() {
    let (home, start, mut agent) = begun(None);
    agent.set_strategies(&[(Strategy::new(0.0, 0.0, 0.1).unwrap(), 1.0)]).unwrap();
    agent.hear(&home, &start, "go").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    agent.acted(&home, &start, Action::new(2)).unwrap();
    assert_eq!(agent.feedback(Feedback::Neutral), Ok(Evidence::Impossible));
    assert_eq!(probabilities(&agent), [0.5; 2]);
}

#[test]
fn what_is_out_of_order_is_refused() {
    let (home, start, mut agent) = begun(None);
    assert_eq!(agent.plan(&home, &start, 1), Err(AgentError::NotNow(Phase::Idle)));
    assert_eq!(agent.finish(&home), Err(AgentError::NotNow(Phase::Idle)));
    assert_eq!(agent.hear(&home, &start, " , . "), Err(AgentError::EmptyCommand));
    agent.hear(&home, &start, "go").unwrap();
    assert_eq!(agent.decide(&home, &start), Err(AgentError::NotPlanned));
    assert_eq!(agent.acted(&home, &start, Action::new(0)), Err(AgentError::NotPlanned));
    agent.plan_fully(&home, &start).unwrap();
    assert_eq!(agent.feedback(Feedback::Reward), Err(AgentError::NothingDone));
    assert_eq!(agent.acted(&home, &start, Action::new(4)), Err(AgentError::NotApplicable));
    assert_eq!(agent.acted(&home, &start, Action::new(200)), Err(AgentError::NotApplicable));
    let _ = agent.finish(&home).unwrap();
    assert_eq!(agent.hear(&home, &start, "go"), Err(AgentError::NotNow(Phase::Learning)));
    agent.learn_fully();
    assert_eq!(agent.hear(&home, &start, "go"), Ok(()));
}

#[test]
fn a_strategy_or_prior_that_is_no_probability_is_refused() {
    let (home, start, mut agent) = begun(None);
    for mu in [f32::NAN, -0.1, 1.1, f32::INFINITY] {
        assert!(Strategy::new(mu, 0.5, 0.1).is_err());
        assert!(Strategy::new(0.5, mu, 0.1).is_err());
        assert!(Strategy::new(0.5, 0.5, mu).is_err());
        let error = agent.set_strategies(&[(Strategy::BALANCED, 0.5), (Strategy::BALANCED, mu)]).unwrap_err();
        let AgentError::Strategy(BeliefError::Prior { strategy: 1, value }) = error else { panic!("{error}") };
        assert_eq!(value.to_bits(), mu.to_bits());
    }
    assert_eq!(agent.set_strategies(&[]), Err(AgentError::Strategy(BeliefError::NoPrior)));
    for prior in [f32::NAN, -1.0, f32::INFINITY] {
        let error = agent.hear_with_prior(&home, &start, "go", |_, _| prior).unwrap_err();
        assert!(matches!(error, AgentError::Prior { task: 0, value } if value.to_bits() == prior.to_bits()));
    }
    assert_eq!(agent.hear_with_prior(&home, &start, "go", |_, _| 0.0), Err(AgentError::NoPrior));
    let too_many = [(Strategy::BALANCED, 0.1); 9];
    assert!(matches!(agent.set_strategies(&too_many), Err(AgentError::Capacity(CapacityError { capacity: Capacity::Strategies, .. }))));
}

#[test]
fn a_command_too_long_is_refused_and_what_was_learned_stays() {
    let (home, start, mut agent) = begun(None);
    let teach = |agent: &mut Agent<AgentArrays<Memory>>| {
        agent.hear(&home, &start, "go to the red room").unwrap();
        agent.plan_fully(&home, &start).unwrap();
        let _ = told(agent, &home, &start, Action::new(2), Feedback::Reward);
        let _ = agent.finish(&home).unwrap();
        agent.learn_fully();
    };
    teach(&mut agent);
    agent.hear(&home, &start, "go to the red room").unwrap();
    let before = probabilities(&agent);
    let long = "go ".repeat(10_000);
    assert!(matches!(
        agent.hear(&home, &start, &long),
        Err(AgentError::Capacity(CapacityError { capacity: Capacity::WordsPerCommand, limit: 64, given: 10_000 }))
    ));
    agent.hear(&home, &start, "go to the red room").unwrap();
    assert_eq!(probabilities(&agent), before);
}

#[test]
fn the_same_seed_decides_the_same() {
    let run = |seed| {
        let (home, mut state, mut agent) = begun(Some(Cell::new(4, 2)));
        let mut random = Pcg32::new(seed, 1);
        agent.hear(&home, &state, "go").unwrap();
        let mut actions = vec![];
        for _ in 0..10 {
            agent.plan_fully(&home, &state).unwrap();
            let decision = agent.decide_with(&home, &state, &mut random).unwrap();
            actions.push((decision.task, decision.action));
            state = apply(&home, &state, decision.action).unwrap();
        }
        actions
    };
    assert_eq!(run(7), run(7));
    assert!((0..20).any(|seed| run(seed) != run(7)));
}

#[test]
fn a_forgotten_session_can_be_taken_up_again_and_learned_from() {
    let (home, start, mut agent) = begun(None);
    agent.hear(&home, &start, "go to the red room").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    let _ = told(&mut agent, &home, &start, Action::new(2), Feedback::Reward);
    let before = probabilities(&agent);
    agent.forget();
    agent.hear_again(&home, &start).unwrap();
    assert_eq!(probabilities(&agent), before, "the belief goes on");
    let _ = agent.finish(&home).unwrap();
    agent.learn_fully();
    assert_eq!(agent.language().tables().words(), 5);
    let words: Vec<String> = agent.language().words().iter().map(|(_, word)| word.to_owned()).collect();
    assert_eq!(words, ["go", "to", "the", "red", "room"]);
}

#[test]
fn a_forgotten_session_changes_nothing_that_was_learned() {
    let (home, start, mut agent) = begun(None);
    agent.hear(&home, &start, "fly to the moon").unwrap();
    agent.forget();
    agent.hear(&home, &start, "go").unwrap();
    assert_eq!(agent.language().words().len(), 1);
    assert_eq!(agent.language().bitext().sessions(), 0);
}
