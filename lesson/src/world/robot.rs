//! A robot from a world file: a [`Domain`] whose states are numbers.
//!
//! The state consists of variables. A proposition that the file lists among its `variables` has one value for each choice of its first
//! arguments: the object in its last. Any other proposition that an effect names is true or false. A state is a number whose digits are the
//! values.
//!
//! Every choice of objects has a digit, so a session may begin in a state that no action leads to. If that makes too many states or
//! actions, values and actions that can never occur from the file's facts on are left out; so they are if no more actions are left then than
//! a controller can hold. If there still are too many states, two propositions of which one always holds, such as on and off, share a digit.

use crate::home::full;
use crate::name::task_name;
use crate::place::Place;
use goodbot::capacity::{ARGUMENTS, ATTRIBUTES, LIFTED_TASKS, NAME_BYTES};
use goodbot::memory::AgentHeap;
use goodbot::oomdp::{
    Action, ActionKind, Attribute, Carrier, Class, ClassId, Domain, GroundProposition, Object, ObjectCount, ObjectError, ObjectId,
    ObjectSet, ObjectTables, ObjectTablesRef, Objects, OneByOne, Proposition, PropositionId, Schema, World, action_name,
};
use goodbot::planning::OptimalSet;
use goodbot::task::{GroundedTask, LiftedTask};
use goodbot::{Agent, AgentError, Capacities, Options};
use goodbot_formats::session::RecordedSession;
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText};
use goodbot_formats::world::{Literal, SessionInWorld, Term, WorldFile};
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

/// Why a world file makes no robot.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("field \"{field}\": {message}")]
pub struct WorldFlaw {
    /// The field at fault.
    pub field: String,
    /// The fault, and the remedy.
    pub message: String,
}

pub(super) fn flaw<T>(field: impl Into<String>, message: impl Into<String>) -> Result<T, WorldFlaw> {
    Err(WorldFlaw { field: field.into(), message: message.into() })
}

/// The most objects that a robot's world may have.
pub const MOST_OBJECTS: usize = 255;
/// The most tasks of a robot that acts.
pub const MOST_TASKS_OF_A_ROBOT: usize = Capacities::STANDARD.tasks;
/// The bytes of all names and values.
const NAME_BYTES_TOGETHER: usize = 60_000;
/// The most digits of a state, one for each choice of objects.
const MOST_DIGITS: usize = 1 << 16;
/// The most choices of objects to try for the conditions and effects of all actions.
const MOST_CASES: usize = 1 << 20;

/// The bytes of the longest name of a derived fact: the core puts two letters before it.
pub const LONGEST_DERIVED: usize = NAME_BYTES - 2;

/// The tables of a robot from a world file.
#[derive(Debug)]
pub struct Tables {
    file: Arc<WorldFile>,
    /// For each attribute: the classes that carry it, with the prefix of its values.
    carriers: Vec<Vec<(ClassId, String)>>,
    parameters: Vec<Vec<ClassId>>,
    rows: Vec<Object>,
    name_bytes: Vec<u8>,
    name_ends: Vec<u16>,
    count: ObjectCount,
    mechanism: Mechanism,
    start: u64,
}

/// The names in the tables, as a schema borrows them.
struct Names<'t> {
    classes: Vec<Class<'t>>,
    carriers: Vec<Vec<Carrier<'t>>>,
    propositions: Vec<Proposition<'t>>,
    kinds: Vec<ActionKind<'t>>,
}

impl<'t> Names<'t> {
    fn of(tables: &'t Tables) -> Self {
        let Tables { file, carriers: carriers_of, parameters, mechanism, .. } = tables;
        let carriers = |all: &'t Vec<(ClassId, String)>| all.iter().map(|(class, prefix)| Carrier::new(*class, prefix)).collect();
        Self {
            classes: file.classes.iter().map(|name| Class::new(name)).collect(),
            carriers: carriers_of.iter().map(carriers).collect(),
            propositions: file.propositions.iter().zip(parameters).map(|((name, _), of)| Proposition::new(name, of)).collect(),
            kinds: mechanism.actions.iter().map(|action| ActionKind::new(&action.name, action.cost)).collect(),
        }
    }

    fn attributes(&self, file: &'t WorldFile) -> Vec<Attribute<'_>> {
        file.attributes.iter().zip(&self.carriers).map(|((name, _), carriers)| Attribute::new(name, carriers)).collect()
    }
}

/// The core's class of a class. The core knows no classes above others: all below a class that an argument is of are one.
fn class_of(file: &WorldFile, name: &str) -> ClassId {
    let is_argument = |class: &&str| file.propositions.iter().any(|(_, classes)| classes.iter().any(|known| known == class));
    let name = if file.parents.is_empty() { name } else { file.and_above(name).filter(is_argument).last().unwrap_or(name) };
    ClassId::new(file.classes.iter().position(|known| known == name).unwrap_or(0) as u8)
}

/// The objects of each class of the file, with those of the classes below it.
struct Members<'w>(HashMap<&'w str, Vec<ObjectId>>);

impl<'w> Members<'w> {
    fn of(file: &'w WorldFile) -> Self {
        let mut all: HashMap<&str, Vec<ObjectId>> = HashMap::new();
        for (position, object) in file.objects.iter().enumerate() {
            for class in file.and_above(&object.class) {
                all.entry(class).or_default().push(ObjectId::new(position as u8));
            }
        }
        Self(all)
    }

    fn of_class(&self, class: &str) -> &[ObjectId] {
        self.0.get(class).map_or(&[], Vec::as_slice)
    }
}

