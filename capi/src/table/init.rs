//! From the caller's description to a robot.

use super::description::{
    GOODBOT_CANNOT, GOODBOT_MOST_ACTIONS, GOODBOT_MOST_ARGUMENTS, GOODBOT_MOST_ATTRIBUTES, GOODBOT_MOST_CARRIERS, GOODBOT_MOST_CLASSES,
    GOODBOT_MOST_DERIVED, GOODBOT_MOST_PROPOSITIONS, GoodbotObject, GoodbotTable,
};
use super::domain::{Parts, Steps, TableDomain, derived_by, next_by};
use crate::arena::{Arena, after};
#[cfg(feature = "explain")]
use crate::beliefs::Writer;
use crate::capacities::GoodbotCapacities;
use crate::robot::{Goodbot, give, list, look, plot, settle, text, with};
#[cfg(feature = "explain")]
use crate::status::text_of;
use crate::status::{At, Failure, Fault, GoodbotStatus, Place};
use crate::tasks::{kinds_of_tasks, written_kinds};
use crate::world::World;
use core::ffi::{c_char, c_void};
use goodbot::Capacities;
use goodbot::capacity::{Capacity, CapacityError, NAME_BYTES};
use goodbot::memory::HomeTables;
use goodbot::oomdp::{ActionKind, Attribute, Carrier, Class, ClassId, Either, ObjectCount, ObjectSet, Proposition, Schema};

/// Without checks the library takes only a table that another program has checked.
const CHECKS: bool = cfg!(feature = "checks");

const NO_CARRIER: Carrier<'static> = Carrier::new(ClassId::new(0), "");
const NO_ATTRIBUTE: Attribute<'static> = Attribute { name: "", carriers: &[] };
const NO_PROPOSITION: Proposition<'static> = Proposition { name: "", parameters: &[] };

/// The end of a description's tables that begin at `at`.
pub(crate) const fn after_storage(at: usize) -> usize {
    let at = after::<Class<'static>>(at, GOODBOT_MOST_CLASSES);
    let at = after::<Carrier<'static>>(at, GOODBOT_MOST_CARRIERS);
    let at = after::<Attribute<'static>>(at, GOODBOT_MOST_ATTRIBUTES);
    let at = after::<ClassId>(at, GOODBOT_MOST_PROPOSITIONS * GOODBOT_MOST_ARGUMENTS);
    let at = after::<Proposition<'static>>(at, GOODBOT_MOST_PROPOSITIONS);
    after::<ActionKind<'static>>(at, GOODBOT_MOST_ACTIONS)
}

/// Makes a robot of the caller's own, in the caller's memory: `bytes` bytes, aligned to 8, as many as `goodbot_table_size` says. The
/// description and all that it points to must stay as long as the robot is used.
///
/// # Safety
/// `memory` is null, or the caller's memory for the robot alone, which does not move; the other pointers are null or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_init_table(
    memory: *mut c_void,
    bytes: usize,
    capacities: *const GoodbotCapacities,
    table: *const GoodbotTable,
    robot: *mut *mut Goodbot,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    match unsafe { init(memory, bytes, capacities, table, robot) } {
        Ok(status) => status,
        Err(fault) => fault.status,
    }
}

/// Like `goodbot_init_table`, in the same memory, but also writes the fault of the description, with a 0 at its end: the list, the
/// item's position, the field, its value and the allowed values; or the full table, its size and the size needed. The text is empty if there
/// is no fault. Returns the status of `goodbot_init_table`, or `BUFFER` if the text does not fit; 200 bytes are enough.
///
/// # Safety
/// As `goodbot_init_table`; `text` is null or room for `text_bytes` bytes.
#[cfg(feature = "explain")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_explain_table(
    memory: *mut c_void,
    bytes: usize,
    capacities: *const GoodbotCapacities,
    table: *const GoodbotTable,
    text: *mut c_char,
    text_bytes: usize,
) -> GoodbotStatus {
    let mut robot = core::ptr::null_mut();
    // SAFETY: the caller's promise.
    let (made, writer) = unsafe { (init(memory, bytes, capacities, table, &raw mut robot), Writer::new(text, text_bytes)) };
    let mut writer = match writer {
        Ok(writer) => writer,
        Err(status) => return status,
    };
    let status = match made {
        Ok(status) => status,
        Err(fault) => {
            explain(&mut writer, &fault);
            fault.status
        }
    };
    match writer.end() {
        Ok(_) => status,
        Err(failure) => failure.status,
    }
}

