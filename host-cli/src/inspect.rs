//! `goodbot inspect`: the words of a model, and their meanings.

use crate::paper::summary;
use crate::words::{self, FullWords, Lexicon};
use clap::{Args, ValueHint};
use goodbot::language::Settings;
use goodbot_console::load::kinds::{kept, texts};
use goodbot_console::{Failure, Output, between, counted, output, read_model, restored};
use serde_json::json;
use std::io::Write;
use std::path::PathBuf;

/// The options of `goodbot inspect`.
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  goodbot inspect words.goodbot --plot words.svg")]
pub struct InspectOptions {
    /// A model that `goodbot learn` wrote
    #[arg(value_name = "MODEL", value_hint = ValueHint::FilePath)]
    model: PathBuf,
    /// Number of words of each token, and of tokens of each word: 1 to 1000
    #[arg(long, short = 'n', value_name = "N", default_value = "8", value_parser = between(1_usize, 1_000))]
    most: usize,
    /// Write a heat map of the most telling words; - is standard output
    #[arg(long, value_name = "FILE.svg", value_hint = ValueHint::FilePath)]
    plot: Option<PathBuf>,
    /// Replace a file that is no picture of goodbot's
    #[arg(long, requires = "plot")]
    force: bool,
    /// Print the sessions with their numbers, the oldest first, and nothing else; goodbot unlearn takes one out
    #[arg(long, conflicts_with = "plot")]
    sessions: bool,
    /// Print a line of JSON for each token and each word
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(options: &InspectOptions) -> Result<(), Failure> {
    let target = Output::picture(&options.plot, [&options.model], options.force)?;
    let agent = restored::model(&options.model)?;
    if options.sessions {
        let mut out = output::text(&[])?;
        for (number, command) in (1..).zip(words::commands(&agent)) {
            if options.json {
                writeln!(out, "{}", json!({"type": "session", "number": number, "command": command}))?;
            } else {
                writeln!(out, "{number:>5}  {command}")?;
            }
        }
        return Ok(out.flush()?);
    }
    let mut lexicon = Lexicon::of(agent.language());
    let full = FullWords::new(agent.language().settings().letters_kept());
    lexicon.words.iter_mut().for_each(|word| *word = full.of(word));
    let mut out = output::text(&[target.as_ref()])?;
    // The picture comes first, so that it is written even if the reader of the text stops early.
    if let Some(target) = &target {
        target.draw(summary::learned_words(&telling(&lexicon)))?;
    }
    if !options.json {
        let sessions = counted(agent.language().bitext().sessions(), "session");
        writeln!(out, "{sessions}, {}{}", counted(lexicon.words.len(), "word"), alike(agent.language().settings()))?;
        if let Some(kinds) = kept(&options.model, &read_model(&options.model)?)? {
            writeln!(out, "for the kinds of task {}", texts(&kinds).join("; "))?;
        }
        writeln!(out, "\nThe words of each machine token: t(word | token)")?;
    }
    for (token, row) in &lexicon.rows {
        let words = lexicon.best(row, options.most);
        if options.json {
            let words: serde_json::Map<_, _> = words.iter().map(|&(word, t)| (word.to_owned(), json!(t))).collect();
            writeln!(out, "{}", json!({"type": "token", "token": token, "words": words}))?;
        } else {
            let words: Vec<String> = words.iter().map(|(word, t)| format!("{word} {t:.2}")).collect();
            writeln!(out, "  {token:18} {}", words.join("  "))?;
        }
    }
    if !options.json {
        writeln!(out, "\nThe machine tokens of each word, by their share of it")?;
    }
    for (column, word) in lexicon.words.iter().enumerate() {
        let mut tokens: Vec<(&str, f32)> =
            lexicon.rows.iter().map(|(token, row)| (token.as_str(), row.get(column).copied().unwrap_or(0.0))).collect();
        let whole: f32 = tokens.iter().map(|(_, t)| t).sum();
        tokens.sort_by(|a, b| b.1.total_cmp(&a.1));
        tokens.truncate(options.most);
        if options.json {
            let tokens: serde_json::Map<_, _> = tokens.iter().map(|&(token, t)| (token.to_owned(), json!(t / whole))).collect();
            writeln!(out, "{}", json!({"type": "word", "word": word, "tokens": tokens}))?;
        } else {
            let tokens: Vec<String> = tokens.iter().take(4).map(|(token, t)| format!("{token} {:.2}", t / whole)).collect();
            writeln!(out, "  {word:12} {}", tokens.join("  "))?;
        }
    }
    Ok(out.flush()?)
}

/// The remark on words that count as one.
fn alike(settings: &Settings) -> String {
    match (settings.word_letters, settings.letters_kept()) {
        (0, _) => String::new(),
        (letters, 0) => format!("; words with the same first {letters} letters count as one, shown as the first of them"),
        (letters, _) => format!("; words are known by their first {letters} letters"),
    }
}

/// The words with the highest probabilities: a picture of hundreds of words shows none.
fn telling(lexicon: &Lexicon) -> Lexicon {
    const MOST: usize = 40;
    let largest = |column: usize| lexicon.rows.iter().filter_map(|(_, row)| row.get(column).copied()).fold(0.0, f32::max);
    let mut columns: Vec<usize> = (0..lexicon.words.len()).collect();
    columns.sort_by(|&a, &b| largest(b).total_cmp(&largest(a)));
    columns.truncate(MOST);
    Lexicon {
        words: columns.iter().filter_map(|&column| lexicon.words.get(column).cloned()).collect(),
        rows: lexicon
            .rows
            .iter()
            .map(|(token, row)| (token.clone(), columns.iter().filter_map(|&column| row.get(column).copied()).collect()))
            .collect(),
    }
}
