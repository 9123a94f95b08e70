//! The beginning of a session: a command becomes a belief over the tasks that are possible here (paper, Algorithm 1).

use super::agent::Agent;
use super::candidates::CandidateCount;
use super::error::AgentError;
use super::phase::{Phase, Position, Prior, Progressed};
use crate::feedback::Belief;
use crate::language::Model;
use crate::language::hearing::Heard;
use crate::language::tokenizer::may_have_pieces;
use crate::memory::AgentMemory;
use crate::oomdp::{Domain, check_actions, digest, vocabulary};
use crate::planning::Progress;
use crate::probability::Scaled;
use crate::task::description::Scene;
use crate::task::grounded::ground_with_done;
use crate::task::{GroundedTask, LiftedTask};

/// Copies bytes to room of the same length, eight at a time: a long command takes a controller a quarter of a call, byte by byte.
fn copy_by_eights(to: &mut [u8], from: &[u8]) {
    let ((to, last_to), (from, last_from)) = (to.as_chunks_mut::<8>(), from.as_chunks::<8>());
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
    last_to.iter_mut().zip(last_from).for_each(|(to, from)| *to = *from);
}

impl<M: AgentMemory> Agent<M> {
    /// Hears a command in the start state of a session: the tasks possible here get their prior from the language model, Pr(t|e,s)
    /// proportional to the sum over l of Pr(l|s) Pr(t|s,l) times the sum over c of Pr(c|s,l,t) Pr(e|l,c). A session under way ends
    /// unlearned: [`finish`](Self::finish) it first to learn from it.
    ///
    /// # Errors
    /// [`AgentError`]; no session is then under way (except for [`AgentError::NotNow`], which changes nothing), and all that was learned is
    /// kept.
    pub fn hear<D: Domain>(&mut self, domain: &D, state: &D::State, command: &str) -> Result<(), AgentError> {
        self.begin_hearing(domain, state, command)?;
        while self.hear_on(domain, u32::MAX)? == Progress::Working {}
        Ok(())
    }

    /// Begins to hear a command in parts, otherwise as [`hear`](Self::hear) does: call [`hear_on`](Self::hear_on) until it is done.
    ///
    /// The command is copied to where plans are made. One with more bytes than fit there is heard here at once. The first part begins the
    /// belief, and then the tasks are known.
    ///
    /// # Errors
    /// As [`hear`](Self::hear), but [`hear_on`](Self::hear_on) tells a command or a word that is too long, and a long command without a word.
    pub fn begin_hearing<D: Domain>(&mut self, domain: &D, state: &D::State, command: &str) -> Result<(), AgentError> {
        if self.open(domain, state, command, self.options.done, true)? {
            self.progressed = Progressed::Begun(core::mem::take(&mut self.task_count) as u8, command.len() as u32);
            return Ok(());
        }
        self.begin_to_understand()
    }

    /// Continues to hear the command, with at most about `budget` table cells of work (at least one machine command). The belief does not
    /// depend on the budget. A known word that a new word is compared with counts as a cell; at least 32 of them are compared.
    ///
    /// # Errors
    /// [`AgentError::NotNow`] if no command was begun, [`AgentError::OtherDomain`] if it was begun in another domain,
    /// [`AgentError::EmptyCommand`] and [`AgentError::Capacity`]; in the last two cases the session ends.
    pub fn hear_on<D: Domain>(&mut self, domain: &D, budget: u32) -> Result<Progress, AgentError> {
        if let Progressed::Begun(..) | Progressed::Words(..) | Progressed::Opened | Progressed::Hearing(..) = self.progressed {
            if self.domain != digest(domain) {
                return Err(AgentError::OtherDomain);
            }
            let mut left = budget.max(1);
            // One after the other, because all together take more stack.
            let result = match self.begin_words(&mut left).and_then(|()| self.hear_words_on(&mut left)) {
                Ok(true) if left > 0 => self.understand_on(domain, left),
                Ok(_) => Ok(Progress::Working),
                Err(error) => Err(error),
            };
            if result.is_err() {
                (self.start, self.progressed) = (None, Progressed::Idle);
            }
            return result;
        }
        self.check_session(domain).map(|()| Progress::Done)
    }

