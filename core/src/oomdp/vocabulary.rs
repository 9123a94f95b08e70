//! The digest of a domain's vocabulary: robots with the same vocabulary can share training data.

use super::Schema;
use crate::checksum::Running;

/// A digest of the domain's vocabulary: its propositional functions with their classes, and its attributes with their carriers. Never 0,
/// which means no domain.
pub fn digest(schema: &Schema<'_>) -> u32 {
    digest_of(schema, schema.propositions.len(), schema.attributes.len())
}

/// The number of attributes of an earlier version of this vocabulary, which has its first propositional functions and first attributes, so
/// that their positions in a model mean what they meant; `None` if it has no version of this digest.
pub fn continued(schema: &Schema<'_>, earlier: u32) -> Option<usize> {
    (0..=schema.attributes.len())
        .find(|&attributes| (1..=schema.propositions.len()).any(|propositions| digest_of(schema, propositions, attributes) == earlier))
}

/// The digest of the first propositional functions and attributes.
fn digest_of(schema: &Schema<'_>, propositions: usize, attributes: usize) -> u32 {
    let mut digest = Running::new();
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
    digest.value().max(1)
}

/// Adds a name and its end to the digest. Not inlined, because it has many callers.
#[inline(never)]
fn take(digest: &mut Running, text: &str) {
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

    #[test]
    fn a_vocabulary_continues_one_with_less_at_its_end() {
        let earlier = Schema { propositions: &SCHEMA.propositions[..1], attributes: &SCHEMA.attributes[..1], ..SCHEMA };
        assert_eq!((continued(&SCHEMA, digest(&earlier)), continued(&SCHEMA, digest(&SCHEMA))), (Some(1), Some(2)));
        assert_eq!(continued(&earlier, digest(&SCHEMA)), None, "an older version does not know the rest");
        assert_eq!(continued(&SCHEMA, digest(&Schema { propositions: &SCHEMA.propositions[1..], ..SCHEMA })), None, "positions moved");
        assert_eq!(continued(&SCHEMA, 0), None);
    }
}
