//! A program in C that does anything.

use super::super::{Bytes, sign};
use super::blocks::Block;
use super::calls::{in_parts, question, settings, words};
use super::description::Description;
use super::texts::Text;
use goodbot_capi::beliefs::{goodbot_most_likely, goodbot_task_count, goodbot_task_probability, goodbot_task_text};
use goodbot_capi::capacities::{GoodbotCapacities, goodbot_preset};
use goodbot_capi::home::*;
use goodbot_capi::memory::{goodbot_size, goodbot_table_size};
use goodbot_capi::model::{goodbot_restore, goodbot_save, goodbot_saved_size};
use goodbot_capi::robot::{Goodbot, goodbot_full, goodbot_seed};
use goodbot_capi::starter::goodbot_join_starter;
use goodbot_capi::status::{GoodbotStatus, goodbot_status_text};
use goodbot_capi::table::init::{goodbot_init_table, goodbot_table_set_state, goodbot_table_state};
use goodbot_capi::training::*;
use std::ffi::{CStr, c_char};
use std::ptr::{null, null_mut};

/// The most memory that is given to one robot.
const MOST_MEMORY: usize = 1 << 18;

/// A program and its data.
#[derive(Debug)]
pub struct Program {
    robot: *mut Goodbot,
    /// The last saved model.
    model: Vec<u8>,
    // The robot's memory goes before the description that it refers to.
    _memory: Option<Block>,
    description: Option<Description>,
    /// Memory that holds no robot.
    empty: Block,
}

impl Program {
    /// A program that already has a robot in a home, so that even short inputs lead somewhere.
    pub fn new() -> Self {
        let mut program = Self { robot: null_mut(), model: Vec::new(), _memory: None, description: None, empty: Block::new(65_536, 0, 0) };
        program.init(&mut Bytes::new(&[]), false);
        assert!(!program.robot.is_null(), "a preset's robot fits the memory that it asks for");
        program.whole_home(&mut Bytes::new(&[]));
        program
    }

    /// Makes one call, or a few that belong together.
    pub fn call(&mut self, choices: &mut Bytes<'_>) {
        let kind = choices.below(36);
        let robot = self.handle(choices);
        // SAFETY: the handle is null, a robot, or memory without one; each other pointer is null or to memory of the size that is said.
        unsafe {
            match kind {
                0 => self.init(choices, false),
                1 => self.init(choices, true),
                2 => drop(goodbot_home_begin(robot)),
                3..=6 => part_of_a_home(robot, choices),
                7 => drop(goodbot_home_build(robot)),
                8 => self.whole_home(choices),
                9 => place(robot, choices),
                10 | 11 => {
                    let command = Text::any(choices);
                    goodbot_hear(robot, command.pointer());
                }
                12 | 13 => drop(goodbot_plan(robot, u32::from(choices.byte()) * 8)),
                14 => plan_fully(robot),
                15 | 16 => decide(robot, choices, self.keeps_its_word()),
                17 | 18 => {
                    let feedback = choices.one_of(&[GOODBOT_REWARD, GOODBOT_PUNISH, GOODBOT_NEUTRAL, 2, i32::MIN]);
                    let mut evidence = GOODBOT_EVIDENCE_IMPOSSIBLE + 1;
                    if goodbot_feedback(robot, feedback, &raw mut evidence) == GoodbotStatus::Ok {
                        assert!(evidence <= GOODBOT_EVIDENCE_IMPOSSIBLE);
                    }
                }
                19 => {
                    let mut evidence = 0;
                    goodbot_demonstration(robot, action(choices), &raw mut evidence);
                }
                20 => drop(goodbot_acted(robot, action(choices))),
                21 => drop(goodbot_finish(robot, null_mut())),
                22 => drop(goodbot_learn(robot, u32::from(choices.byte()) * 64)),
                23 => while goodbot_learn(robot, 100_000) == GoodbotStatus::Working {},
                24 => session(robot, choices, self.keeps_its_word()),
                25 => drop(goodbot_forget(robot)),
                26 => {
                    let value = |choices: &mut Bytes<'_>| choices.one_of(&[0.0, 0.05, 0.1, 0.7, 0.85, 1.0, -0.1, f32::NAN, f32::INFINITY]);
                    goodbot_trainer(robot, value(choices), value(choices), value(choices));
                }
                27 => drop(goodbot_table_set_state(robot, u32::from(choices.byte()))),
                28 => self.save(robot, choices),
                29 => self.restore(robot, choices),
                30 => ask(robot, choices),
                31 => in_parts(robot, choices),
                32 => question(robot, choices),
                33 => words(robot, choices),
                34 => settings(robot, choices),
                _ => self.anything_else(robot, choices),
            }
        }
    }

