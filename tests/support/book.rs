//! The book in `docs`: its pages, their headings, links and fenced blocks, and what a page's commands print.

use std::fs;
use std::path::{Path, PathBuf};

use crate::arms::workspace_root;

/// Most that a printed number may differ from the one in the book, as a share of it: what processors with other
/// instructions make of the last digits.
const DIFFERS: f64 = 0.03;

/// Units of the last place that it may differ by all the same: one, and what subtraction adds to it.
const PLACES: f64 = 1.01;

/// A page: its file in `docs/src` and its text.
#[derive(Debug)]
pub struct Page {
    /// Name of the file.
    pub name: String,
    /// All of it.
    pub text: String,
}

/// A fenced block: the words behind its fence, and what stands in it.
#[derive(Debug, PartialEq, Eq)]
pub struct Block {
    /// The word behind the fence.
    pub language: String,
    /// What is done with it: `run`, `printed`, `file=NAME`, or nothing.
    pub tag: String,
    /// Its lines.
    pub text: String,
}

/// The folder of the pages.
pub fn folder() -> PathBuf {
    workspace_root().join("docs/src")
}

/// The pages that the contents name, in their order.
pub fn pages() -> Vec<Page> {
    let contents = fs::read_to_string(folder().join("SUMMARY.md")).unwrap();
    let names = links(&contents).into_iter().map(str::to_owned);
    let read = |name: String| {
        let text = fs::read_to_string(folder().join(&name)).map_err(|error| (name.clone(), error));
        Page { name, text: text.unwrap() }
    };
    names.map(read).collect()
}

/// Lines outside of fenced blocks.
fn prose(text: &str) -> impl Iterator<Item = &str> {
    let mut fenced = false;
    text.lines().filter(move |line| {
        let fence = line.starts_with("```");
        fenced ^= fence;
        !fenced && !fence
    })
}

/// Targets of links and pictures.
pub fn links(text: &str) -> Vec<&str> {
    let targets = |line| str::split(line, "](").skip(1).filter_map(|rest| rest.split_once(')'));
    prose(text).flat_map(targets).map(|(target, _)| target).collect()
}

/// The anchors of a page, as mdBook makes them of its headings: letters, digits, hyphens and underscores in lower
/// case, blanks as hyphens.
pub fn anchors(text: &str) -> Vec<String> {
    let headings = prose(text).filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| {
        let words = heading.trim_start_matches('#').trim().to_lowercase();
        let kept = words.chars().filter(|c| c.is_alphanumeric() || "-_ ".contains(*c));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    headings.map(anchor).collect()
}

/// The fenced blocks of a page.
pub fn blocks(text: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let Some(words) = line.strip_prefix("```") else { continue };
        let (language, tag) = words.split_once(',').unwrap_or((words, ""));
        let body: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
        blocks.push(Block {
            language: language.to_owned(),
            tag: tag.to_owned(),
            text: body.join("\n") + "\n",
        });
    }
    blocks
}

/// A folder as a reader has it who stands in a checkout: its robots, scenarios and documents, and the files of
/// the page.
#[cfg(unix)]
pub fn reader(page: &Page) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["robots", "scenarios", "docs"] {
        std::os::unix::fs::symlink(workspace_root().join(name), folder.path().join(name)).unwrap();
    }
    for block in blocks(&page.text) {
        if let Some(name) = block.tag.strip_prefix("file=") {
            fs::write(folder.path().join(name), &block.text).unwrap();
        }
    }
    folder
}

/// The first line that the book says is printed and is not, in the order of the lines. A line `...` stands for any
/// others; numbers may differ by 3 % or by one in the last place.
pub fn missing<'a>(shown: &'a str, printed: &str) -> Option<&'a str> {
    let mut lines = printed.lines();
    let wanted = shown.lines().filter(|line| !line.trim().is_empty() && line.trim() != "...");
    wanted.into_iter().find(|wanted| !lines.any(|line| is_alike(wanted, line)))
}

fn is_alike(shown: &str, printed: &str) -> bool {
    let [shown, printed] = [shown, printed].map(|line| line.split_whitespace().collect::<Vec<_>>());
    shown.len() == printed.len() && shown.iter().zip(&printed).all(|(a, b)| is_same(a, b))
}

fn is_same(shown: &str, printed: &str) -> bool {
    let [a, b] = [shown, printed].map(|w| w.trim_matches(['(', ')', '[', ']', ',', ';', ':', '%']));
    let decimals = a.split_once('.').map(|(_, decimals)| decimals);
    let decimals = decimals.filter(|d| d.bytes().all(|byte| byte.is_ascii_digit()));
    // A count, or a number with an exponent, has no last place of its own.
    let last_place = decimals.map_or(0.0, |d| 0.1f64.powi(d.len() as i32));
    let numbers = a.parse::<f64>().ok().zip(b.parse::<f64>().ok());
    let is_near =
        |(a, b): (f64, f64)| (a - b).abs() <= (DIFFERS * a.abs()).max(PLACES * last_place);
    shown == printed || numbers.is_some_and(is_near)
}

/// Whether a program can be started with these arguments and ends well.
pub fn can(program: impl AsRef<Path>, arguments: &[&str]) -> bool {
    let mut command = std::process::Command::new(program.as_ref());
    command.args(arguments).output().is_ok_and(|output| output.status.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_is_taken_apart() {
        let text = "# A title: `b_c`\n[a](b.md#c)\n```sh,run\n# [no](link)\nls\n```\n## Two\n";
        assert_eq!(links(text), ["b.md#c"]);
        assert_eq!(anchors(text), ["a-title-b_c", "two"]);
        let block = |language: &str, tag: &str, text: &str| Block {
            language: language.to_owned(),
            tag: tag.to_owned(),
            text: text.to_owned(),
        };
        assert_eq!(blocks(text), [block("sh", "run", "# [no](link)\nls\n")]);
    }

    #[test]
    fn what_is_shown_and_not_printed_is_told() {
        let printed = "level  1.502 N·m (1.48 to 1.52)\nother\nend\n2 causes, 3.6e-5\n";
        assert_eq!(missing("level 1.50 N·m (1.48 to 1.52)\n...\nend\n", printed), None);
        assert_eq!(missing("end\nother\n", printed), Some("other"));
        assert_eq!(missing("3 causes, 3.6e-5\n", printed), Some("3 causes, 3.6e-5"));
        assert_eq!(missing("2 causes, 3.9e-5\n", printed), Some("2 causes, 3.9e-5"));
        assert_eq!(
            missing("level 1.7 N·m (1.48 to 1.52)\n", printed),
            Some("level 1.7 N·m (1.48 to 1.52)")
        );
    }
}
