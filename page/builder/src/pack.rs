//! Packs bytes for `page/src/expand.js`. LZMA finds the copies. Its bits are then written anew, because LZMA predicts without the bytes before
//! whether there is a copy.

use std::io::Write;

use anyhow::Result;
use lzma_rust2::{EncodeMode, LzmaOptions, LzmaWriter, MfType};

/// How many bits of the previous byte predict a literal, as in `page/src/expand.js`.
const LC: u32 = 5;
/// A bit that is as often 0 as 1, of 2048.
const EVEN: u16 = 1 << 10;
/// The place in [`Odds`] of the bits that say whether the distance of a copy is an earlier one.
const IS_AGAIN: usize = 16;

/// The bytes as `page/src/expand.js` expands them.
pub fn packed(bytes: &[u8]) -> Result<Vec<u8>> {
    let stream = lzma(bytes)?;
    let mut recoder = Recoder {
        whole: bytes,
        end: 0,
        from: stream.iter(),
        range: u32::MAX,
        code: 0,
        to: vec![],
        width: u32::MAX,
        low: 0,
        odds: Odds::new(),
    };
    (0..5).for_each(|_| recoder.next());
    recoder.recode();
    Ok(recoder.to)
}

fn lzma(bytes: &[u8]) -> Result<Vec<u8>> {
    let options = LzmaOptions::new(1 << 20, LC, 0, 0, EncodeMode::Normal, 273, MfType::Bt4, 10_000);
    let mut packer = LzmaWriter::new_no_header(Vec::new(), &options, false)?;
    packer.write_all(bytes)?;
    Ok(packer.finish()?)
}

/// Reads the bits of an LZMA stream, and writes them to another stream.
struct Recoder<'a> {
    whole: &'a [u8],
    end: usize,
    from: std::slice::Iter<'a, u8>,
    range: u32,
    code: u32,
    to: Vec<u8>,
    width: u32,
    low: u32,
    odds: Odds,
}

/// The chances of lengths.
struct Lengths {
    choice: [u16; 2],
    short: [u16; 8],
    middle: [u16; 8],
    long: [u16; 256],
}

