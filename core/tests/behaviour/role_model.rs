//! The role model: invariants for any training data.

use goodbot::capacity::{Capacity, CapacityError};
use goodbot::feedback::Feedback;
use goodbot::home::{Area, Cell, Home, HomeBuilder, HomeState, Moves, paper_tasks};
use goodbot::language::{Meaning, Synonyms};
use goodbot::memory::{AgentHeap, AgentMemory, HomeMemory};
use goodbot::oomdp::{Action, Domain, apply};
use goodbot::planning::Judgement;
use goodbot::planning::Progress;
use goodbot::session::Phase;
use goodbot::task::{RoleKind, TaskSet};
use goodbot::{Agent, AgentError, Capacities, HeapMemory, Options};

type Rooms = [&'static str; 3];

/// A wide room below two others, added in this order. The robot is in the wide room, and so is the block, if there is one.
fn home<M: HomeMemory>(memory: M, colors: Rooms, block: Option<(&str, &str)>, order: [usize; 3]) -> (Home<M>, HomeState) {
    let boxes = [Area::new(0, 0, 8, 4), Area::new(0, 4, 4, 8), Area::new(4, 4, 8, 8)];
    let mut builder = HomeBuilder::new(memory);
    for room in order {
        builder.room(&format!("room{room}"), boxes[room], colors[room]).unwrap();
    }
    builder.door("door0", Area::new(2, 4, 2, 4)).unwrap();
    builder.door("door1", Area::new(6, 4, 6, 4)).unwrap();
    builder.agent("agent0", Cell::new(4, 1)).unwrap();
    if let Some((color, shape)) = block {
        builder.block("block0", Cell::new(4, 2), color, shape).unwrap();
    }
    builder.build(Moves::Push).unwrap()
}

struct Taught {
    command: &'static str,
    colors: Rooms,
    block: Option<(&'static str, &'static str)>,
    /// The names of the subject and of its goal.
    meant: (&'static str, &'static str),
}

const fn lesson(
    command: &'static str,
    colors: Rooms,
    block: Option<(&'static str, &'static str)>,
    meant: (&'static str, &'static str),
) -> Taught {
    Taught { command, colors, block, meant }
}

const LESSONS: [Taught; 6] = [
    lesson("go to the green room", ["blue", "green", "red"], None, ("agent0", "room1")),
    lesson("go to the red room", ["blue", "green", "red"], None, ("agent0", "room2")),
    lesson("go to the blue room", ["red", "yellow", "blue"], None, ("agent0", "room2")),
    lesson("go to the yellow room", ["blue", "yellow", "red"], None, ("agent0", "room1")),
    lesson("take the blue chair to the green room", ["red", "green", "yellow"], Some(("blue", "chair")), ("block0", "room1")),
    lesson("take the green bag to the red room", ["blue", "yellow", "red"], Some(("green", "bag")), ("block0", "room2")),
];

fn task(agent: &Agent<impl AgentMemory>, domain: &impl Domain, (subject, place): (&str, &str)) -> usize {
    let name = |object| domain.world().objects.name(object);
    agent.tasks().iter().position(|task| name(task.bindings[0]) == subject && name(task.bindings[1]) == place).unwrap()
}

/// Teaches a command by judging every step.
fn teach(agent: &mut Agent<impl AgentMemory>, it: &Taught, colors: Rooms, block: Option<(&str, &str)>, command: &str, order: [usize; 3]) {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, mut state) = home(&mut memory.home, colors, block, order);
    agent.hear(&home, &state, command).unwrap();
    for _ in 0..20 {
        agent.plan_fully(&home, &state).unwrap();
        let action = agent.decide(&home, &state).unwrap().action;
        let right = agent.planned().judge(task(agent, &home, it.meant), action) == Judgement::Correct;
        let next = agent.acted(&home, &state, action).unwrap();
        let _ = agent.feedback(if right { Feedback::Reward } else { Feedback::Punish }).unwrap();
        assert_eq!(Some(next), apply(&home, &state, action));
        state = next;
    }
    let _ = agent.finish(&home).unwrap();
    agent.learn_fully();
}

fn new() -> Agent<AgentHeap> {
    Agent::new(AgentHeap::new(&Capacities::SMALL), &paper_tasks().unwrap(), Options::DEFAULT).unwrap()
}

/// A robot after all lessons.
fn taught() -> Agent<AgentHeap> {
    let mut agent = new();
    LESSONS.iter().for_each(|it| teach(&mut agent, it, it.colors, it.block, it.command, [0, 1, 2]));
    agent
}

