//! What an object or a list holds, as slices of the text, up to a limit.

use std::fmt;

use serde::de::{Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

/// The most entries that an object or a list may have; more would take much memory for little text.
pub(super) const LIMIT: usize = 1 << 16;

/// A field of an object.
pub(super) struct Member<'a> {
    pub(super) name: String,
    pub(super) key: &'a RawValue,
    pub(super) value: &'a RawValue,
}

/// The fields of an object, if they are not too many.
pub(super) fn members(object: &RawValue) -> Result<Option<Vec<Member<'_>>>, serde_json::Error> {
    serde_json::Deserializer::from_str(object.get()).deserialize_map(Members)
}

/// The items of a list, if they are not too many.
pub(super) fn items(list: &RawValue) -> Result<Option<Vec<&RawValue>>, serde_json::Error> {
    serde_json::Deserializer::from_str(list.get()).deserialize_seq(Items)
}

struct Members;

impl<'a> Visitor<'a> for Members {
    type Value = Option<Vec<Member<'a>>>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'a>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut members = Vec::new();
        while members.len() < LIMIT {
            let Some((key, value)) = map.next_entry::<&RawValue, &RawValue>()? else {
                return Ok(Some(members));
            };
            let name = serde_json::from_str(key.get()).map_err(A::Error::custom)?;
            members.push(Member { name, key, value });
        }
        let mut more = false;
        while map.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {
            more = true;
        }
        Ok(Some(members).filter(|_| !more))
    }
}

struct Items;

impl<'a> Visitor<'a> for Items {
    type Value = Option<Vec<&'a RawValue>>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'a>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut items = Vec::new();
        while items.len() < LIMIT {
            match seq.next_element()? {
                Some(item) => items.push(item),
                None => return Ok(Some(items)),
            }
        }
        let mut more = false;
        while seq.next_element::<IgnoredAny>()?.is_some() {
            more = true;
        }
        Ok(Some(items).filter(|_| !more))
    }
}
