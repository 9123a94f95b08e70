//! A suite of sentences in several languages: utterances to a robot, in words of the lessons and in others. Half of it is for choosing
//! settings: the homes with even numbers, and the first, third and so on of each kind of sentence. The other half is kept aside: homes with
//! odd numbers, and the sentences between.

use super::{COLORS, Home, SHAPES, asked_with, go, keep, not, take, then};
use crate::program::goodbot;
use serde_json::json;
use std::collections::BTreeMap;

const ENGLISH: &str = include_str!("en.txt");
const GERMAN: &str = include_str!("de.txt");
const FRENCH: &str = include_str!("fr.txt");
const SPANISH: &str = include_str!("es.txt");
const CHINESE: &str = include_str!("zh.txt");
/// Sentences of other authors: the language, the words of the lessons, the lines that differ from them, the author, and the sentences.
const BY_OTHERS: [(&str, &str, &str, &str, &str); 22] = [
    ("en", ENGLISH, "", "stranger", include_str!("stranger.en.tsv")),
    ("de", GERMAN, "", "stranger", include_str!("stranger.de.tsv")),
    ("en", ENGLISH, "", "everyday", include_str!("everyday.en.tsv")),
    ("de", GERMAN, OTHER_GERMAN, "everyday", include_str!("everyday.de.tsv")),
    ("fr", FRENCH, "", "everyday", include_str!("everyday.fr.tsv")),
    ("es", SPANISH, OTHER_SPANISH, "everyday", include_str!("everyday.es.tsv")),
    ("zh", CHINESE, OTHER_CHINESE, "everyday", include_str!("everyday.zh.tsv")),
    ("en", ENGLISH, "", "household", include_str!("household.en.tsv")),
    ("de", GERMAN, OTHER_GERMAN, "household", include_str!("household.de.tsv")),
    ("fr", FRENCH, "", "household", include_str!("household.fr.tsv")),
    ("es", SPANISH, OTHER_SPANISH, "household", include_str!("household.es.tsv")),
    ("zh", CHINESE, OTHER_CHINESE, "household", include_str!("household.zh.tsv")),
    ("en", ENGLISH, "", "visitor", include_str!("visitor.en.tsv")),
    ("de", GERMAN, OTHER_GERMAN, "visitor", include_str!("visitor.de.tsv")),
    ("fr", FRENCH, "", "visitor", include_str!("visitor.fr.tsv")),
    ("es", SPANISH, OTHER_SPANISH, "visitor", include_str!("visitor.es.tsv")),
    ("zh", CHINESE, OTHER_CHINESE, "visitor", include_str!("visitor.zh.tsv")),
    ("en", ENGLISH, "", "guest", include_str!("guest.en.tsv")),
    ("de", GERMAN, OTHER_GERMAN, "guest", include_str!("guest.de.tsv")),
    ("fr", FRENCH, "", "guest", include_str!("guest.fr.tsv")),
    ("es", SPANISH, OTHER_SPANISH, "guest", include_str!("guest.es.tsv")),
    ("zh", CHINESE, OTHER_CHINESE, "guest", include_str!("guest.zh.tsv")),
];
const OTHER_GERMAN: &str = include_str!("everyday.de.txt");
const OTHER_SPANISH: &str = include_str!("everyday.es.txt");
const OTHER_CHINESE: &str = include_str!("everyday.zh.txt");

/// The homes of each half.
const HOMES: u64 = 6;
/// The number of them in which every run of the tests asks.
const FEW_HOMES: u64 = 1;

/// The halves of the suite.
#[derive(Clone, Copy, PartialEq)]
enum Half {
    /// For choosing settings.
    Tuning,
    /// Looked at after all settings are chosen.
    KeptAside,
}

/// The closed words of the robot.
#[derive(Clone, Copy, PartialEq)]
enum Table {
    /// The built-in ones.
    Of5Languages,
    /// None.
    Empty,
}

