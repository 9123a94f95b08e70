//! The surface for JavaScript: one class, `Goodbot`. A text "JSON, `Scene`" has the fields of that struct of [`view`](crate::view). A
//! refusal is thrown as an `Error` whose message is for people.

use goodbot::feedback::Strategy;
use goodbot_lesson::walk::Expected;
use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::course;
use crate::world::{self, Refusal, World};

type Thrown<T> = Result<T, JsError>;

fn thrown(refusal: Refusal) -> JsError {
    JsError::new(&refusal.0)
}

/// The numbers of a strategy.
const STRATEGY: usize = 11;

/// A strategy from eleven numbers, with its prior.
fn strategy_of(numbers: &[f32; STRATEGY]) -> Thrown<(Strategy, f32)> {
    let &[mu_plus, mu_minus, epsilon, prior, now, before, earlier, ref rests @ ..] = numbers;
    let strategy = Strategy::new(mu_plus, mu_minus, epsilon).and_then(|strategy| strategy.with_lags([now, before, earlier]));
    let strategy = strategy.and_then(|strategy| strategy.with_rests(*rests));
    Ok((strategy.map_err(|error| thrown(Refusal::from(error)))?, prior))
}

/// Pairs of a name and a text, from two lines each.
fn pairs(lines: &str) -> Vec<(String, String)> {
    let lines: Vec<&str> = lines.lines().collect();
    lines.as_chunks::<2>().0.iter().map(|[name, text]| ((*name).to_owned(), (*text).to_owned())).collect()
}

fn json(value: &impl Serialize) -> Thrown<String> {
    crate::json::json(value).ok_or_else(|| JsError::new("what the page draws is no JSON; please report this"))
}

/// One world with one robot.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Goodbot(World);

#[wasm_bindgen]
impl Goodbot {
    /// A robot that has learned nothing yet; `seed` decides its draws among actions that are equally good.
    #[wasm_bindgen(constructor)]
    pub fn new(seed: u32) -> Thrown<Goodbot> {
        World::new(u64::from(seed)).map(Self).map_err(thrown)
    }

    /// Says why an environment, as JSON, cannot be used; empty if it can.
    pub fn check(environment: &str) -> String {
        world::check(environment).err().map_or_else(String::new, |refusal| refusal.0)
    }

    /// The paper's lessons and tests, in the homes as drawn (seed 0) or at random: JSON, [`Course`](crate::course::Course).
    pub fn course(seed: u32) -> Thrown<String> {
        json(&if seed == 0 { course::fixed() } else { course::random(u64::from(seed)) })
    }

    /// Moves the robot to another home, as JSON. Throws if that cannot be used; the old one then stays.
    #[wasm_bindgen(js_name = setEnvironment)]
    pub fn set_environment(&mut self, environment: &str) -> Thrown<()> {
        self.0.set_environment(environment).map_err(thrown)
    }

    /// The home as it was entered, as JSON.
    pub fn environment(&self) -> String {
        self.0.environment()
    }

    /// Puts everything back to where it was when the home was entered.
    pub fn reset(&mut self) {
        self.0.reset();
    }

    /// The home as it is now: JSON, [`Scene`](crate::view::Scene).
    pub fn scene(&self) -> Thrown<String> {
        json(&self.0.scene())
    }

    /// Sets whether the robot can pull blocks too. Puts everything back.
    #[wasm_bindgen(js_name = setPulls)]
    pub fn set_pulls(&mut self, pulls: bool) -> Thrown<()> {
        self.0.set_pulls(pulls).map_err(thrown)
    }

    /// Whether the robot can pull blocks too.
    pub fn pulls(&self) -> bool {
        self.0.pulls()
    }

    /// Sets whether commands may mean tasks with a way too. The robot keeps its training data; call `learn` until it is done.
    #[wasm_bindgen(js_name = setWays)]
    pub fn set_ways(&mut self, ways: bool) -> Thrown<()> {
        self.0.set_ways(ways).map_err(thrown)
    }

    /// Whether commands may mean tasks with a way too.
    pub fn ways(&self) -> bool {
        self.0.ways()
    }

    /// Gives the robot the everyday sentences of a language, beside its own sessions; the empty text takes them away. Call `learn` until it is
    /// done.
    #[wasm_bindgen(js_name = setStarter)]
    pub fn set_starter(&mut self, language: &str) {
        self.0.set_starter(language);
    }

    /// The language of these sentences; empty without them.
    pub fn starter(&self) -> String {
        self.0.starter().to_owned()
    }

    /// Seeds the random draws of this step of the next session.
    #[wasm_bindgen(js_name = drawFrom)]
    pub fn draw_from(&mut self, seed: u32, step: u32) {
        self.0.draw_from(seed, step);
    }

