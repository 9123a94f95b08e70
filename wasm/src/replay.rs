//! The replay of a recorded session: the same command in the same home, the same actions and the same feedback teach the same.
//!
//! The strict reader of logs is large: the page reads their lines itself, and hands over their contents.

use crate::log::task_name;
use crate::world::{MIND, ROOMS, Refusal, Replaying, World, build};
use goodbot::feedback::Feedback;
use goodbot::home::Home;
use goodbot::memory::HomeMemory;
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, ground};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::{FeedbackWord, Kind, RecordedAnswer, RecordedSession, StrategyRecord};
use goodbot_lesson::replay::{Event, Replay, Rules};
use goodbot_lesson::walk::{Expected, SessionAnswer, Step, Walk};
use wasm_bindgen::prelude::*;

/// Tasks, each with its name.
pub(crate) fn with_names<M: HomeMemory>(home: &Home<M>, lifted: &[LiftedTask], tasks: &[GroundedTask]) -> Vec<(GroundedTask, String)> {
    let named = |task: &GroundedTask| Some((*task, task_name(home, lifted.get(usize::from(task.lifted))?, task)));
    tasks.iter().filter_map(named).collect()
}

pub(crate) fn not_begun() -> Refusal {
    Refusal("no recorded session was begun".to_owned())
}

impl World {
    /// Adds the trainer strategies that the session names.
    ///
    /// # Errors
    /// Where no session was begun.
    pub fn recorded_strategies(&mut self, strategies: Vec<Expected>) -> Result<(), Refusal> {
        self.replaying.as_mut().ok_or_else(not_begun)?.walk.strategies = Some(strategies);
        Ok(())
    }

    /// Replays a session that a host has read, and learns from it if its record says so.
    ///
    /// # Errors
    /// Why the session cannot be replayed; the training data are kept.
    pub fn replay(&mut self, recorded: &RecordedSession) -> Result<(), Refusal> {
        self.tell(recorded)?;
        while !self.replay_on(u32::MAX, recorded.learn)? {}
        while !self.learn(u32::MAX) {}
        Ok(())
    }

    /// Hands over a session that a host has read, in the same order as the page.
    ///
    /// # Errors
    /// Why it is no session here.
    pub fn tell(&mut self, recorded: &RecordedSession) -> Result<(), Refusal> {
        let header = &recorded.header;
        self.set_pulls(header.action_names().any(|name| name == "pull"))?;
        let shown = header.kind == Kind::Demonstration;
        self.begin_recorded(&header.environment.to_json_line(), &header.command, shown, header.continues)?;
        if let Some(records) = &header.strategies {
            let most = records.iter().map(|record| record.prior).fold(0.0, f64::max);
            let expected = |record: &StrategyRecord| Expected::new(record, most).map_err(Refusal::from);
            self.recorded_strategies(records.iter().map(expected).collect::<Result<_, _>>()?)?;
        }
        if let Some(prior) = &header.prior {
            let most = prior.iter().map(|(_, share)| *share).fold(0.0, f64::max);
            let (names, shares): (Vec<_>, Vec<_>) = prior.iter().map(|(task, share)| (task.to_string(), (share / most) as f32)).unzip();
            self.recorded_prior(&names.join("\n"), &shares)?;
        }
        if let Some(utterance) = &header.utterance {
            let after = header.after.as_ref().map(ToString::to_string);
            self.recorded_listening(utterance, after.as_deref(), header.conversation.as_deref().unwrap_or_default())?;
        }
        for done in 0..=recorded.steps.len() {
            for RecordedAnswer { answer, .. } in recorded.answers_after(done) {
                let names: Vec<String> = answer.tasks.iter().map(ToString::to_string).collect();
                let words = answer.words.as_deref().unwrap_or_default();
                self.recorded_answer(&names.join("\n"), answer.yes, answer.eta as f32, answer.others, words)?;
            }
            if let Some((_, step)) = recorded.steps.get(done) {
                self.recorded_step(&step.action, step.feedback.map_or("", FeedbackWord::as_str))?;
            }
        }
        Ok(())
    }
}

#[wasm_bindgen(js_class = "Goodbot")]
impl World {
    /// Adds the prior of the tasks with these names in logs, one a line, in any unit up to 1; 0 for the others.
    ///
    /// # Errors
    /// A name that is no task's.
    #[wasm_bindgen(js_name = recordedPrior)]
    pub fn recorded_prior(&mut self, tasks: &str, prior: &[f32]) -> Result<(), Refusal> {
        let told = self.replaying.as_mut().ok_or_else(not_begun)?;
        let named = |(name, share): (&str, f32)| {
            let known = told.tasks.iter().find(|(_, known)| known == name);
            known.map(|&(task, _)| (task, share)).ok_or_else(|| Refusal(format!("“prior” names {name}, which is no task of this page")))
        };
        told.walk.prior = Some(tasks.lines().zip(prior.iter().copied()).map(named).collect::<Result<_, _>>()?);
        Ok(())
    }

