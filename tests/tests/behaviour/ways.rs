//! Tasks with a path constraint against brute force over the product of the world and its history.

use goodbot::home::{self, Area, Cell, HomeBuilder, Moves};
use goodbot::memory::{AgentHeap, HomeMemory};
use goodbot::oomdp::{Action, ActionSet, Domain, GroundProposition};
use goodbot::planning::OptimalSet;
use goodbot::session::Lessons;
use goodbot::task::{GroundedTask, LiftedTask, Part, TaskSet, Way, WayState, ground};
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::own_planner::OwnPlanner;
use goodbot_tests::random_homes::{Size, below, random_home};
use goodbot_tests::turning_robot::TurningRobot;
use rand_pcg::Pcg32;
use std::collections::{BTreeMap, VecDeque};

const ROOMY: Capacities = Capacities { states: 1 << 15, hashed_states: 1 << 15, ..Capacities::STANDARD };

/// The history since the command, as far as a task depends on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Past {
    /// The clauses `through` that were met, one bit each.
    passed: u8,
    /// The earlier goals that were reached.
    reached: u8,
    /// The task was done.
    done: bool,
    /// Something to be avoided was not avoided.
    spoilt: bool,
}

/// The requirements of a task, by the definition of its text.
struct Asked {
    goal: Vec<GroundProposition>,
    through: Vec<Vec<GroundProposition>>,
    before: Vec<Vec<GroundProposition>>,
    avoiding: Vec<GroundProposition>,
}

impl Asked {
    fn new(task: &GroundedTask, lifted: &LiftedTask) -> Self {
        let mut asked = Self { goal: vec![], through: vec![], before: vec![], avoiding: vec![] };
        for (part, proposition) in lifted.parts() {
            let group = |groups: &mut Vec<Vec<_>>, position: u8| {
                groups.resize(groups.len().max(usize::from(position) + 1), vec![]);
                groups[usize::from(position)].push(task.grounded(proposition));
            };
            match part {
                Part::Goal => asked.goal.push(task.grounded(proposition)),
                Part::Before(position) => group(&mut asked.before, position),
                Part::Through(clause) => group(&mut asked.through, clause),
                Part::Avoiding => asked.avoiding.push(task.grounded(proposition)),
            }
        }
        asked
    }

    /// The history after the robot has also entered a state.
    fn come_to(&self, mut past: Past, holds: impl Fn(&GroundProposition) -> bool) -> Past {
        if past.done || past.spoilt {
            return past;
        }
        for (clause, alternatives) in self.through.iter().enumerate() {
            past.passed |= u8::from(alternatives.iter().any(&holds)) << clause;
        }
        while let Some(goal) = self.before.get(usize::from(past.reached)).filter(|goal| goal.iter().all(&holds)) {
            assert!(!goal.is_empty());
            past.reached += 1;
        }
        let all_passed = past.passed == (1 << self.through.len()) - 1;
        if all_passed && usize::from(past.reached) == self.before.len() && self.goal.iter().all(&holds) {
            past.done = true;
        } else {
            past.spoilt = self.avoiding.iter().any(&holds);
        }
        past
    }

    /// Whether the task is done here; once done, only the goal counts.
    fn is_done(&self, past: Past, holds: impl Fn(&GroundProposition) -> bool) -> bool {
        past.done && self.goal.iter().all(holds)
    }
}

/// The reachable part of a task's product, with the true distance of each node.
struct Product<S> {
    /// World state, past, and the state of the task's own automaton after the same world states.
    nodes: Vec<(S, Past, WayState)>,
    edges: Vec<Vec<(Action, u32, usize)>>,
    distances: Vec<Option<u32>>,
    /// The nodes of each world state.
    of_state: BTreeMap<u64, Vec<usize>>,
}

