//! `goodbot merge`, as it is used.

use assert_cmd::Command;
use goodbot::home::paper_tasks;
use goodbot::snapshot::Contents;
use goodbot::symbols::Symbol;
use goodbot::{Agent, Capacities, HeapMemory, Options, language::LanguageModel};
use std::fs;
use std::path::Path;

/// A model file that has learned these pairs of a command and its machine command.
fn model(sessions: &[(&str, &str)]) -> Vec<u8> {
    model_with(sessions, &Capacities::SMALL, Options::PAPER)
}

fn model_with(sessions: &[(&str, &str)], capacities: &Capacities, options: Options) -> Vec<u8> {
    let mut memory = HeapMemory::new(capacities);
    let mut language = LanguageModel::new(&mut memory.agent, options.language).unwrap();
    for (english, machine) in sessions {
        let command: Vec<Symbol> = machine.split(' ').map(|token| language.lend().tokens_mut().intern(token).unwrap()).collect();
        let sentence = language.lend().hear(english).unwrap();
        language.lend().add_session(&sentence, std::iter::once((&command[..], 1.0))).unwrap();
    }
    let mut bytes = vec![0; 1 << 20];
    let length = language.save(&mut bytes).unwrap();
    bytes.truncate(length);
    // The model as an agent of the home saves it.
    let mut memory = HeapMemory::new(capacities);
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), options).unwrap();
    agent.restore(&bytes).unwrap();
    let mut bytes = vec![0; agent.saved_bytes().unwrap()];
    agent.save(&mut bytes).unwrap();
    bytes
}

/// The sessions of a model file, as texts.
fn sessions(path: &Path) -> Vec<String> {
    let bytes = fs::read(path).unwrap();
    let contents = Contents::read(&bytes).unwrap();
    let words: Vec<&str> = contents.words.iter().collect();
    let tokens: Vec<&str> = contents.tokens.iter().collect();
    let commands: Vec<_> = contents.commands.iter().collect();
    let mut pairs = contents.pairs.iter();
    let text = |positions: &[u16], texts: &[&str]| positions.iter().map(|&at| texts[usize::from(at)]).collect::<Vec<_>>().join(" ");
    let one = |session: goodbot::snapshot::SessionRecord| {
        let pair = pairs.next().unwrap();
        format!("{}: {}", text(&session.words, &words), text(&commands[usize::from(pair.command)], &tokens))
    };
    contents.sessions.iter().map(one).collect()
}

fn merge(folder: &Path, out: &str) -> assert_cmd::assert::Assert {
    Command::cargo_bin("goodbot").unwrap().current_dir(folder).args(["merge", "a.model", "b.model", "--out", out]).assert()
}

#[test]
fn words_and_tokens_are_matched_by_name_and_a_common_past_is_kept_once() {
    let folder = tempfile::tempdir().unwrap();
    let common = ("go there", "agentInRoom agent room");
    fs::write(folder.path().join("a.model"), model(&[common, ("red", "roomIsRed room")])).unwrap();
    fs::write(folder.path().join("b.model"), model(&[common, ("blue red", "roomIsBlue room roomIsRed room"), common])).unwrap();
    merge(folder.path(), "c.model").success().stdout("").stderr("c.model: 4 sessions, 2 of them added; 4 words\n");
    let expected = [
        "go there: agentInRoom agent room",
        "red: roomIsRed room",
        "blue red: roomIsBlue room roomIsRed room",
        "go there: agentInRoom agent room",
    ];
    assert_eq!(sessions(&folder.path().join("c.model")), expected);
}

#[test]
fn a_model_is_not_merged_into_a_file_that_is_read() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.model"), model(&[("red", "roomIsRed room")])).unwrap();
    fs::write(folder.path().join("b.model"), model(&[("blue", "roomIsBlue room")])).unwrap();
    merge(folder.path(), "a.model").code(2).stderr("error: a.model: is read here, and would be replaced; write to another file\n");
    assert_eq!(sessions(&folder.path().join("a.model")), ["red: roomIsRed room"]);
    merge(folder.path(), "c.model").success();
    merge(folder.path(), "c.model").success();
    assert_eq!(sessions(&folder.path().join("c.model")), ["red: roomIsRed room", "blue: roomIsBlue room"]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3, "nothing temporary is left");
}

