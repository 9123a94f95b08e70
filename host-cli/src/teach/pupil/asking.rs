//! The robot's questions in words.

use super::Pupil;
use crate::teach::plain_names::{in_plain_words, object_words, task_words};
use crate::teach::site::Site;
use goodbot::asking::{Asking, Question, Subject};
use goodbot::home::BLOCK_IN_ROOM;
use goodbot::oomdp::Domain;
use goodbot::task::{LiftedTask, Part};
use goodbot_console::outcome::Failure;

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
