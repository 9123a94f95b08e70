//! Utterances: commands, words to a robot on its way, and other talk.

use crate::log::task_name;
use crate::replay::{not_begun, with_names};
use crate::view::Reaction;
use crate::world::{MIND, Refusal, World};
use goodbot::asking::Answer;
use goodbot::feedback::Feedback;
use goodbot::home::{Home, HomeState};
use goodbot::memory::HomeMemory;
use goodbot::talk::{Class, Listened, Said, Verdict};
use goodbot::task::{GroundedTask, LiftedTask, ground_with_done};
use goodbot_lesson::closed_words::kept_table;
use goodbot_lesson::listening::Conversing;
use goodbot_lesson::walk::Listening;
use wasm_bindgen::prelude::*;

/// All tasks that commands may mean in this state, with those that are done already, each with its name.
pub(crate) fn named_tasks<M: HomeMemory>(
    home: &Home<M>,
    lifted: &[LiftedTask],
    start: &HomeState,
) -> Result<Vec<(GroundedTask, String)>, Refusal> {
    let mut tasks = vec![GroundedTask::UNUSED; MIND.tasks];
    let count = ground_with_done(home, lifted, start, &mut tasks, f32::MIN_POSITIVE).map_err(Refusal::from)?;
    Ok(with_names(home, lifted, &tasks[..count]))
}

/// The listening that began a recorded session, and the task of the command before: from the utterance, that task's name, and the
/// conversation, as texts by name.
pub(crate) fn listening<M: HomeMemory>(
    home: &Home<M>,
    lifted: &[LiftedTask],
    tasks: &[(GroundedTask, String)],
    utterance: &str,
    after: Option<&str>,
    conversation: &[(String, String)],
) -> Result<(Listening, Option<GroundedTask>), Refusal> {
    let task = |name: &str| {
        let plain = name.trim_start_matches('!');
        let (task, _) = tasks.iter().find(|(_, known)| known == plain)?;
        if plain == name { Some(*task) } else { task.negated(lifted.get(usize::from(task.lifted))?) }
    };
    let after = match after {
        None => None,
        Some(name) => Some(task(name).ok_or_else(|| Refusal(format!("{name} is no task here")))?),
    };
    let conversation = Conversing::read(home, conversation, task);
    let conversation = conversation.map_err(|(field, message)| Refusal(format!("conversation.{field}: {message}")))?;
    Ok((Listening { utterance: utterance.to_owned(), after: after.map(|task| task.lifted), conversation }, after))
}

impl World {
    /// Tells the robot something in the current state, as [`Lesson::tell`](goodbot_lesson::live::Lesson::tell) does. `insists` makes it a
    /// command, whatever the robot takes it for, unless it is negated. A session under way ends unlearned.
    ///
    /// # Errors
    /// Why it cannot be heard; the training data are kept.
    pub fn listen(&mut self, words: &str, insists: bool) -> Result<Reaction, Refusal> {
        self.forget();
        let environment = self.environment_now();
        let mut listened = Some(self.lesson.tell(words, environment).map_err(Refusal::from)?);
        if insists && !self.lesson.is_under_way() && !self.lesson.is_prohibition() {
            let environment = self.environment_now();
            self.lesson.hear(words, environment).map_err(Refusal::from)?;
            listened = None;
        }
        self.heard(listened)
    }

    /// Begins with the rest of the utterance, once a session is over, in the current state. `None` without a rest.
    ///
    /// # Errors
    /// As [`listen`](Self::listen).
    pub fn listen_on(&mut self) -> Result<Option<Reaction>, Refusal> {
        let environment = self.environment_now();
        let listened = self.lesson.listen_on(environment).map_err(Refusal::from)?;
        listened.map(|listened| self.heard(Some(listened))).transpose()
    }

    /// Begins a session of a log anew, one that began by listening.
    ///
    /// # Errors
    /// A name that is no task's or object's here.
    pub fn listen_as(&mut self, utterance: &str, after: Option<&str>, conversation: &[(String, String)]) -> Result<Reaction, Refusal> {
        self.forget();
        let environment = self.environment_now();
        let (mind, home, state) = self.lesson.parts();
        let tasks = named_tasks(home, mind.lifted(), state)?;
        let (listening, after) = listening(home, mind.lifted(), &tasks, utterance, after, conversation)?;
        let listened = self.lesson.listen_as(listening, after, environment).map_err(Refusal::from)?;
        self.heard(Some(listened))
    }

    /// Adds to the recorded session that it began by listening.
    ///
    /// # Errors
    /// As [`listen_as`](Self::listen_as).
    pub fn recorded_listening(&mut self, utterance: &str, after: Option<&str>, conversation: &[(String, String)]) -> Result<(), Refusal> {
        let lifted = self.lesson.agent.lifted();
        let told = self.replaying.as_mut().ok_or_else(not_begun)?;
        let walk = &mut told.walk;
        told.tasks = named_tasks(&walk.home, lifted, &walk.start)?;
        walk.listening = Some(listening(&walk.home, lifted, &told.tasks, utterance, after, conversation)?.0);
        Ok(())
    }