/// Writes the place of a failure, and its kind.
#[cfg(feature = "explain")]
fn explain(writer: &mut Writer, fault: &Fault) {
    if let Some(Place { list, item, field, found, allowed }) = fault.place {
        writer.put(list);
        if let Some(item) = item {
            writer.put("[");
            writer.number(item as u32);
            writer.put("]");
        }
        if !field.is_empty() {
            writer.put(".");
            writer.put(field);
        }
        if let Some(found) = found {
            writer.put(" is ");
            writer.number(found);
        }
        if let Some((least, most)) = allowed {
            writer.put(" and must be from ");
            writer.number(least);
            writer.put(" to ");
            writer.number(most);
        }
        writer.put(": ");
    }
    match fault.full {
        Some(full) => {
            writer.put(full.capacity.name());
            writer.put(" holds ");
            writer.number(full.limit);
            writer.put(" and ");
            writer.number(full.given);
            writer.put(" are needed; raise it");
        }
        None => writer.put(text_of(fault.status as i32).to_str().unwrap_or("")),
    }
}

/// # Safety
/// As [`goodbot_init_table`].
unsafe fn init(
    memory: *mut c_void,
    bytes: usize,
    capacities: *const GoodbotCapacities,
    table: *const GoodbotTable,
    robot: *mut *mut Goodbot,
) -> Result<GoodbotStatus, Fault> {
    // SAFETY: the caller's promise, for all that follows.
    unsafe {
        let Some(table) = table.as_ref().filter(|_| !robot.is_null()) else { return Err(GoodbotStatus::Null.into()) };
        let mut plot = plot(memory.cast(), bytes, capacities).at(Place::of("the memory given"))?;
        let (classes, attributes, propositions) = schema(table, &mut plot.arena)?;
        let schema = Schema { classes, attributes, propositions };
        let actions = actions(table, &mut plot.arena)?;
        let steps = steps(table)?;
        let most = Capacities::from(&*capacities).states;
        if CHECKS {
            lead_to_states(table, steps, actions, most)?;
            derive_texts(table, most)?;
        }
        if table.start >= table.state_count {
            return Err(GoodbotStatus::Number).at(Place::of("start").number(table.start, 0, table.state_count.saturating_sub(1)));
        }
        let tasks = if CHECKS { kinds_of_tasks(table.tasks, table.task_count, &schema)? } else { written_kinds(table, &schema)? };
        let mut world = |mut memory: HomeTables<'static>| {
            let objects = objects(table, attributes, &mut memory)?;
            let (holds, derived, context, states) = (table.holds, table.derived, table.context, table.state_count);
            let domain = TableDomain { schema, memory, objects, actions, steps, holds, derived, context, states };
            Ok(World::Here(Either::Other(domain), Either::Other(table.start)))
        };
        settle(plot, &tasks, &mut world, robot)
    }
}

