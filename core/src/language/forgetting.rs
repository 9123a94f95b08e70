//! Which sessions are forgotten when memory is full, so that learning continues (feature `forgetting`; without it a session without room is
//! refused). If a rule finds two sessions equal, the older one goes.
//!
//! When a session is forgotten, another session with the same English command, if there is one, remembers that the command was heard
//! before. A session is *strange* if its command was heard once in the robot's life, as far as is remembered, and has a word that no other
//! session has: a slip of the tongue, or something new.
//!
//! - If there is no room for one more session, the oldest strange session goes, if more than two and more than an eighth of the sessions
//!   are strange. Otherwise one goes whose command other sessions repeat, if there is one: the one that is repeated most, measured by how
//!   often its command is kept plus how many sessions have its rarest word (counted up to three); among equals, the one that taught least,
//!   because it has the most machine commands.
//! - If the alignment tables are full, those of the new session's machine commands that need a table of their own and weigh less than a
//!   tenth are left out. If heavier ones find no room, the oldest strange session of another length goes, then one whose command has the
//!   rarest length.
//! - If the vocabulary is full, rare words go first: the oldest strange session goes, then the session with the most words that no other
//!   has. Words and machine tokens that no session uses any more go with it. An eighth of the vocabulary is kept free, so that the next
//!   command is heard whole; if more words, or more facts about objects, come at once, the rest are left out. For words that were left out,
//!   as much is kept free as they need, if the command fits alone: said again, it is heard whole.
//!
//! The newest session is never forgotten. A session that would not fit even alone is refused, and nothing is forgotten for it. A command of
//! which no word found room has nothing to learn from: it is refused too, and room is made for its words.

use super::bitext::{Alone, close_up};
use super::model::LanguageMut;
use super::settings::Model;
use super::{ibm2, roles};
use crate::capacity::{Capacities, Capacity, CapacityError, WORDS_PER_COMMAND};
use crate::symbols::Symbol;
use heapless::Vec;

/// Whether sessions may be forgotten. If not, the code that chooses one is not linked.
const FORGETS: bool = cfg!(feature = "forgetting");

/// The inverse of the share of the vocabulary that is kept free.
const FREE_PART: usize = 8;

/// The words of a command that found no room when it was heard, each as often as it was said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Unheard {
    words: u8,
    bytes: u16,
}

impl Unheard {
    /// No words.
    pub const NONE: Self = Self { words: 0, bytes: 0 };

    /// One more word, of this many bytes.
    pub const fn note(&mut self, bytes: usize) {
        self.words = self.words.saturating_add(1);
        self.bytes = self.bytes.saturating_add(bytes as u16);
    }
}

/// The smallest capacity for `entries` of which an eighth is kept free.
pub(crate) const fn with_free_part(entries: usize) -> usize {
    entries.saturating_add(entries.saturating_sub(1) / (FREE_PART - 1))
}

/// The inverse of the share of sessions that may be strange; [`STRANGE`] always may.
const STRANGE_PART: usize = 8;
const STRANGE: usize = 2;

/// A word that this many sessions have is well known.
const WELL_KNOWN: usize = 3;

/// The result of one attempt to keep a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use]
pub(crate) enum Room {
    /// There is room.
    Found,
    /// Not known yet: call again.
    Sought,
    /// This session was forgotten because this table was full; whether that is enough is not known yet.
    Made(u16, Capacity),
}

/// The next step in keeping a session, or in making room in the vocabulary. Each takes one call.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Step {
    /// Check whether there is room.
    Look,
    /// Add the session, or accept the vocabulary as it is.
    Take,
    /// Choose the session to forget.
    Choose(Choice),
    /// Continue to forget the chosen session, because this table was full.
    Forget(u16, Capacity),
    /// Forget the words before this position that no session has.
    ForgetWords(u16),
    /// Check whether the vocabulary has room.
    Measure,
    /// As this table of the vocabulary is full, forget the machine tokens before a position that nothing uses; whether there were any so far.
    ForgetTokens(u16, bool, Capacity),
    /// A session was forgotten: collect the parameters of the remaining training data again.
    Renew,
}

