//! `goodbot diff`: the sessions and words that only one of two models has, and the words with another meaning.

use crate::words;
use crate::words::{FullWords, Lexicon, percent, token_words};
use clap::{Args, ValueHint};
use goodbot_console::{Failure, counted, output, restored};
use serde_json::json;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Print the differences of two models: sessions, words, and meanings of words
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
A word has shares in ideas, as in goodbot inspect. It has moved by the share that belongs to another idea than before: 0 % is the same \
meaning, 100 % another one.

Example:
  goodbot diff before.goodbot after.goodbot")]
pub struct DiffArgs {
    /// The model before
    #[arg(value_name = "A", value_hint = ValueHint::FilePath)]
    first: PathBuf,
    /// The model after
    #[arg(value_name = "B", value_hint = ValueHint::FilePath)]
    second: PathBuf,
    /// Print words that moved by this share or more: 0 to 1
    #[arg(long, value_name = "SHARE", default_value = "0.05", value_parser = share)]
    least: f32,
    /// Print a line of JSON for each difference
    #[arg(long)]
    json: bool,
}

fn share(text: &str) -> Result<f32, String> {
    let share: Option<f32> = text.trim().parse().ok();
    share.filter(|share| (0.0..=1.0).contains(share)).ok_or_else(|| "give a number from 0 to 1, such as 0.05".to_owned())
}

/// The shares of one word among ideas.
type Shares = BTreeMap<String, f32>;

/// The sessions and words of a model.
struct ModelContents {
    sessions: Vec<String>,
    words: BTreeMap<String, Shares>,
}

/// A word whose meaning has moved.
#[derive(Clone, Debug, PartialEq)]
struct Moved {
    word: String,
    /// The share that belongs to another idea than before.
    by: f32,
    /// The ideas whose shares changed, with their shares before and after, the largest change first.
    ideas: Vec<(String, f32, f32)>,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] names the file and its fault.
pub fn run(args: &DiffArgs) -> Result<(), Failure> {
    let [before, after] = [known(&args.first)?, known(&args.second)?];
    let (gone, added) = (without(&before.sessions, &after.sessions), without(&after.sessions, &before.sessions));
    let words = |known: &ModelContents| known.words.keys().cloned().collect::<Vec<_>>();
    let (old, new) = (words(&before), words(&after));
    let (forgotten, learned) = (without(&old, &new), without(&new, &old));
    let moved: Vec<Moved> = moved(&before.words, &after.words).into_iter().filter(|word| word.by >= args.least).collect();
    let mut out = output::text(&[])?;
    if args.json {
        let lists = [("session gone", &gone), ("session added", &added), ("word gone", &forgotten), ("word added", &learned)];
        for (kind, text) in lists.into_iter().flat_map(|(kind, texts)| texts.iter().map(move |text| (kind, text))) {
            writeln!(out, "{}", json!({"type": kind, "text": text}))?;
        }
        for Moved { word, by, ideas } in &moved {
            let ideas: Vec<_> =
                ideas.iter().map(|(token, before, after)| json!({"token": token, "before": before, "after": after})).collect();
            writeln!(out, "{}", json!({"type": "word moved", "text": word, "by": by, "ideas": ideas}))?;
        }
        return Ok(out.flush()?);
    }
    let [a, b] = [&args.first, &args.second].map(|file| file.display().to_string());
    for (name, known) in [(&a, &before), (&b, &after)] {
        writeln!(out, "{name}: {}, {}", counted(known.sessions.len(), "session"), counted(known.words.len(), "word"))?;
    }
    for (what, name, texts) in [("Sessions", &a, &gone), ("Sessions", &b, &added), ("Words", &a, &forgotten), ("Words", &b, &learned)] {
        if !texts.is_empty() {
            writeln!(out, "\n{what} that only {name} has:")?;
            texts.iter().try_for_each(|text| writeln!(out, "  {}", text))?;
        }
    }
    if !moved.is_empty() {
        writeln!(out, "\nWords whose meaning moved, and the ideas that they left or came to:")?;
    }
    for Moved { word, by, ideas } in &moved {
        let idea =
            |(token, before, after): &(String, f32, f32)| format!("{} {} → {}", token_words(token), percent(*before), percent(*after));
        let ideas: Vec<String> = ideas.iter().take(3).map(idea).collect();
        writeln!(out, "  {word:12} {:>5}  {}", percent(*by), ideas.join(", "))?;
    }
    if [&gone, &added, &forgotten, &learned].iter().all(|texts| texts.is_empty()) && moved.is_empty() {
        writeln!(out, "\nThey know the same.")?;
    }
    Ok(out.flush()?)
}