/// Numbers that look random, and are the same each time (SplitMix64).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }

    fn one<T: Copy>(&mut self, of: &[T]) -> Option<T> {
        of.get(self.below(of.len())).copied()
    }

    fn shuffled<T: Copy>(&mut self, all: &[T]) -> Vec<T> {
        let mut all = all.to_vec();
        for end in (1..all.len()).rev() {
            all.swap(end, self.below(end + 1));
        }
        all
    }
}

/// A home of 3 to 6 rooms with 2 to 5 things, no two of which are alike.
fn home(numbers: &mut Numbers) -> Home {
    let rooms = numbers.shuffled(&COLORS)[..3 + numbers.below(4)].to_vec();
    let mut blocks: Vec<(&str, &str, usize)> = Vec::new();
    for _ in 0..2 + numbers.below(4) {
        let (color, shape) = (COLORS[numbers.below(6)], SHAPES[numbers.below(3)]);
        if !blocks.iter().any(|block| (block.0, block.1) == (color, shape)) {
            blocks.push((color, shape, numbers.below(rooms.len())));
        }
    }
    let robot = numbers.below(rooms.len());
    Home { rooms, blocks, robot }
}

/// The sentences of a language, and the words for their slots.
struct Wording {
    lines: Vec<(&'static str, &'static str)>,
}

impl Wording {
    fn of(text: &'static str) -> Self {
        let lines = text.lines().filter(|line| !line.starts_with('#')).filter_map(|line| line.split_once(": "));
        Self { lines: lines.collect() }
    }

    /// The same, with these lines in place of lines with the same key.
    fn with(self, others: &'static str) -> Self {
        let mut lines = Self::of(others).lines;
        let own = self.lines.into_iter().filter(|(key, _)| lines.iter().all(|(other, _)| other != key)).collect::<Vec<_>>();
        lines.extend(own);
        Self { lines }
    }

    fn all(&self, key: &str) -> Vec<&'static str> {
        self.lines.iter().filter(|(known, _)| *known == key).map(|(_, text)| *text).collect()
    }

    fn one(&self, key: &str) -> &'static str {
        self.lines.iter().find(|(known, _)| *known == key).map_or_else(|| panic!("no line for {key}"), |(_, text)| text)
    }

    /// Replaces `{color}` and its other forms by the words for a color.
    fn colored(&self, text: &str, color: &str) -> String {
        let forms: Vec<&str> = self.one(&format!("color {color}")).split(' ').collect();
        let form = |position: usize| forms.get(position).unwrap_or(&forms[0]);
        text.replace("{color}", form(0)).replace("{color2}", form(1)).replace("{color3}", form(2))
    }

    fn room(&self, key: &str, color: &str) -> String {
        self.lines.iter().find(|(known, _)| *known == key).map_or_else(String::new, |(_, text)| self.colored(text, color))
    }

    fn thing(&self, key: &str, color: &str, shape: &str) -> String {
        let key = format!("{key} {shape}");
        self.lines.iter().find(|(known, _)| *known == key).map_or_else(String::new, |(_, text)| self.colored(text, color))
    }

    /// Lessons in homes of their own: commands for tasks that are still to do.
    fn lessons(&self, count: usize) -> String {
        let mut numbers = Numbers(7);
        let (going, taking) = (self.all("taught go"), self.all("taught take"));
        let (mut log, mut lesson) = (String::new(), 0);
        while lesson < count {
            let home = home(&mut numbers);
            let (room, block) = (numbers.below(home.rooms.len()), numbers.below(home.blocks.len()));
            let is_going = lesson % 2 == 0;
            let template = numbers.one(if is_going { &going } else { &taking }).expect("sentences");
            if room == if is_going { home.robot } else { home.blocks[block].2 } {
                continue;
            }
            let task = if is_going { go(room) } else { take(block, room) };
            let command = self.filled(template, &home, &[room, room], &[block, block]);
            let session = json!({"type": "session", "version": 1, "id": lesson.to_string(), "kind": "labelled", "environment": home.json(), "command": command, "intended": [task]});
            log += &format!("{session}\n{}\n", json!({"type": "end", "learn": true}));
            lesson += 1;
        }
        log
    }

    /// Fills the slots of a sentence with two rooms and two things of a home.
    fn filled(&self, template: &str, home: &Home, rooms: &[usize; 2], blocks: &[usize; 2]) -> String {
        let mut text = template.to_owned();
        for (number, (&room, &block)) in ["", "2"].iter().zip(rooms.iter().zip(blocks)) {
            let (color, shape, _) = home.blocks[block];
            for key in ["room", "room en"] {
                text =
                    text.replace(&format!("{{{}}}", key.replacen("room", &format!("room{number}"), 1)), &self.room(key, home.rooms[room]));
            }
            for key in ["thing", "nominative"] {
                text = text.replace(&format!("{{{key}{number}}}"), &self.thing(key, color, shape));
            }
        }
        self.colored(&text, home.blocks[blocks[0]].0)
    }
}

