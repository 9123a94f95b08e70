//! Teaching without a terminal: one request on each input line, one JSON object on each output line. docs/teach.md describes both.

use super::classroom::Classroom;
use super::kept::Kept;
use super::lessons::{Next, random_home};
use super::pupil::{Meaning, Reaction};
use super::site::{Shown, Table};
use goodbot::asking::{Answer, Asking};
use goodbot::feedback::Feedback;
use goodbot::session::Evidence;
use goodbot::talk::{Class, Said};
use goodbot_console::Failure;
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
use goodbot_formats::lines::Lines;
use goodbot_lesson::asking::answer_of;
use serde_json::{Map, Value, json};
use std::io::{self, BufRead, Write};

/// The version of the protocol.
const PROTOCOL: u32 = 2;

/// The end of the protocol.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spoken {
    /// How many lines were refused.
    pub refused: usize,
}

/// A refused line: the reason, and the request to send instead.
struct Misunderstood {
    message: String,
    instead: &'static str,
}

impl<E: Into<Failure>> From<E> for Misunderstood {
    fn from(refused: E) -> Self {
        Self::told(refused, "send help for all requests")
    }
}

impl Misunderstood {
    fn told(refused: impl Into<Failure>, instead: &'static str) -> Self {
        Self { message: refused.into().to_string(), instead }
    }
}

type Answers = Result<Vec<Value>, Misunderstood>;

fn refused(message: &str, instead: &'static str) -> Answers {
    Err(Misunderstood { message: message.to_owned(), instead })
}

const NO_SESSION: &str = "no session is under way";
const ASK_FIRST: &str = "send ask first, and then answer yes, answer no, or answer and the number of a choice, such as: answer 1";
const COMMAND_FIRST: &str = "send a command first, such as: command go to the red room";

const REQUESTS: &[(&str, &str)] = &[
    ("command WORDS", "say a command; in the tour, without words, the lesson's own command"),
    ("say WORDS", "say anything: praise, blame, stop, undo, again, an answer, a correction, or a command"),
    ("step", "let the robot take its next step"),
    ("good [WORDS]", "reward the last step; words said along with it are praise from then on"),
    ("bad [WORDS]", "punish the last step; words said along with it are blame from then on"),
    ("silence", "say nothing to the last step"),
    ("ask", "let the robot ask a question, if one teaches it more than its next steps"),
    ("answer yes|no|NUMBER", "answer its last question; among several choices by number, or no for none of these"),
    ("intended TASK", "note in the log what the command means, as its task or in words; nothing is learned from it"),
    ("auto", "let a simulated trainer judge the last step: in lessons of the tour, or after intended"),
    ("back", "take back the last step and its feedback"),
    ("finish", "end the session and learn from it; then the next part of the utterance begins, if there is one"),
    ("forget", "end the session and do not learn from it"),
    ("undo", "unlearn the last session"),
    ("conversation [ID]", "go on with another conversation in this home; without an id, a new one"),
    ("next", "propose the next lesson, with the reason"),
    ("home JSON", "move to another home, one environment on one line; or: home random SEED"),
    ("reset", "put everything back to where it was"),
    ("state", "tell the places of all things, and the robot's beliefs"),
    ("words", "list the robot's words for each machine token"),
    ("help", "list these requests"),
    ("quit", "leave"),
];

fn is_request(word: &str) -> bool {
    REQUESTS.iter().any(|(request, _)| request.split(' ').next() == Some(word))
}

/// Reads requests until the input ends, and answers each.
///
/// # Errors
/// An error if the input cannot be read or the output cannot be written.
pub fn speak(classroom: &mut Classroom, seed: u64, input: impl BufRead, mut output: impl Write) -> io::Result<Spoken> {
    let mut speaker = Speaker { classroom, seed };
    let mut spoken = Spoken::default();
    write(&mut output, &[speaker.ready()])?;
    for line in Lines::new(input) {
        let request = line.text.trim();
        let answered = match line.error {
            Some(unread) => refused(&unread.problem, "send a shorter line of text in UTF-8"),
            None if request.is_empty() => continue,
            None if request == "quit" => break,
            None => speaker.answer(request),
        };
        let mut answers = answered.unwrap_or_else(|Misunderstood { message, instead }| {
            spoken.refused += 1;
            vec![error(&message, instead)]
        });
        answers.push(done());
        write(&mut output, &answers)?;
    }
    write(&mut output, &[speaker.farewell()])?;
    Ok(spoken)
}