    /// Whether the robot's steps are the same each time.
    fn keeps_its_word(&self) -> bool {
        self.description.as_ref().is_none_or(Description::keeps_its_word)
    }

    /// The robot; now and then null, memory without a robot, or an address inside of the robot.
    fn handle(&self, choices: &mut Bytes<'_>) -> *mut Goodbot {
        match choices.below(32) {
            29 => null_mut(),
            30 => self.empty.start().cast(),
            31 => self.robot.cast::<u8>().wrapping_add(1).cast(),
            _ => self.robot,
        }
    }

    /// Makes a new robot, in memory that may be too small or misaligned. The old one stays if the new one cannot be made.
    fn init(&mut self, choices: &mut Bytes<'_>, table: bool) {
        let Some(capacities) = capacities(choices) else { return };
        let description = table.then(|| Description::new(choices));
        // SAFETY: the capacities are there.
        let needed = unsafe { if table { goodbot_table_size(&capacities) } else { goodbot_size(&capacities) } };
        let given = match choices.below(8) {
            7 => needed.saturating_sub(1 + usize::from(choices.byte())),
            6 => usize::from(choices.byte()),
            _ => needed,
        };
        let offset = if choices.below(16) == 15 { 1 + choices.below(7) } else { 0 };
        let memory = Block::new(given.min(MOST_MEMORY), offset, choices.byte());
        let at = if choices.below(32) == 31 { null_mut() } else { memory.start().cast() };
        let (mut robot, bytes) = (null_mut(), memory.bytes());
        let to = if choices.below(32) == 31 { null_mut() } else { &raw mut robot };
        // SAFETY: the memory is new, and the description is kept as long as the robot.
        let status = unsafe {
            match &description {
                Some(description) => goodbot_init_table(at, bytes, &capacities, description.table(), to),
                None => goodbot_init_home(at, bytes, &capacities, to),
            }
        };
        assert!(status != GoodbotStatus::Memory || bytes < needed, "as much memory as was asked for is enough");
        assert_eq!(status == GoodbotStatus::Ok, !robot.is_null(), "a handle comes with success alone");
        if offset > 0 {
            assert_ne!(status, GoodbotStatus::Ok, "misaligned memory is refused");
        }
        if status == GoodbotStatus::Ok {
            (self.robot, self._memory, self.description) = (robot, Some(memory), description);
        }
    }

    /// A home that is right, of two rooms with a block, or one of a few others.
    fn whole_home(&mut self, choices: &mut Bytes<'_>) {
        let (robot, colors) = (self.robot, choices.one_of(&[[c"red", c"green"], [c"blue", c"red"]]));
        // SAFETY: the robot and the texts are there.
        unsafe {
            goodbot_home_begin(robot);
            goodbot_home_room(robot, c"room0".as_ptr(), 0, 0, 4, 4, colors[0].as_ptr());
            goodbot_home_room(robot, c"room1".as_ptr(), 0, 4, 4, 8, colors[1].as_ptr());
            goodbot_home_door(robot, c"door0".as_ptr(), 2, 4, 2, 4);
            if choices.below(2) == 0 {
                goodbot_home_block(robot, c"block0".as_ptr(), 2, 2, c"red".as_ptr(), c"chair".as_ptr());
            }
            goodbot_home_agent(robot, c"agent0".as_ptr(), 1, 1 + choices.below(3) as i32);
            goodbot_home_build(robot);
        }
    }