/// A sentence, its kind, and its meaning: nothing, or tasks, with or without an order.
struct Said {
    kind: &'static str,
    text: String,
    meant: Option<Vec<String>>,
}

/// The sentences of half the suite in a home.
fn said(wording: &Wording, home: &Home, half: Half, numbers: &mut Numbers) -> Vec<Said> {
    let mut all = Vec::new();
    let mut positions: BTreeMap<&str, usize> = BTreeMap::new();
    for &(kind, template) in &wording.lines {
        let position = positions.entry(kind).or_default();
        *position += 1;
        if (*position % 2 == 1) != (half == Half::Tuning) {
            continue;
        }
        let every: Vec<usize> = (0..home.rooms.len()).collect();
        let [mut room, other] = numbers.shuffled(&every)[..2] else { unreachable!("a home has three rooms") };
        let every: Vec<usize> = (0..home.blocks.len()).collect();
        let (block, mut second) = (numbers.below(home.blocks.len()), 0);
        if kind == "take take" {
            let Some(&other) = numbers.shuffled(&every).iter().find(|&&other| other != block) else { continue };
            second = other;
        } else if kind == "go take" {
            second = block;
        }
        if kind == "out go" {
            room = home.robot;
        } else if kind == "out take" {
            room = home.blocks[block].2;
        }
        let of_shape = |shape: &str| (0..home.blocks.len()).filter(|&block| home.blocks[block].1 == shape).collect::<Vec<_>>();
        let shape = numbers.one(&SHAPES).unwrap_or_default();
        let to_bring = |blocks: Vec<usize>| {
            let tasks = |blocks: &[usize]| blocks.iter().map(|&block| take(block, room)).collect::<Vec<_>>();
            let open: Vec<usize> = blocks.iter().copied().filter(|&block| home.blocks[block].2 != room).collect();
            Some(tasks(if open.is_empty() { &blocks } else { &open })).filter(|tasks| !tasks.is_empty())
        };
        let (first, alike) = (home.blocks[block].1, of_shape(home.blocks[block].1));
        let meant = match kind {
            "go" | "verb go" | "polite go" | "slip go" => Some(vec![go(room)]),
            "take" | "verb take" | "polite take" | "slip take" => Some(vec![take(block, room)]),
            "not go" | "out go" => Some(vec![not(&go(room))]),
            "not take" | "out take" => Some(vec![not(&take(block, room))]),
            "go go" => Some(vec![go(room), go(other)]),
            "take go" => Some(vec![take(block, room), go(other)]),
            "go take" => Some(vec![go(room), take(second, other)]),
            "take take" => Some(vec![take(block, room), take(second, other)]),
            "all" => match to_bring(of_shape(shape)) {
                None => continue,
                tasks => tasks,
            },
            "everything" => to_bring(every),
            "only" if alike.len() == 1 => Some(vec![take(block, room)]),
            "which" if alike.len() > 1 => None,
            "absent" | "talk" | "question" | "other" => None,
            _ => continue,
        };
        let mut text = template.to_owned();
        if text.contains("{absent room}") {
            let absent: Vec<&str> = COLORS.into_iter().filter(|color| !home.rooms.contains(color)).collect();
            let Some(color) = numbers.one(&absent) else { continue };
            text = text.replace("{absent room}", &wording.room("room", color));
        }
        if text.contains("{absent thing}") {
            let here = |color: &str, shape: &str| home.blocks.iter().any(|block| (block.0, block.1) == (color, shape));
            let (color, shape) = (COLORS[numbers.below(6)], SHAPES[numbers.below(3)]);
            if here(color, shape) {
                continue;
            }
            text = text.replace("{absent thing}", &wording.thing("thing", color, shape));
        }
        text = text.replace("{kinds}", &wording.thing("kinds", "red", shape));
        text = text.replace("{double}", &wording.thing("double", "red", first)).replace("{single}", &wording.thing("double", "red", first));
        text = wording.filled(&text, home, &[room, other], &[block, second]);
        if kind.starts_with("slip") {
            text = mistyped(&text, numbers);
        }
        all.push(Said { kind, text, meant });
    }
    all
}