impl<S: Copy + PartialEq> Product<S> {
    fn new<D: Domain<State = S>>(domain: &D, start: &S, task: &GroundedTask, lifted: &LiftedTask) -> Self {
        let (asked, way) = (Asked::new(task, lifted), Way::of(task, lifted));
        let come = |state: S, past: Past, told: WayState| {
            let holds = |part: &GroundProposition| domain.holds(part, &state);
            (state, asked.come_to(past, holds), way.advance(told, holds))
        };
        let mut product = Self { nodes: vec![], edges: vec![], distances: vec![], of_state: BTreeMap::new() };
        let mut known = BTreeMap::new();
        let mut enter = |product: &mut Self, node: (S, Past, WayState)| {
            let number = domain.number(&node.0);
            *known.entry((number, node.1)).or_insert_with(|| {
                product.nodes.push(node);
                product.of_state.entry(number).or_default().push(product.nodes.len() - 1);
                product.nodes.len() - 1
            })
        };
        enter(&mut product, come(*start, Past::default(), WayState::START));
        let mut at = 0;
        while let Some(&(state, past, told)) = product.nodes.get(at) {
            let mut edges = vec![];
            for position in 0..domain.actions().len() {
                let Some(next) = domain.step(&state, Action::new(position as u8)) else { continue };
                let next = enter(&mut product, come(next, past, told));
                edges.push((Action::new(position as u8), u32::from(domain.actions()[position].cost), next));
            }
            product.edges.push(edges);
            at += 1;
        }
        product.measure(|(state, past, _)| asked.is_done(*past, |part| domain.holds(part, state)));
        product
    }

    /// Computes distances backwards from the ends, relaxing until nothing changes.
    fn measure(&mut self, is_end: impl Fn(&(S, Past, WayState)) -> bool) {
        let mut into = vec![vec![]; self.nodes.len()];
        for (from, edges) in self.edges.iter().enumerate() {
            for &(_, cost, to) in edges {
                into[to].push((from, cost));
            }
        }
        self.distances = self.nodes.iter().map(|node| is_end(node).then_some(0)).collect();
        let mut open: VecDeque<usize> = (0..self.nodes.len()).filter(|&node| self.distances[node].is_some()).collect();
        while let Some(node) = open.pop_front() {
            for &(from, cost) in &into[node] {
                let through = self.distances[node].unwrap() + cost;
                if self.distances[from].is_none_or(|known| through < known) {
                    self.distances[from] = Some(through);
                    open.push_back(from);
                }
            }
        }
    }

    fn optimal(&self, node: usize) -> OptimalSet {
        let set = |keep: &dyn Fn(u32, usize) -> bool| {
            self.edges[node].iter().filter(|edge| keep(edge.1, edge.2)).fold(ActionSet::EMPTY, |set, edge| set.with(edge.0))
        };
        match self.distances[node] {
            Some(0) => OptimalSet::Goal,
            Some(distance) => OptimalSet::Toward(set(&|cost, to| self.distances[to].is_some_and(|rest| rest + cost == distance))),
            None => OptimalSet::DeadEnd(set(&|_, _| true).with(Action::NOOP)),
        }
    }
}

/// Counts of the comparisons.
#[derive(Debug, Default)]
struct Compared {
    toward: usize,
    goals: usize,
    dead_without_spoiling: usize,
    spoilt: usize,
}

impl Compared {
    fn add(&mut self, other: &Self) {
        self.toward += other.toward;
        self.goals += other.goals;
        self.dead_without_spoiling += other.dead_without_spoiling;
        self.spoilt += other.spoilt;
    }
}

/// Compares the plans in every `every`th world state, with each past that a task can have there.
fn compare<D: Domain>(capacities: &Capacities, domain: &D, start: &D::State, lifted: &[LiftedTask], every: usize) -> Compared {
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(domain, lifted, start, &mut tasks).unwrap();
    let tasks = &mut tasks[..count];
    let products: Vec<_> = tasks.iter().map(|task| Product::new(domain, start, task, &lifted[usize::from(task.lifted)])).collect();
    let mut planner = OwnPlanner::new(capacities, domain, lifted, tasks);
    let mut compared = Compared::default();
    let numbers: Vec<u64> = products.first().map_or(vec![], |product| product.of_state.keys().copied().collect());
    for (position, number) in numbers.into_iter().enumerate().step_by(every) {
        let pasts = products.iter().map(|product| product.of_state[&number].len()).max().unwrap_or(0);
        for past in 0..pasts {
            // Tasks with fewer pasts repeat theirs, together with other pasts of the other tasks.
            let nodes: Vec<usize> = products
                .iter()
                .map(|product| {
                    let nodes = &product.of_state[&number];
                    nodes[past % nodes.len()]
                })
                .collect();
            for (task, (product, &node)) in tasks.iter_mut().zip(products.iter().zip(&nodes)) {
                task.way = product.nodes[node].2;
            }
            let state = domain.numbered(number);
            let plan = planner.plan_for_ways(domain, &state, lifted, tasks, 100);
            assert!(plan.unknown().is_empty() && plan.approximate().is_empty());
            for (task, (product, &node)) in products.iter().zip(&nodes).enumerate() {
                let happened = product.nodes[node].1;
                let truth = product.optimal(node);
                let text = lifted[usize::from(tasks[task].lifted)].parts().collect::<Vec<_>>();
                assert_eq!(plan.optimal(task), truth, "state {position}, {:?} of {text:?} after {happened:?}", tasks[task].bindings);
                assert_eq!(plan.distance(task), product.distances[node]);
                match truth {
                    OptimalSet::Goal => compared.goals += 1,
                    OptimalSet::DeadEnd(_) if happened.spoilt => compared.spoilt += 1,
                    OptimalSet::DeadEnd(_) => compared.dead_without_spoiling += 1,
                    _ => {
                        assert!(!happened.spoilt);
                        compared.toward += 1;
                    }
                }
            }
        }
    }
    compared
}

