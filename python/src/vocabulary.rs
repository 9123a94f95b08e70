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
    /// Classes below others, each with the one above it.
    pub parents: Vec<(ClassId, ClassId)>,
    /// The classes of each proposition's arguments, of which `propositions` has the core's.
    pub wanted: Vec<Vec<ClassId>>,
}

impl Names {
    /// A class and those above it, the nearest first.
    fn and_above(&self, class: ClassId) -> impl Iterator<Item = ClassId> {
        std::iter::successors(Some(class), |class| self.parents.iter().find(|(below, _)| below == class).map(|&(_, above)| above))
    }

    /// Whether a class is another one, or below it.
    pub fn is_a(&self, class: ClassId, above: ClassId) -> bool {
        self.and_above(class).any(|known| known == above)
    }

    /// The core's class of a class. The core knows no classes above others: all below a class that an argument is of are one.
    pub fn of_core(&self, class: ClassId) -> ClassId {
        self.and_above(class).filter(|class| self.wanted.iter().any(|classes| classes.contains(class))).last().unwrap_or(class)
    }

    /// Gives the propositions and attributes the core's classes.
    pub fn settle(&mut self) {
        self.wanted = self.propositions.iter().map(|(_, classes)| classes.clone()).collect();
        let classes = || (0..self.classes.len()).map(|position| ClassId::new(position as u8));
        let propositions = self.wanted.iter().map(|classes| classes.iter().map(|&class| self.of_core(class)).collect()).collect::<Vec<_>>();
        let carried = |carriers: &Vec<(ClassId, String)>| {
            let mut all: Vec<(ClassId, String)> = Vec::new();
            for (above, prefix) in carriers {
                for class in classes().filter(|&class| self.is_a(class, *above)).map(|class| self.of_core(class)) {
                    if all.iter().all(|(known, _)| *known != class) {
                        all.push((class, prefix.clone()));
                    }
                }
            }
            all
        };
        let attributes = self.attributes.iter().map(|(_, carriers)| carried(carriers)).collect::<Vec<_>>();
        self.propositions.iter_mut().zip(propositions).for_each(|((_, known), classes)| *known = classes);
        self.attributes.iter_mut().zip(attributes).for_each(|((_, known), carriers)| *known = carriers);
    }

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
