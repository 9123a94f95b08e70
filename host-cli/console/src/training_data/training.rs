//! A language model trained on many sessions at once, with questions to it.

use super::{Lesson, MachineCommand};
use crate::typed;
use goodbot::capacity::CapacityError;
use goodbot::language::{LanguageModel, LanguageRef, Model, Settings};
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::planning::Progress;
use goodbot::probability::{Scaled, total};
use goodbot::symbols::Symbol;
use goodbot::task::{Marker, is_marker};
use goodbot::{AgentError, Capacities};
use goodbot_lesson::first_words::heard;
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

/// Memory for a language model of these lessons, without planning.
pub fn memory(lessons: &[Lesson], settings: &Settings) -> AgentHeap {
    typed::memory(&capacities(lessons, Capacities { states: 64, hashed_states: 0, ..Capacities::STANDARD }), settings, tasks(lessons))
}

/// The total number of possible tasks in these lessons.
pub fn tasks(lessons: &[Lesson]) -> usize {
    lessons.iter().map(|lesson| lesson.readings.len()).sum()
}

/// A lesson for each number of the worlds of these lessons: its digits mean each task with it. So "75" is understood in every language
/// before it was taught. The lessons have no possible tasks, because the layer understood less when it learned from them.
///
/// Numbers with equal keys get one lesson.
fn numbers<'l, K: Ord>(lessons: impl IntoIterator<Item = &'l Lesson>, key: impl Fn(&'l str, &'l Lesson) -> K) -> Vec<Lesson> {
    let (mut known, mut numbers) = (BTreeSet::new(), Vec::new());
    for lesson in lessons {
        for (token, digits) in lesson.numbers.iter() {
            // A look at all tasks takes long, so a known number is not looked for again.
            let key = key(token, lesson);
            if known.contains(&key) {
                continue;
            }
            let commands = lesson.readings.iter().filter_map(|reading| reading.commands.first());
            let with_it: Vec<&MachineCommand> = commands.filter(|command| command.contains(token)).collect();
            if with_it.is_empty() {
                continue;
            }
            known.insert(key);
            let share = 1.0 / with_it.len() as f32;
            let pairs = with_it.into_iter().map(|command| (command.clone(), share)).collect();
            numbers.push(Lesson { command: digits.clone(), pairs, beliefs: vec![], readings: Arc::default(), ..lesson.clone() });
        }
    }
    numbers
}

/// Capacities for these lessons, and at least `least`.
pub fn capacities(lessons: &[Lesson], least: Capacities) -> Capacities {
    let (mut words, mut commands) = (BTreeSet::new(), BTreeSet::new());
    let (mut lengths, mut sentence_words, mut pairs) = (BTreeSet::new(), 0, 0);
    // A part of the lessons may know a number from any of their worlds.
    let numbers = numbers(lessons, |token, lesson| (token, lesson.readings.as_ptr()));
    for lesson in lessons.iter().chain(&numbers) {
        // The words as each model reads them. A command that is too long has only its first words here.
        let [count, pieces] = [Model::Model2, Model::Roles].map(|model| {
            let heard = heard(model, &lesson.command).unwrap_or_default();
            let count = heard.len();
            words.extend(heard);
            count
        });
        sentence_words += pieces.max(count);
        pairs += lesson.pairs.len();
        for (command, _) in &lesson.pairs {
            lengths.insert((command.len(), count));
            commands.insert(command);
        }
    }
    let (spare, named) = (64, to_name_tasks(lessons));
    let (word_count, token_count) = (words.len() + spare, named.tokens + spare);
    Capacities {
        words: least.words.max(word_count),
        word_bytes: least.word_bytes.max(words.iter().map(String::len).sum::<usize>() + 16 * spare),
        tokens: least.tokens.max(token_count),
        token_bytes: least.token_bytes.max(named.token_bytes + 32 * spare),
        commands: least.commands.max(commands.len()),
        command_tokens: least.command_tokens.max(commands.iter().map(|command| command.len()).sum()),
        sessions: least.sessions.max(lessons.len() + numbers.len()),
        sentence_words: least.sentence_words.max(sentence_words),
        pairs: least.pairs.max(pairs),
        translations: least.translations.max((token_count + 1) * word_count),
        alignments: least.alignments.max(lengths.iter().map(|(machine, english)| (machine + 1) * english).sum()),
        length_pairs: least.length_pairs.max(lengths.len()),
        ..least
    }
}

/// Capacities for the machine tokens of all possible tasks in these lessons.
pub fn to_name_tasks<'l>(lessons: impl IntoIterator<Item = &'l Lesson>) -> Capacities {
    let (mut counted, mut tokens) = (BTreeSet::new(), BTreeSet::new());
    for lesson in lessons {
        // Lessons in one world share their tasks.
        if counted.insert(lesson.readings.as_ptr()) {
            tokens.extend(lesson.readings.iter().flat_map(|reading| &reading.commands).flatten());
        }
    }
    let token_bytes = tokens.iter().map(|token| token.len()).sum();
    Capacities { tokens: tokens.len(), token_bytes, ..Capacities::NONE }
}

