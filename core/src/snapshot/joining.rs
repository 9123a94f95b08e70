//! Joining the training data of two robots.

use super::contents::Contents;
use super::error::RestoreError;
#[cfg(feature = "layer")]
use super::possible::Possible;
use super::record::{CommandRecord, PairRecord, SessionRecord, marker};
use super::section::Index;
use super::starter::is_beside;
use crate::capacity::{CapacityError, TOKENS_PER_COMMAND, WORDS_PER_COMMAND};
use crate::language::{LanguageMut, LanguageRef, Model, Pair};
use crate::memory::AgentMemory;
use crate::session::Agent;
use crate::symbols::{Symbol, listed};
use crate::task::constraint::sort;
use crate::task::role::is_marker;
use heapless::Vec;

impl<M: AgentMemory> Agent<M> {
    /// Adds the sessions of a model file to those learned here, matching words and machine tokens by their text, and begins training: call
    /// [`learn`](Self::learn) until it is done. A session with the same words, machine commands and weights, to the last bit, comes from a
    /// common past and is not added again; repetitions are matched one by one. The options and the belief about the trainer stay unchanged.
    /// A session under way ends unlearned. Returns the number of added sessions.
    ///
    /// # Errors
    /// [`RestoreError`]; the training data are then unchanged.
    pub fn join(&mut self, bytes: &[u8]) -> Result<usize, RestoreError> {
        self.join_beside(bytes, 0)
    }

    /// Adds the sessions of a model file as [`join`](Self::join) does, but only those to learn from beside this many own sessions:
    /// [`is_beside`] chooses them. So a robot begins with a model of everyday sentences.
    ///
    /// # Errors
    /// As [`join`](Self::join).
    pub fn join_beside(&mut self, bytes: &[u8], own: usize) -> Result<usize, RestoreError> {
        let contents = Contents::read(bytes)?;
        if !self.takes(contents.vocabulary) {
            return Err(RestoreError::OtherDomain);
        }
        self.language().check_forms(&contents)?;
        self.end_session();
        self.workspace_to_training();
        Ok(self.language_mut().join_contents(&contents, own)?)
    }
}

impl LanguageRef<'_> {
    /// Whole words can be shortened to the letters that count here; shortened words cannot be restored, nor facts reordered.
    pub(super) fn check_forms(self, contents: &Contents<'_>) -> Result<(), RestoreError> {
        let (here, there) = (self.settings(), &contents.options.language);
        let letters = |letters: u8| if letters == 0 { u8::MAX } else { letters };
        if contents.sessions.is_empty()
            || (here.model == there.model && here.order == there.order && letters(here.word_letters) <= letters(there.word_letters))
        {
            Ok(())
        } else {
            Err(RestoreError::OtherForms)
        }
    }

    /// Sorts the values of each group by the symbols of this model, as this robot describes its tasks; a file has other symbols.
    pub(super) fn put_in_order(self, description: &mut [Symbol]) {
        if self.settings().model == Model::Roles {
            // The proposition comes before the groups.
            let groups = description.get_mut(1..).unwrap_or_default().split_mut(|&symbol| is_marker(symbol));
            groups.for_each(|values| sort(values, |&value| value));
        }
    }
}

