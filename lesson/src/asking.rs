//! When the robot asks in a live session: seldom, and nothing twice.
//!
//! Beside what [`goodbot::asking`] decides: never where a task is believed with 0.5; never what was asked or offered before in the session,
//! even after a step back; and half as readily after each session in which all answers were as expected, down to an eighth, until one is not.
//! While a question waits for its answer, no other is asked.
//! Where the robot listened and two tasks fit nearly as well that differ in one object, such as two chairs, it asks at once which is meant.

use crate::live::{Lesson, LiveError};
use crate::place::Place;
use goodbot::asking::{Answer, Asking, Considered, Question};
use goodbot::memory::AgentHeap;
use goodbot::oomdp::Domain;
use goodbot::task::TaskSet;
use goodbot::{Agent, AgentError};

/// With this much belief in a task nothing is asked. Chosen with four robots of twenty lessons: 0.8 brings a question before a third of the
/// commands, and understands 2 in 100 more.
const SURE: f32 = 0.5;
/// Expected answers in up to this many sessions make it ask ever less.
const MOST_TRUST: u8 = 3;
/// An answer with less than this share of an even part is a surprise.
const LEAST_EXPECTED: f32 = 0.9;
/// What a question costs in steps where two things fit alike.
const COST_OF_A_TIE: f32 = 0.5;
/// Two tasks fit alike if the less probable one has this share of the other, and both together this belief.
const TIE: f32 = 0.6;

/// What keeps a robot from asking much: what it asked in a session, and how its questions were answered.
#[derive(Clone, Debug, Default)]
pub struct Restraint {
    /// The tasks of each question and of each of its choices.
    sets: Vec<TaskSet>,
    answered: bool,
    surprised: bool,
    /// In how many sessions, one after another, all answers were as expected.
    trust: u8,
}

impl Restraint {
    /// Nothing was asked yet.
    pub const NEW: Self = Self { sets: Vec::new(), answered: false, surprised: false, trust: 0 };

    /// A session begins: what was asked before may be asked again.
    pub fn begin(&mut self) {
        *self = Self { trust: self.trust, ..Self::NEW };
    }

    /// A session is over: whether its answers were as expected counts for the next.
    pub fn end(&mut self) {
        self.trust = match (self.answered, self.surprised) {
            (false, _) => self.trust,
            (true, false) => self.trust.saturating_add(1).min(MOST_TRUST),
            (true, true) => 0,
        };
    }

    /// Proposes a question, as [`Agent::consider`] does. `listened` says whether the robot listened to the command.
    ///
    /// # Errors
    /// What [`Agent::consider`] refuses.
    pub fn consider<D: Domain + ?Sized>(
        &mut self,
        agent: &mut Agent<AgentHeap>,
        domain: &D,
        state: &D::State,
        asking: &Asking,
        listened: bool,
        budget: u32,
    ) -> Result<Considered, AgentError> {
        // A trainer who does not answer is not asked more.
        if agent.open_question().is_some() {
            return Ok(Considered::Act);
        }
        let mut asking = Asking { sure: asking.sure.min(SURE), kappa: asking.kappa * f32::from(1_u8 << self.trust), ..*asking };
        if listened && asking.kappa.is_finite() && has_tie(agent) {
            asking.kappa = asking.kappa.min(COST_OF_A_TIE);
        }
        loop {
            match agent.consider(domain, state, &asking, budget)? {
                // The agent proposes nothing twice, so this ends.
                Considered::Ask(question) if sets(&question).any(|set| self.sets.contains(&set)) => agent.withdraw_question(),
                Considered::Ask(question) => {
                    self.sets.extend(sets(&question));
                    return Ok(Considered::Ask(question));
                }
                considered => return Ok(considered),
            }
        }
    }

    /// Records how probable an answer is that is about to be taken in. One that is less probable than most is a surprise.
    pub fn expect(&mut self, agent: &Agent<AgentHeap>, answer: Answer) {
        let Some((tasks, yes, others)) = agent.open_question().and_then(|question| question.meaning(answer)) else { return };
        let among: f32 = tasks.iter().map(|task| agent.belief().probability(task)).sum();
        let probability = if yes { among } else { 1.0 - among };
        self.answered = true;
        self.surprised |= probability * (f32::from(others) + 1.0) < LEAST_EXPECTED;
    }
}