fn posterior(
    agent: &mut Agent<impl AgentMemory>,
    colors: Rooms,
    block: (&str, &str),
    order: [usize; 3],
    command: &str,
) -> Vec<(String, f32)> {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = home(&mut memory.home, colors, Some(block), order);
    agent.hear(&home, &state, command).unwrap();
    let name = |object| home.world().objects.name(object);
    let tasks = agent.tasks().iter().enumerate();
    let mut all: Vec<(String, f32)> =
        tasks.map(|(t, it)| (format!("{} {}", name(it.bindings[0]), name(it.bindings[1])), agent.belief().probability(t))).collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    agent.forget();
    all
}

/// The posterior for a command in a home of a green, a blue and a red room with a yellow bag.
fn meant(agent: &mut Agent<impl AgentMemory>, command: &str) -> Vec<(String, f32)> {
    posterior(agent, ["green", "blue", "red"], ("yellow", "bag"), [0, 1, 2], command)
}

fn best(all: &[(String, f32)]) -> &str {
    &all.iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap().0
}

#[test]
fn probabilities_sum_to_one_and_what_was_taught_is_understood() {
    let mut agent = taught();
    for (command, wanted) in [
        ("go to the red room", "agent0 room2"),
        ("go to the blue room", "agent0 room1"),
        ("take the yellow bag to the red room", "block0 room2"),
        ("please, bring the bag to the BLUE room!", "block0 room1"),
    ] {
        let all = meant(&mut agent, command);
        assert!((all.iter().map(|(_, share)| share).sum::<f32>() - 1.0).abs() < 1e-5, "{command}");
        assert_eq!(best(&all), wanted, "{command}: {all:?}");
    }
}

#[test]
fn a_robot_that_expects_done_tasks_rests_where_it_is_told_to_be_and_leaves_things_where_they_belong() {
    let first_action = |done: f32, command: &str| {
        let mut agent = taught();
        agent.set_options(Options { done, ..Options::DEFAULT }).unwrap();
        let mut memory = HeapMemory::new(&Capacities::SMALL);
        let (home, state) = home(&mut memory.home, ["green", "blue", "red"], Some(("yellow", "bag")), [0, 1, 2]);
        agent.hear(&home, &state, command).unwrap();
        agent.plan_fully(&home, &state).unwrap();
        (agent.tasks().len(), agent.decide(&home, &state).unwrap().action == Action::NOOP)
    };
    for command in ["go to the green room", "take the yellow bag to the green room"] {
        assert_eq!(first_action(0.0, command), (4, false), "{command}: the paper's robot takes the next best task");
        assert_eq!(first_action(Options::SELDOM_DONE, command), (6, true), "{command}");
    }
    for command in ["go to the red room", "take the yellow bag to the blue room"] {
        assert_eq!(first_action(Options::SELDOM_DONE, command), (6, false), "{command}: this is still to do");
    }
}

#[test]
fn a_robot_without_words_does_something_in_every_home_although_it_expects_done_tasks() {
    let mut agent = Agent::new(
        AgentHeap::new(&Capacities::STANDARD),
        &paper_tasks().unwrap(),
        Options { done: Options::SELDOM_DONE, ..Options::DEFAULT },
    )
    .unwrap();
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let mut builder = HomeBuilder::new(&mut memory.home);
    for room in 0..10 {
        builder.room(&format!("room{room}"), Area::new(room * 3, 0, room * 3 + 3, 4), "red").unwrap();
        if room > 0 {
            builder.door(&format!("door{room}"), Area::new(room * 3, 2, room * 3, 2)).unwrap();
        }
    }
    builder.agent("agent0", Cell::new(1, 1)).unwrap();
    let (home, state) = builder.build(Moves::Push).unwrap();
    agent.hear(&home, &state, "zork").unwrap();
    agent.plan_fully(&home, &state).unwrap();
    assert_ne!(agent.decide(&home, &state).unwrap().action, Action::NOOP);
}

#[test]
fn the_order_of_the_objects_says_nothing() {
    let mut agent = taught();
    let command = "take the yellow bag to the red room";
    let one = meant(&mut agent, command);
    let other = posterior(&mut agent, ["green", "blue", "red"], ("yellow", "bag"), [2, 0, 1], command);
    for (one, other) in one.iter().zip(&other) {
        assert_eq!(one.0, other.0);
        assert!((one.1 - other.1).abs() < 1e-4, "{one:?} {other:?}");
    }
}

/// A lifted task and the colour of its goal.
type Meant = (&'static str, &'static str);

