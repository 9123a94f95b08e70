//! The objects of one environment: a set of fixed capacity, in memory that the caller lends.

use super::schema::{ClassId, PropositionId};
use crate::capacity::{ARGUMENTS, ATTRIBUTES, Capacities, Capacity, CapacityError};
use crate::memory::{ObjectTables, ObjectTablesRef};
use crate::symbols::{Symbol, Symbols, SymbolsRef, positions};

positions! {
    /// An object, by its position among the [`Objects`].
    #[derive(Default)]
    ObjectId(u8);
}

/// A propositional function of objects: `blockInRoom(block0, room2)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct GroundProposition {
    /// The propositional function.
    pub proposition: PropositionId,
    /// Its arguments; those beyond the function's parameters are object 0, so that equal propositions compare equal.
    pub arguments: [ObjectId; ARGUMENTS],
}

impl GroundProposition {
    /// The proposition of these objects. Unused arguments are object 0, and objects beyond [`ARGUMENTS`] are left out.
    pub fn new(proposition: PropositionId, objects: &[ObjectId]) -> Self {
        let mut arguments = [ObjectId(0); ARGUMENTS];
        arguments.iter_mut().zip(objects).for_each(|(argument, &object)| *argument = object);
        Self { proposition, arguments }
    }
}

/// One object: its class, its name, and its value of each attribute of the schema (none if its class does not carry the attribute).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Object {
    /// Its class.
    pub class: ClassId,
    /// Its name.
    pub name: Symbol,
    /// One more than the symbol of each attribute value, in the order of [`Schema::attributes`](super::Schema::attributes); 0 for none.
    values: [u16; ATTRIBUTES],
}

impl Object {
    /// The value of unused memory: zeros, so that a static needs no room in flash.
    pub const UNUSED: Self = Self { class: ClassId(0), name: Symbol(0), values: [0; ATTRIBUTES] };

    /// The value of an attribute, by the attribute's position in the schema.
    pub fn value(&self, attribute: usize) -> Option<Symbol> {
        self.values.get(attribute)?.checked_sub(1).map(Symbol)
    }
}

/// Why an object could not be added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ObjectError {
    /// Another object has this name.
    #[error("another object has this name; give each its own")]
    DuplicateName,
    /// The name is empty.
    #[error("the object's name is empty; give it one")]
    EmptyName,
    /// A table was full.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
}

/// The numbers of objects and names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ObjectCount {
    objects: usize,
    names: usize,
}

impl ObjectCount {
    /// No objects.
    pub const NONE: Self = Self { objects: 0, names: 0 };
}

/// The objects of one environment, while they are being described.
#[derive(Debug)]
pub struct ObjectSet<'t> {
    memory: ObjectTables<'t>,
    count: ObjectCount,
}

/// The objects of one environment.
#[derive(Clone, Copy, Debug)]
pub struct Objects<'t> {
    memory: ObjectTablesRef<'t>,
    count: ObjectCount,
}

impl<'t> ObjectSet<'t> {
    /// No objects yet.
    ///
    /// ```
    /// use goodbot::oomdp::{ClassId, Object, ObjectSet, ObjectTables};
    /// let (mut objects, mut name_bytes, mut name_ends) = ([Object::UNUSED; 4], [0; 64], [0; 8]);
    /// let memory = ObjectTables { objects: &mut objects, name_bytes: &mut name_bytes, name_ends: &mut name_ends };
    /// let mut set = ObjectSet::new(memory);
    /// let lamp = set.add(ClassId::new(0), "lamp0", &["red"])?;
    /// assert_eq!(set.into_objects().value(lamp, 0), "red");
    /// # Ok::<(), goodbot::oomdp::ObjectError>(())
    /// ```
    pub const fn new(memory: ObjectTables<'t>) -> Self {
        Self { memory, count: ObjectCount::NONE }
    }

    /// The first `count` objects in the tables; more can be added.
    pub const fn with(memory: ObjectTables<'t>, count: ObjectCount) -> Self {
        Self { memory, count }
    }

    /// The numbers of objects and names.
    pub const fn count(&self) -> ObjectCount {
        self.count
    }

    /// The objects, read-only.
    pub const fn read(&self) -> Objects<'_> {
        Objects { memory: self.memory.read(), count: self.count }
    }

    /// The complete set of objects.
    pub fn into_objects(self) -> Objects<'t> {
        let ObjectTables { objects, name_bytes, name_ends } = self.memory;
        Objects { memory: ObjectTablesRef { objects, name_bytes, name_ends }, count: self.count }
    }

    /// Adds an object with its values of the schema's attributes, in their order: `&["", "school"]` if its class does not carry the first
    /// one. `""` means no value, as do values that are left out.
    ///
    /// # Errors
    /// [`ObjectError`]; the set is then unchanged except for names that it may have interned.
    pub fn add(&mut self, class: ClassId, name: &str, values: &[&str]) -> Result<ObjectId, ObjectError> {
        if name.is_empty() {
            return Err(ObjectError::EmptyName);
        }
        if self.read().find(name).is_some() {
            return Err(ObjectError::DuplicateName);
        }
        let limit = self.memory.objects.len().min(usize::from(u8::MAX));
        if self.count.objects >= limit {
            return Err(CapacityError::full(Capacity::Objects, limit).into());
        }
        Capacity::Attributes.fits(values.len(), ATTRIBUTES)?;
        let (bytes, ends) = (&mut *self.memory.name_bytes, &mut *self.memory.name_ends);
        let mut names = Symbols::new(bytes, ends, &mut self.count.names, Capacity::Names, Capacity::NameBytesTogether);
        let mut object = Object { class, name: names.intern(name)?, ..Object::UNUSED };
        for (slot, value) in object.values.iter_mut().zip(values) {
            if !value.is_empty() {
                *slot = names.intern(value)?.0.saturating_add(1);
            }
        }
        let id = ObjectId(self.count.objects as u8);
        if let Some(slot) = self.memory.objects.get_mut(self.count.objects) {
            *slot = object;
        }
        self.count.objects += 1;
        Ok(id)
    }
}