    /// Hears a command with a given task prior: `prior(task, lifted)` for each task and the lifted task that it grounds, in any unit.
    ///
    /// # Errors
    /// As [`hear`](Self::hear), [`AgentError::Prior`] if a prior is negative or not a number, and [`AgentError::NoPrior`] if all are 0.
    pub fn hear_with_prior<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        command: &str,
        prior: impl Fn(&GroundedTask, &LiftedTask) -> f32,
    ) -> Result<(), AgentError> {
        // Learning from the session still needs the machine commands' likelihoods.
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

    /// Ends the session that was about to begin. A belief without tasks always fits, so this restart cannot fail.
    fn refuse_prior(&mut self, error: AgentError) -> Result<(), AgentError> {
        (self.start, self.progressed) = (None, Progressed::Idle);
        self.belief_mut().restart(core::iter::empty(), 0.0)?;
        Err(error)
    }

    /// Hears the same command again in the same initial state: the belief is kept. An ended session, learned or forgotten, is resumed.
    ///
    /// # Errors
    /// [`AgentError::NotNow`]: with [`Phase::Idle`] if the last session did not start in this state, and with the current phase while a
    /// command is being heard, or a session finished or learned from.
    pub fn hear_again<D: Domain>(&mut self, domain: &D, state: &D::State) -> Result<(), AgentError> {
        if self.start != Some(domain.key(state)) || self.domain != digest(domain) || self.tasks().is_empty() {
            return Err(AgentError::NotNow(Phase::Idle));
        }
        if let phase @ (Phase::Learning | Phase::Hearing | Phase::Finishing | Phase::Restoring) = self.phase() {
            return Err(AgentError::NotNow(phase));
        }
        self.progressed = Progressed::Ready;
        self.belief_mut().settle();
        self.forget_plan();
        self.begin_ways();
        Ok(())
    }

    /// Opens a session. Returns whether the command is kept at the front of the workspace, to be heard in parts; otherwise it is heard. Only
    /// where `in_parts` is set it is kept, and if it fits there.
    #[inline(never)]
    pub(crate) fn open<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        command: &str,
        done: f32,
        in_parts: bool,
    ) -> Result<bool, AgentError> {
        let phase = self.phase();
        if matches!(self.progressed, Progressed::Tidying(_)) || matches!(phase, Phase::Learning | Phase::Restoring) {
            return Err(AgentError::NotNow(phase));
        }
        (self.start, self.followed, self.progressed) = (None, None, Progressed::Idle);
        self.forget_plan();
        self.forget_questions();
        self.task_count = 0;
        let tables = self.memory.lend();
        // Words need none of the counts.
        let mut language = self.language.called_with(tables.language, &mut []);
        language.forget_unlearned();
        language.training.forget_explained();
        let in_parts = in_parts && language.model() == Model::Roles;
        let kept = bytemuck::cast_slice_mut(tables.workspace).get_mut(..command.len()).filter(|_| in_parts);
        let is_kept = kept.is_some();
        self.sentence.clear();
        match kept {
            Some(kept) => {
                copy_by_eights(kept, command.as_bytes());
                // The last plan left its marks there.
                self.planner.release_marks();
            }
            None => language.hear_into(command, &mut self.sentence)?,
        }
        if if is_kept { !may_have_pieces(command) } else { self.sentence.is_empty() } {
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
        let count = ground_with_done(domain, &self.lifted, state, tables.session.tasks, done)?;
        if count == 0 {
            return Err(AgentError::NoTask);
        }
        self.expect_change(domain, state, count);
        self.task_count = count;
        self.domain = digest(domain);
        self.start = Some(domain.key(state));
        Ok(is_kept)
    }

    /// Begins the belief, if a command is kept at the front of the workspace and its words are not begun.
    fn begin_words(&mut self, left: &mut u32) -> Result<(), AgentError> {
        if let Progressed::Begun(tasks, bytes) = self.progressed {
            self.task_count = tasks.into();
            self.begin_to_understand()?;
            self.progressed = Progressed::Words(Heard::START, bytes);
            *left = left.saturating_sub(self.task_count as u32);
        }
        Ok(())
    }

    /// Hears on the words of a command, if it is kept at the front of the workspace. Returns whether all are heard.
    #[inline(never)]
    fn hear_words_on(&mut self, left: &mut u32) -> Result<bool, AgentError> {
        let Progressed::Words(mut heard, bytes) = self.progressed else { return Ok(true) };
        let tables = self.memory.lend();
        let kept: &[u8] = bytemuck::cast_slice(tables.workspace);
        let command = core::str::from_utf8(kept.get(..bytes as usize).unwrap_or(&[])).unwrap_or("");
        // Words need none of the counts.
        let mut language = self.language.called_with(tables.language, &mut []);
        let is_heard = language.hear_on(command, &mut heard, &mut self.sentence, left)?;
        if is_heard && self.sentence.is_empty() {
            return Err(AgentError::EmptyCommand);
        }
        self.progressed = if is_heard { Progressed::Opened } else { Progressed::Words(heard, bytes) };
        Ok(is_heard)
    }

    /// Hears the words of a command that is kept in the workspace, which other work needs now. A session whose command is too long ends.
    pub(crate) fn hear_words_to_the_end(&mut self) {
        if self.begin_words(&mut { u32::MAX }).and_then(|()| self.hear_words_on(&mut { u32::MAX })).is_err() {
            (self.start, self.progressed) = (None, Progressed::Idle);
        }
    }

    /// The task at a position.
    pub(crate) fn task(&self, position: usize) -> GroundedTask {
        self.tasks().get(position).copied().unwrap_or(GroundedTask::UNUSED)
    }

    /// Begins the belief with each task's prior Pr(l|s) Pr(t|s,l).
    #[inline(never)]
    pub(crate) fn begin_to_understand(&mut self) -> Result<(), AgentError> {
        self.candidates = CandidateCount::NONE;
        let session = self.memory.lend().session;
        let tasks = session.tasks.get(..self.task_count).unwrap_or(&[]);
        let restarted =
            Belief::new(session.belief, &mut self.belief).restart(tasks.iter().map(|task| Scaled::new(task.prior)), self.options.drift);
        if restarted.is_err() {
            self.start = None;
        }
        self.progressed = if restarted.is_err() { Progressed::Idle } else { Progressed::Opened };
        Ok(restarted?)
    }

    /// Prepares planning for the tasks, and understanding of the command.
    #[inline(never)]
    pub(crate) fn take_up<D: Domain>(&mut self, domain: &D) -> Result<(), AgentError> {
        self.plan_for(domain, self.task_count)?;
        // The tasks' own tokens are interned first, then those of the objects' facts, as far as there is room.
        self.intern_own_tokens(domain)?;
        self.progressed = Progressed::Hearing(Position::of_task(0), Prior::Zero);
        Ok(())
    }

    /// Continues to set each task's prior to Pr(l|s) Pr(t|s,l) times the sum over c of Pr(c|s,l,t) Pr(e|l,c). Fills the candidates.
    #[inline(never)]
    fn understand_on<D: Domain>(&mut self, domain: &D, mut left: u32) -> Result<Progress, AgentError> {
        if matches!(self.progressed, Progressed::Opened) {
            self.take_up(domain)?;
            left = left.saturating_sub(self.task_count as u32);
        }
        let mut scene = self.scene(domain);
        while let Progressed::Hearing(mut position, mut any) = self.progressed {
            if left == 0 {
                return Ok(Progress::Working);
            }
            if position.task >= self.task_count {
                self.weigh_kinds(domain);
                #[cfg(feature = "layer")]
                self.weigh_parts();
                // A command that no task explains is no evidence.
                if any == Prior::Zero {
                    for position in 0..self.task_count {
                        let prior = Scaled::new(self.task(position).prior);
                        self.belief_mut().set_prior(position, prior);
                    }
                }
                self.progressed = Progressed::Ready;
                self.take_usage();
                break;
            }
            let done = self.read_candidates(domain, &mut scene, &mut position, &mut left)?;
            if done {
                let prior = position.sum.scaled_by(self.task(position.task).prior);
                if !prior.is_zero() {
                    any = Prior::Positive;
                }
                self.belief_mut().set_prior(position.task, prior);
                position = Position::of_task(position.task.saturating_add(1));
            }
            self.progressed = Progressed::Hearing(position, any);
        }
        Ok(Progress::Done)
    }

    /// The facts of the session's start state that its tasks' descriptions need. Not inlined, because its stack would stay below the
    /// reading of the words.
    #[inline(never)]
    pub(crate) fn scene<D: Domain>(&self, domain: &D) -> Option<Scene<D::State>> {
        let scene = self.start.map(|start| Scene::new(domain.keyed(start)));
        #[cfg(all(feature = "ways", feature = "talk"))]
        let scene = scene.map(|scene| scene.of_conversation(self.conversation.here(domain)));
        scene
    }

    /// The start state of the session, `None` if none is under way in this domain.
    pub fn started_from<D: Domain>(&self, domain: &D) -> Option<D::State> {
        self.start.filter(|_| self.domain == digest(domain)).map(|key| domain.keyed(key))
    }
}
