//! `goodbot merge`, as it is used.

use assert_cmd::Command;
use goodbot::home::paper_tasks;
use goodbot::snapshot::Contents;
use goodbot::symbols::Symbol;
use goodbot::{Agent, Capacities, HeapMemory, Options, language::LanguageModel};
use std::fs;
use std::path::Path;

/// A model file of what was said and meant, word by word.
fn model(sessions: &[(&str, &str)]) -> Vec<u8> {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut language = LanguageModel::new(memory.split().agent.language, Options::PAPER.language);
    for (english, machine) in sessions {
        let command: Vec<Symbol> = machine.split(' ').map(|token| language.tokens_mut().intern(token).unwrap()).collect();
        let sentence = language.hear(english).unwrap();
        language.add_session(&sentence, std::iter::once((&command[..], 1.0))).unwrap();
    }
    let mut bytes = vec![0; 4_096];
    let length = language.save(&mut bytes).unwrap();
    bytes.truncate(length);
    // As an agent of the home saves it.
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(memory.split().agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
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
    let one = |session: goodbot::snapshot::record::SessionRecord| {
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
fn a_model_may_be_merged_into_its_own_file() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.model"), model(&[("red", "roomIsRed room")])).unwrap();
    fs::write(folder.path().join("b.model"), model(&[("blue", "roomIsBlue room")])).unwrap();
    merge(folder.path(), "a.model").success();
    assert_eq!(sessions(&folder.path().join("a.model")), ["red: roomIsRed room", "blue: roomIsBlue room"]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing temporary is left");
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
