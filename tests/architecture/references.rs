//! Every source that the code cites has a full entry in the map.

use std::collections::BTreeSet;

use crate::assert_kept;
use crate::tree::{rust_files, text};

/// Sources cited as `Surname 1990`, in comments and in strings: the word before a year
/// where it starts with a capital, and the year.
fn citations(source: &str) -> BTreeSet<(String, String)> {
    let punctuation = |c: char| !c.is_alphanumeric();
    let words = source.split_whitespace().filter(|word| !word.starts_with("//"));
    let words: Vec<&str> = words.map(|word| word.trim_matches(punctuation)).collect();
    let pairs = words.windows(2).filter(|pair| is_name(pair[0]) && is_year(pair[1]));
    pairs.map(|pair| (ascii(pair[0]), pair[1].to_owned())).collect()
}

fn is_name(word: &str) -> bool {
    word.len() > 2
        && word.starts_with(char::is_uppercase)
        && word.chars().all(|c| c.is_alphabetic() || c == '-')
}

fn is_year(word: &str) -> bool {
    word.len() == 4 && word.parse().is_ok_and(|year: u32| (1900..2100).contains(&year))
}

/// Letters of names as the code writes them.
fn ascii(text: &str) -> String {
    text.replace('ã', "a").replace('é', "e").replace('ü', "u")
}

/// Entries of the list of references: one paragraph or list item each.
fn entries(map: &str) -> Vec<String> {
    let list = map.split_once("## References").map_or("", |(_, list)| list);
    list.split("\n- ").skip(1).map(ascii).collect()
}

fn broken(source: &str, entries: &[String]) -> Vec<String> {
    let known = |name: &str, year: &str| {
        entries.iter().any(|entry| entry.contains(name) && entry.contains(year))
    };
    let unknown = citations(source).into_iter().filter(|(name, year)| !known(name, year));
    unknown.map(|(name, year)| format!("{name} {year} has no entry in crates/README.md")).collect()
}

#[test]
fn sources_have_full_entries() {
    let entries = entries(&text("crates/README.md"));
    let files = rust_files("crates");
    let of = |file: &String| -> Vec<String> {
        broken(&text(file), &entries).iter().map(|b| format!("{file}: {b}")).collect()
    };
    assert_kept(&files.iter().flat_map(of).collect::<Vec<_>>());
}

#[test]
fn a_source_without_an_entry_is_reported() {
    let entries = entries("## References\n\n- A. Cortesão, *Title*, 2014.\n- B. Other, 1990.\n");
    assert_eq!(entries.len(), 2);
    assert_kept(&broken("/// Sousa & Cortesao 2014, section 3.", &entries));
    assert_kept(&broken("source: \"Other 1990\"", &entries));
    let wrapped = "/// as in Sousa & Cortesao\n/// 1990; Other 2014";
    let expected =
        ["Cortesao 1990", "Other 2014"].map(|c| format!("{c} has no entry in crates/README.md"));
    assert_eq!(broken(wrapped, &entries), expected);
}
