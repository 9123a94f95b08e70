//! The position of each parameter in the tables.
//!
//! `translations` has one row of V words for the background, then one per machine token: `T[v]` for a value, `A[l]` for a lifted task.
//! `alignments` has, in this order:
//!
//! | part | rows | columns |
//! |---|---|---|
//! | frequency of each word | 1 | V |
//! | lift | V words before, and the beginning | kinds |
//! | cue, where tasks have ways | V words | kinds of roles, seen and expected |
//! | kind of task | lifted tasks | V words, a constant, the length |
//! | p0 | lifted tasks times memories | background, task, roles |
//! | end | lifted tasks | memories |
//! | lambda | roles | sorts of values |
//! | naming, where tasks have ways | lifted tasks | kinds of roles, each: none named, some, all |
//! | novelty | background, and each machine token | 1 |
//! | trellis | the longest command and two more | memories and a scale |

use crate::capacity::LIFTED_TASKS;
use crate::language::bitext::{BitextRef, Pair};
use crate::symbols::Symbol;
use crate::task::description::form;
use crate::task::role::{Marker, Role, RoleKind, VALUE_SORTS};
use core::ops::Range;

/// The largest number of different roles; any after these are left out.
pub const MOST_ROLES: usize = 16;
/// The largest number of columns of a lift: background, a word of the task, or a kind of role. See [`Layout::kinds`].
pub const KINDS: usize = 2 + RoleKind::COUNT;
/// The number of columns of a cue: the counts of each kind of role, seen and expected. The parameters use the first half.
pub const CUES: usize = 2 * RoleKind::COUNT;
/// The coverages of a role: none of it named, a part, or all.
pub(super) const SHARES_NAMED: usize = 3;
const NAMING: usize = RoleKind::COUNT * SHARES_NAMED;
/// The columns of a kind of task after its words: the constant and the weight of the length.
pub(super) const BESIDE_WORDS: usize = 2;
/// The number of sessions at which terms that grow with them reach half their size.
const HALF_OF_MANY: f32 = 60.0;
/// The largest weight of the roles *start* and *other* before training, relative to 1 for a goal. It is reached after fifteen lessons,
/// because the first ones must teach what goals are called: with all of it after two lessons in a flat of ten rooms, "green" is one of the
/// nine other rooms. If it grew on, to half a goal's, the words of a goal would be read as other things of the scene after a hundred
/// lessons, although eight were enough to understand them.
const OTHERS: f32 = 0.1;
/// The same if tasks have ways: people name the rooms of the way, and seldom another one.
const OTHERS_WITH_WAYS: f32 = 0.05;

/// The dimensions of the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    words: usize,
    tokens: usize,
    forms: [Symbol; LIFTED_TASKS],
    form_count: u8,
    roles: [Role; MOST_ROLES],
    role_count: u8,
    longest: u8,
    /// Whether a role belongs to a way.
    has_ways: bool,
    /// Whether the words in the names of propositions are values.
    #[cfg(feature = "alloc")]
    has_names: bool,
    sessions: f32,
    starts: Starts,
}

/// The positions at which the parts of `alignments` begin, stored because every step of every word needs them.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Starts {
    cues: usize,
    kinds: usize,
    p0: usize,
    end: usize,
    lambda: usize,
    naming: usize,
    novelty: usize,
}

impl Layout {
    /// No parameters.
    pub(crate) const NONE: Self = Self {
        words: 0,
        tokens: 0,
        forms: [Symbol(0); LIFTED_TASKS],
        form_count: 0,
        roles: [Role::UNUSED; MOST_ROLES],
        role_count: 0,
        longest: 0,
        has_ways: false,
        #[cfg(feature = "alloc")]
        has_names: false,
        sessions: 0.0,
        starts: Starts { cues: 0, kinds: 0, p0: 0, end: 0, lambda: 0, naming: 0, novelty: 0 },
    };

    /// The parameters for training data of this many words and machine tokens.
    pub(crate) fn of(bitext: BitextRef<'_>, words: usize, tokens: usize) -> Self {
        let mut layout = Self { words, tokens, sessions: bitext.sessions_kept() as f32, ..Self::NONE };
        for command in 0..bitext.commands() as u16 {
            layout.see(bitext.command(command));
        }
        layout.see_length(bitext.longest_sentence());
        layout.settled()
    }

    /// Extends the layout by a description's lifted task and roles; [`with`](Self::with) must follow.
    pub(crate) fn see(&mut self, description: &[Symbol]) {
        if let Some(form) = form(description) {
            self.add_form(form);
        }
        // A role counts once it has a value. Most markers have the role of the one before.
        let (mut before, mut added) = (None, None);
        for &symbol in description {
            match Marker::of(symbol) {
                Some(marker) => before = Some(marker.role),
                None => match before.take() {
                    Some(role) if added != Some(role) => {
                        self.add_role(role);
                        added = Some(role);
                    }
                    _ => {}
                },
            }
        }
    }

