//! Descriptions: a task and the scene around it as a sequence of symbols, which the role model reads.
//!
//! A description begins with the token of the lifted task. Then come groups: a [marker](Marker) of a role and a sort of values, and the
//! values of the objects in that role. For `blockInRoom`, with the chair in the red room and the robot in the blue room:
//!
//! ```text
//! blockInRoom | the block to move, shape: shapeChair | its goal, color: colorRed | the robot's place, color: colorBlue | ...
//! ```
//!
//! Values are the same for all classes, `colorRed` for rooms and blocks. A value occurs once in a group, and a group's values are sorted,
//! so the order of the objects does not matter. Values without room in a description or in the vocabulary are left out, those of the other
//! objects first.

use super::machine_command::{Interning, Tokens};
#[cfg(feature = "ways")]
use super::role::VALUE_SORTS;
use super::role::{Marker, Role, RoleKind, is_marker};
use super::{GroundedTask, LiftedProposition, LiftedTask, Part};
use crate::capacity::{ARGUMENTS, ATTRIBUTES, Capacity, CapacityError, LIFTED_TASKS, NAME_BYTES};
use crate::oomdp::{ClassId, Domain, GroundProposition, ObjectId, PropositionId, Schema, World};
use crate::symbols::{Symbol, Symbols};
#[cfg(all(feature = "ways", feature = "talk"))]
use crate::talk::Conversation;
use heapless::String;

/// One group of a description: a role's values of one sort.
#[derive(Clone, Copy, Debug)]
pub struct Group<'d> {
    /// The role and the sort.
    pub marker: Marker,
    /// The position of its first value in the description.
    pub first: usize,
    /// The values, at least one.
    pub values: &'d [Symbol],
}

/// The first token of a description: that of the lifted task.
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
        let first = description.len().saturating_sub(after.len());
        Some(Group { marker, first, values })
    })
    .filter(|group| !group.values.is_empty())
}

/// Whether the task itself, not its context, has a value.
pub fn has_value(description: &[Symbol], value: Symbol) -> bool {
    groups(description).filter(is_of_task).any(|group| group.values.contains(&value))
}

/// Whether a group is of the task itself, not of its context.
pub(crate) fn is_of_task(group: &Group<'_>) -> bool {
    group.marker.role.kind().is_of_task() && group.marker.sort & 1 == 0
}

/// The token of a lifted task: the names of its propositions, with the numbers of their variables if there are several.
///
/// # Errors
/// A [`CapacityError`] if `tokens` has no room.
#[inline(never)]
pub fn form_token(schema: &Schema<'_>, lifted: &LiftedTask, tokens: &mut Symbols<'_>) -> Result<Symbol, CapacityError> {
    let mut text: String<NAME_BYTES> = String::new();
    // A digest of the truncated letters tells long names apart.
    let mut rest: u16 = 0;
    let mut add = |letter: char| {
        if text.len().saturating_add(letter.len_utf8()) > NAME_BYTES.saturating_sub(4) || rest != 0 {
            rest = (rest.rotate_left(5) ^ letter as u16).wrapping_mul(0x9e37) | 1;
        } else {
            let _ = text.push(letter);
        }
    };
    let several = lifted.propositions().len() > 1 || lifted.has_way();
    for (position, (kind, part)) in lifted.parts().enumerate() {
        let (sign, number) = match kind {
            Part::Goal => ('&', None),
            Part::Before(stage) => ('<', Some(stage)),
            Part::Through(clause) => ('>', Some(clause)),
            Part::Avoiding => ('!', None),
        };
        if position > 0 {
            add(sign);
            number.into_iter().for_each(|number| add(char::from(b'0' + number.min(9))));
        }
        schema.proposition_name(part.proposition).chars().for_each(&mut add);
        if several {
            let count = schema.parameters(part.proposition).len();
            part.variables.iter().take(count).for_each(|&variable| add(char::from(b'0' + variable.min(9))));
        }
    }
    if rest != 0 {
        for shift in [12, 8, 4, 0] {
            let _ = text.push(char::from(b'a' + ((rest >> shift) & 15) as u8));
        }
    }
    tokens.intern(&text)
}