impl<'t> Objects<'t> {
    /// The first `count` objects in the tables.
    pub const fn new(memory: ObjectTablesRef<'t>, count: ObjectCount) -> Self {
        Self { memory, count }
    }

    const fn names(self) -> SymbolsRef<'t> {
        SymbolsRef::new(self.memory.name_bytes, self.memory.name_ends, self.count.names)
    }

    /// The number of objects.
    pub const fn len(self) -> usize {
        self.count.objects
    }

    /// Whether there are no objects.
    pub const fn is_empty(self) -> bool {
        self.count.objects == 0
    }

    /// The object with this identity.
    pub fn get(self, id: ObjectId) -> Option<&'t Object> {
        self.memory.objects.get(..self.count.objects)?.get(id.index())
    }

    /// All objects, in the order in which they were added.
    pub fn iter(self) -> impl Iterator<Item = (ObjectId, &'t Object)> {
        self.iter_all()
    }

    fn iter_all(self) -> EachObject<'t> {
        EachObject { objects: self.memory.objects.split_at_checked(self.count.objects).map_or(&[], |(objects, _)| objects), next: 0 }
    }

    /// The objects of one class, in order.
    pub fn of_class(self, class: ClassId) -> impl Iterator<Item = ObjectId> + use<'t> {
        OfClass { objects: self.iter_all(), class }
    }

    /// The object with this name.
    pub fn find(self, name: &str) -> Option<ObjectId> {
        let name = self.names().find(name)?;
        self.iter().find(|(_, object)| object.name == name).map(|(id, _)| id)
    }

    /// The name of an object; empty for one that the set does not have.
    pub fn name(self, id: ObjectId) -> &'t str {
        self.get(id).map_or("", |object| self.names().text(object.name))
    }

    /// The value of an object's attribute, by the attribute's position in the schema; empty if it has none.
    pub fn value(self, id: ObjectId, attribute: usize) -> &'t str {
        self.get(id).and_then(|object| object.value(attribute)).map_or("", |value| self.names().text(value))
    }

    /// Passes all of its contents to `take`, word by word: the objects, and their names.
    pub(super) fn for_each_word(self, take: &mut impl FnMut(u32)) {
        for (_, object) in self.iter() {
            take(u32::from(object.class.0) << 16 | u32::from(object.name.0));
            for pair in object.values.chunks(2) {
                take(pair.iter().fold(0, |word, &value| word << 16 | u32::from(value)));
            }
        }
        let (bytes, ends) = self.names().parts();
        for_each_word(bytes, take);
        ends.iter().for_each(|&end| take(u32::from(end)));
    }

    /// Sets the used numbers of objects, names and name bytes.
    pub fn usage(self, used: &mut Capacities) {
        (used.objects, used.names, used.name_bytes) = (self.count.objects, self.count.names, self.names().byte_len());
    }
}

/// Passes bytes four at a time.
pub(super) fn for_each_word(bytes: &[u8], take: &mut impl FnMut(u32)) {
    let (words, rest) = bytes.as_chunks();
    words.iter().for_each(|&word| take(u32::from_le_bytes(word)));
    take(rest.iter().fold(0, |word, &byte| word << 8 | u32::from(byte)));
}

/// Iterates over objects. On a page it is one function for all callers; elsewhere inlining takes less flash.
#[derive(Clone)]
struct EachObject<'t> {
    objects: &'t [Object],
    next: usize,
}

/// Iterates over the objects of a class, compiled in the same way.
#[derive(Clone)]
struct OfClass<'t> {
    objects: EachObject<'t>,
    class: ClassId,
}

impl Iterator for OfClass<'_> {
    type Item = ObjectId;

    #[cfg_attr(target_family = "wasm", inline(never))]
    fn next(&mut self) -> Option<ObjectId> {
        loop {
            let (id, object) = self.objects.next()?;
            if object.class == self.class {
                return Some(id);
            }
        }
    }
}

impl<'t> Iterator for EachObject<'t> {
    type Item = (ObjectId, &'t Object);

    #[cfg_attr(target_family = "wasm", inline(never))]
    fn next(&mut self) -> Option<Self::Item> {
        let position = self.next;
        let object = self.objects.get(position)?;
        self.next = position.saturating_add(1);
        Some((ObjectId(position as u8), object))
    }
}
