//! The layer above the role model: its contribution, and the cases where it must not change anything.

use goodbot::capacity::{Capacity, CapacityError};
use goodbot::home::AGENT_IN_ROOM;
use goodbot::language::{LanguageModel, Settings};
use goodbot::memory::AgentHeap;
use goodbot::oomdp::PropositionId;
use goodbot::planning::Progress;
use goodbot::probability::{Scaled, total};
use goodbot::symbols::Symbol;
use goodbot::task::{Marker, Role, RoleKind};
use goodbot::{Capacities, capacity};
use goodbot_layer::above;

const COLORS: [&str; 4] = ["colorRed", "colorGreen", "colorBlue", "colorYellow"];
/// Commands, each with the color of its goal.
const LESSONS: [(&str, usize); 10] = [
    ("skip the green room enter the blue room", 2),
    ("skip the blue room enter the green room", 1),
    ("enter the red room skip the blue room", 0),
    ("enter the yellow room", 3),
    ("skip the green room enter the red room", 0),
    ("enter the red room", 0),
    ("skip the blue room enter the red room", 0),
    ("enter the green room skip the red room", 1),
    ("enter the blue room skip the green room", 2),
    ("enter the yellow room please", 3),
];

fn capacities() -> Capacities {
    Capacities { states: 64, hashed_states: 0, ..Capacities::STANDARD }
}

fn memory() -> AgentHeap {
    above(AgentHeap::new(&capacities()), capacities().pairs)
}

/// The task to go to the room of each color.
fn tasks(model: &mut LanguageModel<AgentHeap>) -> Vec<[Symbol; 3]> {
    let goal = Marker { role: Role::of_argument(RoleKind::Goal, AGENT_IN_ROOM, 1), sort: 0 }.symbol();
    let form = model.lend().tokens_mut().intern("agentInRoom").unwrap();
    COLORS.iter().map(|color| [form, goal, model.lend().tokens_mut().intern(color).unwrap()]).collect()
}

fn with_lessons(memory: AgentHeap, settings: Settings, lessons: &[(&str, usize)]) -> LanguageModel<AgentHeap> {
    let mut model = LanguageModel::new(memory, settings).unwrap();
    for &(command, meant) in lessons {
        let words = model.lend().hear(command).unwrap();
        let tasks = tasks(&mut model);
        model.lend().add_session(&words, [(&tasks[meant][..], 1.0)].into_iter()).unwrap();
        model.lend().add_possible(tasks.iter().map(|task| (&task[..], 0.25))).unwrap();
    }
    model
}

fn train(model: &mut LanguageModel<AgentHeap>, budget: u32) {
    model.lend().begin_training();
    while model.lend().train(budget) == Progress::Working {}
}

fn taught(memory: AgentHeap, settings: Settings, lessons: &[(&str, usize)]) -> LanguageModel<AgentHeap> {
    let mut model = with_lessons(memory, settings, lessons);
    train(&mut model, u32::MAX);
    model
}

/// The probability of the room of each color.
fn posterior(model: &mut LanguageModel<AgentHeap>, command: &str) -> Vec<f32> {
    let (words, tasks) = (model.lend().hear(command).unwrap(), tasks(model));
    let mut scores: Vec<Scaled> = tasks.iter().map(|task| model.read().likelihood(&words, task).scaled_by(0.25)).collect();
    model.read().weigh_kinds(&words, |_| tasks[0][0], |_| 0.25, &mut scores);
    model.read().weigh_parts(&words, |task| task, |task| &tasks[task], &mut scores);
    model.lend().forget_unlearned();
    let whole = total(scores.iter().copied());
    scores.into_iter().map(|score| score.over(whole)).collect()
}

fn bits(model: &mut LanguageModel<AgentHeap>) -> Vec<u32> {
    let commands = ["skip the yellow room enter the red room", "enter the green room", "room", "never heard of it"];
    commands.iter().flat_map(|command| posterior(model, command)).map(f32::to_bits).collect()
}

