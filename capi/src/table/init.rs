//! From the caller's description to a robot.

use super::description::{
    GOODBOT_CANNOT, GOODBOT_MOST_ACTIONS, GOODBOT_MOST_ARGUMENTS, GOODBOT_MOST_ATTRIBUTES, GOODBOT_MOST_CARRIERS, GOODBOT_MOST_CLASSES,
    GOODBOT_MOST_PROPOSITIONS, GOODBOT_MOST_TASKS, GoodbotTable,
};
use super::domain::{Parts, Steps, TableDomain};
use crate::arena::{Arena, HomeArena, after};
use crate::capacities::GoodbotCapacities;
use crate::robot::{Goodbot, World, give, plot, settle, text, with};
use crate::status::{Failure, GoodbotStatus};
use core::ffi::{c_char, c_void};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{ActionKind, Attribute, Carrier, Class, ClassId, ObjectCount, ObjectSet, Proposition, Schema};
use goodbot::task::LiftedTask;
use heapless::Vec;

const NO_CARRIER: Carrier<'static> = Carrier { class: ClassId(0), prefix: "" };
const NO_ATTRIBUTE: Attribute<'static> = Attribute { name: "", carriers: &[] };
const NO_PROPOSITION: Proposition<'static> = Proposition { name: "", parameters: &[] };

/// Where the tables of a description end that begin at `at`.
pub(crate) const fn after_storage(at: usize) -> usize {
    let at = after::<Class<'static>>(at, GOODBOT_MOST_CLASSES);
    let at = after::<Carrier<'static>>(at, GOODBOT_MOST_CARRIERS);
    let at = after::<Attribute<'static>>(at, GOODBOT_MOST_ATTRIBUTES);
    let at = after::<ClassId>(at, GOODBOT_MOST_PROPOSITIONS * GOODBOT_MOST_ARGUMENTS);
    let at = after::<Proposition<'static>>(at, GOODBOT_MOST_PROPOSITIONS);
    after::<ActionKind<'static>>(at, GOODBOT_MOST_ACTIONS)
}

/// Items of the caller's.
///
/// # Safety
/// `items` is null or points to `count` items that stay.
unsafe fn list<T>(items: *const T, count: u32, most: usize) -> Result<&'static [T], GoodbotStatus> {
    if count == 0 {
        return Ok(&[]);
    }
    if items.is_null() {
        return Err(GoodbotStatus::Null);
    }
    if count as usize > most {
        return Err(GoodbotStatus::Number);
    }
    // SAFETY: the caller's promise.
    Ok(unsafe { core::slice::from_raw_parts(items, count as usize) })
}

/// Makes a robot of the caller's own, in the caller's memory: `bytes` bytes, aligned to 8, as many as `goodbot_table_size` says. The
/// description and all that it points to must stay as long as the robot is used.
///
/// # Safety
/// `memory` is null or the caller's memory for this alone, which stays where it is; the other pointers are null or point to what they
/// say.
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
        Err(failure) => failure.status,
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
) -> Result<GoodbotStatus, Failure> {
    // SAFETY: the caller's promise, for all that follows.
    unsafe {
        let Some(table) = table.as_ref().filter(|_| !robot.is_null()) else { return Err(GoodbotStatus::Null.into()) };
        let mut plot = plot(memory.cast(), bytes, capacities)?;
        let (classes, attributes, propositions) = schema(table, &mut plot.arena)?;
        let schema = Schema { classes, attributes, propositions };
        let actions = actions(table, &mut plot.arena)?;
        let steps = steps(table)?;
        if table.start >= table.state_count {
            return Err(GoodbotStatus::Number.into());
        }
        let tasks = kinds_of_tasks(table.tasks, table.task_count, &schema)?;
        let world = |mut memory: HomeArena| {
            let objects = objects(table, &mut memory)?;
            let (holds, context, states) = (table.holds, table.context, table.state_count);
            Ok(World::Table(TableDomain { schema, memory, objects, actions, steps, holds, context, states }, table.start))
        };
        Ok(settle(plot, &tasks, world, robot))
    }
}

/// The kinds of tasks that commands may mean.
///
/// # Safety
/// `tasks` is null or points to so many texts, each null or ended by a 0.
pub(crate) unsafe fn kinds_of_tasks(
    tasks: *const *const c_char,
    count: u32,
    schema: &Schema<'_>,
) -> Result<Vec<LiftedTask, GOODBOT_MOST_TASKS>, Failure> {
    let mut kinds = Vec::new();
    // SAFETY: the caller's promise.
    for &task in unsafe { list(tasks, count, GOODBOT_MOST_TASKS)? } {
        // SAFETY: the caller's promise.
        let kind = LiftedTask::parse(unsafe { text(task)? }, schema)?;
        kinds.push(kind).map_err(|_| GoodbotStatus::Number)?;
    }
    Ok(kinds)
}

