//! The effect of a person's words during a session and between sessions: praise, blame, an answer, a correction, or a command.
//!
//! Closed classes of words determine it, without lessons. An utterance whose words are all in closed classes is no command. While the robot
//! acts, one other word may be among them, if it is in no learned command: "well done", "good job".
//!
//! - `classes`: closed classes of words, from a table.

pub(crate) mod classes;

pub use classes::{Class, Classes, ClosedWords, ClosedWordsError};

use crate::asking::{Answer, Question};
use crate::feedback::{Feedback, Judged};
use crate::language::{for_each_piece, word_form};
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::session::{Agent, AgentError};
use crate::symbols::Symbol;

/// The effect of a person's words, at this stage of the conversation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Said {
    /// A judgement of the last step.
    Judgement(Feedback),
    /// Praise for the robot that rests at its goal: the session is over.
    Finish,
    /// The answer to the open question.
    Answer(Answer),
    /// Words that correct the robot on its way: "no, the blue one". Without the feature `talk`, only those that begin with a no, a not or
    /// blame, or have a word such as "meant"; they are then no more than blame.
    Correction,
    /// Stop the robot.
    Stop,
    /// Undo the last step, or, between sessions, the last session.
    Undo,
    /// Repeat the same command.
    Again,
    /// Words without effect here.
    Nothing(Class),
    /// A command.
    Command,
}

/// The stage of a conversation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// No session is under way.
    Between,
    /// A session is under way, and no step waits for a word.
    OnTheWay,
    /// A step waits for a word.
    Stepped,
    /// The last step was a rest at the goal, and waits for a word.
    AtGoal,
}

impl Stage {
    /// Whether a step waits for a word.
    const fn is_judged(self) -> bool {
        matches!(self, Self::Stepped | Self::AtGoal)
    }
}

/// Classes of words that may stand beside praise, blame and answers.
const BESIDE: [Class; 5] = [Class::Polite, Class::Pronoun, Class::All, Class::Connective, Class::Asking];

/// Classes of words that may stand beside an act word where nothing is to be moved, and of act words that move nothing: "forget", "leave".
const BESIDE_ACTS: [Class; 4] = [Class::Negation, Class::Stop, Class::Polite, Class::You];
const NOT_TO_MOVE: [Class; 4] = [Class::If, Class::Out, Class::Asking, Class::Polite];

/// The most words of praise or blame.
const SHORT: usize = 6;

/// Whether a word of these classes may belong to praise, blame, an answer or other talk.
fn is_closed(classes: Classes) -> bool {
    Class::ALL.into_iter().any(|class| class.is_talk() && classes.contains(class))
        || classes.contains(Class::Negation)
        || classes.contains_any(&BESIDE)
}

/// Passes each word of an utterance outside the classes of talk to `take`: words whose meaning the buttons may teach.
///
/// # Errors
/// As [`for_each_piece`].
pub fn for_each_open_word(words: &str, closed: ClosedWords<'_>, mut take: impl FnMut(&str)) -> Result<(), AgentError> {
    for_each_piece(words, |piece| {
        if !is_closed(closed.of(piece).about_commands()) {
            take(piece);
        }
        Ok(())
    })?;
    Ok(())
}

/// A summary of the classes of an utterance's words.
#[derive(Default)]
struct Summary {
    count: usize,
    first: Classes,
    any: Classes,
    /// Whether a word negates, and is no yes.
    is_not: bool,
    /// The number of words outside the classes of talk.
    strange: usize,
    /// Whether a word asks to undo something.
    is_back: bool,
    is_meant: bool,
    /// The number of act words, and of words that are neither these nor may stand beside them in "do not move" and "stop driving".
    acts: usize,
    others: usize,
    /// Whether a word forbids something, and is no "no".
    forbids: bool,
    /// The number that the last word is.
    number: Option<u8>,
    /// How often words like these came with praise and with blame; `None` if one of them never did.
    learned: Option<[u32; 2]>,
}

impl Summary {
    const fn has(&self, class: Class) -> bool {
        self.any.contains(class)
    }

    /// Whether the robot shall not act at all: "do not move", "stop driving". "Do not move the bag" names something, so it is a command, and
    /// "no, drive" and "do not forget" ask for an act.
    const fn halts(&self) -> bool {
        (self.forbids || self.first.contains(Class::Stop)) && self.acts > 0 && self.others == 0
    }

    /// The class of the closed words, at any stage of the conversation.
    fn class(&self) -> Option<Class> {
        let turned = |turned: bool, plain: Class, other: Class| if turned { other } else { plain };
        Some(match () {
            () if self.has(Class::Stop) => Class::Stop,
            () if self.first.contains(Class::Asking) && !self.first.contains(Class::Polite) => Class::Asking,
            () if self.has(Class::Praise) => turned(self.is_not || self.has(Class::No), Class::Praise, Class::Blame),
            () if self.has(Class::Blame) => turned(self.is_not, Class::Blame, Class::Praise),
            () => return [Class::No, Class::Yes, Class::Again, Class::Greeting].into_iter().find(|&class| self.has(class)),
        })
    }