impl Tables {
    /// The tables of a world file.
    ///
    /// # Errors
    /// A [`WorldFlaw`] if the world is too large for the core, or has no actions.
    pub fn of(file: Arc<WorldFile>) -> Result<Self, WorldFlaw> {
        if file.actions.is_empty() {
            return flaw("actions", "is missing: commands can be learned and asked in this world, but no robot can act in it; add actions");
        }
        let limits = [
            ("objects", file.objects.len(), MOST_OBJECTS),
            ("attributes", file.attributes.len(), ATTRIBUTES),
            ("classes", file.classes.len(), 255),
            ("propositions", file.propositions.len(), 255),
        ];
        if let Some((field, given, most)) = limits.into_iter().find(|(_, given, most)| given > most) {
            return flaw(field, format!("are {given}, and {most} are the most for a robot that acts; leave out some"));
        }
        if let Some((name, _)) = file.propositions.iter().find(|(_, classes)| classes.len() > ARGUMENTS) {
            return flaw(format!("propositions.{name}"), format!("has more than {ARGUMENTS} arguments; give it fewer"));
        }
        if file.attributes.len() == ATTRIBUTES && !file.derived.is_empty() {
            let message = format!("have no room beside {ATTRIBUTES} attributes; leave out an attribute, or these");
            return flaw("derived", message);
        }
        if let Some(position) = file.derived.iter().position(|derived| derived.name.len() > LONGEST_DERIVED) {
            return flaw(format!("derived[{position}]"), format!("has a name of more than {LONGEST_DERIVED} bytes; give it a shorter one"));
        }
        let mut tables = Self {
            carriers: file.attributes.iter().map(|(name, classes)| carriers(&file, name, classes)).collect(),
            parameters: file.propositions.iter().map(|(_, classes)| classes.iter().map(|name| class_of(&file, name)).collect()).collect(),
            rows: vec![Object::UNUSED; file.objects.len()],
            name_bytes: vec![0; NAME_BYTES_TOGETHER],
            name_ends: vec![0; file.objects.len() * (1 + ATTRIBUTES)],
            count: ObjectCount::NONE,
            mechanism: Mechanism::default(),
            start: 0,
            file,
        };
        tables.count = tables.add_objects()?;
        tables.mechanism = tables.lend(|robot| Mechanism::of(&tables.file, robot.world))?;
        tables.start = tables.lend(|robot| robot.state_of(&tables.file.facts))?;
        Ok(tables)
    }

    fn add_objects(&mut self) -> Result<ObjectCount, WorldFlaw> {
        let Self { file, rows, name_bytes, name_ends, .. } = self;
        let mut set = ObjectSet::new(ObjectTables { objects: rows, name_bytes, name_ends });
        for (position, object) in file.objects.iter().enumerate() {
            let value = |(attribute, _): &(String, Vec<String>)| {
                object.attributes.iter().find(|(known, _)| known == attribute).map_or("", |(_, value)| value.as_str())
            };
            let values: Vec<&str> = file.attributes.iter().map(value).collect();
            set.add(class_of(file, &object.class), &object.name, &values)
                .map_err(|error| WorldFlaw { field: format!("objects[{position}]"), message: refused(&error) })?;
        }
        Ok(set.count())
    }

    /// The state in the file.
    pub const fn start(&self) -> u64 {
        self.start
    }

    /// The file.
    pub const fn file(&self) -> &Arc<WorldFile> {
        &self.file
    }

    /// Lends the robot to a function.
    pub fn lend<R>(&self, use_it: impl FnOnce(&Robot<'_>) -> R) -> R {
        let names = Names::of(self);
        let attributes = names.attributes(&self.file);
        use_it(&Robot::of(self, &names, &attributes))
    }

    /// The robot until the program ends: its tables are never freed. For programs that meet few worlds.
    pub fn keep(self) -> Robot<'static> {
        let tables: &'static Self = Box::leak(Box::new(self));
        let names: &'static Names<'static> = Box::leak(Box::new(Names::of(tables)));
        Robot::of(tables, names, Vec::leak(names.attributes(&tables.file)))
    }
}

/// Builds the robot of a world file, and passes it on with its initial state.
///
/// ```
/// use goodbot::oomdp::check;
/// use goodbot_formats::world::WorldFile;
/// use goodbot_lesson::world::robot;
/// let file = WorldFile::parse(r#"{"type":"world","name":"hall","classes":["lamp"],"attributes":{},"propositions":{"on":["lamp"]},
///     "objects":[{"name":"a","class":"lamp"},{"name":"b","class":"lamp"}],"task_kinds":["on(?l)"],
///     "actions":[{"name":"light","parameters":{"?l":"lamp"},"conditions":["!on(?l)"],"effects":["on(?l)"]}]}"#)?;
/// let checked = robot::with(&file, |lamps, start| check(lamps, start, 1_000))??;
/// assert!(checked.all && checked.states == 4);
/// assert_eq!(robot::plan(&file, &"on(b)".parse()?)?, Some(vec!["light(b)".to_owned()]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The errors of [`Tables::of`].
pub fn with<R>(file: &WorldFile, use_it: impl FnOnce(&Robot<'_>, u64) -> R) -> Result<R, WorldFlaw> {
    let tables = Tables::of(Arc::new(file.clone()))?;
    Ok(tables.lend(|robot| use_it(robot, tables.start)))
}

/// The core's classes that carry an attribute, with the prefix of its values.
fn carriers(file: &WorldFile, name: &str, classes: &[String]) -> Vec<(ClassId, String)> {
    let mut all: Vec<(ClassId, String)> = Vec::new();
    for of in classes.iter().flat_map(|above| file.classes.iter().filter(move |class| file.is_a(class, above))) {
        let class = class_of(file, of);
        if all.iter().all(|(known, _)| *known != class) {
            let of = file.classes.get(class.index()).unwrap_or(of);
            all.push((class, format!("{of}{}", capitalised(name))));
        }
    }
    all
}

fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map(|first| first.to_ascii_uppercase()).into_iter().chain(letters).collect()
}