    /// Saves, into a buffer that may be too small or absent.
    unsafe fn save(&mut self, robot: *mut Goodbot, choices: &mut Bytes<'_>) {
        let mut needed = usize::MAX;
        // SAFETY: the caller's promise.
        if unsafe { goodbot_saved_size(robot, &raw mut needed) } != GoodbotStatus::Ok {
            return;
        }
        let buffer = Block::new(needed.saturating_sub(choices.one_of(&[0, 0, 0, 1, 20, usize::MAX])), 0, 0xaa);
        let at = if choices.below(16) == 15 { null_mut() } else { buffer.start() };
        let mut written = 0;
        // SAFETY: the buffer is as large as is said.
        let status = unsafe { goodbot_save(robot, at, buffer.bytes(), &raw mut written) };
        assert_eq!(status == GoodbotStatus::Ok, !at.is_null() && buffer.bytes() >= needed, "{status:?}");
        if status == GoodbotStatus::Ok {
            assert_eq!(written, needed);
            self.model = buffer.contents()[..written].to_vec();
        }
    }

    /// Restores the saved model, whole or damaged; a refused model changes nothing.
    unsafe fn restore(&mut self, robot: *mut Goodbot, choices: &mut Bytes<'_>) {
        let mut model = self.model.clone();
        let damage = choices.below(6);
        match damage {
            0 | 1 => {}
            2 => model.truncate(usize::from(choices.byte())),
            _ if model.is_empty() => {}
            _ => {
                let at = (usize::from(choices.byte()) * 256 + usize::from(choices.byte())) % model.len();
                model[at] ^= 1 << choices.below(8);
            }
        }
        if damage > 3 {
            sign(&mut model);
        }
        let before = saved(robot);
        let copy = Block::new(model.len(), 0, 0);
        // SAFETY: the copy is as large as the model.
        unsafe { copy.start().copy_from_nonoverlapping(model.as_ptr(), model.len()) };
        // SAFETY: the caller's promise.
        let status = unsafe { goodbot_restore(robot, copy.start(), model.len()) };
        assert!(status != GoodbotStatus::Ok || damage != 3 || model.is_empty(), "a damaged model is refused");
        if status != GoodbotStatus::Ok {
            assert_eq!(saved(robot), before, "a refused model changes nothing");
        }
    }

    /// Rare calls, and null for needed pointers.
    unsafe fn anything_else(&mut self, robot: *mut Goodbot, choices: &mut Bytes<'_>) {
        let (mut x, mut y) = (0, 0);
        // SAFETY: the caller's promise; null is refused.
        unsafe {
            match choices.below(14) {
                0 => drop(goodbot_seed(robot, u64::from(choices.byte()))),
                1 => {
                    let text = goodbot_status_text(i32::from(choices.byte()) - 100);
                    assert!(!CStr::from_ptr(text).to_bytes().is_empty());
                }
                2 => assert_ne!(goodbot_hear(robot, null()), GoodbotStatus::Ok),
                3 => {
                    assert_ne!(goodbot_decide(robot, null_mut(), null_mut()), GoodbotStatus::Ok);
                    assert_ne!(goodbot_feedback(robot, GOODBOT_REWARD, null_mut()), GoodbotStatus::Ok);
                }
                4 => assert_ne!(goodbot_task_count(robot, null_mut()), GoodbotStatus::Ok),
                5 => assert_ne!(goodbot_most_likely(robot, null_mut()), GoodbotStatus::Ok),
                6 => assert_ne!(goodbot_saved_size(robot, null_mut()), GoodbotStatus::Ok),
                7 => assert_ne!(goodbot_restore(robot, null(), 0), GoodbotStatus::Ok),
                8 => drop(goodbot_table_state(robot, &raw mut x)),
                9 => {
                    let name = Text::any(choices);
                    let (mut x, y) = (0, &raw mut y);
                    goodbot_home_where(robot, name.pointer(), &raw mut x, if choices.below(4) == 0 { null_mut() } else { y.cast() });
                }
                10 => assert_ne!(goodbot_preset(choices.below(3) as u32, null_mut()), GoodbotStatus::Ok),
                11 => assert_eq!(goodbot_size(null()) + goodbot_table_size(null()), 0),
                12 => drop(goodbot_join_starter(robot, self.model.as_ptr(), self.model.len(), null_mut())),
                _ => drop(goodbot_join_starter(robot, null(), 0, null_mut())),
            }
        }
        let _ = y + x;
    }