    fn add_form(&mut self, form: Symbol) {
        if self.form(form).is_none()
            && let Some(slot) = self.forms.get_mut(usize::from(self.form_count))
        {
            *slot = form;
            self.form_count = self.form_count.saturating_add(1);
        }
    }

    fn add_role(&mut self, role: Role) {
        self.has_ways |= role.kind().index() >= RoleKind::WITHOUT_WAYS;
        #[cfg(feature = "alloc")]
        {
            self.has_names |= role.is_of_name();
        }
        if self.role(role).is_none()
            && let Some(slot) = self.roles.get_mut(usize::from(self.role_count))
        {
            *slot = role;
            self.role_count = self.role_count.saturating_add(1);
        }
    }

    /// The layout of another robot's parameters: for this many words and machine tokens, with its lifted tasks, its roles and its number of
    /// sessions.
    pub(crate) fn of_others(
        words: usize,
        tokens: usize,
        sessions: f32,
        forms: impl Iterator<Item = Symbol>,
        roles: impl Iterator<Item = Role>,
    ) -> Self {
        let mut layout = Self { words, tokens, sessions, ..Self::NONE };
        forms.for_each(|form| layout.add_form(form));
        roles.for_each(|role| layout.add_role(role));
        layout.settled()
    }

    /// The same layout, with the beginnings of its parts computed.
    const fn settled(mut self) -> Self {
        let (forms, roles) = (self.form_count as usize, self.role_count as usize);
        let (memories, moves) = (roles + 1, roles + 2);
        let cues = row(self.words, self.words, self.kinds()).end;
        let kinds = if self.has_ways() { row(cues, self.words, CUES).start } else { cues };
        let p0 = row(kinds, forms, self.words.saturating_add(BESIDE_WORDS)).start;
        let end = row(p0, forms.saturating_mul(memories), moves).start;
        let lambda = row(end, forms, memories).start;
        let naming = row(lambda, roles, VALUE_SORTS).start;
        let novelty = if self.has_ways() { row(naming, forms, NAMING).start } else { naming };
        self.starts = Starts { cues, kinds, p0, end, lambda, naming, novelty };
        self
    }

    /// Extends the layout to a command of this many words.
    pub(crate) fn see_length(&mut self, words: usize) {
        self.longest = self.longest.max(words.min(usize::from(u8::MAX)) as u8);
    }

    /// The same layout for this many words and machine tokens.
    pub(crate) const fn with(self, words: usize, tokens: usize) -> Self {
        Self { words, tokens, ..self }.settled()
    }

    /// The number of machine tokens.
    pub const fn tokens(&self) -> usize {
        self.tokens
    }

    /// V, the number of words.
    pub const fn words(&self) -> usize {
        self.words
    }

    /// Whether a role belongs to a way.
    pub const fn has_ways(&self) -> bool {
        cfg!(feature = "ways") && self.has_ways
    }

    /// Whether the words in the names of propositions are values that tell tasks apart, as in worlds in which no robot acts. Only hosts
    /// learn in such worlds.
    #[cfg(feature = "alloc")]
    pub const fn has_names(&self) -> bool {
        self.has_names
    }

    /// Always `false`: only hosts learn in worlds in which words in names are values.
    #[cfg(not(feature = "alloc"))]
    pub const fn has_names(&self) -> bool {
        false
    }

    /// The number of columns of a lift: background, a word of the task, and the kinds of roles, those of ways only if there are ways.
    pub const fn kinds(&self) -> usize {
        if self.has_ways() { KINDS } else { 2 + RoleKind::WITHOUT_WAYS }
    }

    /// The weight of a pair in training.
    pub(in crate::language) fn weight(&self, bitext: BitextRef<'_>, pair: &Pair) -> f32 {
        if self.has_names() { bitext.weight_of_meaning(pair) } else { pair.weight }
    }

    /// The number of words of all sessions, repetitions included, each times the weight of its session.
    #[cfg(feature = "layer")]
    pub fn words_said(&self, bitext: BitextRef<'_>) -> f32 {
        if !self.has_names() {
            return bitext.words_said() as f32;
        }
        let of_session = |session: u16| {
            let weight = bitext.pairs_of(session).first().map_or(0.0, |pair| self.weight(bitext, pair));
            weight * bitext.sentence(session).len() as f32
        };
        (0..bitext.sessions() as u16).map(of_session).sum()
    }

    /// The number of sessions.
    pub(crate) const fn sessions(&self) -> f32 {
        self.sessions
    }

    /// The tokens of the lifted tasks, in the order of their rows.
    pub fn forms(&self) -> &[Symbol] {
        self.forms.get(..usize::from(self.form_count)).unwrap_or(&[])
    }

    /// The roles, in the order of their rows.
    pub fn roles(&self) -> &[Role] {
        self.roles.get(..usize::from(self.role_count)).unwrap_or(&[])
    }