/// # Safety
/// What the table points to is valid and stays; the same holds for the functions below.
unsafe fn schema(table: &GoodbotTable, arena: &mut Arena) -> Result<Parts, Fault> {
    let room = GoodbotStatus::Memory;
    let classes = arena.table(GOODBOT_MOST_CLASSES, Class { name: "" }).ok_or(room)?;
    let mut carriers = arena.table(GOODBOT_MOST_CARRIERS, NO_CARRIER).ok_or(room)?;
    let attributes = arena.table(GOODBOT_MOST_ATTRIBUTES, NO_ATTRIBUTE).ok_or(room)?;
    let mut parameters = arena.table(GOODBOT_MOST_PROPOSITIONS * GOODBOT_MOST_ARGUMENTS, ClassId::new(0)).ok_or(room)?;
    let propositions = arena.table(GOODBOT_MOST_PROPOSITIONS, NO_PROPOSITION).ok_or(room)?;
    // SAFETY: the caller's promise.
    unsafe {
        let given = list(table.classes, table.class_count, GOODBOT_MOST_CLASSES, Place::of("classes"), Place::of("class_count"))?;
        for (number, (slot, &name)) in classes.iter_mut().zip(given).enumerate() {
            slot.name = text(name).at(Place::item("classes", number, ""))?;
        }
        let (place, counted) = (Place::of("attributes"), Place::of("attribute_count"));
        let given = list(table.attributes, table.attribute_count, GOODBOT_MOST_ATTRIBUTES, place, counted)?;
        for (number, (slot, attribute)) in attributes.iter_mut().zip(given).enumerate() {
            let part = |field| Place::item("attributes", number, field);
            let given = list(attribute.carriers, attribute.carrier_count, GOODBOT_MOST_CARRIERS, part("carriers"), part("carrier_count"))?;
            let left = carriers.len() as u32;
            let too_many = part("carrier_count").number(attribute.carrier_count, 0, left);
            let (own, rest) = carriers.split_at_mut_checked(given.len()).ok_or(GoodbotStatus::Number).at(too_many)?;
            for (slot, carrier) in own.iter_mut().zip(given) {
                let prefix = text(carrier.prefix).at(part("carriers"))?;
                *slot = Carrier { class: class(table, carrier.object_class, part("carriers"))?, prefix };
            }
            (*slot, carriers) = (Attribute { name: text(attribute.name).at(part("name"))?, carriers: own }, rest);
        }
        let (place, counted) = (Place::of("propositions"), Place::of("proposition_count"));
        let given = list(table.propositions, table.proposition_count, GOODBOT_MOST_PROPOSITIONS, place, counted)?;
        for (number, (slot, proposition)) in propositions.iter_mut().zip(given).enumerate() {
            let part = |field| Place::item("propositions", number, field);
            let count = proposition.parameter_count as usize;
            if count == 0 || count > GOODBOT_MOST_ARGUMENTS {
                let most = GOODBOT_MOST_ARGUMENTS as u32;
                return Err(GoodbotStatus::Number).at(part("parameter_count").number(proposition.parameter_count, 1, most));
            }
            let (own, rest) = parameters.split_at_mut_checked(count).ok_or(GoodbotStatus::Number).at(part("parameters"))?;
            for (slot, &parameter) in own.iter_mut().zip(&proposition.parameters) {
                *slot = class(table, parameter, part("parameters"))?;
            }
            (*slot, parameters) = (Proposition { name: text(proposition.name).at(part("name"))?, parameters: own }, rest);
        }
    }
    let used = |count: u32| ..count as usize;
    let classes = classes.get(used(table.class_count)).unwrap_or(&[]);
    let attributes = attributes.get(used(table.attribute_count)).unwrap_or(&[]);
    Ok((classes, attributes, propositions.get(used(table.proposition_count)).unwrap_or(&[])))
}

/// The class of this position.
fn class(table: &GoodbotTable, position: u8, place: Place) -> Result<ClassId, Fault> {
    let found = u32::from(position);
    let known = if !CHECKS || found < table.class_count { Ok(ClassId::new(position)) } else { Err(GoodbotStatus::Unknown) };
    known.at(place.number(found, 0, table.class_count.saturating_sub(1)))
}

