//! Reads a log of worlds, line by line, and the description of a world.

use super::file::{ActionOfWorld, DerivedOfWorld, ObjectOfWorld, WorldFile};
use super::{CommandRecord, SessionInWorld, WorldClasses, usable};
use crate::error::{
    ANSWER_OUTSIDE_SESSION, END_OUTSIDE_SESSION, FormatError, STEP_BEFORE_SESSION, no_end, not_in_world, quoted, twice, wrong_class,
};
use crate::json::{Node, Object, Source};
use crate::lines::{Line as RawLine, Lines};
use crate::session::{EndRecord, Record, RecordedAnswer, RecordedSession};
use crate::task_text::{LiftedTaskText, TaskTextError, is_usable_name};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::io::BufRead;
use std::sync::Arc;

/// An item of a log of worlds.
#[derive(Debug, Clone, PartialEq)]
pub enum Line {
    /// A world. It is valid until another of the same name.
    World(Arc<WorldFile>),
    /// A command in a world on an earlier line.
    Command(CommandRecord),
    /// A session in a world on an earlier line.
    Session(Box<SessionInWorld>),
}

const TYPES: &[&str] = &["world", "command", "session", "step", "answer", "end"];

/// Reads a log of worlds. An iterator: each item is a world, a command, a whole session, or an error. After an error, one may continue:
/// commands and sessions in a world with an error are errors too, and the rest of a broken session is skipped.
pub struct WorldReader<R> {
    lines: Lines<R>,
    worlds: HashMap<String, Arc<WorldFile>>,
    /// A line that came before the end of a session.
    pending: Option<RawLine>,
    /// Whether the last item was an error.
    is_broken: bool,
    began: usize,
}

impl<R: BufRead> WorldReader<R> {
    /// A reader of this log.
    pub fn new(input: R) -> Self {
        Self { lines: Lines::new(input), worlds: HashMap::new(), pending: None, is_broken: false, began: 0 }
    }

    /// The first line of the last item, counted from 1; 0 before the first item.
    pub const fn began(&self) -> usize {
        self.began
    }

    /// The next line that is not blank.
    fn line(&mut self) -> Option<RawLine> {
        loop {
            let line = self.pending.take().or_else(|| self.lines.next())?;
            if line.error.is_some() || !line.text.trim().is_empty() {
                return Some(line);
            }
        }
    }

    /// The item that begins on this line.
    fn read(&mut self, text: &str, number: usize) -> Result<Line, FormatError> {
        let source = Source::new(text, number);
        let fields = source.root()?.object()?;
        let problem = match fields.required("type")?.word(TYPES)? {
            0 => {
                let world = Arc::new(WorldFile::read(&fields)?);
                self.worlds.insert(world.name.clone(), Arc::clone(&world));
                return Ok(Line::World(world));
            }
            1 => return Ok(Line::Command(CommandRecord::read(&fields, number, &*self.world(&fields)?)?)),
            2 => return self.session(&fields, number).map(|session| Line::Session(Box::new(session))),
            3 => STEP_BEFORE_SESSION,
            4 => ANSWER_OUTSIDE_SESSION,
            _ => END_OUTSIDE_SESSION,
        };
        Err(FormatError::new(number, problem))
    }

    /// The world that a command or a session names.
    fn world(&self, fields: &Object<'_>) -> Result<Arc<WorldFile>, FormatError> {
        let node = fields.required("world")?;
        let name = node.text()?;
        self.worlds.get(&name).cloned().ok_or_else(|| {
            node.error(format!("no world {} could be read on a line before this one; put the world's line first", quoted(&name)))
        })
    }

    /// A session, up to its end.
    fn session(&mut self, fields: &Object<'_>, begin: usize) -> Result<SessionInWorld, FormatError> {
        let (world, facts, header) = SessionInWorld::header(fields, self.world(fields)?)?;
        let (mut steps, mut answers) = (Vec::new(), Vec::new());
        loop {
            let Some(line) = self.line() else {
                return Err(FormatError::new(begin, no_end(None)));
            };
            let number = line.number;
            if let Some(error) = line.error {
                return Err(error);
            }
            let source = Source::new(&line.text, number);
            if source.root()?.object()?.required("type")?.word(TYPES)? <= 2 {
                // The item that begins before the end is read next.
                self.pending = Some(line);
                return Err(FormatError::new(begin, no_end(Some(number))));
            }
            match Record::parse(&line.text, number)? {
                Record::Step(step) => {
                    header.check_feedback(&step, number)?;
                    steps.push((number, step));
                }
                Record::Answer(answer) => {
                    header.check_answer(number)?;
                    answers.push(RecordedAnswer { line: number, after: steps.len(), answer });
                }
                Record::End(EndRecord { learn }) => {
                    let session = RecordedSession { header, header_line: begin, steps, answers, learn, end_line: number };
                    return Ok(SessionInWorld { world, facts, session });
                }
                Record::Session(_) => {}
            }
        }
    }
}

