//! What a person says while a session is under way, and between sessions: praise, blame, an answer, a correction, or a command.
//!
//! Closed classes of words tell it, and no lesson is needed. An utterance is no command if all of its words are of closed classes. While the
//! robot is on its way, one more word may be among them, if it is in no command that the robot learned: "well done", "good job". What is said
//! along with the buttons is learned: such words are praise or blame from then on, as long as the program runs.

use crate::listening::CLOSED_WORDS;
use crate::live::{Lesson, LiveError};
use crate::place::Place;
use crate::walk::SessionAnswer;
use goodbot::AgentError;
use goodbot::asking::{Answer, Asking};
use goodbot::feedback::Feedback;
use goodbot::language::for_each_piece;
use goodbot::planning::OptimalSet;
use goodbot::session::Evidence;
use goodbot::talk::{Class, Classes};
use goodbot::task::TaskSet;
use std::collections::BTreeMap;

/// What a person's words ask for, given where the conversation stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Said {
    /// A word to the last step.
    Judgement(Feedback),
    /// Praise for the robot that rests at its goal: the session is over.
    Finish,
    /// The answer to the open question.
    Answer(Answer),
    /// Words that turn the robot on its way round: "no, the blue one".
    Correction,
    /// The robot shall stop.
    Stop,
    /// Take something back: the last step, or, between sessions, the last session.
    Undo,
    /// The same command once more.
    Again,
    /// Words for which there is nothing to do here.
    Nothing(Class),
    /// A command.
    Command,
}

/// What was said along with the buttons: for each word, how often with "good" and with "bad".
#[derive(Clone, Debug, Default)]
pub struct Voice {
    said: BTreeMap<String, [u32; 2]>,
}

/// Words of the class [`Class::Again`] that take back rather than repeat.
const BACK: [&str; 9] = ["undo", "back", "zurück", "annule", "retour", "deshaz", "rückgängig", "vuelve", "revert"];

/// Classes of words that may stand beside praise, blame and answers.
const BESIDE: [Class; 5] = [Class::Polite, Class::Pronoun, Class::All, Class::Connective, Class::Asking];

/// Many words are no praise of one or two.
const SHORT: usize = 6;

/// An utterance, word by word, with the classes of each.
fn pieces(words: &str) -> Result<Vec<(String, Classes)>, AgentError> {
    let mut pieces = Vec::new();
    for_each_piece(words, |piece| {
        pieces.push((piece.to_owned(), CLOSED_WORDS.of(piece).about_commands()));
        Ok(())
    })?;
    Ok(pieces)
}

fn is_closed(classes: Classes) -> bool {
    Class::ALL.into_iter().any(|class| class.is_talk() && classes.contains(class))
        || classes.contains(Class::Negation)
        || classes.contains_any(&BESIDE)
}

impl Voice {
    /// Takes in what was said along with a button. Silence teaches nothing, and neither do words of closed classes.
    ///
    /// # Errors
    /// A [`goodbot::capacity::CapacityError`] where the words are too many or too long.
    pub fn learn(&mut self, words: &str, feedback: Feedback) -> Result<(), AgentError> {
        let side = match feedback {
            Feedback::Reward => 0,
            Feedback::Punish => 1,
            Feedback::Neutral => return Ok(()),
        };
        for (word, _) in pieces(words)?.into_iter().filter(|&(_, classes)| !is_closed(classes)) {
            let counts = self.said.entry(word).or_default();
            counts[side] = counts[side].saturating_add(1);
        }
        Ok(())
    }

    /// Whether words are praise (reward) or blame (punishment) by what was learned; `None` if they are neither, or a word was never heard so.
    fn judges(&self, pieces: &[(String, Classes)]) -> Option<Feedback> {
        let mut counts = [0, 0];
        for (word, classes) in pieces {
            match self.said.get(word) {
                Some(known) => (0..2).for_each(|side| counts[side] += u64::from(known[side])),
                None if is_closed(*classes) => {}
                None => return None,
            }
        }
        match counts {
            [good, bad] if good > 2 * bad => Some(Feedback::Reward),
            [good, bad] if bad > 2 * good => Some(Feedback::Punish),
            _ => None,
        }
    }
}

/// What closed words say, wherever the conversation stands.
fn class_of(pieces: &[(String, Classes)]) -> Option<Class> {
    let has = |class| pieces.iter().any(|(_, classes)| classes.contains(class));
    let is_not = pieces.iter().any(|(_, classes)| classes.contains(Class::Negation) && !classes.contains(Class::Yes));
    let asks = pieces.first().is_some_and(|(_, first)| first.contains(Class::Asking) && !first.contains(Class::Polite));
    Some(match () {
        () if has(Class::Stop) => Class::Stop,
        () if asks => Class::Asking,
        () if has(Class::Praise) => {
            if is_not || has(Class::No) {
                Class::Blame
            } else {
                Class::Praise
            }
        }
        () if has(Class::Blame) => {
            if is_not {
                Class::Praise
            } else {
                Class::Blame
            }
        }
        () if has(Class::No) => Class::No,
        () if has(Class::Yes) => Class::Yes,
        () if has(Class::Again) => Class::Again,
        () if has(Class::Greeting) => Class::Greeting,
        () => return None,
    })
}

