//! A model for the next version of a robot: an update of its program may rename, move, add or leave out propositional functions, classes
//! and attributes, and the lessons stay.

use crc::{CRC_32_ISO_HDLC, Crc};
use goodbot::capacity::{Capacity, NAME_BYTES};
use goodbot::language::Model;
use goodbot::oomdp::vocabulary::digest;
use goodbot::oomdp::{Attribute, Class, ClassId, Proposition, PropositionId, Schema};
use goodbot::snapshot::{CommandRecord, Contents, RestoreError};
use goodbot::symbols::{Symbol, Symbols};
use goodbot::task::description::{form, form_token, groups};
use goodbot::task::{LiftedTask, Marker, Role, RoleKind, VALUE_SORTS};

/// The change from one version of a robot to the next.
#[derive(Clone, Copy, Debug)]
pub struct Migration<'m> {
    /// The vocabulary that the model was learned in.
    pub from: Schema<'m>,
    /// The vocabulary of the next version.
    pub to: Schema<'m>,
    /// The kinds of task before, and those of the next version.
    pub kinds: [&'m [LiftedTask]; 2],
    /// The names that changed, of propositional functions, classes and attributes: each the old one and the new one.
    pub renamed: &'m [(&'m str, &'m str)],
}

/// A model of the next version, and what it lacks.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Migrated {
    /// The model.
    pub model: Vec<u8>,
    /// The names that the next version does not have, each once: propositional functions, classes, attributes, and kinds of task.
    pub lost: Vec<String>,
    /// The sessions that most probably meant a kind of task that the next version does not have, by position: leave them out by
    /// [`Agent::unlearn`](goodbot::Agent::unlearn), the last one first.
    pub sessions: Vec<u16>,
}

/// The machine tokens of the next version, while commands are rewritten.
struct Rewriting<'m> {
    migration: &'m Migration<'m>,
    /// The old vocabulary, with the new names.
    renamed: Schema<'m>,
    /// The old tokens, the kinds of task among them, and the new tokens.
    before: Vec<&'m str>,
    kinds: Vec<Kind>,
    after: Vec<String>,
    lost: Vec<String>,
}

/// The token of a kind of task before and after, and whether the next version has this kind.
struct Kind {
    before: String,
    after: String,
    is_kept: bool,
}

impl Migration<'_> {
    /// The model for the next version. What has the same name, or a new one by the table, is kept. A pure renaming changes no other byte.
    ///
    /// # Errors
    /// [`RestoreError`] if it is no model of the vocabulary `from`, or none of the role model.
    pub fn of(&self, bytes: &[u8]) -> Result<Migrated, RestoreError> {
        let contents = Contents::read(bytes)?;
        if ![0, digest(&self.from)].contains(&contents.vocabulary) {
            return Err(RestoreError::OtherDomain);
        }
        if contents.options.language.model != Model::Roles {
            return Err(RestoreError::OtherForms);
        }
        let classes: Vec<_> = self.from.classes.iter().map(|class| Class { name: self.new_name(class.name) }).collect();
        let propositions: Vec<_> =
            self.from.propositions.iter().map(|known| Proposition { name: self.new_name(known.name), ..*known }).collect();
        let attributes: Vec<_> = self.from.attributes.iter().map(|known| Attribute { name: self.new_name(known.name), ..*known }).collect();
        let renamed = Schema { classes: &classes, propositions: &propositions, attributes: &attributes };
        let mut rewriting = Rewriting {
            migration: self,
            renamed,
            before: contents.tokens.iter().collect(),
            kinds: self.kinds(&renamed)?,
            after: Vec::new(),
            lost: Vec::new(),
        };
        rewriting.take_names();
        let (commands, known): (Vec<_>, Vec<_>) = contents.commands.iter().map(|command| rewriting.command(&command)).unzip();
        let possible: Vec<_> = contents.possible_commands.iter().map(|command| rewriting.command(&command).0).collect();
        let mut pairs = contents.pairs.iter();
        let mut sessions = Vec::new();
        for (position, session) in contents.sessions.iter().enumerate() {
            let own = pairs.by_ref().take(session.pairs as usize);
            let [kept, gone] = own.fold([0.0, 0.0], |[kept, gone], pair| {
                let is_known = known.get(usize::from(pair.command)).copied().unwrap_or(false);
                if is_known { [kept + pair.weight, gone] } else { [kept, gone + pair.weight] }
            });
            if gone > kept {
                sessions.push(position as u16);
            }
        }
        let model = rewriting.file(bytes, &contents, &commands, &possible);
        Ok(Migrated { model, lost: rewriting.lost, sessions })
    }

    fn new_name<'n>(&'n self, name: &'n str) -> &'n str {
        self.renamed.iter().find(|(old, _)| *old == name).map_or(name, |&(_, new)| new)
    }

    /// The kinds of task before, with their tokens.
    fn kinds(&self, renamed: &Schema<'_>) -> Result<Vec<Kind>, RestoreError> {
        let text = |schema: &Schema<'_>, kind: &LiftedTask| -> Result<String, RestoreError> {
            let (mut bytes, mut ends, mut len) = ([0; NAME_BYTES], [0; 1], 0);
            let mut tokens = Symbols::new(&mut bytes, &mut ends, &mut len, Capacity::Tokens, Capacity::TokenBytes);
            let token = form_token(schema, kind, &mut tokens)?;
            Ok(tokens.read().text(token).to_owned())
        };
        let [before, after] = self.kinds;
        let after = after.iter().map(|kind| text(&self.to, kind)).collect::<Result<Vec<_>, _>>()?;
        let one = |kind| {
            let (before, new) = (text(&self.from, kind)?, text(renamed, kind)?);
            let is_kept = after.contains(&new);
            Ok(Kind { before, after: new, is_kept })
        };
        before.iter().map(one).collect()
    }
}

