//! The driver of a lesson: when the trainer ends it, and what the agent has learned then.

use goodbot::feedback::{Feedback, Strategy};
use goodbot::home::{Area, Cell};
use goodbot::memory::AgentMemory;
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, Domain};
use goodbot::planning::OptimalSet;
use goodbot::{Agent, Capacities, HeapMemory, Options, home};
use goodbot_course::exercise::HomeName;
use goodbot_course::layout::BlockPlan;
use goodbot_course::lesson::{MOST_STEPS, RESTS};
use goodbot_course::{
    CourseError, CourseTrainer, Ending, Exercise, Homes, Intention, LESSONS, Layout, Observer, Results, Scene, SimulatedTrainer, Step,
    generator, run_course, run_lesson,
};

const BALANCED: Strategy = Strategy::BALANCED;

fn lesson(layout: &Layout, exercise: &Exercise, strategy: Strategy, seed: u64) -> (Result<Ending, CourseError>, Vec<Step>) {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), Options::PAPER).unwrap();
    agent.set_strategies(&[(strategy, 1.0)]).unwrap();
    let (home, start) = layout.build(&mut memory.home).unwrap();
    let mut steps = Vec::new();
    let trainer = SimulatedTrainer { strategy };
    let report =
        run_lesson(&mut agent, &home, &start, exercise, &trainer, &mut generator(seed), |_, _, _, step| steps.extend(step.copied()));
    (report.map(|report| report.ending), steps)
}

#[test]
fn a_lesson_ends_when_the_agent_has_rested_at_the_intended_goal() {
    let (ending, steps) = lesson(Homes::FIXED.layout(HomeName::A), &LESSONS[0], BALANCED, 1);
    assert_eq!(ending, Ok(Ending::AtGoal));
    let rests = steps.iter().rev().take_while(|step| step.decision.action == Action::NOOP && step.correct).count();
    assert_eq!(rests, usize::from(RESTS));
}

#[test]
fn a_lesson_ends_when_the_block_is_stuck() {
    // In a room one cell wide, the chair can only be pushed north, past the door in the east wall, and the agent cannot get round it.
    let layout = Layout {
        rooms: [Some((Area::new(0, 0, 2, 5), "red")), Some((Area::new(2, 0, 6, 5), "green")), None, None],
        doors: [Some(Cell::new(2, 3)), None, None, None],
        agent: Cell::new(1, 1),
        blocks: [Some(BlockPlan { cell: Cell::new(1, 2), color: "blue", shape: "chair" }), None],
    };
    let take = Exercise { command: "take the chair away", intention: Intention::take("blue", "chair", "green"), home: HomeName::D };
    let (ending, steps) = lesson(&layout, &take, BALANCED, 1);
    assert_eq!(ending, Ok(Ending::DeadEnd));
    assert!(steps.is_empty());
}

#[test]
fn a_trainer_whom_the_agent_cannot_follow_gives_up() {
    // This trainer never speaks, as the agent expects: its first belief stays.
    let silent = Strategy::new(1.0, 1.0, 0.1).unwrap();
    let endings: Vec<_> = (0..8).map(|seed| lesson(Homes::FIXED.layout(HomeName::A), &LESSONS[0], silent, seed)).collect();
    assert!(endings.iter().any(|(ending, _)| *ending == Ok(Ending::AtGoal)));
    let given_up: Vec<_> = endings.iter().filter(|(ending, _)| *ending == Ok(Ending::TooLong)).collect();
    assert!(!given_up.is_empty());
    assert!(given_up.iter().all(|(_, steps)| steps.len() == usize::from(MOST_STEPS)));
}

#[test]
fn an_infallible_trainer_rewards_exactly_the_right_actions() {
    let infallible = Strategy::new(0.0, 0.0, 0.0).unwrap();
    let (_, steps) = lesson(Homes::FIXED.layout(HomeName::E), &LESSONS[5], infallible, 3);
    assert!(steps.iter().any(|step| !step.correct));
    assert!(steps.iter().all(|step| step.feedback == if step.correct { Feedback::Reward } else { Feedback::Punish }));
}

#[test]
fn a_command_for_what_is_done_already_is_refused() {
    let done = Exercise { command: "go to the blue room", intention: Intention::go("blue"), home: HomeName::A };
    assert_eq!(lesson(Homes::FIXED.layout(HomeName::A), &done, BALANCED, 1).0, Err(CourseError::NotPosed));
}

fn course(strategy: Strategy, seed: u64, random_homes: bool, observer: &mut impl Observer) -> Results {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), Options::PAPER).unwrap();
    let mut random = generator(seed);
    let homes = if random_homes { Homes::random(&mut random, &mut memory.home) } else { Homes::FIXED };
    run_course(&mut agent, &mut memory.home, &homes, &CourseTrainer::of(strategy), strategy, &mut random, observer).unwrap()
}

#[test]
fn the_same_seed_gives_the_same_course() {
    for random_homes in [false, true] {
        let run = |seed| course(Strategy::BALANCED, seed, random_homes, &mut ());
        assert_eq!(run(5), run(5));
        assert_ne!(run(5), run(6));
    }
}

#[test]
fn the_papers_second_trainer_never_rewards_and_all_tests_are_right() {
    for seed in 0..10 {
        let mut memory = HeapMemory::new(&Capacities::SMALL);
        let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), Options::PAPER).unwrap();
        let (trainer, believed) = (CourseTrainer::PUNISH_ONLY, Strategy::PUNISH_ONLY);
        let results = run_course(&mut agent, &mut memory.home, &Homes::FIXED, &trainer, believed, &mut generator(seed), &mut ()).unwrap();
        let feedback = results.feedback();
        assert_eq!(feedback.reward, 0);
        assert!(feedback.punish > 0 && feedback.neutral > 0);
        assert!(results.all_tests_right(), "seed {seed}");
    }
}

#[derive(Default)]
struct Onlooker {
    commands: Vec<&'static str>,
    unknown_plans: usize,
    steps: u16,
}

impl Observer for Onlooker {
    fn lesson_begins(&mut self, scene: &Scene<'_, impl HomeMemory, impl AgentMemory>) {
        self.commands.push(scene.exercise.command);
        assert_eq!(scene.home.world().objects.name(scene.home.agent()), "agent0");
    }

    fn acted(&mut self, _scene: &Scene<'_, impl HomeMemory, impl AgentMemory>, step: &Step) {
        self.steps += 1;
        self.unknown_plans += usize::from(step.decision.plan == OptimalSet::Unknown);
    }
}

#[test]
fn a_controllers_memory_is_enough_to_plan_every_step_of_random_courses() {
    for seed in 0..20 {
        let mut onlooker = Onlooker::default();
        let results = course(Strategy::BALANCED, seed, true, &mut onlooker);
        assert_eq!(onlooker.commands, LESSONS.map(|exercise| exercise.command));
        assert_eq!(onlooker.steps, results.lessons.iter().map(|lesson| lesson.steps).sum::<u16>());
        assert_eq!(onlooker.unknown_plans, 0);
    }
}
