//! The posteriors of a role model that has not seen the session.

use crate::{Layered, tasks_of};
use goodbot::capacity::WORDS_PER_COMMAND;
use goodbot::language::BitextRef;
use goodbot::language::layer::View;
use goodbot::language::roles::whole::said_before;
use goodbot::language::roles::{forward, kind};
use goodbot::probability::{Scaled, total};
use goodbot::symbols::Symbol;
use goodbot::task::description::form;
use heapless::Vec;

impl Layered {
    /// Finds out which of `words` words the trained role model has heard: `bitext` leaves out the others' sessions. Returns about the number
    /// of cells visited.
    pub fn hear(&mut self, words: usize, bitext: BitextRef<'_>) -> usize {
        self.heard.clear();
        self.heard.resize(words, false);
        for session in (0..bitext.sessions() as u16).filter(|&session| !bitext.leaves_out(session)) {
            for word in bitext.sentence(session) {
                if let Some(slot) = self.heard.get_mut(word.index()) {
                    *slot = true;
                }
            }
        }
        words
    }

    /// Stores the posterior over a session's tasks by a role model trained without it, and the posterior that the session showed. `bitext`
    /// leaves out the session and the others of its half. Returns the approximate number of table cells visited.
    #[inline(never)]
    pub fn understand(&mut self, View { tables, bitext, possible }: View<'_>, session: u16) -> usize {
        let (pairs, shown) = (possible.pairs_of(session), bitext.pairs_of(session));
        if tasks_of(possible, session) == 0 {
            return 1;
        }
        let is_heard = |word: Symbol| self.heard.get(word.index()).copied().unwrap_or(false);
        let mut sentence: Vec<Option<Symbol>, WORDS_PER_COMMAND> = Vec::new();
        for &word in bitext.sentence(session) {
            let _ = sentence.push(Some(word).filter(|&word| is_heard(word)));
        }
        let description = |task: usize| pairs.get(task).map_or(&[][..], |pair| possible.command(pair.command));
        let prior = |task: usize| pairs.get(task).map_or(0.0, |pair| pair.weight);
        let (layout, mut cells) = (tables.layout(), 1_usize);
        let weights = &mut *vec![Scaled::ZERO; pairs.len()];
        for (task, weight) in weights.iter_mut().enumerate() {
            let likelihood = forward::likelihood(layout, tables.cells(), &sentence, description(task), |_, _| {});
            *weight = likelihood.scaled_by(said_before(bitext, &sentence, description(task))).scaled_by(prior(task));
            cells = cells.saturating_add(description(task).len().saturating_mul(sentence.len()).saturating_mul(4));
        }
        kind::weigh(tables, &sentence, |task| form(description(task)).unwrap_or(Symbol::new(0)), weights);
        kind::dilute(tables, &sentence, prior, weights);
        if weights.iter().all(|weight| weight.is_zero()) {
            weights.iter_mut().enumerate().for_each(|(task, weight)| *weight = Scaled::new(prior(task)));
        }
        let whole = total(weights.iter().copied());
        let first = possible.pairs().partition_point(|pair| pair.session < session);
        for (task, weight) in weights.iter().enumerate() {
            let share = shown.iter().filter(|pair| bitext.command(pair.command) == description(task)).map(|pair| pair.weight).sum();
            let at = first.saturating_add(task);
            if let (Some(understood), Some(shown)) = (self.understood.get_mut(at), self.shares.get_mut(at)) {
                (*understood, *shown) = (weight.over(whole), share);
            }
        }
        cells
    }
}
