//! Optimal sets against brute force, in random homes and for robots whose actions cost 1 to 5, and up to 255.

use goodbot::home::{self, Moves};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{
    Action, ActionKind, ActionSet, BitRows, CellId, Domain, Floor, GroundProposition, MOST_COST, MOST_COST_ON_CONTROLLERS, OneByOne, Piece,
    PropositionId, PushGrid, World,
};
use goodbot::planning::OptimalSet;
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, ground};
use goodbot::{Capacities, HeapMemory};
use goodbot_tests::brute_force::BruteForce;
use goodbot_tests::own_planner::OwnPlanner;
use goodbot_tests::random_homes::{Size, below, random_home};
use goodbot_tests::sweep::Sweep;
use goodbot_tests::turning_robot::TurningRobot;
use rand_pcg::Pcg32;

const ROOMY: Capacities = Capacities { states: 1 << 15, hashed_states: 1 << 15, ..Capacities::STANDARD };

/// Compares the optimal sets of all tasks that `start` permits, in every `every`th state. Returns how many were compared.
fn compare<D: Domain>(domain: &D, start: &D::State, lifted: &[LiftedTask], every: usize) -> usize {
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(domain, lifted, start, &mut tasks).unwrap();
    compare_all(domain, start, lifted, &tasks[..count], every)
}

/// The same for these tasks.
fn compare_all<D: Domain>(domain: &D, start: &D::State, lifted: &[LiftedTask], tasks: &[GroundedTask], every: usize) -> usize {
    // The higher the costs, the more room a state takes.
    let is_dear = domain.actions().iter().any(|kind| kind.cost > MOST_COST_ON_CONTROLLERS);
    let roomy = Capacities { states: if is_dear { 1 << 18 } else { ROOMY.states }, ..ROOMY };
    let count = tasks.len();
    let truth = BruteForce::new(domain, start, lifted, tasks);
    // A sweep has no room for state numbers that lie far apart.
    let sweep = (domain.state_count() < 1 << 24).then(|| Sweep::new(domain, start, lifted, tasks));
    let (mut planner, mut compared) = (OwnPlanner::new(&roomy, domain, lifted, tasks), 0);
    for (position, state) in truth.states.iter().enumerate().step_by(every) {
        let plan = planner.plan_for(domain, state, TaskSet::first(count), 100);
        assert!(plan.unknown().is_empty() && plan.approximate().is_empty());
        for task in 0..count {
            assert_eq!(plan.optimal(task), truth.optimal(position, task), "search, state {position}, task {task}");
            assert_eq!(plan.distance(task), truth.distances[task][position]);
            let Some(sweep) = &sweep else { continue };
            let toward = match truth.optimal(position, task) {
                OptimalSet::Toward(actions) => actions,
                _ => ActionSet::EMPTY,
            };
            assert_eq!(sweep.toward(domain, state, task), toward, "sweep, state {position}, task {task}");
            assert_eq!(sweep.distance(domain, state, task), truth.distances[task][position]);
        }
        compared += count;
    }
    compared
}

#[test]
fn search_and_sweep_give_the_optimal_sets_of_brute_force_in_random_homes() {
    let mut random = Pcg32::new(7, 7);
    let pairs = LiftedTask::parse("agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2)", &home::SCHEMA).unwrap();
    let [agent, block] = home::paper_tasks().unwrap();
    for round in 0..12 {
        let mut memory = HeapMemory::new(&ROOMY);
        let size =
            Size { columns: 2 + round % 2, rows: 1 + round / 9, side: 2 + round % 2, blocks: 1 + i32::from(round % 3 == 0 && round < 9) };
        let moves = if round % 2 == 0 { Moves::Push } else { Moves::PushAndPull };
        let (home, start) = random_home(&mut random, size, moves, &mut memory.home);
        let lifted = [agent.clone(), block.clone(), pairs.clone()];
        let compared = compare(&home, &start, &lifted, 7);
        assert!(compared > 0, "{size:?}");
    }
}

/// The tasks that a home permits, and the opposite of each.
fn with_opposites<D: Domain>(domain: &D, start: &D::State, lifted: &[LiftedTask]) -> Vec<GroundedTask> {
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(domain, lifted, start, &mut tasks).unwrap();
    let opposite = |task: &GroundedTask| task.negated(&lifted[usize::from(task.lifted)]).unwrap();
    tasks[..count].iter().flat_map(|task| [*task, opposite(task)]).collect()
}