/// The reason why an object was refused, without the library's names.
fn refused(error: &ObjectError) -> String {
    match error {
        ObjectError::Capacity(error) => full(error).unwrap_or_else(|| error.to_string()),
        error => error.to_string(),
    }
}

/// The kinds of task of a robot's world.
///
/// # Errors
/// A [`WorldFlaw`] of one kind, or of all kinds if they have too many tasks together.
pub fn tasks(file: &WorldFile, robot: &Robot<'_>) -> Result<Vec<LiftedTask>, WorldFlaw> {
    if file.task_kinds.len() > LIFTED_TASKS {
        let message = format!("are {}, and {LIFTED_TASKS} are the most for a robot that acts; leave out some", file.task_kinds.len());
        return flaw("task_kinds", message);
    }
    let given = super::count_tasks(file).map_err(|error| WorldFlaw { field: "task_kinds".to_owned(), message: error.to_string() })?;
    if given > MOST_TASKS_OF_A_ROBOT {
        let message =
            format!("give {given} tasks, and {MOST_TASKS_OF_A_ROBOT} are the most for a robot that acts; leave out kinds or objects");
        return flaw("task_kinds", message);
    }
    let parse = |(position, kind): (usize, &goodbot_formats::task_text::LiftedTaskText)| {
        LiftedTask::parse(&kind.to_string(), &robot.world.schema)
            .map_err(|error| WorldFlaw { field: format!("task_kinds[{position}]"), message: error.to_string() })
    };
    file.task_kinds.iter().enumerate().map(parse).collect()
}

/// A robot from a world file.
#[derive(Clone, Copy, Debug)]
pub struct Robot<'w> {
    world: World<'w>,
    kinds: &'w [ActionKind<'w>],
    mechanism: &'w Mechanism,
    file: &'w Arc<WorldFile>,
}

impl<'w> Robot<'w> {
    fn of<'n: 'w>(tables: &'w Tables, names: &'w Names<'n>, attributes: &'w [Attribute<'w>]) -> Self {
        let Tables { rows, name_bytes, name_ends, count, mechanism, file, .. } = tables;
        let schema = Schema { classes: &names.classes, attributes, propositions: &names.propositions };
        let objects = Objects::new(ObjectTablesRef { objects: rows, name_bytes, name_ends }, *count);
        Self { world: World { schema, objects }, kinds: &names.kinds, mechanism, file }
    }

    /// The file that describes it.
    pub const fn file(&self) -> &'w Arc<WorldFile> {
        self.file
    }

    /// The state in which exactly these propositions hold.
    ///
    /// # Errors
    /// A [`WorldFlaw`] if a variable has no value or two, or if a proposition that no action changes differs from the file.
    pub fn state_of(&self, facts: &[GroundAtomText]) -> Result<u64, WorldFlaw> {
        let values = self.mechanism.values_of(facts, &self.file.variables, self.world)?;
        Ok(self.mechanism.digits.iter().zip(values).map(|(digit, value)| digit.unit * value).sum())
    }

    /// The facts of a state, in the order of the propositions and their objects.
    pub fn facts(&self, state: u64) -> Vec<GroundAtomText> {
        let changing = self.mechanism.places.iter().filter(|&(_, &(digit, value))| self.mechanism.has(state, digit, value));
        self.texts(changing.map(|(key, _)| key).chain(&self.mechanism.fixed))
    }

    /// The propositions that an action can change, in the same order.
    pub fn changing(&self) -> Vec<GroundAtomText> {
        self.texts(self.mechanism.places.keys())
    }

    fn texts<'k>(&self, keys: impl Iterator<Item = &'k Key>) -> Vec<GroundAtomText> {
        let all: BTreeSet<&Key> = keys.collect();
        let text = |(proposition, arguments): &&Key| {
            let count = self.world.schema.parameters(*proposition).len();
            let names = arguments.iter().take(count).map(|&object| self.world.objects.name(object));
            GroundAtomText::new(self.world.schema.proposition_name(*proposition), names).ok()
        };
        all.iter().filter_map(text).collect()
    }

    /// The propositions that can hold, and the digits' values with which they do; all others never hold. In the order of the propositions
    /// and their objects.
    pub fn where_facts_hold(&self) -> Vec<FactAt> {
        let Mechanism { places, fixed, digits, .. } = self.mechanism;
        let mut facts: Vec<FactAt> = Vec::new();
        for (&(proposition, arguments), &(digit, value)) in places {
            facts.extend(digits.get(digit).map(|&digit| FactAt { proposition, arguments, at: DigitAt { digit, value } }));
        }
        // A proposition that always holds is the only value of a digit.
        let always = DigitAt { digit: Digit { unit: 1, values: 1 }, value: 0 };
        facts.extend(fixed.iter().map(|&(proposition, arguments)| FactAt { proposition, arguments, at: always }));
        facts.sort_by_key(|fact| (fact.proposition, fact.arguments));
        facts
    }

    /// The rules of each action: the first rule whose conditions hold takes effect.
    pub fn rules(&self) -> Vec<Vec<Rule>> {
        let at = |digit: usize, value| self.mechanism.digits.get(digit).map(|&digit| DigitAt { digit, value });
        let rule = |case: &Case| Rule {
            conditions: case.conditions.iter().filter_map(|&(digit, value, wanted)| Some((at(digit, value)?, wanted))).collect(),
            effects: case.effects.iter().filter_map(|&(digit, value)| at(digit, value)).collect(),
        };
        self.mechanism.actions.iter().map(|action| action.cases.iter().map(rule).collect()).collect()
    }

    /// Whether any action can change a proposition.
    pub fn changes(&self, proposition: &GroundAtomText) -> bool {
        self.mechanism.places.contains_key(&key(self.world, proposition))
    }
}