unsafe fn actions(table: &GoodbotTable, arena: &mut Arena) -> Result<&'static [ActionKind<'static>], Fault> {
    let actions = arena.table(GOODBOT_MOST_ACTIONS, ActionKind { name: "", cost: 1 }).ok_or(GoodbotStatus::Memory)?;
    let (place, counted) = (Place::of("actions"), Place::of("action_count"));
    // SAFETY: the caller's promise.
    let given = unsafe { list(table.actions, table.action_count, GOODBOT_MOST_ACTIONS, place, counted) }?;
    for (number, (slot, action)) in actions.iter_mut().zip(given).enumerate() {
        if !(1..=16).contains(&action.cost) {
            return Err(GoodbotStatus::Number).at(Place::item("actions", number, "cost").number(action.cost, 1, 16));
        }
        // SAFETY: as above.
        let name = unsafe { text(action.name) }.at(Place::item("actions", number, "name"))?;
        *slot = ActionKind { name, cost: action.cost as u8 };
    }
    Ok(actions.get(..table.action_count as usize).unwrap_or(&[]))
}

unsafe fn steps(table: &GoodbotTable) -> Result<Steps, Fault> {
    // The entries of a table of steps cannot name more states.
    let most = if table.next.is_null() { u32::MAX } else { u32::from(GOODBOT_CANNOT) };
    if table.state_count == 0 || table.state_count > most {
        return Err(GoodbotStatus::Number).at(Place::of("state_count").number(table.state_count, 1, most));
    }
    if table.holds.is_none() {
        return Err(GoodbotStatus::Null).at(Place::of("holds"));
    }
    if !table.next.is_null() {
        let entries = table.state_count.checked_mul(table.action_count).ok_or(GoodbotStatus::Number).at(Place::of("state_count"))?;
        // SAFETY: the caller's promise.
        return Ok(Steps::Table(unsafe { list(table.next, entries, entries as usize, Place::of("next"), Place::of("next")) }?));
    }
    if table.step.is_none() {
        return Err(GoodbotStatus::Null).at(Place::of("next and step"));
    }
    Ok(Steps::Function(table.step))
}

