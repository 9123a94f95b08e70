//! More lessons never make a worse robot: simulated robots in ten worlds, each with other things, and told in other ways.

use goodbot::Capacities;
use goodbot::language::{LanguageModel, Settings};
use goodbot::memory::AgentHeap;
use goodbot::oomdp::{ClassId, PropositionId};
use goodbot::planning::Progress;
use goodbot::probability::{Scaled, total};
use goodbot::random::below;
use goodbot::symbols::Symbol;
use goodbot::task::{Marker, Role, RoleKind};
use goodbot_layer::above;
use rand_core::SeedableRng;
use rand_pcg::Pcg32;

const COLORS: [&str; 6] = ["red", "green", "blue", "purple", "yellow", "grey"];
const SHAPES: [&str; 3] = ["key", "ball", "box"];

/// A thing, by its color and its shape, and the place that it is at.
type Thing = (usize, usize, usize);

/// A task: its kind, and the positions of what is brought and of its goal.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Task {
    kind: usize,
    subject: Option<usize>,
    goal: usize,
}

/// The things of a scene and its tasks.
struct Scene {
    things: Vec<Thing>,
    /// The color of each place; none if tasks are about things alone.
    places: Vec<usize>,
    robot: usize,
    tasks: Vec<Task>,
}

fn pick<'a, T>(random: &mut Pcg32, of: &'a [T]) -> &'a T {
    &of[below(of.len(), random)]
}

/// Different things, all at place 0.
fn things(count: usize, random: &mut Pcg32) -> Vec<Thing> {
    let mut all: Vec<Thing> = (0..COLORS.len()).flat_map(|color| (0..SHAPES.len()).map(move |shape| (color, shape, 0))).collect();
    (0..count).map(|_| all.swap_remove(below(all.len(), random))).collect()
}

/// A world: how scenes are drawn, and what is said for a task.
struct World {
    name: &'static str,
    scene: fn(&mut Pcg32) -> Scene,
    /// The tasks that are meant.
    is_meant: fn(&Scene, Task) -> bool,
    say: fn(&Scene, Task, &mut Pcg32) -> String,
}

/// Eight things; one shall be next to another.
fn next_to(random: &mut Pcg32) -> Scene {
    let things = things(8, random);
    let tasks =
        (0..8).flat_map(|one| (0..8).filter(move |&other| other != one).map(move |goal| Task { kind: 0, subject: Some(one), goal }));
    Scene { tasks: tasks.collect(), things, places: vec![], robot: 0 }
}

/// Eight things; the robot shall go to one.
fn go_to(random: &mut Pcg32) -> Scene {
    let mut things = things(8, random);
    // One is the red ball.
    if !things.iter().any(|it| (it.0, it.1) == (0, 1)) {
        things[0] = (0, 1, 0);
    }
    Scene { things, places: vec![], robot: 0, tasks: (0..8).map(|goal| Task { kind: 1, subject: None, goal }).collect() }
}

/// Four places of different colors with three things; the robot goes to one, or takes a thing there.
fn rooms(random: &mut Pcg32) -> Scene {
    let things = [(0, 0), (1, 1), (2, 2)].map(|(color, shape)| (color, shape, below(4, random))).to_vec();
    let robot = below(4, random);
    let goals = || 0..4;
    let mut tasks: Vec<Task> = goals().map(|goal| Task { kind: 2, subject: None, goal }).collect();
    tasks.extend((0..3).flat_map(|one| goals().map(move |goal| Task { kind: 3, subject: Some(one), goal })));
    Scene { things, places: vec![1, 0, 4, 2], robot, tasks }
}

/// The same with colors of places and things that are drawn.
fn any_rooms(random: &mut Pcg32) -> Scene {
    let things = things(2, random).into_iter().map(|(color, shape, _)| (color, shape, below(4, random))).collect();
    let mut colors: Vec<usize> = (0..COLORS.len()).collect();
    let places = (0..4).map(|_| colors.swap_remove(below(colors.len(), random))).collect();
    let mut tasks: Vec<Task> = (0..4).map(|goal| Task { kind: 2, subject: None, goal }).collect();
    tasks.extend((0..2).flat_map(|one| (0..4).map(move |goal| Task { kind: 3, subject: Some(one), goal })));
    Scene { things, places, robot: below(4, random), tasks }
}

