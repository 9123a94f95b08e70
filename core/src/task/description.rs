//! Descriptions: a task and the scene around it as a sequence of symbols, which the role model reads.
//!
//! A description begins with the token of the lifted task. Then come groups: a [marker](Marker) of a role and a sort of values, and the
//! values that the objects of that role have. `blockInRoom`, where the red room has the chair and the robot is in the blue room:
//!
//! ```text
//! blockInRoom | the block to move, shape: shapeChair | its goal, color: colorRed | where the robot is, color: colorBlue | ...
//! ```
//!
//! Values are the same for all classes, `colorRed` for rooms and blocks. A value stands once in a group, and a group's values are sorted, so
//! that the order of the objects plays no part. What finds no room in a description or in the vocabulary is left out, the other objects
//! before all else.

use super::machine_command::{Tokens, attribute_token};
use super::role::{Marker, Role, RoleKind, is_marker};
use super::{GroundedTask, LiftedTask};
use crate::capacity::{ARGUMENTS, Capacity, CapacityError, NAME_BYTES};
use crate::oomdp::{ClassId, Domain, GroundProposition, ObjectId, PropositionId, Schema, World};
use crate::symbols::{Symbol, Symbols};
use heapless::String;

/// One group of a description: a role's values of one sort.
#[derive(Clone, Copy, Debug)]
pub struct Group<'d> {
    /// The role and the sort.
    pub marker: Marker,
    /// The values, at least one.
    pub values: &'d [Symbol],
}

/// The token of the lifted task that a description begins with.
pub fn form(description: &[Symbol]) -> Option<Symbol> {
    description.first().copied().filter(|&token| !is_marker(token))
}

/// The groups of a description.
pub fn groups(description: &[Symbol]) -> impl Iterator<Item = Group<'_>> + Clone {
    let mut rest = description.get(1..).unwrap_or(&[]);
    core::iter::from_fn(move || {
        let (&first, after) = rest.split_first()?;
        let marker = Marker::of(first)?;
        let count = after.iter().position(|&symbol| is_marker(symbol)).unwrap_or(after.len());
        let (values, others) = after.split_at_checked(count)?;
        rest = others;
        Some(Group { marker, values })
    })
    .filter(|group| !group.values.is_empty())
}

/// Whether the task itself, not its context, has a value.
pub fn has_value(description: &[Symbol], value: Symbol) -> bool {
    let of_task = |group: &Group<'_>| group.marker.role.kind().is_of_task() && group.marker.sort & 1 == 0;
    groups(description).filter(of_task).any(|group| group.values.contains(&value))
}

/// The token of a lifted task: the names of its propositions, with the numbers of their variables where there are several.
///
/// # Errors
/// A [`CapacityError`] where `tokens` has no room.
pub(crate) fn form_token(schema: &Schema<'_>, lifted: &LiftedTask, tokens: &mut Symbols<'_>) -> Result<Symbol, CapacityError> {
    let mut text: String<NAME_BYTES> = String::new();
    // What is too long is told apart by a digest of the rest.
    let mut rest: u16 = 0;
    let mut add = |letter: char| {
        if text.len().saturating_add(letter.len_utf8()) > NAME_BYTES.saturating_sub(4) || rest != 0 {
            rest = (rest.rotate_left(5) ^ letter as u16).wrapping_mul(0x9e37) | 1;
        } else {
            let _ = text.push(letter);
        }
    };
    let several = lifted.propositions().len() > 1;
    for (position, part) in lifted.propositions().iter().enumerate() {
        if position > 0 {
            add('&');
        }
        schema.proposition_name(part.proposition).chars().for_each(&mut add);
        if several {
            let count = schema.parameters(part.proposition).len();
            part.variables.iter().take(count).for_each(|&variable| add(char::from(b'0'.saturating_add(variable.min(9)))));
        }
    }
    if rest != 0 {
        for shift in [12, 8, 4, 0] {
            let _ = text.push(char::from(b'a'.saturating_add(((rest >> shift) & 15) as u8)));
        }
    }
    tokens.intern(&text)
}

/// Interns the tokens of the lifted tasks that `tasks` ground.
pub(crate) fn intern_forms(
    schema: &Schema<'_>,
    lifted: &[LiftedTask],
    tasks: &[GroundedTask],
    tokens: &mut Symbols<'_>,
) -> Result<(), CapacityError> {
    for (position, lifted) in lifted.iter().enumerate() {
        if tasks.iter().any(|task| usize::from(task.lifted) == position) {
            form_token(schema, lifted, tokens)?;
        }
    }
    Ok(())
}

