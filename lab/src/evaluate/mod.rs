//! `goodbot evaluate`: the accuracy for commands that were not trained on.
//!
//! - [`split`]: the sessions that are left out together, and test sessions that were trained on nevertheless;
//! - [`folds`]: training on some sessions and asking others;
//! - [`method`]: trained models, and the control, a learner without words;
//! - [`novel`]: the same commands in other layouts;
//! - [`curve`]: accuracy against the number of sessions;
//! - [`report`]: the report.

mod curve;
mod folds;
mod method;
mod novel;
pub mod report;
mod split;

use crate::calibration;
use clap::{Args, ValueHint};
use folds::Experiment;
use goodbot::memory::AgentHeap;
use goodbot::task::LiftedTask;
use goodbot::{Capacities, Options};
use goodbot_console::training_data::{Lessons, LogOptions};
use goodbot_console::whole_file::options_of_model;
use goodbot_console::{
    Failure, InputFile, Learner, Lesson, Limit, Output, Starter, StarterOptions, SynonymOptions, TaskKinds, between, counted, output,
    restored, say, training_data,
};
use method::Trained;
use novel::Novel;
use report::{SessionCounts, Summary};
use split::{Group, Split};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Above this many sessions, ten parts are left out in turn, instead of each session: the work of leaving out each one grows with the
/// square of their number.
const MOST_LEFT_OUT_ONE_BY_ONE: usize = 500;
/// The number of parts then.
const PARTS: usize = 10;

/// The options of `goodbot evaluate`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct EvaluateOptions {
    /// Session logs (JSON Lines) to train on; - is standard input. Without --test, each is also asked, in its turn
    #[arg(required_unless_present = "with", value_name = "TRAIN", value_hint = ValueHint::FilePath)]
    files: Vec<InputFile>,
    /// Ask the sessions of these logs, and train on all of TRAIN
    #[arg(long, value_name = "FILE", num_args = 1.., value_hint = ValueHint::FilePath, conflicts_with_all = ["leave_one_out", "k_fold", "group", "leave_environment_out", "leave_task_out"])]
    test: Vec<InputFile>,
    /// Ask a model that `goodbot learn` wrote, and train none
    #[arg(long, short = 'w', value_name = "MODEL", value_hint = ValueHint::FilePath, conflicts_with_all = ["leave_one_out", "k_fold", "group", "leave_environment_out", "leave_task_out", "learner", "ablation", "curve"])]
    with: Option<PathBuf>,
    /// For every session, train on all the others (the default up to 500 sessions)
    #[arg(long, conflicts_with_all = ["k_fold", "group", "leave_environment_out", "leave_task_out"])]
    leave_one_out: bool,
    /// Train on all but one of K parts, in turn; K is 2 or more (10 is the default for more than 500 sessions)
    #[arg(long, short = 'k', value_name = "K", value_parser = between(2_usize, 65_535))]
    k_fold: Option<usize>,
    /// Leave out whole groups of sessions with this in common: each group in turn, or each of K parts of groups
    #[arg(long, short = 'g', value_enum, value_name = "WHAT", conflicts_with_all = ["leave_environment_out", "leave_task_out"])]
    group: Option<Group>,
    /// For every environment, train on the sessions in all the others
    #[arg(long, conflicts_with_all = ["k_fold", "leave_task_out"])]
    leave_environment_out: bool,
    /// For every environment and task, train on the sessions with another environment or task
    #[arg(long, conflicts_with = "k_fold")]
    leave_task_out: bool,
    #[command(flatten)]
    kinds: TaskKinds,
    #[command(flatten)]
    synonyms: SynonymOptions,
    /// Ask each command in N random layouts of its home; N is 1 to 100
    #[arg(long, value_name = "N", value_parser = between(1_usize, 100))]
    novel_environments: Option<usize>,
    /// The language model
    #[arg(long, value_enum, value_name = "NAME", default_value_t)]
    learner: Learner,
    #[command(flatten)]
    starter: StarterOptions,
    /// Compare the default with the same without one choice at a time, in a table
    #[arg(long, conflicts_with_all = ["learner", "plot", "curve"])]
    ablation: bool,
    /// Seed of the parts, layouts and curves [default: 1]
    #[arg(long, short = 's', value_name = "S", value_parser = between(0, u64::MAX))]
    seed: Option<u64>,
    /// Write a reliability diagram: how often answers are right, against how sure they are; - is standard output
    #[arg(long, value_name = "FILE.svg", value_hint = ValueHint::FilePath)]
    plot: Option<PathBuf>,
    /// Write accuracy against the number of training sessions as a picture; - is standard output
    #[arg(long, value_name = "FILE.svg", value_hint = ValueHint::FilePath, conflicts_with = "test")]
    curve: Option<PathBuf>,
    /// Orders of the sessions that a learning curve is averaged over, 1 to 1000 [default: 10]
    #[arg(long, short = 'n', value_name = "N", requires = "curve", value_parser = between(1_usize, 1_000))]
    runs: Option<usize>,
    /// Replace files that goodbot did not write
    #[arg(long)]
    force: bool,
    /// Ask sessions without "intended", too, where the steps alone make a task more probable than P, and count it as meant; P is 0.5 to
    /// less than 1
    #[arg(long, value_name = "P", value_parser = goodbot_console::typed::clear, conflicts_with_all = ["novel_environments", "ablation", "curve"])]
    clear: Option<f32>,
    #[command(flatten)]
    limit: Limit,
    /// Skip sessions with faults, and count them
    #[arg(long)]
    keep_going: bool,
    /// Print JSON lines: one for each command asked, and a summary at the end
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
A session teaches the posterior over tasks that its steps give, without any word. The intended task only counts \
right answers; in labelled sessions it is the lesson. A demonstration that ends at its goal counts as if the robot \
had rested there for one more step.

