//! Starters: robots begin with goodbot's own everyday sentences in one of five languages. Later sessions replace these sentences.
//!
//! A starter is a text with words for values, and with sentences that have gaps for these words. Each sentence becomes a labelled session
//! in a home that has the things it names. Beside n sessions of the user, the share 1 / (1 + n / 4) of the sentences is learned from: with
//! many sessions, the user's own words count alone.

use crate::outcome::Failure;
use crate::training_data::Lesson;
use crate::training_data::evidence::Witness;
use crate::training_data::training;
use crate::whole_file::options_of_model;
use clap::{Args, ValueEnum};
use goodbot::capacity::Capacity;
use goodbot::home::{AGENT_IN_ROOM, BLOCK_IN_ROOM};
use goodbot::language::Model;
use goodbot::memory::AgentHeap;
use goodbot::oomdp::PropositionId;
use goodbot::snapshot::SAVED;
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};
use goodbot_formats::session::SessionReader;
use serde_json::{Value, json};
use std::path::Path;

/// The languages of the starters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Language {
    /// German
    De,
    /// English
    En,
    /// Spanish
    Es,
    /// French
    Fr,
    /// Chinese
    Zh,
}

impl Language {
    const fn text(self) -> &'static str {
        match self {
            Self::De => include_str!("../starter/de.txt"),
            Self::En => include_str!("../starter/en.txt"),
            Self::Es => include_str!("../starter/es.txt"),
            Self::Fr => include_str!("../starter/fr.txt"),
            Self::Zh => include_str!("../starter/zh.txt"),
        }
    }
}

/// The option for the starter.
#[derive(Clone, Copy, Debug, Args)]
pub struct StarterOptions {
    /// Begin with everyday sentences in a language; they count less with each session of your own
    #[arg(long, value_enum, value_name = "LANGUAGE")]
    starter: Option<Language>,
}

impl StarterOptions {
    /// Whether a starter is asked for.
    pub const fn is_given(&self) -> bool {
        self.starter.is_some()
    }

    /// The starter to add to a model file.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read), and an error if the file is no model.
    pub fn of_model(&self, file: &Path, lifted: &[LiftedTask]) -> Result<Starter, Failure> {
        if self.is_given() { self.read(lifted, options_of_model(file)?) } else { Ok(Starter::default()) }
    }

    /// The starter; without the option, it has no lessons.
    ///
    /// # Errors
    /// [`Failure::Input`] for the paper's settings, and for tasks that make a sentence unreadable.
    pub fn read(&self, lifted: &[LiftedTask], options: Options) -> Result<Starter, Failure> {
        match self.starter {
            None => Ok(Starter::default()),
            Some(_) if options.language.model != Model::Roles => {
                Err(Failure::Input("--starter is not for the paper's settings; leave out --learner or --starter".to_owned()))
            }
            Some(language) => Starter::new(language, lifted, options),
        }
    }
}

/// With this many sessions of the user, half of the starter's sentences are left.
const HALF: usize = 4;
/// How often each sentence is used, with other things each time.
const TIMES: usize = 2;

/// Lessons beside the user's own: the more own lessons, the fewer of these.
#[derive(Clone, Debug, Default)]
pub struct Starter {
    lessons: Vec<Lesson>,
}

impl Starter {
    /// The starter in a language, for a robot with these kinds of task. Sentences of other kinds are left out.
    ///
    /// # Errors
    /// [`Failure::Input`] for tasks that make a sentence unreadable.
    pub fn new(language: Language, lifted: &[LiftedTask], options: Options) -> Result<Self, Failure> {
        let fault = |error: &dyn std::fmt::Display| Failure::Input(format!("the starter: {error}"));
        let mut witness = Witness::new(lifted, options, None, false).map_err(|error| fault(&error))?;
        let text = Text::of(language.text());
        let mut lessons = Vec::new();
        for time in 0..TIMES {
            for (number, (kind, sentence)) in text.sentences.iter().enumerate() {
                if !kind.is_of(lifted) {
                    continue;
                }
                let log = text.session(*kind, sentence, number + time * text.sentences.len());
                for session in SessionReader::new(log.as_bytes()) {
                    let session = session.map_err(|error| fault(&error))?;
                    lessons.push(witness.lesson("starter", &session)?);
                }
            }
        }
        Ok(Self { lessons })
    }

    /// All its lessons.
    pub fn lessons(&self) -> &[Lesson] {
        &self.lessons
    }

    /// The lessons to learn from beside this many own ones, taken evenly from all.
    pub fn beside(&self, own: usize) -> impl Iterator<Item = &Lesson> {
        let all = self.lessons.len();
        let left = (all * HALF).div_ceil(HALF + own).min(all);
        (0..left).filter_map(move |position| self.lessons.get(position * all / left.max(1)))
    }

