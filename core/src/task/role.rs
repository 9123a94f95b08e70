//! Roles: the part of an object in a task, and its marker in a [description](super::description).
//!
//! Roles follow from the schema alone. For a task `blockInRoom(?o, ?r)` of a home they are the block to move, its target room, its room at
//! the start, the room of the robot, the other rooms and the other blocks.

use super::way::Part;
use crate::oomdp::{ClassId, PropositionId};
use crate::symbols::Symbol;
use core::fmt;
use core::str::FromStr;

/// The part of an object in a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RoleKind {
    /// The last argument of a goal proposition: the target place.
    Goal,
    /// Another argument of a goal proposition: the thing to bring there.
    Subject,
    /// The last argument of a proposition that holds of an object of the task at the start: the present place of that object.
    Start,
    /// Another object, of the class of a proposition's last argument.
    OtherPlace,
    /// Any other object.
    Other,
    /// An argument of a proposition that a way goes through.
    Through,
    /// An argument of a proposition that a way avoids.
    Avoiding,
    /// An argument of an earlier goal.
    Before,
}

impl RoleKind {
    /// The number of kinds.
    pub const COUNT: usize = if cfg!(feature = "ways") { 8 } else { Self::WITHOUT_WAYS };
    /// The number of kinds if no task has a way: they are the first ones.
    pub(crate) const WITHOUT_WAYS: usize = 5;
    const ALL: [Self; 8] =
        [Self::Goal, Self::Subject, Self::Start, Self::OtherPlace, Self::Other, Self::Through, Self::Avoiding, Self::Before];

    /// The kind of the objects in a part of a task.
    pub(crate) const fn of_part(part: Part) -> Self {
        match part {
            Part::Goal => Self::Goal,
            Part::Before(_) => Self::Before,
            Part::Through(_) => Self::Through,
            Part::Avoiding => Self::Avoiding,
        }
    }

    /// Its position among the kinds.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Whether such objects are part of the task itself; the others are its context.
    pub const fn is_of_task(self) -> bool {
        matches!(self, Self::Goal | Self::Subject | Self::Through | Self::Avoiding | Self::Before)
    }

    /// Whether such objects are neither part of the task nor places of its objects.
    pub(crate) const fn is_of_others(self) -> bool {
        matches!(self, Self::OtherPlace | Self::Other)
    }
}

/// A role: its kind, and its proposition and argument, or its class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Role(u16);

const ARGUMENT_BITS: u32 = 2;
const ABOUT_BITS: u32 = 6;
/// The argument number of a proposition's name: no proposition has this many arguments.
const NAME: usize = (1 << ARGUMENT_BITS) - 1;
const ABOUT: u16 = (1 << ABOUT_BITS) - 1;

impl Role {
    /// The value of unused memory.
    pub(crate) const UNUSED: Self = Self(0);

    /// The role of an argument of a proposition.
    pub const fn of_argument(kind: RoleKind, proposition: PropositionId, argument: usize) -> Self {
        Self::new(kind, proposition.0 as u16, argument)
    }

    /// The role of the words in a proposition's name, if tasks are named to the robot by them.
    pub const fn of_name(proposition: PropositionId) -> Self {
        Self::new(RoleKind::Subject, proposition.0 as u16, NAME)
    }

    /// Whether the values of the role are the words in a proposition's name.
    #[cfg(feature = "alloc")]
    pub(crate) fn is_of_name(self) -> bool {
        self.kind() == RoleKind::Subject && self.argument() == NAME
    }

    /// The role of the other objects of a class.
    pub const fn of_class(kind: RoleKind, class: ClassId) -> Self {
        Self::new(kind, class.0 as u16, 0)
    }

    const fn new(kind: RoleKind, about: u16, argument: usize) -> Self {
        let about = if about > ABOUT { ABOUT } else { about };
        let argument = if argument > 3 { 3 } else { argument as u16 };
        Self(((kind as u16) << (ABOUT_BITS + ARGUMENT_BITS)) | (about << ARGUMENT_BITS) | argument)
    }

    /// Its kind.
    pub fn kind(self) -> RoleKind {
        let kind = usize::from(self.0 >> (ABOUT_BITS + ARGUMENT_BITS));
        RoleKind::ALL.get(kind).copied().unwrap_or(RoleKind::Other)
    }

    /// The proposition, for the kinds of role that have one.
    pub const fn proposition(self) -> PropositionId {
        PropositionId(((self.0 >> ARGUMENT_BITS) & ABOUT) as u8)
    }

    /// The class, for the kinds of role that have one.
    pub const fn class(self) -> ClassId {
        ClassId(((self.0 >> ARGUMENT_BITS) & ABOUT) as u8)
    }

    /// The argument of the proposition.
    pub const fn argument(self) -> usize {
        (self.0 & ((1 << ARGUMENT_BITS) - 1)) as usize
    }
}

/// The number of sorts of values: each attribute of the object, and each attribute of the objects there.
pub const VALUE_SORTS: usize = 2 * crate::capacity::ATTRIBUTES;

/// The symbol before the values of a role: the role and the sort of the values. Markers are numbered above all symbols with a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Marker {
    /// The role of the values that follow.
    pub role: Role,
    /// Twice the attribute's position, plus one for the values of the objects at a place.
    pub sort: u8,
}

const MARKER: u16 = 0x8000;
const SORT_BITS: u32 = 3;

impl Marker {
    /// The marker as a symbol.
    pub const fn symbol(self) -> Symbol {
        Symbol(MARKER | (self.role.0 << SORT_BITS) | (self.sort as u16 & ((1 << SORT_BITS) - 1)))
    }

    /// The marker of a symbol, if it is a marker.
    pub fn of(symbol: Symbol) -> Option<Self> {
        let code = symbol.0.checked_sub(MARKER)?;
        Some(Self { role: Role(code >> SORT_BITS), sort: (code & ((1 << SORT_BITS) - 1)) as u8 })
    }
}

impl fmt::Display for Marker {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "@{:04x}", self.symbol().0)
    }
}

impl FromStr for Marker {
    type Err = NoMarker;

    fn from_str(text: &str) -> Result<Self, NoMarker> {
        let code = text.strip_prefix('@').and_then(|code| u16::from_str_radix(code, 16).ok()).ok_or(NoMarker)?;
        Self::of(Symbol(code)).ok_or(NoMarker)
    }
}

/// A text is no marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a marker is @ and four hexadecimal digits, 8000 or more")]
pub struct NoMarker;

/// Whether a symbol is a marker: it has no text, and keeps its number when others are forgotten.
pub const fn is_marker(symbol: Symbol) -> bool {
    symbol.0 >= MARKER
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_marker_says_what_it_was_made_of() {
        for kind in RoleKind::ALL {
            let role = Role::of_argument(kind, PropositionId(11), 2);
            let marker = Marker { role, sort: 5 };
            assert_eq!(Marker::of(marker.symbol()), Some(marker));
            assert_eq!("@7fff".parse::<Marker>(), Err(NoMarker));
            assert_eq!((role.kind(), role.proposition(), role.argument()), (kind, PropositionId(11), 2));
            assert!(is_marker(marker.symbol()) && !is_marker(Symbol(32_767)));
        }
    }
}
