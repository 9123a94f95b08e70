//! What JavaScript calls otherwise than Rust: its class `Goodbot` is [`World`], and takes and gives texts and numbers. A text "JSON, `Scene`"
//! has the fields of that struct of [`view`](crate::view). A refusal is thrown as an `Error` whose message is for people.

use crate::course;
use crate::world::{self, Refusal, World};
use goodbot::feedback::Strategy;
use goodbot_lesson::walk::Expected;
use serde::Serialize;
use wasm_bindgen::prelude::*;

impl From<Refusal> for JsValue {
    fn from(refusal: Refusal) -> Self {
        JsError::new(&refusal.0).into()
    }
}

/// The numbers of a strategy.
const STRATEGY: usize = 11;

/// A strategy from eleven numbers, with its prior.
fn strategy_of(numbers: &[f32; STRATEGY]) -> Result<(Strategy, f32), Refusal> {
    let &[mu_plus, mu_minus, epsilon, prior, now, before, earlier, ref rests @ ..] = numbers;
    let strategy = Strategy::new(mu_plus, mu_minus, epsilon).and_then(|strategy| strategy.with_lags([now, before, earlier]));
    let strategy = strategy.and_then(|strategy| strategy.with_rests(*rests));
    Ok((strategy.map_err(Refusal::from)?, prior))
}

/// Pairs of a name and a text, from two lines each.
fn pairs(lines: &str) -> Vec<(String, String)> {
    let lines: Vec<&str> = lines.lines().collect();
    lines.as_chunks::<2>().0.iter().map(|[name, text]| ((*name).to_owned(), (*text).to_owned())).collect()
}

fn json(value: &impl Serialize) -> Result<String, Refusal> {
    crate::log::try_json(value).ok_or_else(|| Refusal("what the page draws is no JSON; please report this".to_owned()))
}

#[wasm_bindgen(js_class = "Goodbot")]
impl World {
    /// A robot that has learned nothing yet; `seed` decides its draws among actions that are equally good.
    #[wasm_bindgen(constructor)]
    pub fn for_page(seed: u32) -> Result<Self, Refusal> {
        Self::new(u64::from(seed))
    }

    /// Says why an environment, as JSON, cannot be used; empty if it can.
    pub fn check(environment: &str) -> String {
        world::check(environment).err().map_or_else(String::new, |refusal| refusal.0)
    }

    /// The paper's lessons and tests, in the homes as drawn (seed 0) or at random: JSON, [`Course`](crate::course::Course).
    pub fn course(seed: u32) -> Result<String, Refusal> {
        json(&if seed == 0 { course::fixed() } else { course::random(u64::from(seed)) })
    }

    /// The home as it is now: JSON, [`Scene`](crate::view::Scene).
    #[wasm_bindgen(js_name = scene)]
    pub fn scene_json(&self) -> Result<String, Refusal> {
        json(&self.scene())
    }

    /// The trainer strategies that the robot expected before it met its trainer, as `setStrategies` takes them: a model file may have changed
    /// them.
    pub fn strategies(&self) -> Vec<f32> {
        let numbers = |(strategy, prior): &(Strategy, f32)| {
            let [now, before, earlier] = strategy.lags();
            let [plus, minus, mistake, inside] = strategy.rests();
            [strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon(), *prior, now, before, earlier, plus, minus, mistake, inside]
        };
        self.expected().iter().flatten().flat_map(numbers).collect()
    }

    /// Sets the trainer strategies: eleven numbers each, mu+, mu-, epsilon, the prior, three lags, and four about rests. Without any, the
    /// robot expects the feedback of real people.
    #[wasm_bindgen(js_name = setStrategies)]
    pub fn set_strategies_of(&mut self, numbers: &[f32]) -> Result<(), Refusal> {
        if numbers.is_empty() {
            return self.set_learns_style(true);
        }
        let mut strategies = Vec::new();
        for strategy in numbers.as_chunks::<STRATEGY>().0 {
            strategies.push(strategy_of(strategy)?);
        }
        self.set_strategies(&strategies)
    }

    /// Adds the trainer strategies that the session names: eleven numbers each, as `setStrategies` takes them, and the prior as a share
    /// of the most probable one's.
    #[wasm_bindgen(js_name = recordedStrategies)]
    pub fn recorded_strategies_of(&mut self, numbers: &[f32]) -> Result<(), Refusal> {
        let mut expected = Vec::new();
        for strategy in numbers.as_chunks::<{ STRATEGY + 1 }>().0 {
            let &[ref numbers @ .., share] = strategy;
            let (strategy, recorded) = strategy_of(numbers)?;
            expected.push(Expected { strategy, share, recorded });
        }
        self.recorded_strategies(expected)
    }

    /// The belief that the robot would have on hearing a command in this home, given as JSON: JSON, [`Belief`](crate::view::Belief). It
    /// learns nothing from that, and everything stays in place.
    #[wasm_bindgen(js_name = asked)]
    pub fn asked_json(&mut self, environment: &str, command: &str) -> Result<String, Refusal> {
        json(&self.asked(environment, command)?)
    }

