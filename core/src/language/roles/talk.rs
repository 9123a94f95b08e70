//! How well a task explains an utterance with words around the command, and how much of the task it names.
//!
//! Chatter is a state before and after the words of the command: "would you be so kind as to" and "please, thank you". The command's own
//! words are read as in [`forward`](super::forward).
//!
//! Coverage is how much of each thing of a task is named: nothing, something or all. Of two bags, people call the red one "red"; so a task
//! whose things stay unnamed explains the words less well.

use super::forward::{Memories, Reader, Scratch, heard};
use super::layout::{Layout, MOST_ROLES, SHARES_NAMED, get};
use crate::capacity::{LIFTED_TASKS, WORDS_PER_COMMAND};
use crate::language::LanguageRef;
use crate::language::bitext::BitextRef;
use crate::language::tables::TablesRef;
use crate::probability::Scaled;
use crate::symbols::Symbol;
use crate::task::description::{Group, form, groups};
use crate::task::role::RoleKind;
use heapless::Vec;

/// The probabilities that there is chatter before or after a command, and that it continues.
const ENTER: f32 = 0.15;
const STAY: f32 = 0.85;

/// Pseudo-counts of a thing that is not named, partly named, and fully named.
const PSEUDO_COUNTS: [f32; SHARES_NAMED] = [0.5, 2.0, 4.0];
/// A word is a sign of a kind of task if at least this share of the commands with it are of that kind.
const SIGN: f32 = 0.85;

/// If one value explains a word this many times better than another, the word does not name the other.
const FOREIGN: f32 = 5.0;

/// A word belongs to a task if it is this many times more probable there than in the background.
const OF_TASK: f32 = 2.0;

/// A word of an utterance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Said {
    pub symbol: Option<Symbol>,
    /// Its probability as chatter.
    pub chatter: f32,
}

/// The frequency of a word in commands; `None` for a word that was never heard.
pub(crate) fn common(tables: TablesRef<'_>, word: Option<Symbol>) -> Option<f32> {
    get(tables.cells().1, tables.layout().common()).get(word?.index()).copied()
}

/// F(w), the probability of a word in the background.
pub(crate) fn background(tables: TablesRef<'_>, word: Option<Symbol>) -> Option<f32> {
    get(tables.cells().0, tables.layout().row(None)).get(word?.index()).copied()
}

/// Pr(words | t), with chatter around the command. `new` is the probability of a new word in the background.
pub(crate) fn likelihood(tables: TablesRef<'_>, said: &[Said], description: &[Symbol], new: f32) -> Scaled {
    let (layout, (translations, alignments)) = (tables.layout(), tables.cells());
    let mut reader = Reader::new(layout, translations, alignments, description);
    reader.take_groups();
    reader.new_in_background = Some(new);
    let mut words: Vec<Option<Symbol>, WORDS_PER_COMMAND> = Vec::new();
    for word in said {
        let _ = words.push(word.symbol);
    }
    let number = |position: usize| words.get(position).and_then(|&word| heard(layout, &[word]).next());
    let (mut before, mut after): (Memories, Memories) = ([0.0; MOST_ROLES + 1], [0.0; MOST_ROLES + 1]);
    before.iter_mut().take(1).for_each(|slot| *slot = 1.0 - ENTER);
    let (mut chatter_before, mut chatter_after, mut whole, mut scratch) = (ENTER, 0.0_f32, Scaled::ONE, Scratch::NEW);
    for (position, (word, said)) in heard(layout, &words).zip(said).enumerate() {
        let stop: f32 = before.iter().take(reader.memories()).enumerate().map(|(memory, mass)| mass * reader.end(memory)).sum();
        let mut sum = reader.advance(word, &reader.before(position, number), &before, &mut after, &mut scratch);
        chatter_after = (chatter_after * STAY + stop * ENTER) * said.chatter;
        chatter_before *= said.chatter;
        // The command begins after this word.
        let begins = chatter_before * (1.0 - STAY);
        after.iter_mut().take(1).for_each(|slot| *slot += begins);
        chatter_before *= STAY;
        sum += begins + chatter_before + chatter_after;
        if sum <= 0.0 {
            return Scaled::ZERO;
        }
        whole = whole.scaled_by(sum);
        before.iter_mut().zip(&after).take(reader.memories()).for_each(|(slot, mass)| *slot = mass / sum);
        (chatter_before, chatter_after) = (chatter_before / sum, chatter_after / sum);
    }
    let stop: f32 = before.iter().take(reader.memories()).enumerate().map(|(memory, mass)| mass * reader.end(memory)).sum();
    whole.scaled_by(stop * (1.0 - ENTER) + chatter_after * (1.0 - STAY))
}

