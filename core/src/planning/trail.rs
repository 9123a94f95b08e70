//! A way from place to place, found and kept in borrowed words.
//!
//! Two arrays of 16-bit entries, four to a word: for each place the one before it (once the way is found, the next on it), and the places
//! in the order in which they were met. Entries are one more than a place; 0 is none.

const fn lane(at: usize) -> (usize, u32) {
    (at / 4, (at % 4 * 16) as u32)
}

fn get(words: &[u64], at: usize) -> Option<usize> {
    let (word, shift) = lane(at);
    usize::from((words.get(word).copied().unwrap_or(0) >> shift) as u16).checked_sub(1)
}

fn set(words: &mut [u64], at: usize, place: Option<usize>) {
    let (word, shift) = lane(at);
    if let Some(word) = words.get_mut(word) {
        let entry = place.map_or(0, |place| place.wrapping_add(1) as u16);
        *word = *word & !(0xffff << shift) | u64::from(entry) << shift;
    }
}

const fn words(places: usize) -> usize {
    places.saturating_mul(2).div_ceil(4)
}

/// Finds a shortest way from a place to one where `is_goal` holds; gives whether there is one. `scratch` holds nothing but zeroes, and is
/// left so where nothing is found, as where it is too small.
pub(super) fn find<I: Iterator<Item = usize>>(
    scratch: &mut [u64],
    places: usize,
    from: usize,
    beside: impl Fn(usize) -> I,
    is_goal: impl Fn(usize) -> bool,
) -> bool {
    if scratch.len() < words(places) || places >= usize::from(u16::MAX) || from >= places {
        return false;
    }
    set(scratch, from, Some(from));
    set(scratch, places, Some(from));
    let (mut taken, mut met) = (0_usize, 1_usize);
    while let Some(place) = if taken < met { get(scratch, places.wrapping_add(taken)) } else { None } {
        taken = taken.wrapping_add(1);
        if is_goal(place) {
            turn_round(scratch, from, place);
            return true;
        }
        for next in beside(place) {
            if next < places && get(scratch, next).is_none() {
                set(scratch, next, Some(place));
                set(scratch, places.wrapping_add(met), Some(next));
                met = met.wrapping_add(1);
            }
        }
    }
    clear(scratch, places);
    false
}

/// Each place of the way points to the next, no longer to the one before.
fn turn_round(scratch: &mut [u64], from: usize, to: usize) {
    let (mut place, mut after) = (to, None);
    while let Some(before) = get(scratch, place) {
        set(scratch, place, after);
        if place == from {
            return;
        }
        (after, place) = (Some(place), before);
    }
}

/// The next place on the way that was found.
pub(super) fn next(scratch: &[u64], place: usize) -> Option<usize> {
    get(scratch, place)
}

/// The places on the way that was found.
pub(super) fn places(scratch: &[u64], from: usize) -> impl Iterator<Item = usize> {
    core::iter::successors(Some(from), |&place| next(scratch, place))
}

/// Leaves nothing but zeroes.
pub(super) fn clear(scratch: &mut [u64], places: usize) {
    scratch.get_mut(..words(places)).unwrap_or(&mut []).fill(0);
}
