//! The fuzz targets that need the command line, without a fuzzer: a fixed number of inputs from a seeded generator, and the stored corpus.

use crate::program::goodbot;
use goodbot_tests::hostile::{TARGETS_WITH_PROGRAM, corpus, made};
use rand_pcg::Pcg32;

/// The number of generated inputs per target: fewer than for the others, because each starts a program a few times.
const MADE: usize = 60;

fn run(name: &str) {
    let (_, target) = TARGETS_WITH_PROGRAM.iter().find(|(known, _)| *known == name).expect("a target of this name");
    let corpus = corpus(name);
    let mut random = Pcg32::new(1, 1);
    corpus.iter().for_each(|input| target(input, &goodbot));
    for _ in 0..MADE {
        target(&made(&corpus, &mut random), &goodbot);
    }
    println!("inputs fuzzed, {name}: {} kept and {MADE} made", corpus.len());
}

#[test]
fn commands_on_hostile_files_send_nothing_that_a_terminal_obeys() {
    run("commands");
}

#[test]
fn tables_of_hostile_worlds_are_what_compilers_read_of_harmless_ones() {
    run("tables");
}
