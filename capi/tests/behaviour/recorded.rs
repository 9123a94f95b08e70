//! A recorded session teaches a C robot what it teaches all others.

use crate::robots::{Owned, small};
use goodbot::feedback::Feedback;
use goodbot::home::SCHEMA;
use goodbot::memory::AgentHeap;
use goodbot::oomdp::Action;
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use goodbot_capi::beliefs::{goodbot_task_count, goodbot_task_probability};
use goodbot_capi::home::*;
use goodbot_capi::memory::goodbot_size;
use goodbot_capi::options::*;
use goodbot_capi::robot::Goodbot;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::training::*;
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
use goodbot_formats::session::{Kind, RecordedSession, SessionReader};
use goodbot_lesson::checked::check_steps;
use goodbot_lesson::home;
use goodbot_lesson::replay::{Event, Replay, Rules};
use goodbot_lesson::walk::Walk;
use std::ffi::CString;
use std::mem::MaybeUninit;
use std::ptr::null_mut;

const LOG: &str = include_str!("../../../tests/fixtures/lesson.jsonl");

const KINDS: [&str; 4] = [
    "agentInRoom(?a,?r)",
    "blockInRoom(?b,?r)",
    "agentInRoom(?a,?r) through agentInRoom(?a,?via)",
    "agentInRoom(?a,?r) avoiding agentInRoom(?a,?not)",
];

fn text(text: &str) -> CString {
    CString::new(text).unwrap()
}

const fn word(feedback: Feedback) -> i32 {
    match feedback {
        Feedback::Reward => GOODBOT_REWARD,
        Feedback::Punish => GOODBOT_PUNISH,
        Feedback::Neutral => GOODBOT_NEUTRAL,
    }
}

/// A robot that knows ways too.
fn robot() -> Owned {
    let mut capacities = small();
    capacities.entries.iter_mut().for_each(|entries| *entries *= 4);
    let kinds = KINDS.map(text);
    let kinds: Vec<_> = kinds.iter().map(|kind| kind.as_ptr()).collect();
    let bytes = unsafe { goodbot_size(&raw const capacities) };
    let mut owned = Owned { memory: vec![0; bytes.div_ceil(8)], bytes, capacities, robot: null_mut() };
    let memory = owned.memory.as_mut_ptr().cast();
    let made =
        unsafe { goodbot_init_home_tasks(memory, bytes, &raw const capacities, kinds.as_ptr(), kinds.len() as u32, &raw mut owned.robot) };
    assert_eq!(made, GoodbotStatus::Ok);
    // The log's robot expects no command for what is so already.
    let mut options = MaybeUninit::uninit();
    unsafe {
        assert_eq!(goodbot_current_options(owned.robot, options.as_mut_ptr()), GoodbotStatus::Ok);
        let options = GoodbotOptions { done: 0.0, ..options.assume_init() };
        assert_eq!(goodbot_set_options(owned.robot, &raw const options), GoodbotStatus::Ok);
    }
    owned
}

unsafe fn enter(robot: *mut Goodbot, environment: &EnvironmentFile) {
    let ok = |status| assert_eq!(status, GoodbotStatus::Ok);
    unsafe {
        ok(goodbot_home_begin(robot));
        for object in &environment.objects {
            let name = text(object.name());
            let name = name.as_ptr();
            ok(match object {
                ObjectRecord::Room { left, bottom, right, top, color, .. } => {
                    goodbot_home_room(robot, name, *left, *bottom, *right, *top, text(color).as_ptr())
                }
                ObjectRecord::Door { left, bottom, right, top, .. } => goodbot_home_door(robot, name, *left, *bottom, *right, *top),
                ObjectRecord::Agent { x, y, .. } => goodbot_home_agent(robot, name, *x, *y),
                ObjectRecord::Block { x, y, color, shape, .. } => {
                    goodbot_home_block(robot, name, *x, *y, text(color).as_ptr(), text(shape).as_ptr())
                }
            });
        }
        ok(goodbot_home_build(robot));
    }
}

