//! Checks a recorded session against its home or world, and walks through its steps before it is used as evidence.

use crate::closed_words::{CLOSED_WORDS, kept_table};
use crate::fault::{Fault, quoted};
use crate::first_words::{Long, read, too_long, words_read};
use crate::home;
use crate::listening::Conversing;
use crate::name::task_name;
use crate::walk::{Expected, Listening, SessionAnswer, Step, Walk};
use goodbot::capacity::{CapacityError, PROPOSITIONS_PER_TASK};
use goodbot::feedback::Feedback;
use goodbot::home::{Home, Moves};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::Domain;
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, ground, ground_with_done};
use goodbot::{AgentError, Capacities};
use goodbot_formats::session::{FeedbackWord, Kind, RecordedAnswer, RecordedSession, StepRecord, StrategyRecord};
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText};
use std::fmt;

/// A session that can be replayed.
pub struct CheckedSession<D: Domain> {
    /// Its command, steps and answers.
    pub walk: Walk<D>,
    /// The tasks that are possible here, with their names.
    pub tasks: Vec<(GroundedTask, GroundTaskText)>,
    /// The position of the intended task, if the record names one of the tasks.
    pub intended: Option<usize>,
    /// The command's length, if only its first words are read.
    pub long: Option<Long>,
}

impl<D: Domain<State: fmt::Debug> + fmt::Debug> fmt::Debug for CheckedSession<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { walk, tasks, intended, .. } = self;
        f.debug_struct("CheckedSession").field("walk", walk).field("tasks", tasks).field("intended", intended).finish_non_exhaustive()
    }
}

/// The moves of a home with these actions.
pub fn moves<'a>(names: impl Iterator<Item = &'a str>) -> Option<Moves> {
    let mut names: Vec<&str> = names.filter(|&name| name != "noop").collect();
    names.sort_unstable();
    match names.as_slice() {
        ["east", "north", "south", "west"] => Some(Moves::Push),
        ["east", "north", "pull", "south", "west"] => Some(Moves::PushAndPull),
        _ => None,
    }
}

/// Collects the faults of one session.
pub(crate) struct Checker<'a> {
    file: &'a str,
    recorded: &'a RecordedSession,
    /// The header's field for the place, and the things to leave out if it has too many tasks.
    place: (&'static str, &'static str),
    faults: Vec<Fault>,
}

impl<'a> Checker<'a> {
    pub(crate) const fn new(file: &'a str, recorded: &'a RecordedSession, place: (&'static str, &'static str)) -> Self {
        Self { file, recorded, place, faults: Vec::new() }
    }

    pub(crate) fn fault(&mut self, field: impl Into<String>, message: impl std::fmt::Display) {
        self.faults.push(Fault::on_line(self.file, self.recorded.header_line, message).in_field(field));
    }
}

/// Checks a session and walks through it. `lifted` are the kinds of task that commands may mean.
///
/// # Errors
/// All faults of the session.
pub fn check<M: HomeMemory>(
    file: &str,
    recorded: &RecordedSession,
    lifted: &[LiftedTask],
    memory: M,
) -> Result<CheckedSession<Home<M>>, Vec<Fault>> {
    let mut checker = Checker::new(file, recorded, ("environment", "rooms or blocks"));
    let header = &recorded.header;
    let moves = moves(header.action_names());
    if moves.is_none() {
        let message = "a home has the actions north, south, east and west, and may have pull; name these four or five";
        checker.fault("actions", message);
    }
    checker.command();
    let flaws = home::flaws(&header.environment);
    for flaw in &flaws {
        checker.fault(format!("environment.{}", flaw.field()), flaw.message(&header.environment));
    }
    let built = match moves {
        Some(moves) if flaws.is_empty() => home::build(&header.environment, moves, memory).map_err(|flaw| {
            checker.fault("environment", flaw.message(&header.environment));
        }),
        _ => Err(()),
    };
    let Ok((home, start)) = built else { return Err(checker.faults) };
    checker.session(home, start, lifted, |home, state, record| {
        let cell = home.agent_cell(state);
        impossible(record, cell.x, cell.y)
    })
}

