//! Replays a recorded session with an agent: the same command in the same home or world, the same actions, feedback and answers.

use crate::listening::listen;
use crate::walk::{Expected, SessionAnswer, Step, Walk};
use goodbot::feedback::{Ending, Strategy, population};
use goodbot::home::HomeState;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::{Action, Domain};
use goodbot::planning::Progress;
use goodbot::session::Evidence;
use goodbot::task::GroundedTask;
use goodbot::{Agent, AgentError, Options};
use goodbot_formats::session::Kind;

/// Which parts of a recorded session count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    /// Whether the agent expects the trainer strategies that the session names.
    pub strategies: bool,
    /// Whether the recorded prior counts, or the belief of the session before if this one continues it. Otherwise only the command counts.
    pub context: bool,
    /// Whether feedback, demonstrations and answers are evidence. Otherwise the agent only plans for each step.
    pub evidence: bool,
    /// Whether the agent plans for the end too. A demonstration that is evidence then ends with a rest: a demonstrator stops when the task
    /// is done.
    pub end: bool,
    /// Whether the session is over. Otherwise its end is no evidence, whatever the agent's options.
    pub over: bool,
}

impl Rules {
    /// The session as it happened.
    pub const AS_IT_WAS: Self = Self { strategies: true, context: true, evidence: true, end: false, over: true };
    /// The session's evidence for its task, without earlier knowledge.
    pub const BY_ITSELF: Self = Self { strategies: true, context: false, evidence: true, end: true, over: true };
    /// Plans alone, to judge the trainer and not the task.
    pub const PLANS: Self = Self { strategies: false, context: false, evidence: false, end: true, over: true };
    /// A session under way, up to its present step.
    pub const UNDER_WAY: Self = Self { over: false, ..Self::AS_IT_WAS };
}

