//! Power that fails between any two calls of a command: of a file is left what was flushed before, of a name what it was
//! given. No name may then hold less than the whole of its file.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::disk::{Call, Disk};
use crate::faults::grows;
use crate::writers::{FURTHER, SLOW, WALKED, folder, plan};

/// What lies on the disk of the files that a command has begun.
#[derive(Debug, Default)]
struct Platter {
    /// Whether all that was written of a file is flushed.
    files: BTreeMap<PathBuf, bool>,
    /// Files with a new name, until their folder is flushed.
    unnamed: Vec<PathBuf>,
}

impl Platter {
    fn take(&mut self, call: &Call) {
        match call.operation.as_str() {
            "create" | "write" | "cut" => drop(self.files.insert(call.path.clone(), false)),
            "sync" => {
                if let Some(is_flushed) = self.files.get_mut(&call.path) {
                    *is_flushed = true;
                }
                self.unnamed.retain(|path| path.parent() != Some(&call.path));
            }
            "rename" => {
                // A folder takes along what is in it.
                let of = |path: &Path| Some(call.to.join(path.strip_prefix(&call.path).ok()?));
                let moved = std::mem::take(&mut self.files).into_iter();
                self.files = moved
                    .map(|(path, flushed)| match of(&path) {
                        // `join` of nothing ends with a slash.
                        Some(new) => (new.components().collect(), flushed),
                        None => (path, flushed),
                    })
                    .collect();
                self.unnamed.push(call.to.clone());
            }
            "remove" => {
                self.files.retain(|path, _| !path.starts_with(&call.path));
                self.unnamed.retain(|path| !path.starts_with(&call.path));
            }
            _ => {}
        }
    }

    /// Files that would be empty or half under their names.
    fn half(&self) -> impl Iterator<Item = &PathBuf> {
        let is_final = |path: &Path| {
            let of_work = ["work", "locks"].map(Path::new);
            let hidden = path.file_name().unwrap().to_string_lossy().starts_with('.');
            !hidden && !path.iter().any(|part| of_work.contains(&Path::new(part)))
        };
        let files = self.files.iter();
        files.filter(move |(path, flushed)| !**flushed && is_final(path)).map(|(path, _)| path)
    }
}

/// What a power loss between any two of the calls would spoil, and what one after them would.
fn losses(calls: &[Call]) -> Vec<String> {
    let mut platter = Platter::default();
    let mut found = Vec::new();
    for call in calls.iter().filter(|call| !call.is_refused) {
        platter.take(call);
        let half = platter.half().filter(|path| !grows(path));
        found.extend(half.map(|path| format!("{} after call {}", path.display(), call.number)));
    }
    found.extend(platter.half().map(|path| format!("{} at the end", path.display())));
    let unnamed = platter.unnamed.iter();
    found.extend(unnamed.map(|path| format!("the name {}", path.display())));
    found
}

#[test]
fn a_power_loss_at_any_moment_leaves_no_file_empty_or_half() {
    let Some(disk) = Disk::build() else {
        println!("skipped: there is no compiler cc");
        return;
    };
    let is_long = checks::round::fresh_seeds().is_some();
    let slow = if is_long { &SLOW[..] } else { &[] };
    for command in WALKED.iter().chain(&FURTHER).chain(slow) {
        let folder = folder();
        plan(folder.path(), command);
        let words: Vec<&str> = command.split(' ').collect();
        let (answer, calls) = disk.run(folder.path(), &words, None);
        assert!(answer.code <= 1, "{command}: {}", answer.err);
        let written = calls.iter().filter(|call| call.operation == "rename").count();
        assert!(written > 0, "{command}");
        assert_eq!(losses(&calls), Vec::<String>::new(), "{command}");
        println!("| `{command}` | {} moments | {written} files |", calls.len());
    }
}

/// Calls of a program that renames before it flushes, that writes under the name, and that does neither.
#[test]
fn what_is_renamed_before_it_is_flushed_is_lost() {
    let call = |operation: &str, path: &str, to: &str| Call {
        number: 1,
        operation: operation.to_owned(),
        is_refused: false,
        bytes: 1,
        path: path.into(),
        to: to.into(),
    };
    let [create, write, flush, rename, flush_folder] = [
        call("create", "/out/.a", ""),
        call("write", "/out/.a", ""),
        call("sync", "/out/.a", ""),
        call("rename", "/out/.a", "/out/a"),
        call("sync", "/out", ""),
    ];
    let of = |calls: &[&Call]| losses(&calls.iter().map(|c| (*c).clone()).collect::<Vec<_>>());
    assert!(of(&[&create, &write, &flush, &rename, &flush_folder]).is_empty());
    assert_eq!(of(&[&create, &write, &flush, &rename]), ["the name /out/a"]);
    let early = of(&[&create, &write, &rename, &flush_folder]);
    assert!(early.contains(&"/out/a at the end".to_owned()), "{early:?}");
    let late = of(&[&create, &flush, &write, &rename, &flush_folder]);
    assert!(late.contains(&"/out/a at the end".to_owned()), "{late:?}");
    let mut whole = call("rename", "/making", "/ab");
    let inside = call("create", "/making/b", "");
    assert_eq!(of(&[&inside, &whole, &call("sync", "/", "")])[1], "/ab/b after call 1");
    whole.to = "/kept".into();
    let flushed = call("sync", "/making/b", "");
    assert_eq!(
        of(&[&inside, &flushed, &whole, &call("sync", "/", "")]),
        ["/making/b after call 1"]
    );
}
