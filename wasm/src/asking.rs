//! The robot's questions, as a page shows them, and the trainer's answers.
use wasm_bindgen::prelude::*;

use crate::view::{About, AnswerEvidence, Question};
use crate::world::{Refusal, World};
use goodbot::asking::{Asking, Considered, Subject};
use goodbot::home::BLOCK_IN_ROOM;
use goodbot::oomdp::ObjectId;
use goodbot::task::{Part, TaskSet};
use goodbot_lesson::asking::answer_of;

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
