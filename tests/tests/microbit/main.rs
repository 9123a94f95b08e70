//! The micro:bit's file, `dist/goodbot.hex`, on an emulated board: lessons over its serial line and by its buttons, its lights, and its
//! model after an interrupted store; and the robot among embassy's tasks.
//!
//! `cargo xtask test --only microbit` builds the file and passes its path and the emulator's; without them, these tests are ignored.

#[cfg(unix)]
mod board;
#[cfg(unix)]
mod embassy;
#[cfg(unix)]
mod lessons;

use std::process::ExitCode;

#[cfg(unix)]
fn main() -> ExitCode {
    use libtest_mimic::{Arguments, Failed, Trial};
    let place = |name: &str| std::env::var_os(name).map(std::path::PathBuf::from);
    let places = place("GOODBOT_MICROBIT").zip(place("GOODBOT_QEMU")).zip(place("GOODBOT_CLI").zip(place("GOODBOT_EMBASSY")));
    let setup = places.map(|((hex, emulator), (goodbot, embassy))| board::Setup { emulator, hex, goodbot, embassy });
    let test = |name: &str, run: fn(&board::Setup)| {
        let setup = setup.clone();
        let absent = setup.is_none();
        let run = move || {
            setup.as_ref().map(run).ok_or(Failed::from("GOODBOT_MICROBIT, GOODBOT_EMBASSY, GOODBOT_QEMU and GOODBOT_CLI are not set"))
        };
        Trial::test(name, run).with_ignored_flag(absent).with_kind("needs an emulated board")
    };
    let tests = vec![
        test("the_papers_course_is_learned_over_the_serial_line", lessons::the_papers_course_is_learned_over_the_serial_line),
        test("a_lesson_is_given_with_the_buttons_alone", lessons::a_lesson_is_given_with_the_buttons_alone),
        test("the_lights_show_the_rooms_the_robot_and_the_block", lessons::the_lights_show_the_rooms_the_robot_and_the_block),
        test(
            "a_power_cut_at_any_write_of_a_store_leaves_the_lessons_of_before",
            lessons::a_power_cut_at_any_write_of_a_store_leaves_the_lessons_of_before,
        ),
        test(
            "what_a_robot_learned_elsewhere_comes_with_the_file_and_its_home_and_commands_too",
            lessons::what_a_robot_learned_elsewhere_comes_with_the_file_and_its_home_and_commands_too,
        ),
        test(
            "among_embassys_tasks_a_lesson_is_given_by_buttons_and_outlives_the_battery",
            embassy::a_lesson_is_given_by_buttons_and_outlives_the_battery,
        ),
        test(
            "a_lesson_of_given_actions_is_learned_and_the_model_is_fetched_as_it_is_stored",
            lessons::a_lesson_of_given_actions_is_learned_and_the_model_is_fetched_as_it_is_stored,
        ),
        test("what_is_said_wrongly_is_answered_and_changes_nothing", lessons::what_is_said_wrongly_is_answered_and_changes_nothing),
    ];
    libtest_mimic::run(&Arguments::from_args(), tests).exit_code()
}

#[cfg(not(unix))]
fn main() -> ExitCode {
    ExitCode::SUCCESS
}