    /// The effect of words that the robot has listened to; `listened` is `None` if it took them for a command.
    fn heard(&mut self, listened: Option<Listened>) -> Result<Reaction, Refusal> {
        let begun = self.lesson.is_under_way();
        let Self { scout, lesson, .. } = self;
        if begun {
            scout.set_tasks(lesson.home(), lesson.agent.lifted(), lesson.agent.tasks()).map_err(Refusal::from)?;
        }
        let verdict = match listened.map(|listened| listened.verdict) {
            None | Some(Verdict::Sure) => "sure",
            Some(Verdict::Unsure) => "unsure",
            Some(Verdict::Done) => "done",
            Some(Verdict::None) => "none",
        };
        let task = listened.and_then(|listened| lesson.agent.tasks().get(listened.task));
        let task = task.and_then(|task| Some(task_name(lesson.home(), lesson.agent.lifted().get(usize::from(task.lifted))?, task)));
        let task = task.unwrap_or_default();
        let command = lesson.command().unwrap_or_default().to_owned();
        Ok(Reaction { begun, verdict, task, negated: lesson.is_prohibition(), command })
    }
}

#[wasm_bindgen(js_class = "Goodbot")]
impl World {
    /// What a person's words ask for, at this point of the session: `command`, `correction`, `reward`, `punish`, `finish`, `yes`, `no`,
    /// the number of a choice, `stop`, `undo`, `again`, `unjudged` for praise, blame, yes or no without anything to judge, `unchanged`
    /// for "back" without anything to take back, or `nothing`.
    ///
    /// # Errors
    /// Where the words are too many or too long.
    pub fn said(&self, words: &str) -> Result<String, Refusal> {
        let word = match self.lesson.said(words).map_err(Refusal::from)? {
            Said::Command => "command",
            Said::Correction => "correction",
            Said::Judgement(feedback) => feedback.name(),
            Said::Finish => "finish",
            Said::Answer(Answer::Yes) => "yes",
            Said::Answer(Answer::No) => "no",
            Said::Answer(Answer::This(number)) => return Ok((number + 1).to_string()),
            Said::Stop => "stop",
            Said::Undo => "undo",
            Said::Again => "again",
            Said::Nothing(Class::Praise | Class::Blame | Class::Yes | Class::No) => "unjudged",
            Said::Nothing(Class::Back) => "unchanged",
            Said::Nothing(_) => "nothing",
        };
        Ok(word.to_owned())
    }

    /// Learns the words that are said along with a button: `reward` or `punish`.
    ///
    /// # Errors
    /// Where the words are too many or too long.
    #[wasm_bindgen(js_name = learnVoice)]
    pub fn learn_voice(&mut self, words: &str, feedback: &str) -> Result<(), Refusal> {
        self.lesson.learn_voice(words, feedback.parse().unwrap_or(Feedback::Neutral)).map_err(Refusal::from)
    }

    /// Whether the utterance has a rest.
    #[wasm_bindgen(js_name = isMore)]
    pub fn is_more(&self) -> bool {
        self.lesson.is_more()
    }

    /// Whether there is something to learn from the session under way.
    pub fn teaches(&self) -> bool {
        self.lesson.teaches()
    }

    /// Takes in words that correct the robot on its way.
    ///
    /// # Errors
    /// Where no session is under way, or the words are too many or too long.
    pub fn correct(&mut self, words: &str) -> Result<(), Refusal> {
        self.lesson.correct(words).map(drop).map_err(Refusal::from)
    }

    /// Takes the last step back. Returns whether there was one.
    ///
    /// # Errors
    /// Where no session is under way.
    #[wasm_bindgen(js_name = takeBack)]
    pub fn take_back(&mut self) -> Result<bool, Refusal> {
        let took = self.lesson.take_back().map_err(Refusal::from)?;
        self.lesson.walk_on().map_err(Refusal::from)?;
        self.lesson.go_on().map_err(Refusal::from)?;
        Ok(took)
    }

    /// Adds to the recorded session its table of closed words.
    ///
    /// # Errors
    /// A text that is no table.
    #[wasm_bindgen(js_name = recordedClosedWords)]
    pub fn recorded_closed_words(&mut self, table: &str) -> Result<(), Refusal> {
        let told = self.replaying.as_mut().ok_or_else(not_begun)?;
        told.walk.closed = kept_table(table).map_err(|_| Refusal("“closed_words” is no table of words".to_owned()))?;
        Ok(())
    }
}