/// The shared data of all descriptions of one session: its start state, and the tokens of lifted tasks and of values needed so far.
#[derive(Clone, Debug)]
pub struct Scene<S> {
    state: S,
    /// `None` before the first description.
    spoken: Option<Spoken>,
    /// For each lifted task one more than its token, 0 if it was not needed yet.
    forms: [u16; LIFTED_TASKS],
    /// The interning of tokens.
    interning: Interning,
    #[cfg(feature = "ways")]
    written: Written,
    /// For each of the first objects and each attribute one more than the value's token, 0 if it was not needed yet.
    tokens: [[u16; ATTRIBUTES]; REMEMBERED],
    #[cfg(all(feature = "ways", feature = "talk"))]
    conversation: Conversation,
}

/// The propositions and classes in the lifted tasks, and the classes that words can tell apart.
#[derive(Clone, Copy, Debug)]
struct Spoken {
    /// The propositions that tasks are made of.
    propositions: Bits,
    /// The classes of their last arguments.
    places: Bits,
    /// The classes that carry an attribute.
    things: Bits,
}

impl Spoken {
    fn of(schema: &Schema<'_>, all: &[LiftedTask]) -> Self {
        let mut spoken = Self { propositions: Bits(0), places: Bits(0), things: Bits(0) };
        for part in all.iter().flat_map(|lifted| lifted.propositions()) {
            spoken.propositions.insert(part.proposition.0);
            if let [_, .., last] = schema.parameters(part.proposition) {
                spoken.places.insert(last.0);
            }
        }
        for carrier in schema.attributes.iter().flat_map(|attribute| attribute.carriers) {
            spoken.things.insert(carrier.class.0);
        }
        spoken
    }
}

/// A set of a schema's propositions or classes. Those beyond 63 share a bit, as they share a role.
#[derive(Clone, Copy, Debug)]
struct Bits(u64);

impl Bits {
    fn insert(&mut self, position: u8) {
        self.0 |= 1 << position.min(63);
    }

    fn contains(self, position: u8) -> bool {
        self.0 & (1 << position.min(63)) != 0
    }
}

/// The tokens of this many objects are cached; those of others are looked up each time.
const REMEMBERED: usize = 16;
/// Marks a value without a token: it is empty, or found no room.
const NO_TOKEN: u16 = u16::MAX;

/// The objects that a description has so far. One counts for each group in which it may have a value.
#[cfg(feature = "ways")]
#[derive(Clone, Copy, Debug)]
struct Written {
    /// By earlier parts of the work.
    before: u16,
    all: u16,
    /// Whether the rest is left to a later part.
    is_broken_off: bool,
}

#[cfg(feature = "ways")]
impl Written {
    const NONE: Self = Self { before: 0, all: 0, is_broken_off: false };
}

impl<S> Scene<S> {
    /// The scene of a session that starts from a state.
    pub const fn new(state: S) -> Self {
        Self {
            state,
            spoken: None,
            forms: [0; LIFTED_TASKS],
            interning: Interning::UNBOUNDED,
            #[cfg(feature = "ways")]
            written: Written::NONE,
            tokens: [[0; ATTRIBUTES]; REMEMBERED],
            #[cfg(all(feature = "ways", feature = "talk"))]
            conversation: Conversation::NEW,
        }
    }

    /// The same scene, with the facts of a conversation.
    #[cfg(all(feature = "ways", feature = "talk"))]
    pub(crate) fn of_conversation(self, conversation: Conversation) -> Self {
        Self { conversation, ..self }
    }

    /// Lets the next description go on after the objects that earlier parts of the work have written, and look for about so many tokens of
    /// values.
    #[cfg(feature = "ways")]
    pub(crate) const fn describe_on(&mut self, written: u16, tokens: u32) {
        (self.interning, self.written) = (Interning::at_most(tokens), Written { before: written, ..Written::NONE });
    }

    /// The number of objects that are written, if the last description was broken off; `None` if it is whole.
    #[cfg(feature = "ways")]
    pub(crate) fn broken_off(&self) -> Option<u16> {
        Some(self.written.all).filter(|_| self.written.is_broken_off)
    }

    /// Whether the next description goes on where an earlier part has broken off.
    #[cfg(feature = "ways")]
    const fn goes_on(&mut self) -> bool {
        self.written.all = 0;
        self.written.before > 0
    }

    /// Always `false`.
    #[cfg(not(feature = "ways"))]
    #[expect(clippy::unused_self, reason = "as with the feature")]
    const fn goes_on(&mut self) -> bool {
        false
    }

