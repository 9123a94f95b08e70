//! The documents as web pages, by mdBook.

use super::archive::{Texts, files, pack};
use super::npm;
use crate::process::root;
use crate::programs::{Missing, installed_by_cargo, npm_packages};
use anyhow::Result;
use std::path::{Component, Path};
use xshell::{Shell, cmd};

const DOCS: &str = "docs";
/// The belief that a reader moves, in the page about how it works.
const PICTURE: &str = "belief.js";

/// Renders a copy of the documents, with README.md as the first page.
pub fn make(sh: &Shell, texts: &Texts, to: &Path) -> Result<()> {
    let mdbook = installed_by_cargo(sh, "mdbook")?;
    let above = sh.create_temp_dir()?;
    let copy = above.path().join("copy");
    let docs = sh.current_dir().join(DOCS);
    for file in files(sh, &docs)? {
        let place = copy.join(file.strip_prefix(&docs)?);
        if file.extension().is_some_and(|end| end == "md") {
            let folder = file.strip_prefix(&docs)?.parent().unwrap_or(Path::new(""));
            sh.write_file(place, within(&sh.read_file(&file)?, folder))?;
        } else {
            sh.write_file(place, sh.read_binary_file(&file)?)?;
        }
    }
    sh.write_file(copy.join("README.md"), within(&sh.read_file("README.md")?.replace("](docs/", "]("), Path::new("")))?;
    if let Err(error) = picture(sh, texts, &above.path().join("npm"), &copy.join(PICTURE)) {
        let missing = error.downcast::<Missing>()?;
        eprintln!("remark: the belief in the guide does not move, for lack of {missing}");
        sh.write_file(copy.join(PICTURE), "// Built without the robot: a still picture takes its place.\n")?;
    }
    let name = format!("goodbot-guide-{}", texts.text("@VERSION@"));
    let folder = above.path().join(&name);
    cmd!(sh, "{mdbook} build {copy} --dest-dir {folder}").run()?;
    pack(sh, &folder, &to.join(format!("{name}.zip")))
}

/// The robot of the npm package and the picture as one script, which also runs in a page from a file.
fn picture(sh: &Shell, texts: &Texts, folder: &Path, to: &Path) -> Result<()> {
    crate::page::build()?;
    npm_packages()?;
    npm::describe(sh, texts, folder)?;
    let esbuild = root().join("page/node_modules/.bin/esbuild");
    let options = ["--bundle", "--minify", "--format=iife", "--loader:.jsonl=text", "--log-level=warning"];
    Ok(cmd!(sh, "{esbuild} wasm/guide/belief.mjs {options...} --alias:goodbot={folder}/index.js --outfile={to}").run()?)
}

/// A document of this folder of the book, whose links lead to files of the book alone: of another link the text stays.
fn within(document: &str, folder: &Path) -> String {
    let mut kept = String::new();
    let mut rest = document;
    while let Some((before, after)) = rest.split_once("](") {
        let (target, behind) = after.split_once(')').unwrap_or((after, ""));
        let is_file = !target.contains("://") && !target.starts_with('#');
        let leaves = is_file && !is_in_book(folder, target.split('#').next().unwrap_or_default());
        match before.rfind('[').filter(|_| leaves && !before.ends_with(']')) {
            Some(bracket) => kept += &[&before[..bracket], &before[bracket + 1..]].concat(),
            None => kept += &[before, "](", target, ")"].concat(),
        }
        rest = behind;
    }
    kept + rest
}

/// Whether a link's path, from a folder of the book, leads to one of its files. Its first page is above the folder of the others.
fn is_in_book(folder: &Path, path: &str) -> bool {
    let mut place = folder.to_owned();
    for part in Path::new(path).components() {
        match part {
            Component::ParentDir if !place.pop() => return false,
            Component::ParentDir => {}
            part => place.push(part),
        }
    }
    place == Path::new("README.md") || root().join(DOCS).join(place).is_file()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::process::shell;

    /// The targets of a document's links.
    fn links(document: &str) -> impl Iterator<Item = &str> {
        document.split("](").skip(1).filter_map(|rest| rest.split_once(')').map(|(target, _)| target))
    }

    /// A heading's name in links, as hosts of repositories make it.
    fn anchor(heading: &str) -> String {
        let kept = heading.trim().to_lowercase().replace(' ', "-");
        kept.chars().filter(|c| c.is_alphanumeric() || "-_".contains(*c)).collect()
    }

    /// The documents, each with its path.
    fn documents() -> Vec<(String, String)> {
        let sh = shell().unwrap();
        let names = cmd!(sh, "git ls-files --cached --others --exclude-standard -- *.md").quiet().read().unwrap();
        let there = names.lines().filter(|name| sh.path_exists(name));
        there.map(|name| (name.to_owned(), sh.read_file(name).unwrap())).collect()
    }

    #[test]
    fn each_link_of_a_document_leads_to_a_file_and_to_a_heading_of_it() {
        let (sh, mut dead) = (shell().unwrap(), Vec::new());
        // The first page of the book is above its folder.
        for (name, text) in documents().into_iter().map(|(name, text)| (name, text.replace("[goodbot](README.md)", ""))) {
            let folder = sh.current_dir().join(Path::new(&name).parent().unwrap());
            let mut is_code = false;
            let prose = text.lines().filter(|line| {
                is_code ^= line.trim_start().starts_with("```");
                !is_code
            });
            for link in prose.flat_map(links).filter(|link| !link.contains("://") && !link.contains('`')) {
                let (path, heading) = link.split_once('#').unwrap_or((link, ""));
                let file = if path.is_empty() { sh.current_dir().join(&name) } else { folder.join(path) };
                let has_heading = heading.is_empty()
                    || sh.read_file(&file).is_ok_and(|text| {
                        text.lines().any(|line| line.starts_with('#') && anchor(line.trim_start_matches('#')) == heading)
                    });
                if !file.exists() || !has_heading {
                    dead.push(format!("{name}: {link}"));
                }
            }
        }
        assert!(dead.is_empty(), "{dead:#?}");
    }

    #[test]
    fn the_contents_name_each_document_once() {
        let sh = shell().unwrap();
        let contents = sh.read_file(Path::new(DOCS).join("SUMMARY.md")).unwrap();
        let named: Vec<_> = links(&contents).filter(|name| *name != "README.md").collect();
        let there: BTreeSet<_> = documents().into_iter().filter_map(|(name, _)| name.strip_prefix("docs/").map(str::to_owned)).collect();
        let there: BTreeSet<_> =
            there.iter().map(String::as_str).filter(|name| !name.starts_with("examples/") && *name != "SUMMARY.md").collect();
        assert_eq!(named.len(), there.len());
        assert_eq!(named.into_iter().collect::<BTreeSet<_>>(), there);
    }

    #[test]
    fn links_out_of_the_book_become_text() {
        assert_eq!(
            within("See [files](files.md#a-home), [code](../core) and [a folder](examples).", Path::new("")),
            "See [files](files.md#a-home), code and a folder."
        );
        let others = "[us](https://a.b/c) [above](#top) ![p](page.png)";
        assert_eq!(within(others, Path::new("")), others);
    }

    #[test]
    fn links_from_a_folder_of_the_book_lead_to_its_other_pages() {
        assert_eq!(
            within(
                "See [files](../files.md#a-home), [the course](experiment.md), [code](../../core) and [us](../../README.md).",
                Path::new("appendix")
            ),
            "See [files](../files.md#a-home), [the course](experiment.md), code and us."
        );
    }
}
