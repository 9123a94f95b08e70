//! A robot in Rust.

use super::{Part, Source, list};
use crate::size::rust_fields;
use goodbot_lesson::world::robot::DigitAt;
use std::fmt::Write;

fn digit(DigitAt { digit, value }: DigitAt) -> String {
    format!("[{}, {}, {value}]", digit.unit, digit.values)
}

/// A name in a comment, in a code span of Markdown. Whatever is no visible letter is escaped, so that the comment does not end; a grave accent
/// would end the span.
fn in_comment(text: &str) -> String {
    text.escape_debug().to_string().replace('`', "\\u{60}")
}

/// The module.
pub fn text(source: &Source<'_>) -> String {
    // Writing to a text does not fail.
    written(source).unwrap_or_default()
}

fn written(source: &Source<'_>) -> Result<String, std::fmt::Error> {
    let (schema, mut out) = (&source.schema, String::new());
    writeln!(out, "//! The world {:?}, written by `goodbot table --rust`. Its description was checked.", source.name)?;
    writeln!(out, "//!\n//! A state is a number, from 0 to {}. It says what holds:\n//!", source.states - 1)?;
    source.legend(in_comment).iter().try_for_each(|line| writeln!(out, "//! - `{line}`"))?;
    writeln!(
        out,
        "
use goodbot::oomdp::{{
    Action, ActionKind, Attribute, Carrier, Class, ClassId, Domain, GroundProposition, ObjectError, ObjectSet, ObjectTables, Objects, OneByOne,
    Proposition, Schema, World,
}};
use goodbot::task::{{LiftedTask, TaskTextError}};

goodbot::memory! {{
    /// Memory for the robot and its agent: every lesson is kept, and every plan is exact.
    pub struct RobotMemory = goodbot::Capacities {{
{}    }};
}}
",
        rust_fields(&source.capacities)
    )?;
    writeln!(out, "/// The vocabulary.\npub const SCHEMA: Schema<'static> = Schema {{")?;
    writeln!(out, "    classes: &[{}],", list(schema.classes.iter().map(|class| format!("Class::new({:?})", class.name))))?;
    writeln!(out, "    attributes: &[")?;
    for attribute in schema.attributes {
        let carriers =
            list(attribute.carriers.iter().map(|it| format!("Carrier::new(ClassId::new({}), {:?})", it.class.index(), it.prefix)));
        writeln!(out, "        Attribute::new({:?}, &[{carriers}]),", attribute.name)?;
    }
    writeln!(out, "    ],\n    propositions: &[")?;
    for proposition in schema.propositions {
        let classes = list(proposition.parameters.iter().map(|class| format!("ClassId::new({})", class.index())));
        writeln!(out, "        Proposition::new({:?}, &[{classes}]),", proposition.name)?;
    }
    writeln!(out, "    ],\n}};\n")?;
    writeln!(out, "const ACTIONS: [ActionKind<'static>; {}] = [", source.actions.len())?;
    source.actions.iter().try_for_each(|action| writeln!(out, "    ActionKind::new({:?}, {}),", action.name, action.cost))?;
    writeln!(out, "];\n\n/// The kinds of task.\npub const TASKS: [&str; {}] = [", source.tasks.len())?;
    source.tasks.iter().try_for_each(|task| writeln!(out, "    {task:?},"))?;
    let rows = source.rows();
    writeln!(out, "];\n\n/// Each object: its class, its name, and its values.")?;
    writeln!(out, "const OBJECTS: [(u8, &str, [&str; {}]); {}] = [", schema.attributes.len(), rows.len())?;
    rows.iter().try_for_each(|(class, name, values)| writeln!(out, "    ({class}, {name:?}, {values:?}),"))?;
    writeln!(
        out,
        "];\n\n/// Facts: a proposition of these objects holds where `state / unit % values == value`, given as `[unit, values, value]`."
    )?;
    writeln!(out, "const FACTS: [(u8, [u8; 3], [u32; 3]); {}] = [", source.facts.len())?;
    for fact in &source.facts {
        let arguments = list(fact.arguments.iter().map(|object| object.index().to_string()));
        writeln!(out, "    ({}, [{arguments}], {}),", fact.proposition.index(), digit(fact.at))?;
    }
    let parts = source.parts();
    writeln!(out, "];\n\n/// A part of an action's rule: a condition or an effect; digits as in `FACTS`.")?;
    writeln!(
        out,
        "enum Part {{\n    /// A rule begins.\n    Begin,\n    /// A digit must have a value.\n    Has([u32; 3]),\n    /// A digit must have another value.\n    #[allow(dead_code)]\n    HasNot([u32; 3]),\n    /// A digit takes a value.\n    Takes([u32; 3]),\n}}\n"
    )?;
    writeln!(out, "/// The rules of all actions, by the action's number: the first rule of an action that fits applies.")?;
    writeln!(out, "const PARTS: [(usize, Part); {}] = [", parts.len())?;
    for (action, part) in parts {
        let part = match part {
            Part::Begin => "Begin".to_owned(),
            Part::Has(at) => format!("Has({})", digit(at)),
            Part::HasNot(at) => format!("HasNot({})", digit(at)),
            Part::Takes(at) => format!("Takes({})", digit(at)),
        };
        writeln!(out, "    ({action}, Part::{part}),")?;
    }
    writeln!(
        out,
        "];

/// The initial state.
pub const START: u32 = {};
/// The number of states.
pub const STATES: u32 = {};

/// The robot. Its objects are in memory that the caller lends: `memory.home.lend().objects`.
pub struct Robot<'m> {{
    objects: Objects<'m>,
}}

