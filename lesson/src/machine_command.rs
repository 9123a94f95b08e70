//! Machine commands as texts, for models with other symbols.

use goodbot::capacity::{Capacity, CapacityError};
use goodbot::language::LanguageModel;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::Domain;
use goodbot::symbols::{Symbol, Symbols, SymbolsRef};
use goodbot::task::description::{Scene, describe};
use goodbot::task::{GroundedTask, LiftedTask, Marker, Tokens};

/// A machine command: its tokens.
pub type MachineCommand = Vec<String>;

/// The description of a task, which is its machine command for the role model.
///
/// # Errors
/// A [`CapacityError`] for a task with too many tokens.
pub fn description<D: Domain>(
    domain: &D,
    all: &[LiftedTask],
    task: &GroundedTask,
    start: &D::State,
) -> Result<MachineCommand, CapacityError> {
    let (mut bytes, mut ends, mut count) = ([0; 2_048], [0; 64], 0);
    let mut tokens = Symbols::new(&mut bytes, &mut ends, &mut count, Capacity::Tokens, Capacity::TokenBytes);
    let mut description = Tokens::new();
    describe(domain, all, task, &mut Scene::new(*start), &mut tokens, &mut description)?;
    Ok(description.iter().map(|&token| token_text(tokens.read(), token)).collect())
}

/// The text of a machine token; a role's marker is `@` and its number.
pub fn token_text(tokens: SymbolsRef<'_>, token: Symbol) -> String {
    Marker::of(token).map_or_else(|| tokens.text(token).to_owned(), |marker| marker.to_string())
}

/// The symbol of a machine token in a model.
///
/// # Errors
/// A [`CapacityError`] if the model has no room for it.
pub fn symbol(model: &mut LanguageModel<impl AgentMemory>, token: &str) -> Result<Symbol, CapacityError> {
    match token.parse::<Marker>() {
        Ok(marker) => Ok(marker.symbol()),
        Err(_) => model.tokens_mut().intern(token),
    }
}

/// The symbols of a machine command in a model.
///
/// # Errors
/// As [`symbol`].
pub fn symbols(model: &mut LanguageModel<impl AgentMemory>, command: &MachineCommand) -> Result<Vec<Symbol>, CapacityError> {
    command.iter().map(|token| symbol(model, token)).collect()
}
