//! The seam: what a robot brings of its own.

use super::{Grid, GroundProposition, ObjectSet, Schema};

/// An action, by its position in [`Domain::actions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Action(pub u8);

impl Action {
    /// Doing nothing: an action of every domain, not listed among its own.
    pub const NOOP: Self = Self(15);
    /// How many actions of its own a domain can have.
    pub const MOST: usize = 15;
}

/// A set of actions, one bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ActionSet(pub u16);

impl ActionSet {
    /// No action.
    pub const EMPTY: Self = Self(0);
    /// Only doing nothing.
    pub const NOOP: Self = Self::of(Action::NOOP);

    /// The set of one action; empty for an action that no domain can have.
    pub const fn of(action: Action) -> Self {
        if action.0 > Action::NOOP.0 { Self::EMPTY } else { Self(1 << action.0) }
    }

    /// Whether the set has this action.
    pub const fn contains(self, action: Action) -> bool {
        self.0 & Self::of(action).0 != 0
    }

    /// The actions of both.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The set with one action more.
    #[must_use]
    pub const fn with(self, action: Action) -> Self {
        self.union(Self::of(action))
    }

    /// Whether there is none.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// How many there are.
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// The actions, in order.
    pub fn iter(self) -> impl Iterator<Item = Action> {
        let mut rest = self.0;
        core::iter::from_fn(move || {
            let next = rest.trailing_zeros();
            rest &= rest.wrapping_sub(1);
            (next < 16).then_some(Action(next as u8))
        })
    }
}

/// An action of a domain: its name in logs and its cost, 1 to [`MOST_COST`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActionKind<'a> {
    /// The name.
    pub name: &'a str,
    /// The cost.
    pub cost: u8,
}

/// The largest cost of an action.
pub const MOST_COST: u8 = 16;

/// A robot and its world: an object-oriented MDP with deterministic actions (paper, sections 3 and 4).
///
/// The objects and their attributes do not change as the robot acts; the state says where everything is. States are numbered without
/// gaps where that is possible: the search keeps its marks in plain arrays by that number, and only hashes where the numbers run higher
/// than its memory.
///
/// `examples/turning_robot` brings a second robot by this trait.
pub trait Domain {
    /// All that changes as the robot acts.
    type State: Copy + PartialEq;

    /// The classes, attributes and propositional functions.
    fn schema(&self) -> Schema<'_>;

    /// The objects of the environment.
    fn objects(&self) -> &ObjectSet<'_>;

