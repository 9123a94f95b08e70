//! Plans for one state after another, for the tasks of one session.
//!
//! Each plan takes these steps, for all tasks at once:
//! 1. goals that hold here, and deadlocks, need no search. On a floor with pieces, the first plan of a session begins by tabulating the
//!    tasks' goal cells;
//! 2. on a floor with more joint states than fit, bounds of the distances of the tasks without a way: exact if the two bounds agree;
//! 3. the exact search for all remaining tasks without a way: by rows of bits if the domain is a floor with pieces and the rows fit, else
//!    state by state. If the states do not fit either, it searches as far as its hash table reaches, so near goals are still found exactly;
//! 4. for the tasks of each unfinished way, an exact search in the product of world and way: by rows of bits if the robot's cell determines
//!    the way's progress, else state by state;
//! 5. on a floor with pieces, the remaining tasks without a way get an approximate plan. Those with a way stay unknown.

use super::Progress;
#[cfg(feature = "approximate")]
use super::approximate::Approximation;
#[cfg(feature = "bounds")]
use super::bounds::Bounds;
use super::deadlock::Deadlocks;
use super::goals::{GoalTable, Goals};
use super::one_by_one::{self, StateSearch, Stray};
use super::plan::{Found, Plan, Results};
use super::rows::{RowSearch, View};
use super::ways::Ways;
use crate::capacity::{Capacities, Capacity, CapacityError};
use crate::memory::{GoalMemory, GoalMemoryRef, PlanMemory};
use crate::oomdp::{ActionSet, Domain, PushGrid, SearchKind};
use crate::task::{GroundedTask, LiftedTask, TaskSet};

/// The tables of a [`Planner`], lent to it for each call. Do not change their contents between its calls.
#[derive(Debug)]
#[doc(hidden)]
pub struct PlanTables<'t> {
    /// The goals' tables; if there are too few entries, propositions are tested one by one.
    goals: GoalMemory<'t>,
    /// The results' tables, and the state numbers of a hashed search.
    pub plan: PlanMemory<'t>,
    /// First actions and the frontier.
    marks: &'t mut [u64],
    /// The tasks, if some have ways; see [`with_ways`](Self::with_ways).
    ways: Ways<'t>,
}

impl<'t> PlanTables<'t> {
    /// The tables in these memories, with the marks at the front of the workspace.
    pub fn new(goals: GoalMemory<'t>, plan: PlanMemory<'t>, workspace: &'t mut [u64]) -> Self {
        let words = plan.search_words.len().min(workspace.len());
        Self { goals, plan, marks: workspace.get_mut(..words).unwrap_or(&mut []), ways: Ways::default() }
    }

    /// The same tables, with the planned tasks and the progress of their ways. Without this, a task with a way is unknown.
    #[must_use]
    pub const fn with_ways(self, ways: Ways<'t>) -> Self {
        Self { ways, ..self }
    }

    /// Splits the tables into the goals, the marks, the hash table, and the results.
    fn split<'s>(&'s mut self, table: &'s GoalTable, found: &'s mut Found) -> (Goals<'s>, &'s mut [u64], &'s mut [u64], Results<'s>) {
        let goals = Goals { table, parts: self.goals.goal_parts, entries: self.goals.goal_entries };
        (goals, self.marks, self.plan.hashed, Results { found, optimal: self.plan.optimal, distances: self.plan.distances })
    }
}

/// A look at this many cells costs about one expansion.
const CELLS_AN_EXPANSION: usize = 4;
/// To tabulate the goals of this many cells costs about one expansion.
const CELLS_TABULATED_AN_EXPANSION: usize = 2;
/// Clearing this many words costs about one expansion.
const WORDS_AN_EXPANSION: usize = 64;

/// The current search, or the contents that it left in the marks.
#[derive(Clone, Copy, Debug)]
enum Marked {
    /// Unknown contents after this number of words, because the marks were used by others.
    Anything(usize),
    /// Zeros.
    Nothing,
    /// By rows of bits; for the tasks that share the way of this one, if they have ways.
    Rows(RowSearch, Option<u8>),
    /// State by state.
    States(StateSearch, Option<u8>),
    /// By bounds of the distances.
    #[cfg(feature = "bounds")]
    Bounds(Bounds),
}

