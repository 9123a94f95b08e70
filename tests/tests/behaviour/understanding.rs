//! The options of the language model, each tested by its effect.

use goodbot::home::{self, Area, Cell, HomeBuilder, Moves};
use goodbot::language::Settings;
use goodbot::task::{LiftedTask, TokenOrder};
use goodbot::{Agent, Capacities, HeapMemory, Options};

/// The number of different machine commands of "agent to one room, block to the other" and of its exchange.
fn distinct_commands(order: TokenOrder) -> usize {
    let (mut homes, mut minds) = (HeapMemory::new(&Capacities::SMALL), HeapMemory::new(&Capacities::STANDARD));
    let mut builder = HomeBuilder::new(&mut homes.home);
    builder.room("room0", Area::new(0, 0, 8, 4), "red").unwrap();
    builder.room("room1", Area::new(0, 4, 8, 8), "green").unwrap();
    builder.room("room2", Area::new(8, 0, 12, 8), "blue").unwrap();
    builder.agent("agent0", Cell::new(4, 2)).unwrap();
    builder.block("block0", Cell::new(2, 2), "yellow", "bag").unwrap();
    let (home, state) = builder.build(Moves::Push).unwrap();
    let both = LiftedTask::parse("agentInRoom(?a,?r1) & blockInRoom(?o,?r2)", &home::SCHEMA).unwrap();
    let language = Settings { order, ..Settings::SMOOTHED };
    let mut agent = Agent::new(&mut minds.agent, &[both], Options { language, ..Options::SMOOTHED }).unwrap();
    agent.hear(&home, &state, "go").unwrap();
    agent.candidates().entries().len()
}

#[test]
fn facts_beside_their_proposition_tell_exchanged_rooms_apart() {
    assert!(distinct_commands(TokenOrder::Propositions) > distinct_commands(TokenOrder::Attributes));
}

#[test]
fn words_that_begin_alike_are_one_word_where_letters_count() {
    let words = |language| {
        let mut memory = HeapMemory::new(&Capacities::SMALL);
        let mut model = goodbot::language::LanguageModel::new(&mut memory.agent, language).unwrap();
        model.lend().hear("orange orangey oranges").unwrap();
        model.read().words().len()
    };
    assert_eq!((words(Settings::SMOOTHED), words(Settings::PAPER)), (1, 3));
}