    /// These capacities, plus room for all its lessons.
    pub fn room(&self, own: Capacities) -> Capacities {
        if self.lessons.is_empty() {
            return own;
        }
        let (needed, mut both) = (training::capacities(&self.lessons, Capacities::NONE), own);
        for capacity in SAVED {
            both.set(capacity, own.get(capacity).saturating_add(needed.get(capacity)));
        }
        both.translations = both.translations.max((both.tokens + 1).saturating_mul(both.words));
        both.set(Capacity::Alignments, both.alignments.max(needed.alignments));
        both
    }

    /// Adds the lessons beside this many own ones to an agent's training data, and begins training. Returns how many were added; lessons
    /// that the agent has already are not.
    ///
    /// # Errors
    /// [`Failure::Input`] if the agent has no room, or has another language model.
    pub fn join(&self, agent: &mut Agent<AgentHeap>, own: usize) -> Result<usize, Failure> {
        if self.lessons.is_empty() {
            return Ok(0);
        }
        let fault = |error: &dyn std::fmt::Display| Failure::Input(format!("the starter: {error}"));
        let settings = agent.options().language;
        let mut memory = training::memory(&self.lessons, &settings);
        let data = training::data(&mut memory, self.beside(own), settings).map_err(|error| fault(&error))?;
        let file = data.saved().map_err(|error| fault(&error))?;
        agent.join(&file).map_err(|error| fault(&error))
    }
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
}

/// The parts of a starter's text.
struct Text<'t> {
    /// A colour's value, and the forms of its word in the language.
    colors: Vec<(&'t str, Vec<&'t str>)>,
    /// A shape's value, and its name with a gap for the colour.
    things: Vec<(&'t str, &'t str)>,
    sentences: Vec<(Kind, &'t str)>,
}