/// The choice of the session to forget. One call looks at one session.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Choice {
    want: Want,
    /// The table that is full.
    full: Capacity,
    /// The number of sessions to choose from, and of those looked at so far.
    among: u16,
    looked: u16,
    /// The number of strange sessions among those, and the oldest of them.
    strange: u16,
    oldest_strange: Option<u16>,
    /// The oldest session of the highest rank, so far.
    best: Option<(u16, Rank)>,
}

/// How little is lost with a session, the higher the less; compared number by number.
type Rank = [u16; 3];

/// Why a session has to be forgotten.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Want {
    /// Room for one more session.
    Session,
    /// Room for the alignment tables of a command of this many words.
    Lengths(usize),
    /// Room for words and machine tokens.
    Vocabulary,
}

impl Choice {
    /// Begins with the first `sessions` sessions; `None` if there are none, or if none may be forgotten.
    fn among(sessions: usize, want: Want, full: Capacity) -> Option<Self> {
        let begun = Self { want, full, among: sessions as u16, looked: 0, strange: 0, oldest_strange: None, best: None };
        (FORGETS && sessions > 0).then_some(begun)
    }
}

/// The symbols that are looked for at once: a bit each.
const LOOKED_FOR: u16 = u32::BITS as u16;

/// Which of the symbols from `first` on are used: a search for each would go through all that use them each time.
fn used_from<'s>(first: u16, used: impl Iterator<Item = &'s Symbol>) -> u32 {
    used.map(|symbol| symbol.0.wrapping_sub(first)).filter(|&at| at < LOOKED_FOR).fold(0, |bits, at| bits | 1 << at)
}

/// The last symbol before `end` that is not used, if it is among those looked for, and the position before which others may be. One part of
/// the work forgets one symbol, because all training data are renamed for it.
fn last_unused<'s>(end: u16, used: impl Iterator<Item = &'s Symbol>) -> (Option<Symbol>, u16) {
    let first = end.saturating_sub(LOOKED_FOR);
    let bits = used_from(first, used);
    let unused = (first..end).rev().find(|position| bits >> position.wrapping_sub(first) & 1 == 0);
    (unused.map(Symbol), unused.unwrap_or(first))
}