impl Place for Robot<'_> {
    type Record = Vec<GroundAtomText>;
    type Recorded = SessionInWorld;

    fn record(&self, state: &u64) -> Vec<GroundAtomText> {
        self.facts(*state)
    }

    fn recorded(&self, record: &Vec<GroundAtomText>, session: RecordedSession) -> SessionInWorld {
        SessionInWorld { world: Arc::clone(self.file), facts: record.clone(), session }
    }
}

/// A proposition with its objects.
type Key = (PropositionId, [ObjectId; ARGUMENTS]);

/// A digit of the state number: `state / unit % values`.
#[derive(Clone, Copy, Debug)]
pub struct Digit {
    /// The number of combinations of the digits before it.
    pub unit: u64,
    /// How many values it has.
    pub values: u64,
}

/// A value of a digit.
#[derive(Clone, Copy, Debug)]
pub struct DigitAt {
    /// The digit.
    pub digit: Digit,
    /// The value.
    pub value: u64,
}

/// A proposition, and the digit's value with which it holds.
#[derive(Clone, Copy, Debug)]
pub struct FactAt {
    /// The proposition.
    pub proposition: PropositionId,
    /// Its objects; those beyond its parameters are 0.
    pub arguments: [ObjectId; ARGUMENTS],
    /// When it holds.
    pub at: DigitAt,
}

/// A rule of an action: its conditions and effects.
#[derive(Clone, Debug)]
pub struct Rule {
    /// Values that digits must have (`true`) or must not have (`false`).
    pub conditions: Vec<(DigitAt, bool)>,
    /// Values that digits get, one after the other.
    pub effects: Vec<DigitAt>,
}

impl Digit {
    fn of(self, state: u64) -> u64 {
        state / self.unit % self.values
    }

    fn set(self, state: u64, value: u64) -> u64 {
        state - self.of(state) * self.unit + value * self.unit
    }
}

#[derive(Clone, Debug, Default)]
struct Mechanism {
    digits: Vec<Digit>,
    states: u64,
    /// For each fact that can change: its digit, and the value with which it holds.
    places: HashMap<Key, (usize, u64)>,
    /// The facts that hold and cannot change.
    fixed: BTreeSet<Key>,
    actions: Vec<Grounded>,
    /// The derived facts of objects, and when each is so.
    derived: Vec<Derived>,
}

/// A derived fact of an object.
#[derive(Clone, Debug)]
struct Derived {
    object: ObjectId,
    name: String,
    /// It is so if the conditions of one of them hold; they have no effects.
    cases: Vec<Case>,
}

/// An action with objects for its parameters.
#[derive(Clone, Debug)]
struct Grounded {
    name: String,
    cost: u8,
    /// In order: the first case whose conditions hold takes effect.
    cases: Vec<Case>,
}

#[derive(Clone, Debug)]
struct Case {
    conditions: Vec<(usize, u64, bool)>,
    effects: Vec<(usize, u64)>,
}

impl Case {
    /// Whether its conditions hold with some of the possible values of each digit.
    fn is_possible(&self, possible: &[BTreeSet<u64>]) -> bool {
        self.conditions.iter().all(|&(digit, value, wanted)| {
            let is_as_wanted = |&it: &u64| (it == value) == wanted;
            possible.get(digit).is_some_and(|values| values.iter().any(is_as_wanted))
        })
    }
}

impl Mechanism {
    fn of(file: &WorldFile, world: World<'_>) -> Result<Self, WorldFlaw> {
        let changed: BTreeSet<&str> =
            file.actions.iter().flat_map(|action| &action.effects).map(|effect| effect.proposition.as_str()).collect();
        let (mut mechanism, members) = (Self::default(), Members::of(file));
        for (position, (name, classes)) in file.propositions.iter().enumerate() {
            let id = PropositionId::new(position as u8);
            if file.variables.contains(name) {
                let Some((last, firsts)) = classes.split_last() else { continue };
                let values = members.of_class(last);
                for arguments in choices(&members, firsts)? {
                    let digit = mechanism.add_digit(name, values.len() as u64)?;
                    for (value, &object) in values.iter().enumerate() {
                        let mut arguments = arguments;
                        if let Some(slot) = arguments.get_mut(firsts.len()) {
                            *slot = object;
                        }
                        mechanism.places.insert((id, arguments), (digit, value as u64));
                    }
                }
            } else if changed.contains(name.as_str()) {
                for arguments in choices(&members, classes)? {
                    let digit = mechanism.add_digit(name, 2)?;
                    mechanism.places.insert((id, arguments), (digit, 1));
                }
            }
        }
        for fact in &file.facts {
            let key = key(world, fact);
            if !mechanism.places.contains_key(&key) {
                mechanism.fixed.insert(key);
            }
        }
        for position in 0..file.actions.len() {
            mechanism.ground(position, file, &members, world)?;
        }
        // Words tell the objects of one class of the core apart by their own class.
        for (position, object) in file.objects.iter().enumerate() {
            if world.schema.class_name(class_of(file, &object.class)) != object.class {
                let always = Case { conditions: vec![], effects: vec![] };
                mechanism.derived.push(Derived { object: ObjectId::new(position as u8), name: object.class.clone(), cases: vec![always] });
            }
        }
        for position in 0..file.derived.len() {
            mechanism.derive(position, file, &members, world)?;
        }
        let fits = mechanism.number().is_ok() && mechanism.actions.len() <= Action::MOST;
        if !fits || mechanism.actions.len() > Action::MOST_ON_CONTROLLERS {
            let start = mechanism.values_of(&file.facts, &file.variables, world)?;
            // What fits is left whole, unless a controller can hold the rest alone.
            let mut possible = if fits { mechanism.clone() } else { std::mem::take(&mut mechanism) };
            possible.keep_possible(&start);
            if !fits || possible.actions.len() <= Action::MOST_ON_CONTROLLERS {
                mechanism = possible;
            }
            if mechanism.number().is_err() {
                let start = mechanism.values_of(&file.facts, &file.variables, world)?;
                mechanism.join_opposites(&start);
            }
        }
        if let Err(digit) = mechanism.number() {
            let of_digit = |&(_, &(of, _)): &(&Key, &(usize, u64))| of == digit;
            let name = mechanism.places.iter().find(of_digit).map_or("", |(&(id, _), _)| world.schema.proposition_name(id));
            return flaw(format!("propositions.{name}"), "gives more states than can be numbered; leave out objects or what changes");
        }
        if mechanism.actions.len() > Action::MOST {
            let message = format!(
                "give the robot {} actions with their objects, and {} are the most; give them fewer parameters",
                mechanism.actions.len(),
                Action::MOST
            );
            return flaw("actions", message);
        }
        Ok(mechanism)
    }