fn kinds(texts: &[&str]) -> Vec<LiftedTask> {
    texts.iter().map(|text| LiftedTask::parse(text, &home::SCHEMA).unwrap()).collect()
}

#[test]
fn optimal_sets_and_distances_of_tasks_with_ways_are_those_of_brute_force_in_random_homes() {
    let sets = [
        vec![
            "agentInRoom(?a,?goal)",
            "agentInRoom(?a,?goal) through agentInRoom(?a,?via)",
            "agentInRoom(?a,?goal) avoiding agentInRoom(?a,?not)",
            "agentInRoom(?a,?goal) through agentInRoom(?a,?via) or agentInRoom(?a,?other)",
        ],
        vec![
            "blockInRoom(?o,?r)",
            "blockInRoom(?o,?r) avoiding agentInRoom(?a,?not)",
            "blockInRoom(?o,?r) then agentInRoom(?a,?home)",
            "agentInRoom(?a,?goal) avoiding blockInRoom(?o,?not)",
        ],
        vec![
            "agentInRoom(?a,?goal) through agentInRoom(?a,?via) avoiding agentInRoom(?a,?not)",
            "agentInRoom(?a,?first) then agentInRoom(?a,?second)",
            "agentInRoom(?a,?goal) through agentInRoom(?a,?via) through agentInRoom(?a,?other)",
        ],
        vec![
            "blockInRoom(?o,?r) through blockInRoom(?o,?via)",
            "agentInRoom(?a,?first) then blockInRoom(?o,?r) then agentInRoom(?a,?home)",
        ],
    ];
    let (mut random, mut all) = (Pcg32::new(16, 16), Compared::default());
    for round in 0..12 {
        let lifted = kinds(&sets[round % sets.len()]);
        let with_block = round % sets.len() % 2 == 1;
        let size = Size { columns: 2, rows: 2 - i32::from(with_block && round < 8), side: 2, blocks: i32::from(with_block) };
        let size = if with_block && size.rows == 1 { Size { columns: 3, ..size } } else { size };
        let moves = if round % 3 == 0 { Moves::PushAndPull } else { Moves::Push };
        let mut memory = HeapMemory::new(&ROOMY);
        let (home, start) = random_home(&mut random, size, moves, &mut memory.home);
        let compared = compare(&ROOMY, &home, &start, &lifted, if with_block { 11 } else { 1 });
        println!("{size:?} {compared:?}");
        assert!(compared.toward > 0 && compared.goals > 0, "{size:?}: {compared:?}");
        all.add(&compared);
    }
    assert!(all.spoilt > 100 && all.dead_without_spoiling > 100, "{all:?}");
}

#[test]
fn actions_of_different_costs_hashed_or_not_give_the_optimal_sets_of_brute_force() {
    let (mut random, mut all) = (Pcg32::new(17, 17), Compared::default());
    for round in 0..4 {
        let mut memory = HeapMemory::new(&ROOMY);
        let blocked = vec![2 + below(&mut random, 5), 8 + below(&mut random, 3)];
        let mut robot = TurningRobot::new(4, blocked, vec![15, 1, 12], memory.home.lend().objects);
        if round % 2 == 1 {
            robot.gap = 1_000_003;
        }
        let start = robot.start(0, 5 + below(&mut random, 2));
        let texts = [
            "robotInZone(?r,?z) avoiding robotInZone(?r,?not)",
            "robotInZone(?r,?z) through robotInZone(?r,?via)",
            "crateInZone(?c,?z) then robotInZone(?r,?y)",
        ];
        let lifted = texts.map(|text| LiftedTask::parse(text, &robot.world().schema).unwrap());
        all.add(&compare(&ROOMY, &robot, &start, &lifted, 23));
    }
    assert!(all.toward > 1_000 && all.goals > 0 && all.spoilt > 0, "{all:?}");
}

