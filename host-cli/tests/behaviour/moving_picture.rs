//! The README's moving picture, drawn from a run: a first lesson with its belief, and then a command that no lesson had.
//!
//! `GOODBOT_DRAW=1 cargo test -p goodbot-cli --test behaviour moving_picture` writes it to `docs/lesson.svg`.

use std::fmt::Write;
use std::fs;

use serde_json::Value;

use crate::program::goodbot;

const DOCS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs");
/// Pixels of a cell, and the upper left corner of a home.
const CELL: f64 = 26.0;
const CORNER: (f64, f64) = (24.0, 42.0);
/// The left edge of the words, and of the bars with their longest length.
const WORDS_AT: f64 = 330.0;
const BARS_AT: f64 = 520.0;
const BAR: f64 = 200.0;
/// Seconds of a glide from cell to cell, or from belief to belief.
const GLIDE: f64 = 0.3;

type Cell = (i64, i64);

/// What is to be seen for some seconds.
#[derive(Clone)]
struct Moment {
    seconds: f64,
    /// None between the lessons.
    home: Option<usize>,
    robot: Cell,
    block: Cell,
    belief: Vec<f64>,
    command: String,
    /// What the trainer says.
    word: &'static str,
    remark: String,
}

/// A home as it is drawn, and the names of the tasks in the order of their bars.
struct Home {
    objects: Vec<Value>,
    tasks: Vec<String>,
}

impl Home {
    fn of(environment: &Value, tasks: Vec<String>) -> Self {
        Self { objects: environment["objects"].as_array().expect("objects").clone(), tasks }
    }

    fn of_class<'h>(&'h self, class: &'static str) -> impl Iterator<Item = &'h Value> {
        self.objects.iter().filter(move |object| object["class"] == class)
    }

    fn cell(&self, class: &'static str) -> Cell {
        let object = self.of_class(class).next().expect("an object of the class");
        (number(object, "x"), number(object, "y"))
    }

    fn top(&self) -> i64 {
        self.of_class("room").map(|room| number(room, "top")).max().expect("a room")
    }

    /// The upper left corner of a cell.
    fn corner(&self, (x, y): Cell) -> (f64, f64) {
        (CORNER.0 + x as f64 * CELL, CORNER.1 + (self.top() - y) as f64 * CELL)
    }
}

fn number(object: &Value, field: &str) -> i64 {
    object[field].as_i64().expect("a whole number")
}

/// The robot and the block after an action: the robot pushes a block that is in its way.
fn acted(robot: Cell, block: Cell, action: &str) -> (Cell, Cell) {
    let (x, y) = match action {
        "north" => (0, 1),
        "south" => (0, -1),
        "east" => (1, 0),
        "west" => (-1, 0),
        _ => (0, 0),
    };
    let to = (robot.0 + x, robot.1 + y);
    (to, if to == block { (block.0 + x, block.1 + y) } else { block })
}

