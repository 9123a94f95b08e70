//! The order of the words of an utterance, by their sorts.
//!
//! "In ten minutes go there" and "go there, never mind" name a task as well as any command does. What tells them apart is which sorts of
//! words stand where. So there is a feature for each sort of word before, between and after the names, for each two sorts that are
//! neighbours, and for each two of which one comes anywhere before the other.

use super::super::heard::Heard;
use crate::voice::classes::Class;

/// The sorts of words: the closed classes, a name, an act, a slip, a new word, a plural, another word.
const SORTS: usize = Class::ALL.len() + 6;
/// The border of the utterance, which is a neighbour too.
const BORDER: usize = SORTS;
const _: () = assert!(BORDER < u64::BITS as usize);

/// The first of each group of features.
const PLACES: usize = SORTS;
const PAIRS: usize = PLACES + 3 * SORTS;
const BEHIND: usize = PAIRS + (SORTS + 1) * (SORTS + 1);
/// The number of features.
pub(super) const ORDERS: usize = BEHIND + SORTS * SORTS;

/// The names of the sorts beside the closed classes.
const OTHERS: [&str; 7] = ["a name", "an act", "a slip", "a new word", "a plural", "another word", "the border"];

/// The name of a sort.
fn sort_name(sort: usize) -> &'static str {
    let other = || OTHERS.get(sort.saturating_sub(Class::ALL.len())).copied().unwrap_or("");
    Class::ALL.get(sort).map_or_else(other, |class| class.name())
}

/// The name of a feature: how two sorts stand to each other, and which they are.
pub(super) fn order_name(feature: usize) -> [&'static str; 3] {
    const WHERE: [&str; 3] = ["before names", "between names", "after names"];
    match feature {
        _ if feature < PLACES => ["somewhere", sort_name(feature), ""],
        _ if feature < PAIRS => {
            let at = feature - PLACES;
            [WHERE.get(at / SORTS).copied().unwrap_or(""), sort_name(at % SORTS), ""]
        }
        _ if feature < BEHIND => {
            ["next to each other", sort_name((feature - PAIRS) / (SORTS + 1)), sort_name((feature - PAIRS) % (SORTS + 1))]
        }
        _ => ["one after the other", sort_name((feature - BEHIND) / SORTS), sort_name((feature - BEHIND) % SORTS)],
    }
}

/// The sorts of a word, as it was said and as it was mended: one bit each.
fn sorts(said: &Heard, mended: &Heard) -> u64 {
    let kinds = [mended.is_name, mended.acts(), mended.is_mended, said.is_new && !mended.is_mended, mended.is_plural];
    let of_class = u64::from(mended.of_table.bits());
    let sorts = kinds.iter().enumerate().fold(of_class, |all, (at, &holds)| all | u64::from(holds) << (Class::ALL.len() + at));
    if sorts == 0 { 1 << (SORTS - 1) } else { sorts }
}

/// The positions of the bits in a set.
fn members(set: u64) -> impl Iterator<Item = usize> {
    (0..u64::BITS as usize).filter(move |at| set >> at & 1 == 1)
}

/// The sorts of the words of an utterance, and how they stand to each other.
#[derive(Clone, Copy)]
pub(super) struct Order {
    /// For each place, the sorts there.
    places: [u64; 3],
    /// For each sort, the sorts of words next to it, and those of words anywhere behind it.
    next: [u64; SORTS + 1],
    behind: [u64; SORTS],
    /// The sorts of the last word so far, and of all words so far.
    before: u64,
    earlier: u64,
}

impl Order {
    /// Before the first word.
    pub const NEW: Self = Self { places: [0; 3], next: [0; SORTS + 1], behind: [0; SORTS], before: 1 << BORDER, earlier: 0 };

    /// Takes the next word, as it was said and as it was mended. It stands before names, between names or after names: 0, 1 or 2.
    pub fn take(&mut self, said: &Heard, mended: &Heard, place: usize) {
        let sorts = sorts(said, mended);
        self.places.iter_mut().skip(place).take(1).for_each(|slot| *slot |= sorts);
        join(&mut self.next, self.before, sorts);
        join(&mut self.behind, self.earlier, sorts);
        (self.before, self.earlier) = (sorts, self.earlier | sorts);
    }

    /// Takes the end of the utterance.
    pub fn end(&mut self) {
        join(&mut self.next, self.before, 1 << BORDER);
    }

    /// Passes each feature that holds, by its number below [`ORDERS`].
    pub fn for_each(&self, take: &mut dyn FnMut(usize)) {
        members(self.places.iter().fold(0, |all, place| all | place)).for_each(&mut *take);
        for (place, &sorts) in self.places.iter().enumerate() {
            members(sorts).for_each(|sort| take(PLACES + place * SORTS + sort));
        }
        for (sort, &next) in self.next.iter().enumerate() {
            members(next).for_each(|other| take(PAIRS + sort * (SORTS + 1) + other));
        }
        for (sort, &behind) in self.behind.iter().enumerate() {
            members(behind).for_each(|other| take(BEHIND + sort * SORTS + other));
        }
    }
}

/// Adds the sorts `after` to the rows of the sorts `before`.
fn join(rows: &mut [u64], before: u64, after: u64) {
    for (_, row) in rows.iter_mut().enumerate().filter(|(sort, _)| before >> sort & 1 == 1) {
        *row |= after;
    }
}
