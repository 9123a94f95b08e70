//! The texts of the interface: a file for each language in `page/languages`, all with the same keys.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context, Result, bail};
use serde_json::{Map, Value};

/// The language that the others are compared with.
const FIRST: &str = "en";
/// The text that `page/src/begin.js` shows in place of the page: it has that text itself.
const IN_PLACE: &str = "noRobot";

/// The texts of all languages, by code and key.
pub struct Languages(BTreeMap<String, Map<String, Value>>);

/// Reads the languages of a folder. It is an error if a language lacks a key, has one too many, or leaves out a value in braces.
pub fn read(folder: &Path) -> Result<Languages> {
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
    Ok(Languages(languages))
}

impl Languages {
    /// All languages, for `takeLanguages` in `page/src/language.js`. A key with a dot that is written in full in the page's scripts or its
    /// body becomes a number there. It is an error if no script and no element has a text's key.
    pub fn number(&self, scripts: &mut String, body: &mut String) -> Result<String> {
        let (mut named, mut numbered) = (Vec::new(), Vec::new());
        for key in self.0[FIRST].keys().filter(|key| *key != IN_PLACE) {
            let uses = [&*scripts, &*body].map(|text| quoted(key).iter().any(|quoted| text.contains(quoted)));
            // Scripts put some keys together: `'color.' + color`.
            let parts = key.match_indices('.').map(|(at, _)| &key[..=at]);
            let put_together = parts.flat_map(opened).any(|part| scripts.contains(&part));
            if !put_together && !uses.contains(&true) && key != "name" {
                bail!("nothing in page/src or page/body.html has the text {key}");
            }
            if put_together || !key.contains('.') { &mut named } else { &mut numbered }.push(key.as_str());
        }
        for (number, key) in numbered.iter().enumerate() {
            for (from, to) in quoted(key).into_iter().zip(quoted(&number.to_string())) {
                *scripts = scripts.replace(&from, &to);
                *body = body.replace(&from, &to);
            }
        }
        let mut all = named.join("\n");
        for (code, texts) in &self.0 {
            all = all + "\n\n" + code;
            for key in named.iter().chain(&numbered) {
                all = all + "\n" + &line(&texts[*key]).with_context(|| format!("page/languages/{code}.json: {key}"))?;
            }
        }
        Ok(all)
    }
}

/// A key as scripts and elements may write it.
fn quoted(key: &str) -> [String; 3] {
    ['"', '\'', '`'].map(|quote| format!("{quote}{key}{quote}"))
}

/// The beginning of a key that a script completes, as scripts may write it.
fn opened(part: &str) -> [String; 4] {
    let [double, single, back] = quoted(part);
    [double, single, back, format!("`{part}$")]
}

/// A text as a line. A text that depends on a number is JSON.
fn line(text: &Value) -> Result<String> {
    match text {
        Value::String(text) if text.contains('\n') || text.starts_with("{\"") => {
            bail!("a text may not have lines of its own, nor begin with {{\"")
        }
        Value::String(text) => Ok(text.clone()),
        forms => Ok(forms.to_string()),
    }
}

fn check(first: &Map<String, Value>, texts: &Map<String, Value>) -> Result<()> {
    for (key, text) in first {
        let Some(other) = texts.get(key) else { bail!("there is no {key}") };
        // The name of a thing needs its colour, in a form of that language.
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

/// The names in braces.
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
    use serde_json::json;

    fn checked(other: Value) -> Result<()> {
        let first = json!({ "hello": "Hello {name}", "n": { "one": "{n} step", "other": "{n} steps" } });
        check(first.as_object().unwrap(), other.as_object().unwrap())
    }

    fn languages(first: Value) -> Languages {
        Languages([(FIRST.to_owned(), first.as_object().unwrap().clone())].into())
    }

    #[test]
    fn every_language_of_the_page_has_every_text() {
        let Languages(all) = read(&Path::new(crate::PAGE).join("languages")).unwrap();
        assert_eq!(all.keys().collect::<Vec<_>>(), ["de", "en", "es", "fr", "zh"]);
    }

    #[test]
    fn keys_become_numbers_unless_a_script_puts_them_together() {
        let all = languages(json!({ "color.red": "red", "n.steps": { "other": "{n} steps" }, "name": "English", "nav.tour": "Tour" }));
        let mut scripts = "t(\"n.steps\"),t(`color.${name}`)".to_owned();
        let mut body = "<a data-t=\"nav.tour\"></a>".to_owned();
        let text = all.number(&mut scripts, &mut body).unwrap();
        assert_eq!(scripts, "t(\"0\"),t(`color.${name}`)");
        assert_eq!(body, "<a data-t=\"1\"></a>");
        assert_eq!(text, "color.red\nname\n\nen\nred\nEnglish\n{\"other\":\"{n} steps\"}\nTour");
    }

    #[test]
    fn a_text_that_nothing_shows_is_refused() {
        let refused = languages(json!({ "name": "English", "nav.tour": "Tour" })).number(&mut String::new(), &mut String::new());
        assert!(refused.unwrap_err().to_string().contains("nav.tour"));
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