/// Trains on commands with their meanings and weights, then lets `ask` query the likelihood of commands under meanings.
fn trained_on<T>(rounds: u32, data: &[(&str, Meant, f32)], ask: impl FnOnce(&mut dyn FnMut(&str, Meant) -> f32) -> T) -> T {
    use goodbot::language::{LanguageModel, LanguageMut, Settings};
    let mut memory = HeapMemory::new(&Capacities { words: 256, translations: 2_048, alignments: 16_384, ..Capacities::STANDARD });
    let mut model = LanguageModel::new(&mut memory.agent, Settings { rounds, ..Settings::DEFAULT }).unwrap();
    let mut language = model.lend();
    let goal = goodbot::task::Marker { role: goodbot::task::Role::of_argument(RoleKind::Goal, goodbot::home::AGENT_IN_ROOM, 1), sort: 0 };
    let described = |language: &mut LanguageMut<'_>, (form, value): Meant| {
        [language.tokens_mut().intern(form).unwrap(), goal.symbol(), language.tokens_mut().intern(value).unwrap()]
    };
    for &(command, meant, weight) in data {
        let (words, description) = (language.hear(command).unwrap(), described(&mut language, meant));
        language.add_session(&words, [(&description[..], weight)].into_iter()).unwrap();
    }
    language.begin_training();
    while language.train(7) == Progress::Working {}
    ask(&mut |command, meant| {
        let (words, description) = (language.hear(command).unwrap(), described(&mut language, meant));
        language.read().likelihood(&words, &description).value()
    })
}

/// The same for going to a room of a colour.
fn trained<T>(rounds: u32, data: &[(&str, &'static str, f32)], ask: impl FnOnce(&mut dyn FnMut(&str, &'static str) -> f32) -> T) -> T {
    let data: Vec<_> = data.iter().map(|&(command, value, weight)| (command, ("agentInRoom", value), weight)).collect();
    trained_on(rounds, &data, |likelihood| ask(&mut |command, value| likelihood(command, ("agentInRoom", value))))
}

/// This many different words of four letters, such as `aakk`.
fn rare_words(count: u8) -> Vec<String> {
    let letter = |number: u8| char::from(b'a' + number);
    (0..count).map(|number| (letter(number / 16), letter(10 + number % 16))).map(|(a, b)| format!("{a}{a}{b}{b}")).collect()
}

#[test]
fn the_order_of_the_sessions_says_nothing_beyond_rounding() {
    let mut data = [("go to red", "colorRed", 1.0), ("walk to green", "colorGreen", 1.0), ("run to the red room", "colorRed", 1.0)];
    let answers =
        |data: &[_]| trained(8, data, |likelihood| ["colorRed", "colorGreen"].map(|value| likelihood("go to the green room", value)));
    let forwards = answers(&data);
    data.reverse();
    for (one, other) in forwards.iter().zip(answers(&data)) {
        assert!((one / other - 1.0).abs() < 1e-4, "{one} {other}");
    }
    assert!(forwards[1] > forwards[0]);
}

#[test]
fn a_weight_that_is_no_number_from_0_on_counts_as_0_and_spoils_nothing() {
    let with = |weight| {
        let data = [("go to red", "colorRed", 1.0), ("go to green", "colorGreen", 1.0), ("go to red", "colorGreen", weight)];
        trained(8, &data, |likelihood| ["colorRed", "colorGreen"].map(|value| likelihood("go to red", value)))
    };
    let nothing = with(0.0);
    assert!(nothing[0] > 2.0 * nothing[1], "{nothing:?}");
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0] {
        assert_eq!(with(bad).map(f32::to_bits), nothing.map(f32::to_bits), "{bad}");
    }
}

#[test]
fn what_was_heard_once_is_a_hint_and_no_proof() {
    let rare: Vec<String> = rare_words(60).iter().map(|word| format!("go to the {word} room")).collect();
    let colors = ["colorRed", "colorGreen"];
    let rare = rare.iter().enumerate().map(|(number, command)| (command.as_str(), colors[number % 2], 1.0));
    let often = (0..20).flat_map(|_| [("go to the red room", colors[0], 1.0), ("go to the green room", colors[1], 1.0)]);
    let data: Vec<(&str, &str, f32)> = often.chain(rare).collect();
    let ratio = |command: &str| trained(8, &data, |likelihood| likelihood(command, "colorRed") / likelihood(command, "colorGreen"));
    let (once, often) = (ratio("go to the aakk room"), ratio("go to the red room"));
    assert!((1.5..20.0).contains(&once) && often > 5.0 * once, "{once} {often}");
}

#[test]
fn a_deed_that_was_heard_once_is_a_hint_and_no_proof() {
    let forms = ["agentInRoom", "blockInRoom"];
    let rare: Vec<String> = rare_words(160).iter().map(|word| format!("{word} to the red room")).collect();
    let rare = rare.iter().enumerate().map(|(number, command)| (command.as_str(), (forms[number % 2], "colorRed"), 1.0));
    let often =
        (0..80).flat_map(|_| [("go to the red room", (forms[0], "colorRed"), 1.0), ("push to the red room", (forms[1], "colorRed"), 1.0)]);
    let data: Vec<(&str, Meant, f32)> = often.chain(rare).collect();
    let ratio = |command: &str| {
        trained_on(8, &data, |likelihood| likelihood(command, (forms[0], "colorRed")) / likelihood(command, (forms[1], "colorRed")))
    };
    let (once, often) = (ratio("please aakk to the red room"), ratio("please go to the red room"));
    assert!((1.5..30.0).contains(&once) && often > 3.0 * once, "{once} {often}");
}