    /// Asserts that every belief is a probability, and that there is none beyond the last task.
    pub fn assert_sound(&self) {
        let mut count = 0;
        // SAFETY: the robot is one, and the numbers are there.
        unsafe {
            assert_eq!(goodbot_task_count(self.robot, &raw mut count), GoodbotStatus::Ok);
            let mut sum = 0.0;
            for task in 0..count {
                let mut probability = f32::NAN;
                assert_eq!(goodbot_task_probability(self.robot, task, &raw mut probability), GoodbotStatus::Ok);
                assert!((0.0..=1.0).contains(&probability), "task {task} has {probability}");
                sum += probability;
            }
            assert!(sum < 1.001, "the posterior sums to {sum}");
            let mut beyond = 0.0;
            assert_eq!(goodbot_task_probability(self.robot, count, &raw mut beyond), GoodbotStatus::Unknown);
        }
    }
}

/// Capacities: a preset, with up to three fields changed.
fn capacities(choices: &mut Bytes<'_>) -> Option<GoodbotCapacities> {
    let mut words = [0_u32; size_of::<GoodbotCapacities>() / 4];
    let capacities = words.as_mut_ptr().cast::<GoodbotCapacities>();
    // SAFETY: the capacities are numbers of 32 bits, one after the other.
    let status = unsafe { goodbot_preset(choices.below(9) as u32 % 3, capacities) };
    if status != GoodbotStatus::Ok {
        return None;
    }
    for _ in 0..choices.below(4) {
        let field = choices.below(words.len());
        words[field] = match choices.below(6) {
            0 => 0,
            1 => words[field].saturating_sub(1),
            2 => words[field].saturating_add(1),
            3 => u32::MAX,
            4 => words[field].saturating_mul(4),
            _ => u32::from(choices.byte()),
        };
    }
    // SAFETY: as above.
    Some(unsafe { words.as_ptr().cast::<GoodbotCapacities>().read() })
}

/// The bytes that the robot would save.
fn saved(robot: *mut Goodbot) -> Option<Vec<u8>> {
    let mut needed = 0;
    // SAFETY: null or a handle, and a buffer as large as is said.
    unsafe {
        if goodbot_saved_size(robot, &raw mut needed) != GoodbotStatus::Ok {
            return None;
        }
        let mut bytes = vec![0; needed];
        let status = goodbot_save(robot, bytes.as_mut_ptr(), needed, &raw mut needed);
        (status == GoodbotStatus::Ok).then_some(bytes)
    }
}

fn action(choices: &mut Bytes<'_>) -> u8 {
    let any = choices.byte();
    choices.one_of(&[0, 1, 2, 3, GOODBOT_NOOP, any])
}

fn coordinate(choices: &mut Bytes<'_>) -> i32 {
    match choices.below(20) {
        0 => i32::MAX,
        1 => i32::MIN,
        2 => 70_000,
        3 => -1,
        small => small as i32 - 4,
    }
}

unsafe fn part_of_a_home(robot: *mut Goodbot, choices: &mut Bytes<'_>) {
    let (name, color, shape) = (Text::any(choices), Text::any(choices), Text::any(choices));
    let [left, bottom, right, top] = [(); 4].map(|()| coordinate(choices));
    // SAFETY: the caller's promise, and the texts are there.
    unsafe {
        match choices.below(4) {
            0 => goodbot_home_room(robot, name.pointer(), left, bottom, right, top, color.pointer()),
            1 => goodbot_home_door(robot, name.pointer(), left, bottom, right, top),
            2 => goodbot_home_block(robot, name.pointer(), left, bottom, color.pointer(), shape.pointer()),
            _ => goodbot_home_agent(robot, name.pointer(), left, bottom),
        };
    }
}

