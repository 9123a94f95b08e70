//! When the robot asks in a live session: seldom, and nothing twice.
//!
//! Beyond [`goodbot::asking`], these rules hold:
//! - The robot asks nothing if a task has a belief of 0.5.
//! - It asks and offers nothing twice in a session, even after a step back.
//! - It asks half as readily after each session with expected answers only, down to an eighth, until an answer surprises it.
//! - It asks nothing while a question waits for its answer.
//! - If it listened, and two tasks that differ in one object fit nearly as well, it asks at once which is meant: two chairs, for example.

use goodbot::asking::{Answer, Asking, Considered, Question};
use goodbot::memory::AgentHeap;
use goodbot::oomdp::Domain;
use goodbot::task::TaskSet;
use goodbot::{Agent, AgentError};

/// The robot asks nothing if a task has this belief. Chosen with four robots of twenty lessons: 0.8 brings a question before a third of the
/// commands, and understands 2 in 100 more.
const SURE: f32 = 0.5;
/// Each session with expected answers makes the robot ask less, up to this many sessions.
const MOST_TRUST: u8 = 3;
/// An answer is a surprise if its probability is below this share of a uniform guess.
const LEAST_EXPECTED: f32 = 0.9;
/// The cost of a question between two tied tasks, in steps.
const COST_OF_A_TIE: f32 = 0.5;
/// Two tasks tie if the less probable one has this share of the other's belief, and both together have this belief.
const TIE: f32 = 0.6;

/// Keeps a robot from asking too much, by the questions of a session and by whether the answers were as expected.
#[derive(Clone, Debug, Default)]
pub struct Restraint {
    /// The tasks of each question and of each of its choices.
    sets: Vec<TaskSet>,
    answered: bool,
    surprised: bool,
    /// The number of sessions in a row with expected answers only.
    trust: u8,
}

impl Restraint {
    /// No question was asked yet.
    pub const NEW: Self = Self { sets: Vec::new(), answered: false, surprised: false, trust: 0 };

    /// Begins a session: earlier questions may be asked again.
    pub fn begin(&mut self) {
        *self = Self { trust: self.trust, ..Self::NEW };
    }

    /// Ends a session: whether its answers were as expected counts for the next one.
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
    /// The errors of [`Agent::consider`].
    pub fn consider<D: Domain>(
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

    /// Records the probability of an answer before it changes the belief, to tell surprises.
    pub fn expect(&mut self, agent: &Agent<AgentHeap>, answer: Answer) {
        let Some((tasks, yes, others)) = agent.open_question().and_then(|question| question.meaning(answer)) else { return };
        let among: f32 = tasks.iter().map(|task| agent.belief().probability(task)).sum();
        let probability = if yes { among } else { 1.0 - among };
        self.answered = true;
        self.surprised |= probability * (f32::from(others) + 1.0) < LEAST_EXPECTED;
    }
}

/// An answer from its text: `yes`, `no` (none of these, if there are choices), or the number of a choice, from 1 on.
pub fn answer_of(text: &str) -> Option<Answer> {
    match text {
        "yes" => Some(Answer::Yes),
        "no" => Some(Answer::No),
        number => number.parse::<u8>().ok()?.checked_sub(1).map(Answer::This),
    }
}

/// The tasks of a question, and those of each of its choices.
fn sets(question: &Question) -> impl Iterator<Item = TaskSet> {
    let count = usize::from(question.subject.choices());
    std::iter::once(question.yes).chain(question.choices.into_iter().take(count)).filter(|set| !set.is_empty())
}

/// Whether two tasks that differ in one object fit the command nearly as well.
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

#[cfg(test)]
mod tests {
    use super::*;
    use goodbot::home::{Moves, paper_tasks};
    use goodbot::{Capacities, Options};

    /// The question of a robot that knows no word, if it asks one, in a session with this answer.
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