#[test]
fn a_code_word_means_a_whole_task_after_one_lesson_with_it() {
    let colors = ["blue", "green", "red"];
    let meanings = ["agent0 room1", "agent0 room2", "block0 room1", "block0 room2"];
    let code = ["hop", "zap", "nix", "bam"];
    let mut agent = new();
    let chair = ("blue", "chair");
    for (command, meant) in code.iter().zip(meanings) {
        let meant = meant.split_once(' ').unwrap();
        teach(&mut agent, &lesson("", colors, None, meant), colors, Some(chair), command, [0, 1, 2]);
    }
    for (command, meant) in code.iter().zip(meanings) {
        let all = posterior(&mut agent, colors, chair, [0, 1, 2], command);
        assert_eq!(best(&all), meant, "{command}: {all:?}");
    }
}

#[test]
fn a_command_that_means_something_else_each_time_tells_none_of_its_meanings() {
    let colors = ["colorRed", "colorGreen", "colorBlue", "colorGray"];
    let said_of = |meanings: [usize; 4]| {
        let data = meanings.map(|meaning| ("again", colors[meaning], 1.0));
        let others = colors.map(|color| ("go there", color, 1.0));
        trained(8, &[&data[..], &others[..]].concat(), |likelihood| likelihood("again", colors[0]) / likelihood("again", colors[3]))
    };
    let (always, each) = (said_of([0; 4]), said_of([0, 1, 2, 2]));
    assert!(always > 5.0 * each && each < 4.0, "{always} {each}");
}

#[test]
fn a_round_of_training_loses_next_to_no_likelihood() {
    let data = [
        ("go to the red room", "colorRed", 1.0),
        ("walk into the green room please", "colorGreen", 1.0),
        ("please go to blue", "colorBlue", 1.0),
        ("move to the room that is red", "colorRed", 0.7),
        ("the green one", "colorGreen", 0.6),
        ("to the blue room now", "colorBlue", 1.0),
    ];
    let after = |rounds| {
        trained(rounds, &data, |likelihood| {
            data.iter().map(|&(command, value, weight)| f64::from(weight) * f64::from(likelihood(command, value)).ln()).sum::<f64>()
        })
    };
    let course: Vec<f64> = (0..12).map(after).collect();
    // Pseudo-counts and the lift make a round only approximately increasing.
    assert!(course.windows(2).all(|pair| pair[1] > pair[0] - 0.001 * pair[0].abs()), "{course:?}");
    assert!(course[8] > course[0] + 1.0, "{course:?}");
}

#[test]
fn other_names_for_the_colors_change_nothing() {
    let renamed = |text: &str| -> &'static str {
        match text {
            "red" => "rood",
            "green" => "groen",
            "blue" => "blauw",
            "yellow" => "geel",
            other => panic!("{other}"),
        }
    };
    let say = |text: &str| text.replace("red", "rood").replace("green", "groen").replace("blue", "blauw").replace("yellow", "geel");
    let (mut one, mut other) = (taught(), new());
    for it in &LESSONS {
        let colors = it.colors.map(renamed);
        teach(&mut other, it, colors, it.block.map(|(color, shape)| (renamed(color), shape)), &say(it.command), [0, 1, 2]);
    }
    let command = "take the yellow bag to the red room";
    let a = meant(&mut one, command);
    let b = posterior(&mut other, ["groen", "blauw", "rood"], ("geel", "bag"), [0, 1, 2], &say(command));
    for (a, b) in a.iter().zip(&b) {
        assert!((a.1 - b.1).abs() < 1e-5, "{a:?} {b:?}");
    }
}

#[test]
fn each_word_is_explained_and_its_shares_sum_to_one() {
    let mut agent = taught();
    let mut homes = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = home(&mut homes.home, ["green", "blue", "red"], Some(("yellow", "bag")), [0, 1, 2]);
    agent.hear(&home, &state, "take the bag to the red room").unwrap();
    let best = agent.most_likely().unwrap();
    let mut sums = [0.0_f32; 7];
    let mut red = None;
    agent
        .explain(&home, best, |position, meaning, share| {
            sums[position] += share;
            if position == 5 && share > 0.5 {
                red = Some(meaning);
            }
        })
        .unwrap();
    assert!(sums.iter().all(|sum| (sum - 1.0).abs() < 1e-4), "{sums:?}");
    let Some(Meaning::Value(role, value)) = red else { panic!("{red:?}") };
    assert_eq!((role.kind(), agent.language().tokens().text(value)), (RoleKind::Goal, "colorRed"));
}

