//! goodbot's inference and the paper's: the probability of each task under a model of trainers' feedback.

use super::{Infer, Now, Tasks};
use crate::study::agent::whole::ROOM;
use crate::study::course::Place;
use crate::study::trial::StudyError;
use goodbot::feedback::{Belief, BeliefCount, BeliefRef, Feedback, Judged, LAGS, Strategy, population};
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::oomdp::Action;
use goodbot::planning::OptimalSet;
use goodbot::probability::Scaled;
use goodbot_course::CourseError;

/// The library's belief over tasks and strategies. Its belief about the trainer is kept between lessons.
#[derive(Debug)]
pub struct Model {
    memory: AgentHeap,
    count: BeliefCount,
    /// How far the belief about the trainer drifts back between lessons.
    drift: f32,
    tasks: Tasks,
    /// For each task, the judgements of the last actions, the last one first.
    judged: Vec<[Judged; LAGS]>,
}

impl Model {
    fn new(strategies: &[(Strategy, f32)], drift: f32, tasks: Tasks) -> Result<Self, StudyError> {
        let memory = AgentHeap::new(&ROOM);
        let mut model = Self { memory, count: BeliefCount::default(), drift, tasks, judged: Vec::new() };
        model.belief_mut().set_strategies(strategies).map_err(|error| CourseError::Agent(error.into()))?;
        Ok(model)
    }

    /// A model that expects the strategies of real people.
    ///
    /// # Errors
    /// [`StudyError`].
    pub fn people(tasks: Tasks) -> Result<Self, StudyError> {
        Self::new(&population::STRATEGIES, population::DRIFT, tasks)
    }

    /// A model that expects the paper's balanced trainer.
    ///
    /// # Errors
    /// [`StudyError`].
    pub fn balanced(tasks: Tasks) -> Result<Self, StudyError> {
        Self::new(&[(Strategy::BALANCED, 1.0)], 0.0, tasks)
    }

    fn belief_mut(&mut self) -> Belief<'_> {
        Belief::new(self.memory.lend().session.belief, &mut self.count)
    }
}

/// The judgement of an action for a task.
fn judged(now: &Now<'_>, task: usize, action: Action) -> Judged {
    let optimal = now.outlook.optimal[task];
    let rests = action == Action::NOOP;
    match optimal.exact() {
        None => Judged::Unknown,
        Some(_) if optimal == OptimalSet::Goal && !rests && now.place.is_done_after(task, now.state, action) => Judged::MovesInside,
        Some(right) => match (right.contains(action), rests) {
            (true, false) => Judged::Nearer,
            (false, false) => Judged::NotNearer,
            (true, true) => Judged::RestsAtGoal,
            (false, true) => Judged::RestsElsewhere,
        },
    }
}

impl Infer for Model {
    fn begin(&mut self, _place: &Place, prior: &[f32]) -> Result<(), StudyError> {
        self.tasks.begin(prior);
        self.judged = vec![[Judged::Unknown; LAGS]; prior.len()];
        let drift = self.drift;
        let restarted = self.belief_mut().restart(prior.iter().map(|&share| Scaled::new(share)), drift);
        restarted.map_err(|error| CourseError::Agent(error.into()).into())
    }

    fn act(&mut self, now: &Now<'_>) -> Result<Action, StudyError> {
        let belief = self.belief();
        let action = self.tasks.act(now, &belief, true);
        self.belief_mut().settle();
        for (task, last) in self.judged.iter_mut().enumerate() {
            last.rotate_right(1);
            last[0] = judged(now, task, action);
        }
        Ok(action)
    }

    fn told(&mut self, word: Feedback) -> Result<(), StudyError> {
        let judged = std::mem::take(&mut self.judged);
        let _ = self.belief_mut().observe_feedback(word, |task| judged[task]);
        self.judged = judged;
        Ok(())
    }

    fn belief(&self) -> Vec<f32> {
        let belief = BeliefRef::new(self.memory.read().session.belief, self.count);
        // The same values as `BeliefRef::probability`, but with a single sum.
        let whole = belief.whole();
        (0..belief.tasks()).map(|task| belief.weight(task).over(whole)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::course::Course;
    use goodbot::home::paper_tasks;
    use goodbot::oomdp::apply;
    use goodbot::{Agent, Options};
    use goodbot_course::generator;

    #[test]
    fn it_believes_what_an_agent_of_the_library_believes() {
        let [lessons, _] = Course::Paper.exercises(3).expect("exercises");
        let lifted = paper_tasks().expect("tasks");
        let mut agent = Agent::new(AgentHeap::new(&ROOM), &lifted, Options::DEFAULT.for_people()).expect("an agent");
        agent.set_strategies(&population::STRATEGIES).expect("strategies");
        let mut model = Model::people(Tasks::new(generator(1))).expect("a model");
        let words = [Feedback::Neutral, Feedback::Punish, Feedback::Neutral, Feedback::Reward, Feedback::Neutral];
        for exercise in &lessons {
            let mut place = Place::new(exercise).expect("a place");
            let even = vec![1.0 / place.tasks.len() as f32; place.tasks.len()];
            model.begin(&place, &even).expect("begun");
            agent.hear_with_prior(&place.home, &place.start, &place.command, |_, _| even[0]).expect("heard");
            let mut state = place.start;
            for step in 0..25 {
                let outlook = place.outlook(&state).expect("plans");
                let action = model.act(&Now { place: &place, state: &state, outlook: &outlook, is_test: false }).expect("an action");
                model.told(words[step % words.len()]).expect("told");
                agent.plan_fully(&place.home, &state).expect("planned");
                agent.acted(&place.home, &state, action).expect("acted");
                let _ = agent.feedback(words[step % words.len()]).expect("told");
                for (task, probability) in model.belief().into_iter().enumerate() {
                    let theirs = agent.belief().probability(task);
                    assert!((probability - theirs).abs() < 1e-4, "{}, step {step}: {probability} and {theirs}", place.command);
                }
                state = apply(&place.home, &state, action).expect("applicable");
            }
            agent.forget();
        }
    }
}
