//! Pr(e|t), word by word.

use super::layout::{KINDS, Layout, MOST_ROLES, SHARES_NAMED, cell, get};
use crate::capacity::TOKENS_PER_COMMAND;
use crate::probability::Scaled;
use crate::symbols::Symbol;
use crate::task::description::{form, groups};
use crate::task::role::{Role, RoleKind};
use heapless::Vec;

/// The largest number of groups of a description that are read.
const MOST_GROUPS: usize = 24;
/// Before training: the probability of background, and of the end of a command.
const BACKGROUND: f32 = 0.5;
pub(super) const END: f32 = 0.1;

/// Memories with a smaller share of the probability are dropped: they take most of the work and change next to nothing.
const LEAST_MASS: f32 = 1.0 / 1024.0;

/// A memory's share of the probability, or 0 if it is dropped. Shares are not negative, so their bits have the same order; without a
/// floating-point unit, bits are compared faster.
pub(super) fn kept(share: f32) -> f32 {
    if share.to_bits() < LEAST_MASS.to_bits() { 0.0 } else { share }
}

/// Whether a share is greater than 0.
fn is_positive(share: f32) -> bool {
    share.to_bits() != 0
}

/// One number per memory: none, or the role that was named last.
pub(super) type Memories = [f32; MOST_ROLES + 1];
/// One number per role.
pub(super) type Roles = [f32; MOST_ROLES];
/// One number per possible reading of a word: background, a word of the task, or a role.
pub(super) type Moves = [f32; MOST_ROLES + 2];

/// A role of the task.
#[derive(Clone, Copy, Debug)]
pub(super) struct Present {
    pub role: Role,
    /// The column of its probability in a row of p0: by its row if training has seen the lifted task, otherwise by its position.
    column: u8,
    /// The column of its kind in a lift.
    lift: u8,
}

impl Present {
    pub fn kind(self) -> RoleKind {
        self.role.kind()
    }

    pub fn column(self) -> usize {
        usize::from(self.column)
    }

    pub fn lift(self) -> usize {
        usize::from(self.lift)
    }
}

/// One group of values.
#[derive(Clone, Copy, Debug)]
pub(super) struct GroupShare {
    /// The role, by its position in `present`.
    present: u8,
    sort: u8,
    /// The position of its first value in the description, and the number of values.
    first: u8,
    count: u8,
    /// The group's share of its role, spread evenly over its values.
    pub share: f32,
}

impl GroupShare {
    pub fn present(self) -> usize {
        usize::from(self.present)
    }

    pub fn sort(self) -> usize {
        usize::from(self.sort)
    }
}

/// A description, prepared to compute the probabilities of words. It is kept small, for a microcontroller's stack.
pub(super) struct Reader<'t, 'd> {
    layout: &'t Layout,
    translations: &'t [f32],
    alignments: &'t [f32],
    description: &'d [Symbol],
    pub form: Option<usize>,
    form_row: &'t [f32],
    /// p0 of the lifted task, one row per memory, and the probabilities of the end; empty if training has not seen the lifted task.
    p0: &'t [f32],
    ends: &'t [f32],
    pub present: Vec<Present, MOST_ROLES, u8>,
    pub groups: Vec<GroupShare, MOST_GROUPS, u8>,
    /// The probability of a new word in the background, if it replaces the trained one.
    #[cfg(feature = "talk")]
    pub new_in_background: Option<f32>,
}

/// The largest distance of a cue from its word.
const FARTHEST_CUE: usize = 4;

/// The context before a word.
pub(super) struct Before {
    /// The word before it.
    pub previous: Option<usize>,
    /// Where tasks have ways: the nearest words before it, up to [`FARTHEST_CUE`], back to one that names something.
    pub cues: Vec<u16, FARTHEST_CUE, u8>,
}