/// As [`check`], for a session that is replayed. A labelled session is refused, because it has no steps.
///
/// # Errors
/// All faults of the session.
pub fn check_steps<M: HomeMemory>(
    file: &str,
    recorded: &RecordedSession,
    lifted: &[LiftedTask],
    memory: M,
) -> Result<CheckedSession<Home<M>>, Vec<Fault>> {
    has_steps(file, recorded)?;
    check(file, recorded, lifted, memory)
}

/// Refuses a session without steps to replay.
pub(crate) fn has_steps(file: &str, recorded: &RecordedSession) -> Result<(), Vec<Fault>> {
    if recorded.header.kind == Kind::Labelled {
        let message = "a labelled session has no steps to go through; learn from it with goodbot learn";
        return Err(vec![Fault::on_line(file, recorded.header_line, message).in_field("kind")]);
    }
    Ok(())
}

impl Checker<'_> {
    /// Walks through a session in its home or world. `impossible` words the reason why a step cannot be taken in a state.
    pub(crate) fn session<D: Domain>(
        mut self,
        home: D,
        start: D::State,
        lifted: &[LiftedTask],
        impossible: impl Fn(&D, &D::State, &StepRecord) -> String,
    ) -> Result<CheckedSession<D>, Vec<Fault>> {
        let header = &self.recorded.header;
        self.intended(&home);
        let tasks = self.tasks(&home, &start, lifted);
        self.intended_task(&home, &start, &tasks, lifted.iter().any(LiftedTask::has_way));
        let meant = header.meant().and_then(Result::ok);
        let walk = Walk {
            command: words_read(&header.command).to_owned(),
            listening: self.listening(&home, &start, lifted),
            closed: self.closed_words(),
            kind: header.kind,
            continues: header.continues,
            header_line: self.recorded.header_line,
            end_line: self.recorded.end_line,
            prior: header.prior.as_ref().map(|prior| self.prior(prior, &tasks)),
            strategies: header.strategies.as_ref().map(|strategies| self.strategies(strategies)),
            steps: self.walk(&home, &start, impossible),
            answers: self.answers(&tasks),
            home,
            start,
        };
        if !self.faults.is_empty() {
            return Err(self.faults);
        }
        let intended = meant.and_then(|meant| tasks.iter().position(|(_, name)| name.is_same(&meant)));
        Ok(CheckedSession { walk, tasks, intended, long: read(&header.command).ok().and_then(|read| read.long()) })
    }

    /// The faults found so far.
    pub(crate) fn into_faults(self) -> Vec<Fault> {
        self.faults
    }

    pub(crate) fn command(&mut self) {
        let header = &self.recorded.header;
        let said = header.utterance.iter().map(|utterance| ("utterance", utterance));
        for (field, text) in std::iter::once(("command", &header.command)).chain(said) {
            match read(text) {
                Err(error) => self.fault(field, too_long(error)),
                Ok(read) if read.count == 0 => self.fault(field, AgentError::EmptyCommand),
                Ok(_) => {}
            }
        }
    }

    /// The utterance and its conversation, if the robot listened when the session began.
    fn listening<D: Domain>(&mut self, home: &D, start: &D::State, lifted: &[LiftedTask]) -> Option<Listening> {
        let header = &self.recorded.header;
        let utterance = header.utterance.clone()?;
        let after = header.after.as_ref().and_then(|after| {
            let named = self.tasks(home, start, lifted);
            let same = named.iter().find(|(_, task)| task.is_same(after) || task.is_same(&after.opposite()));
            if same.is_none() {
                self.fault("after", "is no task of the kinds that commands may mean; correct it, or leave it out");
            }
            same.map(|(task, _)| task.lifted)
        });
        let conversation = self.conversation(home, start, lifted);
        Some(Listening { utterance, after, conversation })
    }

    /// The table of closed words.
    fn closed_words(&mut self) -> goodbot::talk::ClosedWords<'static> {
        let table = self.recorded.header.closed_words.as_deref().map(kept_table);
        match table {
            None => CLOSED_WORDS,
            Some(Ok(table)) => table,
            Some(Err(error)) => {
                self.fault("closed_words", error);
                CLOSED_WORDS
            }
        }
    }

    /// The conversation that the session belongs to.
    fn conversation<D: Domain>(&mut self, home: &D, start: &D::State, lifted: &[LiftedTask]) -> Conversing {
        let Some(record) = &self.recorded.header.conversation else { return Conversing::default() };
        let named = self.tasks(home, start, lifted);
        let task = |text: &str| {
            let text: GroundTaskText = text.parse().ok()?;
            let same = named.iter().find(|(_, task)| task.is_same(&text)).map(|(task, _)| *task);
            let opposite = || {
                let (task, _) = named.iter().find(|(_, task)| task.is_same(&text.opposite()))?;
                task.negated(lifted.get(usize::from(task.lifted))?)
            };
            same.or_else(opposite)
        };
        Conversing::read(home, record, task).unwrap_or_else(|(field, message)| {
            self.fault(format!("conversation.{field}"), message);
            Conversing::default()
        })
    }

    fn intended(&mut self, home: &impl Domain) {
        let header = &self.recorded.header;
        let list = |name: &str, atoms: &[GroundAtomText]| -> Vec<(String, GroundAtomText)> {
            atoms.iter().enumerate().map(|(position, atom)| (format!("{name}[{position}]"), atom.clone())).collect()
        };
        let lists = |name: &str, lists: &[Vec<GroundAtomText>]| -> Vec<(String, GroundAtomText)> {
            lists.iter().enumerate().flat_map(|(position, atoms)| list(&format!("{name}[{position}]"), atoms)).collect()
        };
        let mut atoms = list("intended", header.intended.as_deref().unwrap_or_default());
        atoms.extend(lists("before", header.before.as_deref().unwrap_or_default()));
        atoms.extend(lists("through", header.through.as_deref().unwrap_or_default()));
        atoms.extend(list("avoiding", header.avoiding.as_deref().unwrap_or_default()));
        for (field, atom) in atoms {
            if let Err(message) = known_atom(home, &atom) {
                self.fault(field, message);
            }
        }
    }

    /// Checks that the intended task is a task here.
    fn intended_task<D: Domain>(&mut self, home: &D, start: &D::State, tasks: &[(GroundedTask, GroundTaskText)], considers_ways: bool) {
        // The reader refused a record that is no task.
        let Some(Ok(meant)) = self.recorded.header.meant() else { return };
        let way = meant.way();
        let holds = |atoms: &[GroundAtomText]| {
            let known: Result<Vec<_>, _> = atoms.iter().map(|atom| known_atom(home, atom)).collect();
            known.map(|known| known.iter().map(|atom| home.holds(atom, start)).collect::<Vec<bool>>())
        };
        let all = [&[meant.atoms().to_vec()], way.before.as_slice(), way.through.as_slice(), std::slice::from_ref(&way.avoiding)].concat();
        if all.iter().any(|atoms| holds(atoms).is_err()) {
            return;
        }
        let propositions: usize = all.iter().map(Vec::len).sum();
        if propositions > PROPOSITIONS_PER_TASK {
            let message =
                format!("has {propositions} propositions with its way, and {PROPOSITIONS_PER_TASK} are the most; leave out clauses");
            self.fault("intended", message);
            return;
        }
        let each = |atoms: &[GroundAtomText]| holds(atoms).is_ok_and(|holds| holds.iter().all(|&holds| holds));
        let any = |atoms: &[GroundAtomText]| holds(atoms).is_ok_and(|holds| holds.contains(&true));
        let here = "where the session begins already";
        if each(meant.atoms()) && way.before.is_empty() && way.through.is_empty() {
            self.fault("intended", format!("holds {here}, so there is nothing to do; correct it or the environment"));
        } else if let Some(position) = way.through.iter().position(|clause| any(clause)) {
            self.fault(format!("through[{position}]"), format!("holds {here}, so it says nothing; leave it out"));
        } else if way.before.first().is_some_and(|before| each(before)) {
            self.fault("before[0]", format!("holds {here}, so it says nothing; leave it out"));
        } else if any(&way.avoiding) {
            self.fault("avoiding", format!("holds {here}, so the task is impossible; correct it or the environment"));
        } else if !tasks.is_empty() && (way.is_empty() || considers_ways) && !tasks.iter().any(|(_, name)| name.is_same(&meant)) {
            // Where no ways are considered, an intended task with a way is not checked against the tasks.
            self.fault("intended", "is no task of the kinds that commands may mean; name its kind with --task, or correct it");
        }
    }

    fn tasks<D: Domain>(&mut self, home: &D, start: &D::State, lifted: &[LiftedTask]) -> Vec<(GroundedTask, GroundTaskText)> {
        let mut tasks = vec![GroundedTask::UNUSED; Capacities::STANDARD.tasks];
        let (field, things) = self.place;
        let grounded = match self.recorded.header.utterance {
            // A robot that listens also considers tasks that are done already.
            Some(_) => ground_with_done(home, lifted, start, &mut tasks, f32::MIN_POSITIVE),
            None => ground(home, lifted, start, &mut tasks),
        };
        let count = match grounded {
            Ok(0) => {
                self.fault(field, AgentError::NoTask);
                0
            }
            Ok(count) => count,
            Err(CapacityError { limit, .. }) => {
                self.fault(field, format!("gives more than {limit} tasks; leave out {things}"));
                0
            }
        };
        let mut named = Vec::new();
        for task in tasks.into_iter().take(count) {
            let Some(lifted) = lifted.get(usize::from(task.lifted)) else { continue };
            match task_name(home, lifted, &task) {
                Ok(name) => named.push((task, name)),
                Err(error) => self.fault(field, error),
            }
        }
        named
    }

    fn prior(&mut self, prior: &[(GroundTaskText, f64)], tasks: &[(GroundedTask, GroundTaskText)]) -> Vec<(GroundedTask, f32)> {
        let mut values = Vec::new();
        let largest = prior.iter().map(|&(_, value)| value).fold(0.0, f64::max);
        for (name, value) in prior {
            match tasks.iter().find(|(_, task)| task.is_same(name)) {
                // As shares of the largest, so that single precision never makes all of them 0.
                Some(&(task, _)) => values.push((task, (value / largest) as f32)),
                None if tasks.is_empty() => {}
                None => {
                    let message = "is no task here: it holds at the beginning already, names an object that is not here, or is of a kind \
                                   not asked for; remove it, or name its kind with --task";
                    self.fault(format!("prior.{name}"), message);
                }
            }
        }
        values
    }

    fn strategies(&mut self, records: &[StrategyRecord]) -> Vec<Expected> {
        let most = Capacities::STANDARD.strategies;
        if records.len() > most {
            self.fault("strategies", format!("are {}, and {most} are the most; leave out the least probable", records.len()));
        }
        let largest = records.iter().map(|record| record.prior).fold(0.0, f64::max);
        let mut strategies = Vec::new();
        for (position, record) in records.iter().enumerate() {
            match Expected::new(record, largest) {
                Ok(expected) => strategies.push(expected),
                Err(error) => self.fault(format!("strategies[{position}]"), error),
            }
        }
        strategies
    }

    fn answers(&mut self, tasks: &[(GroundedTask, GroundTaskText)]) -> Vec<SessionAnswer> {
        let mut answers = vec![];
        for RecordedAnswer { line, after, answer } in &self.recorded.answers {
            let mut named = TaskSet::EMPTY;
            for name in &answer.tasks {
                // A session of prohibitions has negated tasks at the positions of the plain ones.
                let position = tasks.iter().position(|(_, task)| task.is_same(name) || task.is_same(&name.opposite()));
                match position {
                    Some(position) => named = named.with(position),
                    None => {
                        let message = format!(
                            "{} is no task here: it holds at the beginning already, names an object that is not here, or is of a kind not \
                             asked for; remove the answer, or name its kind with --task",
                            quoted(&name.to_string())
                        );
                        self.faults.push(Fault::on_line(self.file, *line, message).in_field("tasks"));
                    }
                }
            }
            let (yes, eta, others) = (answer.yes, answer.eta as f32, answer.others);
            answers.push(SessionAnswer {
                line: *line,
                after: *after,
                tasks: named,
                yes,
                eta,
                others,
                words: answer.words.as_deref().map(|words| words_read(words).to_owned()),
            });
        }
        answers
    }

    fn walk<D: Domain>(
        &mut self,
        home: &D,
        start: &D::State,
        impossible: impl Fn(&D, &D::State, &StepRecord) -> String,
    ) -> Vec<Step<D::State>> {
        let mut state = *start;
        let mut steps = Vec::new();
        for (line, record) in &self.recorded.steps {
            let feedback = match record.feedback {
                Some(FeedbackWord::Reward) => Feedback::Reward,
                Some(FeedbackWord::Punish) => Feedback::Punish,
                Some(FeedbackWord::Neutral) | None => Feedback::Neutral,
            };
            let Some((step, next)) = Step::from(home, state, &record.action, feedback, *line) else {
                let message = impossible(home, &state, record);
                self.faults.push(Fault::on_line(self.file, *line, message).in_field("action"));
                break;
            };
            steps.push(step);
            state = next;
        }
        steps
    }
}

