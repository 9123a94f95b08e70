//! Scenes that were taught often. In these, a robot can learn how people speak of each single task. A scene is the set of all tasks that
//! are possible in it, with their descriptions: the same home, with everything in the same place.

use goodbot::language::BitextRef;
use goodbot::language::layer::hash;
use goodbot::symbols::Symbol;
use std::collections::BTreeMap;

/// A scene with this many sessions was taught often.
const OFTEN: usize = 64;
/// A task was meant in a scene if in at least this many sessions it is more probable than all others together.
const MEANT: usize = 8;
const MOSTLY: f32 = 0.5;

/// The scene of tasks with these descriptions, in any order: a hash.
pub fn of<'d>(descriptions: impl Iterator<Item = &'d [Symbol]>) -> u32 {
    descriptions.fold(0, |sum, description| sum.wrapping_add(hash(description)))
}

/// The hash of a task in a scene.
pub fn task(scene: u32, description: &[Symbol]) -> u32 {
    scene ^ hash(description)
}

/// The hashes of the tasks that were meant in scenes that were taught often, sorted. `possible` has the tasks of all sessions, and `shares`
/// the posterior of each.
pub fn taught(possible: BitextRef<'_>, shares: &[f32]) -> Vec<u32> {
    let (mut sessions, mut meant): (BTreeMap<u32, usize>, BTreeMap<(u32, u32), usize>) = (BTreeMap::new(), BTreeMap::new());
    let mut shares = shares.iter();
    for session in 0..possible.sessions() as u16 {
        let descriptions = || possible.pairs_of(session).iter().map(|pair| possible.command(pair.command));
        let scene = of(descriptions());
        let count = sessions.entry(scene).or_default();
        *count = count.saturating_add(1);
        for (description, &share) in descriptions().zip(&mut shares) {
            let count = meant.entry((scene, task(scene, description))).or_default();
            *count = count.saturating_add(usize::from(share > MOSTLY));
        }
    }
    let is_often = |scene: &u32| sessions.get(scene).is_some_and(|&count| count >= OFTEN);
    let mut taught: Vec<u32> =
        meant.into_iter().filter(|((scene, _), meant)| *meant >= MEANT && is_often(scene)).map(|((_, task), _)| task).collect();
    taught.sort_unstable();
    taught
}
