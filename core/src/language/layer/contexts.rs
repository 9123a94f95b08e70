//! A command as features for the layer: the words that name values, and their contexts.

use super::parts::Part;
use super::weights::{Context, of_context, of_kind, of_kind_word, of_told, of_value_word};
use crate::capacity::WORDS_PER_COMMAND;
use crate::language::roles::names::Names;
use crate::language::tables::TablesRef;
use crate::symbols::Symbol;
use core::ops::Range;
use heapless::Vec;

/// A word is a feature of a value if it was taken for it in more than this share of the times it was heard.
const SPEAKS: f32 = 0.05;
/// A word is a mention if it was taken for some value in more than this share of those times.
const MENTIONS: f32 = 0.3;
/// More mentions before or after count as this many.
const MOST_COUNTED: usize = 3;

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
    /// In order.
    mentions: Vec<Mention, WORDS_PER_COMMAND>,
}

impl<'s, 't> Command<'s, 't> {
    /// A command, after a training on data with `said` words, repetitions included.
    pub fn new(tables: TablesRef<'t>, said: f32, words: &'s [Option<Symbol>]) -> Self {
        let names = Names::new(tables, said);
        let mut command = Self { words, names, is_told: tables.layout().has_names(), mentions: Vec::new() };
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
            Part::Value(role, value) => (role, value),
        };
        if self.is_told {
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