/// The event of one call of [`Replay::advance`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event<'s, S = HomeState> {
    /// The budget is used up; call again.
    Working,
    /// The agent heard the command.
    Heard,
    /// The agent took an answer of the trainer.
    Answered(&'s SessionAnswer),
    /// The plan for a step is done, and the step comes next; without a step, the plan for the end.
    Planned(Option<&'s Step<S>>),
    /// The agent took a step and its feedback.
    Took(&'s Step<S>, Evidence),
    /// The end was taken as evidence.
    Closed(Evidence),
    /// The session is replayed.
    Ended,
}

/// An agent's error, and the line in the log that caused it.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{error}")]
pub struct ReplayError {
    /// The line in the log.
    pub line: usize,
    /// The error.
    pub error: AgentError,
}

#[derive(Clone, Copy, Debug)]
enum Next {
    Hear,
    Plan(usize),
    Take(usize),
    PlanEnd,
    TakeEnd,
    Nothing,
}

/// The replay of a recorded session. Finish or forget the session after [`Event::Ended`].
///
/// ```
/// use goodbot::memory::AgentHeap;
/// use goodbot::{Agent, Capacities, Options, home::paper_tasks};
/// use goodbot_formats::session::SessionReader;
/// use goodbot_lesson::{checked, home, replay::{Event, Replay, Rules}};
///
/// let log = r#"{"type":"session","version":1,"kind":"feedback","command":"go there","environment":{"version":1,"objects":[
///   {"class":"room","name":"a","left":0,"bottom":0,"right":3,"top":3,"color":"red"},
///   {"class":"room","name":"b","left":3,"bottom":0,"right":6,"top":3,"color":"blue"},
///   {"class":"door","name":"d","left":3,"bottom":1,"right":3,"top":1},
///   {"class":"agent","name":"r","x":2,"y":1}]}}
/// {"type":"step","action":"east","feedback":"reward"}
/// {"type":"end","learn":true}"#.replace("\n  ", "");
/// let recorded = SessionReader::new(log.as_bytes()).next().unwrap()?;
/// let lifted = paper_tasks().unwrap();
/// let mut agent = Agent::new(AgentHeap::new(&Capacities::SMALL), &lifted, Options::DEFAULT)?;
/// let session = checked::check("log", &recorded, &lifted, home::memory()).expect("a sound session");
/// let mut replay = Replay::new(Rules::AS_IT_WAS);
/// while replay.advance(&mut agent, &session.walk, u32::MAX)? != Event::Ended {}
/// let _ = agent.finish(&session.walk.home)?;
/// agent.learn_fully();
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Replay {
    rules: Rules,
    next: Next,
    answered: usize,
}

impl Replay {
    /// A replay at the beginning of a session.
    pub const fn new(rules: Rules) -> Self {
        Self { rules, next: Next::Hear, answered: 0 }
    }

    /// Continues to the next event. Pass the same `walk` at each call, and leave the agent's belief and plan alone in between. One call
    /// plans with a budget of about `budget` node expansions.
    ///
    /// # Errors
    /// The agent's error, with the line.
    pub fn advance<'s, D: Domain>(
        &mut self,
        agent: &mut Agent<impl AgentMemory>,
        walk: &'s Walk<D>,
        budget: u32,
    ) -> Result<Event<'s, D::State>, ReplayError> {
        let line = match self.next {
            Next::Hear => walk.header_line,
            Next::Plan(position) | Next::Take(position) => walk.steps.get(position).map_or(walk.end_line, |step| step.line),
            Next::PlanEnd | Next::TakeEnd | Next::Nothing => walk.end_line,
        };
        let at = |error| ReplayError { line, error };
        match self.next {
            Next::Hear => {
                self.hear(agent, walk).map_err(at)?;
                self.next = Next::Plan(0);
                Ok(Event::Heard)
            }
            Next::Plan(position) => {
                if let Some(answer) = self.answer_before(walk, position) {
                    answered(agent, walk, answer).map_err(|error| ReplayError { line: answer.line, error })?;
                    self.answered += 1;
                    return Ok(Event::Answered(answer));
                }
                let Some(step) = walk.steps.get(position) else {
                    self.next = if self.plans_end(agent, walk) { Next::PlanEnd } else { Next::Nothing };
                    return self.advance(agent, walk, budget);
                };
                if agent.plan(&walk.home, &step.before, budget).map_err(at)? == Progress::Working {
                    return Ok(Event::Working);
                }
                self.next = if self.rules.evidence { Next::Take(position) } else { Next::Plan(position + 1) };
                Ok(Event::Planned(Some(step)))
            }
            Next::Take(position) => {
                let Some(step) = walk.steps.get(position) else { return Ok(Event::Ended) };
                let evidence = take(agent, walk, step).map_err(at)?;
                self.next = Next::Plan(position + 1);
                Ok(Event::Took(step, evidence))
            }
            Next::PlanEnd => {
                if agent.plan(&walk.home, &walk.end(), budget).map_err(at)? == Progress::Working {
                    return Ok(Event::Working);
                }
                self.next = if self.rules.evidence { Next::TakeEnd } else { Next::Nothing };
                Ok(Event::Planned(None))
            }
            Next::TakeEnd => {
                self.next = Next::Nothing;
                let end = walk.end();
                match walk.kind {
                    Kind::Demonstration => agent.demonstrated(&walk.home, &end, Action::NOOP).map(Event::Closed),
                    Kind::Feedback if agent.options().ending.is_evidence() => agent.trainer_ended(&walk.home, &end).map(Event::Closed),
                    Kind::Feedback | Kind::Labelled => Ok(Event::Ended),
                }
                .map_err(at)
            }
            Next::Nothing => Ok(Event::Ended),
        }
    }

    fn hear<D: Domain>(self, agent: &mut Agent<impl AgentMemory>, walk: &Walk<D>) -> Result<(), AgentError> {
        if let Some(strategies) = walk.strategies.as_ref().filter(|_| self.rules.strategies) {
            expect(agent, strategies)?;
        }
        if self.rules.strategies && !(walk.continues && self.rules.context) {
            expect_ends(agent)?;
        }
        let (home, start) = (&walk.home, &walk.start);
        if let Some(listening) = &walk.listening {
            return listen(agent, home, start, listening, walk.closed).map(|_| ());
        }
        agent.resume(goodbot::talk::Conversation::NEW);
        if walk.continues && self.rules.context {
            agent.hear_again(home, start)
        } else if let Some(prior) = walk.prior.as_ref().filter(|_| self.rules.context) {
            let of = |task: &GroundedTask| prior.iter().find(|(known, _)| known == task).map_or(0.0, |&(_, share)| share);
            agent.hear_with_prior(home, start, &walk.command, |task, _| of(task))
        } else {
            agent.hear(home, start, &walk.command)
        }
    }

    fn answer_before<D: Domain>(self, walk: &Walk<D>, position: usize) -> Option<&SessionAnswer> {
        walk.answers.get(self.answered).filter(|answer| self.rules.evidence && answer.after <= position)
    }

    fn plans_end<D: Domain>(self, agent: &Agent<impl AgentMemory>, walk: &Walk<D>) -> bool {
        let ends = walk.kind == Kind::Feedback && agent.options().ending.is_evidence() && !walk.steps.is_empty();
        match walk.kind {
            _ if !self.rules.over => false,
            _ if !self.rules.evidence => self.rules.end,
            Kind::Demonstration => self.rules.end,
            Kind::Feedback | Kind::Labelled => ends,
        }
    }
}

