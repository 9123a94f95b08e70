//! `goodbot acts`: trains the [acceptance](goodbot::talk::ACTS_FROM), the model that decides whether a robot acts on what was said.
//!
//! - [`sets`]: sentences with their meanings;
//! - [`readings`]: a robot's readings of them, and which are right;
//! - [`fit`]: the weights that fit best.

pub mod fit;
pub mod readings;
pub mod sets;

use clap::{Args, ValueHint};
use fit::{Example, Fitted, Prices};
use goodbot::talk::{ACTS_FROM, CLUES, HASHED, KINDS, Trained, Weights, clue_name};
use goodbot_console::messages::bar;
use goodbot_console::outcome::Failure;
use goodbot_console::output::{self, Kind, Output};
use rayon::prelude::*;
use readings::{Did, Read, Said};
use serde_json::json;
use sets::Set;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::PathBuf;

/// Before the name of an author whose sentences are for training alone.
const FOR_TRAINING: char = '+';

/// The probabilities above which robots are tried.
const ABOVE: [f64; 9] = [0.6, 0.7, 0.75, 0.78, ACTS_FROM as f64, 0.82, 0.84, 0.86, 0.9];

/// The options of `goodbot acts`.
#[derive(Debug, Args)]
#[command(after_help = "\
SETS has a line for each set of sentences, with five columns parted by tabs: its author, its language, a model that `goodbot learn` wrote, a home,
and a file of sentences. A sentence's line has its kind, its words, and its meaning: `none`, or tasks joined by ` then ` (in this order) or ` and `
(in any order); ` or ` parts meanings of which each is right. Words before ` ||| ` were said and followed before. The sentences of an author whose
name begins with `+` are for training alone, and left out with those of the same name without it.

A robot with the model reads each sentence in the home. The weights are fitted to tell its right readings from the others. The table is of weights
fitted without the sentences of their author: \"read\" is the share of sentences with a meaning that have a right reading, \"first\" of those where it is
the most probable, \"helpful\" is the share of sentences with a meaning that the robot would follow rightly, \"harmful\" the
share of all sentences on which it would act wrongly. The last rows are of each kind of sentence.

Examples:
  goodbot acts lab/acts/sets.tsv --weights core/src/talk/acceptance/weights.acts
  goodbot acts lab/acts/first-looks.tsv --first-look")]
pub struct ActsOptions {
    /// A list of sets of sentences
    #[arg(value_name = "SETS", value_hint = ValueHint::FilePath)]
    sets: PathBuf,
    /// Ask the decision that the library has, and fit nothing: a first look at sentences that it never saw
    #[arg(long, conflicts_with_all = ["weights", "explain", "price", "most", "folds"])]
    first_look: bool,
    /// Write the weights, for the library and for --acts of `goodbot ask`
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    weights: Option<PathBuf>,
    /// Replace a file that has no weights
    #[arg(long, requires = "weights")]
    force: bool,
    /// Print the weights, the largest first
    #[arg(long)]
    explain: bool,
    /// The price of the square of a weight: larger prices make smaller weights
    #[arg(long, value_name = "PRICE", default_value = "0.5")]
    price: f32,
    /// How many words may have weights
    #[arg(long, value_name = "NUMBER", default_value = "15000")]
    most: usize,
    /// Leave the authors out in so many groups, dealt out in the order of their names, instead of one at a time: faster
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(2..))]
    folds: Option<u16>,
    /// Print lines of JSON
    #[arg(long)]
    json: bool,
}

