//! Help, completions and the manual page know every command.

use crate::program::goodbot;

/// The names in a list of the help: those at the start of its lines.
fn names(list: &str) -> Vec<&str> {
    let lines = list.lines().filter_map(|line| line.strip_prefix("  "));
    lines.filter(|line| line.starts_with(|c: char| c.is_ascii_lowercase())).filter_map(|line| line.split_whitespace().next()).collect()
}

/// The help's lists of commands, in its order.
fn lists(help: &str) -> [Vec<&str>; 4] {
    let (_, rest) = help.split_once("\nCommands:\n").expect("the everyday commands");
    let (everyday, rest) = rest.split_once("\nFor controllers:\n").expect("those for controllers");
    let (boards, rest) = rest.split_once("\nThe laboratory:\n").expect("the laboratory");
    let (laboratory, rest) = rest.split_once("\nThis program:\n").expect("the program itself");
    let (itself, _) = rest.split_once("\nOptions:\n").expect("the options");
    [everyday, boards, laboratory, itself].map(names)
}

#[test]
fn the_help_names_each_command_once_and_the_everyday_ones_first() {
    // The completions for Bash list all commands in one line.
    let completions = goodbot(&["completions", "bash"], b"").output;
    let offered = completions.lines().map(str::trim).find(|line| line.starts_with("opts=\"-")).expect("a list");
    let offered = offered.trim_start_matches("opts=\"").trim_end_matches('"');
    let mut commands: Vec<&str> = offered.split_whitespace().filter(|word| !word.starts_with('-')).collect();
    commands.sort_unstable();
    assert!(commands.len() > 15, "{commands:?}");
    for help in [&["--help"][..], &["-h"], &["help"]] {
        let help = goodbot(help, b"").output;
        let [everyday, boards, laboratory, itself] = lists(&help);
        assert!(everyday.contains(&"teach") && everyday.len() <= 10, "{everyday:?}");
        assert!(laboratory.contains(&"study"), "{laboratory:?}");
        assert_eq!(boards, ["size", "table", "convert", "microbit", "parameters", "migrate"]);
        let mut named = [everyday, boards, laboratory, itself].concat();
        named.sort_unstable();
        assert_eq!(named, commands, "{help}");
    }
}

#[test]
fn each_command_has_its_own_help_and_its_part_of_the_manual() {
    let help = goodbot(&["--help"], b"").output;
    let manual = goodbot(&["man"], b"").output;
    assert!(manual.contains(".TH goodbot 1"), "{manual}");
    for command in lists(&help).concat().into_iter().filter(|name| *name != "help") {
        let help = goodbot(&["help", command], b"");
        assert!(help.code == 0 && help.output.contains(&format!("Usage: goodbot {command}")), "{}", help.output);
        assert!(manual.contains(&format!("GOODBOT {}", command.to_uppercase())), "{command}");
    }
}

#[test]
fn the_first_help_is_short_and_leaves_the_options_of_a_command_to_its_own() {
    let help = goodbot(&["--help"], b"").output;
    assert!(help.lines().count() <= 66, "{} lines:\n{help}", help.lines().count());
    assert!(help.contains("--quiet") && help.contains("--color") && !help.contains("--layouts"), "{help}");
    assert_eq!(goodbot(&["--runs", "2", "--csv"], b"").output, goodbot(&["paper", "--runs", "2", "--csv"], b"").output);
}

#[test]
fn help_and_completions_teach() {
    assert!(goodbot(&["--help"], b"").output.contains("goodbot --runs 200 --json | tail -1"));
    let paper = goodbot(&["paper", "--help"], b"").output;
    assert!(paper.contains("punish-only  0.7,0.05,0.1") && paper.contains("--layouts"), "{paper}");
    for shell in ["bash", "zsh", "fish"] {
        assert!(goodbot(&["completions", shell], b"").output.contains("trainer"));
    }
}