/// Whether the agent expects the strategies fitted to real people.
pub fn expects_people(agent: &Agent<impl AgentMemory>) -> bool {
    let expected = agent.belief().strategies().iter().map(|(strategy, _)| strategy);
    expected.eq(population::STRATEGIES.iter().map(|(strategy, _)| strategy))
}

/// Makes the end of a session evidence if the agent expects real people's strategies: when people end a session is known. Otherwise makes
/// it no evidence. A change forgets the session under way.
///
/// # Errors
/// The agent's error.
pub fn expect_ends(agent: &mut Agent<impl AgentMemory>) -> Result<(), AgentError> {
    let options = *agent.options();
    let ending = if expects_people(agent) { population::ENDING } else { Ending::NO_EVIDENCE };
    if options.ending == ending { Ok(()) } else { agent.set_options(Options { ending, ..options }) }
}

/// Makes the agent expect these trainer strategies. If it expects them already, to the last bit, nothing changes: so its own log teaches it
/// the same again.
///
/// # Errors
/// The agent's error.
pub fn expect(agent: &mut Agent<impl AgentMemory>, strategies: &[Expected]) -> Result<(), AgentError> {
    let belief = agent.belief();
    let known = belief.strategies().iter().enumerate().map(|(at, &(strategy, _))| (strategy, belief.strategy_probability(at)));
    if known.eq(strategies.iter().map(|expected| (expected.strategy, expected.recorded))) {
        return Ok(());
    }
    let scaled: Vec<(Strategy, f32)> = strategies.iter().map(|expected| (expected.strategy, expected.share)).collect();
    agent.set_strategies(&scaled)
}

fn answered<D: Domain>(agent: &mut Agent<impl AgentMemory>, walk: &Walk<D>, answer: &SessionAnswer) -> Result<(), AgentError> {
    let _ = agent.answered(answer.tasks, answer.yes, answer.eta, answer.others)?;
    if let Some(words) = &answer.words {
        let _ = agent.corrected(&walk.home, words, walk.closed, answer.tasks)?;
    }
    Ok(())
}

fn take<D: Domain>(agent: &mut Agent<impl AgentMemory>, walk: &Walk<D>, step: &Step<D::State>) -> Result<Evidence, AgentError> {
    if walk.kind == Kind::Demonstration {
        return agent.demonstrated(&walk.home, &step.before, step.action);
    }
    agent.acted(&walk.home, &step.before, step.action)?;
    agent.feedback(step.feedback)
}
