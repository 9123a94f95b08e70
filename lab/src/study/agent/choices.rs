//! What the others choose from, in two forms, and the weights that they learn.
//!
//! *Tabular*: the actions. There is a weight for each command, home, state and action, and nothing is known of a state that was never
//! visited.
//!
//! *Shared*: the tasks. There is a weight for each pair of a word of the command and a fact of a task. Commands share words and tasks share
//! facts, so what was learned of one command speaks for another. The learned quantity scores the tasks, and a planner acts for them.

use crate::study::place::{Outlook, Place};
use goodbot::home::HomeState;
use goodbot::oomdp::{Action, ActionSet, Domain};
use std::collections::HashMap;
use std::fmt;

/// Which of the two forms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A table for each command.
    Tabular,
    /// Weights of words and facts, and a planner.
    Shared(Words),
}

/// What of a command is paired with the facts of tasks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Words {
    /// Its words.
    Single,
    /// Its words, and each two that follow each other.
    Neighbours,
}

impl Form {
    /// All of the first kind.
    pub const TABLES: [Self; 1] = [Self::Tabular];
    /// All of the second.
    pub const SHARED: [Self; 2] = [Self::Shared(Words::Single), Self::Shared(Words::Neighbours)];
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Tabular => "table",
            Self::Shared(Words::Single) => "words",
            Self::Shared(Words::Neighbours) => "words and neighbours",
        })
    }
}

/// What a weight is of.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Key {
    /// A command, a home, a state and an action.
    Cell(&'static str, u8, u64, Action),
    /// A word, or two, or none, and a fact.
    Pair(String, String),
    /// A number that is the same for all candidates, and what the candidate is.
    Statistic(usize, Own),
}

/// What a candidate is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Own {
    Action(Action),
    Kind(u8),
}

/// A weight, by its position, and the value that it is multiplied with.
pub type Feature = (usize, f32);

/// One of the things to choose from.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Its features. The squares of their values sum to 1.
    pub features: Vec<Feature>,
    /// What is right for it here, empty where that is not known.
    pub right: ActionSet,
    /// What to do for it.
    pub onward: ActionSet,
    own: Own,
}

/// What was done in one step, as a judgement of a candidate.
#[derive(Clone, Debug)]
pub struct Claim {
    /// Whose features.
    pub features: Vec<Feature>,
    /// 1 where the candidate would have done the same, -1 where not, 0 where that is not known.
    pub sign: f32,
}

/// The features of a task of the command under way.
#[derive(Clone, Debug)]
struct Task {
    features: Vec<Feature>,
    own: Own,
}

/// The weights, and the tasks of the command under way.
#[derive(Clone, Debug)]
pub struct Choices {
    form: Form,
    known: HashMap<Key, usize>,
    weights: Vec<f32>,
    tasks: Vec<Task>,
}

impl Choices {
    /// Nothing is learned yet.
    pub fn new(form: Form) -> Self {
        Self { form, known: HashMap::new(), weights: Vec::new(), tasks: Vec::new() }
    }

    /// Hears a command.
    pub fn hear(&mut self, place: &Place<'_, '_>) {
        let Form::Shared(words) = self.form else { return };
        let neighbours = place.words.windows(2).map(|two| two.join(" ")).filter(|_| words == Words::Neighbours);
        // Beside the words stands none at all: what is true of a fact whatever is said.
        let said: Vec<String> = place.words.iter().cloned().chain(neighbours).chain([String::new()]).collect();
        let mut tasks = Vec::new();
        for (facts, &kind) in place.facts.iter().zip(&place.kinds) {
            let value = 1.0 / ((said.len() * facts.len()).max(1) as f32).sqrt();
            let pairs = said.iter().flat_map(|word| facts.iter().map(move |fact| Key::Pair(word.clone(), fact.clone())));
            tasks.push(Task { features: pairs.map(|key| (self.weight(key), value)).collect(), own: Own::Kind(kind) });
        }
        self.tasks = tasks;
    }

    fn weight(&mut self, key: Key) -> usize {
        let next = self.weights.len();
        let at = *self.known.entry(key).or_insert(next);
        if at == next {
            self.weights.push(0.0);
        }
        at
    }

    /// The candidates in a state.
    pub fn here(&mut self, place: &Place<'_, '_>, state: &HomeState, outlook: &Outlook) -> Vec<Candidate> {
        match self.form {
            Form::Tabular => {
                let (command, home, number) = (place.exercise.command, place.exercise.home as u8, place.home.number(state));
                let candidate = |action| Candidate {
                    features: vec![(self.weight(Key::Cell(command, home, number, action)), 1.0)],
                    right: ActionSet::of(action),
                    onward: ActionSet::of(action),
                    own: Own::Action(action),
                };
                outlook.applicable.iter().map(candidate).collect()
            }
            Form::Shared(_) => {
                let candidate = |(task, optimal): (&Task, &goodbot::planning::OptimalSet)| Candidate {
                    features: task.features.clone(),
                    right: optimal.exact().unwrap_or(ActionSet::EMPTY),
                    onward: optimal.onward().unwrap_or(ActionSet::NOOP),
                    own: task.own,
                };
                self.tasks.iter().zip(&outlook.optimal).map(candidate).collect()
            }
        }
    }

    /// Gives a candidate features for numbers that are the same for all: a weight for each number and what the candidate is.
    pub fn with_statistics(&mut self, candidate: &mut Candidate, numbers: &[f32]) {
        for (position, &number) in numbers.iter().enumerate() {
            let at = self.weight(Key::Statistic(position, candidate.own));
            candidate.features.push((at, number));
        }
    }

    /// The weighted sum of features.
    pub fn score(&self, features: &[Feature]) -> f32 {
        features.iter().map(|&(at, value)| self.weights[at] * value).sum()
    }

    /// The scores of candidates.
    pub fn scores(&self, candidates: &[Candidate]) -> Vec<f32> {
        candidates.iter().map(|candidate| self.score(&candidate.features)).collect()
    }

    /// The scores of the command's tasks; `None` where tasks are not what is chosen from.
    pub fn task_scores(&self) -> Option<Vec<f32>> {
        self.are_tasks().then(|| self.tasks.iter().map(|task| self.score(&task.features)).collect())
    }

    /// Moves the weights along features.
    pub fn learn(&mut self, features: &[Feature], step: f32) {
        for &(at, value) in features {
            self.weights[at] += step * value;
        }
    }

    /// An action as a judgement of the candidates. In a table it judges itself alone; a task is judged by every action, for or against.
    pub fn claims(&self, candidates: &[Candidate], action: Action) -> Vec<Claim> {
        let claim = |candidate: &Candidate| {
            let sign = match candidate.right {
                ActionSet::EMPTY => 0.0,
                right if right.contains(action) => 1.0,
                _ => -1.0,
            };
            Claim { features: candidate.features.clone(), sign }
        };
        let judged = |candidate: &&Candidate| self.form != Form::Tabular || candidate.right.contains(action);
        candidates.iter().filter(judged).map(claim).collect()
    }

    /// Whether the candidates are tasks.
    pub fn are_tasks(&self) -> bool {
        self.form != Form::Tabular
    }
}
