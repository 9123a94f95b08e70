//! A command as features for the layer: the words that name values, and their contexts.

use super::parts::Part;
use super::weights::{Context, Naming, Roles, of_context, of_kind, of_kind_word, of_naming, of_roles, of_told, of_value_word};
use crate::capacity::WORDS_PER_COMMAND;
use crate::language::roles::names::Names;
use crate::language::tables::TablesRef;
use crate::symbols::Symbol;
use crate::task::role::{Marker, RoleKind};
use core::ops::Range;
use heapless::Vec;

/// A word is a feature of a value if it was taken for it in more than this share of the times it was heard.
const SPEAKS: f32 = 0.05;
/// A word is a mention if it was taken for some value in more than this share of those times.
const MENTIONS: f32 = 0.3;
/// More mentions before or after count as this many.
const MOST_COUNTED: usize = 3;
/// A value has a name if some word was taken for it in more than this share of the times it was heard.
const HAS_NAME: f32 = 0.5;
/// A command of at most this many words may be a name of the whole task, such as "hop". No context tells what its words mean.
const OF_WHOLE_TASK: usize = 2;
/// If tasks have ways: the farthest word between two mentions that counts for the second.
const FARTHEST: usize = 6;
/// Any word that names a value, and any new word, as neighbours of a mention. No word has these numbers.
const ANY_NAME: Symbol = Symbol(u16::MAX - 1);
const NEW_WORD: Symbol = Symbol(u16::MAX - 2);

/// A word that was taken for a value often enough.
#[derive(Clone, Copy)]
struct Mention {
    position: usize,
    value: Symbol,
}

/// A command.
pub(super) struct Command<'s, 't> {
    words: &'s [Option<Symbol>],
    names: Names<'t>,
    /// Whether the words in names are values.
    is_told: bool,
    /// Whether tasks have ways.
    has_ways: bool,
    /// The number of words that training has seen.
    heard: usize,
    /// In order.
    mentions: Vec<Mention, WORDS_PER_COMMAND>,
}

impl<'s, 't> Command<'s, 't> {
    /// A command, after a training on data with `said` words, repetitions included.
    pub fn new(tables: TablesRef<'t>, said: f32, words: &'s [Option<Symbol>]) -> Self {
        let names = Names::new(tables, said);
        let layout = tables.layout();
        let (is_told, has_ways) = (layout.has_names(), layout.has_ways());
        let mut command = Self { words, names, is_told, has_ways, heard: layout.words(), mentions: Vec::new() };
        for (position, word) in words.iter().enumerate() {
            let Some(word) = *word else { continue };
            let best =
                names.values().map(|value| (value, names.share(word, value))).reduce(|best, it| if it.1 > best.1 { it } else { best });
            if let Some((value, _)) = best.filter(|&(_, share)| share > MENTIONS) {
                // No more than there are words.
                let _ = command.mentions.push(Mention { position, value });
            }
        }
        command
    }

    /// The different words of a stretch.
    fn different(&self, stretch: Range<usize>) -> impl Iterator<Item = Symbol> {
        let words = self.words.get(stretch).unwrap_or(&[]);
        let is_first = move |position: usize, word: Symbol| !words.iter().take(position).any(|&other| other == Some(word));
        let known = words.iter().enumerate().filter_map(|(position, word)| word.map(|word| (position, word)));
        known.filter(move |&(position, word)| is_first(position, word)).map(|(_, word)| word)
    }

    /// All different words.
    fn all(&self) -> impl Iterator<Item = Symbol> {
        self.different(0..self.words.len())
    }

    /// Tells each weight that speaks for a part of a task, and how much it counts.
    pub fn each_weight(&self, part: Part, mut tell: impl FnMut(usize, f32)) {
        let (role, value) = match part {
            Part::Kind(form) => {
                tell(of_kind(form), 1.0);
                self.all().for_each(|word| tell(of_kind_word(form, word), 1.0));
                return;
            }
            Part::Goals(roles) | Part::Way(roles) => {
                let roles = Symbol(roles);
                tell(of_kind(roles), 1.0);
                self.all().for_each(|word| tell(of_kind_word(roles, word), 1.0));
                return;
            }
            Part::Value(role, value, has_alternatives) => {
                if self.has_ways {
                    self.each_of_roles(role, value, has_alternatives, &mut tell);
                }
                (role, value)
            }
        };
        if self.is_told || self.words.len() <= OF_WHOLE_TASK {
            tell(of_told(role, value, None), 1.0);
            self.all().for_each(|word| tell(of_told(role, value, Some(word)), 1.0));
        }
        for word in self.all().filter(|&word| self.names.share(word, value) > SPEAKS) {
            tell(of_value_word(role, value, word), 1.0);
        }
        for (position, word) in self.words.iter().enumerate() {
            let share = word.map_or(0.0, |word| self.names.share(word, value));
            if share > SPEAKS {
                self.each_context(position, value, |context| tell(of_context(role, context), share));
            }
        }
    }

