//! Plans for memories that cannot hold even the robot and one block in the whole home: region by region.
//!
//! A block's way to the goal is first looked for as if the robot were wherever it has to be. Then one search moves the robot and that
//! block within a window of regions (in a home, its rooms and doors): those of the two, those on the block's way for as long as they fit the memory, and
//! then what lies around. The block is to come to the goal where that is in the window, else to the last place of its way there. Where the
//! robot is too far off for one window, it first goes behind the block, on its own; where the window has no way, too, and then the block is
//! pushed by one place. All other blocks stand still. Such a plan is good for the next action, not for the whole way: its distance is that to
//! where it ends.

use super::Progress;
use super::confined::{Confined, Leg, RegionSet};
use super::goals::{GoalMemory, GoalPart, GoalTable};
use super::search::Search;
use super::standing::{Moving, Standing};
use super::trail;
use crate::oomdp::Domain;
use crate::task::TaskSet;

/// Plans made for one task after another.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Regions {
    /// The tasks not looked at yet.
    waiting: TaskSet,
    /// The tasks without a plan.
    left: TaskSet,
    /// The task under way.
    under_way: Option<usize>,
    leg: Leg,
    /// Whether there is nothing else to try.
    last: bool,
}

impl Regions {
    /// Begins for the tasks that `search` has not resolved at its state.
    #[inline(never)]
    pub(super) fn begin<D: Domain + ?Sized>(&mut self, search: &mut Search<'_>, domain: &D, goals: &GoalTable<'_>, state: &D::State) {
        let all = search.unknown();
        let too_large = |&task: &usize| {
            let read = goals.variables_of(domain, task);
            read.is_some_and(|read| {
                let moving = Moving(Moving::own(domain).0 | read);
                !search.fits(&Standing { domain, moving, now: state }, goals, TaskSet::of(task))
            })
        };
        let waiting = all.iter().filter(too_large).fold(TaskSet::EMPTY, |set, task| set.union(TaskSet::of(task)));
        *self = Self { waiting, left: all.without(waiting), ..Self::default() };
    }

    /// Goes on, with about `budget` looks.
    #[inline(never)]
    pub(super) fn advance<D: Domain + ?Sized>(
        &mut self,
        search: &mut Search<'_>,
        domain: &D,
        goals: &GoalTable<'_>,
        state: &D::State,
        budget: u32,
    ) -> Progress {
        let (before, mut spent) = (search.looks(), 0_u32);
        loop {
            let Some(task) = self.under_way else {
                if self.waiting.is_empty() {
                    break;
                }
                if spent > 0 && spent.wrapping_add(search.looks().wrapping_sub(before)) >= budget {
                    return Progress::Working;
                }
                // To find a window takes a few looks at each place.
                spent = spent.saturating_add(domain.values(0) as u32).max(1);
                self.next_task(search, domain, goals, state);
                continue;
            };
            let left = budget.saturating_sub(spent.saturating_add(search.looks().wrapping_sub(before))).max(1);
            let tasks = TaskSet::of(task);
            let mut part = [GoalPart::UNUSED];
            let there = GoalTable::of_domain(GoalMemory { parts: &mut part, entries: &mut [] }, tasks);
            if search.advance(&Confined { domain, goals, now: state, leg: self.leg }, &there, left) == Progress::Working {
                return Progress::Working;
            }
            let missed = search.end_part(tasks, false);
            if !missed.is_empty() && !self.last && self.step_by_step(search, domain, goals, state, task) {
                continue;
            }
            self.left = self.left.union(missed);
            self.under_way = None;
        }
        search.leave_unknown(self.left);
        Progress::Done
    }

    /// Takes the next task, if a window can be found for it.
    fn next_task<D: Domain + ?Sized>(&mut self, search: &mut Search<'_>, domain: &D, goals: &GoalTable<'_>, state: &D::State) {
        let Some(task) = self.waiting.iter().next() else { return };
        self.waiting = self.waiting.without(TaskSet::of(task));
        match (View { domain, goals, state, task }).leg(search) {
            Some(leg) => self.start(search, domain, goals, state, task, leg),
            None => self.left = self.left.union(TaskSet::of(task)),
        }
    }