#[test]
fn what_stands_around_one_color_is_known_of_another() {
    let believed = |settings| posterior(&mut taught(memory(), settings, &LESSONS), "skip the yellow room enter the red room")[0];
    let (alone, layered) = (believed(Settings::DEFAULT), believed(Settings::LAYERED));
    assert!(layered > alone + 0.02, "{layered} {alone}");
}

/// Two commands of the same words that mean different rooms, told in turn.
fn by_order(lessons: usize) -> Vec<(&'static str, usize)> {
    [("left and then right", 0), ("right and then left", 1)].into_iter().cycle().take(lessons).collect()
}

fn roomy() -> AgentHeap {
    let capacities = Capacities { sessions: 80, pairs: 320, ..capacities() };
    above(AgentHeap::new(&capacities), capacities.pairs)
}

#[test]
fn the_layer_is_silent_before_eight_lessons() {
    for lessons in 0..=LESSONS.len() {
        let believed = |settings| bits(&mut taught(memory(), settings, &LESSONS[..lessons]));
        assert_eq!(believed(Settings::LAYERED) == believed(Settings::DEFAULT), lessons < 8, "{lessons}");
    }
}

/// The probability of all tasks of taking something, after lessons of going alone. In the lessons, these tasks were possible too, or there
/// was nothing to take.
fn believed_of_a_new_kind(settings: Settings, was_possible: bool, command: &str) -> f32 {
    let mut model = LanguageModel::new(memory(), settings).unwrap();
    let both = |model: &mut LanguageModel<AgentHeap>| {
        let take = model.lend().tokens_mut().intern("blockInRoom").unwrap();
        let goes = tasks(model);
        goes.iter().copied().chain(goes.iter().map(|&[_, goal, color]| [take, goal, color])).collect::<Vec<_>>()
    };
    for (position, color) in ["red", "green", "blue", "yellow"].into_iter().cycle().take(8).enumerate() {
        let words = model.lend().hear(&format!("go to the {color} room")).unwrap();
        let tasks = both(&mut model);
        let here = if was_possible { &tasks[..] } else { &tasks[..4] };
        model.lend().add_session(&words, [(&tasks[position % 4][..], 1.0)].into_iter()).unwrap();
        model.lend().add_possible(here.iter().map(|task| (&task[..], 1.0 / here.len() as f32))).unwrap();
    }
    train(&mut model, u32::MAX);
    let words = model.lend().hear(command).unwrap();
    let tasks = both(&mut model);
    let mut scores: Vec<Scaled> = tasks.iter().map(|task| model.read().likelihood(&words, task).scaled_by(0.125)).collect();
    model.read().weigh_kinds(&words, |task| tasks[task][0], |_| 0.125, &mut scores);
    model.read().weigh_parts(&words, |task| task, |task| &tasks[task], &mut scores);
    total(scores[4..].iter().copied()).over(total(scores.iter().copied()))
}

#[test]
fn a_kind_of_task_that_was_never_meant_is_as_probable_as_without_the_layer() {
    for command in ["take the chair to the yellow room", "go to the red room"] {
        let [layered, alone] = [Settings::LAYERED, Settings::DEFAULT].map(|settings| believed_of_a_new_kind(settings, true, command));
        assert!((layered - alone).abs() < 1e-4, "{command}: {layered} {alone}");
    }
}

#[test]
fn a_kind_of_task_that_no_lesson_could_mean_is_meant_by_new_words() {
    let believed = |command| believed_of_a_new_kind(Settings::LAYERED, false, command);
    let [taken, gone] = ["take the chair to the yellow room", "go to the yellow room"].map(believed);
    assert!(taken > 0.8 && gone < 0.2, "{taken} {gone}");
}

/// The tasks to go to the room of each of these colors, and to do so avoiding another of these rooms.
fn tasks_that_avoid(model: &mut LanguageModel<AgentHeap>, colors: &[&str]) -> Vec<Vec<Symbol>> {
    let role = |kind| Marker { role: Role::of_argument(kind, AGENT_IN_ROOM, 1), sort: 0 }.symbol();
    let forms = ["agentInRoom", "agentInRoom01!agentInRoom02"].map(|form| model.lend().tokens_mut().intern(form).unwrap());
    let colors: Vec<Symbol> = colors.iter().map(|color| model.lend().tokens_mut().intern(color).unwrap()).collect();
    let goes = colors.iter().map(|&goal| vec![forms[0], role(RoleKind::Goal), goal]);
    let pairs = colors.iter().flat_map(|&goal| colors.iter().filter(move |&&other| other != goal).map(move |&other| (goal, other)));
    goes.chain(pairs.map(|(goal, other)| vec![forms[1], role(RoleKind::Goal), goal, role(RoleKind::Avoiding), other])).collect()
}

