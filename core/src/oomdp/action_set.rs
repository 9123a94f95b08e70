//! Sets of actions: 16 bits on a controller, and four words with the feature `alloc`.
//!
//! Doing nothing is the last bit of either, so the order of the actions is the same in both.

use super::Action;
#[cfg(not(feature = "alloc"))]
use narrow as width;
#[cfg(feature = "alloc")]
use wide as width;

/// The bits of a controller.
#[cfg(any(test, not(feature = "alloc")))]
mod narrow {
    pub type Bits = u16;
    pub const MOST: usize = 16;
    pub const NONE: Bits = 0;

    pub const fn one(action: u8) -> Bits {
        if action as usize >= MOST { NONE } else { 1 << action }
    }

    pub const fn either(bits: Bits, other: Bits) -> Bits {
        bits | other
    }

    /// The bits with one more, perhaps, without a branch.
    pub fn with_if(bits: Bits, action: usize, there: bool) -> Bits {
        bits | u16::from(there) << action
    }

    pub const fn has(bits: Bits, action: usize) -> bool {
        bits >> action & 1 == 1
    }

    pub const fn both(bits: Bits, other: Bits) -> Bits {
        bits & other
    }

    #[cfg(any(test, feature = "learning"))]
    pub const fn without(bits: Bits, other: Bits) -> Bits {
        bits & !other
    }

    pub const fn len(bits: Bits) -> usize {
        bits.count_ones() as usize
    }

    pub const fn is_none(bits: Bits) -> bool {
        bits == NONE
    }

    /// Takes out the first bit.
    pub fn take_first(bits: &mut Bits) -> Option<u8> {
        let next = bits.trailing_zeros();
        *bits &= bits.wrapping_sub(1);
        ((next as usize) < MOST).then_some(next as u8)
    }

    pub const fn of_first_16(bits: u16) -> Bits {
        bits
    }

    #[cfg(any(test, feature = "bounds"))]
    pub const fn first_16(bits: Bits) -> u16 {
        bits
    }

    /// The bits with these first bytes, of which there are `count`, and zeros.
    pub fn of_bytes(count: usize, byte: impl Fn(usize) -> u8) -> Bits {
        let high = if count > 1 { byte(1) } else { 0 };
        u16::from_le_bytes([byte(0), high])
    }

    pub fn bytes(bits: Bits) -> impl Iterator<Item = u8> {
        bits.to_le_bytes().into_iter()
    }
}

/// The bits of a host.
#[cfg(feature = "alloc")]
mod wide {
    pub type Bits = [u64; 4];
    pub const MOST: usize = 256;
    pub const NONE: Bits = [0; 4];

    pub const fn one(action: u8) -> Bits {
        let bit = 1_u64 << (action % 64);
        match action / 64 {
            0 => [bit, 0, 0, 0],
            1 => [0, bit, 0, 0],
            2 => [0, 0, bit, 0],
            _ => [0, 0, 0, bit],
        }
    }

    pub const fn either([a, b, c, d]: Bits, [e, f, g, h]: Bits) -> Bits {
        [a | e, b | f, c | g, d | h]
    }

    pub const fn with_if(bits: Bits, action: usize, there: bool) -> Bits {
        if there { either(bits, one(action as u8)) } else { bits }
    }

    pub const fn has(bits: Bits, action: usize) -> bool {
        !is_none(both(bits, one(action as u8)))
    }

    pub const fn both([a, b, c, d]: Bits, [e, f, g, h]: Bits) -> Bits {
        [a & e, b & f, c & g, d & h]
    }

    #[cfg(any(test, feature = "learning"))]
    pub const fn without([a, b, c, d]: Bits, [e, f, g, h]: Bits) -> Bits {
        [a & !e, b & !f, c & !g, d & !h]
    }

    pub const fn len([a, b, c, d]: Bits) -> usize {
        (a.count_ones() as usize)
            .wrapping_add(b.count_ones() as usize)
            .wrapping_add(c.count_ones() as usize)
            .wrapping_add(d.count_ones() as usize)
    }

    pub const fn is_none([a, b, c, d]: Bits) -> bool {
        a | b | c | d == 0
    }

    /// Takes out the first bit.
    pub fn take_first(bits: &mut Bits) -> Option<u8> {
        let (at, word) = bits.iter_mut().enumerate().find(|(_, word)| **word != 0)?;
        let next = word.trailing_zeros() as usize;
        *word &= word.wrapping_sub(1);
        Some(at.wrapping_mul(64).wrapping_add(next) as u8)
    }

    pub const fn of_first_16(bits: u16) -> Bits {
        [bits as u64, 0, 0, 0]
    }

    #[cfg(any(test, feature = "bounds"))]
    pub const fn first_16([first, ..]: Bits) -> u16 {
        first as u16
    }

    /// The bits with these first bytes, of which there are `count`, and zeros.
    pub fn of_bytes(count: usize, byte: impl Fn(usize) -> u8) -> Bits {
        let mut bits = NONE;
        for at in 0..count {
            if let Some(word) = bits.get_mut(at / 8) {
                *word |= u64::from(byte(at)) << (at % 8 * 8);
            }
        }
        bits
    }

    pub fn bytes(bits: Bits) -> impl Iterator<Item = u8> {
        bits.into_iter().flat_map(u64::to_le_bytes)
    }
}