impl Marked {
    /// Continues to fill the marks with zeros, in about `left` expansions at most. Returns whether it is done.
    #[inline(never)]
    fn clear_on(&mut self, marks: &mut [u64], left: &mut u32) -> bool {
        let mut words = (*left as usize).saturating_mul(WORDS_AN_EXPANSION);
        let is_clear = match self {
            Self::Anything(from) => {
                let rest = marks.get_mut(*from..).unwrap_or(&mut []);
                let part = rest.len().min(words);
                rest.get_mut(..part).unwrap_or(&mut []).fill(0);
                (*from, words) = (from.saturating_add(part), words.saturating_sub(part));
                *from >= marks.len()
            }
            Self::Nothing => return true,
            Self::Rows(rows, _) => rows.clear_on(marks, &mut words),
            Self::States(states, _) => states.clear_on(marks, &mut words),
            #[cfg(feature = "bounds")]
            Self::Bounds(bounds) => {
                bounds.clear(marks);
                true
            }
        };
        if is_clear {
            *self = Self::Nothing;
        }
        *left = (words / WORDS_AN_EXPANSION) as u32;
        is_clear
    }
}

/// The remaining work.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// Plan for the `wanted` tasks; the `dead` ones are dead ends.
    Begin {
        wanted: TaskSet,
        dead: TaskSet,
    },
    /// Fill the table of goals.
    Tabulate,
    /// Find deadlocks.
    RuleOut(Option<Deadlocks>),
    /// Bound the distances; `with_ways` are the tasks with unfinished ways.
    #[cfg(feature = "bounds")]
    Bound {
        with_ways: TaskSet,
    },
    /// Search for the `waiting` tasks; `with_ways` are the tasks with unfinished ways.
    Exact {
        waiting: TaskSet,
        with_ways: TaskSet,
    },
    #[cfg(feature = "approximate")]
    Approximate(Approximation),
    Done,
}

/// Plans for one state after another. It holds no tables: they are lent to each call.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct Planner {
    goals: GoalTable,
    /// The tasks with a way.
    with_ways: TaskSet,
    found: Found,
    /// The tasks that get the most work.
    #[cfg(feature = "bounds")]
    likely: TaskSet,
    stage: Stage,
    marked: Marked,
}

impl Default for Planner {
    fn default() -> Self {
        Self::new()
    }
}

impl Planner {
    /// A planner without tasks.
    pub const fn new() -> Self {
        Self {
            goals: GoalTable::EMPTY,
            with_ways: TaskSet::EMPTY,
            found: Found::NOTHING,
            #[cfg(feature = "bounds")]
            likely: TaskSet::EMPTY,
            stage: Stage::Done,
            marked: Marked::Anything(0),
        }
    }

    /// Sets the tasks to plan for.
    ///
    /// # Errors
    /// A [`CapacityError`] if the tasks' distinct ground propositions do not fit, or if the domain's states do not fit and can
    /// neither be hashed nor planned for approximately. The planner then has no tasks.
    pub fn set_tasks<D: Domain>(
        &mut self,
        tables: &mut PlanTables<'_>,
        domain: &D,
        lifted: &[LiftedTask],
        tasks: &[GroundedTask],
    ) -> Result<(), CapacityError> {
        (self.goals, self.found, self.stage) = (GoalTable::EMPTY, Found::NOTHING, Stage::Done);
        one_by_one::check(domain, tables.marks.len(), tables.plan.hashed.len())?;
        self.goals = GoalTable::list(&mut tables.goals, domain, lifted, tasks)?;
        self.with_ways = Ways { lifted, tasks }.all();
        Ok(())
    }

    /// The number of distinct ground propositions of the tasks.
    pub(crate) fn ground_propositions(&self) -> usize {
        self.goals.parts()
    }

