//! Pr(e|m), exactly: the product over the words of the sum over the tokens, NULL included, of a(j|i,l,n) t(e_i|m_j).

use super::tables::Tables;
use crate::probability::Scaled;
use crate::symbols::Symbol;

/// Pr(e|m) of an English command given a machine command; 1 for an untrained model. A word that the model was not trained on is skipped:
/// it keeps its place in the sentence and says nothing.
pub fn likelihood(tables: &Tables<'_>, sentence: &[Option<Symbol>], command: &[Symbol]) -> Scaled {
    let (machine, english) = (command.len(), sentence.len());
    let width = machine.saturating_add(1);
    let uniform = 1.0 / width as f32;
    let table = tables.alignment_table(machine, english);
    let mut product = Scaled::ONE;
    for (i, word) in sentence.iter().enumerate() {
        let Some(word) = word.filter(|word| word.index() < tables.words()) else { continue };
        let row = table.and_then(|table| table.get(i.saturating_mul(width)..)).unwrap_or(&[]);
        let mut sum = 0.0;
        for (j, token) in core::iter::once(None).chain(command.iter().copied().map(Some)).enumerate() {
            let alignment = if table.is_some() { row.get(j).copied().unwrap_or(0.0) } else { uniform };
            sum += alignment * tables.translation(word, token);
        }
        product = product.scaled_by(sum);
    }
    product
}

/// Pr(n|l): the weighted share of the English length among the data of this machine length; 0 for lengths never seen together, 1 for an
/// untrained model.
pub fn length_likelihood(tables: &Tables<'_>, machine: usize, english: usize) -> f32 {
    if tables.words() == 0 {
        return 1.0;
    }
    let of_machine = || tables.length_pairs().iter().filter(|pair| usize::from(pair.machine) == machine);
    let whole: f32 = of_machine().map(|pair| pair.weight).sum();
    let part: f32 = of_machine().filter(|pair| usize::from(pair.english) == english).map(|pair| pair.weight).sum();
    if whole > 0.0 { part / whole } else { 0.0 }
}
