//! The robot's questions, as a page shows them, and the trainer's answers; which word of a command speaks for which task; and the next lesson to
//! teach, by the words that this robot has heard.

use crate::view::{About, AnswerEvidence, NextLesson, Question, Support};
use crate::world::{Refusal, World};
use goodbot::Agent;
use goodbot::asking::{Asking, Considered, Subject};
use goodbot::capacity::{Capacity, CapacityError};
use goodbot::home::{BLOCK_IN_ROOM, Home};
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::oomdp::ObjectId;
use goodbot::symbols::{Symbol, Symbols};
use goodbot::task::description::{Scene, describe};
use goodbot::task::{Part, TaskSet, Tokens, is_marker};
use goodbot_course::next_lesson::{next_lesson, times_heard};
use goodbot_lesson::asking::answer_of;
use std::cell::RefCell;
use std::collections::BTreeMap;
use wasm_bindgen::prelude::*;

impl World {
    /// Proposes a question if it teaches more than acting, with at most about `budget` node expansions: see
    /// [`Lesson::consider`](goodbot_lesson::live::Lesson::consider). The plan must be done. `None`: call again; `Some(None)`: there is nothing to ask.
    ///
    /// # Errors
    /// Where no session is under way, or the plan is not done.
    pub fn question(&mut self, budget: u32) -> Result<Option<Option<Question>>, Refusal> {
        Ok(match self.lesson.consider(&Asking::DEFAULT, budget).map_err(Refusal::from)? {
            Considered::Working => None,
            Considered::Act => Some(None),
            Considered::Ask(_) => Some(self.open_question()),
        })
    }

    /// The open question.
    pub fn open_question(&self) -> Option<Question> {
        let (agent, home) = (self.agent(), self.home());
        let question = agent.open_question()?;
        let name = |object: ObjectId| home.objects().name(object).to_owned();
        let yes: Vec<usize> = question.yes.iter().collect();
        let mut way = "";
        let (about, objects) = match question.subject {
            Subject::Object(object) => (About::Object, vec![name(object)]),
            Subject::Kind(kind) => {
                let kind = agent.lifted().get(usize::from(kind))?;
                if self.ways() {
                    way = match kind.way().map(|(part, _)| part).collect::<Vec<_>>().as_slice() {
                        [] => "any",
                        [Part::Avoiding, ..] => "avoiding",
                        [_] => "through",
                        _ => "either",
                    };
                }
                let carries = kind.propositions().iter().any(|part| part.proposition == BLOCK_IN_ROOM);
                (if carries { About::Carrying } else { About::Moving }, vec![])
            }
            Subject::Task(_) => (About::Task, vec![]),
            Subject::WhichObject(objects, count) => {
                (About::WhichObject, objects.iter().take(usize::from(count)).map(|&object| name(object)).collect())
            }
            Subject::WhichTask(..) => (About::WhichTask, vec![]),
        };
        let choices = match question.subject {
            Subject::WhichTask(tasks, count) => tasks.iter().take(usize::from(count)).map(|&task| usize::from(task)).collect(),
            Subject::Task(task) => vec![usize::from(task)],
            _ => vec![],
        };
        Some(Question { about, way, objects, choices, tasks: yes, information: question.information })
    }

    /// Takes in the answer to the open question: `yes`, `no` (none of these, if there are choices), or the number of a choice, from 1 on.
    ///
    /// # Errors
    /// Where there is no open question, or this is no answer to it.
    pub fn answer(&mut self, answer: &str) -> Result<AnswerEvidence, Refusal> {
        let given = answer_of(answer).ok_or_else(|| Refusal(format!("{answer} is no answer; say yes, no or the number of a choice")))?;
        let before = self.probabilities();
        let outcome = self.lesson.answer(given).map_err(Refusal::from)?.name();
        Ok(AnswerEvidence { outcome, before, after: self.probabilities() })
    }
}