#[test]
fn a_damaged_model_is_bad_input_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let mut damaged = model(&[("red", "roomIsRed room")]);
    damaged[30] ^= 1;
    fs::write(folder.path().join("a.model"), model(&[("blue", "roomIsBlue room")])).unwrap();
    fs::write(folder.path().join("b.model"), damaged).unwrap();
    let message = "error: b.model: the model is damaged: its check does not match; take another copy\n";
    merge(folder.path(), "c.model").code(2).stdout("").stderr(message);
    assert!(!folder.path().join("c.model").exists());
    fs::remove_file(folder.path().join("b.model")).unwrap();
    merge(folder.path(), "c.model").code(2);
}

#[test]
fn conflicting_orders_of_words_and_tokens_are_resolved_by_name() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.model"), model(&[("go red", "agentInRoom agent room roomIsRed room"), ("blue", "roomIsBlue room")]))
        .unwrap();
    fs::write(folder.path().join("b.model"), model(&[("blue go", "roomIsBlue room agentInRoom agent room"), ("red", "roomIsRed room")]))
        .unwrap();
    merge(folder.path(), "c.model").success();
    let expected = [
        "go red: agentInRoom agent room roomIsRed room",
        "blue: roomIsBlue room",
        "blue go: roomIsBlue room agentInRoom agent room",
        "red: roomIsRed room",
    ];
    assert_eq!(sessions(&folder.path().join("c.model")), expected);
}

#[test]
fn the_same_model_twice_is_the_same_model() {
    let folder = tempfile::tempdir().unwrap();
    let same = model(&[("go there", "agentInRoom agent room"), ("go there", "agentInRoom agent room"), ("red", "roomIsRed room")]);
    fs::write(folder.path().join("a.model"), &same).unwrap();
    fs::write(folder.path().join("b.model"), &same).unwrap();
    merge(folder.path(), "c.model").success().stderr("c.model: 3 sessions, 0 of them added; 3 words\n");
    assert_eq!(sessions(&folder.path().join("c.model")), sessions(&folder.path().join("a.model")));
}

#[test]
fn models_of_any_capacities_are_merged() {
    let folder = tempfile::tempdir().unwrap();
    let large = Capacities {
        words: 3_000,
        word_bytes: 30_000,
        sessions: 3_000,
        sentence_words: 3_000,
        pairs: 3_000,
        translations: 20_000,
        ..Capacities::SMALL
    };
    let names: Vec<String> = (0..1_500).map(|word| format!("word{word}")).collect();
    let many: Vec<(&str, &str)> = names.iter().map(|name| (name.as_str(), "agentInRoom agent room")).collect();
    fs::write(folder.path().join("a.model"), model_with(&many, &large, Options::PAPER)).unwrap();
    fs::write(folder.path().join("b.model"), model_with(&[("red", "roomIsRed room")], &Capacities::TINY, Options::PAPER)).unwrap();
    merge(folder.path(), "c.model").success().stderr("c.model: 1501 sessions, 1 of them added; 1501 words\n");
}

#[test]
fn models_that_form_words_differently_are_refused_and_other_settings_are_named() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.model"), model(&[("red", "roomIsRed room")])).unwrap();
    fs::write(folder.path().join("b.model"), model_with(&[("blue", "roomIsBlue room")], &Capacities::SMALL, Options::DEFAULT)).unwrap();
    let message = "error: b.model: the models form words or machine commands differently (letters of a word that count, order of facts); \
                   learn both with the same settings\n";
    merge(folder.path(), "c.model").code(2).stdout("").stderr(message);
    assert!(!folder.path().join("c.model").exists());
    let short = Options { language: goodbot::language::Settings { rounds: 5, ..Options::PAPER.language }, ..Options::PAPER };
    fs::write(folder.path().join("b.model"), model_with(&[("blue", "roomIsBlue room")], &Capacities::SMALL, short)).unwrap();
    let message = "b.model: trained with other settings; those of a.model stay\nc.model: 2 sessions, 1 of them added; 2 words\n";
    merge(folder.path(), "c.model").success().stderr(message);
}
