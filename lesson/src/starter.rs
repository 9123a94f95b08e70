//! Starters: goodbot's own everyday sentences in five languages, for a robot to begin with. Its own sessions replace them.
//!
//! A starter is a text with words for values, and with sentences that have gaps for these words. Each sentence becomes a labelled session
//! in a home that has the things it names. Beside n sessions of the user, the share 1 / (1 + n / 32) of the sentences is learned from: with
//! many sessions, the user's own words count alone.

use goodbot::home::{AGENT_IN_ROOM, BLOCK_IN_ROOM};
use goodbot::oomdp::PropositionId;
use goodbot::snapshot::is_beside;
use goodbot::task::LiftedTask;
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};

/// How often each sentence is used, with other things each time.
const TIMES: usize = 2;

/// The text of a language's starter; empty for a language without one.
fn text(language: &str) -> &'static str {
    match language {
        "de" => include_str!(concat!(env!("OUT_DIR"), "/de.txt")),
        "en" => include_str!(concat!(env!("OUT_DIR"), "/en.txt")),
        "es" => include_str!(concat!(env!("OUT_DIR"), "/es.txt")),
        "fr" => include_str!(concat!(env!("OUT_DIR"), "/fr.txt")),
        "zh" => include_str!(concat!(env!("OUT_DIR"), "/zh.txt")),
        _ => "",
    }
}

/// A sentence with its meaning, in a home that has the things it names.
#[derive(Clone, Debug)]
pub struct Sentence {
    /// The sentence.
    pub command: String,
    /// The home.
    pub home: EnvironmentFile,
    /// The name of its task.
    pub intended: &'static str,
}

/// The sentences of a language (`de`, `en`, `es`, `fr` or `zh`), for a robot with these kinds of task. Sentences of other kinds are left
/// out.
pub fn sentences(language: &str, lifted: &[LiftedTask]) -> Vec<Sentence> {
    let text = Text::of(text(language));
    let count = text.sentences.len();
    let numbered = (0..TIMES * count).zip(text.sentences.iter().cycle());
    numbered.filter(|(_, (kind, _))| kind.is_of(lifted)).map(|(number, (kind, said))| text.sentence(*kind, said, number)).collect()
}

/// The items of a starter to learn from beside this many sessions of the user.
pub fn beside<T>(all: &[T], own: usize) -> impl Iterator<Item = &T> {
    all.iter().enumerate().filter(move |(position, _)| is_beside(*position, all.len(), own)).map(|(_, item)| item)
}

/// The task of a sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// The robot in a room.
    Go,
    /// A thing in a room.
    Take,
    /// A thing in a room, and then the robot in another.
    Both,
}

impl Kind {
    /// Whether one of these kinds of task is meant.
    fn is_of(self, lifted: &[LiftedTask]) -> bool {
        let wanted: &[PropositionId] = match self {
            Self::Go => &[AGENT_IN_ROOM],
            Self::Take => &[BLOCK_IN_ROOM],
            Self::Both => &[AGENT_IN_ROOM, BLOCK_IN_ROOM],
        };
        let is_wanted = |task: &LiftedTask| {
            let goals = task.propositions();
            !task.has_way() && goals.len() == wanted.len() && wanted.iter().all(|&goal| goals.iter().any(|it| it.proposition == goal))
        };
        lifted.iter().any(is_wanted)
    }

    /// The task's name in the home of a sentence.
    const fn task(self) -> &'static str {
        match self {
            Self::Go => "agentInRoom(agent0,room0)",
            Self::Take => "blockInRoom(block0,room0)",
            Self::Both => "agentInRoom(agent0,room2) & blockInRoom(block0,room0)",
        }
    }
}

/// The parts of a starter's text.
#[derive(Default)]
struct Text<'t> {
    /// A colour's value, and the forms of its word in the language, with slashes between.
    colors: Vec<(&'t str, &'t str)>,
    /// A shape's value, and its name with a gap for the colour.
    things: Vec<(&'t str, &'t str)>,
    sentences: Vec<(Kind, &'t str)>,
}

impl<'t> Text<'t> {
    fn of(text: &'t str) -> Self {
        let mut read = Self::default();
        for line in text.lines() {
            match line.split_once(' ') {
                Some(("go", sentence)) => read.sentences.push((Kind::Go, sentence)),
                Some(("take", sentence)) => read.sentences.push((Kind::Take, sentence)),
                Some(("both", sentence)) => read.sentences.push((Kind::Both, sentence)),
                _ => {
                    read.colors.extend(line.split_once('='));
                    read.things.extend(line.split_once(':'));
                }
            }
        }
        read
    }