    /// The actions, at most [`Action::MOST`], in an order that stays. Doing nothing is not among them.
    fn actions(&self) -> &[ActionKind<'_>];

    /// The state that an action leads to, `None` where the action cannot be done. Bumping into a wall can be done and changes nothing.
    fn step(&self, state: &Self::State, action: Action) -> Option<Self::State>;

    /// Whether the proposition holds.
    fn holds(&self, proposition: &GroundProposition, state: &Self::State) -> bool;

    /// Above every number that [`number`](Self::number) gives. [`u64::MAX`] where that is not known.
    fn state_count(&self) -> u64;

    /// The number of a state; different states have different numbers.
    fn number(&self, state: &Self::State) -> u64;

    /// The state with this number. Only asked for numbers that [`number`](Self::number) gave.
    fn numbered(&self, number: u64) -> Self::State;

    /// The number of the state that an action leads to; `number` is that of `state`. A domain that can tell it by the difference, without
    /// making the state, is searched faster. `None` where the action cannot be done.
    fn number_after(&self, state: &Self::State, _number: u64, action: Action) -> Option<u64> {
        self.step(state, action).map(|next| self.number(&next))
    }

    /// How many variables make up the state, if the domain wants to say: 0 is always correct. A domain whose propositions each read one
    /// variable (where the agent is, where a block is) makes goal tests cost the same however many tasks there are.
    fn variables(&self) -> usize {
        0
    }

    /// How many values a variable has.
    fn values(&self, _variable: usize) -> usize {
        0
    }

    /// The value of a variable in a state.
    fn value(&self, _state: &Self::State, _variable: usize) -> usize {
        0
    }

    /// The state with one variable set to a value, which need not be a state that can be reached.
    fn with_value(&self, state: &Self::State, _variable: usize, _value: usize) -> Self::State {
        *state
    }

    /// The variable that a proposition reads, where it reads only one.
    fn reads(&self, _proposition: &GroundProposition) -> Option<usize> {
        None
    }

    /// Whether a variable keeps its value until the robot acts on it: where a block is, not where the robot is. In a home too large for
    /// exact plans, such a variable is taken to stand still in the plans of tasks that do not read it.
    fn stands_still(&self, _variable: usize) -> bool {
        false
    }

    /// How the robot's places lie in a grid, if they do: `None` is always correct, and makes the search look at states one by one.
    ///
    /// A domain that gives one says this: variable 0 is the robot's place, and the number of a state is its place plus
    /// [`values(0)`](Self::values) times a number of all else, the row. Every action costs 1. A direction of the grid leads to the
    /// neighbour cell of the same row where that is free and not [`taken`](Self::taken), and does nothing where it is not free; the other
    /// actions do nothing where no neighbour cell is taken. What a direction does toward a taken cell, and another action beside one, is
    /// asked of [`number_after`](Self::number_after).
    fn grid(&self) -> Option<Grid> {
        None
    }

    /// A state of a row, with the robot at any place.
    fn row(&self, row: u64) -> Self::State {
        self.numbered(row.wrapping_mul(self.values(0) as u64))
    }

    /// The bit of a place, in a row of the grid: larger for larger places.
    fn bit_of(&self, _place: usize) -> usize {
        0
    }

    /// Whether the robot can ever be at a place, or act on what is there.
    fn is_free(&self, _place: usize) -> bool {
        true
    }

    /// The place that a variable other than the first takes, so that the robot can go there only by acting on it.
    fn taken(&self, _state: &Self::State, _variable: usize) -> Option<usize> {
        None
    }

    /// How many values a variable that [stands still](Self::stands_still) can take on after a value by one action, if the domain wants to
    /// say: 0 is always correct, and makes dead ends take longer to find.
    fn ways_on(&self) -> usize {
        0
    }

    /// A value that a variable can take on after `value` by one action, for each `way` below [`ways_on`](Self::ways_on). All that it can
    /// take on in any state must be among them; others do no harm.
    fn way_on(&self, _variable: usize, _value: usize, _way: usize) -> Option<usize> {
        None
    }

    /// How many regions the places make up, rooms and doors say, at most 32: 0 is always correct. A domain that gives some is planned for
    /// region by region where the memory cannot hold even the robot and the blocks of a task.
    ///
    /// The domain then says this: the values of variable 0, the robot's place, and of all variables that
    /// [stand still](Self::stands_still) are the same places, and there is no other variable. [`way_on`](Self::way_on) says which places lie
    /// side by side, for variable 0 too, with the same `way` in the same direction for all.
    fn regions(&self) -> usize {
        0
    }

    /// How many places a region has; a bound does.
    fn region_size(&self, _region: usize) -> usize {
        0
    }

    /// The region of a place, and the position of the place in it, less than the region's size.
    fn region_of(&self, _place: usize) -> Option<(usize, usize)> {
        None
    }

    /// The place at a position of a region.
    fn place_in(&self, _region: usize, _position: usize) -> Option<usize> {
        None
    }

    /// How many states at most lead to one state by one action, if the domain wants to say: 0 is always correct, and makes the sweep
    /// slower.
    fn ways_in(&self) -> usize {
        0
    }

    /// A state from which an action may lead to `state`, for each `way` below [`ways_in`](Self::ways_in). All states from which one does
    /// must be among them; others do no harm.
    fn way_in(&self, _state: &Self::State, _way: usize) -> Option<Self::State> {
        None
    }
}

/// The name of an action of a domain, `noop` included.
pub fn action_name<D: Domain + ?Sized>(domain: &D, action: Action) -> &str {
    if action == Action::NOOP { "noop" } else { domain.actions().get(usize::from(action.0)).map_or("", |kind| kind.name) }
}

/// The action with this name, `noop` included.
pub fn action_named<D: Domain + ?Sized>(domain: &D, name: &str) -> Option<Action> {
    if name == "noop" {
        return Some(Action::NOOP);
    }
    domain.actions().iter().take(Action::MOST).position(|kind| kind.name == name).map(|position| Action(position as u8))
}

/// What an action leads to, `noop` included.
pub fn apply<D: Domain + ?Sized>(domain: &D, state: &D::State, action: Action) -> Option<D::State> {
    if action == Action::NOOP { Some(*state) } else { domain.step(state, action) }
}
