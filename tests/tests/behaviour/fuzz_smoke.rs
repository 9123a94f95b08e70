//! The fuzz targets without a fuzzer: a fixed number of inputs from a seeded generator, and the stored corpus.

use goodbot::feedback::Strategy;
use goodbot::home::paper_tasks;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::hostile::{TARGETS, Target, corpus, made};
use goodbot_tests::school;
use rand_pcg::Pcg32;

/// The number of generated inputs per target.
const MADE: usize = 400;
/// The same for calls of C, each of which may be a whole life.
const MADE_OF_CALLS: usize = 100;

/// The model of a robot that has learned the paper's course.
fn model() -> Vec<u8> {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
    for lesson in school::lessons() {
        school::train(&mut agent, &lesson, Strategy::BALANCED, &mut Pcg32::new(6, 6)).unwrap();
    }
    let mut bytes = vec![0; agent.saved_bytes().unwrap()];
    agent.save(&mut bytes).unwrap();
    bytes
}

fn run((name, target): Target) {
    let mut corpus = corpus(name);
    if name == "model" {
        corpus.push(model());
    }
    let mut random = Pcg32::new(1, 1);
    let number = if name == "capi" { MADE_OF_CALLS } else { MADE };
    corpus.iter().for_each(|input| target(input));
    for _ in 0..number {
        target(&made(&corpus, &mut random));
    }
    println!("inputs fuzzed, {name}: {} kept and {number} made", corpus.len());
}

/// The target with this name.
fn target(name: &str) -> Target {
    *TARGETS.iter().find(|(known, _)| *known == name).expect("a target of this name")
}

#[test]
fn hostile_environments_are_refused_or_lived_in() {
    run(target("environment"));
}

#[test]
fn hostile_session_logs_are_refused_or_read() {
    run(target("session"));
}

#[test]
fn hostile_models_are_refused_or_harmless() {
    run(target("model"));
}

#[test]
fn hostile_commands_are_refused_or_heard() {
    run(target("tokenizer"));
}

#[test]
fn calls_in_any_order_are_refused_or_done() {
    run(target("calls"));
}

#[test]
fn calls_of_the_c_interface_in_any_order_give_a_status() {
    run(target("capi"));
}

#[test]
fn calls_with_budgets_do_what_calls_to_the_end_do() {
    run(target("budgets"));
}

#[test]
fn beliefs_are_those_of_double_precision() {
    run(target("belief"));
}

#[test]
fn plans_by_bounds_are_those_of_exact_search() {
    run(target("bounds"));
}