#[test]
fn tasks_that_words_cannot_tell_apart_are_explained_alike_and_in_as_many_parts() {
    let mut agent = taught();
    let mut homes = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = home(&mut homes.home, ["green", "red", "red"], Some(("yellow", "bag")), [0, 1, 2]);
    agent.hear(&home, &state, "take the bag to the red room").unwrap();
    let [first, second] = ["room1", "room2"].map(|room| {
        let (task, mut parts, mut meanings) = (task(&agent, &home, ("block0", room)), 0, Vec::new());
        while agent.explain_on(&home, task, 1).unwrap() == Progress::Working {
            parts += 1;
        }
        agent.explain(&home, task, |position, meaning, share| meanings.push((position, meaning, share))).unwrap();
        (parts, meanings)
    });
    assert!(first.0 > 0 && first.1.len() > 7, "{first:?}");
    assert_eq!(first, second);
}

#[test]
fn long_and_unheard_commands_get_a_sensible_answer() {
    let mut agent = taught();
    let long = "go to the red room and ".repeat(10);
    assert_eq!(long.split_whitespace().count(), 60);
    let all = meant(&mut agent, &long);
    assert_eq!(best(&all), "agent0 room2");
    let all = meant(&mut agent, "xyzzy plugh");
    assert!(all.iter().all(|(_, share)| (0.0..=0.8).contains(share)), "{all:?}");
    assert!((all.iter().map(|(_, share)| share).sum::<f32>() - 1.0).abs() < 1e-5);
}

#[test]
fn a_slip_of_the_pen_counts_as_the_word() {
    let mut agent = taught();
    let right = meant(&mut agent, "take the yellow bag to the red room");
    let slips = meant(&mut agent, "take the yelow bag to the red romo");
    assert_eq!(right.iter().map(|it| &it.0).collect::<Vec<_>>(), slips.iter().map(|it| &it.0).collect::<Vec<_>>());
    assert_eq!(best(&right), best(&slips));
}

#[test]
fn words_that_differ_in_a_digit_alone_are_different_words() {
    let lessons = [("go to bay12", "red", 1.0), ("go to bay13", "green", 1.0), ("enter bay12", "red", 1.0), ("enter bay13", "green", 1.0)];
    trained(8, &lessons, |likelihood| {
        assert!(likelihood("bay12", "red") > 2.0 * likelihood("bay12", "green"));
        assert!(likelihood("bay13", "green") > 2.0 * likelihood("bay13", "red"));
        let (of_red, of_green) = (likelihood("bay14", "red"), likelihood("bay14", "green"));
        assert!((of_red - of_green).abs() < 1e-3 * of_red, "a bay never heard of is neither: {of_red}, {of_green}");
    });
}

/// "Living room" and "bedroom" with one particle, then with another.
#[test]
fn a_korean_word_with_another_particle_is_the_same_word() {
    let lessons = [("거실로 가", "red", 1.0), ("침실로 가", "green", 1.0), ("거실로 이동", "red", 1.0), ("침실로 이동", "green", 1.0)];
    trained(8, &lessons, |likelihood| {
        assert!(likelihood("거실에 가", "red") > 2.0 * likelihood("거실에 가", "green"));
        assert!(likelihood("침실 가", "green") > 2.0 * likelihood("침실 가", "red"));
        let (of_red, of_green) = (likelihood("거품에 가", "red"), likelihood("거품에 가", "green"));
        assert!((of_red - of_green).abs() < 1e-3 * of_red, "a word with another syllable is another word: {of_red}, {of_green}");
    });
}

#[test]
fn what_was_learned_is_the_same_whatever_the_budget() {
    let mut files = Vec::new();
    for budget in [1, 100, u32::MAX] {
        let mut agent = new();
        let mut homes = HeapMemory::new(&Capacities::SMALL);
        let (home, state) = home(&mut homes.home, ["green", "blue", "red"], Some(("yellow", "bag")), [0, 1, 2]);
        for command in ["go to the red room", "take the yellow bag to the blue room"] {
            agent.begin_hearing(&home, &state, command).unwrap();
            while agent.hear_on(&home, budget).unwrap() == Progress::Working {}
            agent.begin_finishing(&home).unwrap();
            while agent.finish_on(&home, budget).unwrap().is_none() {}
            while agent.learn(budget) == Progress::Working {}
        }
        agent.hear(&home, &state, "bring the red bag").unwrap();
        files.push((0..agent.tasks().len()).map(|task| agent.belief().probability(task).to_bits()).collect::<Vec<_>>());
    }
    assert!(files.windows(2).all(|two| two[0] == two[1]));
}

