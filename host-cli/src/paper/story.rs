//! Tells one run as it happens: the home, the command, the agent's belief and actions, and the trainer's feedback.

use super::experiment::{Run, run_seed};
use super::options::PaperOptions;
use crate::words::Lexicon;
use goodbot::Agent;
use goodbot::feedback::Feedback;
use goodbot::home::Map;
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::oomdp::action_name;
use goodbot::planning::OptimalSet;
use goodbot_console::{Failure, name_of};
use goodbot_course::{CourseTrainer, Ending, LESSONS, LessonReport, Observer, Scene, Step, TESTS, TestReport};
use goodbot_lesson::name::in_words;
use std::io::{self, Write};

/// The beginning of a line with a remark on a step.
const NOTE: &str = "               ";

/// Cells of a belief's bar.
const BAR: usize = 18;

/// Runs one seed and tells it as it happens. If the reader stops early, the run goes on. Returns the run's result, then the result of
/// writing.
///
/// # Errors
/// [`Failure`] if the run itself failed.
pub fn tell(options: &PaperOptions, out: &mut impl Write) -> Result<((Run, Lexicon), io::Result<()>), Failure> {
    let begun = begin(options, out);
    let mut story = Story { out, failed: begun.err(), shown: false };
    let run = run_seed(options, options.seed, &mut story)?;
    Ok((run, story.failed.map_or(Ok(()), Err)))
}

fn begin(options: &PaperOptions, out: &mut impl Write) -> io::Result<()> {
    let CourseTrainer { strategy, rewards, punishes } = options.trainer.trainer;
    writeln!(out, "An agent that knows no word goes through {} lessons and {} tests.", LESSONS.len(), TESTS.len())?;
    writeln!(
        out,
        "Its trainer ({}) is silent after a right action with probability {},\nafter a wrong one with {}, and takes one for the other with {}.\nSeed {}, {} homes.",
        options.trainer.name,
        strategy.mu_plus(),
        strategy.mu_minus(),
        strategy.epsilon(),
        options.seed,
        name_of(options.homes()),
    )?;
    if !rewards {
        writeln!(out, "It never rewards: where another would, it is silent.")?;
    }
    if !punishes {
        writeln!(out, "It never punishes: where another would, it is silent.")?;
    }
    let believed = options.believed().trainer.strategy;
    let [plus, minus, epsilon] = [believed.mu_plus(), believed.mu_minus(), believed.epsilon()];
    writeln!(out, "The agent thinks that a trainer is silent with {plus} and {minus}, and mistaken\nwith {epsilon}.")?;
    writeln!(out, "In the drawings @ is the agent, # wall, + a door, a capital letter a block,\na small one the room's colour.")
}

struct Story<'w, W> {
    out: &'w mut W,
    /// The first write error; nothing is written after it.
    failed: Option<io::Error>,
    /// Whether the home of the tests has been shown.
    shown: bool,
}

impl<W: Write> Story<'_, W> {
    fn write(&mut self, tell: impl FnOnce(&mut W) -> io::Result<()>) {
        if self.failed.is_none() {
            self.failed = tell(self.out).err();
        }
    }
}

impl<W: Write> Observer for Story<'_, W> {
    fn lesson_begins(&mut self, scene: &Scene<'_, impl HomeMemory, impl AgentMemory>) {
        self.write(|out| {
            writeln!(out, "\nLesson {} of {}\n", scene.number + 1, LESSONS.len())?;
            home(out, scene)?;
            writeln!(out, "\n  Trainer: \"{}\"\n  What it may mean, to the agent:", scene.exercise.command)?;
            beliefs(out, scene)
        });
    }

    fn acted(&mut self, scene: &Scene<'_, impl HomeMemory, impl AgentMemory>, step: &Step) {
        self.write(|out| {
            let number = |task| scene.agent.belief().probability(task);
            let best = (0..scene.agent.tasks().len()).max_by(|&a, &b| number(a).total_cmp(&number(b))).unwrap_or(0);
            let said = match step.feedback {
                Feedback::Reward => "\"good bot\"",
                Feedback::Punish => "\"bad bot\"",
                Feedback::Neutral => "",
            };
            let followed = task_in_words(scene, step.decision.task);
            let action = action_name(scene.home, step.decision.action);
            writeln!(out, "    {action:<6} for {followed:<39} {said:<10}  now {:.3}", number(step.decision.task))?;
            if matches!(step.decision.plan, OptimalSet::DeadEnd(_)) {
                writeln!(out, "{NOTE}which cannot be done any more")?;
            }
            if best != step.decision.task {
                writeln!(out, "{NOTE}likelier now: {:.3} {}", number(best), task_in_words(scene, best))?;
            }
            Ok(())
        });
    }

    fn lesson_ends(&mut self, _number: usize, _agent: &Agent<impl AgentMemory>, report: &LessonReport) {
        self.write(|out| {
            let ending = match report.ending {
                Ending::AtGoal => "done as meant",
                Ending::DeadEnd => "it cannot be done any more",
                Ending::TooLong => "the trainer gave up",
            };
            let feedback = report.feedback;
            let understood = if report.understood { "understood on hearing" } else { "not understood on hearing" };
            writeln!(
                out,
                "  {understood}; {ending}\n  after {} steps, {} \"good bot\", {} \"bad bot\"",
                report.steps, feedback.reward, feedback.punish
            )
        });
    }

    fn tested(&mut self, scene: &Scene<'_, impl HomeMemory, impl AgentMemory>, report: &TestReport) {
        let first = !std::mem::replace(&mut self.shown, true);
        self.write(|out| {
            if first {
                writeln!(out, "\nTests: a new home, no feedback, no learning; two of the commands are new\n")?;
                home(out, scene)?;
            }
            writeln!(out, "\n  \"{}\": {}", scene.exercise.command, if report.right { "right" } else { "wrong" })?;
            beliefs(out, scene)
        });
    }
}

fn home(out: &mut impl Write, scene: &Scene<'_, impl HomeMemory, impl AgentMemory>) -> io::Result<()> {
    for line in Map::new(scene.home, scene.state).to_string().lines() {
        writeln!(out, "    {line}")?;
    }
    Ok(())
}

/// Prints each task with its probability as a bar, and marks the intended one.
fn beliefs(out: &mut impl Write, scene: &Scene<'_, impl HomeMemory, impl AgentMemory>) -> io::Result<()> {
    for task in 0..scene.agent.tasks().len() {
        let probability = scene.agent.belief().probability(task);
        let cells = (probability * BAR as f32).round() as usize;
        let meant = if task == scene.intended { "  <- meant" } else { "" };
        let bar = format!("{}{}", "█".repeat(cells), "·".repeat(BAR.saturating_sub(cells)));
        writeln!(out, "    {bar} {probability:.3}  {}{meant}", task_in_words(scene, task))?;
    }
    Ok(())
}

/// A task in everyday words.
fn task_in_words(scene: &Scene<'_, impl HomeMemory, impl AgentMemory>, task: usize) -> String {
    let agent = scene.agent;
    let Some(task) = agent.tasks().get(task) else { return String::new() };
    agent.lifted().get(usize::from(task.lifted)).map_or_else(String::new, |lifted| in_words(scene.home, lifted, task))
}