fn thing(scene: &Scene, at: usize) -> String {
    let (color, shape, _) = scene.things[at];
    format!("the {} {}", COLORS[color], SHAPES[shape])
}

/// "go to" a place or "take" a thing there, with names for the places.
fn told(scene: &Scene, task: Task, names: [&str; 4], random: &mut Pcg32) -> String {
    let place = names[task.goal];
    match task.subject {
        None => pick(random, &["go to {}", "go to {}", "please go into {}"]).replace("{}", place),
        Some(one) => format!("{} the {} to {place}", pick(random, &["take", "take", "bring"]), SHAPES[scene.things[one].1]),
    }
}

/// Tasks that are not done yet in a place that has a name here.
fn is_open(scene: &Scene, task: Task, named: usize) -> bool {
    let at = task.subject.map_or(scene.robot, |one| scene.things[one].2);
    task.goal < named && at != task.goal
}

const WORLDS: [World; 10] = [
    World {
        name: "next to",
        scene: next_to,
        is_meant: |_, _| true,
        say: |scene, task, _| format!("put {} next to {}", thing(scene, task.subject.unwrap()), thing(scene, task.goal)),
    },
    World {
        name: "one sentence",
        scene: go_to,
        is_meant: |scene, task| (scene.things[task.goal].0, scene.things[task.goal].1) == (0, 1),
        say: |_, _, _| "go to the red ball".to_owned(),
    },
    World { name: "go to", scene: go_to, is_meant: |_, _| true, say: |scene, task, _| format!("go to {}", thing(scene, task.goal)) },
    World {
        name: "floors",
        scene: rooms,
        is_meant: |scene, task| is_open(scene, task, 3),
        say: |scene, task, random| told(scene, task, ["floor1", "floor2", "floor3", ""], random),
    },
    World {
        name: "four code words",
        scene: rooms,
        is_meant: |scene, task| is_open(scene, task, 2) && task.subject.is_none_or(|one| one == 0),
        say: |_, task, _| ["hop", "skip", "jump", "roll"][task.goal + 2 * usize::from(task.subject.is_some())].to_owned(),
    },
    World {
        name: "twelve code words",
        scene: rooms,
        is_meant: |scene, task| is_open(scene, task, 3),
        say: |_, task, _| {
            let words = ["hop", "skip", "jump", "roll", "zip", "fizz", "bonk", "twirl", "dash", "glim", "poof", "wonk"];
            words[task.goal + 3 * task.subject.map_or(0, |one| one + 1)].to_owned()
        },
    },
    World {
        name: "any rooms",
        scene: any_rooms,
        is_meant: |scene, task| is_open(scene, task, 4),
        say: |scene, task, random| {
            let place = COLORS[scene.places[task.goal]];
            match task.subject {
                None => pick(random, &["go to the {} room", "walk into the {} room", "{} room"]).replace("{}", place),
                Some(one) => format!("{} {} to the {place} room", pick(random, &["take", "bring", "move"]), thing(scene, one)),
            }
        },
    },
    World {
        name: "two names",
        scene: any_rooms,
        is_meant: |scene, task| is_open(scene, task, 4),
        say: |scene, task, random| {
            let other = ["scarlet", "lime", "azure", "violet", "golden", "silver"];
            let color = scene.places[task.goal];
            let place = *pick(random, &[COLORS[color], other[color]]);
            match task.subject {
                None => format!("go to the {place} room"),
                Some(one) => format!("take the {} to the {place} room", SHAPES[scene.things[one].1]),
            }
        },
    },
    World {
        name: "verb last",
        scene: any_rooms,
        is_meant: |scene, task| is_open(scene, task, 4),
        say: |scene, task, _| {
            let place = ["rojo", "verde", "azul", "morado", "amarillo", "gris"][scene.places[task.goal]];
            match task.subject {
                None => format!("sala {place} e iku"),
                Some(one) => format!("{} o sala {place} e hakobu", ["kagi", "bol", "hako"][scene.things[one].1]),
            }
        },
    },
    World {
        name: "from and to",
        scene: any_rooms,
        is_meant: |scene, task| is_open(scene, task, 4),
        say: |scene, task, random| {
            let place = COLORS[scene.places[task.goal]];
            let at = COLORS[scene.places[task.subject.map_or(scene.robot, |one| scene.things[one].2)]];
            match task.subject {
                None => {
                    pick(random, &["leave {at} and go to {}", "go to {} from {at}", "go to {}"]).replace("{at}", at).replace("{}", place)
                }
                Some(one) => pick(random, &["take the {it} from {at} to {}", "the {it} in {at} belongs in {}"])
                    .replace("{it}", SHAPES[scene.things[one].1])
                    .replace("{at}", at)
                    .replace("{}", place),
            }
        },
    },
];