    /// The judgement that the words stand for, as learned together with the buttons.
    fn judges(&self) -> Option<Class> {
        let [good, bad] = self.learned?.map(u64::from);
        match () {
            () if good > bad.saturating_mul(2) => Some(Class::Praise),
            () if bad > good.saturating_mul(2) => Some(Class::Blame),
            () => None,
        }
    }
}

impl<M: AgentMemory> Agent<M> {
    /// The stage of the conversation, by the actions reported to the agent; `state` is the present state.
    pub fn stage<D: Domain>(&self, domain: &D, state: &D::State) -> Stage {
        if self.check_session(domain).is_err() {
            return Stage::Between;
        }
        let Some(task) = self.followed.or_else(|| self.most_likely()).filter(|_| self.done.is_something()) else {
            return Stage::OnTheWay;
        };
        let kind = self.lifted.get(usize::from(self.task(task).lifted));
        let is_reached = kind.is_some_and(|kind| self.task(task).is_reached(kind, |part| domain.holds(part, state)));
        let rests = self.judged(task).first() == Some(&Judged::RestsAtGoal);
        if rests && is_reached { Stage::AtGoal } else { Stage::Stepped }
    }

    /// The effect of a person's words, which is not carried out. `learned` returns how often a word came with praise and with blame, `None`
    /// if it never did; callers that learn no such words return `None`.
    ///
    /// ```
    /// use goodbot::feedback::Feedback;
    /// use goodbot::voice::{ClosedWords, Said, Stage};
    /// use goodbot::{Agent, HeapMemory, Options, home};
    /// let memory = HeapMemory::new(&goodbot::Capacities::SMALL);
    /// let agent = Agent::new(memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// let said = |words, stage| agent.said(words, ClosedWords::ENGLISH, stage, |_| None);
    /// assert_eq!(said("well done!", Stage::Stepped)?, Said::Judgement(Feedback::Reward));
    /// assert_eq!(said("stop", Stage::OnTheWay)?, Said::Stop);
    /// assert_eq!(said("go to the red room", Stage::Between)?, Said::Command);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// An [`AgentError`] if there are too many words or one is too long.
    pub fn said(
        &self,
        words: &str,
        closed: ClosedWords<'_>,
        stage: Stage,
        learned: impl Fn(&str) -> Option<[u32; 2]>,
    ) -> Result<Said, AgentError> {
        let heard = self.words_of(words, closed, learned)?;
        if heard.halts() {
            return Ok(Said::Stop);
        }
        let question = self.open_question().filter(|_| stage != Stage::Between);
        let choices = question.map_or(0, |question| question.subject.choices());
        if let Some(number) = heard.number.filter(|number| heard.count == 1 && (1..=choices).contains(number)) {
            return Ok(Said::Answer(Answer::This(number.saturating_sub(1))));
        }
        let is_judged = stage.is_judged();
        // "Well done", "good job", but not "put the good chair there".
        let has_room = is_judged && is_closed(heard.first) && heard.strange == 1 && heard.count <= SHORT;
        // To look for a word among the learned ones takes longer than all else, so it is done last.
        let class = match heard.class() {
            class if heard.strange == 0 => class,
            Some(class) if has_room && !self.knows_strange(words, closed)? => Some(class),
            _ => None,
        };
        let class = match heard.judges().filter(|_| class.is_none() && is_judged) {
            Some(judged) if !self.knows_strange(words, closed)? => Some(judged),
            _ => class,
        };
        Ok(match class {
            Some(class) => act_of(class, &heard, stage, question),
            None if stage != Stage::Between && self.corrects(words, closed, &heard)? => Said::Correction,
            None => Said::Command,
        })
    }

    fn words_of(&self, words: &str, closed: ClosedWords<'_>, learned: impl Fn(&str) -> Option<[u32; 2]>) -> Result<Summary, AgentError> {
        let mut heard = Summary { learned: Some([0, 0]), ..Summary::default() };
        for_each_piece(words, |piece| {
            let in_table = closed.of(piece);
            let classes = in_table.about_commands();
            let is_closed = is_closed(classes);
            if heard.count == 0 {
                heard.first = classes;
            }
            heard.count = heard.count.saturating_add(1);
            heard.any = heard.any.and(classes);
            heard.is_not |= classes.contains(Class::Negation) && !classes.contains(Class::Yes);
            heard.strange = heard.strange.saturating_add(usize::from(!is_closed));
            heard.is_back |= classes.contains(Class::Again) && classes.contains_any(&[Class::Back, Class::Undo]);
            heard.forbids |= classes.contains(Class::Negation) && !classes.contains_any(&[Class::No, Class::Yes]);
            let acts = in_table.contains(Class::Act);
            if acts && !classes.contains_any(&NOT_TO_MOVE) {
                heard.acts = heard.acts.saturating_add(1);
            } else if acts || !classes.contains_any(&BESIDE_ACTS) || classes.contains(Class::No) {
                heard.others = heard.others.saturating_add(1);
            }
            heard.is_meant |= in_table.contains(Class::Meant);
            heard.number = piece.parse().ok();
            heard.learned = match (heard.learned, learned(piece)) {
                (Some([good, bad]), Some([more_good, more_bad])) => Some([good.saturating_add(more_good), bad.saturating_add(more_bad)]),
                (counts, None) if is_closed => counts,
                _ => None,
            };
            Ok(())
        })?;
        Ok(heard)
    }

