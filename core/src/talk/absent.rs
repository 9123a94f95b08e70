//! A task about a thing that is not here.

use crate::language::bitext::BitextRef;
use crate::symbols::Symbol;
use crate::task::description::groups;
use crate::task::machine_command::Tokens;
use crate::task::role::RoleKind;

/// The description of a task about a thing that is not here. The object in this role gets all values of its sorts that lessons spoke of,
/// for a goal only those that no place here has, and one value that nobody has named. `None` if no object has this role.
pub(super) fn with_ghost(
    description: &[Symbol],
    kind: RoleKind,
    tokens: usize,
    bitext: BitextRef<'_>,
    is_form: &dyn Fn(Symbol) -> bool,
) -> Option<Tokens> {
    let mut ghost = Tokens::new();
    let (mut found, unnamed) = (false, Symbol(tokens as u16));
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
        for command in 0..bitext.commands() as u16 {
            for other in groups(bitext.command(command)).filter(|other| other.marker.sort == group.marker.sort) {
                for &value in other.values.iter().filter(|&&value| !is_form(value) && !is_here(value)) {
                    if !ghost.get(first..).is_some_and(|values| values.contains(&value)) {
                        ghost.push(value).ok()?;
                    }
                }
            }
        }
        ghost.push(unnamed).ok()?;
    }
    found.then_some(ghost)
}