#[test]
fn a_search_that_runs_out_of_memory_says_unknown_of_ways_and_never_anything_wrong() {
    let mut memory = HeapMemory::new(&ROOMY);
    let (home, start) =
        random_home(&mut Pcg32::new(18, 18), Size { columns: 3, rows: 2, side: 3, blocks: 0 }, Moves::Push, &mut memory.home);
    let lifted = kinds(&["agentInRoom(?a,?goal) through agentInRoom(?a,?via)"]);
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(&home, &lifted, &start, &mut tasks).unwrap();
    let products: Vec<_> = tasks[..count].iter().map(|task| Product::new(&home, &start, task, &lifted[0])).collect();
    let bounded = Capacities { states: 64, hashed_states: 48, ..ROOMY };
    let mut planner = OwnPlanner::new(&bounded, &home, &lifted, &tasks[..count]);
    let plan = planner.plan_for_ways(&home, &start, &lifted, &tasks[..count], 50);
    let mut unknown = 0;
    for (task, product) in products.iter().enumerate() {
        match plan.optimal(task) {
            OptimalSet::Unknown => unknown += 1,
            found => assert_eq!(found, product.optimal(0)),
        }
    }
    assert!(unknown > 0 && unknown < count, "{unknown} of {count}");
}

#[test]
fn the_least_states_have_room_for_every_layer_of_a_way() {
    let mut memory = HeapMemory::new(&ROOMY);
    let size = Size { columns: 2, rows: 2, side: 3, blocks: 0 };
    let (home, start) = random_home(&mut Pcg32::new(20, 20), size, Moves::Push, &mut memory.home);
    let least = |texts: &[&str]| {
        let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), &kinds(texts), Options::DEFAULT).unwrap();
        agent.least_capacities(&home, &Lessons::new(4, 8)).unwrap().states
    };
    let way = "agentInRoom(?a,?goal) through agentInRoom(?a,?via) through agentInRoom(?a,?other)";
    let states = least(&[way]);
    assert!(states > least(&["agentInRoom(?a,?goal)"]));
    let lifted = kinds(&[way]);
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(&home, &lifted, &start, &mut tasks).unwrap();
    let unknown = |states: usize| {
        let capacities = Capacities { states, hashed_states: 0, ..ROOMY };
        let mut planner = OwnPlanner::new(&capacities, &home, &lifted, &tasks[..count]);
        let plan = planner.plan_for_ways(&home, &start, &lifted, &tasks[..count], 50);
        (0..count).filter(|&task| plan.optimal(task) == OptimalSet::Unknown).count()
    };
    assert_eq!(unknown(states), 0);
    assert!(unknown(states / 4) > 0, "with a quarter of the states, far goals stay unknown");
}

#[test]
fn nothing_is_known_of_a_way_that_the_planner_is_not_told_of() {
    let mut memory = HeapMemory::new(&ROOMY);
    let (home, start) =
        random_home(&mut Pcg32::new(19, 19), Size { columns: 2, rows: 2, side: 2, blocks: 0 }, Moves::Push, &mut memory.home);
    let lifted = kinds(&["agentInRoom(?a,?goal)", "agentInRoom(?a,?goal) avoiding agentInRoom(?a,?not)"]);
    let mut tasks = [GroundedTask::UNUSED; 64];
    let count = ground(&home, &lifted, &start, &mut tasks).unwrap();
    let mut planner = OwnPlanner::new(&ROOMY, &home, &lifted, &tasks[..count]);
    let plan = planner.plan_for(&home, &start, TaskSet::first(count), 100);
    for (position, task) in tasks[..count].iter().enumerate() {
        assert_eq!(plan.optimal(position) == OptimalSet::Unknown, task.lifted == 1);
    }
}