    /// Adds the next answer, as [`answer_as`](Self::answer_as) takes it.
    ///
    /// # Errors
    /// A name that is no task's.
    #[wasm_bindgen(js_name = recordedAnswer)]
    pub fn recorded_answer(&mut self, names: &str, yes: bool, eta: f32, others: u8, words: &str) -> Result<(), Refusal> {
        let told = self.replaying.as_mut().ok_or_else(not_begun)?;
        let mut tasks = TaskSet::EMPTY;
        for name in names.lines() {
            // A negated task has the position of the plain one.
            let position = told.tasks.iter().position(|(_, known)| known == name.trim_start_matches('!'));
            tasks = tasks.with(position.ok_or_else(|| Refusal(format!("{name} is no task here")))?);
        }
        let after = told.walk.steps.len();
        told.walk.answers.push(SessionAnswer {
            after,
            tasks,
            yes,
            others,
            words: Some(words).filter(|words| !words.is_empty()).map(str::to_owned),
            ..SessionAnswer::of(eta)
        });
        Ok(())
    }

    /// Begins a recorded session: its home, its command, whether the trainer showed the way, and whether it continues the session before.
    /// Then call [`recorded_step`](Self::recorded_step) and [`recorded_answer`](Self::recorded_answer) in their order, and at the end
    /// [`replay_on`](Self::replay_on) until it is done. A session under way ends unlearned.
    ///
    /// # Errors
    /// Why the home cannot be used.
    #[wasm_bindgen(js_name = beginRecorded)]
    pub fn begin_recorded(&mut self, environment: &str, command: &str, shown: bool, continues: bool) -> Result<(), Refusal> {
        let environment = EnvironmentFile::parse(environment).map_err(Refusal::from)?;
        let (home, start) = build(&environment, self.moves, &ROOMS)?;
        self.forget();
        let lifted = self.lesson.agent.lifted();
        let mut tasks = vec![GroundedTask::UNUSED; MIND.tasks];
        let count = ground(&home, lifted, &start, &mut tasks).map_err(Refusal::from)?;
        let tasks = with_names(&home, lifted, &tasks[..count]);
        let kind = if shown { Kind::Demonstration } else { Kind::Feedback };
        let walk = Walk { command: command.to_owned(), continues, ..Walk::new(home, start, kind) };
        self.replaying = Some(Replaying { replay: Replay::new(Rules::AS_IT_WAS), walk, end: start, environment, tasks });
        Ok(())
    }

    /// Adds the next step: the action, by its name, and the feedback to it.
    ///
    /// # Errors
    /// Where it cannot be done there.
    #[wasm_bindgen(js_name = recordedStep)]
    pub fn recorded_step(&mut self, action: &str, feedback: &str) -> Result<(), Refusal> {
        let told = self.replaying.as_mut().ok_or_else(not_begun)?;
        let feedback = feedback.parse().unwrap_or(Feedback::Neutral);
        let step = Step::from(&told.walk.home, told.end, action, feedback, 0);
        let (step, next) = step.ok_or_else(|| Refusal(format!("{action} is no action here")))?;
        told.walk.steps.push(step);
        told.end = next;
        Ok(())
    }

    /// Replays the recorded session, by a step or by about `budget` node expansions. Returns whether it is done: the robot is then in the
    /// session's last state. With `learn`, it has begun to learn from the session; otherwise the next one can continue it.
    ///
    /// # Errors
    /// Why the session cannot be replayed; the training data are kept.
    #[wasm_bindgen(js_name = replayOn)]
    pub fn replay_on(&mut self, budget: u32, learn: bool) -> Result<bool, Refusal> {
        let told = self.replaying.as_mut().ok_or_else(not_begun)?;
        match told.replay.advance(&mut self.lesson.agent, &told.walk, budget) {
            Ok(Event::Ended) => {}
            Ok(_) => return Ok(false),
            Err(refused) => {
                self.forget();
                return Err(Refusal::from(refused));
            }
        }
        let Some(Replaying { walk, end, environment, .. }) = self.replaying.take() else { return Ok(true) };
        self.lesson.enter(walk.home, end);
        (self.file, self.start) = (environment, walk.start);
        if learn {
            let (agent, home, _) = self.lesson.parts();
            let finished = agent.finish(home).map_err(Refusal::from)?;
            self.learned(&finished);
        } else {
            self.lesson.agent.forget();
        }
        Ok(true)
    }
}
