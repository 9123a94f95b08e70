//! The vocabulary of a robot of one's own. The core borrows names; they are lent to it for the length of a call.

use goodbot::oomdp::{ActionKind, Attribute, Carrier, Class, ClassId, Proposition, Schema};

/// The names, as owned values. A class is given by its position.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    pub classes: Vec<String>,
    /// The attribute, and the classes that carry it with their prefixes.
    pub attributes: Vec<(String, Vec<(ClassId, String)>)>,
    pub propositions: Vec<(String, Vec<ClassId>)>,
    /// Names and costs.
    pub actions: Vec<(String, u8)>,
}

impl Names {
    /// Lends the names to `call`, in the core's types.
    pub fn lend<T>(&self, call: impl FnOnce(Schema<'_>, &[ActionKind<'_>]) -> T) -> T {
        let classes: Vec<Class<'_>> = self.classes.iter().map(|name| Class { name }).collect();
        let carriers: Vec<Vec<Carrier<'_>>> = self.attributes.iter().map(|(_, carriers)| carried(carriers)).collect();
        let attributes: Vec<Attribute<'_>> =
            self.attributes.iter().zip(&carriers).map(|((name, _), carriers)| Attribute { name, carriers }).collect();
        let propositions: Vec<Proposition<'_>> =
            self.propositions.iter().map(|(name, parameters)| Proposition { name, parameters }).collect();
        let actions: Vec<ActionKind<'_>> = self.actions.iter().map(|&(ref name, cost)| ActionKind { name, cost }).collect();
        call(Schema { classes: &classes, attributes: &attributes, propositions: &propositions }, &actions)
    }
}

fn carried(carriers: &[(ClassId, String)]) -> Vec<Carrier<'_>> {
    carriers.iter().map(|&(class, ref prefix)| Carrier { class, prefix }).collect()
}
