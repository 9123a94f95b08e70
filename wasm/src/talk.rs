//! What people say: a command, words to a robot on its way, and all that is said beside.

use goodbot::asking::Answer;
use goodbot::feedback::Feedback;
use goodbot::home::{Home, HomeState};
use goodbot::memory::HomeMemory;
use goodbot::talk::{Class, Listened, Said, Verdict};
use goodbot::task::{GroundedTask, LiftedTask, ground_with_done};
use goodbot_lesson::conversing::Conversing;
use goodbot_lesson::listening::{kept_table, tells_talk};
use goodbot_lesson::walk::Listening;

use crate::cells::MIND;
use crate::replay::{not_begun, with_names};
use crate::training::task_name;
use crate::view::Heard;
use crate::world::{Refusal, World};

/// All tasks that commands may mean where things are so, those that are done already too, each with its name.
pub(crate) fn named_tasks<M: HomeMemory>(
    home: &Home<M>,
    lifted: &[LiftedTask],
    start: &HomeState,
) -> Result<Vec<(GroundedTask, String)>, Refusal> {
    let mut tasks = vec![GroundedTask::UNUSED; MIND.tasks];
    let count = ground_with_done(home, lifted, start, &mut tasks, f32::MIN_POSITIVE).map_err(Refusal::from)?;
    Ok(with_names(home, lifted, &tasks[..count]))
}

/// How a session of a log began, where the robot listened: what was said, the task of the command before, and the conversation, as texts by
/// name.
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
    /// What a person's words ask for, at this point of the session: `command`, `correction`, `reward`, `punish`, `finish`, `yes`, `no`, the number of a
    /// choice, `stop`, `undo`, `again`, `unjudged` for praise and blame where there is nothing to judge, `unchanged` for what would change something where
    /// nothing was before, or `nothing`.
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

    /// Learns what is said along with a button: `reward` or `punish`.
    ///
    /// # Errors
    /// Where the words are too many or too long.
    pub fn learn_voice(&mut self, words: &str, feedback: &str) -> Result<(), Refusal> {
        self.lesson.learn_voice(words, feedback.parse().unwrap_or(Feedback::Neutral)).map_err(Refusal::from)
    }

    /// Tells the robot something where everything is now, as [`Lesson::tell`](goodbot_lesson::live::Lesson::tell) does. `insists` says that it is a
    /// command, whatever the robot takes it for; only what shall not be is no other command for that. A session under way ends unlearned.
    ///
    /// # Errors
    /// Why it cannot be heard; what was learned is kept.
    pub fn listen(&mut self, words: &str, insists: bool) -> Result<Heard, Refusal> {
        self.forget();
        let knows_little = self.sessions() > 0 && !tells_talk(self.agent());
        if let Some(task) = if knows_little && !insists { self.already(words)? } else { None } {
            return Ok(Heard { begun: false, verdict: "done", task, negated: false, command: String::new() });
        }
        let environment = self.environment_now();
        let mut listened = self.lesson.tell(words, environment).map_err(Refusal::from)?;
        if insists && !self.lesson.is_under_way() && !self.lesson.is_about_what_shall_not_be() {
            let environment = self.environment_now();
            self.lesson.hear(words, environment).map_err(Refusal::from)?;
            listened = None;
        }
        self.heard(listened)
    }

    /// Whether the utterance has a rest.
    pub fn is_more(&self) -> bool {
        self.lesson.is_more()
    }

    /// Begins with what is still to come, once a session is over, where everything is now. `None` where nothing is.
    ///
    /// # Errors
    /// As [`listen`](Self::listen).
    pub fn listen_on(&mut self) -> Result<Option<Heard>, Refusal> {
        let environment = self.environment_now();
        let listened = self.lesson.listen_on(environment).map_err(Refusal::from)?;
        listened.map(|listened| self.heard(Some(listened))).transpose()
    }

    /// Whether there is something to learn from the session under way.
    pub fn teaches(&self) -> bool {
        self.lesson.teaches()
    }

    /// Takes in words that turn the robot on its way round.
    ///
    /// # Errors
    /// Where no session is under way, or the words are too many or too long.
    pub fn correct(&mut self, words: &str) -> Result<(), Refusal> {
        self.lesson.correct(words).map(drop).map_err(Refusal::from)
    }

    /// Takes the last step back. Gives whether there was one.
    ///
    /// # Errors
    /// Where no session is under way.
    pub fn take_back(&mut self) -> Result<bool, Refusal> {
        let took = self.lesson.take_back().map_err(Refusal::from)?;
        self.lesson.walk_on().map_err(Refusal::from)?;
        self.lesson.go_on().map_err(Refusal::from)?;
        Ok(took)
    }

    /// Begins a session of a log anew where the robot listened.
    ///
    /// # Errors
    /// A name that is no task's or object's here.
    pub fn listen_as(&mut self, utterance: &str, after: Option<&str>, conversation: &[(String, String)]) -> Result<Heard, Refusal> {
        self.forget();
        let environment = self.environment_now();
        let (mind, home, state) = self.lesson.parts();
        let tasks = named_tasks(home, mind.lifted(), state)?;
        let (listening, after) = listening(home, mind.lifted(), &tasks, utterance, after, conversation)?;
        let listened = self.lesson.listen_as(listening, after, environment).map_err(Refusal::from)?;
        self.heard(Some(listened))
    }

    /// Where the recorded session that is being told began by listening.
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

    /// The recorded session that is being told had this table of closed words.
    ///
    /// # Errors
    /// A text that is no table.
    pub fn recorded_closed_words(&mut self, table: &str) -> Result<(), Refusal> {
        let told = self.replaying.as_mut().ok_or_else(not_begun)?;
        told.walk.closed = kept_table(table).map_err(|_| Refusal("“closed_words” is no table of words".to_owned()))?;
        Ok(())
    }

    /// The effect of words that the robot has listened to; `None` where it took them for a command.
    fn heard(&mut self, listened: Option<Listened>) -> Result<Heard, Refusal> {
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
        Ok(Heard { begun, verdict, task, negated: lesson.is_about_what_shall_not_be(), command })
    }
}
