//! The drill's program on this machine.

use goodbot::{Capacities, HeapMemory};
use goodbot_drill::{Budget, Watch, stop};
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

#[test]
fn stop_ends_a_lesson_at_any_moment_before_it_is_learned() {
    #[derive(Default)]
    struct Counted(u32);
    impl Watch for Counted {
        fn stopped(&mut self) {
            self.0 += 1;
        }
    }
    let (memory, mut counted) = (HeapMemory::new(&Capacities::SMALL), Counted::default());
    let stops = stop(memory.home, memory.agent, Budget { hear: 1, plan: 8, finish: 1, learn: 16 }, &mut counted).unwrap();
    assert!(stops.are_clean && stops.count > 10 && stops.count == counted.0, "{stops:?}");
}