/// The figures of some sentences.
#[derive(Clone, Copy, Debug, Default)]
struct Figures {
    sentences: usize,
    meant: usize,
    /// Of those with a meaning: how many have a right reading, and how many one that is the most probable.
    read: usize,
    first: usize,
    helpful: usize,
    harmful: usize,
    /// Of the sentences that the robot acts on: the sum of its probabilities, and how many it understood.
    said: f64,
    acted: usize,
    right: usize,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &ActsOptions) -> Result<(), Failure> {
    let target = options.weights.as_ref().map(|file| Output::new(Kind::Weights, file, [&options.sets], options.force)).transpose()?;
    let sets = sets::read(&options.sets)?;
    let said = read(&sets, options.first_look)?;
    let prices = Prices { square: options.price, most: options.most };
    let mut out = output::text(&[target.as_ref()])?;
    let mut authors: Vec<&str> = said.iter().map(|said| said.author.as_str()).filter(|author| !author.starts_with(FOR_TRAINING)).collect();
    authors.sort_unstable();
    authors.dedup();
    if options.first_look {
        let different = |of: fn(&Said) -> &str| said.iter().map(of).collect::<BTreeSet<&str>>();
        let (languages, kinds) = (different(|it| &it.language), different(|it| &it.kind));
        let mut first_look = |author: &str, language: &str, kind: &str| {
            let is = |it: &&Said| {
                [(author, &it.author), (language, &it.language), (kind, &it.kind)].iter().all(|(of, it)| of.is_empty() || of == it)
            };
            tell_first_look(
                &mut out,
                options.json,
                [author, language, kind],
                &said.iter().filter(is).fold(Figures::default(), Figures::and_first_look),
            )
        };
        for author in authors.iter().copied().chain([""]) {
            [""].into_iter().chain(languages.iter().copied()).try_for_each(|language| first_look(author, language, ""))?;
        }
        kinds.iter().try_for_each(|kind| first_look("", "", kind))?;
        return Ok(out.flush()?);
    }
    if authors.len() > 1 {
        let folds = options.folds.map_or(authors.len(), |folds| authors.len().min(folds.into()));
        let fold_of = |author: &str| authors.iter().position(|it| *it == author.trim_start_matches(FOR_TRAINING)).map(|at| at % folds);
        let progress = bar(folds, "leaving authors out");
        let without = |fold: usize| {
            let fitted = fitted_to(&said, &|it| fold_of(&it.author) != Some(fold), prices);
            progress.inc(1);
            fitted
        };
        let fitted: Vec<Fitted> = (0..folds).into_par_iter().map(without).collect();
        progress.finish_and_clear();
        let fitted = || fitted.iter().cycle();
        let of = |author: &str, language: &str, fitted: &Fitted, above: f64| {
            figures(said.iter().filter(|it| it.author == author && (language.is_empty() || it.language == language)), fitted, above)
        };
        for (author, fitted) in authors.iter().zip(fitted()) {
            let mut languages: Vec<&str> = said.iter().filter(|it| it.author == *author).map(|it| it.language.as_str()).collect();
            languages.sort_unstable();
            languages.dedup();
            for (language, above) in languages.iter().flat_map(|language| ABOVE.map(|above| (language, above))) {
                if options.json || above == f64::from(ACTS_FROM) {
                    tell(&mut out, options.json, [author, language, ""], above, &of(author, language, fitted, above))?;
                }
            }
        }
        let left_out = |kind: &str, above: f64| {
            let is_in = |it: &&Said, author: &str| it.author == author && (kind.is_empty() || it.kind == kind);
            let each =
                authors.iter().zip(fitted()).map(|(author, fitted)| figures(said.iter().filter(|it| is_in(it, author)), fitted, above));
            each.fold(Figures::default(), |all, figures| all.and(&figures))
        };
        for above in (50..100)
            .map(|hundredth| f64::from(hundredth) / 100.0)
            .filter(|above| options.json || ABOVE.iter().any(|it| (it - above).abs() < 1e-3))
        {
            tell(&mut out, options.json, ["left out", "", ""], above, &left_out("", above))?;
        }
        let kinds: BTreeSet<&str> = said.iter().filter(|it| !it.author.starts_with(FOR_TRAINING)).map(|it| it.kind.as_str()).collect();
        for kind in kinds {
            let above = f64::from(ACTS_FROM);
            tell(&mut out, options.json, ["left out", "", kind], above, &left_out(kind, above))?;
        }
    }
    let fitted = fitted_to(&said, &|_| true, prices);
    tell(&mut out, options.json, ["fitted", "", ""], f64::from(ACTS_FROM), &figures(said.iter(), &fitted, f64::from(ACTS_FROM)))?;
    if options.explain {
        explain(&mut out, &said, &fitted)?;
    }
    if let Some(target) = target {
        let bytes = bytes(&fitted);
        Weights::new(&bytes).map_err(|error| Failure::Input(format!("{}: {error}; try a smaller --most", target.name())))?;
        target.write(&bytes)?;
        writeln!(out, "weights of {} clues and {} words in {}", fitted.clues.len(), fitted.words.len(), target.name())?;
    }
    Ok(out.flush()?)
}

