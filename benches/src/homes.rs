//! The homes that plans are measured in, with their tasks.

use goodbot::Capacities;
use goodbot::home::{Home, HomeState, Moves, SCHEMA};
use goodbot::memory::HomeHeap;
use goodbot::oomdp::Domain;
use goodbot::planning::Plan;
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, ground};
use goodbot_tests::own_planner::OwnPlanner;
use goodbot_tests::random_homes::{Size, random_home};
use goodbot_tests::sweep::Sweep;
use rand_pcg::Pcg32;

/// Room for four million states looked at one by one.
pub const LARGE: Capacities = Capacities { states: 1 << 22, hashed_states: 1 << 20, ..Capacities::STANDARD };

/// A home of this many rooms and blocks, in words.
pub fn named(rooms: i32, blocks: i32) -> String {
    format!("{rooms} rooms, {blocks} block{}", if blocks == 1 { "" } else { "s" })
}

/// A home of this many rooms, three cells to a side, and blocks.
pub const fn size(rooms: i32, blocks: i32) -> Size {
    let columns = if rooms > 3 { rooms / 2 } else { rooms };
    Size { columns, rows: rooms / columns, side: 3, blocks }
}

/// A home with tasks and what plans for them.
#[derive(Debug)]
pub struct Scene {
    /// The home.
    pub home: Home<HomeHeap>,
    /// Where all begins.
    pub start: HomeState,
    /// The lifted tasks.
    pub lifted: Vec<LiftedTask>,
    /// The tasks.
    pub tasks: Vec<GroundedTask>,
    /// What plans.
    pub planner: OwnPlanner,
}

/// Which tasks a scene has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tasks {
    /// The paper's two kinds, all of them.
    Paper,
    /// This many, evenly taken from the first 64, or as many as are asked for, of the paper's and those of agent and block together.
    Count(usize),
}

impl Scene {
    /// Of twelve scenes, the one from whose start the search has most to do; the first where exact plans are out of reach.
    pub fn roomy(size: Size, tasks: Tasks) -> Self {
        let expansions = |seed: u64| {
            let mut scene = Self::seeded(seed, size, tasks);
            if scene.home.state_count() > LARGE.states as u64 {
                return 0;
            }
            scene.plan().expansions()
        };
        Self::seeded((0..12).max_by_key(|&seed| (expansions(seed), 12 - seed)).unwrap_or(0), size, tasks)
    }

    /// The scene of a seed.
    pub fn seeded(seed: u64, size: Size, tasks: Tasks) -> Self {
        let (home, start) = random_home(&mut Pcg32::new(seed, 3), size, Moves::Push, HomeHeap::new(&LARGE));
        let mut texts = vec!["agentInRoom(?a, ?r)", "blockInRoom(?o, ?r)"];
        if tasks != Tasks::Paper {
            texts.push("agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2)");
        }
        let lifted: Vec<LiftedTask> = texts.iter().map(|text| LiftedTask::parse(text, &SCHEMA).expect("a lifted task")).collect();
        let mut all = [GroundedTask::UNUSED; TaskSet::MOST];
        let mut grounded = Vec::new();
        // More tasks than there can be are refused as a whole, so each kind is grounded alone.
        for (kind, lifted) in lifted.iter().enumerate() {
            let count = ground(&home, std::slice::from_ref(lifted), &start, &mut all).unwrap_or(TaskSet::MOST);
            grounded.extend(all.iter().take(count).map(|task| GroundedTask { lifted: kind as u8, ..*task }));
        }
        if let Tasks::Count(count) = tasks {
            grounded.truncate(count.max(64));
            grounded = grounded.iter().step_by((grounded.len() / count).max(1)).take(count).copied().collect();
        }
        let planner = OwnPlanner::new(&LARGE, &home, &lifted, &grounded);
        Self { home, start, lifted, tasks: grounded, planner }
    }

    /// Plans at its start for all its tasks.
    pub fn plan(&mut self) -> Plan<'_> {
        let all = self.planner.all();
        self.planner.plan_for(&self.home, &self.start, all, u32::MAX)
    }

    /// Sweeps its whole state space.
    pub fn sweep(&self) -> Sweep {
        Sweep::new(&self.home, &self.start, &self.lifted, &self.tasks)
    }
}
