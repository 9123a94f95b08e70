//! Draws the home of a question as text, in colours if wanted.

use goodbot::home::Map;
use goodbot::memory::HomeMemory;
use goodbot_console::messages::is_colored;
use goodbot_console::printed::Printed;
use std::io::{self, Write};

/// Draws a home.
///
/// # Errors
/// The error of the output.
pub fn draw(out: &mut Printed, map: &Map<'_, impl HomeMemory>) -> io::Result<()> {
    for line in map.to_string().lines() {
        write!(out, "  ")?;
        for character in line.chars() {
            match code(character).filter(|_| is_colored()) {
                Some(code) => out.paint(code, character.encode_utf8(&mut [0; 4]))?,
                None => write!(out, "{character}")?,
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

/// The terminal's colour for a letter of the drawing.
fn code(character: char) -> Option<u8> {
    Some(match character {
        'r' => 31,
        'g' => 32,
        'b' => 34,
        'y' | 'o' => 33,
        'p' => 35,
        't' => 36,
        '@' => 1,
        _ => return None,
    })
}
