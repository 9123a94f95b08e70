//! Logistic regression that keeps the words that tell most. It is fitted twice, with all words and then with the kept ones, the utterances one
//! after another with a rate for each weight (Duchi, Hazan and Singer 2011, *Adaptive subgradient methods for online learning*). The same
//! data give the same weights.

use goodbot::talk::{CLUES, HASHED, KINDS_OF_WORDS as KINDS, SENSES};
use std::collections::BTreeMap;

/// How often each reading is seen.
const ROUNDS: usize = 8;
/// The rate of learning, and what slows the first steps.
const RATE: f32 = 0.05;
const SLOWLY: f32 = 1.0;

/// The value of a word as a feature: words are believed sooner than clues.
const WORD: f64 = 2.0;
/// The share of words that are hidden in each round, so that no reading depends on one word alone (Srivastava et al. 2014, *Dropout: a
/// simple way to prevent neural networks from overfitting*). The value of the others makes up for them.
const HIDDEN: f64 = 0.1;
const HEARD_WORD: f32 = (WORD / (1.0 - HIDDEN)) as f32;
/// Weights are whole numbers up to this.
const MOST: f64 = 127.0;
/// How often the senses of words are moved to the middle of their words.
const MOVES: usize = 20;

/// Where the weights of words begin: first those for all kinds of readings, then those of each kind.
const WORDS: usize = CLUES;
/// How many weights there are to learn.
const SIZE: usize = WORDS + (KINDS + 1) * HASHED;

/// A reading.
#[derive(Clone, Copy, Debug)]
pub struct Example<'e> {
    /// Its clues.
    pub clues: &'e [u16],
    /// Their values.
    pub values: &'e [f32],
    /// The words of its utterance, as features, which all its readings share.
    pub words: &'e [(u32, String)],
    /// The words between two commands, or in a repair.
    pub between: &'e [(u32, String)],
    /// Its kind, from 1.
    pub kind: usize,
    /// The distance from each clue to that for its kind of reading alone.
    pub to_kind: u16,
    /// Whether it is right.
    pub holds: bool,
}

impl Example<'_> {
    /// The clues for all kinds of readings and for its own, with their values.
    fn clues_of_both(&self) -> impl Iterator<Item = (usize, f32)> {
        let both = |(&clue, &value): (&u16, &f32)| [clue, clue.saturating_add(self.to_kind)].map(|clue| (usize::from(clue), value));
        self.clues.iter().zip(self.values).flat_map(both)
    }

    /// The features for all kinds of readings and for its own, with their values.
    fn each(&self) -> impl Iterator<Item = (usize, f64)> {
        let of_word = |(hash, _): &(u32, String)| [0, self.kind].map(|kind| (WORDS + kind * HASHED + *hash as usize, WORD));
        let clues = self.clues_of_both().map(|(clue, value)| (clue, f64::from(value)));
        clues.chain(self.words.iter().chain(self.between).flat_map(of_word))
    }
}

/// How a model is fitted.
#[derive(Clone, Copy, Debug)]
pub struct Prices {
    /// The price of the square of a weight.
    pub square: f32,
    /// How many words may have weights.
    pub most: usize,
}

/// A trained model, in whole numbers.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The weight of each clue, and the value of a weight of 1.
    pub clues: Vec<i8>,
    /// See `clues`.
    pub scale: f64,
    /// The weights of each sense that words have, for each kind of reading, and the value of a weight of 1.
    pub senses: Box<[[i8; KINDS]; SENSES]>,
    /// See `senses`.
    pub scale_of_words: f64,
    /// The sense of each word.
    pub words: BTreeMap<u32, u8>,
    /// The weight of every reading.
    pub bias: f64,
}

impl Fitted {
    /// The odds of a reading against nothing that is to be done.
    pub fn odds(&self, example: &Example<'_>) -> f64 {
        let of_words = example.words.iter().chain(example.between).filter_map(|(hash, _)| self.words.get(hash));
        let words: f64 = of_words.map(|&sense| f64::from(self.senses[usize::from(sense)][example.kind - 1])).sum();
        let clues: f64 = example.each().filter(|&(at, _)| at < WORDS).map(|(at, value)| f64::from(self.clues[at]) * value).sum();
        libm::exp(self.bias + words * self.scale_of_words + clues * self.scale)
    }
}

