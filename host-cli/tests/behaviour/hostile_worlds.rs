//! Worlds of strangers, whose names try to be code: `goodbot table` writes their robots, and only their robots.

use crate::program::goodbot;
use goodbot_tests::hostile::{Harmless, named, read_by_c, table, world};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;

/// Parts of names that end a comment, a text or a line in C or Rust, or begin a new one.
const PARTS: [&str; 24] = [
    "*/",
    "/*",
    "//",
    "\"",
    "\\",
    "\n",
    "\r\n",
    "\u{2028}",
    "??/",
    "??'",
    "#define x 1",
    "`",
    "{",
    "};",
    ";",
    "(",
    "\0",
    "\u{1b}[31m",
    "\u{202e}",
    "ü",
    "int f(void)",
    "\\u{41}",
    "%s",
    "'",
];

#[test]
fn no_name_of_a_world_becomes_code() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let harmless = Harmless::new(folder, &goodbot);
    let mut random = Pcg32::seed_from_u64(59);
    let mut name = || (0..1 + random.next_u32() % 5).map(|_| PARTS[random.next_u32() as usize % PARTS.len()]).collect::<String>();
    let mut written = 0;
    for _ in 0..40 {
        let hostile = named([&name(), &name(), &name(), &name()]);
        written += harmless.assert_same(folder, &hostile, &goodbot);
    }
    assert!(written >= 20, "only {written} were written");
}

#[test]
fn a_name_that_would_end_early_in_c_is_refused_and_not_shortened() {
    let folder = tempfile::tempdir().unwrap();
    let cut = world("lift", "floor0", "up", "ga\0rage");
    let refused = table(folder.path(), &cut, "--c", &goodbot).unwrap_err();
    assert!(refused.contains("U+0000") && refused.contains("--rust"), "{refused}");
    assert!(table(folder.path(), &cut, "--rust", &goodbot).unwrap().contains("ga\\0rage"));
}

#[test]
fn a_world_with_the_name_of_the_library_or_of_no_letters_compiles() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["goodbot", "goodbot_size", "7 lifts", "_Static_assert", "__x", "家", "int", &"long ".repeat(100)] {
        let header = table(folder.path(), &world(name, "floor0", "up", "garage"), "--c", &goodbot).unwrap();
        read_by_c(folder.path(), &header);
    }
}
