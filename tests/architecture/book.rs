//! The book: its contents name every page and each page once, links and anchors lead somewhere, and every command
//! and snippet has what runs it.

use std::collections::BTreeMap;
use std::fs;

use checks::book::{Page, anchors, blocks, folder, links, pages};

use crate::assert_kept;
use crate::tree::text;

/// What may stand behind a fence: a language and what a test does with the block. Text without a tag is an equation or
/// a picture of how things hang together.
fn is_held(language: &str, tag: &str) -> bool {
    match language {
        "sh" | "python" => tag == "run",
        "text" => tag.is_empty() || tag == "printed",
        _ => tag.starts_with("file="),
    }
}

fn loose(page: &Page) -> Vec<String> {
    let blocks = blocks(&page.text).into_iter();
    let loose = blocks.filter(|block| !is_held(&block.language, &block.tag));
    let told = |b: checks::book::Block| {
        format!("{}: no test runs the block ```{},{}", page.name, b.language, b.tag)
    };
    loose.map(told).collect()
}

/// Links of a page that lead nowhere. `known` has the anchors of every page.
fn dead(page: &Page, known: &BTreeMap<String, Vec<String>>) -> Vec<String> {
    let leads = |target: &&str| {
        if target.starts_with("https://") {
            return true;
        }
        let (file, anchor) = target.split_once('#').map_or((*target, None), |(f, a)| (f, Some(a)));
        let file = if file.is_empty() { page.name.as_str() } else { file };
        match (known.get(file), anchor) {
            (Some(anchors), Some(anchor)) => anchors.iter().any(|known| known == anchor),
            (Some(_), None) => true,
            // A picture, or a page that the contents do not name.
            (None, _) => !file.ends_with(".md") && folder().join(file).exists(),
        }
    };
    let dead = links(&page.text).into_iter().filter(|target| !leads(target));
    dead.map(|target| format!("{}: {target} leads nowhere", page.name)).collect()
}

fn known(pages: &[Page]) -> BTreeMap<String, Vec<String>> {
    pages.iter().map(|page| (page.name.clone(), anchors(&page.text))).collect()
}

#[test]
fn the_contents_name_every_page_once() {
    let mut named: Vec<String> = pages().into_iter().map(|page| page.name).collect();
    let entries =
        fs::read_dir(folder()).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    let mut there: Vec<String> =
        entries.filter(|name| name.ends_with(".md") && name != "SUMMARY.md").collect();
    named.sort();
    there.sort();
    assert_eq!(named, there);
}

#[test]
fn links_and_anchors_of_the_book_lead_somewhere() {
    let pages = pages();
    let known = known(&pages);
    assert_kept(&pages.iter().flat_map(|page| dead(page, &known)).collect::<Vec<_>>());
}

#[test]
fn what_can_be_run_in_the_book_is_run() {
    assert_kept(&pages().iter().flat_map(loose).collect::<Vec<_>>());
}

#[test]
fn the_tables_of_the_judge_are_those_of_the_notebook() {
    let known = [text("README.md"), text("docs/lab/2026-11-26-panel.md")].concat();
    let page = pages().into_iter().find(|page| page.name == "judge.md").unwrap();
    let rows = page.text.lines().filter(|line| line.starts_with("| ")).map(str::to_owned);
    let blocks = blocks(&page.text).into_iter().map(|block| block.text);
    let figures: Vec<String> = rows.chain(blocks).collect();
    assert!(figures.len() > 3);
    let stale = figures.into_iter().filter(|figure| !known.contains(figure.as_str()));
    assert_kept(&stale.collect::<Vec<_>>());
}

#[test]
fn what_leads_nowhere_or_is_run_by_nothing_is_told() {
    let page = |name: &str, text: &str| Page { name: name.to_owned(), text: text.to_owned() };
    let pages = [
        page("a.md", "# One\n[x](b.md#two) [y](b.md#three) [z](c.md) [w](#one) [v](no.svg)\n"),
        page("b.md", "## Two\n```sh\nls\n```\n```toml\na = 1\n```\n"),
    ];
    let known = known(&pages);
    let dead = dead(&pages[0], &known);
    let expected = ["b.md#three", "c.md", "no.svg"];
    assert_eq!(dead, expected.map(|target| format!("a.md: {target} leads nowhere")));
    assert_eq!(loose(&pages[1]).len(), 2);
}