/// The tasks of a question, and those of each choice.
fn sets(question: &Question) -> impl Iterator<Item = TaskSet> {
    let count = usize::from(question.subject.choices());
    std::iter::once(question.yes).chain(question.choices.into_iter().take(count)).filter(|set| !set.is_empty())
}

/// Whether two tasks that differ in one object fit what was said nearly as well.
fn has_tie(agent: &Agent<AgentHeap>) -> bool {
    let belief = agent.belief();
    let next = |than: Option<usize>| {
        let tasks = (0..agent.tasks().len()).filter(|&task| Some(task) != than);
        tasks.map(|task| (task, belief.probability(task))).reduce(|one, other| if other.1 > one.1 { other } else { one })
    };
    let Some((first, most)) = next(None) else { return false };
    let Some((second, next)) = next(Some(first)) else { return false };
    let [first, second] = [first, second].map(|task| agent.tasks()[task]);
    let different = first.bindings.iter().zip(&second.bindings).filter(|(a, b)| a != b).count();
    first.lifted == second.lifted && different == 1 && next >= TIE * most && most + next >= TIE
}

impl<D: Place> Lesson<D> {
    /// What the robot asks here, if a question teaches it more than its next steps do. The plan must be done.
    ///
    /// # Errors
    /// [`LiveError::NoSession`], or what [`Agent::question`] refuses.
    pub fn ask(&mut self, asking: &Asking) -> Result<Option<Question>, LiveError> {
        loop {
            match self.consider(asking, u32::MAX)? {
                Considered::Working => {}
                Considered::Act => return Ok(None),
                Considered::Ask(question) => return Ok(Some(question)),
            }
        }
    }

    /// As [`ask`](Self::ask), but in parts: see [`Agent::consider`].
    ///
    /// # Errors
    /// As [`ask`](Self::ask).
    pub fn consider(&mut self, asking: &Asking, budget: u32) -> Result<Considered, LiveError> {
        let listened = self.session().ok_or(LiveError::NoSession)?.0.listening.is_some();
        let (agent, home, state) = (&mut self.agent, &self.walk.home, &self.state);
        Ok(self.restraint.consider(agent, home, state, asking, listened, budget)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use goodbot::home::{Moves, paper_tasks};
    use goodbot::{Capacities, Options};

    /// A session with a robot that knows no word: what it asks, if anything, and this answer.
    fn asked(restraint: &mut Restraint, kappa: f32, answer: Answer) -> Option<Question> {
        let drawn = "#########\n#rrr#ggg#\n#r@r+gCg#\n#rrr#ggg#\n##+###+##\n#bbb#ttt#\n#bBb+ttt#\n#bbb#ttt#\n#########\nC: red chair\nB: teal bag\n";
        let rooms = crate::home::parse("home", drawn).unwrap();
        let (home, start) = crate::home::build(&rooms, Moves::Push, crate::home::memory()).unwrap();
        let mut agent = Agent::new(AgentHeap::new(&Capacities::SMALL), &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        agent.hear(&home, &start, "abrakadabra").unwrap();
        agent.plan_fully(&home, &start).unwrap();
        restraint.begin();
        let considered = restraint.consider(&mut agent, &home, &start, &Asking { kappa, ..Asking::DEFAULT }, false, u32::MAX).unwrap();
        let question = match considered {
            Considered::Ask(question) => Some(question),
            _ => None,
        };
        restraint.expect(&agent, answer);
        restraint.end();
        question
    }

    #[test]
    fn it_asks_less_after_answers_as_expected_and_more_after_a_surprise() {
        let mut restraint = Restraint::NEW;
        for _ in 0..2 {
            // Which of three objects: the first is in most tasks.
            let question = asked(&mut restraint, 8.0, Answer::This(0)).unwrap();
            assert_eq!(question.subject.choices(), 3);
            assert_eq!(asked(&mut restraint, 8.0, Answer::No), None, "what it does not ask has no answer");
            assert_eq!(asked(&mut restraint, 8.0, Answer::No), None);
            assert!(asked(&mut restraint, 1.0, Answer::No).is_some());
        }
    }
}
