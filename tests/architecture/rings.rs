//! Files of a crate import each other in one direction: what a file is told by `use crate::...` to
//! read first never leads back to it, nor does a folder to itself.

use std::collections::{BTreeMap, BTreeSet};

use crate::assert_kept;
use crate::tree::{folders, rust_files, text};

/// Crates with rings left: to be taken off, and never to be added to.
const RINGED: [&str; 9] = [
    "cli",
    "dynamics",
    "effects",
    "exchange",
    "inspection",
    "next_motion",
    "population",
    "recording",
    "simulator",
];

/// A file's text, or a folder's, by the name of its module, such as `search::select`.
type Modules = BTreeMap<String, String>;

/// The modules that each one imports.
type Imports = BTreeMap<String, BTreeSet<String>>;

fn modules(name: &str) -> Modules {
    let source = format!("crates/{name}/src");
    let module = |file: &String| {
        let path = file.strip_prefix(&format!("{source}/"))?.strip_suffix(".rs")?;
        let path = path.strip_suffix("/mod").unwrap_or(path);
        let is_root = path == "lib" || path == "main";
        (!is_root).then(|| (path.replace('/', "::"), text(file)))
    };
    rust_files(&source).iter().filter_map(module).collect()
}

/// Paths such as `crate::search::select::Selection` in the product's part of a file.
fn paths<'a>(text: &'a str) -> Vec<Vec<&'a str>> {
    let product = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = product.lines().filter(|line| !line.trim_start().starts_with("//"));
    let of_line = |line: &'a str| -> Vec<Vec<&'a str>> {
        let named = |(at, _): (usize, &str)| {
            let rest = &line[at + "crate::".len()..];
            let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
            rest[..end.unwrap_or(rest.len())].split("::").collect()
        };
        line.match_indices("crate::").map(named).collect()
    };
    lines.flat_map(of_line).collect()
}

fn imports(modules: &Modules) -> Imports {
    let known = |path: &Vec<&str>| {
        let prefixes = (1..=path.len()).rev().map(|n| path[..n].join("::"));
        prefixes.into_iter().find(|name| modules.contains_key(name))
    };
    let of = |(name, text): (&String, &String)| {
        let folder =
            name.rsplit_once("::").map_or(String::new(), |(folder, _)| format!("{folder}::"));
        let text = text.replace("super::", &format!("crate::{folder}"));
        let imported: BTreeSet<String> = paths(&text).iter().filter_map(known).collect();
        (name.clone(), imported.into_iter().filter(|other| other != name).collect())
    };
    modules.iter().map(of).collect()
}

/// The same of the folders and files directly below `src`.
fn of_folders(imports: &Imports) -> Imports {
    let folder = |name: &String| name.split("::").next().unwrap_or_default().to_owned();
    let mut all = Imports::new();
    for (name, imported) in imports {
        let own = folder(name);
        let others = imported.iter().map(folder).filter(|other| *other != own);
        let others: Vec<String> = others.collect();
        all.entry(own).or_default().extend(others);
    }
    all
}

/// The modules of which each leads back to itself.
fn ringed(imports: &Imports) -> Vec<String> {
    let leads_back = |start: &&String| {
        let mut seen = BTreeSet::new();
        let mut open: Vec<&String> = imports[*start].iter().collect();
        while let Some(next) = open.pop() {
            if seen.insert(next) {
                open.extend(imports.get(next).into_iter().flatten());
            }
        }
        seen.contains(*start)
    };
    imports.keys().filter(leads_back).cloned().collect()
}

fn broken(name: &str, modules: &Modules) -> Vec<String> {
    let files = imports(modules);
    let folders = of_folders(&files);
    let ring = |ringed: Vec<String>| {
        (!ringed.is_empty()).then(|| format!("{name}: {} import each other", ringed.join(", ")))
    };
    [ring(ringed(&files)), ring(ringed(&folders))].into_iter().flatten().collect()
}

#[test]
fn files_import_in_one_direction() {
    let all = folders("crates");
    let names = all.iter().filter(|name| !RINGED.contains(&name.as_str()));
    assert_kept(&names.flat_map(|name| broken(name, &modules(name))).collect::<Vec<_>>());
}

#[test]
fn a_crate_without_rings_is_not_excused() {
    let is_free = |name: &&&str| broken(name, &modules(name)).is_empty();
    let free = RINGED.iter().filter(is_free).map(|name| format!("{name} has no ring"));
    assert_kept(&free.collect::<Vec<_>>());
}

fn made_up(files: &[(&str, &str)]) -> Modules {
    files.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect()
}

#[test]
fn a_ring_of_three_files_is_reported() {
    let ring = [
        ("a", "use crate::b::B;"),
        ("b", "fn f() -> crate::c::C {}"),
        ("c", "use crate::a::{A, B};"),
        ("d", "use crate::a::A;"),
    ];
    let told = broken("x", &made_up(&ring));
    assert!(told[0].contains("a, b, c import") && !told[0].contains('d'), "{told:?}");
    let within = [("f::a", "use super::b::B;"), ("f::b", "use crate::f::a::A;")];
    assert_eq!(broken("x", &made_up(&within)), ["x: f::a, f::b import each other"]);
    let tree = [ring[0], ring[1], ("c", "// crate::a::A\n#[cfg(test)]\nuse crate::a::A;"), ring[3]];
    assert_eq!(broken("x", &made_up(&tree)), Vec::<String>::new());
}

#[test]
fn folders_that_import_each_other_are_reported_though_no_file_does() {
    let files = [("a::x", "use crate::b::y::Y;"), ("b::y", ""), ("b::z", "use crate::a::x::X;")];
    assert_eq!(broken("x", &made_up(&files)), ["x: a, b import each other"]);
}