#[test]
fn tasks_among_many_new_values_are_described_the_same_whatever_the_budget() {
    // Two rooms in the middle are alike, and their tasks have one description.
    let colors: Vec<String> = (0..30).map(|number| format!("hue{}", if number == 15 { 14 } else { number })).collect();
    let described = |budget: u32, tokens: usize, is_interrupted: bool| {
        let mut memory = HeapMemory::new(&Capacities { tokens, ..Capacities::STANDARD });
        let mut builder = HomeBuilder::new(&mut memory.home);
        for (number, color) in colors.iter().enumerate() {
            let left = 2 * number as i32;
            builder.room(&format!("room{number}"), Area::new(left, 0, left + 2, 2), color).unwrap();
            if number > 0 {
                builder.door(&format!("door{number}"), Area::new(left, 1, left, 1)).unwrap();
            }
        }
        builder.agent("agent0", Cell::new(1, 1)).unwrap();
        let (home, state) = builder.build(Moves::Push).unwrap();
        let mut agent = Agent::new(memory.agent, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        agent.begin_hearing(&home, &state, "go").unwrap();
        let mut calls = 0;
        while agent.hear_on(&home, budget).unwrap() == Progress::Working {
            calls += 1;
            if is_interrupted {
                let _ = agent.save_in_place().unwrap();
            }
        }
        agent.begin_finishing(&home).unwrap();
        while agent.finish_on(&home, budget).unwrap().is_none() {
            calls += 1;
        }
        let (candidates, tokens) = (agent.candidates(), agent.language().tokens());
        assert!(candidates.entries().len() < agent.tasks().len());
        let text = |entry| candidates.tokens(entry).iter().map(|&token| tokens.text(token).to_owned()).collect::<Vec<_>>();
        let descriptions: Vec<_> = candidates.entries().iter().map(|entry| (text(entry), entry.likelihood, entry.weight)).collect();
        (calls, (descriptions, tokens.iter().map(|(_, text)| text.to_owned()).collect::<Vec<_>>()))
    };
    for (tokens, known) in [(Capacities::STANDARD.tokens, 30), (20, 20)] {
        let (calls, whole) = described(u32::MAX, tokens, false);
        assert!(calls == 0 && whole.1.len() >= known, "{calls} {whole:?}");
        for (budget, is_interrupted) in [(1, false), (10, false), (100, false), (1, true)] {
            let (calls, parts) = described(budget, tokens, is_interrupted);
            assert!(calls > 20, "{calls} calls of budget {budget}");
            assert_eq!(parts, whole, "{budget} {is_interrupted}");
        }
    }
}

/// A word of a number: no two begin with the same four letters.
fn word(number: usize) -> String {
    let (consonants, vowels) = (b"bdfghklmnprst", b"aeiou");
    let letters = [
        consonants[number % 13],
        vowels[number / 13 % 5],
        consonants[(number + number / 65) % 13],
        vowels[number / 3 % 5],
        consonants[number * 7 % 13],
        b'o',
    ];
    letters.map(char::from).iter().collect()
}

#[test]
fn a_new_word_is_compared_with_few_known_words_at_a_time_and_means_the_same() {
    let taught = || {
        let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        let mut homes = HeapMemory::new(&Capacities::SMALL);
        let (home, state) = home(&mut homes.home, ["green", "blue", "red"], Some(("yellow", "bag")), [0, 1, 2]);
        for number in 0..6 {
            let words: Vec<_> = (0..30).map(|at| word(30 * number + at)).collect();
            agent.hear(&home, &state, &words.join(" ")).unwrap();
            agent.finish_for_later(&home).unwrap();
        }
        agent.begin_learning();
        agent.learn_fully();
        agent
    };
    let mut homes = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = home(&mut homes.home, ["green", "blue", "red"], Some(("yellow", "bag")), [0, 1, 2]);
    // Known words, slips of them, forms of them, and new ones.
    let words: Vec<_> = (0..64).map(|at| word(at) + ["", "n", "ningly", "zzzzz"][at % 4]).collect();
    let command = words.join(", ");
    let (mut whole, mut parts) = (taught(), taught());
    assert!(whole.language().words().len() > 100);
    whole.hear(&home, &state, &command).unwrap();
    parts.begin_hearing(&home, &state, &command).unwrap();
    assert_eq!(parts.sentence(), []);
    let mut calls = 0;
    while parts.hear_on(&home, 1).unwrap() == Progress::Working {
        calls += 1;
    }
    assert!(calls > 300, "{calls}");
    assert_eq!(parts.sentence(), whole.sentence());
    let texts = |agent: &Agent<AgentHeap>| agent.language().words().iter().map(|(_, text)| text.to_owned()).collect::<Vec<_>>();
    assert_eq!(texts(&parts), texts(&whole));
    let bits =
        |agent: &Agent<AgentHeap>| (0..agent.tasks().len()).map(|task| agent.belief().probability(task).to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&parts), bits(&whole));
    // Work that needs the same memory in between changes nothing.
    parts.begin_hearing(&home, &state, &command).unwrap();
    assert_eq!(parts.hear_on(&home, 1).unwrap(), Progress::Working);
    let model = parts.save_in_place().unwrap().to_vec();
    assert_eq!(model, whole.saved().unwrap());
    while parts.hear_on(&home, 1).unwrap() == Progress::Working {}
    assert_eq!((parts.sentence(), bits(&parts)), (whole.sentence(), bits(&whole)));
}

