//! Finds the values of a JSON text, by RFC 8259.

/// The most entries of an object or a list: more would take much memory for a short text.
pub(super) const LIMIT: usize = 1 << 16;

/// The fault of a text, and the byte at which it is.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct JsonFault {
    pub(super) at: usize,
    /// The fault; `None` if the text ends too soon.
    pub(super) message: Option<&'static str>,
}

/// A field of an object.
pub(super) struct Member<'a> {
    pub(super) name: String,
    pub(super) key: &'a str,
    pub(super) value: &'a str,
}

/// The one value of a text.
pub(super) fn whole(text: &str) -> Result<&str, JsonFault> {
    let mut scanner = Scanner { text, at: 0 };
    let value = scanner.value()?;
    scanner.blanks();
    if scanner.at < text.len() { Err(scanner.fault("trailing characters")) } else { Ok(value) }
}

/// The fields of an object; `None` if there are too many. A field name with half a surrogate pair is an error.
pub(super) fn members(object: &str) -> Result<Option<Vec<Member<'_>>>, &'static str> {
    let mut scanner = Scanner { text: object, at: 1 };
    let mut members = Vec::new();
    while let Some(key) = scanner.entry() {
        if members.len() == LIMIT {
            return Ok(None);
        }
        scanner.blanks();
        scanner.at += 1;
        let Ok(value) = scanner.value() else { break };
        members.push(Member { name: unescaped(key)?, key, value });
    }
    Ok(Some(members))
}

/// The items of a list; `None` if there are too many.
pub(super) fn items(list: &str) -> Option<Vec<&str>> {
    let mut scanner = Scanner { text: list, at: 1 };
    let mut items = Vec::new();
    while let Some(item) = scanner.entry() {
        if items.len() == LIMIT {
            return None;
        }
        items.push(item);
    }
    Some(items)
}

/// The contents of a text in quotes. Half a surrogate pair is an error.
pub(super) fn unescaped(quoted: &str) -> Result<String, &'static str> {
    let mut rest = quoted.get(1..quoted.len().saturating_sub(1)).unwrap_or_default();
    let mut text = String::with_capacity(rest.len());
    while let Some((before, after)) = rest.split_once('\\') {
        text.push_str(before);
        let mut characters = after.chars();
        let escaped = characters.next();
        rest = characters.as_str();
        text.push(match escaped {
            Some('b') => '\u{8}',
            Some('f') => '\u{c}',
            Some('n') => '\n',
            Some('r') => '\r',
            Some('t') => '\t',
            Some('u') => code_point(&mut rest).ok_or("half of a surrogate pair")?,
            other => other.unwrap_or('\\'),
        });
    }
    text.push_str(rest);
    Ok(text)
}

/// Takes a character's code from the front of `rest`: four digits, or a surrogate pair.
fn code_point(rest: &mut &str) -> Option<char> {
    let first = code_unit(rest)?;
    let pair = (0xd800..0xdc00).contains(&first).then(|| rest.strip_prefix("\\u")).flatten();
    let Some(mut after) = pair else { return char::from_u32(first) };
    let second = code_unit(&mut after)?.checked_sub(0xdc00).filter(|low| *low < 0x400)?;
    *rest = after;
    char::from_u32(0x10000 + ((first - 0xd800) << 10) + second)
}

fn code_unit(rest: &mut &str) -> Option<u32> {
    let (digits, after) = rest.split_at_checked(4)?;
    *rest = after;
    u32::from_str_radix(digits, 16).ok()
}