/// The first lesson of the example's log, and the answer to a command of no lesson.
fn run() -> (Vec<Home>, Vec<Moment>) {
    let log = format!("{DOCS}/examples/sessions.jsonl");
    let lines: Vec<Value> =
        fs::read_to_string(&log).expect("a log").lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let replay = goodbot(&["replay", "--json", &log], b"");
    let tasks = ["blockInRoom(block0,room1)", "agentInRoom(agent0,room1)", "blockInRoom(block0,room2)", "agentInRoom(agent0,room2)"];
    let beliefs: Vec<Vec<f64>> = replay
        .output
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).expect("JSON"))
        .filter(|line| line["session"] == "chair to green")
        .map(|line| tasks.map(|task| line["tasks"][task].as_f64().expect("a probability")).to_vec())
        .collect();
    let names = ["take the chair to green", "go to green", "take the chair to red", "go to red"].map(String::from).to_vec();
    let first = Home::of(&lines[0]["environment"], names);
    let mut now = Moment {
        seconds: 2.6,
        home: Some(0),
        robot: first.cell("agent"),
        block: first.cell("block"),
        belief: beliefs[0].clone(),
        command: lines[0]["command"].as_str().expect("a command").to_owned(),
        word: "",
        remark: "It knows no word yet: four tasks are equally likely.".into(),
    };
    let mut moments = vec![now.clone()];
    for (step, line) in lines[1..].iter().take_while(|line| line["type"] == "step").enumerate() {
        let action = line["action"].as_str().expect("an action");
        (now.robot, now.block) = acted(now.robot, now.block, action);
        let is_slow = step < 3;
        if is_slow {
            moments.push(Moment { seconds: 0.9, word: "", remark: format!("It goes {action}."), ..now.clone() });
        }
        now.word = match line["feedback"].as_str() {
            Some("reward") => "good bot",
            Some("punish") => "bad bot",
            _ => "",
        };
        now.belief.clone_from(&beliefs[step + 1]);
        now.seconds = if is_slow { 1.7 } else { 0.5 };
        now.remark = match step {
            0 => "West is right for both tasks with the green room.",
            1 => "North was right for going there, wrong for taking the chair.",
            2 => "South goes round the chair: now it is nearly sure.",
            _ => "It finishes, and learns its first words.",
        }
        .into();
        moments.push(now.clone());
    }
    moments.last_mut().expect("a moment").seconds = 1.8;

    let others: Vec<&str> = lines.iter().filter_map(|line| line["command"].as_str()).skip(1).collect();
    moments.push(Moment { seconds: 3.0, home: None, command: others.join("\n"), word: "", remark: String::new(), ..now.clone() });

    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("words.goodbot").to_str().expect("a name").to_owned();
    assert_eq!(goodbot(&["learn", &log, "--out", &model], b"").code, 0);
    let (home, command) = (format!("{DOCS}/examples/home.json"), "take the yellow bag to the blue room");
    assert!(lines.iter().all(|line| line["command"] != command));
    let answer = goodbot(&["ask", "--json", "--with", &model, "--environment", &home, command], b"");
    let answer: Value = serde_json::from_str(&answer.output).expect("one line of JSON");
    assert_eq!(answer["verdict"], "sure");
    let meanings = answer["meanings"].as_array().expect("meanings");
    let names = meanings
        .iter()
        .map(|meaning| meaning["words"].as_str().expect("words").replace("the yellow", "the").replace("to the", "to").replace(" room", ""))
        .collect();
    let environment = serde_json::from_str(&fs::read_to_string(home).expect("a home")).expect("JSON");
    let second = Home::of(&environment, names);
    now = Moment {
        seconds: 2.6,
        home: Some(1),
        robot: second.cell("agent"),
        block: second.cell("block"),
        belief: meanings.iter().map(|meaning| meaning["probability"].as_f64().expect("a probability")).collect(),
        command: command.into(),
        word: "",
        remark: "No lesson had this command, but it understands.".into(),
    };
    moments.push(now.clone());
    for action in answer["plan"].as_array().expect("a plan") {
        (now.robot, now.block) = acted(now.robot, now.block, action.as_str().expect("an action"));
        now.seconds = 0.5;
        moments.push(now.clone());
    }
    moments.last_mut().expect("a moment").seconds = 3.2;
    let goal = second.of_class("room").find(|room| room["color"] == "blue").expect("a blue room");
    assert!(number(goal, "left") < now.block.0 && now.block.0 < number(goal, "right"), "the plan leads to the goal");
    (vec![first, second], moments)
}

/// A picture whose elements move.
struct Picture {
    body: String,
    rules: String,
    tracks: usize,
    /// When each moment begins, and when the last one ends.
    starts: Vec<f64>,
}

impl Picture {
    fn percent(&self, seconds: f64) -> String {
        format!("{:.2}%", 100.0 * seconds / self.starts.last().expect("an end"))
    }

    /// The class of an element with these keyframes: times with declarations.
    fn track(&mut self, frames: &[(f64, String)], timing: &str) -> String {
        let name = format!("t{}", self.tracks);
        self.tracks += 1;
        let length = self.starts.last().expect("an end");
        let frames: String = frames.iter().map(|(at, what)| format!("{}{{{what}}}", self.percent(*at))).collect();
        writeln!(self.rules, ".{name}{{animation:{name} {length:.1}s {timing} infinite}}@keyframes {name}{{{frames}}}").expect("a text");
        name
    }