/// The meaning of each word in the training data: the value that it names, and the kinds of task that it is a sign of.
pub(crate) struct Senses<'t> {
    tables: TablesRef<'t>,
    bitext: BitextRef<'t>,
    /// Whether a word belongs to no task, whatever the lessons say.
    is_plain: &'t dyn Fn(Symbol) -> bool,
    known: Vec<Option<Sense>, MOST_WORDS>,
    /// The sort of derived facts, which nobody needs to name.
    facts: u8,
}

/// The number of words whose meaning is stored; that of the others is computed each time. A controller has fewer words, and little stack.
pub(crate) const MOST_WORDS: usize = if cfg!(feature = "alloc") { 256 } else { 64 };

#[derive(Clone, Copy)]
struct Sense {
    value: Option<Symbol>,
    /// One bit for each lifted task that training has seen.
    acts: u8,
}

impl<'t> Senses<'t> {
    pub fn new(tables: TablesRef<'t>, bitext: BitextRef<'t>, is_plain: &'t dyn Fn(Symbol) -> bool, facts: u8) -> Self {
        let mut known = Vec::new();
        let _ = known.resize(tables.words().min(MOST_WORDS), None);
        Self { tables, bitext, is_plain, known, facts }
    }

    fn of(&mut self, word: Symbol) -> Sense {
        if let Some(&Some(sense)) = self.known.get(word.index()) {
            return sense;
        }
        let value = value_of(self.tables, word).filter(|&value| is_of_things(self.bitext, word, value));
        let acts = if value.is_some() || (self.is_plain)(word) { 0 } else { sign_of(self.tables.layout(), self.bitext, word) };
        let sense = Sense { value, acts };
        if let Some(slot) = self.known.get_mut(word.index()) {
            *slot = Some(sense);
        }
        sense
    }
}

/// A new word may be a word of a kind of task if in this share of the kind's commands the second word is the one that follows the new word.
const SIGN_BEFORE_NEXT: f32 = 0.3;

impl Senses<'_> {
    /// The kinds of task that a new word before `next` may belong to, one bit each. `is_alike` accepts words that can replace `next`, such
    /// as "towards" for "to".
    pub fn acts_before(&mut self, next: Option<Symbol>, is_alike: Option<&dyn Fn(Symbol) -> bool>) -> u8 {
        let next = next.filter(|word| word.index() < self.tables.words());
        if next.is_none() && is_alike.is_none() {
            return 0;
        }
        let (layout, bitext) = (self.tables.layout(), self.bitext);
        let names = next.is_some_and(|next| self.of(next).value.is_some());
        let (with, all) = kinds_said(layout, bitext, &mut |session| {
            let second = bitext.sentence(session).iter().copied().skip_while(|&word| (self.is_plain)(word)).nth(1);
            second.is_some_and(|word| {
                Some(word) == next || names && self.of(word).value.is_some() || is_alike.is_some_and(|is_alike| is_alike(word))
            })
        });
        let is_sign = |(with, all): (f32, f32)| all > 0.0 && with >= SIGN_BEFORE_NEXT * all;
        with.into_iter().zip(all).enumerate().fold(0, |acts, (row, counts)| acts | u8::from(is_sign(counts)) << row)
    }
}

