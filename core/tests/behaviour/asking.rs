//! Questions: when they are asked, the effect of an answer, and refusals. Late words and the end of a session as evidence.

use crate::rooms;

use goodbot::asking::{Answer, Asking, Considered, Subject};
use goodbot::feedback::{Ending, Feedback, Hazard, Judged, LAGS, Strategy, population};
use goodbot::home::{self, Cell, Home, HomeState};
use goodbot::memory::{AgentHeap, AgentMemory, HomeHeap};
use goodbot::oomdp::Action;
use goodbot::session::{Evidence, Phase};
use goodbot::task::TaskSet;
use goodbot::{Agent, AgentError, Capacities, HeapMemory, Options};
use rooms::rooms;

fn memory() -> HeapMemory {
    HeapMemory::new(&Capacities { strategies: 16, beliefs: 192, ..Capacities::SMALL })
}

fn heard(memory: &mut HeapMemory, options: Options) -> (Agent<&mut AgentHeap>, Home<&mut HomeHeap>, HomeState) {
    let (home, start) = rooms(&mut memory.home, Some(Cell::new(4, 2)));
    let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), options).unwrap();
    agent.hear(&home, &start, "go").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    (agent, home, start)
}

fn probabilities(agent: &Agent<impl AgentMemory>) -> Vec<f32> {
    (0..agent.tasks().len()).map(|task| agent.belief().probability(task)).collect()
}

const CHEAP: Asking = Asking { kappa: 1.0, ..Asking::DEFAULT };

#[test]
fn a_robot_that_knows_no_word_asks_and_understands_within_a_few_answers() {
    let mut memory = memory();
    let (mut agent, home, start) = heard(&mut memory, Options::DEFAULT);
    for intended in 0..agent.tasks().len() {
        agent.hear(&home, &start, "go").unwrap();
        agent.plan_fully(&home, &start).unwrap();
        let mut asked: Vec<TaskSet> = vec![];
        while let Some(question) = agent.question(&home, &start, &CHEAP).unwrap() {
            assert!(!asked.contains(&question.yes), "never the same question twice");
            asked.push(question.yes);
            let answer = match question.subject.choices() {
                0 if question.yes.contains(intended) => Answer::Yes,
                0 => Answer::No,
                count => {
                    let chosen = (0..count).find(|&choice| question.choices[usize::from(choice)].contains(intended));
                    chosen.map_or(Answer::No, Answer::This)
                }
            };
            assert_eq!(agent.answer(answer), Ok(Evidence::Used));
        }
        assert!(agent.belief().probability(intended) >= CHEAP.sure, "{:?}", probabilities(&agent));
        assert!(asked.len() <= 4, "{asked:?}");
    }
}

#[test]
fn it_never_asks_where_a_question_costs_everything_and_where_it_is_sure() {
    let mut memory = memory();
    let (mut agent, home, start) = heard(&mut memory, Options::DEFAULT);
    assert_eq!(agent.question(&home, &start, &Asking::NEVER), Ok(None));
    let sure = Asking { sure: 0.1, ..CHEAP };
    assert_eq!(agent.question(&home, &start, &sure), Ok(None));
    let impatient = Asking { patience: 0.0, ..CHEAP };
    assert_eq!(agent.question(&home, &start, &impatient), Ok(None));
}

#[test]
fn the_plan_and_the_belief_are_the_same_after_a_question_in_parts_as_before_it() {
    let mut memory = memory();
    let (mut agent, home, start) = heard(&mut memory, Options::DEFAULT);
    let patient = |kappa| Asking { kappa, patience: 1_000.0, ..Asking::DEFAULT };
    let mut most_calls = 0;
    for asking in [1.0, 4.0, 8.0, 12.0].map(patient) {
        agent.hear(&home, &start, "go").unwrap();
        agent.plan_fully(&home, &start).unwrap();
        let before: Vec<_> = (0..agent.tasks().len()).map(|task| agent.planned().optimal(task)).collect();
        let believed = probabilities(&agent);
        let mut calls = 1;
        let considered = loop {
            match agent.consider(&home, &start, &asking, 1).unwrap() {
                Considered::Working => calls += 1,
                done => break done,
            }
        };
        most_calls = most_calls.max(calls);
        let after: Vec<_> = (0..agent.tasks().len()).map(|task| agent.planned().optimal(task)).collect();
        assert_eq!((before, believed), (after, probabilities(&agent)));
        agent.decide(&home, &start).unwrap();
        // The question does not depend on the budget.
        agent.hear(&home, &start, "go").unwrap();
        agent.plan_fully(&home, &start).unwrap();
        let whole = agent.question(&home, &start, &asking).unwrap();
        assert_eq!(considered, whole.map_or(Considered::Act, Considered::Ask));
    }
    // A cheap question is weighed against many steps.
    assert!(most_calls > 12, "{most_calls}");
}

