//! Every agent goes through every course with every trainer.

use goodbot_lab::study::agent::inference::{Inference, coach, shaping, tamer};
use goodbot_lab::study::agent::language::{Language, loglinear};
use goodbot_lab::study::agent::{AGENTS, Contestant, Learns};
use goodbot_lab::study::course::Course;
use goodbot_lab::study::trainer::TRAINERS;
use goodbot_lab::study::trainer::population::Population;
use goodbot_lab::study::trial::{CoursePlaces, Ending, MOST_STEPS, Outcome, run};

fn agent(name: &str) -> &'static Contestant {
    AGENTS.iter().find(|agent| agent.name == name).expect("an agent of this name")
}

/// All agents but those with a program.
fn agents() -> impl Iterator<Item = &'static Contestant> {
    AGENTS.iter().filter(|agent| agent.program().is_none())
}

fn outcome(agent: &Contestant, trainer: &str, places: &mut CoursePlaces, seed: u64) -> Outcome {
    let trainer = TRAINERS.iter().find(|known| known.name == trainer).expect("a trainer of this name");
    run(&agent.learns, trainer.habits(&Population::fitted(), seed), places, seed).expect("a course")
}

/// The means of a number over some seeds, for each of these agents and trainers.
fn means<const N: usize>(course: Course, who: [(&str, &str); N], of: fn(&Outcome) -> f64) -> [f64; N] {
    const SEEDS: u64 = 6;
    let mut means = [0.0; N];
    for seed in 1..=SEEDS {
        let mut places = CoursePlaces::new(course, seed).expect("homes");
        for (mean, (name, trainer)) in means.iter_mut().zip(who) {
            *mean += of(&outcome(agent(name), trainer, &mut places, seed)) / SEEDS as f64;
        }
    }
    means
}

fn right(outcome: &Outcome) -> f64 {
    outcome.tests_right() as f64
}

fn answers(outcome: &Outcome) -> f64 {
    outcome.lessons.iter().map(|lesson| f64::from(lesson.answers)).sum()
}

#[test]
fn every_agent_gets_through_the_course_with_every_trainer_and_the_same_seed_gives_the_same() {
    let [mut one, mut other] = [(); 2].map(|()| CoursePlaces::new(Course::Paper, 3).expect("homes"));
    for agent in agents() {
        for trainer in &TRAINERS {
            let outcome = outcome(agent, trainer.name, &mut one, 3);
            assert!(outcome.lessons.iter().all(|lesson| lesson.steps <= MOST_STEPS), "{} with {}", agent.name, trainer.name);
        }
    }
    // Whatever plans were made before in these homes.
    for agent in agents() {
        assert_eq!(outcome(agent, "population", &mut one, 3), outcome(agent, "population", &mut other, 3), "{}", agent.name);
    }
}

#[test]
fn every_inference_and_language_gets_through_the_other_courses() {
    for course in [Course::Free, Course::Told] {
        let mut places = CoursePlaces::new(course, 5).expect("homes");
        for agent in agents().filter(|agent| matches!(agent.learns, Learns::Factors(..))) {
            assert_eq!(outcome(agent, "balanced", &mut places, 5).tests.len(), 5, "{}", agent.name);
        }
    }
}

#[test]
fn a_trainer_who_never_speaks_says_no_word_and_one_who_leaves_ends_lessons_early() {
    let words = |outcome: &Outcome| outcome.lessons.iter().map(|lesson| f64::from(lesson.words)).sum();
    let [mute, punished] = means(Course::Paper, [("sabl+model2", "mute"), ("sabl+model2", "punish-only")], words);
    assert!(mute == 0.0 && punished > 0.0, "{mute}, {punished}");
    let left = |outcome: &Outcome| outcome.lessons.iter().filter(|lesson| lesson.ending == Ending::Left).count() as f64;
    let [leaving, staying] = means(Course::Paper, [("sabl+model2", "leaving"), ("sabl+model2", "population")], left);
    assert!(leaving > 0.0 && staying == 0.0, "{leaving}, {staying}");
}

/// The belief of every inference must reach every language.
#[test]
fn a_trainer_who_says_the_wrong_word_teaches_each_inference_and_language_worse_than_a_balanced_one() {
    for name in ["this+roles", "sabl+model2", "tamer+roles", "tamer+model2", "coach+roles", "shaping+roles", "shaping+loglinear"] {
        let [taught, misled] = means(Course::Paper, [(name, "balanced"), (name, "contrary")], right);
        assert!(taught > misled + 0.5, "{name}: {taught} right, and {misled} with the wrong word each time");
    }
}

#[test]
fn where_only_feedback_can_tell_nobody_learns_without_a_word() {
    let who = [("sabl+roles", "balanced"), ("sabl+roles", "mute"), ("none+roles", "balanced"), ("tamer+model2", "mute")];
    let [taught, alone, unheard, other] = means(Course::Told, who, right);
    // By luck, one of five tests is right.
    assert!(taught > 3.0, "{taught}");
    assert!(alone < 2.0 && unheard < 2.0 && other < 2.0, "{alone}, {unheard}, {other}");
}

#[test]
fn without_a_language_no_test_is_more_than_luck() {
    let [right] = means(Course::Paper, [("sabl+none", "balanced")], right);
    assert!(right < 2.0, "{right}");
}

#[test]
fn who_asks_is_answered_by_a_trainer_who_hardly_speaks_and_not_by_one_who_never_does() {
    let who = [("asking", "silent"), ("people", "silent"), ("asking", "mute")];
    let [asks, never, mute] = means(Course::Paper, who, answers);
    assert!(asks > 0.0 && never == 0.0 && mute == 0.0, "{asks}, {never}, {mute}");
}

#[test]
fn settings_that_were_taken_are_among_those_that_were_tried_and_not_at_the_edge() {
    for agent in AGENTS {
        let grid = agent.learns.grid();
        assert!(grid.is_empty() || grid.contains(&agent.learns), "{}: {}", agent.name, agent.learns);
    }
    let inside =
        |value: f32, tried: &[f32]| tried.first().is_some_and(|&first| first < value) && tried.last().is_some_and(|&last| value < last);
    assert!(inside(tamer::CHOSEN.rate, &tamer::RATES) && inside(tamer::CHOSEN.sharpness, &tamer::SHARPNESSES));
    assert!(inside(coach::CHOSEN.rate, &coach::RATES) && inside(coach::CHOSEN.trace, &coach::TRACES));
    assert!(inside(shaping::CHOSEN.consistency, &shaping::CONSISTENCIES));
    assert!(inside(loglinear::CHOSEN.rate, &loglinear::RATES));
    // The grids contain the agents' settings.
    let learns = Learns::Factors(Inference::Sabl, Language::LogLinear(loglinear::CHOSEN));
    assert!(AGENTS.iter().any(|agent| agent.learns == learns));
}
