//! The book: every snippet of Python in it prints what the book shows, and every notebook runs from top to bottom and prints
//! what is stored in it.

use std::fs;
use std::process::Command;

use checks::arms::workspace_root;
use checks::book::{Page, blocks, missing, pages, reader};

use crate::{NUMPY, module, python};

/// What a notebook shows once it has run, besides what a test of its tutorial holds.
const SHOWN: [(&str, &[&str]); 3] = [
    (
        "ur-arm",
        &["1251 rows", "FR01", "shoulder_lift_joint", "FR02", "elbow_joint", "frictionloss"],
    ),
    ("hobby-arm", &["FR02", "elbow_flex", "the scale of all efforts cannot be known"]),
    ("payload", &["IN01", "panda_link7", "FR02", "panda_joint2"]),
];

/// Most that a notebook is in the repository, with its outputs (bytes).
const SIZE: u64 = 400_000;

/// What stands between the outputs of two snippets.
const BETWEEN: &str = "---- the next snippet ----";

/// Runs the snippets of a page as one program of `python`, and holds what they print against what the page shows.
pub fn hold(page: &Page, mut python: Command) {
    let folder = reader(page);
    let blocks = blocks(&page.text);
    let snippets = blocks.iter().filter(|block| block.language == "python");
    let snippets: Vec<&str> = snippets.map(|block| block.text.as_str()).collect();
    let script = folder.path().join("snippets.py");
    fs::write(&script, snippets.join(&format!("\nprint({BETWEEN:?})\n"))).unwrap();
    let ended = python.arg(&script).current_dir(folder.path()).output().unwrap();
    let said = String::from_utf8_lossy(&ended.stderr);
    assert!(ended.status.success(), "{}: {said}", page.name);
    let printed = String::from_utf8(ended.stdout).unwrap();
    let mut printed = printed.split(BETWEEN);
    let mut last = None;
    for block in &blocks {
        match (block.language.as_str(), block.tag.as_str()) {
            ("python", _) => last = printed.next(),
            ("sh", _) => last = None,
            ("text", "printed") => {
                let absent = last.and_then(|last| missing(&block.text, last));
                assert!(absent.is_none(), "{}: {absent:?} is not in {last:?}", page.name);
            }
            _ => {}
        }
    }
}

#[test]
fn snippets_print_what_the_book_shows() {
    let with_snippets = |page: &Page| blocks(&page.text).iter().any(|b| b.language == "python");
    let pages: Vec<Page> = pages().into_iter().filter(with_snippets).collect();
    assert!(!pages.is_empty());
    for page in &pages {
        let Some(module) = module(NUMPY, &format!("snippets of {} are", page.name)) else { return };
        hold(page, python(module.path()));
    }
}

/// What a script of the module's folder prints of its sources; none, said so, without a Python that runs it.
fn made_by(script: &str) -> Option<String> {
    let can =
        checks::book::can("python3", &["-c", "import sys; assert sys.version_info >= (3, 9)"]);
    if !can {
        println!("no python3 of 3.9 or later here: {script} is left unrun");
        return None;
    }
    let script = workspace_root().join("crates/python").join(script);
    let ended = Command::new("python3").arg(script).output().unwrap();
    let said = String::from_utf8_lossy(&ended.stderr);
    assert!(ended.status.success(), "{said}");
    Some(String::from_utf8(ended.stdout).unwrap())
}

#[test]
fn the_reference_is_made_of_the_sources() {
    let Some(made) = made_by("reference.py") else { return };
    let page = fs::read_to_string(checks::book::folder().join("python-reference.md")).unwrap();
    assert!(made == page, "python3 crates/python/reference.py > docs/src/python-reference.md");
}

#[test]
fn the_type_stubs_are_made_of_the_sources() {
    let Some(made) = made_by("stubs.py") else { return };
    let stubs = "crates/python/python/plumbline/_plumbline.pyi";
    let kept = fs::read_to_string(workspace_root().join(stubs)).unwrap();
    assert!(made == kept, "python3 crates/python/stubs.py > {stubs}");
}

#[test]
fn notebooks_run_from_top_to_bottom_and_print_what_is_stored() {
    let imports = "import nbclient, nbformat, ipykernel, pandas, matplotlib, pyarrow, numpy";
    let Some(module) = module(imports, "notebooks are") else { return };
    for (name, shown) in SHOWN {
        let path = workspace_root().join(format!("docs/notebooks/{name}.ipynb"));
        let work = tempfile::tempdir().unwrap();
        let ended = python(module.path())
            .arg(workspace_root().join("tests/python/run_notebook.py"))
            .arg(&path)
            .arg("--check")
            .env("TMPDIR", work.path())
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&ended.stderr);
        assert!(ended.status.success(), "{name}: {said}");
        let printed = String::from_utf8_lossy(&ended.stdout);
        let absent: Vec<_> = shown.iter().filter(|words| !printed.contains(**words)).collect();
        assert!(absent.is_empty(), "{name}: {absent:?} is not in {printed}");
    }
}

#[test]
fn every_tutorial_has_a_notebook_with_its_outputs() {
    let folder = workspace_root().join("docs/notebooks");
    let files = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
    let mut names: Vec<String> =
        files.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect();
    names.sort();
    assert_eq!(names, ["hobby-arm", "payload", "ur-arm"]);
    for name in names {
        assert!(pages().iter().any(|page| page.name == format!("{name}.md")), "{name}");
        let path = folder.join(format!("{name}.ipynb"));
        assert!(fs::metadata(&path).unwrap().len() < SIZE, "{name}");
        let notebook: serde_json::Value =
            serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        let cells = notebook["cells"].as_array().unwrap();
        let run = cells.iter().filter(|cell| cell["cell_type"] == "code");
        let counts: Vec<_> = run.map(|cell| cell["execution_count"].as_u64()).collect();
        let expected: Vec<_> = (1..=counts.len() as u64).map(Some).collect();
        assert_eq!(counts, expected, "{name}: it was run from top to bottom");
        let outputs: Vec<_> = cells.iter().filter_map(|cell| cell.get("outputs")).collect();
        let stored = serde_json::to_string(&outputs).unwrap();
        let (_, shown) = SHOWN.iter().find(|(known, _)| *known == name).unwrap();
        let absent: Vec<_> = shown.iter().filter(|words| !stored.contains(**words)).collect();
        assert!(absent.is_empty(), "{name}: {absent:?} is not in its outputs");
        for kept_out in ["\"error\"", "/tmp/", "/root/", "/home/"] {
            assert!(!stored.contains(kept_out), "{name}: {kept_out} is in its outputs");
        }
    }
}
