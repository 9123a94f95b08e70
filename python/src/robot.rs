//! A robot that a Python class describes: any object with `actions`, `objects`, `propositions`, `step`, `number`, and `holds` or `true`.
//!
//! The answers of a class are cached: a domain does not change as the robot acts, and a search asks the same again and again. An exception
//! in the class cannot pass through the search. The first one is kept, the search is led to a quick end, and the caller raises it.

use crate::error::{full, value};
use crate::options::Items;
use crate::vocabulary::Names;
use goodbot::capacity::{ARGUMENTS, ATTRIBUTES, Capacity, CapacityError};
use goodbot::oomdp::{
    Action, ActionKind, ClassId, Domain, GroundProposition, MOST_COST, Object, ObjectCount, ObjectError, ObjectId, ObjectSet, ObjectTables,
    ObjectTablesRef, Objects, OneByOne, PropositionId, Schema, World,
};
use goodbot_lesson::world::robot::LONGEST_DERIVED;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyTuple};
use std::collections::{HashMap, HashSet};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The most objects.
const MOST_OBJECTS: usize = 255;
const NAME_BYTES: usize = 1 << 15;

/// A robot of a Python class.
#[derive(Debug)]
pub struct Robot {
    object: Py<PyAny>,
    names: Names,
    /// The class of each object, of which `objects` has the core's.
    classes: Vec<ClassId>,
    objects: Vec<Object>,
    name_bytes: Vec<u8>,
    name_ends: Vec<u16>,
    count: ObjectCount,
    state_count: u64,
    /// Whether the class tells at once all that is true in a state, by `true`.
    tells_all: bool,
    /// Whether the class tells derived facts, by `derived`.
    tells_derived: bool,
    known: Mutex<CachedAnswers>,
}

/// The cached answers of the class.
#[derive(Debug, Default)]
struct CachedAnswers {
    states: HashMap<u64, Py<PyAny>>,
    steps: HashMap<(u64, u8), Option<u64>>,
    holds: HashMap<(u64, GroundProposition), bool>,
    truths: HashMap<u64, HashSet<GroundProposition>>,
    derived: HashMap<u64, HashMap<ObjectId, Vec<String>>>,
    failed: Option<PyErr>,
}

/// The pairs of a dict.
fn pairs<'py>(object: &Bound<'py, PyAny>, name: &str) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
    let attribute = object.getattr(name)?;
    let dict = attribute.cast::<PyDict>().map_err(|_| value(format!("{name} must be a dict")))?;
    dict.iter().map(|(name, given)| Ok((name.extract()?, given))).collect()
}

/// The names of actions and their costs: a dict, or a list of names that cost 1 each.
fn actions(object: &Bound<'_, PyAny>) -> PyResult<Vec<(String, u8)>> {
    let given = object.getattr("actions")?;
    let actions: Vec<(String, i64)> = match given.cast::<PyDict>() {
        Ok(dict) => dict.iter().map(|(name, cost)| Ok((name.extract()?, cost.extract()?))).collect::<PyResult<_>>()?,
        Err(_) => given.extract::<Items<String>>()?.0.into_iter().map(|name| (name, 1)).collect(),
    };
    if actions.is_empty() || actions.len() > Action::MOST {
        let remedy = if actions.is_empty() { "name at least one" } else { "give several small ones one name" };
        return Err(value(format!("a robot has 1 to {} actions, and {} are given; {remedy}", Action::MOST, actions.len())));
    }
    for (position, (name, cost)) in actions.iter().enumerate() {
        if !(1..=i64::from(MOST_COST)).contains(cost) {
            return Err(value(format!("action {name:?} costs {cost}; the cost must be 1 to {MOST_COST}")));
        }
        if name.is_empty() || name == "noop" || actions.iter().take(position).any(|(other, _)| other == name) {
            return Err(value(format!("an action cannot be called {name:?}: names are unique, not empty, and noop is every robot's")));
        }
    }
    Ok(actions.into_iter().map(|(name, cost)| (name, cost as u8)).collect())
}

/// The position of a class, which is added if it is new.
fn class_id(names: &mut Names, class: &str) -> ClassId {
    let position = names.classes.iter().position(|known| known == class).unwrap_or_else(|| {
        names.classes.push(class.to_owned());
        names.classes.len() - 1
    });
    ClassId::new(position.min(usize::from(u8::MAX)) as u8)
}