    /// If tasks have ways: tells each weight that all roles of a kind or of a group share, for a value in a role. So a role that was never
    /// meant in a lesson is understood as roles like it are.
    fn each_of_roles(&self, role: Symbol, value: Symbol, has_alternatives: bool, tell: &mut impl FnMut(usize, f32)) {
        let Some(Marker { role, sort }) = Marker::of(role) else { return };
        if sort & 1 == 1 {
            return;
        }
        let groups: &[Roles] = match role.kind() {
            RoleKind::Through | RoleKind::Avoiding | RoleKind::Before => &[Roles::OfTask, Roles::OfWay],
            kind if kind.is_of_task() => &[Roles::OfTask],
            _ => &[Roles::Others],
        };
        let roles = || core::iter::once(Roles::Kind(role.kind(), has_alternatives)).chain(groups.iter().copied());
        let mut is_named = false;
        for mention in self.mentions.iter().filter(|mention| mention.value == value) {
            is_named = true;
            let share = self.words.get(mention.position).copied().flatten().map_or(0.0, |word| self.names.share(word, value));
            self.each_context_of_names(mention, |context| roles().for_each(|roles| tell(of_roles(roles, context), share)));
        }
        let naming = match is_named {
            true => Naming::Named,
            false if self.has_name(value) => Naming::Unnamed,
            false if self.words.iter().all(|&word| self.is_heard(word)) => Naming::Nameless,
            // A new word may name it.
            false => return,
        };
        roles().for_each(|roles| tell(of_naming(roles, naming), 1.0));
    }

    /// Whether training has seen a word.
    fn is_heard(&self, word: Option<Symbol>) -> bool {
        word.is_some_and(|word| word.index() < self.heard)
    }

    /// Whether some word names a value.
    fn has_name(&self, value: Symbol) -> bool {
        (0..self.heard).any(|word| self.names.share(Symbol(word as u16), value) > HAS_NAME)
    }

    /// Calls `tell` with each feature of a mention's context, in which all names are alike.
    fn each_context_of_names(&self, mention: &Mention, mut tell: impl FnMut(Context)) {
        let position = mention.position;
        let at = |position: Option<usize>| {
            let position = position?;
            let word = *self.words.get(position)?;
            let is_mention = self.mentions.iter().any(|mention| mention.position == position);
            Some(if is_mention { ANY_NAME } else { word.filter(|_| self.is_heard(word)).unwrap_or(NEW_WORD) })
        };
        let next = position.saturating_add(1);
        tell(Context::Any);
        tell(Context::Before(at(position.checked_sub(1))));
        if position > 0 {
            tell(Context::SecondBefore(at(position.checked_sub(2))));
        }
        tell(Context::After(at(Some(next))));
        let earlier = || self.mentions.iter().filter(|mention| mention.position < position);
        let later = || self.mentions.iter().filter(|mention| mention.position > position);
        tell(Context::Earlier(earlier().count().min(MOST_COUNTED) as u16));
        tell(Context::Later(later().count().min(MOST_COUNTED) as u16));
        let last = earlier().next_back();
        let from = last.map_or(0, |mention| mention.position.saturating_add(1)).max(position.saturating_sub(FARTHEST));
        self.different(from..position).filter(|&word| self.is_heard(Some(word))).for_each(|word| tell(Context::Since(word)));
        if later().next().is_none() {
            let tail = self.different(next.min(self.words.len())..self.words.len());
            tail.filter(|&word| self.is_heard(Some(word))).for_each(|word| tell(Context::Tail(word)));
        }
        if let Some(last) = last {
            tell(Context::Again(last.value == mention.value));
        }
    }

    /// The word at a position: `None` for one that training has not seen, and `Some(None)` beyond either end.
    fn around(&self, position: Option<usize>) -> Option<Option<Symbol>> {
        match position.and_then(|position| self.words.get(position)) {
            None => Some(None),
            Some(word) => word.map(Some),
        }
    }

    /// Calls `tell` with each feature of the context of a word that names a value.
    fn each_context(&self, position: usize, value: Symbol, mut tell: impl FnMut(Context)) {
        tell(Context::Any);
        self.around(position.checked_sub(1)).into_iter().for_each(|word| tell(Context::Before(word)));
        self.around(position.checked_sub(2)).into_iter().for_each(|word| tell(Context::SecondBefore(word)));
        let next = position.saturating_add(1);
        self.around(Some(next)).into_iter().for_each(|word| tell(Context::After(word)));
        let earlier = || self.mentions.iter().filter(|mention| mention.position < position);
        let later = || self.mentions.iter().filter(|mention| mention.position > position);
        tell(Context::Earlier(earlier().count().min(MOST_COUNTED) as u16));
        tell(Context::Later(later().count().min(MOST_COUNTED) as u16));
        if later().next().is_none() {
            self.different(next.min(self.words.len())..self.words.len()).for_each(|word| tell(Context::Tail(word)));
        }
        let same = |mention: Option<&Mention>| mention.map_or(0, |mention| if mention.value == value { 2 } else { 1 });
        tell(Context::Between(same(earlier().next_back()), same(later().next())));
    }
}
