//! How a session begins: a command becomes a belief over the tasks that are possible here (paper, Algorithm 1).

use super::agent::{Agent, Position, Prior, Work};
use super::candidates::{CandidateCount, Candidates};
use super::error::AgentError;
use crate::capacity::{CapacityError, LIFTED_TASKS};
use crate::feedback::Belief;
use crate::language::roles::forward::Reading;
use crate::language::{LanguageMut, LanguageRef, Meaning};
use crate::memory::{AgentMemory, AgentTables};
use crate::oomdp::{Domain, Schema, check_actions, digest, vocabulary};
use crate::planning::Progress;
use crate::probability::Scaled;
use crate::symbols::Symbol;
use crate::task::description::{Scene, describe, form_token};
use crate::task::grounded::expect_change;
use crate::task::machine_command::{Tokens, head};
use crate::task::{Expression, GroundedTask, LiftedTask, ground};
use heapless::Vec;

/// What is done for each machine command, with its share: one compiled copy of the loop over them serves all.
type Each<'e> = dyn FnMut(&mut Candidates<'_>, LanguageRef<'_>, &[Option<Symbol>], &[Symbol], f32) -> Result<Scaled, CapacityError> + 'e;

impl<M: AgentMemory> Agent<M> {
    /// Hears a command in the state that the session starts from: the tasks possible here get their prior from the language model,
    /// Pr(t|e,s) proportional to the sum over l of Pr(l|s) Pr(t|s,l) times the sum over c of Pr(c|s,l,t) Pr(e|l,c). A session under way
    /// ends, and what was said in it is not learned from: [`finish`](Self::finish) it before.
    ///
    /// # Errors
    /// [`AgentError`]; no session is then under way (but for [`AgentError::StillLearning`], which changes nothing), and what was learned is
    /// kept.
    pub fn hear<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State, command: &str) -> Result<(), AgentError> {
        self.begin_hearing(domain, state, command)?;
        while self.hear_on(domain, u32::MAX)? == Progress::Working {}
        Ok(())
    }

    /// Begins to hear a command, as [`hear`](Self::hear) does, but in parts: call [`hear_on`](Self::hear_on) until it is done.
    ///
    /// # Errors
    /// As [`hear`](Self::hear).
    pub fn begin_hearing<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State, command: &str) -> Result<(), AgentError> {
        self.open(domain, state, command)?;
        let result = self.begin_to_understand(domain);
        if result.is_err() {
            self.start = None;
        }
        result
    }

    /// Goes on hearing the command, with at most about `budget` table cells of work (at least one machine command). The belief is the same
    /// whatever the budget.
    ///
    /// # Errors
    /// [`AgentError::NoSession`] where no command was begun, [`AgentError::OtherDomain`] where it was begun in another domain, and
    /// [`AgentError::Capacity`]; in the last case no session is under way any more.
    pub fn hear_on<D: Domain + ?Sized>(&mut self, domain: &D, budget: u32) -> Result<Progress, AgentError> {
        if let Work::Hearing(..) = self.work {
            if self.domain != digest(domain) {
                return Err(AgentError::OtherDomain);
            }
            let result = self.understand_on(domain, budget);
            if result.is_err() {
                (self.start, self.work) = (None, Work::None);
            }
            return result;
        }
        self.check_session(domain).map(|()| Progress::Done)
    }

    /// Hears a command whose task prior is given: `prior(task, lifted)` for each task and the lifted task that it grounds, in any unit.
    ///
    /// # Errors
    /// As [`hear`](Self::hear), [`AgentError::Prior`] where a prior is negative or not a number, and [`AgentError::NoPrior`] where all are
    /// 0.
    pub fn hear_with_prior<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        state: &D::State,
        command: &str,
        prior: impl Fn(&GroundedTask, &LiftedTask) -> f32,
    ) -> Result<(), AgentError> {
        // The machine commands' likelihoods are still needed when the session is learned from.
        self.hear(domain, state, command)?;
        let mut any = false;
        for position in 0..self.task_count {
            let task = self.task(position);
            let value = self.lifted.get(usize::from(task.lifted)).map_or(0.0, |lifted| prior(&task, lifted));
            if !(0.0..=f32::MAX).contains(&value) {
                return self.refuse_prior(AgentError::Prior { task: position as u8, value });
            }
            any |= value > 0.0;
            self.belief_mut().set_prior(position, Scaled::new(value));
        }
        if any { Ok(()) } else { self.refuse_prior(AgentError::NoPrior) }
    }

    /// Ends the session that was about to begin: a belief of no tasks is a belief all the same.
    fn refuse_prior(&mut self, error: AgentError) -> Result<(), AgentError> {
        self.start = None;
        self.belief_mut().restart(core::iter::empty(), 0.0)?;
        Err(error)
    }

    /// Hears the same command again in the same initial state: the belief goes on. An ended session, learned from or forgotten, is taken up
    /// again by this.
    ///
    /// # Errors
    /// [`AgentError::NoSession`] where the last session did not start in this state, [`AgentError::StillLearning`] while what it ended
    /// with is being learned, and [`AgentError::StillHearing`] or [`AgentError::StillFinishing`] while it is not that far.
    pub fn hear_again<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State) -> Result<(), AgentError> {
        if self.start != Some(domain.number(state)) || self.domain != digest(domain) || self.tasks().is_empty() {
            return Err(AgentError::NoSession);
        }
        if self.language.is_training() {
            return Err(AgentError::StillLearning);
        }
        if let Err(error @ (AgentError::StillHearing | AgentError::StillFinishing)) = self.check_session(domain) {
            return Err(error);
        }
        self.ended = false;
        self.belief_mut().settle();
        self.forget_plan();
        self.begin_ways();
        Ok(())
    }

    #[inline(never)]
    fn open<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State, command: &str) -> Result<(), AgentError> {
        if self.language.is_training() {
            return Err(AgentError::StillLearning);
        }
        (self.start, self.followed, self.work) = (None, None, Work::None);
        self.ended = false;
        self.forget_plan();
        self.forget_questions();
        self.task_count = 0;
        let tables = self.memory.lend();
        let mut language = self.language.with(tables.language, tables.workspace);
        language.forget_unlearned();
        language.hear_into(command, &mut self.sentence)?;
        if self.sentence.is_empty() {
            return Err(AgentError::EmptyCommand);
        }
        check_actions(domain)?;
        if domain.number(state) >= domain.state_count() {
            return Err(AgentError::StateNumber);
        }
        let vocabulary = vocabulary::digest(&domain.world().schema);
        if self.lifted.iter().any(|lifted| lifted.vocabulary() != vocabulary) {
            return Err(AgentError::OtherVocabulary);
        }
        let count = ground(domain, &self.lifted, state, tables.session.tasks)?;
        if count == 0 {
            return Err(AgentError::NoTask);
        }
        if self.options.language.model.is_roles() {
            expect_change(domain, &self.lifted, state, tables.session.tasks.get_mut(..count).unwrap_or(&mut []));
        }
        self.plan_for(domain, count)?;
        self.task_count = count;
        self.domain = digest(domain);
        self.start = Some(domain.number(state));
        Ok(())
    }

    /// The task at a position.
    pub(super) fn task(&self, position: usize) -> GroundedTask {
        self.tasks().get(position).copied().unwrap_or(GroundedTask::UNUSED)
    }

    /// Begins the belief with each task's Pr(l|s) Pr(t|s,l).
    #[inline(never)]
    fn begin_to_understand<D: Domain + ?Sized>(&mut self, domain: &D) -> Result<(), AgentError> {
        self.candidates = CandidateCount::NONE;
        let AgentTables { language, session, workspace } = self.memory.lend();
        let tasks = session.tasks.get(..self.task_count).unwrap_or(&[]);
        Belief::new(session.belief, &mut self.belief).restart(tasks.iter().map(|task| Scaled::new(task.prior)), self.options.drift)?;
        // The tasks' own tokens come first, and what can be said of objects after them, as far as there is room.
        let mut language = self.language.with(language, workspace);
        intern_own_tokens(&mut language, &domain.world().schema, &self.lifted, tasks)?;
        self.work = Work::Hearing(Position::of_task(0), Prior::Zero);
        Ok(())
    }

    /// Goes on giving each task its Pr(l|s) Pr(t|s,l) times the sum over c of Pr(c|s,l,t) Pr(e|l,c). Fills the candidates.
    fn understand_on<D: Domain + ?Sized>(&mut self, domain: &D, budget: u32) -> Result<Progress, AgentError> {
        let mut left = budget.max(1);
        let mut scene = self.scene(domain);
        while let Work::Hearing(mut position, mut any) = self.work {
            if left == 0 {
                return Ok(Progress::Working);
            }
            if position.task >= self.task_count {
                self.weigh_kinds(domain);
                // A command that nothing explains says nothing.
                if any == Prior::Zero {
                    for position in 0..self.task_count {
                        let prior = Scaled::new(self.task(position).prior);
                        self.belief_mut().set_prior(position, prior);
                    }
                }
                self.work = Work::None;
                self.take_usage();
                break;
            }
            let done = match (self.options.language.model.is_roles(), &mut scene) {
                (true, Some(scene)) => self.read_on(domain, scene, &mut position, &mut left)?,
                (true, None) => true,
                (false, _) => {
                    let task = position.task;
                    self.for_each_constraint(domain, &mut position, &mut left, &mut |candidates, language, sentence, tokens, _| {
                        let found = match candidates.read().find(tokens) {
                            Some(found) => found,
                            None => candidates.add(task, tokens, language.likelihood(sentence, tokens))?,
                        };
                        Ok(candidates.read().entries().get(found).map_or(Scaled::ZERO, |entry| entry.likelihood))
                    })?
                }
            };
            if done {
                let prior = position.sum.scaled_by(self.task(position.task).prior);
                if !prior.is_zero() {
                    any = Prior::Positive;
                }
                self.belief_mut().set_prior(position.task, prior);
                position = Position::of_task(position.task.saturating_add(1));
            }
            self.work = Work::Hearing(position, any);
        }
        Ok(Progress::Done)
    }

    /// Tells for each word of the command what the role model takes it for where this task is meant, the last word first: its position, a
    /// [`Meaning`], and the share of 1 that this meaning has. Nothing for Model 2 and before anything is learned.
    ///
    /// # Errors
    /// [`AgentError::NoSession`], [`AgentError::OtherDomain`], [`AgentError::StillLearning`], and [`AgentError::Capacity`].
    pub fn explain<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        task: usize,
        tell: impl FnMut(usize, Meaning, f32),
    ) -> Result<(), AgentError> {
        if self.domain != digest(domain) {
            return Err(AgentError::OtherDomain);
        }
        if self.language.is_training() {
            return Err(AgentError::StillLearning);
        }
        if let Work::Hearing(..) = self.work {
            return Err(AgentError::StillHearing);
        }
        let start = self.start.ok_or(AgentError::NoSession)?;
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let Some(task) = session.tasks.get(..self.task_count).and_then(|tasks| tasks.get(task)) else { return Ok(()) };
        if language.is_model_2() {
            return Ok(());
        }
        let mut description = Tokens::new();
        let mut scene = Scene::new(domain.numbered(start));
        describe(domain, &self.lifted, task, &mut scene, language.tokens_mut(), &mut description)?;
        Ok(language.explain(&self.sentence, &description, tell)?)
    }

    /// What the descriptions of the session's tasks need to know of the state that it started from.
    pub(super) fn scene<D: Domain + ?Sized>(&self, domain: &D) -> Option<Scene<D::State>> {
        self.start.map(|start| Scene::new(domain.numbered(start)))
    }

    /// The state that the session started from, `None` where none is under way in this domain.
    pub fn started_from<D: Domain + ?Sized>(&self, domain: &D) -> Option<D::State> {
        self.start.filter(|_| self.domain == digest(domain)).map(|number| domain.numbered(number))
    }

    /// Lets the role model's kind of task speak.
    #[inline(never)]
    fn weigh_kinds<D: Domain + ?Sized>(&mut self, domain: &D) {
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        if language.is_model_2() {
            return;
        }
        let mut forms: Vec<Symbol, LIFTED_TASKS> = Vec::new();
        for lifted in &self.lifted {
            // The tokens of this session's tasks are interned already. A kind of task that is not possible here can do without its token.
            let form = form_token(&domain.world().schema, lifted, language.tokens_mut()).unwrap_or(Symbol(0));
            // As many as there are lifted tasks.
            let _ = forms.push(form);
        }
        let tasks = session.tasks.get(..self.task_count).unwrap_or(&[]);
        let form = |task: usize| {
            let lifted = tasks.get(task).map_or(0, |task| usize::from(task.lifted));
            forms.get(lifted).copied().unwrap_or(Symbol(0))
        };
        let prior = |task: usize| tasks.get(task).map_or(0.0, |task| task.prior);
        let mut belief = Belief::new(session.belief, &mut self.belief);
        language.read().weigh_kinds(&self.sentence, form, prior, belief.priors_mut());
    }

    /// Goes on with the machine commands of a task: adds Pr(c|s,l,t), which is the last argument of `each`, times what `each` returns for
    /// the machine command to the position's sum. Returns whether all of the task's are done. For the role model, the task's description
    /// is its only machine command.
    pub(super) fn for_each_candidate<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        scene: &mut Option<Scene<D::State>>,
        position: &mut Position,
        left: &mut u32,
        mut each: impl FnMut(&mut Candidates<'_>, LanguageRef<'_>, &[Option<Symbol>], &[Symbol], f32) -> Result<Scaled, CapacityError>,
    ) -> Result<bool, AgentError> {
        match (self.options.language.model.is_roles(), scene) {
            (true, Some(scene)) => self.with_description(domain, scene, position, left, each).map(|()| true),
            (true, None) => Ok(true),
            (false, _) => self.for_each_constraint(domain, position, left, &mut each),
        }
    }

    /// Goes on with Pr(e|t) of the role model for the task at the position, which keeps how far it is. Returns whether it is done.
    #[inline(never)]
    fn read_on<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        scene: &mut Scene<D::State>,
        position: &mut Position,
        left: &mut u32,
    ) -> Result<bool, AgentError> {
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let Some(task) = session.tasks.get(position.task) else { return Ok(true) };
        let mut candidates = Candidates::new(session.candidates, &mut self.candidates);
        let added = match candidates.read().added_for(position.task) {
            Some(added) => added,
            None => {
                let mut description = Tokens::new();
                describe(domain, &self.lifted, task, scene, language.tokens_mut(), &mut description)?;
                *left = left.saturating_sub(description.len() as u32);
                if let Some(entry) = candidates.read().find(&description).and_then(|found| candidates.read().entries().get(found)) {
                    position.sum = entry.likelihood;
                    return Ok(true);
                }
                let added = candidates.add(position.task, &description, Scaled::ZERO)?;
                if *left == 0 {
                    return Ok(false);
                }
                added
            }
        };
        let mut reading = match position.constraint {
            0 => Reading::START,
            words => Reading { words, probability: position.sum },
        };
        let read = candidates.read();
        let description = read.entries().get(added).map_or(&[][..], |entry| read.tokens(entry));
        let done = language.likelihood_on(&self.sentence, description, &mut reading, left);
        (position.constraint, position.sum) = (reading.words, reading.probability);
        if let Some(entry) = candidates.entry_mut(added).filter(|_| done) {
            entry.likelihood = reading.probability;
        }
        Ok(done)
    }

    #[inline(never)]
    fn with_description<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        scene: &mut Scene<D::State>,
        position: &mut Position,
        left: &mut u32,
        mut each: impl FnMut(&mut Candidates<'_>, LanguageRef<'_>, &[Option<Symbol>], &[Symbol], f32) -> Result<Scaled, CapacityError>,
    ) -> Result<(), AgentError> {
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let Some(task) = session.tasks.get(position.task) else { return Ok(()) };
        let mut candidates = Candidates::new(session.candidates, &mut self.candidates);
        let mut description = Tokens::new();
        let read = candidates.read();
        match read.added_for(position.task).and_then(|added| read.entries().get(added)) {
            Some(entry) => {
                let _ = description.extend_from_slice(read.tokens(entry));
            }
            None => describe(domain, &self.lifted, task, scene, language.tokens_mut(), &mut description)?,
        }
        let value = each(&mut candidates, language.read(), &self.sentence, &description, 1.0)?;
        position.sum = position.sum.plus(value);
        let cells = description.len().saturating_mul(self.sentence.len().max(1)).saturating_mul(4);
        *left = left.saturating_sub(cells as u32);
        Ok(())
    }

    #[inline(never)]
    fn for_each_constraint<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        position: &mut Position,
        left: &mut u32,
        each: &mut Each<'_>,
    ) -> Result<bool, AgentError> {
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let Some(task) = session.tasks.get(position.task) else { return Ok(true) };
        let Some(lifted) = self.lifted.get(usize::from(task.lifted)) else { return Ok(true) };
        let order = language.read().settings().order;
        // Left where it was made, and the tokens too: taken out of their results, they would stand on the stack twice.
        let expression = Expression::new(domain, lifted, task, order, language.tokens_mut());
        let expression = expression.as_ref().map_err(|error| *error)?;
        let mut candidates = Candidates::new(session.candidates, &mut self.candidates);
        let mut tokens = Tokens::new();
        let share = 1.0 / f32::from(expression.constraints());
        while position.constraint < expression.constraints() && *left > 0 {
            expression.write_machine_command(position.constraint, &mut tokens)?;
            let value = each(&mut candidates, language.read(), &self.sentence, &tokens, share)?;
            position.sum = position.sum.plus(value.scaled_by(share));
            position.constraint = position.constraint.saturating_add(1);
            let cells = tokens.len().saturating_add(1).saturating_mul(self.sentence.len().max(1));
            *left = left.saturating_sub(cells as u32);
        }
        Ok(position.constraint >= expression.constraints())
    }
}

/// Interns the tokens of the lifted tasks that `tasks` ground: those of a machine command's propositions and classes, or of a description.
#[inline(never)]
fn intern_own_tokens(
    language: &mut LanguageMut<'_>,
    schema: &Schema<'_>,
    lifted: &[LiftedTask],
    tasks: &[GroundedTask],
) -> Result<(), CapacityError> {
    let is_model_2 = language.is_model_2();
    for (position, lifted) in lifted.iter().enumerate() {
        if tasks.iter().any(|task| usize::from(task.lifted) == position) {
            match is_model_2 {
                true => head(schema, lifted, language.tokens_mut()).map(drop)?,
                false => form_token(schema, lifted, language.tokens_mut()).map(drop)?,
            }
        }
    }
    Ok(())
}