/// The values that an utterance names, and the kinds of task of which it has a sign.
pub(crate) struct Named {
    /// The words that name a value, and their values.
    words: Vec<Symbol, WORDS_PER_COMMAND>,
    values: Vec<Symbol, WORDS_PER_COMMAND>,
    /// The number of words that were never heard.
    new: usize,
    acts: u8,
    facts: u8,
    /// Whether the place, and the thing, of a task need no name.
    covers: [bool; 2],
}

impl Named {
    pub fn of(senses: &mut Senses<'_>, said: &[Said]) -> Self {
        let mut named = Self { words: Vec::new(), values: Vec::new(), new: 0, acts: 0, facts: senses.facts, covers: [false; 2] };
        for word in said {
            let Some(symbol) = word.symbol.filter(|symbol| symbol.index() < senses.tables.words()) else {
                named.new = named.new.saturating_add(1);
                continue;
            };
            let sense = senses.of(symbol);
            if let Some(value) = sense.value {
                let _ = named.words.push(symbol);
                let _ = named.values.push(value);
            }
            named.acts |= sense.acts;
        }
        named
    }

    /// Whether a word names the place of a task.
    pub fn places(&self, layout: &Layout, description: &[Symbol]) -> bool {
        let is_goal = |position: usize| layout.roles().get(position).is_some_and(|role| role.kind() == RoleKind::Goal);
        let mut places = false;
        named_of(layout, self, description, None, &mut |role, share| {
            places |= share > 0 && role.checked_sub(1).is_some_and(is_goal);
        });
        places
    }

    /// Whether every thing of the task is fully named.
    pub fn is_whole(&self, layout: &Layout, description: &[Symbol]) -> bool {
        let mut whole = true;
        named_of(layout, self, description, None, &mut |role, share| whole &= role == 0 || share == 2);
        whole
    }

    /// Whether no word names a thing outside the task.
    pub fn is_own(&self, tables: TablesRef<'_>, bitext: BitextRef<'_>, description: &[Symbol]) -> bool {
        let (layout, (rows, _)) = (tables.layout(), tables.cells());
        let cell = |value: Symbol, word: Symbol| get(rows, layout.row(Some(value))).get(word.index()).copied().unwrap_or(0.0);
        // A word of a task may occur with a value by chance.
        let is_name = |word: Symbol, value: Symbol| beside_values(tables, word) * FOREIGN < cell(value, word);
        // An article occurs with several values.
        let is_own = |&(word, value): &(Symbol, Symbol)| {
            let most = of_goal(description).flat_map(|group| group.values).map(|&value| cell(value, word)).fold(0.0, f32::max);
            let said = self.words.iter().filter(|&&other| other == word).count();
            let known = of_goal(description).filter(|group| group.values.contains(&value)).count();
            let fits = || most * FOREIGN >= cell(value, word) && (said == 1 || said <= known);
            !is_name(word, value) || fits() || !is_of_things(bitext, word, value)
        };
        self.words.iter().copied().zip(self.values.iter().copied()).all(|named| is_own(&named))
    }

    /// Whether each two neighbouring names are those of one thing of the task: not "green chair" if its chair is red and its room green.
    /// After a name of two words, that of another thing may follow: "blue chair red room".
    pub fn is_of_one(&self, neighbours: &[[Symbol; 2]], description: &[Symbol]) -> bool {
        let roles = |word: Symbol| {
            let value = self.words.iter().position(|&named| named == word).and_then(|at| self.values.get(at)).copied();
            of_goal(description)
                .filter(move |group| value.is_some_and(|value| group.values.contains(&value)))
                .map(|group| group.marker.role)
        };
        let mut was_one = None;
        neighbours.iter().all(|&[first, second]| {
            let is_one = roles(first).any(|role| roles(second).any(|other| other == role));
            let ends_name = was_one == Some(first);
            was_one = Some(second).filter(|_| is_one);
            // A name of nothing in the task is no name of another thing in it.
            is_one || ends_name || roles(first).next().is_none() || roles(second).next().is_none()
        })
    }

