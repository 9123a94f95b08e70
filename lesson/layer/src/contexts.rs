//! A command as features for the layer: the words that name values, and their contexts.

use crate::parts::Part;
use crate::weights::{Context, Roles, of_context, of_kind, of_kind_word, of_roles, of_told};
use goodbot::capacity::WORDS_PER_COMMAND;
use goodbot::language::TablesRef;
use goodbot::language::roles::names::Names;
use goodbot::symbols::Symbol;
use goodbot::task::Marker;
use heapless::Vec;

/// A word names a value if it was taken for it in more than this share of the times it was heard.
const SPEAKS: f32 = 0.05;
/// A word is a mention if it was taken for some value in more than this share of those times.
const MENTIONS: f32 = 0.3;
/// More mentions before or after count as this many.
const MOST_COUNTED: usize = 3;
/// A command of at most this many words may be a name of the whole task, such as "hop". No context tells what its words mean.
const OF_WHOLE_TASK: usize = 2;
/// The farthest word after a mention that counts for the next one.
const FARTHEST: usize = 6;
/// Any mention, as a neighbour of another. No word has this number.
const ANY_NAME: Symbol = Symbol::new(u16::MAX - 1);

/// A word that was taken for a value often enough.
#[derive(Clone, Copy)]
struct Mention {
    position: usize,
    value: Symbol,
}

/// A command.
pub struct Command<'s, 't> {
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

    /// The different words from one position to before another.
    fn different(&self, from: usize, until: usize) -> impl Iterator<Item = Symbol> {
        let words = self.words.get(from..until).unwrap_or(&[]);
        let is_first = move |position: usize, word: Symbol| !words.iter().take(position).any(|&other| other == Some(word));
        let known = words.iter().enumerate().filter_map(|(position, word)| word.map(|word| (position, word)));
        known.filter(move |&(position, word)| is_first(position, word)).map(|(_, word)| word)
    }

    /// Tells each weight that speaks for a part of a task, and how much it counts.
    pub fn each_weight(&self, part: Part, mut tell: impl FnMut(usize, f32)) {
        let all = || self.different(0, self.words.len());
        let (role, value, has_alternatives) = match part {
            Part::Kind(form) => {
                tell(of_kind(form), 1.0);
                all().for_each(|word| tell(of_kind_word(form, word), 1.0));
                return;
            }
            Part::Value(role, value, has_alternatives) => (role, value, has_alternatives),
        };
        if self.is_told || self.words.len() <= OF_WHOLE_TASK {
            tell(of_told(role, value, None), 1.0);
            all().for_each(|word| tell(of_told(role, value, Some(word)), 1.0));
        }
        for (position, word) in self.words.iter().enumerate() {
            let share = word.map_or(0.0, |word| self.names.share(word, value));
            if share > SPEAKS {
                self.each_context(position, |context| tell(of_context(role, context), share));
            }
            let is_mention = || self.mentions.iter().any(|mention| mention.position == position && mention.value == value);
            if let Some(Marker { role, .. }) = Marker::of(role).filter(|marker| self.has_ways && marker.sort & 1 == 0 && is_mention()) {
                // A role that was never meant in a lesson is understood as roles like it are.
                let group = if role.kind().is_of_task() { Roles::OfTask } else { Roles::Others };
                let groups = [Roles::Kind(role.kind(), has_alternatives), group];
                self.each_context(position, |context| groups.iter().for_each(|&group| tell(of_roles(group, context), share)));
            }
        }
    }

    /// A neighbour: `None` for a word that training has not seen, and `Some(None)` beyond either end. If tasks have ways, all mentions are
    /// alike.
    fn around(&self, position: Option<usize>) -> Option<Option<Symbol>> {
        let Some((position, word)) = position.and_then(|position| Some((position, *self.words.get(position)?))) else { return Some(None) };
        let is_mention = self.has_ways && self.mentions.iter().any(|mention| mention.position == position);
        if is_mention { Some(Some(ANY_NAME)) } else { word.filter(|word| word.index() < self.heard).map(Some) }
    }

    /// Calls `tell` with each feature of the context of a word that names a value.
    fn each_context(&self, position: usize, mut tell: impl FnMut(Context)) {
        tell(Context::Any);
        self.around(position.checked_sub(1)).into_iter().for_each(|word| tell(Context::Before(word)));
        self.around(position.checked_sub(2)).into_iter().for_each(|word| tell(Context::SecondBefore(word)));
        self.around(Some(position.saturating_add(1))).into_iter().for_each(|word| tell(Context::After(word)));
        let mut earlier = self.mentions.iter().filter(|mention| mention.position < position);
        let later = self.mentions.iter().filter(|mention| mention.position > position);
        tell(Context::Earlier(earlier.clone().count().min(MOST_COUNTED) as u16));
        tell(Context::Later(later.count().min(MOST_COUNTED) as u16));
        let last = earlier.next_back();
        let from = last.map_or(0, |mention| mention.position.saturating_add(1)).max(position.saturating_sub(FARTHEST));
        self.different(from, position).filter(|word| word.index() < self.heard).for_each(|word| tell(Context::Since(word)));
    }
}
