//! The evidence of each word for a task.
//!
//! All data about single words come from [`words`]. Another language model needs only another function here.

use goodbot::language::{LanguageRef, Meaning, Model};
use goodbot::memory::AgentMemory;
use goodbot::oomdp::{Domain, Schema};
use goodbot::symbols::Symbol;
use goodbot::task::{Role, RoleKind};
use goodbot::{Agent, AgentError};
use goodbot_console::evidence;
use goodbot_console::training_data::MachineCommand;
use goodbot_lesson::first_words::heard;

/// The explanation of a word.
#[derive(Clone, Debug)]
pub struct Word {
    /// The word as in the command.
    pub word: String,
    /// The machine token that explains it best, `NULL` for none.
    pub token: String,
    /// That token's share of the word's probability.
    pub share: f32,
    /// The word's probability given the task; `None` for a word never heard, or left out.
    pub probability: Option<f32>,
    /// The learned word that it counts as, if that is another one.
    pub taken_for: Option<String>,
}

/// The token of a word that training never had.
const NEVER_HEARD: &str = "never heard";

impl Word {
    /// Whether training never had the word.
    pub fn is_never_heard(&self) -> bool {
        self.token == NEVER_HEARD
    }
}

/// The learned word that a word counts as, if that is another one, because they begin alike or one is misspelt: the robot cannot tell them
/// apart, so whoever asks must know.
pub fn taken_for(language: LanguageRef<'_>, word: &str) -> Option<String> {
    // Model 2 keeps no whole words.
    let known = language.known_as(word).filter(|_| language.settings().model == Model::Roles);
    known.filter(|known| *known != word).map(str::to_owned)
}

/// What an answer tells of words that no lesson had: those never heard, and those taken for another with it.
pub fn new_words<'w>(words: impl Iterator<Item = (&'w str, bool, Option<&'w str>)>) -> Vec<String> {
    let (mut never_heard, mut taken) = (Vec::new(), Vec::new());
    for (word, is_never_heard, taken_for) in words {
        if is_never_heard {
            never_heard.push(format!("{word:?}"));
        } else if let Some(known) = taken_for {
            taken.push(format!("{word:?} is new, and taken for {known:?}"));
        }
    }
    taken.dedup();
    if !never_heard.is_empty() {
        taken.insert(0, format!("never heard: {}", never_heard.join(", ")));
    }
    taken
}

/// The words that the agent has listened to in `start`, each with its best explanation if the task is meant: a role and its value, or a
/// machine token of the task's most likely machine command. Words that the robot did not take for a part of the command are `left out`.
///
/// # Errors
/// An [`AgentError`] if the task does not fit.
pub fn words<D: Domain>(
    agent: &mut Agent<impl AgentMemory>,
    domain: &D,
    start: &D::State,
    command: &str,
    task: usize,
) -> Result<Vec<Word>, AgentError> {
    let Some(grounded) = agent.tasks().get(task) else { return Ok(vec![]) };
    let commands = evidence::commands(domain, agent.lifted(), grounded, start, agent.options())?;
    if agent.options().language.model == Model::Roles {
        let description = commands.into_iter().next().unwrap_or_default();
        return words_by_roles(agent, domain, &description, command, task);
    }
    let language = agent.language();
    let find = |command: &MachineCommand| -> Option<Vec<Symbol>> { command.iter().map(|token| language.tokens().find(token)).collect() };
    let commands: Vec<Vec<Symbol>> = commands.iter().filter_map(find).collect();
    let sentence = agent.sentence();
    let likelier = |best: Option<Vec<Symbol>>, command: Vec<Symbol>| match best {
        Some(best) if !language.likelihood(sentence, &command).exceeds(language.likelihood(sentence, &best)) => Some(best),
        _ => Some(command),
    };
    let Some(best) = commands.into_iter().fold(None, likelier) else { return Ok(vec![]) };
    let said = heard(Model::Model2, command).unwrap_or_default();
    Ok(words_by_tokens(language, sentence, &best, &said))
}

/// Model 2's explanation of each word by the tokens of a machine command.
fn words_by_tokens(language: LanguageRef<'_>, sentence: &[Option<Symbol>], tokens: &[Symbol], said: &[String]) -> Vec<Word> {
    let tables = language.tables();
    let word = |(i, &word): (usize, &Option<Symbol>)| {
        let known = word.filter(|word| word.index() < tables.words());
        let part = |j: usize, token: Option<Symbol>| {
            known.map_or(0.0, |word| tables.alignment(j, i, tokens.len(), sentence.len()) * tables.translation(word, token))
        };
        let parts: Vec<f32> =
            std::iter::once(None).chain(tokens.iter().copied().map(Some)).enumerate().map(|(j, token)| part(j, token)).collect();
        let whole: f32 = parts.iter().sum();
        let best = parts.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(j, _)| j);
        let token = best.checked_sub(1).and_then(|j| tokens.get(j)).map_or("NULL", |&token| language.tokens().text(token));
        let in_model = || word.map_or_else(String::new, |word| language.words().text(word).to_owned());
        Word {
            word: said.get(i).cloned().unwrap_or_else(in_model),
            token: if known.is_some() { token } else { NEVER_HEARD }.to_owned(),
            share: if whole > 0.0 { parts.get(best).copied().unwrap_or(0.0) / whole } else { 0.0 },
            probability: known.map(|_| whole),
            taken_for: None,
        }
    };
    sentence.iter().enumerate().map(word).collect()
}

