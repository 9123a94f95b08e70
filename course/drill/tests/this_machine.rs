//! The drill's program on this machine.

use std::process::Command;

#[test]
fn it_passes_the_course_and_prints_its_digest() {
    let ended = Command::new(env!("CARGO_BIN_EXE_drill")).output().unwrap();
    let said = String::from_utf8(ended.stdout).unwrap();
    assert!(ended.status.success(), "{said}");
    let number = |name: &str| said.lines().find_map(|line| line.strip_prefix(name)?.trim().parse::<u32>().ok());
    assert_eq!(number("passed "), Some(5), "{said}");
    assert!(number("digest ").is_some_and(|digest| digest != 0), "{said}");
}
