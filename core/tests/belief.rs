//! The belief over tasks and trainers, number by number. Separate from the other tests, so that mutation tests build it in seconds.

use goodbot::capacity::{Capacity, CapacityError};
use goodbot::feedback::Judged::{MovesInside, Nearer, NotNearer, RestsAtGoal, RestsElsewhere, Unknown};
use goodbot::feedback::{
    Belief, BeliefCount, BeliefError, BeliefTables, Ending, Feedback, Hazard, Judged, LAGS, Moment, Strategy, StrategyError,
};
use goodbot::probability::Scaled;

const ALL: [Feedback; 3] = [Feedback::Reward, Feedback::Punish, Feedback::Neutral];
/// A trainer who rewards a right move eight times in ten, and one who punishes a wrong move eight times in ten.
const PRAISES: [f32; 3] = [0.2, 1.0, 0.0];
const BLAMES: [f32; 3] = [1.0, 0.2, 0.0];

fn strategy([mu_plus, mu_minus, epsilon]: [f32; 3]) -> Strategy {
    Strategy::new(mu_plus, mu_minus, epsilon).unwrap()
}

/// The tables, with room for exactly this many tasks and strategies.
struct Room {
    joint: Vec<Scaled>,
    settled: Vec<Scaled>,
    priors: Vec<Scaled>,
    strategies: Vec<(Strategy, f32)>,
    expected: Vec<f32>,
    count: BeliefCount,
}

impl Room {
    fn new(tasks: usize, strategies: usize) -> Self {
        Self {
            joint: vec![Scaled::ONE; tasks * strategies],
            settled: vec![Scaled::ONE; tasks * strategies],
            priors: vec![Scaled::ONE; tasks],
            strategies: vec![(Strategy::UNUSED, 0.0); strategies],
            expected: vec![0.0; strategies],
            count: BeliefCount::NONE,
        }
    }

    fn belief(&mut self) -> Belief<'_> {
        let Self { joint, settled, priors, strategies, expected, count } = self;
        Belief::new(BeliefTables { joint, settled, priors, strategies, expected }, count)
    }

    /// A belief with these strategies and priors.
    fn begun(tasks: usize, strategies: &[(Strategy, f32)], priors: &[f32]) -> Self {
        let mut room = Self::new(tasks, strategies.len());
        room.belief().set_strategies(strategies).unwrap();
        room.belief().restart(priors.iter().map(|&prior| Scaled::new(prior)), 0.0).unwrap();
        room
    }
}

#[track_caller]
fn near(found: &[f32], wanted: &[f32]) {
    assert_eq!(found.len(), wanted.len());
    assert!(found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-6), "{found:?} is not {wanted:?}");
}

fn tasks(belief: &Belief<'_>) -> Vec<f32> {
    let belief = belief.read();
    (0..belief.tasks()).map(|task| belief.probability(task)).collect()
}

fn trainers(belief: &Belief<'_>) -> Vec<f32> {
    let belief = belief.read();
    (0..belief.strategies().len()).map(|strategy| belief.strategy_probability(strategy)).collect()
}

const fn last(judged: Judged) -> [Judged; LAGS] {
    [judged, Unknown, Unknown]
}

#[test]
fn a_word_multiplies_each_task_by_its_likelihood() {
    let mut room = Room::begun(3, &[(Strategy::BALANCED, 1.0)], &[0.5, 0.25, 0.25]);
    let mut belief = room.belief();
    near(&tasks(&belief), &[0.5, 0.25, 0.25]);
    assert!(!belief.read().has_evidence());
    // Praise: 0.9 · 0.3 where the move is right, 0.1 · 0.3 where it is wrong.
    assert!(belief.observe_feedback(Feedback::Reward, |task| last(if task == 0 { Nearer } else { NotNearer })));
    near(&tasks(&belief), &[0.9, 0.05, 0.05]);
    assert!(belief.read().has_evidence());
    near(&[belief.read().evidence(0).value(), belief.read().evidence(2).value()], &[0.27, 0.03]);
    near(&[belief.read().weight(0).value(), belief.read().whole().value()], &[0.135, 0.15]);
}

#[test]
fn a_later_word_about_the_same_action_replaces_the_one_before_until_it_is_settled() {
    let mut room = Room::begun(2, &[(Strategy::BALANCED, 1.0)], &[0.5, 0.5]);
    let mut belief = room.belief();
    let judged = |task| last(if task == 0 { Nearer } else { NotNearer });
    belief.observe_feedback(Feedback::Punish, judged);
    near(&tasks(&belief), &[0.1, 0.9]);
    belief.observe_feedback(Feedback::Reward, judged);
    near(&tasks(&belief), &[0.9, 0.1]);
    belief.settle();
    belief.observe_feedback(Feedback::Reward, judged);
    near(&tasks(&belief), &[81.0 / 82.0, 1.0 / 82.0]);
}