    /// Tells the robot something: JSON, [`Reaction`](crate::view::Reaction). With some lessons it listens, and begins a session if there is
    /// something to do. `insists` makes it a command, whatever the robot takes it for, unless it is negated.
    #[wasm_bindgen(js_name = listen)]
    pub fn listen_json(&mut self, words: &str, insists: bool) -> Result<String, Refusal> {
        json(&self.listen(words, insists)?)
    }

    /// Begins with the rest of the utterance, once a session is over: JSON, [`Reaction`](crate::view::Reaction), or `null` without a rest.
    #[wasm_bindgen(js_name = listenOn)]
    pub fn listen_on_json(&mut self) -> Result<String, Refusal> {
        json(&self.listen_on()?)
    }

    /// Begins a session of a log anew, one that began by listening: the utterance, the task of the command before, if there was one, and
    /// the conversation, as a name and a text on two lines each. JSON, [`Reaction`](crate::view::Reaction).
    #[wasm_bindgen(js_name = listenAs)]
    pub fn listen_as_json(&mut self, utterance: &str, after: Option<String>, conversation: &str) -> Result<String, Refusal> {
        json(&self.listen_as(utterance, after.as_deref(), &pairs(conversation))?)
    }

    /// Adds to the recorded session that it began by listening, as `listenAs` takes it.
    #[wasm_bindgen(js_name = recordedListening)]
    pub fn recorded_listening_of(&mut self, utterance: &str, after: Option<String>, conversation: &str) -> Result<(), Refusal> {
        self.recorded_listening(utterance, after.as_deref(), &pairs(conversation))
    }

    /// Decides on an action and does it; or does the action of this name instead, as in a log: JSON, [`Decided`](crate::view::Decided).
    #[wasm_bindgen(js_name = act)]
    pub fn act_json(&mut self, named: Option<String>) -> Result<String, Refusal> {
        let decided = match named {
            Some(action) => self.act_as(&action),
            None => self.act(),
        };
        json(&decided?)
    }

    /// Takes in the trainer's feedback to the last action, `reward`, `punish` or `neutral`: JSON, [`Evidence`](crate::view::Evidence).
    #[wasm_bindgen(js_name = judge)]
    pub fn judge_json(&mut self, feedback: &str) -> Result<String, Refusal> {
        json(&self.judge(feedback)?)
    }

    /// Proposes a question if it teaches more than acting: JSON, [`Question`](crate::view::Question), or `null` if there is nothing to
    /// ask; empty while it is still looking ahead, with about `budget` node expansions a call. The plan must be done.
    #[wasm_bindgen(js_name = question)]
    pub fn question_json(&mut self, budget: u32) -> Result<String, Refusal> {
        match self.question(budget)? {
            None => Ok(String::new()),
            Some(question) => json(&question),
        }
    }

    /// The one of `lessons`, one command a line, the one in the simplest home first, that teaches most of the commands in `wanted`: JSON,
    /// [`NextLesson`](crate::view::NextLesson), or `null` if none has a wanted word.
    #[wasm_bindgen(js_name = nextLesson)]
    pub fn next_lesson_json(&self, lessons: &str, wanted: &str) -> Result<String, Refusal> {
        json(&self.next_lesson(lessons, wanted)?)
    }

    /// The open question: JSON, [`Question`](crate::view::Question), or `null`.
    #[wasm_bindgen(js_name = openQuestion)]
    pub fn open_question_json(&self) -> Result<String, Refusal> {
        json(&self.open_question())
    }

    /// Takes in the answer to the open question, `yes`, `no` (none of these) or the number of a choice from 1 on: JSON,
    /// [`AnswerEvidence`](crate::view::AnswerEvidence).
    #[wasm_bindgen(js_name = answer)]
    pub fn answer_json(&mut self, answer: &str) -> Result<String, Refusal> {
        json(&self.answer(answer)?)
    }

    /// The session under way as lines of a log that is not learned from.
    #[wasm_bindgen(js_name = log)]
    pub fn unlearned_log(&self) -> Result<String, Refusal> {
        self.log(false)
    }

    /// The robot's belief: JSON, [`Belief`](crate::view::Belief).
    #[wasm_bindgen(js_name = belief)]
    pub fn belief_json(&self) -> Result<String, Refusal> {
        json(&self.belief())
    }

    /// Goes on looking ahead, with about `budget` node expansions: JSON, [`Route`](crate::view::Route), or `null` if the task leads
    /// nowhere; empty while it is still looking.
    #[wasm_bindgen(js_name = look)]
    pub fn look_json(&mut self, budget: u32) -> Result<String, Refusal> {
        match self.look(budget) {
            (false, _) => Ok(String::new()),
            (true, route) => json(&route),
        }
    }

    /// Which word of the command speaks for which task: JSON, [`Support`](crate::view::Support).
    #[wasm_bindgen(js_name = support)]
    pub fn support_json(&self) -> Result<String, Refusal> {
        json(&self.support()?)
    }

    /// The meaning of every word to the robot: JSON, [`Heat`](crate::view::Heat).
    #[wasm_bindgen(js_name = heat)]
    pub fn heat_json(&self) -> Result<String, Refusal> {
        json(&self.heat())
    }
}
