//! Scripts that are written without spaces between words: Chinese, Japanese, Thai, Lao, Khmer, Burmese.
//!
//! A piece of such a text is what its readers take for one sign:
//!
//! - a Chinese character, with 子 after it, which makes nouns of many;
//! - a hiragana, with the small ones after it;
//! - a run of katakana, which writes one foreign word;
//! - a consonant of Thai, Lao, Khmer or Burmese with the vowels and tones around it.
//!
//! A name of several pieces is learned piece by piece, as "tan coloured" is. So a text is cut alike with spaces and without them, and no
//! dictionary takes room.

/// How a letter is cut from the next one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Script {
    /// Written with spaces.
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
    /// Makes one piece of the consonants on both sides.
    Joins,
}

impl Script {
    const fn of(letter: char) -> Self {
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

    /// Whether a letter is of the same piece as the one before it.
    fn goes_on(self, before: Self) -> bool {
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

/// The pieces of a word. A word of a script with spaces is one.
///
/// ```
/// use goodbot::language::unspaced::cut;
/// let pieces = |word| cut(word).collect::<Vec<_>>();
/// assert_eq!(pieces("去绿色的房间"), ["去", "绿", "色", "的", "房", "间"]);
/// assert_eq!(pieces("オレンジの部屋へ行って"), ["オレンジ", "の", "部", "屋", "へ", "行", "って"]);
/// assert_eq!(pieces("ห้องสีแดง"), ["ห้", "อ", "ง", "สี", "แด", "ง"]);
/// assert_eq!(pieces("椅子"), ["椅子"]);
/// assert_eq!(pieces("raum"), ["raum"]);
/// ```
pub fn cut(word: &str) -> impl Iterator<Item = &str> {
    let mut rest = word;
    core::iter::from_fn(move || {
        let mut letters = rest.char_indices().map(|(at, letter)| (at, Script::of(letter)));
        let mut before = letters.next()?.1;
        let end = letters.find(|&(_, now)| !now.goes_on(core::mem::replace(&mut before, now)));
        let (piece, after) = rest.split_at_checked(end.map_or(rest.len(), |(at, _)| at))?;
        rest = after;
        Some(piece)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

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
            assert_eq!(cut(word).collect::<std::vec::Vec<_>>(), pieces);
        }
    }

    #[test]
    fn no_letter_is_lost() {
        let all: std::string::String = (0..0x3_1000).filter_map(char::from_u32).collect();
        assert_eq!(cut(&all).collect::<std::string::String>(), all);
        assert!(cut(&all).all(|piece| !piece.is_empty()) && cut("").next().is_none());
    }
}