impl LanguageMut<'_> {
    /// Adds the sessions to learn from beside this many own ones.
    pub(super) fn join_contents(&mut self, contents: &Contents<'_>, beside: usize) -> Result<usize, CapacityError> {
        self.forget_unlearned();
        let (words, tokens, extent) = (self.words.len(), self.tokens_mut().len(), self.bitext.extent());
        let tasks = self.possible_mut().map(|possible| possible.extent());
        let added = self.add_contents(contents, beside).and_then(|added| self.data_replaced().map(|()| added));
        if added.is_err() {
            self.bitext.rewind(extent);
            if let (Some(possible), Some(extent)) = (self.possible_mut(), tasks) {
                possible.rewind(extent);
            }
            self.words.truncate(words);
            self.tokens_mut().truncate(tokens);
            // These are the previous data, so they fit.
            let _ = self.data_replaced();
        }
        self.begin_training();
        added
    }

    fn add_contents(&mut self, contents: &Contents<'_>, beside: usize) -> Result<usize, CapacityError> {
        let texts = Texts { words: contents.words.index(), tokens: contents.tokens.index(), commands: contents.commands.index() };
        let own = self.read().bitext().sessions() as u16;
        let (mut pairs, mut heard_again, mut added) = (contents.pairs.iter(), contents.heard_again.iter(), 0_usize);
        #[cfg(feature = "layer")]
        let (mut possible, mut counts) = (Possible::of(contents), contents.possible_counts.iter());
        for (position, session) in contents.sessions.iter().enumerate() {
            let count = session.pairs as usize;
            #[cfg(feature = "layer")]
            let tasks = counts.next().unwrap_or(0) as usize;
            if !is_beside(position, contents.sessions.len(), beside) {
                #[cfg(feature = "layer")]
                possible.pass(tasks);
                let _ = (heard_again.next(), pairs.by_ref().take(count).count());
                continue;
            }
            let mut same = (0..own).filter(|&own| self.has_session(own, &session, pairs.clone().take(count), &texts)).peekable();
            let known = same.peek().is_some().then(|| times_before(contents, position, beside)).and_then(|times| same.nth(times));
            let at = match known {
                Some(known) => {
                    #[cfg(feature = "layer")]
                    possible.pass(tasks);
                    known
                }
                None => {
                    self.add_record(&session, pairs.clone().take(count), &texts)?;
                    #[cfg(feature = "layer")]
                    possible.add_next(self, tasks)?;
                    added = added.saturating_add(1);
                    self.read().bitext().sessions().saturating_sub(1) as u16
                }
            };
            if heard_again.next() == Some(true) {
                self.bitext.set_heard_again(at);
            }
            let _ = pairs.by_ref().take(count).count();
        }
        Ok(added)
    }

    /// Whether a session equals a session of a file, pair by pair.
    fn has_session(&self, own: u16, session: &SessionRecord, pairs: impl Iterator<Item = PairRecord>, texts: &Texts<'_>) -> bool {
        let (language, bitext) = (self.read(), self.read().bitext());
        let words = session.words.iter().map(|&word| language.word_like(texts.words.get(usize::from(word)).unwrap_or(""), 0));
        let mut own_pairs = bitext.pairs_of(own).iter();
        let same_command = |command: u16, own: u16| {
            let (record, own) = (texts.commands.get(usize::from(command)).unwrap_or_default(), bitext.command(own));
            if record.len() != own.len() {
                return false;
            }
            let symbol =
                |&token: &u16| marker(token).or_else(|| language.tokens().find(texts.tokens.get(usize::from(token)).unwrap_or("")));
            let mut command: Vec<Symbol, TOKENS_PER_COMMAND> = listed(record.iter().map_while(symbol));
            let mut own: Vec<Symbol, TOKENS_PER_COMMAND> = listed(own.iter().copied());
            language.put_in_order(&mut command);
            language.put_in_order(&mut own);
            command == own
        };
        let same_pair =
            |pair: &PairRecord, own: &Pair| pair.weight.to_bits() == own.weight.to_bits() && same_command(pair.command, own.command);
        bitext.sentence(own).iter().copied().map(Some).eq(words)
            && own_pairs.len() == session.pairs as usize
            && pairs.into_iter().all(|pair| own_pairs.next().is_some_and(|own| same_pair(&pair, own)))
    }

    fn add_record(
        &mut self,
        session: &SessionRecord,
        pairs: impl Iterator<Item = PairRecord>,
        texts: &Texts<'_>,
    ) -> Result<(), CapacityError> {
        let mut sentence: Vec<Symbol, WORDS_PER_COMMAND> = Vec::new();
        for &word in &session.words {
            // There are no more words than the record has, so they fit.
            let _ = sentence.push(self.take_word(texts.words.get(usize::from(word)).unwrap_or(""), 0)?);
        }
        self.bitext.add_session(&sentence)?;
        for pair in pairs {
            let command = self.symbols_here(&texts.commands.get(usize::from(pair.command)).unwrap_or_default(), texts)?;
            self.bitext.add_pair(&command, pair.weight)?;
        }
        Ok(())
    }

    /// A machine command of a file, in the symbols of this model.
    fn symbols_here(&mut self, record: &CommandRecord, texts: &Texts<'_>) -> Result<Vec<Symbol, TOKENS_PER_COMMAND>, CapacityError> {
        let mut command = Vec::new();
        for &token in record {
            let symbol = match marker(token) {
                Some(marker) => marker,
                None => self.tokens_mut().intern(texts.tokens.get(usize::from(token)).unwrap_or(""))?,
            };
            let _ = command.push(symbol);
        }
        self.read().put_in_order(&mut command);
        Ok(command)
    }
}

/// The words, machine tokens and machine commands of a file.
struct Texts<'a> {
    words: Index<'a, &'a str>,
    tokens: Index<'a, &'a str>,
    commands: Index<'a, CommandRecord>,
}

/// How often the session at `position` of a model file occurs before it, among those to learn from.
fn times_before(contents: &Contents<'_>, position: usize, beside: usize) -> usize {
    let mut sessions = contents.sessions.iter();
    let mut pairs = contents.pairs.iter();
    for session in sessions.by_ref().take(position) {
        let _ = pairs.by_ref().take(session.pairs as usize).count();
    }
    let Some(wanted) = sessions.next() else { return 0 };
    let (mut times, mut before) = (0_usize, contents.pairs.iter());
    for (earlier, session) in contents.sessions.iter().enumerate().take(position) {
        let same_pairs = || before.clone().take(session.pairs as usize).eq(pairs.clone().take(wanted.pairs as usize));
        let is_same = session.words == wanted.words && session.pairs == wanted.pairs && same_pairs();
        if is_same && is_beside(earlier, contents.sessions.len(), beside) {
            times = times.saturating_add(1);
        }
        let _ = before.by_ref().take(session.pairs as usize).count();
    }
    times
}
