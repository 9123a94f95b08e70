//! A word of an utterance, with its probabilities in a command and beside one.

use crate::capacity::WORDS_PER_COMMAND;
use crate::language::LanguageRef;
use crate::language::bitext::BitextRef;
use crate::language::roles::talk::{Said, background, common, is_name, is_name_alone, is_of_task};
use crate::symbols::Symbol;
use crate::voice::classes::{Class, Classes};
use heapless::Vec;

/// The probability of a new word if no task is meant, and beside a command.
const NEW: f32 = 0.5;
/// The probability of a polite word beside a command, and of another word of a closed class.
const POLITE: f32 = 0.6;
const OTHER_CLOSED: f32 = 1e-3;
/// The classes of words that negate, split or generalise a command.
const TURNING: [Class; 5] = [Class::Negation, Class::Out, Class::But, Class::All, Class::Connective];
/// The factor of a word of these classes that no lesson had, read as an ordinary word.
const TURNS: f32 = 0.01;

/// One word, with its classes.
#[derive(Clone, Copy)]
pub(super) struct Heard {
    pub said: Said,
    pub classes: Classes,
    /// All its classes in the table, also those of words that commands have.
    pub of_table: Classes,
    /// Its probability if no task is meant.
    pub without_task: f32,
    /// Its number of occurrences in lessons.
    pub count: f32,
    /// A factor on its probability in a command. For a mended word: its spelling as a slip, against that of a new word. For a word that
    /// negates, splits or generalises commands and was in no lesson: [`TURNS`]. 1 for any other word.
    pub factor: f32,
    /// Whether it is heard for the first time, and in no class.
    pub is_new: bool,
    /// Whether it is heard for the first time, and read as a known word.
    pub is_mended: bool,
    /// Whether it is a word of direction, such as "to".
    pub is_toward: bool,
    /// Whether it is an article: "el".
    pub is_article: bool,
    /// Whether it leaves a thing in its place, such as "leave".
    pub leaves: bool,
    /// Whether it is "have" before a participle.
    pub is_perfect: bool,
    /// Whether it tells a place by the thing named next, such as "where" and "beside".
    pub is_beside: bool,
    /// Whether it is a single sign of a script without spaces.
    pub is_sign: bool,
    /// The number of its piece in the utterance, from 0.
    pub piece: u8,
    /// The number of its phrase, from 0. Marks such as commas end a phrase.
    pub phrase: u8,
    /// Whether some task explains it better than the background does.
    pub is_of_task: bool,
    /// Whether it names a value.
    pub is_name: bool,
    /// Whether it is probably the plural of a name: "chairs".
    pub is_plural: bool,
}

/// The words of an utterance.
pub(super) type Utterance = Vec<Heard, WORDS_PER_COMMAND>;

impl Heard {
    pub fn new(language: LanguageRef<'_>, symbol: Option<Symbol>, of_table: Classes) -> Self {
        let tables = language.tables();
        let (is_toward, is_article, is_beside) = (of_table.contains(Class::Toward), of_table.contains(Class::Clitic), of_table.is_beside());
        let acts_as = |class| of_table.contains(Class::Act) && of_table.contains(class);
        let classes = of_table.about_commands();
        let (is_polite, common) = (classes.contains(Class::Polite), common(tables, symbol));
        let share = |known: Option<f32>, new: f32| known.map_or(new, |share| (1.0 - new) * share);
        let others = [Class::Stop, Class::No, Class::Pronoun, Class::Again, Class::Asking];
        let chatter = match is_polite {
            true => common.map_or(POLITE, |common| POLITE.max((1.0 - NEW) * common)),
            false if classes.contains_any(&TURNING) || classes.contains_any(&others) => OTHER_CLOSED,
            false => share(background(tables, symbol), NEW),
        };
        let is_name_alone = is_name_alone(language, symbol);
        let count = symbol.map_or(0.0, |symbol| count(language.bitext(), symbol) as f32);
        let factor = if count == 0.0 && classes.contains_any(&TURNING) { TURNS } else { 1.0 };
        Self {
            said: Said { symbol, chatter },
            classes,
            of_table,
            without_task: factor * share(common, if is_polite { NEW / 2.0 } else { NEW }),
            count,
            factor,
            is_new: classes == Classes::NONE && !is_toward && !is_beside && !is_article && is_unknown(language, symbol),
            is_mended: false,
            is_toward,
            is_article,
            leaves: acts_as(Class::Out),
            is_perfect: acts_as(Class::Asking),
            is_beside,
            is_sign: false,
            piece: 0,
            phrase: 0,
            is_of_task: is_of_task(tables, symbol) || is_name(tables, symbol) && !is_name_alone,
            is_name: is_name_alone,
            is_plural: false,
        }
    }