#[test]
fn what_shall_not_be_is_planned_as_exactly_as_what_shall() {
    let (mut random, lifted, mut reached) = (Pcg32::new(9, 9), home::paper_tasks().unwrap(), 0);
    for round in 0..8 {
        let mut memory = HeapMemory::new(&ROOMY);
        let size = Size { columns: 2 + round % 2, rows: 1 + round / 6, side: 2 + round % 2, blocks: 1 + i32::from(round % 4 == 0) };
        let moves = if round % 2 == 0 { Moves::Push } else { Moves::PushAndPull };
        let (home, start) = random_home(&mut random, size, moves, &mut memory.home);
        let tasks = with_opposites(&home, &start, &lifted);
        assert!(compare_all(&home, &start, &lifted, &tasks, 5) > 0, "{size:?}");
        // With little memory the planner may answer `Unknown`, but is never wrong.
        let truth = BruteForce::new(&home, &start, &lifted, &tasks);
        for states in [64, 256, 1_024] {
            let little = Capacities { states, hashed_states: 64, ..ROOMY };
            let mut planner = OwnPlanner::new(&little, &home, &lifted, &tasks);
            for (position, state) in truth.states.iter().enumerate().step_by(11) {
                let plan = planner.plan_for(&home, state, TaskSet::first(tasks.len()), 100);
                for (task, it) in tasks.iter().enumerate() {
                    let (found, known) = (plan.optimal(task), truth.optimal(position, task));
                    assert!(found.exact().is_none() || found == known, "{found:?} is {known:?}: {it:?}");
                    reached += usize::from(found.exact().is_some() && it.is_negated());
                }
            }
        }
    }
    assert!(reached > 1_000, "{reached}");
}

/// The tasks of the robot and of the crate.
fn robot_tasks(robot: &TurningRobot<'_>) -> [LiftedTask; 2] {
    [0, 1].map(|proposition| LiftedTask::single(PropositionId::new(proposition), &robot.world().schema).unwrap())
}

#[test]
fn actions_of_different_costs_hashed_or_not_give_the_optimal_sets_of_brute_force() {
    let mut random = Pcg32::new(8, 8);
    for round in 0..8 {
        let mut memory = HeapMemory::new(&ROOMY);
        let blocked = vec![2 + below(&mut random, 9), 12 + below(&mut random, 11)];
        let mut robot = TurningRobot::new(5, blocked, vec![24, 1 + below(&mut random, 20), 20], memory.home.lend().objects);
        if round % 2 == 1 {
            robot.gap = 1_000_003;
        }
        let start = robot.start(0, 7);
        compare(&robot, &start, &robot_tasks(&robot), 41);
    }
}

/// A robot with other costs.
struct Dear<'d, D> {
    robot: &'d D,
    actions: Vec<ActionKind<'d>>,
}

impl<D: Domain> Domain for Dear<'_, D> {
    type State = D::State;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        self.robot.world()
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        &self.actions
    }

    fn step(&self, state: &D::State, action: Action) -> Option<D::State> {
        self.robot.step(state, action)
    }

    fn holds(&self, proposition: &GroundProposition, state: &D::State) -> bool {
        self.robot.holds(proposition, state)
    }

    fn state_count(&self) -> u64 {
        self.robot.state_count()
    }

    fn number(&self, state: &D::State) -> u64 {
        self.robot.number(state)
    }

    fn numbered(&self, number: u64) -> D::State {
        self.robot.numbered(number)
    }
}

#[test]
fn costs_up_to_the_most_hashed_or_not_give_the_optimal_sets_of_brute_force() {
    let mut random = Pcg32::new(10, 10);
    for round in 0..8 {
        let mut memory = HeapMemory::new(&ROOMY);
        let blocked = vec![2 + below(&mut random, 9), 12 + below(&mut random, 11)];
        let mut robot = TurningRobot::new(5, blocked, vec![24, 1 + below(&mut random, 20), 20], memory.home.lend().objects);
        if round % 2 == 1 {
            robot.gap = 1_000_003;
        }
        let start = robot.start(0, 7);
        let mut cost = || (1 + below(&mut random, i32::from(MOST_COST))) as u8;
        let mut actions: Vec<ActionKind<'_>> = robot.actions().iter().map(|kind| ActionKind::new(kind.name, cost())).collect();
        // Both ends of the ring of open distances.
        actions.iter_mut().zip([MOST_COST, 1]).for_each(|(kind, cost)| kind.cost = cost);
        let dear = Dear { robot: &robot, actions };
        compare(&dear, &start, &robot_tasks(&robot), 41);
    }
}

/// A home with costs of its own, where a piece's cell may decide no proposition. Actions beyond the home's do what its last one does.
struct Unlike<'d, D: Domain> {
    home: &'d D,
    actions: Vec<ActionKind<'d>>,
    tells_pieces: bool,
}

impl<D: PushGrid> Domain for Unlike<'_, D> {
    type State = D::State;
    type Search = BitRows;

    fn world(&self) -> World<'_> {
        self.home.world()
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        &self.actions
    }

    fn step(&self, state: &D::State, action: Action) -> Option<D::State> {
        let last = self.home.actions().len() - 1;
        self.home.step(state, Action::new(action.index().min(last) as u8))
    }

    fn holds(&self, proposition: &GroundProposition, state: &D::State) -> bool {
        self.home.holds(proposition, state)
    }

    fn state_count(&self) -> u64 {
        self.home.state_count()
    }

    fn number(&self, state: &D::State) -> u64 {
        self.home.number(state)
    }

    fn numbered(&self, number: u64) -> D::State {
        self.home.numbered(number)
    }
}