/// The probability that a command has no way, in a home with rooms of these colors, after lessons that all named a room to avoid.
fn believed_to_say_no_way(settings: Settings, colors: &[&str], command: &str) -> f32 {
    let mut model = LanguageModel::new(memory(), settings).unwrap();
    let names = ["red", "green", "blue"];
    for (goal, other) in [(0, 1), (1, 2), (2, 0), (1, 0), (0, 2), (2, 1)].into_iter().cycle().take(18) {
        let words = model.lend().hear(&format!("go to the {} room but avoid the {} room", names[goal], names[other])).unwrap();
        let tasks = tasks_that_avoid(&mut model, &COLORS[..3]);
        let meant = tasks.iter().position(|task| task.len() == 5 && task[2] == tasks[goal][2] && task[4] == tasks[other][2]).unwrap();
        model.lend().add_session(&words, [(&tasks[meant][..], 1.0)].into_iter()).unwrap();
        model.lend().add_possible(tasks.iter().map(|task| (&task[..], 1.0 / 9.0))).unwrap();
    }
    train(&mut model, u32::MAX);
    let words = model.lend().hear(command).unwrap();
    let tasks = tasks_that_avoid(&mut model, colors);
    let prior = 1.0 / tasks.len() as f32;
    let mut scores: Vec<Scaled> = tasks.iter().map(|task| model.read().likelihood(&words, task).scaled_by(prior)).collect();
    model.read().weigh_kinds(&words, |task| tasks[task][0], |_| prior, &mut scores);
    model.read().weigh_parts(&words, |task| task, |task| &tasks[task], &mut scores);
    total(scores[..colors.len()].iter().copied()).over(total(scores.iter().copied()))
}

#[test]
fn a_command_that_names_no_way_means_none_in_a_home_where_none_was_heard() {
    let elsewhere = ["colorRed", "colorGreen", "colorYellow"];
    let [layered, alone] =
        [Settings::LAYERED, Settings::DEFAULT].map(|settings| believed_to_say_no_way(settings, &elsewhere, "go to the red room"));
    assert!(layered > 0.5 && alone < 0.5, "{layered} {alone}");
    let with_a_way = believed_to_say_no_way(Settings::LAYERED, &elsewhere, "go to the red room but avoid the green room");
    assert!(with_a_way < 0.5, "{with_a_way}");
}

#[test]
fn where_all_lessons_told_a_way_the_role_model_says_whether_the_next_does() {
    let [layered, alone] =
        [Settings::LAYERED, Settings::DEFAULT].map(|settings| believed_to_say_no_way(settings, &COLORS[..3], "go to the red room"));
    assert!((layered - alone).abs() < 1e-4, "{layered} {alone}");
}

#[test]
fn memory_without_room_for_the_layer_is_that_of_the_role_model() {
    let alone = bits(&mut taught(memory(), Settings::DEFAULT, &LESSONS));
    let without = bits(&mut taught(AgentHeap::new(&capacities()), Settings::LAYERED, &LESSONS));
    assert_eq!(without, alone);
    assert_ne!(bits(&mut taught(memory(), Settings::LAYERED, &LESSONS)), alone);
}

#[test]
fn training_the_layer_in_parts_gives_the_bits_of_training_it_at_once() {
    let at_once = bits(&mut taught(memory(), Settings::LAYERED, &LESSONS));
    for budget in [1, 37, 1_000] {
        let mut model = with_lessons(memory(), Settings::LAYERED, &LESSONS);
        train(&mut model, budget);
        assert_eq!(bits(&mut model), at_once, "{budget}");
    }
    let often = by_order(64);
    let mut model = with_lessons(roomy(), Settings::LAYERED, &often);
    train(&mut model, 37);
    assert_eq!(bits(&mut model), bits(&mut taught(roomy(), Settings::LAYERED, &often)));
}