    /// The needs of planning for these tasks: the number of distinct ground propositions, and the number of states for which every plan is
    /// exact.
    ///
    /// # Errors
    /// A [`CapacityError`] if the propositions do not fit into `goals`, or if the states cannot be counted and the domain cannot
    /// be planned for approximately.
    pub(crate) fn needs<D: Domain>(
        goals: &mut GoalMemory<'_>,
        domain: &D,
        lifted: &[LiftedTask],
        tasks: &[GroundedTask],
    ) -> Result<(usize, usize), CapacityError> {
        let table = GoalTable::list(goals, domain, lifted, tasks)?;
        let parts = table.parts();
        let seen = Goals { table: &table, parts: goals.goal_parts, entries: goals.goal_entries };
        let words = D::Search::grid(domain).and_then(|grid| RowSearch::words_needed(grid, &seen, TaskSet::first(tasks.len())));
        let states = words.map(Capacities::states_of).or_else(|| one_by_one::states_needed(domain));
        let states = states.or(D::Search::grid(domain).map(|_| 0));
        // A way has a copy of the world for each of its states.
        let ways = Ways { lifted, tasks };
        let of_way = |task| ways.product(domain, task).and_then(|(product, _)| one_by_one::states_needed(&product));
        let states = states.map(|states| ways.all().iter().filter_map(of_way).fold(states, usize::max));
        Ok((parts, states.ok_or(CapacityError::full(Capacity::HashedStates, 0))?))
    }

    /// Ends the current search, because the marks are lent to others. They may then hold anything.
    pub fn release_marks(&mut self) {
        (self.stage, self.marked) = (Stage::Done, Marked::Anything(0));
    }

    /// Begins a plan for the tasks in `wanted`; those in `dead` are known to be dead ends.
    pub fn begin(&mut self, wanted: TaskSet, dead: TaskSet) {
        (self.found, self.stage) = (Found::NOTHING, Stage::Begin { wanted, dead });
        #[cfg(feature = "bounds")]
        {
            self.likely = wanted;
        }
    }

    /// Call after [`begin`](Self::begin): these tasks are likely. Among more than 64 tasks, the others get little work if the states do not
    /// fit.
    #[cfg(feature = "bounds")]
    pub fn expect(&mut self, likely: TaskSet) {
        self.likely = likely;
    }

    /// Continues, with at most about `budget` expansions (at least one). `state` is the planned state, the same in all calls.
    #[inline(never)]
    pub fn advance<D: Domain>(&mut self, tables: &mut PlanTables<'_>, domain: &D, state: &D::State, budget: u32) -> Progress {
        let mut left = budget.max(1);
        // The expansions that a look at every cell of a floor costs.
        let of_floor = D::Search::grid(domain).map_or(1, |grid| grid.floor().cells.len() as u32);
        while !self.is_done() {
            let is_search = !self.found.sought.is_empty();
            #[cfg(feature = "bounds")]
            if let Stage::Bound { .. } = self.stage
                && left > 0
            {
                self.bound(tables, domain, state, &mut left);
                continue;
            }
            let is_part = match &self.stage {
                Stage::Tabulate | Stage::RuleOut(_) => true,
                _ => is_search,
            };
            // A step that cannot be split is left to the next call, unless nothing was done in this one.
            if left == 0 || (!is_part && left < of_floor.min(budget)) {
                return Progress::Working;
            }
            if is_search {
                self.search(tables, domain, state, &mut left);
                continue;
            }
            match self.stage {
                Stage::Begin { .. } if !self.marked.clear_on(tables.marks, &mut left) => continue,
                Stage::Begin { wanted, dead } => self.look(tables, domain, state, wanted, dead),
                Stage::Tabulate => {
                    left = left.saturating_sub(self.tabulate(tables, domain, state, left));
                    continue;
                }
                Stage::RuleOut(deadlocks) => {
                    self.rule_out(tables, domain, state, deadlocks, &mut left);
                    continue;
                }
                #[cfg(feature = "approximate")]
                Stage::Approximate(_) => {
                    self.next_approximate(tables, domain, &mut left);
                    continue;
                }
                #[cfg(feature = "bounds")]
                Stage::Bound { .. } => {}
                _ => self.next_search(tables, domain, state, &mut left),
            }
            left = left.saturating_sub(of_floor);
        }
        Progress::Done
    }