Beside the accuracy:
  interval           95 % (Wilson)
  log loss           the mean of -ln of the probability of the intended task
  without words      a learner that sees the scene and the intended task, but no word
  by chance          the mean probability of the intended task before any learning
  without copies     the accuracy for commands that are no copy of a training session
  by the steps       with --clear: the accuracy where the steps told what was meant; the other figures are without
                     these commands, unless there are no others
  steps alone        training sessions whose steps, without any word, point at the intended task
  calibration error  the mean difference between certainty and accuracy

With --with, the model's training data are unknown, so a learner without words and copies are not reported \
(null in JSON).

Examples:
  goodbot evaluate turk-simplified.jsonl
  goodbot evaluate half.jsonl --test other-half.jsonl --plot reliability.svg
  goodbot evaluate --with words.goodbot --test log.jsonl
  goodbot evaluate expert.jsonl --task \"agentInRoom(?a,?r1) & blockInRoom(?o,?r2)\"
  goodbot evaluate feedback.jsonl --group worker
  goodbot evaluate turk-original.jsonl --leave-environment-out
  goodbot evaluate turk-original.jsonl --synonyms words.txt
  goodbot evaluate turk-simplified.jsonl --k-fold 10 --learner roles
  goodbot evaluate turk-simplified.jsonl --curve curve.svg --runs 20
  goodbot evaluate turk-simplified.jsonl --curve curve.svg --starter en
  goodbot evaluate turk-simplified.jsonl --ablation";

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &EvaluateOptions) -> Result<(), Failure> {
    let lifted = match &options.with {
        Some(model) => options.kinds.of_model(model)?,
        None => options.kinds.lifted()?,
    };
    if options.force && options.plot.is_none() && options.curve.is_none() {
        return Err(Failure::Input(
            "--force has no effect here: nothing is written. It is for --plot and --curve; leave it out".to_owned(),
        ));
    }
    if options.synonyms.is_given() && options.curve.is_some() {
        return Err(Failure::Input("--synonyms is not for --curve; leave one of them out".to_owned()));
    }
    let inputs = || options.files.iter().chain(&options.test).map(AsRef::as_ref).chain(options.with.as_deref());
    let [plot, curve] = [&options.plot, &options.curve].map(|path| Output::picture(path, inputs(), options.force));
    let (plot, curve) = (plot?, curve?);
    let mut out = output::text(&[plot.as_ref(), curve.as_ref()])?;
    if options.ablation {
        return ablation(options, &lifted, &mut out);
    }
    let agent = match &options.with {
        Some(model) => options_of_model(model)?,
        None => options.learner.options(),
    };
    let sessions = Sessions::read(options, &lifted, agent)?;
    let (answers, summary) = sessions.answers(options, &lifted, agent)?;
    sessions.tell_copies(&answers);
    // Pictures come first, so that they are written even if the reader of the text stops early.
    reliability(plot.as_ref(), &summary)?;
    report::print(&mut out, &answers, &summary, options.json).or_else(unheard)?;
    if let Some(curve) = &curve {
        let runs = options.runs.unwrap_or(10);
        let points = curve::points(&sessions.taught.lessons, &sessions.starter, agent.language, runs, options.seed())?;
        curve.draw(curve::draw(&points, runs))?;
        if !options.json {
            report::print_curve(&mut out, &points)?;
        }
    }
    Ok(out.flush()?)
}

/// A reader who stops early is no fault. Files that are still to be written are written.
fn unheard(error: io::Error) -> io::Result<()> {
    if error.kind() == io::ErrorKind::BrokenPipe { Ok(()) } else { Err(error) }
}

