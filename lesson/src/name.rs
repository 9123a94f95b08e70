//! Tasks as texts: for files, for people, and as machine commands for models with other symbols.

use goodbot::capacity::{Capacity, CapacityError};
use goodbot::home::{AGENT, COLOR, Home, SHAPE};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Domain, GroundProposition, ObjectId, World};
use goodbot::symbols::{Symbol, Symbols, SymbolsRef};
use goodbot::task::description::{Scene, describe};
use goodbot::task::{GroundedTask, LiftedTask, Part, Piece, TaskText, Tokens, Wording};
use goodbot_formats::task_text::{GroundTaskText, TaskTextError};

/// The text of a task, such as `blockInRoom(block0,room1)`. `lifted` is the kind of task that it grounds.
///
/// # Errors
/// A [`TaskTextError`] if the text could not be parsed again. Names from files always can.
pub fn task_name<D: Domain>(domain: &D, lifted: &LiftedTask, task: &GroundedTask) -> Result<GroundTaskText, TaskTextError> {
    TaskText::new(task, lifted, domain.world()).to_string().parse()
}

/// A task in everyday words: `go to the green room`, `take the blue chair to the red room`.
pub fn in_words(home: &Home<impl HomeMemory>, lifted: &LiftedTask, task: &GroundedTask) -> String {
    let said = |object| object_in_words(home, object);
    let goes = |subject| home.world().objects.get(subject).is_some_and(|known| known.class == AGENT);
    let goal = |part: GroundProposition| {
        let [subject, place, _] = part.arguments;
        match (goes(subject), task.is_negated()) {
            (true, false) => format!("go to the {}", said(place)),
            (true, true) => format!("stay out of the {}", said(place)),
            (false, false) => format!("take the {} to the {}", said(subject), said(place)),
            (false, true) => format!("keep the {} out of the {}", said(subject), said(place)),
        }
    };
    // A way goes through a room, or through a room that contains another object.
    way_in_words(lifted, task, goal, |part: GroundProposition| {
        let [subject, place, _] = part.arguments;
        if goes(subject) { format!("the {}", said(place)) } else { format!("the {} with the {} in it", said(place), said(subject)) }
    })
}

/// A task in words, with its way: `go to the green room, but not through the yellow room`. `goal` words a goal, `place` a place on the way.
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

/// An object by its looks, such as `green room`; with its name if another looks the same: `blue chair (block0)`.
pub fn object_in_words(home: &Home<impl HomeMemory>, object: ObjectId) -> String {
    let objects = home.world().objects;
    let Some(class) = objects.get(object).map(|known| known.class) else { return String::new() };
    let looks = |object| {
        let (color, shape) = (objects.value(object, COLOR), objects.value(object, SHAPE));
        format!("{color} {}", if shape.is_empty() { home.world().schema.class_name(class) } else { shape }).trim().to_owned()
    };
    let alike = objects.of_class(class).filter(|&other| looks(other) == looks(object)).count();
    if alike > 1 { format!("{} ({})", looks(object), objects.name(object)) } else { looks(object) }
}

/// A task of any world in words, by the names that its file or class gives: `lamp on: red kitchen lamp`.
pub fn in_words_of_file<D: Domain>(domain: &D, lifted: &LiftedTask, task: &GroundedTask) -> String {
    let told = |part: GroundProposition| {
        let schema = domain.world().schema;
        let count = schema.parameters(part.proposition).len();
        let objects: Vec<String> = part.arguments.iter().take(count).map(|&object| looks(domain, object)).collect();
        let not = if task.is_negated() { "not " } else { "" };
        format!("{not}{}: {}", in_plain_words(schema.proposition_name(part.proposition)), objects.join(", "))
    };
    way_in_words(lifted, task, told, told)
}

/// An object of any world by its values and its class, `red kitchen lamp`. If another looks alike, its name follows. An object without
/// values has its name alone.
pub fn looks<D: Domain>(domain: &D, id: ObjectId) -> String {
    let World { schema, objects } = domain.world();
    let values = |id: ObjectId| (0..schema.attributes.len()).map(move |at| objects.value(id, at)).filter(|value| !value.is_empty());
    let class = |id: ObjectId| objects.get(id).map(|object| object.class);
    let Some(of) = class(id).filter(|_| values(id).next().is_some()) else { return objects.name(id).to_owned() };
    let alike = objects.of_class(of).filter(|&other| values(other).eq(values(id))).count();
    let told = values(id).chain([schema.class_name(of)]).collect::<Vec<_>>().join(" ");
    if alike > 1 { format!("{told} ({})", objects.name(id)) } else { told }
}

/// A name from a file in words: `lampOn` is `lamp on`.
pub fn in_plain_words(name: &str) -> String {
    let mut words = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !words.is_empty() {
            words.push(' ');
        }
        words.extend(letter.to_lowercase());
    }
    words
}

/// The description of a task, which is its machine command for the role model. `token` makes something of each token, of which only a role's
/// marker is the same in all models.
///
/// # Errors
/// A [`CapacityError`] for a task with too many tokens, and the errors of `token`.
pub fn description<D: Domain, T>(
    domain: &D,
    all: &[LiftedTask],
    task: &GroundedTask,
    start: &D::State,
    mut token: impl FnMut(SymbolsRef<'_>, Symbol) -> Result<T, CapacityError>,
) -> Result<Vec<T>, CapacityError> {
    let (mut bytes, mut ends, mut count) = ([0; 2_048], [0; 64], 0);
    let mut tokens = Symbols::new(&mut bytes, &mut ends, &mut count, Capacity::Tokens, Capacity::TokenBytes);
    let mut description = Tokens::new();
    describe(domain, all, task, &mut Scene::new(*start), &mut tokens, &mut description)?;
    description.iter().map(|&symbol| token(tokens.read(), symbol)).collect()
}
