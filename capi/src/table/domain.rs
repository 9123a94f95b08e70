//! The caller's robot as the core sees it.

use super::description::{GOODBOT_CANNOT, GOODBOT_MOST_DERIVED, GoodbotDerived, GoodbotHolds, GoodbotStep};
use crate::robot::text;
use crate::status::GoodbotStatus;
use core::ffi::c_void;
use goodbot::Capacities;
use goodbot::memory::HomeTables;
#[cfg(feature = "ways")]
use goodbot::oomdp::ObjectId;
use goodbot::oomdp::{
    Action, ActionKind, Attribute, Class, Domain, GroundProposition, ObjectCount, Objects, OneByOne, Proposition, Schema, World,
};

/// How the next state is found.
#[derive(Clone, Copy, Debug)]
pub(super) enum Steps {
    /// By a table: one entry for each state and action.
    Table(&'static [u16]),
    /// By a function.
    Function(GoodbotStep),
}

/// The next state by the caller's function; `None` if the action cannot be done.
pub(super) fn next_by(
    step: unsafe extern "C" fn(*mut c_void, u32, u8, *mut u32) -> bool,
    context: *mut c_void,
    state: u32,
    action: u8,
) -> Option<u32> {
    let mut next = 0;
    // SAFETY: the caller's function, with the context that came with it.
    let can = unsafe { step(context, state, action, &raw mut next) };
    can.then_some(next)
}

/// The derived facts about an object by the caller's function: up to one more than is allowed, so that it can be refused.
pub(super) fn derived_by<'a>(
    derived: GoodbotDerived,
    context: *mut c_void,
    state: u32,
    object: u8,
) -> impl Iterator<Item = Result<&'a str, GoodbotStatus>> {
    // SAFETY: the caller's function, with the context that came with it.
    let said = move |number| derived.map_or(core::ptr::null(), |derived| unsafe { derived(context, state, object, number) });
    // SAFETY: the caller's promise: each text stays until the next is asked for.
    (0..=GOODBOT_MOST_DERIVED).map(said).take_while(|said| !said.is_null()).map(|said| unsafe { text(said) })
}

/// The caller's robot.
#[derive(Debug)]
pub struct TableDomain {
    pub(super) schema: Schema<'static>,
    pub(super) memory: HomeTables<'static>,
    pub(super) objects: ObjectCount,
    pub(super) actions: &'static [ActionKind<'static>],
    pub(super) steps: Steps,
    pub(super) holds: GoodbotHolds,
    #[cfg_attr(not(feature = "ways"), allow(dead_code, reason = "nothing is told of objects without the feature"))]
    pub(super) derived: GoodbotDerived,
    pub(super) context: *mut c_void,
    pub(super) states: u32,
}

impl TableDomain {
    /// How many states there are.
    pub fn states(&self) -> u32 {
        self.states
    }

    /// How full the tables of objects and names are.
    pub fn usage(&self) -> Capacities {
        let mut used = Capacities::NONE;
        self.world().objects.usage(&mut used);
        used
    }
}

/// The parts of a schema, while it is being made.
pub(super) type Parts = (&'static [Class<'static>], &'static [Attribute<'static>], &'static [Proposition<'static>]);

impl Domain for TableDomain {
    type State = u32;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        World { schema: self.schema, objects: Objects::new(self.memory.read().objects, self.objects) }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        self.actions
    }

    fn step(&self, state: &u32, action: Action) -> Option<u32> {
        if action.index() >= self.actions.len() {
            return None;
        }
        let next = match self.steps {
            Steps::Table(table) => {
                let at = (*state as usize).checked_mul(self.actions.len())?.checked_add(action.index())?;
                u32::from(*table.get(at).filter(|&&next| next != GOODBOT_CANNOT)?)
            }
            Steps::Function(step) => next_by(step?, self.context, *state, action.index() as u8)?,
        };
        (next < self.states).then_some(next)
    }

    fn holds(&self, proposition: &GroundProposition, state: &u32) -> bool {
        let arguments = proposition.arguments.map(|object| object.index() as u8);
        // SAFETY: the caller's function, with the context that came with it.
        self.holds.is_some_and(|holds| unsafe { holds(self.context, *state, proposition.proposition.index() as u8, arguments.as_ptr()) })
    }

    fn state_count(&self) -> u64 {
        u64::from(self.states)
    }

    fn number(&self, state: &u32) -> u64 {
        u64::from(*state)
    }

    fn numbered(&self, number: u64) -> u32 {
        number as u32
    }

    #[cfg(feature = "ways")]
    fn tell_derived(&self, state: &u32, object: ObjectId, tell: &mut dyn FnMut(&str)) {
        // A text that is not UTF-8 is left out; the checks refuse it when the robot is made.
        derived_by(self.derived, self.context, *state, object.index() as u8).filter_map(Result::ok).for_each(tell);
    }
}