/// Writes the description of a task, one of those that ground a task of `all`, in place of what `description` held. Its tokens are
/// interned in `tokens`.
///
/// # Errors
/// A [`CapacityError`] where `tokens` has no room for the lifted task's own token.
pub fn describe<D: Domain + ?Sized>(
    domain: &D,
    all: &[LiftedTask],
    task: &GroundedTask,
    state: &D::State,
    tokens: &mut Symbols<'_>,
    description: &mut Tokens,
) -> Result<(), CapacityError> {
    description.clear();
    let Some(lifted) = all.get(usize::from(task.lifted)) else { return Ok(()) };
    let scene = Scene { domain, world: domain.world(), state, all, lifted, task };
    let form = form_token(&scene.world.schema, lifted, tokens)?;
    let _ = description.push(form);
    for &kind in &[RoleKind::Subject, RoleKind::Goal, RoleKind::Start] {
        for (proposition, argument) in scene.arguments(kind) {
            let role = Role::of_argument(kind, proposition, argument);
            scene.write(role, |object| scene.has_role(kind, proposition, argument, object), tokens, description)?;
        }
    }
    for class in (0..scene.world.schema.classes.len()).map(|class| ClassId(class as u8)) {
        let kind = if scene.is_place(class) { RoleKind::OtherPlace } else { RoleKind::Other };
        let other = |object| scene.class(object) == Some(class) && !scene.has_any_role(object);
        scene.write(Role::of_class(kind, class), other, tokens, description)?;
    }
    Ok(())
}

/// A task in its scene.
struct Scene<'a, D: Domain + ?Sized> {
    domain: &'a D,
    world: World<'a>,
    state: &'a D::State,
    all: &'a [LiftedTask],
    lifted: &'a LiftedTask,
    task: &'a GroundedTask,
}

