//! A simulated trainer, who knows the intended task, judges each action, and ends the lesson.

use crate::agent::Agent;
use crate::error::{self, value};
use crate::log::{Session, header, header_in_world};
use crate::mind::{Mind, Part};
use crate::options::{Drawn, Random};
use crate::place::{Place, in_place_and_on};
use goodbot::feedback::Strategy;
use goodbot::oomdp::Domain;
use goodbot::task::TaskSet;
use goodbot_course::{CourseTrainer, Ending, FeedbackCounts, Lesson as Course, LessonReport, Step, Trainer as _, Turn};
use goodbot_formats::session::{RecordedSession, SessionHeader, StepRecord};
use goodbot_formats::task_text::GroundTaskText;
use goodbot_lesson::place::word;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Mutex, PoisonError};

/// A trainer by its name, or by mu+, mu- and epsilon.
pub fn trainer_of(kind: &Bound<'_, PyAny>) -> PyResult<CourseTrainer> {
    if let Ok(name) = kind.extract::<&str>() {
        let found = CourseTrainer::NAMED.into_iter().find(|(known, _)| *known == name);
        return found.map(|(_, trainer)| trainer).ok_or_else(|| {
            value(format!(
                "no trainer is called {name:?}; give balanced, punish-only, reward-only, or three numbers such as (0.7, 0.7, 0.1)"
            ))
        });
    }
    let (mu_plus, mu_minus, epsilon) = kind.extract()?;
    Ok(CourseTrainer::of(Strategy::new(mu_plus, mu_minus, epsilon).map_err(value)?))
}

/// A simulated trainer (the paper, section 3), who is silent and makes mistakes as often as a strategy says.
///
/// `kind` is `balanced`, `punish-only`, who never rewards, `reward-only`, who never punishes, or the numbers mu+, mu- and epsilon. The same seed,
/// the same trainer.
///
/// >>> trainer = goodbot.Trainer("punish-only", seed=1)
/// >>> {trainer.feedback(correct=True) for _ in range(100)} <= {"punish", "neutral"}
/// True
#[pyclass(frozen, module = "goodbot")]
#[derive(Debug)]
pub struct Trainer {
    trainer: CourseTrainer,
    random: Mutex<Random>,
}

/// The result of a lesson.
#[pyclass(frozen, module = "goodbot")]
#[derive(Debug)]
pub struct Lesson {
    report: LessonReport,
    /// The last state.
    #[pyo3(get)]
    state: Py<PyAny>,
    /// How many older sessions were forgotten because memory was full.
    #[pyo3(get)]
    gave_way: usize,
    session: Option<Session>,
}

/// The counts of feedback, as a dict.
pub fn counts<'py>(py: Python<'py>, counts: FeedbackCounts) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("reward", counts.reward)?;
    dict.set_item("punish", counts.punish)?;
    dict.set_item("neutral", counts.neutral)?;
    Ok(dict)
}