/// The sentence with a slip in each of two words.
fn mistyped(text: &str, numbers: &mut Numbers) -> String {
    let mut words: Vec<Vec<char>> = text.split(' ').map(|word| word.chars().collect()).collect();
    let long: Vec<usize> = (0..words.len()).filter(|&word| words[word].len() > 2).collect();
    for word in numbers.shuffled(&long).into_iter().take(2) {
        let letters = &mut words[word];
        let at = numbers.below(letters.len() - 1);
        match numbers.below(4) {
            0 if letters[at] != letters[at + 1] => letters.swap(at, at + 1),
            1 => drop(letters.remove(at)),
            2 => letters[at] = if letters[at] == 'x' { 'z' } else { 'x' },
            _ => letters.insert(at, letters[at]),
        }
    }
    words.iter().map(|word| word.iter().collect::<String>()).collect::<Vec<_>>().join(" ")
}

/// How many sentences had the right answer.
#[derive(Clone, Copy, Default)]
struct Tally {
    follow: usize,
    helpful: usize,
    all: usize,
    harmful: usize,
}

/// Wilson's interval of 95 % for a share, in percent.
fn interval(hits: usize, of: usize) -> (f64, f64) {
    let (n, z) = (of.max(1) as f64, 1.96);
    let share = hits as f64 / n;
    let middle = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let half = z * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt() / (1.0 + z * z / n);
    (100.0 * (middle - half).max(0.0), 100.0 * (middle + half).min(1.0))
}

fn is_right(answer: &str, kind: &str, meant: &[String]) -> bool {
    let mut parts: Vec<&str> = answer.split(" then ").collect();
    let mut meant: Vec<&str> = meant.iter().map(String::as_str).collect();
    if kind == "all" || kind == "everything" {
        parts.sort_unstable();
        meant.sort_unstable();
    }
    parts == meant
}

