//! The surface for JavaScript: one class, `Goodbot`. Texts that are said to be JSON have the fields of the named struct of
//! [`view`](crate::view). A refusal is thrown as an `Error` whose message is for people.

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

/// A strategy of eleven numbers, with how probable it is.
fn strategy_of(numbers: &[f32; STRATEGY]) -> Thrown<(Strategy, f32)> {
    let &[mu_plus, mu_minus, epsilon, prior, now, before, earlier, ref rests @ ..] = numbers;
    let strategy = Strategy::new(mu_plus, mu_minus, epsilon).and_then(|strategy| strategy.with_lags([now, before, earlier]));
    let strategy = strategy.and_then(|strategy| strategy.with_rests(*rests));
    Ok((strategy.map_err(|error| thrown(Refusal::from(error)))?, prior))
}

/// A name and a text on two lines each.
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

    /// Says why an environment, as JSON, cannot be used; empty where it can.
    pub fn check(environment: &str) -> String {
        world::check(environment).err().map_or_else(String::new, |refusal| refusal.0)
    }

    /// The paper's lessons and tests, in the homes as drawn (seed 0) or at random: JSON, [`Course`](crate::course::Course).
    pub fn course(seed: u32) -> Thrown<String> {
        json(&if seed == 0 { course::fixed() } else { course::random(u64::from(seed)) })
    }

    /// Moves the robot to another home, as JSON. Throws where that cannot be used; the old one then stays.
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

    /// Whether the robot can pull blocks too. Puts everything back.
    #[wasm_bindgen(js_name = setPulls)]
    pub fn set_pulls(&mut self, pulls: bool) -> Thrown<()> {
        self.0.set_pulls(pulls).map_err(thrown)
    }

    /// Whether the robot can pull blocks too.
    pub fn pulls(&self) -> bool {
        self.0.pulls()
    }

    /// Whether commands may mean tasks with a way too. The robot keeps what it has learned; call `learn` until it is done.
    #[wasm_bindgen(js_name = setWays)]
    pub fn set_ways(&mut self, ways: bool) -> Thrown<()> {
        self.0.set_ways(ways).map_err(thrown)
    }

    /// Whether commands may mean tasks with a way too.
    pub fn ways(&self) -> bool {
        self.0.ways()
    }

    /// Begins the random draws anew: those of this step of the next session, with this seed.
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

    /// Takes trainer strategies: eleven numbers each, mu+, mu-, epsilon, how probable it is, its three lags, and four about rests. Where there
    /// are none, the robot expects what real people do.
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

    /// Begins to tell of a recorded session: its home as JSON, its command, whether the trainer showed the way, and whether it goes on from the
    /// session before.
    #[wasm_bindgen(js_name = beginRecorded)]
    pub fn begin_recorded(&mut self, environment: &str, command: &str, shown: bool, continues: bool) -> Thrown<()> {
        self.0.begin_recorded(environment, command, shown, continues).map_err(thrown)
    }

    /// The trainer strategies that the session names: eleven numbers each, as `setStrategies` takes them, and how probable each is as a share of
    /// the most probable one.
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

    /// The prior of the session's tasks: their names on a line each, and a number up to 1 for each.
    #[wasm_bindgen(js_name = recordedPrior)]
    pub fn recorded_prior(&mut self, tasks: &str, prior: &[f32]) -> Thrown<()> {
        self.0.recorded_prior(tasks.lines().zip(prior.iter().copied())).map_err(thrown)
    }

    /// The session's next step: the action's name, and what was said to it; empty where the trainer showed the way.
    #[wasm_bindgen(js_name = recordedStep)]
    pub fn recorded_step(&mut self, action: &str, feedback: &str) -> Thrown<()> {
        self.0.recorded_step(action, feedback).map_err(thrown)
    }

    /// The session's next answer, as `answerAs` takes it, and its words where it is a correction.
    #[wasm_bindgen(js_name = recordedAnswer)]
    pub fn recorded_answer(&mut self, tasks: &str, yes: bool, eta: f32, others: u8, words: &str) -> Thrown<()> {
        self.0.recorded_answer(tasks.lines(), yes, eta, others, words).map_err(thrown)
    }

    /// Replays the session that was told, by a step or by about `budget` looks of planning. Gives whether it is done; where it is learned
    /// from, call `learn` until that is done too.
    #[wasm_bindgen(js_name = replayOn)]
    pub fn replay_on(&mut self, budget: u32, learn: bool) -> Thrown<bool> {
        self.0.replay_on(budget, learn).map_err(thrown)
    }

    /// What the robot would believe of a command in this home, as JSON: JSON, [`Belief`](crate::view::Belief). It learns nothing from that, and
    /// everything stays where it is.
    pub fn asked(&mut self, environment: &str, command: &str) -> Thrown<String> {
        json(&self.0.asked(environment, command).map_err(thrown)?)
    }

    /// What a person's words ask for, at this point of the session: `command`, `correction`, `reward`, `punish`, `finish`, `yes`, `no`, the
    /// number of a choice, `stop`, `undo`, `again`, `unjudged`, `unchanged` or `nothing`.
    pub fn said(&self, words: &str) -> Thrown<String> {
        self.0.said(words).map_err(thrown)
    }

    /// Learns what is said along with a button: `reward` or `punish`.
    #[wasm_bindgen(js_name = learnVoice)]
    pub fn learn_voice(&mut self, words: &str, feedback: &str) -> Thrown<()> {
        self.0.learn_voice(words, feedback).map_err(thrown)
    }

    /// Tells the robot something: JSON, [`Heard`](crate::view::Heard). With some lessons it listens, and begins with what there is to do.
    /// `insists` says that it is a command, whatever the robot takes it for.
    pub fn listen(&mut self, words: &str, insists: bool) -> Thrown<String> {
        json(&self.0.listen(words, insists).map_err(thrown)?)
    }

    /// Whether the utterance has a rest.
    #[wasm_bindgen(js_name = isMore)]
    pub fn is_more(&self) -> bool {
        self.0.is_more()
    }

    /// Begins with what is still to come, once a session is over: JSON, [`Heard`](crate::view::Heard), or `null`.
    #[wasm_bindgen(js_name = listenOn)]
    pub fn listen_on(&mut self) -> Thrown<String> {
        json(&self.0.listen_on().map_err(thrown)?)
    }

    /// Whether there is something to learn from the session under way.
    pub fn teaches(&self) -> bool {
        self.0.teaches()
    }

    /// Takes in words that turn the robot on its way round.
    pub fn correct(&mut self, words: &str) -> Thrown<()> {
        self.0.correct(words).map_err(thrown)
    }

    /// Takes the last step back. Gives whether there was one.
    #[wasm_bindgen(js_name = takeBack)]
    pub fn take_back(&mut self) -> Thrown<bool> {
        self.0.take_back().map_err(thrown)
    }

    /// Begins a session of a log anew where the robot listened: what was said, the task of the command before, or nothing, and the
    /// conversation, as a name and a text on two lines each. JSON, [`Heard`](crate::view::Heard).
    #[wasm_bindgen(js_name = listenAs)]
    pub fn listen_as(&mut self, utterance: &str, after: Option<String>, conversation: &str) -> Thrown<String> {
        json(&self.0.listen_as(utterance, after.as_deref(), &pairs(conversation)).map_err(thrown)?)
    }

    /// Where the recorded session that is being told began by listening, as `listenAs` has it.
    #[wasm_bindgen(js_name = recordedListening)]
    pub fn recorded_listening(&mut self, utterance: &str, after: Option<String>, conversation: &str) -> Thrown<()> {
        self.0.recorded_listening(utterance, after.as_deref(), &pairs(conversation)).map_err(thrown)
    }

    /// The table of closed words that the recorded session had that is being told.
    #[wasm_bindgen(js_name = recordedClosedWords)]
    pub fn recorded_closed_words(&mut self, table: &str) -> Thrown<()> {
        self.0.recorded_closed_words(table).map_err(thrown)
    }

    /// Hears a command.
    pub fn hear(&mut self, command: &str) -> Thrown<()> {
        self.0.hear(command).map_err(thrown)
    }

    /// Goes on planning, with at most about `budget` looks. Gives whether the plan is done.
    pub fn plan(&mut self, budget: u32) -> Thrown<bool> {
        self.0.plan(budget).map_err(thrown)
    }

    /// Decides on an action and does it; or does the action of this name instead, as a log has it: JSON, [`Decided`](crate::view::Decided).
    pub fn act(&mut self, named: Option<String>) -> Thrown<String> {
        let decided = match named {
            Some(action) => self.0.act_as(&action),
            None => self.0.act(),
        };
        json(&decided.map_err(thrown)?)
    }

    /// Takes in what the trainer said to the last action, `reward`, `punish` or `neutral`: JSON, [`Evidence`](crate::view::Evidence).
    pub fn judge(&mut self, feedback: &str) -> Thrown<String> {
        json(&self.0.judge(feedback).map_err(thrown)?)
    }

    /// Nobody judges the last action, and that is no silence either: what the robot believes stays as it is, as a test wants it.
    pub fn unjudged(&mut self) {
        self.0.unjudged();
    }

    /// Proposes a question where it teaches more than acting does: JSON, [`Question`](crate::view::Question), or `null` where there is nothing
    /// to ask; empty while it is still looking ahead, with about `budget` looks a call. The plan must be done.
    pub fn question(&mut self, budget: u32) -> Thrown<String> {
        match self.0.question(budget).map_err(thrown)? {
            None => Ok(String::new()),
            Some(question) => json(&question),
        }
    }

    /// Which of `lessons`, a command on each line, the one in the simplest home first, teaches most of the commands in `wanted`: JSON,
    /// [`NextLesson`](crate::view::NextLesson), or `null` where none has a word that is wanted.
    #[wasm_bindgen(js_name = nextLesson)]
    pub fn next_lesson(&self, lessons: &str, wanted: &str) -> Thrown<String> {
        json(&self.0.next_lesson(lessons, wanted).map_err(thrown)?)
    }

    /// The question that waits for its answer: JSON, [`Question`](crate::view::Question), or `null`.
    #[wasm_bindgen(js_name = openQuestion)]
    pub fn open_question(&self) -> Thrown<String> {
        json(&self.0.open_question())
    }

    /// Takes in the answer to the question that was proposed last, `yes`, `no` (none of these) or the number of a choice from 1 on: JSON,
    /// [`Told`](crate::view::Told).
    pub fn answer(&mut self, answer: &str) -> Thrown<String> {
        json(&self.0.answer(answer).map_err(thrown)?)
    }

    /// Takes in an answer as a log has it: the names of its tasks on a line each, whether what is meant is among them, how often that is wrong,
    /// how many other answers there were, and its words where it is a correction.
    #[wasm_bindgen(js_name = answerAs)]
    pub fn answer_as(&mut self, tasks: &str, yes: bool, eta: f32, others: u8, words: &str) -> Thrown<()> {
        self.0.answer_as(tasks.lines().map(str::to_owned).collect(), yes, eta, others, words).map_err(thrown)
    }

    /// What a simulated trainer who means the given task says to the last action.
    #[wasm_bindgen(js_name = simulatedFeedback)]
    pub fn simulated_feedback(&mut self, intended: usize) -> Thrown<String> {
        self.0.simulated_feedback(intended).map(str::to_owned).map_err(thrown)
    }

    /// Ends the session and begins to learn from it. Gives the session as lines of a log.
    pub fn finish(&mut self) -> Thrown<String> {
        self.0.finish().map_err(thrown)
    }

    /// Goes on learning, with about `budget` table cells of work. Gives whether it is done.
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

    /// What the robot has learned, as the bytes of a model file.
    pub fn save(&self) -> Thrown<Vec<u8>> {
        self.0.save().map_err(thrown)
    }

    /// Replaces what the robot has learned by a model file; call `learn` until it is done. Throws where the file is none; what it knew then stays.
    pub fn restore(&mut self, bytes: &[u8]) -> Thrown<()> {
        self.0.restore(bytes).map_err(thrown)
    }

    /// Whether the home has room on a micro:bit.
    #[wasm_bindgen(js_name = fitsMicrobit)]
    pub fn fits_microbit(&self) -> bool {
        self.0.fits_microbit()
    }

    /// What the robot has learned, as a micro:bit takes it. Throws where it has no room there.
    #[wasm_bindgen(js_name = forMicrobit)]
    pub fn for_microbit(&self) -> Thrown<Vec<u8>> {
        self.0.for_microbit().map_err(thrown)
    }

    /// A new robot, which has learned nothing, in the same home.
    pub fn restart(&mut self) -> Thrown<()> {
        self.0.restart().map_err(thrown)
    }

    /// What the robot believes: JSON, [`Belief`](crate::view::Belief).
    pub fn belief(&self) -> Thrown<String> {
        json(&self.0.belief())
    }

    /// Begins to look where a task would lead from here.
    #[wasm_bindgen(js_name = lookAhead)]
    pub fn look_ahead(&mut self, task: usize) {
        self.0.look_ahead(task);
    }

    /// Goes on looking ahead, with about `budget` looks: JSON, [`Route`](crate::view::Route), or `null` where the task leads nowhere;
    /// empty while it is still looking.
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

    /// What every word means to the robot: JSON, [`Heat`](crate::view::Heat).
    pub fn heat(&self) -> Thrown<String> {
        json(&self.0.heat())
    }
}
