#![no_main]

libfuzzer_sys::fuzz_target!(|input: &[u8]| goodbot_tests::hostile::budgets(input));
