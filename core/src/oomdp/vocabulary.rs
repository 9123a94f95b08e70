//! The digest of a domain's vocabulary: robots with the same vocabulary can share training data.

use super::Schema;
use crate::checksum::{CHECK, Check};

/// A digest of the domain's vocabulary: its propositional functions with their classes, and its attributes with their carriers. Never 0,
/// which means no domain.
pub fn digest(schema: &Schema<'_>) -> u32 {
    digest_of(schema, schema.propositions.len(), schema.attributes.len())
}

/// Whether a digest is that of an earlier version of this vocabulary: of its first propositional functions and its first attributes, so that
/// every position in a model means what it meant.
#[cfg(feature = "snapshot")]
pub fn continues(schema: &Schema<'_>, earlier: u32) -> bool {
    (1..=schema.propositions.len())
        .any(|propositions| (0..=schema.attributes.len()).any(|attributes| digest_of(schema, propositions, attributes) == earlier))
}

/// The digest of the first propositional functions and attributes.
fn digest_of(schema: &Schema<'_>, propositions: usize, attributes: usize) -> u32 {
    let mut digest = CHECK.digest();
    let mut name = |text: &str| take(&mut digest, text);
    for proposition in schema.propositions.iter().take(propositions) {
        name(proposition.name);
        for &class in proposition.parameters {
            name(schema.class_name(class));
        }
        name("");
    }
    for attribute in schema.attributes.iter().take(attributes) {
        name(attribute.name);
        for carrier in attribute.carriers {
            name(carrier.prefix);
            name(schema.class_name(carrier.class));
        }
        name("");
    }
    digest.finalize().max(1)
}

/// Adds a name and its end to the digest. Not inlined, because it has many callers.
#[inline(never)]
fn take(digest: &mut Check, text: &str) {
    digest.update(text.as_bytes());
    digest.update(&[0]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::home::SCHEMA;
    use crate::oomdp::Proposition;

    #[test]
    fn another_propositional_function_is_another_vocabulary() {
        let fewer: &[Proposition<'_>] = &SCHEMA.propositions[1..];
        assert_ne!(digest(&SCHEMA), digest(&Schema { propositions: fewer, ..SCHEMA }));
        assert_ne!(digest(&SCHEMA), digest(&Schema { attributes: &[], ..SCHEMA }));
    }

    #[cfg(feature = "snapshot")]
    #[test]
    fn a_vocabulary_continues_one_with_less_at_its_end() {
        let earlier = Schema { propositions: &SCHEMA.propositions[..1], attributes: &SCHEMA.attributes[..1], ..SCHEMA };
        assert!(continues(&SCHEMA, digest(&earlier)) && continues(&SCHEMA, digest(&SCHEMA)));
        assert!(!continues(&earlier, digest(&SCHEMA)), "an older version does not know the rest");
        assert!(!continues(&SCHEMA, digest(&Schema { propositions: &SCHEMA.propositions[1..], ..SCHEMA })), "positions moved");
        assert!(!continues(&SCHEMA, 0));
    }
}
