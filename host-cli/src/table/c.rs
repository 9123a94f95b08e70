//! A robot as C.

use super::{Part, Source, list};
use crate::size::c_table;
use goodbot::task::LiftedTask;
use goodbot_capi::memory::bytes_32;
use goodbot_lesson::world::robot::{DigitAt, WorldFlaw};
use std::fmt::Write;

/// The limits of the library's tables.
const MOST: [(&str, usize); 3] = [("classes", 8), ("propositions", 8), ("task_kinds", 8)];
const MOST_CARRIERS: usize = 16;

/// The most letters of a name in an identifier. Whole identifiers stay below the 63 letters that every compiler tells apart.
const MOST_LETTERS: usize = 40;

/// A text as a C literal. All but plain letters are octal numbers of three digits, so that nothing runs into the next character.
fn quoted(text: &str) -> String {
    let plain = |byte: &u8| byte.is_ascii_graphic() && !matches!(byte, b'"' | b'\\' | b'?') || *byte == b' ';
    let letter = |byte: u8| if plain(&byte) { char::from(byte).to_string() } else { format!("\\{byte:03o}") };
    format!("\"{}\"", text.bytes().map(letter).collect::<String>())
}

/// A text in a C comment. Letters of any script stay, because people read them; what could end the comment, or begin another, is escaped.
fn in_comment(text: &str) -> String {
    let plain =
        |letter: char| letter.is_alphanumeric() || letter.is_ascii_graphic() && !matches!(letter, '*' | '/' | '\\' | '?') || letter == ' ';
    let shown = |letter: char| if plain(letter) { letter.to_string() } else { letter.escape_unicode().to_string() };
    text.chars().map(shown).collect()
}

/// A text as the beginning of a C identifier: lower-case letters, digits and `_`. Names that are the library's or the compiler's get a word
/// before them.
fn identifier(text: &str) -> String {
    let letter = |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '_' };
    let word: String = text.chars().take(MOST_LETTERS).map(letter).collect();
    let is_own = word.starts_with(|first: char| first.is_ascii_lowercase()) && !word.starts_with("goodbot");
    if is_own { word } else { format!("world_{word}") }
}

fn digit(DigitAt { digit, value }: DigitAt) -> String {
    format!("{}, {}, {value}", digit.unit, digit.values)
}

/// The header.
///
/// # Errors
/// A [`WorldFlaw`] for a limit of the library's tables, and for a name that no text in C can hold.
pub fn text(source: &Source<'_>) -> Result<String, WorldFlaw> {
    let schema = &source.schema;
    let carriers: usize = schema.attributes.iter().map(|attribute| attribute.carriers.len()).sum();
    let given = [schema.classes.len(), schema.propositions.len(), source.tasks.len()];
    let limits = MOST.into_iter().zip(given).chain([(("attributes", MOST_CARRIERS), carriers)]);
    for ((field, most), given) in limits {
        if given > most {
            let message =
                format!("are {given} with their classes, and {most} are the most of a table in C; leave out some, or print --rust");
            return Err(WorldFlaw { field: field.to_owned(), message });
        }
    }
    let text = written(source).unwrap_or_default();
    // No other text has this: a backslash of a name is written as its number.
    if text.contains("\\000") {
        let message = "have a name or value with the character U+0000, where a text in C ends; rename it, or print --rust";
        return Err(WorldFlaw { field: "objects".to_owned(), message: message.to_owned() });
    }
    Ok(text)
}