unsafe fn beliefs(robot: *mut Goodbot) -> Vec<u32> {
    let mut count = 0;
    assert_eq!(unsafe { goodbot_task_count(robot, &raw mut count) }, GoodbotStatus::Ok);
    let belief = |task| {
        let mut probability = 0.0;
        assert_eq!(unsafe { goodbot_task_probability(robot, task, &raw mut probability) }, GoodbotStatus::Ok);
        probability.to_bits()
    };
    (0..count).map(belief).collect()
}

/// Each belief of a session, through the C interface: on hearing the command, and after each step.
unsafe fn taught(
    robot: *mut Goodbot,
    session: &RecordedSession,
    walk: &Walk<goodbot::home::Home<impl goodbot::memory::HomeMemory>>,
) -> Vec<Vec<u32>> {
    let ok = |status| assert_eq!(status, GoodbotStatus::Ok);
    let mut all = Vec::new();
    unsafe {
        if walk.continues {
            for object in &session.header.environment.objects {
                if let ObjectRecord::Agent { name, x, y } | ObjectRecord::Block { name, x, y, .. } = object {
                    ok(goodbot_home_place(robot, text(name).as_ptr(), *x, *y));
                }
            }
            ok(goodbot_hear_again(robot));
        } else {
            enter(robot, &session.header.environment);
            if let Some(strategies) = &walk.strategies {
                let of = |expected: &goodbot_lesson::walk::Expected| {
                    let it = expected.strategy;
                    let (mu_plus, mu_minus, epsilon, lags) = (it.mu_plus(), it.mu_minus(), it.epsilon(), it.lags());
                    let rests = it.rests();
                    GoodbotStrategy { mu_plus, mu_minus, epsilon, lags, rests, prior: expected.share }
                };
                let strategies: Vec<_> = strategies.iter().map(of).collect();
                ok(goodbot_trainers(robot, strategies.as_ptr(), strategies.len() as u32));
            }
            ok(goodbot_hear(robot, text(&walk.command).as_ptr()));
        }
        all.push(beliefs(robot));
        let mut evidence = 0;
        for step in &walk.steps {
            while goodbot_plan(robot, 1_000) == GoodbotStatus::Working {}
            let action = if step.action == Action::NOOP { GOODBOT_NOOP } else { step.action.index() as u8 };
            if walk.kind == Kind::Demonstration {
                ok(goodbot_demonstration(robot, action, &raw mut evidence));
            } else {
                ok(goodbot_acted(robot, action));
                ok(goodbot_feedback(robot, word(step.feedback), &raw mut evidence));
            }
            all.push(beliefs(robot));
        }
        if session.learn {
            let mut gave_way = 0;
            ok(goodbot_finish(robot, &raw mut gave_way));
            while goodbot_learn(robot, 10_000) == GoodbotStatus::Working {}
        } else {
            ok(goodbot_forget(robot));
        }
    }
    all
}

#[test]
fn a_recorded_session_is_believed_bit_for_bit_as_the_one_walker_believes_it() {
    let lifted = KINDS.map(|kind| LiftedTask::parse(kind, &SCHEMA).unwrap());
    let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), &lifted, Options::DEFAULT).unwrap();
    let owned = robot();
    let mut compared = 0;
    for session in SessionReader::new(LOG.as_bytes()) {
        // The C interface takes no prior, and an answer only to a question of the robot's.
        let mut session = session.unwrap();
        (session.header.prior, session.answers) = (None, vec![]);
        let checked = check_steps("lesson.jsonl", &session, &lifted, home::memory()).unwrap();
        let (mut replay, mut all) = (Replay::new(Rules::AS_IT_WAS), Vec::new());
        loop {
            match replay.advance(&mut agent, &checked.walk, u32::MAX).unwrap() {
                Event::Ended => break,
                Event::Heard | Event::Took(..) => {
                    all.push((0..checked.tasks.len()).map(|task| agent.belief().probability(task).to_bits()).collect::<Vec<_>>());
                }
                _ => {}
            }
        }
        if session.learn {
            let _ = agent.finish(&checked.walk.home).unwrap();
            agent.learn_fully();
        } else {
            agent.forget();
        }
        compared += all.len();
        assert_eq!(unsafe { taught(owned.robot, &session, &checked.walk) }, all, "{:?}", session.header.id);
    }
    assert_eq!(compared, 27);
}
