//! Robots that were taught in one language each, for the tests of single rules.

use super::context::DONE;
use super::words::Words;
use crate::Capacities;
use crate::home::{Area, Cell, Home, HomeBuilder, HomeState, Moves, paper_tasks};
use crate::language::for_each_piece;
use crate::memory::{AgentHeap, HomeHeap};
use crate::session::{Agent, Options};
use crate::task::TaskSet;
use crate::voice::classes::ClosedWords;
use heapless::Vec;
use std::borrow::ToOwned;
use std::collections::BTreeMap;
use std::format;
use std::string::String;
use std::vec;

const LESSONS: usize = 36;
const COLORS: [&str; 3] = ["red", "blue", "green"];
const THINGS: [(&str, &str); 4] = [("yellow", "chair"), ("purple", "bag"), ("purple", "chair"), ("yellow", "bag")];

/// The words of a language's lessons. In the commands, `R` is a room and `T` a thing.
struct Wording {
    language: &'static str,
    /// As in [`COLORS`].
    rooms: [&'static str; 3],
    /// As in [`THINGS`].
    things: [&'static str; 4],
    go: [&'static str; 2],
    take: [&'static str; 2],
}

const WORDINGS: [Wording; 5] = [
    Wording {
        language: "en",
        rooms: ["red room", "blue room", "green room"],
        things: ["yellow chair", "purple bag", "purple chair", "yellow bag"],
        go: ["go to the R", "walk into the R"],
        take: ["take the T to the R", "bring the T into the R"],
    },
    Wording {
        language: "de",
        rooms: ["rote Zimmer", "blaue Zimmer", "grüne Zimmer"],
        things: ["den gelben Stuhl", "die lila Tasche", "den lila Stuhl", "die gelbe Tasche"],
        go: ["geh ins R", "lauf in das R"],
        take: ["bring T ins R", "trag T in das R"],
    },
    Wording {
        language: "fr",
        rooms: ["salle rouge", "salle bleue", "salle verte"],
        things: ["la chaise jaune", "le sac violet", "la chaise violette", "le sac jaune"],
        go: ["va dans la R", "entre dans la R"],
        take: ["apporte T dans la R", "porte T à la R"],
    },
    Wording {
        language: "es",
        rooms: ["sala roja", "sala azul", "sala verde"],
        things: ["la silla amarilla", "el bolso morado", "la silla morada", "el bolso amarillo"],
        go: ["ve a la R", "entra en la R"],
        take: ["lleva T a la R", "pon T en la R"],
    },
    Wording {
        language: "zh",
        rooms: ["红色房间", "蓝色房间", "绿色房间"],
        things: ["黄色的椅子", "紫色的包", "紫色的椅子", "黄色的包"],
        go: ["去R", "走到R"],
        take: ["把T拿到R", "把T搬到R"],
    },
];

/// A robot that was taught in one language.
struct Taught {
    agent: Agent<AgentHeap>,
    home: Home<HomeHeap>,
    start: HomeState,
}

impl Taught {
    fn in_language(language: &str) -> Self {
        let wording = WORDINGS.iter().find(|wording| wording.language == language).unwrap();
        let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        for lesson in 0..LESSONS {
            // The robot and the things are in the middle room.
            let (place, one, of_two) = ([0, 2][lesson / 2 % 2], lesson / 3 % 4, lesson / 7 % 2);
            let room = (place + 2 * lesson) % 3;
            let (home, start) = home(lesson, [one, (one + 1 + lesson / 5 % 3) % 4]);
            let is_go = lesson % 5 < 2;
            let command = if is_go { wording.go[of_two] } else { wording.take[of_two] };
            agent.hear(&home, &start, &command.replace('T', wording.things[one]).replace('R', wording.rooms[room])).unwrap();
            let task = if is_go { format!("agentInRoom(agent0,room{place})") } else { format!("blockInRoom(block0,room{place})") };
            let task = agent.task_named(&home, &task).unwrap();
            let _ = agent.answered(TaskSet::of(task), true, 1e-6, 1).unwrap();
            agent.finish_for_later(&home).unwrap();
        }
        agent.begin_learning();
        agent.learn_fully();
        let (home, start) = home(0, [0, 1]);
        Self { agent, home, start }
    }

    /// Passes the words of a sentence to a test, as they are heard.
    fn hear(&mut self, sentence: &str, test: &mut dyn FnMut(Words<'_>)) {
        let Self { agent, home, start } = self;
        agent.open(home, start, sentence, DONE, false).unwrap();
        agent.begin_to_understand().unwrap();
        agent.take_up(home).unwrap();
        let mut words = Vec::new();
        let language = agent.language();
        let knows = |word: &str| language.words().find(word).is_some_and(|word| word.index() < language.tables().words());
        agent.hear_words(sentence, ClosedWords::ALL.spoken(&knows), &mut words).unwrap();
        test(Words::new(&words, sentence.ends_with(['?', '？'])));
        agent.leave();
    }
}

/// Three rooms in a row, with two things in the middle one. Each lesson has the next color on the left.
fn home(lesson: usize, things: [usize; 2]) -> (Home<HomeHeap>, HomeState) {
    let mut builder = HomeBuilder::new(HomeHeap::new(&Capacities::STANDARD));
    for (at, name) in ["room0", "room1", "room2"].into_iter().enumerate() {
        let left = 6 * at as i32;
        builder.room(name, Area::new(left, 0, left + 6, 6), COLORS[(at + 2 * lesson) % 3]).unwrap();
    }
    builder.door("door0", Area::new(6, 3, 6, 3)).unwrap();
    builder.door("door1", Area::new(12, 3, 12, 3)).unwrap();
    builder.agent("agent0", Cell::new(7, 3)).unwrap();
    for (at, (name, thing)) in ["block0", "block1"].into_iter().zip(things).enumerate() {
        let (color, shape) = THINGS[thing];
        builder.block(name, Cell::new(8 + 2 * at as i32, 2 + 2 * at as i32), color, shape).unwrap();
    }
    builder.build(Moves::Push).unwrap()
}

/// Passes each row's sentence to `test`, as words that a robot of the row's language hears, with the rest of the row.
pub(super) fn for_each<R>(rows: &[(&'static str, &str, R)], test: &dyn Fn(&str, Words<'_>, &R)) {
    let mut robots = BTreeMap::new();
    for (language, sentence, row) in rows {
        robots.entry(*language).or_insert_with(|| Taught::in_language(language)).hear(sentence, &mut |words| test(sentence, words, row));
    }
}

/// The pieces of a sentence that belong to some of its words, in their order.
pub(super) fn left(sentence: &str, words: Words<'_>) -> String {
    let (mut pieces, mut numbers) = (vec::Vec::new(), vec::Vec::new());
    for_each_piece(sentence, |piece| {
        pieces.push(piece.to_owned());
        Ok(())
    })
    .unwrap();
    numbers.extend(words.iter().map(|word| usize::from(word.piece)));
    numbers.dedup();
    numbers.into_iter().map(|number| pieces[number].as_str()).collect::<vec::Vec<_>>().join(" ")
}
