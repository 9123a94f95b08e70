//! Inputs without a fuzzer: the stored corpus, and random changes of it.

use rand_core::Rng;
use rand_pcg::Pcg32;
use std::path::PathBuf;

/// The stored inputs of a target, in the order of their names.
pub fn corpus(target: &str) -> Vec<Vec<u8>> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(target);
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).expect("the corpus is there").map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files.iter().map(|file| std::fs::read(file).unwrap()).collect()
}

fn below(count: usize, random: &mut Pcg32) -> usize {
    random.next_u32() as usize % count.max(1)
}

/// An input of the corpus with random changes, or random bytes.
pub fn made(corpus: &[Vec<u8>], random: &mut Pcg32) -> Vec<u8> {
    let mut input = match below(4, random) {
        0 => (0..below(300, random)).map(|_| random.next_u32() as u8).collect(),
        _ => corpus[below(corpus.len(), random)].clone(),
    };
    for _ in 0..below(6, random) {
        let at = below(input.len() + 1, random);
        match below(6, random) {
            0 => input.truncate(at),
            1 => input.insert(at, random.next_u32() as u8),
            2 if at < input.len() => drop(input.remove(at)),
            3 if at < input.len() => input[at] ^= 1 << below(8, random),
            4 if at < input.len() => input[at] = [0, 1, 0x7f, 0x80, 0xff, b'"', b'{', b'9', b' '][below(9, random)],
            _ => {
                let other = &corpus[below(corpus.len(), random)];
                let from = below(other.len() + 1, random);
                let to = (from + below(40, random)).min(other.len());
                input.splice(at..at, other[from..to].iter().copied());
            }
        }
    }
    input
}
