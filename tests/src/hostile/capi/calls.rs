//! Calls other than a plain session: in parts, with questions, explanations and settings.

use super::super::Bytes;
use super::texts::Text;
use goodbot_capi::asking::{GOODBOT_ASK_WHICH_TASK, GOODBOT_NO, GOODBOT_YES, goodbot_answer, goodbot_question, goodbot_question_text};
use goodbot_capi::home::goodbot_home_derived;
use goodbot_capi::memory::{GoodbotLessons, goodbot_least_capacities, goodbot_session_count, goodbot_usage};
use goodbot_capi::options::*;
use goodbot_capi::robot::Goodbot;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::training::*;
use goodbot_capi::words::goodbot_explain_word;
use std::mem::MaybeUninit;

/// Hears and ends a session in parts, and hears the last command again.
pub unsafe fn in_parts(robot: *mut Goodbot, choices: &mut Bytes<'_>) {
    let command = Text::any(choices);
    let budget = 1 + u32::from(choices.byte()) * 16;
    // SAFETY: the caller's promise.
    unsafe {
        match choices.below(5) {
            0 => drop(goodbot_begin_hearing(robot, command.pointer())),
            1 => drop(goodbot_hear_on(robot, budget)),
            2 => drop(goodbot_hear_again(robot)),
            3 => drop(goodbot_begin_finishing(robot)),
            _ => {
                let mut gave_way = 0;
                goodbot_finish_on(robot, budget, &raw mut gave_way);
            }
        }
    }
}

/// Asks for a question, reads its texts and answers it, with valid and invalid answers.
pub unsafe fn question(robot: *mut Goodbot, choices: &mut Bytes<'_>) {
    let (mut kind, mut count, mut evidence) = (0, 0, 0);
    let mut text = [0; 80];
    // SAFETY: the caller's promise; the numbers and the text are there.
    unsafe {
        let kappa = choices.one_of(&[0.5, 2.0, 8.0, f32::INFINITY, f32::NAN, -1.0]);
        let eta = choices.one_of(&[0.05, 0.0, 0.5, f32::NAN]);
        if goodbot_question(robot, kappa, eta, u32::from(choices.byte()) * 16, &raw mut kind, &raw mut count) == GoodbotStatus::Ok {
            assert!(kind <= GOODBOT_ASK_WHICH_TASK);
        }
        let asked = goodbot_question_text(robot, u32::from(choices.byte()) % 4, text.as_mut_ptr(), 80) != GoodbotStatus::NotAsked;
        let answer = choices.one_of(&[GOODBOT_YES, GOODBOT_NO, 1, 2, 7, 300, i32::MIN]);
        let status = goodbot_answer(robot, answer, &raw mut evidence);
        assert!(asked || status != GoodbotStatus::Ok, "what was not asked is not answered");
    }
}

/// Explains a word, and hears one of several transcripts.
pub unsafe fn words(robot: *mut Goodbot, choices: &mut Bytes<'_>) {
    let (mut word, mut meaning, mut share, mut chosen) = ([0; 32], [0; 80], f32::NAN, 0);
    let (first, second) = (Text::any(choices), Text::any(choices));
    let weight = choices.one_of(&[0.5, 0.0, -1.0, f32::NAN, f32::MAX, f32::MIN, f32::NEG_INFINITY]);
    let heard = [GoodbotHypothesis { command: first.pointer(), weight }, GoodbotHypothesis { command: second.pointer(), weight: 0.25 }];
    let (task, position, rank) = (choices.below(8) as u32, choices.below(8) as u32, choices.below(4) as u32);
    // SAFETY: the caller's promise; the texts are as long as is said.
    unsafe {
        if choices.below(2) == 0 {
            let count = choices.below(3) as u32;
            let status = match choices.below(2) {
                0 => goodbot_hear_one_of(robot, heard.as_ptr(), count, &raw mut chosen),
                _ => goodbot_hear_one_of_logs(robot, heard.as_ptr(), count, &raw mut chosen),
            };
            if status == GoodbotStatus::Ok {
                assert!(chosen < count);
            }
        }
        let (at, said) = (word.as_mut_ptr(), meaning.as_mut_ptr());
        if goodbot_explain_word(robot, task, position, rank, at, 32, said, 80, &raw mut share) == GoodbotStatus::Ok {
            assert!((0.0..=1.001).contains(&share), "a share of {share}");
        }
    }
}

/// Sets strategies and options, and asks for capacities and counts.
pub unsafe fn settings(robot: *mut Goodbot, choices: &mut Bytes<'_>) {
    let number = |choices: &mut Bytes<'_>| choices.one_of(&[0.0, 0.05, 0.7, 0.3, 1.0, -0.1, f32::NAN, f32::INFINITY]);
    let (mut evidence, mut count) = (0, 0);
    let mut room = MaybeUninit::uninit();
    // SAFETY: the caller's promise; what is pointed to is there.
    unsafe {
        match choices.below(6) {
            0 => {
                let mut options = MaybeUninit::uninit();
                if goodbot_current_options(robot, options.as_mut_ptr()) == GoodbotStatus::Ok {
                    let current: GoodbotOptions = options.assume_init();
                    let mut hazard = || {
                        let [moved, rested, resting, praised, scolded] = core::array::from_fn(|_| number(choices));
                        GoodbotHazard { moved, rested, resting, praised, scolded }
                    };
                    let (ends_at_goal, ends_elsewhere) = (hazard(), hazard());
                    let drift = number(choices);
                    let (weights, least_weight) = (choices.below(4) as u32, number(choices));
                    let (telling, done) = (choices.below(2) == 0, number(choices));
                    let wanted = GoodbotOptions { telling, drift, ends_at_goal, ends_elsewhere, weights, least_weight, done };
                    let expected = if goodbot_set_options(robot, &raw const wanted) == GoodbotStatus::Ok { wanted } else { current };
                    assert_eq!(goodbot_current_options(robot, options.as_mut_ptr()), GoodbotStatus::Ok);
                    assert_eq!(options.assume_init().drift, expected.drift);
                }
            }
            1 => drop(goodbot_trainer_ended(robot, &raw mut evidence)),
            2 => {
                let lags = [number(choices), number(choices), number(choices)];
                let one = GoodbotStrategy {
                    mu_plus: 0.8,
                    mu_minus: 0.7,
                    epsilon: number(choices),
                    lags,
                    rests: [number(choices); 4],
                    prior: number(choices),
                };
                goodbot_trainers(robot, [one, GoodbotStrategy { lags: [1.0, 0.0, 0.0], ..one }].as_ptr(), choices.below(3) as u32);
            }
            3 => drop(goodbot_home_derived(robot, choices.below(2) == 0)),
            4 => {
                let mut number = || u32::from(choices.byte());
                let lessons =
                    GoodbotLessons { sessions: number(), words_per_command: number(), different_words: number(), word_bytes: number() };
                goodbot_least_capacities(robot, &raw const lessons, room.as_mut_ptr());
            }
            _ => {
                goodbot_session_count(robot, &raw mut count);
                goodbot_usage(robot, room.as_mut_ptr());
            }
        }
    }
}