    /// The token of the lifted task at a position.
    fn form(
        &mut self,
        schema: &Schema<'_>,
        position: usize,
        lifted: &LiftedTask,
        tokens: &mut Symbols<'_>,
    ) -> Result<Symbol, CapacityError> {
        let slot = self.forms.get_mut(position);
        if let Some(known) = slot.as_deref().and_then(|form| form.checked_sub(1)) {
            return Ok(Symbol(known));
        }
        let token = form_token(schema, lifted, tokens)?;
        if let Some(slot) = slot {
            *slot = token.0.saturating_add(1);
        }
        Ok(token)
    }

    /// The token of an object's value of an attribute, `None` if it has none.
    fn token(
        &mut self,
        world: &World<'_>,
        object: ObjectId,
        attribute: usize,
        tokens: &mut Symbols<'_>,
    ) -> Result<Option<Symbol>, CapacityError> {
        let mut slot = self.tokens.get_mut(object.index()).and_then(|tokens| tokens.get_mut(attribute));
        match slot.as_deref().copied().unwrap_or(0) {
            0 => {}
            NO_TOKEN => return Ok(None),
            known => return Ok(Some(Symbol(known.saturating_sub(1)))),
        }
        let name = world.schema.attributes.get(attribute).map_or("", |attribute| attribute.name);
        let value = world.objects.value(object, attribute);
        let token = match value.is_empty() {
            true => None,
            false => match self.interning.intern(name, value, tokens) {
                Ok(token) => Some(token).filter(|&token| !is_marker(token)),
                Err(error) if matches!(error.capacity, Capacity::Tokens | Capacity::TokenBytes) => None,
                Err(error) => return Err(error),
            },
        };
        if let Some(slot) = &mut slot {
            **slot = token.map_or(NO_TOKEN, |token| token.0.saturating_add(1));
        }
        Ok(token)
    }
}

/// Replaces `description` by that of a task, which grounds a lifted task of `all`. Its tokens are interned in `tokens`, which must not
/// forget any while the scene is in use. If the scene goes on, `description` has what earlier parts wrote.
///
/// # Errors
/// A [`CapacityError`] if `tokens` has no room for the lifted task's own token, and any if the description was broken off.
// Its room on the stack is free again when the description is read.
#[inline(never)]
pub fn describe<D: Domain>(
    domain: &D,
    all: &[LiftedTask],
    task: &GroundedTask,
    scene: &mut Scene<D::State>,
    tokens: &mut Symbols<'_>,
    description: &mut Tokens,
) -> Result<(), CapacityError> {
    let Some(lifted) = all.get(usize::from(task.lifted)) else {
        description.clear();
        return Ok(());
    };
    if !scene.goes_on() {
        description.clear();
        let form = scene.form(&domain.world().schema, usize::from(task.lifted), lifted, tokens)?;
        let _ = description.push(form);
    }
    let bound: Chosen = task.bindings.iter().take(lifted.variables().len()).copied().collect();
    let mut with_role = Chosen::NONE;
    let world = domain.world();
    let spoken = *scene.spoken.get_or_insert_with(|| Spoken::of(&world.schema, all));
    let mut description = Description { domain, world, scene, spoken, lifted, task, bound, tokens, description };
    for &kind in &[RoleKind::Subject, RoleKind::Goal, RoleKind::Start] {
        if kind == RoleKind::Start {
            description.write_way(&mut with_role)?;
        }
        for proposition in description.propositions(kind) {
            let last = description.world.schema.parameters(proposition).len().min(ARGUMENTS).saturating_sub(1);
            for argument in (0..=last).filter(|&argument| (argument == last) != (kind == RoleKind::Subject)) {
                let chosen = match kind {
                    RoleKind::Start => description.starts(proposition),
                    _ => description.bound_as(proposition, argument),
                };
                with_role.insert_all(&chosen);
                description.write(Role::of_argument(kind, proposition, argument), &chosen)?;
            }
        }
    }
    with_role.insert_all(&bound);
    for class in (0..description.world.schema.classes.len()).map(|class| ClassId(class as u8)) {
        if !description.can_be_told(class) {
            continue;
        }
        let kind = if spoken.places.contains(class.0) { RoleKind::OtherPlace } else { RoleKind::Other };
        let others = description.chosen(class, &|object| !with_role.contains(object));
        description.write(Role::of_class(kind, class), &others)?;
    }
    #[cfg(feature = "ways")]
    {
        description.scene.written = Written::NONE;
    }
    Ok(())
}

/// A set of objects, one bit each.
#[derive(Clone, Copy)]
struct Chosen {
    words: [u32; 8],
    /// The number of words up to the last one with a bit.
    end: u8,
}

