//! The objects of one environment: a set of fixed capacity, in memory that the caller lends.

use super::schema::ClassId;
use crate::capacity::{ATTRIBUTES, Capacity, CapacityError};
use crate::symbols::{Symbol, Symbols};

/// An object, by its position in its [`ObjectSet`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct ObjectId(pub u8);

impl ObjectId {
    /// The position in the set.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// One object: its class, its name, and the value of each attribute of the schema (none where its class does not carry it).
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
    /// What unused memory holds: zeros, so that a static needs no room in flash.
    pub const UNUSED: Self = Self { class: ClassId(0), name: Symbol(0), values: [0; ATTRIBUTES] };

    /// The value of an attribute, by the attribute's position in the schema.
    pub fn value(&self, attribute: usize) -> Option<Symbol> {
        self.values.get(attribute)?.checked_sub(1).map(Symbol)
    }
}

/// Memory for an [`ObjectSet`].
#[derive(Debug)]
pub struct ObjectMemory<'m> {
    /// One entry an object.
    pub objects: &'m mut [Object],
    /// Names and attribute values.
    pub name_bytes: &'m mut [u8],
    /// One entry a name or value.
    pub name_ends: &'m mut [u16],
}

/// Why an object could not be added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObjectError {
    /// Another object has this name.
    DuplicateName,
    /// The name is empty.
    EmptyName,
    /// Something was full.
    Capacity(CapacityError),
}

impl From<CapacityError> for ObjectError {
    fn from(error: CapacityError) -> Self {
        Self::Capacity(error)
    }
}

/// The objects of one environment.
#[derive(Debug)]
pub struct ObjectSet<'m> {
    objects: &'m mut [Object],
    len: usize,
    names: Symbols<'m>,
}

impl<'m> ObjectSet<'m> {
    /// An empty set.
    pub fn new(memory: ObjectMemory<'m>) -> Self {
        let names = Symbols::new(memory.name_bytes, memory.name_ends, Capacity::Names, Capacity::NameBytesTogether);
        Self { objects: memory.objects, len: 0, names }
    }

    /// Adds an object with the given attribute values; `""` stands for no value.
    ///
    /// # Errors
    /// [`ObjectError`]; the set is then unchanged but for names it may have interned.
    pub fn add(&mut self, class: ClassId, name: &str, values: &[&str]) -> Result<ObjectId, ObjectError> {
        if name.is_empty() {
            return Err(ObjectError::EmptyName);
        }
        if self.find(name).is_some() {
            return Err(ObjectError::DuplicateName);
        }
        let limit = self.objects.len().min(usize::from(u8::MAX));
        if self.len >= limit {
            return Err(CapacityError::full(Capacity::Objects, limit).into());
        }
        if values.len() > ATTRIBUTES {
            return Err(CapacityError::new(Capacity::Attributes, ATTRIBUTES, values.len()).into());
        }
        let mut object = Object { class, name: self.names.intern(name)?, ..Object::UNUSED };
        for (slot, value) in object.values.iter_mut().zip(values) {
            if !value.is_empty() {
                *slot = self.names.intern(value)?.0.saturating_add(1);
            }
        }
        let id = ObjectId(self.len as u8);
        if let Some(slot) = self.objects.get_mut(self.len) {
            *slot = object;
        }
        self.len = self.len.saturating_add(1);
        Ok(id)
    }

    /// How many objects there are.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The object with this identity.
    pub fn get(&self, id: ObjectId) -> Option<&Object> {
        self.objects.get(..self.len)?.get(id.index())
    }

    /// All objects, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = (ObjectId, &Object)> {
        self.objects.iter().take(self.len).enumerate().map(|(position, object)| (ObjectId(position as u8), object))
    }

    /// The objects of one class, in order.
    pub fn of_class(&self, class: ClassId) -> impl Iterator<Item = ObjectId> {
        self.iter().filter(move |(_, object)| object.class == class).map(|(id, _)| id)
    }

    /// The object with this name.
    pub fn find(&self, name: &str) -> Option<ObjectId> {
        let name = self.names.find(name)?;
        self.iter().find(|(_, object)| object.name == name).map(|(id, _)| id)
    }

    /// The name of an object; empty for one that the set does not have.
    pub fn name(&self, id: ObjectId) -> &str {
        self.get(id).map_or("", |object| self.names.text(object.name))
    }

    /// The text of an attribute value.
    pub fn value_text(&self, value: Symbol) -> &str {
        self.names.text(value)
    }

    /// The value of an object's attribute, by the attribute's position in the schema; empty where it has none.
    pub fn value(&self, id: ObjectId, attribute: usize) -> &str {
        self.get(id).and_then(|object| object.value(attribute)).map_or("", |value| self.names.text(value))
    }
}
