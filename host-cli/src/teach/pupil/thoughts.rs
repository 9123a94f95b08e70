//! The robot's beliefs and words: the tasks, the support of each word for each task, the words for each machine token, and its questions.

use super::Pupil;
use crate::teach::site::Site;
use crate::words::{Lexicon, in_plain_words, object_words, task_words, token_words};
use goodbot::asking::{Asking, Question, Subject};
use goodbot::home::BLOCK_IN_ROOM;
use goodbot::language::Model;
use goodbot::oomdp::Domain;
use goodbot::probability::{Scaled, total};
use goodbot::symbols::Symbol;
use goodbot::task::{GroundedTask, LiftedTask, Part};
use goodbot_console::{Failure, evidence};
use goodbot_lesson::first_words::heard;
use goodbot_lesson::live::LiveError;

/// A task that the command may mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Meaning {
    /// Its position, which does not change during the session.
    pub position: usize,
    /// The task as in logs: `agentInRoom(agent0,room1)`.
    pub name: String,
    /// The task in everyday words: `go to the green room`.
    pub words: String,
    /// Its present probability.
    pub probability: f32,
}

/// The support of a word of the command: its share for each task. A word without information has even shares.
#[derive(Clone, Debug, PartialEq)]
pub struct WordSupport {
    /// The word as in the command.
    pub word: String,
    /// Whether the robot has learned from this word before.
    pub known: bool,
    /// Its share for each task, by position; the sum is 1.
    pub shares: Vec<f32>,
}

/// A machine token, and the robot's words for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Idea {
    /// The machine token: `roomIsRed`.
    pub token: String,
    /// The token in plain words: `room is red`.
    pub words: String,
    /// The words that the robot expects for it, the most probable first, with their probabilities.
    pub called: Vec<(String, f32)>,
}

impl Pupil {
    /// A task in everyday words.
    pub(super) fn words_of(&self, position: usize) -> Option<String> {
        let agent = &self.lesson.agent;
        let task = agent.tasks().get(position)?;
        Some(task_words(self.lesson.home(), agent.lifted().get(usize::from(task.lifted))?, task))
    }

    /// The tasks that the command may mean, the most probable first; empty without a command.
    pub fn meanings(&self) -> Vec<Meaning> {
        let agent = &self.lesson.agent;
        let tasks = if self.lesson.is_under_way() { agent.tasks() } else { &[] };
        let named = |(position, task): (usize, &GroundedTask)| {
            let lifted = agent.lifted().get(usize::from(task.lifted))?;
            let name = self.lesson.name_of(position)?.to_string();
            Some(Meaning {
                position,
                name,
                words: task_words(self.lesson.home(), lifted, task),
                probability: agent.belief().probability(position),
            })
        };
        let mut meanings: Vec<Meaning> = tasks.iter().enumerate().filter_map(named).collect();
        meanings.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        meanings
    }

    /// The support of each word for each task: the probability of the word alone under the task, averaged over the task's machine commands.
    pub fn word_support(&self) -> Result<Vec<WordSupport>, Failure> {
        let command = self.lesson.command().ok_or(LiveError::NoSession)?;
        let (agent, home) = (&self.lesson.agent, self.lesson.home());
        let (language, sentence) = (agent.language(), agent.sentence());
        let learned = |word: &Option<Symbol>| word.filter(|word| word.index() < language.tables().words());
        let mut rows = vec![Vec::new(); sentence.len()];
        let start = agent.started_from(home).ok_or(LiveError::NoSession)?;
        for task in agent.tasks() {
            let commands = evidence::commands(home, agent.lifted(), task, &start, agent.options())?;
            if agent.options().language.model == Model::Roles {
                let description = commands.first().map(|command| evidence::description_symbols(language, command)).unwrap_or_default();
                rows.iter_mut().for_each(|row| row.push(Scaled::ZERO));
                language.word_by_word(sentence, &description, |position, probability| {
                    if let Some(slot) = rows.get_mut(position).and_then(|row| row.last_mut()) {
                        *slot = Scaled::new(probability);
                    }
                });
                continue;
            }
            let find = |command: &Vec<String>| command.iter().map(|token| language.tokens().find(token)).collect::<Option<Vec<_>>>();
            let commands: Vec<Vec<Symbol>> = commands.iter().filter_map(find).collect();
            for (at, row) in rows.iter_mut().enumerate() {
                // The other words keep their places in the sentence, but count as unknown.
                let alone: Vec<Option<Symbol>> =
                    sentence.iter().enumerate().map(|(other, word)| if other == at { *word } else { None }).collect();
                let sum = commands.iter().fold(Scaled::ZERO, |sum, command| sum.plus(language.likelihood(&alone, command)));
                row.push(sum.scaled_by(1.0 / commands.len().max(1) as f32));
            }
        }
        let said = heard(agent.options().language.model, command)?;
        let support = |((word, row), heard): ((String, Vec<Scaled>), &Option<Symbol>)| {
            let whole = total(row.iter().copied());
            let even = 1.0 / row.len().max(1) as f32;
            let shares = row.iter().map(|&part| if whole.is_zero() { even } else { part.over(whole) }).collect();
            WordSupport { word, known: learned(heard).is_some(), shares }
        };
        Ok(said.into_iter().zip(rows).zip(sentence.iter()).map(support).collect())
    }