impl Chosen {
    const NONE: Self = Self { words: [0; 8], end: 0 };

    /// Adds the objects with these bits in the word at a position.
    fn insert_bits(&mut self, position: u8, bits: u32) {
        if let Some(word) = self.words.get_mut(usize::from(position)) {
            *word |= bits;
            self.end = self.end.max(position + 1);
        }
    }

    fn insert(&mut self, object: ObjectId) {
        self.insert_bits(object.0 / 32, 1 << (object.0 % 32));
    }

    fn contains(&self, object: ObjectId) -> bool {
        self.words.get(object.index() / 32).is_some_and(|word| word & (1 << (object.0 % 32)) != 0)
    }

    fn insert_all(&mut self, others: &Self) {
        others.words.iter().zip(0..others.end).for_each(|(&bits, position)| self.insert_bits(position, bits));
    }

    fn iter(&self) -> impl Iterator<Item = ObjectId> {
        let mut position = 0;
        let mut rest = self.words.first().copied().unwrap_or(0);
        core::iter::from_fn(move || {
            while rest == 0 {
                position = u8::saturating_add(position, 1);
                if position >= self.end {
                    return None;
                }
                rest = self.words.get(usize::from(position)).copied().unwrap_or(0);
            }
            let bit = rest.trailing_zeros();
            rest &= rest.wrapping_sub(1);
            Some(ObjectId(position.wrapping_mul(32).wrapping_add(bit as u8)))
        })
    }
}

impl FromIterator<ObjectId> for Chosen {
    fn from_iter<I: IntoIterator<Item = ObjectId>>(objects: I) -> Self {
        let mut chosen = Self::NONE;
        objects.into_iter().for_each(|object| chosen.insert(object));
        chosen
    }
}

/// The description of a task in its scene, under construction.
struct Description<'a, 't, D: Domain> {
    domain: &'a D,
    world: World<'a>,
    scene: &'a mut Scene<D::State>,
    spoken: Spoken,
    lifted: &'a LiftedTask,
    task: &'a GroundedTask,
    /// The objects that the task binds.
    bound: Chosen,
    tokens: &'a mut Symbols<'t>,
    description: &'a mut Tokens,
}

