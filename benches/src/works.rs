//! The benchmarks, each with its name, ready to be run repeatedly.

use crate::homes::{LARGE, Scene, Tasks, named, size};
use crate::language::{model, sessions, train};
use crate::three_storeys::{self, three_storeys};
use goodbot::feedback::{Feedback, Strategy};
use goodbot::home::{self, Moves};
use goodbot::language::Settings;
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::oomdp::Action;
use goodbot::session::Evidence;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_course::{CourseTrainer, HomeName, Homes, generator, run_course};
use goodbot_tests::random_homes::random_home;
use rand_pcg::Pcg32;
use std::hint::black_box;

/// A benchmark.
pub struct Work {
    /// Its name.
    pub name: String,
    /// Prepares it; each call of the returned function runs it once.
    pub prepare: Box<dyn Fn() -> Box<dyn FnMut()>>,
}

fn work(name: impl Into<String>, prepare: impl Fn() -> Box<dyn FnMut()> + 'static) -> Work {
    Work { name: name.into(), prepare: Box::new(prepare) }
}

/// All benchmarks, quick ones first.
pub fn all() -> Vec<Work> {
    let mut works = vec![
        work("hear a command", || hear(Options::DEFAULT)),
        work("hear a command, Model 2", || hear(Options::PAPER)),
        work("feedback to one action", feedback),
    ];
    works.push(work("the course", || Box::new(course)));
    for name in [HomeName::A, HomeName::B, HomeName::C, HomeName::D, HomeName::E, HomeName::F] {
        works.push(work(format!("plan, the course's environment {name:?}"), move || plan_of_course(name)));
    }
    for count in [8, 64, 512] {
        works.push(work(format!("EM round, {count} sessions"), move || em_round(count)));
    }
    for (rooms, blocks) in [(3, 0), (3, 1), (6, 1), (12, 1), (3, 2), (6, 2), (3, 3), (6, 4), (12, 3)] {
        works.push(work(format!("plan, {}", named(rooms, blocks)), move || plan(rooms, blocks)));
    }
    for blocks in [10, 20] {
        works.push(work(format!("plan, {}, ten likely tasks", named(10, blocks)), move || plan_expecting(10, blocks)));
    }
    works.push(work("plan, three storeys with ways", || {
        let mut scene = three_storeys();
        repeated(move || three_storeys::plan(&mut scene).expansions())
    }));
    for (rooms, blocks) in [(3, 1), (12, 1), (3, 2)] {
        works.push(work(format!("sweep, {}", named(rooms, blocks)), move || whole_sweep(rooms, blocks)));
    }
    works
}

/// An agent that has learned 16 sessions, and its home.
fn learned(options: Options) -> (Agent<AgentHeap>, home::Home<HomeHeap>, home::HomeState) {
    let parts = HeapMemory::new(&LARGE);
    let (home, start) = random_home(&mut Pcg32::new(3, 3), size(3, 2), Moves::Push, parts.home);
    let mut agent = Agent::new(parts.agent, &home::paper_tasks().expect("the tasks"), options).expect("an agent");
    for (english, _) in sessions(16) {
        agent.hear(&home, &start, &english.join(" ")).expect("a command");
        let _ = agent.finish(&home).expect("room for the session");
        agent.learn_fully();
    }
    (agent, home, start)
}

fn hear(options: Options) -> Box<dyn FnMut()> {
    let (mut agent, home, start) = learned(options);
    Box::new(move || agent.hear(&home, &start, "take the red chair to the blue room").expect("a command"))
}

fn feedback() -> Box<dyn FnMut()> {
    let (mut agent, home, start) = learned(Options::DEFAULT);
    agent.hear(&home, &start, "take the red chair to the blue room").expect("a command");
    agent.plan_fully(&home, &start).expect("a plan");
    Box::new(move || {
        agent.acted(&home, &start, Action::new(0)).expect("a plan");
        assert_eq!(agent.feedback(Feedback::Neutral), Ok(Evidence::Used));
    })
}

/// Seven lessons and five tests in the fixed homes, by a new agent.
pub fn course() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(memory.agent, &home::paper_tasks().expect("the tasks"), Options::PAPER).expect("an agent");
    let (trainer, believed) = (CourseTrainer::BALANCED, Strategy::BALANCED);
    run_course(&mut agent, &mut memory.home, &Homes::FIXED, &trainer, believed, &mut generator(1), &mut ()).expect("a course");
}

fn em_round(count: usize) -> Box<dyn FnMut()> {
    let settings = Settings { rounds: 1, ..Settings::PAPER };
    let mut model = model(AgentHeap::new(&Capacities::STANDARD), &sessions(count), settings, 0.25);
    Box::new(move || train(&mut model))
}

/// The first plan in one of the course's fixed environments, repeatedly.
fn plan_of_course(name: HomeName) -> Box<dyn FnMut()> {
    let parts = HeapMemory::new(&Capacities::SMALL);
    let (home, start) = Homes::FIXED.layout(name).build(parts.home).expect("a home");
    let mut agent = Agent::new(parts.agent, &home::paper_tasks().expect("the tasks"), Options::PAPER).expect("an agent");
    agent.hear(&home, &start, "go").expect("a command");
    Box::new(move || {
        agent.hear_again(&home, &start).expect("the same session");
        agent.plan_fully(&home, &start).expect("a plan");
    })
}

/// Work whose result nobody reads.
fn repeated<R>(mut run: impl FnMut() -> R + 'static) -> Box<dyn FnMut()> {
    Box::new(move || drop(black_box(run())))
}

fn plan(rooms: i32, blocks: i32) -> Box<dyn FnMut()> {
    let mut scene = Scene::roomy(size(rooms, blocks), Tasks::Paper);
    repeated(move || scene.plan().expansions())
}

fn plan_expecting(rooms: i32, blocks: i32) -> Box<dyn FnMut()> {
    let mut scene = Scene::bounded(size(rooms, blocks));
    let ten = scene.ten();
    repeated(move || scene.plan_expecting(ten).expansions())
}

fn whole_sweep(rooms: i32, blocks: i32) -> Box<dyn FnMut()> {
    let scene = Scene::roomy(size(rooms, blocks), Tasks::Paper);
    repeated(move || scene.sweep())
}