    /// Finds the results that need no search.
    #[inline(never)]
    fn look<D: Domain>(&mut self, tables: &mut PlanTables<'_>, domain: &D, state: &D::State, wanted: TaskSet, dead: TaskSet) {
        tables.plan.optimal.fill(ActionSet::EMPTY);
        tables.plan.distances.fill(u32::MAX);
        let ways = tables.ways;
        // A task whose way is not given must not be planned as one without a way.
        let wanted = wanted.without(self.with_ways.without(ways.all()));
        let goals = Goals { table: &self.goals, parts: tables.goals.goal_parts, entries: tables.goals.goal_entries };
        self.found = Found::at(domain, &goals, state, wanted, dead.union(ways.broken(wanted)), ways.open(wanted));
        self.stage = if self.found.unknown.is_empty() { Stage::Done } else { Stage::Tabulate };
    }

    /// Continues the table of goals, if there is one to fill. Returns its work, in expansions.
    #[inline(never)]
    fn tabulate<D: Domain>(&mut self, tables: &mut PlanTables<'_>, domain: &D, state: &D::State, left: u32) -> u32 {
        let entries = tables.goals.goal_entries.len();
        let Some(grid) = D::Search::grid(domain).filter(|grid| self.goals.is_to_tabulate(entries, *grid)) else {
            self.stage = Stage::RuleOut(None);
            return 0;
        };
        let cells = self.goals.tabulate(&mut tables.goals, grid, state, (left as usize).saturating_mul(CELLS_TABULATED_AN_EXPANSION));
        cells.div_ceil(CELLS_TABULATED_AN_EXPANSION) as u32
    }

    /// Continues to find the deadlocks. All remaining tasks wait for an exact search.
    #[inline(never)]
    fn rule_out<D: Domain>(
        &mut self,
        tables: &mut PlanTables<'_>,
        domain: &D,
        state: &D::State,
        deadlocks: Option<Deadlocks>,
        left: &mut u32,
    ) {
        let ways = tables.ways;
        let (goals, marks, _, results) = tables.split(&self.goals, &mut self.found);
        if let Some(grid) = D::Search::grid(domain) {
            let mut deadlocks = deadlocks.unwrap_or(Deadlocks::of(results.found.unknown));
            let mut cells = left.saturating_mul(CELLS_AN_EXPANSION as u32);
            let possible = deadlocks.advance(grid, &goals, state, marks, &mut cells);
            *left = cells / CELLS_AN_EXPANSION as u32;
            let Some(possible) = possible else {
                (self.stage, self.marked) = (Stage::RuleOut(Some(deadlocks)), Marked::Anything(0));
                return;
            };
            self.marked = Marked::Nothing;
            results.found.rule_out(results.found.unknown.without(possible));
        }
        let waiting = results.found.unknown;
        let with_ways = ways.open(waiting);
        self.stage = Stage::Exact { waiting, with_ways };
        #[cfg(feature = "bounds")]
        if let Some(grid) = D::Search::grid(domain) {
            let plain = waiting.without(with_ways);
            let is_crowded = self.goals.all.len() > TaskSet::MOST_OF_ONE_WORD;
            let likely = if is_crowded { self.likely } else { plain };
            let fits =
                StateSearch::fits(domain, marks.len()) || RowSearch::layout(grid, &goals, plain, View::WHOLE, None, marks.len()).is_some();
            if let Some(bounds) = Bounds::new(grid, plain, likely).filter(|_| !fits) {
                (self.marked, self.stage) = (Marked::Bounds(bounds), Stage::Bound { with_ways });
            }
        }
    }