#[test]
fn an_answer_to_what_was_not_asked_is_refused_and_changes_nothing() {
    let mut memory = memory();
    let (mut agent, home, start) = heard(&mut memory, Options::DEFAULT);
    let before = probabilities(&agent);
    assert_eq!(agent.answer(Answer::Yes), Err(AgentError::NotAsked));
    let of_yes_and_no = Asking { choices: 0, ..CHEAP };
    let question = agent.question(&home, &start, &of_yes_and_no).unwrap().unwrap();
    assert!(!matches!(question.subject, Subject::WhichTask(..) | Subject::WhichObject(..)));
    assert_eq!(agent.answer(Answer::This(0)), Err(AgentError::NoAnswer));
    assert_eq!(agent.open_question(), Some(&question), "it goes on waiting");
    assert_eq!(agent.answered(TaskSet::of(63), true, 0.1, 1), Err(AgentError::NoAnswer));
    assert_eq!(agent.answered(TaskSet::EMPTY, true, 0.1, 1), Err(AgentError::NoAnswer));
    assert_eq!(agent.answered(TaskSet::of(0), true, 0.1, 0), Err(AgentError::NoAnswer));
    assert!(matches!(agent.answered(TaskSet::of(0), true, 0.5, 1), Err(AgentError::Setting(_))));
    for wrong in [Asking { kappa: f32::NAN, ..CHEAP }, Asking { kappa: 0.0, ..CHEAP }, Asking { eta: 0.5, ..CHEAP }] {
        assert!(matches!(agent.question(&home, &start, &wrong), Err(AgentError::Setting(_))));
    }
    assert_eq!(probabilities(&agent), before);
    agent.forget();
    assert_eq!(agent.answer(Answer::Yes), Err(AgentError::NotNow(Phase::Ended)));
}

#[test]
fn a_word_that_is_corrected_after_an_answer_leaves_the_answer_as_it_was() {
    let mut memory = memory();
    let (mut agent, home, start) = heard(&mut memory, Options::DEFAULT);
    let answer = |agent: &mut Agent<_>| assert_eq!(agent.answered(TaskSet::of(1), true, 0.1, 1), Ok(Evidence::Used));
    agent.acted(&home, &start, Action::new(0)).unwrap();
    assert_eq!(agent.feedback(Feedback::Punish), Ok(Evidence::Used));
    answer(&mut agent);
    assert_eq!(agent.feedback(Feedback::Reward), Ok(Evidence::Used));
    let corrected = probabilities(&agent);
    agent.hear(&home, &start, "go").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    answer(&mut agent);
    agent.acted(&home, &start, Action::new(0)).unwrap();
    assert_eq!(agent.feedback(Feedback::Reward), Ok(Evidence::Used));
    assert_eq!(probabilities(&agent), corrected);
}

#[test]
fn a_late_word_counts_for_the_action_before_the_last_one() {
    let mut memory = memory();
    let (mut agent, home, start) = heard(&mut memory, Options::PAPER);
    // All words are one step late.
    let late = Strategy::BALANCED.with_lags([0.0, 1.0, 0.0]).unwrap();
    agent.set_strategies(&[(late, 1.0)]).unwrap();
    agent.hear(&home, &start, "go").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    let first: Vec<_> = (0..agent.tasks().len()).map(|task| agent.planned().judge(task, Action::new(3))).collect();
    let next = agent.acted(&home, &start, Action::new(3)).unwrap();
    assert_eq!(agent.feedback(Feedback::Reward), Ok(Evidence::Uninformative), "there is no action before the first");
    agent.plan_fully(&home, &next).unwrap();
    agent.acted(&home, &next, Action::new(2)).unwrap();
    assert_eq!(agent.feedback(Feedback::Reward), Ok(Evidence::Used));
    let right = |task: usize| agent.belief().weight(task).over(agent.belief().prior(task));
    for (task, judgement) in first.iter().enumerate() {
        let expected = late.probability(Feedback::Reward, *judgement == goodbot::planning::Judgement::Correct);
        assert!((right(task) - expected).abs() < 1e-6, "{task}");
    }
}