/// The description of a task, as a robot makes it.
fn describe(model: &mut LanguageModel<AgentHeap>, scene: &Scene, task: Task) -> Vec<Symbol> {
    let mut token = |text: String| model.lend().tokens_mut().intern(&text).unwrap();
    let mut all = vec![token(format!("kind{}", task.kind))];
    let proposition = PropositionId::new(task.kind as u8);
    let mut tell = |role: Role, sort: u8, values: Vec<String>| {
        let mut symbols: Vec<Symbol> = values.into_iter().map(&mut token).collect();
        symbols.sort_unstable();
        symbols.dedup();
        if !symbols.is_empty() {
            all.push(Marker { role, sort }.symbol());
            all.extend(symbols);
        }
    };
    let color = |it: &Thing| format!("color{}", COLORS[it.0]);
    let shape = |it: &Thing| format!("shape{}", SHAPES[it.1]);
    let mut of_things = |role: Role, things: Vec<Thing>| {
        tell(role, 0, things.iter().map(color).collect());
        tell(role, 2, things.iter().map(shape).collect());
    };
    if let Some(one) = task.subject {
        of_things(Role::of_argument(RoleKind::Subject, proposition, 0), vec![scene.things[one]]);
    }
    let is_of_things = scene.places.is_empty();
    let others = |task: Task| (0..scene.things.len()).filter(move |&at| Some(at) != task.subject && !(is_of_things && at == task.goal));
    if is_of_things {
        of_things(Role::of_argument(RoleKind::Goal, proposition, 1), vec![scene.things[task.goal]]);
        of_things(Role::of_class(RoleKind::OtherPlace, ClassId::new(1)), others(task).map(|at| scene.things[at]).collect());
        return all;
    }
    of_things(Role::of_class(RoleKind::Other, ClassId::new(1)), others(task).map(|at| scene.things[at]).collect());
    let start = task.subject.map_or(scene.robot, |one| scene.things[one].2);
    let mut of_places = |role: Role, places: Vec<usize>| {
        tell(role, 0, places.iter().map(|&place| format!("color{}", COLORS[scene.places[place]])).collect());
        let there = |sort: u8| {
            let here = scene.things.iter().filter(|it| places.contains(&it.2));
            if sort == 1 { here.map(color).collect::<Vec<_>>() } else { here.map(shape).collect() }
        };
        if role.kind() == RoleKind::Goal {
            tell(role, 1, there(1));
            tell(role, 3, there(3));
        }
    };
    of_places(Role::of_argument(RoleKind::Goal, proposition, 1), vec![task.goal]);
    of_places(Role::of_argument(RoleKind::Start, PropositionId::new(3), 1), vec![start]);
    if task.subject.is_some() {
        of_places(Role::of_argument(RoleKind::Start, PropositionId::new(2), 1), vec![scene.robot]);
    }
    let rest = (0..scene.places.len()).filter(|&place| place != task.goal && place != start && place != scene.robot).collect();
    of_places(Role::of_class(RoleKind::OtherPlace, ClassId::new(2)), rest);
    all
}

/// A lesson or a question: what was said, all tasks, and the one that was meant.
fn draw(world: &World, random: &mut Pcg32) -> (Scene, usize, String) {
    loop {
        let scene = (world.scene)(random);
        let meant: Vec<usize> = (0..scene.tasks.len()).filter(|&task| (world.is_meant)(&scene, scene.tasks[task])).collect();
        if !meant.is_empty() {
            let meant = *pick(random, &meant);
            let said = (world.say)(&scene, scene.tasks[meant], random);
            return (scene, meant, said);
        }
    }
}

