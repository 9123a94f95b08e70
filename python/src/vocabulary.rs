//! What a robot of one's own speaks of, as the core wants it: slices that live as long as the domain.
//!
//! Each vocabulary is made once and kept for the life of the process. A program speaks of few, however many robots it makes.

use goodbot::oomdp::{ActionKind, Attribute, Carrier, Class, ClassId, Proposition, Schema};
use std::collections::HashMap;
use std::sync::{LazyLock, Mutex, PoisonError};

/// The names, in plain values. A class is told by its position.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Names {
    pub classes: Vec<String>,
    /// The attribute, and the classes that carry it with their prefixes.
    pub attributes: Vec<(String, Vec<(u8, String)>)>,
    pub propositions: Vec<(String, Vec<u8>)>,
    /// Names and costs.
    pub actions: Vec<(String, u8)>,
}

/// The same, as the core has it.
#[derive(Debug)]
pub struct Vocabulary {
    pub schema: Schema<'static>,
    pub actions: &'static [ActionKind<'static>],
}

static KNOWN: LazyLock<Mutex<HashMap<Names, &'static Vocabulary>>> = LazyLock::new(Mutex::default);

impl Names {
    /// The vocabulary of these names.
    pub fn vocabulary(&self) -> &'static Vocabulary {
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(vocabulary) = known.get(self) {
            return vocabulary;
        }
        let vocabulary = Box::leak(Box::new(self.leaked()));
        known.insert(self.clone(), vocabulary);
        vocabulary
    }

    fn leaked(&self) -> Vocabulary {
        let carrier = |(class, prefix): &(u8, String)| Carrier { class: ClassId(*class), prefix: text(prefix) };
        let attribute = |(name, carriers): &(String, Vec<_>)| Attribute { name: text(name), carriers: list(carriers.iter().map(carrier)) };
        let proposition = |(name, parameters): &(String, Vec<u8>)| Proposition {
            name: text(name),
            parameters: list(parameters.iter().map(|&class| ClassId(class))),
        };
        Vocabulary {
            schema: Schema {
                classes: list(self.classes.iter().map(|name| Class { name: text(name) })),
                attributes: list(self.attributes.iter().map(attribute)),
                propositions: list(self.propositions.iter().map(proposition)),
            },
            actions: list(self.actions.iter().map(|(name, cost)| ActionKind { name: text(name), cost: *cost })),
        }
    }
}

fn text(text: &str) -> &'static str {
    Box::leak(text.to_owned().into_boxed_str())
}

fn list<T>(items: impl Iterator<Item = T>) -> &'static [T] {
    Box::leak(items.collect())
}