    fn add_digit(&mut self, name: &str, values: u64) -> Result<usize, WorldFlaw> {
        if self.digits.len() >= MOST_DIGITS {
            return flaw(format!("propositions.{name}"), "gives more variables than can be kept; leave out objects or what changes");
        }
        self.digits.push(Digit { unit: 0, values });
        Ok(self.digits.len() - 1)
    }

    /// Gives each digit its unit in the state number.
    ///
    /// # Errors
    /// The digit at which the numbers become too large.
    fn number(&mut self) -> Result<(), usize> {
        self.states = 1;
        for (position, digit) in self.digits.iter_mut().enumerate() {
            digit.unit = self.states;
            self.states = self.states.checked_mul(digit.values).filter(|&states| states < u64::MAX).ok_or(position)?;
        }
        Ok(())
    }

    /// Leaves out all that is impossible from these values of the digits on: digits that keep their value, values that never occur, and
    /// actions that need them.
    fn keep_possible(&mut self, start: &[u64]) {
        let possible = self.possible(start);
        let cases =
            self.actions.iter_mut().map(|action| &mut action.cases).chain(self.derived.iter_mut().map(|derived| &mut derived.cases));
        cases.for_each(|cases| cases.retain(|case| case.is_possible(&possible)));
        self.actions.retain(|action| !action.cases.is_empty());
        let is_kept = |digit: usize| possible.get(digit).is_some_and(|values| values.len() > 1);
        // The new positions of the digits and their values.
        let mut next = 0..;
        let digits: Vec<usize> = possible.iter().map(|values| if values.len() > 1 { next.next().unwrap_or(0) } else { 0 }).collect();
        let at = |digit: usize, value: u64| -> Option<(usize, u64)> {
            let before = possible.get(digit)?.range(..value).count();
            Some((*digits.get(digit)?, before as u64))
        };
        let is_value = |digit: usize, value: u64| possible.get(digit).is_some_and(|values| values.contains(&value));
        for case in self.cases_mut() {
            // Only possible cases are left, so a condition on an impossible value demands another value, and always holds.
            case.conditions.retain(|&(digit, value, _)| is_kept(digit) && is_value(digit, value));
            case.effects.retain(|&(digit, _)| is_kept(digit));
            let conditions = case.conditions.iter_mut().map(|(digit, value, _)| (digit, value));
            for (digit, value) in conditions.chain(case.effects.iter_mut().map(|(digit, value)| (digit, value))) {
                (*digit, *value) = at(*digit, *value).unwrap_or((*digit, *value));
            }
        }
        let placed = std::mem::take(&mut self.places).into_iter().filter(|&(_, (digit, value))| is_value(digit, value));
        let (changing, fixed): (Vec<_>, Vec<_>) = placed.partition(|&(_, (digit, _))| is_kept(digit));
        self.fixed.extend(fixed.into_iter().map(|(key, _)| key));
        self.places = changing.into_iter().filter_map(|(key, (digit, value))| Some((key, at(digit, value)?))).collect();
        let kept = possible.iter().filter(|values| values.len() > 1);
        self.digits = kept.map(|values| Digit { unit: 0, values: values.len() as u64 }).collect();
    }