#[test]
fn a_long_command_is_looked_at_in_parts_and_heard_the_same() {
    let mut homes = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = home(&mut homes.home, ["green", "blue", "red"], Some(("yellow", "bag")), [0, 1, 2]);
    let full = |capacity, limit, given| Err(AgentError::Capacity(CapacityError::new(capacity, limit, given)));
    let (space, marks, word) = (" ".repeat(500), "\u{301}'.".repeat(200), "é".repeat(24));
    for (command, words) in [
        (format!("{space}go{space}there'{space}"), Ok(2)),
        (format!("go{marks}{word}, {}", "'".repeat(500)), Ok(2)),
        (format!("{}去 red 的房间。", space.replace(' ', "!")), Ok(5)),
        (space + &marks, Err(AgentError::EmptyCommand)),
        ("a".repeat(700), full(Capacity::NameBytes, 48, 700)),
        ("go, ".repeat(300), full(Capacity::WordsPerCommand, 64, 300)),
    ] {
        let mut heard = Vec::new();
        for budget in [1, 40, u32::MAX] {
            let (mut agent, mut calls) =
                (Agent::new(AgentHeap::new(&Capacities::STANDARD), &paper_tasks().unwrap(), Options::DEFAULT).unwrap(), 1);
            agent.begin_hearing(&home, &state, &command).unwrap();
            let mut result = agent.hear_on(&home, budget);
            while result == Ok(Progress::Working) {
                result = agent.hear_on(&home, budget);
                calls += 1;
            }
            assert!(budget > 1 || calls * 32 > command.chars().count(), "{calls} calls for {command}");
            assert_eq!(result.map(|_| agent.sentence().len()), words, "{command}");
            let texts: Vec<_> = agent.language().words().iter().map(|(_, text)| text.to_owned()).collect();
            heard.push((agent.sentence().to_vec(), texts));
        }
        assert!(heard.windows(2).all(|two| two[0] == two[1]), "{heard:?}");
    }
}

#[test]
fn plans_are_the_same_whatever_was_said_since_the_last_one() {
    let mut homes = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = home(&mut homes.home, ["green", "blue", "red"], Some(("yellow", "bag")), [0, 1, 2]);
    let plans_after = |commands: &[String]| {
        let mut agent = new();
        for command in commands {
            agent.hear(&home, &state, command).unwrap();
            assert_eq!(agent.plan(&home, &state, u32::MAX).unwrap(), Progress::Done);
        }
        let plan = agent.planned();
        (0..agent.tasks().len()).map(|task| (plan.optimal(task), plan.distance(task))).collect::<Vec<_>>()
    };
    let once = plans_after(&["go".to_owned()]);
    // A command is kept in the memory of plans while it is heard.
    for words in [1, 20, 60] {
        assert_eq!(plans_after(&["go".to_owned(), "abcdefg ".repeat(words)]), once, "{words} words");
    }
}

#[test]
fn a_command_that_is_too_long_is_told_while_it_is_heard_in_parts() {
    let mut homes = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = home(&mut homes.home, ["green", "blue", "red"], None, [0, 1, 2]);
    let mut agent = new();
    assert_eq!(agent.begin_hearing(&home, &state, " , "), Err(AgentError::EmptyCommand));
    for (command, error) in [
        ("go ".repeat(70), CapacityError::new(Capacity::WordsPerCommand, 64, 70)),
        ("go ".to_owned() + &"o".repeat(60), CapacityError::new(Capacity::NameBytes, 48, 60)),
    ] {
        agent.begin_hearing(&home, &state, &command).unwrap();
        let heard = loop {
            match agent.hear_on(&home, 1) {
                Ok(Progress::Working) => {}
                end => break end,
            }
        };
        assert_eq!(heard, Err(AgentError::Capacity(error)));
        assert_eq!(agent.hear(&home, &state, &command), Err(AgentError::Capacity(error)));
        // No session is under way.
        assert_eq!(agent.hear_on(&home, 1), Err(AgentError::NotNow(Phase::Idle)));
    }
}