    /// Continues the bounds of distances. Tasks that stay open wait for an exact search.
    #[cfg(feature = "bounds")]
    #[inline(never)]
    fn bound<D: Domain>(&mut self, tables: &mut PlanTables<'_>, domain: &D, state: &D::State, left: &mut u32) {
        let (Stage::Bound { with_ways }, Marked::Bounds(bounds)) = (self.stage, &mut self.marked) else { return };
        let before = *left;
        let (goals, marks, _, mut results) = tables.split(&self.goals, &mut self.found);
        let is_open = D::Search::grid(domain).is_some_and(|grid| bounds.advance(marks, &mut results, grid, &goals, state, left));
        self.found.expansions = self.found.expansions.saturating_add(before.saturating_sub(*left));
        if !is_open {
            self.stage = Stage::Exact { waiting: self.found.unknown, with_ways };
        }
    }

    /// Continues the current search. It ends once it seeks no task.
    fn search<D: Domain>(&mut self, tables: &mut PlanTables<'_>, domain: &D, state: &D::State, left: &mut u32) {
        let ways = tables.ways;
        let (goals, marks, hashed, mut results) = tables.split(&self.goals, &mut self.found);
        while *left > 0 {
            if let (Marked::Rows(rows, task), Some(grid)) = (&mut self.marked, D::Search::grid(domain))
                && !rows.is_laid_out()
            {
                let product = task.and_then(|task| ways.product(domain, usize::from(task)));
                let way = product.as_ref().map(|(product, now)| (product.way(), *now));
                let cells = rows.lay_out(grid, &goals, state, way, marks, (*left as usize).saturating_mul(CELLS_AN_EXPANSION));
                *left = left.saturating_sub(cells.div_ceil(CELLS_AN_EXPANSION) as u32);
                if rows.is_laid_out() {
                    rows.open_first(grid, state, way, marks, results.found.applicable);
                }
                continue;
            }
            let expansions = match &mut self.marked {
                Marked::Rows(rows, _) => D::Search::grid(domain).and_then(|grid| rows.expand(marks, &mut results, grid, &goals, state)),
                Marked::States(states, None) => states.expand(marks, hashed, &mut results, domain, &goals),
                Marked::States(states, Some(task)) => ways
                    .product(domain, usize::from(*task))
                    .and_then(|(product, _)| states.expand(marks, hashed, &mut results, &product, &goals)),
                _ => None,
            };
            if let Some(expansions) = expansions {
                let work = if let Marked::States(states, _) = &self.marked { states.work() } else { 1 };
                *left = left.saturating_sub(expansions.saturating_mul(work));
                results.found.expansions = results.found.expansions.saturating_add(expansions);
                continue;
            }
            #[cfg(feature = "approximate")]
            if let Stage::Approximate(_) = self.stage {
                results.found.approximate = results.found.approximate.union(results.found.met);
            }
            results.end_level();
            let ahead = match &mut self.marked {
                Marked::Rows(rows, _) => rows.next_level(),
                Marked::States(states, _) => states.next_level(results.found.level),
                _ => false,
            };
            if !ahead || results.found.sought.is_empty() {
                results.found.sought = TaskSet::EMPTY;
                return;
            }
        }
    }

    /// Begins the next search after the current one has ended, if one is left.
    #[inline(never)]
    fn next_search<D: Domain>(&mut self, tables: &mut PlanTables<'_>, domain: &D, state: &D::State, left: &mut u32) {
        if let Stage::Exact { waiting, with_ways } = self.stage {
            let searched = match &self.marked {
                Marked::Rows(_, way) => Some(*way),
                Marked::States(states, way) => Some(*way).filter(|_| states.is_complete()),
                _ => None,
            };
            if let Some(way) = searched {
                let group =
                    way.map_or(TaskSet::first(TaskSet::MOST).without(with_ways), |task| tables.ways.group(usize::from(task), with_ways));
                self.found.rule_out(group.common(self.found.unknown));
            }
            if !waiting.is_empty() && !self.marked.clear_on(tables.marks, left) {
                return;
            }
            if self.next_exact(tables, domain, state, waiting, with_ways).is_some() {
                return;
            }
            #[cfg(feature = "approximate")]
            {
                // The remaining tasks with ways stay unknown.
                self.stage = Stage::Approximate(Approximation::new(self.found.unknown.without(with_ways)));
                return;
            }
        }
        self.stage = Stage::Done;
    }

