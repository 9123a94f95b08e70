//! Posterior-predictive checks: lessons of simulated trainers, beside those of the real trainers that they were fitted to.
//!
//! For each real person, similar people are drawn. Each goes through the same recorded actions and gives feedback. The rates after right
//! and wrong actions were fitted; the other figures were not, and show what the fit misses.

use super::StudyOptions;
use super::trainer::Listening;
use super::trainer::population::{Counts, Observed, Population, Record};
use crate::recorded;
use crate::recorded::WalkStep;
use goodbot::feedback::{Feedback, Judged};
use goodbot::home::paper_tasks;
use goodbot_console::{Failure, InputFile};
use goodbot_course::generator;
use std::io::Write;

/// The measures, and whether each was fitted.
const MEASURES: [(&str, bool); 11] = [
    ("reward after a right action", true),
    ("punishment after a right action", true),
    ("silence after a right action", true),
    ("reward after a wrong action", true),
    ("punishment after a wrong action", true),
    ("silence after a wrong action", true),
    ("reward while resting at the goal", false),
    ("silence while resting at the goal", false),
    ("a word directly after a word", false),
    ("a word after the first action", false),
    ("lessons without a word", false),
];

/// The least number of draws: fewer would give no 95 % interval.
const DRAWS: u32 = 100;

/// The measures of lessons, as shares; `None` without an occasion.
fn measured<'l>(lessons: impl Iterator<Item = &'l [Observed]> + Clone) -> [Option<f64>; MEASURES.len()] {
    let share = |occasion: &dyn Fn(&[Observed], usize) -> Option<bool>| {
        let answers = lessons.clone().flat_map(|lesson| (0..lesson.len()).filter_map(|step| occasion(lesson, step)));
        let (mut all, mut yes) = (0_usize, 0_usize);
        for answer in answers {
            all += 1;
            yes += usize::from(answer);
        }
        (all > 0).then(|| yes as f64 / all as f64)
    };
    let said =
        |correct: bool, word: Feedback| share(&move |lesson, step| (lesson[step].correct == correct).then(|| lesson[step].said == word));
    let resting =
        |word: Feedback| share(&move |lesson, step| (lesson[step].at_goal && lesson[step].correct).then(|| lesson[step].said == word));
    let speaks = |observed: &Observed| observed.said != Feedback::Neutral;
    let [reward, punish, silence] = [Feedback::Reward, Feedback::Punish, Feedback::Neutral];
    [
        said(true, reward),
        said(true, punish),
        said(true, silence),
        said(false, reward),
        said(false, punish),
        said(false, silence),
        resting(reward),
        resting(silence),
        share(&|lesson, step| step.checked_sub(1).filter(|&before| speaks(&lesson[before])).map(|_| speaks(&lesson[step]))),
        share(&|lesson, step| (step == 0).then(|| speaks(&lesson[step]))),
        share(&|lesson, step| (step == 0).then(|| !lesson.iter().any(speaks))),
    ]
}

/// The same actions, with the feedback of another person.
fn simulated(record: &Record, population: &Population, like: &Counts, seed: u64) -> Vec<Vec<Observed>> {
    let mut random = generator(seed);
    let habits = population.another(like, &mut random);
    let lesson = |lesson: &Vec<Observed>| {
        let mut trainer = Listening::new(habits);
        lesson.iter().map(|&observed| Observed { said: trainer.says(observed.correct, &mut random), ..observed }).collect()
    };
    record.lessons.iter().map(lesson).collect()
}

/// For each measure, the real share, the mean of the simulated shares, and their central 95 %.
struct Check {
    real: [Option<f64>; MEASURES.len()],
    simulated: [Option<(f64, f64, f64)>; MEASURES.len()],
}

