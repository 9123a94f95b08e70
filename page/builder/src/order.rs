//! Puts the functions of a module into an order that packs well: the packer predicts bytes from similar bytes shortly before, so similar
//! functions should be neighbours.

use std::collections::BTreeMap;
use std::convert::Infallible;

use anyhow::Result;
use wasm_encoder::reencode::{Error, Reencode, utils};
use wasm_encoder::{CodeSection, FunctionSection, Module};
use wasmparser::{CodeSectionReader, CustomSectionReader, FunctionBody, FunctionSectionReader, Parser, Payload, TypeRef};

/// A function is compared with this many bytes before it.
const WINDOW: usize = 1_000;
/// Runs of this many bytes are compared.
const RUN: usize = 5;
/// A run in more functions than this is left out.
const COMMON: usize = 1_000;

/// The same module with its functions in another order.
pub fn neighbours(module: &[u8]) -> Result<Vec<u8>> {
    let (mut imported, mut bodies) = (0, Vec::new());
    for payload in Parser::new(0).parse_all(module) {
        match payload? {
            Payload::ImportSection(section) => {
                for import in section.into_imports() {
                    imported += u32::from(matches!(import?.ty, TypeRef::Func(_)));
                }
            }
            Payload::CodeSectionEntry(body) => bodies.push(body.as_bytes()),
            _ => {}
        }
    }
    let order = order(&bodies);
    let mut places = vec![0; order.len()];
    for (place, function) in (0..).zip(&order) {
        places[*function] = place;
    }
    let mut ordered = Module::new();
    Ordering { imported, order, places }.parse_core_module(&mut ordered, Parser::new(0), module).map_err(anyhow::Error::from)?;
    Ok(ordered.finish())
}

/// Writes a module with its own functions in another order. The imported ones come before them and keep their numbers.
struct Ordering {
    imported: u32,
    /// For each place, its function.
    order: Vec<usize>,
    /// For each function, its place.
    places: Vec<u32>,
}

impl Reencode for Ordering {
    type Error = Infallible;

    fn function_index(&mut self, function: u32) -> Result<u32, Error<Infallible>> {
        let own = function.checked_sub(self.imported);
        Ok(own.map_or(function, |own| self.imported + self.places[own as usize]))
    }

    /// Left out: browsers do not need custom sections.
    fn parse_custom_section(&mut self, _: &mut Module, _: CustomSectionReader<'_>) -> Result<(), Error<Infallible>> {
        Ok(())
    }

    fn parse_function_section(
        &mut self,
        functions: &mut FunctionSection,
        section: FunctionSectionReader<'_>,
    ) -> Result<(), Error<Infallible>> {
        let types = section.into_iter().collect::<Result<Vec<_>, _>>()?;
        for function in self.order.clone() {
            functions.function(self.type_index(types[function])?);
        }
        Ok(())
    }

    fn parse_code_section(&mut self, code: &mut CodeSection, section: CodeSectionReader<'_>) -> Result<(), Error<Infallible>> {
        let bodies: Vec<FunctionBody<'_>> = section.into_iter().collect::<Result<_, _>>()?;
        for function in self.order.clone() {
            utils::parse_function_body(self, code, bodies[function].clone())?;
        }
        Ok(())
    }
}

/// Puts after each function the one that has most in common with those in the window, for its length. The longest is the first.
fn order(bodies: &[&[u8]]) -> Vec<usize> {
    let mut with: BTreeMap<&[u8], Vec<usize>> = BTreeMap::new();
    for (function, body) in bodies.iter().enumerate() {
        for run in body.windows(RUN) {
            let functions = with.entry(run).or_default();
            if functions.last() != Some(&function) {
                functions.push(function);
            }
        }
    }
    with.retain(|_, functions| (2..=COMMON).contains(&functions.len()));
    let mut runs = vec![Vec::new(); bodies.len()];
    for (run, functions) in with.values().enumerate() {
        for function in functions {
            runs[*function].push(run);
        }
    }
    let with: Vec<Vec<usize>> = with.into_values().collect();
    // For each run, how often it is in the window; for each function, how much it has in common with the window.
    let (mut there, mut common) = (vec![0_u32; with.len()], vec![0_f64; bodies.len()]);
    let count = |run: usize, sign: f64, common: &mut [f64]| {
        let worth = sign / (with[run].len() as f64).powf(0.3);
        with[run].iter().for_each(|function| common[*function] += worth);
    };
    let (mut order, mut left): (Vec<usize>, Vec<usize>) = (Vec::new(), (0..bodies.len()).collect());
    let (mut begin, mut size) = (0, 0);
    while !left.is_empty() {
        let fitness = |function: usize| {
            let length = bodies[function].len() as f64;
            if order.is_empty() { length } else { common[function] / length }
        };
        let best = (0..left.len()).max_by(|&a, &b| fitness(left[a]).total_cmp(&fitness(left[b]))).unwrap_or_default();
        let next = left.remove(best);
        order.push(next);
        size += bodies[next].len();
        for run in &runs[next] {
            there[*run] += 1;
            if there[*run] == 1 {
                count(*run, 1.0, &mut common);
            }
        }
        while size > WINDOW && begin + 1 < order.len() {
            let gone = order[begin];
            begin += 1;
            size -= bodies[gone].len();
            for run in &runs[gone] {
                there[*run] -= 1;
                if there[*run] == 0 {
                    count(*run, -1.0, &mut common);
                }
            }
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_that_are_alike_become_neighbours() {
        let [long, one, other, alike] = [&b"0123456789abcdefghijkl"[..], b"qrstuvwxyz", b"ABCDEFGHIJ", b"0123456789abc"];
        let order = order(&[one, long, other, alike]);
        assert_eq!(order[..2], [1, 3]);
        assert_eq!(order.len(), 4);
    }
}