/// The axes of the reliability diagram.
const SURE: &str = "% sure of the predicted task, on average";
const RIGHT: &str = "% right, with 95 % interval";

fn reliability(plot: Option<&Output>, summary: &Summary) -> Result<(), Failure> {
    let Some(plot) = plot else { return Ok(()) };
    let caption = format!("How sure, and how often right: {}", counted(summary.score.asked, "command"));
    plot.draw(calibration::draw(&summary.ranges, &caption, SURE, RIGHT))
}

fn ablation(options: &EvaluateOptions, lifted: &[LiftedTask], out: &mut impl Write) -> Result<(), Failure> {
    let mut rows = Vec::new();
    for (name, agent) in method::ablations() {
        let sessions = Sessions::read(options, lifted, agent)?;
        let (_, summary) = sessions.answers(options, lifted, agent)?;
        rows.push((name, summary));
    }
    report::ablation(out, &rows, options.json)?;
    Ok(out.flush()?)
}

/// The sessions to train on, and others to ask, if there are any.
struct Sessions {
    taught: Lessons,
    asked: Option<Lessons>,
    starter: Starter,
}

impl Sessions {
    fn read(options: &EvaluateOptions, lifted: &[LiftedTask], agent: Options) -> Result<Self, Failure> {
        let log_options = LogOptions { keep_going: options.keep_going, limit: options.limit, ..LogOptions::default() };
        let read = |files: &[InputFile]| Ok::<_, Failure>(options.cleared(training_data::read(files, lifted, agent, &log_options)?));
        let (taught, asked) = match (&options.with, options.test.as_slice()) {
            (Some(_), []) if options.files.is_empty() => {
                return Err(Failure::Input("there is nothing to ask the model; name a session log with --test".to_owned()));
            }
            // A model that was trained before is asked all sessions.
            (Some(_), test) => (Lessons::default(), Some(read(&[&options.files, test].concat())?)),
            (None, []) => (read(&options.files)?, None),
            (None, test) => (read(&options.files)?, Some(read(test)?)),
        };
        Ok(Self { taught, asked, starter: options.starter.read(lifted, agent)? })
    }

    /// The sessions that are asked.
    fn asked(&self) -> &[Lesson] {
        &self.asked.as_ref().unwrap_or(&self.taught).lessons
    }

    /// Whether the commands that are asked are in worlds from files.
    fn are_of_worlds(&self) -> bool {
        self.asked().iter().any(|lesson| lesson.world.is_some())
    }

    /// Whether a robot acts in all of their places.
    fn act(&self) -> bool {
        self.asked().iter().all(|lesson| lesson.acts)
    }

    /// Remarks on the sessions that were read.
    ///
    /// # Errors
    /// [`Failure::Input`] if no question has an intended task.
    fn about(&self) -> Result<SessionCounts, Failure> {
        let unknown = self.asked().iter().filter(|lesson| lesson.intended.is_none()).count();
        if unknown == self.asked().len() {
            let message = "no session has an intended task, so no answer can be checked; add \"intended\" to the session \
                           lines, take what the steps make probable with --clear 0.9, or ask one command at a time with goodbot ask";
            return Err(Failure::Input(message.to_owned()));
        }
        if unknown > 0 {
            say!("{} not asked: without \"intended\", the answer cannot be checked", counted(unknown, "session"));
        }
        let evidence: Vec<bool> = self.taught.lessons.iter().filter_map(Lesson::evidence_is_right).collect();
        let (asked_skipped, asked_way) = self.asked.as_ref().map_or((0, 0), |asked| (asked.skipped, asked.with_way));
        Ok(SessionCounts {
            is_given: self.taught.lessons.is_empty(),
            taught: self.taught.lessons.iter().filter(|lesson| lesson.learn).count(),
            skipped: self.taught.skipped + asked_skipped,
            with_way: self.taught.with_way + asked_way,
            unknown,
            long: self.taught.long + self.asked.as_ref().map_or(0, |asked| asked.long),
            evidence: (evidence.iter().filter(|&&right| right).count(), evidence.len()),
        })
    }

