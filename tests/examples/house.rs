//! Figures of the house: how the sources are laid out and named.
//!
//! ```sh
//! cargo run --release -p checks --example house            # all figures
//! cargo run --release -p checks --example house -- logs    # rings and detours of one crate
//! ```
#![allow(clippy::unwrap_used, reason = "a file of the checkout that cannot be read ends it")]

use std::collections::{BTreeMap, BTreeSet};

#[path = "../architecture/modules.rs"]
mod modules;
#[path = "../architecture/tree.rs"]
mod tree;

use modules::{Texts, folders_of, graph, rings, units_of};
use tree::{folders, rust_files, text};

fn texts(name: &str) -> Texts {
    let source = format!("crates/{name}/src");
    let module = |file: &String| {
        let path = file.strip_prefix(&format!("{source}/"))?.strip_suffix(".rs")?;
        let path = path.strip_suffix("/mod").unwrap_or(path);
        (path != "main").then(|| (path.replace('/', "::"), text(file)))
    };
    rust_files(&source).iter().filter_map(module).collect()
}

fn print_crate(name: &str) {
    let graph = graph(&texts(name));
    for ring in rings(&graph.imports) {
        println!("{name}: files {} import each other", ring.join(", "));
        for file in &ring {
            let inside = graph.imports[file].iter().filter(|other| ring.contains(other));
            println!("    {file} -> {}", inside.cloned().collect::<Vec<_>>().join(", "));
        }
    }
    for folder in folders_of(&graph.imports) {
        for ring in rings(&units_of(&graph.imports, &folder)) {
            println!("{name}: in {folder}/ {} import each other", ring.join(", "));
        }
    }
    for [module, path, target] in &graph.detours {
        println!("{name}: {module} imports crate::{path}, which {target} defines");
    }
}

/// Files, lines, rings, files in rings, imports inside rings, rings of folders, detours of a crate.
fn row(name: &str) -> [usize; 7] {
    let texts = texts(name);
    let graph = graph(&texts);
    let rings_of_files = rings(&graph.imports);
    let back = rings_of_files.iter().flat_map(|ring| {
        ring.iter().map(|file| graph.imports[file].iter().filter(|to| ring.contains(to)).count())
    });
    let folder_rings = |folder: &String| rings(&units_of(&graph.imports, folder)).len();
    [
        texts.len(),
        texts.values().map(|text| text.lines().count()).sum(),
        rings_of_files.len(),
        rings_of_files.iter().flatten().count(),
        back.sum(),
        folders_of(&graph.imports).iter().map(folder_rings).sum(),
        graph.detours.len(),
    ]
}

/// Files of all crates with their lines without what only tests see.
fn product() -> Vec<(String, String)> {
    let files = folders("crates").into_iter().map(|name| format!("crates/{name}/src"));
    files.flat_map(|folder| rust_files(&folder)).map(|file| (file.clone(), text(&file))).collect()
}

/// The name of the type that a line declares for its crate or for all.
fn public_type(line: &str) -> Option<&str> {
    let line = line.trim_start();
    let rest = line.strip_prefix("pub ").or_else(|| line.strip_prefix("pub(crate) "))?;
    let kinds = ["struct ", "enum ", "trait ", "type "];
    let name = kinds.iter().find_map(|kind| rest.strip_prefix(kind))?;
    name.split(|c: char| !(c.is_alphanumeric() || c == '_')).next()
}

fn double_names(files: &[(String, String)]) -> BTreeMap<&str, BTreeSet<&str>> {
    let mut all: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (file, text) in files {
        for name in text.lines().filter_map(public_type) {
            all.entry(name).or_default().insert(file);
        }
    }
    all.retain(|name, files| files.len() > 1 && *name != "Arguments");
    all
}

fn words(path: &str) -> usize {
    text(path).split_whitespace().count()
}

fn profile_lines() -> usize {
    let manifest = text("Cargo.toml");
    let release = manifest.lines().scan("", |section, line| {
        if line.starts_with('[') {
            *section = line;
        }
        Some((*section, line))
    });
    let is_counted = |(section, line): &(&str, &str)| {
        section.starts_with("[profile.release") && !line.is_empty() && !line.starts_with('#')
    };
    release.filter(is_counted).count()
}

fn print_all() {
    println!(
        "crate              files  lines  rings  files in them  imports in them  of folders  detours"
    );
    let mut sum = [0; 7];
    for name in folders("crates") {
        let row = row(&name);
        print_row(&name, row);
        sum.iter_mut().zip(row).for_each(|(sum, x)| *sum += x);
    }
    print_row("all", sum);
    let files = product();
    let count = |is: fn(&str) -> bool, folder: &str| -> usize {
        let inside = files.iter().filter(|(file, _)| file.starts_with(folder));
        inside.map(|(_, text)| text.lines().filter(|line| is(line)).count()).sum()
    };
    let guards = count(is_place_guard, "crates/effects/src");
    println!("\nguards of `Place` in effects                    {guards}");
    println!(
        "parameters that bundle arguments (tuples)       {}",
        count(has_tuple_argument, "crates")
    );
    let doubles = double_names(&files);
    println!("type names that stand for more than one thing    {}", doubles.len());
    for (name, files) in &doubles {
        println!("    {name}: {}", files.iter().copied().collect::<Vec<_>>().join(" "));
    }
    println!("lines of profile.release                        {}", profile_lines());
    println!("words in READMEs");
    for name in folders("crates") {
        let path = format!("crates/{name}/README.md");
        if tree::root().join(&path).exists() {
            println!("    {path}: {}", words(&path));
        }
    }
}

/// A test of a place that the kind of an effect decides.
fn is_place_guard(line: &str) -> bool {
    let line = line.trim_start();
    (line.contains("let Place::") || line.contains("let Some(Place::")) && !line.starts_with("//")
}

/// A parameter such as `(a, b): (f64, f64)` of a function.
fn has_tuple_argument(line: &str) -> bool {
    let Some(at) = line.find("): (") else { return false };
    let before = &line[..at];
    let is_parameter =
        !before.contains("let ") && !before.contains('|') && !before.contains("for ");
    is_parameter && before.rfind('(').is_some_and(|open| before[open..].contains(','))
}

fn print_row(name: &str, row: [usize; 7]) {
    let [files, lines, rings, in_rings, back, of_folders, detours] = row;
    println!(
        "{name:<17}{files:>7}{lines:>7}{rings:>7}{in_rings:>15}{back:>17}{of_folders:>12}{detours:>9}"
    );
}

fn main() {
    match std::env::args().nth(1) {
        Some(name) => print_crate(&name),
        None => print_all(),
    }
}