struct Scanner<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Scanner<'a> {
    fn byte(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    /// A fault at this byte. At the end of the text, the fault is that it ends.
    fn fault(&self, message: &'static str) -> JsonFault {
        JsonFault { at: self.at, message: Some(message).filter(|_| self.at < self.text.len()) }
    }

    /// Advances by one byte if it is wanted.
    fn takes(&mut self, wanted: impl Fn(u8) -> bool) -> bool {
        let takes = self.byte().is_some_and(wanted);
        self.at += usize::from(takes);
        takes
    }

    fn needs(&mut self, wanted: impl Fn(u8) -> bool, message: &'static str) -> Result<(), JsonFault> {
        if self.takes(wanted) { Ok(()) } else { Err(self.fault(message)) }
    }

    fn blanks(&mut self) {
        while self.takes(|byte| matches!(byte, b' ' | b'\t' | b'\n' | b'\r')) {}
    }

    /// The next field name or item of a checked object or list; `None` at its end.
    fn entry(&mut self) -> Option<&'a str> {
        self.blanks();
        self.takes(|byte| byte == b',');
        self.value().ok()
    }

    /// Passes a value of any depth, and returns it.
    fn value(&mut self) -> Result<&'a str, JsonFault> {
        self.blanks();
        let from = self.at;
        // The closing brackets of all open lists and objects.
        let mut open = Vec::new();
        loop {
            let list = self.takes(|byte| byte == b'[');
            if list || self.takes(|byte| byte == b'{') {
                let end = if list { b']' } else { b'}' };
                self.blanks();
                if !self.takes(|byte| byte == end) {
                    open.push(end);
                    self.name(end)?;
                    continue;
                }
            } else {
                self.scalar()?;
            }
            loop {
                let Some(&end) = open.last() else { return self.text.get(from..self.at).ok_or(self.fault("")) };
                self.blanks();
                if self.takes(|byte| byte == b',') {
                    self.name(end)?;
                    break;
                }
                self.needs(|byte| byte == end, if end == b']' { "expected `,` or `]`" } else { "expected `,` or `}`" })?;
                open.pop();
            }
        }
    }

    /// Goes to the next value in a list or object that closes with `end`. In an object, passes the field name.
    fn name(&mut self, end: u8) -> Result<(), JsonFault> {
        self.blanks();
        if end == b']' {
            return Ok(());
        }
        if self.byte() != Some(b'"') {
            return Err(self.fault("key must be a string"));
        }
        self.scalar()?;
        self.blanks();
        self.needs(|byte| byte == b':', "expected `:`")?;
        self.blanks();
        Ok(())
    }

    /// Passes a value that contains no other values.
    fn scalar(&mut self) -> Result<(), JsonFault> {
        match self.byte() {
            Some(b'"') => self.string(),
            Some(b'-' | b'0'..=b'9') => self.number(),
            _ => {
                let word = ["null", "true", "false"].into_iter().find(|word| self.byte() == word.bytes().next());
                for letter in word.ok_or(self.fault("expected value"))?.bytes() {
                    self.needs(|byte| byte == letter, "expected ident")?;
                }
                Ok(())
            }
        }
    }

    fn string(&mut self) -> Result<(), JsonFault> {
        self.at += 1;
        while !self.takes(|byte| byte == b'"') {
            if self.takes(|byte| byte == b'\\') {
                let unicode = self.byte() == Some(b'u');
                self.needs(|byte| b"\"\\/bfnrtu".contains(&byte), "invalid escape")?;
                for _ in 0..if unicode { 4 } else { 0 } {
                    self.needs(|byte| byte.is_ascii_hexdigit(), "invalid escape")?;
                }
            } else {
                self.needs(|byte| byte >= b' ', "control character found while parsing a string")?;
            }
        }
        Ok(())
    }

    fn number(&mut self) -> Result<(), JsonFault> {
        self.takes(|byte| byte == b'-');
        if !self.takes(|byte| byte == b'0') {
            self.digits()?;
        } else if self.byte().is_some_and(|byte| byte.is_ascii_digit()) {
            return Err(self.fault("invalid number"));
        }
        if self.takes(|byte| byte == b'.') {
            self.digits()?;
        }
        if self.takes(|byte| matches!(byte, b'e' | b'E')) {
            self.takes(|byte| matches!(byte, b'+' | b'-'));
            self.digits()?;
        }
        Ok(())
    }

    fn digits(&mut self) -> Result<(), JsonFault> {
        self.needs(|byte| byte.is_ascii_digit(), "invalid number")?;
        while self.takes(|byte| byte.is_ascii_digit()) {}
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOUND: [&str; 4] = [
        r#"{"a":[1,-0.5e+3,true,false,null,"b\n\u00e9\ud83d\ude00"],"é": {} , "c":[ ]}"#,
        r#"[[[]], {"x":{"y":-12.0E-7}}]"#,
        r#" "\"\\\/\b\f\r\t" "#,
        "0",
    ];

    #[test]
    fn a_text_that_is_cut_ends_too_soon() {
        for text in SOUND {
            for (end, _) in text.trim_end().char_indices() {
                assert_eq!(whole(&text[..end]), Err(JsonFault { at: end, message: None }), "{}", &text[..end]);
            }
        }
    }

    #[test]
    fn a_text_is_json_where_another_reader_says_so() {
        let bytes: Vec<char> = "{}[]\",:\\u0eE+-.19 tn\u{1}é\n".chars().collect();
        let mut tried = 0;
        for seed in SOUND {
            let characters: Vec<char> = seed.chars().collect();
            for place in 0..=characters.len() {
                for &new in &bytes {
                    for left_out in 0..=2.min(characters.len() - place) {
                        let changed: String =
                            characters[..place].iter().chain([&new]).chain(&characters[place + left_out..]).copied().collect();
                        let cut = changed.char_indices().next_back().map_or("", |(last, _)| &changed[..last]);
                        for text in [changed.as_str(), cut] {
                            let theirs = serde_json::from_str::<&serde_json::value::RawValue>(text);
                            assert_eq!(whole(text).ok(), theirs.as_ref().ok().map(|raw| raw.get()), "{text}");
                            tried += 1;
                        }
                    }
                }
            }
        }
        assert!(tried > 10_000);
    }

    #[test]
    fn a_text_in_quotes_says_what_another_reader_says() {
        for quoted in [
            r#""""#,
            r#""plain é""#,
            r#""\"\\\/\b\f\n\r\t""#,
            r#""\u0041\u00e9\u20ac\uFFFF\u0000""#,
            r#""\ud83d\ude00x""#,
            r#""\ud83d""#,
            r#""\ud83dx""#,
            r#""\ud83d\n""#,
            r#""\ude00\ud83d""#,
            r#""\ud83d\u0041""#,
            r#""\ud83d\ud83d\ude00""#,
        ] {
            assert_eq!(unescaped(quoted).ok(), serde_json::from_str::<String>(quoted).ok(), "{quoted}");
        }
    }
}
