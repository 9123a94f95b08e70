#![no_main]

#[path = "../command_line.rs"]
mod command_line;

libfuzzer_sys::fuzz_target!(|input: &[u8]| goodbot_tests::hostile::commands(input, &command_line::run));
