//! The crates that the project depends on. docs/appendix/dependencies.md must give the reason for each.

#[cfg(test)]
mod tests {
    use crate::process::{packages, root, shell};
    use anyhow::Result;
    use std::collections::{BTreeMap, BTreeSet};

    /// The manifests of all workspaces.
    const MANIFESTS: [&str; 3] = ["Cargo.toml", "tests/fuzz/Cargo.toml", "firmware/Cargo.toml"];

    /// Every direct dependency outside the project, with the crates that depend on it.
    fn direct() -> Result<BTreeMap<String, BTreeSet<String>>> {
        let sh = shell()?;
        let (mut own, mut direct) = (BTreeSet::new(), BTreeMap::<String, BTreeSet<String>>::new());
        for manifest in MANIFESTS {
            for package in packages(&sh, manifest)? {
                let name = package["name"].as_str().unwrap_or_default();
                own.insert(name.to_owned());
                for dependency in package["dependencies"].as_array().into_iter().flatten() {
                    let dependency = dependency["name"].as_str().unwrap_or_default();
                    direct.entry(dependency.to_owned()).or_default().insert(name.to_owned());
                }
            }
        }
        direct.retain(|name, _| !own.contains(name));
        Ok(direct)
    }

    #[test]
    fn each_direct_dependency_has_its_reason_and_no_reason_is_left_over() {
        let document = std::fs::read_to_string(root().join("docs/appendix/dependencies.md")).unwrap();
        let reason = |line: &str| line.strip_prefix("- `")?.split_once('`').map(|(name, _)| name.to_owned());
        let explained: BTreeSet<String> = document.lines().filter_map(reason).collect();
        let direct = direct().unwrap();
        let unexplained: Vec<_> = direct.iter().filter(|(name, _)| !explained.contains(*name)).collect();
        assert!(unexplained.is_empty(), "say in docs/appendix/dependencies.md why they are there: {unexplained:?}");
        let left: Vec<_> = explained.iter().filter(|name| !direct.contains_key(*name)).collect();
        assert!(left.is_empty(), "no crate depends on them, so take them out of docs/appendix/dependencies.md: {left:?}");
    }
}