/// Scratch buffers, reused across words to avoid zeroing them again. Only the entries of roles that are present are read.
pub(super) struct Scratch {
    pub lifts: Moves,
    pub emissions: Roles,
    pub moves: Moves,
    pub into: Roles,
}

impl Scratch {
    pub const NEW: Self =
        Self { lifts: [0.0; MOST_ROLES + 2], emissions: [0.0; MOST_ROLES], moves: [0.0; MOST_ROLES + 2], into: [0.0; MOST_ROLES] };
}

impl<'t, 'd> Reader<'t, 'd> {
    /// A reader that [`take_groups`](Self::take_groups) fills in place: returned by a function, it would be on the stack twice.
    #[inline(always)]
    pub fn new(layout: &'t Layout, translations: &'t [f32], alignments: &'t [f32], description: &'d [Symbol]) -> Self {
        let token = form(description);
        let form = token.and_then(|token| layout.form(token));
        Self {
            layout,
            translations,
            alignments,
            description,
            form,
            form_row: get(translations, layout.row(token.filter(|_| form.is_some()))),
            p0: form.map_or(&[], |form| get(alignments, layout.all_p0(form))),
            ends: form.map_or(&[], |form| get(alignments, layout.end(form))),
            present: Vec::new(),
            groups: Vec::new(),
            #[cfg(feature = "talk")]
            new_in_background: None,
        }
    }

    /// Takes the roles and values from the description.
    #[inline(never)]
    pub fn take_groups(&mut self) {
        let mut whole: Roles = [0.0; MOST_ROLES];
        for group in groups(self.description) {
            let role = group.marker.role;
            // A role's groups follow each other.
            let before = self.present.iter().rposition(|present| present.role == role);
            let known = match before.filter(|_| self.form.is_some()) {
                Some(before) => self.known(before),
                None => self.layout.role(role),
            };
            // A role that training has not seen says nothing about a lifted task that it has seen.
            if known.is_none() && self.form.is_some() {
                continue;
            }
            let present = match before {
                Some(present) => present,
                None => {
                    let column = known.filter(|_| self.form.is_some()).unwrap_or(self.present.len()).saturating_add(2);
                    let lift = role.kind().index().saturating_add(2);
                    if self.present.push(Present { role, column: column as u8, lift: lift as u8 }).is_err() {
                        continue;
                    }
                    self.present.len().saturating_sub(1)
                }
            };
            let sort = group.marker.sort;
            let share = known.map_or(1.0, |role| cell(get(self.alignments, self.layout.lambda(role)), usize::from(sort)));
            if let Some(whole) = whole.get_mut(present) {
                *whole += share;
            }
            let (first, count) = (group.first as u8, group.values.len() as u8);
            let _ = self.groups.push(GroupShare { present: present as u8, sort, first, count, share });
        }
        for group in &mut self.groups {
            let whole = cell(&whole, group.present());
            // The only value of its role has the whole share. This saves a division, which is slow without a floating-point unit.
            let is_all = group.count == 1 && group.share.to_bits() == whole.to_bits();
            group.share = match is_positive(whole) {
                true if is_all => 1.0,
                true => group.share / (whole * f32::from(group.count)),
                false => 0.0,
            };
        }
    }

