//! The paths that a module of `robot_descriptions` assigns, read and not run.

use std::collections::BTreeMap;
use std::path::PathBuf;

/// Functions whose results are read.
const JOIN: &str = "_path.join(";
const CLONE: &str = "_clone_to_cache(";

/// The paths of a module, by the names of its variables.
///
/// ```python
/// REPOSITORY_PATH: str = _clone_to_cache("NAME", ...)    # where `clone` says
/// PACKAGE_PATH: str = _path.join(REPOSITORY_PATH, "a", "b")
/// URDF_PATH = PACKAGE_PATH
/// ```
///
/// Other assignments are left out.
pub(super) fn paths(
    module: &str,
    clone: &dyn Fn(&str) -> Option<PathBuf>,
) -> BTreeMap<String, PathBuf> {
    let mut paths = BTreeMap::new();
    let mut rest = module;
    while let Some(line) = rest.lines().next() {
        let assigned = line.split_once('=').filter(|(target, _)| is_variable(target));
        if let Some((target, _)) = assigned {
            let name = target.split(':').next().unwrap_or_default().trim();
            let value = rest[target.len() + 1..].trim_start();
            if let Some(path) = evaluate(value, &paths, clone) {
                paths.insert(name.to_owned(), path);
            }
        }
        rest = rest[line.len()..]
            .strip_prefix("\r\n")
            .or_else(|| rest[line.len()..].strip_prefix('\n'))
            .unwrap_or_default();
    }
    paths
}

/// Whether the left side of an assignment is a variable in capitals, with or without `: str`.
fn is_variable(target: &str) -> bool {
    let name = target.split(':').next().unwrap_or_default().trim_end();
    !name.is_empty()
        && name.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_')
}

/// The path at the beginning of a text.
fn evaluate(
    text: &str,
    known: &BTreeMap<String, PathBuf>,
    clone: &dyn Fn(&str) -> Option<PathBuf>,
) -> Option<PathBuf> {
    if let Some(arguments) = text.strip_prefix(CLONE) {
        return clone(&literal(arguments.trim_start())?.0);
    }
    let Some(mut arguments) = text.strip_prefix(JOIN) else {
        let name = text.split_whitespace().next()?;
        return known.get(name).cloned();
    };
    let mut path = PathBuf::new();
    loop {
        arguments = arguments.trim_start();
        if arguments.starts_with(')') {
            return Some(path);
        }
        if let Some((part, rest)) = literal(arguments) {
            path.push(part);
            arguments = rest;
        } else {
            let end = arguments.find([',', ')'])?;
            path.push(known.get(arguments[..end].trim())?);
            arguments = &arguments[end..];
        }
        arguments = arguments.trim_start();
        arguments = arguments.strip_prefix(',').unwrap_or(arguments);
    }
}

/// A text in double quotes without escapes, and what follows it.
pub(super) fn literal(text: &str) -> Option<(String, &str)> {
    let (inside, rest) = text.strip_prefix('"')?.split_once('"')?;
    (!inside.contains(['\\', '\n'])).then(|| (inside.to_owned(), rest))
}