/// The readings of all sets; one that is listed twice counts twice, but is read once.
fn read(sets: &[Set], is_first_look: bool) -> Result<Vec<Said>, Failure> {
    let first = |at: usize| sets.iter().position(|set| set.reads_as(&sets[at])).unwrap_or(at);
    let firsts: Vec<usize> = (0..sets.len()).map(first).collect();
    let progress = bar(sets.len(), "reading sentences");
    let read = |(at, set)| {
        let said = if firsts[at] == at { readings::of(set, is_first_look) } else { Ok(Vec::new()) };
        progress.inc(1);
        said
    };
    let mut said: Vec<Vec<Said>> = sets.par_iter().enumerate().map(read).collect::<Result<_, _>>()?;
    progress.finish_and_clear();
    for (at, set) in sets.iter().enumerate().filter(|&(at, _)| firsts[at] != at) {
        said[at] = said[firsts[at]].iter().map(|it| Said { author: set.author.clone(), ..it.clone() }).collect();
    }
    Ok(said.into_iter().flatten().collect())
}

/// Prints the weights, the largest first.
fn explain(out: &mut impl Write, said: &[Said], fitted: &Fitted) -> Result<(), Failure> {
    let texts: BTreeMap<u32, &str> = said.iter().flat_map(Said::features).map(|(hash, text)| (*hash, text.as_str())).collect();
    let of_clues = (0_u16..).zip(&fitted.clues).map(|(clue, &weight)| (f64::from(weight) * fitted.scale, clue_name(clue)));
    let kinds = [1, 2, 3, KINDS].into_iter().map(|kind| clue_name((kind * (CLUES / (KINDS + 1))) as u16)[0]);
    let of_words = fitted.words.iter().flat_map(|(hash, sense)| {
        let text = texts.get(hash).copied().unwrap_or("");
        let weights = fitted.senses[usize::from(*sense)];
        kinds.clone().zip(weights).map(move |(kind, weight)| (f64::from(weight) * fitted.scale_of_words, [kind, "word", text, ""]))
    });
    let mut largest: Vec<(f64, [&str; 4])> = of_clues.chain(of_words).filter(|&(weight, _)| weight != 0.0).collect();
    largest.sort_by(|one, other| other.0.abs().total_cmp(&one.0.abs()).then(one.1.cmp(&other.1)));
    for (weight, [reading, place, what, of_lessons]) in largest {
        writeln!(out, "{weight:6.2}  {reading:12} {place:14} {what} {of_lessons}")?;
    }
    Ok(())
}

/// Whether a word was said by several of these people: what one alone says tells little of others.
fn said_by_several<'s>(said: impl Iterator<Item = &'s Said>) -> Vec<bool> {
    let mut by: Vec<Option<Result<&str, ()>>> = vec![None; HASHED];
    for it in said {
        let author = it.author.trim_start_matches(FOR_TRAINING);
        for (hash, _) in it.features() {
            let by = &mut by[*hash as usize];
            *by = match *by {
                None => Some(Ok(author)),
                Some(Ok(other)) if author == other => *by,
                _ => Some(Err(())),
            };
        }
    }
    by.into_iter().map(|by| by == Some(Err(()))).collect()
}

/// Fits weights to the sentences of these people.
fn fitted_to(said: &[Said], is_in: &dyn Fn(&Said) -> bool, prices: Prices) -> Fitted {
    let of = || said.iter().filter(|it| is_in(it));
    let utterances: Vec<Vec<Example<'_>>> = of().flat_map(Said::commands).map(|said| said.examples().collect()).collect();
    let by_several = said_by_several(of());
    fit::fit(&utterances, &|hash| by_several[hash as usize], prices)
}

impl Figures {
    /// With what the robot did of one more sentence.
    fn and_first_look(self, said: &Said) -> Self {
        let did = |is: fn(&Did) -> bool| usize::from(said.did.as_ref().is_some_and(is));
        Self {
            sentences: self.sentences + 1,
            meant: self.meant + usize::from(said.is_meant),
            helpful: self.helpful + if said.is_meant { did(|did| did.is_right) } else { 0 },
            harmful: self.harmful + did(|did| !did.is_right && !did.is_done),
            ..self
        }
    }

    fn and(self, other: &Self) -> Self {
        Self {
            sentences: self.sentences + other.sentences,
            meant: self.meant + other.meant,
            read: self.read + other.read,
            first: self.first + other.first,
            helpful: self.helpful + other.helpful,
            harmful: self.harmful + other.harmful,
            said: self.said + other.said,
            acted: self.acted + other.acted,
            right: self.right + other.right,
        }
    }
}

/// The figures of sentences, by these weights, if the robot acts above this probability.
fn figures<'s>(said: impl Iterator<Item = &'s Said>, fitted: &Fitted, above: f64) -> Figures {
    let mut figures = Figures::default();
    for sentence in said {
        figures.sentences += 1;
        figures.meant += usize::from(sentence.is_meant);
        figures.read += usize::from(sentence.is_meant && sentence.readings.iter().any(|reading| reading.is_right));
        let Some((_, best)) = likeliest(sentence, fitted) else { continue };
        figures.first += usize::from(sentence.is_meant && best.is_right);
        if let Some((probability, last)) = followed(sentence, fitted, above) {
            figures.acted += 1;
            figures.right += usize::from(last.is_right);
            figures.said += probability;
            figures.helpful += usize::from(sentence.is_meant && last.is_right);
            figures.harmful += usize::from(!last.is_right && !last.is_done);
        }
    }
    figures
}

