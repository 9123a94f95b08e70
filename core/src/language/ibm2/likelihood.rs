//! Pr(e|m), exactly: the product over the words of the sum over the tokens, NULL included, of a(j|i,l,n) t(e_i|m_j).

use crate::language::tables::TablesRef;
use crate::probability::Scaled;
use crate::symbols::Symbol;

/// Pr(e|m) of an English command given a machine command, times Pr(n|l) if `length`; 1 for an untrained model. A word that the model was
/// not trained on is skipped: it counts for the length and for the positions of other words, but has no factor.
pub(crate) fn likelihood(tables: TablesRef<'_>, sentence: &[Option<Symbol>], command: &[Symbol], length: bool) -> Scaled {
    let width = command.len().saturating_add(1);
    let uniform = 1.0 / width as f32;
    let table = tables.alignment_table(command.len(), sentence.len());
    let mut product = Scaled::ONE;
    for (i, word) in sentence.iter().enumerate() {
        let Some(word) = word.filter(|word| word.index() < tables.words()) else { continue };
        let sum = match table {
            Some(table) => {
                let start = i.saturating_mul(width);
                let row = table.get(start..start.saturating_add(width)).unwrap_or(&[]);
                explained(tables, word, command, row.iter().copied())
            }
            None => explained(tables, word, command, core::iter::repeat_n(uniform, width)),
        };
        product = product.scaled_by(sum);
    }
    if length { product.scaled_by(length_likelihood(tables, command.len(), sentence.len())) } else { product }
}

/// The sum over the tokens, NULL first, of the token's alignment probability times the probability that it translates into a known word.
#[inline]
fn explained(tables: TablesRef<'_>, word: Symbol, command: &[Symbol], mut alignments: impl Iterator<Item = f32>) -> f32 {
    let (column, null) = (tables.column(word), alignments.next().unwrap_or(0.0));
    let of_null = null * column.translation(0);
    command
        .iter()
        .zip(alignments)
        .fold(of_null, |sum, (&token, alignment)| sum + alignment * column.translation(TablesRef::row(Some(token))))
}

/// Pr(n|l): the share, by weight, of this English length among the training pairs of this machine length; 0 for lengths never seen
/// together, 1 for an untrained model.
fn length_likelihood(tables: TablesRef<'_>, machine: usize, english: usize) -> f32 {
    if tables.words() == 0 {
        return 1.0;
    }
    let of_machine = || tables.length_pairs().iter().filter(|pair| usize::from(pair.machine) == machine);
    let whole: f32 = of_machine().map(|pair| pair.weight).sum();
    let part: f32 = of_machine().filter(|pair| usize::from(pair.english) == english).map(|pair| pair.weight).sum();
    if whole > 0.0 { part / whole } else { 0.0 }
}