    /// The trainer strategies that the robot expected before it met its trainer, as `setStrategies` takes them: a model file may have changed
    /// them.
    pub fn strategies(&self) -> Vec<f32> {
        let numbers = |(strategy, prior): &(Strategy, f32)| {
            let [now, before, earlier] = strategy.lags();
            let [plus, minus, mistake, inside] = strategy.rests();
            [strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon(), *prior, now, before, earlier, plus, minus, mistake, inside]
        };
        self.0.expected().iter().flatten().flat_map(numbers).collect()
    }

    /// Sets the trainer strategies: eleven numbers each, mu+, mu-, epsilon, the prior, three lags, and four about rests. Without any, the
    /// robot expects the feedback of real people.
    #[wasm_bindgen(js_name = setStrategies)]
    pub fn set_strategies(&mut self, numbers: &[f32]) -> Thrown<()> {
        if numbers.is_empty() {
            return self.0.set_learns_style(true).map_err(thrown);
        }
        let mut strategies = Vec::new();
        for strategy in numbers.as_chunks::<STRATEGY>().0 {
            strategies.push(strategy_of(strategy)?);
        }
        self.0.set_strategies(&strategies).map_err(thrown)
    }

    /// Begins a recorded session: its home as JSON, its command, whether the trainer showed the way, and whether it continues the session
    /// before.
    #[wasm_bindgen(js_name = beginRecorded)]
    pub fn begin_recorded(&mut self, environment: &str, command: &str, shown: bool, continues: bool) -> Thrown<()> {
        self.0.begin_recorded(environment, command, shown, continues).map_err(thrown)
    }

    /// Adds the trainer strategies that the session names: eleven numbers each, as `setStrategies` takes them, and the prior as a share
    /// of the most probable one's.
    #[wasm_bindgen(js_name = recordedStrategies)]
    pub fn recorded_strategies(&mut self, numbers: &[f32]) -> Thrown<()> {
        let mut expected = Vec::new();
        for strategy in numbers.as_chunks::<{ STRATEGY + 1 }>().0 {
            let &[ref numbers @ .., share] = strategy;
            let (strategy, recorded) = strategy_of(numbers)?;
            expected.push(Expected { strategy, share, recorded });
        }
        self.0.recorded_strategies(expected).map_err(thrown)
    }

    /// Adds the prior of the session's tasks: their names on a line each, and a number up to 1 for each.
    #[wasm_bindgen(js_name = recordedPrior)]
    pub fn recorded_prior(&mut self, tasks: &str, prior: &[f32]) -> Thrown<()> {
        self.0.recorded_prior(tasks.lines().zip(prior.iter().copied())).map_err(thrown)
    }

    /// Adds the session's next step: the action's name, and the feedback to it; empty if the trainer showed the way.
    #[wasm_bindgen(js_name = recordedStep)]
    pub fn recorded_step(&mut self, action: &str, feedback: &str) -> Thrown<()> {
        self.0.recorded_step(action, feedback).map_err(thrown)
    }

    /// Adds the session's next answer, as `answerAs` takes it, and its words if it is a correction.
    #[wasm_bindgen(js_name = recordedAnswer)]
    pub fn recorded_answer(&mut self, tasks: &str, yes: bool, eta: f32, others: u8, words: &str) -> Thrown<()> {
        self.0.recorded_answer(tasks.lines(), yes, eta, others, words).map_err(thrown)
    }

    /// Replays the recorded session, by a step or by about `budget` node expansions. Returns whether it is done; with `learn`, call the
    /// function `learn` until that is done too.
    #[wasm_bindgen(js_name = replayOn)]
    pub fn replay_on(&mut self, budget: u32, learn: bool) -> Thrown<bool> {
        self.0.replay_on(budget, learn).map_err(thrown)
    }

    /// The belief that the robot would have on hearing a command in this home, given as JSON: JSON, [`Belief`](crate::view::Belief). It
    /// learns nothing from that, and everything stays in place.
    pub fn asked(&mut self, environment: &str, command: &str) -> Thrown<String> {
        json(&self.0.asked(environment, command).map_err(thrown)?)
    }

    /// What a person's words ask for, at this point of the session: `command`, `correction`, `reward`, `punish`, `finish`, `yes`, `no`, the
    /// number of a choice, `stop`, `undo`, `again`, `unjudged`, `unchanged` or `nothing`.
    pub fn said(&self, words: &str) -> Thrown<String> {
        self.0.said(words).map_err(thrown)
    }

    /// Learns the words that are said along with a button: `reward` or `punish`.
    #[wasm_bindgen(js_name = learnVoice)]
    pub fn learn_voice(&mut self, words: &str, feedback: &str) -> Thrown<()> {
        self.0.learn_voice(words, feedback).map_err(thrown)
    }