    /// A sentence with its gaps filled. `number` selects the values.
    fn sentence(&self, kind: Kind, sentence: &str, number: usize) -> Sentence {
        // Four rooms and two things of different colours, in turn.
        let color = |place: usize| number.wrapping_mul(5).wrapping_add(place * (1 + number / self.colors.len() % 3)) % self.colors.len();
        let [goal, start, other, last] = [0, 1, 2, 3].map(color);
        let (own, second) = ((number * 7 + 3) % self.colors.len(), (number * 7 + 8) % self.colors.len());
        let thing = |place: usize| self.things.get(place % self.things.len()).copied().unwrap_or_default();
        let ((shape, name), (beside, _)) = (thing(number), thing(number + 1));
        let value = |color: usize| self.colors.get(color).map_or("", |(value, _)| *value).to_owned();
        let word = |color: usize, form: usize| {
            let forms = self.colors.get(color).map_or("", |(_, forms)| *forms);
            forms.split('/').nth(form).or_else(|| forms.split('/').next()).unwrap_or_default().to_owned()
        };
        let named = || filled(name, |gap| word(own, usize::from(gap == "c")));
        let plain = || match name.split_once('的') {
            Some((_, noun)) => noun.to_owned(),
            None => {
                let words: Vec<&str> = name.split(' ').filter(|word| !word.starts_with('{')).collect();
                words.join(" ")
            }
        };
        let command = filled(sentence, |gap| match gap {
            "T" => named(),
            "N" => plain(),
            "R" => word(goal, 0),
            "r" => word(goal, 1),
            "F" => word(start, 0),
            "f" => word(start, 1),
            "O" => word(other, 0),
            _ => word(other, 1),
        });
        let room = |name: &str, [left, bottom]: [i32; 2], color: usize| {
            let (name, color) = (name.to_owned(), value(color));
            ObjectRecord::Room { name, left, bottom, right: left + 4, top: bottom + 4, color }
        };
        let door = |name: &str, [x, y]: [i32; 2]| ObjectRecord::Door { name: name.to_owned(), left: x, bottom: y, right: x, top: y };
        let block = |name: &str, y: i32, color: usize, shape: &str| ObjectRecord::Block {
            name: name.to_owned(),
            x: 6,
            y,
            color: value(color),
            shape: shape.to_owned(),
        };
        let objects = vec![
            room("room0", [0, 0], goal),
            room("room1", [4, 0], start),
            room("room2", [0, 4], other),
            room("room3", [4, 4], last),
            door("door0", [4, 2]),
            door("door1", [4, 6]),
            door("door2", [2, 4]),
            door("door3", [6, 4]),
            block("block0", 2, own, shape),
            block("block1", 6, second, beside),
            ObjectRecord::Agent { name: "agent0".to_owned(), x: 5, y: 1 },
        ];
        Sentence { command, home: EnvironmentFile::new(objects), intended: kind.task() }
    }
}

/// A text with its gaps filled: `{R}` by `fill("R")`.
fn filled(text: &str, fill: impl Fn(&str) -> String) -> String {
    let mut parts = text.split('{');
    let mut whole = parts.next().unwrap_or_default().to_owned();
    for (gap, after) in parts.filter_map(|part| part.split_once('}')) {
        whole += &fill(gap);
        whole += after;
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use goodbot::home::{SCHEMA, paper_tasks};

    const LANGUAGES: [&str; 5] = ["de", "en", "es", "fr", "zh"];

    #[test]
    fn a_starter_says_a_hundred_things_in_little_room() {
        for language in LANGUAGES {
            let sentences = sentences(language, &paper_tasks().unwrap());
            assert!(text(language).len() <= 4_096 && sentences.len() >= 80, "{language}: {}", sentences.len());
            for Sentence { command, .. } in sentences {
                assert!(!command.contains(['{', '}']), "{command}");
            }
        }
        assert!(sentences("a language without a starter", &paper_tasks().unwrap()).is_empty());
    }

    #[test]
    fn the_model_card_tells_how_many_sessions_each_starter_has() {
        let card = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/appendix/model-card.md")).unwrap();
        let both = LiftedTask::parse("agentInRoom(?a,?r1) & blockInRoom(?o,?r2)", &SCHEMA).unwrap();
        let [paper, all] = [vec![], vec![both]].map(|more| [&paper_tasks().unwrap()[..], &more].concat());
        let counts = |lifted: &[LiftedTask]| LANGUAGES.map(|language| sentences(language, lifted).len());
        let (whole, of_paper) = (counts(&all), counts(&paper));
        let list = |counts: &[usize]| {
            let counts: Vec<String> = counts.iter().map(usize::to_string).collect();
            counts.split_last().map(|(last, others)| format!("{} and {last}", others.join(", "))).unwrap()
        };
        let left_out: Vec<usize> = whole.iter().zip(of_paper).map(|(whole, paper)| whole - paper).collect();
        for told in [format!("thus {} sessions", list(&whole)), format!("leaves out {} of the sessions", list(&left_out))] {
            assert!(card.contains(&told), "{told}");
        }
    }
}