    /// Lets two propositions share a digit if one of them holds and the other does not, and each action that changes one changes the other:
    /// lamps that are on or off then have half as many digits.
    fn join_opposites(&mut self, start: &[u64]) {
        // For each digit, the cases that set it, and the last value that each gives it.
        let mut changes: Vec<BTreeMap<usize, u64>> = vec![BTreeMap::new(); self.digits.len()];
        for (number, case) in self.actions.iter().flat_map(|action| &action.cases).enumerate() {
            for &(digit, value) in &case.effects {
                changes.iter_mut().skip(digit).take(1).for_each(|of_digit| {
                    of_digit.insert(number, value);
                });
            }
        }
        // The digits of variables have a proposition for each value.
        let of_variables: BTreeSet<usize> = self.places.values().filter(|&&(_, value)| value == 0).map(|&(digit, _)| digit).collect();
        let mut alone: HashMap<(u64, BTreeMap<usize, u64>), usize> = HashMap::new();
        // The new position of each digit, and whether its values are exchanged.
        let (mut joined, mut next) = (Vec::new(), 0..);
        for (digit, (of_digit, &value)) in changes.into_iter().zip(start).enumerate() {
            let is_of_variable = of_variables.contains(&digit);
            let opposite = (exchanged(value), of_digit.iter().map(|(&case, &value)| (case, exchanged(value))).collect());
            let other = if is_of_variable { None } else { alone.remove(&opposite) };
            let place = other.or_else(|| next.next()).unwrap_or(0);
            if other.is_none() && !is_of_variable {
                alone.insert((value, of_digit), place);
            }
            joined.push((place, other.is_some()));
        }
        let at = |digit: &mut usize, value: &mut u64| {
            if let Some(&(place, is_exchanged)) = joined.get(*digit) {
                (*digit, *value) = (place, if is_exchanged { exchanged(*value) } else { *value });
            }
        };
        for case in self.cases_mut() {
            case.conditions.iter_mut().for_each(|(digit, value, _)| at(digit, value));
            case.effects.iter_mut().for_each(|(digit, value)| at(digit, value));
        }
        self.places.values_mut().for_each(|(digit, value)| at(digit, value));
        let kept = std::mem::take(&mut self.digits).into_iter().zip(&joined).filter(|(_, (_, is_joined))| !is_joined);
        self.digits = kept.map(|(digit, _)| digit).collect();
    }

    /// The cases of all actions and derived facts.
    fn cases_mut(&mut self) -> impl Iterator<Item = &mut Case> {
        let of_actions = self.actions.iter_mut().flat_map(|action| &mut action.cases);
        of_actions.chain(self.derived.iter_mut().flat_map(|derived| &mut derived.cases))
    }

    /// The possible values of each digit, and perhaps more: each effect counts as if the old value stayed possible too.
    fn possible(&self, start: &[u64]) -> Vec<BTreeSet<u64>> {
        let mut possible: Vec<BTreeSet<u64>> = start.iter().map(|&value| BTreeSet::from([value])).collect();
        let mut left: Vec<&Case> = self.actions.iter().flat_map(|action| &action.cases).collect();
        loop {
            let before = left.len();
            left.retain(|case| {
                let is_possible = case.is_possible(&possible);
                for &(digit, value) in case.effects.iter().filter(|_| is_possible) {
                    possible.iter_mut().skip(digit).take(1).for_each(|values| {
                        values.insert(value);
                    });
                }
                !is_possible
            });
            if left.len() == before {
                return possible;
            }
        }
    }

    /// The values of the digits with these facts.
    fn values_of(&self, facts: &[GroundAtomText], variables: &[String], world: World<'_>) -> Result<Vec<u64>, WorldFlaw> {
        let (mut start, mut told, mut fixed) = (vec![0; self.digits.len()], BTreeMap::new(), BTreeSet::new());
        for (position, fact) in facts.iter().enumerate() {
            let key = key(world, fact);
            let Some(&(digit, value)) = self.places.get(&key) else {
                if !self.fixed.contains(&key) {
                    return flaw(format!("facts[{position}]"), "holds here and not in the world, and no action changes it; leave it out");
                }
                fixed.insert(key);
                continue;
            };
            let before = told.insert(digit, value);
            if before.is_some() && variables.iter().any(|name| name == fact.function()) {
                return flaw(format!("facts[{position}]"), "gives a variable a second value; leave one of the two");
            }
            if before.is_some_and(|before| before != value) {
                return flaw(format!("facts[{position}]"), "is the opposite of a fact before it, by all actions; leave one of the two");
            }
            start.iter_mut().skip(digit).take(1).for_each(|slot| *slot = value);
        }
        if fixed.len() < self.fixed.len() {
            return flaw("facts", "leave out a proposition that holds in the world and that no action changes; add it");
        }
        let mut places: Vec<(&Key, &(usize, u64))> = self.places.iter().collect();
        places.sort();
        let opposites: HashMap<usize, &Key> =
            places.iter().filter(|(_, (_, value))| *value == 0).map(|&(key, &(digit, _))| (digit, key)).collect();
        for (key, &(digit, value)) in places {
            if told.contains_key(&digit) {
                continue;
            }
            let named = |&(proposition, arguments): &Key, without: usize| {
                let count = world.schema.parameters(proposition).len() - without;
                let of: Vec<&str> = arguments.iter().take(count).map(|&object| world.objects.name(object)).collect();
                (world.schema.proposition_name(proposition), of)
            };
            let (name, of) = named(key, 1);
            if variables.iter().any(|variable| variable == name) {
                return flaw("facts", format!("say no value of the variable {name} of {}; add it", of.join(", ")));
            }
            if let Some(opposite) = opposites.get(&digit).filter(|_| value == 1) {
                let [one, other] = [key, opposite].map(|key| {
                    let (name, of) = named(key, 0);
                    format!("{name}({})", of.join(","))
                });
                return flaw("facts", format!("say neither {one} nor {other}, and by all actions one of them holds; add it"));
            }
        }
        Ok(start)
    }