    fn answers(&self, options: &EvaluateOptions, lifted: &[LiftedTask], agent: Options) -> Result<(Vec<folds::Answer>, Summary), Failure> {
        let about = self.about()?;
        let rounds: Vec<(Vec<usize>, Vec<usize>)> = match &self.asked {
            Some(asked) => vec![(vec![], (0..asked.lessons.len()).collect())],
            None => {
                let parts = options.split(&self.taught.lessons).parts(&self.taught.lessons, options.seed()).map_err(Failure::Input)?;
                parts.into_iter().map(|part| (part.clone(), part)).collect()
            }
        };
        options.refuse_idle_seed(&self.taught.lessons)?;
        if self.are_of_worlds() && options.novel_environments.is_some() {
            return Err(Failure::Input("--novel-environments is for homes: a world from a file has no other layout".to_owned()));
        }
        // Commands in other layouts are no copies.
        let copies = match options.novel_environments {
            Some(_) => vec![None; self.asked().len()],
            None => split::find(&self.taught.lessons, self.asked(), &rounds, self.asked.is_none()),
        };
        let experiment = Experiment {
            taught: &self.taught.lessons,
            asked: self.asked(),
            rounds,
            copies,
            synonyms: options.synonyms.read()?,
            starter: &self.starter,
            novel: options.novel(lifted, agent)?,
        };
        let answers = match &options.with {
            Some(model) => experiment.ask(&mut self.restored(options, model, lifted, &mut AgentHeap::new(&Capacities::NONE))?)?,
            None => experiment.run(agent.language)?,
        };
        let summary = Summary::of(&answers, about);
        Ok((answers, summary))
    }

    /// A model that was trained before, for the places of these sessions.
    fn restored<'m>(
        &self,
        options: &EvaluateOptions,
        file: &Path,
        lifted: &[LiftedTask],
        memory: &'m mut AgentHeap,
    ) -> Result<Trained<'m>, Failure> {
        if !self.are_of_worlds() {
            return Ok(Trained::Robot(Box::new(restored::agent_beside(file, lifted, &self.starter)?)));
        }
        if options.starter.is_given() {
            return Err(Failure::Input("--starter is for homes; leave it out in a world from a file".to_owned()));
        }
        Ok(Trained::Model(Box::new(restored::language(file, memory, self.asked(), self.act())?)))
    }

    /// Names the first copies of training sessions.
    fn tell_copies(&self, answers: &[folds::Answer]) {
        const MOST: usize = 5;
        let mut copies: Vec<(&str, &str)> =
            answers.iter().filter_map(|answer| Some((answer.id.as_str(), answer.copy_of.as_deref()?))).collect();
        copies.dedup();
        if copies.is_empty() {
            return;
        }
        let named: Vec<String> =
            copies.iter().take(MOST).map(|(id, of)| format!("{} of {}", id.escape_debug(), of.escape_debug())).collect();
        let more = if copies.len() > MOST { format!(" and {} more", copies.len() - MOST) } else { String::new() };
        let what = if self.asked.is_some() { "the same id, or the same content" } else { "the same content" };
        say!("copies of sessions trained on ({what}), which make the accuracy too good: {}{more}", named.join(", "));
    }
}

impl EvaluateOptions {
    fn seed(&self) -> u64 {
        self.seed.unwrap_or(1)
    }

    fn split(&self, lessons: &[Lesson]) -> Split {
        let grouped = !self.leave_one_out && lessons.iter().any(|lesson| lesson.group.is_some());
        let group = match (self.leave_environment_out, self.leave_task_out) {
            (true, _) => Some(Group::Environment),
            (_, true) => Some(Group::Task),
            _ => self.group.or(grouped.then_some(Group::Logged)),
        };
        let many = lessons.len() > MOST_LEFT_OUT_ONE_BY_ONE && group.is_none() && !self.leave_one_out;
        let most = (group == Some(Group::Logged)).then_some(PARTS);
        Split { group, parts: self.k_fold.or(many.then_some(PARTS)), most }
    }

    /// A seed without anything to draw is a mistake.
    fn refuse_idle_seed(&self, lessons: &[Lesson]) -> Result<(), Failure> {
        let split = self.split(lessons);
        let in_parts = self.with.is_none() && self.test.is_empty() && (split.parts.is_some() || split.most.is_some());
        let draws = self.novel_environments.is_some() || self.curve.is_some() || in_parts;
        if self.seed.is_some() && !draws {
            let message = "--seed has no effect here: nothing is drawn. It is for --k-fold, --novel-environments and --curve; leave it out";
            return Err(Failure::Input(message.to_owned()));
        }
        Ok(())
    }

    /// The sessions, with the intended tasks that their steps tell.
    fn cleared(&self, mut read: Lessons) -> Lessons {
        if let Some(clear) = self.clear {
            read.lessons = read.lessons.into_iter().map(|lesson| lesson.told_by_steps(clear)).collect();
        }
        read
    }

    fn novel<'l>(&self, lifted: &'l [LiftedTask], agent: Options) -> Result<Option<Novel<'l>>, Failure> {
        Ok(self.novel_environments.map(|count| Novel::new(lifted, agent, count, self.seed())))
    }
}