    /// The values of a group.
    pub fn values(&self, group: &GroupShare) -> &'d [Symbol] {
        let first = usize::from(group.first);
        self.description.get(first..first.saturating_add(usize::from(group.count))).unwrap_or(&[])
    }

    /// The row of a present role; `None` unless training has seen the lifted task.
    pub fn known(&self, present: usize) -> Option<usize> {
        let column = self.present.get(present).filter(|_| self.form.is_some())?.column;
        usize::from(column).checked_sub(2)
    }

    /// The row of a memory: 0 for none, otherwise that of the present role at the position before.
    pub fn memory(&self, memory: usize) -> Option<usize> {
        match memory.checked_sub(1) {
            None => Some(0),
            Some(present) => self.known(present).map(|role| role + 1),
        }
    }

    pub fn layout(&self) -> &'t Layout {
        self.layout
    }

    pub fn memories(&self) -> usize {
        self.present.len() + 1
    }

    /// The length of the description.
    pub fn described(&self) -> usize {
        self.description.len()
    }

    /// The probability that the command ends after this memory.
    pub fn end(&self, memory: usize) -> f32 {
        match self.memory(memory) {
            Some(row) if self.form.is_some() => cell(self.ends, row),
            _ => END,
        }
    }

    /// The probability of a new word for a token.
    fn novelty(&self, token: Option<Symbol>) -> f32 {
        match token.map_or(0, |token| token.index() + 1) {
            row if row <= self.layout.tokens() => cell(self.alignments, self.layout.novelty(row)),
            _ => 1.0,
        }
    }

    /// T[v](w). A value that training has not seen has the frequencies of all words.
    #[cfg_attr(not(feature = "layer"), inline(never))]
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

    /// The word's column, from the first value's row to the last's. It saves calls of [`value`](Self::value) in the common case.
    fn column(&self, word: usize) -> &'t [f32] {
        let (words, tokens) = (self.layout.words(), self.layout.tokens());
        let first = words.saturating_add(word);
        get(self.translations, first..if word < words { words.saturating_mul(tokens + 1) } else { 0 })
    }

    /// [`value`](Self::value), for a word whose column is known.
    #[inline(always)]
    fn value_in(&self, column: &[f32], token: Symbol, word: usize) -> f32 {
        match column.get(token.index().wrapping_mul(self.layout.words())) {
            Some(&probability) => probability,
            None => self.value(token, word),
        }
    }

    /// F(w) of a new word.
    fn new_in_background(&self) -> f32 {
        #[cfg(feature = "talk")]
        if let Some(new) = self.new_in_background {
            return new;
        }
        self.novelty(None)
    }

    /// F(w) and A[l](w).
    pub fn background_and_task(&self, word: usize) -> (f32, f32) {
        if word >= self.layout.words() {
            return (
                self.new_in_background(),
                self.form.and_then(|form| self.layout.forms().get(form)).map_or(1.0, |&token| self.novelty(Some(token))),
            );
        }
        (cell(get(self.translations, self.layout.row(None)), word), cell(self.form_row, word))
    }

    /// Pr(w | role) for each role present.
    pub fn emissions(&self, word: usize, emissions: &mut Roles) {
        emissions.iter_mut().take(self.present.len()).for_each(|slot| *slot = 0.0);
        let column = self.column(word);
        for group in &self.groups {
            let translations = self.values(group).iter().map(|&value| self.value_in(column, value, word));
            let sum = translations.reduce(|sum, next| sum + next).unwrap_or(0.0);
            if let Some(slot) = emissions.get_mut(group.present()) {
                *slot += group.share * sum;
            }
        }
    }

    /// The context before a word.
    pub fn before(&self, position: usize, word: impl Fn(usize) -> Option<usize>) -> Before {
        let at = |back: usize| position.checked_sub(back).and_then(&word);
        let mut before = Before { previous: at(1), cues: Vec::new() };
        if self.layout.has_ways() {
            // Words farther back belong to the thing that is named there.
            for cue in (1..=FARTHEST_CUE).map_while(at) {
                let _ = before.cues.push(cue as u16);
                if self.names(cue) {
                    break;
                }
            }
        }
        before
    }

    /// Whether a word is likelier as a value of the description than as background or a word of the task.
    fn names(&self, word: usize) -> bool {
        let (background, task) = self.background_and_task(word);
        let (most, column) = (background.max(task), self.column(word));
        let names = |&value: &Symbol| self.value_in(column, value, word) > most;
        word < self.layout.words() && self.groups.iter().any(|group| self.values(group).iter().any(names))
    }

    /// Which of these values a word names, if that is likelier than background or a word of the task.
    fn value_named(&self, word: usize, values: &[Symbol]) -> Option<Symbol> {
        let (background, task) = self.background_and_task(word);
        let (mut best, mut most, column) = (None, background.max(task), self.column(word));
        if word < self.layout.words() {
            for &value in values {
                let probability = self.value_in(column, value, word);
                if probability > most {
                    (best, most) = (Some(value), probability);
                }
            }
        }
        best
    }

    /// Calls `tell`, for each kind of role that the task has, with a column of `naming`: how much of it the words name.
    pub fn naming(&self, words: impl Iterator<Item = usize>, mut tell: impl FnMut(usize)) {
        // Found once, for all words.
        let mut values: Vec<Symbol, TOKENS_PER_COMMAND, u8> = Vec::new();
        for group in self.groups.iter().filter(|group| group.sort & 1 == 0) {
            // They are part of the description, so they fit.
            let _ = values.extend_from_slice(self.values(group));
        }
        let mut named: Vec<Symbol, 8, u8> = Vec::new();
        // A word said again names nothing more. Only the first words of the vocabulary have a bit; others are looked up again.
        let mut said = 0_u64;
        let is_new = |word: &usize| {
            let bit = u32::try_from(*word).ok().and_then(|word| 1_u64.checked_shl(word)).unwrap_or(0);
            let is_new = said & bit == 0;
            said |= bit;
            is_new
        };
        for value in words.filter(is_new).filter_map(|word| self.value_named(word, &values)) {
            if !named.contains(&value) {
                let _ = named.push(value);
            }
        }
        for kind in 0..RoleKind::COUNT {
            let of_kind = self.groups.iter().filter(|group| group.sort & 1 == 0);
            let of_kind = of_kind.filter(|group| self.present.get(group.present()).is_some_and(|it| it.kind().index() == kind));
            let (mut all, mut said) = (0_usize, 0_usize);
            for &value in of_kind.flat_map(|group| self.values(group)) {
                all += 1;
                said = said.saturating_add(usize::from(named.contains(&value)));
            }
            if all > 0 {
                let share = if said == 0 { 0 } else { 1_usize.saturating_add(usize::from(said == all)) };
                tell(kind.saturating_mul(SHARES_NAMED).saturating_add(share));
            }
        }
    }

    /// The probability that commands name as much of each role as these words do.
    fn naming_of(&self, words: impl Iterator<Item = usize>) -> f32 {
        let mut product = 1.0;
        if let Some(form) = self.form.filter(|_| self.layout.has_ways()) {
            let row = get(self.alignments, self.layout.naming(form));
            self.naming(words, |at| product *= cell(row, at));
        }
        product
    }

    /// The same; a kind of task that was never meant is named like the average of the others.
    #[cfg(feature = "layer")]
    fn naming_of_any(&self, words: impl Iterator<Item = usize>) -> f32 {
        if self.form.is_some() || !self.layout.has_ways() {
            return self.naming_of(words);
        }
        let mut product = 1.0;
        self.naming(words, |at| {
            let (first, forms) = (at.saturating_sub(at.checked_rem(SHARES_NAMED).unwrap_or(0)), self.layout.forms().len());
            let (mut sum, mut count) = (0.0, 0.0);
            for form in 0..forms {
                let row = get(self.alignments, self.layout.naming(form));
                let shares = get(row, first..first.saturating_add(SHARES_NAMED));
                // A kind of task without the role has no counts for it, so all its shares are equal.
                if shares.windows(2).any(|pair| cell(pair, 0) != cell(pair, 1)) {
                    (sum, count) = (sum + cell(row, at), count + 1.0);
                }
            }
            product *= if count > 0.0 { sum / count } else { 1.0 / SHARES_NAMED as f32 };
        });
        product
    }

    /// Fills in the factors of p0 after these words, for background, a word of the task, and each present role.
    #[inline(always)]
    pub fn lifts(&self, before: &Before, lifts: &mut Moves) {
        let lift = self.lift(before.previous);
        let [background, task, roles @ ..] = lifts;
        (*background, *task) = (cell(lift, 0), cell(lift, 1));
        for (slot, present) in roles.iter_mut().zip(&self.present) {
            *slot = cell(lift, present.lift());
        }
        for &cue in &before.cues {
            let row = get(self.alignments, self.layout.cue(usize::from(cue)));
            for (slot, present) in roles.iter_mut().zip(&self.present) {
                *slot *= if usize::from(cue) < self.layout.words() { cell(row, present.kind().index()) } else { 1.0 };
            }
        }
    }

    /// The lift after a word or, for `None`, at the beginning; 1 after an unknown word.
    fn lift(&self, previous: Option<usize>) -> &'t [f32] {
        match previous {
            Some(word) if word >= self.layout.words() => &[1.0; KINDS],
            word => get(self.alignments, self.layout.lift(word.unwrap_or(self.layout.words()))),
        }
    }

    /// A row of p0 for a lifted task that training has not seen.
    fn untrained_row(&self) -> Moves {
        prior(self.layout, self.present.iter().map(|present| present.kind()))
    }

    /// Fills in the weights of background, a word of the task and each present role after a memory, with these lifts. Returns their scale,
    /// (1 - end) / (the sum of the weights).
    #[cfg_attr(feature = "layer", inline(always))]
    #[cfg_attr(not(feature = "layer"), inline(never))]
    pub fn step(&self, memory: usize, lifts: &Moves, moves: &mut Moves) -> f32 {
        let untrained;
        let (row, end) = if self.form.is_some() {
            self.trained_row(memory)
        } else {
            untrained = self.untrained_row();
            (untrained.as_slice(), END)
        };
        self.scaled_moves(row, end, lifts, moves)
    }

    /// Fills in a memory's weights from its row of p0, and returns their scale.
    #[inline(always)]
    fn scaled_moves(&self, row: &[f32], end: f32, lifts: &Moves, moves: &mut Moves) -> f32 {
        let ([background, task, roles @ ..], [of_background, of_task, of_roles @ ..]) = (moves, lifts);
        *background = cell(row, 0) * of_background;
        *task = cell(row, 1) * of_task;
        let mut sum = *background + *task;
        for ((slot, lift), present) in roles.iter_mut().zip(of_roles).zip(&self.present) {
            *slot = cell(row, present.column()) * lift;
            sum += *slot;
        }
        if sum > 0.0 { (1.0 - end) / sum } else { 0.0 }
    }

    /// A memory's row of p0 and the probability of the end after it, for a lifted task that training has seen. Its present roles are then
    /// known, and a role's row is the one after its column.
    #[inline(always)]
    fn trained_row(&self, memory: usize) -> (&'t [f32], f32) {
        let present = memory.checked_sub(1).and_then(|present| self.present.get(present));
        let row = present.map_or(0, |present| present.column().saturating_sub(1));
        let width = self.layout.moves();
        let start = row.saturating_mul(width);
        (get(self.p0, start..start.saturating_add(width)), cell(self.ends, row))
    }

    /// Reads one word: computes the probability of each memory after it from that before it. Returns the sum over the memories.
    pub fn advance(&self, word: usize, words: &Before, before: &[f32], after: &mut [f32], scratch: &mut Scratch) -> f32 {
        let Scratch { lifts, emissions, moves, into } = scratch;
        self.lifts(words, lifts);
        let (background, task) = self.background_and_task(word);
        self.emissions(word, emissions);
        // If training has not seen the lifted task, all memories have the same weights.
        let untrained = self.form.is_none().then(|| self.step(0, lifts, moves));
        let count = self.present.len();
        into.iter_mut().take(count).for_each(|slot| *slot = 0.0);
        let mut is_first = true;
        for (memory, (slot, &mass)) in after.iter_mut().zip(before).take(count + 1).enumerate() {
            *slot = 0.0;
            if !is_positive(mass) {
                continue;
            }
            let scale = mass
                * untrained.unwrap_or_else(|| {
                    let (row, end) = self.trained_row(memory);
                    self.scaled_moves(row, end, lifts, moves)
                });
            let [first, second, roles @ ..] = &*moves;
            *slot = scale * (*first * background + *second * task);
            let into = into.iter_mut().zip(roles).take(count);
            match core::mem::replace(&mut is_first, false) {
                true => into.for_each(|(slot, part)| *slot = scale * part),
                false => into.for_each(|(slot, part)| *slot += scale * part),
            }
        }
        let Some((none, roles)) = after.split_first_mut() else { return 0.0 };
        let mut sum = *none;
        for ((slot, into), emission) in roles.iter_mut().zip(&*into).zip(&*emissions).take(count) {
            *slot += into * emission;
            sum += *slot;
        }
        sum
    }
}

