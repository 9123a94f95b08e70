//! What the robot takes each word of a command for.

use crate::beliefs::Writer;
use crate::robot::{Goodbot, give, with};
use crate::status::GoodbotStatus;
use crate::training::in_world;
use crate::world::World;
use core::ffi::c_char;
use goodbot::language::Meaning;
use goodbot::oomdp::{Domain, Schema};
use goodbot::task::{Role, RoleKind};

/// What a word of the last command is taken for if this task is meant; `position` counts from 0, and `UNKNOWN` is beyond the last word, or no
/// task. `word` is given the word, empty where there was no room for it, and `meaning` the most probable of its meanings: the role and the
/// value, such as `goal of agentInRoom: colorGreen`, or `kind of task`, `no meaning`, or `never heard`. `share` is given how much of 1 that
/// meaning has. Each text has a 0 at its end; `BUFFER` where one does not fit.
///
/// # Safety
/// `robot` is null or a handle; `word` and `meaning` are null or room for so many bytes; `share` is null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_explain_word(
    robot: *mut Goodbot,
    task: u32,
    position: u32,
    word: *mut c_char,
    word_bytes: usize,
    meaning: *mut c_char,
    meaning_bytes: usize,
    share: *mut f32,
) -> GoodbotStatus {
    // SAFETY: the caller's promise, for each of them.
    unsafe {
        with(robot, |robot| {
            let Goodbot { agent, world, .. } = robot;
            let (task, position) = (task as usize, position as usize);
            agent.tasks().get(task).ok_or(GoodbotStatus::Unknown)?;
            let symbol = *agent.sentence().get(position).ok_or(GoodbotStatus::Unknown)?;
            let mut best: Option<(Meaning, f32)> = None;
            let mut tell = |at, meaning, share| {
                if at == position && best.is_none_or(|(_, most)| share > most) {
                    best = Some((meaning, share));
                }
            };
            let schema = in_world!(world, |domain, _state| {
                agent.explain(domain, task, &mut tell)?;
                domain.world().schema
            });
            let language = agent.language();
            let mut writer = Writer::new(word, word_bytes)?;
            writer.put(symbol.map_or("", |symbol| language.words().text(symbol)));
            writer.end()?;
            let known = symbol.is_some_and(|symbol| symbol.index() < language.tables().words());
            let best = best.filter(|_| known);
            let mut writer = Writer::new(meaning, meaning_bytes)?;
            match best {
                None => writer.put("never heard"),
                Some((Meaning::Background, _)) => writer.put("no meaning"),
                Some((Meaning::Task, _)) => writer.put("kind of task"),
                Some((Meaning::Value(role, value), _)) => {
                    put_role(&mut writer, &schema, role);
                    writer.put(": ");
                    writer.put(language.tokens().text(value));
                }
            }
            writer.end()?;
            give(share, best.map_or(0.0, |(_, share)| share))
        })
    }
}

/// Writes a role.
fn put_role(writer: &mut Writer, schema: &Schema<'_>, role: Role) {
    let before = match role.kind() {
        RoleKind::Goal => "goal of ",
        RoleKind::Subject => "subject of ",
        RoleKind::Start => "start of ",
        RoleKind::Through => "through ",
        RoleKind::Avoiding => "avoiding ",
        RoleKind::Before => "earlier goal ",
        RoleKind::OtherPlace | RoleKind::Other => "other ",
    };
    writer.put(before);
    writer.put(match role.kind() {
        RoleKind::OtherPlace | RoleKind::Other => schema.class_name(role.class()),
        _ => schema.proposition_name(role.proposition()),
    });
}