/// Asks half the suite of a robot with some lessons, and prints the result.
fn judge(language: &str, text: &'static str, lessons: usize, half: Half, table: Table, homes: u64) -> Tally {
    let wording = Wording::of(text);
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("words.goodbot").to_str().expect("a name").to_owned();
    let run = goodbot(&["learn", "-", "--quiet", "--out", &model], wording.lessons(lessons).as_bytes());
    assert_eq!(run.code, 0, "{}", run.messages);
    let empty = folder.path().join("empty.txt").to_str().expect("a name").to_owned();
    std::fs::write(&empty, "").expect("a file");
    let options: &[&str] = if table == Table::Empty { &["--closed-words", &empty] } else { &[] };
    let (mut kinds, mut whole): (BTreeMap<&str, Tally>, Tally) = (BTreeMap::new(), Tally::default());
    for number in 0..homes {
        let mut numbers = Numbers(1_000 + 2 * number + u64::from(half == Half::KeptAside));
        let home = home(&mut numbers);
        let said = said(&wording, &home, half, &mut numbers);
        let sentences: Vec<String> = said.iter().map(|said| said.text.clone()).collect();
        if half == Half::Tuning && table == Table::Of5Languages {
            let meaning = |said: &Said| said.meant.as_ref().map_or_else(|| "none".to_owned(), |meant| then(meant));
            keep(language, &model, &home, &said.iter().map(|said| (said.kind, &*said.text, meaning(said))).collect::<Vec<_>>());
        }
        for (said, answer) in said.iter().zip(asked_with(options, &model, &home, &sentences)) {
            let is_sure = answer["verdict"] == "sure" || answer["verdict"] == "done";
            let is_right =
                is_sure && said.meant.as_ref().is_some_and(|meant| is_right(answer["task"].as_str().unwrap_or(""), said.kind, meant));
            for tally in [kinds.entry(said.kind).or_default(), &mut whole] {
                tally.all += 1;
                tally.follow += usize::from(said.meant.is_some());
                tally.helpful += usize::from(is_right);
                tally.harmful += usize::from(is_sure && !is_right);
            }
            if is_sure != is_right || said.meant.is_some() && !is_right {
                let meant = said.meant.as_ref().map_or_else(|| "none".to_owned(), |meant| then(meant));
                let first = answer["meanings"][0].clone();
                let probability = first["probability"].as_f64().unwrap_or(0.0);
                println!(
                    "{} {language} {lessons} {number} {}: {}: {} ({}, {probability:.2}) {} instead of {meant}",
                    if is_sure { "HARM" } else { "miss" },
                    said.kind,
                    said.text,
                    answer["verdict"].as_str().unwrap_or(""),
                    answer["taken_for"].as_str().unwrap_or(""),
                    answer["task"].as_str().unwrap_or(""),
                );
            }
        }
    }
    for (kind, tally) in &kinds {
        println!(
            "  {language} {lessons} {kind}: helpful {} of {}, harmful {} of {}",
            tally.helpful, tally.follow, tally.harmful, tally.all
        );
    }
    let share = |hits: usize, of: usize| {
        let (low, high) = interval(hits, of);
        format!("{:.1} % ({low:.1} to {high:.1}, {hits} of {of})", 100.0 * hits as f64 / of.max(1) as f64)
    };
    println!("{language}, {lessons} lessons: helpful {}, harmful {}", share(whole.helpful, whole.follow), share(whole.harmful, whole.all));
    whole
}

/// Asks half the suite in all languages, of robots with this many lessons each.
fn judge_all(half: Half, table: Table, lessons: &[usize], homes: u64) -> Vec<(&'static str, usize, Tally)> {
    let languages = [("en", ENGLISH), ("de", GERMAN), ("fr", FRENCH), ("es", SPANISH), ("zh", CHINESE)];
    let judged =
        |(name, text)| lessons.iter().map(|&lessons| (name, lessons, judge(name, text, lessons, half, table, homes))).collect::<Vec<_>>();
    std::thread::scope(|scope| {
        let threads: Vec<_> = languages.into_iter().map(|language| scope.spawn(move || judged(language))).collect();
        threads.into_iter().flat_map(|thread| thread.join().expect("the suite is asked")).collect()
    })
}

/// At most 1 of 40 answers may be sure of a wrong meaning; after 24 lessons, 1 of 30. At least this many of 100 sentences must be followed
/// after 120 and after 24 lessons.
fn check(half: Half, least: [usize; 2]) {
    for (name, lessons, tally) in judge_all(half, Table::Of5Languages, &[120, 24], HOMES) {
        let least = least[usize::from(lessons == 24)];
        assert!(tally.helpful * 100 >= tally.follow * least, "{name}, {lessons} lessons: {} of {}", tally.helpful, tally.follow);
        let one_of = if lessons == 24 { 30 } else { 40 };
        assert!(tally.harmful * one_of <= tally.all, "{name}, {lessons} lessons: harmful {} of {}", tally.harmful, tally.all);
    }
}

/// A home of each half shows where something broke; the ignored tests give the figures.
#[test]
fn a_part_of_the_suite_is_followed_in_five_languages() {
    for half in [Half::Tuning, Half::KeptAside] {
        for (name, _, tally) in judge_all(half, Table::Of5Languages, &[120], FEW_HOMES) {
            assert!(tally.helpful * 100 >= tally.follow * 75, "{name}: {} of {}", tally.helpful, tally.follow);
            assert!(tally.harmful * 20 <= tally.all, "{name}: harmful {} of {}", tally.harmful, tally.all);
        }
    }
}