impl LanguageMut<'_> {
    /// Adds one session to the training data, as [`add_session`](Self::add_session) does. If memory is full, other sessions are forgotten:
    /// call again, with the same `step`, until room is found. Words that found no room when they were heard are left out.
    /// [`tidy_vocabulary`](Self::tidy_vocabulary) and a training must follow.
    ///
    /// `session_tokens` are the machine tokens that must stay.
    ///
    /// # Errors
    /// A [`CapacityError`] if the session would not fit even alone, or none of its words was heard; nothing is forgotten then. In the second
    /// case the next step is [`Step::Take`]: room can be made for the words.
    pub(crate) fn add_session_or_make_room<'a, I: Iterator<Item = (&'a [Symbol], f32)>>(
        &mut self,
        sentence: &[Option<Symbol>],
        session_tokens: &[Symbol],
        pairs: impl Fn() -> I,
        step: &mut Step,
    ) -> Result<Room, CapacityError> {
        match step {
            Step::Choose(_) | Step::Forget(..) if FORGETS => return Ok(self.make_room(step, Step::Renew)),
            Step::Renew if FORGETS => {
                self.rebuild_wanted()?;
                *step = Step::Take;
                return Ok(Room::Sought);
            }
            _ => {}
        }
        let mut words: Vec<Symbol, WORDS_PER_COMMAND> = Vec::new();
        for &word in sentence.iter().flatten() {
            let too_long = CapacityError::new(Capacity::WordsPerCommand, WORDS_PER_COMMAND, sentence.len());
            words.push(word).map_err(|_| too_long)?;
        }
        if let Step::Look = step {
            self.check_alone(&words, sentence.len(), session_tokens, &pairs)?;
            *step = Step::Take;
            return if words.is_empty() { Err(self.read().no_room_for_a_word()) } else { Ok(Room::Sought) };
        }
        let (extent, wanted) = (self.bitext.extent(), self.tables.trained.wanted);
        let Err(error) = self.add_to_data(&words, &pairs) else { return Ok(Room::Found) };
        self.bitext.rewind(extent);
        self.tables.trained.wanted = wanted;
        let want = match error.capacity {
            Capacity::Alignments | Capacity::LengthPairs => Want::Lengths(words.len()),
            _ => Want::Session,
        };
        *step = Step::Choose(Choice::among(self.bitext.sessions(), want, error.capacity).ok_or(error)?);
        Ok(Room::Sought)
    }

    fn add_to_data<'a, I: Iterator<Item = (&'a [Symbol], f32)>>(
        &mut self,
        words: &[Symbol],
        pairs: impl Fn() -> I,
    ) -> Result<(), CapacityError> {
        match self.model() {
            Model::Model2 => ibm2::data::add(&mut self.tables, &mut self.bitext, words, pairs),
            Model::Roles => roles::data::add(&mut self.bitext, words, pairs),
        }
    }

    /// Checks that the session would fit if there were no other: with the words that were heard or, if there are none, with all.
    fn check_alone<'a, I: Iterator<Item = (&'a [Symbol], f32)>>(
        &self,
        words: &[Symbol],
        said: usize,
        tokens: &[Symbol],
        pairs: &impl Fn() -> I,
    ) -> Result<(), CapacityError> {
        let rooms = self.read().rooms();
        let missing = if words.is_empty() { *self.unheard } else { Unheard::NONE };
        let sentence = if words.is_empty() { said } else { words.len() };
        let (words, word_bytes) = self.vocabulary_alone(|word| words.contains(&word), missing);
        let tokens = self.tokens.read().iter().filter(|(symbol, _)| tokens.contains(symbol)).count();
        let alone = Alone { words, tokens, sentence };
        let needs = match self.model() {
            Model::Model2 => ibm2::data::needs_alone(&alone, &rooms, pairs),
            Model::Roles => roles::data::needs_alone(&alone, &rooms, pairs),
        };
        let translations = tokens.saturating_add(1).saturating_mul(words);
        Capacities { words, word_bytes, sessions: 1, sentence_words: sentence, translations, ..needs }.fits_in(&rooms)
    }

    /// The number of words, and of their bytes, in a vocabulary of these words alone.
    fn vocabulary_alone(&self, has: impl Fn(Symbol) -> bool, unheard: Unheard) -> (usize, usize) {
        let known = self.words.read().iter().filter(|&(symbol, _)| has(symbol));
        known.fold((unheard.words.into(), unheard.bytes.into()), |(count, bytes): (usize, usize), (_, text)| {
            (count.saturating_add(1), bytes.saturating_add(text.len()))
        })
    }

    /// The words that were not heard, if there would be room for them beside those that were; otherwise none.
    fn with_room_alone(&self, sentence: &[Option<Symbol>]) -> Unheard {
        let unheard = *self.unheard;
        let (words, bytes) = self.vocabulary_alone(|word| sentence.contains(&Some(word)), unheard);
        let rooms = self.read().rooms();
        if words <= rooms.words && bytes <= rooms.word_bytes { unheard } else { Unheard::NONE }
    }

    /// After a session was added, checks that the vocabulary fits the tables with an eighth free, and room for the words that were not heard.
    /// Otherwise it forgets other sessions; without any word heard, no session was added, and each is another. Call again, with the same
    /// `step`, until room is found. Symbols may change; those in `sentence` and `session_tokens` change too. A
    /// training must follow.
    ///
    /// # Errors
    /// A [`CapacityError`] as of [`add_session_or_make_room`](Self::add_session_or_make_room).
    pub(crate) fn tidy_vocabulary(
        &mut self,
        sentence: &mut [Option<Symbol>],
        session_tokens: &mut [Symbol],
        step: &mut Step,
    ) -> Result<Room, CapacityError> {
        match step {
            Step::Choose(_) | Step::Forget(..) if FORGETS => return Ok(self.make_room(step, Step::Look)),
            Step::Take => {
                self.data_replaced()?;
                return Ok(Room::Found);
            }
            Step::Measure => {
                let full = self.full_of_vocabulary(self.with_room_alone(sentence));
                *step = full.map_or(Step::Take, |full| Step::ForgetTokens(self.tokens.len() as u16, false, full));
            }
            Step::ForgetTokens(0, true, _) => *step = Step::Measure,
            Step::ForgetTokens(0, false, full) => {
                let newest = usize::from(sentence.iter().any(Option::is_some));
                let choice = Choice::among(self.bitext.sessions().saturating_sub(newest), Want::Vocabulary, *full);
                *step = choice.map_or(Step::Take, Step::Choose);
            }
            Step::ForgetTokens(end, any, _) => *any |= self.remove_unused_tokens(session_tokens, end),
            Step::ForgetWords(0) => *step = Step::Measure,
            Step::ForgetWords(end) => self.remove_unused_words(sentence, end),
            _ => *step = Step::ForgetWords(self.words.len() as u16),
        }
        Ok(Room::Sought)
    }

    /// Forgets the words and machine tokens that no session uses any more. Training begins.
    pub(crate) fn forget_unused(&mut self) {
        self.forget_unlearned();
        let (mut words, mut tokens) = (self.words.len() as u16, self.tokens.len() as u16);
        while words > 0 {
            self.remove_unused_words(&mut [], &mut words);
        }
        while tokens > 0 {
            let _ = self.remove_unused_tokens(&mut [], &mut tokens);
        }
        // The vocabulary only shrank, so it fits.
        let _ = self.data_replaced();
        self.begin_training();
    }

    /// The table of words, machine tokens or their parameters that has too little free space, if there is one.
    fn full_of_vocabulary(&self, unheard: Unheard) -> Option<Capacity> {
        let Capacities { words, word_bytes, tokens, token_bytes, .. } = self.read().rooms();
        let is_full = |used: usize, room: usize, least: usize| room.saturating_sub(used) < (room / FREE_PART).max(least);
        if is_full(self.words.len(), words, unheard.words.into()) {
            Some(Capacity::Words)
        } else if is_full(self.words.read().byte_len(), word_bytes, unheard.bytes.into()) {
            Some(Capacity::WordBytes)
        } else if is_full(self.tokens.len(), tokens, 0) {
            Some(Capacity::Tokens)
        } else if is_full(self.tokens.read().byte_len(), token_bytes, 0) {
            Some(Capacity::TokenBytes)
        } else {
            self.parameters_fit().err().map(|error| error.capacity)
        }
    }

    /// Looks at one more session, or forgets a part of the chosen one. Once it is forgotten, `next` is the next step.
    fn make_room(&mut self, step: &mut Step, next: Step) -> Room {
        match step {
            Step::Forget(session, full) => {
                if !self.bitext.remove_on() {
                    return Room::Sought;
                }
                let room = Room::Made(*session, *full);
                *step = next;
                return room;
            }
            Step::Choose(choice) => {
                if let Some(session) = self.choose_on(choice) {
                    self.begin_removal(session);
                    *step = Step::Forget(session, choice.full);
                }
            }
            _ => {}
        }
        Room::Sought
    }

    /// Looks at one more session. Returns the chosen one after the last.
    fn choose_on(&self, choice: &mut Choice) -> Option<u16> {
        if choice.looked < choice.among {
            let (session, data) = (choice.looked, self.bitext.read());
            // Going through all sessions for each word takes most of the work, so it is done once for both.
            let rarest = if choice.want == Want::Session { self.rarest(session) } else { WELL_KNOWN };
            let has_own = || if choice.want == Want::Session { rarest <= 1 } else { self.has_own_word(session) };
            let is_strange = !data.heard_again(session) && has_own();
            choice.looked = session.saturating_add(1);
            if is_strange {
                choice.strange = choice.strange.saturating_add(1);
                choice.oldest_strange = choice.oldest_strange.or(Some(session));
            }
            let rank = self.rank(session, choice.want, is_strange, rarest);
            if choice.best.is_none_or(|(_, best)| rank > best) {
                choice.best = Some((session, rank));
            }
            return None;
        }
        let too_many = STRANGE.max(usize::from(choice.among) / STRANGE_PART);
        let strange = choice.oldest_strange.filter(|_| choice.want == Want::Session && usize::from(choice.strange) > too_many);
        Some(strange.or(choice.best.map(|(session, _)| session)).unwrap_or(0))
    }

    /// The rank of a session: how little is lost with it.
    fn rank(&self, session: u16, want: Want, is_strange: bool, rarest: usize) -> Rank {
        let data = self.bitext.read();
        let length = |session| data.sentence(session).len();
        let short = |count: usize| u16::try_from(count).unwrap_or(u16::MAX);
        match want {
            Want::Lengths(new) if length(session) != new && is_strange => [3, 0, 0],
            Want::Lengths(new) if length(session) != new => {
                let as_long = (0..data.sessions() as u16).filter(|&other| length(other) == length(session)).count();
                [2, u16::MAX.saturating_sub(short(as_long)), 0]
            }
            Want::Vocabulary if is_strange => [3, 0, 0],
            // One that is not strange has a word of its own only if it was heard again.
            Want::Vocabulary => [2, short(if data.heard_again(session) { self.own_words(session) } else { 0 }), 0],
            Want::Lengths(_) | Want::Session => {
                let times = self.times_kept(session);
                [u16::from(times > 1), short(times.saturating_add(rarest)), short(data.pairs_of(session).len())]
            }
        }
    }

    /// Whether the session has a word that no other session has.
    fn has_own_word(&self, session: u16) -> bool {
        self.bitext.read().sentence(session).iter().any(|&word| self.sessions_with(word, 2) <= 1)
    }

    /// The number of sessions with the same command, itself included.
    fn times_kept(&self, session: u16) -> usize {
        let data = self.bitext.read();
        let sentence = data.sentence(session);
        (0..data.sessions() as u16).filter(|&other| data.sentence(other) == sentence).count()
    }

    /// The number of sessions that have a word, counted up to `most`: for a well-known word few sessions are visited.
    fn sessions_with(&self, word: Symbol, most: usize) -> usize {
        let data = self.bitext.read();
        (0..data.sessions() as u16).filter(|&session| data.sentence(session).contains(&word)).take(most).count()
    }

    /// The number of words of a session that no other session has.
    fn own_words(&self, session: u16) -> usize {
        self.bitext.read().sentence(session).iter().filter(|&&word| self.sessions_with(word, 2) <= 1).count()
    }

    /// The number of sessions that have the session's rarest word, itself included; [`WELL_KNOWN`] for a well-known word.
    fn rarest(&self, session: u16) -> usize {
        self.bitext.read().sentence(session).iter().map(|&word| self.sessions_with(word, WELL_KNOWN)).min().unwrap_or(WELL_KNOWN)
    }

    /// Forgets the last word before `end` that no session has, and moves `end` before it.
    fn remove_unused_words(&mut self, sentence: &mut [Option<Symbol>], end: &mut u16) {
        let unused;
        (unused, *end) = last_unused(*end, self.bitext.words_mut().iter());
        if let Some(word) = unused {
            self.words.remove(word);
            self.bitext.words_mut().iter_mut().for_each(|other| close_up(other, word));
            for heard in sentence.iter_mut() {
                *heard = heard.filter(|&heard| heard != word);
                heard.iter_mut().for_each(|other| close_up(other, word));
            }
        }
    }

    /// Forgets the last machine token before `end` that neither a machine command nor the new session uses, and moves `end` before it.
    /// Returns whether there was any.
    fn remove_unused_tokens(&mut self, session_tokens: &mut [Symbol], end: &mut u16) -> bool {
        let unused;
        (unused, *end) = last_unused(*end, self.bitext.tokens_mut().iter().chain(&*session_tokens));
        if let Some(token) = unused {
            self.remove_token(token, session_tokens);
        }
        unused.is_some()
    }

    /// Forgets a machine token that nothing uses. The later ones move up.
    fn remove_token(&mut self, token: Symbol, session_tokens: &mut [Symbol]) {
        #[cfg(feature = "layer")]
        self.layer.remove_token(token);
        self.tokens.remove(token);
        self.bitext.tokens_mut().iter_mut().chain(session_tokens).for_each(|other| close_up(other, token));
    }
}