/// The most probable reading of a command, with the probability of its tasks.
fn likeliest<'s>(said: &'s Said, fitted: &Fitted) -> Option<(f64, &'s Read)> {
    let odds: Vec<f64> = said.examples().map(|example| fitted.odds(&example)).collect();
    let all = 1.0 + odds.iter().sum::<f64>();
    let weighed = said.readings.iter().map(|reading| {
        let same = odds.iter().zip(&said.readings).filter(|(_, other)| other.asked == reading.asked);
        (same.map(|(odds, _)| odds).sum::<f64>() / all, reading)
    });
    weighed.max_by(|a, b| a.0.total_cmp(&b.0))
}

/// The reading of the last command that a robot acts on, a wrong one at the latest, with the least probability until there; `None` if it waits
/// at one of them.
fn followed<'s>(sentence: &'s Said, fitted: &Fitted, above: f64) -> Option<(f64, &'s Read)> {
    let mut least = 1.0_f64;
    for command in sentence.commands() {
        let (probability, best) = likeliest(command, fitted).filter(|&(probability, _)| probability > above)?;
        least = least.min(probability);
        if !best.is_right || best.rest.is_none() {
            return Some((least, best));
        }
    }
    None
}

fn share(count: usize, of: usize) -> f64 {
    count as f64 / of.max(1) as f64
}

fn tell_first_look(out: &mut impl Write, json: bool, of: [&str; 3], figures: &Figures) -> Result<(), Failure> {
    let [author, language, kind] = of;
    let (helpful, harmful) = (share(figures.helpful, figures.meant), share(figures.harmful, figures.sentences));
    if json {
        let Figures { sentences, meant, .. } = figures;
        let line = json!({ "author": author, "language": language, "kind": kind, "sentences": sentences, "meant": meant, "helpful": helpful, "harmful": harmful });
        writeln!(out, "{line}")?;
    } else {
        let of = of.map(|it| if it.is_empty() { "all" } else { it });
        let [helpful, harmful] = [helpful, harmful].map(|share| 100.0 * share);
        writeln!(
            out,
            "{:10} {:4} {:14} {:6} sentences  helpful {helpful:5.1} %  harmful {harmful:4.1} %",
            of[0], of[1], of[2], figures.sentences
        )?;
    }
    Ok(())
}

fn tell(out: &mut impl Write, json: bool, [author, language, kind]: [&str; 3], above: f64, figures: &Figures) -> Result<(), Failure> {
    let (helpful, harmful) = (share(figures.helpful, figures.meant), share(figures.harmful, figures.sentences));
    let (read, first) = (share(figures.read, figures.meant), share(figures.first, figures.meant));
    let (said, right) = (figures.said / figures.acted.max(1) as f64, share(figures.right, figures.acted));
    if json {
        let line = json!({
            "author": author, "language": language, "kind": kind, "above": above, "sentences": figures.sentences, "meant": figures.meant, "read": read, "first": first, "helpful": helpful,
            "harmful": harmful, "acted": figures.acted, "mean_probability": said, "right": right,
        });
        writeln!(out, "{line}")?;
    } else {
        writeln!(
            out,
            "{author:10} {language:4} {kind:14} above {above:.2} {:6} sentences  read {:5.1} %  first {:5.1} %  helpful {:5.1} %  harmful {:4.1} %  of {:5} acted on: said {:4.2}, right {:4.2}",
            figures.sentences,
            100.0 * read,
            100.0 * first,
            100.0 * helpful,
            100.0 * harmful,
            figures.acted,
            said,
            right
        )?;
    }
    Ok(())
}

/// The file of the weights.
fn bytes(fitted: &Fitted) -> Vec<u8> {
    let words: Vec<(u32, u8)> = fitted.words.iter().map(|(&hash, &sense)| (hash, sense)).collect();
    let scales = [fitted.bias, fitted.scale, fitted.scale_of_words].map(|scale| scale as f32);
    let mut bytes = Vec::new();
    let trained = Trained { scales, clues: &fitted.clues, senses: &fitted.senses, words: &words };
    trained.write(|some| bytes.extend_from_slice(some));
    bytes
}