#[wasm_bindgen(js_class = "Goodbot")]
impl World {
    /// Takes in an answer with all its parts, as in a log: its tasks' names on a line each, whether the meant task is among them, the
    /// probability that this is wrong, how many other answers there were, and the words of a correction, or none.
    ///
    /// # Errors
    /// A name that is no task's; the errors of [`Agent::answered`](goodbot::Agent::answered).
    #[wasm_bindgen(js_name = answerAs)]
    pub fn answer_as(&mut self, tasks: &str, yes: bool, eta: f32, others: u8, words: &str) -> Result<(), Refusal> {
        let known = self.belief().tasks;
        let position =
            |name: &str| known.iter().position(|task| task.name == name).ok_or_else(|| Refusal(format!("{name} is no task here")));
        let tasks = tasks.lines().map(position).collect::<Result<TaskSet, Refusal>>()?;
        if words.is_empty() {
            return self.lesson.answered(tasks, yes, eta, others).map(drop).map_err(Refusal::from);
        }
        self.lesson.correct_as(tasks, eta, words).map_err(Refusal::from)
    }
}

impl World {
    /// The next lesson to teach: of `lessons`, one command a line, the one that teaches most of the commands in `wanted`, also one a
    /// line. Of equal ones it is the first. `None` if no lesson has a wanted word.
    ///
    /// # Errors
    /// Where a command has too many words, or one that is too long.
    pub fn next_lesson(&self, lessons: &str, wanted: &str) -> Result<Option<NextLesson>, Refusal> {
        let [lessons, wanted]: [Vec<&str>; 2] = [lessons, wanted].map(|text| text.lines().collect());
        // Each word is asked for often, and counting it goes through all that the robot has heard.
        let counted = RefCell::new(BTreeMap::new());
        let heard = |word: &str| {
            let known = counted.borrow().get(word).copied();
            known.unwrap_or_else(|| {
                let count = times_heard(self.agent(), word);
                counted.borrow_mut().insert(word.to_owned(), count);
                count
            })
        };
        let next = next_lesson(&lessons, &wanted, heard).map_err(Refusal::from)?;
        Ok(next.map(|next| {
            let known = next.is_known();
            NextLesson { lesson: next.lesson, word: next.word.to_owned(), needed: next.needed, heard: next.heard, known }
        }))
    }
}

/// How much each word of the command under way speaks for each task.
///
/// # Errors
/// A [`CapacityError`] where a task's machine commands are too many or too long.
pub fn support(agent: &Agent<impl AgentMemory>, home: &Home<impl HomeMemory>) -> Result<Support, CapacityError> {
    let (language, sentence) = (agent.language(), agent.sentence());
    let length = sentence.len();
    // Interning machine tokens must leave the model's own as they are.
    let (mut bytes, mut ends, mut count) = (vec![0; 4_096], vec![0; 256], 0);
    let mut own = Symbols::new(&mut bytes, &mut ends, &mut count, Capacity::Tokens, Capacity::TokenBytes);
    let mut rows = vec![Vec::new(); length];
    let mut description = Tokens::new();
    for task in 0..agent.tasks().len() {
        description.clear();
        if let Some((task, start)) = agent.tasks().get(task).zip(agent.started_from(home)) {
            describe(home, agent.lifted(), task, &mut Scene::new(start), &mut own, &mut description)?;
        }
        // All values that the model does not know are alike.
        for token in description.iter_mut().filter(|token| !is_marker(**token)) {
            *token = language.tokens().find(own.read().text(*token)).unwrap_or(Symbol::new(i16::MAX as u16));
        }
        for row in &mut rows {
            row.push(0.0);
        }
        language.word_by_word(sentence, &description, |position, probability| {
            if let Some(slot) = rows.get_mut(position).and_then(|row| row.last_mut()) {
                *slot = probability;
            }
        });
    }
    Ok(spread(agent, rows))
}

/// The support, with each row scaled to sum to 1.
fn spread(agent: &Agent<impl AgentMemory>, mut rows: Vec<Vec<f32>>) -> Support {
    let (language, sentence) = (agent.language(), agent.sentence());
    let even = 1.0 / agent.tasks().len().max(1) as f32;
    for row in &mut rows {
        let whole: f32 = row.iter().sum();
        for share in row.iter_mut() {
            *share = if whole > 0.0 { *share / whole } else { even };
        }
    }
    let words = sentence.iter().map(|word| word.map_or_else(String::new, |word| language.words().text(word).to_owned())).collect();
    let known = sentence.iter().map(|word| word.is_some_and(|word| word.index() < language.tables().words())).collect();
    Support { words, known, tasks: rows }
}