/// Three rooms in a row: the way from the first to the last leads through the middle one, or around it through a passage.
fn ring<M: HomeMemory>(memory: M) -> (home::Home<M>, home::HomeState) {
    let mut builder = HomeBuilder::new(memory);
    builder.room("room0", Area::new(0, 0, 4, 8), "blue").unwrap();
    builder.room("room1", Area::new(4, 0, 8, 4), "yellow").unwrap();
    builder.room("room2", Area::new(4, 4, 8, 8), "red").unwrap();
    builder.room("room3", Area::new(8, 0, 12, 8), "green").unwrap();
    for (name, x, y) in [("door0", 4, 2), ("door1", 4, 6), ("door2", 8, 2), ("door3", 8, 6)] {
        builder.door(name, Area::new(x, y, x, y)).unwrap();
    }
    builder.agent("agent0", Cell::new(3, 2)).unwrap();
    builder.build(Moves::Push).unwrap()
}

/// The position of the agent's task with these objects.
fn task_of<M: goodbot::memory::AgentMemory>(agent: &Agent<M>, domain: &impl Domain, objects: &[&str]) -> usize {
    let name = |object| domain.world().objects.name(object);
    let is = |task: &GroundedTask| objects.iter().zip(task.bindings).all(|(wanted, object)| name(object) == *wanted);
    agent.tasks().iter().position(is).unwrap()
}

const EAST: Action = Action::new(2);
const WEST: Action = Action::new(3);

#[test]
fn who_stepped_into_the_avoided_room_has_a_dead_end_and_leaving_it_does_not_help() {
    let (mut memory, mut homes) = (HeapMemory::new(&ROOMY), HeapMemory::new(&ROOMY));
    let (home, mut state) = ring(&mut homes.home);
    let lifted = kinds(&["agentInRoom(?a,?goal) avoiding agentInRoom(?a,?not)"]);
    let mut agent = Agent::new(&mut memory.agent, &lifted, Options::PAPER).unwrap();
    agent.hear(&home, &state, "go to the green room but not through the yellow one").unwrap();
    let [around_yellow, around_red] = ["room1", "room2"].map(|not| task_of(&agent, &home, &["agent0", "room3", not]));
    agent.plan_fully(&home, &state).unwrap();
    assert!(matches!(agent.planned().optimal(around_yellow), OptimalSet::Toward(actions) if !actions.contains(EAST)));
    assert_eq!(agent.planned().optimal(around_red), OptimalSet::Toward(ActionSet::of(EAST)));
    let begun = state;
    for action in [EAST, EAST, WEST, WEST] {
        let before = state;
        state = agent.acted(&home, &state, action).unwrap();
        assert!(state != before);
        agent.plan_fully(&home, &state).unwrap();
    }
    assert!(state == begun);
    assert!(matches!(agent.planned().optimal(around_yellow), OptimalSet::DeadEnd(_)));
    assert_eq!(agent.planned().optimal(around_red), OptimalSet::Toward(ActionSet::of(EAST)));
    // The same command, heard again: nothing has happened yet.
    agent.hear_again(&home, &begun).unwrap();
    agent.plan_fully(&home, &begun).unwrap();
    assert!(matches!(agent.planned().optimal(around_yellow), OptimalSet::Toward(_)));
}

#[test]
fn who_was_to_step_into_the_avoided_room_and_did_not_get_there_has_broken_nothing() {
    let (mut memory, mut homes) = (HeapMemory::new(&ROOMY), HeapMemory::new(&ROOMY));
    let (home, start) = ring(&mut homes.home);
    let lifted = kinds(&["agentInRoom(?a,?goal) avoiding agentInRoom(?a,?not)"]);
    let mut agent = Agent::new(&mut memory.agent, &lifted, Options::PAPER).unwrap();
    agent.hear(&home, &start, "go to the green room but not through the yellow one").unwrap();
    let around_yellow = task_of(&agent, &home, &["agent0", "room3", "room1"]);
    agent.plan_fully(&home, &start).unwrap();
    let door = agent.acted(&home, &start, EAST).unwrap();
    agent.plan_fully(&home, &door).unwrap();
    let _meant = agent.acted(&home, &door, EAST).unwrap();
    // The robot slipped: it is still in the doorway.
    agent.plan_fully(&home, &door).unwrap();
    assert!(matches!(agent.planned().optimal(around_yellow), OptimalSet::Toward(_)));
}