impl<D: PushGrid> PushGrid for Unlike<'_, D> {
    fn floor(&self) -> Floor<'_> {
        self.home.floor()
    }

    fn pieces(&self) -> usize {
        self.home.pieces()
    }

    fn cell(&self, state: &D::State, piece: Piece) -> CellId {
        self.home.cell(state, piece)
    }

    fn put(&self, state: &D::State, piece: Piece, cell: CellId) -> D::State {
        self.home.put(state, piece, cell)
    }

    fn piece_of(&self, proposition: &GroundProposition) -> Option<Piece> {
        self.home.piece_of(proposition).filter(|_| self.tells_pieces)
    }

    fn can_pull(&self) -> bool {
        self.home.can_pull()
    }

    fn pushes_plainly(&self) -> bool {
        self.home.pushes_plainly()
    }

    fn swaps(&self) -> bool {
        self.home.swaps()
    }
}

#[test]
fn a_floor_with_actions_of_different_costs_or_with_goals_of_several_pieces_gives_the_optimal_sets_of_brute_force() {
    let mut random = Pcg32::new(10, 10);
    for (cost, tells_pieces) in [(2, true), (1, false), (2, false)] {
        let mut memory = HeapMemory::new(&ROOMY);
        let size = Size { columns: 2, rows: 1, side: 3, blocks: 1 };
        let (home, start) = random_home(&mut random, size, Moves::Push, &mut memory.home);
        let cost_of = |position: usize| if position.is_multiple_of(3) { cost } else { 1 };
        let actions = home.actions().iter().enumerate().map(|(position, kind)| ActionKind::new(kind.name, cost_of(position))).collect();
        let unlike = Unlike { home: &home, actions, tells_pieces };
        assert!(compare(&unlike, &start, &home::paper_tasks().unwrap(), 3) > 0);
    }
}

#[test]
fn a_robot_of_as_many_actions_as_a_host_can_hold_gets_the_optimal_sets_of_brute_force() {
    let lifted = home::paper_tasks().unwrap();
    for count in [15, 16, 17, 64, 65, Action::MOST] {
        let (mut random, mut memory) = (Pcg32::new(11, 11), HeapMemory::new(&ROOMY));
        let (home, start) =
            random_home(&mut random, Size { columns: 2, rows: 1, side: 3, blocks: 1 }, Moves::PushAndPull, &mut memory.home);
        let names: Vec<String> = (0..count).map(|position| format!("action{position}")).collect();
        // In rows of states, and one by one.
        for cost in [1, 2] {
            let cost_of = |position: usize| if position.is_multiple_of(3) { cost } else { 1 };
            let kinds = names.iter().enumerate().map(|(position, name)| ActionKind::new(name, cost_of(position)));
            let many = Unlike { home: &home, actions: kinds.collect(), tells_pieces: true };
            assert!(compare(&many, &start, &lifted, 7) > 0);
        }
        // By bounds, or not at all.
        let many = Unlike { home: &home, actions: names.iter().map(|name| ActionKind::new(name, 1)).collect(), tells_pieces: true };
        let tasks = with_opposites(&many, &start, &lifted);
        let truth = BruteForce::new(&many, &start, &lifted, &tasks);
        let mut planner = OwnPlanner::new(&Capacities { states: 1_024, hashed_states: 64, ..ROOMY }, &many, &lifted, &tasks);
        for (position, state) in truth.states.iter().enumerate().step_by(11) {
            let plan = planner.plan_for(&many, state, TaskSet::first(tasks.len()), 100);
            let wrong =
                (0..tasks.len()).find(|&task| plan.optimal(task).exact().is_some() && plan.optimal(task) != truth.optimal(position, task));
            assert_eq!(wrong, None, "{count} actions, state {position}");
        }
    }
}

#[test]
fn a_search_that_runs_out_of_memory_says_unknown_and_never_anything_wrong() {
    let mut memory = HeapMemory::new(&ROOMY);
    let mut robot = TurningRobot::new(5, vec![6, 17], vec![24, 1, 20], memory.home.lend().objects);
    robot.gap = 1_000_003;
    let (start, lifted) = (robot.start(0, 7), robot_tasks(&robot));
    let mut tasks = [GroundedTask::UNUSED; 8];
    let count = ground(&robot, &lifted, &start, &mut tasks).unwrap();
    let truth = BruteForce::new(&robot, &start, &lifted, &tasks[..count]);
    let bounded = Capacities { states: 4_096, hashed_states: 300, ..ROOMY };
    let mut planner = OwnPlanner::new(&bounded, &robot, &lifted, &tasks[..count]);
    let (mut known, mut unknown) = (0, 0);
    for (position, state) in truth.states.iter().enumerate().step_by(13) {
        let plan = planner.plan_for(&robot, state, TaskSet::first(count), 50);
        for task in 0..count {
            match plan.optimal(task) {
                OptimalSet::Unknown => unknown += 1,
                found => {
                    assert_eq!(found, truth.optimal(position, task));
                    known += 1;
                }
            }
        }
    }
    assert!(known > 100 && unknown > 100, "{known} known, {unknown} unknown");
}