    /// Adds one of the file's actions with each choice of objects, or its cases to those of an earlier action of the same name and objects.
    fn ground(&mut self, position: usize, file: &WorldFile, members: &Members<'_>, world: World<'_>) -> Result<(), WorldFlaw> {
        let Some((action, before)) = file.actions.get(..=position).and_then(<[_]>::split_last) else { return Ok(()) };
        let has_earlier_cases = before.iter().any(|other| other.name == action.name);
        let earlier = self.actions.iter().enumerate().filter(|_| has_earlier_cases);
        let earlier: HashMap<String, usize> = earlier.map(|(at, action)| (action.name.clone(), at)).collect();
        let free = free_variables(file, &action.conditions, |name| action.parameters.iter().any(|(known, _)| known == name));
        let bound: Vec<(&str, &str)> = action.parameters.iter().map(|(name, of)| (name.as_str(), of.as_str())).collect();
        let tries = Tries::new(format!("actions[{position}]"), "can be done with more objects than can be tried; give it fewer variables");
        let mut one = |binding: &Binding<'_>| -> Result<(), WorldFlaw> {
            let mut cases = Vec::new();
            each_binding(members, &free, binding, &tries, &mut |binding| {
                cases.extend(self.case(&action.conditions, &action.effects, world, binding));
                Ok(())
            })?;
            if !cases.is_empty() {
                let arguments: Vec<&str> =
                    bound.iter().filter_map(|(name, _)| binding.get(name)).map(|&object| world.objects.name(object)).collect();
                let name = if arguments.is_empty() { action.name.clone() } else { format!("{}({})", action.name, arguments.join(",")) };
                match earlier.get(&name).and_then(|&at| self.actions.get_mut(at)) {
                    Some(known) => known.cases.append(&mut cases),
                    None => self.actions.push(Grounded { name, cost: action.cost, cases }),
                }
            }
            Ok(())
        };
        each_binding(members, &bound, &BTreeMap::new(), &tries, &mut one)
    }

    /// Adds a derived fact of each object, or further cases of one that is there.
    fn derive(&mut self, position: usize, file: &WorldFile, members: &Members<'_>, world: World<'_>) -> Result<(), WorldFlaw> {
        let Some(all) = file.derived.get(position) else { return Ok(()) };
        let free = free_variables(file, &all.conditions, |name| *name == all.of);
        let tries = Tries::new(format!("derived[{position}]"), "has more choices of objects than can be tried; give it fewer variables");
        for &object in members.of_class(&all.class) {
            let mut cases = Vec::new();
            each_binding(members, &free, &BTreeMap::from([(all.of.as_str(), object)]), &tries, &mut |binding| {
                cases.extend(self.case(&all.conditions, &[], world, binding));
                Ok(())
            })?;
            match self.derived.iter_mut().find(|known| known.object == object && known.name == all.name) {
                Some(known) => known.cases.append(&mut cases),
                None => self.derived.push(Derived { object, name: all.name.clone(), cases }),
            }
        }
        Ok(())
    }

    /// The case of an action or a derived fact with these objects, if its fixed conditions hold.
    fn case(&self, conditions: &[Literal], effects: &[Literal], world: World<'_>, binding: &Binding<'_>) -> Option<Case> {
        let key = |literal: &Literal| -> Option<Key> {
            let mut arguments = [ObjectId::new(0); ARGUMENTS];
            for (slot, term) in arguments.iter_mut().zip(&literal.terms) {
                *slot = match term {
                    Term::Variable(name) => *binding.get(name.as_str())?,
                    Term::Object(name) => world.objects.find(name)?,
                };
            }
            Some((world.schema.proposition(&literal.proposition)?, arguments))
        };
        let mut case = Case { conditions: vec![], effects: vec![] };
        for condition in conditions {
            let key = key(condition)?;
            match self.places.get(&key) {
                Some(&(digit, value)) => case.conditions.push((digit, value, !condition.negated)),
                None if self.fixed.contains(&key) == condition.negated => return None,
                None => {}
            }
        }
        for effect in effects {
            let &(digit, value) = self.places.get(&key(effect)?)?;
            case.effects.push((digit, if effect.negated { 0 } else { value }));
        }
        Some(case)
    }

    fn has(&self, state: u64, digit: usize, value: u64) -> bool {
        self.digits.get(digit).is_some_and(|digit| digit.of(state) == value)
    }

    fn is_so(&self, state: u64, case: &Case) -> bool {
        case.conditions.iter().all(|&(digit, value, wanted)| self.has(state, digit, value) == wanted)
    }
}

/// The variables of conditions that `is_bound` does not know, each with its class.
fn free_variables<'c>(file: &'c WorldFile, conditions: &'c [Literal], is_bound: impl Fn(&String) -> bool) -> Vec<(&'c str, &'c str)> {
    let mut free: Vec<(&str, &str)> = Vec::new();
    for literal in conditions {
        let classes = file.propositions.iter().find(|(name, _)| *name == literal.proposition).map_or(&[][..], |(_, classes)| classes);
        for (term, class) in literal.terms.iter().zip(classes) {
            let Term::Variable(name) = term else { continue };
            match free.iter_mut().find(|(known, _)| known == name) {
                None if is_bound(name) => {}
                None => free.push((name, class)),
                // The lower of two classes counts.
                Some((_, known)) if file.is_a(class, known) => *known = class,
                Some(_) => {}
            }
        }
    }
    free
}

/// All choices of different objects of these classes.
fn choices(members: &Members<'_>, classes: &[String]) -> Result<Vec<[ObjectId; ARGUMENTS]>, WorldFlaw> {
    let names = ["0", "1", "2"];
    let variables: Vec<(&str, &str)> = names.iter().copied().zip(classes.iter().map(String::as_str)).collect();
    let mut all = Vec::new();
    let tries = Tries::new("objects".to_owned(), "give more propositions than can be told apart; leave out some");
    each_binding(members, &variables, &BTreeMap::new(), &tries, &mut |binding| {
        let mut arguments = [ObjectId::new(0); ARGUMENTS];
        for (slot, (name, _)) in arguments.iter_mut().zip(&variables) {
            *slot = binding.get(name).copied().unwrap_or(ObjectId::new(0));
        }
        all.push(arguments);
        Ok(())
    })?;
    Ok(all)
}

/// The other value of a digit with two.
const fn exchanged(value: u64) -> u64 {
    1_u64.wrapping_sub(value)
}

