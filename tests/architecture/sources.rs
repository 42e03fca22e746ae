//! What a source file may hold: no more than can be read at a sitting, no unfinished work,
//! no way to stop the program. Tests are free to stop. Length of functions is clippy's.

use std::collections::BTreeSet;

use crate::assert_kept;
use crate::tree::{folders, rust_files, text};

/// Most lines of a file without its tests.
const LONGEST: usize = 500;
/// Macros of unfinished work.
const UNFINISHED: [&str; 3] = ["todo", "unimplemented", "dbg"];
/// Words that need the name of who will see to it.
const REMINDERS: [&str; 2] = ["TODO", "FIXME"];
/// What stops the program.
const STOPS: [&str; 3] = [".unwrap()", ".expect(", "panic!("];

const TEST_ONLY: &str = "#[cfg(test)]";

/// Lines outside the items that only tests see, numbered from 1.
fn without_tests(text: &str) -> Vec<(usize, &str)> {
    let mut kept = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((i, line)) = lines.next() {
        if line.trim() != TEST_ONLY {
            kept.push((i + 1, line));
            continue;
        }
        // The item ends with a brace in its own column, or on one line with a semicolon.
        let indent = line.len() - line.trim_start().len();
        let ends = |line: &str| {
            let column = line.len() - line.trim_start().len();
            column == indent && (line.trim() == "}" || line.ends_with(';'))
        };
        lines.find(|(_, line)| ends(line));
    }
    kept
}

/// Modules of a file that are files of their own and only tests see.
fn test_modules(text: &str) -> Vec<&str> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let pairs = lines.windows(2).filter(|pair| pair[0] == TEST_ONLY);
    pairs.filter_map(|pair| module(pair[1])).collect()
}

/// The name of a module in a file of its own.
fn module(line: &str) -> Option<&str> {
    line.strip_prefix("pub(crate) ").unwrap_or(line).strip_prefix("mod ")?.strip_suffix(';')
}

fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with("//")
}

fn too_long(text: &str) -> Vec<String> {
    let length = without_tests(text).len();
    let message = format!("{length} lines without tests, of {LONGEST} at most");
    if length > LONGEST { vec![message] } else { Vec::new() }
}

fn stops(text: &str) -> Vec<String> {
    let code = without_tests(text).into_iter().filter(|(_, line)| !is_comment(line));
    code.filter(|(_, line)| STOPS.iter().any(|stop| line.contains(stop)))
        .map(|(number, line)| format!("line {number} may stop the program: {}", line.trim()))
        .collect()
}

fn unfinished(text: &str) -> Vec<String> {
    let ignored = format!("#[{}", "ignore");
    let marks = UNFINISHED.map(|name| format!("{name}!("));
    let is_unfinished = |line: &str| {
        let mark = marks.iter().any(|mark| line.contains(mark)) || line.contains(&ignored);
        (mark && !is_comment(line)) || has_nameless_reminder(line)
    };
    let lines = text.lines().enumerate().filter(|(_, line)| is_unfinished(line));
    lines.map(|(i, line)| format!("line {} is unfinished: {}", i + 1, line.trim())).collect()
}

/// Whether a comment holds a reminder without a name in brackets behind it.
fn has_nameless_reminder(line: &str) -> bool {
    let comment = line.split_once("//").map_or("", |(_, comment)| comment);
    let is_nameless = |rest: &str| {
        let name = rest.strip_prefix('(').and_then(|rest| rest.split_once(')'));
        name.is_none_or(|(name, _)| name.trim().is_empty())
    };
    let mut found = REMINDERS.iter().flat_map(|word| comment.match_indices(word));
    found.any(|(at, word)| is_nameless(&comment[at + word.len()..]))
}

/// Files of the crates' `src` folders that are more than tests.
fn product_files() -> Vec<String> {
    let sources = folders("crates").into_iter().map(|name| format!("crates/{name}/src"));
    let files: Vec<String> = sources.flat_map(|folder| rust_files(&folder)).collect();
    let mut tests = BTreeSet::new();
    for file in &files {
        let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
        let content = text(file);
        let modules = test_modules(&content);
        tests.extend(modules.iter().map(|name| format!("{folder}/{name}.rs")));
    }
    files.into_iter().filter(|file| !tests.contains(file)).collect()
}

/// Holds a rule against files.
fn assert_kept_by(files: &[String], rule: fn(&str) -> Vec<String>) {
    assert!(!files.is_empty());
    let broken = |file: &String| -> Vec<String> {
        rule(&text(file)).iter().map(|broken| format!("{file}: {broken}")).collect()
    };
    assert_kept(&files.iter().flat_map(broken).collect::<Vec<_>>());
}

fn all_files() -> Vec<String> {
    [rust_files("crates"), rust_files("tests")].concat()
}

#[test]
fn files_can_be_read_at_a_sitting() {
    assert_kept_by(&all_files(), too_long);
}

#[test]
fn nothing_is_left_unfinished() {
    assert_kept_by(&all_files(), unfinished);
}

#[test]
fn nothing_in_the_crates_stops_the_program() {
    assert_kept_by(&product_files(), stops);
}

#[test]
fn a_long_file_is_reported_but_not_for_its_tests() {
    let long = "a\n".repeat(LONGEST);
    assert_kept(&too_long(&format!("{long}#[cfg(test)]\nmod tests {{\n    b;\n}}\n")));
    assert_eq!(too_long(&format!("{long}b\n")).len(), 1);
}

#[test]
fn unfinished_work_is_reported() {
    for name in UNFINISHED {
        assert_eq!(unfinished(&format!("fn f() {{\n    {name}!()\n}}")).len(), 1, "{name}");
    }
    assert_eq!(unfinished(&format!("#[{}]\nfn test() {{}}", "ignore")).len(), 1);
    for word in REMINDERS {
        assert_eq!(unfinished(&format!("f(); // {word}: later")).len(), 1, "{word}");
        assert_eq!(unfinished(&format!("/// {word}(): later")).len(), 1, "{word}");
        assert_kept(&unfinished(&format!("f(); // {word}(ada): later")));
    }
}

#[test]
fn what_stops_the_program_is_reported_outside_tests_only() {
    for stop in ["a.unwrap();", "a.expect(\"b\");", "panic!(\"b\");"] {
        assert_eq!(stops(stop), [format!("line 1 may stop the program: {stop}")]);
        assert_kept(&stops(&format!("/// {stop}")));
        assert_kept(&stops(&format!("#[cfg(test)]\nmod tests {{\n    {stop}\n}}")));
        assert_eq!(stops(&format!("#[cfg(test)]\nmod sample;\n{stop}")).len(), 1);
        assert_eq!(stops(&format!("#[cfg(test)]\nfn f() {{\n    a;\n}}\n{stop}")).len(), 1);
    }
}

#[test]
fn a_test_module_in_a_file_of_its_own_is_found() {
    assert_eq!(test_modules("mod a;\n#[cfg(test)]\nmod sample;\nmod b;"), ["sample"]);
    assert_eq!(test_modules("#[cfg(test)]\npub(crate) mod sample;\npub(crate) mod b;"), ["sample"]);
}