impl Check {
    /// The measures, whether each was fitted, and the real and simulated percentages as text.
    fn rows(&self) -> impl Iterator<Item = (&'static str, bool, String, String)> + '_ {
        MEASURES.iter().zip(self.real).zip(self.simulated).map(|((&(measure, fitted), real), simulated)| {
            let real = real.map_or("-".to_owned(), |real| format!("{:.1}", 100.0 * real));
            let drawn = |(mean, low, high)| format!("{:.1} ({:.1} to {:.1})", 100.0 * mean, 100.0 * low, 100.0 * high);
            (measure, fitted, real, simulated.map_or("-".to_owned(), drawn))
        })
    }
}

fn check(people: &People, population: &Population, options: &StudyOptions) -> Check {
    let real = measured(people.iter().flat_map(|(_, record)| record.lessons.iter().map(Vec::as_slice)));
    let mut draws: [Vec<f64>; MEASURES.len()] = Default::default();
    for run in 0..u64::from(options.runs.max(DRAWS)) {
        let lessons: Vec<Vec<Observed>> = (0_u64..)
            .zip(people.iter().zip(&population.people))
            .flat_map(|(number, ((_, record), like))| {
                simulated(record, population, like, options.seed.wrapping_add(run).wrapping_mul(1_000_003).wrapping_add(number))
            })
            .collect();
        for (draws, share) in draws.iter_mut().zip(measured(lessons.iter().map(Vec::as_slice))) {
            draws.extend(share);
        }
    }
    let summary = |mut draws: Vec<f64>| {
        draws.sort_by(f64::total_cmp);
        let at = |share: f64| draws.get((share * (draws.len() - 1) as f64).round() as usize).copied().unwrap_or(0.0);
        (!draws.is_empty()).then(|| (draws.iter().sum::<f64>() / draws.len() as f64, at(0.025), at(0.975)))
    };
    Check { real, simulated: draws.map(summary) }
}

/// Fits trainers to logs, and prints the fit and the checks.
///
/// # Errors
/// [`Failure`].
pub fn show(out: &mut impl Write, options: &StudyOptions) -> Result<(), Failure> {
    let people = read(&options.fit)?;
    let records: Vec<Record> = people.iter().map(|(_, record)| record.clone()).collect();
    let population = Population::fit(&records);
    let check = check(&people, &population, options);
    writeln!(out, "{} people. Counts that were fitted: rewards, punishments, silences after right and after wrong actions;", people.len())?;
    writeln!(out, "steps after which the lesson was over and was not, at the goal and elsewhere.\n")?;
    for ((name, _), Counts { right, wrong, at_goal, elsewhere }) in people.iter().zip(&population.people) {
        let [right, wrong] = [right, wrong].map(|all| all.map(|count| format!("{count:6.1}")).join(" "));
        let [at_goal, elsewhere] = [at_goal, elsewhere].map(|all| all.map(|count| format!("{count:4.0}")).join(" "));
        writeln!(out, "{name:<12} right {right}   wrong {wrong}   at goal {at_goal}   elsewhere {elsewhere}")?;
    }
    let [now, before, earlier] = population.late.map(|share| 100.0 * share);
    writeln!(
        out,
        "\nOf the words, {now:.1} % judge the last action, {before:.1} % the one before, and {earlier:.1} % the one before that.\n"
    )?;
    writeln!(out, "| percentage of occasions | real | simulated, 95 % of draws |\n|---|---:|---:|")?;
    for (measure, fitted, real, simulated) in check.rows() {
        writeln!(out, "| {measure}{} | {real} | {simulated} |", if fitted { " (fitted)" } else { "" })?;
    }
    Ok(())
}

/// The trainers of some logs, each with a name.
pub type People = Vec<(String, Record)>;

/// The person of a session: its id up to the first `.`, or else up to the last `-`.
fn person(id: &str) -> &str {
    id.split_once('.').or_else(|| id.rsplit_once('-')).map_or(id, |(person, _)| person)
}

/// Reads logs. Only sessions with feedback and a known intended task count.
///
/// # Errors
/// [`Failure::Input`] names the file and its fault.
pub fn read(files: &[InputFile]) -> Result<People, Failure> {
    let mut people = People::new();
    for walk in recorded::read(files, &paper_tasks()?)? {
        let Some(intended) = walk.intended else { continue };
        let who = walk.id.as_deref().map_or(walk.trainer.as_str(), person);
        let position = people.iter().position(|(known, _)| known == who).unwrap_or_else(|| {
            people.push((who.to_owned(), Record::default()));
            people.len() - 1
        });
        let record = &mut people[position].1;
        // A session that was continued had not ended.
        if let Some(last) = record.ended.last_mut().filter(|_| walk.continues) {
            *last = false;
        }
        let observed = |step: &WalkStep| Observed {
            correct: matches!(step.judged[intended], Judged::Nearer | Judged::RestsAtGoal),
            at_goal: step.began[intended] == Some(true),
            said: step.feedback,
        };
        record.lessons.push(walk.steps.iter().map(observed).collect());
        record.ended.push(true);
    }
    match people.is_empty() {
        true => Err(Failure::Input("no session with feedback has an intended task; name other logs".to_owned())),
        false => Ok(people),
    }
}
