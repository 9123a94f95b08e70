//! Bytes as printable letters that a web server packs without loss: deflate gives each letter a whole number of bits, so each letter is six or seven
//! bits here, too. Base64 takes more letters, and so more of deflate's blocks, each with a table of its own.

/// The letters for six bits; the others are for seven.
const OF_SIX_BITS: u32 = 35;

/// Bytes as letters, for `page/src/letters.js`. Up to seven zero bits are added at the end.
pub fn letters(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len() * 5 / 4);
    let (mut held, mut bits) = (0_u32, 0);
    let mut write = |held: u32, bits: &mut u32| {
        let six = held >> (*bits - 6) & 63;
        let is_six = six < OF_SIX_BITS;
        *bits -= if is_six { 6 } else { 7 };
        text.push(letter(if is_six { six } else { (held >> *bits & 127) - OF_SIX_BITS }));
    };
    for byte in bytes {
        (held, bits) = (held << 8 | u32::from(*byte), bits + 8);
        while bits > 6 {
            write(held, &mut bits);
        }
    }
    write(held << 7, &mut (bits + 7));
    text
}

/// From `!` to `~`, without the `<` that could end the element.
fn letter(number: u32) -> char {
    let code = b'!' + number as u8;
    char::from(if code < b'<' { code } else { code + 1 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As `page/src/letters.js` does it.
    fn bytes(text: &str) -> Vec<u8> {
        let (mut bytes, mut held, mut bits) = (Vec::new(), 0_u32, 0);
        for code in text.bytes() {
            let number = u32::from(code - b'!') - u32::from(code > b'<');
            let (value, more) = if number < OF_SIX_BITS { (number, 6) } else { (number + OF_SIX_BITS, 7) };
            (held, bits) = (held << more | value, bits + more);
            if bits > 7 {
                bits -= 8;
                bytes.push((held >> bits) as u8);
            }
        }
        bytes
    }

    #[test]
    fn bytes_come_back_from_letters_of_a_script() {
        let all: Vec<u8> = (0..=255_u8).chain([0; 9]).chain((0..=255).map(|byte: u8| byte.wrapping_mul(167))).collect();
        for length in 0..all.len() {
            let text = letters(&all[..length]);
            assert_eq!(&bytes(&text)[..length], &all[..length]);
            assert!(text.bytes().all(|code| code.is_ascii_graphic() && code != b'<'), "{text}");
        }
    }
}
