//! What installs the project: the distribution of PyPI has a name of its own, since `plumbline` is another project there and
//! in cargo's registry, and until it is published every text that tells it says so.

use crate::assert_kept;
use crate::tree::{files, text};

/// Name of the distribution.
const NAME: &str = "plumbline-robotics";

/// The project of others, the module and the program of this one.
const TAKEN: &str = "plumbline";

/// Commands that install every package behind them.
const INSTALLERS: [&str; 6] =
    ["pip install", "pipx install", "uv add", "uv tool install", "cargo install", "cargo add"];

/// Commands that run a program of the package behind them, or of the one behind `--from`.
const RUNNERS: [&str; 3] = ["uvx", "pipx run", "uv tool run"];

/// Folders whose files tell something, beside the files at the root.
const FOLDERS: [&str; 7] = [".ci", ".github", "crates", "docs", "robots", "scenarios", "tests"];

const ENDINGS: [&str; 11] =
    ["html", "ipynb", "md", "py", "pyi", "rs", "run", "sh", "toml", "yaml", "yml"];

/// What a text says while nothing is published, as the list of changes does.
const UNPUBLISHED: &str = "not published yet";

/// Packages that a line installs, without extras and versions.
fn installed(line: &str) -> Vec<String> {
    let behind = |command: &'static str| {
        let pieces = line.split(command).skip(1);
        pieces.map(|rest| rest.split(['`', '&', ';', '#', '|', '\\']).next().unwrap_or_default())
    };
    let words = |rest: &str| {
        let words =
            rest.split_whitespace().filter(|word| *word == "--from" || !word.starts_with('-'));
        let bare = words.map(|word| word.trim_matches(['"', '\'', '(', ')', ',', '.', ':']));
        let bare =
            bare.map(|word| word.split(['[', '=', '<', '>', '~', '@']).next().unwrap_or_default());
        bare.map(str::to_owned).collect::<Vec<_>>()
    };
    let run = |rest: &str| {
        let words = words(rest);
        let from = words.iter().position(|word| word == "--from").map_or(0, |at| at + 1);
        words.get(from).cloned()
    };
    let mut packages: Vec<String> =
        INSTALLERS.into_iter().flat_map(behind).flat_map(words).collect();
    packages.extend(RUNNERS.into_iter().flat_map(behind).filter_map(run));
    packages
}

/// Lines of a file that install a package of others.
fn others(path: &str, text: &str) -> Vec<String> {
    let lines = text.lines().enumerate();
    let taken = lines.filter(|(_, line)| installed(line).iter().any(|package| package == TAKEN));
    let line = |(i, _)| format!("{path}:{}: installs {TAKEN}, which is another project", i + 1);
    taken.map(line).collect()
}

/// That a file installs the distribution and leaves out that it is not published yet.
fn promises(path: &str, text: &str) -> Option<String> {
    let tells = text.lines().flat_map(installed).any(|package| package == NAME);
    let says = text.split_whitespace().collect::<Vec<_>>().join(" ").contains(UNPUBLISHED);
    (tells && !says)
        .then(|| format!("{path}: installs {NAME} and leaves out that it is {UNPUBLISHED}"))
}

/// Whether the list of changes says that a version is out.
fn is_published(changes: &str, version: &str) -> bool {
    let heading = changes.lines().find(|line| line.starts_with(&format!("## {version}")));
    heading.is_some_and(|line| !line.contains(UNPUBLISHED))
}

#[test]
fn every_text_installs_the_distribution_of_this_project() {
    let is_published = is_published(&text("CHANGELOG.md"), env!("CARGO_PKG_VERSION"));
    let ends = |path: &str| ENDINGS.iter().any(|end| path.rsplit(['.', '/']).next() == Some(end));
    let mut all: Vec<String> = FOLDERS.iter().flat_map(|folder| files(folder, ends)).collect();
    all.extend(
        ["README", "CONTRIBUTING", "SECURITY", "CHANGELOG"].map(|name| format!("{name}.md")),
    );
    assert_kept(&all.iter().flat_map(|path| others(path, &text(path))).collect::<Vec<_>>());
    let promises = all.iter().filter_map(|path| promises(path, &text(path)));
    assert_kept(&promises.filter(|_| !is_published).collect::<Vec<_>>());
}

#[test]
fn the_wheel_has_the_name_and_the_version_is_in_the_list_of_changes() {
    let project: toml::Table = text("crates/python/pyproject.toml").parse().unwrap();
    assert_eq!(project["project"]["name"].as_str(), Some(NAME));
    let scripts = project["project"]["scripts"].as_table().unwrap();
    assert_eq!(scripts.keys().collect::<Vec<_>>(), [TAKEN, NAME]);
    let heading = format!("## {}", env!("CARGO_PKG_VERSION"));
    assert!(text("CHANGELOG.md").lines().any(|line| line.starts_with(&heading)), "{heading}");
}

#[test]
fn a_package_of_others_and_a_promise_are_reported() {
    let told = [
        format!("pip install {TAKEN} numpy"),
        format!("    pip install \"{TAKEN}[notebook]>=0.1\""),
        format!("\"!pip install -q {TAKEN}\\n\","),
        format!("uvx {TAKEN} demo"),
        format!("cargo install --locked {TAKEN}"),
    ];
    for line in &told {
        let expected = format!("a.md:1: installs {TAKEN}, which is another project");
        assert_eq!(others("a.md", line), [expected], "{line}");
    }
    let right = [
        format!("`pip install` takes the wheel of {TAKEN}"),
        format!("pip install wheels/plumbline_robotics-0.2.0-cp310-abi3-any.whl && {TAKEN} demo"),
        format!("cargo install --path crates/cli # {TAKEN}"),
        format!("uvx --from {NAME} {TAKEN} demo: it is not\npublished yet"),
    ];
    for text in &right {
        assert_eq!(others("a.md", text), Vec::<String>::new(), "{text}");
        assert_eq!(promises("a.md", text), None, "{text}");
    }
    assert!(promises("a.md", &format!("pip install {NAME}")).is_some());
}

#[test]
fn a_version_is_out_where_its_heading_no_longer_says_otherwise() {
    assert!(is_published("# Changes\n\n## 0.2.0\n", "0.2.0"));
    assert!(!is_published("# Changes\n\n## 0.2.0 (not published yet)\n\n## 0.1.0\n", "0.2.0"));
    assert!(!is_published("# Changes\n", "0.2.0"));
}

#[test]
fn the_workflow_of_a_release_builds_what_cargo_dist_is_told() {
    let workflow = text(".github/workflows/release.yml");
    let workspace: toml::Table = text("Cargo.toml").parse().unwrap();
    let dist = &workspace["workspace"]["metadata"]["dist"];
    let version = dist["cargo-dist-version"].as_str().unwrap();
    assert!(workflow.contains(&format!("CARGO_DIST: \"{version}\"")), "{version}");
    for target in dist["targets"].as_array().unwrap() {
        let row = format!("{{ target: {}, ", target.as_str().unwrap());
        // One of the archives, one of the wheels.
        assert_eq!(workflow.matches(&row).count(), 2, "{row}");
    }
}
