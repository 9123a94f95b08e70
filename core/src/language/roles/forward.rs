//! Pr(e|t), word by word.

use super::layout::{KINDS, Layout, MOST_ROLES, cell, get};
use crate::probability::Scaled;
use crate::symbols::Symbol;
use crate::task::description::{form, groups};
use crate::task::role::{Role, RoleKind};
use heapless::Vec;

/// The most groups of a description that are read.
const MOST_GROUPS: usize = 24;
/// Before anything is learned: the probability of background, and of the end of a command.
const BACKGROUND: f32 = 0.5;
pub(super) const END: f32 = 0.1;

/// One number for each memory: none, or the role that was named last.
pub(super) type Memories = [f32; MOST_ROLES + 1];
/// One number for each role.
pub(super) type Roles = [f32; MOST_ROLES];
/// One number for each thing that a word can be: background, a word of the task, a role.
pub(super) type Moves = [f32; MOST_ROLES + 2];

/// A role that the task has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Present {
    pub role: Role,
    /// Its row, which it has if training has seen it.
    pub known: Option<usize>,
    pub kind: RoleKind,
    /// Where its probability stands in a row of p0: by its row where training has seen the lifted task, by its position otherwise.
    column: usize,
}

/// One group of values.
#[derive(Clone, Copy, Debug)]
pub(super) struct GroupShare<'d> {
    /// The role, by its position among those present.
    pub present: usize,
    pub sort: usize,
    /// What the group has of its role, spread evenly over its values.
    pub share: f32,
    pub values: &'d [Symbol],
}

/// A description, ready to explain words.
pub(super) struct Reader<'t, 'd> {
    layout: &'t Layout,
    translations: &'t [f32],
    alignments: &'t [f32],
    pub form: Option<usize>,
    form_row: &'t [f32],
    /// For each memory its row of p0, and the probability of the end; nothing where training has not seen the lifted task.
    moves: Vec<(&'t [f32], f32), { MOST_ROLES + 1 }>,
    pub present: Vec<Present, MOST_ROLES>,
    pub groups: Vec<GroupShare<'d>, MOST_GROUPS>,
    /// Where training has not seen the lifted task: what is probable before anything is learned.
    prior: Moves,
}

/// How one memory moves on.
pub(super) struct Step {
    /// (1 - end) / (the sum of all moves).
    pub scale: f32,
    /// p0 times lift: background, a word of the task, each role present.
    pub moves: Moves,
}

impl<'t, 'd> Reader<'t, 'd> {
    pub fn new(layout: &'t Layout, translations: &'t [f32], alignments: &'t [f32], description: &'d [Symbol]) -> Self {
        let form = form(description);
        let known_form = form.and_then(|token| layout.form(token));
        let form_row = known_form.and(form).map_or(get(translations, layout.row(None)), |token| get(translations, layout.row(Some(token))));
        let mut reader = Self {
            layout,
            translations,
            alignments,
            form: known_form,
            form_row,
            moves: Vec::new(),
            present: Vec::new(),
            groups: Vec::new(),
            prior: [0.0; MOST_ROLES + 2],
        };
        reader.take_groups(description);
        match known_form {
            Some(form) => {
                let ends = get(alignments, layout.end(form));
                let known = reader.present.iter().map(|present| present.known.map_or(0, |role| role.saturating_add(1)));
                for row in core::iter::once(0).chain(known) {
                    // As many as there are memories.
                    let _ = reader.moves.push((get(alignments, layout.p0(form, row)), cell(ends, row)));
                }
            }
            None => reader.prior = prior(layout, reader.present.iter().map(|present| present.kind)),
        }
        reader
    }