/// The probabilities of background, a word of the task and each of these roles before training.
pub(super) fn prior(layout: &Layout, roles: impl Iterator<Item = RoleKind>) -> Moves {
    let mut prior: Moves = [0.0; MOST_ROLES + 2];
    let (mut count, [background, task, of_roles @ ..]) = (0_usize, &mut prior);
    for (slot, kind) in of_roles.iter_mut().zip(roles) {
        *slot = layout.weight_of(kind);
        count += 1;
    }
    (*background, *task) = (BACKGROUND, share_among(of_roles.get_mut(..count).unwrap_or(&mut [])));
    prior
}

/// Divides the probability that is not background among the roles by their weights. Returns the share of a word of the task, whose weight
/// is 1.
#[inline(never)]
fn share_among(weights: &mut [f32]) -> f32 {
    let whole: f32 = 1.0 + weights.iter().sum::<f32>();
    let rest = (1.0 - BACKGROUND) / whole;
    weights.iter_mut().for_each(|weight| *weight *= rest);
    rest
}

/// The words of a command, with V for each unknown word.
pub(crate) fn heard(layout: &Layout, sentence: &[Option<Symbol>]) -> impl Iterator<Item = usize> {
    sentence.iter().map(|&word| number(layout, word))
}

fn number(layout: &Layout, word: Option<Symbol>) -> usize {
    word.map_or(layout.words(), |word| word.index().min(layout.words()))
}