    /// Whether a learned command has one of the words outside the classes of talk.
    fn knows_strange(&self, words: &str, closed: ClosedWords<'_>) -> Result<bool, AgentError> {
        let mut knows = false;
        for_each_open_word(words, closed, |piece| knows = knows || self.knows_word(piece))?;
        Ok(knows)
    }

    /// Whether words correct the robot: they begin with "no" or "not", or name something without an act word.
    #[cfg_attr(not(feature = "talk"), expect(unused_variables, reason = "only talk knows act words"))]
    fn corrects(&self, words: &str, closed: ClosedWords<'_>, heard: &Summary) -> Result<bool, AgentError> {
        if heard.first.contains_any(&[Class::No, Class::Blame]) {
            return Ok(true);
        }
        let is_cue = heard.first.contains(Class::Negation) || heard.is_meant;
        #[cfg(feature = "talk")]
        let is_cue = (is_cue || self.is_named(words, closed)?) && !self.is_told_to_act(words, closed)?;
        Ok(is_cue)
    }

    /// Whether a word occurs in a learned command.
    pub fn knows_word(&self, word: &str) -> bool {
        self.known_word(word).is_some()
    }

    /// The learned word that a piece of an utterance stands for.
    pub(crate) fn known_word(&self, piece: &str) -> Option<Symbol> {
        let (language, learned) = (self.language(), self.language().tables().words());
        let form = word_form(piece, self.options().language.letters_kept());
        language.word_like(piece, learned).or_else(|| language.words().find(form)).filter(|word| word.index() < learned)
    }
}

/// The effect of a class of words here.
fn act_of(class: Class, words: &Summary, stage: Stage, question: Option<&Question>) -> Said {
    match class {
        Class::Praise | Class::Yes if question.is_some_and(|question| question.subject.choices() == 0) => Said::Answer(Answer::Yes),
        Class::Blame | Class::No if question.is_some() => Said::Answer(Answer::No),
        Class::Praise | Class::Yes if stage == Stage::AtGoal => Said::Finish,
        Class::Praise | Class::Yes if stage.is_judged() => Said::Judgement(Feedback::Reward),
        Class::Blame | Class::No if stage.is_judged() => Said::Judgement(Feedback::Punish),
        Class::Stop => Said::Stop,
        Class::Again if words.is_back => Said::Undo,
        Class::Again if stage == Stage::Between => Said::Again,
        class => Said::Nothing(class),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Capacities, HeapMemory, Options, home};

    fn said(words: &str, closed: ClosedWords<'_>, stage: Stage) -> Said {
        let memory = HeapMemory::new(&Capacities::SMALL);
        let agent = Agent::new(memory.agent, &home::paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        agent.said(words, closed, stage, |_| None).unwrap()
    }

    #[test]
    fn emergencies_and_an_act_that_is_forbidden_or_stopped_stop_the_robot() {
        const STAGES: [Stage; 4] = [Stage::Between, Stage::OnTheWay, Stage::Stepped, Stage::AtGoal];
        let english = [
            "stop",
            "emergency stop!",
            "emergency!",
            "do not move",
            "don't move, please",
            "never move",
            "stop driving",
            "robot, don't you move",
        ];
        for (closed, sentences) in [
            (ClosedWords::ENGLISH, &english[..]),
            (ClosedWords::GERMAN, &["stopp", "Notstopp!", "nothalt", "nicht bewegen", "beweg dich bitte nicht"]),
            (ClosedWords::FRENCH, &["stop", "arrêt d'urgence", "urgence"]),
        ] {
            for (stage, words) in STAGES.into_iter().flat_map(|stage| sentences.iter().map(move |words| (stage, words))) {
                assert_eq!(said(words, closed, stage), Said::Stop, "{words} {stage:?}");
            }
        }
    }

    #[test]
    fn what_names_a_thing_or_a_place_stops_nothing() {
        for words in [
            "stop at the red room",
            "do not move the bag",
            "don't move it",
            "do not go to the red room",
            "go to the emergency exit",
            "take the bag to the emergency room",
            "move",
            "no, drive",
            "don't forget",
            "don't leave",
            "go and wait",
            "don't go back",
        ] {
            for stage in [Stage::Between, Stage::OnTheWay] {
                assert_ne!(said(words, ClosedWords::ENGLISH, stage), Said::Stop, "{words} {stage:?}");
            }
        }
        assert_ne!(said("beweg die Tasche nicht", ClosedWords::GERMAN, Stage::Between), Said::Stop);
    }
}