impl<'m> Robot<'m> {{
    /// The robot and its world.
    ///
    /// # Errors
    /// An error if the memory is smaller than `RobotMemory`.
    pub fn new(memory: ObjectTables<'m>) -> Result<Self, ObjectError> {{
        let mut objects = ObjectSet::new(memory);
        for (class, name, values) in OBJECTS {{
            objects.add(ClassId::new(class), name, &values)?;
        }}
        Ok(Self {{ objects: objects.into_objects() }})
    }}

    /// The kinds of task that commands may mean.
    ///
    /// # Errors
    /// None: the texts were checked.
    pub fn tasks() -> Result<[LiftedTask; TASKS.len()], TaskTextError> {{
        let mut tasks = [const {{ None }}; TASKS.len()];
        for (slot, text) in tasks.iter_mut().zip(TASKS) {{
            *slot = Some(LiftedTask::parse(text, &SCHEMA)?);
        }}
        Ok(tasks.map(|task| task.unwrap_or_else(|| unreachable!())))
    }}
}}

fn has(state: u32, [unit, values, value]: [u32; 3]) -> bool {{
    state / unit % values == value
}}

impl Domain for Robot<'_> {{
    type State = u32;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {{
        World {{ schema: SCHEMA, objects: self.objects }}
    }}

    fn actions(&self) -> &[ActionKind<'_>] {{
        &ACTIONS
    }}

    fn step(&self, state: &u32, action: Action) -> Option<u32> {{
        let (mut after, mut fits) = (*state, false);
        for (_, part) in PARTS.iter().filter(|(of, _)| *of == action.index()) {{
            match *part {{
                Part::Begin if fits => break,
                Part::Begin => (after, fits) = (*state, true),
                Part::Has(digit) => fits &= has(*state, digit),
                Part::HasNot(digit) => fits &= !has(*state, digit),
                Part::Takes([unit, values, value]) => after = after - after / unit % values * unit + value * unit,
            }}
        }}
        fits.then_some(after)
    }}

    fn holds(&self, proposition: &GroundProposition, state: &u32) -> bool {{
        let count = SCHEMA.parameters(proposition.proposition).len();
        let same = |arguments: &[u8; 3]| arguments.iter().zip(proposition.arguments).take(count).all(|(&known, given)| usize::from(known) == given.index());
        FACTS.iter().any(|(of, arguments, digit)| usize::from(*of) == proposition.proposition.index() && same(arguments) && has(*state, *digit))
    }}

    fn state_count(&self) -> u64 {{
        u64::from(STATES)
    }}

    fn number(&self, state: &u32) -> u64 {{
        u64::from(*state)
    }}

    fn numbered(&self, number: u64) -> u32 {{
        number as u32
    }}
}}",
        source.start, source.states
    )?;
    Ok(out)
}
