//! Facts about earlier commands in a world without a robot. Words such as "it", "again", "back" and "undo" are learned for these facts, as
//! for those of a home's [conversation](goodbot::talk::Conversation).
//!
//! | fact | holds for | meaning |
//! |---|---|---|
//! | `namedLast` | an object | the last task named it |
//! | `removedLast` | an object | the last task with the proposition `removed` named it |
//! | `numberAsLast` | an object | it has the `number` of an object of its class that the last task named |
//! | `step2` | an object or a proposition | it was in the second task |
//! | `wasThereBefore` | an argument | another argument was last in a fact with it |
//! | `addedAfterRemoved` | the proposition `added` | the last task had the proposition `removed` |

use super::token;
use goodbot_formats::task_text::GroundAtomText;
use goodbot_formats::world::{CommandRecord, ObjectOfWorld, WorldFile};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The steps that have a number.
const NUMBERED: usize = 9;
/// The steps that are remembered: the last ones.
const MOST: usize = 100;

/// An earlier command of a conversation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Its position in its conversation, from 1 on.
    number: usize,
    world: Arc<WorldFile>,
    facts: Vec<GroundAtomText>,
    intended: Vec<GroundAtomText>,
}

/// The steps of a conversation, with one more. Only the last hundred are kept.
pub fn after(before: &[Arc<Step>], world: &Arc<WorldFile>, command: &CommandRecord) -> Vec<Arc<Step>> {
    let facts = command.facts.as_ref().unwrap_or(&world.facts).clone();
    let number = before.last().map_or(1, |step| step.number + 1);
    let step = Step { number, world: Arc::clone(world), facts, intended: command.intended.clone() };
    before.iter().skip((before.len() + 1).saturating_sub(MOST)).cloned().chain([Arc::new(step)]).collect()
}

impl Step {
    fn names(&self, object: &str) -> bool {
        self.intended.iter().any(|atom| has(atom, object))
    }

    fn is_of(&self, proposition: &str) -> bool {
        self.intended.iter().any(|atom| atom.function() == proposition)
    }

    fn numbered(&self) -> Option<String> {
        (self.number <= NUMBERED).then(|| format!("step{}", self.number))
    }
}

fn has(atom: &GroundAtomText, object: &str) -> bool {
    atom.arguments().iter().any(|argument| argument == object)
}

/// The facts that hold for an object.
pub(super) fn of_object(before: &[Arc<Step>], object: &ObjectOfWorld) -> BTreeSet<String> {
    let mut told: BTreeSet<String> = before.iter().filter(|step| step.names(&object.name)).filter_map(|step| step.numbered()).collect();
    let propositions: BTreeSet<&str> = before.iter().flat_map(|step| &step.intended).map(GroundAtomText::function).collect();
    let is_last = |proposition: &&str| before.iter().rfind(|step| step.is_of(proposition)).is_some_and(|step| step.names(&object.name));
    told.extend(propositions.into_iter().filter(is_last).map(|proposition| token(proposition, "last")));
    let Some(last) = before.last() else { return told };
    told.extend(last.names(&object.name).then(|| token("named", "last")));
    let named = last.world.objects.iter().filter(|named| named.class == object.class && last.names(&named.name));
    let alike = named.flat_map(|named| &named.attributes).filter(|value| object.attributes.contains(value));
    told.extend(alike.map(|(attribute, _)| token(attribute, "asLast")));
    told
}

/// The facts that hold for a task's proposition.
pub(super) fn of_proposition(before: &[Arc<Step>], proposition: &str) -> BTreeSet<String> {
    let last = before.last().into_iter().flat_map(|step| &step.intended);
    let after = last.map(|atom| token(&token(proposition, "after"), atom.function()));
    before.iter().filter(|step| step.is_of(proposition)).filter_map(|step| step.numbered()).chain(after).collect()
}