#[test]
fn memory_that_another_model_had_is_as_good_as_new() {
    let fresh = bits(&mut taught(memory(), Settings::LAYERED, &LESSONS[2..]));
    let used = taught(memory(), Settings::LAYERED, &LESSONS).into_memory();
    assert_eq!(bits(&mut taught(used, Settings::LAYERED, &LESSONS[2..])), fresh);
}

#[test]
fn a_layer_that_is_full_says_so_and_learns_from_the_sessions_before() {
    let room = above(AgentHeap::new(&Capacities { pairs: 32, ..capacities() }), 32);
    let mut model = with_lessons(room, Settings::LAYERED, &LESSONS[..8]);
    let words = model.lend().hear(LESSONS[8].0).unwrap();
    let tasks = tasks(&mut model);
    model.lend().add_session(&words, [(&tasks[LESSONS[8].1][..], 1.0)].into_iter()).unwrap();
    let full = model.lend().add_possible(tasks.iter().map(|task| (&task[..], 0.25)));
    assert_eq!(full, Err(CapacityError::full(Capacity::Pairs, 32)));
    train(&mut model, u32::MAX);
    assert_eq!(model.read().bitext().sessions(), 9);
    assert_ne!(bits(&mut model), bits(&mut taught(memory(), Settings::DEFAULT, &LESSONS[..9])));
}

#[test]
fn no_session_makes_a_belief_that_is_no_number() {
    let long = "red ".repeat(capacity::WORDS_PER_COMMAND);
    for priors in [[f32::NAN, f32::INFINITY, -1.0, 0.0], [0.0; 4], [1e6; 4]] {
        let mut model = with_lessons(memory(), Settings::LAYERED, &LESSONS);
        for weight in [0.0, 1e6] {
            let (words, tasks) = (model.lend().hear(&long).unwrap(), tasks(&mut model));
            model.lend().add_session(&words, [(&tasks[0][..], weight)].into_iter()).unwrap();
            model.lend().add_possible(tasks.iter().zip(priors).map(|(task, prior)| (&task[..], prior))).unwrap();
        }
        train(&mut model, u32::MAX);
        for command in [&long, "enter the red room"] {
            let posterior = posterior(&mut model, command);
            assert!(posterior.iter().all(|share| (0.0..=1.0).contains(share)), "{posterior:?}");
            assert!((posterior.iter().sum::<f32>() - 1.0).abs() < 1e-5, "{posterior:?}");
        }
    }
}

mod saved {
    use super::{LESSONS, bits, capacities, memory, taught, train, with_lessons};
    use goodbot::language::{LanguageModel, Settings};
    use goodbot::memory::AgentHeap;
    use goodbot::planning::Progress;
    use goodbot::snapshot::{Contents, LAYERED_VERSION, Part, RestoreError, VERSION};

    fn go_on(model: &mut LanguageModel<AgentHeap>) {
        while model.lend().train(u32::MAX) == Progress::Working {}
    }

    #[test]
    fn a_restored_layered_model_believes_the_same_to_the_bit() {
        let mut model = taught(memory(), Settings::LAYERED, &LESSONS);
        let file = model.saved().unwrap();
        let mut restored = LanguageModel::new(memory(), Settings::DEFAULT).unwrap();
        restored.restore(&file).unwrap();
        go_on(&mut restored);
        assert_eq!(bits(&mut restored), bits(&mut model));
        assert_eq!(restored.saved().unwrap(), file);
    }