impl<D: Domain + ?Sized> Scene<'_, D> {
    fn class(&self, object: ObjectId) -> Option<ClassId> {
        self.world.objects.get(object).map(|object| object.class)
    }

    fn objects(&self) -> impl Iterator<Item = ObjectId> + use<D> {
        (0..self.world.objects.len()).map(|object| ObjectId(object as u8))
    }

    /// The propositions and arguments that roles of a kind are about: those of the task for goals and subjects, those of all tasks here for
    /// where things are at the start. Each once, in order.
    fn arguments(&self, kind: RoleKind) -> impl Iterator<Item = (PropositionId, usize)> {
        let of = move |proposition: PropositionId| match kind {
            RoleKind::Start => self.all.iter().any(|lifted| lifted.propositions().iter().any(|part| part.proposition == proposition)),
            _ => self.lifted.propositions().iter().any(|part| part.proposition == proposition),
        };
        let count = self.world.schema.propositions.len();
        (0..count).map(|position| PropositionId(position as u8)).filter(move |&proposition| of(proposition)).flat_map(move |proposition| {
            let last = self.world.schema.parameters(proposition).len().min(ARGUMENTS).saturating_sub(1);
            (0..=last)
                .filter(move |&argument| (argument == last) != (kind == RoleKind::Subject))
                .map(move |argument| (proposition, argument))
        })
    }

    /// Whether the class is that of the last argument of a proposition that tasks here are made of.
    fn is_place(&self, class: ClassId) -> bool {
        let parts = self.all.iter().flat_map(|lifted| lifted.propositions());
        parts.map(|part| self.world.schema.parameters(part.proposition)).any(|classes| classes.len() > 1 && classes.last() == Some(&class))
    }

    /// Whether the task binds the object.
    fn is_bound(&self, object: ObjectId) -> bool {
        self.task.bindings.iter().take(self.lifted.variables().len()).any(|&bound| bound == object)
    }

    /// Whether the object is what the task is about: it is bound, or it is of a class that no words can tell apart, like the robot.
    fn is_subject(&self, object: ObjectId) -> bool {
        let carries = |class| self.world.schema.attributes.iter().any(|attribute| attribute.carriers.iter().any(|it| it.class == class));
        self.is_bound(object) || self.class(object).is_some_and(|class| !carries(class))
    }

    /// Whether the proposition holds at the start with this object as its last argument, and others that `with` accepts before it.
    fn holds_at(&self, proposition: PropositionId, object: ObjectId, with: impl Fn(ObjectId) -> bool + Copy) -> bool {
        let classes = self.world.schema.parameters(proposition);
        if classes.last().copied() != self.class(object) {
            return false;
        }
        let ground = |arguments: [ObjectId; ARGUMENTS]| self.domain.holds(&GroundProposition { proposition, arguments }, self.state);
        let of = move |class: ClassId| self.objects().filter(move |&it| self.class(it) == Some(class) && it != object && with(it));
        let none = ObjectId(0);
        match *classes {
            [_] => ground([object, none, none]),
            [first, _] => of(first).any(|first| ground([first, object, none])),
            [first, second, _] => of(first).any(|first| of(second).any(|second| second != first && ground([first, second, object]))),
            _ => false,
        }
    }

    /// What is at a place at the start, beside what the task binds, and has a value of an attribute.
    fn guests(&self, place: ObjectId, attribute: usize) -> impl Iterator<Item = ObjectId> {
        let has_value = move |guest: &ObjectId| self.world.objects.get(*guest).is_some_and(|it| it.value(attribute).is_some());
        let parts = move || self.all.iter().flat_map(|lifted| lifted.propositions());
        let is_there = move |guest: &ObjectId| {
            let arguments = [*guest, place, ObjectId(0)];
            parts().any(|part| match *self.world.schema.parameters(part.proposition) {
                [first, second] if self.class(*guest) == Some(first) && self.class(place) == Some(second) => {
                    self.domain.holds(&GroundProposition { proposition: part.proposition, arguments }, self.state)
                }
                _ => false,
            })
        };
        self.objects().filter(has_value).filter(|&guest| !self.is_bound(guest)).filter(is_there)
    }

    fn has_role(&self, kind: RoleKind, proposition: PropositionId, argument: usize, object: ObjectId) -> bool {
        match kind {
            RoleKind::Start => self.holds_at(proposition, object, |it| self.is_subject(it)),
            _ => self
                .task
                .propositions(self.lifted)
                .any(|part| part.proposition == proposition && part.arguments.get(argument) == Some(&object) && self.is_bound(object)),
        }
    }

    fn has_any_role(&self, object: ObjectId) -> bool {
        self.is_bound(object)
            || self.arguments(RoleKind::Start).any(|(proposition, argument)| self.has_role(RoleKind::Start, proposition, argument, object))
    }

    /// Writes the groups of a role: for each attribute the values of its objects and, for goals, those of what is there at the start.
    fn write(
        &self,
        role: Role,
        of_role: impl Fn(ObjectId) -> bool,
        tokens: &mut Symbols<'_>,
        description: &mut Tokens,
    ) -> Result<(), CapacityError> {
        for attribute in 0..self.world.schema.attributes.len() {
            let marker = Marker { role, sort: (attribute << 1) as u8 };
            self.write_group(marker, attribute, self.objects().filter(|&object| of_role(object)), tokens, description)?;
            if role.kind() == RoleKind::Goal {
                let marker = Marker { role, sort: marker.sort | 1 };
                let places = self.objects().filter(|&place| of_role(place));
                let guests = places.flat_map(|place| self.guests(place, attribute));
                self.write_group(marker, attribute, guests, tokens, description)?;
            }
        }
        Ok(())
    }

    fn write_group(
        &self,
        marker: Marker,
        attribute: usize,
        objects: impl Iterator<Item = ObjectId>,
        tokens: &mut Symbols<'_>,
        description: &mut Tokens,
    ) -> Result<(), CapacityError> {
        let first = description.len().saturating_add(1);
        let name = self.world.schema.attributes.get(attribute).map_or("", |attribute| attribute.name);
        for object in objects {
            let value = self.world.objects.value(object, attribute);
            if value.is_empty() {
                continue;
            }
            let token = match tokens.intern(&attribute_token(name, value)?) {
                Ok(token) if !is_marker(token) => token,
                Ok(_) => continue,
                Err(error) if matches!(error.capacity, Capacity::Tokens | Capacity::TokenBytes) => continue,
                Err(error) => return Err(error),
            };
            if description.len() < first && description.push(marker.symbol()).is_err() {
                return Ok(());
            }
            insert(description, first, token);
        }
        if description.len() == first {
            description.pop();
        }
        Ok(())
    }
}

/// Inserts a value into the last group, which begins at `first`, unless it is there or has no room.
fn insert(description: &mut Tokens, first: usize, token: Symbol) {
    let group = description.get(first..).unwrap_or(&[]);
    let place = group.iter().position(|&other| other >= token).unwrap_or(group.len());
    if group.get(place) == Some(&token) {
        return;
    }
    let _ = description.insert(first.saturating_add(place), token);
}
