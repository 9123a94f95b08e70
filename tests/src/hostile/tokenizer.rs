//! Commands: any text.

use goodbot::capacity::{NAME_BYTES, WORDS_PER_COMMAND};
use goodbot::language::for_each_word;
use goodbot::language::{LanguageModel, Settings};
use goodbot::{Capacities, HeapMemory};

/// Splits any text into words: each is short and has a letter or a digit, and the words joined again give as many words.
pub fn tokenizer(input: &[u8]) {
    let text = String::from_utf8_lossy(input);
    let words = |text: &str| {
        let mut words = Vec::new();
        for_each_word(text, |word| {
            words.push(word.to_owned());
            Ok(())
        })
        .map(|()| words)
    };
    let Ok(found) = words(&text) else { return };
    assert!(found.len() <= WORDS_PER_COMMAND);
    for word in &found {
        assert!(!word.is_empty() && word.len() <= NAME_BYTES && word.chars().any(char::is_alphanumeric), "{word:?}");
    }
    // Lower case of lower case may differ, as Unicode says; the number of words never does.
    assert_eq!(words(&found.join(" ")).map(|again| again.len()), Ok(found.len()));
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut model = LanguageModel::new(&mut memory.agent, Settings::PAPER).expect("settings to train with");
    assert_eq!(model.lend().hear(&text).map(|sentence| sentence.len()), Ok(found.len()));
    assert!(model.read().words().len() <= Capacities::SMALL.words);
}