/// The text of the header. Writing to a text does not fail.
fn written(source: &Source<'_>) -> Result<String, std::fmt::Error> {
    let (schema, word, mut out) = (&source.schema, identifier(source.name), String::new());
    let guard = word.to_uppercase();
    writeln!(out, "/* The world \"{}\", written by `goodbot table --c`. Its description was checked. */", in_comment(source.name))?;
    writeln!(out, "#ifndef GOODBOT_WORLD_{guard}_H\n#define GOODBOT_WORLD_{guard}_H\n\n#include <goodbot.h>\n")?;
    writeln!(out, "/* A state is a number, from 0 to {}. It says what holds:", source.states - 1)?;
    source.legend(in_comment).iter().try_for_each(|line| writeln!(out, "   {line}"))?;
    writeln!(out, "*/\n")?;
    writeln!(out, "static const char *const {word}_classes[] = {{{}}};", list(schema.classes.iter().map(|class| quoted(class.name))))?;
    for (position, attribute) in schema.attributes.iter().enumerate() {
        let carriers = list(attribute.carriers.iter().map(|it| format!("{{{}, {}}}", it.class.index(), quoted(it.prefix))));
        writeln!(out, "static const goodbot_carrier {word}_carriers{position}[] = {{{carriers}}};")?;
    }
    if !schema.attributes.is_empty() {
        let attribute = |(position, it): (usize, &goodbot::oomdp::Attribute<'_>)| {
            format!("{{{}, {word}_carriers{position}, {}}}", quoted(it.name), it.carriers.len())
        };
        writeln!(
            out,
            "static const goodbot_attribute {word}_attributes[] = {{{}}};",
            list(schema.attributes.iter().enumerate().map(attribute))
        )?;
    }
    writeln!(out, "static const goodbot_proposition {word}_propositions[] = {{")?;
    for proposition in schema.propositions {
        let classes = list(proposition.parameters.iter().map(|class| class.index().to_string()));
        writeln!(out, "    {{{}, {{{classes}}}, {}}},", quoted(proposition.name), proposition.parameters.len())?;
    }
    writeln!(out, "}};\nstatic const goodbot_object {word}_objects[] = {{")?;
    for (class, name, values) in source.rows() {
        let value = |value: &&str| if value.is_empty() { "NULL".to_owned() } else { quoted(value) };
        let values = if values.is_empty() { "NULL".to_owned() } else { list(values.iter().map(value)) };
        writeln!(out, "    {{{class}, {}, {{{values}}}}},", quoted(name))?;
    }
    let actions = list(source.actions.iter().map(|action| format!("{{{}, {}}}", quoted(action.name), action.cost)));
    writeln!(out, "}};\nstatic const goodbot_action {word}_actions[] = {{{actions}}};")?;
    writeln!(out, "static const char *const {word}_tasks[] = {{{}}};", list(source.tasks.iter().map(|task| quoted(task))))?;
    // A task with a way is stored as a text alone.
    let kinds = if source.kinds.iter().any(LiftedTask::has_way) {
        "NULL".to_owned()
    } else {
        writeln!(out, "/* The kinds of task, parsed: their variables' classes, their propositions, and the variables of each. */")?;
        writeln!(out, "static const goodbot_kind {word}_kinds[] = {{")?;
        for kind in &source.kinds {
            let classes = list(kind.variables().iter().map(|class| class.index().to_string()));
            let propositions = list(kind.propositions().iter().map(|part| part.proposition.index().to_string()));
            let variables = list(kind.propositions().iter().map(|part| format!("{{{}}}", list(part.variables.iter().map(u8::to_string)))));
            let counts = [kind.variables().len(), kind.propositions().len()];
            writeln!(out, "    {{{{{classes}}}, {}, {{{propositions}}}, {}, {{{variables}}}}},", counts[0], counts[1])?;
        }
        writeln!(out, "}};")?;
        format!("{word}_kinds")
    };
    writeln!(out)?;

    writeln!(out, "/* Facts: a proposition of these objects holds where state / unit % values == value. */")?;
    writeln!(
        out,
        "static const struct {{\n    uint8_t proposition, arguments[GOODBOT_MOST_ARGUMENTS];\n    uint32_t unit, values, value;\n}} {word}_facts[] = {{"
    )?;
    for fact in &source.facts {
        let arguments = list(fact.arguments.iter().map(|object| object.index().to_string()));
        writeln!(out, "    {{{}, {{{arguments}}}, {}}},", fact.proposition.index(), digit(fact.at))?;
    }
    writeln!(
        out,
        "}};\n\n/* Rules of actions: 0 begins a rule; 1 is a value that a digit must have, 2 one that it must not have, 3 one that it gets. */"
    )?;
    writeln!(out, "static const struct {{\n    uint8_t action, kind;\n    uint32_t unit, values, value;\n}} {word}_parts[] = {{")?;
    for (action, part) in source.parts() {
        let (kind, at) = match part {
            Part::Begin => (0, "1, 1, 0".to_owned()),
            Part::Has(at) => (1, digit(at)),
            Part::HasNot(at) => (2, digit(at)),
            Part::Takes(at) => (3, digit(at)),
        };
        writeln!(out, "    {{{action}, {kind}, {at}}},")?;
    }
    writeln!(out, "}};\n\n{}", include_str!("functions.c.txt").replace("WORLD_", &format!("{word}_")).trim_end())?;
    let [classes, attributes, propositions, objects] =
        [schema.classes.len(), schema.attributes.len(), schema.propositions.len(), source.objects.len()];
    let attribute_table = if attributes == 0 { "NULL".to_owned() } else { format!("{word}_attributes") };
    let (actions, tasks, states, start) = (source.actions.len(), source.tasks.len(), source.states, source.start);
    writeln!(
        out,
        "
/* In the order of the fields, as C++ wants it. */
static const goodbot_table {word}_table = {{
    {word}_classes, {classes}, {attribute_table}, {attributes}, {word}_propositions, {propositions}, {word}_objects, {objects},
    {word}_actions, {actions}, {word}_tasks, {tasks}, {states} /* states */, {start} /* the first */, NULL /* next */, {word}_step, {word}_holds, NULL /* derived */, NULL, {kinds}
}};

/* With these, every lesson is kept and every plan is exact. Where a pointer has four bytes, the robot takes {guard}_BYTES_32 bytes;
   goodbot_table_size(&{word}_capacities) says how many it takes. */
#define {guard}_BYTES_32 {}
{}
#endif",
        bytes_32(&source.capacities, true),
        c_table(&format!("{word}_capacities"), &source.capacities),
    )?;
    Ok(out)
}