    /// The row of a lifted task.
    pub(super) fn form(&self, token: Symbol) -> Option<usize> {
        self.forms().iter().position(|&form| form == token)
    }

    /// The row of a role.
    pub(super) fn role(&self, role: Role) -> Option<usize> {
        self.roles().iter().position(|&known| known == role)
    }

    pub(crate) const fn memories(&self) -> usize {
        (self.role_count as usize).saturating_add(1)
    }

    pub(super) const fn moves(&self) -> usize {
        (self.role_count as usize).saturating_add(2)
    }

    /// The row of a token in `translations`; the background's is 0.
    pub(super) fn row(&self, token: Option<Symbol>) -> Range<usize> {
        row(0, token.map_or(0, |token| token.index() + 1), self.words)
    }

    /// The cell of a word in a token's row; no cell of the table if the row lacks it.
    pub(super) fn of_word(&self, token: Option<Symbol>, word: usize) -> usize {
        if word < self.words { self.row(token).start.wrapping_add(word) } else { usize::MAX }
    }

    pub(super) fn common(&self) -> Range<usize> {
        row(0, 0, self.words)
    }

    /// The row of the lift after a word; `words` means the beginning of a command.
    pub(super) fn lift(&self, word: usize) -> Range<usize> {
        row(self.words, word, self.kinds())
    }

    /// The row of a word as a cue; empty without roles of ways.
    pub(super) fn cue(&self, word: usize) -> Range<usize> {
        row(self.starts.cues, word, if self.has_ways() { CUES } else { 0 })
    }

    pub(super) fn kind_of_task(&self, form: usize) -> Range<usize> {
        row(self.starts.kinds, form, self.words.saturating_add(BESIDE_WORDS))
    }

    pub(super) fn p0(&self, form: usize, memory: usize) -> Range<usize> {
        row(self.starts.p0, form.saturating_mul(self.memories()).saturating_add(memory), self.moves())
    }

    /// All rows of p0 of a lifted task.
    pub(super) fn all_p0(&self, form: usize) -> Range<usize> {
        self.p0(form, 0).start..self.p0(form + 1, 0).start
    }

    pub(super) fn end(&self, form: usize) -> Range<usize> {
        row(self.starts.end, form, self.memories())
    }

    pub(super) fn lambda(&self, role: usize) -> Range<usize> {
        row(self.starts.lambda, role, VALUE_SORTS)
    }

    /// The row of how much of each kind of role is named; empty without roles of ways.
    pub(super) fn naming(&self, form: usize) -> Range<usize> {
        row(self.starts.naming, form, if self.has_ways() { NAMING } else { 0 })
    }

    /// The cell of a row's novelty: the probability that its next word is a new one; 1 for a token that was never named.
    pub(super) fn novelty(&self, row: usize) -> usize {
        self.starts.novelty.saturating_add(row)
    }

    /// The number of cells of `translations` in use.
    pub(crate) const fn translations(&self) -> usize {
        self.tokens.saturating_add(1).saturating_mul(self.words)
    }

    /// The position at which the trellis begins, after all parameters.
    pub(crate) fn trellis_start(&self) -> usize {
        self.novelty(self.tokens + 1)
    }

    /// The number of cells of `alignments` in use.
    pub(crate) fn cells(&self) -> usize {
        let rows = usize::from(self.longest).saturating_add(2);
        if self.words == 0 { 0 } else { self.trellis_start().saturating_add(rows.saturating_mul(self.memories() + 1)) }
    }

    /// The weight of a role in the prior, relative to 1 for a goal.
    pub(super) fn weight_of(&self, kind: RoleKind) -> f32 {
        match kind.is_of_task() {
            true => 1.0,
            false if self.has_ways() => OTHERS_WITH_WAYS,
            false => (0.5 * self.many()).min(OTHERS),
        }
    }

    /// How far the number of sessions counts as many, from 0 to 1.
    pub(super) fn many(&self) -> f32 {
        self.sessions / (self.sessions + HALF_OF_MANY)
    }
}

/// The tables have at most 65,535 words and tokens, so nothing wraps; checking each cell would take flash and time.
const fn row(start: usize, position: usize, width: usize) -> Range<usize> {
    let from = start.wrapping_add(position.wrapping_mul(width));
    from..from.wrapping_add(width)
}

/// A row of a table; empty if the table is too short.
pub(super) fn get(cells: &[f32], range: Range<usize>) -> &[f32] {
    cells.get(range).unwrap_or(&[])
}

/// A row of a table, to write to; empty if the table is too short. On boards, a call takes less flash than the check.
#[cfg_attr(not(feature = "layer"), inline(never))]
pub(super) fn get_mut(cells: &mut [f32], range: Range<usize>) -> &mut [f32] {
    cells.get_mut(range).unwrap_or(&mut [])
}

/// One cell of a row; 0 beyond its end.
pub(super) fn cell(row: &[f32], position: usize) -> f32 {
    row.get(position).copied().unwrap_or(0.0)
}
