//! A world from a file, and the tasks that commands may mean in it.
//!
//! A world without actions needs no plan, so it may have thousands of tasks. The role model reads a description of each:
//!
//! - its form is the number of its propositions and of their arguments;
//! - one role has the words of the propositions' names, cut at capital letters: `coverOpen` and `coverClosed` share `cover`;
//! - one role for each argument has the values of its object, a sort for each attribute, and the propositions that hold for the object
//!   alone.
//!
//! So words learned for an object in one kind of task serve in all kinds. After other commands of a conversation, these roles have facts of
//! [`before`] too, if the description has room for all of them.
//!
//! A world with actions belongs to a robot: see [`robot`], which also words the faults of such a world. The role model reads its tasks as
//! it reads those of a home, so words learned in one are understood in the other. [`check`] walks through sessions in it.

pub mod before;
pub mod pddl;
pub mod robot;

use crate::checked::{CheckedSession, Checker, has_steps};
use crate::fault::{Fault, quoted};
use before::Step;
use goodbot::capacity::{NAME_BYTES, TOKENS_PER_COMMAND};
use goodbot::oomdp::{Domain, PropositionId, action_named};
use goodbot::task::{LiftedTask, Marker, Role, RoleKind, VALUE_SORTS};
use goodbot_formats::session::StepRecord;
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText, LiftedTaskText};
use goodbot_formats::world::{ObjectOfWorld, SessionInWorld, WorldFile};
use robot::Robot;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The most tasks that one world may have.
pub const MOST_TASKS: usize = 100_000;

/// A task that a command may mean in a world.
#[derive(Clone, Debug, PartialEq)]
pub struct Meaning {
    /// The task.
    pub name: GroundTaskText,
    /// Its propositions, and the values of its objects.
    pub label: String,
    /// Its probability before any word: all tasks are equally probable. With an equal share for each kind, the only task of its kind would
    /// be more probable than any of hundreds.
    pub prior: f32,
    /// The tokens that the role model reads: markers such as `@8000`, and values.
    pub description: Vec<String>,
}

/// A world with more tasks than [`MOST_TASKS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooMany;

impl std::fmt::Display for TooMany {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "gives more than {MOST_TASKS} tasks; give its kinds of task fewer variables, or leave out objects")
    }
}

/// The tasks of a world in which `facts` hold, after the steps `before`. Each kind of task is grounded with different objects for its
/// variables; tasks that hold already are left out.
///
/// # Errors
/// [`TooMany`].
pub fn meanings(world: &WorldFile, facts: &[GroundAtomText], before: &[Arc<Step>]) -> Result<Vec<Meaning>, TooMany> {
    let facts: BTreeSet<&GroundAtomText> = facts.iter().collect();
    let scenes = [Scene::of(world, &facts, before), Scene::of(world, &facts, &[])];
    let [scene, alone] = &scenes;
    let mut meanings: Vec<Meaning> = Vec::new();
    for atoms in tasks(world, &facts)? {
        let has_room = |description: &Vec<String>| description.len() <= TOKENS_PER_COMMAND;
        let description = Some(scene.description(&atoms)).filter(has_room).unwrap_or_else(|| alone.description(&atoms));
        let label = alone.label(&atoms);
        let Ok(name) = GroundTaskText::new(atoms) else { continue };
        meanings.push(Meaning { name, label, prior: 0.0, description });
    }
    let share = 1.0 / meanings.len() as f32;
    meanings.iter_mut().for_each(|meaning| meaning.prior = share);
    Ok(meanings)
}

/// How many tasks a world has in the state that it describes.
///
/// # Errors
/// [`TooMany`].
pub fn count_tasks(world: &WorldFile) -> Result<usize, TooMany> {
    Ok(tasks(world, &world.facts.iter().collect())?.len())
}

