//! Compares the belief over tasks and trainers with the same sums in double precision.

use super::Bytes;
use goodbot::feedback::{Belief, BeliefCount, BeliefTables, Feedback, Judged, LAGS, Strategy};
use goodbot::probability::Scaled;

const WORDS: [Feedback; 3] = [Feedback::Reward, Feedback::Punish, Feedback::Neutral];
const JUDGED: [Judged; 6] =
    [Judged::Nearer, Judged::NotNearer, Judged::RestsAtGoal, Judged::RestsElsewhere, Judged::MovesInside, Judged::Unknown];
/// Rounding of twenty words in single precision stays below this.
const TOLERANCE: f64 = 1e-3;

/// The probability of a word, as the paper writes it.
fn said([plus, minus, mistake]: [f64; 3], word: Feedback, right: bool) -> f64 {
    let seen_right = if right { 1.0 - mistake } else { mistake };
    match word {
        Feedback::Reward => seen_right * (1.0 - plus),
        Feedback::Punish => (1.0 - seen_right) * (1.0 - minus),
        Feedback::Neutral => seen_right * plus + (1.0 - seen_right) * minus,
    }
}

/// The mean over the actions that a word may be about; `None` if nothing is known about them.
fn likelihood(strategy: &Strategy, word: Feedback, judged: [Judged; LAGS]) -> Option<f64> {
    let moves = [strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon()].map(f64::from);
    let [plus, minus, mistake, inside] = strategy.rests().map(f64::from);
    let after = |judged| {
        let resting = |right| said([plus, minus, mistake], word, right);
        Some(match judged {
            Judged::Nearer => said(moves, word, true),
            Judged::NotNearer => said(moves, word, false),
            Judged::RestsAtGoal => resting(true),
            Judged::RestsElsewhere => resting(false),
            Judged::MovesInside => inside * resting(true) + (1.0 - inside) * said(moves, word, false),
            Judged::Unknown => return None,
        })
    };
    let known = strategy.lags().into_iter().zip(judged).filter_map(|(lag, judged)| Some((f64::from(lag), after(judged)?)));
    let (sum, whole) = known.fold((0.0, 0.0), |(sum, whole), (lag, value)| (sum + lag * value, whole + lag));
    (whole > 0.0).then(|| sum / whole)
}

/// Tests tasks, trainers and words that the bytes choose.
pub fn belief(input: &[u8]) {
    let mut choices = Bytes::new(input);
    let share = |choices: &mut Bytes<'_>| f32::from(choices.byte()) / 255.0;
    let (tasks, kinds) = (1 + choices.below(6), 1 + choices.below(3));
    let mut strategies = Vec::new();
    for _ in 0..kinds {
        let numbers = [(); 7].map(|()| share(&mut choices));
        let lags = choices.one_of(&[Strategy::NO_LAG, [0.5, 0.25, 0.25], [0.0, 1.0, 0.0]]);
        let [plus, minus, mistake, rests @ ..] = numbers;
        let strategy = Strategy::new(plus, minus, mistake).and_then(|kind| kind.with_rests(rests)).and_then(|kind| kind.with_lags(lags));
        strategies.push((strategy.expect("shares are sound"), (share(&mut choices) + 0.01).min(1.0)));
    }
    let priors: Vec<f32> = (0..tasks).map(|_| share(&mut choices)).collect();

    let (mut joint, mut settled) = (vec![Scaled::ZERO; tasks * kinds], vec![Scaled::ZERO; tasks * kinds]);
    let (mut own_priors, mut own_kinds) = (vec![Scaled::ZERO; tasks], vec![(Strategy::UNUSED, 0.0); kinds]);
    let (mut expected, mut count) = (vec![0.0; kinds], BeliefCount::NONE);
    let tables = BeliefTables {
        joint: &mut joint,
        settled: &mut settled,
        priors: &mut own_priors,
        strategies: &mut own_kinds,
        expected: &mut expected,
    };
    let mut belief = Belief::new(tables, &mut count);
    belief.set_strategies(&strategies).expect("they fit and are sound");
    belief.restart(priors.iter().map(|&prior| Scaled::new(prior)), 0.0).expect("they fit");

    let begun: Vec<f64> = belief.read().strategies().iter().map(|&(_, prior)| f64::from(prior)).collect();
    let mut exact: Vec<Vec<f64>> = vec![begun; tasks];
    let mut exact_settled = exact.clone();
    let prior = |task: usize| f64::from(priors[task]);
    for _ in 0..choices.below(20) {
        if choices.below(2) == 0 {
            belief.settle();
            exact_settled.clone_from(&exact);
        }
        let word = choices.one_of(&WORDS);
        let judged: Vec<[Judged; LAGS]> = (0..tasks).map(|_| [(); LAGS].map(|()| choices.one_of(&JUDGED))).collect();
        let value = |task: usize, kind: usize| likelihood(&strategies[kind].0, word, judged[task]);
        let pairs = || (0..tasks).flat_map(|task| (0..kinds).map(move |kind| (task, kind)));
        let is_possible =
            pairs().any(|(task, kind)| value(task, kind).is_some_and(|value| value * exact_settled[task][kind] * prior(task) > 0.0));
        assert_eq!(belief.observe_feedback(word, |task| judged[task]), is_possible, "{word} is possible, or is not");
        if !is_possible {
            continue;
        }
        exact.clone_from(&exact_settled);
        for kind in 0..kinds {
            let of_kind = exact.iter().enumerate().map(|(task, exact)| (task, exact[kind]));
            let known = of_kind.filter_map(|(task, exact)| Some((exact * prior(task), value(task, kind)?)));
            let (weight, explained) =
                known.fold((0.0, 0.0), |(sum, explained), (weight, value)| (sum + weight, explained + weight * value));
            let mean = if weight > 0.0 { explained / weight } else { 1.0 };
            (0..tasks).for_each(|task| exact[task][kind] *= value(task, kind).unwrap_or(mean));
        }
        let whole: f64 = pairs().map(|(task, kind)| exact[task][kind] * prior(task)).sum();
        for (task, exact) in exact.iter().enumerate() {
            let (ours, exactly) = (f64::from(belief.read().probability(task)), exact.iter().sum::<f64>() * prior(task) / whole);
            assert!((ours - exactly).abs() < TOLERANCE, "task {task}: {ours} here, {exactly} in double precision");
        }
        for kind in 0..kinds {
            let exactly = exact.iter().enumerate().map(|(task, exact)| exact[kind] * prior(task)).sum::<f64>() / whole;
            let ours = f64::from(belief.read().strategy_probability(kind));
            assert!((ours - exactly).abs() < TOLERANCE, "trainer {kind}: {ours} here, {exactly} in double precision");
        }
    }
}
