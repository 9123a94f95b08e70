//! A task about a thing that is not here.

use crate::capacity::TOKENS_PER_COMMAND;
use crate::language::LanguageRef;
use crate::symbols::Symbol;
use crate::task::description::groups;
use crate::task::machine_command::Tokens;
use crate::task::role::RoleKind;
use heapless::Vec;

/// The number of values that are kept. A controller has fewer words, and little stack.
const MOST_VALUES: usize = if cfg!(feature = "alloc") { 4 * TOKENS_PER_COMMAND } else { TOKENS_PER_COMMAND };

/// The values that lessons spoke of, each with its sort, in the order in which lessons had them.
pub(super) struct Spoken {
    values: Vec<(u8, Symbol), MOST_VALUES>,
    /// Whether they are all; otherwise lessons are searched each time.
    are_all: bool,
}

impl Spoken {
    pub fn of(language: LanguageRef<'_>) -> Self {
        let mut values = Vec::new();
        let mut add = |value| if values.contains(&value) { Some(()) } else { values.push(value).ok() };
        let are_all = each_value(language, &mut add).is_some();
        Self { values, are_all }
    }

    /// Passes the values of a sort, perhaps several times, until one is refused.
    fn each_of(&self, language: LanguageRef<'_>, sort: u8, take: &mut dyn FnMut(Symbol) -> Option<()>) -> Option<()> {
        let mut take_own = |(of, value)| if of == sort { take(value) } else { Some(()) };
        if self.are_all { self.values.iter().copied().try_for_each(take_own) } else { each_value(language, &mut take_own) }
    }
}

fn each_value(language: LanguageRef<'_>, take: &mut dyn FnMut((u8, Symbol)) -> Option<()>) -> Option<()> {
    let (bitext, layout) = (language.bitext(), language.tables().layout());
    for group in (0..bitext.commands() as u16).flat_map(|command| groups(bitext.command(command))) {
        group.values.iter().filter(|value| !layout.forms().contains(value)).try_for_each(|&value| take((group.marker.sort, value)))?;
    }
    Some(())
}

/// The description of a task about a thing that is not here. The object in this role gets all values of its sorts that lessons spoke of,
/// for a goal only those that no place here has, and one value that nobody has named. `None` if no object has this role.
pub(super) fn with_ghost(description: &[Symbol], kind: RoleKind, language: LanguageRef<'_>, spoken: &Spoken) -> Option<Tokens> {
    let mut ghost = Tokens::new();
    let (mut found, unnamed) = (false, Symbol(language.tables().layout().tokens() as u16));
    ghost.push(*description.first()?).ok()?;
    for group in groups(description) {
        let marker = *description.get(group.first.checked_sub(1)?)?;
        if group.marker.role.kind() != kind {
            ghost.push(marker).ok()?;
            ghost.extend_from_slice(group.values).ok()?;
            continue;
        }
        if group.marker.sort & 1 == 1 {
            continue;
        }
        found = true;
        ghost.push(marker).ok()?;
        // The values of this sort in lessons; for a place, those that no place here has.
        let is_here = |value: Symbol| {
            kind == RoleKind::Goal
                && groups(description).any(|other| {
                    other.marker.sort == group.marker.sort
                        && matches!(other.marker.role.kind(), RoleKind::Goal | RoleKind::Start | RoleKind::OtherPlace)
                        && other.values.contains(&value)
                })
        };
        let first = ghost.len();
        spoken.each_of(language, group.marker.sort, &mut |value| {
            let is_known = is_here(value) || ghost.get(first..).is_some_and(|values| values.contains(&value));
            if is_known { Some(()) } else { ghost.push(value).ok() }
        })?;
        ghost.push(unnamed).ok()?;
    }
    found.then_some(ghost)
}