/// The propositions of each task.
fn tasks(world: &WorldFile, facts: &BTreeSet<&GroundAtomText>) -> Result<Vec<Vec<GroundAtomText>>, TooMany> {
    let mut tasks: Vec<Vec<GroundAtomText>> = Vec::new();
    let mut known = BTreeSet::new();
    for kind in &world.task_kinds {
        for objects in bindings(world, kind, MOST_TASKS - tasks.len())? {
            let atoms: Vec<GroundAtomText> = kind.atoms().iter().filter_map(|atom| ground(atom, &objects)).collect();
            // `swapped(?a) & swapped(?b)` is one task for two objects, in either order.
            let is_known = atoms.len() > 1 && !known.insert(atoms.iter().cloned().collect::<BTreeSet<_>>());
            if !is_known && !atoms.iter().all(|atom| facts.contains(atom)) {
                tasks.push(atoms);
            }
        }
    }
    Ok(tasks)
}

/// An assignment of objects to the variables of a kind of task.
type Binding<'w> = Vec<(&'w str, &'w str)>;

fn ground(atom: &goodbot_formats::task_text::LiftedAtomText, objects: &Binding<'_>) -> Option<GroundAtomText> {
    let object = |variable: &String| objects.iter().find(|(known, _)| known == variable).map_or("", |&(_, object)| object);
    GroundAtomText::new(atom.function(), atom.variables().iter().map(object)).ok()
}

/// All assignments of different objects to the variables of a kind of task, in the order of the objects, the last variable fastest.
fn bindings<'w>(world: &'w WorldFile, kind: &'w LiftedTaskText, most: usize) -> Result<Vec<Binding<'w>>, TooMany> {
    let mut variables: Vec<(&str, &str)> = Vec::new();
    for atom in kind.atoms() {
        let parameters = world.propositions.iter().find(|(name, _)| name == atom.function()).map_or(&[][..], |(_, parameters)| parameters);
        for (variable, class) in atom.variables().iter().zip(parameters) {
            match variables.iter_mut().find(|(known, _)| known == variable) {
                None => variables.push((variable, class)),
                // The lower of two classes counts.
                Some((_, known)) if world.is_a(class, known) => *known = class,
                Some(_) => {}
            }
        }
    }
    let mut all: Vec<Binding<'w>> = vec![vec![]];
    for (variable, class) in variables {
        let mut next = Vec::new();
        for before in &all {
            for object in world.objects.iter().filter(|object| world.is_a(&object.class, class)) {
                if before.iter().all(|(_, other)| *other != object.name) {
                    let mut binding = before.clone();
                    binding.push((variable, &object.name));
                    next.push(binding);
                }
                if next.len() > most {
                    return Err(TooMany);
                }
            }
        }
        all = next;
    }
    Ok(all)
}

/// The tokens for each object.
struct Scene<'w> {
    objects: BTreeMap<&'w str, Vec<(usize, String)>>,
    /// The sort of tokens for facts.
    last: usize,
    before: &'w [Arc<Step>],
}

