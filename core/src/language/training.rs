//! A training, in steps as large as the caller allows. Each model defines its own steps: [`ibm2::training`](super::ibm2) and
//! [`roles::training`](super::roles::training).

use super::bitext::BitextRef;
use super::ibm2;
use super::layer::Above;
#[cfg(feature = "layer")]
use super::layer::Step;
use super::roles::explanation::Explained;
use super::roles::training::Work;
use super::roles::{self, Layout};
use super::settings::{Model, Settings};
use super::tables::Tables;
use crate::planning::Progress;

/// The next step of a training.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Phase {
    #[default]
    Done,
    /// Done, and since then a command is explained, if this task is meant.
    Explaining(usize, Explained),
    /// The tables get their new sizes.
    Start,
    Model2(ibm2::training::Part),
    Roles(roles::training::Part),
    #[cfg(feature = "layer")]
    Layer,
}

impl Phase {
    /// The step after a trained role model.
    #[cfg(feature = "layer")]
    const AFTER_ROLES: Self = Self::Layer;
    #[cfg(not(feature = "layer"))]
    const AFTER_ROLES: Self = Self::Done;

    const fn of_model_2(part: ibm2::training::Part) -> Self {
        if let ibm2::training::Part::Done = part { Self::Done } else { Self::Model2(part) }
    }
}

/// A training, under way or done.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[doc(hidden)]
pub struct Training {
    phase: Phase,
    round: u32,
}

impl Training {
    /// No training is under way.
    pub(super) const DONE: Self = Self { phase: Phase::Done, round: 0 };

    /// Begins, for `words` and `tokens`. The caller has checked that the tables have room. Without words there is nothing to train.
    pub(super) fn begin(
        tables: &mut Tables<'_>,
        bitext: BitextRef<'_>,
        layer: &mut Above<'_>,
        words: usize,
        tokens: usize,
        settings: &Settings,
    ) -> Self {
        (tables.trained.words, tables.trained.tokens) = (words, tokens);
        let is_nothing = words == 0 || (settings.rounds == 0 && settings.model.in_use() == Model::Model2);
        layer.begin(settings);
        Self { phase: if is_nothing { start(tables, bitext, settings) } else { Phase::Start }, round: 0 }
    }

    /// Whether the training is complete.
    pub fn is_done(&self) -> bool {
        matches!(self.phase, Phase::Done | Phase::Explaining(..))
    }

    /// Begins to explain a command if this task is meant, unless it is explained already.
    pub(crate) fn begin_explaining(&mut self, task: usize) {
        if !matches!(self.phase, Phase::Explaining(of, _) if of == task) {
            self.phase = Phase::Explaining(task, Explained::START);
        }
    }

    /// The progress of explaining a command; `None` if none is explained.
    pub(super) fn explained(&mut self) -> Option<&mut Explained> {
        if let Phase::Explaining(_, explained) = &mut self.phase { Some(explained) } else { None }
    }

    /// Other work takes the memory of what was explained.
    pub(crate) fn forget_explained(&mut self) {
        if self.is_done() {
            self.phase = Phase::Done;
        }
    }

    /// The current round, from 0.
    pub fn round(&self) -> u32 {
        self.round
    }

    /// Continues, with at most about `budget` table cells of work: at least one pair, row or alignment table, or for the role model one
    /// memory of a word. The first call also sizes the tables, regardless of the budget.
    pub(super) fn advance(
        &mut self,
        tables: &mut Tables<'_>,
        bitext: BitextRef<'_>,
        layer: &mut Above<'_>,
        settings: &Settings,
        budget: u32,
    ) -> Progress {
        let mut left = budget.max(1) as usize;
        let bitext = bitext.without(layer.left_out());
        if matches!(self.phase, Phase::Start) {
            self.phase = start(tables, bitext, settings);
            left = left.saturating_sub(tables.trained.words.saturating_mul(tables.trained.tokens));
        }
        let (layout, tokens) = (tables.trained.layout, tables.trained.tokens);
        while left > 0 {
            let (work, next) = match self.phase {
                // A model that is not built in is not linked.
                Phase::Model2(part) if Model::Model2.is_there() => {
                    let (cells, next) = ibm2::training::advance(tables, bitext, part, &mut self.round, settings);
                    (cells, Phase::of_model_2(next))
                }
                Phase::Done | Phase::Explaining(..) | Phase::Start | Phase::Model2(_) => return Progress::Done,
                Phase::Roles(part) => {
                    let (t, a) = tables.parts();
                    let mut work = Work { layout: &layout, tokens, bitext, t, a };
                    let (cells, next) = work.advance(part, &mut self.round, settings.rounds, left);
                    let is_done = matches!(next, roles::training::Part::Done);
                    (cells, if is_done { Phase::AFTER_ROLES } else { Phase::Roles(next) })
                }
                #[cfg(feature = "layer")]
                Phase::Layer => match layer.advance(tables.read(), bitext) {
                    Step::Working(cells) => (cells, Phase::Layer),
                    Step::RolesAnew => {
                        *self = Self { phase: Phase::Start, round: 0 };
                        return Progress::Working;
                    }
                    Step::Done => (1, Phase::Done),
                },
            };
            self.phase = next;
            left = left.saturating_sub(work.max(1));
        }
        if self.is_done() { Progress::Done } else { Progress::Working }
    }
}

/// Gives the tables their new sizes.
#[inline(never)]
fn start(tables: &mut Tables<'_>, bitext: BitextRef<'_>, settings: &Settings) -> Phase {
    let (words, tokens) = (tables.trained.words, tables.trained.tokens);
    match settings.model.in_use() {
        Model::Model2 => {
            tables.trained.layout = Layout::NONE;
            tables.clear_counts();
            Phase::of_model_2(ibm2::training::start(tables, bitext, settings))
        }
        Model::Roles => {
            tables.trained.layout = Layout::of(bitext, words, tokens);
            tables.clear_counts();
            if words == 0 {
                return Phase::Done;
            }
            let layout = tables.trained.layout;
            let (t, a) = tables.parts();
            Work { layout: &layout, tokens, bitext, t, a }.clear();
            Phase::Roles(roles::training::Part::Count(0))
        }
    }
}
