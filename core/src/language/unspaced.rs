//! Scripts without spaces between words: Chinese, Japanese, Thai, Lao, Khmer, Burmese.
//!
//! A piece of such a text is one sign for its readers:
//!
//! - a Chinese character, with 子 after it, which makes nouns of many;
//! - a hiragana, with the small ones after it;
//! - a run of katakana, which writes one foreign word;
//! - a consonant of Thai, Lao, Khmer or Burmese with the vowels and tones around it.
//!
//! A name of several pieces is learned piece by piece, like "tan coloured". So a text is split alike with and without spaces, and no
//! dictionary is needed.
//!
//! ```
//! use goodbot::language::for_each_piece;
//! let mut pieces = vec![];
//! for_each_piece("オレンジの部屋 ห้องสีแดง 椅子 raum", |piece| { pieces.push(piece.to_string()); Ok(()) })?;
//! assert_eq!(pieces.join(" "), "オレンジ の 部 屋 ห้ อ ง สี แด ง 椅子 raum");
//! # Ok::<(), goodbot::capacity::CapacityError>(())
//! ```

/// The class of a letter, which decides whether a piece ends before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Script {
    /// Of a script with spaces.
    Spaced,
    /// One character, one piece.
    Han,
    /// Makes a noun of the character before it: 椅子, 袋子.
    Noun,
    Hiragana,
    Katakana,
    /// Belongs to the piece before it.
    Follows,
    /// A vowel that is written before its consonant.
    Leads,
    /// A consonant of Thai, Lao, Khmer or Burmese.
    Consonant,
    /// Joins the consonants on both sides to one piece.
    Joins,
}

impl Script {
    pub const fn of(letter: char) -> Self {
        match letter {
            // Most letters.
            '\0'..='\u{e00}' => Self::Spaced,
            // Thai and Lao, whose tables are alike.
            '\u{e30}'..='\u{e3a}' | '\u{e45}'..='\u{e4e}' | '\u{eb0}'..='\u{ebc}' | '\u{ec6}'..='\u{ece}' => Self::Follows,
            '\u{e40}'..='\u{e44}' | '\u{ec0}'..='\u{ec4}' => Self::Leads,
            '\u{e01}'..='\u{e2f}' | '\u{e81}'..='\u{eaf}' | '\u{edc}'..='\u{edf}' => Self::Consonant,
            // Burmese and Khmer write a consonant under another.
            '\u{1039}' | '\u{17d2}' => Self::Joins,
            '\u{102b}'..='\u{103e}' | '\u{17b4}'..='\u{17d3}' => Self::Follows,
            '\u{1000}'..='\u{102a}' | '\u{1780}'..='\u{17b3}' => Self::Consonant,
            'ぁ' | 'ぃ' | 'ぅ' | 'ぇ' | 'ぉ' | 'っ' | 'ゃ' | 'ゅ' | 'ょ' | 'ゎ' | '\u{3099}' | '\u{309a}' => Self::Follows,
            '\u{3041}'..='\u{309f}' => Self::Hiragana,
            '\u{30a1}'..='\u{30ff}' | '\u{31f0}'..='\u{31ff}' | '\u{ff66}'..='\u{ff9f}' => Self::Katakana,
            '子' => Self::Noun,
            '\u{3005}'..='\u{3007}' | '\u{3400}'..='\u{9fff}' | '\u{f900}'..='\u{faff}' | '\u{20000}'..='\u{3ffff}' => Self::Han,
            _ => Self::Spaced,
        }
    }

    /// Whether a letter belongs to the piece of the previous letter.
    pub fn goes_on(self, before: Self) -> bool {
        match (before, self) {
            (_, Self::Follows | Self::Joins)
            | (Self::Leads, Self::Consonant)
            | (Self::Joins, Self::Consonant)
            | (Self::Han, Self::Noun) => true,
            (Self::Spaced | Self::Katakana, now) => before == now,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::language::for_each_piece;

    fn cut(text: &str) -> std::vec::Vec<std::string::String> {
        let mut pieces = std::vec::Vec::new();
        for_each_piece(text, |piece| {
            pieces.push(std::string::String::from(piece));
            Ok(())
        })
        .unwrap();
        pieces
    }

    #[test]
    fn pieces_of_each_script_are_its_readers_signs() {
        for (word, pieces) in [
            ("把蓝色的椅子搬到", "把 蓝 色 的 椅子 搬 到"),
            ("子供の色々", "子 供 の 色 々"),
            ("ちょっとまって", "ちょっ と まっ て"),
            ("グリーンの部屋", "グリーン の 部 屋"),
            ("แดง", "แด ง"),
            ("ຫ້ອງສີແດງ", "ຫ້ ອ ງ ສີ ແດ ງ"),
            ("បន្ទប់ក្រហម", "ប ន្ទ ប់ ក្រ ហ ម"),
            ("အခန်းနီ", "အ ခ န်း နီ"),
            ("go去room", "go 去 room"),
            ("초록색", "초록색"),
            ("größer", "größer"),
        ] {
            let pieces: std::vec::Vec<_> = pieces.split(' ').collect();
            assert_eq!(cut(word), pieces);
        }
    }
}