    /// Tells the robot something: JSON, [`Reaction`](crate::view::Reaction). With some lessons it listens, and begins a session if there is
    /// something to do. `insists` makes it a command, whatever the robot takes it for, unless it is negated.
    pub fn listen(&mut self, words: &str, insists: bool) -> Thrown<String> {
        json(&self.0.listen(words, insists).map_err(thrown)?)
    }

    /// Whether the utterance has a rest.
    #[wasm_bindgen(js_name = isMore)]
    pub fn is_more(&self) -> bool {
        self.0.is_more()
    }

    /// Begins with the rest of the utterance, once a session is over: JSON, [`Reaction`](crate::view::Reaction), or `null` without a rest.
    #[wasm_bindgen(js_name = listenOn)]
    pub fn listen_on(&mut self) -> Thrown<String> {
        json(&self.0.listen_on().map_err(thrown)?)
    }

    /// Whether there is something to learn from the session under way.
    pub fn teaches(&self) -> bool {
        self.0.teaches()
    }

    /// Takes in words that correct the robot on its way.
    pub fn correct(&mut self, words: &str) -> Thrown<()> {
        self.0.correct(words).map_err(thrown)
    }

    /// Takes the last step back. Returns whether there was one.
    #[wasm_bindgen(js_name = takeBack)]
    pub fn take_back(&mut self) -> Thrown<bool> {
        self.0.take_back().map_err(thrown)
    }

    /// Begins a session of a log anew, one that began by listening: the utterance, the task of the command before, if there was one, and
    /// the conversation, as a name and a text on two lines each. JSON, [`Reaction`](crate::view::Reaction).
    #[wasm_bindgen(js_name = listenAs)]
    pub fn listen_as(&mut self, utterance: &str, after: Option<String>, conversation: &str) -> Thrown<String> {
        json(&self.0.listen_as(utterance, after.as_deref(), &pairs(conversation)).map_err(thrown)?)
    }

    /// Adds to the recorded session that it began by listening, as `listenAs` takes it.
    #[wasm_bindgen(js_name = recordedListening)]
    pub fn recorded_listening(&mut self, utterance: &str, after: Option<String>, conversation: &str) -> Thrown<()> {
        self.0.recorded_listening(utterance, after.as_deref(), &pairs(conversation)).map_err(thrown)
    }

    /// Adds to the recorded session its table of closed words.
    #[wasm_bindgen(js_name = recordedClosedWords)]
    pub fn recorded_closed_words(&mut self, table: &str) -> Thrown<()> {
        self.0.recorded_closed_words(table).map_err(thrown)
    }

    /// Hears a command.
    pub fn hear(&mut self, command: &str) -> Thrown<()> {
        self.0.hear(command).map_err(thrown)
    }

    /// Goes on planning, with at most about `budget` node expansions. Returns whether the plan is done.
    pub fn plan(&mut self, budget: u32) -> Thrown<bool> {
        self.0.plan(budget).map_err(thrown)
    }

    /// Decides on an action and does it; or does the action of this name instead, as in a log: JSON, [`Decided`](crate::view::Decided).
    pub fn act(&mut self, named: Option<String>) -> Thrown<String> {
        let decided = match named {
            Some(action) => self.0.act_as(&action),
            None => self.0.act(),
        };
        json(&decided.map_err(thrown)?)
    }

    /// Takes in the trainer's feedback to the last action, `reward`, `punish` or `neutral`: JSON, [`Evidence`](crate::view::Evidence).
    pub fn judge(&mut self, feedback: &str) -> Thrown<String> {
        json(&self.0.judge(feedback).map_err(thrown)?)
    }

    /// Leaves the last action unjudged, which is no silence either: the belief stays as it is, as in a test.
    pub fn unjudged(&mut self) {
        self.0.unjudged();
    }

    /// Proposes a question if it teaches more than acting: JSON, [`Question`](crate::view::Question), or `null` if there is nothing to
    /// ask; empty while it is still looking ahead, with about `budget` node expansions a call. The plan must be done.
    pub fn question(&mut self, budget: u32) -> Thrown<String> {
        match self.0.question(budget).map_err(thrown)? {
            None => Ok(String::new()),
            Some(question) => json(&question),
        }
    }

    /// The one of `lessons`, one command a line, the one in the simplest home first, that teaches most of the commands in `wanted`: JSON,
    /// [`NextLesson`](crate::view::NextLesson), or `null` if none has a wanted word.
    #[wasm_bindgen(js_name = nextLesson)]
    pub fn next_lesson(&self, lessons: &str, wanted: &str) -> Thrown<String> {
        json(&self.0.next_lesson(lessons, wanted).map_err(thrown)?)
    }