#[test]
fn evidence_that_cannot_be_is_ignored() {
    let mut room = Room::begun(2, &[(strategy([1.0, 1.0, 0.0]), 1.0)], &[0.5, 0.5]);
    let mut belief = room.belief();
    // Praise from a trainer who never speaks is impossible.
    assert!(!belief.observe_feedback(Feedback::Reward, |_| last(Nearer)));
    assert!(!belief.read().has_evidence());
    // Possible only under a task that is itself impossible.
    belief.set_prior(0, Scaled::ZERO);
    assert!(!belief.observe(&|_, task| Some(if task == 0 { 1.0 } else { 0.0 })));
    assert!(belief.observe(&|_, task| Some(if task == 1 { 1.0 } else { 0.0 })));
    near(&tasks(&belief), &[0.0, 1.0]);
    // Evidence without any known probability is uninformative.
    assert!(!belief.observe(&|_, _| None));
}

#[test]
fn a_task_that_is_not_judged_gets_the_mean_of_those_that_are() {
    let mut room = Room::begun(3, &[(Strategy::BALANCED, 1.0)], &[0.5, 0.25, 0.25]);
    let mut belief = room.belief();
    assert!(belief.observe(&|_, task| [Some(0.8), Some(0.2), None][task]));
    // The mean is (0.5 · 0.8 + 0.25 · 0.2) / 0.75 = 0.6, and the third task keeps its quarter.
    near(&[belief.read().evidence(2).value()], &[0.6]);
    near(&tasks(&belief), &[0.4 / 0.6, 0.05 / 0.6, 0.25]);
}

#[test]
fn what_is_known_for_one_kind_of_trainer_alone_leaves_the_other_as_it_was() {
    let mut room = Room::begun(2, &[(strategy(PRAISES), 0.5), (strategy(BLAMES), 0.5)], &[0.5, 0.5]);
    let mut belief = room.belief();
    assert!(belief.observe(&|kind, task| (kind.mu_plus() < 0.5).then_some(if task == 0 { 0.5 } else { 0.25 })));
    near(&[belief.read().evidence(0).value(), belief.read().evidence(1).value()], &[0.75, 0.625]);
}

#[test]
fn words_tell_trainers_apart_and_the_next_session_begins_with_that() {
    let mut room = Room::begun(2, &[(strategy(PRAISES), 0.75), (strategy(BLAMES), 0.25)], &[0.5, 0.5]);
    let mut belief = room.belief();
    near(&trainers(&belief), &[0.75, 0.25]);
    // Silence after a move that is right for both tasks: two in ten from the one trainer, always from the other.
    assert!(belief.observe_feedback(Feedback::Neutral, |_| last(Nearer)));
    near(&trainers(&belief), &[0.375, 0.625]);
    near(&tasks(&belief), &[0.5, 0.5]);
    assert_eq!((belief.read().strategy_probability(2), belief.read().expected(2)), (0.0, 0.0));

    belief.restart([0.25, 0.75].into_iter().map(Scaled::new), 0.0).unwrap();
    near(&trainers(&belief), &[0.375, 0.625]);
    near(&[belief.read().expected(0), belief.read().expected(1)], &[0.75, 0.25]);
    near(&tasks(&belief), &[0.25, 0.75]);
    assert!(!belief.read().has_evidence());
    // A third of the way back to the prior.
    assert!(belief.observe(&|_, task| Some(if task == 0 { 1.0 } else { 0.5 })));
    belief.restart([0.5, 0.5].into_iter().map(Scaled::new), 1.0 / 3.0).unwrap();
    near(&trainers(&belief), &[0.5, 0.5]);
    assert_eq!(belief.read().strategies()[0].0, strategy(PRAISES));
}

#[test]
fn without_evidence_the_next_session_begins_as_the_last_to_the_bit() {
    let strategies = [(strategy(PRAISES), 0.1), (strategy(BLAMES), 0.7), (Strategy::BALANCED, 0.1)];
    let mut room = Room::begun(3, &strategies, &[0.3, 0.3, 0.4]);
    let mut belief = room.belief();
    let before: Vec<_> = belief.read().strategies().iter().map(|&(_, probability)| probability.to_bits()).collect();
    for _ in 0..10 {
        belief.restart([0.3, 0.3, 0.4].into_iter().map(Scaled::new), 0.0).unwrap();
    }
    assert_eq!(belief.read().strategies().iter().map(|&(_, probability)| probability.to_bits()).collect::<Vec<_>>(), before);
}