    #[test]
    fn tasks_that_were_never_meant_may_speak_of_things_that_no_other_does() {
        let mut model = with_lessons(memory(), Settings::LAYERED, &LESSONS);
        let words = model.lend().hear("enter the red room").unwrap();
        let meant = super::tasks(&mut model)[0];
        model.lend().add_session(&words, [(&meant[..], 1.0)].into_iter()).unwrap();
        let pink = [meant[0], meant[1], model.lend().tokens_mut().intern("colorPink").unwrap()];
        model.lend().add_possible([meant, pink].iter().map(|task| (&task[..], 0.5))).unwrap();
        train(&mut model, u32::MAX);
        let file = model.saved().unwrap();
        assert!(Contents::read(&file).unwrap().tokens.iter().any(|token| token == "colorPink"));
        let mut restored = LanguageModel::new(memory(), Settings::DEFAULT).unwrap();
        restored.restore(&file).unwrap();
        go_on(&mut restored);
        assert_eq!(bits(&mut restored), bits(&mut model));
    }

    #[test]
    fn memory_without_the_layer_makes_a_layered_model_a_role_model() {
        let file = taught(memory(), Settings::LAYERED, &LESSONS).saved().unwrap();
        let mut restored = LanguageModel::new(AgentHeap::new(&capacities()), Settings::LAYERED).unwrap();
        restored.restore(&file).unwrap();
        go_on(&mut restored);
        assert_eq!(bits(&mut restored), bits(&mut taught(memory(), Settings::DEFAULT, &LESSONS)));
        let saved = restored.saved().unwrap();
        assert_eq!((version(&file), version(&saved)), (LAYERED_VERSION, VERSION));
        assert!(!restored.read().settings().layer && !Contents::read(&saved).unwrap().options.language.layer);
    }

    #[test]
    fn a_role_model_stays_one_in_memory_with_the_layer() {
        let file = taught(memory(), Settings::DEFAULT, &LESSONS).saved().unwrap();
        let mut restored = LanguageModel::new(memory(), Settings::LAYERED).unwrap();
        restored.restore(&file).unwrap();
        go_on(&mut restored);
        assert_eq!(bits(&mut restored), bits(&mut taught(memory(), Settings::DEFAULT, &LESSONS)));
        assert_eq!(restored.saved().unwrap(), file);
    }

    fn version(file: &[u8]) -> u16 {
        u16::from_le_bytes([file[8], file[9]])
    }

    /// The same file with another end before its checksum.
    fn with_end(file: &[u8], cut: usize, more: &[u8]) -> Vec<u8> {
        let mut file = [&file[..file.len() - 4 - cut], more].concat();
        let length = file.len() as u32 + 4;
        file[10..14].copy_from_slice(&length.to_le_bytes());
        let check = !file.iter().fold(u32::MAX, |crc, &byte| {
            (0..8).fold(crc ^ u32::from(byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 })
        });
        file.extend(check.to_le_bytes());
        file
    }

    #[test]
    fn a_layered_model_without_all_of_its_tasks_or_with_more_is_refused_by_their_name() {
        let file = taught(memory(), Settings::LAYERED, &LESSONS[..3]).saved().unwrap();
        assert!(Contents::read(&with_end(&file, 0, &[])).is_ok());
        let tail = file.len() - role_model(&file).len();
        for changed in
            (1..=tail).map(|cut| with_end(&file, cut, &[])).chain([with_end(&file, 0, &[0]), with_end(&file, 5, &[9, 9, 9, 9, 9])])
        {
            let refused = Contents::read(&changed).unwrap_err();
            assert_eq!(refused, RestoreError::Inconsistent(Part::Possible));
            assert!(refused.to_string().contains("possible tasks"), "{refused}");
        }
        let longer = with_end(&role_model(&file), 0, &[0]);
        assert_eq!(Contents::read(&longer).unwrap_err(), RestoreError::Inconsistent(Part::Rests));
    }

    /// A layered file without its layer: a file of the role model.
    fn role_model(file: &[u8]) -> Vec<u8> {
        let mut model = LanguageModel::new(AgentHeap::new(&capacities()), Settings::DEFAULT).unwrap();
        model.restore(file).unwrap();
        model.saved().unwrap()
    }

    #[test]
    fn sessions_that_join_bring_their_tasks() {
        let file = taught(memory(), Settings::LAYERED, &LESSONS[4..]).saved().unwrap();
        let mut joined = with_lessons(memory(), Settings::LAYERED, &LESSONS[..4]);
        train(&mut joined, u32::MAX);
        assert_eq!(joined.join(&file), Ok(6));
        go_on(&mut joined);
        assert_eq!(bits(&mut joined), bits(&mut taught(memory(), Settings::LAYERED, &LESSONS)));
    }