impl<'w> Scene<'w> {
    fn of(world: &'w WorldFile, facts: &BTreeSet<&GroundAtomText>, before: &'w [Arc<Step>]) -> Self {
        // An odd sort belongs to objects at a goal, and training begins with no word for its values. So sorts are even, unless a class has
        // so many attributes that most would share the last one.
        let carried =
            |class: &String| world.attributes.iter().filter(|(_, classes)| classes.iter().any(|above| world.is_a(class, above))).count();
        let most = world.classes.iter().map(carried).max().unwrap_or(0);
        let step = if most <= VALUE_SORTS / 2 + 1 { 2 } else { 1 };
        let numbers = (0..).step_by(step);
        let sorts: BTreeMap<&str, usize> = world.attributes.iter().zip(numbers).map(|((name, _), sort)| (name.as_str(), sort)).collect();
        // The propositions that hold for an object alone, by its name.
        let mut alone: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for fact in facts {
            if let [object] = fact.arguments() {
                alone.entry(object).or_default().push(fact.function());
            }
        }
        let last = VALUE_SORTS - step;
        let said = |object: &'w ObjectOfWorld| {
            let mut said: Vec<(usize, String)> = Vec::new();
            for (attribute, value) in &object.attributes {
                let sort = sorts.get(attribute.as_str()).copied().unwrap_or(last);
                said.push((sort.min(last), token(attribute, value)));
                // A value can be the name of another object, such as a lamp's room. The facts of the room then count for the lamp.
                for fact in alone.get(value.as_str()).into_iter().flatten() {
                    said.push((last, token(attribute, fact)));
                }
            }
            for fact in alone.get(object.name.as_str()).into_iter().flatten() {
                said.push((last, token("is", fact)));
            }
            if world.parents.iter().any(|(below, _)| *below == object.class) {
                said.push((last, token("is", &object.class)));
            }
            said.extend(before::of_object(before, object).into_iter().map(|fact| (last, fact)));
            said.sort();
            said.dedup();
            (object.name.as_str(), said)
        };
        Self { objects: world.objects.iter().map(said).collect(), last, before }
    }

    fn label(&self, atoms: &[GroundAtomText]) -> String {
        let mut words: Vec<&str> = atoms.iter().map(GroundAtomText::function).collect();
        let objects: Vec<&String> = atoms.iter().flat_map(GroundAtomText::arguments).collect();
        words.extend(objects.iter().flat_map(|object| self.said(object)).map(|(_, value)| value.as_str()));
        words.join(" ")
    }

    fn said(&self, object: &str) -> &[(usize, String)] {
        self.objects.get(object).map_or(&[], Vec::as_slice)
    }

    fn description(&self, atoms: &[GroundAtomText]) -> Vec<String> {
        let arguments: Vec<String> = atoms.iter().map(|atom| atom.arguments().len().to_string()).collect();
        let mut description = vec![format!("task{}", arguments.join("&"))];
        for (position, atom) in atoms.iter().enumerate() {
            let proposition = PropositionId::new(position as u8);
            let marker = |role, sort| Marker { role, sort }.to_string();
            let mut words: Vec<String> = parts_of_name(atom.function()).map(|part| token("is", part)).collect();
            words.extend(before::of_proposition(self.before, atom.function()));
            words.sort();
            words.dedup();
            description.push(marker(Role::of_name(proposition), 0));
            description.extend(words);
            for (argument, object) in atom.arguments().iter().enumerate() {
                let was_there = before::of_argument(self.before, atom, object).map(|fact| (self.last, fact));
                let mut sort = None;
                for (next, value) in self.said(object).iter().cloned().chain(was_there) {
                    if sort != Some(next) {
                        sort = Some(next);
                        description.push(marker(Role::of_argument(RoleKind::Goal, proposition, argument), next as u8));
                    }
                    description.push(value);
                }
            }
        }
        description
    }
}

/// `color` and `red` make `colorRed`. A token that is too long is cut.
fn token(attribute: &str, value: &str) -> String {
    let mut token = attribute.to_owned();
    let mut letters = value.chars();
    token.extend(letters.next().map(|first| first.to_ascii_uppercase()));
    token.push_str(letters.as_str());
    while token.len() > NAME_BYTES {
        token.pop();
    }
    token
}

/// The values of a world that are numbers, alone or after their class: `30`, or `number30` of the class `number`. Each token
/// with its digits, which name the value in every language.
pub fn numbers(world: &WorldFile) -> BTreeMap<String, String> {
    let values = world.objects.iter().flat_map(|object| object.attributes.iter().map(move |it| (object, it)));
    let number = |(object, (attribute, value)): (&ObjectOfWorld, &(String, String))| {
        let digits = value.strip_prefix(&object.class).unwrap_or(value).replacen('_', ".", 1);
        let is_number = digits.split('.').all(|part| !part.is_empty() && part.bytes().all(|digit| digit.is_ascii_digit()));
        is_number.then(|| (token(attribute, value), digits))
    };
    values.filter_map(number).collect()
}

/// The parts of a name, each from a capital letter to the next.
fn parts_of_name(name: &str) -> impl Iterator<Item = &str> {
    let mut rest = name;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let end = rest.char_indices().skip(1).find(|(_, letter)| letter.is_uppercase()).map_or(rest.len(), |(at, _)| at);
        let (part, after) = rest.split_at(end);
        rest = after;
        Some(part)
    })
}

