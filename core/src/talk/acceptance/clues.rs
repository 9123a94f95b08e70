//! The features of a reading that no word itself tells: what it is, how probable the words make it, what speaks against it, and the classes
//! of the words.

use super::super::heard::Heard;
use super::super::hypothesis::Hypothesis;
use super::super::readings::Gathering;
use super::super::repair::Shape;
use super::super::verdict::Doubts;
use super::super::words::Words;
use super::weights::Weights;
use super::words::Spoken;
use crate::voice::classes::Class;

/// The sorts of words: 32 closed classes of new words, the same of words that lessons had, then the sorts below.
const CLASSES: usize = Class::ALL.len();
const NAME: usize = 2 * CLASSES;
const ACT: usize = NAME + 1;
const MENDED: usize = NAME + 2;
const NEW: usize = NAME + 3;
const KNOWN: usize = NAME + 4;
const SORTS: usize = NAME + 5;

/// The places of a word: before the first name, between names, after the last name, first of all, last of all.
const PLACES: usize = 5;

/// Features that have a number for a value.
const NUMBERS: usize = 5;
/// The first of each group of features.
const DONE: usize = NUMBERS;
const ASKED: usize = DONE + 1;
const BACK: usize = DONE + 2;
const REST: usize = DONE + 3;
const TOP: usize = DONE + 4;
const TASKS: usize = TOP + 1 + RIVALS;
const DOUBTS: usize = TASKS + 4;
const NEW_WORDS: usize = DOUBTS + Doubts::COUNT;
const LENGTH: usize = NEW_WORDS + 5;
const NAMES: usize = LENGTH + 7;
const WORDS: usize = NAMES + 6;
/// What the likeliest reading is, and what the first of several commands is.
const RIVALS: usize = 7;
const KIND: usize = WORDS + PLACES * SORTS;
const FIRST: usize = KIND + 1;
/// What tells that all things are meant, in the place of what the first is if it asks for nothing.
const GATHERING: usize = FIRST + 4;
const TURNED: usize = FIRST + RIVALS;
/// Each number once more, as one of [`STEPS`] steps, or none.
const STEPS_OF: usize = TURNED + 1;

/// The upper ends of the steps of a number, without the last.
const ENDS: [f32; 9] = [-1.5, -1.0, -0.6, -0.3, 0.0, 0.3, 0.6, 1.0, 1.5];
const STEPS: usize = ENDS.len() + 2;
/// The sorts of the words between two names.
const BETWEEN: usize = STEPS_OF + NUMBERS * STEPS;
/// The value of a feature of a step, of which many hold at once.
const ONE_OF_MANY: f32 = 0.5;

/// What a repair changes that takes nothing of the utterance back.
const OF_LAST: usize = BETWEEN + SORTS;
/// Whether other words tell the thing, or the place; and whether the task is about a thing.
const TOLD: usize = OF_LAST + Shape::CHANGES;
const OF_THING: usize = TOLD + 2;

/// The number of features, each of which counts for all readings, and again for each [kind](kind) of reading.
const FEATURES: usize = OF_THING + 1;
/// The number of clues.
pub const CLUES: usize = FEATURES * (KINDS + 1);

/// The kinds of readings with weights of their own: a command, a prohibition, several, all, a repair, and all that no known cue tells.
pub const KINDS: usize = 6;
/// The same for words: those of "all" are those of a command.
pub const KINDS_OF_WORDS: usize = 4;
const _: () = assert!(CLUES <= u16::MAX as usize);

/// The kind of a reading that asks for something, from 1.
const fn kind(hypothesis: Hypothesis) -> Option<usize> {
    match hypothesis {
        Hypothesis::Command => Some(1),
        Hypothesis::Negated => Some(2),
        Hypothesis::Several => Some(3),
        Hypothesis::All => Some(4),
        _ => None,
    }
}

/// Whether a hypothesis asks for something.
pub(in super::super) const fn asks(hypothesis: Hypothesis) -> bool {
    kind(hypothesis).is_some()
}

/// The place of a hypothesis among [`RIVALS`].
const fn rival(hypothesis: Hypothesis) -> usize {
    match (kind(hypothesis), hypothesis) {
        (Some(kind), _) => kind.saturating_sub(1),
        (_, Hypothesis::Nothing) => 4,
        (_, Hypothesis::Absent | Hypothesis::About | Hypothesis::Reversed) => 5,
        _ => 6,
    }
}

