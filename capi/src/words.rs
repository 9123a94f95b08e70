//! The meanings of the words of a command.

use crate::beliefs::Writer;
use crate::robot::{Goodbot, Robot, give, with};
use crate::status::GoodbotStatus;
use crate::world::{World, in_world};
use core::ffi::c_char;
use goodbot::language::Meaning;
use goodbot::oomdp::{Domain, Schema};
use goodbot::planning::Progress;
use goodbot::task::{Role, RoleKind};
use heapless::Vec;

/// Reads the last command for `goodbot_explain_word`, if this task is meant, at most about `budget` table cells of work. `WORKING` means: call
/// again; the robot may plan and act meanwhile. A command that was heard since, another task, and the end of the session begin it anew.
/// `UNKNOWN` for no task.
///
/// # Safety
/// `robot` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_explain_on(robot: *mut Goodbot, task: u32, budget: u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |Robot { agent, world, .. }| {
            agent.tasks().get(task as usize).ok_or(GoodbotStatus::Unknown)?;
            Ok(in_world!(world, |domain, _state| agent.explain_on(domain, task as usize, budget)?))
        })
    }
}

/// Most meanings of a word: the values of a description, no meaning, and the kind of task.
const MEANINGS: usize = 64;

/// Explains a word of the last command, if this task is meant. `position` counts the words from 0; `rank` 0 is the word's most probable
/// meaning, 1 the next, and so on. `UNKNOWN` beyond the last word or the last meaning, or for no task. `word` receives the word, empty if
/// the robot has no room for it. `meaning` receives the role and the value, such as `goal of agentInRoom: colorGreen`, or `kind of task`,
/// `no meaning`, or `never heard`, which is then the only meaning. `share` receives the share of the meaning: the shares of one word add
/// up to 1; a word that was never heard has 0. Each text has a 0 at its end; `BUFFER` if one does not fit. It reads the command first, at
/// once, unless `goodbot_explain_on` has done so for this task.
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
            let mut meanings: Vec<(Meaning, f32), MEANINGS> = Vec::new();
            let schema = in_world!(world, |domain, _state| {
                while !agent.explain_word(domain, task, position, |meaning, share| keep(&mut meanings, meaning, share, rank as usize))? {
                    while agent.explain_on(domain, task, u32::MAX)? == Progress::Working {}
                }
                domain.world().schema
            });
            let found = meanings.get(rank as usize).copied();
            if known && found.is_none() {
                return Err(GoodbotStatus::Unknown.into());
            }
            let found = found.filter(|_| known);
            let language = agent.language();
            let mut writer = Writer::new(word, word_bytes)?;
            writer.put(symbol.map_or("", |symbol| language.words().text(symbol)));
            writer.end()?;
            let mut writer = Writer::new(meaning, meaning_bytes)?;
            match found {
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
            give(share, found.map_or(0.0, |(_, share)| share))
        })
    }
}

/// Keeps the most probable meanings, up to this rank; of equal ones the first comes first.
fn keep(meanings: &mut Vec<(Meaning, f32), MEANINGS>, meaning: Meaning, share: f32, rank: usize) {
    let at = meanings.iter().rposition(|&(_, more)| more >= share).map_or(0, |before| before.saturating_add(1));
    if share > 0.0 && at <= rank {
        let mut last = (meaning, share);
        meanings.iter_mut().skip(at).for_each(|slot| core::mem::swap(slot, &mut last));
        if meanings.len() <= rank {
            let _ = meanings.push(last);
        }
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