fn known(file: &Path) -> Result<ModelContents, Failure> {
    let agent = restored::model(file)?;
    let lexicon = Lexicon::of(agent.language());
    let full = FullWords::new(agent.language().settings().letters_kept());
    let shares = |column: usize| {
        let of = |row: &[f32]| row.get(column).copied().unwrap_or(0.0);
        let whole: f32 = lexicon.rows.iter().map(|(_, row)| of(row)).sum();
        lexicon.rows.iter().map(|(token, row)| (token.clone(), if whole > 0.0 { of(row) / whole } else { 0.0 })).collect()
    };
    let words = lexicon.words.iter().enumerate().map(|(column, word)| (full.of(word), shares(column))).collect();
    Ok(ModelContents { sessions: words::commands(&agent), words })
}

/// The texts that the others do not have. A text that is missing twice is listed twice.
fn without(texts: &[String], others: &[String]) -> Vec<String> {
    let mut left: BTreeMap<&str, usize> = BTreeMap::new();
    others.iter().for_each(|text| *left.entry(text).or_default() += 1);
    let is_missing = |text: &&String| match left.get_mut(text.as_str()) {
        Some(count) if *count > 0 => {
            *count -= 1;
            false
        }
        _ => true,
    };
    texts.iter().filter(is_missing).cloned().collect()
}

/// The words of both models, the most moved first.
fn moved(before: &BTreeMap<String, Shares>, after: &BTreeMap<String, Shares>) -> Vec<Moved> {
    let of = |shares: &Shares, token: &str| shares.get(token).copied().unwrap_or(0.0);
    let word = |(word, old): (&String, &Shares)| {
        let new = after.get(word)?;
        let mut tokens: Vec<&String> = old.keys().chain(new.keys()).collect();
        tokens.sort_unstable();
        tokens.dedup();
        let mut ideas: Vec<(String, f32, f32)> = tokens.into_iter().map(|token| (token.clone(), of(old, token), of(new, token))).collect();
        let by = ideas.iter().map(|(_, old, new)| (old - new).abs()).sum::<f32>() / 2.0;
        ideas.sort_by(|a, b| (b.1 - b.2).abs().total_cmp(&(a.1 - a.2).abs()));
        Some(Moved { word: word.clone(), by, ideas })
    };
    let mut moved: Vec<Moved> = before.iter().filter_map(word).collect();
    moved.sort_by(|a, b| b.by.total_cmp(&a.by));
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(texts: &[&str]) -> Vec<String> {
        texts.iter().map(|&text| text.to_owned()).collect()
    }

    #[test]
    fn a_session_that_was_said_twice_and_then_once_is_missing_once() {
        let (a, b) = (texts(&["go", "go", "stay"]), texts(&["stay", "go", "come"]));
        assert_eq!((without(&a, &b), without(&b, &a)), (texts(&["go"]), texts(&["come"])));
    }

    #[test]
    fn a_word_moves_by_the_part_that_another_idea_has_now() {
        let shares = |red: f32, blue: f32| Shares::from([("colorRed".to_owned(), red), ("colorBlue".to_owned(), blue)]);
        let [before, after] = [shares(0.75, 0.25), shares(0.5, 0.5)].map(|shares| BTreeMap::from([("red".to_owned(), shares)]));
        let moved = moved(&before, &after);
        assert_eq!((moved[0].word.as_str(), moved[0].by), ("red", 0.25));
    }
}
