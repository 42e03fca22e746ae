//! Files that someone names are read in one place, and each option and key that names one is tried with what is no file.

use std::collections::BTreeSet;

use checks::named_keys::KEYS;

use crate::assert_kept;
use crate::tree::{rust_files, text};

/// Ways of the standard library to open a file.
const OPENERS: [&str; 4] = ["File::open(", "fs::read(", "fs::read_to_string(", "OpenOptions::new("];

/// Sources that open what nobody names: the operating system's own files, and folders whose names go to the disk.
const OWN: [&str; 6] = [
    "crates/benchmark/src/panel/peak_memory.rs",
    "crates/bench_cli/src/commands/times/curves.rs",
    "crates/files/src/named_file.rs",
    "crates/learner/src/memory.rs",
    "crates/logs/src/writing/leftovers.rs",
    "crates/logs/src/writing/whole_file.rs",
];

/// The sources of all crates.
fn sources() -> impl Iterator<Item = String> {
    rust_files("crates").into_iter().filter(|path| path.contains("/src/"))
}

/// Lines of a source up to its tests.
fn program(text: &str) -> impl Iterator<Item = &str> {
    text.lines().take_while(|line| line.trim() != "#[cfg(test)]")
}

fn opened(path: &str, text: &str) -> Vec<String> {
    let is_whole = |line: &str, at: usize| !line[..at].ends_with(char::is_alphanumeric);
    let opens = |line: &&str| {
        let mut found = OPENERS.iter().flat_map(|opener| line.match_indices(opener));
        !line.trim_start().starts_with("//") && found.any(|(at, _)| is_whole(line, at))
    };
    program(text).filter(opens).map(|line| format!("{path}: {}", line.trim())).collect()
}

/// The type and the field of everything in a source that takes the name of a file from a user.
fn named(text: &str) -> Vec<(String, String)> {
    let (mut derived, mut owner, mut fields) = (String::new(), None, Vec::new());
    for line in program(text) {
        if line.starts_with("#[derive(") {
            derived = line.to_owned();
        }
        let words: Vec<&str> = line
            .trim_start_matches("pub(crate) ")
            .trim_start_matches("pub ")
            .split_whitespace()
            .collect();
        match words.as_slice() {
            ["struct" | "enum", name, ..] if !line.starts_with(' ') => {
                let reads = ["Args", "Parser", "Deserialize"].iter().any(|of| {
                    derived.split(|c: char| !c.is_alphanumeric()).any(|word| word == *of)
                });
                owner = reads.then(|| name.split('<').next().unwrap_or(name).to_owned());
                derived.clear();
            }
            ["}", ..] if !line.starts_with(' ') => owner = None,
            _ => {}
        }
        let Some(owner) =
            owner.as_ref().filter(|_| line.starts_with("    ") && line.contains("PathBuf"))
        else {
            continue;
        };
        let field = line.trim().trim_start_matches("pub(crate) ").trim_start_matches("pub ");
        let field: String =
            field.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        if !field.is_empty() {
            fields.push((owner.clone(), field));
        }
    }
    fields
}

#[test]
fn what_someone_names_is_opened_in_one_place() {
    let sources = sources().filter(|path| !OWN.contains(&path.as_str()));
    let broken: Vec<String> = sources.flat_map(|path| opened(&path, &text(&path))).collect();
    assert_kept(&broken);
}

#[test]
fn an_opened_file_is_reported() {
    let source = "fn read() {\n    let a = std::fs::read(path);\n    // fs::read(\n}\n#[cfg(test)]\nfn t() { fs::read(a) }";
    assert_eq!(opened("a.rs", source), ["a.rs: let a = std::fs::read(path);"]);
}

#[test]
fn every_key_that_names_a_file_is_tried() {
    let found: BTreeSet<(String, String, String)> = sources()
        .flat_map(|path| {
            let source = text(&path);
            let path = path.trim_start_matches("crates/").to_owned();
            named(&source)
                .into_iter()
                .map(move |(owner, field)| (path.clone(), owner, field))
                .collect::<Vec<_>>()
        })
        .collect();
    let tried: BTreeSet<(String, String, String)> = KEYS
        .iter()
        .map(|(path, owner, field, _)| ((*path).into(), (*owner).into(), (*field).into()))
        .collect();
    assert_eq!(tried, found, "tests/support/named_keys.rs lists the keys that name files");
}

#[test]
fn a_new_key_is_found() {
    let source = "#[derive(Debug, Args)]\npub struct New<'a> {\n    /// PathBuf.\n    #[arg(long)]\n    pub file: Option<PathBuf>,\n}\n\
                  #[derive(Debug)]\nstruct Other {\n    file: PathBuf,\n}\n";
    assert_eq!(named(source), [("New".to_owned(), "file".to_owned())]);
}