fn names(py: Python<'_>, object: &Bound<'_, PyAny>) -> PyResult<Names> {
    let mut names = Names { actions: actions(object)?, ..Names::default() };
    for (name, parameters) in pairs(object, "propositions")? {
        let Items::<String>(parameters) = parameters.extract()?;
        if parameters.is_empty() || parameters.len() > ARGUMENTS {
            return Err(value(format!("proposition {name:?} must be of 1 to {ARGUMENTS} classes")));
        }
        let parameters = parameters.iter().map(|class| class_id(&mut names, class)).collect();
        names.propositions.push((name, parameters));
    }
    if names.propositions.is_empty() {
        return Err(value("propositions is empty; name at least one, such as {\"lampOn\": (\"lamp\",)}"));
    }
    if object.hasattr("attributes")? {
        for (name, carriers) in pairs(object, "attributes")? {
            let carriers =
                carriers.cast::<PyDict>().map_err(|_| value(format!("attribute {name:?} must be a dict from classes to prefixes")))?;
            let mut carried = Vec::new();
            for (class, prefix) in carriers {
                carried.push((class_id(&mut names, class.extract()?), prefix.extract()?));
            }
            names.attributes.push((name, carried));
        }
    }
    if object.hasattr("parents")? {
        for (name, above) in pairs(object, "parents")? {
            let above: String = above.extract()?;
            let (class, above_it) = (class_id(&mut names, &name), class_id(&mut names, &above));
            if names.is_a(above_it, class) {
                return Err(value(format!("parents has {above:?} above {name:?}, which is itself, or above it; name another one")));
            }
            names.parents.push((class, above_it));
        }
    }
    if names.attributes.len() > ATTRIBUTES {
        return Err(full(py, CapacityError::new(Capacity::Attributes, ATTRIBUTES, names.attributes.len())));
    }
    Ok(names)
}

/// The vocabulary of a Python object, for an agent's tasks.
pub fn names_of(object: &Bound<'_, PyAny>) -> PyResult<Names> {
    Ok(described(object)?.0)
}

type Described<'py> = (Names, Vec<(String, ClassId, Bound<'py, PyDict>)>);

/// The names and the objects: each with its name, its class and its attributes.
fn described<'py>(object: &Bound<'py, PyAny>) -> PyResult<Described<'py>> {
    let mut names = names(object.py(), object)?;
    let mut objects = Vec::new();
    for (name, given) in pairs(object, "objects")? {
        let given = given.cast_into::<PyDict>().map_err(|_| value(format!("object {name:?} must be a dict, with its \"class\"")))?;
        let class = given.get_item("class")?.ok_or_else(|| value(format!("object {name:?} has no \"class\"; add it")))?;
        let class = class_id(&mut names, class.extract()?);
        for key in given.keys() {
            let key: String = key.extract()?;
            if key != "class" && !names.attributes.iter().any(|(known, _)| *known == key) {
                return Err(value(format!("object {name:?} has {key:?}, which is none of the attributes")));
            }
        }
        objects.push((name, class, given));
    }
    names.settle();
    Ok((names, objects))
}

impl Robot {
    /// The robot that a Python object describes.
    pub fn of(object: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = object.py();
        let (names, given) = described(object)?;
        let tells_all = object.hasattr("true")?;
        if !tells_all && !object.hasattr("holds")? {
            return Err(value("a robot of your own needs a method holds(proposition, objects, state), or true(state)"));
        }
        let tells_derived = object.hasattr("derived")?;
        if tells_derived && names.attributes.len() == ATTRIBUTES {
            return Err(value(format!(
                "derived facts have no room beside {ATTRIBUTES} attributes; leave out an attribute, or derived(state)"
            )));
        }
        if given.len() > MOST_OBJECTS {
            return Err(value(format!("a robot has at most {MOST_OBJECTS} objects, and {} are given", given.len())));
        }
        let (mut objects, mut name_bytes, mut name_ends) =
            (vec![Object::UNUSED; given.len()], vec![0; NAME_BYTES], vec![0; given.len() * (1 + ATTRIBUTES)]);
        let tables = ObjectTables { objects: &mut objects, name_bytes: &mut name_bytes, name_ends: &mut name_ends };
        let mut set = ObjectSet::new(tables);
        for (name, class, values) in &given {
            let mut texts = Vec::new();
            for (attribute, _) in &names.attributes {
                texts.push(values.get_item(attribute)?.map(|text| text.extract::<String>()).transpose()?.unwrap_or_default());
            }
            let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            set.add(names.of_core(*class), name, &texts).map_err(|error| match error {
                ObjectError::Capacity(error) => full(py, error),
                error => value(format!("object {name:?}: {error}")),
            })?;
        }
        let count = set.count();
        let state_count = match object.getattr_opt("state_count")? {
            Some(count) => count.extract()?,
            None => u64::MAX,
        };
        let object = object.clone().unbind();
        let classes = given.iter().map(|&(_, class, _)| class).collect();
        Ok(Self {
            object,
            classes,
            names,
            objects,
            name_bytes,
            name_ends,
            count,
            state_count,
            tells_all,
            tells_derived,
            known: Mutex::default(),
        })
    }