impl<'a, D: Domain> Description<'a, '_, D> {
    fn class(&self, object: ObjectId) -> Option<ClassId> {
        self.world.objects.get(object).map(|object| object.class)
    }

    /// Whether words could distinguish objects of a class.
    fn can_be_told(&self, class: ClassId) -> bool {
        cfg!(feature = "ways") || self.spoken.things.contains(class.0)
    }

    fn of_class(&self, class: ClassId) -> impl Iterator<Item = ObjectId> + use<'a, D> {
        self.world.objects.of_class(class)
    }

    /// The objects of a class that are chosen. One function for all choices, because each would compile the loop anew.
    #[inline(never)]
    fn chosen(&self, class: ClassId, is_chosen: &dyn Fn(ObjectId) -> bool) -> Chosen {
        self.of_class(class).filter(|&object| is_chosen(object)).collect()
    }

    fn holds(&self, proposition: PropositionId, arguments: [ObjectId; ARGUMENTS]) -> bool {
        self.domain.holds(&GroundProposition { proposition, arguments }, &self.scene.state)
    }

    /// The propositions for the roles of a kind, each once, in order: those of the task for goals and subjects, those of all lifted tasks
    /// for the places at the start.
    fn propositions(&self, kind: RoleKind) -> impl Iterator<Item = PropositionId> + use<'a, D> {
        let mut bits = self.spoken.propositions;
        if kind != RoleKind::Start {
            bits = Bits(0);
            self.lifted.propositions().iter().for_each(|part| bits.insert(part.proposition.0));
        }
        let all = (0..self.world.schema.propositions.len()).map(|position| PropositionId(position as u8));
        all.filter(move |proposition| bits.contains(proposition.0))
    }

    /// The objects that the task binds as an argument of a proposition.
    fn bound_as(&self, proposition: PropositionId, argument: usize) -> Chosen {
        let parts = self.task.propositions(self.lifted).filter(|part| part.proposition == proposition);
        parts.filter_map(|part| part.arguments.get(argument).copied()).filter(|&object| self.bound.contains(object)).collect()
    }

    /// The task's subjects of a class: the bound objects, or all objects if no words can distinguish them, like the robot.
    fn subjects(&self, class: ClassId) -> Chosen {
        let is_thing = self.spoken.things.contains(class.0);
        self.chosen(class, &|object| !is_thing || self.bound.contains(object))
    }

    /// The last arguments with which a proposition holds at the start, if its other arguments are subjects of the task.
    fn starts(&self, proposition: PropositionId) -> Chosen {
        let none = ObjectId(0);
        match *self.world.schema.parameters(proposition) {
            [class] => self.chosen(class, &|object| self.holds(proposition, [object, none, none])),
            [first, class] => {
                let firsts = self.subjects(first);
                self.chosen(class, &|object| firsts.iter().any(|first| first != object && self.holds(proposition, [first, object, none])))
            }
            [first, second, class] => {
                let (firsts, seconds) = (self.subjects(first), self.subjects(second));
                let of_two = |first, object| {
                    let mut seconds = seconds.iter().filter(|&second| second != first && second != object);
                    seconds.any(|second| self.holds(proposition, [first, second, object]))
                };
                self.chosen(class, &|object| firsts.iter().any(|first| first != object && of_two(first, object)))
            }
            _ => Chosen::NONE,
        }
    }

    /// The objects at these places at the start, except those that the task binds.
    fn guests(&self, places: &Chosen) -> Chosen {
        let mut guests = Chosen::NONE;
        for proposition in self.propositions(RoleKind::Start) {
            let [first, second] = *self.world.schema.parameters(proposition) else { continue };
            for place in places.iter().filter(|&place| self.class(place) == Some(second)) {
                let others = self.of_class(first).filter(|&guest| !self.bound.contains(guest));
                let there = others.filter(|&guest| self.holds(proposition, [guest, place, ObjectId(0)]));
                there.for_each(|guest| guests.insert(guest));
            }
        }
        guests
    }

    /// Writes the groups of the objects that only the way has. Alternatives share a group.
    fn write_way(&mut self, with_role: &mut Chosen) -> Result<(), CapacityError> {
        let lifted = self.lifted;
        if !lifted.has_way() {
            return Ok(());
        }
        let known = *with_role;
        for kind in [RoleKind::Before, RoleKind::Through, RoleKind::Avoiding] {
            for proposition in (0..self.world.schema.propositions.len()).map(|position| PropositionId(position as u8)) {
                for argument in 0..self.world.schema.parameters(proposition).len().min(ARGUMENTS) {
                    let task = self.task;
                    let of = |&(part, it): &(Part, LiftedProposition)| RoleKind::of_part(part) == kind && it.proposition == proposition;
                    let object = |(_, it)| task.grounded(it).arguments.get(argument).copied();
                    let chosen: Chosen = lifted.way().filter(of).filter_map(object).filter(|&object| !known.contains(object)).collect();
                    with_role.insert_all(&chosen);
                    self.write(Role::of_argument(kind, proposition, argument), &chosen)?;
                }
            }
        }
        Ok(())
    }

    /// Writes the groups of a role: for each attribute the values of its objects and, for goals, of the objects there at the start.
    fn write(&mut self, role: Role, objects: &Chosen) -> Result<(), CapacityError> {
        let Some(class) = objects.iter().next().and_then(|object| self.class(object)) else { return Ok(()) };
        let guests = (role.kind() == RoleKind::Goal).then(|| self.guests(objects)).filter(|guests| guests.end > 0);
        // A role's objects are of one class.
        if guests.is_none() && !self.can_be_told(class) {
            return Ok(());
        }
        for attribute in 0..self.world.schema.attributes.len() {
            let sort = (attribute << 1) as u8;
            self.write_group(Marker { role, sort }, attribute, objects)?;
            if let Some(guests) = &guests {
                self.write_group(Marker { role, sort: sort | 1 }, attribute, guests)?;
            }
        }
        #[cfg(feature = "ways")]
        self.write_derived(role, objects)?;
        Ok(())
    }

    /// Writes the group of a role's derived facts, like one more attribute. Facts without room are left out.
    #[cfg(feature = "ways")]
    fn write_derived(&mut self, role: Role, objects: &Chosen) -> Result<(), CapacityError> {
        let sort = self.world.schema.attributes.len() << 1;
        if sort >= VALUE_SORTS {
            return Ok(());
        }
        let mut group = OpenGroup::new(Marker { role, sort: sort as u8 }, self.description);
        for object in objects.iter() {
            if self.is_done(&mut group)? {
                continue;
            }
            let Self { domain, scene, tokens, description, .. } = self;
            let interning = &mut scene.interning;
            let mut tell = |fact: &str| {
                if let Some(token) = interning.intern("is", fact, tokens).ok().filter(|&token| !is_marker(token)) {
                    let _ = group.take(token, description);
                }
            };
            domain.tell_derived(&scene.state, object, &mut tell);
            #[cfg(feature = "talk")]
            scene.conversation.tell(*domain, object, &mut tell);
        }
        group.close(self.description);
        Ok(())
    }

    /// Writes the group of a role's values of an attribute.
    fn write_group(&mut self, marker: Marker, attribute: usize, objects: &Chosen) -> Result<(), CapacityError> {
        #[cfg_attr(not(feature = "ways"), expect(unused_mut, reason = "as with the feature"))]
        let mut group = OpenGroup::new(marker, self.description);
        for object in objects.iter() {
            #[cfg(feature = "ways")]
            if self.is_done(&mut group)? {
                continue;
            }
            let Some(token) = self.scene.token(&self.world, object, attribute, self.tokens)? else { continue };
            if !group.take(token, self.description) {
                #[cfg(not(feature = "ways"))]
                return Ok(());
                #[cfg(feature = "ways")]
                {
                    group.is_left_out = true;
                }
            }
        }
        group.close(self.description);
        Ok(())
    }

    /// Whether nothing is to be done for the next object of a group.
    ///
    /// # Errors
    /// Any, if the description is broken off before this object.
    #[cfg(feature = "ways")]
    fn is_done(&mut self, group: &mut OpenGroup) -> Result<bool, CapacityError> {
        let written = &mut self.scene.written;
        let is_earlier = written.all < written.before;
        if !is_earlier && group.goes_on {
            group.goes_on = false;
            // An earlier part has begun the group.
            let last = self.description.iter().rposition(|&symbol| is_marker(symbol));
            if let Some(last) = last.filter(|&last| self.description.get(last) == Some(&group.marker.symbol())) {
                group.first = last.saturating_add(1);
            }
        }
        if !is_earlier && !group.is_left_out && self.scene.interning.is_spent() {
            if group.has_objects && self.description.len() < group.first {
                // The next part finds the group by its marker.
                let _ = self.description.push(group.marker.symbol());
            }
            written.is_broken_off = true;
            return Err(CapacityError::full(Capacity::Tokens, 0));
        }
        written.all = written.all.saturating_add(1);
        group.has_objects = true;
        group.goes_on = is_earlier;
        Ok(is_earlier || group.is_left_out)
    }
}