/// Trains a model on lessons, from uniform parameters.
///
/// # Errors
/// An [`AgentError`] if the memory was made for fewer lessons, or a setting is out of range.
pub fn train<'m, 'l>(
    memory: &'m mut AgentHeap,
    lessons: impl Iterator<Item = &'l Lesson>,
    settings: Settings,
) -> Result<LanguageModel<&'m mut AgentHeap>, AgentError> {
    let mut model = data(memory, lessons, settings)?;
    model.lend().begin_training();
    while model.lend().train(u32::MAX) == Progress::Working {}
    Ok(model)
}

/// A model with these lessons and the numbers of their worlds, before training.
///
/// # Errors
/// The errors of [`train`].
pub fn data<'m, 'l>(
    memory: &'m mut AgentHeap,
    lessons: impl Iterator<Item = &'l Lesson>,
    settings: Settings,
) -> Result<LanguageModel<&'m mut AgentHeap>, AgentError> {
    let mut model = LanguageModel::new(memory, settings)?;
    let mut interned = Interned::of(&model);
    let lessons: Vec<&Lesson> = lessons.filter(|lesson| lesson.learn).collect();
    let numbers = if settings.model == Model::Roles { numbers(lessons.iter().copied(), |token, _| token) } else { vec![] };
    for lesson in lessons.into_iter().chain(&numbers) {
        let sentence = model.lend().hear(&lesson.command)?;
        let pairs: Vec<(Vec<Symbol>, f32)> = lesson
            .pairs
            .iter()
            .map(|(command, share)| {
                let command = symbols(&mut model, command)?;
                // The layer compares it with the descriptions of the possible tasks.
                Ok((if settings.layer { in_order(lesson, command) } else { command }, *share))
            })
            .collect::<Result<_, CapacityError>>()?;
        model.lend().add_session(&sentence, pairs.iter().map(|(command, share)| (&command[..], *share)))?;
        if settings.layer {
            let possible = possible(&mut model, lesson, &mut interned)?;
            model.lend().add_possible(possible.iter().map(|(description, prior)| (&description[..], *prior)))?;
        }
    }
    Ok(model)
}

/// The descriptions of a lesson's tasks, without repetition, with their prior probabilities.
fn possible(
    model: &mut LanguageModel<impl AgentMemory>,
    lesson: &Lesson,
    interned: &mut Interned,
) -> Result<Vec<(Vec<Symbol>, f32)>, CapacityError> {
    let mut possible: Vec<(Vec<Symbol>, f32)> = Vec::new();
    let mut known: HashMap<Vec<Symbol>, usize> = HashMap::new();
    for reading in &*lesson.readings {
        let Some(description) = reading.commands.first() else { continue };
        let description = in_order(lesson, interned.symbols(model, description)?);
        match known.get(&description).and_then(|&at| possible.get_mut(at)) {
            Some((_, prior)) => *prior += reading.prior,
            None => {
                known.insert(description.clone(), possible.len());
                possible.push((description, reading.prior));
            }
        }
    }
    Ok(possible)
}

/// A description with the values of each group sorted by this model's symbols, as a robot describes the task; the log's reader has other
/// symbols. Worlds keep the order of their file: their commands are understood more often that way.
fn in_order(lesson: &Lesson, mut description: Vec<Symbol>) -> Vec<Symbol> {
    if lesson.world.is_some() {
        return description;
    }
    let values = description.get_mut(1..).unwrap_or_default();
    values.split_mut(|&symbol| is_marker(symbol)).for_each(<[Symbol]>::sort_unstable);
    description
}

/// The symbols of tokens, each looked up once: a world may have thousands of tasks that share thousands of tokens.
struct Interned {
    symbols: HashMap<String, Symbol>,
}

impl Interned {
    /// The symbols of a model.
    fn of(model: &LanguageModel<impl AgentMemory>) -> Self {
        Self { symbols: model.read().tokens().iter().map(|(symbol, text)| (text.to_owned(), symbol)).collect() }
    }

    fn symbols(&mut self, model: &mut LanguageModel<impl AgentMemory>, command: &MachineCommand) -> Result<Vec<Symbol>, CapacityError> {
        let symbol = |token: &String| match self.symbols.get(token) {
            Some(&known) => Ok(known),
            None => {
                let symbol = symbol(model, token)?;
                self.symbols.insert(token.clone(), symbol);
                Ok(symbol)
            }
        };
        command.iter().map(symbol).collect()
    }
}

fn symbol(model: &mut LanguageModel<impl AgentMemory>, token: &str) -> Result<Symbol, CapacityError> {
    match token.parse::<Marker>() {
        Ok(marker) => Ok(marker.symbol()),
        Err(_) => model.lend().tokens_mut().intern(token),
    }
}