/// For pickle: the function that makes a lesson again, and its arguments: the report in parts, the last state, and the session.
type LessonReduced<'py> = (Bound<'py, PyAny>, (bool, &'static str, u16, [u32; 3], Py<PyAny>, usize, Option<Session>));

#[pymethods]
impl Lesson {
    /// Whether the agent set out for the intended task on hearing the command, before any feedback.
    #[getter]
    const fn understood(&self) -> bool {
        self.report.understood
    }

    /// Why it ended: `goal`, `dead end`, or `too long`, after 300 steps.
    #[getter]
    const fn ending(&self) -> &'static str {
        self.report.ending.name()
    }

    /// How many steps it took.
    #[getter]
    const fn steps(&self) -> u16 {
        self.report.steps
    }

    /// How often the trainer gave each feedback: a dict of `reward`, `punish` and `neutral`.
    #[getter]
    fn feedback<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        counts(py, self.report.feedback)
    }

    /// The lesson as a recorded session; None for a robot of your own class, which no log can describe.
    #[getter]
    fn session(&self) -> Option<Session> {
        self.session.clone()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<LessonReduced<'py>> {
        let Self { report, state, gave_way, session } = slf.get();
        let FeedbackCounts { reward, punish, neutral } = report.feedback;
        let session = session.clone();
        let parts = (
            report.understood,
            report.ending.name(),
            report.steps,
            [reward, punish, neutral],
            state.clone_ref(slf.py()),
            *gave_way,
            session,
        );
        Ok((slf.get_type().getattr("_restored")?, parts))
    }

    #[staticmethod]
    fn _restored(
        understood: bool,
        ending: &str,
        steps: u16,
        feedback: [u32; 3],
        state: Py<PyAny>,
        gave_way: usize,
        session: Option<Bound<'_, Session>>,
    ) -> PyResult<Self> {
        let known = [Ending::AtGoal, Ending::DeadEnd, Ending::TooLong].into_iter().find(|known| known.name() == ending);
        let ending = known.ok_or_else(|| value(format!("{ending:?} is no ending of a lesson")))?;
        let [reward, punish, neutral] = feedback;
        let report = LessonReport { understood, ending, steps, feedback: FeedbackCounts { reward, punish, neutral } };
        Ok(Self { report, state, gave_way, session: session.map(|session| session.get().clone()) })
    }

    fn __repr__(&self) -> String {
        format!("<goodbot.Lesson: {} steps, ended: {}>", self.report.steps, self.report.ending.name())
    }
}

/// A step as in a log.
fn recorded(place: &Place, step: &Step) -> (usize, StepRecord) {
    (0, StepRecord::new(place.action_text(step.decision.action), Some(word(step.feedback))))
}

impl Trainer {
    /// Runs a lesson whose command was heard to its end. Returns its report, its last place, and its steps.
    #[expect(clippy::too_many_arguments, reason = "a lesson, where it is, and who takes part")]
    fn walk<D: Domain>(
        &self,
        py: Python<'_>,
        mind: &mut Mind,
        domain: &D,
        start: &D::State,
        meant: TaskSet,
        random: &mut Random,
        place: impl Fn(D::State) -> Place,
    ) -> PyResult<(LessonReport, Place, Vec<Step>)> {
        let (mut lesson, mut steps) = (Course::meaning(start, meant.iter().next().unwrap_or(0)), Vec::new());
        loop {
            let here = place(*lesson.state());
            mind.go_on(py, Part::Plan, &here, None)?;
            let turn = lesson.act_for_any(&mut mind.core, domain, meant, &self.trainer, random);
            if let Some(failure) = here.failure() {
                mind.core.leave();
                return Err(failure);
            }
            match turn.map_err(|refused| error::course(py, refused))? {
                Turn::Acted(step) => steps.push(step),
                Turn::Ended(ending) => return Ok((lesson.report(ending), here, steps)),
            }
        }
    }

    fn teach_in(
        &self,
        py: Python<'_>,
        mind: &mut Mind,
        place: &Place,
        command: &str,
        intended: &Bound<'_, PyAny>,
        learn: bool,
    ) -> PyResult<Lesson> {
        // The lesson draws from a copy: holding the lock while other threads run could deadlock.
        let mut random = self.random.lock().unwrap_or_else(PoisonError::into_inner).clone();
        mind.hear(py, place, command)?;
        let meant = mind.tasks(intended)?;
        // A log has one meaning of a command.
        let one = meant.iter().next().filter(|_| meant.len() == 1).map(|task| mind.task_text(py, task));
        if meant.is_empty() {
            return Err(value("no task is meant; name one, or several of which each will do"));
        }
        let walked = in_place_and_on!(py, place, |domain, start, on| self.walk(py, mind, domain, start, meant, &mut random, on));
        let (report, end, steps) = walked?;
        let intended = one.map(|task| task.parse::<GroundTaskText>()).transpose().map_err(value)?;
        let steps = steps.iter().map(|step| recorded(place, step)).collect();
        let session = |mut header: SessionHeader| {
            header.set_meant(intended.as_ref());
            RecordedSession { header, header_line: 1, steps, answers: vec![], learn, end_line: 1 }
        };
        let session = match place {
            Place::Home(home, start) => Some(Session::in_home(session(header(&home.get().rooms, start, command)))),
            Place::Robot(..) => None,
            Place::World(tables, start) => {
                let facts = tables.lend(|robot| robot.facts(*start));
                Some(Session::in_world(session(header_in_world(command)), tables.clone(), facts))
            }
        };
        let mut gave_way = 0;
        if learn {
            gave_way = mind.finish(py, place)?;
            mind.learn(py)?;
        } else {
            mind.core.forget();
        }
        *self.random.lock().unwrap_or_else(PoisonError::into_inner) = random;
        Ok(Lesson { report, state: end.state(py)?, gave_way, session })
    }
}

