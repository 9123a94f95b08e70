//! The class `Agent`: a mind that one thread uses at a time.

use crate::decision::Decision;
use crate::error::{self, InUseError, InternalError, ModelError, value};
use crate::mind::{Mind, Part, words_read};
use crate::options::{Drawn, Items, Kinds, Random, are_same, array, as_dict, capacities_of, kinds_of_tasks, options};
use crate::place::{Place, in_place};
use crate::world::World;
use crate::{home as home_of, robot};
use goodbot::asking::{Answer, Asking, Subject};
use goodbot::feedback::{Feedback, Strategy};
use goodbot::home::SCHEMA;
use goodbot::language::{Meaning, Synonyms};
use goodbot::oomdp::{Action, Domain, Schema};
use goodbot::planning::Progress;
use goodbot::session::{Evidence, Phase};
use goodbot::snapshot::Contents;
use goodbot::symbols::{Symbol, SymbolsRef};
use goodbot::talk::{ClosedWords, Conversation, Said, Verdict};
use goodbot::task::TaskSet;
use goodbot::{AgentError, Capacities, Options};
use goodbot_console::Kind;
use goodbot_console::restored::{room_for, room_for_tasks};
use goodbot_console::whole_file::{Claim, MOST_BYTES};
use goodbot_lesson::first_words::{self, heard};
use goodbot_lesson::kept_kinds;
use goodbot_lesson::name::{in_words, in_words_of_file};
use goodbot_lesson::world::robot as world;
use pyo3::exceptions::PyFileExistsError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyString};
use std::collections::HashMap;
use std::io::Read;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, TryLockError};

/// The most entries of the table of possible tasks, whatever the capacities say.
const MOST_OF_A_FIELD: usize = 1 << 24;

/// A trainer's feedback, by name; `None` is silence.
pub fn feedback_of(name: Option<&str>) -> PyResult<Feedback> {
    match name {
        None => Ok(Feedback::Neutral),
        Some(name) => name.parse().map_err(|_| value(format!("{name:?} is no feedback; say reward, punish or neutral"))),
    }
}

/// The kinds of tasks of a model: those that its file keeps, or else those that are named.
fn kinds_of_model(py: Python<'_>, model: &[u8], tasks: Option<Vec<String>>, domain: Option<&Bound<'_, PyAny>>) -> PyResult<Kinds> {
    let kept = kept_kinds::of(model).map_err(|damaged| ModelError::new_err(damaged.to_string()))?;
    // Kinds of another vocabulary are left out here; restoring such a model is refused later.
    let read = kept.and_then(|kept| Some((tasks_of(py, Some(kept.clone()), domain).ok()?, kept)));
    let Some((kinds, kept)) = read else { return tasks_of(py, tasks, domain) };
    if let Some(tasks) = tasks {
        let asked = tasks_of(py, Some(tasks.clone()), domain)?;
        if !are_same(&kinds.lifted, &asked.lifted) {
            let (kept, tasks) = (kept.join("; "), tasks.join("; "));
            return Err(value(format!(
                "the model was learned for the kinds of task {kept}, and tasks= names {tasks}; leave out tasks=, or load another model"
            )));
        }
    }
    Ok(kinds)
}

/// A table of closed words; without a text, the built-in one.
fn table_of(text: Option<&str>) -> PyResult<ClosedWords<'_>> {
    text.map_or(Ok(ClosedWords::ALL), |text| ClosedWords::new(text).map_err(|error| value(format!("closed_words: {error}"))))
}

/// A trainer strategy and how probable it is: mu+, mu-, epsilon, prior.
type StrategyNumbers = (f32, f32, f32, f32);

fn strategies_of(numbers: &[StrategyNumbers]) -> PyResult<Vec<(Strategy, f32)>> {
    let strategy =
        |&(mu_plus, mu_minus, epsilon, prior): &StrategyNumbers| Ok((Strategy::new(mu_plus, mu_minus, epsilon).map_err(value)?, prior));
    numbers.iter().map(strategy).collect()
}

/// The robot's mind (the paper, Algorithm 1): it hears a command, plans, decides, takes feedback, and learns what words mean.
///
/// `tasks` are the kinds of tasks that commands may mean, such as `agentInRoom(?a,?r)`; without them, the paper's two. `domain` is a
/// robot of your own whose vocabulary they are written in. `learner` is `default`, `paper` or `smoothed`; `weights` is `paper`, `belief`
/// or `evidence`. `strategies` are the trainer's possible strategies, each mu+, mu-, epsilon and prior; without them, the paper's
/// balanced one. `capacities` are the sizes of the tables: `tiny`, `small`, `standard`, or a dict of sizes that differ from `standard`.
/// `seed` decides between equally good choices.
///
/// An agent can be copied and pickled, with all that it has learned and its random numbers, but without a session under way.
///
/// One thread at a time: a second one is refused with `InUseError`. Long calls let other threads run, and stop on ctrl-C.
///
/// >>> home = goodbot.Home.from_map('''
/// ... #########
/// ... #ggg#rrr#
/// ... ##+###+##
/// ... #bb@bbbb#
/// ... #########
/// ... ''')
/// >>> agent, state = goodbot.Agent(seed=1), home.start
/// >>> agent.hear(home, state, "go to the red room")
/// >>> agent.tasks
/// ['agentInRoom(agent0,room1)', 'agentInRoom(agent0,room2)']
/// >>> agent.plan(home, state)
/// True
/// >>> decision = agent.decide(home, state)
/// >>> state = agent.acted(home, state, decision.action)
/// >>> agent.feedback("punish" if decision.task == 0 else "reward")
/// 'used'
/// >>> agent.most_likely
/// 'agentInRoom(agent0,room2)'
/// >>> agent.finish(home)
/// 0
/// >>> agent.words
/// ['go', 'to', 'the', 'red', 'room']
#[pyclass(frozen, module = "goodbot")]
pub struct Agent(Mutex<Mind>);