/// The object of each variable.
type Binding<'v> = BTreeMap<&'v str, ObjectId>;

/// How many more objects may be tried, and the fault to report when none are left.
struct Tries {
    left: Cell<usize>,
    field: String,
    message: &'static str,
}

impl Tries {
    const fn new(field: String, message: &'static str) -> Self {
        Self { left: Cell::new(MOST_CASES), field, message }
    }

    fn take(&self) -> Result<(), WorldFlaw> {
        match self.left.get().checked_sub(1) {
            Some(left) => {
                self.left.set(left);
                Ok(())
            }
            None => flaw(self.field.clone(), self.message),
        }
    }
}

/// Calls `each` for each choice of objects for the variables, beside those that have objects already. Different variables have different
/// objects.
fn each_binding<'v>(
    members: &Members<'_>,
    variables: &[(&'v str, &str)],
    before: &Binding<'v>,
    tries: &Tries,
    each: &mut dyn FnMut(&Binding<'v>) -> Result<(), WorldFlaw>,
) -> Result<(), WorldFlaw> {
    let Some((&(name, class), rest)) = variables.split_first() else { return each(before) };
    for &object in members.of_class(class) {
        tries.take()?;
        if before.values().all(|&taken| taken != object) {
            let mut binding = before.clone();
            binding.insert(name, object);
            each_binding(members, rest, &binding, tries, each)?;
        }
    }
    Ok(())
}

fn key(world: World<'_>, fact: &GroundAtomText) -> Key {
    let mut arguments = [ObjectId::new(0); ARGUMENTS];
    for (slot, name) in arguments.iter_mut().zip(fact.arguments()) {
        *slot = world.objects.find(name).unwrap_or(ObjectId::new(0));
    }
    (world.schema.proposition(fact.function()).unwrap_or(PropositionId::new(0)), arguments)
}

impl Domain for Robot<'_> {
    type State = u64;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        self.world
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        self.kinds
    }

    fn step(&self, state: &u64, action: Action) -> Option<u64> {
        let cases = &self.mechanism.actions.get(action.index())?.cases;
        let case = cases.iter().find(|case| self.mechanism.is_so(*state, case))?;
        let set =
            |state: u64, &(digit, value): &(usize, u64)| self.mechanism.digits.get(digit).map_or(state, |digit| digit.set(state, value));
        Some(case.effects.iter().fold(*state, set))
    }

    fn holds(&self, proposition: &GroundProposition, state: &u64) -> bool {
        // Arguments beyond the parameters have no meaning.
        let mut arguments = proposition.arguments;
        let count = self.world.schema.parameters(proposition.proposition).len();
        arguments.iter_mut().skip(count).for_each(|slot| *slot = ObjectId::new(0));
        let key = (proposition.proposition, arguments);
        match self.mechanism.places.get(&key) {
            Some(&(digit, value)) => self.mechanism.has(*state, digit, value),
            None => self.mechanism.fixed.contains(&key),
        }
    }

    fn state_count(&self) -> u64 {
        self.mechanism.states
    }

    fn number(&self, state: &u64) -> u64 {
        *state
    }

    fn numbered(&self, number: u64) -> u64 {
        number
    }

    fn tell_derived(&self, state: &u64, object: ObjectId, tell: &mut dyn FnMut(&str)) {
        let is_so = |derived: &&Derived| derived.cases.iter().any(|case| self.mechanism.is_so(*state, case));
        self.mechanism.derived.iter().filter(|derived| derived.object == object).filter(is_so).for_each(|derived| tell(&derived.name));
    }

    fn admits(&self, proposition: &GroundProposition) -> bool {
        let Some((_, classes)) = self.file.propositions.get(proposition.proposition.index()).filter(|_| !self.file.parents.is_empty())
        else {
            return true;
        };
        let class = |object: ObjectId| self.file.objects.get(object.index()).map_or("", |object| object.class.as_str());
        proposition.arguments.iter().zip(classes).all(|(&object, above)| self.file.is_a(class(object), above))
    }
}

/// One of the cheapest plans that make a task hold, from the state in the world file; `None` if that is impossible, or it is no task there.
///
/// # Errors
/// The errors of [`with`].
pub fn plan(file: &WorldFile, task: &GroundTaskText) -> Result<Option<Vec<String>>, WorldFlaw> {
    with(file, |robot, start| {
        let lifted = tasks(file, robot)?;
        planned(robot, start, &lifted, task).map_err(|error| WorldFlaw { field: "task_kinds".to_owned(), message: error.to_string() })
    })?
}

fn planned(robot: &Robot<'_>, start: u64, lifted: &[LiftedTask], task: &GroundTaskText) -> Result<Option<Vec<String>>, AgentError> {
    let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), lifted, Options::DEFAULT)?;
    let is_meant = |grounded: &GroundedTask, lifted: &LiftedTask| task_name(robot, lifted, grounded).is_ok_and(|name| name.is_same(task));
    // The words mean nothing; the prior alone gives the task.
    match agent.hear_with_prior(robot, &start, "do", |grounded, lifted| f32::from(u8::from(is_meant(grounded, lifted)))) {
        Err(AgentError::NoPrior | AgentError::NoTask) => return Ok(None),
        heard => heard?,
    }
    let (mut state, mut actions) = (start, Vec::new());
    loop {
        agent.plan_fully(robot, &state)?;
        let decision = agent.decide(robot, &state)?;
        if decision.action == Action::NOOP {
            return Ok((decision.plan == OptimalSet::Goal).then_some(actions));
        }
        actions.push(action_name(robot, decision.action).to_owned());
        state = agent.acted(robot, &state, decision.action)?;
    }
}
