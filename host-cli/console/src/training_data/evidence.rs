//! Replays one session with an agent without words: how far do the steps speak for each task?

use super::{Lesson, MachineCommand, Reading, place, told_pairs};
use crate::typed::Believes;
use goodbot::feedback::{Ending, Strategy};
use goodbot::language::{LanguageRef, Model};
use goodbot::memory::AgentHeap;
use goodbot::oomdp::{Domain, ObjectId};
use goodbot::probability::total;
use goodbot::session::Evidence;
use goodbot::symbols::{Symbol, Symbols, SymbolsRef};
use goodbot::task::{Expression, LiftedTask, Marker, Part};
use goodbot::{Agent, AgentError, Capacities, Options};
use goodbot_formats::session::{FeedbackWord, Kind, RecordedSession, StepRecord};
use goodbot_formats::task_text::GroundAtomText;
use goodbot_formats::world::SessionInWorld;
use goodbot_lesson::checked::{CheckedSession, check};
use goodbot_lesson::fault::quoted;
use goodbot_lesson::name::description;
use goodbot_lesson::replay::{Event, Replay, Rules};
use goodbot_lesson::world;
use goodbot_lesson::world::robot::Robot;
use goodbot_lesson::{Fault, home};

/// Turns sessions into training data.
pub struct Witness {
    agent: Agent<AgentHeap>,
    lifted: Vec<LiftedTask>,
    believes: Option<Believes>,
}

impl Witness {
    /// A witness without words. `believes` replaces the trainer strategies that the sessions name.
    pub fn new(lifted: &[LiftedTask], options: Options, believes: Option<Believes>) -> Result<Self, goodbot::AgentError> {
        Ok(Self { agent: Agent::new(AgentHeap::new(&Capacities::STANDARD), lifted, options)?, lifted: lifted.to_vec(), believes })
    }

    /// Replays a session. The trainer strategies that it names count. A recorded prior does not count, because it comes from words.
    ///
    /// # Errors
    /// The faults of the session.
    pub fn lesson(&mut self, file: &str, recorded: &RecordedSession) -> Result<Lesson, Vec<Fault>> {
        let session = check(file, recorded, &self.lifted, home::memory())?;
        self.seen(file, recorded, &session, |home, state| {
            let cell = home.agent_cell(state);
            format!("walks into a wall or a held block at {}, {}; nothing moves, and the step still counts", cell.x, cell.y)
        })
    }

    /// Replays a session in another world, as [`lesson`](Self::lesson) does in a home.
    ///
    /// # Errors
    /// The faults of the session.
    pub fn lesson_in(&mut self, file: &str, recorded: &SessionInWorld, robot: Robot<'_>) -> Result<Lesson, Vec<Fault>> {
        let session = world::check(file, recorded, robot, &self.lifted)?;
        self.seen_in(file, recorded, &session)
    }

    /// The lesson of a command in another world. `intended` is its meaning; `None` if no task there has this meaning.
    ///
    /// # Errors
    /// The faults of the command.
    pub fn told_in(
        &mut self,
        file: &str,
        recorded: &SessionInWorld,
        robot: Robot<'_>,
        intended: &[GroundAtomText],
    ) -> Result<Option<Lesson>, Vec<Fault>> {
        let mut session = world::check(file, recorded, robot, &self.lifted)?;
        let sorted = |atoms: &[GroundAtomText]| {
            let mut atoms = atoms.to_vec();
            atoms.sort();
            atoms
        };
        let wanted = sorted(intended);
        session.intended = session.tasks.iter().position(|(_, name)| sorted(name.atoms()) == wanted);
        if session.intended.is_none() {
            return Ok(None);
        }
        self.seen_in(file, recorded, &session).map(Some)
    }

    fn seen_in(&mut self, file: &str, recorded: &SessionInWorld, session: &CheckedSession<Robot<'_>>) -> Result<Lesson, Vec<Fault>> {
        let bump = |_: &Robot<'_>, _: &u64| "changes nothing, and the step still counts".to_owned();
        let lesson = self.seen(file, &recorded.session, session, bump)?;
        Ok(Lesson { world: Some(place(&recorded.world, &recorded.facts)), ..lesson })
    }