    #[inline(never)]
    fn start<D: Domain + ?Sized>(
        &mut self,
        search: &mut Search<'_>,
        domain: &D,
        goals: &GoalTable<'_>,
        state: &D::State,
        task: usize,
        leg: Leg,
    ) {
        (self.under_way, self.leg, self.last) = (Some(task), leg, leg.subject == 0);
        let mut part = [GoalPart::UNUSED];
        let there = GoalTable::of_domain(GoalMemory { parts: &mut part, entries: &mut [] }, TaskSet::of(task));
        search.begin_part(&Confined { domain, goals, now: state, leg }, &there, state, TaskSet::of(task));
    }

    /// Where a block cannot be brought on within its window, the robot may have to go round by other regions: it goes to the place behind
    /// the block, or pushes it to the next place where it is there.
    fn step_by_step<D: Domain + ?Sized>(
        &mut self,
        search: &mut Search<'_>,
        domain: &D,
        goals: &GoalTable<'_>,
        state: &D::State,
        task: usize,
    ) -> bool {
        let view = View { domain, goals, state, task };
        let leg = view.first_push(search, self.leg.subject).and_then(|push| view.one_step(search, self.leg.subject, push));
        leg.is_some_and(|leg| {
            self.start(search, domain, goals, state, task, leg);
            self.last = true;
            true
        })
    }
}

/// What is planned for.
struct View<'d, 'g, D: Domain + ?Sized> {
    domain: &'d D,
    goals: &'d GoalTable<'g>,
    state: &'d D::State,
    task: usize,
}

impl<D: Domain + ?Sized> View<'_, '_, D> {
    /// What is to be done next for the task.
    fn leg(&self, search: &mut Search<'_>) -> Option<Leg> {
        let read = Moving(self.goals.variables_of(self.domain, self.task)?);
        let asks = |&variable: &usize| read.contains(variable) && !self.is_goal(variable, self.value(variable));
        // Blocks first: the robot's own place changes as it moves them.
        let subject = (0..self.domain.variables()).rev().find(asks)?;
        let (here, robot) = (self.region(self.value(subject))?, self.region(self.value(0))?);
        let mut start = here.union(robot);
        if here != robot
            && let Some((behind, _)) = self.first_push(search, subject)
            && self.trail(search, 0, Some(behind))
        {
            let scratch = search.scratch();
            let regions = trail::places(scratch, self.value(0)).filter_map(|place| self.region(place));
            let near = regions.fold(start, RegionSet::union);
            trail::clear(search.scratch(), self.places());
            if !self.fits(search, subject, near) {
                return self.approach(search, behind);
            }
            start = near;
        }
        let leg = Leg { subject, window: start, task: self.task, place: None };
        let found = self.trail(search, subject, None);
        let leg = if found { self.along(search, leg) } else { None };
        trail::clear(search.scratch(), self.places());
        leg
    }

    /// The robot goes to a place on its own.
    #[inline(never)]
    fn approach(&self, search: &mut Search<'_>, to: usize) -> Option<Leg> {
        let leg = Leg { subject: 0, window: self.region(self.value(0))?, task: self.task, place: Some(to) };
        let found = self.value(0) != to && self.trail(search, 0, Some(to));
        let leg = if found { self.along(search, leg) } else { None };
        trail::clear(search.scratch(), self.places());
        leg
    }

    #[inline(never)]
    fn one_step(&self, search: &mut Search<'_>, block: usize, (behind, next): (usize, usize)) -> Option<Leg> {
        if self.value(0) != behind {
            return self.approach(search, behind);
        }
        let regions = [behind, self.value(block), next].map(|place| self.region(place).unwrap_or_default());
        let window = regions.into_iter().fold(RegionSet::default(), RegionSet::union);
        self.fits(search, block, window).then_some(Leg { subject: block, window, task: self.task, place: Some(next) })
    }

