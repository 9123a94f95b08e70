//! The meanings of the words of a command.

use crate::beliefs::Writer;
use crate::robot::{Goodbot, Robot, give, with};
use crate::status::GoodbotStatus;
use crate::world::{World, in_world};
use core::ffi::c_char;
use goodbot::language::Meaning;
use goodbot::oomdp::{Domain, Schema};
use goodbot::task::{Role, RoleKind};

/// Explains a word of the last command, if this task is meant. `position` counts the words from 0; `rank` 0 is the word's most probable
/// meaning, 1 the next, and so on. `UNKNOWN` beyond the last word or the last meaning, or for no task. `word` receives the word, empty if
/// the robot has no room for it. `meaning` receives the role and the value, such as `goal of agentInRoom: colorGreen`, or `kind of task`,
/// `no meaning`, or `never heard`, which is then the only meaning. `share` receives the share of the meaning: the shares of one word add
/// up to 1; a word that was never heard has 0. Each text has a 0 at its end; `BUFFER` if one does not fit. Each call explains the command
/// anew, once for each rank up to this one.
///
/// # Safety
/// `robot` is null or a handle; `word` and `meaning` are null or room for that many bytes; `share` is null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_explain_word(
    robot: *mut Goodbot,
    task: u32,
    position: u32,
    rank: u32,
    word: *mut c_char,
    word_bytes: usize,
    meaning: *mut c_char,
    meaning_bytes: usize,
    share: *mut f32,
) -> GoodbotStatus {
    // SAFETY: the caller's promise, for each of them.
    unsafe {
        with(robot, |robot| {
            let Robot { agent, world, .. } = robot;
            let (task, position) = (task as usize, position as usize);
            agent.tasks().get(task).ok_or(GoodbotStatus::Unknown)?;
            let symbol = *agent.sentence().get(position).ok_or(GoodbotStatus::Unknown)?;
            let known = symbol.is_some_and(|symbol| symbol.index() < agent.language().tables().words());
            if !known && rank > 0 {
                return Err(GoodbotStatus::Unknown.into());
            }
            // The meaning of the previous rank, its share, and its place in the order of telling, which decides between equal shares.
            let mut found: Option<(Meaning, f32, usize)> = None;
            let schema = in_world!(world, |domain, _state| {
                for _ in 0..=rank {
                    let (last, mut place) = (found.take(), 0_usize);
                    agent.explain(domain, task, |at, meaning, share| {
                        place = place.saturating_add(1);
                        let after = last.is_none_or(|(_, most, before)| share < most || (share == most && place > before));
                        if at == position && share > 0.0 && after && found.is_none_or(|(_, most, _)| share > most) {
                            found = Some((meaning, share, place));
                        }
                    })?;
                    if known && found.is_none() {
                        return Err(GoodbotStatus::Unknown.into());
                    }
                }
                domain.world().schema
            });
            let found = found.filter(|_| known);
            let language = agent.language();
            let mut writer = Writer::new(word, word_bytes)?;
            writer.put(symbol.map_or("", |symbol| language.words().text(symbol)));
            writer.end()?;
            let mut writer = Writer::new(meaning, meaning_bytes)?;
            match found {
                None => writer.put("never heard"),
                Some((Meaning::Background, ..)) => writer.put("no meaning"),
                Some((Meaning::Task, ..)) => writer.put("kind of task"),
                Some((Meaning::Value(role, value), ..)) => {
                    put_role(&mut writer, &schema, role);
                    writer.put(": ");
                    writer.put(language.tokens().text(value));
                }
            }
            writer.end()?;
            give(share, found.map_or(0.0, |(_, share, _)| share))
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