    /// The words that the robot expects for each machine token, after its last training. Only the beginnings of words may be known: see
    /// [`word_letters`](Self::word_letters).
    pub fn ideas(&self) -> Vec<Idea> {
        let lexicon = Lexicon::of(self.lesson.agent.language());
        let idea = |(token, row): &(String, Vec<f32>)| {
            let called = lexicon.best(row, row.len()).into_iter().map(|(word, share)| (word.to_owned(), share)).collect();
            Idea { token: token.clone(), words: token_words(token), called }
        };
        lexicon.rows.iter().map(idea).collect()
    }

    /// How many letters of a word the robot keeps; 0 for all.
    pub fn word_letters(&self) -> usize {
        self.lesson.agent.options().language.letters_kept()
    }
}

/// A question in words.
#[derive(Clone, Debug, PartialEq)]
pub struct Asks {
    /// The question: `Do you mean the red room?`
    pub text: String,
    /// The choices, beside "none of these"; empty for a question with yes or no.
    pub choices: Vec<String>,
    /// The positions of the tasks for which the answer is yes; for choices, of all tasks that can be chosen.
    pub tasks: Vec<usize>,
}

impl Pupil {
    /// The question to ask here, if it teaches the robot more than acting does. The plan must be done.
    pub fn ask(&mut self, asking: &Asking) -> Result<Option<Asks>, Failure> {
        let question = self.lesson.ask(asking)?;
        Ok(question.and_then(|question| self.in_words(&question)))
    }

    /// The question that waits for its answer.
    pub fn open_question(&self) -> Option<Asks> {
        self.in_words(self.lesson.agent.open_question().filter(|_| self.lesson.is_under_way())?)
    }

    fn in_words(&self, question: &Question) -> Option<Asks> {
        let (agent, rooms) = (&self.lesson.agent, self.lesson.home());
        let task = |position: u8| {
            let task = agent.tasks().get(usize::from(position))?;
            Some(task_words(rooms, agent.lifted().get(usize::from(task.lifted))?, task))
        };
        let which = "Which of these do you mean?".to_owned();
        let (text, choices) = match question.subject {
            Subject::Object(object) => (format!("Do you mean the {}?", object_words(rooms, object)), vec![]),
            Subject::Kind(kind) => {
                let kind = agent.lifted().get(usize::from(kind))?;
                let text = match rooms {
                    Site::Floor(_) => kind_question(agent.lifted(), kind),
                    Site::Other(robot) => kind_in_world(robot, kind),
                };
                (text, vec![])
            }
            Subject::Task(position) => (format!("Do you mean: {}?", task(position)?), vec![]),
            Subject::WhichObject(objects, count) => {
                let named = objects.iter().take(usize::from(count)).map(|&object| format!("the {}", object_words(rooms, object)));
                (which, named.collect())
            }
            Subject::WhichTask(tasks, count) => (which, tasks.iter().take(usize::from(count)).filter_map(|&at| task(at)).collect()),
        };
        Some(Asks { text, choices, tasks: question.yes.iter().collect() })
    }
}

/// The question for a kind of task in a world from a file: `Is it about lamp on?`.
fn kind_in_world<D: Domain>(domain: &D, kind: &LiftedTask) -> String {
    let schema = domain.world().schema;
    let names: Vec<String> = kind.propositions().iter().map(|part| in_plain_words(schema.proposition_name(part.proposition))).collect();
    format!("Is it about \"{}\"?", names.join("\" and \""))
}

/// The question for a kind of task, among the kinds that the command may mean: `Shall I go somewhere myself, and not through a certain
/// room?`.
fn kind_question(all: &[LiftedTask], kind: &LiftedTask) -> String {
    let carries = kind.propositions().iter().any(|part| part.proposition == BLOCK_IN_ROOM);
    let mut text = if carries { "Shall I carry something" } else { "Shall I go somewhere myself" }.to_owned();
    let through = kind.way().filter(|(part, _)| matches!(part, Part::Through(_))).count();
    if kind.way().any(|(part, _)| matches!(part, Part::Before(_))) {
        text.push_str(", after something else");
    }
    match through {
        0 => {}
        1 => text.push_str(", through a certain room"),
        _ => text.push_str(", through one of two rooms"),
    }
    if kind.way().any(|(part, _)| part == Part::Avoiding) {
        text.push_str(", and not through a certain room");
    }
    if !kind.has_way() && all.iter().any(LiftedTask::has_way) {
        text.push_str(", whichever way");
    }
    text + "?"
}

#[cfg(test)]
mod tests {
    use super::*;
    use goodbot::home::{paper_tasks, with_routes};

    #[test]
    fn kinds_of_tasks_are_asked_for_with_their_ways_where_commands_may_mean_ways() {
        let paper = paper_tasks().unwrap();
        let ask = |all: &[LiftedTask]| all.iter().map(|kind| kind_question(all, kind)).collect::<Vec<_>>();
        assert_eq!(ask(&paper), ["Shall I go somewhere myself?", "Shall I carry something?"]);
        let with_ways = ask(&with_routes(&paper).unwrap());
        assert_eq!(with_ways[0], "Shall I go somewhere myself, whichever way?");
        let go = with_ways.iter().filter(|text| text.starts_with("Shall I go")).skip(1).collect::<Vec<_>>();
        assert_eq!(
            go,
            [
                "Shall I go somewhere myself, through a certain room?",
                "Shall I go somewhere myself, and not through a certain room?",
                "Shall I go somewhere myself, through one of two rooms?",
            ]
        );
    }
}
