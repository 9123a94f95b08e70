//! Values as JSON.

use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};

/// A value as JSON. `None` only for a key that is no text, which neither the view nor logs have.
pub(crate) fn json<T: Serialize + ?Sized>(value: &T) -> Option<String> {
    let mut text = Vec::new();
    value.serialize(&mut Serializer::with_formatter(&mut text, Short)).ok()?;
    String::from_utf8(text).ok()
}

/// Writes without spaces. In the page, the browser writes the numbers: the tables for that would take two kilobytes of it.
struct Short;

impl Formatter for Short {
    #[cfg(target_family = "wasm")]
    fn write_f32<W: std::io::Write + ?Sized>(&mut self, writer: &mut W, value: f32) -> std::io::Result<()> {
        use wasm_bindgen::JsCast;
        use wasm_bindgen::prelude::*;

        #[wasm_bindgen]
        extern "C" {
            type Number;
            #[wasm_bindgen(method, js_name = toPrecision)]
            fn with_digits(this: &Number, digits: u32) -> String;
            #[wasm_bindgen(js_name = parseFloat)]
            fn number(text: &str) -> f64;
            #[wasm_bindgen(js_name = String)]
            fn shortest(number: f64) -> String;
        }

        // The fewest digits, six or more, that are read as the same number; nine always are.
        let exact: Number = JsValue::from_f64(value.into()).unchecked_into();
        let near = (6..9).map(|digits| number(&exact.with_digits(digits))).find(|near| *near as f32 == value);
        let text = shortest(near.unwrap_or_else(|| number(&exact.with_digits(9))));
        writer.write_all(text.as_bytes())?;
        // Rust writes a whole number with `.0`.
        if text.bytes().all(|letter| letter == b'-' || letter.is_ascii_digit()) { writer.write_all(b".0") } else { Ok(()) }
    }
}