    /// The word "it" joined to a verb.
    pub fn joined(language: LanguageRef<'_>) -> Self {
        Self::new(language, None, Classes::of(Class::It).with(Class::Pronoun))
    }

    /// Whether it is of a class.
    pub const fn is(&self, class: Class) -> bool {
        self.classes.contains(class)
    }

    /// Whether it is of one of these classes.
    pub fn is_any(&self, classes: &[Class]) -> bool {
        self.classes.contains_any(classes)
    }

    /// Whether it is in no class about commands.
    pub fn is_open(&self) -> bool {
        self.classes == Classes::NONE
    }

    /// Whether a lesson had it.
    pub fn is_of_lessons(&self) -> bool {
        self.count > 0.0
    }

    /// Whether it is heard for the first time, and in no class, even if it was mended.
    pub fn is_strange(&self) -> bool {
        self.is_new || self.is_mended
    }

    /// Whether it is heard for the first time, and no slip for a known word.
    pub fn is_new_word(&self) -> bool {
        self.is_strange() && !self.is_slip()
    }

    /// Whether it is more probable as a slip for a known word than as a new word.
    fn is_slip(&self) -> bool {
        self.is_mended && self.factor > 1.0
    }

    /// Whether it neither belongs to a task nor names a value.
    pub const fn is_plain(&self) -> bool {
        !(self.is_new || self.is_of_task || self.is_name)
    }

    /// Whether it may be the noun of a name before it: "room" of "the red room".
    pub fn is_noun(&self) -> bool {
        self.is_of_lessons() && self.is_open() && self.is_plain() && !self.is_toward && !self.is_article
    }

    /// Whether it may be an act word, or a direction.
    pub const fn may_act(&self) -> bool {
        self.is_new || self.is_of_task
    }

    /// Whether it is a known act word, and no direction.
    pub const fn acts(&self) -> bool {
        self.is_of_task && !self.is_toward
    }

    /// The same word as a slip for a known one.
    pub fn mended(self, language: LanguageRef<'_>, symbol: Symbol, slip: f32) -> Self {
        let meant = Self::new(language, Some(symbol), Classes::NONE);
        let said = Said { symbol: Some(symbol), chatter: self.said.chatter / slip + meant.said.chatter };
        Self {
            said,
            without_task: self.without_task + slip * meant.without_task,
            count: meant.count,
            factor: slip,
            is_new: false,
            is_mended: true,
            is_of_task: meant.is_of_task,
            is_name: meant.is_name,
            is_plural: false,
            ..self
        }
    }
}

/// The number of occurrences of a word in all lessons.
pub(super) fn count(bitext: BitextRef<'_>, word: Symbol) -> usize {
    (0..bitext.sessions() as u16).map(|session| bitext.sentence(session).iter().filter(|&&other| other == word).count()).sum()
}

/// Whether no lesson had a word.
pub(super) fn is_unknown(language: LanguageRef<'_>, symbol: Option<Symbol>) -> bool {
    symbol.is_none_or(|symbol| symbol.index() >= language.tables().words())
}
