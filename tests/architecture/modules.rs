//! What the files of a crate import of each other, read from their text.
//!
//! A path is followed through groups (`use crate::{a, b::C}`), through `super` and `self`, through
//! modules that a `use` brings by name, and through what `lib.rs` and `mod.rs` re-export, to the
//! file that defines the thing. What only tests see is left out.

use std::collections::{BTreeMap, BTreeSet};

/// Name of the module of `lib.rs`.
pub const ROOT: &str = "lib";

/// Texts of a crate's files by the name of the module, such as `search::select`; `lib` for `lib.rs`.
pub type Texts = BTreeMap<String, String>;

/// The modules that each module imports.
pub type Imports = BTreeMap<String, BTreeSet<String>>;

/// What was read of the imports of a crate.
pub struct Graph {
    /// From each module to those that define what it imports.
    pub imports: Imports,
    /// Paths that lead through a re-export of `lib.rs` or `mod.rs`: the module, the path, the file that defines it.
    pub detours: Vec<[String; 3]>,
}

/// A path in a file, with the name that it has there.
#[derive(Clone)]
struct Leaf {
    path: Vec<String>,
    alias: String,
    is_macro: bool,
}

/// The tokens of a file that matter: words, `::` and single signs, without comments and literals.
pub fn tokens(text: &str) -> Vec<String> {
    let chars: Vec<char> = text.chars().collect();
    let at = |i: usize| chars.get(i).copied().unwrap_or('\0');
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let (mut found, mut i) = (Vec::new(), 0);
    while i < chars.len() {
        let start = i;
        match at(i) {
            '/' if at(i + 1) == '/' => i = past(&chars, i, "\n"),
            '/' if at(i + 1) == '*' => i = past(&chars, i, "*/"),
            'r' | 'b' if is_raw_string(&chars, i) => i = past_raw_string(&chars, i),
            '"' => i = past_string(&chars, i),
            '\'' if at(i + 1) == '\\' => i = past(&chars, i + 3, "'"),
            '\'' if at(i + 2) == '\'' => i += 3,
            c if is_word(c) => {
                while is_word(at(i)) {
                    i += 1;
                }
                found.push(chars[start..i].iter().collect());
            }
            ':' if at(i + 1) == ':' => {
                i += 2;
                found.push("::".into());
            }
            c => {
                i += 1;
                if !c.is_whitespace() {
                    found.push(c.into());
                }
            }
        }
    }
    found
}

/// The place behind the next `end`.
fn past(chars: &[char], from: usize, end: &str) -> usize {
    let end: Vec<char> = end.chars().collect();
    let found = (from..chars.len()).find(|&i| chars[i..].starts_with(&end));
    found.map_or(chars.len(), |i| i + end.len())
}

fn past_string(chars: &[char], from: usize) -> usize {
    let mut i = from + 1;
    while i < chars.len() && chars[i] != '"' {
        i += if chars[i] == '\\' { 2 } else { 1 };
    }
    i + 1
}

fn hashes(chars: &[char], from: usize) -> (usize, usize) {
    let start = from + chars[from..].iter().take_while(|c| matches!(c, 'r' | 'b')).count();
    (start, chars.get(start..).unwrap_or_default().iter().take_while(|c| **c == '#').count())
}

fn is_raw_string(chars: &[char], from: usize) -> bool {
    let is_inside_word = from > 0 && (chars[from - 1].is_alphanumeric() || chars[from - 1] == '_');
    let (start, count) = hashes(chars, from);
    let has_r = chars[from..start].contains(&'r');
    !is_inside_word && start - from <= 2 && has_r && chars.get(start + count) == Some(&'"')
}

fn past_raw_string(chars: &[char], from: usize) -> usize {
    let (start, count) = hashes(chars, from);
    past(chars, start + count + 1, &format!("\"{}", "#".repeat(count)))
}

/// The tokens without items that only tests see, and the modules among those items.
pub fn without_tests(tokens: Vec<String>) -> (Vec<String>, BTreeSet<String>) {
    const TEST_ONLY: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let (mut kept, mut modules, mut i) = (Vec::new(), BTreeSet::new(), 0);
    while i < tokens.len() {
        let here = &tokens[i..];
        if here.len() < 7 || !TEST_ONLY.iter().zip(here).all(|(a, b)| a == b) {
            kept.push(tokens[i].clone());
            i += 1;
            continue;
        }
        let end = i + item_length(here);
        let is_file = end - i < 14 && tokens[end - 1] == ";";
        if let Some(at) = tokens[i..end].iter().position(|t| t == "mod").filter(|_| is_file) {
            modules.insert(tokens[i + at + 1].clone());
        }
        i = end;
    }
    (kept, modules)
}