/// The log odds of a probability, from -2 to 2.
fn odds(probability: f32) -> f32 {
    let (for_it, against) = (probability.max(1e-6), (1.0 - probability).max(1e-6));
    libm::logf(for_it / against).clamp(-8.0, 8.0) / 4.0
}

/// From this probability on, a reading without doubts is clear: 0.7 after 24 lessons, 0.62 after 120.
pub(in super::super) fn clear_from(lessons: usize) -> f32 {
    (0.6 + 2.4 / lessons.max(1) as f32).min(0.95)
}

/// The log odds of a command against a prohibition before its words are heard: 9 to 1.
const MOSTLY_ASKED: f32 = 2.2;

/// The words of an utterance, and their sorts at each place, one bit each.
#[derive(Clone, Copy)]
pub(in super::super) struct Sorts<'u> {
    places: [u128; PLACES],
    new: usize,
    names: usize,
    words: usize,
    spoken: Spoken<'u>,
}

impl<'u> Sorts<'u> {
    /// Of an utterance: the words as they were said, and as they were mended.
    pub fn of(utterance: &'u str, weights: Weights<'u>, said: &[Heard], mended: &[Heard]) -> Self {
        let words = || said.iter().zip(mended);
        let is_name = |(_, word): (&Heard, &Heard)| word.is_name;
        let first = words().position(is_name).unwrap_or(usize::MAX);
        let last = words().enumerate().filter(|&(_, pair)| is_name(pair)).map(|(at, _)| at).next_back();
        let (mut places, mut new, end) = ([0_u128; PLACES], 0_usize, words().count().saturating_sub(1));
        for (at, (said, mended)) in words().enumerate() {
            let sorts = sorts(said, mended);
            new = new.saturating_add((sorts >> NEW & 1) as usize);
            let place = if at < first {
                0
            } else if last.is_none_or(|last| at <= last) {
                1
            } else {
                2
            };
            for (slot, _) in
                places.iter_mut().zip([place == 0, place == 1, place == 2, at == 0, at == end]).filter(|(_, is_there)| *is_there)
            {
                *slot |= sorts;
            }
        }
        // What its own words mean, lessons have told: "turn on" is no task in a home, and one where lamps are.
        let is_taught = |word: &Heard| word.is_of_lessons() || word.is_name;
        let taught = words().filter(|&(said, mended)| is_taught(said) || is_taught(mended));
        let taught = taught.map(|(said, mended)| (said.piece, mended.is_name && !mended.is_toward));
        let spoken = Spoken::of(utterance, weights, taught);
        Self { places, new, names: words().filter(|&pair| is_name(pair)).count(), words: end.saturating_add(1), spoken }
    }

    /// The byte where a piece of the utterance begins.
    pub fn place(&self, piece: Option<usize>) -> Option<usize> {
        piece.and_then(|piece| self.spoken.place(piece))
    }

    /// Whether its words speak for a prohibition rather than a command, although that is rarer.
    pub fn forbids(&self) -> bool {
        let of = |hypothesis| self.spoken.says(kind(hypothesis).unwrap_or(0));
        of(Hypothesis::Negated) > of(Hypothesis::Command) + MOSTLY_ASKED
    }

    /// Whether its words speak for a command.
    pub fn asks(&self) -> bool {
        self.spoken.says(kind(Hypothesis::Command).unwrap_or(0)) > 0.0
    }

    /// Whether its words speak for a repair.
    pub fn repairs(&self) -> bool {
        self.spoken.says(KINDS_OF_WORDS) > 0.0
    }

    /// Of some of its words, with a sign before each of those that are near, such as [`BETWEEN`](super::BETWEEN).
    pub fn between(&self, words: Words<'_>, is_near: &dyn Fn(&Heard) -> bool, sign: &'static str) -> Self {
        let sorts = words.iter().fold(0, |all, word| all | sorts(word, word));
        Self { places: [sorts; PLACES], spoken: self.spoken.between(words.iter().map(|word| (word.piece, is_near(word))), sign), ..*self }
    }
}

/// The sorts of a word.
fn sorts(said: &Heard, mended: &Heard) -> u128 {
    let classes = u128::from(mended.of_table.bits());
    let is_mended = mended.is_mended;
    let mut sorts = if mended.is_of_lessons() { classes << CLASSES } else { classes };
    let mut add = |sort: usize, holds: bool| sorts |= u128::from(holds) << sort;
    add(NAME, mended.is_name);
    add(ACT, mended.acts());
    add(MENDED, is_mended);
    add(NEW, said.is_new && !is_mended);
    let is_marked = mended.is_name || mended.is_of_task || mended.is_plural || is_mended || said.is_new;
    add(KNOWN, classes == 0 && !is_marked && mended.is_of_lessons());
    sorts
}

