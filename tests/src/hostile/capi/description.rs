//! A robot of the caller's own, described rightly or wrongly.

use super::super::Bytes;
use super::machine::{Machine, derived, holds, step};
use super::texts::Text;
use goodbot_capi::table::description::{
    GOODBOT_MOST_ACTIONS, GOODBOT_MOST_ATTRIBUTES, GOODBOT_MOST_CARRIERS, GOODBOT_MOST_CLASSES, GOODBOT_MOST_PROPOSITIONS, GoodbotAction,
    GoodbotAttribute, GoodbotCarrier, GoodbotObject, GoodbotProposition, GoodbotTable,
};
use goodbot_capi::tasks::GOODBOT_MOST_TASKS;
use std::ffi::c_char;

/// A description and all that it points to.
#[derive(Debug)]
pub struct Description {
    table: Box<GoodbotTable>,
    _texts: Vec<Text>,
    _lists: Lists,
    machine: Box<Machine>,
    _steps: Vec<u16>,
}

#[derive(Debug, Default)]
struct Lists {
    classes: Vec<*const c_char>,
    carriers: Vec<GoodbotCarrier>,
    attributes: Vec<GoodbotAttribute>,
    propositions: Vec<GoodbotProposition>,
    objects: Vec<GoodbotObject>,
    actions: Vec<GoodbotAction>,
    tasks: Vec<*const c_char>,
}

/// The texts of a right description, some of them changed by the choices.
struct Texts<'a, 'b> {
    kept: Vec<Text>,
    choices: &'a mut Bytes<'b>,
    hostile: bool,
}

impl Texts<'_, '_> {
    fn text(&mut self, right: &str) -> *const c_char {
        let wrong = self.hostile && self.choices.below(24) == 0;
        let text = if wrong { Text::any(self.choices) } else { Text::of(right) };
        let pointer = text.pointer();
        self.kept.push(text);
        pointer
    }

    fn number(&mut self, right: u32, wrong: &[u32]) -> u32 {
        if self.hostile && self.choices.below(24) == 0 { self.choices.one_of(wrong) } else { right }
    }

    /// The stated count of `there` items: never more than there are, except for numbers that must be refused.
    fn count(&mut self, there: usize, most: usize) -> u32 {
        let less = there.saturating_sub(1) as u32;
        self.number(there as u32, &[0, less, most as u32 + 1, u32::MAX])
    }
}

impl Description {
    /// A robot on a few floors, each with a use, which goes up and down; the choices make some fields wrong.
    pub fn new(choices: &mut Bytes<'_>) -> Self {
        let floors = 1 + choices.below(6);
        let states = [1, 4, 16, 60, 300][choices.below(5)];
        let moves = 1 + choices.below(4);
        let machine = Box::new(Machine::new(choices, states, moves));
        let by_table = choices.below(2) == 0;
        let hostile = choices.below(2) == 0;
        let mut texts = Texts { kept: Vec::new(), choices, hostile };
        let mut lists = Lists::default();
        lists.classes = ["robot", "floor"].map(|name| texts.text(name)).to_vec();
        lists.carriers = vec![GoodbotCarrier { object_class: texts.number(1, &[2, 255]) as u8, prefix: texts.text("floorIs") }];
        lists.attributes = vec![GoodbotAttribute {
            name: texts.text("use"),
            carrier_count: texts.count(1, GOODBOT_MOST_CARRIERS),
            carriers: lists.carriers.as_ptr(),
        }];
        lists.propositions = ["robotOnFloor", "near"]
            .map(|name| GoodbotProposition {
                name: texts.text(name),
                parameters: [texts.number(0, &[1, 9]) as u8, texts.number(1, &[0, 255]) as u8, 0],
                parameter_count: texts.number(2, &[0, 1, 3, 4, u32::MAX]),
            })
            .to_vec();
        let none = [std::ptr::null(); GOODBOT_MOST_ATTRIBUTES];
        lists.objects.push(GoodbotObject { object_class: texts.number(0, &[1, 2, 255]) as u8, name: texts.text("robot0"), values: none });
        for floor in 0..floors {
            let mut values = none;
            values[0] = texts.text(["garage", "shop", "office", "roof"][floor % 4]);
            lists.objects.push(GoodbotObject { object_class: 1, name: texts.text(&format!("floor{floor}")), values });
        }
        for action in 0..moves {
            let cost = texts.number(1, &[0, 2, 16, 17, u32::MAX]);
            lists.actions.push(GoodbotAction { name: texts.text(["up", "down", "jump", "wait"][action]), cost });
        }
        lists.tasks = ["robotOnFloor(?r, ?f)", "near(?r, ?f)"].map(|task| texts.text(task)).to_vec();
        let steps = if by_table { machine.table(states, moves) } else { Vec::new() };
        let table = Box::new(GoodbotTable {
            class_count: texts.count(lists.classes.len(), GOODBOT_MOST_CLASSES),
            classes: lists.classes.as_ptr(),
            attribute_count: texts.count(lists.attributes.len(), GOODBOT_MOST_ATTRIBUTES),
            attributes: lists.attributes.as_ptr(),
            proposition_count: texts.count(lists.propositions.len(), GOODBOT_MOST_PROPOSITIONS),
            propositions: lists.propositions.as_ptr(),
            object_count: texts.count(lists.objects.len(), usize::from(u8::MAX)),
            objects: if texts.number(0, &[1]) == 0 { lists.objects.as_ptr() } else { std::ptr::null() },
            // The table of steps has one row for each state: another number of actions, or more states, would promise missing entries.
            action_count: if by_table { moves as u32 } else { texts.count(moves, GOODBOT_MOST_ACTIONS) },
            actions: lists.actions.as_ptr(),
            task_count: texts.count(lists.tasks.len(), GOODBOT_MOST_TASKS),
            tasks: lists.tasks.as_ptr(),
            state_count: if by_table { texts.number(states, &[0, 1]) } else { texts.number(states, &[0, 1, 70_000, u32::MAX]) },
            start: texts.number(0, &[states - 1, states, u32::MAX]),
            next: if by_table { steps.as_ptr() } else { std::ptr::null() },
            step: (texts.number(0, &[1]) == 0).then_some(step as _),
            holds: (texts.number(0, &[1]) == 0).then_some(holds as _),
            derived: (texts.number(0, &[1]) == 1).then_some(derived as _),
            context: std::ptr::from_ref(&*machine).cast_mut().cast(),
            kinds: std::ptr::null(),
        });
        Self { table, _texts: texts.kept, _lists: lists, machine, _steps: steps }
    }

    /// Whether its functions return the same answer each time, as they must.
    pub fn keeps_its_word(&self) -> bool {
        !self.machine.is_moody()
    }

    /// As C sees it. All of it stays as long as this description.
    pub fn table(&self) -> &GoodbotTable {
        &self.table
    }
}