/// # Safety
/// What the table points to is there and stays; so for the three functions that follow.
unsafe fn schema(table: &GoodbotTable, arena: &mut Arena) -> Result<Parts, Failure> {
    let room = GoodbotStatus::Memory;
    let classes = arena.table(GOODBOT_MOST_CLASSES, Class { name: "" }).ok_or(room)?;
    let carriers = arena.table(GOODBOT_MOST_CARRIERS, NO_CARRIER).ok_or(room)?;
    let attributes = arena.table(GOODBOT_MOST_ATTRIBUTES, NO_ATTRIBUTE).ok_or(room)?;
    let parameters = arena.table(GOODBOT_MOST_PROPOSITIONS * GOODBOT_MOST_ARGUMENTS, ClassId(0)).ok_or(room)?;
    let propositions = arena.table(GOODBOT_MOST_PROPOSITIONS, NO_PROPOSITION).ok_or(room)?;
    // SAFETY: the caller's promise, for all that follows: its memory stays as long as the robot is used.
    let (classes, attributes, propositions) = unsafe { (classes.stay(), attributes.stay(), propositions.stay()) };
    // SAFETY: as above.
    let (mut carriers, mut parameters) = unsafe { (carriers.stay(), parameters.stay()) };
    // SAFETY: as above.
    unsafe {
        for (slot, &name) in classes.iter_mut().zip(list(table.classes, table.class_count, GOODBOT_MOST_CLASSES)?) {
            slot.name = text(name)?;
        }
        let class =
            |position: u8| if u32::from(position) < table.class_count { Ok(ClassId(position)) } else { Err(GoodbotStatus::Unknown) };
        for (slot, attribute) in attributes.iter_mut().zip(list(table.attributes, table.attribute_count, GOODBOT_MOST_ATTRIBUTES)?) {
            let given = list(attribute.carriers, attribute.carrier_count, GOODBOT_MOST_CARRIERS)?;
            let (own, rest) = carriers.split_at_mut_checked(given.len()).ok_or(GoodbotStatus::Number)?;
            for (slot, carrier) in own.iter_mut().zip(given) {
                *slot = Carrier { class: class(carrier.object_class)?, prefix: text(carrier.prefix)? };
            }
            (*slot, carriers) = (Attribute { name: text(attribute.name)?, carriers: own }, rest);
        }
        let given = list(table.propositions, table.proposition_count, GOODBOT_MOST_PROPOSITIONS)?;
        for (slot, proposition) in propositions.iter_mut().zip(given) {
            let count = proposition.parameter_count as usize;
            if count == 0 || count > GOODBOT_MOST_ARGUMENTS {
                return Err(GoodbotStatus::Number.into());
            }
            let (own, rest) = parameters.split_at_mut_checked(count).ok_or(GoodbotStatus::Number)?;
            for (slot, &parameter) in own.iter_mut().zip(&proposition.parameters) {
                *slot = class(parameter)?;
            }
            (*slot, parameters) = (Proposition { name: text(proposition.name)?, parameters: own }, rest);
        }
    }
    let used = |count: u32| ..count as usize;
    let classes = classes.get(used(table.class_count)).unwrap_or(&[]);
    let attributes = attributes.get(used(table.attribute_count)).unwrap_or(&[]);
    Ok((classes, attributes, propositions.get(used(table.proposition_count)).unwrap_or(&[])))
}

unsafe fn actions(table: &GoodbotTable, arena: &mut Arena) -> Result<&'static [ActionKind<'static>], Failure> {
    let actions = arena.table(GOODBOT_MOST_ACTIONS, ActionKind { name: "", cost: 1 }).ok_or(GoodbotStatus::Memory)?;
    // SAFETY: the caller's promise: its memory stays as long as the robot is used.
    let actions = unsafe { actions.stay() };
    // SAFETY: the caller's promise.
    for (slot, action) in actions.iter_mut().zip(unsafe { list(table.actions, table.action_count, GOODBOT_MOST_ACTIONS) }?) {
        if !(1..=16).contains(&action.cost) {
            return Err(GoodbotStatus::Number.into());
        }
        // SAFETY: as above.
        *slot = ActionKind { name: unsafe { text(action.name) }?, cost: action.cost as u8 };
    }
    Ok(actions.get(..table.action_count as usize).unwrap_or(&[]))
}

unsafe fn steps(table: &GoodbotTable) -> Result<Steps, Failure> {
    if table.holds.is_none() {
        return Err(GoodbotStatus::Null.into());
    }
    if !table.next.is_null() {
        // The table's entries cannot name more states.
        if table.state_count > u32::from(GOODBOT_CANNOT) {
            return Err(GoodbotStatus::Number.into());
        }
        let entries = table.state_count.checked_mul(table.action_count).ok_or(GoodbotStatus::Number)?;
        // SAFETY: the caller's promise.
        return Ok(Steps::Table(unsafe { list(table.next, entries, entries as usize) }?));
    }
    if table.step.is_none() {
        return Err(GoodbotStatus::Null.into());
    }
    Ok(Steps::Function(table.step))
}

unsafe fn objects(table: &GoodbotTable, memory: &mut HomeArena) -> Result<ObjectCount, Failure> {
    let mut objects = ObjectSet::new(memory.lend().objects);
    // SAFETY: the caller's promise, for all that follows.
    unsafe {
        for object in list(table.objects, table.object_count, usize::from(u8::MAX))? {
            if u32::from(object.object_class) >= table.class_count {
                return Err(GoodbotStatus::Unknown.into());
            }
            let mut values = [""; GOODBOT_MOST_ATTRIBUTES];
            for (slot, &value) in values.iter_mut().zip(&object.values) {
                let value: *const c_char = value;
                if !value.is_null() {
                    *slot = text(value)?;
                }
            }
            objects.add(ClassId(object.object_class), text(object.name)?, &values)?;
        }
    }
    Ok(objects.count())
}

/// Says which state things are in, as sensed.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_table_set_state(robot: *mut Goodbot, state: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let World::Table(domain, now) = &mut robot.world else { return Err(GoodbotStatus::World.into()) };
            if state >= domain.states() {
                return Err(GoodbotStatus::Number.into());
            }
            *now = state;
            Ok(GoodbotStatus::Ok)
        })
    }
}

/// Which state things are in.
///
/// # Safety
/// `robot` is null or a handle, `state` null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_table_state(robot: *mut Goodbot, state: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let World::Table(_, now) = &robot.world else { return Err(GoodbotStatus::World.into()) };
            give(state, *now)
        })
    }
}
