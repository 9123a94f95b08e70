//! Meanings that lessons had, in worlds in which the words in names are values.
//!
//! In such worlds the layer weighs hundreds of tasks that no lesson meant, so it is too modest about those that lessons did mean: of
//! answers with .4 to .5, nine in ten are right. A task is familiar to a command if lessons meant it, and these lessons had every word of
//! the command. For example, "lights off in the kitchen" is familiar after "turn the kitchen lights off" and "off with the lights in the
//! kitchen", but "lights off in the hall" is not.
//!
//! - A familiar task counts a third more, because people repeat what they want.
//! - If the most probable task is familiar, all probabilities are squared.
//!
//! A word that no lesson said with the task keeps it from being familiar, so a new combination of known parts is as uncertain as before.

use crate::weighed::Weighed;
use goodbot::capacity::WORDS_PER_COMMAND;
use goodbot::language::BitextRef;
use goodbot::probability::Scaled;
use goodbot::symbols::Symbol;
use std::collections::{BTreeMap, BTreeSet};

/// A lesson meant a task that has at least this share of its weight.
const MEANT: f32 = 0.5;
/// How much more a familiar task counts. With e^0.5 or more, new combinations are mistaken for what lessons meant.
const REPEATED: f32 = 4.0 / 3.0;

/// One bit per word of a command.
type Words = u64;
const _: () = assert!(WORDS_PER_COMMAND <= Words::BITS as usize);

/// The descriptions of the tasks that are familiar to a command.
pub fn to_command<'t>(bitext: BitextRef<'t>, sentence: &[Option<Symbol>]) -> BTreeSet<&'t [Symbol]> {
    let all: Words = sentence.iter().fold(0, |all, _| (all << 1) | 1);
    let said = |session: u16| {
        let words = bitext.sentence(session);
        sentence.iter().fold(0, |said: Words, word| (said << 1) | Words::from(word.is_some_and(|word| words.contains(&word))))
    };
    let mut with_task: BTreeMap<u16, Words> = BTreeMap::new();
    for pair in bitext.pairs().iter().filter(|pair| pair.weight >= MEANT) {
        *with_task.entry(pair.command).or_default() |= said(pair.session);
    }
    with_task.into_iter().filter(|&(_, said)| said == all && all > 0).map(|(command, _)| bitext.command(command)).collect()
}

/// The probability of each task, of which those at the positions in `is_familiar` are familiar. `count` returns how many tasks a position
/// stands for.
pub fn surer(tasks: &[Weighed], is_familiar: impl Fn(usize) -> bool, count: impl Fn(usize) -> usize) -> Vec<Scaled> {
    let counted = |(position, task): (usize, &Weighed)| if is_familiar(position) { REPEATED * task.believed } else { task.believed };
    let believed: Vec<f32> = tasks.iter().enumerate().map(counted).collect();
    let of_one = |position: usize, believed: f32| believed / count(position).max(1) as f32;
    let best = believed.iter().enumerate().fold((0, f32::MIN), |best, (position, &believed)| {
        let of_one = of_one(position, believed);
        if of_one > best.1 { (position, of_one) } else { best }
    });
    let is_sure = is_familiar(best.0);
    let sure = |&believed: &f32| if is_sure { Scaled::new(believed).times(Scaled::new(believed)) } else { Scaled::new(believed) };
    believed.iter().map(sure).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn probabilities(believed: [f32; 3], familiar: &[usize]) -> [f32; 3] {
        let tasks = believed.map(|believed| Weighed { believed, ..Weighed::default() });
        let sure = surer(&tasks, |position| familiar.contains(&position), |_| 1);
        let whole = goodbot::probability::total(sure.iter().copied());
        [0, 1, 2].map(|task| sure[task].over(whole))
    }

    #[test]
    fn only_a_familiar_task_makes_a_command_surer() {
        let before = [0.5, 0.25, 0.25];
        assert_eq!(probabilities(before, &[]), before);
        let [best, others @ ..] = probabilities(before, &[0]);
        assert!(best > 0.75 && others[0] == others[1], "{best}");
        // What lessons meant gains, but the command is not squared.
        let [best, familiar, other] = probabilities(before, &[1]);
        assert!((familiar / other - REPEATED).abs() < 1e-5 && (best / other - 2.0).abs() < 1e-5, "{best} {familiar} {other}");
    }

    #[test]
    fn a_tiny_probability_is_squared_and_not_lost() {
        let tasks = [1.0, 1e-30].map(|believed| Weighed { believed, ..Weighed::default() });
        let sure = surer(&tasks, |_| true, |_| 1);
        assert!(!sure[1].is_zero());
    }
}