    /// The attributes of an element that is there in some moments; without animation, in the last one.
    fn seen(&mut self, is_there: &[bool]) -> String {
        let frames: Vec<_> = (0..is_there.len())
            .filter(|&moment| moment == 0 || is_there[moment] != is_there[moment - 1])
            .map(|moment| (self.starts[moment], format!("opacity:{}", u8::from(is_there[moment]))))
            .collect();
        let last = u8::from(*is_there.last().expect("a moment"));
        if frames.len() == 1 {
            format!(r#"opacity="{last}""#)
        } else {
            format!(r#"class="{}" opacity="{last}""#, self.track(&frames, "step-end"))
        }
    }

    /// The attributes of an element with a transformation in each moment, into which it glides.
    fn moved(&mut self, transformations: &[String]) -> String {
        let end = self.starts.len() - 1;
        let mut frames = Vec::new();
        for (moment, transformation) in transformations.iter().enumerate() {
            if moment > 0 && *transformation != transformations[moment - 1] {
                frames.push((self.starts[moment], format!("transform:{}", transformations[moment - 1])));
                frames.push((self.starts[moment] + GLIDE, format!("transform:{transformation}")));
            } else if moment == 0 {
                frames.push((0.0, format!("transform:{transformation}")));
            }
        }
        let last = transformations.last().expect("a moment");
        frames.push((self.starts[end], format!("transform:{last}")));
        format!(r#"class="{}" style="transform:{last}""#, self.track(&frames, "linear"))
    }

    /// Each text in the moments that have it.
    fn texts(&mut self, of_moments: &[String], attributes: &str) {
        let mut texts: Vec<&String> = of_moments.iter().filter(|text| !text.is_empty()).collect();
        texts.sort();
        texts.dedup();
        for text in texts {
            let seen = self.seen(&of_moments.iter().map(|other| other == text).collect::<Vec<_>>());
            writeln!(self.body, "<text {attributes} {seen}>{text}</text>").expect("a text");
        }
    }
}

fn floor(color: &Value) -> &'static str {
    match color.as_str() {
        Some("red") => "#f3b9b0",
        Some("green") => "#bfe0b4",
        Some("blue") => "#b7cdf0",
        _ => "#dddddd",
    }
}

fn ink(color: &Value) -> &'static str {
    if color == "blue" { "#2f5fb3" } else { "#c79a00" }
}

fn draw(homes: &[Home], moments: &[Moment]) -> String {
    let mut starts = vec![0.0];
    for moment in moments {
        starts.push(starts.last().expect("a time") + moment.seconds);
    }
    let mut picture = Picture { body: String::new(), rules: String::new(), tracks: 0, starts };
    for (index, home) in homes.iter().enumerate() {
        let here: Vec<bool> = moments.iter().map(|moment| moment.home == Some(index)).collect();
        let seen = picture.seen(&here);
        writeln!(picture.body, "<g {seen}>").expect("a text");
        let (width, height) = {
            let right = home.of_class("room").map(|room| number(room, "right")).max().expect("a room");
            ((right + 1) as f64 * CELL, (home.top() + 1) as f64 * CELL)
        };
        writeln!(picture.body, r##"<rect x="{}" y="{}" width="{width}" height="{height}" rx="4" fill="#4a4a55"/>"##, CORNER.0, CORNER.1)
            .expect("a text");
        for place in home.of_class("room").chain(home.of_class("door")) {
            let inset = i64::from(place["class"] == "room");
            let (left, top) = home.corner((number(place, "left") + inset, number(place, "top") - inset));
            let wide = (number(place, "right") - number(place, "left") + 1 - 2 * inset) as f64 * CELL;
            let high = (number(place, "top") - number(place, "bottom") + 1 - 2 * inset) as f64 * CELL;
            let fill = if inset == 1 { floor(&place["color"]) } else { "#e8e4da" };
            writeln!(picture.body, r#"<rect x="{left}" y="{top}" width="{wide}" height="{high}" fill="{fill}"/>"#).expect("a text");
        }
        let block = home.of_class("block").next().expect("a block");
        // Elsewhere the pieces wait where they begin.
        let places = |of: fn(&Moment) -> Cell| {
            let first = here.iter().position(|is_here| *is_here).expect("a moment here");
            let last = here.iter().rposition(|is_here| *is_here).expect("a moment here");
            (0..moments.len())
                .map(|moment| home.corner(of(&moments[moment.clamp(first, last)])))
                .map(|(x, y)| format!("translate({x}px,{y}px)"))
                .collect::<Vec<_>>()
        };
        let moved = picture.moved(&places(|moment| moment.block));
        let shape = if block["shape"] == "chair" {
            r#"<path d="M6 3h4v10h11v10h-4v-6h-7v6h-4z"/>"#
        } else {
            r#"<path d="M4 10h18l-2 13h-14zM9 10a4 5 0 0 1 8 0h-2a2 3 0 0 0-4 0z"/>"#
        };
        writeln!(picture.body, r#"<g {moved} fill="{}">{shape}</g>"#, ink(&block["color"])).expect("a text");
        let moved = picture.moved(&places(|moment| moment.robot));
        writeln!(
            picture.body,
            r##"<g {moved}><rect x="3" y="5" width="20" height="18" rx="5" fill="#222"/><circle cx="9" cy="13" r="2.6" fill="#fff"/><circle cx="17" cy="13" r="2.6" fill="#fff"/><path d="M13 5V1" stroke="#222" stroke-width="2"/></g>"##
        )
        .expect("a text");
        for (row, task) in home.tasks.iter().enumerate() {
            let y = 138.0 + row as f64 * 28.0;
            writeln!(picture.body, r##"<text x="{WORDS_AT}" y="{y}" fill="#222">{task}</text>"##).expect("a text");
            let first = here.iter().position(|is_here| *is_here).expect("a moment here");
            let last = here.iter().rposition(|is_here| *is_here).expect("a moment here");
            let beliefs: Vec<f64> = (0..moments.len()).map(|moment| moments[moment.clamp(first, last)].belief[row]).collect();
            let moved = picture.moved(&beliefs.iter().map(|belief| format!("scaleX({belief:.3})")).collect::<Vec<_>>());
            writeln!(picture.body, r##"<rect {moved} x="{BARS_AT}" y="{}" width="{BAR}" height="16" fill="#3a7bd5"/>"##, y - 13.0)
                .expect("a text");
            let numbers: Vec<String> =
                beliefs.iter().zip(&here).map(|(belief, is_here)| if *is_here { format!("{belief:.3}") } else { String::new() }).collect();
            picture.texts(&numbers, &format!(r##"x="{}" y="{y}" fill="#555""##, BARS_AT + BAR + 8.0));
        }
        picture.body += "</g>\n";
    }
    let in_homes = |text: fn(&Moment) -> String| {
        moments.iter().map(|moment| if moment.home.is_some() { text(moment) } else { String::new() }).collect::<Vec<_>>()
    };
    let begun = moments.iter().map(|moment| moment.home.is_some()).collect::<Vec<_>>();
    let seen = picture.seen(&begun);
    writeln!(
        picture.body,
        r##"<g {seen} fill="#777"><text x="{WORDS_AT}" y="38">you say</text><text x="{WORDS_AT}" y="106">it believes that you mean</text></g>"##
    )
    .expect("a text");
    picture.texts(
        &in_homes(|moment| format!("“{}”", moment.command)),
        &format!(r##"x="{WORDS_AT}" y="64" font-size="20" font-weight="bold" fill="#222""##),
    );
    for (word, color) in [("good bot", "#1c7c3c"), ("bad bot", "#b3261e")] {
        let said: Vec<String> =
            moments.iter().map(|moment| if moment.word == word { format!("“{word}”") } else { String::new() }).collect();
        picture.texts(&said, &format!(r##"x="{WORDS_AT}" y="266" font-size="20" font-weight="bold" fill="{color}""##));
    }
    picture.texts(&in_homes(|moment| moment.remark.clone()), &format!(r##"x="{WORDS_AT}" y="292" fill="#222""##));
    let between: Vec<bool> = begun.iter().map(|is_home| !is_home).collect();
    let others = &moments.iter().find(|moment| moment.home.is_none()).expect("a moment between").command;
    let seen = picture.seen(&between);
    write!(
        picture.body,
        r##"<g {seen} text-anchor="middle" fill="#222"><text x="400" y="110" fill="#777">three more lessons like this</text>"##
    )
    .expect("a text");
    for (row, other) in others.lines().enumerate() {
        write!(picture.body, r#"<text x="400" y="{}" font-size="20">“{other}”</text>"#, 150 + 32 * row).expect("a text");
    }
    picture.body += "</g>\n";
    format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 800 318" width="800" height="318" font-family="sans-serif" font-size="15">
<title>A robot learns its first words, and understands a command that no lesson had</title>
<style>
rect{{transform-box:fill-box;transform-origin:left}}
{}@media (prefers-reduced-motion:reduce){{*{{animation:none!important}}}}
</style>
<rect width="800" height="318" rx="10" fill="#fbfaf6"/>
{}</svg>
"##,
        picture.rules, picture.body
    )
}

#[test]
fn the_moving_picture_is_that_of_its_run() {
    let (homes, moments) = run();
    let (drawn, file) = (draw(&homes, &moments), format!("{DOCS}/lesson.svg"));
    if std::env::var_os("GOODBOT_DRAW").is_some() {
        fs::write(&file, &drawn).expect("a picture is written");
    }
    let shown = fs::read_to_string(file).unwrap_or_default();
    assert!(shown == drawn, "draw it anew: GOODBOT_DRAW=1 cargo test -p goodbot-cli --test behaviour moving_picture");
}
