//! Every agent goes through the course with every trainer.

use goodbot_lab::study::agent::{AGENTS, Contestant, Learns};
use goodbot_lab::study::trainer::TRAINERS;
use goodbot_lab::study::trainer::population::Population;
use goodbot_lab::study::trial::{Ending, MOST_STEPS, Outcome, homes, run};

fn agent(name: &str) -> Contestant {
    *AGENTS.iter().find(|agent| agent.name == name).expect("an agent of this name")
}

fn outcome(agent: &Contestant, trainer: &str, seed: u64) -> Outcome {
    let trainer = TRAINERS.iter().find(|known| known.name == trainer).expect("a trainer of this name");
    run(&agent.learns, trainer.habits(&Population::fitted(), seed), &homes(seed), seed).expect("a course")
}

/// The mean over six seeds.
fn mean(agent: &Contestant, trainer: &str, of: impl Fn(&Outcome) -> f64) -> f64 {
    (1..=6).map(|seed| of(&outcome(agent, trainer, seed))).sum::<f64>() / 6.0
}

fn steps(outcome: &Outcome) -> f64 {
    let steps = outcome.lessons.iter().map(|lesson| if lesson.ending == Ending::Goal { lesson.steps } else { MOST_STEPS });
    steps.map(f64::from).sum::<f64>() / outcome.lessons.len() as f64
}

#[test]
fn every_agent_gets_through_the_course_with_every_trainer() {
    for agent in &AGENTS {
        for trainer in &TRAINERS {
            let outcome = outcome(agent, trainer.name, 3);
            assert!(outcome.lessons.iter().all(|lesson| lesson.steps <= MOST_STEPS), "{} with {}", agent.name, trainer.name);
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_course() {
    for agent in &AGENTS {
        assert_eq!(outcome(agent, "population", 5), outcome(agent, "population", 5), "{}", agent.name);
    }
}

#[test]
fn a_trainer_who_never_speaks_says_no_word_and_one_who_only_punishes_teaches() {
    assert!(outcome(&agent("paper"), "mute", 1).lessons.iter().all(|lesson| lesson.words == 0));
    assert!(outcome(&agent("paper"), "punish-only", 1).lessons.iter().any(|lesson| lesson.words > 0));
}

#[test]
fn a_trainer_who_leaves_ends_lessons_before_the_goal() {
    let left = |outcome: &Outcome| outcome.lessons.iter().filter(|lesson| lesson.ending == Ending::Left).count() as f64;
    assert!(mean(&agent("paper"), "leaving", left) > 0.0);
    assert!(mean(&agent("paper"), "population", left) < 1e-9);
}

#[test]
fn goodbot_understands_new_commands_and_a_table_does_not() {
    let right = |outcome: &Outcome| outcome.tests_right() as f64;
    assert!(mean(&agent("goodbot"), "balanced", right) > 4.5);
    for name in ["tamer-table", "coach-table", "advise-table", "cobot-table"] {
        assert!(mean(&agent(name), "balanced", right) < 1.5, "{name}");
    }
}

#[test]
fn words_teach_every_agent_more_than_silence_does() {
    for agent in &AGENTS {
        let (taught, alone) = (mean(agent, "balanced", steps), mean(agent, "mute", steps));
        assert!(taught < alone, "{}: {taught} steps with a trainer, {alone} with a mute one", agent.name);
    }
}

#[test]
fn agents_that_share_words_and_plan_need_fewer_steps_than_tables() {
    for algorithm in ["tamer", "coach", "advise", "cobot"] {
        let of = |form: &str| mean(&agent(&format!("{algorithm}-{form}")), "balanced", steps);
        let (shared, table) = (of("shared"), of("table"));
        assert!(shared < table, "{algorithm}: {shared} steps shared, {table} in a table");
    }
}

#[test]
fn only_agents_with_a_probability_of_tasks_can_be_wrongly_certain() {
    for agent in &AGENTS {
        let told = outcome(agent, "mistaken", 2).tests[0].wrongly_certain.is_some();
        let has = matches!(agent.learns, Learns::Goodbot(_)) || ["coach-shared", "advise-shared"].contains(&agent.name);
        assert_eq!(told, has, "{}", agent.name);
    }
}

#[test]
fn who_asks_is_answered_and_needs_fewer_steps_with_a_trainer_who_hardly_speaks() {
    let answers = |outcome: &Outcome| outcome.lessons.iter().map(|lesson| f64::from(lesson.answers)).sum();
    assert!(mean(&agent("asking"), "silent", answers) > 0.0);
    assert!(mean(&agent("people"), "silent", answers) < 1e-9);
    assert!(mean(&agent("asking"), "silent", steps) <= mean(&agent("people"), "silent", steps));
}

#[test]
fn settings_that_were_taken_are_among_those_that_were_tried() {
    for agent in &AGENTS {
        let grid = agent.learns.grid();
        match agent.learns {
            Learns::Goodbot(_) => assert!(grid.is_empty()),
            learns => assert!(grid.contains(&learns), "{}: {learns}", agent.name),
        }
    }
}
