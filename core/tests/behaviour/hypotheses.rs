//! A speech recogniser is unsure about the transcript: the scene and the robot's lessons decide.

use crate::rooms;

use goodbot::home::{self, Home, HomeState};
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::session::{Hypothesis, Phase};
use goodbot::{Agent, AgentError, Capacities, HeapMemory, Options};
use rooms::rooms;

const CAPACITIES: Capacities = Capacities { words: 64, word_bytes: 512, translations: 2_000, alignments: 4_000, ..Capacities::SMALL };

type Robot<'m> = Agent<&'m mut AgentHeap>;

/// Runs with a robot that has learned what "red room" and "green room" mean, and with one that has learned nothing.
fn with_robots(options: Options, run: impl Fn(&mut Robot<'_>, &mut Robot<'_>, &Home<&mut HomeHeap>, &HomeState)) {
    let [mut taught, mut new, mut rooms_memory] = [(); 3].map(|()| HeapMemory::new(&CAPACITIES));
    let (home, start) = rooms(&mut rooms_memory.home, None);
    let tasks = home::paper_tasks().unwrap();
    let [mut taught, mut new] = [&mut taught.agent, &mut new.agent].map(|memory| Agent::new(memory, &tasks, options).unwrap());
    for (command, task) in
        [("go to the green room", 0), ("go to the red room", 1), ("walk to the green room", 0), ("walk to the red room", 1)]
    {
        taught
            .hear_with_prior(&home, &start, command, |grounded, _| {
                f32::from(u8::from(home.objects().name(grounded.bindings[1]) == ["room1", "room2"][task]))
            })
            .unwrap();
        let _ = taught.finish(&home).unwrap();
        taught.learn_fully();
    }
    run(&mut taught, &mut new, &home, &start);
}

fn heard<'h>(given: &[(&'h str, f32)]) -> Vec<Hypothesis<'h>> {
    given.iter().map(|&(command, weight)| Hypothesis { command, weight }).collect()
}

#[test]
fn what_can_be_meant_here_wins_over_a_slightly_better_sound() {
    for options in [Options::DEFAULT, Options::PAPER] {
        with_robots(options, |robot, _, home, start| {
            let list = heard(&[("goat tooth a bread broom", 0.5), ("go to the red room", 0.4), ("go to the rude groom", 0.3)]);
            assert_eq!(robot.hear_one_of(home, start, &list), Ok(1));
            let meant = robot.most_likely();
            robot.hear(home, start, "go to the red room").unwrap();
            assert_eq!(robot.most_likely(), meant);
        });
    }
}

#[test]
fn a_robot_that_has_learned_nothing_takes_the_best_sound() {
    with_robots(Options::DEFAULT, |_, robot, home, start| {
        let list = heard(&[("go to the red room please", 0.3), ("goat", 0.3), ("go to the green room", 0.4)]);
        assert_eq!(robot.hear_one_of(home, start, &list), Ok(2));
    });
}

#[test]
fn a_much_better_sound_wins_among_what_can_be_meant() {
    with_robots(Options::DEFAULT, |robot, _, home, start| {
        for (weights, chosen) in [([0.9, 0.1], 0), ([0.1, 0.9], 1)] {
            let list = heard(&[("go to the red room", weights[0]), ("go to the green room", weights[1])]);
            assert_eq!(robot.hear_one_of(home, start, &list), Ok(chosen));
        }
    });
}

#[test]
fn the_session_is_as_if_the_chosen_transcript_alone_had_been_heard() {
    let drifting = Options { drift: 0.25, ..Options::DEFAULT };
    with_robots(drifting, |robot, _, home, start| {
        robot.hear(home, start, "go to the red room").unwrap();
        let alone: Vec<u32> = (0..robot.tasks().len()).map(|task| robot.belief().probability(task).to_bits()).collect();
        for list in [
            &[("go to the red room", 1.0)][..],
            &[("go to the red room", 0.9), ("xyzzy", 0.1)],
            &[("xyzzy", 0.1), ("go to the red room", 0.9)],
        ] {
            let _ = robot.hear_one_of(home, start, &heard(list)).unwrap();
            let now: Vec<u32> = (0..robot.tasks().len()).map(|task| robot.belief().probability(task).to_bits()).collect();
            assert_eq!(now, alone, "{list:?}");
        }
        let _ = robot.finish(home).unwrap();
        robot.learn_fully();
        assert_eq!(robot.language().bitext().sessions(), 5);
    });
}