impl<'t> Text<'t> {
    fn of(text: &'t str) -> Self {
        let mut read = Self { colors: vec![], things: vec![], sentences: vec![] };
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            if let Some((kind, sentence)) = line.split_once(' ').and_then(|(kind, sentence)| {
                let kind = match kind {
                    "go" => Kind::Go,
                    "take" => Kind::Take,
                    "both" => Kind::Both,
                    _ => return None,
                };
                Some((kind, sentence))
            }) {
                read.sentences.push((kind, sentence));
            } else if let Some((value, words)) = line.split_once('=') {
                read.colors.push((value, words.split('/').collect()));
            } else if let Some((value, name)) = line.split_once(':') {
                read.things.push((value, name));
            }
        }
        read
    }

    /// A labelled session of a sentence with its gaps filled, in a home that has the things it names. `number` selects the values.
    fn session(&self, kind: Kind, sentence: &str, number: usize) -> String {
        // Four rooms and two things of different colours, in turn.
        let color = |place: usize| number.wrapping_mul(5).wrapping_add(place * (1 + number / self.colors.len() % 3)) % self.colors.len();
        let [goal, start, other, last] = [0, 1, 2, 3].map(color);
        let (own, second) = ((number * 7 + 3) % self.colors.len(), (number * 7 + 8) % self.colors.len());
        let (thing, beside) = (number % self.things.len(), (number + 1) % self.things.len());
        let value = |color: usize| self.colors.get(color).map_or("", |(value, _)| *value);
        let word = |color: usize, form: usize| {
            self.colors.get(color).and_then(|(_, forms)| forms.get(form).or(forms.first())).map_or("", |word| *word)
        };
        let (shape, name) = self.things.get(thing).copied().unwrap_or(("", ""));
        let named = name.replace("{C}", word(own, 0)).replace("{c}", word(own, 1));
        let plain: Vec<&str> = name.split_inclusive(' ').filter(|part| !part.contains('{')).collect();
        let plain = match name.split_once("的") {
            Some((_, noun)) => noun.to_owned(),
            None => plain.concat().trim_end().to_owned(),
        };
        let mut command = sentence.replace("{T}", &named).replace("{N}", &plain);
        for (gap, color) in [('R', goal), ('F', start), ('O', other)] {
            command = command.replace(&format!("{{{gap}}}"), word(color, 0));
            command = command.replace(&format!("{{{}}}", gap.to_ascii_lowercase()), word(color, 1));
        }
        let room = |name: &str, [left, bottom]: [u8; 2], color: usize| json!({"class": "room", "name": name, "left": left, "bottom": bottom, "right": left + 4, "top": bottom + 4, "color": value(color)});
        let door = |name: &str, [x, y]: [u8; 2]| json!({"class": "door", "name": name, "left": x, "bottom": y, "right": x, "top": y});
        let block = |name: &str, [x, y]: [u8; 2], color: usize, shape: &str| json!({"class": "block", "name": name, "x": x, "y": y, "color": value(color), "shape": shape});
        let beside = self.things.get(beside).map_or("", |(shape, _)| *shape);
        let objects: Vec<Value> = vec![
            room("room0", [0, 0], goal),
            room("room1", [4, 0], start),
            room("room2", [0, 4], other),
            room("room3", [4, 4], last),
            door("door0", [4, 2]),
            door("door1", [4, 6]),
            door("door2", [2, 4]),
            door("door3", [6, 4]),
            block("block0", [6, 2], own, shape),
            block("block1", [6, 6], second, beside),
            json!({"class": "agent", "name": "agent0", "x": 5, "y": 1}),
        ];
        let intended = match kind {
            Kind::Go => vec!["agentInRoom(agent0,room0)"],
            Kind::Take => vec!["blockInRoom(block0,room0)"],
            Kind::Both => vec!["agentInRoom(agent0,room2)", "blockInRoom(block0,room0)"],
        };
        let header = json!({
            "type": "session", "version": 1, "kind": "labelled", "environment": {"version": 1, "objects": objects}, "command": command, "intended": intended,
        });
        format!("{header}\n{}\n", json!({"type": "end", "learn": true}))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training_data::training;
    use goodbot::home::paper_tasks;

    #[test]
    fn a_starter_says_a_hundred_things_in_little_room() {
        for language in Language::value_variants() {
            let starter = Starter::new(*language, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
            assert!(language.text().len() <= 4_096 && starter.lessons().len() >= 80, "{language:?}: {}", starter.lessons().len());
            for lesson in starter.lessons() {
                assert!(!lesson.command.contains(['{', '}']) && lesson.pairs.len() == 1, "{}", lesson.command);
            }
        }
    }

    #[test]
    fn the_model_card_tells_how_many_sessions_each_starter_has() {
        let card = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/model-card.md")).unwrap();
        let both = LiftedTask::parse("agentInRoom(?a,?r1) & blockInRoom(?o,?r2)", &goodbot::home::SCHEMA).unwrap();
        let [paper, all] = [vec![], vec![both]].map(|more| [&paper_tasks().unwrap()[..], &more].concat());
        let count = |language, lifted: &[LiftedTask]| Starter::new(language, lifted, Options::DEFAULT).unwrap().lessons().len();
        let [mut sessions, mut left_out] = [vec![], vec![]];
        for language in [Language::De, Language::En, Language::Es, Language::Fr, Language::Zh] {
            let whole = count(language, &all);
            sessions.push(whole.to_string());
            left_out.push((whole - count(language, &paper)).to_string());
        }
        let list = |counts: &[String]| counts.split_last().map(|(last, others)| format!("{} and {last}", others.join(", "))).unwrap();
        for told in [format!("thus {} sessions", list(&sessions)), format!("leaves out {} of the sessions", list(&left_out))] {
            assert!(card.contains(&told), "{told}");
        }
    }

    #[test]
    fn own_sessions_take_the_starters_place() {
        let starter = Starter::new(Language::En, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        let all = starter.lessons().len();
        let left = |own| starter.beside(own).count();
        assert_eq!([left(0), left(4), left(28)], [all, all.div_ceil(2), all.div_ceil(8)]);
        assert!(left(400) < 3 && Starter::default().beside(0).count() == 0);
    }

    #[test]
    fn a_robot_that_was_told_nothing_else_understands_everyday_sentences() {
        for (language, go, take) in [
            (Language::En, "go to the green room", "take the chair to the yellow room"),
            (Language::De, "geh in den grünen Raum", "bring den Stuhl in den gelben Raum"),
            (Language::Fr, "va dans la pièce verte", "porte la chaise dans la pièce jaune"),
            (Language::Es, "ve a la habitación verde", "lleva la silla a la habitación amarilla"),
            (Language::Zh, "去绿色的房间", "把椅子搬到黄色的房间"),
        ] {
            let lifted = paper_tasks().unwrap();
            let starter = Starter::new(language, &lifted, Options::DEFAULT).unwrap();
            let settings = Options::DEFAULT.language;
            let mut memory = training::memory(starter.lessons(), &settings);
            let mut model = training::train(&mut memory, starter.beside(0), settings).unwrap();
            let text = Text {
                colors: vec![("green", vec!["a"]), ("red", vec!["b"]), ("blue", vec!["c"]), ("yellow", vec!["d"])],
                ..Text::of("chair:x\nbag:y\nbox:z")
            };
            let mut witness = Witness::new(&lifted, Options::DEFAULT, None, false).unwrap();
            for command in [go, take] {
                let log = text.session(Kind::Go, command, 0);
                let session = SessionReader::new(log.as_bytes()).next().unwrap().unwrap();
                let lesson = witness.lesson("home", &session).unwrap();
                let posterior = training::posterior(&mut model, &lesson).unwrap();
                let best = posterior.iter().enumerate().max_by(|one, other| one.1.total_cmp(other.1)).unwrap().0;
                let label = &lesson.readings[best].label;
                let wanted = if command == go { "agentInRoom green" } else { "blockInRoom yellow chair yellow" };
                assert_eq!(label, wanted, "{command}");
            }
        }
    }
}