/// The clues to whether a reading is meant.
#[derive(Clone, Copy)]
pub struct Clues<'s> {
    pub(in super::super) sorts: &'s Sorts<'s>,
    pub(in super::super) hypothesis: Hypothesis,
    /// Of several commands, what the first is.
    pub(in super::super) first: Option<Hypothesis>,
    /// Of a repair, what it takes back; and the words between two commands, or in a repair.
    pub(in super::super) repair: Option<Shape>,
    /// Of a command about all things that no known cue tells, what tells it.
    pub(in super::super) gathering: Option<Gathering>,
    pub(in super::super) between: Option<&'s Sorts<'s>>,
    /// The probability of the hypothesis, and of its tasks if it holds.
    pub(in super::super) share: f32,
    pub(in super::super) of_tasks: f32,
    /// The most probable other hypothesis.
    pub(in super::super) rival: (Hypothesis, f32),
    pub(in super::super) tasks: usize,
    pub(in super::super) is_done: bool,
    pub(in super::super) is_asked: bool,
    /// Whether it refers to an earlier sentence.
    pub(in super::super) points_back: bool,
    /// Whether words that were read apart tell its place, or else its thing; and whether it is about a thing.
    pub(in super::super) told: Option<bool>,
    pub(in super::super) is_of_thing: bool,
    /// Whether it follows an earlier command of the utterance, and whether the second of two commands is to be done first.
    pub(in super::super) is_rest: bool,
    pub(in super::super) is_turned: bool,
    pub(in super::super) lessons: usize,
    pub(in super::super) doubts: Doubts,
}

impl Clues<'_> {
    /// The kind of the reading, from 1 to [`KINDS`].
    fn kind(&self) -> usize {
        match (self.repair, self.gathering) {
            (Some(_), _) => KINDS - 1,
            (_, Some(_)) => KINDS,
            _ => kind(self.hypothesis).unwrap_or(0),
        }
    }

    /// The kind of the reading for words, from 1 to [`KINDS_OF_WORDS`].
    pub fn kind_of_words(&self) -> usize {
        match self.kind() {
            4 | KINDS => 1,
            kind => kind.min(KINDS_OF_WORDS),
        }
    }

    /// The words between two commands, or in a repair, each of which is a clue too.
    pub fn between(&self) -> Option<&Spoken<'_>> {
        self.between.map(|sorts| &sorts.spoken)
    }

    /// The distance from a clue to the same clue for this kind of reading alone: both are below [`CLUES`], and have weights of their own.
    pub fn to_kind(&self) -> u16 {
        (self.kind() * FEATURES) as u16
    }

    /// The words of the utterance, each of which is a clue too.
    pub const fn spoken(&self) -> &Spoken<'_> {
        &self.sorts.spoken
    }

    /// Passes each clue that holds, by its number, with its value.
    pub fn for_each(&self, take: &mut dyn FnMut(u16, f32)) {
        let mut add = |feature: usize, value: f32| take(feature as u16, value);
        let (other, share) = self.rival;
        let is_top = self.share >= share;
        add(KIND, 1.0);
        let against = Some(odds(self.share / (self.share + share))).filter(|_| is_top);
        let both = odds(self.share * self.of_tasks);
        let numbers =
            [Some(odds(self.share)), Some(odds(self.of_tasks)), Some(both), against, Some(libm::logf(1.0 + self.lessons as f32) / 5.0)];
        for (at, number) in numbers.into_iter().enumerate() {
            let step = number.map_or(ENDS.len() + 1, |number| ENDS.iter().filter(|&&end| end < number).count());
            add(STEPS_OF + at * STEPS + step, ONE_OF_MANY);
            if let Some(number) = number {
                add(at, number);
            }
        }
        let mut mark = |feature: usize, holds: bool| {
            if holds {
                add(feature, 1.0);
            }
        };
        mark(DONE, self.is_done);
        mark(ASKED, self.is_asked);
        mark(BACK, self.points_back);
        mark(REST, self.is_rest);
        mark(TURNED, self.is_turned);
        mark(TOP, is_top);
        if let Some(is_place) = self.told {
            mark(TOLD + usize::from(is_place), true);
        }
        mark(OF_THING, self.is_of_thing);
        mark(TOP + 1 + rival(other), !is_top);
        mark(TASKS + self.tasks.min(3), true);
        for doubt in 0..Doubts::COUNT {
            mark(DOUBTS + doubt, self.doubts.has(doubt));
        }
        mark(NEW_WORDS + self.sorts.new.min(4), true);
        mark(LENGTH + (self.sorts.words / 3).min(6), true);
        mark(NAMES + self.sorts.names.min(5), true);
        if let Some(first) = self.first {
            mark(FIRST + rival(first), true);
        }
        if let Some(shape) = self.repair {
            mark(shape.change().map_or(FIRST + shape as usize, |change| OF_LAST + change), true);
        }
        if let Some(gathering) = self.gathering {
            mark(GATHERING + gathering as usize, true);
        }
        let between = self.between.map_or(0, |sorts| sorts.places[0]);
        for sort in 0..SORTS {
            mark(BETWEEN + sort, between >> sort & 1 == 1);
        }
        for (place, &sorts) in self.sorts.places.iter().enumerate() {
            for sort in 0..SORTS {
                mark(WORDS + place * SORTS + sort, sorts >> sort & 1 == 1);
            }
        }
    }
}

