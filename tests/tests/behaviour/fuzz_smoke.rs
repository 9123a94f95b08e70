//! The fuzz targets without a fuzzer: a fixed number of inputs from a seeded generator, and the stored corpus.

use goodbot::feedback::Strategy;
use goodbot::home::paper_tasks;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::hostile::{TARGETS, Target};
use goodbot_tests::school;
use rand_core::Rng;
use rand_pcg::Pcg32;
use std::path::PathBuf;

/// The number of generated inputs per target.
const MADE: usize = 400;

fn corpus(target: &str) -> Vec<Vec<u8>> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus").join(target);
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).expect("the corpus is there").map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files.iter().map(|file| std::fs::read(file).unwrap()).collect()
}

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

fn below(count: usize, random: &mut Pcg32) -> usize {
    random.next_u32() as usize % count.max(1)
}

/// An input of the corpus with random changes, or random bytes.
fn made(corpus: &[Vec<u8>], random: &mut Pcg32) -> Vec<u8> {
    let mut input = match below(4, random) {
        0 => (0..below(300, random)).map(|_| random.next_u32() as u8).collect(),
        _ => corpus[below(corpus.len(), random)].clone(),
    };
    for _ in 0..below(6, random) {
        let at = below(input.len() + 1, random);
        match below(6, random) {
            0 => input.truncate(at),
            1 => input.insert(at, random.next_u32() as u8),
            2 if at < input.len() => drop(input.remove(at)),
            3 if at < input.len() => input[at] ^= 1 << below(8, random),
            4 if at < input.len() => input[at] = [0, 1, 0x7f, 0x80, 0xff, b'"', b'{', b'9', b' '][below(9, random)],
            _ => {
                let other = &corpus[below(corpus.len(), random)];
                let from = below(other.len() + 1, random);
                let to = (from + below(40, random)).min(other.len());
                input.splice(at..at, other[from..to].iter().copied());
            }
        }
    }
    input
}

fn run((name, target): Target) {
    let mut corpus = corpus(name);
    if name == "model" {
        corpus.push(model());
    }
    let mut random = Pcg32::new(1, 1);
    corpus.iter().for_each(|input| target(input));
    for _ in 0..MADE {
        target(&made(&corpus, &mut random));
    }
    println!("inputs fuzzed, {name}: {} kept and {MADE} made", corpus.len());
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