impl Agent {
    /// Runs a call on the mind, unless another thread or an outer call uses it. A panic of goodbot's becomes an `InternalError`.
    pub fn with<T>(&self, run: impl FnOnce(&mut Mind) -> PyResult<T>) -> PyResult<T> {
        let broken = || InternalError::new_err("goodbot itself failed in an earlier call of this agent; load it anew, and report it");
        let mut mind = match self.0.try_lock() {
            Ok(mind) => mind,
            Err(TryLockError::Poisoned(_)) => return Err(broken()),
            Err(TryLockError::WouldBlock) => {
                let message =
                    "this agent is in use, by another thread or by the call that is under way; give each thread an agent of its own";
                return Err(InUseError::new_err(message));
            }
        };
        if mind.broken {
            return Err(broken());
        }
        catch_unwind(AssertUnwindSafe(|| run(&mut mind))).unwrap_or_else(|_| {
            mind.broken = true;
            Err(InternalError::new_err("goodbot itself failed; what was learned before is in the last file that was saved; report it"))
        })
    }

    /// A mind from a model; with the sizes of its tables, or with room for what is in the model.
    fn restored(py: Python<'_>, bytes: &[u8], kinds: Kinds, sizes: Option<(Capacities, usize)>, random: Random) -> PyResult<Mind> {
        let read = catch_unwind(AssertUnwindSafe(|| -> PyResult<Mind> {
            let contents = Contents::read(bytes).map_err(|refused| error::restore(py, refused))?;
            let (capacities, room) = sizes.unwrap_or_else(|| (room_for(&contents), room_for_tasks(&contents)));
            let made = Mind::new(&capacities, room, kinds, contents.options, 0);
            let mut mind = made.map_err(|refused| error::agent(py, refused))?;
            mind.random = random;
            mind.core.restore(bytes).map_err(|refused| error::restore(py, refused))?;
            mind.learn(py)?;
            Ok(mind)
        }));
        read.unwrap_or_else(|_| Err(InternalError::new_err("goodbot itself failed on this model; report it")))
    }
}

/// For pickle: the function that makes an agent again, and its arguments.
type Reduced<'py> = (Bound<'py, PyAny>, Copied<'py>);
type Copied<'py> = (Bound<'py, PyBytes>, Option<Vec<String>>, Option<Py<PyAny>>, Bound<'py, PyDict>, usize, Drawn, bool);

/// The kinds of tasks of an agent, in the vocabulary of a robot, or of homes where none is given.
fn tasks_of(py: Python<'_>, tasks: Option<Vec<String>>, domain: Option<&Bound<'_, PyAny>>) -> PyResult<Kinds> {
    if let Some(world) = domain.and_then(|domain| domain.cast::<World>().ok()) {
        let tables = &world.get().0;
        return tables.lend(|robot| match tasks {
            None => Ok(Kinds { lifted: world::tasks(tables.file(), robot).map_err(value)?, texts: None }),
            tasks => kinds_of_tasks(py, tasks, &robot.world().schema),
        });
    }
    match domain {
        Some(domain) if domain.cast::<home_of::Home>().is_err() => {
            let of_own = |schema: Schema<'_>| match tasks.is_none() && schema != SCHEMA {
                true => Err(value("a robot of your own needs tasks, such as [\"lampOn(?l)\"]")),
                false => kinds_of_tasks(py, tasks, &schema),
            };
            robot::names_of(domain)?.lend(|schema, _| of_own(schema))
        }
        _ => kinds_of_tasks(py, tasks, &SCHEMA),
    }
}

/// Writes a model as the command line does. A file that is no model is replaced only with `force`.
fn write_model(path: &Path, bytes: &[u8], force: bool) -> PyResult<()> {
    if !force && !Kind::Model.may_replace(path) {
        let message = format!("{} is there and is no model; name another file, or say force=True", path.display());
        return Err(PyFileExistsError::new_err(message));
    }
    Ok(Claim::take(path)?.write(bytes)?)
}

#[pymethods]
impl Agent {
    #[new]
    #[pyo3(signature = (tasks=None, *, domain=None, learner="default", weights=None, strategies=None, capacities=None, seed=0))]
    #[expect(clippy::too_many_arguments, reason = "Python's arguments have names")]
    fn new(
        py: Python<'_>,
        tasks: Option<Items<String>>,
        domain: Option<&Bound<'_, PyAny>>,
        learner: &str,
        weights: Option<&str>,
        strategies: Option<Items<StrategyNumbers>>,
        capacities: Option<&Bound<'_, PyAny>>,
        seed: u64,
    ) -> PyResult<Self> {
        let given = tasks.map(|tasks| tasks.0);
        let kinds = tasks_of(py, given.clone(), domain)?;
        let capacities = capacities_of(capacities)?;
        let tasks = capacities.sessions.saturating_mul(capacities.tasks).min(MOST_OF_A_FIELD);
        let made = Mind::new(&capacities, tasks, kinds, options(learner, weights)?, seed);
        let mut mind = made.map_err(|refused| error::agent(py, refused))?;
        mind.made_with = (given, domain.map(|domain| domain.clone().unbind()));
        if let Some(strategies) = strategies {
            mind.set_strategies(py, &strategies_of(&strategies.0)?)?;
        }
        Ok(Self(Mutex::new(mind)))
    }

