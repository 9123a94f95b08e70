//! The kinds of task that a model was trained for, in a record after the model's bytes.
//!
//! The model itself has no room for them: a controller is compiled with its kinds, and skips the record. The documentation of
//! `goodbot::snapshot` gives the meaning of each byte.

use goodbot::oomdp::Schema;
use goodbot::snapshot::KINDS_MAGIC;
use goodbot::task::{LiftedProposition, LiftedTask, Piece, Wording};

/// Bytes of the magic and the length, and of the checksum at the end.
const HEAD: usize = 12;
const CHECK: usize = 4;
/// The position of a model's stated length.
const STATED: std::ops::Range<usize> = 10..14;

/// The fault of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the kinds of task after the model are damaged: their length or their check is wrong; take another copy")]
pub struct Damaged;

/// A model's bytes without the record after them.
pub fn model_alone(file: &[u8]) -> &[u8] {
    let stated = file.get(STATED).and_then(|bytes| bytes.try_into().ok()).map(u32::from_le_bytes);
    stated.and_then(|stated| file.get(..usize::try_from(stated).ok()?)).unwrap_or(file)
}

/// The kinds of task in the record after a model, as texts; `None` without a record.
///
/// # Errors
/// [`Damaged`].
pub fn of(file: &[u8]) -> Result<Option<Vec<String>>, Damaged> {
    let record = file.get(model_alone(file).len()..).unwrap_or_default();
    if !record.starts_with(&KINDS_MAGIC) {
        // The model's own check finds the fault of other bytes there.
        return Ok(None);
    }
    let (checked, check) = record.split_last_chunk::<CHECK>().ok_or(Damaged)?;
    let stated = checked.get(KINDS_MAGIC.len()..HEAD).and_then(|bytes| bytes.try_into().ok()).map(u32::from_le_bytes);
    if stated.map(|stated| stated as usize) != Some(record.len()) || crc(checked) != u32::from_le_bytes(*check) {
        return Err(Damaged);
    }
    let texts = checked.get(HEAD..).and_then(|bytes| str::from_utf8(bytes).ok()).ok_or(Damaged)?;
    Ok(Some(texts.lines().map(str::to_owned).collect()))
}

/// The model with a record of these kinds of task, which replaces an older record.
pub fn with(file: &[u8], texts: &[String]) -> Vec<u8> {
    let mut record = [KINDS_MAGIC.as_slice(), &[0; HEAD - KINDS_MAGIC.len()]].concat();
    for text in texts {
        record.extend(text.as_bytes());
        record.push(b'\n');
    }
    let length = (record.len() + CHECK) as u32;
    record[KINDS_MAGIC.len()..HEAD].copy_from_slice(&length.to_le_bytes());
    let check = crc(&record);
    [model_alone(file), &record, &check.to_le_bytes()].concat()
}

/// The CRC-32 that models use.
fn crc(bytes: &[u8]) -> u32 {
    crc::Crc::<u32, crc::NoTable>::new(&crc::CRC_32_ISO_HDLC).checksum(bytes)
}

/// A kind of task as a text. Its variables are named in order, so that equal kinds have equal texts.
///
/// ```
/// use goodbot::{home::SCHEMA, task::LiftedTask};
/// use goodbot_lesson::kept_kinds::text;
/// let kind = LiftedTask::parse("agentInRoom(?me, ?goal) avoiding agentInRoom(?me,?not)", &SCHEMA)?;
/// assert_eq!(text(&kind, &SCHEMA), "agentInRoom(?a,?b) avoiding agentInRoom(?a,?c)");
/// assert_eq!(LiftedTask::parse(&text(&kind, &SCHEMA), &SCHEMA)?, kind);
/// # Ok::<(), goodbot::task::TaskTextError>(())
/// ```
pub fn text(kind: &LiftedTask, schema: &Schema<'_>) -> String {
    let mut text = String::new();
    Wording::FILES.tell(kind.parts(), |piece| match piece {
        Piece::Between(sign) => text.push_str(sign),
        Piece::Proposition(_, LiftedProposition { proposition, variables }) => {
            let count = schema.parameters(proposition).len();
            let named: Vec<String> = variables.iter().take(count).map(|variable| format!("?{}", char::from(b'a' + variable))).collect();
            text += &format!("{}({})", schema.proposition_name(proposition), named.join(","));
        }
    });
    text
}

/// Whether two lists have the same kinds, in any order.
pub fn are_same(some: &[String], others: &[String]) -> bool {
    let all_in = |some: &[String], others: &[String]| some.iter().all(|text| others.contains(text));
    all_in(some, others) && all_in(others, some)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model() -> Vec<u8> {
        [b"goodbot\0\x02\0\x10\0\0\0".as_slice(), b"ab"].concat()
    }

    #[test]
    fn kinds_after_a_model_are_there_again_and_take_the_place_of_older_ones() {
        let [some, others] = [vec!["a(?a)".to_owned(), "b(?a,?b)".to_owned()], vec!["c(?a)".to_owned()]];
        assert_eq!(of(&model()), Ok(None));
        let file = with(&model(), &some);
        assert_eq!((of(&file), model_alone(&file)), (Ok(Some(some)), model().as_slice()));
        assert_eq!(of(&with(&file, &others)), Ok(Some(others)));
    }

    #[test]
    fn a_changed_or_cut_record_is_refused() {
        let file = with(&model(), &["a(?a)".to_owned()]);
        for at in model().len() + KINDS_MAGIC.len()..file.len() {
            let mut changed = file.clone();
            changed[at] ^= 4;
            assert_eq!(of(&changed), Err(Damaged), "byte {at}");
            assert_eq!(of(&file[..at]), Err(Damaged), "cut at {at}");
        }
    }

    #[test]
    fn the_check_is_that_of_zip() {
        assert_eq!(crc(b"123456789"), 0xcbf4_3926);
    }
}
