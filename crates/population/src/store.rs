use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::error::PopulationError;
use crate::sheet::TruthSheet;
use crate::spec::{FORMAT, PopulationSpec};
use crate::text_file::write_text;
use crate::trial::again::sheet_again;
use crate::trial::make::make;

/// Name of the file that lists the files of an entry; it is written last.
const ENTRY: &str = "entry.json";

/// A cache of trials: a folder with an entry per trial.
///
/// ```text
/// key   = SHA-256(everything that determines the draws of a population, seed of the trial)
/// entry = DIR/ab/abcd.../{nominal, logs, held_out, truth, sheet.json, entry.json}
/// ```
///
/// An entry is built beside its place and renamed when complete, under a lock that ends with the process. An
/// entry of another version, or with files that differ from its list, is made again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Store {
    root: PathBuf,
}

/// An entry of a store that could not be used and was made again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remade {
    /// Its folder.
    pub path: PathBuf,
    /// What was wrong with it.
    pub reason: String,
}

/// A trial in a store.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Kept {
    /// Its folder.
    pub folder: PathBuf,
    /// How it came to be there.
    pub came: Came,
}

/// How a trial came to be in a store.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Came {
    /// It existed.
    WasThere,
    /// It was made.
    Made,
    /// It existed, could not be used, and was made again.
    Again(Remade),
}

/// `entry.json`
#[derive(Debug, Serialize, Deserialize)]
struct Entry {
    format: u32,
    /// SHA-256 of every file, by its path in the entry.
    files: BTreeMap<String, String>,
}

impl Entry {
    fn write(&self, folder: &Path) -> Result<(), PopulationError> {
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        write_text(&folder.join(ENTRY), &text)
    }
}

impl Store {
    /// Opens the store in a folder, creating the folder where it is absent.
    ///
    /// # Errors
    ///
    /// [`PopulationError::Folder`].
    pub fn open(root: &Path) -> Result<Self, PopulationError> {
        fs::create_dir_all(root.join("locks")).map_err(PopulationError::of_folder(root))?;
        Ok(Self { root: root.to_owned() })
    }

    /// The simulated trial of a population with a seed, made where it is absent.
    ///
    /// # Errors
    ///
    /// [`PopulationError`] when it cannot be made, read or written. No incomplete entry is left behind.
    pub fn trial(&self, spec: &PopulationSpec, seed: u64) -> Result<Kept, PopulationError> {
        let key = key(spec, seed);
        let folder = self.root.join(&key[..2]).join(&key);
        let at = PopulationError::of_folder(&self.root);
        let lock = File::create(self.root.join("locks").join(&key)).map_err(&at)?;
        lock.lock().map_err(&at)?;
        let came = match whole(&folder) {
            Ok(()) => return Ok(Kept { folder, came: Came::WasThere }),
            Err(None) => Came::Made,
            Err(Some(reason)) => Came::Again(Remade { path: folder.clone(), reason }),
        };
        let making = self.root.join(format!("making-{key}"));
        let made = self.fill(spec, seed, &making, &folder);
        if made.is_err() {
            // What is half made takes room and is of no use.
            let _ = fs::remove_dir_all(&making);
        }
        made.map(|()| Kept { folder, came })
    }

    /// Whether it has the simulated trial of a population with a seed.
    pub fn holds(&self, spec: &PopulationSpec, seed: u64) -> bool {
        let key = key(spec, seed);
        whole(&self.root.join(&key[..2]).join(&key)).is_ok()
    }

