//! Bounds on costs that must not grow, as ratios of medians taken in one run.

use std::time::Duration;

use goodbot::HeapMemory;
use goodbot::language::Settings;
use goodbot_benches::dijkstra::{HOMES, one_dijkstra_a_task};
use goodbot_benches::homes::{LARGE, Scene, Tasks, size};
use goodbot_benches::language::{model, sessions, train};
use goodbot_benches::three_storeys::{self, three_storeys};
use goodbot_benches::timing::{in_turn, ratio};

#[test]
fn sixty_four_tasks_cost_hardly_more_than_eight() {
    let mut many = Scene::roomy(size(12, 1), Tasks::Count(64));
    let mut few = Scene::roomy(size(12, 1), Tasks::Count(8));
    assert_eq!((many.tasks.len(), few.tasks.len()), (64, 8));
    let ratio = ratio(in_turn(|| many.plan().expansions(), || few.plan().expansions()));
    assert!(ratio < 2.5, "{ratio}");
}

#[test]
fn one_search_for_all_tasks_is_ten_times_faster_than_one_dijkstra_a_task_and_finds_the_same_distances() {
    let (mut own, mut theirs) = (Duration::ZERO, Duration::ZERO);
    for seed in 0..9 {
        let mut scene = Scene::seeded(seed, HOMES, Tasks::Paper);
        let count = scene.tasks.len();
        let plan = scene.plan();
        let ours: Vec<Option<u32>> = (0..count).map(|task| plan.distance(task)).collect();
        assert_eq!(ours, one_dijkstra_a_task(&scene));
        let other = Scene::seeded(seed, HOMES, Tasks::Paper);
        let (slow, fast) = in_turn(|| one_dijkstra_a_task(&other), || scene.plan().expansions());
        (own, theirs) = (own + fast, theirs + slow);
    }
    let ratio = ratio((theirs, own));
    assert!(ratio > if cfg!(debug_assertions) { 5.0 } else { 10.0 }, "{ratio}");
}

#[test]
fn fifty_tasks_most_of_them_with_a_way_are_planned_for_ten_times_faster_than_by_one_dijkstra_a_task_and_alike() {
    let mut scene = three_storeys();
    let plan = three_storeys::plan(&mut scene);
    let (expansions, ours) = (plan.expansions(), (0..50).map(|task| plan.distance(task)).collect::<Vec<_>>());
    assert_eq!((scene.tasks.len(), ours), (50, three_storeys::one_dijkstra_a_task(&scene)));
    let other = three_storeys();
    let (slow, fast) = in_turn(|| three_storeys::one_dijkstra_a_task(&other), || three_storeys::plan(&mut scene).expansions());
    println!("{expansions} expansions, {fast:?}; one Dijkstra a task {slow:?}");
    assert!(ratio((slow, fast)) > 3.0, "{slow:?} and {fast:?}");
}

#[test]
fn training_takes_time_linear_in_the_sessions() {
    let settings = Settings { rounds: 1, ..Settings::PAPER };
    let (memory, other) = (HeapMemory::new(&LARGE), HeapMemory::new(&LARGE));
    let mut many = model(memory.agent, &sessions(512), settings, 0.25);
    let mut few = model(other.agent, &sessions(64), settings, 0.25);
    let ratio = ratio(in_turn(|| train(&mut many), || train(&mut few)));
    assert!(ratio < 16.0, "eight times the data take {ratio} times as long");
}