    /// The training data of a session. `bump` words the effect of a step that changes nothing in a demonstration.
    fn seen<D: Domain>(
        &mut self,
        file: &str,
        recorded: &RecordedSession,
        session: &CheckedSession<D>,
        bump: impl Fn(&D, &D::State) -> String,
    ) -> Result<Lesson, Vec<Fault>> {
        let header = &recorded.header;
        let at = |line: usize| move |error: AgentError| vec![Fault::on_line(file, line, error)];
        self.expect(header.kind).map_err(at(recorded.header_line))?;
        let remarks = self.watch(file, session, bump)?;
        let intended = session.intended;
        let beliefs: Vec<f32> = match (header.kind, intended) {
            (Kind::Labelled, Some(told)) => (0..session.tasks.len()).map(|task| f32::from(u8::from(task == told))).collect(),
            _ => (0..session.tasks.len()).map(|task| self.agent.belief().probability(task)).collect(),
        };
        self.agent.weigh(&session.walk.home).map_err(at(recorded.end_line))?;
        let pairs = self.pairs();
        let readings = self.readings(session).map_err(at(recorded.header_line))?;
        let lesson = Lesson {
            id: header.id.clone().unwrap_or_else(|| format!("{file}:{}", recorded.header_line)),
            command: session.walk.command.clone(),
            header: header.clone(),
            intended,
            pairs: intended.filter(|_| header.kind == Kind::Labelled).and_then(|told| readings.get(told)).map_or(pairs, told_pairs),
            readings: readings.into(),
            beliefs,
            acts: true,
            walk: walked(recorded),
            learn: recorded.learn,
            remarks,
            long: session.long.map(|long| Fault::on_line(file, recorded.header_line, long).in_field("command")),
            ..Lesson::default()
        };
        self.agent.forget();
        Ok(lesson)
    }

    /// Expects the trainers of `believes` in a feedback session, and otherwise the paper's trainer, whom a session without strategies
    /// means. A demonstrator is expected to make one mistake in ten, like the paper's trainer.
    fn expect(&mut self, kind: Kind) -> Result<(), AgentError> {
        let plain = Options { drift: 0.0, ending: Ending::NO_EVIDENCE, ..*self.agent.options() };
        let told = self.believes.as_ref().filter(|_| kind == Kind::Feedback);
        self.agent.set_options(told.map_or(plain, |believes| believes.options(plain)))?;
        self.agent.set_strategies(told.and_then(Believes::strategies).unwrap_or(&[(Strategy::BALANCED, 1.0)]))
    }

    fn watch<D: Domain>(
        &mut self,
        file: &str,
        session: &CheckedSession<D>,
        bump: impl Fn(&D, &D::State) -> String,
    ) -> Result<Vec<Fault>, Vec<Fault>> {
        let mut remarks = vec![];
        let mut replay =
            Replay::new(Rules { strategies: self.believes.as_ref().and_then(Believes::strategies).is_none(), ..Rules::BY_ITSELF });
        loop {
            let event = replay.advance(&mut self.agent, &session.walk, u32::MAX);
            match event.map_err(|refused| vec![Fault::on_line(file, refused.line, refused.error)])? {
                Event::Ended => return Ok(remarks),
                Event::Took(step, evidence) => {
                    if step.bump && session.walk.kind == Kind::Demonstration {
                        let message = bump(&session.walk.home, &step.before);
                        remarks.push(Fault::on_line(file, step.line, message).in_field("action"));
                    }
                    remarks.extend(remark(evidence).map(|message| Fault::on_line(file, step.line, message)));
                }
                Event::Working | Event::Heard | Event::Answered(_) | Event::Planned(_) | Event::Closed(_) => {}
            }
        }
    }

    /// The machine commands with their shares of the posterior. Shares up to [`Options::least_weight`] are dropped.
    fn pairs(&self) -> Vec<(MachineCommand, f32)> {
        let candidates = self.agent.candidates();
        let whole = total(candidates.entries().iter().map(|entry| entry.weight));
        let text = |&token| token_text(self.agent.language().tokens(), token);
        let mut pairs: Vec<(MachineCommand, f32)> = candidates
            .entries()
            .iter()
            .map(|entry| (candidates.tokens(entry).iter().map(text).collect(), entry.weight.over(whole)))
            .filter(|&(_, share)| share > self.agent.options().least_weight)
            .collect();
        let kept: f32 = pairs.iter().map(|&(_, share)| share).sum();
        pairs.iter_mut().for_each(|(_, share)| *share /= kept);
        pairs
    }

