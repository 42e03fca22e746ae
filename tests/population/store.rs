//! A store of logs: what is made once is kept, what cannot be used is named and made again.

use std::fs;
use std::path::Path;

use population::{ArmClass, Came, Kept, PopulationError, PopulationSpec, Store};

use crate::made::{files, short};

fn spec() -> PopulationSpec {
    PopulationSpec { strangers: 0.0, ..short(ArmClass::Hobby, [0, 0]) }
}

fn took(store: &Store, seed: u64) -> Kept {
    store.trial(&spec(), seed).unwrap()
}

fn reason(kept: &Kept) -> &str {
    match &kept.came {
        Came::Again(remade) => &remade.reason,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_trial_is_made_once_and_again_when_it_is_damaged() {
    let root = tempfile::tempdir().unwrap();
    let store = Store::open(root.path()).unwrap();
    let first = took(&store, 1);
    assert_eq!(first.came, Came::Made);
    let whole = files(&first.folder);
    assert_eq!(took(&store, 1).came, Came::WasThere);
    assert_ne!(took(&store, 2).folder, first.folder);
    // A larger population holds the trials of a smaller.
    let larger = PopulationSpec { trials: 9, ..spec() };
    assert_eq!(store.trial(&larger, 1).unwrap().came, Came::WasThere);

    let log = first
        .folder
        .join("logs")
        .join(whole.keys().find_map(|name| name.strip_prefix("logs/")).unwrap());
    let mut bytes = fs::read(&log).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&log, bytes).unwrap();
    let again = took(&store, 1);
    assert!(reason(&again).contains("is missing or damaged"), "{}", reason(&again));
    assert!(reason(&again).contains("logs/"));
    assert!(files(&first.folder) == whole, "made again it is other");

    fs::remove_file(first.folder.join("sheet.json")).unwrap();
    assert!(reason(&took(&store, 1)).contains("sheet.json"));
    fs::write(first.folder.join("entry.json"), "{").unwrap();
    assert!(reason(&took(&store, 1)).contains("entry.json is none"));
    let old = fs::read_to_string(first.folder.join("entry.json")).unwrap();
    let other = old.replacen(&format!("\"format\": {}", population::FORMAT), "\"format\": 0", 1);
    assert_ne!(old, other);
    fs::write(first.folder.join("entry.json"), other).unwrap();
    assert!(reason(&took(&store, 1)).contains("it is of format 0"));
    assert!(files(&first.folder) == whole);
}

/// The oracle needs nothing but the files of a trial, and an entry with a new sheet is whole.
#[test]
fn a_sheet_that_is_worked_out_anew_is_the_one_that_was_made() {
    let root = tempfile::tempdir().unwrap();
    let store = Store::open(root.path()).unwrap();
    let spec = PopulationSpec { spoilt: 1.0, ..short(ArmClass::Hobby, [2, 2]) };
    let made = store.trial(&spec, 4).unwrap();
    let whole = files(&made.folder);
    let mut told = Vec::new();
    store.sheets_again(&mut |folder| told.push(folder.to_owned())).unwrap();
    assert_eq!(told, std::slice::from_ref(&made.folder));
    assert!(files(&made.folder) == whole);
    assert_eq!(store.trial(&spec, 4).unwrap().came, Came::WasThere);
}

#[test]
fn what_a_kill_left_half_made_is_no_trial() {
    let root = tempfile::tempdir().unwrap();
    let store = Store::open(root.path()).unwrap();
    let made = took(&store, 1);
    let whole = files(&made.folder);
    // As a process leaves it that dies while it makes the same trial.
    let key = made.folder.file_name().unwrap().to_str().unwrap();
    let half = root.path().join(format!("making-{key}"));
    fs::create_dir_all(half.join("logs")).unwrap();
    fs::write(half.join("logs/run_1.parquet"), b"PAR1").unwrap();
    fs::remove_dir_all(&made.folder).unwrap();
    assert_eq!(took(&store, 1).came, Came::Made);
    assert!(files(&made.folder) == whole && !half.exists());
}

/// A small file system in memory, where one can be had.
fn small_disk(at: &Path) -> Option<()> {
    let mount = std::process::Command::new("mount")
        .args(["-t", "tmpfs", "-o", "size=96k", "tmpfs"])
        .arg(at)
        .output()
        .ok()?;
    mount.status.success().then_some(())
}

#[test]
fn a_full_disk_leaves_nothing_half_made() {
    let root = tempfile::tempdir().unwrap();
    if small_disk(root.path()).is_none() {
        println!("skipped: no file system in memory can be mounted here");
        return;
    }
    let store = Store::open(root.path()).unwrap();
    let error = store.trial(&spec(), 1).unwrap_err();
    let left = files(root.path());
    let _ = std::process::Command::new("umount").arg(root.path()).status();
    assert!(matches!(error, PopulationError::Log(_) | PopulationError::Folder { .. }), "{error:?}");
    assert!(error.to_string().contains(&root.path().display().to_string()), "{error}");
    assert!(left.keys().all(|name| name.starts_with("locks/")), "{:?}", left.keys());
}