impl<R: BufRead> Iterator for WorldReader<R> {
    type Item = Result<Line, FormatError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let line = self.line()?;
            self.began = line.number;
            let read = line.error.map_or_else(|| self.read(&line.text, line.number), Err);
            let was_broken = std::mem::replace(&mut self.is_broken, read.is_err());
            let begins = || TYPES[..3].iter().any(|kind| line.text.contains(&format!("\"{kind}\"")));
            if !matches!(&read, Err(error) if was_broken && !error.is_fatal && !begins()) {
                return Some(read);
            }
        }
    }
}

const FIELDS: &[&str] = &[
    "type",
    "name",
    "classes",
    "parents",
    "attributes",
    "propositions",
    "objects",
    "facts",
    "task_kinds",
    "license",
    "source",
    "variables",
    "actions",
    "derived",
];

impl WorldFile {
    /// Reads a world, on one line or on several.
    ///
    /// # Errors
    /// The fault, and its place.
    pub fn parse(text: &str) -> Result<Self, FormatError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let source = Source::new(text, 1);
        let fields = source.root()?.object()?;
        fields.required("type")?.word(&["world"])?;
        Self::read(&fields)
    }

    pub(super) fn read(fields: &Object<'_>) -> Result<Self, FormatError> {
        fields.only(FIELDS)?;
        for name in ["license", "source"] {
            fields.optional(name).map(|node| node.text()).transpose()?;
        }
        let mut world = Self { name: fields.required("name")?.filled_text()?, ..Self::default() };
        world.classes = fields.required("classes")?.each_once(usable)?;
        if let Some(parents) = fields.optional("parents") {
            world.read_parents(&parents)?;
        }
        world.attributes = world.of_classes(fields.required("attributes")?, false)?;
        world.propositions = world.of_classes(fields.required("propositions")?, true)?;
        world.read_objects(&fields.required("objects")?)?;
        if let Some(facts) = fields.optional("facts") {
            world.facts = WorldClasses::of(&world).atoms(&facts)?;
        }
        if let Some(variables) = fields.optional("variables") {
            world.read_variables(&variables)?;
        }
        if let Some(actions) = fields.optional("actions") {
            world.read_actions(&actions)?;
        }
        if let Some(derived) = fields.optional("derived") {
            if world.actions.is_empty() {
                return Err(
                    derived.error("belong to a world with actions: elsewhere words can mean each fact about one object; list it in facts")
                );
            }
            let known = WorldClasses::of(&world);
            world.derived = derived.list()?.iter().map(|node| DerivedOfWorld::read(node, &known)).collect::<Result<_, _>>()?;
        }
        for node in fields.required("task_kinds")?.filled_list()? {
            let kind: LiftedTaskText = node.task()?;
            world.check_kind(&node, &kind)?;
            if world.task_kinds.contains(&kind) {
                return Err(node.error(twice(&kind.to_string())));
            }
            world.task_kinds.push(kind);
        }
        Ok(world)
    }

    /// Reads an object from names to lists of classes.
    fn of_classes(&self, node: Node<'_>, filled: bool) -> Result<Vec<(String, Vec<String>)>, FormatError> {
        let mut all = Vec::new();
        for (name, node) in node.object()?.entries() {
            if !is_usable_name(name) {
                return Err(node.error(TaskTextError::UnusableName { name: name.to_owned() }.to_string()));
            }
            let mut classes = Vec::new();
            for item in if filled { node.filled_list()? } else { node.list()? } {
                let class = item.text()?;
                if !self.classes.contains(&class) {
                    return Err(item.error(not_in_world("class", &class)));
                }
                classes.push(class);
            }
            all.push((name.to_owned(), classes));
        }
        Ok(all)
    }

    fn read_parents(&mut self, node: &Node<'_>) -> Result<(), FormatError> {
        for (class, above) in node.clone().object()?.entries() {
            let name = above.text()?;
            if let Some(strange) = [class, &name].into_iter().find(|class| !self.classes.iter().any(|known| known == class)) {
                return Err(above.error(not_in_world("class", strange)));
            }
            if self.is_a(&name, class) {
                return Err(above.error(format!("{} is the class itself, or below it; name one above it", quoted(&name))));
            }
            self.parents.push((class.to_owned(), name));
        }
        Ok(())
    }

    fn read_objects(&mut self, list: &Node<'_>) -> Result<(), FormatError> {
        let mut seen = BTreeSet::new();
        for node in list.filled_list()? {
            let fields = node.object()?;
            fields.only(&["name", "class", "attributes"])?;
            let name_node = fields.required("name")?;
            let name = usable(&name_node)?;
            if !seen.insert(name.clone()) {
                return Err(name_node.error(twice(&name)));
            }
            let class_node = fields.required("class")?;
            let class = class_node.text()?;
            if !self.classes.contains(&class) {
                return Err(class_node.error(not_in_world("class", &class)));
            }
            let mut attributes = Vec::new();
            if let Some(node) = fields.optional("attributes") {
                for (attribute, value) in node.object()?.entries() {
                    let Some((_, carriers)) = self.attributes.iter().find(|(known, _)| known == attribute) else {
                        return Err(value.error(not_in_world("attribute", attribute)));
                    };
                    if !carriers.iter().any(|carrier| self.is_a(&class, carrier)) {
                        return Err(value.error(format!(
                            "objects of the class {} do not carry this attribute; add the class to the attribute's list",
                            quoted(&class)
                        )));
                    }
                    attributes.push((attribute.to_owned(), value.filled_text()?));
                }
            }
            self.objects.push(ObjectOfWorld { name, class, attributes });
        }
        Ok(())
    }

    fn read_variables(&mut self, list: &Node<'_>) -> Result<(), FormatError> {
        for node in list.list()? {
            let name = node.text()?;
            let Some((_, classes)) = self.propositions.iter().find(|(known, _)| *known == name) else {
                return Err(node.error(not_in_world("proposition", &name)));
            };
            if let Some(class) = classes.last().filter(|class| !self.objects.iter().any(|object| self.is_a(&object.class, class))) {
                return Err(node.error(format!("is a variable without values: there is no object of the class {}; add one", quoted(class))));
            }
            if self.variables.contains(&name) {
                return Err(node.error(twice(&name)));
            }
            self.variables.push(name);
        }
        Ok(())
    }

    fn read_actions(&mut self, list: &Node<'_>) -> Result<(), FormatError> {
        let mut actions: Vec<ActionOfWorld> = Vec::new();
        let known = WorldClasses::of(self);
        for node in list.list()? {
            let action = ActionOfWorld::read(&node, &known)?;
            // Entries of one name are cases of one action.
            if let Some(first) = actions.iter().find(|other| other.name == action.name && other.cost != action.cost) {
                return Err(node.error(format!(
                    "costs {}, and an earlier case of {} costs {}; give all cases of an action the same cost",
                    action.cost,
                    quoted(&action.name),
                    first.cost
                )));
            }
            actions.push(action);
        }
        self.actions = actions;
        Ok(())
    }

    /// Checks that a kind of task has propositions of the world, and one class for each variable.
    fn check_kind(&self, node: &Node<'_>, kind: &LiftedTaskText) -> Result<(), FormatError> {
        let way = kind.way();
        if !(way.before.is_empty() && way.through.is_empty() && way.avoiding.is_empty()) {
            return Err(node.error("has a way (then, through, avoiding), which worlds from files do not know; write the goal alone"));
        }
        let mut classes: BTreeMap<&str, &str> = BTreeMap::new();
        for atom in kind.atoms() {
            let parameters = self.parameters(node, atom.function(), atom.variables().len())?;
            for (variable, class) in atom.variables().iter().zip(parameters) {
                let known = classes.entry(variable).or_insert(class);
                // The lower of two classes counts.
                if self.is_a(class, known) {
                    *known = class;
                } else if !self.is_a(known, class) {
                    return Err(node.error(wrong_class(&format!("?{variable}"), class)));
                }
            }
        }
        Ok(())
    }
}

/// The line, counted from 1, of a field such as `objects[3]`, `propositions.at` or `actions` in the text of a world, for errors of the
/// world as a whole.
pub fn field_line(text: &str, field: &str) -> Option<usize> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = Source::new(text, 1);
    let world = source.root().ok()?.object().ok()?;
    let end = field.find(['[', '.']).unwrap_or(field.len());
    let (name, rest) = field.split_at(end);
    let node = world.optional(name)?;
    if let Some(position) = rest.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
        return node.list().ok()?.get(position.parse::<usize>().ok()?).map(Node::line);
    }
    match rest.strip_prefix('.') {
        Some(entry) => node.object().ok()?.optional(entry).map(|node| node.line()),
        None => Some(node.line()),
    }
}