    /// Whether this object describes it.
    pub fn is_of(&self, object: &Bound<'_, PyAny>) -> bool {
        self.object.is(object)
    }

    fn known(&self) -> MutexGuard<'_, CachedAnswers> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The exception that the class has raised since the last call.
    pub fn failure(&self) -> Option<PyErr> {
        self.known().failed.take()
    }

    /// The number of a state, which is kept.
    pub fn enter(&self, state: &Bound<'_, PyAny>) -> PyResult<u64> {
        let number: u64 = self.object.bind(state.py()).call_method1("number", (state,))?.extract()?;
        if number >= self.state_count {
            return Err(value(format!("number() returned {number}, and state_count is {}; it must be more", self.state_count)));
        }
        let kept = state.clone().unbind();
        self.known().states.entry(number).or_insert(kept);
        Ok(number)
    }

    /// The state of a number.
    pub fn state(&self, py: Python<'_>, number: u64) -> Option<Py<PyAny>> {
        self.known().states.get(&number).map(|state| state.clone_ref(py))
    }

    fn ask_step(&self, py: Python<'_>, number: u64, action: Action) -> PyResult<Option<u64>> {
        let name = self.names.actions.get(action.index()).map(|(name, _)| name);
        let (Some(state), Some(name)) = (self.state(py, number), name) else { return Ok(None) };
        let next = self.object.bind(py).call_method1("step", (state, PyString::intern(py, name)))?;
        if next.is_none() { Ok(None) } else { self.enter(&next).map(Some) }
    }

    fn ask_holds(&self, py: Python<'_>, proposition: &GroundProposition, number: u64) -> PyResult<bool> {
        let name = self.names.propositions.get(proposition.proposition.index());
        let (Some(state), Some((name, parameters))) = (self.state(py, number), name) else { return Ok(false) };
        let objects = self.objects();
        let arguments = proposition.arguments.iter().take(parameters.len()).map(|&object| PyString::intern(py, objects.name(object)));
        let arguments = PyTuple::new(py, arguments.collect::<Vec<_>>())?;
        let name = PyString::intern(py, name);
        self.object.bind(py).call_method1("holds", (name, arguments, state))?.is_truthy()
    }

    /// All that is true in a state, of a class that tells it by `true`.
    fn ask_truths(&self, py: Python<'_>, number: u64) -> PyResult<HashSet<GroundProposition>> {
        let Some(state) = self.state(py, number) else { return Ok(HashSet::new()) };
        let Items::<String>(told) = self.object.bind(py).call_method1("true", (state,))?.extract()?;
        let objects = self.objects();
        let read = |text: &String| {
            let (name, arguments) = text.strip_suffix(')')?.split_once('(')?;
            let position = self.names.propositions.iter().position(|(known, _)| known == name.trim())?;
            let ids = arguments.split(',').map(|name| objects.iter().map(|(id, _)| id).find(|&id| objects.name(id) == name.trim()));
            let ids: Vec<ObjectId> = ids.collect::<Option<_>>()?;
            let (_, parameters) = self.names.propositions.get(position)?;
            (ids.len() == parameters.len()).then(|| GroundProposition::new(PropositionId::new(position as u8), &ids))
        };
        let strange =
            |text: &String| value(format!("true() told {text:?}, which is no proposition of these objects; write \"lampOn(lamp1)\""));
        told.iter().map(|text| read(text).ok_or_else(|| strange(text))).collect()
    }

    /// The derived facts of each object in a state.
    fn ask_derived(&self, py: Python<'_>, number: u64) -> PyResult<HashMap<ObjectId, Vec<String>>> {
        let mut all = HashMap::new();
        let Some(state) = self.state(py, number) else { return Ok(all) };
        let told = self.object.bind(py).call_method1("derived", (state,))?;
        let told = told.cast_into::<PyDict>().map_err(|_| value("derived() must return a dict from objects to lists of words"))?;
        for (name, facts) in told {
            let (name, Items(facts)): (String, Items<String>) = (name.extract()?, facts.extract()?);
            let Some(object) = self.objects().find(&name) else {
                return Err(value(format!("derived() told of {name:?}, which is none of the objects")));
            };
            if let Some(strange) = facts.iter().find(|fact| fact.is_empty() || fact.len() > LONGEST_DERIVED) {
                return Err(value(format!("derived() told {strange:?}; a derived fact is a word of 1 to {LONGEST_DERIVED} bytes")));
            }
            all.insert(object, facts);
        }
        Ok(all)
    }

