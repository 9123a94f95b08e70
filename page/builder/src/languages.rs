//! The texts of the interface: a file for each language in `page/languages`, all with the same keys.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context, Result, bail};
use serde_json::{Map, Value, json};

/// The language that the others are compared with.
const FIRST: &str = "en";

/// All languages as one JSON text: the keys once, and for each language's code its texts in their order. It is an error if a language lacks
/// a key, has one too many, or leaves out what stands in braces.
pub fn read(folder: &Path) -> Result<Vec<u8>> {
    let mut languages = BTreeMap::new();
    for entry in std::fs::read_dir(folder).with_context(|| format!("{} cannot be read", folder.display()))? {
        let path = entry?.path();
        let text = std::fs::read_to_string(&path).with_context(|| format!("{} cannot be read", path.display()))?;
        let texts: Map<String, Value> = serde_json::from_str(&text).with_context(|| format!("{} is no JSON object", path.display()))?;
        languages.insert(path.file_stem().unwrap_or_default().to_string_lossy().into_owned(), texts);
    }
    let first = languages.get(FIRST).with_context(|| format!("page/languages has no {FIRST}.json"))?;
    for (code, texts) in &languages {
        check(first, texts).with_context(|| format!("page/languages/{code}.json"))?;
    }
    let keys: Vec<&String> = first.keys().collect();
    let mut joined = json!({ "keys": keys });
    for (code, texts) in &languages {
        joined[code.as_str()] = keys.iter().map(|key| texts[key.as_str()].clone()).collect();
    }
    Ok(joined.to_string().into_bytes())
}

fn check(first: &Map<String, Value>, texts: &Map<String, Value>) -> Result<()> {
    for (key, text) in first {
        let Some(other) = texts.get(key) else { bail!("there is no {key}") };
        // What a thing is called needs its colour, in the form that the language has.
        if !key.starts_with("thing.") && !key.starts_with("label.") && places(text) != places(other) {
            bail!("{key} must have {:?}, and has {:?}", places(text), places(other));
        }
        if leaves(other).iter().any(|text| text.trim().is_empty()) {
            bail!("{key} is empty");
        }
    }
    match texts.keys().find(|key| !first.contains_key(*key)) {
        Some(key) => bail!("there is no {key} in {FIRST}.json"),
        None => Ok(()),
    }
}

/// What stands in braces.
fn places(text: &Value) -> BTreeSet<String> {
    leaves(text).iter().flat_map(|text| text.split('{').skip(1)).filter_map(|part| Some(part.split_once('}')?.0.to_owned())).collect()
}

fn leaves(text: &Value) -> Vec<&str> {
    match text {
        Value::String(text) => vec![text],
        Value::Object(forms) => forms.values().flat_map(leaves).collect(),
        _ => vec![""],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(other: Value) -> Result<()> {
        let first = json!({ "hello": "Hello {name}", "n": { "one": "{n} step", "other": "{n} steps" } });
        check(first.as_object().unwrap(), other.as_object().unwrap())
    }

    #[test]
    fn every_language_of_the_page_has_every_text() {
        let joined: Value = serde_json::from_slice(&read(&Path::new(crate::PAGE).join("languages")).unwrap()).unwrap();
        for code in ["de", "en", "es", "fr", "zh"] {
            assert_eq!(joined[code].as_array().unwrap().len(), joined["keys"].as_array().unwrap().len(), "{code}");
        }
    }

    #[test]
    fn a_language_with_other_forms_of_a_number_is_complete() {
        assert!(checked(json!({ "hello": "{name}！", "n": { "other": "{n}" } })).is_ok());
    }

    #[test]
    fn a_text_that_is_missing_too_many_empty_or_without_its_value_is_refused() {
        for (other, why) in [
            (json!({ "hello": "{name}" }), "there is no n"),
            (json!({ "hello": "{name}", "n": "{n}", "more": "x" }), "more"),
            (json!({ "hello": "Hi", "n": "{n}" }), "hello must have"),
            (json!({ "hello": "{name}", "n": { "other": "{n}", "one": " " } }), "n is empty"),
        ] {
            let refused = checked(other).unwrap_err().to_string();
            assert!(refused.contains(why), "{refused}");
        }
    }
}
