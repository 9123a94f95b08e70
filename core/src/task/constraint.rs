//! Variable-binding constraints: the attributes of a task's objects that a command may mention ("the *yellow chair*", "the *red* room").
//!
//! Every subset of the attribute propositions that are true of the bound objects is a constraint, the empty one included, and all are
//! equally probable (paper, section 3).

use super::{GroundedTask, LiftedTask};
use crate::capacity::{Capacity, CapacityError, FACTS_PER_TASK};
use crate::oomdp::{Carrier, Domain, ObjectId};
use heapless::Vec;

/// An attribute proposition that is true of an object bound by a task: `roomIsRed(room0)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fact {
    /// The object.
    pub object: ObjectId,
    /// The attribute, by its position in the schema.
    pub attribute: u8,
    /// The carrier, by its position in the attribute.
    pub carrier: u8,
}

/// The facts of one task, in the order of machine commands: by attribute, then by value, then by carrier.
pub type Facts = Vec<Fact, FACTS_PER_TASK>;

/// The facts true of the objects that `task` binds.
///
/// # Errors
/// A [`CapacityError`] if there are more than [`FACTS_PER_TASK`].
pub fn facts<D: Domain>(domain: &D, lifted: &LiftedTask, task: &GroundedTask) -> Result<Facts, CapacityError> {
    let mut facts = Facts::new();
    let (schema, objects) = (domain.world().schema, domain.world().objects);
    for &object in task.bindings.iter().take(lifted.variables.len()) {
        let Some(bound) = objects.get(object) else { continue };
        for (position, attribute) in schema.attributes.iter().enumerate() {
            if bound.value(position).is_none() {
                continue;
            }
            let Some(carrier) = attribute.carriers.iter().position(|carrier: &Carrier<'_>| carrier.class == bound.class) else { continue };
            let fact = Fact { object, attribute: position as u8, carrier: carrier as u8 };
            facts.push(fact).map_err(|_| CapacityError::full(Capacity::FactsPerTask, FACTS_PER_TASK))?;
        }
    }
    let key = |fact: &Fact| (fact.attribute, objects.value(fact.object, usize::from(fact.attribute)), fact.carrier);
    sort(&mut facts, key);
    Ok(facts)
}

/// Sorts a few entries by insertion: the library's sort can panic and is larger than the rest of this module.
pub(crate) fn sort<T, K: Ord>(entries: &mut [T], key: impl Fn(&T) -> K) {
    for unsorted in 1..entries.len() {
        for earlier in (0..unsorted).rev() {
            let Some([before, after]) = entries.get_mut(earlier..=earlier + 1) else { break };
            if key(before) <= key(after) {
                break;
            }
            core::mem::swap(before, after);
        }
    }
}