fn write(output: &mut impl Write, answers: &[Value]) -> io::Result<()> {
    answers.iter().try_for_each(|answer| writeln!(output, "{answer}"))?;
    output.flush()
}

fn error(message: &str, instead: &str) -> Value {
    json!({"type": "error", "message": message, "do": instead})
}

/// The last line of each answer. A program that reads up to it never waits in vain.
fn done() -> Value {
    json!({"type": "done"})
}

struct Speaker<'a> {
    classroom: &'a mut Classroom,
    seed: u64,
}

impl Speaker<'_> {
    fn answer(&mut self, line: &str) -> Answers {
        let (request, rest) = line.split_once(char::is_whitespace).map_or((line, ""), |(request, rest)| (request, rest.trim()));
        match request {
            "command" => self.command(rest),
            "say" => self.say(rest),
            "good" => self.judge_saying(Feedback::Reward, rest),
            "bad" => self.judge_saying(Feedback::Punish, rest),
            "home" => self.home(rest),
            "conversation" => self.conversation(rest),
            "answer" => self.reply(rest),
            "intended" => self.intended(rest),
            _ if !rest.is_empty() => Err(Misunderstood {
                message: if is_request(request) { format!("{request:?} takes no words") } else { format!("{request:?} is no request") },
                instead: "send command before the words of a command, such as: command go to the red room",
            }),
            "step" => self.step(),
            "silence" => self.judge(Feedback::Neutral),
            "ask" => self.ask(),
            "auto" => self.auto(),
            "back" => self.back(),
            "finish" => self.finish(),
            "forget" => self.forget(),
            "undo" => self.undo(),
            "reset" => {
                self.classroom.forget()?;
                self.classroom.pupil.put_back();
                Ok(vec![self.place(if self.classroom.pupil.is_in_world() { "world" } else { "home" })])
            }
            "state" => Ok(vec![self.state()]),
            "words" => Ok(vec![self.words()]),
            "next" => self.next_lesson(),
            "help" => {
                let requests: Map<String, Value> = REQUESTS.iter().map(|(request, what)| ((*request).to_owned(), json!(what))).collect();
                Ok(vec![json!({"type": "help", "requests": requests})])
            }
            _ => Err(Misunderstood { message: format!("{request:?} is no request"), instead: "send help for all requests" }),
        }
    }

    fn ready(&self) -> Value {
        let mut ready =
            json!({"type": "ready", "protocol": PROTOCOL, "seed": self.seed, "sessions": self.classroom.pupil.lessons_learned()});
        self.add_place(&mut ready);
        self.add_lesson(&mut ready);
        ready
    }

    fn farewell(&mut self) -> Value {
        // A session under way goes to the log, and a write error is reported.
        let failure = self.classroom.leave().err();
        let files = self.classroom.kept.as_ref().map(|kept| kept.files());
        let mut bye = json!({
            "type": "bye", "sessions": self.classroom.pupil.lessons_learned(), "kept": self.classroom.kept.as_ref().map(Kept::sessions),
            "model": files.map(|files| files.model.display().to_string()),
            "log": files.map(|files| files.log.display().to_string()),
        });
        if let Some(failure) = failure {
            bye["error"] = failure.to_string().into();
        }
        bye
    }

    fn command(&mut self, words: &str) -> Answers {
        let stop = self.classroom.tour.as_ref().and_then(|tour| tour.stop());
        let said = match stop {
            Some(stop) if words.is_empty() => stop.exercise.command,
            _ => words,
        };
        if said.is_empty() {
            return refused("the command has no word", "send what the robot shall do, such as: command go to the red room");
        }
        let heard = self.classroom.say(said)?;
        let told = self.heard(said, &heard)?;
        if heard != Reaction::Command {
            return Ok(vec![told]);
        }
        let Some(tested) = self.classroom.tested() else { return Ok(vec![told]) };
        let result = json!({"type": "tested", "right": tested.right, "task": tested.heard.name, "words": tested.heard.words});
        self.classroom.pass_test(tested.right)?;
        let mut answers = vec![told, result];
        answers.extend(self.lesson());
        Ok(answers)
    }

    /// The answer to a command.
    fn heard(&self, said: &str, heard: &Reaction) -> Result<Value, Misunderstood> {
        let pupil = &self.classroom.pupil;
        let (certainty, meant) = (pupil.certainty(), pupil.taken_for().to_string());
        let declined = match heard {
            Reaction::Command => None,
            Reaction::Done(words) => Some(("done", Some(words))),
            Reaction::Nothing(_) => Some(("none", None)),
        };
        if let Some((verdict, words)) = declined {
            return Ok(
                json!({"type": "heard", "command": said, "verdict": verdict, "certainty": certainty, "taken_for": meant, "done": words}),
            );
        }
        let words: Vec<Value> = self.support()?;
        let command = self.classroom.pupil.lesson.command().unwrap_or(said);
        let conversation = &self.classroom.pupil.lesson.conversation().id;
        let mut heard = json!({"type": "heard", "command": command, "verdict": "try", "certainty": certainty, "taken_for": meant, "words": words, "conversation": conversation});
        if let Some(rest) = self.classroom.pupil.lesson.rest() {
            heard["rest"] = rest.into();
        }
        if pupil.unread > 0 {
            heard["unread"] = pupil.unread.into();
        }
        self.add_tasks(&mut heard);
        Ok(heard)
    }

    /// Handles any utterance.
    fn say(&mut self, words: &str) -> Answers {
        if words.is_empty() {
            return refused("nothing was said", "send say and some words, such as: say good robot");
        }
        let nothing = |taken_for: &str| Ok(vec![json!({"type": "said", "words": words, "taken_for": taken_for})]);
        let said = self.classroom.pupil.said(words)?;
        if matches!(said, Said::Command | Said::Again) && self.classroom.doubts(words)? {
            let under_way = self.classroom.pupil.lesson.command().unwrap_or_default();
            let asks = format!("Shall I leave \"{under_way}\" unlearned, and begin \"{words}\"?");
            return Ok(vec![
                json!({"type": "said", "words": words, "taken_for": "a command", "asks": asks, "do": "say the same once more for yes; or go on: step, good, bad, finish"}),
            ]);
        }
        match said {
            Said::Judgement(feedback) => self.judge(feedback),
            Said::Finish => {
                let mut answers = self.judge(Feedback::Reward)?;
                answers.extend(self.finish()?);
                Ok(answers)
            }
            Said::Answer(answer) => self.reply_as(words, answer),
            Said::Correction => {
                let evidence = self.classroom.pupil.correct(words)?;
                let mut told = json!({"type": "corrected", "words": words, "counted": evidence == Evidence::Used});
                self.add_tasks(&mut told);
                Ok(vec![told])
            }
            Said::Stop if self.classroom.pupil.lesson.is_under_way() => self.forget(),
            Said::Undo if self.classroom.pupil.lesson.steps() > 0 || self.classroom.pupil.lesson.acted().is_some() => self.back(),
            Said::Undo if !self.classroom.pupil.lesson.is_under_way() && self.classroom.has_taught() => self.undo(),
            Said::Again => match self.classroom.last.clone() {
                Some(command) => self.command(&command),
                None => nothing(Class::Again.name()),
            },
            Said::Command => self.command(words),
            Said::Stop => nothing(Class::Stop.name()),
            Said::Undo => nothing("undo"),
            Said::Nothing(class) => nothing(class.name()),
        }
    }

    /// Judges the last step, and learns the words said along with the feedback.
    fn judge_saying(&mut self, feedback: Feedback, words: &str) -> Answers {
        let judged = self.judge(feedback)?;
        self.classroom.pupil.lesson.learn_voice(words, feedback)?;
        Ok(judged)
    }

    fn support(&self) -> Result<Vec<Value>, Failure> {
        let lesson = &self.classroom.pupil.lesson;
        let word = |word: crate::teach::pupil::WordSupport| {
            let shares: Map<String, Value> = word
                .shares
                .iter()
                .enumerate()
                .filter_map(|(position, &share)| Some((lesson.name_of(position)?.to_string(), number(share))))
                .collect();
            json!({"word": word.word, "known": word.known, "speaks_for": shares})
        };
        Ok(self.classroom.pupil.word_support()?.into_iter().map(word).collect())
    }

    fn step(&mut self) -> Answers {
        if !self.classroom.pupil.lesson.is_under_way() {
            return refused(NO_SESSION, COMMAND_FIRST);
        }
        let pupil = &mut self.classroom.pupil;
        pupil.lesson.go_on()?;
        pupil.plan_fully()?;
        let meanings = pupil.meanings();
        let acted = pupil.act()?.clone();
        let task = meanings.iter().find(|meaning| meaning.position == acted.task);
        let mut answer = json!({
            "type": "acted", "action": acted.action, "confidence": number(acted.confidence), "plan": acted.plan.name(),
            "task": task.map(|task| &task.name), "words": task.map(|task| &task.words),
        });
        self.add_cells(&mut answer);
        self.add_tasks(&mut answer);
        if let Some(tasks) = answer.get_mut("tasks").and_then(Value::as_array_mut) {
            for (meaning, task) in self.classroom.pupil.meanings().iter().zip(tasks) {
                task["right"] = acted.is_right(meaning.position).into();
            }
        }
        Ok(vec![answer])
    }

    fn judge(&mut self, feedback: Feedback) -> Answers {
        let pupil = &mut self.classroom.pupil;
        let Some(action) = pupil.lesson.acted().map(|acted| acted.action.clone()) else {
            return refused("there is no step to judge yet", "send step first");
        };
        let judged = pupil.lesson.judge(feedback)?;
        let mut answer = json!({"type": "judged", "action": action, "feedback": feedback.name(), "counted": judged == Evidence::Used});
        self.add_tasks(&mut answer);
        Ok(vec![answer])
    }

    fn ask(&mut self) -> Answers {
        if !self.classroom.pupil.lesson.is_under_way() {
            return refused(NO_SESSION, COMMAND_FIRST);
        }
        let pupil = &mut self.classroom.pupil;
        pupil.plan_fully()?;
        let asks = pupil.ask(&Asking::DEFAULT)?;
        Ok(vec![match asks {
            None => json!({"type": "question", "text": null}),
            Some(asks) => {
                let tasks: Vec<String> = asks.tasks.iter().filter_map(|&task| Some(pupil.lesson.name_of(task)?.to_string())).collect();
                json!({"type": "question", "text": asks.text, "choices": asks.choices, "tasks": tasks})
            }
        }])
    }

    fn reply(&mut self, answer: &str) -> Answers {
        match answer_of(answer) {
            Some(given) => self.reply_as(answer, given),
            None => refused(&format!("{answer:?} is no answer"), ASK_FIRST),
        }
    }

    fn reply_as(&mut self, answer: &str, given: Answer) -> Answers {
        let pupil = &mut self.classroom.pupil;
        let evidence = pupil.lesson.answer(given).map_err(|refused| Misunderstood::told(refused, ASK_FIRST))?;
        let mut told = json!({"type": "answered", "answer": answer, "counted": evidence == Evidence::Used});
        self.add_tasks(&mut told);
        Ok(vec![told])
    }

    fn intended(&mut self, task: &str) -> Answers {
        let instead = "send intended and one of the tasks, such as: intended go to the red room";
        let meant = self.classroom.mean(Some(task)).map_err(|refused| Misunderstood::told(refused, instead))?;
        Ok(vec![json!({"type": "intended", "task": meant.name, "words": meant.words})])
    }

    fn next_lesson(&self) -> Answers {
        let none = |reason: &str| json!({"type": "next", "command": null, "reason": reason});
        Ok(vec![match self.classroom.next_lesson()? {
            Next::NothingWanted => none("no command was said yet, and --wanted names none"),
            Next::LittleLeft => none("it has heard every word of these commands often"),
            Next::Lesson(proposal) => {
                json!({
                    "type": "next", "command": proposal.command, "home": proposal.home, "word": proposal.word, "needed": proposal.needed,
                    "heard": proposal.heard, "reason": proposal.reason(),
                })
            }
        }])
    }

    fn auto(&mut self) -> Answers {
        let feedback = self.classroom.pupil.simulated_word().ok_or(Misunderstood {
            message: "a simulated trainer judges only if it knows the intended task: in lessons of the tour, or after intended".to_owned(),
            instead: "send good, bad or silence; or send intended and the task first",
        })?;
        self.judge(feedback)
    }

    fn back(&mut self) -> Answers {
        let pupil = &mut self.classroom.pupil;
        if !pupil.lesson.take_back()? {
            return refused("no step was taken yet", "send step");
        }
        pupil.lesson.walk_on()?;
        let mut answer = json!({"type": "back"});
        self.add_cells(&mut answer);
        self.add_tasks(&mut answer);
        Ok(vec![answer])
    }

    fn finish(&mut self) -> Answers {
        let steps = self.classroom.pupil.lesson.steps();
        let teaches = self.classroom.pupil.lesson.teaches();
        let gave_way = self.classroom.finish()?;
        while !self.classroom.learn(u32::MAX)? {}
        let mut answers = self.over(teaches && gave_way.is_some(), steps, gave_way.unwrap_or(0));
        let rest = self.classroom.pupil.lesson.rest().map(str::to_owned);
        if let (Some(rest), Some(heard)) = (rest, self.classroom.hear_rest()?) {
            answers.push(self.heard(&rest, &heard)?);
        }
        Ok(answers)
    }

    fn forget(&mut self) -> Answers {
        let steps = self.classroom.pupil.lesson.steps();
        if !self.classroom.forget()? {
            return refused(NO_SESSION, COMMAND_FIRST);
        }
        Ok(self.over(false, steps, 0))
    }

    fn over(&self, learned: bool, steps: usize, gave_way: usize) -> Vec<Value> {
        let sessions = self.classroom.pupil.lessons_learned();
        let over = json!({"type": "finished", "learned": learned, "steps": steps, "sessions": sessions, "gave_way": gave_way});
        std::iter::once(over).chain(self.lesson().filter(|_| learned)).collect()
    }

    fn undo(&mut self) -> Answers {
        if !self.classroom.unlearn()? {
            return refused("nothing was learned since the start", "send a command, step, good and finish first");
        }
        let undone = json!({"type": "undone", "sessions": self.classroom.pupil.lessons_learned()});
        Ok(std::iter::once(undone).chain(self.lesson()).collect())
    }

    fn home(&mut self, text: &str) -> Answers {
        let instead = "send home and one environment as JSON on the same line, or: home random 7";
        let refuse = |message: String| Misunderstood { message, instead };
        let home = if let Some(seed) = text.strip_prefix("random") {
            let seed = if seed.trim().is_empty() { Ok(self.seed) } else { seed.trim().parse::<u64>() };
            random_home(seed.map_err(|_| refuse("the seed is no whole number".to_owned()))?)
                .ok_or_else(|| refuse("no home could be drawn".to_owned()))?
        } else {
            EnvironmentFile::parse(text).map_err(|error| refuse(error.to_string()))?
        };
        self.classroom.enter(&home).map_err(|refused| Misunderstood::told(refused, instead))?;
        Ok(vec![self.place("home")])
    }

    fn conversation(&mut self, id: &str) -> Answers {
        let instead = "send conversation and an id that heard gave, or conversation alone for a new one";
        let id = Some(id).filter(|id| !id.is_empty());
        self.classroom.converse(id).map_err(|refused| Misunderstood::told(refused, instead))?;
        let lesson = &self.classroom.pupil.lesson;
        let known: Vec<&str> = lesson.conversations().collect();
        Ok(vec![json!({"type": "conversation", "id": lesson.conversation().id, "known": known})])
    }

    fn state(&self) -> Value {
        let mut state = json!({
            "type": "state", "command": self.classroom.pupil.lesson.command(),
            "sessions": self.classroom.pupil.lessons_learned(),
        });
        self.add_place(&mut state);
        self.add_cells(&mut state);
        self.add_tasks(&mut state);
        self.add_lesson(&mut state);
        state
    }

    fn words(&self) -> Value {
        let idea = |idea: crate::teach::pupil::Idea| {
            let called = idea.called.iter().map(|(word, share)| (self.classroom.words.of(word), number(*share)));
            json!({"token": idea.token, "words": idea.words, "called": called.collect::<Map<String, Value>>()})
        };
        json!({"type": "words", "ideas": self.classroom.pupil.ideas().into_iter().map(idea).collect::<Vec<_>>()})
    }

    /// The tour's current lesson or test, as a line of its own; no line outside the tour.
    fn lesson(&self) -> impl Iterator<Item = Value> + use<> {
        let mut lesson = json!({"type": "lesson"});
        self.add_lesson(&mut lesson);
        self.classroom.tour.is_some().then_some(lesson).into_iter()
    }

    fn add_lesson(&self, answer: &mut Value) {
        let Some(tour) = &self.classroom.tour else { return };
        answer["lesson"] = match tour.stop() {
            Some(stop) => {
                json!({"number": stop.number, "of": stop.of, "test": stop.test, "command": stop.exercise.command, "over": false})
            }
            None => json!({"over": true, "score": tour.score()}),
        };
    }

    fn place(&self, kind: &str) -> Value {
        let mut place = json!({"type": kind});
        self.add_place(&mut place);
        place
    }

    fn add_place(&self, answer: &mut Value) {
        match self.classroom.pupil.shown() {
            Some(Shown::Floor(scene)) => {
                answer["home"] = json!(scene.environment);
                answer["map"] = scene.map.lines().collect();
            }
            Some(Shown::Other(table)) => {
                answer["world"] = table.name.as_str().into();
                answer["facts"] = facts(&table);
            }
            None => {}
        }
    }

    /// The cells of the robot and the blocks; in a world from a file, the facts.
    fn add_cells(&self, answer: &mut Value) {
        let scene = match self.classroom.pupil.shown() {
            Some(Shown::Floor(scene)) => scene,
            Some(Shown::Other(table)) => return answer["facts"] = facts(&table),
            None => return,
        };
        let cell = |object: &ObjectRecord| match object {
            ObjectRecord::Agent { name, x, y } | ObjectRecord::Block { name, x, y, .. } => Some((name.clone(), json!([x, y]))),
            ObjectRecord::Room { .. } | ObjectRecord::Door { .. } => None,
        };
        answer["cells"] = scene.environment.objects.iter().filter_map(cell).collect();
    }

    /// The tasks, the likeliest first.
    fn add_tasks(&self, answer: &mut Value) {
        let task = |meaning: Meaning| json!({"task": meaning.name, "words": meaning.words, "probability": number(meaning.probability)});
        answer["tasks"] = self.classroom.pupil.meanings().into_iter().map(task).collect();
    }
}

/// The facts of a world that its robot can change.
fn facts(table: &Table) -> Value {
    table.facts.iter().map(ToString::to_string).collect()
}

/// The shortest number that reads back as the same probability.
fn number(probability: f32) -> Value {
    probability.to_string().parse::<f64>().map_or(Value::Null, |number| json!(number))
}
