//! The documents name files and crates that exist, and the command that is run.

use std::collections::BTreeMap;
use std::path::Path;

use crate::assert_kept;
use crate::tree::{folders, root, text};
use crate::workspace::{crates, packages};

/// How a path that is named from the root starts.
const PATHS: [&str; 6] = ["crates/", "robots/", "scenarios/", "tests/", "docs/", ".ci/"];

/// What stands at the root, the map, the pages of the book, the list of the lab notebook, and README files where the tests, a
/// crate or a robot have one.
fn documents() -> Vec<String> {
    let of = |folder: &'static str| {
        folders(folder).into_iter().map(move |name| format!("{folder}/{name}/README.md"))
    };
    let top = ["README.md", "CONTRIBUTING.md", "SECURITY.md"].map(str::to_owned);
    let maps = ["crates/README.md", "tests/README.md", "docs/lab/README.md"].map(str::to_owned);
    // Examples in the help of the program name folders of their reader.
    let pages = checks::book::pages().into_iter().filter(|page| page.name != "command-line.md");
    let pages = pages.map(|page| format!("docs/src/{}", page.name));
    let all = top.into_iter().chain(maps).chain(pages).chain(of("crates")).chain(of("robots"));
    all.filter(|path| root().join(path).exists()).collect()
}

/// What stands between backticks, and the lines of fenced blocks.
fn code(document: &str) -> Vec<&str> {
    let mut code = Vec::new();
    for (i, block) in document.split("\n```").enumerate() {
        if i % 2 == 1 {
            // The first line of a fenced block names its language.
            code.extend(block.lines().skip(1));
            continue;
        }
        let paragraphs = block.split("\n\n");
        code.extend(paragraphs.flat_map(|p| p.split('`').skip(1).step_by(2)));
    }
    code
}

/// Paths in code, without those that hold a place for a name.
fn named_paths(document: &str) -> Vec<&str> {
    let words = code(document).into_iter().flat_map(str::split_whitespace);
    let bare = words.map(|word| word.trim_matches(['"', '\'', '(', ')', ',', ';', ':']));
    let bare = bare.map(|word| word.trim_end_matches('.'));
    bare.filter(|word| PATHS.iter().any(|start| word.starts_with(start)) || is_source(word))
        .filter(|word| !word.contains(['<', '*', '{', '…', '$']))
        .collect()
}

/// A file of the crate whose README it stands in.
fn is_source(word: &str) -> bool {
    word.ends_with(".rs") && !word.contains('/')
}

/// Targets of links and pictures that lie in the checkout.
fn links(document: &str) -> Vec<&str> {
    let targets = document.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    let files = targets.map(|(target, _)| target.split('#').next().unwrap_or_default());
    files.filter(|file| !file.is_empty() && !file.contains(':')).collect()
}

/// Names said to be a crate: before or after that word, or behind cargo's `-p`.
fn named_crates(document: &str) -> Vec<&str> {
    let mut names = Vec::new();
    for paragraph in document.split("\n\n") {
        let pieces: Vec<&str> = paragraph.split('`').collect();
        let said = |i: &usize| {
            pieces[i - 1].trim_end().ends_with("crate")
                || pieces.get(i + 1).is_some_and(|next| next.trim_start().starts_with("crate"))
        };
        names.extend((1..pieces.len()).step_by(2).filter(said).map(|i| pieces[i]));
    }
    for command in code(document).into_iter().filter(|line| line.trim().starts_with("cargo ")) {
        let words: Vec<&str> = command.split_whitespace().collect();
        let behind = words.windows(2).filter(|pair| pair[0] == "-p").map(|pair| pair[1]);
        names.extend(behind);
    }
    names
}

/// What a document names and what is not there. `path` is the document's own.
fn broken(path: &str, document: &str, names: &[String]) -> Vec<String> {
    let folder = root().join(path).parent().unwrap().to_owned();
    let missing_path = |word: &&str| {
        let base = if is_source(word) { folder.join("src") } else { root() };
        !base.join(word).exists()
    };
    let missing_link = |target: &&str| !folder.join(Path::new(target)).exists();
    let mut missing: Vec<&str> = named_paths(document).into_iter().filter(missing_path).collect();
    missing.extend(links(document).into_iter().filter(missing_link));
    let unknown = |name: &&str| !names.iter().any(|n| n == name);
    missing.extend(named_crates(document).into_iter().filter(unknown));
    missing.iter().map(|word| format!("{path} names {word}, which is not there")).collect()
}