    fn take_groups(&mut self, description: &'d [Symbol]) {
        let mut whole: Roles = [0.0; MOST_ROLES];
        for group in groups(description) {
            let role = group.marker.role;
            let known = self.layout.role(role);
            // A role that no training has seen says nothing of a lifted task that training knows.
            if known.is_none() && self.form.is_some() {
                continue;
            }
            let present = match self.present.iter().position(|present| present.role == role) {
                Some(present) => present,
                None => {
                    let column = known.filter(|_| self.form.is_some()).unwrap_or(self.present.len()).saturating_add(2);
                    if self.present.push(Present { role, known, kind: role.kind(), column }).is_err() {
                        continue;
                    }
                    self.present.len().saturating_sub(1)
                }
            };
            let sort = usize::from(group.marker.sort);
            let lambda = known.map_or(1.0, |role| cell(get(self.alignments, self.layout.lambda(role)), sort));
            if let Some(whole) = whole.get_mut(present) {
                *whole += lambda;
            }
            let _ = self.groups.push(GroupShare { present, sort, share: lambda, values: group.values });
        }
        for group in &mut self.groups {
            let whole = cell(&whole, group.present);
            group.share = if whole > 0.0 { group.share / (whole * group.values.len() as f32) } else { 0.0 };
        }
    }

    /// The row of a memory: 0 for none, otherwise the role present at the position before.
    pub fn memory(&self, memory: usize) -> Option<usize> {
        match memory.checked_sub(1) {
            None => Some(0),
            Some(present) => self.present.get(present).and_then(|present| present.known).map(|role| role.saturating_add(1)),
        }
    }

    pub fn memories(&self) -> usize {
        self.present.len().saturating_add(1)
    }

    /// The probability of the end of the command.
    pub fn end(&self, memory: usize) -> f32 {
        self.moves.get(memory).map_or(END, |&(_, end)| end)
    }

    /// How probable a new word is for a token.
    fn novelty(&self, token: Option<Symbol>) -> f32 {
        match token.map_or(0, |token| token.index().saturating_add(1)) {
            row if row <= self.layout.tokens() => cell(self.alignments, self.layout.novelty(row)),
            _ => 1.0,
        }
    }

    /// T[v](w). A value that training has not seen has the words that are common.
    #[inline]
    pub fn value(&self, token: Symbol, word: usize) -> f32 {
        if word >= self.layout.words() {
            return self.novelty(Some(token));
        }
        if token.index() >= self.layout.tokens() {
            return cell(get(self.alignments, self.layout.common()), word);
        }
        let row = token.index().saturating_add(1).saturating_mul(self.layout.words());
        cell(self.translations, row.saturating_add(word))
    }

    /// F(w) and A[l](w).
    pub fn background_and_task(&self, word: usize) -> (f32, f32) {
        if word >= self.layout.words() {
            return (
                self.novelty(None),
                self.form.and_then(|form| self.layout.forms().get(form)).map_or(1.0, |&token| self.novelty(Some(token))),
            );
        }
        (cell(get(self.translations, self.layout.row(None)), word), cell(self.form_row, word))
    }

    /// Pr(w | role), for each role present.
    pub fn emissions(&self, word: usize, emissions: &mut Roles) {
        for slot in emissions.iter_mut().take(self.present.len()) {
            *slot = 0.0;
        }
        for group in &self.groups {
            let sum: f32 = group.values.iter().map(|&value| self.value(value, word)).sum();
            if let Some(slot) = emissions.get_mut(group.present) {
                *slot += group.share * sum;
            }
        }
    }

    /// The lift after a word, at the beginning for none, and 1 after a word that is not known.
    pub fn lift(&self, previous: Option<usize>) -> &'t [f32] {
        match previous {
            Some(word) if word >= self.layout.words() => &[1.0; KINDS],
            word => get(self.alignments, self.layout.lift(word.unwrap_or(self.layout.words()))),
        }
    }