/// For pickle: the function that makes a trainer again, and its arguments.
type Reduced<'py> = (Bound<'py, PyAny>, ((f32, f32, f32), bool, bool, Drawn));

#[pymethods]
impl Trainer {
    #[new]
    #[pyo3(signature = (kind=None, *, seed=0))]
    fn new(kind: Option<&Bound<'_, PyAny>>, seed: u64) -> PyResult<Self> {
        let trainer = kind.map_or(Ok(CourseTrainer::BALANCED), trainer_of)?;
        Ok(Self { trainer, random: Mutex::new(Random::new(seed)) })
    }

    /// mu+, mu- and epsilon.
    #[getter]
    fn strategy(&self) -> (f32, f32, f32) {
        let strategy = self.trainer.strategy;
        (strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon())
    }

    /// Whether the trainer ever rewards.
    #[getter]
    const fn rewards(&self) -> bool {
        self.trainer.rewards
    }

    /// Whether the trainer ever punishes.
    #[getter]
    const fn punishes(&self) -> bool {
        self.trainer.punishes
    }

    /// The trainer's feedback to an action that is right, or wrong.
    fn feedback(&self, correct: bool) -> &'static str {
        let mut random = self.random.lock().unwrap_or_else(PoisonError::into_inner);
        self.trainer.feedback(correct, &mut *random).name()
    }

    /// The trainer's feedback to a step of a lesson, as that of a trainer of your own: see `goodbot.Judge`.
    fn judge(&self, step: &Bound<'_, PyAny>) -> PyResult<&'static str> {
        Ok(self.feedback(step.getattr("correct")?.extract()?))
    }

    /// Gives a command that means the task `intended` (its name or position), and judges the agent's actions. The lesson ends after `noop`
    /// three times at the goal, in a dead end or after 300 steps. The agent learns from it unless `learn=False`.
    ///
    /// `intended` may be a list of tasks of which each will do, as for "any block". Then the recorded session does not say what was
    /// meant.
    ///
    /// Raises as `hear` does, and `ValueError` if there is no such task.
    #[pyo3(signature = (agent, domain, state, command, intended, *, learn=true))]
    fn teach(
        &self,
        agent: &Bound<'_, Agent>,
        domain: &Bound<'_, PyAny>,
        state: &Bound<'_, PyAny>,
        command: &str,
        intended: &Bound<'_, PyAny>,
        learn: bool,
    ) -> PyResult<Lesson> {
        agent.get().with(|mind| {
            mind.robot = None;
            let place = mind.place(domain, state)?;
            self.teach_in(domain.py(), mind, &place, command, intended, learn)
        })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let trainer = slf.get();
        let drawn = trainer.random.lock().unwrap_or_else(PoisonError::into_inner).drawn();
        Ok((slf.get_type().getattr("_restored")?, (trainer.strategy(), trainer.rewards(), trainer.punishes(), drawn)))
    }

    #[staticmethod]
    fn _restored(strategy: (f32, f32, f32), rewards: bool, punishes: bool, drawn: Drawn) -> PyResult<Self> {
        let strategy = Strategy::new(strategy.0, strategy.1, strategy.2).map_err(value)?;
        let trainer = CourseTrainer { rewards, punishes, ..CourseTrainer::of(strategy) };
        Ok(Self { trainer, random: Mutex::new(Random::after(drawn)) })
    }

    fn __repr__(&self) -> String {
        let known = CourseTrainer::NAMED.into_iter().find(|(_, trainer)| *trainer == self.trainer);
        known.map_or_else(|| format!("goodbot.Trainer({:?})", self.strategy()), |(name, _)| format!("goodbot.Trainer({name:?})"))
    }
}