    /// Passes the derived facts of an object on.
    fn tell_derived(&self, state: u64, object: ObjectId, tell: &mut dyn FnMut(&str)) {
        let known = self.known().derived.get(&state).map(|known| known.get(&object).cloned());
        let facts = match known {
            Some(facts) => facts,
            None => {
                let Some(told) = self.asked(|py| self.ask_derived(py, state)) else { return };
                let facts = told.get(&object).cloned();
                self.known().derived.insert(state, told);
                facts
            }
        };
        facts.iter().flatten().for_each(|fact| tell(fact));
    }

    /// Lends the robot to `call`, as a domain of the core.
    pub fn lend<T>(&self, call: impl FnOnce(&Lent<'_>) -> T) -> T {
        self.names.lend(|schema, actions| call(&Lent { robot: self, schema, actions }))
    }

    fn objects(&self) -> Objects<'_> {
        let tables = ObjectTablesRef { objects: &self.objects, name_bytes: &self.name_bytes, name_ends: &self.name_ends };
        Objects::new(tables, self.count)
    }

    fn step(&self, state: u64, action: Action) -> Option<u64> {
        if let Some(&known) = self.known().steps.get(&(state, action.index() as u8)) {
            return known;
        }
        let next = self.asked(|py| self.ask_step(py, state, action))?;
        self.known().steps.insert((state, action.index() as u8), next);
        next
    }

    /// Whether the objects are of the proposition's classes, or of classes below.
    fn admits(&self, proposition: &GroundProposition) -> bool {
        let wanted = self.names.wanted.get(proposition.proposition.index()).map_or(&[][..], Vec::as_slice);
        let is_it =
            |(&object, &above): (&ObjectId, &ClassId)| self.classes.get(object.index()).is_some_and(|&it| self.names.is_a(it, above));
        self.names.parents.is_empty() || proposition.arguments.iter().zip(wanted).all(is_it)
    }

    fn holds(&self, proposition: &GroundProposition, state: u64) -> bool {
        if !self.admits(proposition) {
            return false;
        }
        if self.tells_all {
            return self.is_told(proposition, state);
        }
        if let Some(&known) = self.known().holds.get(&(state, *proposition)) {
            return known;
        }
        let Some(holds) = self.asked(|py| self.ask_holds(py, proposition, state)) else { return false };
        self.known().holds.insert((state, *proposition), holds);
        holds
    }

    /// Whether a proposition is among those that the class tells of a state.
    fn is_told(&self, proposition: &GroundProposition, state: u64) -> bool {
        if let Some(known) = self.known().truths.get(&state) {
            return known.contains(proposition);
        }
        let Some(truths) = self.asked(|py| self.ask_truths(py, state)) else { return false };
        let holds = truths.contains(proposition);
        self.known().truths.insert(state, truths);
        holds
    }

    /// The answer of the class; `None` if it failed now or before.
    fn asked<T>(&self, ask: impl FnOnce(Python<'_>) -> PyResult<T>) -> Option<T> {
        if self.known().failed.is_some() {
            return None;
        }
        match Python::attach(ask) {
            Ok(answer) => Some(answer),
            Err(error) => {
                self.known().failed.get_or_insert(error);
                None
            }
        }
    }
}

/// A robot with its names, for the length of a call.
#[derive(Clone, Copy, Debug)]
pub struct Lent<'r> {
    robot: &'r Robot,
    schema: Schema<'r>,
    actions: &'r [ActionKind<'r>],
}

impl Domain for Lent<'_> {
    type State = u64;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        World { schema: self.schema, objects: self.robot.objects() }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        self.actions
    }

    fn step(&self, state: &u64, action: Action) -> Option<u64> {
        self.robot.step(*state, action)
    }

    fn holds(&self, proposition: &GroundProposition, state: &u64) -> bool {
        self.robot.holds(proposition, *state)
    }

    fn state_count(&self) -> u64 {
        self.robot.state_count
    }

    fn number(&self, state: &u64) -> u64 {
        *state
    }

    fn numbered(&self, number: u64) -> u64 {
        number
    }

    fn tell_derived(&self, state: &u64, object: ObjectId, tell: &mut dyn FnMut(&str)) {
        // Words tell the objects of one class of the core apart by their own class.
        let class = self.robot.classes.get(object.index()).filter(|&&class| self.robot.names.of_core(class) != class);
        if let Some(name) = class.and_then(|class| self.robot.names.classes.get(class.index())) {
            tell(name);
        }
        if self.robot.tells_derived {
            self.robot.tell_derived(*state, object, tell);
        }
    }

    fn admits(&self, proposition: &GroundProposition) -> bool {
        self.robot.admits(proposition)
    }
}
