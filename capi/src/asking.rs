//! Questions to the trainer.

use crate::beliefs::{Writer, put_object, put_task};
use crate::robot::{Goodbot, give, given, look, with};
use crate::status::GoodbotStatus;
use crate::training::write;
use crate::world::{World, in_world};
use core::ffi::c_char;
use goodbot::asking::{Answer, Asking, Considered, Subject};
use goodbot::task::{Piece, Wording};

/// There is nothing to ask: act.
pub const GOODBOT_ASK_NOTHING: u32 = 0;
/// "Do you mean this room?", "this block?": answer `GOODBOT_YES` or `GOODBOT_NO`.
pub const GOODBOT_ASK_OBJECT: u32 = 1;
/// "Do you mean this kind of task?": answer `GOODBOT_YES` or `GOODBOT_NO`.
pub const GOODBOT_ASK_KIND: u32 = 2;
/// "Do you mean this task?": answer `GOODBOT_YES` or `GOODBOT_NO`.
pub const GOODBOT_ASK_TASK: u32 = 3;
/// "Which of these rooms, or of these blocks?": answer with the number of a choice, from 0 on, or `GOODBOT_NO` for none of these.
pub const GOODBOT_ASK_WHICH_OBJECT: u32 = 4;
/// "Which of these tasks?": answer with the number of a choice, from 0 on, or `GOODBOT_NO` for none of these.
pub const GOODBOT_ASK_WHICH_TASK: u32 = 5;

/// Yes.
pub const GOODBOT_YES: i32 = 0;
/// No, or none of these.
pub const GOODBOT_NO: i32 = -1;

/// Proposes a question if it teaches more than acting. The plan for the current state must be done. `kappa` is the cost of a question, in
/// steps (8 is a good number, infinite: never ask), and `eta` the probability of a wrong answer (0.05). It looks ahead with at most about
/// `budget` node expansions; `WORKING` means: call again. `kind` receives `GOODBOT_ASK_NOTHING` and so on, and `choices` the number of
/// choices, 1 for yes or no. A question may stay unanswered. It is not asked again in this session, and after eight questions no more
/// are asked.
///
/// # Safety
/// `robot` is null or a handle; `kind` and `choices` are null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_question(
    robot: *mut Goodbot,
    kappa: f32,
    eta: f32,
    budget: u32,
    kind: *mut u32,
    choices: *mut u32,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            given(kind)?;
            given(choices)?;
            let asking = Asking { kappa, eta, ..Asking::DEFAULT };
            let considered = in_world!(&robot.world, |domain, state| robot.agent.consider(domain, state, &asking, budget)?);
            let subject = match considered {
                Considered::Working => return Ok(GoodbotStatus::Working),
                Considered::Act => {
                    give(choices, 0)?;
                    return give(kind, GOODBOT_ASK_NOTHING);
                }
                Considered::Ask(question) => question.subject,
            };
            give(choices, u32::from(subject.choices().max(1)))?;
            give(
                kind,
                match subject {
                    Subject::Object(_) => GOODBOT_ASK_OBJECT,
                    Subject::Kind(_) => GOODBOT_ASK_KIND,
                    Subject::Task(_) => GOODBOT_ASK_TASK,
                    Subject::WhichObject(..) => GOODBOT_ASK_WHICH_OBJECT,
                    Subject::WhichTask(..) => GOODBOT_ASK_WHICH_TASK,
                },
            )
        })
    }
}

/// Writes the text of one choice of the open question, with a 0 at its end: the name of an object such as `room1`, a task such as
/// `blockInRoom(block0,room1)`, or a kind of task such as `blockInRoom`. `BUFFER` if it does not fit, `NOT_ASKED` without an open question.
///
/// # Safety
/// `robot` is null or a handle; `buffer` is null or room for `bytes` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_question_text(robot: *const Goodbot, choice: u32, buffer: *mut c_char, bytes: usize) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        look(robot, |robot| {
            let mut writer = Writer::new(buffer, bytes)?;
            let subject = robot.agent.open_question().ok_or(GoodbotStatus::NotAsked)?.subject;
            let count = u32::from(subject.choices().max(1));
            let choice = usize::try_from(choice).map_err(|_| GoodbotStatus::Unknown)?;
            if choice >= count as usize {
                return Err(GoodbotStatus::Unknown.into());
            }
            let agent = &robot.agent;
            in_world!(&robot.world, |domain, _state| match subject {
                Subject::Object(object) => put_object(&mut writer, domain, object),
                Subject::WhichObject(objects, _) => {
                    put_object(&mut writer, domain, *objects.get(choice).ok_or(GoodbotStatus::Unknown)?);
                }
                Subject::Task(task) => put_task(&mut writer, domain, agent, usize::from(task))?,
                Subject::WhichTask(tasks, _) => {
                    put_task(&mut writer, domain, agent, usize::from(*tasks.get(choice).ok_or(GoodbotStatus::Unknown)?))?;
                }
                Subject::Kind(kind) => {
                    let lifted = agent.lifted().get(usize::from(kind)).ok_or(GoodbotStatus::Unknown)?;
                    let schema = goodbot::oomdp::Domain::world(domain).schema;
                    Wording::FILES.tell(lifted.parts(), |piece| match piece {
                        Piece::Between(sign) => writer.put(sign),
                        Piece::Proposition(_, part) => writer.put(schema.proposition_name(part.proposition)),
                    });
                }
            });
            writer.end()
        })
    }
}

/// Takes in the trainer's answer to the open question: `GOODBOT_YES`, `GOODBOT_NO`, or the number of a choice, from 0 on. `NOT_ASKED`
/// without an open question, `NO_ANSWER` if this is no answer to it; the question then stays open. `evidence` receives
/// `GOODBOT_EVIDENCE_USED` and so on.
///
/// # Safety
/// `robot` is null or a handle, `evidence` null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_answer(robot: *mut Goodbot, answer: i32, evidence: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            given(evidence)?;
            let to_choose = robot.agent.open_question().is_some_and(|question| question.subject.choices() > 0);
            let answer = match answer {
                GOODBOT_NO => Answer::No,
                GOODBOT_YES if !to_choose => Answer::Yes,
                choice => Answer::This(u8::try_from(choice).map_err(|_| GoodbotStatus::NoAnswer)?),
            };
            give(evidence, write(robot.agent.answer(answer)?))
        })
    }
}
