//! What gives way when memory is full, so that learning goes on (feature `forgetting`; without it a session without room is refused). Of two
//! sessions that are equal by a rule, the older one goes.
//!
//! When a session gives way, another one of the same English command, if there is one, remembers that the command was heard before. A
//! session is *strange* when its command was heard once in the robot's life, as far as is remembered, and has a word that no other session
//! has: a slip of the tongue, or something new.
//!
//! - Where a new session finds no room among the others, the oldest strange one goes, if more than two and more than an eighth of the
//!   sessions are strange. Otherwise one goes whose command others have too, if there is one: the one that is repeated most, by how often
//!   its command is kept and in how many sessions its rarest word stands (three count as many); of these the one that taught least, for it
//!   goes with the most machine commands.
//! - Where the alignment tables are full, the new session's machine commands of less than a tenth that need a table of their own are left
//!   out. Where those of more find no room, the oldest strange session of another length goes, then one whose command has the rarest
//!   length.
//! - Where the vocabulary is full, rare words go first: the oldest strange session goes, then the one that has the most words that no
//!   other has. Words and machine tokens that nothing has any more go with it. An eighth of the vocabulary is kept free, so that the next
//!   command is heard whole; words, and what is known of objects, are left out where there are more at once.
//!
//! The newest session never goes. One that could not be kept even alone is refused, and nothing is forgotten for it.

use super::bitext::Removal;
use super::model::LanguageMut;
use super::settings::Model;
use super::{ibm2, roles};
use crate::capacity::{Capacities, Capacity, CapacityError, WORDS_PER_COMMAND};
use crate::symbols::{Symbol, SymbolsRef};
use crate::task::role::is_marker;
use heapless::Vec;

/// The part of the vocabulary that is kept free: one in so many.
const FREE_PART: usize = 8;

/// The least room for so many entries where an eighth of it is kept free.
pub(crate) const fn with_free_part(entries: usize) -> usize {
    entries.saturating_add(entries.saturating_sub(1) / (FREE_PART - 1))
}

/// The part of the sessions that may be strange: one in so many, or two.
const STRANGE_PART: usize = 8;
const STRANGE: usize = 2;

/// A word that stands in so many sessions is well known.
const WELL_KNOWN: usize = 3;

/// Machine commands of a smaller weight are left out where the alignment tables have no room for their lengths.
pub(super) const LIGHT: f32 = 0.1;

/// The least of a session's weight that must be kept.
pub(super) const LEAST_KEPT: f32 = 0.5;

/// How far room is made for a session.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Making {
    /// The session is added where it has room.
    Add,
    /// Another session is chosen to give way.
    Choose(Choice),
    /// The chosen one goes, for the sake of this.
    Remove(Removal, Want),
    /// Words that no session has are looked for below this one.
    Words(u16),
    /// Whether the vocabulary is full, now that they are gone.
    Vocabulary,
    /// Machine tokens that nothing has are looked for below this one.
    Tokens(u16),
    /// Whether the vocabulary is still full.
    StillFull,
    /// There is room for everything.
    Done,
}

impl Making {
    /// Whether the training data are between two states.
    pub(crate) const fn is_removing(self) -> bool {
        matches!(self, Self::Remove(..))
    }
}

/// A session that gives way, and the table that was full.
pub(crate) type Gone = Option<(u16, Capacity)>;

/// The choice of a session to give way, from one part to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Choice {
    want: Want,
    full: Capacity,
    /// One of the first so many.
    among: u16,
    /// The session that is looked at next.
    next: u16,
    /// The first strange one, and how many there are so far.
    strange: Option<u16>,
    strange_ones: u16,
    best: Option<(u16, Rank)>,
}

impl Choice {
    const fn new(want: Want, full: Capacity, among: usize) -> Self {
        Self { want, full, among: among as u16, next: 0, strange: None, strange_ones: 0, best: None }
    }

    /// The session that gives way, once it is known.
    fn chosen(&self) -> Option<u16> {
        let most = match self.want {
            Want::Session => STRANGE.max(usize::from(self.among) / STRANGE_PART),
            Want::Lengths(_) | Want::Vocabulary => 0,
        };
        let best = self.best.filter(|_| self.next >= self.among).map(|(session, _)| session);
        self.strange.filter(|_| usize::from(self.strange_ones) > most).or(best)
    }
}

/// How little is lost with a session: the highest goes.
type Rank = [u16; 4];

/// A session by itself.
pub(crate) struct Alone {
    /// Its different words.
    pub words: usize,
    /// Its different machine tokens.
    pub tokens: usize,
    /// The words of its command, each as often as it is said.
    pub sentence: usize,
}

/// Why a session has to give way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Want {
    /// Room for one more session.
    Session,
    /// Room for the alignment tables of a command of so many words.
    Lengths(u8),
    /// Room for words and machine tokens.
    Vocabulary,
}