/// The role model's explanation of each word.
fn words_by_roles<D: Domain>(
    agent: &mut Agent<impl AgentMemory>,
    domain: &D,
    description: &MachineCommand,
    command: &str,
    task: usize,
) -> Result<Vec<Word>, AgentError> {
    let mut meanings: Vec<Option<(Meaning, f32)>> = vec![None; agent.sentence().len()];
    agent.explain(domain, task, |position, meaning, share| {
        if let Some(slot) = meanings.get_mut(position).filter(|slot| slot.is_none_or(|(_, most)| share > most)) {
            *slot = Some((meaning, share));
        }
    })?;
    let (language, sentence) = (agent.language(), agent.sentence());
    let mut probabilities = vec![0.0; sentence.len()];
    language.word_by_word(sentence, &evidence::description_symbols(language, description), |position, probability| {
        if let Some(slot) = probabilities.get_mut(position) {
            *slot = probability;
        }
    });
    let schema = domain.world().schema;
    let is_known = |word: &Symbol| word.index() < language.tables().words();
    let told = |position: usize| {
        let heard = sentence.get(position).copied().flatten().filter(is_known);
        let meaning = meanings.get(position).copied().flatten();
        let token = match meaning.filter(|_| heard.is_some()) {
            None => NEVER_HEARD.to_owned(),
            Some((Meaning::Background, _)) => "no meaning".to_owned(),
            Some((Meaning::Task, _)) => "kind of task".to_owned(),
            Some((Meaning::Value(role, value), _)) => format!("{} {}", role_name(&schema, role), language.tokens().text(value)),
        };
        let probability = heard.and_then(|_| probabilities.get(position).copied());
        (token, meaning.map_or(0.0, |(_, share)| share), probability)
    };
    // The sentence has some of the words, each as itself or as the known word that it is a slip of.
    let mut left: Vec<usize> = (0..sentence.len()).collect();
    let mut take = |of: &dyn Fn(Option<Symbol>) -> bool| {
        let at = left.iter().position(|&at| of(sentence.get(at).copied().flatten()))?;
        Some(left.remove(at))
    };
    let (said, all) = (heard(Model::Roles, command).unwrap_or_default(), language.words());
    let symbols: Vec<Option<Symbol>> = said.iter().map(|word| all.find(word)).collect();
    let mut positions: Vec<Option<usize>> = symbols.iter().map(|&symbol| take(&|other| other == symbol)).collect();
    for (position, symbol) in positions.iter_mut().zip(&symbols) {
        if position.is_none() && !symbol.is_some_and(|word| is_known(&word)) {
            *position = take(&|_| true);
        }
    }
    let word = |(word, position, symbol): (String, Option<usize>, Option<Symbol>)| {
        let (token, share, probability) = match position {
            Some(position) => told(position),
            None if symbol.is_some_and(|word| is_known(&word)) => ("left out".to_owned(), 0.0, None),
            None => (NEVER_HEARD.to_owned(), 0.0, None),
        };
        let taken_for = taken_for(language, &word);
        Word { word, token, share, probability, taken_for }
    };
    Ok(said.into_iter().zip(positions).zip(symbols).map(|((said, position), symbol)| word((said, position, symbol))).collect())
}

/// A role in words.
fn role_name(schema: &Schema<'_>, role: Role) -> String {
    match role.kind() {
        RoleKind::Goal => format!("goal of {}", schema.proposition_name(role.proposition())),
        RoleKind::Subject => format!("subject of {}", schema.proposition_name(role.proposition())),
        RoleKind::Start => format!("start of {}", schema.proposition_name(role.proposition())),
        RoleKind::Through => format!("through {}", schema.proposition_name(role.proposition())),
        RoleKind::Avoiding => format!("avoiding {}", schema.proposition_name(role.proposition())),
        RoleKind::Before => format!("earlier goal {}", schema.proposition_name(role.proposition())),
        RoleKind::OtherPlace | RoleKind::Other => format!("other {}", schema.class_name(role.class())),
    }
}
