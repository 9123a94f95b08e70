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
    writeln!(out, "];\n\n/// The initial state.\npub const START: u32 = {};", source.start)?;
    writeln!(out, "/// The number of states.\npub const STATES: u32 = {};\n", source.states)?;
    out.push_str(include_str!("robot.rs.txt"));
    Ok(out)
}