#[test]
fn a_restored_robot_understands_the_same_to_the_last_bit() {
    let mut agent = taught();
    let mut buffer = vec![0; 8_192];
    let length = agent.save(&mut buffer).unwrap();
    let mut restored = Agent::new(AgentHeap::new(&Capacities::SMALL), &paper_tasks().unwrap(), Options::PAPER).unwrap();
    restored.restore(&buffer[..length]).unwrap();
    restored.learn_fully();
    let command = "take the yellow bag to the red room";
    assert_eq!(meant(&mut agent, command), meant(&mut restored, command));
}

#[test]
fn a_synonym_that_was_learned_stands_for_a_word_that_was_not() {
    let mut agent = taught();
    let words = Synonyms::new("red crimson ruby\nbring carry take").unwrap();
    let said = "carry the bag to the Crimson room, please!";
    let heard = words.in_known_words(agent.language(), said).unwrap();
    assert_eq!(heard, "take the bag to the red room please");
    assert_eq!(meant(&mut agent, &heard), meant(&mut agent, "take the bag to the red room please"));
    // Learned words come first, even misspelled ones, and words in no line stay unchanged.
    let words = Synonyms::new("blue red\nbag room").unwrap();
    assert_eq!(words.in_known_words(agent.language(), "the red romo xyzzy").unwrap(), "the red romo xyzzy");
    assert!(words.in_known_words(agent.language(), &"go ".repeat(1_000)).is_err());
}

#[test]
fn more_tasks_than_fit_are_refused_by_name_and_nothing_learned_is_lost() {
    let mut memory = HeapMemory::new(&Capacities { tasks: 12, ..Capacities::STANDARD });
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    LESSONS.iter().for_each(|it| teach(&mut agent, it, it.colors, it.block, it.command, [0, 1, 2]));
    let command = "take the yellow bag to the red room";
    let before = meant(&mut agent, command);

    // Nine rooms in a row with eight blocks: 72 meanings.
    let mut homes = HeapMemory::new(&Capacities::STANDARD);
    let mut builder = HomeBuilder::new(&mut homes.home);
    for room in 0..9 {
        builder.room(&format!("room{room}"), Area::new(4 * room, 0, 4 * room + 4, 4), ["red", "green"][room as usize % 2]).unwrap();
    }
    for door in 1..9 {
        builder.door(&format!("door{door}"), Area::new(4 * door, 2, 4 * door, 2)).unwrap();
    }
    builder.agent("agent0", Cell::new(1, 1)).unwrap();
    for block in 0..8 {
        builder.block(&format!("block{block}"), Cell::new(4 * block + 6, 2), "yellow", "bag").unwrap();
    }
    let (crowded, state) = builder.build(Moves::Push).unwrap();
    // If the largest memory has room for fewer, they are not counted to the end.
    assert_eq!(
        agent.hear(&crowded, &state, command),
        Err(AgentError::Capacity(CapacityError::new(Capacity::Tasks, 12, 72.min(TaskSet::MOST + 1))))
    );
    assert_eq!(meant(&mut agent, command), before);
}

#[cfg(feature = "talk")]
#[test]
fn what_shall_not_be_is_followed_and_teaches_no_words() {
    let mut agent = taught();
    let sessions = agent.language().bitext().sessions();
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, mut state) = home(&mut memory.home, ["red", "green", "blue"], None, [0, 1, 2]);
    let words = goodbot::talk::ClosedWords::new("negation: not\nout: leave").unwrap();
    let listened = agent.listen(&home, &state, "leave the red room", words).unwrap();
    assert_eq!(listened.hypothesis, goodbot::talk::Hypothesis::Negated);
    assert_eq!(agent.task_text(&home, listened.task).unwrap().to_string(), "!agentInRoom(agent0,room0)");
    for _ in 0..20 {
        agent.plan_fully(&home, &state).unwrap();
        let action = agent.planned().optimal(listened.task).onward().and_then(|actions| actions.iter().next());
        let Some(action) = action else { break };
        state = agent.acted(&home, &state, action).unwrap();
        let _ = agent.feedback(Feedback::Reward).unwrap();
    }
    assert!(agent.tasks()[listened.task].is_reached(&agent.lifted()[0], |part| home.holds(part, &state)));
    assert_eq!(agent.finish(&home).unwrap().gave_way.count(), 0);
    agent.learn_fully();
    assert_eq!(agent.language().bitext().sessions(), sessions);
    assert_eq!(agent.phase(), goodbot::session::Phase::Ended);
}