    #[test]
    fn a_model_without_the_layer_has_the_format_that_it_had_before_there_was_one() {
        let version = |settings| version(&taught(memory(), settings, &LESSONS).saved().unwrap());
        assert_eq!((version(Settings::DEFAULT), version(Settings::LAYERED)), (2, 3));
    }

    #[test]
    fn memory_with_less_room_for_the_layer_refuses_the_model() {
        let file = taught(memory(), Settings::LAYERED, &LESSONS).saved().unwrap();
        let small = goodbot_layer::above(AgentHeap::new(&goodbot::Capacities { pairs: 20, ..capacities() }), 20);
        let refused = LanguageModel::new(small, Settings::LAYERED).unwrap().restore(&file).unwrap_err();
        assert!(matches!(refused, RestoreError::Capacity(full) if full.given == 40), "{refused}");
    }

    #[test]
    fn a_damaged_layer_is_never_restored_as_another() {
        let file = taught(memory(), Settings::LAYERED, &LESSONS[..3]).saved().unwrap();
        for length in 0..file.len() {
            assert!(Contents::read(&file[..length]).is_err());
        }
    }
}

/// The tasks of a world without a robot: the lamp of each color on, and off.
fn lamps(model: &mut LanguageModel<AgentHeap>) -> Vec<[Symbol; 5]> {
    let names = ["lampOn", "lampOff"].into_iter().zip(["on", "off"]).enumerate();
    let mut tasks = Vec::new();
    for (proposition, (form, name)) in names {
        let proposition = PropositionId::new(proposition as u8);
        let mut token = |text: &str| model.lend().tokens_mut().intern(text).unwrap();
        let marker = |role| Marker { role, sort: 0 }.symbol();
        let (of_name, goal) = (marker(Role::of_name(proposition)), marker(Role::of_argument(RoleKind::Goal, proposition, 0)));
        let (form, name) = (token(form), token(name));
        tasks.extend(COLORS.map(|color| [form, of_name, name, goal, token(color)]));
    }
    tasks
}

#[test]
fn in_a_world_without_a_robot_a_task_that_lessons_meant_with_all_these_words_is_surer_than_a_new_combination() {
    let mut model = LanguageModel::new(memory(), Settings::LAYERED).unwrap();
    let lessons = [
        ("switch on red", 0),
        ("red on please", 0),
        ("switch on green", 1),
        ("green on please", 1),
        ("switch off blue", 6),
        ("blue off please", 6),
        ("switch off yellow", 7),
        ("yellow off please", 7),
        ("switch off red", 4),
        ("switch on blue", 2),
    ];
    for (command, meant) in lessons {
        let (words, tasks) = (model.lend().hear(command).unwrap(), lamps(&mut model));
        model.lend().add_session(&words, [(&tasks[meant][..], 1.0)].into_iter()).unwrap();
        model.lend().add_possible(tasks.iter().map(|task| (&task[..], 0.125))).unwrap();
    }
    train(&mut model, u32::MAX);
    let mut posterior = |command: &str, meant: usize| {
        let (words, tasks) = (model.lend().hear(command).unwrap(), lamps(&mut model));
        let mut scores: Vec<Scaled> = tasks.iter().map(|task| model.read().likelihood(&words, task).scaled_by(0.125)).collect();
        model.read().weigh_kinds(&words, |task| tasks[task][0], |_| 0.125, &mut scores);
        model.read().weigh_parts(&words, |task| task, |task| &tasks[task], &mut scores);
        model.lend().forget_unlearned();
        scores[meant].over(total(scores.iter().copied()))
    };
    // Lessons meant both with some of the words, but only the first with all of them.
    let (familiar, new) = (posterior("switch on green please", 1), posterior("switch off green please", 5));
    assert!(new > 0.9 && 100.0 * (1.0 - familiar) < 1.0 - new, "{familiar} {new}");
}