    /// Works out the sheet of every trial anew, and leaves logs, list and format of the entry as they are but for the
    /// sheet. So a program that takes this format can be judged by the oracle of this one.
    ///
    /// `on_trial` is called with the folder of each.
    ///
    /// # Errors
    ///
    /// [`PopulationError`] at the first trial that cannot be read, worked out or written.
    pub fn sheets_again(&self, on_trial: &mut dyn FnMut(&Path)) -> Result<(), PopulationError> {
        let at = PopulationError::of_folder(&self.root);
        for folder in self.entries().map_err(&at)? {
            let key = folder.file_name().unwrap_or_default();
            let lock = File::create(self.root.join("locks").join(key)).map_err(&at)?;
            lock.lock().map_err(&at)?;
            let unreadable = |reason| PopulationError::Folder { path: folder.clone(), reason };
            let text = files::text(&folder.join(ENTRY), files::KEPT_BYTES)
                .map_err(|e| unreadable(e.to_string()))?;
            let mut entry: Entry =
                serde_json::from_str(&text).map_err(|e| unreadable(e.to_string()))?;
            sheet_again(&folder)?.write(&folder)?;
            let sheet = files::bytes(&folder.join(TruthSheet::FILE), files::KEPT_BYTES)
                .map_err(|e| at(e.into()))?;
            entry.files.insert(TruthSheet::FILE.to_owned(), hexadecimal(&sheet));
            entry.write(&folder)?;
            on_trial(&folder);
        }
        Ok(())
    }

    /// Folders of all complete entries, in order.
    fn entries(&self) -> std::io::Result<Vec<PathBuf>> {
        let mut all = Vec::new();
        for part in fs::read_dir(&self.root)? {
            let part = part?;
            let name = part.file_name();
            if name.len() == 2 && part.path().is_dir() {
                for entry in fs::read_dir(part.path())? {
                    all.push(entry?.path());
                }
            }
        }
        all.retain(|folder| folder.join(ENTRY).is_file());
        all.sort();
        Ok(all)
    }

    fn fill(
        &self,
        spec: &PopulationSpec,
        seed: u64,
        making: &Path,
        folder: &Path,
    ) -> Result<(), PopulationError> {
        let at = PopulationError::of_folder(making);
        for left in [making, folder] {
            if left.exists() {
                fs::remove_dir_all(left).map_err(&at)?;
            }
        }
        fs::create_dir_all(making).map_err(&at)?;
        make(spec, seed, making)?;
        let entry = Entry { format: FORMAT, files: hashes(making).map_err(&at)? };
        entry.write(making)?;
        fs::create_dir_all(folder.parent().unwrap_or(&self.root)).map_err(&at)?;
        fs::rename(making, folder).map_err(&at)
    }
}

/// The key of a trial.
fn key(spec: &PopulationSpec, seed: u64) -> String {
    hexadecimal(format!("{}\n{seed}", spec.draws()).as_bytes())
}

fn hexadecimal(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |mut all, byte| {
        // A String takes everything.
        let _ = write!(all, "{byte:02x}");
        all
    })
}

/// Whether an entry is complete and of this version, and why not where one exists.
fn whole(folder: &Path) -> Result<(), Option<String>> {
    if !folder.exists() {
        return Err(None);
    }
    let text = files::text(&folder.join(ENTRY), files::KEPT_BYTES)
        .map_err(|e| Some(format!("{ENTRY} cannot be read: {e}")))?;
    let entry: Entry =
        serde_json::from_str(&text).map_err(|e| Some(format!("{ENTRY} is none: {e}")))?;
    if entry.format != FORMAT {
        return Err(Some(format!("it is of format {}, {FORMAT} was expected", entry.format)));
    }
    let found = hashes(folder).map_err(|e| Some(format!("it cannot be read: {e}")))?;
    match entry.files.iter().find(|(name, hash)| found.get(*name) != Some(hash)) {
        Some((name, _)) => Err(Some(format!("{name} is missing or damaged"))),
        None => Ok(()),
    }
}

/// SHA-256 of every file below a folder except the list itself.
fn hashes(folder: &Path) -> std::io::Result<BTreeMap<String, String>> {
    let mut all = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path.strip_prefix(folder).unwrap_or(&path).to_string_lossy().into_owned();
            if name != ENTRY {
                all.insert(name, hexadecimal(&files::bytes(&path, u64::MAX)?));
            }
        }
    }
    Ok(all)
}
