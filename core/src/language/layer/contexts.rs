//! A command as the layer hears it: which words speak of values, and what stands around them.

use super::parts::Part;
use super::weights::{Context, of_context, of_kind, of_word};
use crate::capacity::WORDS_PER_COMMAND;
use crate::language::roles::names::Names;
use crate::language::tables::TablesRef;
use crate::symbols::Symbol;
use heapless::Vec;

/// A word speaks of a value if it was taken for it in more than this share of the times that it was heard.
const SPEAKS: f32 = 0.05;
/// A word is a mention if it was taken for some value in more than this share.
const MENTIONS: f32 = 0.3;
/// More mentions before or after count as so many.
const MOST_COUNTED: usize = 3;

/// A command.
pub(super) struct Command<'s, 't> {
    words: &'s [Option<Symbol>],
    names: Names<'t>,
    /// The positions of the mentions, in order.
    mentions: Vec<usize, WORDS_PER_COMMAND>,
}

impl<'s, 't> Command<'s, 't> {
    /// A command, after a training on data of so many words, each as often as it was `said`.
    pub fn new(tables: TablesRef<'t>, said: f32, words: &'s [Option<Symbol>]) -> Self {
        let names = Names::new(tables, said);
        let mut command = Self { words, names, mentions: Vec::new() };
        let most = |word: Symbol| names.values().map(|value| names.share(word, value)).fold(0.0, f32::max);
        for (position, word) in words.iter().enumerate() {
            if word.is_some_and(|word| most(word) > MENTIONS) {
                // As many as words at most.
                let _ = command.mentions.push(position);
            }
        }
        command
    }

    /// The words, each once.
    fn different(&self, from: usize) -> impl Iterator<Item = (usize, Symbol)> {
        let words = self.words;
        let first = move |position: usize, word: Symbol| !words.iter().take(position).skip(from).any(|&other| other == Some(word));
        words
            .iter()
            .enumerate()
            .skip(from)
            .filter_map(|(position, word)| word.map(|word| (position, word)))
            .filter(move |&(position, word)| first(position, word))
    }

    /// Tells each weight that speaks for a part of a task, and how much it counts.
    pub fn each_weight(&self, part: Part, mut tell: impl FnMut(usize, f32)) {
        let (role, value) = part;
        if role == value {
            tell(of_kind(value), 1.0);
            self.different(0).for_each(|(_, word)| tell(of_word(part, word), 1.0));
            return;
        }
        for (_, word) in self.different(0).filter(|&(_, word)| self.names.share(word, value) > SPEAKS) {
            tell(of_word(part, word), 1.0);
        }
        let mut most = 0.0_f32;
        for (position, word) in self.words.iter().enumerate() {
            let share = word.map_or(0.0, |word| self.names.share(word, value));
            if share > SPEAKS {
                most = most.max(share);
                self.each_context(position, |context| tell(of_context(role, context), share));
            }
        }
        if most > 0.0 {
            tell(of_context(role, Context::Most), most);
        }
    }

    /// Tells what stands around a word.
    fn each_context(&self, position: usize, mut tell: impl FnMut(Context)) {
        tell(Context::Any);
        let next = position.saturating_add(1);
        // What is around a word that training has not seen says nothing.
        match position.checked_sub(1).map(|before| self.words.get(before).copied().flatten()) {
            None => tell(Context::Before(None)),
            Some(None) => {}
            word => tell(Context::Before(word.flatten())),
        }
        match self.words.get(next) {
            None => tell(Context::After(None)),
            Some(None) => {}
            Some(&word) => tell(Context::After(word)),
        }
        let (earlier, later) = self.mentions.iter().fold((0_usize, 0_usize), |(earlier, later), &other| {
            (earlier.saturating_add(usize::from(other < position)), later.saturating_add(usize::from(other > position)))
        });
        tell(Context::Earlier(earlier.min(MOST_COUNTED) as u16));
        tell(Context::Later(later.min(MOST_COUNTED) as u16));
        if later == 0 {
            self.different(next).for_each(|(_, word)| tell(Context::Tail(word)));
        }
    }
}
