//! Every reader of files that come from outside, with good inputs, mistakes, and the words of its format.

#[path = "diagnoses.rs"]
mod diagnoses;
#[path = "documents.rs"]
mod documents;
#[path = "folders.rs"]
mod folders;
#[path = "logs_of_kinds.rs"]
mod logs_of_kinds;
#[path = "robots.rs"]
mod robots;
#[path = "tables.rs"]
mod tables;

use std::path::Path;

use rand_chacha::ChaCha8Rng;

/// Puts what inputs refer to into a folder, and gives good inputs.
pub type Seeds = fn(&Path) -> Vec<Vec<u8>>;

/// A reader and what it is tried on.
pub struct Reader {
    /// What it reads.
    pub name: &'static str,
    /// The name of the file that it is given.
    pub file: &'static str,
    /// Inputs of the short round.
    pub short: u64,
    /// Puts files that inputs refer to into the folder, and gives good inputs.
    pub seeds: Seeds,
    /// Shorter ones where those take long, for rounds that read an input and no more.
    pub parsed: Option<Seeds>,
    /// Makes a few mistakes in a good input.
    pub change: fn(&[u8], &mut ChaCha8Rng) -> Vec<u8>,
    /// Reads the file and goes on to where it is used.
    pub read: fn(&Path) -> Result<(), String>,
    /// Reads the file and no more.
    pub parse: fn(&Path) -> Result<(), String>,
    /// Words and first bytes of the format.
    pub words: &'static [&'static str],
}

/// All of them.
pub fn readers() -> Vec<Reader> {
    let mut readers = logs_of_kinds::readers();
    readers.extend(robots::readers());
    readers.extend(documents::readers());
    readers.extend(tables::readers());
    readers.extend(folders::readers());
    readers.extend(diagnoses::readers());
    readers
}