    /// The open question: JSON, [`Question`](crate::view::Question), or `null`.
    #[wasm_bindgen(js_name = openQuestion)]
    pub fn open_question(&self) -> Thrown<String> {
        json(&self.0.open_question())
    }

    /// Takes in the answer to the open question, `yes`, `no` (none of these) or the number of a choice from 1 on: JSON,
    /// [`AnswerEvidence`](crate::view::AnswerEvidence).
    pub fn answer(&mut self, answer: &str) -> Thrown<String> {
        json(&self.0.answer(answer).map_err(thrown)?)
    }

    /// Takes in an answer as in a log: the names of its tasks on a line each, whether the meant task is among them, the probability that
    /// this is wrong, how many other answers there were, and its words if it is a correction.
    #[wasm_bindgen(js_name = answerAs)]
    pub fn answer_as(&mut self, tasks: &str, yes: bool, eta: f32, others: u8, words: &str) -> Thrown<()> {
        self.0.answer_as(tasks.lines().map(str::to_owned).collect(), yes, eta, others, words).map_err(thrown)
    }

    /// The feedback to the last action of a simulated trainer, who means the given task.
    #[wasm_bindgen(js_name = simulatedFeedback)]
    pub fn simulated_feedback(&mut self, intended: usize) -> Thrown<String> {
        self.0.simulated_feedback(intended).map(str::to_owned).map_err(thrown)
    }

    /// Ends the session and begins to learn from it. Returns the session as lines of a log.
    pub fn finish(&mut self) -> Thrown<String> {
        self.0.finish().map_err(thrown)
    }

    /// Goes on learning, with about `budget` table cells of work. Returns whether it is done.
    pub fn learn(&mut self, budget: u32) -> bool {
        self.0.learn(budget)
    }

    /// Ends the session without learning from it.
    pub fn forget(&mut self) {
        self.0.forget();
    }

    /// The session under way as lines of a log that is not learned from.
    pub fn log(&self) -> Thrown<String> {
        self.0.log(false).map_err(thrown)
    }

    /// How many sessions the robot has learned from.
    pub fn sessions(&self) -> usize {
        self.0.sessions()
    }

    /// The robot's model, as the bytes of a model file.
    pub fn save(&self) -> Thrown<Vec<u8>> {
        self.0.save().map_err(thrown)
    }

    /// Replaces the robot's model by a model file; call `learn` until it is done. Throws if the file is none; the old model then stays.
    pub fn restore(&mut self, bytes: &[u8]) -> Thrown<()> {
        self.0.restore(bytes).map_err(thrown)
    }

    /// Adds the lessons of another robot's model file; call `learn` until it is done. Returns the number of those that were not known.
    /// Throws if the file cannot be used; the training data are then unchanged.
    pub fn join(&mut self, bytes: &[u8]) -> Thrown<usize> {
        self.0.join(bytes).map_err(thrown)
    }

    /// Whether a micro:bit has room for the home.
    #[wasm_bindgen(js_name = fitsMicrobit)]
    pub fn fits_microbit(&self) -> bool {
        self.0.fits_microbit()
    }

    /// The robot's model, as the bytes of a model file for a micro:bit. Throws if a micro:bit has no room for it.
    #[wasm_bindgen(js_name = forMicrobit)]
    pub fn for_microbit(&self) -> Thrown<Vec<u8>> {
        self.0.for_microbit().map_err(thrown)
    }

    /// A new robot, which has learned nothing, in the same home.
    pub fn restart(&mut self) -> Thrown<()> {
        self.0.restart().map_err(thrown)
    }

    /// The robot's belief: JSON, [`Belief`](crate::view::Belief).
    pub fn belief(&self) -> Thrown<String> {
        json(&self.0.belief())
    }

    /// Begins to look where a task would lead from here.
    #[wasm_bindgen(js_name = lookAhead)]
    pub fn look_ahead(&mut self, task: usize) {
        self.0.look_ahead(task);
    }

    /// Goes on looking ahead, with about `budget` node expansions: JSON, [`Route`](crate::view::Route), or `null` if the task leads
    /// nowhere; empty while it is still looking.
    pub fn look(&mut self, budget: u32) -> Thrown<String> {
        match self.0.look(budget) {
            (false, _) => Ok(String::new()),
            (true, route) => json(&route),
        }
    }

    /// Which word of the command speaks for which task: JSON, [`Support`](crate::view::Support).
    pub fn support(&self) -> Thrown<String> {
        json(&self.0.support().map_err(thrown)?)
    }

    /// The meaning of every word to the robot: JSON, [`Heat`](crate::view::Heat).
    pub fn heat(&self) -> Thrown<String> {
        json(&self.0.heat())
    }
}