#[test]
fn the_end_of_a_session_speaks_for_what_is_done_there() {
    let mut memory = memory();
    let ending = Ending { at_goal: Hazard::of(0.2), elsewhere: Hazard::of(0.02) };
    let (mut agent, home, start) = heard(&mut memory, Options { ending, ..Options::PAPER });
    assert_eq!(agent.trainer_ended(&home, &start), Err(AgentError::NothingDone));
    // Through the door up into the green room.
    let mut state = start;
    for action in [3, 3, 0, 0, 0, 0] {
        agent.plan_fully(&home, &state).unwrap();
        state = agent.acted(&home, &state, Action::new(action)).unwrap();
    }
    agent.plan_fully(&home, &state).unwrap();
    let green = (0..agent.tasks().len()).find(|&task| agent.planned().distance(task) == Some(0)).unwrap();
    let before = agent.belief().probability(green);
    assert_eq!(agent.trainer_ended(&home, &state), Ok(Evidence::Used));
    assert!(agent.belief().probability(green) > 1.5 * before);
    assert_eq!(agent.feedback(Feedback::Reward), Err(AgentError::NothingDone), "a word after the end is about nothing");
}

#[test]
fn the_end_says_more_after_praise_and_after_a_rest_where_trainers_have_it_so() {
    let after = |said: Feedback, rests: usize| {
        let at_goal = Hazard { moved: 0.1, rested: 0.2, resting: 0.4, praised: 2.0, scolded: 0.5 };
        let mut memory = memory();
        let ending = Ending { at_goal, elsewhere: Hazard::of(0.05) };
        let (mut agent, home, start) = heard(&mut memory, Options { ending, ..Options::PAPER });
        // This trainer's words are uninformative.
        agent.set_strategies(&[(Strategy::new(0.5, 0.5, 0.5).unwrap(), 1.0)]).unwrap();
        agent.hear(&home, &start, "go").unwrap();
        let mut state = start;
        let way = [3, 3, 0, 0, 0, 0].map(Action::new);
        for action in way.into_iter().chain(std::iter::repeat_n(Action::NOOP, rests)) {
            agent.plan_fully(&home, &state).unwrap();
            state = agent.acted(&home, &state, action).unwrap();
        }
        // A mistake of the finger first: the last word counts.
        let _ = agent.feedback(if said == Feedback::Reward { Feedback::Punish } else { Feedback::Reward }).unwrap();
        let _ = agent.feedback(said).unwrap();
        agent.plan_fully(&home, &state).unwrap();
        let green = (0..agent.tasks().len()).find(|&task| agent.planned().distance(task) == Some(0)).unwrap();
        let odds = |agent: &Agent<_>| agent.belief().evidence(green).over(agent.belief().evidence(usize::from(green == 0)));
        let before = odds(&agent);
        assert_eq!(agent.trainer_ended(&home, &state), Ok(Evidence::Used));
        odds(&agent) / before
    };
    for (said, rests, times) in [
        (Feedback::Neutral, 0, 2.0),
        (Feedback::Neutral, 1, 4.0),
        (Feedback::Neutral, 2, 8.0),
        (Feedback::Neutral, 3, 8.0),
        (Feedback::Reward, 0, 4.0),
        (Feedback::Punish, 2, 4.0),
    ] {
        let measured = after(said, rests);
        assert!((measured - times).abs() < 1e-4, "{said} after {rests} rests: {measured}");
    }
}

#[test]
fn a_move_inside_the_goal_is_wrong_for_the_papers_trainer_and_a_rest_for_a_patient_one() {
    let patient = Strategy::BALANCED.with_rests([0.2, 0.9, 0.05, 1.0]).unwrap();
    for (strategy, word) in [(Strategy::BALANCED, Strategy::BALANCED.probability(Feedback::Reward, false)), (patient, 0.95 * 0.8)] {
        let mut memory = memory();
        let (mut agent, home, start) = heard(&mut memory, Options::PAPER);
        agent.set_strategies(&[(strategy, 1.0)]).unwrap();
        agent.hear(&home, &start, "go").unwrap();
        let mut state = start;
        for action in [3, 3, 0, 0, 0, 0].map(Action::new) {
            agent.plan_fully(&home, &state).unwrap();
            state = agent.acted(&home, &state, action).unwrap();
        }
        agent.plan_fully(&home, &state).unwrap();
        let green = (0..agent.tasks().len()).find(|&task| agent.planned().distance(task) == Some(0)).unwrap();
        let before = agent.belief().evidence(green);
        agent.acted(&home, &state, Action::new(0)).unwrap();
        assert_eq!(agent.judged(green)[0], Judged::MovesInside);
        let _ = agent.feedback(Feedback::Reward).unwrap();
        let measured = agent.belief().evidence(green).over(before);
        assert!((measured - word).abs() < 1e-5, "{measured} {word}");
    }
}