impl<'m> Rewriting<'m> {
    /// Takes the old tokens over in their order, so that a renaming keeps their numbers; and notes the names that are gone.
    fn take_names(&mut self) {
        let (old, new) = (self.migration.from, self.migration.to);
        let renamed = self.renamed;
        let propositions =
            renamed.propositions.iter().map(|known| (known.name, new.propositions.iter().any(|other| other.name == known.name)));
        let classes = renamed.classes.iter().map(|known| (known.name, new.classes.iter().any(|other| other.name == known.name)));
        let attributes = renamed.attributes.iter().map(|known| (known.name, new.attributes.iter().any(|other| other.name == known.name)));
        let names = old.propositions.iter().map(|known| known.name);
        let names = names.chain(old.classes.iter().map(|known| known.name)).chain(old.attributes.iter().map(|known| known.name));
        let gone = names.zip(propositions.chain(classes).chain(attributes)).filter(|(_, (_, is_kept))| !is_kept);
        let mut lost: Vec<String> = gone.map(|(name, _)| name.to_owned()).collect();
        lost.extend(self.kinds.iter().filter(|kind| !kind.is_kept).map(|kind| kind.before.clone()));
        for name in lost {
            self.lose(&name);
        }
        for token in self.before.clone() {
            let text = self.new_text(token);
            self.number(text);
        }
    }

    fn lose(&mut self, name: &str) {
        if !self.lost.iter().any(|known| known == name) {
            self.lost.push(name.to_owned());
        }
    }

    /// The new text of a token: that of its kind of task, or of a value, of which the old attribute's name gives way to the new one.
    fn new_text(&self, token: &str) -> String {
        if let Some(kind) = self.kinds.iter().find(|kind| kind.before == token) {
            return kind.after.clone();
        }
        let attributes = self.migration.from.attributes.iter().zip(self.renamed.attributes);
        let of = |(old, new): (&Attribute<'_>, &Attribute<'_>)| {
            let value = token.strip_prefix(old.name)?;
            value.starts_with(|letter: char| !letter.is_ascii_lowercase()).then(|| [new.name, value].concat())
        };
        attributes.filter_map(of).next().unwrap_or_else(|| token.to_owned())
    }

    fn number(&mut self, text: String) -> u16 {
        let known = self.after.iter().position(|other| *other == text);
        known.unwrap_or_else(|| {
            self.after.push(text);
            self.after.len().saturating_sub(1)
        }) as u16
    }

    /// A machine command of the next version, and whether its kind of task is known there.
    fn command(&self, record: &CommandRecord) -> (Vec<Symbol>, bool) {
        let old: Vec<Symbol> = record.iter().copied().map(Symbol::new).collect();
        let text = |token: Symbol| self.before.get(token.index()).copied().unwrap_or("");
        let is_known = form(&old).is_some_and(|token| self.kinds.iter().any(|kind| kind.is_kept && kind.before == text(token)));
        let renumbered = |token: Symbol| {
            let text = self.new_text(text(token));
            Symbol::new(self.after.iter().position(|other| *other == text).unwrap_or(0) as u16)
        };
        let mut new: Vec<(Marker, Vec<Symbol>)> = Vec::new();
        for group in groups(&old) {
            let Some(marker) = self.marker(group.marker) else { continue };
            let mut values: Vec<Symbol> = group.values.iter().map(|&value| renumbered(value)).collect();
            values.sort_unstable();
            new.push((marker, values));
        }
        // In the order of a description.
        new.sort_by_key(|&(Marker { role, sort }, _)| (rank(role.kind()), role.class().index(), role.argument(), sort));
        let mut command: Vec<Symbol> = form(&old).map(renumbered).into_iter().collect();
        for (marker, values) in new {
            command.push(marker.symbol());
            command.extend(values);
        }
        (command, is_known)
    }