    /// An agent from a model file, written by this package, the command line, the page, or a controller. Its kinds of tasks are those in
    /// the file; `tasks` are for files without any.
    ///
    /// Raises `ValueError` if `tasks` differ from the kinds in the file, `ModelError`, `CapacityError` and `OSError`.
    #[staticmethod]
    #[pyo3(signature = (path, tasks=None, *, domain=None, seed=0))]
    fn load(py: Python<'_>, path: PathBuf, tasks: Option<Items<String>>, domain: Option<&Bound<'_, PyAny>>, seed: u64) -> PyResult<Self> {
        let mut bytes = Vec::new();
        let read = std::fs::File::open(&path).and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes));
        read.map_err(|error| error::file(&path, &error))?;
        Self::from_bytes(py, &bytes, tasks, domain, seed).map_err(|error| error::in_file(py, &path, error))
    }

    /// As `load`, from the bytes of a model file.
    #[staticmethod]
    #[pyo3(signature = (model, tasks=None, *, domain=None, seed=0))]
    fn from_bytes(
        py: Python<'_>,
        model: &[u8],
        tasks: Option<Items<String>>,
        domain: Option<&Bound<'_, PyAny>>,
        seed: u64,
    ) -> PyResult<Self> {
        let given = tasks.map(|tasks| tasks.0);
        let kinds = kinds_of_model(py, model, given.clone(), domain)?;
        let mut mind = Self::restored(py, model, kinds, None, Random::new(seed))?;
        mind.made_with = (given, domain.map(|domain| domain.clone().unbind()));
        Ok(Self(Mutex::new(mind)))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let py = slf.py();
        slf.get().with(|mind| {
            let (tasks, domain) = &mind.made_with;
            let domain = domain.as_ref().map(|domain| domain.clone_ref(py));
            let model = PyBytes::new(py, &mind.saved()?);
            let sizes = as_dict(py, &mind.core.capacities())?;
            let arguments = (model, tasks.clone(), domain, sizes, mind.room, mind.random.drawn(), mind.waiting);
            Ok((slf.get_type().getattr("_restored")?, arguments))
        })
    }

    #[staticmethod]
    #[expect(clippy::too_many_arguments, reason = "all that a copy needs")]
    fn _restored(
        py: Python<'_>,
        model: &[u8],
        tasks: Option<Items<String>>,
        domain: Option<Bound<'_, PyAny>>,
        sizes: &Bound<'_, PyAny>,
        room: usize,
        drawn: Drawn,
        waiting: bool,
    ) -> PyResult<Self> {
        let given = tasks.map(|tasks| tasks.0);
        let kinds = kinds_of_model(py, model, given.clone(), domain.as_ref())?;
        let sizes = (capacities_of(Some(sizes))?, room.min(MOST_OF_A_FIELD));
        let mut mind = Self::restored(py, model, kinds, Some(sizes), Random::after(drawn))?;
        mind.made_with = (given, domain.map(Bound::unbind));
        mind.waiting = waiting;
        Ok(Self(Mutex::new(mind)))
    }

    /// Learns what a command means from its label, without any action: `tasks` is the task that was meant, by name or position, or a list
    /// of tasks of which each will do. Returns how many older sessions were forgotten because memory was full.
    ///
    /// With `learn=False` the training is left to `learn`, so that many labels cost one training; memory must have room for them.
    ///
    /// Raises as `hear` does, `ValueError` if there is no such task, and `CapacityError`.
    ///
    /// >>> home = goodbot.Home.from_map("#########\n#ggg#rrr#\n##+###+##\n#bb@bbbb#\n#########")
    /// >>> agent = goodbot.Agent()
    /// >>> agent.told(home, home.start, "off to the crimson one", "agentInRoom(agent0,room2)")
    /// 0
    /// >>> agent.hear(home, home.start, "crimson")
    /// >>> agent.most_likely
    /// 'agentInRoom(agent0,room2)'
    #[pyo3(signature = (domain, state, command, tasks, *, learn=true))]
    fn told(
        &self,
        domain: &Bound<'_, PyAny>,
        state: &Bound<'_, PyAny>,
        command: &str,
        tasks: &Bound<'_, PyAny>,
        learn: bool,
    ) -> PyResult<usize> {
        let py = domain.py();
        self.with(|mind| {
            mind.robot = None;
            let place = mind.place(domain, state)?;
            mind.hear(py, &place, command)?;
            // An answer that is never wrong: no other task is possible any more.
            let told =
                mind.tasks(tasks).and_then(|tasks| mind.core.answered(tasks, true, 0.0, 1).map_err(|refused| error::agent(py, refused)));
            let kept = match told {
                Err(refused) => Err(refused),
                Ok(Evidence::Impossible) => Err(value("the words of this command make these tasks impossible")),
                Ok(_) if learn => return mind.finish(py, &place).and_then(|gave_way| mind.learn(py).map(|()| gave_way)),
                Ok(_) => {
                    let kept = in_place!(&place, |domain, _state| mind.core.finish_for_later(domain));
                    mind.waiting |= kept.is_ok();
                    mind.settled(py, &place, kept)
                }
            };
            if kept.is_err() {
                mind.core.forget();
            }
            kept.map(|()| 0)
        })
    }

    /// Writes a model file, whole or not at all. An existing file that is no model is replaced only with `force=True`.
    ///
    /// Raises `FileExistsError`, `OSError` and `ModelError`.
    #[pyo3(signature = (path, *, force=false))]
    fn save(&self, path: PathBuf, force: bool) -> PyResult<()> {
        self.with(|mind| write_model(&path, &mind.saved()?, force))
    }

    /// The bytes of a model file. A session under way is not in them.
    ///
    /// >>> goodbot.Agent.from_bytes(goodbot.Agent().to_bytes()).sessions
    /// 0
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self.with(|mind| Ok(PyBytes::new(py, &mind.saved()?)))
    }

    /// Replaces the trainer strategies: for each mu+, mu-, epsilon and prior. A session under way ends unlearned.
    fn set_strategies(&self, py: Python<'_>, strategies: Items<StrategyNumbers>) -> PyResult<()> {
        self.with(|mind| mind.set_strategies(py, &strategies_of(&strategies.0)?))
    }

    /// Hears a command in a state: a session begins. Each task gets its prior from the words, or `prior` gives it by name, in any unit. Of
    /// more than 64 words the first 64 are heard, and a `UserWarning` says so.
    ///
    /// A prior is no lesson: `finish` learns from feedback and answers, so after a prior alone it learns nothing. If you know what was
    /// meant, and want the words learned, call `told`.
    ///
    /// Raises `ValueError`, `CapacityError`, and `SessionError` while the last session is still being learned from.
    ///
    /// >>> home = goodbot.Home.from_map("#########\n#ggg#rrr#\n##+###+##\n#bb@bbbb#\n#########")
    /// >>> agent, green = goodbot.Agent(), "agentInRoom(agent0,room1)"
    /// >>> def believed():
    /// ...     agent.hear(home, home.start, "off to the verdant one")
    /// ...     return round(float(agent.beliefs[agent.tasks.index(green)]), 2)
    /// >>> agent.hear(home, home.start, "off to the verdant one", prior={green: 1.0})
    /// >>> agent.finish(home), believed()          # one of two rooms, as before
    /// (0, 0.5)
    /// >>> agent.told(home, home.start, "off to the verdant one", green), believed() > 0.5
    /// (0, True)
    #[pyo3(signature = (domain, state, command, *, prior=None))]
    fn hear(
        &self,
        domain: &Bound<'_, PyAny>,
        state: &Bound<'_, PyAny>,
        command: &str,
        prior: Option<HashMap<String, f32>>,
    ) -> PyResult<()> {
        self.with(|mind| {
            mind.robot = None;
            let place = mind.place(domain, state)?;
            match &prior {
                None => mind.hear(domain.py(), &place, command),
                Some(prior) => mind.hear_with_prior(domain.py(), &place, command, prior),
            }
        })
    }

    /// Hears words that may be no command, in a state. Returns a dict: `verdict` is `sure`, `unsure`, `done` or `none`; `taken_for` is
    /// the most likely reading of the words; `tasks` are the tasks that are meant, negated if they begin with `!`; `probability` is how
    /// probable they are; `rest` is the rest of several commands, or None. A session begins, as with `hear`. `goes_on` hears such a rest,
    /// in the state after the previous command.
    ///
    /// A robot without lessons takes everything for a command, and so does one with the paper's language model.
    ///
    /// `closed_words` is a table of words such as "not", "and", "please", as text, in place of the built-in one, which
    /// `goodbot example closed-words` prints; an empty text has no words.
    ///
    /// Raises as `hear` does, and ValueError if `closed_words` is no table.
    #[pyo3(signature = (domain, state, words, *, goes_on=false, closed_words=None))]
    fn listen<'py>(
        &self,
        domain: &Bound<'py, PyAny>,
        state: &Bound<'py, PyAny>,
        words: &str,
        goes_on: bool,
        closed_words: Option<&str>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (py, closed) = (domain.py(), table_of(closed_words)?);
        self.with(|mind| {
            mind.robot = None;
            let place = mind.place(domain, state)?;
            let listened = in_place!(&place, |domain, state| {
                let heard = mind.core.listen_in_parts(domain, state, words, closed, goes_on, &|| true);
                heard.and_then(|listened| mind.core.leave_out_done(domain, &listened).map(|()| listened))
            });
            let listened = mind.settled(py, &place, listened)?;
            first_words::words_read(words).clone_into(&mut mind.command);
            mind.name_tasks(py, &place);
            let heard = PyDict::new(py);
            let verdict = match listened.verdict {
                Verdict::Sure => "sure",
                Verdict::Unsure => "unsure",
                Verdict::Done => "done",
                Verdict::None => "none",
            };
            heard.set_item("verdict", verdict)?;
            heard.set_item("taken_for", listened.hypothesis.to_string())?;
            heard.set_item("tasks", listened.tasks.iter().map(|task| mind.task_text(py, task)).collect::<Vec<_>>())?;
            heard.set_item("probability", listened.probability)?;
            heard.set_item("rest", listened.rest.and_then(|from| words.get(from..)))?;
            Ok(heard)
        })
    }

    /// Remembers that the robot followed a task of the session, by its name or its position among `tasks`, from the session's first state:
    /// `listen` then knows what "it", "there", "back", "the other one" and "again" refer to. Call it before the session is finished or
    /// forgotten.
    ///
    /// Raises ValueError if there is no such task, and SessionError if no session is under way.
    fn remember(&self, domain: &Bound<'_, PyAny>, task: &Bound<'_, PyAny>) -> PyResult<()> {
        let py = domain.py();
        self.with(|mind| {
            let place = mind.place_of(domain)?;
            let position = mind.task(task)?;
            let followed = mind.core.tasks().get(position).copied();
            let remembered = in_place!(&place, |domain, _state| {
                let start = mind.core.started_from(domain);
                start.zip(followed).map(|(start, followed)| mind.core.remember(domain, &start, &followed))
            });
            remembered.ok_or_else(|| error::agent(py, AgentError::NotNow(Phase::Idle)))
        })
    }

    /// Begins another conversation: the previous one is forgotten.
    fn converse_anew(&self) -> PyResult<()> {
        self.with(|mind| {
            mind.core.resume(Conversation::NEW);
            Ok(())
        })
    }

    /// Finds what a person's words ask for, given the session under way, the last action, and the open question. It does nothing yet.
    /// Returns one of these names, and the answer if the words are one:
    ///
    /// - `command`: `listen`; `stop`: `forget`; `nothing`;
    /// - `reward`, `punish`: `feedback`; `finish`: praise for a robot that rests at its goal;
    /// - `answer`: `answer`, with the second value; `correction`: `correct`;
    /// - `undo`: take something back; `again`: the last command once more.
    ///
    /// >>> agent, home = goodbot.Agent(), goodbot.Home.from_map("#######\n#r@+gg#\n#######")
    /// >>> agent.said(home, home.start, "go to the red room"), agent.said(home, home.start, "stop")
    /// (('command', None), ('stop', None))
    #[pyo3(signature = (domain, state, words, *, closed_words=None))]
    fn said(
        &self,
        domain: &Bound<'_, PyAny>,
        state: &Bound<'_, PyAny>,
        words: &str,
        closed_words: Option<&str>,
    ) -> PyResult<(&'static str, Option<Py<PyAny>>)> {
        let (py, closed) = (domain.py(), table_of(closed_words)?);
        self.with(|mind| {
            let place = mind.place(domain, state)?;
            let said = in_place!(&place, |domain, state| {
                let stage = mind.core.stage(domain, state);
                mind.core.said(words, closed, stage, |word| mind.voice.count(word))
            });
            let asks = match said.map_err(|refused| error::agent(py, refused))? {
                Said::Answer(Answer::Yes) => return Ok(("answer", Some(PyString::new(py, "yes").into_any().unbind()))),
                Said::Answer(Answer::No) => return Ok(("answer", Some(PyString::new(py, "no").into_any().unbind()))),
                Said::Answer(Answer::This(choice)) => return Ok(("answer", Some(choice.into_pyobject(py)?.into_any().unbind()))),
                Said::Command => "command",
                Said::Judgement(Feedback::Punish) => "punish",
                Said::Judgement(_) => "reward",
                Said::Finish => "finish",
                Said::Correction => "correction",
                Said::Stop => "stop",
                Said::Undo => "undo",
                Said::Again => "again",
                Said::Nothing(_) => "nothing",
            };
            Ok((asks, None))
        })
    }

    /// Learns words that are said along with a feedback button: `said` then takes them for praise or blame, as long as they come with one
    /// of the two more than twice as often as with the other. A saved robot does not keep them.
    #[pyo3(signature = (words, feedback, *, closed_words=None))]
    fn learn_voice(&self, py: Python<'_>, words: &str, feedback: Option<&str>, closed_words: Option<&str>) -> PyResult<()> {
        let (feedback, closed) = (feedback_of(feedback)?, table_of(closed_words)?);
        self.with(|mind| mind.voice.learn(words, feedback, closed).map_err(|refused| error::agent(py, refused)))
    }

    /// Takes in words that correct the robot on its way: "no, the other one", "I meant the blue one", "not the red one". The belief in
    /// the task that it follows drops to at most a twentieth of that in the next one, and the words are evidence.
    #[pyo3(signature = (domain, words, *, closed_words=None))]
    fn correct(&self, domain: &Bound<'_, PyAny>, words: &str, closed_words: Option<&str>) -> PyResult<()> {
        let (py, closed) = (domain.py(), table_of(closed_words)?);
        self.with(|mind| {
            let place = mind.place_of(domain)?;
            let corrected = in_place!(&place, |domain, _state| mind.core.correct(domain, words, closed, None));
            corrected.map(|_| ()).map_err(|refused| error::agent(py, refused))
        })
    }

    /// Hears the last command again in the same state: the belief goes on.
    fn hear_again(&self, domain: &Bound<'_, PyAny>, state: &Bound<'_, PyAny>) -> PyResult<()> {
        self.with(|mind| {
            let place = mind.place(domain, state)?;
            let heard = in_place!(&place, |domain, state| mind.core.hear_again(domain, state));
            mind.settled(domain.py(), &place, heard)
        })
    }

    /// Plans for a state, to the end or with at most about `budget` expansions. Returns whether the plan is done.
    #[pyo3(signature = (domain, state, budget=None))]
    fn plan(&self, domain: &Bound<'_, PyAny>, state: &Bound<'_, PyAny>, budget: Option<u32>) -> PyResult<bool> {
        self.with(|mind| {
            let place = mind.place(domain, state)?;
            Ok(mind.go_on(domain.py(), Part::Plan, &place, budget)?.is_some())
        })
    }

    /// Decides on an action in a state that was planned for. Raises `SessionError` if it was not.
    fn decide(&self, domain: &Bound<'_, PyAny>, state: &Bound<'_, PyAny>) -> PyResult<Decision> {
        let py = domain.py();
        self.with(|mind| {
            let place = mind.place(domain, state)?;
            let decided = in_place!(&place, |domain, state| mind.core.decide_with(domain, state, &mut mind.random));
            let decision = mind.settled(py, &place, decided)?;
            let name = mind.names.get(decision.task).map_or_else(|| PyString::new(py, "").unbind(), |name| name.clone_ref(py));
            Ok(Decision { action: place.action_text(decision.action), task: decision.task, plan: decision.plan.name().to_owned(), name })
        })
    }

    /// Records that an action was done in a state that was planned for. Returns the next state.
    ///
    /// Raises `ValueError` if the action cannot be done.
    fn acted(&self, domain: &Bound<'_, PyAny>, state: &Bound<'_, PyAny>, action: &str) -> PyResult<Py<PyAny>> {
        self.with(|mind| {
            let place = mind.place(domain, state)?;
            let action = place.action(action)?;
            mind.acted(domain.py(), &place, action)?.state(domain.py())
        })
    }

    /// Takes in the trainer's feedback to the last action: `reward`, `punish`, or `neutral`, which None means too. Of several words the
    /// last counts.
    ///
    /// Returns `used`, `says nothing` if no task's right actions are known exactly, or `impossible`, which is ignored.
    #[pyo3(signature = (feedback))]
    fn feedback(&self, py: Python<'_>, feedback: Option<&str>) -> PyResult<&'static str> {
        let feedback = feedback_of(feedback)?;
        self.with(|mind| mind.core.feedback(feedback).map(Evidence::name).map_err(|refused| error::agent(py, refused)))
    }

    /// Takes in an action that the trainer did to show the way, in a state that was planned for. Returns the same as `feedback`.
    fn demonstrated(&self, domain: &Bound<'_, PyAny>, state: &Bound<'_, PyAny>, action: &str) -> PyResult<&'static str> {
        self.with(|mind| {
            let place = mind.place(domain, state)?;
            let action = place.action(action)?;
            let evidence = in_place!(&place, |domain, state| mind.core.demonstrated(domain, state, action));
            mind.settled(domain.py(), &place, evidence).map(Evidence::name)
        })
    }

    /// Proposes a question in a state that was planned for, or None if acting teaches as much.
    ///
    /// A dict of `about` (`object`, `kind`, `task`, or `which` if there are choices), `choices`, a list of names of tasks for each choice
    /// (one list if the answer is yes or no), and `bits`, the expected information of an answer. `kappa` is the cost of a question in
    /// steps, `eta` the probability of a wrong answer.
    ///
    /// >>> home = goodbot.Home.from_map("#########\n#ggg#rrr#\n##+###+##\n#bb@bbbb#\n#########")
    /// >>> agent = goodbot.Agent()
    /// >>> agent.hear(home, home.start, "over there")
    /// >>> agent.plan(home, home.start)
    /// True
    /// >>> question = agent.ask(home, home.start, kappa=0.5)
    /// >>> agent.answer(0 if question["about"] == "which" else "yes")
    /// 'used'
    #[pyo3(signature = (domain, state, *, kappa=8.0, eta=0.05))]
    fn ask<'py>(
        &self,
        domain: &Bound<'py, PyAny>,
        state: &Bound<'py, PyAny>,
        kappa: f32,
        eta: f32,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let py = domain.py();
        self.with(|mind| {
            let place = mind.place(domain, state)?;
            let asking = Asking { kappa, eta, ..Asking::DEFAULT };
            let asked = in_place!(&place, |domain, state| mind.core.question(domain, state, &asking));
            let Some(question) = mind.settled(py, &place, asked)? else { return Ok(None) };
            let about = match question.subject {
                Subject::Object(_) => "object",
                Subject::Kind(_) => "kind",
                Subject::Task(_) => "task",
                Subject::WhichObject(..) | Subject::WhichTask(..) => "which",
            };
            let names = |tasks: &TaskSet| tasks.iter().map(|task| mind.task_text(py, task)).collect::<Vec<_>>();
            let choices: Vec<_> = match question.subject.choices() {
                0 => vec![names(&question.yes)],
                count => question.choices.iter().take(usize::from(count)).map(names).collect(),
            };
            let told = PyDict::new(py);
            told.set_item("about", about)?;
            told.set_item("choices", choices)?;
            told.set_item("bits", question.information)?;
            Ok(Some(told))
        })
    }

    /// Takes in the answer to the last question: `"yes"`, `"no"` (which also means none of these), or the position of a choice, from 0 on.
    /// Returns the same as `feedback`.
    fn answer(&self, answer: &Bound<'_, PyAny>) -> PyResult<&'static str> {
        let py = answer.py();
        let said = match answer.extract::<String>().as_deref() {
            Ok("yes") => Answer::Yes,
            Ok("no") => Answer::No,
            _ => Answer::This(
                answer.extract().map_err(|_| value(format!("{answer} is no answer; say \"yes\", \"no\" or the position of a choice")))?,
            ),
        };
        self.with(|mind| mind.core.answer(said).map(Evidence::name).map_err(|refused| error::agent(py, refused)))
    }

    /// Ends the session and learns from it. Returns how many older sessions were forgotten because memory was full.
    ///
    /// With `learn=False` the training is left to `learn`.
    #[pyo3(signature = (domain, *, learn=true))]
    fn finish(&self, domain: &Bound<'_, PyAny>, learn: bool) -> PyResult<usize> {
        self.with(|mind| {
            let place = mind.place_of(domain)?;
            let gave_way = mind.finish(domain.py(), &place)?;
            if learn {
                mind.learn(domain.py())?;
            }
            Ok(gave_way)
        })
    }

    /// Goes on learning, to the end or with about `budget` table cells of work. Returns whether it is done.
    #[pyo3(signature = (budget=None))]
    fn learn(&self, py: Python<'_>, budget: Option<u32>) -> PyResult<bool> {
        self.with(|mind| {
            if std::mem::take(&mut mind.waiting) {
                mind.core.begin_learning();
            }
            match budget {
                None => mind.learn(py).map(|()| true),
                Some(budget) => Ok(py.detach(|| mind.core.learn(budget)) == Progress::Done),
            }
        })
    }

    /// Ends the session without learning from it.
    fn forget(&self) -> PyResult<()> {
        self.with(|mind| {
            mind.core.forget();
            Ok(())
        })
    }

    /// The last command.
    #[getter]
    fn command(&self) -> PyResult<String> {
        self.with(|mind| Ok(mind.command.clone()))
    }

    /// The names of this session's tasks, in the order of `beliefs`, `plans`, `distances` and the rows of `optimal_sets`.
    #[getter]
    fn tasks(&self, py: Python<'_>) -> PyResult<Vec<Py<PyString>>> {
        self.with(|mind| Ok(mind.names(py).take(mind.count()).collect()))
    }

    /// How probable each task is: float32, shape (tasks,), sum 1.
    #[getter]
    fn beliefs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.with(|mind| array(py, mind.beliefs(), &[mind.count()]))
    }

    /// The trainer strategies: for each mu+, mu-, epsilon, and how probable it was when the session began.
    #[getter]
    fn strategies(&self) -> PyResult<Vec<StrategyNumbers>> {
        self.with(|mind| {
            let numbers = |(strategy, prior): &(Strategy, f32)| (strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon(), *prior);
            Ok(mind.core.belief().strategies().iter().map(numbers).collect())
        })
    }

    /// How probable each strategy is now: float32, shape (strategies,).
    #[getter]
    fn strategy_beliefs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.with(|mind| {
            let belief = mind.core.belief();
            let count = belief.strategies().len();
            array(py, (0..count).map(|strategy| belief.strategy_probability(strategy)), &[count])
        })
    }

    /// The name of the most likely task, or None before the first command.
    #[getter]
    fn most_likely(&self, py: Python<'_>) -> PyResult<Option<Py<PyString>>> {
        self.with(|mind| Ok(mind.core.most_likely().and_then(|task| mind.names.get(task)).map(|name| name.clone_ref(py))))
    }

    /// Which actions begin a shortest way to each task's goal, in the state that was planned for last: bool, shape (tasks, actions + 1).
    ///
    /// The columns are the domain's actions and, last, `noop`, which is right at the goal. In a dead end all possible actions are right. An
    /// `approximate` plan has the actions that it found, perhaps not of a shortest way. The row of an `unknown` plan is all False.
    fn optimal_sets<'py>(&self, domain: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.with(|mind| {
            let place = mind.place_of(domain)?;
            let actions = in_place!(&place, |domain, _state| domain.actions().len());
            let plan = mind.core.planned();
            let row = |task: usize| {
                let optimal = plan.optimal(task);
                let set = optimal.exact().or(optimal.onward()).unwrap_or_default();
                (0..actions as u8).map(Action::new).chain([Action::NOOP]).map(move |action| set.contains(action))
            };
            array(domain.py(), (0..mind.count()).flat_map(row), &[mind.count(), actions + 1])
        })
    }

    /// The kind of plan for each task: `goal`, `toward`, `dead end`, `approximate` or `unknown`.
    #[getter]
    fn plans(&self) -> PyResult<Vec<&'static str>> {
        self.with(|mind| Ok((0..mind.count()).map(|task| mind.core.planned().optimal(task).name()).collect()))
    }

    /// The cost of a shortest way to each task's goal: int64, shape (tasks,); -1 if none is known.
    #[getter]
    fn distances<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.with(|mind| {
            let plan = mind.core.planned();
            array(py, (0..mind.count()).map(|task| plan.distance(task).map_or(-1, i64::from)), &[mind.count()])
        })
    }

    /// The words of the training data; long words may be cut.
    #[getter]
    fn words(&self) -> PyResult<Vec<String>> {
        self.with(|mind| {
            let language = mind.core.language();
            Ok(texts(language.words(), language.tables().words()))
        })
    }

    /// A command for `hear`, with unknown words replaced by learned synonyms. Each line of `synonyms` has words of the same meaning, with
    /// spaces between them; a `#` begins a comment. A learned word stays, and so does a word without a learned synonym.
    fn in_known_words(&self, py: Python<'_>, command: &str, synonyms: &str) -> PyResult<String> {
        let table = Synonyms::new(synonyms).map_err(value)?;
        self.with(|mind| table.in_known_words(mind.core.language(), command).map_err(|error| error::full(py, error)))
    }

    /// The machine tokens that the words are explained by.
    #[getter]
    fn tokens(&self) -> PyResult<Vec<String>> {
        self.with(|mind| {
            let language = mind.core.language();
            Ok(texts(language.tokens(), language.tables().tokens()))
        })
    }

    /// How probable each word is for each machine token: float32, shape (tokens, words).
    #[getter]
    fn translations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.with(|mind| {
            let tables = mind.core.language().tables();
            let (words, tokens) = (tables.words(), tables.tokens());
            let cell = |token: usize| move |word: usize| tables.translation(Symbol::new(word as u16), Some(Symbol::new(token as u16)));
            array(py, (0..tokens).flat_map(|token| (0..words).map(cell(token))), &[tokens, words])
        })
    }

    /// A task of the session in a person's words, by its name or position: `go to the green room`. In a world from a file, and with a robot
    /// of your own, these are its own names: `lamp on: red kitchen lamp`.
    ///
    /// Raises `ValueError` if there is no such task.
    ///
    /// >>> home = goodbot.Home.from_map("#########\n#ggg#rrr#\n##+###+##\n#bb@bbbb#\n#########")
    /// >>> agent = goodbot.Agent()
    /// >>> agent.hear(home, home.start, "over there")
    /// >>> [agent.words_of(home, task) for task in agent.tasks]
    /// ['go to the green room', 'go to the red room']
    fn words_of(&self, domain: &Bound<'_, PyAny>, task: &Bound<'_, PyAny>) -> PyResult<String> {
        self.with(|mind| {
            let place = mind.place_of(domain)?;
            let position = mind.task(task)?;
            let known = mind.core.tasks().get(position).and_then(|task| Some((mind.core.lifted().get(usize::from(task.lifted))?, task)));
            let Some((lifted, task)) = known else { return Err(error::agent(domain.py(), AgentError::NotNow(Phase::Idle))) };
            Ok(match &place {
                Place::Home(home, _) => in_words(&home.get().rooms, lifted, task),
                Place::Robot(robot, _) => robot.lend(|domain| in_words_of_file(domain, lifted, task)),
                Place::World(tables, _) => tables.lend(|domain| in_words_of_file(domain, lifted, task)),
            })
        })
    }

    /// Explains each word of the command if this task, by name or position, is meant: the word's meanings and their shares, which sum to 1.
    /// Meanings are `background`, `task`, and values such as `goal colorRed`.
    ///
    /// Empty dicts for the learners `paper` and `smoothed`, and before anything is learned.
    fn explain<'py>(&self, domain: &Bound<'py, PyAny>, task: &Bound<'py, PyAny>) -> PyResult<Vec<(String, Bound<'py, PyDict>)>> {
        let py = domain.py();
        self.with(|mind| {
            let place = mind.place_of(domain)?;
            let task = mind.task(task)?;
            let mut told: Vec<(usize, Meaning, f32)> = Vec::new();
            let result = in_place!(&place, |domain, _state| mind
                .core
                .explain(domain, task, |word, meaning, share| told.push((word, meaning, share))));
            mind.settled(py, &place, result)?;
            let words = heard(mind.core.options().language.model, &mind.command).map_err(|refused| error::full(py, refused))?;
            let words: Vec<_> = words.into_iter().map(|word| (word, PyDict::new(py))).collect();
            let tokens = mind.core.language().tokens();
            for (word, meaning, share) in told.into_iter().filter(|(_, _, share)| *share > 0.0) {
                let name = match meaning {
                    Meaning::Background => "background".to_owned(),
                    Meaning::Task => "task".to_owned(),
                    Meaning::Value(role, symbol) => format!("{} {}", kind_name(role.kind()), tokens.text(symbol)),
                };
                if let Some((_, shares)) = words.get(word) {
                    // The same value of two roles of a kind is one meaning here.
                    let before: f32 = shares.get_item(&name)?.map_or(Ok(0.0), |before| before.extract())?;
                    shares.set_item(name, before + share)?;
                }
            }
            Ok(words)
        })
    }

    /// How many sessions are in the training data.
    #[getter]
    fn sessions(&self) -> PyResult<usize> {
        self.with(|mind| Ok(mind.core.language().bitext().sessions()))
    }

    /// Whether the last session is still being learned from: `learn` goes on.
    #[getter]
    fn is_learning(&self) -> PyResult<bool> {
        self.with(|mind| Ok(mind.core.language().is_training()))
    }

    /// How large each table is.
    #[getter]
    fn capacities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.with(|mind| as_dict(py, &mind.core.capacities()))
    }

    /// The most entries of each table after a command or a session so far. Those of a home and of the search are 0.
    #[getter]
    fn most_used<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.with(|mind| as_dict(py, &mind.core.most_used()))
    }

    /// Plans, decides, acts and takes feedback this many times in one state, all in Rust: `benches/figures.py` compares the same calls from
    /// Python with it.
    fn _rounds(&self, domain: &Bound<'_, PyAny>, state: &Bound<'_, PyAny>, count: u32) -> PyResult<()> {
        self.with(|mind| {
            let place = mind.place(domain, state)?;
            let result = in_place!(&place, |domain, state| (0..count).try_for_each(|_| {
                mind.core.plan_fully(domain, state)?;
                let decision = mind.core.decide_with(domain, state, &mut mind.random)?;
                mind.core.acted(domain, state, decision.action)?;
                mind.core.feedback(Feedback::Neutral).map(drop)
            }));
            mind.settled(domain.py(), &place, result)
        })
    }

    fn __repr__(&self) -> String {
        let told = self.with(|mind| {
            let language = mind.core.language();
            Ok(format!("<goodbot.Agent: {} sessions, {} words>", language.bitext().sessions(), language.tables().words()))
        });
        told.unwrap_or_else(|_| "<goodbot.Agent in use>".to_owned())
    }
}

/// The words of a command, as a robot hears them: in lower case, without punctuation, and in scripts without spaces sign by sign.
///
/// >>> goodbot.words("Go to the RED room!")
/// ['go', 'to', 'the', 'red', 'room']
#[pyfunction]
pub fn words(py: Python<'_>, command: &str) -> PyResult<Vec<String>> {
    heard(Options::DEFAULT.language.model, words_read(py, command)?).map_err(|refused| error::full(py, refused))
}

/// The first symbols of a table.
fn texts(symbols: SymbolsRef<'_>, count: usize) -> Vec<String> {
    symbols.iter().take(count).map(|(_, text)| text.to_owned()).collect()
}

const fn kind_name(kind: goodbot::task::RoleKind) -> &'static str {
    use goodbot::task::RoleKind;
    match kind {
        RoleKind::Goal => "goal",
        RoleKind::Subject => "subject",
        RoleKind::Start => "start",
        RoleKind::OtherPlace => "other place",
        RoleKind::Other => "other",
        RoleKind::Through => "through",
        RoleKind::Avoiding => "avoiding",
        RoleKind::Before => "before",
    }
}