/// The fact that another argument of the proposition was last in a fact with this one.
pub(super) fn of_argument(before: &[Arc<Step>], atom: &GroundAtomText, argument: &str) -> Option<String> {
    let mut others = atom.arguments().iter().filter(|other| *other != argument);
    let is_there = others.any(|other| {
        let with = |step: &'_ Arc<Step>, object: &str| {
            step.facts.iter().any(|fact| has(fact, other) && fact.arguments().len() > 1 && has(fact, object))
        };
        before.iter().rfind(|step| with(step, other)).is_some_and(|step| with(step, argument))
    });
    is_there.then(|| token("was", "thereBefore"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::meanings;
    use goodbot_formats::world::{Line, WorldReader};

    /// A row of figures, from which the second is taken out. The other is then asked for.
    const LOG: &str = r#"
{"type":"world","name":"row","classes":["figure","place","out"],"attributes":{"number":["figure","place"]},"propositions":{"removed":["figure"],"added":["place","out"],"at":["figure","place"]},"objects":[{"name":"a","class":"figure","attributes":{"number":"1"}},{"name":"b","class":"figure","attributes":{"number":"2"}},{"name":"p1","class":"place"},{"name":"p2","class":"place"}],"facts":["at(a,p1)","at(b,p2)"],"task_kinds":["removed(?f)","added(?p,?o)"]}
{"type":"command","world":"row","id":"1","command":"remove the second","intended":["removed(b)"]}
{"type":"world","name":"rest","classes":["figure","place","out"],"attributes":{"number":["figure","place"]},"propositions":{"removed":["figure"],"added":["place","out"],"at":["figure","place"]},"objects":[{"name":"a","class":"figure","attributes":{"number":"2"}},{"name":"b","class":"out"},{"name":"p1","class":"place"},{"name":"p2","class":"place"}],"facts":["at(a,p1)"],"task_kinds":["removed(?f)","added(?p,?o)"]}
"#;

    #[test]
    fn each_fact_is_told_of_what_it_holds_of_and_of_nothing_else() {
        let lines: Vec<Line> = WorldReader::new(LOG.as_bytes()).collect::<Result<_, _>>().unwrap();
        let [Line::World(row), Line::Command(command), Line::World(rest)] = lines.as_slice() else { panic!("two worlds") };
        let before = after(&[], row, command);
        let told = |task: &str, fact: &str| {
            let all = meanings(rest, &rest.facts, &before).unwrap();
            let task = all.iter().find(|it| it.name.to_string() == task).unwrap();
            task.description.iter().any(|token| token == fact)
        };
        let [again, back, elsewhere] = ["removed(a)", "added(p2,b)", "added(p1,b)"];
        for (fact, of) in [
            ("namedLast", [false, true, true]),
            ("removedLast", [false, true, true]),
            ("numberAsLast", [true, false, false]),
            ("step1", [true, true, true]),
            ("wasThereBefore", [false, true, false]),
            ("addedAfterRemoved", [false, true, true]),
            ("removedAfterRemoved", [true, false, false]),
        ] {
            assert_eq!([again, back, elsewhere].map(|task| told(task, fact)), of, "{fact}");
        }
    }

    #[test]
    fn a_description_without_room_for_all_facts_has_none() {
        let lines: Vec<Line> = WorldReader::new(LOG.as_bytes()).collect::<Result<_, _>>().unwrap();
        let [Line::World(row), Line::Command(command), ..] = lines.as_slice() else { panic!("a world and a command") };
        let mut crowded = WorldFile::clone(row);
        // Each value is a token, with a marker before each sort.
        crowded.attributes = (0..25).map(|number| (format!("a{number}"), vec!["figure".to_owned()])).collect();
        let values =
            |object: &mut ObjectOfWorld| object.attributes = (0..49).map(|number| (format!("a{number}"), "v".to_owned())).collect();
        crowded.objects.iter_mut().for_each(values);
        let before = (0..20).fold(vec![], |before, _| after(&before, row, command));
        let is_same = |(with, alone): (crate::world::Meaning, crate::world::Meaning)| with.description == alone.description;
        let (with, alone) = (meanings(&crowded, &[], &before).unwrap(), meanings(&crowded, &[], &[]).unwrap());
        let same = with.into_iter().zip(alone).filter(|(with, _)| with.name.to_string() == "removed(b)").all(is_same);
        assert!(same);
    }
}