#[test]
fn what_is_believed_of_a_trainer_drifts_back_to_what_was_expected() {
    let mut memory = memory();
    let (mut agent, home, start) = heard(&mut memory, Options { drift: 0.25, ..Options::PAPER });
    agent.set_strategies(&[(Strategy::REWARD_ONLY, 0.5), (Strategy::PUNISH_ONLY, 0.5)]).unwrap();
    agent.hear(&home, &start, "go").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    for _ in 0..6 {
        agent.acted(&home, &start, Action::new(0)).unwrap();
        let _ = agent.feedback(Feedback::Reward).unwrap();
    }
    let kind = agent.belief().strategy_probability(0);
    agent.hear(&home, &start, "go").unwrap();
    assert!((agent.belief().strategy_probability(0) - (0.75 * kind + 0.25 * 0.5)).abs() < 1e-6);
    // Forgotten evidence leaves no trace.
    agent.plan_fully(&home, &start).unwrap();
    let begun = agent.belief().strategy_probability(0);
    agent.acted(&home, &start, Action::new(0)).unwrap();
    let _ = agent.feedback(Feedback::Punish).unwrap();
    agent.forget_evidence();
    agent.hear(&home, &start, "go").unwrap();
    assert_eq!(agent.belief().strategy_probability(0), begun);
}

#[test]
fn the_population_is_of_strategies_that_can_be() {
    let mut memory = memory();
    let (mut agent, ..) = heard(&mut memory, Options::DEFAULT.for_people());
    agent.set_strategies(&population::STRATEGIES).unwrap();
    for (strategy, share) in population::STRATEGIES {
        let sound = Strategy::new(strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon()).unwrap().with_lags(strategy.lags());
        assert_eq!((sound.unwrap().with_rests(strategy.rests()), strategy.lags().len()), (Ok(strategy), LAGS));
        assert!((0.0..1.0).contains(&share));
    }
    assert!((8..=16).contains(&population::STRATEGIES.len()));
}

#[test]
fn with_the_same_generator_it_takes_other_actions_where_they_tell_more() {
    let (mut telling, mut any) = (memory(), memory());
    let (mut telling, home, start) = heard(&mut telling, Options { telling: true, ..Options::PAPER });
    let (mut any, ..) = heard(&mut any, Options::PAPER);
    let chosen = |agent: &mut Agent<_>| -> Vec<Action> {
        let draw = |seed| agent.decide_with(&home, &start, &mut rand_pcg::Pcg32::new(seed, 1)).unwrap().action;
        (0..20).map(draw).collect()
    };
    // Both draw with the same seeds and follow the same task.
    assert_ne!(chosen(&mut telling), chosen(&mut any));
}

#[test]
fn of_equally_short_ways_it_takes_the_one_that_tells_more() {
    let mut memory = memory();
    let (mut agent, home, start) = heard(&mut memory, Options { telling: true, ..Options::PAPER });
    let decision = agent.decide(&home, &start).unwrap();
    let told = |action: Action| {
        let weigh = |judgement| agent.planned().judged(action, judgement).iter().map(|task| agent.belief().probability(task)).sum::<f32>();
        let right: f32 = weigh(goodbot::planning::Judgement::Correct);
        goodbot::feedback::Words::expected(agent.belief()).information(right)
    };
    let onward = decision.plan.onward().unwrap();
    assert!(onward.iter().all(|other| told(decision.action) >= told(other) - 1e-6));
}

#[test]
fn it_goes_on_straight_while_that_leads_on() {
    let mut memory = memory();
    let (mut agent, home, start) = heard(&mut memory, Options { telling: true, ..Options::PAPER });
    let mut state = start;
    let (mut last, mut straight) = (None, 0);
    loop {
        let decision = agent.decide(&home, &state).unwrap();
        let Some(onward) = decision.plan.onward() else { break };
        if let Some(last) = last.filter(|&last| onward.len() > 1 && onward.contains(last)) {
            assert_eq!(decision.action, last);
            straight += 1;
        }
        state = agent.acted(&home, &state, decision.action).unwrap();
        last = Some(decision.action);
        agent.plan_fully(&home, &state).unwrap();
    }
    assert!(straight > 0);
}

#[test]
fn commands_without_a_word_leave_what_is_believed_of_the_trainer_to_the_last_bit() {
    let mut memory = memory();
    let (home, start) = rooms(&mut memory.home, Some(Cell::new(4, 2)));
    let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    agent.set_strategies(&population::STRATEGIES).unwrap();
    let believed = |agent: &Agent<_>| agent.belief().strategies().to_vec();
    let before = believed(&agent);
    for _ in 0..10 {
        agent.hear(&home, &start, "go to the red room").unwrap();
        assert_eq!(believed(&agent), before);
    }
}
