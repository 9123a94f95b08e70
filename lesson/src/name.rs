//! A grounded task as a text.

use goodbot::home::{AGENT, COLOR, Home, SHAPE};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Domain, GroundProposition, ObjectId};
use goodbot::task::{GroundedTask, LiftedTask, Part, Piece, Way, Wording};
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText, TaskTextError, WayText};

/// The text of a task: `blockInRoom(block0,room1)`. `lifted` is the task that it grounds.
///
/// # Errors
/// A [`TaskTextError`] where a name could not be read again; names from files always can.
pub fn task_name<D: Domain + ?Sized>(domain: &D, lifted: &LiftedTask, task: &GroundedTask) -> Result<GroundTaskText, TaskTextError> {
    let schema = domain.world().schema;
    let atom = |part: GroundProposition| {
        let parameters = schema.parameters(part.proposition).len();
        let names = part.arguments.iter().take(parameters).map(|&object| domain.world().objects.name(object));
        GroundAtomText::new(schema.proposition_name(part.proposition), names)
    };
    let signed = |part| atom(part).map(|atom| if task.is_negated() { atom.negated() } else { atom });
    let goal = task.propositions(lifted).map(signed).collect::<Result<_, _>>()?;
    let mut way = WayText::default();
    let place = |lists: &mut Vec<Vec<GroundAtomText>>, position: u8, atom| {
        let position = usize::from(position);
        lists.resize(lists.len().max(position + 1), vec![]);
        lists[position].push(atom);
    };
    for (part, proposition) in Way::of(task, lifted).parts() {
        let atom = atom(proposition)?;
        match part {
            Part::Goal => {}
            Part::Before(position) => place(&mut way.before, position, atom),
            Part::Through(position) => place(&mut way.through, position, atom),
            Part::Avoiding => way.avoiding.push(atom),
        }
    }
    GroundTaskText::with_way(goal, way)
}

/// A task in a person's words: `go to the green room`, `take the blue chair to the red room`.
pub fn in_words(home: &Home<impl HomeMemory>, lifted: &LiftedTask, task: &GroundedTask) -> String {
    let part = |part: GroundProposition| {
        let [subject, place, _] = part.arguments;
        let goes = home.world().objects.get(subject).is_some_and(|known| known.class == AGENT);
        match (goes, task.is_negated()) {
            (true, false) => format!("go to {}", thing(home, place)),
            (true, true) => format!("stay out of {}", thing(home, place)),
            (false, false) => format!("take {} to {}", thing(home, subject), thing(home, place)),
            (false, true) => format!("keep {} out of {}", thing(home, subject), thing(home, place)),
        }
    };
    way_in_words(lifted, task, part, |it| place_in_words(home, it, |object| thing(home, object)))
}

/// A task in words, with its way: `go to the green room, but not through the yellow room`. `goal` says a goal, `place` what is gone through.
pub fn way_in_words(
    lifted: &LiftedTask,
    task: &GroundedTask,
    goal: impl Fn(GroundProposition) -> String,
    place: impl Fn(GroundProposition) -> String,
) -> String {
    let mut words = String::new();
    Wording::PEOPLE.tell(task.parts(lifted), |piece| match piece {
        Piece::Between(sign) => words.push_str(sign),
        Piece::Proposition(Part::Goal | Part::Before(_), it) => words.push_str(&goal(it)),
        Piece::Proposition(Part::Through(_) | Part::Avoiding, it) => words.push_str(&place(it)),
    });
    words
}

/// What a way goes through: a room, or a room with something else than the robot in it. `said` names an object.
pub fn place_in_words(home: &Home<impl HomeMemory>, part: GroundProposition, said: impl Fn(ObjectId) -> String) -> String {
    let [subject, place, _] = part.arguments;
    let goes = home.world().objects.get(subject).is_some_and(|known| known.class == AGENT);
    if goes { said(place) } else { format!("{} with {} in it", said(place), said(subject)) }
}

/// An object by its looks, and by its name where others look the same.
fn thing(home: &Home<impl HomeMemory>, object: ObjectId) -> String {
    let objects = home.world().objects;
    let Some(class) = objects.get(object).map(|known| known.class) else { return String::new() };
    let looks = |object| {
        let (color, shape) = (objects.value(object, COLOR), objects.value(object, SHAPE));
        format!("{color} {}", if shape.is_empty() { home.world().schema.class_name(class) } else { shape }).trim().to_owned()
    };
    let alike = objects.of_class(class).filter(|&other| looks(other) == looks(object)).count();
    if alike > 1 { format!("the {} {}", looks(object), objects.name(object)) } else { format!("the {}", looks(object)) }
}