/// Rows of the table of floors: a level, then a name in backticks.
fn floors(map: &str) -> BTreeMap<&str, u32> {
    map.lines()
        .filter_map(|line| {
            let mut cells = line.strip_prefix('|')?.split('|').map(str::trim);
            let level = cells.next()?.parse().ok()?;
            Some((cells.next()?.strip_prefix('`')?.strip_suffix('`')?, level))
        })
        .collect()
}

/// The command that tests, as the document gives it.
fn test_command(document: &str) -> Option<&str> {
    let command = code(document).into_iter().find(|line| line.trim().starts_with("cargo test"))?;
    command.split('#').next().map(str::trim)
}

/// Whether a line of the script runs exactly `command`.
fn runs(script: &str, command: &str) -> bool {
    script.lines().any(|line| line.trim().strip_prefix("step ") == Some(command))
}

#[test]
fn documents_name_what_exists() {
    let names: Vec<String> = packages().into_iter().map(|p| p.name).collect();
    let of = |path: &String| broken(path, &text(path), &names);
    assert_kept(&documents().iter().flat_map(of).collect::<Vec<_>>());
}

#[test]
fn the_map_shows_every_crate_on_its_floor() {
    let map = text("crates/README.md");
    let crates = crates();
    let expected = crates.iter().map(|p| (p.name.as_str(), p.floor().unwrap())).collect();
    assert_eq!(floors(&map), expected);
}

#[test]
fn the_script_runs_the_test_command_of_the_readme() {
    let readme = text("README.md");
    let command = test_command(&readme);
    let script = text(".ci/run");
    assert!(command.is_some_and(|command| runs(&script, command)), "{command:?}\n{script}");
}

/// The pages of the lab notebook. Commands and paths in them are those of their day, so that links alone are held.
#[test]
fn the_lab_notebook_lists_every_page_by_its_day() {
    let list = text("docs/lab/README.md");
    let mut named = links(&list);
    let folder = root().join("docs/lab");
    let files = std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name());
    let pages = files.map(|name| name.into_string().unwrap()).filter(|name| name != "README.md");
    let mut pages: Vec<String> = pages.collect();
    named.sort_unstable();
    pages.sort_unstable();
    assert_eq!(named, pages);
    for page in &pages {
        let day = |c: char| c.is_ascii_digit() || c == '-';
        assert!(page.len() > 11 && page[..11].chars().all(day), "{page} has no day");
        let text = text(&format!("docs/lab/{page}"));
        let missing = links(&text).into_iter().filter(|target| !folder.join(target).exists());
        assert_eq!(missing.collect::<Vec<_>>(), Vec::<&str>::new(), "{page}");
    }
}

#[test]
fn what_is_not_there_is_reported() {
    let document = "See `crates/robot` and `crates/ghost/src`, `mirage.rs`, [this](gone.md).\n\n\
                    The `phantom` crate, the crate `robot`.\n\n\
                    ```\nmkdir -p out\n\
                    cargo run -p spectre -- robots/shade/robot.toml\n```\n\
                    Then `tests/spirit.rs`; `robots/<name>/robot.toml` is a pattern.\n";
    let missing = broken("crates/robot/README.md", document, &["robot".to_owned()]);
    let expected = [
        "crates/ghost/src",
        "mirage.rs",
        "robots/shade/robot.toml",
        "tests/spirit.rs",
        "gone.md",
        "phantom",
        "spectre",
    ];
    let expected =
        expected.map(|e| format!("crates/robot/README.md names {e}, which is not there"));
    assert_eq!(missing, expected);
}

#[test]
fn the_table_of_floors_is_read_row_by_row() {
    let map = "| floor | crate |\n|---|---|\n| 0 | `robot` | data |\n| 2 | simulator |\n";
    assert_eq!(floors(map), BTreeMap::from([("robot", 0)]));
}

#[test]
fn a_test_command_that_is_not_run_is_reported() {
    let readme = "First\n\n```\ncargo run\ncargo test --release  # all\n```\n";
    assert_eq!(test_command(readme), Some("cargo test --release"));
    assert!(runs("step cargo fmt\nstep cargo test --release\n", "cargo test --release"));
    assert!(!runs("step cargo test --release --workspace\n", "cargo test --release"));
    assert!(!runs("# step cargo test --release\n", "cargo test --release"));
}