    fn readings<D: Domain>(&self, session: &CheckedSession<D>) -> Result<Vec<Reading>, AgentError> {
        let mut readings = Vec::new();
        for (position, (task, name)) in session.tasks.iter().enumerate() {
            let Some(lifted) = self.lifted.get(usize::from(task.lifted)) else { continue };
            // The agent's prior favours tasks that change something. The language model must use the same prior.
            let prior = self.agent.tasks().get(position).map_or(task.prior, |it| it.prior);
            readings.push(Reading {
                name: name.clone(),
                label: label(&session.walk.home, lifted, &task.bindings),
                prior,
                commands: commands(&session.walk.home, &self.lifted, task, &session.walk.start, self.agent.options())?,
            });
        }
        Ok(readings)
    }
}

/// A remark on feedback to a step that is no evidence.
pub fn remark(evidence: Evidence) -> Option<&'static str> {
    match evidence {
        Evidence::Used => None,
        Evidence::Uninformative => Some("is no evidence: no exact plan is known here"),
        Evidence::Impossible => Some("this is impossible under every task and strategy, and was ignored"),
    }
}

/// The actions and their feedback, step by step.
fn walked(recorded: &RecordedSession) -> String {
    let step = |(_, step): &(usize, StepRecord)| format!("{} {}", step.action, step.feedback.map_or("", FeedbackWord::as_str));
    recorded.steps.iter().map(step).collect::<Vec<_>>().join(", ")
}

/// The text of a machine token; a role's marker is `@` and its number.
pub fn token_text(tokens: SymbolsRef<'_>, token: Symbol) -> String {
    Marker::of(token).map_or_else(|| tokens.text(token).to_owned(), |marker| marker.to_string())
}

/// The machine commands of a task, one for each constraint. For the role model, its description alone.
pub fn commands<D: Domain>(
    domain: &D,
    all: &[LiftedTask],
    task: &goodbot::task::GroundedTask,
    start: &D::State,
    options: &Options,
) -> Result<Vec<MachineCommand>, AgentError> {
    if options.language.model == Model::Roles {
        return Ok(vec![description(domain, all, task, start, |tokens, token| Ok(token_text(tokens, token)))?]);
    }
    let (mut bytes, mut ends, mut count) = ([0; 2_048], [0; 64], 0);
    let mut tokens =
        Symbols::new(&mut bytes, &mut ends, &mut count, goodbot::capacity::Capacity::Tokens, goodbot::capacity::Capacity::TokenBytes);
    let Some(lifted) = all.get(usize::from(task.lifted)) else { return Ok(vec![]) };
    let expression = Expression::new(domain, lifted, task, options.language.order, &mut tokens)?;
    let text = |constraint| -> Result<MachineCommand, AgentError> {
        Ok(expression.machine_command(constraint)?.iter().map(|&token| tokens.read().text(token).to_owned()).collect())
    };
    (0..expression.constraints()).map(text).collect()
}

/// A task as the names of its propositions, with the attributes of its objects.
pub fn label<D: Domain>(domain: &D, lifted: &LiftedTask, bindings: &[ObjectId]) -> String {
    let functions = lifted.parts().map(|(part, it)| {
        let sign = match part {
            Part::Goal => "",
            Part::Before(_) => "after ",
            Part::Through(_) => "through ",
            Part::Avoiding => "avoiding ",
        };
        format!("{sign}{}", domain.world().schema.proposition_name(it.proposition))
    });
    let objects = domain.world().objects;
    let mut parts: Vec<String> = functions.collect();
    for &object in bindings.iter().take(lifted.variables().len()) {
        for (position, _) in domain.world().schema.attributes.iter().enumerate() {
            let value = objects.value(object, position);
            if !value.is_empty() {
                parts.push(quoted(value).trim_matches('"').to_owned());
            }
        }
    }
    parts.join(" ")
}

/// The symbols of a description. All values that the model does not know share one symbol.
pub fn description_symbols(language: LanguageRef<'_>, description: &MachineCommand) -> Vec<Symbol> {
    const UNKNOWN: Symbol = Symbol::new(i16::MAX as u16);
    let symbol = |token: &String| match token.parse::<Marker>() {
        Ok(marker) => marker.symbol(),
        Err(_) => language.tokens().find(token).unwrap_or(UNKNOWN),
    };
    description.iter().map(symbol).collect()
}
