//! Machine commands for models with other symbols.

use goodbot::capacity::{Capacity, CapacityError};
use goodbot::oomdp::Domain;
use goodbot::symbols::{Symbol, Symbols, SymbolsRef};
use goodbot::task::description::{Scene, describe};
use goodbot::task::{GroundedTask, LiftedTask, Tokens};

/// The description of a task, which is its machine command for the role model. `token` makes something of each token, of which only a role's
/// marker is the same in all models.
///
/// # Errors
/// A [`CapacityError`] for a task with too many tokens, and the errors of `token`.
pub fn description<D: Domain, T>(
    domain: &D,
    all: &[LiftedTask],
    task: &GroundedTask,
    start: &D::State,
    mut token: impl FnMut(SymbolsRef<'_>, Symbol) -> Result<T, CapacityError>,
) -> Result<Vec<T>, CapacityError> {
    let (mut bytes, mut ends, mut count) = ([0; 2_048], [0; 64], 0);
    let mut tokens = Symbols::new(&mut bytes, &mut ends, &mut count, Capacity::Tokens, Capacity::TokenBytes);
    let mut description = Tokens::new();
    describe(domain, all, task, &mut Scene::new(*start), &mut tokens, &mut description)?;
    description.iter().map(|&symbol| token(tokens.read(), symbol)).collect()
}