/// The share of `asked` new commands that a robot understands after each of these numbers of lessons.
fn curve(world: &World, settings: Settings, seed: u64, sizes: &[usize], asked: usize) -> Vec<f32> {
    let mut random = Pcg32::seed_from_u64(seed);
    let capacities = Capacities { states: 64, hashed_states: 0, ..Capacities::STANDARD };
    let memory = above(AgentHeap::new(&capacities), capacities.pairs * 4);
    let mut model = LanguageModel::new(memory, settings).unwrap();
    let mut shares = vec![];
    let mut learned = 0;
    for &size in sizes {
        for _ in learned..size {
            let (scene, meant, said) = draw(world, &mut random);
            let words = model.lend().hear(&said).unwrap();
            let tasks: Vec<Vec<Symbol>> = scene.tasks.iter().map(|&task| describe(&mut model, &scene, task)).collect();
            model.lend().add_session(&words, [(&tasks[meant][..], 1.0)].into_iter()).unwrap();
            if settings.layer {
                let share = 1.0 / tasks.len() as f32;
                model.lend().add_possible(tasks.iter().map(|task| (&task[..], share))).unwrap();
            }
        }
        learned = size;
        model.lend().begin_training();
        while model.lend().train(u32::MAX) == Progress::Working {}
        let mut random = Pcg32::seed_from_u64(1_000 + seed);
        let mut right = 0;
        for _ in 0..asked {
            let (scene, meant, said) = draw(world, &mut random);
            let words = model.lend().hear(&said).unwrap();
            let tasks: Vec<Vec<Symbol>> = scene.tasks.iter().map(|&task| describe(&mut model, &scene, task)).collect();
            let prior = 1.0 / tasks.len() as f32;
            let mut scores: Vec<Scaled> = tasks.iter().map(|task| model.read().likelihood(&words, task).scaled_by(prior)).collect();
            model.read().weigh_kinds(&words, |task| tasks[task][0], |_| prior, &mut scores);
            if settings.layer {
                model.read().weigh_parts(&words, |task| task, |task| &tasks[task], &mut scores);
            }
            model.lend().forget_unlearned();
            let whole = total(scores.iter().copied());
            let scores: Vec<f32> = scores.iter().map(|score| score.over(whole)).collect();
            right += usize::from(scores.iter().enumerate().all(|(task, &score)| task == meant || score < scores[meant]));
        }
        shares.push(right as f32 / asked as f32);
    }
    shares
}

/// The numbers of lessons after which the robots are asked.
const SIZES: [usize; 6] = [8, 16, 32, 64, 96, 128];
const ROBOTS: u64 = 10;
/// A curve may fall by this much on average: more than three times the standard error where a robot understands nine commands of ten.
const NOISE: f32 = 0.05;

/// No curve of a learner falls, on average over the robots of a world, by more than noise.
fn no_curve_falls(settings: Settings, worlds: impl Iterator<Item = &'static World>) {
    for world in worlds {
        let all: Vec<Vec<f32>> = (0..ROBOTS).map(|seed| curve(world, settings, seed, &SIZES, 40)).collect();
        let mean: Vec<f32> = (0..SIZES.len()).map(|at| all.iter().map(|it| it[at]).sum::<f32>() / ROBOTS as f32).collect();
        println!("{}: {mean:.2?}", world.name);
        let mut best = 0.0_f32;
        for &share in &mean {
            assert!(share > best - NOISE, "{}: {mean:?} after {SIZES:?} lessons", world.name);
            best = best.max(share);
        }
        assert!(best > 0.7, "{}: {mean:?} after {SIZES:?} lessons", world.name);
    }
}

#[test]
fn more_lessons_never_make_a_robot_worse() {
    no_curve_falls(Settings::LAYERED, WORLDS.iter());
}

#[test]
fn more_lessons_never_make_the_role_model_worse() {
    no_curve_falls(Settings::DEFAULT, WORLDS.iter());
}

#[test]
fn words_that_mean_a_whole_task_are_understood_after_few_lessons_with_each() {
    for (settings, name) in [(Settings::DEFAULT, "roles"), (Settings::LAYERED, "default")] {
        for world in WORLDS.iter().filter(|world| world.name.contains("code words")) {
            let shares: Vec<f32> = (0..ROBOTS).map(|seed| curve(world, settings, seed, &[48], 40)[0]).collect();
            let mean = shares.iter().sum::<f32>() / ROBOTS as f32;
            println!("{name}, {}: {mean:.2} after 48 lessons", world.name);
            assert!(mean > 0.9, "{name}, {}: {shares:?}", world.name);
        }
    }
}