/// Checks that every action leads to an existing state. A function is checked in only as many states as one plan can hold: with more
/// states, no command is heard.
fn lead_to_states(table: &GoodbotTable, steps: Steps, actions: &[ActionKind<'static>], most: usize) -> Result<(), Fault> {
    let last = table.state_count.saturating_sub(1);
    match steps {
        Steps::Table(entries) => {
            let beyond = |next: &u16| *next != GOODBOT_CANNOT && u32::from(*next) > last;
            match entries.iter().enumerate().find(|(_, next)| beyond(next)) {
                Some((entry, &next)) => Err(GoodbotStatus::Number).at(Place::item("next", entry, "").number(u32::from(next), 0, last)),
                None => Ok(()),
            }
        }
        Steps::Function(step) => {
            for state in 0..table.state_count.min(most as u32) {
                for (action, kind) in (0..).zip(actions) {
                    let next = step.and_then(|step| next_by(step, table.context, state, action)).filter(|next| *next > last);
                    if let Some(next) = next {
                        return Err(GoodbotStatus::Number)
                            .at(Place::item("what step gives for state", state as usize, kind.name).number(next, 0, last));
                    }
                }
            }
            Ok(())
        }
    }
}

/// Bytes of the longest derived fact; the core puts two letters before it.
const LONGEST_DERIVED: usize = NAME_BYTES - 2;

/// Checks the derived facts of all objects, in as many states as one plan can hold.
fn derive_texts(table: &GoodbotTable, most: usize) -> Result<(), Fault> {
    for state in 0..if table.derived.is_some() { table.state_count.min(most as u32) } else { 0 } {
        for object in 0..table.object_count.min(u32::from(u8::MAX)) as u8 {
            for (before, said) in (0..).zip(derived_by(table.derived, table.context, state, object)) {
                let place = |what| Place::item(what, state as usize, "");
                if before == GOODBOT_MOST_DERIVED {
                    let place = place("what derived gives of an object in state").number(before + 1, 0, GOODBOT_MOST_DERIVED);
                    return Err(GoodbotStatus::Number).at(place);
                }
                let said = said.at(place("what derived gives in state"))?;
                if said.is_empty() || said.len() > LONGEST_DERIVED {
                    let place = place("length of what derived gives in state").number(said.len() as u32, 1, LONGEST_DERIVED as u32);
                    return Err(GoodbotStatus::Number).at(place);
                }
            }
        }
    }
    Ok(())
}

unsafe fn objects(table: &GoodbotTable, attributes: &[Attribute<'static>], memory: &mut HomeTables<'static>) -> Result<ObjectCount, Fault> {
    let mut objects = ObjectSet::new(memory.lend().objects);
    // SAFETY: the caller's promise, for all that follows.
    unsafe {
        let given = list(table.objects, table.object_count, usize::from(u8::MAX), Place::of("objects"), Place::of("object_count"))?;
        for (number, object) in given.iter().enumerate() {
            let part = |field| Place::item("objects", number, field);
            let class = class(table, object.object_class, part("object_class"))?;
            let mut values = [""; GOODBOT_MOST_ATTRIBUTES];
            for (position, (slot, &value)) in values.iter_mut().zip(&object.values).enumerate() {
                let value: *const c_char = value;
                if !value.is_null() {
                    let attribute = attributes.get(position);
                    if !attribute.is_some_and(|attribute| attribute.carriers.iter().any(|carrier| carrier.class == class)) {
                        // No word could mean it.
                        return Err(GoodbotStatus::World).at(part("values, of an attribute that its class does not carry"));
                    }
                    *slot = text(value).at(part("values"))?;
                }
            }
            let name = text(object.name).at(part("name"))?;
            objects.add(class, name, &values).map_err(|error| whole(error.into(), given)).at(part("name"))?;
        }
    }
    Ok(objects.count())
}

/// A full table, with the size that all objects need, not only those up to the one that did not fit: it is raised only once. Nobody is told
/// without the feature `explain`.
///
/// # Safety
/// What the objects point to is valid and stays.
unsafe fn whole(failure: Failure, objects: &'static [GoodbotObject]) -> Failure {
    /// The texts of one object: its name and its values.
    const TEXTS: usize = 1 + GOODBOT_MOST_ATTRIBUTES;
    let Some(full) = failure.full.filter(|_| cfg!(feature = "explain")) else { return failure };
    let given = |at: usize| {
        let object = objects.get(at / TEXTS)?;
        let value = (at % TEXTS).checked_sub(1);
        // SAFETY: the caller's promise.
        unsafe { text(value.map_or(Some(object.name), |value| object.values.get(value).copied())?) }.ok()
    };
    let (mut names, mut bytes) = (0, 0);
    for at in 0..objects.len() * TEXTS {
        let name = given(at).unwrap_or("");
        if !name.is_empty() && (0..at).all(|before| given(before) != Some(name)) {
            names += 1;
            bytes += name.len();
        }
    }
    let needed = match full.capacity {
        Capacity::Objects => objects.len(),
        Capacity::Names => names,
        Capacity::NameBytesTogether => bytes,
        _ => return failure,
    };
    Failure { full: Some(CapacityError::new(full.capacity, full.limit as usize, needed)), ..failure }
}

/// Sets the current state, as sensed.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_table_set_state(robot: *mut Goodbot, state: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            #[allow(irrefutable_let_patterns, reason = "without the feature home there is nothing else")]
            let World::Here(Either::Other(domain), Either::Other(now)) = &mut robot.world else {
                return Err(GoodbotStatus::World.into());
            };
            if state >= domain.states() {
                return Err(GoodbotStatus::Number.into());
            }
            *now = state;
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// The current state.
///
/// # Safety
/// `robot` is null or a handle, `state` null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_table_state(robot: *const Goodbot, state: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        look(robot, |robot| {
            #[allow(irrefutable_let_patterns, reason = "without the feature home there is nothing else")]
            let World::Here(_, Either::Other(now)) = &robot.world else { return Err(GoodbotStatus::World.into()) };
            give(state, *now)
        })
    }
}