fn impossible(record: &StepRecord, x: i32, y: i32) -> String {
    let action = quoted(&record.action);
    format!(
        "{action} cannot be done here, where the agent is at {x}, {y}: no block beside it has a wall or another block on its far side; correct the \
         steps, or leave out the session"
    )
}

/// The proposition that a text names, if its function and objects are in this home; otherwise the fault.
pub fn known_atom(home: &impl Domain, atom: &GroundAtomText) -> Result<goodbot::oomdp::GroundProposition, String> {
    if atom.is_negated() {
        return Err(format!("{atom} is a prohibition, and no session is about one; name a goal"));
    }
    let schema = home.world().schema;
    let Some(proposition) = schema.proposition(atom.function()) else {
        let known: Vec<&str> = schema.propositions.iter().map(|known| known.name).collect();
        return Err(format!("{} is no propositional function; known are {}", quoted(atom.function()), known.join(", ")));
    };
    let parameters = schema.parameters(proposition);
    if parameters.len() != atom.arguments().len() {
        let (given, wanted) = (atom.arguments().len(), parameters.len());
        return Err(format!("{} takes {wanted} objects, and {given} are given; name {wanted}", atom.function()));
    }
    let mut arguments = goodbot::oomdp::GroundProposition { proposition, arguments: Default::default() };
    for ((name, &class), slot) in atom.arguments().iter().zip(parameters).zip(&mut arguments.arguments) {
        let class_name = schema.class_name(class);
        let objects = home.world().objects;
        match objects.find(name) {
            None => return Err(format!("there is no object {}; name a {class_name} of the environment", quoted(name))),
            Some(id) if objects.get(id).is_some_and(|object| object.class != class) => {
                return Err(format!("{} is no {class_name}; name a {class_name} of the environment", quoted(name)));
            }
            Some(id) => *slot = id,
        }
    }
    Ok(arguments)
}
