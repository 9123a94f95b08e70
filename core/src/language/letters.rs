//! On hosts, with `alloc` and `unicode`: the many ways to write one letter: combining marks, full-width and half-width forms, invisible characters.
//!
//! A word is kept in Unicode's composed form, the shortest. Other spellings of a word, such as "gruen" and "grün", are kept as they were
//! heard, and [compared](is_spelled_alike) as one word.

/// The ordinary form of a letter, often itself. `None` for invisible characters.
pub(super) const fn ordinary(letter: char) -> Option<char> {
    match letter {
        // Plain characters stay.
        '\0'..='\u{ac}' => Some(letter),
        _ if is_unseen(letter) => None,
        '‘' | '’' | '\u{2bc}' => Some('\''),
        '\u{ff01}'..='\u{ff5e}' => Some((letter as u32).wrapping_sub(0xfee0) as u8 as char),
        _ => Some(letter),
    }
}

/// The soft hyphen, joiners and non-joiners, and the byte order mark.
const fn is_unseen(letter: char) -> bool {
    matches!(letter, '\u{ad}' | '\u{200c}' | '\u{200d}' | '\u{2060}' | '\u{feff}')
}

/// Whether a character is part of a word without being a letter: invisible ones, and the combining voice marks that turn か into が and は
/// into ぱ.
pub(super) const fn is_within_words(letter: char) -> bool {
    is_unseen(letter) || matches!(letter, '\u{3099}' | '\u{309a}')
}

/// Whether two words are equal if ä counts as ae, ö as oe, ü as ue, å as aa, ß as ss and ı as i, or begin with the same `letters` letters
/// in this sense (0 compares whole words).
///
/// ```
/// use goodbot::language::is_spelled_alike;
/// assert!(is_spelled_alike("grün", "gruen", 0) && is_spelled_alike("weiß", "weisser", 4) && is_spelled_alike("kırmızı", "kirmizi", 0));
/// assert!(!is_spelled_alike("grün", "grau", 0) && !is_spelled_alike("grün", "grun", 0));
/// ```
pub fn is_spelled_alike(one: &str, other: &str, letters: usize) -> bool {
    let (mut one, mut other) = (spelled_out(one), spelled_out(other));
    let mut same = 0_usize;
    loop {
        match (one.next(), other.next()) {
            (None, None) => return true,
            (one, other) if one != other => return false,
            _ => same = same.saturating_add(1),
        }
        if same == letters {
            return true;
        }
    }
}

/// A word in which letters that may be written as two are written so.
fn spelled_out(word: &str) -> impl Iterator<Item = char> {
    word.chars().flat_map(|letter| {
        let (first, second) = match letter {
            'ä' | 'æ' => ('a', Some('e')),
            'ö' | 'ø' | 'œ' => ('o', Some('e')),
            'ü' => ('u', Some('e')),
            'å' => ('a', Some('a')),
            'ß' => ('s', Some('s')),
            'ı' => ('i', None),
            _ => (letter, None),
        };
        core::iter::once(first).chain(second)
    })
}

/// The letter that two characters compose: a letter with a mark, or parts of a Korean syllable.
pub(super) fn composed(before: char, letter: char) -> Option<char> {
    let (first, second) = (u32::from(before), u32::from(letter));
    match letter {
        // The dot of İ in lower case.
        '\u{307}' if before == 'i' => Some('i'),
        '\u{300}'..='\u{36f}' => {
            let (_, letters) = MARKED.iter().find(|&&(mark, _)| mark == letter)?;
            let mut letters = letters.chars();
            core::iter::from_fn(|| Some((letters.next()?, letters.next()?))).find(|&(plain, _)| plain == before).map(|(_, marked)| marked)
        }
        '\u{3099}' if matches!(before, 'か'..='ほ' | 'カ'..='ホ') => char::from_u32(first.saturating_add(1)),
        '\u{309a}' if matches!(before, 'は'..='ほ' | 'ハ'..='ホ') => char::from_u32(first.saturating_add(2)),
        '\u{1161}'..='\u{1175}' if matches!(before, '\u{1100}'..='\u{1112}') => {
            let [consonant, vowel] = [first.saturating_sub(0x1100), second.saturating_sub(0x1161)];
            char::from_u32(consonant.saturating_mul(21).saturating_add(vowel).saturating_mul(28).saturating_add(0xac00))
        }
        '\u{11a8}'..='\u{11c2}' if matches!(before, '가'..='힣') && first.saturating_sub(0xac00).is_multiple_of(28) => {
            char::from_u32(first.saturating_add(second.saturating_sub(0x11a7)))
        }
        _ => None,
    }
}

/// The full-width letter of a half-width Japanese one, with its marks apart.
pub(super) fn full_width(letter: char) -> char {
    const KATAKANA: &str =
        "ヲァィゥェォャュョッーアイウエオカキクケコサシスセソタチツテトナニヌネノハヒフヘホマミムメモヤユヨラリルレロワン\u{3099}\u{309a}";
    match letter {
        '\u{ff66}'..='\u{ff9f}' => KATAKANA.chars().nth(u32::from(letter).saturating_sub(0xff66) as usize).unwrap_or(letter),
        _ => letter,
    }
}

