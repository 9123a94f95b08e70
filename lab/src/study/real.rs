//! What real trainers said, from session logs: each action judged for what they meant.

use crate::study::trainer::population::{Observed, Record};
use goodbot::memory::AgentHeap;
use goodbot::planning::OptimalSet;
use goodbot::{Agent, Capacities, Options, home::paper_tasks};
use goodbot_console::load::input;
use goodbot_console::outcome::Failure;
use goodbot_formats::session::{Kind, RecordedSession, SessionReader};
use goodbot_lesson::checked::check;
use goodbot_lesson::replay::{Event, Replay, Rules};
use goodbot_lesson::{Fault, home};

/// The trainers of some logs, each with a name.
pub type People = Vec<(String, Record)>;

/// The person of a session: its name up to the first `.`, or else up to the last `-`.
fn person(id: &str) -> &str {
    id.split_once('.').or_else(|| id.rsplit_once('-')).map_or(id, |(person, _)| person)
}

/// Reads logs. Only sessions with feedback count, of which it is known what was meant.
///
/// # Errors
/// [`Failure::Input`] names the file and what is wrong with it.
pub fn read(files: &[String]) -> Result<People, Failure> {
    let failed = |faults: Vec<Fault>| Failure::Input(faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"));
    let mut judge = Judge::new()?;
    let mut people = People::new();
    for file in files {
        let name = input::name(file);
        for recorded in SessionReader::new(input::log(file).map_err(|fault| failed(vec![fault]))?) {
            let recorded = recorded.map_err(|error| failed(vec![Fault::from_format(name, error)]))?;
            if recorded.header.kind != Kind::Feedback || recorded.header.intended.is_none() {
                continue;
            }
            let who = recorded.header.id.as_deref().map_or(name, person).to_owned();
            let lesson = judge.lesson(name, &recorded).map_err(failed)?;
            let position = people.iter().position(|(known, _)| *known == who).unwrap_or_else(|| {
                people.push((who, Record::default()));
                people.len() - 1
            });
            let record = &mut people[position].1;
            // What is gone on with was not the end.
            if let Some(last) = record.ended.last_mut().filter(|_| recorded.header.continues) {
                *last = false;
            }
            record.lessons.push(lesson);
            record.ended.push(true);
        }
    }
    match people.is_empty() {
        true => Err(Failure::Input("no session with feedback has an intended task; name other logs".to_owned())),
        false => Ok(people),
    }
}

/// Plans for what was meant.
struct Judge(Agent<AgentHeap>);

impl Judge {
    fn new() -> Result<Self, Failure> {
        let lifted = paper_tasks().map_err(|error| Failure::Result(error.to_string()))?;
        let agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), &lifted, Options::PAPER);
        agent.map(Self).map_err(|error| Failure::Result(error.to_string()))
    }

    fn lesson(&mut self, file: &str, recorded: &RecordedSession) -> Result<Vec<Observed>, Vec<Fault>> {
        let agent = &mut self.0;
        let session = check(file, recorded, agent.lifted(), home::memory())?;
        let Some(intended) = session.intended else { return Ok(Vec::new()) };
        let (mut replay, mut observed) = (Replay::new(Rules::PLANS), Vec::new());
        loop {
            let event = replay.advance(agent, &session.walk, u32::MAX);
            match event.map_err(|refused| vec![Fault::on_line(file, refused.line, refused.error)])? {
                Event::Ended => return Ok(observed),
                Event::Planned(Some(step)) => {
                    let right = agent.planned().optimal(intended);
                    let correct = right.exact().is_some_and(|actions| actions.contains(step.action));
                    observed.push(Observed { correct, at_goal: right == OptimalSet::Goal, said: step.feedback });
                }
                _ => {}
            }
        }
    }
}