/// The state of reading a command for one task.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reading {
    /// The number of words read.
    pub words: u16,
    /// Their probability; at the end of the command, Pr(e|t).
    pub probability: Scaled,
}

impl Reading {
    /// Before the first word.
    pub const START: Self = Self { words: 0, probability: Scaled::ONE };

    /// Reads at most `most` more words. Returns `true` at the end of the command. The end is read in a part of its own, because it looks at
    /// all words once more where tasks have ways, and at lessons with the same words. `masses` keeps the probability of each memory between calls; `tell` gets each word's
    /// position and its probability after the words before it.
    pub(super) fn go_on(
        &mut self,
        reader: &Reader<'_, '_>,
        sentence: &[Option<Symbol>],
        masses: &mut [f32],
        most: usize,
        mut tell: impl FnMut(usize, f32),
    ) -> bool {
        let mut before: Memories = [0.0; MOST_ROLES + 1];
        let mut after: Memories = [0.0; MOST_ROLES + 1];
        before.iter_mut().zip(&*masses).for_each(|(slot, mass)| *slot = *mass);
        if self.words == 0 {
            before = [0.0; MOST_ROLES + 1];
            before.iter_mut().take(1).for_each(|slot| *slot = 1.0);
        }
        let first = usize::from(self.words);
        let mut scratch = Scratch::NEW;
        for (position, word) in heard(reader.layout, sentence).enumerate().skip(first).take(most) {
            let words = reader.before(position, |position| sentence.get(position).map(|&word| number(reader.layout, word)));
            let sum = reader.advance(word, &words, &before, &mut after, &mut scratch);
            tell(position, sum);
            if !is_positive(sum) {
                self.probability = Scaled::ZERO;
                return true;
            }
            self.probability = self.probability.scaled_by(sum);
            let scale = 1.0 / sum;
            for (slot, mass) in before.iter_mut().zip(&after).take(reader.memories()) {
                *slot = kept(mass * scale);
            }
            self.words = self.words.saturating_add(1);
        }
        let read = usize::from(self.words).saturating_sub(first);
        if usize::from(self.words) < sentence.len() || read >= most {
            masses.iter_mut().zip(&before).for_each(|(slot, mass)| *slot = *mass);
            return false;
        }
        let masses = before.iter().take(reader.memories()).enumerate().filter(|&(_, &mass)| is_positive(mass));
        let end: f32 = masses.map(|(memory, mass)| mass * reader.end(memory)).sum();
        self.probability = self.probability.scaled_by(end * reader.naming_of(heard(reader.layout, sentence)));
        true
    }
}

