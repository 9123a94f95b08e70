//! The interface to a robot of your own.

#[cfg(feature = "ways")]
use super::ObjectId;
use super::objects::for_each_word;
use super::{ActionSet, GroundProposition, Objects, PushGrid, Schema, SearchKind, StateKey};
use crate::symbols::positions;

positions! {
    /// An action, by its position in [`Domain::actions`].
    Action(u8);
}

impl Action {
    /// Doing nothing: an action of every domain, not listed among its own.
    pub const NOOP: Self = Self(Self::MOST as u8);
    /// The most actions that a domain can have: 15, and 255 with the feature `alloc`.
    pub const MOST: usize = ActionSet::MOST - 1;
    /// The most actions that a domain can have without the feature `alloc`, as on controllers.
    pub const MOST_ON_CONTROLLERS: usize = 15;
}

/// An action of a domain: its name in logs and its cost, 1 to [`MOST_COST`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ActionKind<'a> {
    /// The name.
    pub name: &'a str,
    /// The cost.
    pub cost: u8,
}

impl<'a> ActionKind<'a> {
    /// An action with this name and cost.
    pub const fn new(name: &'a str, cost: u8) -> Self {
        Self { name, cost }
    }
}

/// The largest cost of an action: [`MOST_COST_ON_CONTROLLERS`], and 255 with the feature `alloc`, where each unit of the highest cost takes a
/// bit of each state and time in each step of a search. No action is free: one that undoes another would be on a cheapest way for ever.
pub const MOST_COST: u8 = if cfg!(feature = "alloc") { u8::MAX } else { MOST_COST_ON_CONTROLLERS };
/// The largest cost of an action without the feature `alloc`, as on controllers.
pub const MOST_COST_ON_CONTROLLERS: u8 = 16;

/// The vocabulary and the objects of a domain.
#[derive(Clone, Copy, Debug)]
pub struct World<'a> {
    /// The classes, attributes and propositional functions.
    pub schema: Schema<'a>,
    /// The objects of the environment.
    pub objects: Objects<'a>,
}

/// A robot and its world: an object-oriented MDP with deterministic actions (paper, sections 3 and 4).
///
/// The objects and their attributes do not change as the robot acts; everything that changes is in the state. To bring your own robot:
///
/// 1. name its classes, attributes and propositional functions in a [`Schema`], and its objects in an [`ObjectSet`](super::ObjectSet);
/// 2. choose a state type, and number the states without gaps from 0: [`state_count`](Self::state_count), [`number`](Self::number) and
///    [`numbered`](Self::numbered);
/// 3. define the effects of the actions ([`step`](Self::step)) and the propositions that hold ([`holds`](Self::holds));
/// 4. set `type Search =` [`OneByOne`](super::OneByOne). A robot that moves pieces on a floor of cells can implement
///    [`PushGrid`](super::PushGrid) as well and set [`BitRows`](super::BitRows), which is many times faster;
/// 5. in a test, let [`check`](super::check) verify these rules in every state that the robot can reach;
/// 6. name the tasks that commands may mean: [`LiftedTask::parse`](crate::task::LiftedTask::parse) reads them, such as
///    `cupInPlace(?c, ?p)`. Pass them to [`Agent::new`](crate::Agent::new), and the domain and its state to the agent's other calls.
///
/// An agent distinguishes domains, so that no plan is used in another domain: by their objects with their values, their actions, their
/// number of states and, for a [`PushGrid`](super::PushGrid), the floor. If two domains differ only in [`step`](Self::step) or
/// [`holds`](Self::holds), call [`Agent::leave`](crate::Agent::leave) before you exchange one for the other, or rename one of their
/// objects.
///
/// The folder `examples` has two robots: an arm, and a lift made of tables.
pub trait Domain: Sized {
    /// Everything that changes as the robot acts.
    type State: Copy + PartialEq;

    /// The search that plans for this domain: [`OneByOne`](super::OneByOne) or [`BitRows`](super::BitRows).
    type Search: SearchKind<Self>;

    /// The vocabulary and the objects.
    fn world(&self) -> World<'_>;