#[test]
fn strategies_are_renormalised_and_unsound_ones_change_nothing() {
    let mut room = Room::new(2, 2);
    let mut belief = room.belief();
    belief.set_strategies(&[(strategy(PRAISES), 0.2), (strategy(BLAMES), 0.6)]).unwrap();
    let priors = |belief: &Belief<'_>| belief.read().strategies().iter().map(|&(_, prior)| prior).collect::<Vec<_>>();
    near(&priors(&belief), &[0.25, 0.75]);
    near(&[belief.read().expected(0), belief.read().expected(1)], &[0.25, 0.75]);
    let (one, zero) = ((Strategy::BALANCED, 1.0), (Strategy::BALANCED, 0.0));
    for value in [-0.1, 1.1, f32::INFINITY] {
        assert_eq!(belief.set_strategies(&[one, (Strategy::BALANCED, value)]), Err(BeliefError::Prior { strategy: 1, value }));
    }
    assert!(matches!(belief.set_strategies(&[(Strategy::BALANCED, f32::NAN)]), Err(BeliefError::Prior { strategy: 0, .. })));
    assert_eq!(belief.set_strategies(&[zero, zero]), Err(BeliefError::NoPrior));
    assert_eq!(belief.set_strategies(&[]), Err(BeliefError::NoPrior));
    let full = CapacityError::new(Capacity::Strategies, 2, 3);
    assert_eq!(belief.set_strategies(&[one, one, one]), Err(full.into()));
    near(&priors(&belief), &[0.25, 0.75]);
    assert_eq!(belief.read().tasks(), 0);
    let said = [BeliefError::NoPrior, BeliefError::Prior { strategy: 1, value: 1.5 }, full.into()].map(|error| error.to_string());
    assert!(said.iter().all(|text| text.len() > 10) && said[1].contains("1.5") && said[2] == full.to_string(), "{said:?}");
}

#[test]
fn strategies_that_are_set_begin_without_tasks() {
    let mut room = Room::begun(2, &[(Strategy::BALANCED, 1.0)], &[0.5, 0.5]);
    let mut belief = room.belief();
    belief.set_strategies(&[(strategy(PRAISES), 1.0)]).unwrap();
    assert_eq!((belief.read().tasks(), belief.read().probability(0), belief.read().prior(0)), (0, 0.0, Scaled::ZERO));
    assert!(belief.read().whole().is_zero() && belief.read().strategy_probability(0) == 1.0);
}

#[test]
fn what_does_not_fit_is_refused_by_the_name_of_what_is_full_and_what_just_fits_is_taken() {
    let mut room = Room::new(2, 2);
    let mut belief = room.belief();
    belief.set_strategies(&[(strategy(PRAISES), 0.5), (strategy(BLAMES), 0.5)]).unwrap();
    let priors = |count| std::iter::repeat_n(Scaled::ONE, count);
    assert_eq!(belief.restart(priors(2), 0.0), Ok(()));
    assert_eq!(belief.restart(priors(3), 0.0), Err(CapacityError::new(Capacity::Beliefs, 4, 6)));
    assert_eq!(belief.read().tasks(), 0);
    belief.set_strategies(&[(Strategy::BALANCED, 1.0)]).unwrap();
    assert_eq!(belief.restart(priors(3), 0.0), Err(CapacityError::new(Capacity::Tasks, 2, 3)));
}

#[test]
fn a_task_that_is_not_there_has_no_belief_and_takes_no_prior() {
    let mut room = Room::begun(3, &[(Strategy::BALANCED, 1.0)], &[0.5, 0.5]);
    let mut belief = room.belief();
    belief.set_prior(2, Scaled::ONE);
    belief.set_prior(1, Scaled::new(0.25));
    let read = belief.read();
    assert!(read.prior(2).is_zero() && read.evidence(2).is_zero() && read.weight(2).is_zero() && read.probability(2) == 0.0);
    near(&tasks(&belief), &[2.0 / 3.0, 1.0 / 3.0]);
}

#[test]
fn a_trainers_words_after_each_kind_of_action_have_their_probabilities() {
    let people = strategy([0.6, 0.4, 0.25]).with_rests([0.2, 0.8, 0.1, 0.25]).unwrap();
    let words = |judged| ALL.map(|word| people.probability_after(word, judged).unwrap());
    near(&words(Nearer), &[0.75 * 0.4, 0.25 * 0.6, 0.75 * 0.6 + 0.25 * 0.4]);
    near(&words(NotNearer), &[0.25 * 0.4, 0.75 * 0.6, 0.25 * 0.6 + 0.75 * 0.4]);
    near(&words(RestsAtGoal), &[0.9 * 0.8, 0.1 * 0.2, 0.9 * 0.2 + 0.1 * 0.8]);
    near(&words(RestsElsewhere), &[0.1 * 0.8, 0.9 * 0.2, 0.1 * 0.2 + 0.9 * 0.8]);
    let mixed = |word: usize| 0.25 * words(RestsAtGoal)[word] + 0.75 * words(NotNearer)[word];
    near(&words(MovesInside), &[mixed(0), mixed(1), mixed(2)]);
    assert_eq!(people.probability_after(Feedback::Reward, Unknown), None);
    near(&[people.mu_plus(), people.mu_minus(), people.epsilon()], &[0.6, 0.4, 0.25]);
    near(&people.rests(), &[0.2, 0.8, 0.1, 0.25]);
    assert!(!people.rests_as_it_moves() && strategy([0.6, 0.4, 0.25]).rests_as_it_moves());
}

