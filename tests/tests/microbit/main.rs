//! The micro:bit's file, `dist/goodbot.hex`, on emulated boards of both versions: lessons over its serial line and by its buttons, its lights,
//! and its model after an interrupted store; and the robot among embassy's tasks.
//!
//! `cargo xtask test --only microbit` builds the file and passes its path and the emulators'; without them, these tests are ignored. The firmware with
//! embassy is built and tried with `--all-boards`.

#[cfg(unix)]
mod board;
#[cfg(unix)]
mod embassy;
#[cfg(unix)]
mod lessons;

use std::process::ExitCode;

#[cfg(unix)]
fn main() -> ExitCode {
    use board::{Setup, V1, V2, Version};
    use libtest_mimic::{Arguments, Failed, Trial};
    let setup = |version: &'static Version, emulator: &'static str| {
        let place = |name: &str| std::env::var_os(name).map(std::path::PathBuf::from).ok_or(format!("{name} is not set"));
        let [emulator, hex, goodbot, embassy] = [emulator, "GOODBOT_MICROBIT", "GOODBOT_CLI", "GOODBOT_EMBASSY"].map(place);
        Ok::<_, String>(Setup { version, emulator: emulator?, hex: hex?, goodbot: goodbot?, embassy: embassy.ok() })
    };
    let (v1, v2) = (setup(&V1, "GOODBOT_QEMU"), setup(&V2, "GOODBOT_UNICORN"));
    let embassy =
        v1.clone().and_then(|setup| setup.embassy.is_some().then_some(setup).ok_or_else(|| "GOODBOT_EMBASSY is not set".to_owned()));
    let test = |setup: &Result<Setup, String>, name: &str, run: fn(&Setup)| {
        let setup = setup.clone();
        let absent = setup.is_err();
        Trial::test(name, move || setup.as_ref().map(run).map_err(Failed::from))
            .with_ignored_flag(absent)
            .with_kind("needs an emulated board")
    };
    macro_rules! tests {
        ($($setup:ident: $file:ident::$name:ident),* $(,)?) => { vec![$(test(&$setup, &format!("{}_{}", stringify!($setup), stringify!($name)), $file::$name)),*] };
    }
    let tests = tests![
        v1: lessons::the_papers_course_is_learned_over_the_serial_line,
        v1: lessons::a_lesson_is_given_with_the_buttons_alone,
        v1: lessons::the_lights_show_the_rooms_the_robot_and_the_block,
        v1: lessons::a_power_cut_at_any_write_of_a_store_leaves_the_lessons_of_before,
        v1: lessons::what_a_robot_learned_elsewhere_comes_with_the_file_and_its_home_and_commands_too,
        embassy: embassy::a_lesson_is_given_by_buttons_and_outlives_the_battery,
        v1: lessons::a_lesson_of_given_actions_is_learned_and_the_model_is_fetched_as_it_is_stored,
        v1: lessons::what_is_said_wrongly_is_answered_and_changes_nothing,
        v2: lessons::the_papers_course_is_learned_over_the_serial_line,
        v2: lessons::each_button_says_its_word_and_both_end_the_lesson,
        v2: lessons::the_lights_show_the_rooms_the_robot_and_the_block,
        v2: lessons::what_a_robot_learned_elsewhere_comes_with_the_file_and_its_home_and_commands_too,
    ];
    libtest_mimic::run(&Arguments::from_args(), tests).exit_code()
}

#[cfg(not(unix))]
fn main() -> ExitCode {
    ExitCode::SUCCESS
}