unsafe fn place(robot: *mut Goodbot, choices: &mut Bytes<'_>) {
    let name = Text::any(choices);
    let (x, y) = (coordinate(choices), coordinate(choices));
    // SAFETY: the caller's promise.
    if unsafe { goodbot_home_place(robot, name.pointer(), x, y) } == GoodbotStatus::Ok {
        let (mut there_x, mut there_y) = (0, 0);
        // SAFETY: as above.
        assert_eq!(unsafe { goodbot_home_where(robot, name.pointer(), &raw mut there_x, &raw mut there_y) }, GoodbotStatus::Ok);
        assert_eq!((there_x, there_y), (x, y));
    }
}

unsafe fn plan_fully(robot: *mut Goodbot) {
    let mut calls = 0;
    // SAFETY: the caller's promise.
    while unsafe { goodbot_plan(robot, 1_000) } == GoodbotStatus::Working {
        calls += 1;
        assert!(calls < 1_000, "a plan comes to its end");
    }
}

unsafe fn decide(robot: *mut Goodbot, choices: &mut Bytes<'_>, keeps_its_word: bool) {
    let (mut action, mut plan) = (0, 0);
    let wanted = if choices.below(2) == 0 { null_mut() } else { &raw mut plan };
    // SAFETY: the caller's promise.
    if unsafe { goodbot_decide(robot, &raw mut action, wanted) } == GoodbotStatus::Ok {
        assert!(plan <= GOODBOT_PLAN_APPROXIMATE && action <= GOODBOT_NOOP);
        // SAFETY: as above.
        let done = unsafe { goodbot_acted(robot, action) };
        // A machine that answers differently each time may first allow the action and then refuse it.
        let excused = !keeps_its_word && done == GoodbotStatus::NotApplicable;
        assert!(done == GoodbotStatus::Ok || excused, "an action that was decided on can be done, but gave {done:?}");
    }
}

/// A whole session: a command, a few steps, and learning.
unsafe fn session(robot: *mut Goodbot, choices: &mut Bytes<'_>, keeps_its_word: bool) {
    let command = Text::any(choices);
    // SAFETY: the caller's promise.
    unsafe {
        if goodbot_hear(robot, command.pointer()) != GoodbotStatus::Ok {
            return;
        }
        for _ in 0..choices.below(5) {
            plan_fully(robot);
            decide(robot, choices, keeps_its_word);
            let mut evidence = 0;
            goodbot_feedback(robot, choices.one_of(&[GOODBOT_REWARD, GOODBOT_PUNISH, GOODBOT_NEUTRAL]), &raw mut evidence);
        }
        goodbot_finish(robot, null_mut());
    }
}

/// Asks for texts, into buffers that may be too small or absent.
unsafe fn ask(robot: *mut Goodbot, choices: &mut Bytes<'_>) {
    let buffer = Block::new(choices.below(64), 0, 0xaa);
    let at: *mut c_char = if choices.below(16) == 15 { null_mut() } else { buffer.start().cast() };
    // Even an empty block has one byte.
    let bytes = buffer.bytes();
    let (mut limit, mut given, mut task) = (0, 0, u32::from(choices.byte()));
    // SAFETY: the caller's promise; the buffer is as large as is said.
    let status = unsafe {
        match choices.below(3) {
            0 => goodbot_full(robot, at, bytes, &raw mut limit, &raw mut given),
            1 => {
                goodbot_most_likely(robot, &raw mut task);
                goodbot_task_text(robot, task, at, bytes)
            }
            _ => goodbot_task_text(robot, task, at, bytes),
        }
    };
    if status == GoodbotStatus::Ok {
        let text = CStr::from_bytes_until_nul(buffer.contents()).expect("a text ends within its buffer");
        assert!(text.to_str().is_ok(), "a text is UTF-8");
    }
}
