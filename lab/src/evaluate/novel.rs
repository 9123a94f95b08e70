//! The same commands in new layouts: rooms exchange their places, and the agent and blocks are elsewhere.

use goodbot::Options;
use goodbot::task::LiftedTask;
use goodbot_console::training_data::evidence::Witness;
use goodbot_console::{Failure, Lesson};
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
use goodbot_formats::session::{Kind, RecordedSession, SessionHeader};
use rand_core::Rng;
use std::sync::Mutex;

/// How often a layout is drawn again if the intended task holds already, or objects cannot be placed.
const TRIES: usize = 200;

/// Other layouts to ask commands in.
pub struct Novel<'l> {
    lifted: &'l [LiftedTask],
    options: Options,
    count: usize,
    seed: u64,
    /// Witnesses for the layouts, one for each core: each has a memory of its own.
    witnesses: Mutex<Vec<Witness>>,
}

impl<'l> Novel<'l> {
    /// `count` layouts for each command.
    pub fn new(lifted: &'l [LiftedTask], options: Options, count: usize, seed: u64) -> Self {
        Self { lifted, options, count, seed, witnesses: Mutex::new(vec![]) }
    }

    /// Passes a lesson, the one at `position`, to `each` in one layout after another.
    ///
    /// # Errors
    /// The error of `each`, and a [`Failure`] if the home has no other layout.
    pub fn each_layout(
        &self,
        lesson: &Lesson,
        position: usize,
        each: &mut impl FnMut(&Lesson) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        if lesson.intended.is_none() {
            return Ok(());
        }
        let free = self.witnesses.lock().ok().and_then(|mut witnesses| witnesses.pop());
        let mut witness = match free {
            Some(witness) => witness,
            None => Witness::new(self.lifted, self.options, None)?,
        };
        let mut random = goodbot_course::generator(self.seed.wrapping_add(position as u64));
        let done = (0..self.count).try_for_each(|_| each(&elsewhere(&mut witness, lesson, &mut random)?));
        if let Ok(mut witnesses) = self.witnesses.lock() {
            witnesses.push(witness);
        }
        done
    }
}

fn elsewhere(witness: &mut Witness, lesson: &Lesson, random: &mut impl Rng) -> Result<Lesson, Failure> {
    for _ in 0..TRIES {
        let environment = rearranged(&lesson.header.environment, random);
        let known = environment == lesson.header.environment;
        let SessionHeader { id, command, intended, before, through, avoiding, actions, .. } = lesson.header.clone();
        let header = SessionHeader::new(Kind::Demonstration, environment, command);
        let header = SessionHeader { id, intended, before, through, avoiding, actions, ..header };
        let recorded = RecordedSession { header, header_line: 1, steps: vec![], answers: vec![], learn: false, end_line: 1 };
        // A layout that cannot be built, or in which the task holds already, is drawn again.
        if let Ok(lesson) = witness.lesson(&lesson.id, &recorded)
            && !known
        {
            return Ok(lesson);
        }
    }
    Err(Failure::Input(format!("{}: no other layout of this home was found in {TRIES} tries", lesson.id)))
}

fn rearranged(environment: &EnvironmentFile, random: &mut impl Rng) -> EnvironmentFile {
    let mut boxes: Vec<[i32; 4]> = environment.objects.iter().filter_map(room_box).collect();
    for last in (1..boxes.len()).rev() {
        boxes.swap(last, random.next_u32() as usize % (last + 1));
    }
    let places = boxes.clone();
    let mut boxes = boxes.into_iter();
    let mut draw = |from: i32, to: i32| from + 1 + (random.next_u32() % (to - from - 1).max(1) as u32) as i32;
    let mut cell = || {
        let [left, bottom, right, top] = places[draw(-1, places.len() as i32) as usize];
        (draw(left, right), draw(bottom, top))
    };
    let mut objects = environment.objects.clone();
    for object in &mut objects {
        match object {
            ObjectRecord::Room { left, bottom, right, top, .. } => {
                if let Some(place) = boxes.next() {
                    [*left, *bottom, *right, *top] = place;
                }
            }
            ObjectRecord::Agent { x, y, .. } | ObjectRecord::Block { x, y, .. } => (*x, *y) = cell(),
            ObjectRecord::Door { .. } => {}
        }
    }
    EnvironmentFile { objects, ..environment.clone() }
}

fn room_box(object: &ObjectRecord) -> Option<[i32; 4]> {
    match object {
        ObjectRecord::Room { left, bottom, right, top, .. } => Some([*left, *bottom, *right, *top]),
        _ => None,
    }
}