    /// Whether there is a sign of the task's kind.
    pub fn acts_for(&self, layout: &Layout, description: &[Symbol]) -> bool {
        form(description).and_then(|token| layout.form(token)).is_some_and(|row| self.acts & 1 << row != 0)
    }

    /// Records that other words tell the place, or the thing.
    pub fn cover(&mut self, place: bool, thing: bool) {
        self.covers = [place, thing];
    }

    fn covers(&self, kind: RoleKind) -> bool {
        let [place, thing] = self.covers;
        place && kind == RoleKind::Goal || thing && kind == RoleKind::Subject
    }

    /// Sets the number of words that may be new names.
    pub const fn has_new(&mut self, words: usize) {
        self.new = words;
    }

    /// Records that a new word may be the sign of these kinds of task.
    pub const fn may_act(&mut self, kinds: u8) {
        self.acts |= kinds;
    }

    /// Records that another word is the sign of a task, of any kind, unless a kind is known.
    pub fn act(&mut self) {
        if self.acts == 0 {
            self.acts = u8::MAX;
        }
    }

    /// Records that the words tell a task without a sign of its kind.
    pub const fn act_in_any_way(&mut self) {
        self.acts = u8::MAX;
    }

    /// Whether there is a sign of any kind of task.
    pub fn acts(&self) -> bool {
        self.acts != 0
    }
}

/// The values of the thing and of the place that a task is about.
fn of_goal(description: &[Symbol]) -> impl Iterator<Item = Group<'_>> {
    let is_of_goal = |kind: RoleKind| matches!(kind, RoleKind::Goal | RoleKind::Subject);
    groups(description).filter(move |group| is_of_goal(group.marker.role.kind()) && group.marker.sort & 1 == 0)
}

/// The highest probability of a word outside values: as a word of a task or of the background.
fn beside_values(tables: TablesRef<'_>, word: Symbol) -> f32 {
    let (layout, (rows, _)) = (tables.layout(), tables.cells());
    let cell = |token: Option<Symbol>| get(rows, layout.row(token)).get(word.index()).copied().unwrap_or(0.0);
    layout.forms().iter().map(|&form| cell(Some(form))).fold(cell(None), f32::max)
}

/// Whether a word belongs to a task rather than to the background.
pub(crate) fn is_of_task(tables: TablesRef<'_>, word: Option<Symbol>) -> bool {
    word.is_some_and(|word| {
        let background = background(tables, Some(word)).unwrap_or(f32::MAX);
        value_of(tables, word).is_none() && beside_values(tables, word) > OF_TASK * background
    })
}

/// Whether a word is likelier as the name of a value than as a word of a task or of the background.
pub(crate) fn is_name(tables: TablesRef<'_>, word: Option<Symbol>) -> bool {
    word.is_some_and(|word| value_of(tables, word).is_some())
}

/// As [`is_name`], for a word that was said of nothing else: in "把篮子拿到红色房间" the verb 拿 follows the name of each thing, so that training
/// takes it for a part of these names.
pub(crate) fn is_name_alone(language: LanguageRef<'_>, word: Option<Symbol>) -> bool {
    word.zip(word.and_then(|word| value_of(language.tables(), word)))
        .is_some_and(|(word, value)| is_of_things(language.bitext(), word, value))
}