    /// The actions, at most [`Action::MOST`], always in the same order. Doing nothing is not listed.
    fn actions(&self) -> &[ActionKind<'_>];

    /// Returns the state that an action leads to, or `None` if the action cannot be done. Bumping into a wall can be done and changes
    /// nothing. It is called only for actions of [`actions`](Self::actions), never for doing nothing.
    fn step(&self, state: &Self::State, action: Action) -> Option<Self::State>;

    /// Returns whether the proposition holds in the state. Its objects are of the classes that the propositional function names, and all
    /// different, unless a lifted task repeats a variable.
    fn holds(&self, proposition: &GroundProposition, state: &Self::State) -> bool;

    /// An upper bound: every number that [`number`](Self::number) returns is below it. [`u64::MAX`] if no bound is known. States beyond the
    /// bound are left out of plans silently: `oomdp::check` finds such a state, and [`Agent::plan`](crate::Agent::plan) refuses to plan
    /// from one.
    fn state_count(&self) -> u64;

    /// Returns the number of a state. Different states have different numbers. Exact plans need memory for every number below
    /// [`state_count`](Self::state_count), so leave few gaps.
    fn number(&self, state: &Self::State) -> u64;

    /// Returns the state with this number. It is called only with numbers that [`number`](Self::number) returned.
    fn numbered(&self, number: u64) -> Self::State;

    /// Returns the state as an agent keeps it: its number. A domain that wraps a home calls the home's own `key`, for a large home has more
    /// states than numbers.
    #[inline]
    fn key(&self, state: &Self::State) -> StateKey {
        StateKey::of(self.number(state))
    }

    /// Returns the state with this key. It is called only with keys that [`key`](Self::key) returned.
    #[inline]
    fn keyed(&self, key: StateKey) -> Self::State {
        self.numbered(key.number())
    }

    /// Calls `tell` with each derived fact of an object in this state, beyond its attributes: single words such as `leftmost` or `largest`.
    /// The role model treats them as values of one more attribute, if the schema has room for one more. A domain need not have any.
    #[cfg(feature = "ways")]
    fn tell_derived(&self, _state: &Self::State, _object: ObjectId, _tell: &mut dyn FnMut(&str)) {}

    /// Whether a task may be about a proposition with these objects, which are of its classes. A domain that knows classes below others has
    /// one class for all of them, and says here which of its objects are of the lower ones.
    #[cfg(feature = "alloc")]
    fn admits(&self, _proposition: &GroundProposition) -> bool {
        true
    }
}

/// The cost of an action, at least 1; 1 for an action that the domain does not have.
pub(crate) fn cost<D: Domain>(domain: &D, action: Action) -> u8 {
    domain.actions().get(usize::from(action.0)).map_or(1, |kind| kind.cost.clamp(1, MOST_COST))
}

/// The domain's own actions, in order.
pub(crate) fn own_actions<D: Domain>(domain: &D) -> impl Iterator<Item = Action> + use<D> {
    (0..domain.actions().len().min(Action::MOST)).map(|position| Action(position as u8))
}

/// A digest of a domain: its objects, its actions, the number of its states and, for a [`PushGrid`], its floor. It identifies the domain of
/// plans and sessions. It is computed at every call, so it costs one multiplication for each word.
pub(crate) fn digest<D: Domain>(domain: &D) -> u32 {
    let mut digest = 0_u32;
    let mut take = |word: u32| digest = (digest.rotate_left(5) ^ word).wrapping_mul(0x9e37_79b1);
    domain.world().objects.for_each_word(&mut take);
    for kind in domain.actions() {
        for_each_word(kind.name.as_bytes(), &mut take);
        take(u32::from(kind.cost));
    }
    let states = domain.state_count();
    take(states as u32);
    take((states >> 32) as u32);
    if let Some(grid) = D::Search::grid(domain) {
        for cell in grid.floor().cells {
            // The neighbours of a cell follow from the coordinates.
            let place = u32::from(cell.x.cast_unsigned()) << 16 | u32::from(cell.y.cast_unsigned());
            take(place ^ u32::from(cell.region).rotate_right(5));
        }
        take(grid.floor().directions.iter().fold(grid.pieces() as u32, |word, direction| word << 4 ^ u32::from(direction.0)));
    }
    digest
}

/// The name of an action of a domain, `noop` included.
pub fn action_name<D: Domain>(domain: &D, action: Action) -> &str {
    if action == Action::NOOP { "noop" } else { domain.actions().get(usize::from(action.0)).map_or("", |kind| kind.name) }
}

/// The action with this name, `noop` included.
pub fn action_named<D: Domain>(domain: &D, name: &str) -> Option<Action> {
    if name == "noop" {
        return Some(Action::NOOP);
    }
    domain.actions().iter().take(Action::MOST).position(|kind| kind.name == name).map(|position| Action(position as u8))
}

/// The state that an action leads to, `noop` included; `None` for an action that the domain does not have.
pub fn apply<D: Domain>(domain: &D, state: &D::State, action: Action) -> Option<D::State> {
    match action {
        Action::NOOP => Some(*state),
        _ if action.index() < domain.actions().len() => domain.step(state, action),
        _ => None,
    }
}