/// The last group of a description, while it is written.
struct OpenGroup {
    marker: Marker,
    /// The position of its first value.
    first: usize,
    /// Whether it has objects so far, with values or without.
    #[cfg(feature = "ways")]
    has_objects: bool,
    /// Whether an earlier part of the work has written its objects so far.
    #[cfg(feature = "ways")]
    goes_on: bool,
    /// Whether the description has no room for it.
    #[cfg(feature = "ways")]
    is_left_out: bool,
}

impl OpenGroup {
    fn new(marker: Marker, description: &Tokens) -> Self {
        Self {
            marker,
            first: description.len() + 1,
            #[cfg(feature = "ways")]
            has_objects: false,
            #[cfg(feature = "ways")]
            goes_on: false,
            #[cfg(feature = "ways")]
            is_left_out: false,
        }
    }

    /// Takes a value. Returns whether there is room for the group.
    fn take(&self, value: Symbol, description: &mut Tokens) -> bool {
        if description.len() < self.first && description.push(self.marker.symbol()).is_err() {
            return false;
        }
        insert(description, self.first, value);
        true
    }

    /// A group without values is none.
    fn close(&self, description: &mut Tokens) {
        if description.len() == self.first {
            description.pop();
        }
    }
}

/// Inserts a value into the last group, which begins at `first`, unless it has the value or there is no room.
fn insert(description: &mut Tokens, first: usize, token: Symbol) {
    let group = description.get(first..).unwrap_or(&[]);
    let place = group.iter().position(|&other| other >= token).unwrap_or(group.len());
    if group.get(place) == Some(&token) {
        return;
    }
    if description.push(token).is_err() {
        return;
    }
    // The later values move up by one. The list's own insertion can panic.
    let mut moved = token;
    for slot in description.iter_mut().skip(first + place) {
        core::mem::swap(slot, &mut moved);
    }
}
