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
//!   command is heard whole; if more words, or more facts about objects, come at once, the rest are left out.
//!
//! The newest session is never forgotten. A session that would not fit even alone is refused, and nothing is forgotten for it.

use super::bitext::{Alone, close_up};
use super::model::LanguageMut;
use super::settings::Model;
use super::{ibm2, roles};
use crate::capacity::{Capacities, Capacity, CapacityError, WORDS_PER_COMMAND};
use crate::symbols::{Symbol, SymbolsRef};
use heapless::Vec;

/// Whether sessions may be forgotten. If not, the code that chooses one is not linked.
const FORGETS: bool = cfg!(feature = "forgetting");

/// The inverse of the share of the vocabulary that is kept free.
const FREE_PART: usize = 8;

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
    /// Check whether the vocabulary has room.
    Measure,
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

impl LanguageMut<'_> {
    /// Adds one session to the training data, as [`add_session`](Self::add_session) does. If memory is full, other sessions are forgotten:
    /// call again, with the same `step`, until room is found. Words that found no room when they were heard are left out.
    /// [`tidy_vocabulary`](Self::tidy_vocabulary) and a training must follow.
    ///
    /// `session_tokens` are the machine tokens that must stay.
    ///
    /// # Errors
    /// A [`CapacityError`] if the session would not fit even alone; nothing is forgotten then.
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
            self.check_alone(&words, session_tokens, pairs())?;
            *step = Step::Take;
            return Ok(Room::Sought);
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

    /// Checks that the session would fit if there were no other.
    fn check_alone<'a>(
        &self,
        words: &[Symbol],
        tokens: &[Symbol],
        pairs: impl Iterator<Item = (&'a [Symbol], f32)>,
    ) -> Result<(), CapacityError> {
        if words.is_empty() {
            return Err(self.read().no_room_for_a_word());
        }
        let different = |table: SymbolsRef<'_>, used: &[Symbol]| table.iter().filter(|(symbol, _)| used.contains(symbol)).count();
        let (words, tokens, sentence) = (different(self.words.read(), words), different(self.tokens.read(), tokens), words.len());
        let alone = Alone { words, tokens, sentence };
        let needs = match self.model() {
            Model::Model2 => ibm2::data::needs_alone(&alone, pairs),
            Model::Roles => roles::data::needs_alone(&alone, pairs),
        };
        let translations = tokens.saturating_add(1).saturating_mul(words);
        Capacities { sessions: 1, sentence_words: sentence, translations, ..needs }.fits_in(&self.read().rooms())
    }

    /// After a session was added, checks that the vocabulary fits the tables with an eighth free, and otherwise forgets other sessions:
    /// call again, with the same `step`, until room is found. Symbols may change; those in `sentence` and `session_tokens` change too. A
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
            Step::Measure => {}
            _ => {
                self.remove_unused_words(sentence);
                *step = Step::Measure;
                return Ok(Room::Sought);
            }
        }
        let mut full = self.full_of_vocabulary();
        if full.is_some() {
            self.remove_unused_tokens(session_tokens);
            full = self.full_of_vocabulary();
        }
        let choice = full.and_then(|full| Choice::among(self.bitext.sessions().saturating_sub(1), Want::Vocabulary, full));
        *step = choice.map_or(Step::Take, Step::Choose);
        Ok(Room::Sought)
    }

    /// Forgets the words and machine tokens that no session uses any more. Training begins.
    pub(crate) fn forget_unused(&mut self) {
        self.forget_unlearned();
        self.remove_unused_words(&mut []);
        self.remove_unused_tokens(&mut []);
        // The vocabulary only shrank, so it fits.
        let _ = self.data_replaced();
        self.begin_training();
    }

    /// The table of words, machine tokens or their parameters that has too little free space, if there is one.
    fn full_of_vocabulary(&self) -> Option<Capacity> {
        let Capacities { words, word_bytes, tokens, token_bytes, .. } = self.read().rooms();
        let is_full = |used: usize, room: usize| room.saturating_sub(used) < room / FREE_PART;
        if is_full(self.words.len(), words) {
            Some(Capacity::Words)
        } else if is_full(self.words.read().byte_len(), word_bytes) {
            Some(Capacity::WordBytes)
        } else if is_full(self.tokens.len(), tokens) {
            Some(Capacity::Tokens)
        } else if is_full(self.tokens.read().byte_len(), token_bytes) {
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
            let (session, is_strange) = (choice.looked, self.is_strange(choice.looked));
            choice.looked = session.saturating_add(1);
            if is_strange {
                choice.strange = choice.strange.saturating_add(1);
                choice.oldest_strange = choice.oldest_strange.or(Some(session));
            }
            let rank = self.rank(session, choice.want, is_strange);
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
    fn rank(&self, session: u16, want: Want, is_strange: bool) -> Rank {
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
            Want::Vocabulary => [2, short(self.own_words(session)), 0],
            Want::Lengths(_) | Want::Session => {
                let times = self.times_kept(session);
                [u16::from(times > 1), short(times.saturating_add(self.rarest(session))), short(data.pairs_of(session).len())]
            }
        }
    }

    /// Whether the command was heard once and has a word that no other session has.
    fn is_strange(&self, session: u16) -> bool {
        let data = self.bitext.read();
        !data.heard_again(session) && data.sentence(session).iter().any(|&word| self.sessions_with(word, 2) <= 1)
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

    /// Forgets the words that no session has.
    fn remove_unused_words(&mut self, sentence: &mut [Option<Symbol>]) {
        for position in (0..self.words.len() as u16).rev() {
            let word = Symbol(position);
            if self.bitext.words_mut().contains(&word) {
                continue;
            }
            self.words.remove(word);
            self.bitext.words_mut().iter_mut().for_each(|other| close_up(other, word));
            for heard in sentence.iter_mut() {
                *heard = heard.filter(|&heard| heard != word);
                heard.iter_mut().for_each(|other| close_up(other, word));
            }
        }
    }

    /// Forgets the machine tokens that neither a machine command nor the new session uses.
    fn remove_unused_tokens(&mut self, session_tokens: &mut [Symbol]) {
        for position in (0..self.tokens.len() as u16).rev() {
            let token = Symbol(position);
            if self.bitext.tokens_mut().contains(&token) || session_tokens.contains(&token) {
                continue;
            }
            #[cfg(feature = "layer")]
            if let Some(layer) = &mut self.layer.room {
                layer.remove_token(token);
            }
            self.tokens.remove(token);
            self.bitext.tokens_mut().iter_mut().chain(&mut *session_tokens).for_each(|other| close_up(other, token));
        }
    }
}