    /// Continues to the next approximate search; planning is done if none is left.
    #[cfg(feature = "approximate")]
    #[inline(never)]
    fn next_approximate<D: Domain>(&mut self, tables: &mut PlanTables<'_>, domain: &D, left: &mut u32) {
        let open = self.found.unknown.without(tables.ways.open(self.found.unknown));
        let (Stage::Approximate(approximation), Some(grid), false) = (&mut self.stage, D::Search::grid(domain), open.is_empty()) else {
            self.stage = Stage::Done;
            return;
        };
        if !matches!(self.marked, Marked::Nothing) {
            self.marked.clear_on(tables.marks, left);
            return;
        }
        let (goals, marks, _, results) = tables.split(&self.goals, &mut self.found);
        match approximation.next(grid, &goals, open, marks.len(), left) {
            None => self.stage = Stage::Done,
            Some(None) => {}
            Some(Some((tasks, rows))) => {
                (results.found.level, results.found.sought) = (0, tasks);
                self.marked = Marked::Rows(rows, None);
            }
        }
    }

    /// Begins the exact search for the tasks without a way, or else for those that share the way of the first; `None` if none is left.
    #[inline(never)]
    fn next_exact<D: Domain>(
        &mut self,
        tables: &mut PlanTables<'_>,
        domain: &D,
        state: &D::State,
        waiting: TaskSet,
        with_ways: TaskSet,
    ) -> Option<()> {
        let (first, ways) = (waiting.iter().next()?, tables.ways);
        let plain = waiting.without(with_ways);
        let way = if plain.is_empty() { Some(ways.product(domain, first)?) } else { None };
        let group = if plain.is_empty() { ways.group(first, waiting) } else { plain };
        self.stage = Stage::Exact { waiting: waiting.without(group), with_ways };
        let (goals, marks, hashed, results) = tables.split(&self.goals, &mut self.found);
        (results.found.level, results.found.sought) = (0, group);
        let applicable = results.found.applicable;
        let rows = D::Search::grid(domain).and_then(|grid| {
            RowSearch::layout(grid, &goals, group, View::WHOLE, way.as_ref().map(|(product, _)| product.way()), marks.len())
        });
        let task = way.as_ref().map(|_| first as u8);
        self.marked = match (rows, &way) {
            (Some(rows), _) => Marked::Rows(rows, task),
            // States without numbers are not searched one by one: the marks stay clear.
            _ if D::Search::grid(domain).is_some_and(|grid| !grid.is_numbered()) => {
                results.found.sought = TaskSet::EMPTY;
                Marked::Nothing
            }
            (None, None) => Marked::States(StateSearch::begin(domain, state, marks, hashed, applicable), task),
            (None, Some((product, now))) => Marked::States(StateSearch::begin(product, &(*state, *now), marks, hashed, applicable), task),
        };
        Some(())
    }

    /// Whether planning is complete.
    pub fn is_done(&self) -> bool {
        matches!(self.stage, Stage::Done)
    }

    /// A state that an action leads to although the domain did not count it, if the search met one.
    pub fn stray(&self) -> Option<Stray> {
        match &self.marked {
            Marked::States(states, _) => states.stray(),
            _ => None,
        }
    }

    /// The tasks among `asked` whose goals hold in a state; for tasks whose ways are finished.
    pub(crate) fn satisfied<D: Domain>(&self, goals: GoalMemoryRef<'_>, domain: &D, state: &D::State, asked: TaskSet) -> TaskSet {
        Goals { table: &self.goals, parts: goals.goal_parts, entries: goals.goal_entries }.satisfied(domain, state, asked)
    }

    /// The results for each task, from the tables that planning wrote.
    pub fn plan<'t>(&'t self, optimal: &'t [ActionSet], distances: &'t [u32]) -> Plan<'t> {
        Plan { found: &self.found, optimal, distances }
    }
}