#[test]
#[ignore = "takes most of a minute of a processor"]
fn the_tuning_half_of_the_suite_is_followed_in_five_languages() {
    check(Half::Tuning, [88, 80]);
}

#[test]
#[ignore = "takes most of a minute of a processor"]
fn the_half_that_was_kept_aside_is_followed_in_five_languages() {
    check(Half::KeptAside, [80, 74]);
}

/// A robot without closed words is sure of a wrong meaning in at most 2 of 25 answers, and follows at least a fifteenth. The tuning half, which
/// is better, would take as long again.
#[test]
#[ignore = "takes half a minute of a processor"]
fn without_closed_words_little_harm_is_done() {
    for (name, lessons, tally) in judge_all(Half::KeptAside, Table::Empty, &[120], HOMES) {
        assert!(tally.helpful * 15 >= tally.follow, "{name}, {lessons} lessons: {} of {}", tally.helpful, tally.follow);
        assert!(tally.harmful * 25 <= tally.all * 2, "{name}, {lessons} lessons: harmful {} of {}", tally.harmful, tally.all);
    }
}

/// Sentences of an author who knew neither the program nor its rules, in the home that they were written for. They are much harder than the
/// suite's: at least two in five are followed, and at most a tenth of all answers are sure of a wrong meaning.
#[test]
#[ignore = "asks 2,219 sentences"]
fn sentences_of_other_authors_are_often_followed_and_seldom_mistaken() {
    let blocks = vec![("green", "bag", 0), ("blue", "chair", 1), ("red", "chair", 1), ("yellow", "basket", 2)];
    let home = Home { rooms: vec!["red", "blue", "green", "yellow"], blocks, robot: 1 };
    for (language, taught, otherwise, author, sentences) in BY_OTHERS {
        let folder = tempfile::tempdir().expect("a folder");
        let model = folder.path().join("words.goodbot").to_str().expect("a name").to_owned();
        let run = goodbot(&["learn", "-", "--quiet", "--out", &model], Wording::of(taught).with(otherwise).lessons(120).as_bytes());
        assert_eq!(run.code, 0, "{}", run.messages);
        let lines = sentences.lines().filter(|line| !line.starts_with('#'));
        let said: Vec<Vec<&str>> = lines.map(|line| line.split('\t').collect()).collect();
        let texts: Vec<String> = said.iter().map(|fields| fields[1].to_owned()).collect();
        let mut halves = [Tally::default(); 2];
        for (number, (fields, answer)) in said.iter().zip(asked_with(&[], &model, &home, &texts)).enumerate() {
            let (kind, meant) = (fields[0], fields[2]);
            let is_sure = answer["verdict"] == "sure" || answer["verdict"] == "done";
            let parts: Vec<String> = meant.split(" then ").map(str::to_owned).collect();
            // "The bag and the chair to ..." may be done in any order.
            let kind = if kind.starts_with("all") { "all" } else { kind };
            let is_right = is_sure && meant != "none" && is_right(answer["task"].as_str().unwrap_or(""), kind, &parts);
            let tally = &mut halves[number % 2];
            tally.all += 1;
            tally.follow += usize::from(meant != "none");
            tally.helpful += usize::from(is_right);
            tally.harmful += usize::from(is_sure && !is_right);
        }
        for (half, Tally { follow, helpful, all, harmful }) in ["tuning", "kept aside"].into_iter().zip(halves) {
            let share = |hits: usize, of: usize| {
                let (low, high) = interval(hits, of);
                format!("{:.1} ({low:.1} to {high:.1})", 100.0 * hits as f64 / of.max(1) as f64)
            };
            println!("{author}, {language}, {half}: helpful {}, harmful {}", share(helpful, follow), share(harmful, all));
            assert!(
                helpful * 5 >= follow * 2 && harmful * 10 <= all,
                "{author}, {language}, {half}: {helpful} of {follow}, harmful {harmful} of {all}"
            );
        }
    }
}
