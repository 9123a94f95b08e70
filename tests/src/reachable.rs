//! The states that can be reached.

use goodbot::oomdp::{Action, Domain};
use std::collections::BTreeMap;

/// Every state reachable from the start, by its number.
pub fn reachable<D: Domain>(domain: &D, start: &D::State) -> BTreeMap<u64, D::State> {
    let mut found = BTreeMap::from([(domain.number(start), *start)]);
    let mut open = vec![*start];
    while let Some(state) = open.pop() {
        for action in (0..domain.actions().len()).map(|position| Action::new(position as u8)) {
            let Some(next) = domain.step(&state, action) else { continue };
            if found.insert(domain.number(&next), next).is_none() {
                open.push(next);
            }
        }
    }
    found
}
