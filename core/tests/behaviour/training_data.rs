//! The training data that the language model accepts, and its refusals.

use goodbot::capacity::{Capacity, TOKENS_PER_COMMAND};
use goodbot::language::{LanguageModel, Settings};
use goodbot::memory::AgentHeap;
use goodbot::planning::Progress;
use goodbot::symbols::Symbol;
use goodbot::{Capacities, HeapMemory};

fn memory() -> HeapMemory {
    HeapMemory::new(&Capacities { words: 8, word_bytes: 8, ..Capacities::SMALL })
}

/// A model with one learned command, whose meaning was one machine token.
fn taught(memory: &mut HeapMemory) -> LanguageModel<&mut AgentHeap> {
    let mut model = LanguageModel::new(&mut memory.agent, Settings::PAPER).unwrap();
    let go = model.lend().tokens_mut().intern("agentInRoom").unwrap();
    let sentence = model.lend().hear("go red").unwrap();
    model.lend().add_session(&sentence, [([go].as_slice(), 0.75)].into_iter()).unwrap();
    model
}

#[test]
fn training_that_begins_anew_forgets_what_it_had_counted() {
    let (mut once, mut twice) = (memory(), memory());
    let (mut once, mut twice) = (taught(&mut once), taught(&mut twice));
    let teach_more = |model: &mut LanguageModel<&mut AgentHeap>| {
        let room = model.lend().tokens_mut().intern("room").unwrap();
        let sentence = model.lend().hear("red").unwrap();
        model.lend().add_session(&sentence, [([room].as_slice(), 1.0)].into_iter()).unwrap();
        model.lend().begin_training();
        while model.lend().train(u32::MAX) == Progress::Working {}
    };
    teach_more(&mut once);
    twice.lend().begin_training();
    assert_eq!(twice.lend().train(1), Progress::Working);
    teach_more(&mut twice);
    for word in 0..2 {
        for token in [None, Some(Symbol::new(0)), Some(Symbol::new(1))] {
            assert_eq!(
                once.read().tables().translation(Symbol::new(word), token),
                twice.read().tables().translation(Symbol::new(word), token)
            );
        }
    }
}

#[test]
fn a_machine_command_too_long_is_refused_and_what_was_learned_stays() {
    let mut memory = memory();
    let mut model = taught(&mut memory);
    let sentence = model.lend().hear("go").unwrap();
    let long = [Symbol::new(0); TOKENS_PER_COMMAND + 1];
    let error = model.lend().add_session(&sentence, [(long.as_slice(), 1.0)].into_iter()).unwrap_err();
    assert_eq!((error.capacity, error.given), (Capacity::TokensPerCommand, TOKENS_PER_COMMAND as u32 + 1));
    assert_eq!(model.read().bitext().sessions(), 1);
}

#[test]
fn a_word_that_finds_no_room_is_refused_by_the_name_of_what_is_full() {
    let mut memory = memory();
    let mut model = taught(&mut memory);
    // Two words of eight are known, but five of eight bytes are taken.
    let sentence = model.lend().hear("go yellow").unwrap();
    let error = model.lend().add_session(&sentence, [([Symbol::new(0)].as_slice(), 1.0)].into_iter()).unwrap_err();
    assert_eq!((error.capacity, error.limit), (Capacity::WordBytes, 8));
}