impl<D: Place> Lesson<D> {
    /// What a person's words ask for, given where the conversation stands. Nothing is done yet.
    ///
    /// # Errors
    /// An [`AgentError`] where the words are too many or too long.
    pub fn said(&self, words: &str) -> Result<Said, LiveError> {
        let pieces = pieces(words)?;
        let strange: Vec<&String> = pieces.iter().filter(|(_, classes)| !is_closed(*classes)).map(|(word, _)| word).collect();
        let is_judged = self.acted().is_some();
        // "Well done", "good job", but not "put the good chair there".
        let begins = pieces.first().is_some_and(|(_, first)| is_closed(*first));
        let is_known = strange.iter().any(|word| self.agent.knows_word(word));
        let is_talk = strange.is_empty() || is_judged && begins && strange.len() == 1 && !is_known && pieces.len() <= SHORT;
        if let Some(answer) = self.number(&pieces) {
            return Ok(Said::Answer(answer));
        }
        let class = class_of(&pieces).filter(|_| is_talk);
        if let Some(class) = class {
            return Ok(self.act_of(class, &pieces));
        }
        if let Some(feedback) = self.voice.judges(&pieces).filter(|_| is_judged && !is_known) {
            return Ok(self.act_of(if feedback == Feedback::Reward { Class::Praise } else { Class::Blame }, &pieces));
        }
        let corrects = self.is_under_way() && self.corrects(words, &pieces)?;
        Ok(if corrects { Said::Correction } else { Said::Command })
    }

    /// The choice that a number is, where a question has choices.
    fn number(&self, pieces: &[(String, Classes)]) -> Option<Answer> {
        let [(word, _)] = pieces else { return None };
        let choices = self.agent.open_question().filter(|_| self.is_under_way())?.subject.choices();
        word.parse::<u8>().ok().filter(|number| (1..=choices).contains(number)).map(|number| Answer::This(number - 1))
    }

    /// What a class of words does here.
    fn act_of(&self, class: Class, pieces: &[(String, Classes)]) -> Said {
        let question = self.agent.open_question().filter(|_| self.is_under_way());
        let is_there = self.acted().is_some_and(|acted| acted.action == "noop" && acted.plan == OptimalSet::Goal);
        match class {
            Class::Praise | Class::Yes if question.is_some_and(|question| question.subject.choices() == 0) => Said::Answer(Answer::Yes),
            Class::Blame | Class::No if question.is_some() => Said::Answer(Answer::No),
            Class::Praise | Class::Yes if is_there => Said::Finish,
            Class::Praise | Class::Yes if self.acted().is_some() => Said::Judgement(Feedback::Reward),
            Class::Blame | Class::No if self.acted().is_some() => Said::Judgement(Feedback::Punish),
            Class::Stop => Said::Stop,
            Class::Again if pieces.iter().any(|(word, _)| BACK.contains(&word.as_str())) => Said::Undo,
            Class::Again if !self.is_under_way() => Said::Again,
            class => Said::Nothing(class),
        }
    }

    /// Whether words correct the robot: they begin with "no" or "not", or name something without a word for what to do.
    fn corrects(&self, words: &str, pieces: &[(String, Classes)]) -> Result<bool, LiveError> {
        let begins = |classes: &[Class]| pieces.first().is_some_and(|(_, first)| first.contains_any(classes));
        if begins(&[Class::No, Class::Blame]) {
            return Ok(true);
        }
        let names = pieces.iter().any(|(word, classes)| *classes == Classes::NONE && self.agent.knows_word(word));
        let is_cue = begins(&[Class::Negation]) || pieces.iter().any(|(word, _)| MEANT.contains(&word.as_str()));
        let is_other = pieces.iter().all(|(_, classes)| is_closed(*classes) || *classes != Classes::NONE);
        Ok((names || is_cue || is_other) && !self.agent.is_told_to_act(words, CLOSED_WORDS)?)
    }

    /// Takes in words that correct the robot: "no, the other one", "I meant the blue one", "not the red one". They are an answer "no" to the task
    /// that it follows, which is left with a twentieth of the belief in the next one at most, however sure the robot was; and the words
    /// are evidence.
    ///
    /// # Errors
    /// [`LiveError::NoSession`], or what the agent refuses.
    pub fn correct(&mut self, words: &str) -> Result<Evidence, LiveError> {
        if !self.is_under_way() {
            return Err(LiveError::NoSession);
        }
        let followed = self.acted().map_or_else(|| self.agent.most_likely(), |acted| Some(acted.task)).ok_or(LiveError::NoSession)?;
        let belief = |task: usize| self.agent.belief().probability(task);
        let next = (0..self.agent.tasks().len()).filter(|&task| task != followed).map(belief).fold(0.0, f32::max);
        let left = (LEFT * next / belief(followed)).clamp(f32::MIN_POSITIVE, Asking::DEFAULT.eta);
        let tasks = TaskSet::of(followed);
        let answer = SessionAnswer { tasks, yes: false, words: Some(words.trim().to_owned()), ..SessionAnswer::of(left) };
        self.agent.withdraw_question();
        let _ = self.agent.answered(answer.tasks, answer.yes, answer.eta, answer.others)?;
        let (agent, home, _) = self.parts();
        let _ = agent.corrected(home, words, CLOSED_WORDS)?;
        self.note_answer(answer);
        Ok(Evidence::Used)
    }
}

/// So much of the belief in the next task is left to the one that a correction turns the robot from.
const LEFT: f32 = 0.05;

/// Words that tell what was meant before.
const MEANT: [&str; 10] = ["meant", "mean", "meinte", "meine", "gemeint", "pensais", "voulais", "quise", "quería", "decía"];