/// Pr(e|t); 1 for an untrained model. `tell` gets each word's position and its probability after the words before it.
#[inline(never)]
pub fn likelihood(
    layout: &Layout,
    (translations, alignments): (&[f32], &[f32]),
    sentence: &[Option<Symbol>],
    description: &[Symbol],
    tell: impl FnMut(usize, f32),
) -> Scaled {
    if layout.words() == 0 {
        return Scaled::ONE;
    }
    let mut reader = Reader::new(layout, translations, alignments, description);
    reader.take_groups();
    let mut reading = Reading::START;
    let _ = reading.go_on(&reader, sentence, &mut [], usize::MAX, tell);
    reading.probability
}

/// The probability that commands name as much of each role of a task as these words do; 1 without ways.
#[cfg(feature = "layer")]
pub fn named(layout: &Layout, (translations, alignments): (&[f32], &[f32]), sentence: &[Option<Symbol>], description: &[Symbol]) -> f32 {
    let mut reader = Reader::new(layout, translations, alignments, description);
    reader.take_groups();
    reader.naming_of_any(heard(layout, sentence))
}

/// Continues Pr(e|t) of a trained model by at most `most` words, as [`Reading::go_on`]. The masses are kept after the parameters.
#[inline(never)]
pub(crate) fn likelihood_on(
    layout: &Layout,
    translations: &[f32],
    alignments: &mut [f32],
    sentence: &[Option<Symbol>],
    description: &[Symbol],
    reading: &mut Reading,
    most: usize,
) -> bool {
    let Some((parameters, masses)) = alignments.split_at_mut_checked(layout.trellis_start()) else { return true };
    let mut reader = Reader::new(layout, translations, parameters, description);
    reader.take_groups();
    // If the masses do not fit there, the command is read at once.
    let most = if masses.len() < reader.memories() { usize::MAX } else { most };
    reading.go_on(&reader, sentence, masses, most, |_, _| {})
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oomdp::PropositionId;
    use crate::task::role::Marker;

    #[test]
    fn a_command_read_in_parts_is_as_probable_where_memories_find_no_room_between_them() {
        let layout = Layout::NONE.with(1, 0);
        let role = |kind, proposition| Marker { role: Role::of_argument(kind, PropositionId(proposition), 0), sort: 0 }.symbol();
        let description = [Symbol(0), role(RoleKind::Goal, 0), Symbol(1), role(RoleKind::Start, 1), Symbol(2)];
        let sentence = [Some(Symbol(0)), None, Some(Symbol(0)), None];
        let mut alignments = std::vec![0.5; layout.trellis_start() + 1];
        let whole = likelihood(&layout, (&[0.25], &alignments), &sentence, &description, |_, _| {});
        let mut reading = Reading::START;
        while !likelihood_on(&layout, &[0.25], &mut alignments, &sentence, &description, &mut reading, 1) {}
        assert_eq!(reading.probability, whole);
    }
}