/// A weight while it is learned (McMahan et al. 2013, *Ad click prediction: a view from the trenches*, algorithm 1): what the readings ask
/// for, and the sum of the squares of their slopes.
#[derive(Clone, Copy, Default)]
struct Learned {
    asked: f32,
    /// The root of the sum.
    height: f32,
    weight: f32,
}

impl Learned {
    fn learn(&mut self, slope: f32, price: f32) {
        let height = (self.height * self.height + slope * slope).sqrt();
        self.asked += slope - (height - self.height) / RATE * self.weight;
        self.height = height;
        self.weight = -self.asked / ((SLOWLY + height) / RATE + price);
    }
}

/// Fits weights: about the least sum of the utterances' negative log likelihoods and the prices of the weights. An utterance is its readings;
/// one without a right reading asks for nothing. `may_count` tells whether a word may have weights.
pub fn fit(utterances: &[Vec<Example<'_>>], may_count: &dyn Fn(u32) -> bool, prices: Prices) -> Fitted {
    let mut heights = vec![0.0; SIZE];
    utterances.iter().flatten().flat_map(Example::each).for_each(|(at, value)| heights[at] += value * value);
    let may = |at: usize| at < WORDS || may_count(((at - WORDS) % HASHED) as u32);
    let all = fit_some(utterances, &(0..SIZE).map(|at| heights[at] > 0.0 && may(at)).collect::<Vec<_>>(), prices.square);
    // What a word tells in all: how far its weights move the readings that have it.
    let of_word = |hash: usize| (0..=KINDS).map(move |kind| WORDS + kind * HASHED + hash);
    let tells = |hash: usize| of_word(hash).map(|at| all.0[at] * all.0[at] * heights[at]).sum::<f64>();
    let mut words: Vec<(f64, usize)> = (0..HASHED).map(|hash| (tells(hash), hash)).filter(|&(tells, _)| tells > 0.0).collect();
    words.sort_by(|one, other| other.0.total_cmp(&one.0).then(one.1.cmp(&other.1)));
    words.truncate(prices.most);
    let mut kept = vec![false; SIZE];
    kept[..WORDS].fill(true);
    words.iter().flat_map(|&(_, hash)| of_word(hash)).for_each(|at| kept[at] = true);
    let (weights, bias) = fit_some(utterances, &kept, prices.square);

    let rounded = |weight: f64, scale: f64| (weight / scale).round().clamp(-MOST, MOST) as i8;
    let scale_of = |weights: &mut dyn Iterator<Item = f64>| weights.fold(f64::MIN_POSITIVE, |most, weight| most.max(weight.abs())) / MOST;
    let scale = scale_of(&mut weights[..WORDS].iter().copied());
    let clues = weights[..WORDS].iter().map(|&weight| rounded(weight, scale)).collect();
    // A word's weight for all kinds is a part of that for each.
    let each = |hash: usize| std::array::from_fn(|kind| (weights[WORDS + hash] + weights[WORDS + (kind + 1) * HASHED + hash]) * WORD);
    let often = |hash: usize| heights[WORDS + hash].sqrt();
    let points: Vec<([f64; KINDS], f64)> = words.iter().map(|&(_, hash)| (each(hash), often(hash))).collect();
    let (middles, of) = senses(&points);
    let scale_of_words = scale_of(&mut middles.iter().flatten().copied());
    let senses = Box::new(std::array::from_fn(|sense| middles[sense].map(|weight| rounded(weight, scale_of_words))));
    let words = words.iter().zip(of).map(|(&(_, hash), sense)| (hash as u32, sense)).collect();
    Fitted { clues, scale, senses, scale_of_words, words, bias }
}

/// Sorts words, given by their weights and by how much each counts, into senses with nearly the same weights (Lloyd 1982, *Least squares
/// quantization in PCM*). Returns the weights of each sense, and the sense of each word.
fn senses(words: &[([f64; KINDS], f64)]) -> (Vec<[f64; KINDS]>, Vec<u8>) {
    let apart = |one: &[f64; KINDS], other: &[f64; KINDS]| one.iter().zip(other).map(|(one, other)| (one - other).powi(2)).sum::<f64>();
    // Each new sense begins at the word that the others tell worst.
    let (mut middles, mut errors) = (vec![[0.0; KINDS]], vec![f64::INFINITY; words.len()]);
    while middles.len() < SENSES {
        let last = middles.last().copied().unwrap_or_default();
        for (error, (word, counts)) in errors.iter_mut().zip(words) {
            *error = error.min(apart(word, &last) * counts);
        }
        let worst = errors.iter().enumerate().max_by(|one, other| one.1.total_cmp(other.1));
        middles.push(worst.map_or([0.0; KINDS], |(at, _)| words[at].0));
    }
    let mut of = vec![0_u8; words.len()];
    for _ in 0..MOVES {
        let nearest = |word: &[f64; KINDS]| {
            let each = middles.iter().map(|middle| apart(word, middle)).enumerate();
            each.min_by(|one, other| one.1.total_cmp(&other.1)).map_or(0, |(sense, _)| sense as u8)
        };
        of = words.iter().map(|(word, _)| nearest(word)).collect();
        let mut sums = vec![([0.0; KINDS], 0.0); SENSES];
        for ((word, counts), &sense) in words.iter().zip(&of) {
            let (sum, all) = &mut sums[usize::from(sense)];
            sum.iter_mut().zip(word).for_each(|(sum, weight)| *sum += weight * counts);
            *all += counts;
        }
        for (middle, (sum, all)) in middles.iter_mut().zip(sums).filter(|(_, (_, all))| *all > 0.0) {
            *middle = sum.map(|sum| sum / all);
        }
    }
    (middles, of)
}

/// The words of an utterance that are kept, and those between two commands or in a repair of each of its readings.
struct Kept {
    words: Vec<u32>,
    between: Vec<Vec<u32>>,
}

/// Any order and any choice will do, but always the same: Knuth's generator.
fn next(random: &mut u64) -> u64 {
    *random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *random >> 33
}

/// Fits these weights, and that of every reading.
fn fit_some(utterances: &[Vec<Example<'_>>], kept: &[bool], price: f32) -> (Vec<f64>, f64) {
    let price = price * ROUNDS as f32;
    let of_words = |words: &[(u32, String)]| words.iter().map(|(hash, _)| *hash).filter(|&hash| kept[WORDS + hash as usize]).collect();
    let of_utterance = |readings: &Vec<Example<'_>>| Kept {
        words: readings.first().map_or(Vec::new(), |reading| of_words(reading.words)),
        between: readings.iter().map(|reading| of_words(reading.between)).collect(),
    };
    let words: Vec<Kept> = utterances.iter().map(of_utterance).collect();
    let (mut learned, mut bias) = (vec![Learned::default(); kept.len()], Learned::default());
    let mut order: Vec<usize> = (0..utterances.len()).collect();
    let mut random = 1_u64;
    let (mut heard, mut odds) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        for at in (1..order.len()).rev() {
            order.swap(at, next(&mut random) as usize % (at + 1));
        }
        for (readings, words) in order.iter().map(|&at| (&utterances[at], &words[at])) {
            let salt = next(&mut random);
            // Of every utterance and in every round other words are hidden, but the same ones from all of its readings (Steele, Lea and Flood
            // 2014, *Fast splittable pseudorandom number generators*).
            let is_heard = |hash: &u32| {
                let mixed = (salt ^ u64::from(*hash)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
                let drawn = (mixed ^ mixed >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 40;
                drawn as f64 >= HIDDEN * f64::from(1 << 24)
            };
            heard.clear();
            heard.extend(words.words.iter().copied().filter(is_heard));
            let of_word = |hash: u32, kind: usize| [0, kind].map(|kind| WORDS + kind * HASHED + hash as usize);
            let mut of_kind = [None; KINDS + 1];
            odds.clear();
            for (reading, between) in readings.iter().zip(&words.between) {
                let weight = |of: usize| learned[of].weight;
                let of_words = |hash: u32| of_word(hash, reading.kind).into_iter().map(weight).sum::<f32>() * HEARD_WORD;
                let of_all = of_kind[reading.kind].get_or_insert_with(|| heard.iter().map(|&hash| of_words(hash)).sum::<f32>());
                let clues = reading.clues_of_both().map(|(clue, value)| learned[clue].weight * value).sum::<f32>();
                let between = between.iter().filter(|hash| is_heard(hash)).map(|&hash| of_words(hash)).sum::<f32>();
                odds.push(libm::expf((bias.weight + *of_all + clues + between).clamp(-30.0, 30.0)));
            }
            let all = 1.0 + odds.iter().sum::<f32>();
            let right: f32 = odds.iter().zip(readings).filter(|(_, reading)| reading.holds).map(|(odds, _)| odds).sum();
            for ((&odds, reading), between) in odds.iter().zip(readings).zip(&words.between) {
                let wanted = if reading.holds { odds / right } else { 0.0 };
                let slope = odds / all - wanted;
                bias.learn(slope, 0.0);
                reading.clues_of_both().for_each(|(clue, value)| learned[clue].learn(slope * value, price));
                for &hash in heard.iter().chain(between.iter().filter(|hash| is_heard(hash))) {
                    of_word(hash, reading.kind).into_iter().for_each(|at| learned[at].learn(slope * HEARD_WORD, price));
                }
            }
        }
    }
    (learned.into_iter().map(|learned| learned.weight.into()).collect(), bias.weight.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clue_of_right_readings_gets_a_weight_and_one_without_meaning_gets_none() {
        let example = |at: usize| {
            let clues: &[u16] = if at.is_multiple_of(2) { &[0, 2] } else { &[1, 2] };
            Example { clues, values: &[1.0, 1.0], words: &[], between: &[], kind: 1, to_kind: 3, holds: at.is_multiple_of(2) }
        };
        let utterances: Vec<Vec<Example<'_>>> = (0..80).map(|at| vec![example(at)]).collect();
        let fitted = fit(&utterances, &|_| true, Prices { square: 0.01, most: 4 });
        let right_and_wrong = [fitted.odds(&example(0)), fitted.odds(&example(1))];
        assert!(fitted.clues[0] > 60 && fitted.clues[1] < -60 && fitted.clues[2].abs() < 20, "{:?}", &fitted.clues[..6]);
        assert!(right_and_wrong[0] > 4.0 && right_and_wrong[1] < 0.25, "{right_and_wrong:?}");
    }

    #[test]
    fn of_two_words_that_are_always_said_together_each_tells_something() {
        let words = [7, 300].map(|hash| (hash, String::new()));
        let example = |holds: bool| Example {
            clues: &[0],
            values: &[1.0],
            words: if holds { &words } else { &[] },
            between: &[],
            kind: 2,
            to_kind: 3,
            holds,
        };
        let utterances: Vec<Vec<Example<'_>>> = (0..80_u8).map(|at| vec![example(at.is_multiple_of(2))]).collect();
        let fitted = fit(&utterances, &|_| true, Prices { square: 0.01, most: 4 });
        let [one, other] = [7, 300].map(|hash| f64::from(fitted.senses[usize::from(fitted.words[&hash])][1]) * fitted.scale_of_words);
        assert!(one > 1.0 && other > 1.0 && (one - other).abs() < one, "{one} {other}");
    }

    #[test]
    fn words_with_nearly_the_same_weights_have_one_sense() {
        let word = |at: usize| [at as f64, 0.0, if at.is_multiple_of(2) { 500.0 } else { -500.0 }, 1.0];
        let words: Vec<([f64; KINDS], f64)> = (0..1024).map(|at| (word(at), 1.0)).collect();
        let (middles, of) = senses(&words);
        let errors = words.iter().zip(&of).map(|((word, _), &sense)| (word[0] - middles[usize::from(sense)][0]).abs());
        assert!(errors.fold(0.0, f64::max) < 8.0);
        assert!(words.iter().zip(&of).all(|((word, _), &sense)| word[2] * middles[usize::from(sense)][2] > 0.0));
    }

    #[test]
    fn of_the_words_that_may_count_those_that_tell_most_get_weights_for_the_kinds_that_had_them() {
        let word = |hash: u32| (hash, String::new());
        let (go, paint) = (vec![word(7), word(1), word(5)], vec![word(8), word(2), word(5)]);
        let example = |at: usize| {
            let holds = at.is_multiple_of(2);
            Example { clues: &[0], values: &[1.0], words: if holds { &go } else { &paint }, between: &[], kind: 2, to_kind: 3, holds }
        };
        let utterances: Vec<Vec<Example<'_>>> = (0..80).map(|at| vec![example(at)]).collect();
        let fitted = fit(&utterances, &|hash| hash > 2, Prices { square: 0.01, most: 2 });
        assert_eq!(fitted.words.keys().collect::<Vec<_>>(), [&7, &8]);
        let weight = |word: u32| fitted.senses[usize::from(fitted.words[&word])][1];
        assert!(weight(7) > 60 && weight(8) < -60, "{} {}", weight(7), weight(8));
        assert!(fitted.odds(&example(0)) > 4.0 && fitted.odds(&example(1)) < 0.25);
    }
}
