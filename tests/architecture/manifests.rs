//! What a manifest says: the workspace's lints, version and edition, and one sentence.

use toml::Table;

use crate::assert_kept;
use crate::tree::text;
use crate::workspace::packages;

/// Keys of `[package]` that the workspace sets for all.
const INHERITED: [&str; 5] = ["version", "edition", "rust-version", "license", "publish"];

fn broken(manifest: &str) -> Vec<String> {
    let manifest: Table = match manifest.parse() {
        Ok(manifest) => manifest,
        Err(error) => return vec![format!("no manifest: {error}")],
    };
    let from_workspace = |table: &str, key: Option<&str>| {
        let table = manifest.get(table)?;
        let value = key.map_or(Some(table), |key| table.get(key))?;
        value.get("workspace")?.as_bool()
    };
    let mut broken = Vec::new();
    if from_workspace("lints", None) != Some(true) {
        broken.push("[lints] is not the workspace's".to_owned());
    }
    let own = INHERITED.iter().filter(|key| from_workspace("package", Some(key)) != Some(true));
    broken.extend(own.map(|key| format!("{key} is not the workspace's")));
    let description = manifest.get("package").and_then(|p| p.get("description")?.as_str());
    broken.extend(not_a_sentence(description.unwrap_or_default()));
    broken
}

/// One sentence: a capital first, several words, one full stop, last.
fn not_a_sentence(text: &str) -> Option<String> {
    let starts = text.chars().next().is_some_and(char::is_uppercase);
    let words = text.split_whitespace().count() >= 3;
    let ends = text.ends_with('.') && !text.contains(". ") && !text.contains('\n');
    let sentence = starts && words && ends;
    (!sentence).then(|| format!("the description is not one sentence: {text:?}"))
}

#[test]
fn manifests_inherit_from_the_workspace_and_say_one_sentence() {
    let mut all = Vec::new();
    for folder in packages().iter().map(|p| p.folder()) {
        let path = format!("{folder}/Cargo.toml");
        all.extend(broken(&text(&path)).iter().map(|b| format!("{path}: {b}")));
    }
    assert_kept(&all);
}

#[test]
fn a_manifest_that_goes_its_own_way_is_reported() {
    let manifest = r#"
        [package]
        version = "0.2.0"
        edition.workspace = true
        rust-version.workspace = true
        license.workspace = true
        publish.workspace = false
        [lints]
        workspace = false
    "#;
    let expected = [
        "[lints] is not the workspace's",
        "version is not the workspace's",
        "publish is not the workspace's",
        "the description is not one sentence: \"\"",
    ];
    assert_eq!(broken(manifest), expected);
}

#[test]
fn only_a_sentence_is_a_sentence() {
    assert_eq!(not_a_sentence("Reads robot.toml and more."), None);
    for text in ["", "Robots.", "reads a log file.", "Reads a log file", "Reads logs. Writes logs."]
    {
        assert!(not_a_sentence(text).is_some(), "{text}");
    }
}
