//! A log-linear model. It has a weight for each pair of a word of the command (or two neighbours, or no word) and a fact of a task.
//! Commands share words and tasks share facts, so training on one command helps with others.

use super::{Speak, wordless};
use crate::study::agent;
use crate::study::course::Place;
use crate::study::trial::StudyError;
use std::collections::HashMap;
use std::fmt;

/// The settings of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Whether pairs of neighbouring words count too.
    pub neighbours: bool,
    /// The step size after each lesson.
    pub rate: f32,
}

/// The chosen settings. More than one step for each lesson was tried, with and without a decay of weights, and was worse.
pub const CHOSEN: Settings = Settings { neighbours: true, rate: 1.0 };

/// The step sizes to try.
pub const RATES: [f32; 7] = [0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0];

/// All settings to try.
pub fn grid() -> Vec<Settings> {
    RATES.into_iter().flat_map(|rate| [false, true].map(|neighbours| Settings { neighbours, rate })).collect()
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { neighbours, rate } = self;
        write!(f, "{}, rate {rate}", if *neighbours { "words and neighbours" } else { "words" })
    }
}

/// A command with its tasks, as weights.
#[derive(Debug)]
struct WeighedCommand {
    /// For each task, the weights of its sum, all with the same factor.
    tasks: Vec<Vec<usize>>,
    value: f32,
    /// The logarithms of the tasks' priors without words.
    logs: Vec<f32>,
}

/// The model.
#[derive(Debug)]
pub struct LogLinear {
    settings: Settings,
    known: HashMap<(String, String), usize>,
    weights: Vec<f32>,
}

impl LogLinear {
    /// A model without words.
    pub fn new(settings: Settings) -> Self {
        Self { settings, known: HashMap::new(), weights: Vec::new() }
    }

    fn read(&mut self, place: &Place) -> WeighedCommand {
        let neighbours = place.words.windows(2).map(|two| two.join(" ")).filter(|_| self.settings.neighbours);
        // The empty word is a bias: a fact's weight for any command.
        let said: Vec<String> = place.words.iter().cloned().chain(neighbours).chain([String::new()]).collect();
        let mut tasks = Vec::new();
        for facts in &place.facts {
            let pairs = said.iter().flat_map(|word| facts.iter().map(move |fact| (word.clone(), fact.clone())));
            tasks.push(pairs.map(|pair| self.weight(pair)).collect());
        }
        // Otherwise long commands would be learned faster.
        let most = place.facts.iter().map(Vec::len).max().unwrap_or(1);
        let logs = wordless(place).into_iter().map(|share| libm::logf(share.max(f32::MIN_POSITIVE))).collect();
        WeighedCommand { tasks, value: 1.0 / ((said.len() * most) as f32).sqrt(), logs }
    }

    fn weight(&mut self, pair: (String, String)) -> usize {
        let next = self.weights.len();
        let at = *self.known.entry(pair).or_insert(next);
        if at == next {
            self.weights.push(0.0);
        }
        at
    }
}

/// The probabilities of the tasks.
fn probabilities(weights: &[f32], lesson: &WeighedCommand) -> Vec<f32> {
    let score = |task: &Vec<usize>| task.iter().map(|&at| weights[at]).sum::<f32>() * lesson.value;
    agent::softmax(&lesson.tasks.iter().zip(&lesson.logs).map(|(task, log)| log + score(task)).collect::<Vec<_>>())
}

impl Speak for LogLinear {
    fn hear(&mut self, place: &Place) -> Result<Vec<f32>, StudyError> {
        let lesson = self.read(place);
        Ok(probabilities(&self.weights, &lesson))
    }

    fn learn(&mut self, place: &Place, posterior: &[f32]) -> Result<(), StudyError> {
        let lesson = self.read(place);
        let expected = probabilities(&self.weights, &lesson);
        for ((task, believed), expected) in lesson.tasks.iter().zip(posterior).zip(expected) {
            let step = self.settings.rate * lesson.value * (believed - expected);
            task.iter().for_each(|&at| self.weights[at] += step);
        }
        Ok(())
    }
}
