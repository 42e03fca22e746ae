//! What a command leaves in its folder where nothing disturbs it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::faults::{grows, is_whole};
use crate::program::run;
use crate::writers::{content, folder, plan};

/// A command, its folder, and what it leaves below `out`.
pub struct Undisturbed {
    folder: tempfile::TempDir,
    pub command: &'static str,
    pub code: i32,
    pub took: Duration,
    /// What the command needs to find below `out`.
    ready: Option<Tree>,
    left: BTreeMap<PathBuf, Content>,
}

/// Names below a folder, the bytes of files; folders have none.
type Tree = BTreeMap<PathBuf, Option<Vec<u8>>>;

/// What has a name below `out`.
enum Content {
    Folder,
    Same(Vec<u8>),
    /// A file with times or memory in it, which no two runs share.
    Varying,
}

impl Undisturbed {
    pub fn new(command: &'static str) -> Self {
        let folder = folder();
        plan(folder.path(), command);
        let out = folder.path().join("out");
        let ready = out.exists().then(|| tree(&out, |path| fs::read(path).unwrap()));
        let mut of_two = [(); 2].map(|()| {
            put(&out, ready.as_ref());
            let start = Instant::now();
            let answer = run(folder.path(), &command.split(' ').collect::<Vec<_>>());
            assert!(answer.code <= 1, "{command}: {}", answer.err);
            (tree(&out, content), answer.code, start.elapsed())
        });
        let [(first, ..), (second, code, took)] = &mut of_two;
        assert!(first.keys().eq(second.keys()), "{command}: {first:?}, then {second:?}");
        let (code, took) = (*code, *took);
        let same = |(name, bytes): (PathBuf, Option<Vec<u8>>)| {
            let content = match bytes {
                None => Content::Folder,
                Some(bytes)
                    if !has_times(command, &name) && first[&name].as_ref() == Some(&bytes) =>
                {
                    Content::Same(bytes)
                }
                Some(_) => Content::Varying,
            };
            (name, content)
        };
        let left = std::mem::take(second).into_iter().map(same).collect();
        Self { folder, command, code, took, ready, left }
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    pub fn words(&self) -> Vec<&'static str> {
        self.command.split(' ').collect()
    }

    /// Only what the command needs to find.
    pub fn prepare(&self) {
        put(&self.out(), self.ready.as_ref());
    }

    fn out(&self) -> PathBuf {
        self.path().join("out")
    }

    /// The folder holds what it holds where nothing disturbs the command, and nothing else.
    pub fn assert_same(&self, after: &str) {
        let found = tree(&self.out(), content);
        let names = |tree: &mut dyn Iterator<Item = &PathBuf>| -> Vec<String> {
            tree.map(|name| name.display().to_string()).collect()
        };
        assert_eq!(
            names(&mut found.keys()),
            names(&mut self.left.keys()),
            "{}, {after}",
            self.command
        );
        self.assert_contents(&found, after);
    }

    /// The same after the command is run once more.
    pub fn assert_same_again(&self, after: &str) {
        let again = run(self.path(), &self.words());
        assert_eq!(again.code, self.code, "again after {after}: {}", again.err);
        self.assert_same(&format!("again after {after}"));
    }

    /// What has a final name is what it is where nothing disturbs the command; under temporary names there is nothing.
    pub fn assert_nothing_half(&self, after: &str) {
        let out = self.out();
        // What is being worked on has a folder of its own.
        let _ = fs::remove_dir_all(out.join("work"));
        let mut found = if out.exists() { tree(&out, content) } else { Tree::new() };
        // Logs and recordings of runs grow.
        found.retain(|name, _| !grows(&out.join(name)));
        self.assert_contents(&found, after);
    }

    fn assert_contents(&self, found: &Tree, after: &str) {
        for (name, bytes) in found {
            let what = || format!("{}, {after}: {}", self.command, name.display());
            let left = self.left.get(name);
            match (left, bytes) {
                (Some(Content::Same(expected)), Some(bytes)) => {
                    assert!(expected == bytes, "{}: {} bytes", what(), bytes.len());
                }
                (Some(Content::Varying), Some(_)) => {
                    assert!(is_whole(&self.out().join(name)), "{}", what());
                }
                _ => assert!(
                    matches!((left, bytes), (Some(Content::Folder), None)),
                    "{} is left",
                    what()
                ),
            }
        }
    }
}

/// Whether a file says how long something took, which may be the same twice.
fn has_times(command: &str, file: &Path) -> bool {
    let times = ["demo", "figure", "learn", "run", "times", "track"];
    let of = times.iter().any(|word| command.starts_with(word));
    let kinds = ["html", "json", "rrd", "svg"];
    of && file.extension().is_some_and(|kind| kinds.iter().any(|k| kind == *k))
}

/// Makes a folder what it is to be.
fn put(folder: &Path, ready: Option<&Tree>) {
    if folder.exists() {
        fs::remove_dir_all(folder).unwrap();
    }
    let Some(ready) = ready else { return };
    fs::create_dir(folder).unwrap();
    // A folder comes before what is in it.
    for (name, bytes) in ready {
        match bytes {
            None => fs::create_dir(folder.join(name)).unwrap(),
            Some(bytes) => fs::write(folder.join(name), bytes).unwrap(),
        }
    }
}

/// Every name in and below a folder.
fn tree(folder: &Path, content: fn(&Path) -> Vec<u8>) -> Tree {
    let mut all = Tree::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for path in fs::read_dir(&next).unwrap().map(|entry| entry.unwrap().path()) {
            let name = path.strip_prefix(folder).unwrap().to_owned();
            if path.is_dir() {
                all.insert(name, None);
                folders.push(path);
            } else {
                all.insert(name, Some(content(&path)));
            }
        }
    }
    all
}