    /// How a memory moves on after a word with this lift.
    pub fn step(&self, memory: usize, lift: &[f32]) -> Step {
        let (row, end) = self.moves.get(memory).map_or((&self.prior[..], END), |&moves| moves);
        let mut moves: Moves = [0.0; MOST_ROLES + 2];
        let [background, task, roles @ ..] = &mut moves;
        *background = cell(row, 0) * cell(lift, 0);
        *task = cell(row, 1) * cell(lift, 1);
        let mut sum = *background + *task;
        for (slot, present) in roles.iter_mut().zip(&self.present) {
            *slot = cell(row, present.column) * cell(lift, present.kind.index().saturating_add(2));
            sum += *slot;
        }
        let scale = if sum > 0.0 { (1.0 - end) / sum } else { 0.0 };
        Step { scale, moves }
    }

    /// Explains one word: from how probable each memory is before it to after it. Returns the sum of the latter.
    pub fn advance(&self, word: usize, previous: Option<usize>, before: &Memories, after: &mut Memories) -> f32 {
        let lift = self.lift(previous);
        let (background, task) = self.background_and_task(word);
        let mut emissions: Roles = [0.0; MOST_ROLES];
        self.emissions(word, &mut emissions);
        let mut into: Roles = [0.0; MOST_ROLES];
        for (memory, (slot, &mass)) in after.iter_mut().zip(before).take(self.memories()).enumerate() {
            *slot = 0.0;
            if mass <= 0.0 {
                continue;
            }
            let step = self.step(memory, lift);
            let scale = step.scale * mass;
            let [first, second, roles @ ..] = &step.moves;
            *slot = scale * (first * background + second * task);
            for (slot, part) in into.iter_mut().zip(roles).take(self.present.len()) {
                *slot += scale * part;
            }
        }
        for ((slot, into), emission) in after.iter_mut().skip(1).zip(&into).zip(&emissions).take(self.present.len()) {
            *slot += into * emission;
        }
        after.iter().take(self.memories()).sum()
    }
}

/// What a word can be, before anything is learned: background, a word of the task, each of these roles.
pub(super) fn prior(layout: &Layout, roles: impl Iterator<Item = RoleKind> + Clone) -> Moves {
    let whole: f32 = 1.0 + roles.clone().map(|kind| layout.weight_of(kind)).sum::<f32>();
    let rest = (1.0 - BACKGROUND) / whole;
    let mut prior: Moves = [0.0; MOST_ROLES + 2];
    let weights = [BACKGROUND, rest].into_iter().chain(roles.map(|kind| rest * layout.weight_of(kind)));
    for (slot, weight) in prior.iter_mut().zip(weights) {
        *slot = weight;
    }
    prior
}

/// The words of a command; V stands for each that the parameters do not know.
pub(crate) fn heard(layout: &Layout, sentence: &[Option<Symbol>]) -> impl Iterator<Item = usize> {
    let words = layout.words();
    sentence.iter().map(move |word| word.map_or(words, |word| word.index().min(words)))
}

/// Pr(e|t); 1 for an untrained model. `tell` is told the position of each word, and the probability of it after those before.
pub fn likelihood(
    layout: &Layout,
    translations: &[f32],
    alignments: &[f32],
    sentence: &[Option<Symbol>],
    description: &[Symbol],
    mut tell: impl FnMut(usize, f32),
) -> Scaled {
    if layout.words() == 0 {
        return Scaled::ONE;
    }
    let reader = Reader::new(layout, translations, alignments, description);
    let mut before: Memories = [0.0; MOST_ROLES + 1];
    let mut after: Memories = [0.0; MOST_ROLES + 1];
    if let Some(first) = before.first_mut() {
        *first = 1.0;
    }
    let (mut product, mut previous) = (Scaled::ONE, None);
    for (position, word) in heard(layout, sentence).enumerate() {
        let sum = reader.advance(word, previous, &before, &mut after);
        tell(position, sum);
        if sum <= 0.0 {
            return Scaled::ZERO;
        }
        product = product.scaled_by(sum);
        let scale = 1.0 / sum;
        for (slot, mass) in before.iter_mut().zip(&after).take(reader.memories()) {
            *slot = mass * scale;
        }
        previous = Some(word);
    }
    let end: f32 = (0..reader.memories()).map(|memory| cell(&before, memory) * reader.end(memory)).sum();
    product.scaled_by(end)
}