/// For each mark, pairs of a letter and the same letter with the mark: lower case of Latin, Greek and Cyrillic. From Unicode's canonical
/// compositions.
#[rustfmt::skip]
const MARKED: [(char, &str); 25] = [
    ('\u{300}', "aàeèiìnǹoòuùwẁyỳâầêềôồüǜăằēḕōṑơờưừеѐиѝ"),
    ('\u{301}', "aácćeégǵiíkḱlĺmḿnńoópṕrŕsśuúwẃyýzź¨΅âấåǻæǽçḉêếïḯôốõṍøǿüǘăắēḗōṓũṹơớưứαάεέηήιίοόυύωώϊΐϋΰϒϓгѓкќ"),
    ('\u{302}', "aâcĉeêgĝhĥiîjĵoôsŝuûwŵyŷzẑạậẹệọộ"),
    ('\u{303}', "aãeẽiĩnñoõuũvṽyỹâẫêễôỗăẵơỡưữ"),
    ('\u{304}', "aāeēgḡiīoōuūyȳäǟæǣõȭöȫüǖǫǭȧǡȯȱиӣуӯḷḹṛṝ"),
    ('\u{306}', "aăeĕgğiĭoŏuŭȩḝаӑеӗжӂийуўạặ"),
    ('\u{307}', "aȧbḃcċdḋeėfḟgġhḣmṁnṅoȯpṗrṙsṡtṫwẇxẋyẏzżśṥšṧſẛṣṩ"),
    ('\u{308}', "aäeëhḧiïoötẗuüwẅxẍyÿõṏūṻιϊυϋϒϔаӓеёжӝзӟиӥоӧуӱчӵыӹэӭіїәӛөӫ"),
    ('\u{309}', "aảeẻiỉoỏuủyỷâẩêểôổăẳơởưử"),
    ('\u{30a}', "aåuůwẘyẙ"),
    ('\u{30b}', "oőuűуӳ"),
    ('\u{30c}', "aǎcčdďeěgǧhȟiǐjǰkǩlľnňoǒrřsštťuǔzžüǚʒǯ"),
    ('\u{30f}', "aȁeȅiȉoȍrȑuȕѵѷ"),
    ('\u{311}', "aȃeȇiȋoȏrȓuȗ"),
    ('\u{31b}', "oơuư"),
    ('\u{323}', "aạbḅdḍeẹhḥiịkḳlḷmṃnṇoọrṛsṣtṭuụvṿwẉyỵzẓơợưự"),
    ('\u{324}', "uṳ"),
    ('\u{325}', "aḁ"),
    ('\u{326}', "sștț"),
    ('\u{327}', "cçdḑeȩgģhḩkķlļnņrŗsştţ"),
    ('\u{328}', "aąeęiįoǫuų"),
    ('\u{32d}', "dḓeḙlḽnṋtṱuṷ"),
    ('\u{32e}', "hḫ"),
    ('\u{330}', "eḛiḭuṵ"),
    ('\u{331}', "bḇdḏhẖkḵlḻnṉrṟtṯzẕ"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::for_each_piece;

    fn heard(command: &str) -> std::string::String {
        let mut words = std::vec::Vec::new();
        for_each_piece(command, |word| {
            words.push(std::string::String::from(word));
            Ok(())
        })
        .unwrap();
        words.join(" ")
    }

    #[test]
    fn one_command_written_in_many_ways_has_the_same_words() {
        for (written, plain) in [
            // Combining marks, as some systems write them in file names and speech.
            ("gru\u{308}n habitacio\u{301}n e\u{323}\u{302}", "grün habitación ệ"),
            ("GRU\u{308}N", "grün"),
            ("\u{438}\u{306}од", "йод"),
            ("\u{3b1}\u{301}σπρο", "άσπρο"),
            ("\u{110e}\u{1169}\u{1105}\u{1169}\u{11a8}", "초록"),
            ("か\u{3099}ハ\u{309a}", "が パ"),
            // Full width, and half width.
            ("ｇｏ　Ｒｏｏｍ５", "go room5"),
            ("ｸﾞﾘｰﾝ", "グリーン"),
            // Apostrophes and invisible characters.
            ("don’t don‘t don't l’eau", "don't don't don't l'eau"),
            ("\u{feff}ro\u{ad}om ro\u{200d}o\u{2060}m", "room room"),
            // Turkish.
            ("İPEK", "ipek"),
        ] {
            assert_eq!(heard(written), plain, "{written}");
        }
    }

    #[test]
    fn what_unicode_composes_is_in_the_table_once() {
        for (mark, letters) in MARKED {
            assert_eq!(letters.chars().count() % 2, 0, "{mark:?}");
            let plain: std::vec::Vec<_> = letters.chars().step_by(2).collect();
            assert!(plain.iter().all(|&letter| composed(letter, mark).is_some_and(|one| letters.contains(one))));
            assert!(plain.windows(2).all(|pair| pair[0] < pair[1]), "{mark:?}");
        }
    }
}