/// Checks a session and walks through it, with the robot of its world. `lifted` are the kinds of task that commands may mean there.
///
/// # Errors
/// All faults of the session.
pub fn check<'w>(
    file: &str,
    recorded: &SessionInWorld,
    robot: Robot<'w>,
    lifted: &[LiftedTask],
) -> Result<CheckedSession<Robot<'w>>, Vec<Fault>> {
    let mut checker = Checker::new(file, &recorded.session, ("world", "objects"));
    checker.command();
    match robot.state_of(&recorded.facts) {
        Ok(start) => checker.session(robot, start, lifted, |robot, _, record| impossible(robot, record)),
        Err(flaw) => {
            checker.fault(flaw.field, flaw.message);
            Err(checker.into_faults())
        }
    }
}

/// As [`check`], for a session that is replayed. A labelled session is refused, because it has no steps.
///
/// # Errors
/// All faults of the session.
pub fn check_steps<'w>(
    file: &str,
    recorded: &SessionInWorld,
    robot: Robot<'w>,
    lifted: &[LiftedTask],
) -> Result<CheckedSession<Robot<'w>>, Vec<Fault>> {
    has_steps(file, &recorded.session)?;
    check(file, recorded, robot, lifted)
}

fn impossible(robot: &Robot<'_>, record: &StepRecord) -> String {
    let action = quoted(&record.action);
    if action_named(robot, &record.action).is_none() {
        let known: Vec<&str> = robot.actions().iter().map(|kind| kind.name).collect();
        return format!("{action} is no action of this world; it has {} and noop", known.join(", "));
    }
    format!(
        "{action} cannot be done here: its conditions do not hold after the steps before it; correct the steps, or leave out the session"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use goodbot_formats::world::{Line, WorldReader};

    /// The sorts in the description of a lamp with this many attributes.
    fn sorts(attributes: usize) -> Vec<u8> {
        let names = || (0..attributes).map(|number| format!("a{number}"));
        let carried: Vec<String> = names().map(|name| format!(r#""{name}":["lamp"]"#)).collect();
        let values: Vec<String> = names().map(|name| format!(r#""{name}":"v""#)).collect();
        let world = format!(
            r#"{{"type":"world","name":"hall","classes":["lamp"],"attributes":{{{}}},"propositions":{{"on":["lamp"]}},"objects":[{{"name":"b","class":"lamp","attributes":{{{}}}}}],"task_kinds":["on(?l)"]}}"#,
            carried.join(","),
            values.join(",")
        );
        let Some(Ok(Line::World(world))) = WorldReader::new(world.as_bytes()).next() else { panic!("a world") };
        let description = meanings(&world, &[], &[]).unwrap().remove(0).description;
        let markers = description.iter().filter_map(|token| token.parse::<Marker>().ok());
        markers.filter(|marker| marker.role.kind() == RoleKind::Goal).map(|marker| marker.sort).collect()
    }

    #[test]
    fn a_task_of_a_class_is_about_objects_of_the_classes_below_too_and_their_class_tells_them_apart() {
        let world = r#"{"type":"world","name":"hall","classes":["thing","ball","box"],"parents":{"ball":"thing","box":"thing"},"attributes":{},
            "propositions":{"there":["thing"],"rolled":["ball"]},"objects":[{"name":"a","class":"ball"},{"name":"b","class":"box"}],
            "task_kinds":["there(?x)","rolled(?x)","there(?x) & rolled(?x)"]}"#;
        let world = WorldFile::parse(world).unwrap();
        let meanings = meanings(&world, &[], &[]).unwrap();
        let labels: Vec<(String, &str)> = meanings.iter().map(|meaning| (meaning.name.to_string(), meaning.label.as_str())).collect();
        let labels: Vec<(&str, &str)> = labels.iter().map(|(name, label)| (name.as_str(), *label)).collect();
        let both = ("there(a) & rolled(a)", "there rolled isBall isBall");
        assert_eq!(labels, [("there(a)", "there isBall"), ("there(b)", "there isBox"), ("rolled(a)", "rolled isBall"), both]);
    }

    #[test]
    fn training_begins_with_words_for_every_attribute_of_an_object_and_many_attributes_have_a_sort_each() {
        assert_eq!(sorts(3), [0, 2, 4]);
        assert_eq!(sorts(5), [0, 2, 4, 6]);
        assert_eq!(sorts(8), [0, 1, 2, 3, 4, 5, 6, 7]);
    }
}