impl Recoder<'_> {
    fn recode(&mut self) {
        let (mut is_copy, mut is_again, mut is_not_last) = ([EVEN; 12], [EVEN; 12], [EVEN; 12]);
        let (mut is_long, mut is_older, mut is_oldest) = ([EVEN; 12], [EVEN; 12], [EVEN; 12]);
        let mut literals = vec![EVEN; 768 << LC];
        let (mut slots, mut near, mut aligned) = ([[EVEN; 64]; 4], [EVEN; 128], [EVEN; 16]);
        let [mut lengths, mut lengths_again] =
            [(); 2].map(|()| Lengths { choice: [EVEN; 2], short: [EVEN; 8], middle: [EVEN; 8], long: [EVEN; 256] });
        let (mut state, mut distances) = (0, [0; 4]);
        while self.end < self.whole.len() {
            if self.guess(&mut is_copy[state], state, state > 6) == 0 {
                let model = (state > 6).then(|| self.before(distances[0] + 1));
                let context = self.before(1) >> (8 - LC);
                self.literal(&mut literals[768 * context..], model);
                state = if state < 4 { 0 } else { state - if state < 10 { 3 } else { 6 } };
                continue;
            }
            let after_copy = state > 6;
            let mut length = 1;
            if self.guess(&mut is_again[state], IS_AGAIN + state, state > 6) == 1 {
                let which = if self.bit(&mut is_not_last[state]) == 0 {
                    0
                } else if self.bit(&mut is_older[state]) == 0 {
                    1
                } else {
                    2 + self.bit(&mut is_oldest[state])
                };
                let is_one = which == 0 && self.bit(&mut is_long[state]) == 0;
                distances[..=which].rotate_right(1);
                if !is_one {
                    length = self.length(&mut lengths_again);
                }
                state = if after_copy { 11 } else { 8 + usize::from(is_one) };
            } else {
                length = self.length(&mut lengths);
                state = if after_copy { 10 } else { 7 };
                distances.rotate_right(1);
                distances[0] = self.distance(&mut slots[(length - 2).min(3)], &mut near, &mut aligned);
            }
            self.end += length;
        }
        (0..4).for_each(|_| self.shift());
    }

    /// A byte before the end; 0 before the beginning.
    fn before(&self, back: usize) -> usize {
        self.end.checked_sub(back).map_or(0, |at| self.whole[at].into())
    }

    fn literal(&mut self, chances: &mut [u16], mut model: Option<usize>) {
        let mut node = 1;
        for place in (0..8).rev() {
            let expected = model.map(|byte| byte >> place & 1);
            let at = node + expected.map_or(0, |expected| (1 + expected) << 8);
            let is = self.bit(&mut chances[at]);
            model = model.filter(|_| expected == Some(is));
            node = node << 1 | is;
        }
        self.end += 1;
    }

    fn length(&mut self, Lengths { choice, short, middle, long }: &mut Lengths) -> usize {
        if self.bit(&mut choice[0]) == 0 {
            2 + self.number(short)
        } else if self.bit(&mut choice[1]) == 0 {
            10 + self.number(middle)
        } else {
            18 + self.number(long)
        }
    }

    fn distance(&mut self, slots: &mut [u16; 64], near: &mut [u16; 128], aligned: &mut [u16; 16]) -> usize {
        let slot = self.number(slots);
        if slot < 4 {
            return slot;
        }
        let bits = (slot >> 1) - 1;
        let mut distance = (2 | slot & 1) << bits;
        if slot < 14 {
            return distance + self.reversed(&mut near[distance - slot..], bits);
        }
        for place in (4..bits).rev() {
            self.range &= !1;
            let is = self.read(self.range >> 1);
            self.write(is, self.width >> 1);
            distance += is << place;
        }
        distance + self.reversed(aligned, 4)
    }

    fn number(&mut self, chances: &mut [u16]) -> usize {
        let mut node = 1;
        while node < chances.len() {
            node = node << 1 | self.bit(&mut chances[node]);
        }
        node - chances.len()
    }

    /// The lowest bit first.
    fn reversed(&mut self, chances: &mut [u16], bits: usize) -> usize {
        let (mut node, mut value) = (1, 0);
        for place in 0..bits {
            let is = self.bit(&mut chances[node]);
            node = node << 1 | is;
            value |= is << place;
        }
        value
    }

    fn bit(&mut self, chance: &mut u16) -> usize {
        let before = u32::from(*chance);
        let is = self.read_by(chance);
        self.write(is, (self.width >> 11) * before);
        is
    }

    /// A bit that is written by the odds at this place.
    fn guess(&mut self, chance: &mut u16, place: usize, after_copy: bool) -> usize {
        let is = self.read_by(chance);
        let places = Odds::places(place, after_copy, self.before(1), self.before(2));
        let chance = self.odds.chance(places);
        self.write(is, (self.width >> 12) * u32::from(chance));
        let error = is as f64 - 1.0 + f64::from(chance) / 4096.0;
        for which in places {
            self.odds.learn(which, error);
        }
        is
    }

    fn read_by(&mut self, chance: &mut u16) -> usize {
        let is = self.read((self.range >> 11) * u32::from(*chance));
        *chance = if is == 1 { *chance - (*chance >> 5) } else { *chance + ((2048 - *chance) >> 5) };
        is
    }

    /// Reads a bit that is 0 in this part of the range.
    fn read(&mut self, bound: u32) -> usize {
        let is = self.code >= bound;
        self.range = if is { self.range - bound } else { bound };
        self.code -= if is { bound } else { 0 };
        if self.range < 1 << 24 {
            self.range <<= 8;
            self.next();
        }
        is.into()
    }

    fn next(&mut self) {
        self.code = self.code << 8 | self.from.next().copied().map_or(0, u32::from);
    }

    fn write(&mut self, is: usize, bound: u32) {
        self.width = if is == 1 { self.width - bound } else { bound };
        let (low, carries) = self.low.overflowing_add(if is == 1 { bound } else { 0 });
        self.low = low;
        if carries {
            let above = self.to.iter().rposition(|byte| *byte < 255).unwrap_or_default();
            self.to[above..].iter_mut().for_each(|byte| *byte = byte.wrapping_add(1));
        }
        while self.width < 1 << 24 {
            self.shift();
            self.width <<= 8;
        }
    }

    fn shift(&mut self) {
        self.to.push((self.low >> 24) as u8);
        self.low <<= 8;
    }
}

/// The odds that a bit is 1, as logarithms: at its place alone, after one byte, and after two bytes. Their sum is the prediction. As in
/// `page/src/expand.js`, all numbers are sums and products, so that they are the same in every browser.
struct Odds {
    odds: Vec<f32>,
    rates: Vec<f32>,
    chances: Vec<u16>,
}

impl Odds {
    fn new() -> Self {
        let chances = (0..4096).map(|sum| {
            let odds = (0..10).fold(1.0 + (2048.0 - f64::from(sum)) / 32768.0, |odds, _| odds * odds);
            (1.0 + 4094.0 * odds / (1.0 + odds)) as u16
        });
        Self { odds: vec![0.0; 1 << 19], rates: vec![0.4; 1 << 19], chances: chances.collect() }
    }

    fn places(place: usize, after_copy: bool, last: usize, older: usize) -> [usize; 3] {
        [place, (1 + last) << 5 | place, 1 << 18 | (older << 8 | last) << 2 | place >> 4 << 1 | usize::from(after_copy)]
    }

    /// The chance that a bit is 0, of 4096.
    fn chance(&self, places: [usize; 3]) -> u16 {
        let [alone, one, two] = places.map(|which| f64::from(self.odds[which]));
        self.chances[(2048.0 + 32.0 * (alone + one + two)) as usize & 4095]
    }

    fn learn(&mut self, which: usize, error: f64) {
        let [odds, rate] = [self.odds[which], self.rates[which]].map(f64::from);
        self.odds[which] = (odds + error * rate) as f32;
        self.rates[which] = (rate + 0.15 * (0.1 - rate)) as f32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_packed_smaller_than_by_lzma() {
        let text = include_bytes!("pack.rs");
        let (ours, before) = (packed(text).unwrap().len(), lzma(text).unwrap().len());
        assert!(ours < before, "{ours} bytes, and {before} by LZMA");
    }
}