/// Tokens of an item with the attributes before it.
fn item_length(tokens: &[String]) -> usize {
    let mut depth = 0_i32;
    for (i, token) in tokens.iter().enumerate() {
        match token.as_str() {
            "{" | "[" | "(" => depth += 1,
            "}" | "]" | ")" => depth -= 1,
            _ => {}
        }
        let ends_block = token == "}" && tokens.get(i + 1).is_none_or(|next| next != ";");
        if depth <= 0 && (token == ";" || ends_block) {
            return i + 1;
        }
    }
    tokens.len()
}

/// The leaves of the tree of paths that begins at `i`, each with `prefix` before it, and the place behind the tree.
fn tree(tokens: &[String], mut i: usize, prefix: &[String]) -> (Vec<Leaf>, usize) {
    let mut path = prefix.to_vec();
    loop {
        let token = tokens.get(i).map_or("", String::as_str);
        if token == "{" {
            let mut leaves = Vec::new();
            i += 1;
            while i < tokens.len() && tokens[i] != "}" {
                if tokens[i] == "," {
                    i += 1;
                    continue;
                }
                let (found, next) = tree(tokens, i, &path);
                leaves.extend(found);
                i = next.max(i + 1);
            }
            return (leaves, i + 1);
        }
        if token != "self" || path.is_empty() {
            path.push(token.to_owned());
        }
        i += 1;
        let goes_on = tokens.get(i).is_some_and(|t| t == "::")
            && tokens.get(i + 1).is_some_and(|t| t == "{" || t == "*" || is_name(t));
        if !goes_on {
            break;
        }
        i += 1;
    }
    let mut alias = path.last().cloned().unwrap_or_default();
    if tokens.get(i).is_some_and(|t| t == "as") {
        alias = tokens.get(i + 1).cloned().unwrap_or_default();
        i += 2;
    }
    let is_macro = tokens.get(i).is_some_and(|t| t == "!");
    (vec![Leaf { path, alias, is_macro }], i)
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// The files of a crate that are more than tests.
struct Crate {
    tokens: BTreeMap<String, Vec<String>>,
    /// What `lib.rs` and each `mod.rs` hand on: the name there, the path from the root.
    re_exports: BTreeMap<String, BTreeMap<String, Vec<String>>>,
}

impl Crate {
    fn new(texts: &Texts) -> Self {
        let read: BTreeMap<&String, _> =
            texts.iter().map(|(name, text)| (name, without_tests(tokens(text)))).collect();
        let of_tests: BTreeSet<String> = read
            .iter()
            .flat_map(|(name, (_, tests))| tests.iter().map(|test| below(name, test)))
            .collect();
        let is_test =
            |name: &str| of_tests.iter().any(|t| name == t || name.starts_with(&format!("{t}::")));
        let kept = read.into_iter().filter(|(name, _)| !is_test(name));
        let tokens = kept.map(|(name, (tokens, _))| (name.clone(), tokens)).collect();
        let mut of = Self { tokens, re_exports: BTreeMap::new() };
        let names: Vec<String> = of.tokens.keys().cloned().collect();
        for name in names {
            let (_, handed_on) = of.split(&name);
            let entries = handed_on.into_iter().map(|leaf| (leaf.alias, leaf.path));
            of.re_exports.insert(name.clone(), entries.collect());
        }
        of
    }

    fn is_module(&self, path: &[String]) -> bool {
        path.is_empty() || self.tokens.contains_key(&path.join("::"))
    }

    /// `path` as it is written in `module`, from the root; none for a path out of the crate.
    fn absolute(&self, module: &str, path: &[String]) -> Option<Vec<String>> {
        let mut at = segments(module);
        let mut rest = path;
        match rest.first()?.as_str() {
            "crate" => {
                at.clear();
                rest = &rest[1..];
            }
            "self" => rest = &rest[1..],
            "super" => {
                while rest.first().is_some_and(|word| word == "super") {
                    at.pop();
                    rest = &rest[1..];
                }
            }
            child => {
                at.push(child.to_owned());
                if !self.is_module(&at) {
                    return None;
                }
                rest = &rest[1..];
            }
        }
        at.extend_from_slice(rest);
        Some(at)
    }

    /// The paths of a file into its crate, those that it imports and those that it only hands on.
    fn split(&self, module: &str) -> (Vec<Leaf>, Vec<Leaf>) {
        let tokens = &self.tokens[module];
        let (mut imported, mut handed_on) = (Vec::new(), Vec::new());
        let mut aliases: BTreeMap<String, Vec<String>> = BTreeMap::new();
        let mut i = 0;
        while i < tokens.len() {
            let is_use = tokens[i] == "use";
            let start = if is_use { i + 1 } else { i };
            let follows = i > 0 && matches!(tokens[i - 1].as_str(), "::" | ".");
            let is_path = tokens.get(start + 1).is_some_and(|next| next == "::");
            if follows || !(is_path && tokens.get(start).is_some_and(|t| is_name(t))) {
                i += 1;
                continue;
            }
            let (leaves, next) = tree(tokens, start, &[]);
            let is_public = is_use && i > 0 && matches!(tokens[i - 1].as_str(), "pub" | ")");
            for leaf in leaves {
                let alias = aliases.get(&leaf.path[0]).filter(|_| !is_use);
                let path = match alias {
                    Some(start) => Some([start, &leaf.path[1..]].concat()),
                    None => self.absolute(module, &leaf.path),
                };
                let Some(path) = path else { continue };
                if is_use && self.is_module(&path) {
                    aliases.insert(leaf.alias.clone(), path.clone());
                }
                let leaf = Leaf { path, ..leaf };
                if is_public { handed_on.push(leaf) } else { imported.push(leaf) }
            }
            i = next.max(i + 1);
        }
        (imported, handed_on)
    }

    /// The module that defines what stands at `path`, and whether a re-export led there.
    fn definer(&self, path: &[String]) -> (String, bool) {
        let depth = (0..=path.len()).rev().find(|n| self.is_module(&path[..*n])).unwrap_or(0);
        let module = if depth == 0 { ROOT.to_owned() } else { path[..depth].join("::") };
        let handed_on = path.get(depth).and_then(|name| self.re_exports.get(&module)?.get(name));
        match handed_on {
            Some(further) if further != path => (self.definer(further).0, true),
            _ => (module, false),
        }
    }
}

fn segments(module: &str) -> Vec<String> {
    if module == ROOT { Vec::new() } else { module.split("::").map(str::to_owned).collect() }
}

fn below(module: &str, child: &str) -> String {
    if module == ROOT { child.to_owned() } else { format!("{module}::{child}") }
}

/// What the files of a crate import of each other.
pub fn graph(texts: &Texts) -> Graph {
    let files = Crate::new(texts);
    let mut imports = Imports::new();
    let mut detours = Vec::new();
    for module in files.tokens.keys() {
        let own = imports.entry(module.clone()).or_default();
        for leaf in files.split(module).0 {
            let (target, is_detour) = files.definer(&leaf.path);
            if target == *module || (leaf.is_macro && target == ROOT) {
                continue;
            }
            if is_detour {
                detours.push([module.clone(), leaf.path.join("::"), target.clone()]);
            }
            own.insert(target);
        }
    }
    Graph { imports, detours }
}

/// The same graph of what lies directly below `folder` (empty for the whole crate).
pub fn units_of(imports: &Imports, folder: &str) -> Imports {
    let prefix = if folder.is_empty() { String::new() } else { format!("{folder}::") };
    let unit = |name: &String| {
        let rest = name.strip_prefix(&prefix).filter(|_| name != ROOT)?;
        Some(format!("{prefix}{}", rest.split("::").next().unwrap_or_default()))
    };
    let mut all = Imports::new();
    for (name, imported) in imports {
        let Some(own) = unit(name) else { continue };
        let others: Vec<String> = imported.iter().filter_map(unit).filter(|u| *u != own).collect();
        all.entry(own).or_default().extend(others);
    }
    all
}

/// Folders with files in them, by the name of their module, and the crate itself as "".
pub fn folders_of(imports: &Imports) -> BTreeSet<String> {
    let parents = imports.keys().flat_map(|name| {
        let ends = name.match_indices("::").map(|(at, _)| name[..at].to_owned());
        ends.collect::<Vec<_>>()
    });
    parents.chain([String::new()]).collect()
}

/// The modules that each leads back to itself, ring by ring.
pub fn rings(imports: &Imports) -> Vec<Vec<String>> {
    let reached = |start: &String| {
        let mut seen = BTreeSet::new();
        let mut open: Vec<&String> = imports[start].iter().collect();
        while let Some(next) = open.pop() {
            if seen.insert(next.clone()) {
                open.extend(imports.get(next).into_iter().flatten());
            }
        }
        seen
    };
    let all: BTreeMap<&String, BTreeSet<String>> =
        imports.keys().map(|name| (name, reached(name))).collect();
    let mut rings: Vec<Vec<String>> = Vec::new();
    for (name, seen) in &all {
        let is_known = rings.iter().flatten().any(|other| other == *name);
        if is_known || !seen.contains(*name) {
            continue;
        }
        let ring =
            all.iter().filter(|(other, back)| seen.contains(**other) && back.contains(*name));
        rings.push(ring.map(|(other, _)| (*other).clone()).collect());
    }
    rings
}