/// The name of a clue, in words: the kind of reading for which it counts, then for most clues the place of a word, what is there, and
/// whether lessons had it.
pub fn clue_name(clue: u16) -> [&'static str; 4] {
    const READINGS: [&str; KINDS + 1] = ["any", "command", "prohibition", "several", "all", "repair", "all in other words"];
    const OTHERS: [&str; RIVALS] = ["command", "prohibition", "several", "all", "nothing", "absent", "talk"];
    const WHERE: [&str; PLACES] = ["before names", "between names", "after names", "first", "last"];
    const FEW: [&str; 7] = ["0", "1", "2", "3", "4", "5", "6"];
    const AT: [&str; STEPS] = ["lowest", "1", "2", "3", "4", "5", "6", "7", "8", "highest", "none"];
    const SINGLE: [&str; TOP + 1] = [
        "odds of the hypothesis",
        "odds of the tasks",
        "odds of both",
        "odds against the next",
        "log of lessons",
        "done",
        "asked",
        "points back",
        "follows another command",
        "likeliest",
    ];
    const CHANGED: [&str; Shape::CHANGES] =
        ["the place", "the thing", "all that is named", "back", "another thing", "the robot", "forbidden", "hither", "beside"];
    let (reading, feature) = (usize::from(clue) / FEATURES, usize::from(clue) % FEATURES);
    let name = |names: &[&'static str], at: usize| names.get(at).copied().unwrap_or("");
    let sort_name = |sort: usize| match sort {
        NAME => "a name",
        ACT => "an act",
        MENDED => "a slip",
        NEW => "a new word",
        KNOWN => "a known word",
        _ => Class::ALL.get(sort % CLASSES).map_or("", |class| class.name()),
    };
    let [place, what] = match feature {
        _ if feature <= TOP => ["", name(&SINGLE, feature)],
        _ if feature < TASKS => ["likelier is", name(&OTHERS, feature - TOP - 1)],
        _ if feature < DOUBTS => ["tasks", name(&FEW, feature - TASKS)],
        _ if feature < NEW_WORDS => ["doubt", Doubts::name(feature - DOUBTS)],
        _ if feature < LENGTH => ["new words", name(&FEW, feature - NEW_WORDS)],
        _ if feature < NAMES => ["thirds of words", name(&FEW, feature - LENGTH)],
        _ if feature < WORDS => ["names", name(&FEW, feature - NAMES)],
        _ if feature < KIND => {
            let (place, sort) = ((feature - WORDS) / SORTS, (feature - WORDS) % SORTS);
            [name(&WHERE, place), sort_name(sort)]
        }
        KIND => ["", "always"],
        TURNED => ["", "the second is first"],
        _ if feature < STEPS_OF => ["the first is", name(&OTHERS, feature - FIRST)],
        OF_THING => ["", "a task about a thing"],
        _ if feature >= TOLD => ["told apart", name(&["the thing", "the place"], feature - TOLD)],
        _ if feature >= OF_LAST => ["of the last task", name(&CHANGED, feature - OF_LAST)],
        _ if feature >= BETWEEN => ["between", sort_name(feature - BETWEEN)],
        _ => {
            let (number, step) = ((feature - STEPS_OF) / STEPS, (feature - STEPS_OF) % STEPS);
            return [name(&READINGS, reading), "step", name(&SINGLE, number), name(&AT, step)];
        }
    };
    let is_of_lessons = (WORDS..KIND).contains(&feature) && (CLASSES..NAME).contains(&((feature - WORDS) % SORTS));
    [name(&READINGS, reading), place, what, if is_of_lessons { "of the lessons" } else { "" }]
}
