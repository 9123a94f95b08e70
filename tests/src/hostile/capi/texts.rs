//! Texts for the C interface.

use super::super::Bytes;
use std::ffi::{CString, c_char};

/// Texts that the interface understands.
const KNOWN: [&str; 24] = [
    "room0",
    "room1",
    "door0",
    "block0",
    "agent0",
    "red",
    "green",
    "blue",
    "chair",
    "bag",
    "go to the red room",
    "go to the green room",
    "take the chair to the green room",
    "up to the roof",
    "good",
    "",
    "robot",
    "floor",
    "robotOnFloor",
    "onFloor",
    "robotOnFloor(?r, ?f)",
    "robotOnFloor(?r, ?f) & robotOnFloor(?r, ?g)",
    "roomIs",
    "near(?r, ?f)",
];

/// A C string, or null.
#[derive(Debug, Default)]
pub struct Text(Option<CString>);

impl Text {
    /// This text.
    pub fn of(text: &str) -> Self {
        Self(Some(CString::new(text).expect("a text without a zero")))
    }

    /// A text of the choices': a known one, any bytes of any length, or now and then null.
    pub fn any(choices: &mut Bytes<'_>) -> Self {
        match choices.below(16) {
            0 => Self(None),
            1..=3 => Self::bytes(choices, 4),
            4 => Self::bytes(choices, 60),
            5 => Self::of(&"long ".repeat(choices.below(256))),
            6 => Self::of(&"x".repeat(choices.below(256))),
            _ => Self::of(choices.one_of(&KNOWN)),
        }
    }

    fn bytes(choices: &mut Bytes<'_>, most: usize) -> Self {
        let bytes: Vec<u8> = (0..choices.below(most)).map(|_| choices.byte()).filter(|&byte| byte != 0).collect();
        Self(CString::new(bytes).ok())
    }

    /// As C sees it. It stays as long as this text.
    pub fn pointer(&self) -> *const c_char {
        self.0.as_ref().map_or(std::ptr::null(), |text| text.as_ptr())
    }
}