impl LanguageMut<'_> {
    /// Adds one session to the training data, as [`add_session`](Self::add_session) does, or where memory is full begins to choose one that
    /// gives way: go on by [`make_room_on`](Self::make_room_on). Words that found no room when they were heard are left out.
    ///
    /// `session_tokens` are the machine tokens that must stay.
    ///
    /// # Errors
    /// A [`CapacityError`] where the session could not be kept even alone; nothing is forgotten then.
    pub(crate) fn add_or_choose<'a, I: Iterator<Item = (&'a [Symbol], f32)>>(
        &mut self,
        sentence: &[Option<Symbol>],
        session_tokens: &[Symbol],
        pairs: impl Fn() -> I,
    ) -> Result<Making, CapacityError> {
        let mut words: Vec<Symbol, WORDS_PER_COMMAND> = Vec::new();
        for &word in sentence.iter().flatten() {
            let too_long = CapacityError::new(Capacity::WordsPerCommand, WORDS_PER_COMMAND, sentence.len());
            words.push(word).map_err(|_| too_long)?;
        }
        self.check_alone(&words, session_tokens, pairs())?;
        let (extent, wanted) = (self.bitext.extent(), self.tables.trained.wanted);
        let Err(error) = self.add_to_data(&words, &pairs) else { return Ok(self.tidied()) };
        self.bitext.rewind(extent);
        self.tables.trained.wanted = wanted;
        let want = match error.capacity {
            Capacity::Alignments | Capacity::LengthPairs => Want::Lengths(words.len() as u8),
            _ => Want::Session,
        };
        let others = if cfg!(feature = "forgetting") { self.bitext.sessions() } else { 0 };
        if others == 0 { Err(error) } else { Ok(Making::Choose(Choice::new(want, error.capacity, others))) }
    }

    /// Begins to make sure that the vocabulary fits the tables and has an eighth free, as it must when a session was added.
    pub(crate) const fn tidied(&self) -> Making {
        Making::Words(self.words.len() as u16)
    }

    /// Goes on making room: says what is next, and which session gives way, where one was chosen now. Symbols may change: those of the
    /// session, in `sentence` and `session_tokens`, are renamed with the rest. A training must follow when all is done.
    ///
    /// # Errors
    /// A [`CapacityError`] that [`add_or_choose`](Self::add_or_choose) would have given.
    pub(crate) fn make_room_on(
        &mut self,
        making: Making,
        sentence: &mut [Option<Symbol>],
        session_tokens: &mut [Symbol],
    ) -> Result<(Making, Gone), CapacityError> {
        let mut gone = None;
        let next = match making {
            Making::Add | Making::Done => making,
            Making::Choose(mut choice) => {
                self.choose_on(&mut choice);
                match choice.chosen() {
                    Some(session) => {
                        gone = Some((session, choice.full));
                        Making::Remove(Removal::Session(session), choice.want)
                    }
                    None => Making::Choose(choice),
                }
            }
            Making::Remove(Removal::Done, Want::Vocabulary) => self.tidied(),
            Making::Remove(Removal::Done, _) => {
                self.rebuild_wanted()?;
                Making::Add
            }
            Making::Remove(removal, want) => Making::Remove(self.remove_on(removal), want),
            Making::Words(0) => Making::Vocabulary,
            Making::Words(after) => {
                let word = Symbol(after.saturating_sub(1));
                self.remove_unused_word(word, sentence);
                Making::Words(word.0)
            }
            Making::Vocabulary if self.full_of_vocabulary().is_some() => Making::Tokens(self.tokens.len() as u16),
            Making::Vocabulary => self.found()?,
            Making::Tokens(0) => Making::StillFull,
            Making::Tokens(after) => {
                let token = Symbol(after.saturating_sub(1));
                self.remove_unused_token(token, session_tokens);
                Making::Tokens(token.0)
            }
            Making::StillFull => {
                let others = if cfg!(feature = "forgetting") { self.bitext.sessions().saturating_sub(1) } else { 0 };
                match self.full_of_vocabulary().filter(|_| others > 0) {
                    Some(full) => Making::Choose(Choice::new(Want::Vocabulary, full, others)),
                    None => self.found()?,
                }
            }
        };
        Ok((next, gone))
    }

    fn found(&mut self) -> Result<Making, CapacityError> {
        self.data_replaced()?;
        Ok(Making::Done)
    }

    fn add_to_data<'a, I: Iterator<Item = (&'a [Symbol], f32)>>(
        &mut self,
        words: &[Symbol],
        pairs: impl Fn() -> I,
    ) -> Result<(), CapacityError> {
        match self.model() {
            Model::Model2 => ibm2::data::add(self, words, pairs),
            Model::Roles => roles::data::add(self, words, pairs),
        }
    }

    /// Whether a session could be kept if there were no other.
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

    /// Takes a session out of the training data, with the words and machine tokens that no other has. Training begins.
    pub(crate) fn unlearn(&mut self, session: u16) {
        self.forget_unlearned();
        let mut removal = Removal::Session(session);
        while removal != Removal::Done {
            removal = self.remove_on(removal);
        }
        for word in (0..self.words.len() as u16).rev() {
            self.remove_unused_word(Symbol(word), &mut []);
        }
        for token in (0..self.tokens.len() as u16).rev() {
            self.remove_unused_token(Symbol(token), &mut []);
        }
        // It is less than before, so it fits.
        let _ = self.data_replaced();
        self.begin_training();
    }

    /// The table of words, machine tokens or their parameters that has too little room, if there is one.
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

    /// Looks at one more session that may give way.
    fn choose_on(&self, choice: &mut Choice) {
        let session = choice.next;
        choice.next = session.saturating_add(1);
        let data = self.bitext.read();
        let is_other = match choice.want {
            Want::Lengths(new) => data.sentence(session).len() != usize::from(new),
            _ => true,
        };
        let rarest = self.rarest(session);
        // Its command was heard once, and has a word that no other session has.
        if is_other && rarest <= 1 && !data.heard_again(session) {
            choice.strange = choice.strange.or(Some(session));
            choice.strange_ones = choice.strange_ones.saturating_add(1);
            if choice.chosen().is_some() {
                return;
            }
        }
        let rank = match choice.want {
            Want::Lengths(_) if is_other => {
                let length = data.sentence(session).len();
                let as_long = (0..choice.among).filter(|&other| data.sentence(other).len() == length).count();
                [1, u16::MAX.saturating_sub(as_long as u16), 0, 0]
            }
            Want::Vocabulary => [1, self.own_words(session) as u16, 0, 0],
            Want::Lengths(_) | Want::Session => self.repeated(session, rarest),
        };
        // Of equals the oldest goes.
        if choice.best.is_none_or(|(_, best)| rank > best) {
            choice.best = Some((session, rank));
        }
    }

    /// How little is lost with a session.
    fn repeated(&self, session: u16, rarest: usize) -> Rank {
        let times = self.times_kept(session);
        let pairs = self.bitext.read().pairs_of(session).len();
        [0, u16::from(times > 1), times.saturating_add(rarest) as u16, pairs.min(usize::from(u16::MAX)) as u16]
    }

    /// How many sessions have the same command, itself included.
    fn times_kept(&self, session: u16) -> usize {
        let data = self.bitext.read();
        let sentence = data.sentence(session);
        (0..data.sessions() as u16).filter(|&other| data.sentence(other) == sentence).count()
    }

    /// In how many sessions a word stands, counted up to `most`: few are gone through for a word that is well known.
    fn sessions_with(&self, word: Symbol, most: usize) -> usize {
        let data = self.bitext.read();
        (0..data.sessions() as u16).filter(|&session| data.sentence(session).contains(&word)).take(most).count()
    }

    /// How many words of a session no other session has.
    fn own_words(&self, session: u16) -> usize {
        self.bitext.read().sentence(session).iter().filter(|&&word| self.sessions_with(word, 2) <= 1).count()
    }

    /// In how many sessions the rarest word of a session stands, itself included; a well-known one stands in [`WELL_KNOWN`].
    fn rarest(&self, session: u16) -> usize {
        let words = self.bitext.read().sentence(session);
        // No more sessions need be gone through than have a word that is rarer.
        words.iter().fold(WELL_KNOWN, |least, &word| if least > 1 { self.sessions_with(word, least) } else { least })
    }

    /// Forgets a word if no session has it.
    fn remove_unused_word(&mut self, word: Symbol, sentence: &mut [Option<Symbol>]) {
        if self.bitext.words_mut().contains(&word) {
            return;
        }
        self.words.remove(word);
        self.bitext.words_mut().iter_mut().for_each(|other| close_up(other, word));
        for heard in sentence {
            *heard = heard.filter(|&heard| heard != word);
            heard.iter_mut().for_each(|other| close_up(other, word));
        }
    }

    /// Forgets a machine token if neither a machine command nor the session has it.
    fn remove_unused_token(&mut self, token: Symbol, session_tokens: &mut [Symbol]) {
        if self.bitext.tokens_mut().contains(&token) || session_tokens.contains(&token) {
            return;
        }
        #[cfg(feature = "layer")]
        if let Some(layer) = &mut self.layer.room {
            layer.remove_token(token);
        }
        self.tokens.remove(token);
        self.bitext.tokens_mut().iter_mut().chain(session_tokens).for_each(|other| close_up(other, token));
    }
}

/// Moves a symbol up where one before it was removed.
pub(super) fn close_up(symbol: &mut Symbol, removed: Symbol) {
    if *symbol > removed && !is_marker(*symbol) {
        symbol.0 = symbol.0.saturating_sub(1);
    }
}
