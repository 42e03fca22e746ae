//! Files and folders of a crate import each other in one direction, and an import names the file that
//! defines a thing: what a file is told by `use crate::...` to read first never leads back to it.

use crate::assert_kept;
use crate::modules::{ROOT, Texts, folders_of, graph, rings, units_of};
use crate::tree::{folders, rust_files, text};

/// The texts of a crate's files by the name of the module, such as `search::select`.
fn texts(name: &str) -> Texts {
    let source = format!("crates/{name}/src");
    let module = |file: &String| {
        let path = file.strip_prefix(&format!("{source}/"))?.strip_suffix(".rs")?;
        let path = path.strip_suffix("/mod").unwrap_or(path);
        (path != "main").then(|| (path.replace('/', "::"), text(file)))
    };
    rust_files(&source).iter().filter_map(module).collect()
}

/// The rings of files and of folders.
fn ringed(name: &str, texts: &Texts) -> Vec<String> {
    let imports = graph(texts).imports;
    let of_files = rings(&imports);
    let folders = folders_of(&imports);
    let of_folders = folders.iter().flat_map(|folder| rings(&units_of(&imports, folder)));
    let all = of_files.into_iter().chain(of_folders);
    let mut told: Vec<String> =
        all.map(|ring| format!("{name}: {} import each other", ring.join(", "))).collect();
    told.sort();
    told.dedup();
    told
}

/// The imports that lead through a re-export.
fn roundabout(name: &str, texts: &Texts) -> Vec<String> {
    let told = graph(texts).detours.into_iter().map(|[module, path, definer]| {
        format!("{name}: {module} imports crate::{path}, which {definer} defines")
    });
    told.collect()
}

/// Holds a rule against every crate.
fn assert_kept_by_all(rule: fn(&str, &Texts) -> Vec<String>) {
    let all = folders("crates");
    assert!(!all.is_empty());
    assert_kept(&all.iter().flat_map(|name| rule(name, &texts(name))).collect::<Vec<_>>());
}

#[test]
fn files_and_folders_import_in_one_direction() {
    assert_kept_by_all(ringed);
}

#[test]
fn an_import_names_the_file_that_defines_a_thing() {
    assert_kept_by_all(roundabout);
}

fn made_up(files: &[(&str, &str)]) -> Texts {
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
    assert_eq!(ringed("x", &made_up(&ring)), ["x: a, b, c import each other"]);
    let within = [("f::a", "use super::b::B;"), ("f::b", "use crate::f::a::A;")];
    assert_eq!(ringed("x", &made_up(&within)), ["x: f::a, f::b import each other"]);
    let tree = [ring[0], ring[1], ("c", "// crate::a::A\n#[cfg(test)]\nuse crate::a::A;"), ring[3]];
    assert_eq!(ringed("x", &made_up(&tree)), Vec::<String>::new());
}

#[test]
fn a_ring_is_seen_through_groups_re_exports_and_modules_brought_by_name() {
    let expected = ["x: a, b import each other"];
    let lib = (ROOT, "pub use a::A;\npub use b::{B, C as D};\nmod a;\nmod b;");
    let grouped =
        [lib, ("a", "use crate::{\n    c::C,\n    b::{self, B},\n};"), ("b", "use crate::a::A;")];
    assert_eq!(ringed("x", &made_up(&grouped)), expected);
    let re_exported = [lib, ("a", "use crate::{D, c::C};"), ("b", "use crate::A;")];
    assert_eq!(ringed("x", &made_up(&re_exported)), expected);
    let by_name = [lib, ("a", "use crate::b;\nfn f() { b::g(); }"), ("b", "use crate::a::A;")];
    assert_eq!(ringed("x", &made_up(&by_name)), expected);
    let defined_in_lib = [(ROOT, "use a::A;\npub struct S(A);"), ("a", "use crate::S;")];
    assert_eq!(ringed("x", &made_up(&defined_in_lib)), ["x: a, lib import each other"]);
}

#[test]
fn what_only_tests_see_makes_no_ring() {
    let lib = (ROOT, "#[cfg(test)]\nmod sample;\nmod a;");
    let inside = "fn f() {}\n#[cfg(test)]\nuse crate::b::{B, C};\n\n#[cfg(test)]\nmod tests {\n    use crate::b::B;\n}";
    let files = [
        lib,
        ("a", inside),
        ("b", "use crate::a::A;"),
        ("sample", "use crate::a::A; use crate::sample::S;"),
    ];
    assert_eq!(ringed("x", &made_up(&files)), Vec::<String>::new());
    let after = [("a", "#[cfg(test)]\nfn f() {}\nuse crate::b::B;"), ("b", "use crate::a::A;")];
    assert_eq!(ringed("x", &made_up(&after)), ["x: a, b import each other"]);
    let in_text =
        [("a", "const A: &str = \"crate::b::B\"; /* crate::b::B */"), ("b", "use crate::a::A;")];
    assert_eq!(ringed("x", &made_up(&in_text)), Vec::<String>::new());
}

#[test]
fn folders_that_import_each_other_are_reported_though_no_file_does() {
    let files = [("a::x", "use crate::b::y::Y;"), ("b::y", ""), ("b::z", "use crate::a::x::X;")];
    assert_eq!(ringed("x", &made_up(&files)), ["x: a, b import each other"]);
    let deep = [
        ("f::a::x", "use crate::f::b::y::Y;"),
        ("f::b::y", ""),
        ("f::b::z", "use crate::f::a::x::X;"),
    ];
    assert_eq!(ringed("x", &made_up(&deep)), ["x: f::a, f::b import each other"]);
}

#[test]
fn an_import_through_a_re_export_is_reported() {
    let files = [
        (ROOT, "pub use f::A;"),
        ("f", "pub use a::A;"),
        ("f::a", "pub struct A;"),
        ("b", "use crate::{A, f::A as B};"),
    ];
    let told = roundabout("x", &made_up(&files));
    let expected = [
        "x: b imports crate::A, which f::a defines",
        "x: b imports crate::f::A, which f::a defines",
    ];
    assert_eq!(told, expected);
    let plain = [files[0], files[1], files[2], ("b", "use crate::f::a::A;")];
    assert_eq!(roundabout("x", &made_up(&plain)), Vec::<String>::new());
}
