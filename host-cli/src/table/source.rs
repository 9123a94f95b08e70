//! The parts of a robot's source that all languages share.

use goodbot::Capacities;
use goodbot::oomdp::{ActionKind, Domain, Objects, Schema, World};
use goodbot::task::LiftedTask;
use goodbot_lesson::world::robot::{DigitAt, FactAt, Robot, Rule};

/// The parts of a robot's source.
pub struct Source<'w> {
    /// The world's name in its file.
    pub name: &'w str,
    /// The vocabulary.
    pub schema: Schema<'w>,
    /// The objects.
    pub objects: Objects<'w>,
    /// The actions.
    pub actions: &'w [ActionKind<'w>],
    /// The kinds of task.
    pub tasks: Vec<String>,
    /// The kinds of task, parsed.
    pub kinds: Vec<LiftedTask>,
    /// How many states there are.
    pub states: u64,
    /// The initial state.
    pub start: u64,
    /// The facts, with the digits' values with which they hold.
    pub facts: Vec<FactAt>,
    /// The rules of each action.
    pub rules: Vec<Vec<Rule>>,
    /// The sizes of its tables.
    pub capacities: Capacities,
}

/// A part of a rule.
#[derive(Clone, Copy, Debug)]
pub enum Part {
    /// A rule begins.
    Begin,
    /// A digit must have this value.
    Has(DigitAt),
    /// A digit must have another value.
    HasNot(DigitAt),
    /// A digit takes this value.
    Takes(DigitAt),
}

impl<'w> Source<'w> {
    /// The source of a robot.
    pub fn of(robot: &'w Robot<'w>, start: u64, kinds: Vec<LiftedTask>, capacities: Capacities) -> Self {
        let World { schema, objects } = robot.world();
        Self {
            name: &robot.file().name,
            schema,
            objects,
            actions: robot.actions(),
            tasks: robot.file().task_kinds.iter().map(ToString::to_string).collect(),
            kinds,
            states: robot.state_count(),
            start,
            facts: robot.where_facts_hold(),
            rules: robot.rules(),
            capacities,
        }
    }

    /// The parts of all rules, in order, each with its action.
    pub fn parts(&self) -> Vec<(usize, Part)> {
        let mut parts = Vec::new();
        for (action, rules) in self.rules.iter().enumerate() {
            for Rule { conditions, effects } in rules {
                parts.push((action, Part::Begin));
                parts.extend(conditions.iter().map(|&(at, has)| (action, if has { Part::Has(at) } else { Part::HasNot(at) })));
                parts.extend(effects.iter().map(|&at| (action, Part::Takes(at))));
            }
        }
        parts
    }

    /// A line for each fact that can change: the fact, and the condition under which it holds. The names come from a file, so that `escaped`
    /// writes each as the language's comments need it.
    pub fn legend(&self, escaped: impl Fn(&str) -> String) -> Vec<String> {
        let told = |fact: &FactAt| {
            let count = self.schema.parameters(fact.proposition).len();
            let names: Vec<String> = fact.arguments.iter().take(count).map(|&object| escaped(self.objects.name(object))).collect();
            let DigitAt { digit, value } = fact.at;
            let name = escaped(self.schema.proposition_name(fact.proposition));
            format!("{name}({}): state / {} % {} == {value}", names.join(","), digit.unit, digit.values)
        };
        self.facts.iter().filter(|fact| fact.at.digit.values > 1).map(told).collect()
    }

    /// The class, the name and the values of each object.
    pub fn rows(&self) -> Vec<(usize, &str, Vec<&str>)> {
        let row = |(id, object): (goodbot::oomdp::ObjectId, &goodbot::oomdp::Object)| {
            let values = (0..self.schema.attributes.len()).map(|attribute| self.objects.value(id, attribute)).collect();
            (object.class.index(), self.objects.name(id), values)
        };
        self.objects.iter().map(row).collect()
    }
}
