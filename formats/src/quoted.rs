//! Excerpts of a text, for messages.

/// The beginning of a text in quotes, with unprintable characters escaped: it comes from a file and goes to a terminal.
pub fn quoted(text: &str) -> String {
    let text = excerpt(text, 80);
    // On the page, Rust's tables of printable characters would take two kilobytes.
    if cfg!(target_family = "wasm") { format!("\"{text}\"") } else { format!("{text:?}") }
}

/// The beginning of a text, at most this many characters.
pub(crate) fn excerpt(text: &str, characters: usize) -> String {
    match text.char_indices().nth(characters) {
        Some((cut, _)) => format!("{}…", &text[..cut]),
        None => text.to_string(),
    }
}