    /// The file of the next version: its bytes are those of the old one, but for the vocabulary, the tokens and the commands.
    fn file(&self, old: &[u8], contents: &Contents<'_>, commands: &[Vec<Symbol>], possible: &[Vec<Symbol>]) -> Vec<u8> {
        // A record of a host may follow the model.
        let length = old.get(BEFORE_LENGTH..HEADER).and_then(|bytes| bytes.try_into().ok()).map_or(0, u32::from_le_bytes);
        let after_vocabulary = old.get(HEADER + number(contents.vocabulary).count()..length as usize).unwrap_or(&[]);
        let mut file = old.get(..BEFORE_LENGTH).unwrap_or(&[]).to_vec();
        file.extend([0; HEADER - BEFORE_LENGTH]);
        file.extend(number(digest(&self.migration.to)));
        file.extend(between(after_vocabulary, contents.words.after()));
        file.extend(number(self.after.len() as u32));
        for text in &self.after {
            file.extend(number(text.len() as u32));
            file.extend(text.as_bytes());
        }
        put_commands(&mut file, commands);
        let mut rest = contents.commands.after();
        if contents.options.language.layer {
            file.extend(between(rest, contents.rests.after()));
            put_commands(&mut file, possible);
            rest = contents.possible_commands.after();
        }
        file.extend(&rest[..rest.len().saturating_sub(CHECK)]);
        let length = (file.len() + CHECK) as u32;
        file[BEFORE_LENGTH..HEADER].copy_from_slice(&length.to_le_bytes());
        let check = Crc::<u32>::new(&CRC_32_ISO_HDLC).checksum(&file);
        file.extend(check.to_le_bytes());
        file
    }

    /// The marker of the next version, `None` if it has no such role or sort of values.
    fn marker(&self, marker: Marker) -> Option<Marker> {
        let (renamed, to) = (self.renamed, self.migration.to);
        let proposition = |id: PropositionId| {
            let known = renamed.propositions.get(id.index())?;
            let same = |other: &Proposition<'_>| other.name == known.name && other.parameters.len() == known.parameters.len();
            Some(PropositionId::new(to.propositions.iter().position(same)? as u8))
        };
        let class = |id: ClassId| {
            let name = renamed.classes.get(id.index())?.name;
            Some(ClassId::new(to.classes.iter().position(|other| other.name == name)? as u8))
        };
        let (kind, argument) = (marker.role.kind(), marker.role.argument());
        let role = match kind {
            RoleKind::Other | RoleKind::OtherPlace => Role::of_class(kind, class(marker.role.class())?),
            _ => Role::of_argument(kind, proposition(marker.role.proposition())?, argument),
        };
        let at = usize::from(marker.sort >> 1);
        // Derived facts come after all attributes.
        let attribute = match renamed.attributes.get(at) {
            Some(known) => to.attributes.iter().position(|other| other.name == known.name)?,
            None => to.attributes.len().saturating_add(at.saturating_sub(renamed.attributes.len())),
        };
        let sort = attribute.saturating_mul(2).saturating_add(usize::from(marker.sort & 1));
        (sort < VALUE_SORTS).then_some(Marker { role, sort: sort as u8 })
    }
}

/// The place of a role in a description: the task's own, its way, the places at the start, and the other objects, class by class.
const fn rank(kind: RoleKind) -> u8 {
    match kind {
        RoleKind::Subject => 0,
        RoleKind::Goal => 1,
        RoleKind::Before => 2,
        RoleKind::Through => 3,
        RoleKind::Avoiding => 4,
        RoleKind::Start => 5,
        RoleKind::OtherPlace | RoleKind::Other => 6,
    }
}

/// The bytes before the payload: magic, format and length; and the bytes before the length.
const HEADER: usize = 14;
const BEFORE_LENGTH: usize = 10;
/// The bytes of the checksum.
const CHECK: usize = 4;

/// The bytes from one place of a file to a later one, each given by all that follows it.
fn between<'a>(from: &'a [u8], to: &[u8]) -> &'a [u8] {
    from.get(..from.len().saturating_sub(to.len())).unwrap_or(&[])
}

/// A number or a count, as postcard writes it: seven bits per byte, the lowest first.
fn number(number: u32) -> impl Iterator<Item = u8> {
    let bytes = (38 - (number | 1).leading_zeros()) / 7;
    (0..bytes).map(move |at| (number >> (7 * at)) as u8 & 0x7f | if at + 1 < bytes { 0x80 } else { 0 })
}

fn put_commands(file: &mut Vec<u8>, commands: &[Vec<Symbol>]) {
    file.extend(number(commands.len() as u32));
    for command in commands {
        file.extend(number(command.len() as u32));
        file.extend(command.iter().flat_map(|symbol| number(symbol.index() as u32)));
    }
}
