//! The order of a module's functions: similar ones stand near each other, because packing looks only 32 kilobytes back.

use std::collections::{HashMap, VecDeque};

use anyhow::{Context, Result, ensure};

/// What functions share: so many bytes in a row.
const PIECE: usize = 5;
/// A piece in more functions than this tells nothing about any.
const MOST_FUNCTIONS: usize = 400;
/// The next function is to resemble those in so many bytes before it.
const NEAR: usize = 10_000;
/// Counts as pieces that a function shares with none: otherwise the shortest would always come first.
const UNSHARED: usize = 50;

/// The module with names for its functions: sorted by these, similar ones stand near each other.
pub fn named(module: &[u8]) -> Result<Vec<u8>> {
    let (imports, bodies) = functions(module).context("the module's functions cannot be read")?;
    let mut names = number(bodies.len());
    let mut rank = vec![0; bodies.len()];
    order(&bodies).into_iter().enumerate().for_each(|(at, function)| rank[function] = at);
    for (at, rank) in rank.into_iter().enumerate() {
        names.extend(number(imports + at));
        names.extend(text(&format!("{rank:05}")));
    }
    let contents = [text("name"), vec![1], number(names.len()), names].concat();
    Ok([module, &[0], &number(contents.len()), &contents].concat())
}

/// The positions of the functions, each after those that it resembles most.
fn order(bodies: &[&[u8]]) -> Vec<usize> {
    let (mut having, mut sizes) = (HashMap::<&[u8], Vec<usize>>::new(), vec![UNSHARED; bodies.len()]);
    for (at, body) in bodies.iter().enumerate() {
        for piece in body.windows(PIECE) {
            let functions = having.entry(piece).or_default();
            if functions.last() != Some(&at) {
                functions.push(at);
                sizes[at] += 1;
            }
        }
    }
    let mut shared: Vec<(&[u8], Vec<usize>)> =
        having.into_iter().filter(|(_, having)| (2..MOST_FUNCTIONS).contains(&having.len())).collect();
    // In any fixed order: the sums below then have the same last bit each time.
    shared.sort();
    let mut pieces = vec![Vec::new(); bodies.len()];
    for (piece, (_, functions)) in shared.iter().enumerate() {
        functions.iter().for_each(|&at| pieces[at].push(piece));
    }
    // How many functions nearby have a piece, and what a function shares with those nearby.
    let (mut near, mut shares) = (vec![0; shared.len()], vec![0.0; bodies.len()]);
    let mut change = |shares: &mut [f64], function: usize, comes: bool| {
        for &piece in &pieces[function] {
            let functions = &shared[piece].1;
            near[piece] = if comes { near[piece] + 1 } else { near[piece] - 1 };
            if near[piece] == usize::from(comes) {
                let share = (functions.len() as f64).sqrt().recip();
                functions.iter().for_each(|&at| shares[at] += if comes { share } else { -share });
            }
        }
    };
    let (mut left, mut ordered) = ((0..bodies.len()).collect::<Vec<_>>(), Vec::new());
    let (mut nearby, mut bytes) = (VecDeque::new(), 0);
    let likeness = |shares: &[f64], at: usize| shares[at] / sizes[at] as f64;
    while let Some(next) =
        (0..left.len()).rev().max_by(|&one, &other| likeness(&shares, left[one]).total_cmp(&likeness(&shares, left[other])))
    {
        let function = left.remove(next);
        ordered.push(function);
        nearby.push_back(function);
        bytes += bodies[function].len();
        change(&mut shares, function, true);
        while bytes > NEAR && nearby.len() > 1 {
            let Some(gone) = nearby.pop_front() else { break };
            bytes -= bodies[gone].len();
            change(&mut shares, gone, false);
        }
    }
    ordered
}

/// How many functions a module imports, and the bodies of its own.
fn functions(module: &[u8]) -> Result<(usize, Vec<&[u8]>)> {
    let mut sections = Reader(module.get(8..).context("it is too short")?);
    let (mut imports, mut bodies) = (0, Vec::new());
    while !sections.0.is_empty() {
        let kind = sections.bytes(1)?[0];
        let length = sections.number()?;
        let mut section = Reader(sections.bytes(length)?);
        match kind {
            2 => {
                imports = section.number()?;
                for _ in 0..imports {
                    for _ in 0..2 {
                        let length = section.number()?;
                        section.bytes(length)?;
                    }
                    ensure!(section.bytes(1)?[0] == 0, "it imports more than functions");
                    section.number()?;
                }
            }
            10 => {
                for _ in 0..section.number()? {
                    let length = section.number()?;
                    bodies.push(section.bytes(length)?);
                }
            }
            _ => {}
        }
    }
    Ok((imports, bodies))
}

/// The rest of a module.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn bytes(&mut self, count: usize) -> Result<&'a [u8]> {
        let (bytes, rest) = self.0.split_at_checked(count).context("it ends too soon")?;
        self.0 = rest;
        Ok(bytes)
    }

    /// A number, seven bits a byte, the lowest first.
    fn number(&mut self) -> Result<usize> {
        let length = 1 + self.0.iter().take_while(|byte| **byte >= 128).count();
        ensure!(length <= 5, "a number is too large");
        Ok(self.bytes(length)?.iter().rev().fold(0, |number, byte| number << 7 | usize::from(byte & 127)))
    }
}

/// A number as [`Reader::number`] reads it.
fn number(mut number: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    while number > 127 {
        bytes.push(number as u8 | 128);
        number >>= 7;
    }
    bytes.push(number as u8);
    bytes
}

fn text(text: &str) -> Vec<u8> {
    [&number(text.len()), text.as_bytes()].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn similar_functions_stand_together() {
        let [one, other]: [Vec<u8>; 2] = [(0..40).collect(), (100..140).collect()];
        let bodies = [&one[..], &other[..], &one[1..], &other[1..]];
        assert_eq!(order(&bodies), [0, 2, 1, 3]);
    }

    #[test]
    fn each_function_of_a_module_gets_a_name() {
        // Two functions without parameters or results, which do nothing.
        let module = [&b"\0asm\x01\0\0\0"[..], &[1, 4, 1, 0x60, 0, 0], &[3, 3, 2, 0, 0], &[10, 7, 2, 2, 0, 0x0b, 2, 0, 0x0b]].concat();
        let named = named(&module).unwrap();
        assert_eq!(named.strip_prefix(&module[..]).unwrap(), b"\x00\x16\x04name\x01\x0f\x02\x00\x0500000\x01\x0500001");
    }

    #[test]
    fn a_module_that_ends_too_soon_is_refused() {
        assert!(named(b"\0asm\x01\0\0\0\x0a\x07\x02").is_err());
    }
}