#[test]
fn what_cannot_be_heard_is_passed_over_where_another_can() {
    with_robots(Options::DEFAULT, |robot, _, home, start| {
        let long = "word ".repeat(65);
        let list = heard(&[("?!", 0.5), (&long, 0.5), ("go to the red room", 0.1), ("go to the green room", 0.0)]);
        assert_eq!(robot.hear_one_of(home, start, &list), Ok(2));
        assert_eq!(robot.hear_one_of(home, start, &heard(&[("?!", 1.0)])), Err(AgentError::EmptyCommand));
        assert_eq!(robot.plan(home, start, 1), Err(AgentError::NotNow(Phase::Idle)));
    });
}

#[test]
fn lists_that_say_nothing_are_refused() {
    with_robots(Options::DEFAULT, |_, robot, home, start| {
        assert_eq!(robot.hear_one_of(home, start, &[]), Err(AgentError::EmptyCommand));
        assert_eq!(robot.hear_one_of(home, start, &heard(&[("go", 0.0)])), Err(AgentError::EmptyCommand));
        for wrong in [f32::NAN, -0.5, f32::INFINITY] {
            let refused = robot.hear_one_of(home, start, &heard(&[("go", 1.0), ("no", wrong)])).unwrap_err();
            assert!(matches!(refused, AgentError::Weight { hypothesis: 1, value } if value.to_bits() == wrong.to_bits()));
        }
    });
}

#[test]
fn logarithms_of_weights_weigh_the_same_whatever_is_added_to_all() {
    with_robots(Options::DEFAULT, |robot, _, home, start| {
        let commands = ["go to the red room", "go to the green room", "goat tooth a bread broom"];
        for weights in [[0.9_f32, 0.1, 0.5], [0.1, 0.9, 0.5], [0.2, 0.3, 0.9], [0.4, 0.4, 0.4], [0.0, 0.1, 1.0]] {
            let list = |of: fn(f32) -> f32| heard(&commands.into_iter().zip(weights.map(of)).collect::<Vec<_>>());
            let chosen = robot.hear_one_of(home, start, &list(|weight| weight)).unwrap();
            assert_eq!(robot.hear_one_of_logs(home, start, &list(f32::ln)), Ok(chosen), "{weights:?}");
            assert_eq!(robot.hear_one_of_logs(home, start, &list(|weight| weight.ln() - 700.0)), Ok(chosen), "{weights:?}");
            assert_eq!(robot.hear_one_of_logs(home, start, &list(|weight| weight.ln() + 256.0)), Ok(chosen), "{weights:?}");
        }
    });
}

#[test]
fn a_logarithm_too_small_for_a_number_still_counts() {
    with_robots(Options::DEFAULT, |robot, _, home, start| {
        // Thirty words that nobody said to the robot are less probable than e^-100, which no f32 can be.
        let nonsense = (0..30).map(|word| format!("word{word} ")).collect::<String>();
        let list = heard(&[(&nonsense, 0.0), ("go to the red room", -110.0), ("go to the green room", -111.0)]);
        assert_eq!(robot.hear_one_of_logs(home, start, &list), Ok(1));
    });
}

#[test]
fn logarithms_that_say_nothing_are_refused() {
    with_robots(Options::DEFAULT, |_, robot, home, start| {
        assert_eq!(robot.hear_one_of_logs(home, start, &[]), Err(AgentError::EmptyCommand));
        assert_eq!(robot.hear_one_of_logs(home, start, &heard(&[("go", f32::NEG_INFINITY)])), Err(AgentError::EmptyCommand));
        for wrong in [f32::NAN, f32::INFINITY] {
            let refused = robot.hear_one_of_logs(home, start, &heard(&[("go", -1.0), ("no", wrong)])).unwrap_err();
            assert!(matches!(refused, AgentError::Weight { hypothesis: 1, value } if value.to_bits() == wrong.to_bits()));
        }
    });
}