/// The value that a word names, if that is likelier than a word of a task or of the background.
fn value_of(tables: TablesRef<'_>, word: Symbol) -> Option<Symbol> {
    let (layout, (rows, _)) = (tables.layout(), tables.cells());
    let cell = |token: Option<Symbol>| get(rows, layout.row(token)).get(word.index()).copied().unwrap_or(0.0);
    let (mut best, mut most) = (None, beside_values(tables, word));
    for token in (0..layout.tokens()).map(|token| Symbol(token as u16)).filter(|token| layout.form(*token).is_none()) {
        let probability = cell(Some(token));
        if probability > most {
            (best, most) = (Some(token), probability);
        }
    }
    best
}

/// More than this share of the commands with the name of a value are about something with that value. A verb that was often said of bags
/// names none.
const NAME: f32 = 0.8;

/// Whether nearly all commands that have a word are about something with this value; so it is of a word that no command has. If all lessons
/// start in one place, words of every command occur with that place and do not name it.
fn is_of_things(bitext: BitextRef<'_>, word: Symbol, value: Symbol) -> bool {
    let (mut with, mut all) = (0.0_f32, 0.0_f32);
    for session in (0..bitext.sessions() as u16).filter(|&session| bitext.sentence(session).contains(&word)) {
        for pair in bitext.pairs_of(session) {
            let is_of_thing = groups(bitext.command(pair.command))
                .any(|group| matches!(group.marker.role.kind(), RoleKind::Goal | RoleKind::Subject) && group.values.contains(&value));
            all += pair.weight;
            with += if is_of_thing { pair.weight } else { 0.0 };
        }
    }
    all == 0.0 || with > NAME * all
}

/// How much each lifted task was meant in the sessions that have something, and in all.
fn kinds_said(layout: &Layout, bitext: BitextRef<'_>, has: &mut dyn FnMut(u16) -> bool) -> ([f32; LIFTED_TASKS], [f32; LIFTED_TASKS]) {
    let (mut with, mut all) = ([0.0_f32; LIFTED_TASKS], [0.0_f32; LIFTED_TASKS]);
    for session in 0..bitext.sessions() as u16 {
        let has = has(session);
        for pair in bitext.pairs_of(session) {
            let Some(row) = form(bitext.command(pair.command)).and_then(|token| layout.form(token)) else { continue };
            if let (Some(with), Some(all)) = (with.get_mut(row), all.get_mut(row)) {
                *all += pair.weight;
                *with += if has { pair.weight } else { 0.0 };
            }
        }
    }
    (with, all)
}

/// The kinds of task that a word is a sign of.
fn sign_of(layout: &Layout, bitext: BitextRef<'_>, word: Symbol) -> u8 {
    let (with, all) = kinds_said(layout, bitext, &mut |session| bitext.sentence(session).contains(&word));
    let (sum_with, sum_all): (f32, f32) = (with.iter().sum(), all.iter().sum());
    let only_one = all.iter().filter(|&&count| count > 0.0).count() < 2;
    let is_sign = |(with, all): (f32, f32)| all > 0.0 && (only_one || (with + 0.5 * all / sum_all) / (sum_with + 0.5) >= SIGN);
    with.into_iter().zip(all).enumerate().fold(0, |acts, (row, counts)| acts | u8::from(is_sign(counts)) << row)
}

/// The probability of each coverage, per lifted task: of the task itself, and of each role of a goal or a subject.
pub(crate) struct Coverage {
    counts: [[[f32; SHARES_NAMED]; MOST_ROLES + 1]; LIFTED_TASKS],
}

impl Coverage {
    /// Counts the coverages in the training data.
    pub fn of(senses: &mut Senses<'_>) -> Self {
        let (layout, bitext) = (senses.tables.layout(), senses.bitext);
        let mut coverage = Self { counts: [[PSEUDO_COUNTS; MOST_ROLES + 1]; LIFTED_TASKS] };
        for session in 0..bitext.sessions() as u16 {
            let mut said: Vec<Said, WORDS_PER_COMMAND> = Vec::new();
            for &word in bitext.sentence(session) {
                let _ = said.push(Said { symbol: Some(word), chatter: 0.0 });
            }
            let named = Named::of(senses, &said);
            for pair in bitext.pairs_of(session) {
                let description = bitext.command(pair.command);
                let Some(row) = form(description).and_then(|token| layout.form(token)) else { continue };
                let Some(counts) = coverage.counts.get_mut(row) else { continue };
                named_of(layout, &named, description, None, &mut |role, share| {
                    if let Some(count) = counts.get_mut(role).and_then(|counts| counts.get_mut(share)) {
                        *count += pair.weight;
                    }
                });
            }
        }
        coverage
    }

