//! A command as a whole: what it meant when lessons had it word for word.
//!
//! A word means one thing, so "hop" for "take the chair to the red room" would stay the name of the chair, or of red, however often it is
//! taught. With n the weight of the last four lessons that had exactly these words, and m the part of it that meant this task,
//!
//! ```text
//! Pr(e|t) counts 1 + 2 m^2 / n times
//! ```
//!
//! m^2 / n and not m, because a command such as "again", which means another task each time, tells none. A task is the same if its kind and
//! the values of its own objects are, wherever things start. Of twelve such code words in a home that stays, the role model understands all
//! after one lesson with each, and without this half after four with each. The 2 was chosen among 2, 4, 8 and 16 with the recorded
//! commands in view: they lose some accuracy with more, because people also say the same and mean another thing. A lesson counts once it has
//! joined the training data, trained on or not, and whatever its trainer said: what the robot guessed, it guesses a little more surely again.

use crate::language::bitext::{BitextRef, LIGHT};
use crate::symbols::Symbol;
use crate::task::description::{groups, is_of_task};

/// More lessons with the same words are not looked up: hearing must stay short on a controller.
const MOST_LESSONS: usize = 4;
const WEIGHT: f32 = 2.0;

/// The factor of Pr(e|t) for a command of these words, at least 1.
#[inline(never)]
pub fn said_before(bitext: BitextRef<'_>, sentence: &[Option<Symbol>], description: &[Symbol]) -> f32 {
    let (mut of_task, mut all) = (0.0_f32, 0.0_f32);
    let is_same =
        |&session: &u16| !bitext.leaves_out(session) && bitext.sentence(session).iter().copied().map(Some).eq(sentence.iter().copied());
    for session in (0..bitext.sessions() as u16).rev().filter(is_same).take(MOST_LESSONS) {
        for pair in bitext.pairs_of(session) {
            all += pair.weight;
            if pair.weight >= LIGHT && is_same_task(bitext.command(pair.command), description) {
                of_task += pair.weight;
            }
        }
    }
    if of_task > 0.0 { 1.0 + WEIGHT * of_task * of_task / all } else { 1.0 }
}

fn is_same_task(one: &[Symbol], other: &[Symbol]) -> bool {
    let of_task = |description| groups(description).filter(is_of_task).map(|group| (group.marker, group.values));
    one.first() == other.first() && of_task(one).eq(of_task(other))
}