    /// The place from which the robot pushes a block on its way, and the place to which.
    #[inline(never)]
    fn first_push(&self, search: &mut Search<'_>, block: usize) -> Option<(usize, usize)> {
        let found = self.trail(search, block, None);
        let (here, next) = (self.value(block), trail::next(search.scratch(), self.value(block)));
        trail::clear(search.scratch(), self.places());
        let next = next.filter(|_| found)?;
        let way = (0..self.domain.ways_on()).find(|&way| self.domain.way_on(block, here, way) == Some(next))?;
        let behind = (0..self.places()).find(|&place| self.domain.way_on(0, place, way) == Some(here))?;
        Some((behind, next))
    }

    /// The leg along the trail of its subject, in as large a window as fits: on along the trail, then around.
    #[inline(never)]
    fn along(&self, search: &mut Search<'_>, leg: Leg) -> Option<Leg> {
        let Leg { subject, mut window, .. } = leg;
        if !self.fits(search, subject, window) {
            return None;
        }
        let from = self.value(subject);
        let mut last = from;
        while let Some(next) = trail::next(search.scratch(), last) {
            let larger = self.region(next)?.union(window);
            if larger != window && !self.fits(search, subject, larger) {
                break;
            }
            (window, last) = (larger, next);
        }
        let arrives = trail::next(search.scratch(), last).is_none();
        if last == from {
            return None;
        }
        loop {
            let before = window;
            for place in 0..self.places() {
                if self.region(place).is_none_or(|region| region.union(before) != before) {
                    continue;
                }
                for way in 0..self.domain.ways_on() {
                    let beside = self.domain.way_on(0, place, way).and_then(|next| self.region(next));
                    let larger = beside.map_or(window, |beside| beside.union(window));
                    if larger != window && self.fits(search, subject, larger) {
                        window = larger;
                    }
                }
            }
            if window == before {
                break;
            }
        }
        Some(Leg { window, place: if arrives { leg.place } else { Some(last) }, ..leg })
    }

    /// Finds a way for one variable alone, around what stands still: to a place, or to wherever the task asks it to be.
    #[inline(never)]
    fn trail(&self, search: &mut Search<'_>, variable: usize, to: Option<usize>) -> bool {
        let others = (1..self.domain.variables()).filter(|&other| other != variable);
        let taken = |place: usize| others.clone().any(|other| self.value(other) == place);
        let ways = self.domain.ways_on();
        let beside = |place: usize| (0..ways).filter_map(move |way| self.domain.way_on(variable, place, way)).filter(|&next| !taken(next));
        let is_goal = |place: usize| to.map_or_else(|| self.is_goal(variable, place), |to| place == to);
        trail::find(search.scratch(), self.places(), self.value(variable), beside, is_goal)
    }

    #[inline(never)]
    fn is_goal(&self, variable: usize, place: usize) -> bool {
        let there = self.domain.with_value(self.state, variable, place);
        self.goals.not_ruled_out(self.domain, &there, variable).contains(self.task)
    }

    #[inline(never)]
    fn fits(&self, search: &Search<'_>, subject: usize, window: RegionSet) -> bool {
        let leg = Leg { subject, window, task: self.task, place: None };
        search.fits(&Confined { domain: self.domain, goals: self.goals, now: self.state, leg }, self.goals, TaskSet::EMPTY)
    }

    fn places(&self) -> usize {
        self.domain.values(0)
    }

    fn value(&self, variable: usize) -> usize {
        self.domain.value(self.state, variable)
    }

    #[inline(never)]
    fn region(&self, place: usize) -> Option<RegionSet> {
        self.domain.region_of(place).map(|(region, _)| RegionSet::of(region))
    }
}
