//! `docs/cookbook.md`: its recipes for the command line, in their order in one folder.

use std::fs;
use std::path::Path;
use std::process::Command;

/// The blocks of code in a language.
fn recipes<'d>(document: &'d str, language: &str) -> Vec<&'d str> {
    document.split(&format!("```{language}\n")).skip(1).filter_map(|rest| rest.split("```\n").next()).collect()
}

#[test]
fn each_recipe_works_as_it_is_written() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let document = fs::read_to_string(root.join("docs/cookbook.md")).expect("the document");
    let folder = tempfile::tempdir().expect("a folder");
    let examples = folder.path().join("docs/examples");
    fs::create_dir_all(examples.join("worlds")).expect("a folder");
    for file in ["home.json", "sessions.jsonl", "worlds/lift.json"] {
        fs::copy(root.join("docs/examples").join(file), examples.join(file)).expect("an example");
    }
    let program = Path::new(env!("CARGO_BIN_EXE_goodbot")).parent().expect("a folder");
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(std::iter::once(program.to_owned()).chain(std::env::split_paths(&path))).expect("a path");
    let recipes = recipes(&document, "sh");
    assert!(recipes.len() >= 12, "{} recipes", recipes.len());
    for recipe in recipes {
        assert!(recipe.lines().count() <= 10, "more than ten lines:\n{recipe}");
        let run = Command::new("sh").args(["-ec", recipe]).current_dir(folder.path()).env("PATH", &path).output().expect("a shell");
        let said = [run.stdout, run.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        assert!(run.status.success(), "{recipe}\n{said:?}");
    }
}