#[test]
fn a_late_word_is_the_mean_over_the_actions_that_it_may_be_about() {
    let late = Strategy::BALANCED.with_lags([0.5, 0.25, 0.25]).unwrap();
    let [right, wrong] = [Nearer, NotNearer].map(|judged| late.probability_after(Feedback::Reward, judged).unwrap());
    let likely = |judged| late.likelihood(Feedback::Reward, judged).unwrap();
    near(&[likely([Nearer, NotNearer, NotNearer])], &[0.5 * right + 0.5 * wrong]);
    near(&[likely([NotNearer, Nearer, NotNearer]), likely([NotNearer, NotNearer, Nearer])], &[0.25 * right + 0.75 * wrong; 2]);
    near(&[likely([Unknown, Nearer, NotNearer])], &[(right + wrong) / 2.0]);
    assert_eq!(late.likelihood(Feedback::Reward, [Unknown; LAGS]), None);
    assert_eq!(Strategy::BALANCED.likelihood(Feedback::Reward, [Unknown, Nearer, Nearer]), None);
}

#[test]
fn numbers_that_are_no_probabilities_are_refused_by_their_names() {
    for wrong in [-0.001, 1.001, f32::NAN] {
        assert_eq!(Strategy::new(wrong, 0.5, 0.5), Err(StrategyError::MuPlus));
        assert_eq!(Strategy::new(0.5, wrong, 0.5), Err(StrategyError::MuMinus));
        assert_eq!(Strategy::new(0.5, 0.5, wrong), Err(StrategyError::Epsilon));
        assert_eq!(Strategy::BALANCED.with_rests([0.5, 0.5, 0.5, wrong]), Err(StrategyError::Rests));
    }
    assert!(Strategy::new(0.0, 1.0, 0.0).is_ok() && Strategy::BALANCED.with_rests([0.0, 1.0, 0.0, 1.0]).is_ok());
    for wrong in [[0.5, 0.25, 0.0], [0.5, 0.5, 0.25], [1.25, -0.25, 0.0], [f32::NAN, 0.5, 0.5], [0.998, 0.0, 0.0], [1.0, 0.002, 0.0]] {
        assert_eq!(Strategy::BALANCED.with_lags(wrong), Err(StrategyError::Lags));
    }
    for sound in [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.333, 0.333, 0.334], [0.9995, 0.0, 0.0], [1.0, 0.0005, 0.0]] {
        assert_eq!(Strategy::BALANCED.with_lags(sound).unwrap().lags(), sound);
    }
    let [plus, minus, mistake, lags, rests] =
        [StrategyError::MuPlus, StrategyError::MuMinus, StrategyError::Epsilon, StrategyError::Lags, StrategyError::Rests]
            .map(|error| error.to_string());
    assert!(plus.starts_with("mu+ ") && minus.starts_with("mu- ") && mistake.starts_with("epsilon "), "{plus} {minus} {mistake}");
    assert!(lags.contains("lags") && rests.contains("rests"), "{lags} {rests}");
}

#[test]
fn an_end_is_as_probable_as_its_moment_says() {
    let hazard = Hazard { moved: 0.1, rested: 0.2, resting: 0.3, praised: 2.0, scolded: 0.5 };
    let ending = Ending { at_goal: hazard, elsewhere: Hazard::of(0.05) };
    let moment = Moment::default().acted(false);
    let ends = |moment| ending.probability(true, true, moment);
    near(&[ends(moment), ends(moment.acted(true)), ends(moment.acted(true).acted(true))], &[0.1, 0.2, 0.3]);
    near(&[ends(moment.acted(true).acted(false))], &[0.1]);
    near(&[ends(moment.heard(Feedback::Reward)), ends(moment.heard(Feedback::Punish))], &[0.2, 0.05]);
    near(&[ends(moment.heard(Feedback::Reward).heard(Feedback::Neutral)), ends(moment.heard(Feedback::Neutral))], &[0.2, 0.1]);
    near(&[ending.probability(false, true, moment), ending.probability(false, false, moment)], &[0.9, 0.95]);
    assert!(ending.is_evidence() && !Ending::NO_EVIDENCE.is_evidence());
}