    /// The probability of this coverage of the task and its things. With `ghost`, a new word may name a thing in this role that is not
    /// here.
    pub fn share(&self, layout: &Layout, named: &Named, description: &[Symbol], ghost: Option<RoleKind>) -> Scaled {
        let Some(row) = form(description).and_then(|token| layout.form(token)) else { return Scaled::ONE };
        let Some(counts) = self.counts.get(row) else { return Scaled::ONE };
        let (mut of_task, mut of_roles) = (1.0_f32, Scaled::ONE);
        named_of(layout, named, description, ghost, &mut |role, share| {
            let Some(counts) = counts.get(role) else { return };
            let probability = counts.get(share).copied().unwrap_or(0.0) / counts.iter().sum::<f32>();
            if role == 0 { of_task = probability } else { of_roles = of_roles.scaled_by(probability) }
        });
        // The roles together count half.
        of_roles.square_root().scaled_by(of_task)
    }

    /// The largest probability, over all kinds, that a command has no word of its task.
    pub fn most_without_task(&self, layout: &Layout) -> f32 {
        let without = |counts: &[[f32; SHARES_NAMED]; MOST_ROLES + 1]| {
            counts.first().map_or(0.0, |counts| counts.first().copied().unwrap_or(0.0) / counts.iter().sum::<f32>())
        };
        self.counts.iter().take(layout.forms().len()).map(without).fold(0.0, f32::max)
    }
}

/// Calls `tell` with a position and its coverage: 0 for nothing named, 1 for a part, 2 for all. The task itself is at position 0, its roles
/// follow. One word names one thing.
fn named_of(layout: &Layout, named: &Named, description: &[Symbol], ghost: Option<RoleKind>, tell: &mut dyn FnMut(usize, usize)) {
    tell(0, if named.acts_for(layout, description) { 2 } else { 0 });
    let mut left = named.values.clone();
    let mut new = named.new;
    let has_subject = groups(description).any(|group| group.marker.role.kind() == RoleKind::Subject);
    for kind in [RoleKind::Goal, RoleKind::Subject] {
        for (position, &role) in layout.roles().iter().enumerate().filter(|(_, role)| role.kind() == kind) {
            let of_role = || groups(description).filter(move |group| group.marker.role == role);
            let (mut all, mut said, covers) = (0_usize, 0_usize, named.covers(kind));
            for group in of_role().filter(|group| group.marker.sort & 1 == 0) {
                let count = all;
                all = all.saturating_add(1);
                if covers {
                    // "Leave the blue chair here" names no place.
                } else if let Some(found) = left.iter().position(|value| group.values.contains(value)) {
                    left.swap_remove(found);
                    said = said.saturating_add(1);
                } else if ghost == Some(kind) && new > 0 {
                    new = new.saturating_sub(1);
                    said = said.saturating_add(1);
                } else if group.marker.sort == named.facts {
                    all = count;
                }
            }
            if all == 0 {
                continue;
            }
            let names_guest = || {
                let mut guests = of_role().filter(|group| group.marker.sort & 1 == 1);
                !has_subject && guests.any(|group| left.iter().any(|value| group.values.contains(value)))
            };
            let share = match said {
                _ if covers => 2,
                0 => usize::from(names_guest()),
                said if said == all => 2,
                _ => 1,
            };
            tell(position.saturating_add(1), share);
        }
    }
}