/// The symbols of a machine command.
pub fn symbols(model: &mut LanguageModel<impl AgentMemory>, command: &MachineCommand) -> Result<Vec<Symbol>, CapacityError> {
    command.iter().map(|token| symbol(model, token)).collect()
}

/// Pr(t|e,s) for each task of a lesson.
///
/// # Errors
/// A [`CapacityError`] if the command does not fit.
pub fn posterior(model: &mut LanguageModel<impl AgentMemory>, lesson: &Lesson) -> Result<Vec<f32>, CapacityError> {
    let sentence = model.lend().hear(&lesson.command)?;
    let (mut scores, mut forms, mut descriptions, mut interned) = (Vec::new(), Vec::new(), Vec::new(), Interned::of(model));
    for reading in &*lesson.readings {
        // The same order of operations as in a robot, so that both give the same bits.
        let share = 1.0 / reading.commands.len().max(1) as f32;
        let (mut sum, mut description) = (Scaled::ZERO, None);
        for command in &reading.commands {
            let command = interned.symbols(model, command)?;
            if forms.len() == scores.len() {
                forms.extend(command.first().copied());
            }
            sum = sum.plus(model.read().likelihood(&sentence, &command).scaled_by(share));
            description.get_or_insert_with(|| in_order(lesson, command));
        }
        scores.push(sum.scaled_by(reading.prior));
        descriptions.push(description.unwrap_or_default());
    }
    let form = |task: usize| forms.get(task).copied().unwrap_or(Symbol::new(0));
    let prior = |task: usize| lesson.readings.get(task).map_or(0.0, |reading| reading.prior);
    model.read().weigh_kinds(&sentence, form, prior, &mut scores);
    if model.read().settings().layer {
        weigh_parts(model.read(), &descriptions, &sentence, &mut scores);
    }
    model.lend().forget_unlearned();
    let whole = total(scores.iter().copied());
    Ok(scores.into_iter().map(|score| score.over(whole)).collect())
}

/// Multiplies the scores by the layer's weights.
fn weigh_parts(model: LanguageRef<'_>, descriptions: &[Vec<Symbol>], sentence: &[Option<Symbol>], scores: &mut [Scaled]) {
    let mut firsts: HashMap<&Vec<Symbol>, usize> = HashMap::new();
    for (task, description) in descriptions.iter().enumerate() {
        firsts.entry(description).or_insert(task);
    }
    let same = |task: usize| descriptions.get(task).and_then(|description| firsts.get(description)).copied().unwrap_or(task);
    let description = |task: usize| descriptions.get(task).map_or(&[][..], |description| &description[..]);
    model.weigh_parts(sentence, same, description, scores);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Learner;
    use crate::training_data::worlds;
    use goodbot_formats::world::{Line, WorldReader};

    /// Two heaters, which can be set to 10, 20.5, 30 or 40.
    const WORLD: &str = r#"{"type":"world","name":"flat","classes":["heater","number"],"attributes":{"room":["heater"],"value":["number"]},"propositions":{"heatAt":["heater","number"]},"objects":[{"name":"a","class":"heater","attributes":{"room":"kitchen"}},{"name":"b","class":"heater","attributes":{"room":"bath"}},{"name":"low","class":"number","attributes":{"value":"number10"}},{"name":"half","class":"number","attributes":{"value":"number20_5"}},{"name":"warm","class":"number","attributes":{"value":"number30"}},{"name":"hot","class":"number","attributes":{"value":"40"}}],"task_kinds":["heatAt(?x,?y)"]}"#;

    #[test]
    fn a_number_is_understood_before_it_was_taught() {
        let said = [("a", "küche"), ("b", "bad")].map(|(heater, room)| {
            format!(r#"{{"type":"command","world":"flat","command":"{room} auf 10","intended":["heatAt({heater},low)"]}}"#)
        });
        let (mut lessons, mut left) = (vec![], usize::MAX);
        let options = Learner::Default.options();
        let log = [WORLD, &said[0], &said[1]].join("\n");
        worlds::read("log", log.as_bytes(), options, None, &mut left, |lesson| {
            lessons.extend(lesson?);
            Ok::<(), goodbot_lesson::Fault>(())
        })
        .unwrap();
        let mut memory = memory(&lessons, &options.language);
        let mut model = train(&mut memory, lessons.iter(), options.language).unwrap();
        let Some(Ok(Line::World(world))) = WorldReader::new(WORLD.as_bytes()).next() else { panic!("a world") };
        for (command, meant) in [
            ("küche auf 20.5", "heatAt(a,half)"),
            ("bad auf 30%", "heatAt(b,warm)"),
            ("bad auf 40", "heatAt(b,hot)"),
            ("küche 10", "heatAt(a,low)"),
        ] {
            let asked = worlds::question("world", &world, command, options).unwrap();
            let posterior = posterior(&mut model, &asked).unwrap();
            let best = posterior.iter().zip(&*asked.readings).max_by(|one, other| one.0.total_cmp(other.0)).unwrap();
            assert_eq!(best.1.name.to_string(), meant, "{command}");
        }
    }
}