/// A set of actions, one bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ActionSet(width::Bits);

impl ActionSet {
    /// The most actions of a set, doing nothing included.
    pub(crate) const MOST: usize = width::MOST;
    /// No action.
    pub const EMPTY: Self = Self(width::NONE);
    /// Only doing nothing.
    pub const NOOP: Self = Self::of(Action::NOOP);

    /// The set of one action; empty for an action that no domain can have.
    pub const fn of(action: Action) -> Self {
        Self(width::one(action.0))
    }

    /// Whether the set has this action.
    pub const fn contains(self, action: Action) -> bool {
        !width::is_none(width::both(self.0, Self::of(action).0))
    }

    /// The actions of either set.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(width::either(self.0, other.0))
    }

    /// The set with one action more.
    #[must_use]
    pub const fn with(self, action: Action) -> Self {
        self.union(Self::of(action))
    }

    /// Whether the set has the action at this position among those of a domain.
    #[inline]
    pub(crate) const fn has(self, action: usize) -> bool {
        width::has(self.0, action)
    }

    /// The set, with one action more if `there` says so.
    #[inline]
    pub(crate) fn with_if(self, action: usize, there: bool) -> Self {
        Self(width::with_if(self.0, action, there))
    }

    /// The actions that are not in `other`.
    #[cfg(feature = "learning")]
    pub(crate) const fn without(self, other: Self) -> Self {
        Self(width::without(self.0, other.0))
    }

    /// Whether the set is empty.
    pub const fn is_empty(self) -> bool {
        width::is_none(self.0)
    }

    /// The number of actions.
    pub const fn len(self) -> usize {
        width::len(self.0)
    }

    /// The actions, in order; doing nothing comes last.
    pub fn iter(self) -> impl Iterator<Item = Action> {
        let mut rest = self.0;
        core::iter::from_fn(move || width::take_first(&mut rest).map(Action))
    }

    /// The set of some of the first 16 actions, one bit each.
    pub(crate) const fn of_first_16(bits: u16) -> Self {
        Self(width::of_first_16(bits))
    }

    /// A bit for each of the first 16 actions.
    #[cfg(feature = "bounds")]
    pub(crate) const fn first_16(self) -> u16 {
        width::first_16(self.0)
    }

    /// The set of some of the first actions, eight in each of `count` bytes.
    #[inline]
    pub(crate) fn of_bytes(count: usize, byte: impl Fn(usize) -> u8) -> Self {
        Self(width::of_bytes(count, byte))
    }

    /// A bit for each action, eight to a byte.
    #[inline]
    pub(crate) fn bytes(self) -> impl Iterator<Item = u8> {
        width::bytes(self.0)
    }
}

impl FromIterator<Action> for ActionSet {
    fn from_iter<I: IntoIterator<Item = Action>>(actions: I) -> Self {
        actions.into_iter().fold(Self::EMPTY, Self::with)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// The same behaviour of either width.
    macro_rules! every_action_has_a_bit {
        ($width:ident) => {
            let all = (0..=u8::MAX).map($width::one).fold($width::NONE, $width::either);
            assert_eq!($width::len(all), $width::MOST);
            for action in 0..$width::MOST {
                assert!(!$width::has($width::NONE, action) && $width::has($width::one(action as u8), action));
                assert_eq!($width::with_if($width::NONE, action, false), $width::NONE);
                assert_eq!($width::with_if($width::NONE, action, true), $width::one(action as u8));
            }
            for action in 0..=u8::MAX {
                let one = $width::one(action);
                assert_eq!($width::is_none(one), usize::from(action) >= $width::MOST);
                assert_eq!($width::both(all, one), one);
                assert_eq!($width::len($width::without(all, one)), $width::MOST - $width::len(one));
                assert_eq!($width::take_first(&mut one.clone()), Some(action).filter(|&it| usize::from(it) < $width::MOST));
                let bytes = Vec::from_iter($width::bytes(one));
                assert_eq!(bytes.len(), $width::MOST / 8);
                assert_eq!($width::of_bytes(bytes.len(), |at| bytes[at]), one);
                assert_eq!($width::of_first_16($width::first_16(one)), if action < 16 { one } else { $width::NONE });
            }
            let mut rest = all;
            assert!(core::iter::from_fn(|| $width::take_first(&mut rest)).eq((0..$width::MOST).map(|action| action as u8)));
            assert_eq!($width::of_bytes(1, |_| 0xa5), $width::of_first_16(0xa5));
        };
    }

    #[test]
    fn sets_of_controllers_and_of_hosts_hold_every_action_that_there_can_be() {
        every_action_has_a_bit!(narrow);
        #[cfg(feature = "alloc")]
        {
            every_action_has_a_bit!(wide);
        }
    }

    #[test]
    fn doing_nothing_comes_after_all_other_actions() {
        let own = (0..Action::MOST).map(|position| Action(position as u8));
        let all: ActionSet = core::iter::once(Action::NOOP).chain(own.clone()).collect();
        assert!(all.iter().eq(own.chain([Action::NOOP])));
        assert_eq!(all.len(), Action::MOST + 1);
        assert!(ActionSet::NOOP.contains(Action::NOOP) && !ActionSet::EMPTY.contains(Action::NOOP));
    }
}
