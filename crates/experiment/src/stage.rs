use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::error::ExperimentError;

/// A part of a run whose files are kept, and made again only when its inputs change.
///
/// ```text
/// inputs --make--> files, value --last--> stages/NAME.json: hash of inputs, hashes of files, value
/// ```
///
/// A stage is made again when it was interrupted, which leaves no such file, and when one of its files was changed,
/// which gives another hash.
#[derive(Debug, Clone)]
pub struct Stage {
    folder: PathBuf,
    file: PathBuf,
}

/// The result of making a stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Product<T> {
    /// The value for later stages.
    pub value: T,
    /// The files of the stage, relative to the folder of the run.
    pub files: Vec<PathBuf>,
}

/// The result of a stage, made now or before.
#[derive(Debug, Clone, PartialEq)]
pub struct Staged<T> {
    /// The value for later stages.
    pub value: T,
    /// SHA-256 of the files, by their paths relative to the folder of the run.
    pub files: BTreeMap<PathBuf, String>,
    /// Whether the result was made before.
    pub is_kept: bool,
}

/// The hash of all inputs of a stage.
#[derive(Debug, Clone)]
pub struct StageInputs(Sha256);

/// `stages/NAME.json`
#[derive(Serialize, Deserialize)]
struct Stored<T> {
    inputs: String,
    files: BTreeMap<PathBuf, String>,
    value: T,
}

impl StageInputs {
    /// Inputs that start with a version of the program.
    pub fn of(version: &str) -> Self {
        Self(Sha256::new()).and(version.as_bytes())
    }

    /// The inputs with these bytes added.
    #[must_use]
    pub fn and(mut self, bytes: &[u8]) -> Self {
        self.0.update((bytes.len() as u64).to_le_bytes());
        self.0.update(bytes);
        self
    }

    /// The inputs with the bytes of a file added.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Stage`].
    pub fn and_file(self, path: &Path) -> Result<Self, ExperimentError> {
        Ok(self.and(&files::bytes(path, u64::MAX).map_err(|e| stage_error(path)(e.into()))?))
    }

    fn hash(self) -> String {
        hexadecimal(self.0)
    }
}

impl Stage {
    /// The stage of this name in the folder of a run.
    pub fn new(folder: &Path, name: &str) -> Self {
        let file = folder.join("stages").join(format!("{name}.json"));
        Self { folder: folder.to_owned(), file }
    }

    /// The product of the stage: the stored one where it is complete and has these inputs, otherwise the one that
    /// `make` returns.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Stage`] when a file cannot be read or written, and the errors of `make`.
    pub fn make<T, E>(
        &self,
        inputs: StageInputs,
        make: impl FnOnce() -> Result<Product<T>, E>,
    ) -> Result<Staged<T>, E>
    where
        T: Serialize + DeserializeOwned,
        E: From<ExperimentError>,
    {
        let inputs = inputs.hash();
        if let Some(Stored { files, value, .. }) = self.read_product(&inputs) {
            return Ok(Staged { value, files, is_kept: true });
        }
        self.begin()?;
        let Product { value, files } = make()?;
        let with_hash = |file: PathBuf| Ok((file.clone(), sha256(&self.folder.join(&file))?));
        let files: Result<BTreeMap<_, _>, ExperimentError> =
            files.into_iter().map(with_hash).collect();
        let stored = Stored { inputs, files: files?, value };
        let text = serde_json::to_string_pretty(&stored).map_err(|e| ExperimentError::Stage {
            path: self.file.clone(),
            reason: e.to_string(),
        })?;
        logs::replace_file(&self.file, |file| Ok(file.write_all(text.as_bytes())?))
            .map_err(ExperimentError::from)?;
        Ok(Staged { value: stored.value, files: stored.files, is_kept: false })
    }

    /// The stored product for these inputs, unless a file is missing or changed.
    fn read_product<T: DeserializeOwned>(&self, inputs: &str) -> Option<Stored<T>> {
        let text = files::text(&self.file, files::KEPT_BYTES).ok()?;
        let stored: Stored<T> = serde_json::from_str(&text).ok()?;
        let is_whole = |(file, hash): (&PathBuf, &String)| {
            sha256(&self.folder.join(file)).is_ok_and(|found| found == *hash)
        };
        (stored.inputs == inputs && stored.files.iter().all(is_whole)).then_some(stored)
    }

    /// Removes the record of a finished stage.
    fn begin(&self) -> Result<(), ExperimentError> {
        if let Some(folder) = self.file.parent() {
            std::fs::create_dir_all(folder).map_err(stage_error(folder))?;
        }
        match std::fs::remove_file(&self.file) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(stage_error(&self.file)(error))
            }
            _ => Ok(()),
        }
    }
}

fn stage_error(path: &Path) -> impl Fn(std::io::Error) -> ExperimentError {
    |error| ExperimentError::Stage { path: path.to_owned(), reason: error.to_string() }
}

/// SHA-256 of a file, in hexadecimal.
///
/// # Errors
///
/// [`ExperimentError::Stage`].
pub fn sha256(path: &Path) -> Result<String, ExperimentError> {
    let mut hasher = Sha256::new();
    files::each_piece(path, |piece| hasher.update(piece))
        .map_err(|error| stage_error(path)(error.into()))?;
    Ok(hexadecimal(hasher))
}

fn hexadecimal(hasher: Sha256) -> String {
    hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes a stage of `input`, counting how often.
    fn make_stage(folder: &Path, input: &str, count: &mut usize) -> Staged<usize> {
        let make = || {
            *count += 1;
            std::fs::write(folder.join("a.txt"), input).unwrap();
            Ok::<_, ExperimentError>(Product { value: input.len(), files: vec!["a.txt".into()] })
        };
        let inputs = StageInputs::of("1").and(input.as_bytes());
        Stage::new(folder, "first").make(inputs, make).unwrap()
    }

    #[test]
    fn a_stage_is_made_once_and_again_when_inputs_or_files_change() {
        let folder = tempfile::tempdir().unwrap();
        let (folder, mut count) = (folder.path(), 0);
        let first = make_stage(folder, "abc", &mut count);
        assert!(!first.is_kept && first.value == 3);
        // FIPS 180-2, appendix B.1.
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(first.files[Path::new("a.txt")], abc);
        let again = make_stage(folder, "abc", &mut count);
        assert_eq!((again.is_kept, again.value, count), (true, 3, 1));
        assert_eq!(again.files, first.files);
        assert!(!make_stage(folder, "abcd", &mut count).is_kept, "another input");
        std::fs::write(folder.join("a.txt"), "damaged").unwrap();
        assert!(!make_stage(folder, "abcd", &mut count).is_kept, "a file that was changed");
        std::fs::remove_file(folder.join("a.txt")).unwrap();
        assert!(!make_stage(folder, "abcd", &mut count).is_kept, "a file that is gone");
        std::fs::write(folder.join("stages/first.json"), "{\"inputs\": ").unwrap();
        assert!(!make_stage(folder, "abcd", &mut count).is_kept, "a torn entry");
        assert!(make_stage(folder, "abcd", &mut count).is_kept);
        assert_eq!(count, 5);
    }

    #[test]
    fn a_stage_that_fails_is_not_taken_for_made_though_its_old_files_are_there() {
        let folder = tempfile::tempdir().unwrap();
        let (folder, mut count) = (folder.path(), 0);
        make_stage(folder, "abc", &mut count);
        let stage = Stage::new(folder, "first");
        let fails = || Err(ExperimentError::WriterDied { path: PathBuf::new() });
        let inputs = || StageInputs::of("1").and(b"other");
        assert!(stage.make::<usize, _>(inputs(), fails).is_err());
        assert!(!make_stage(folder, "abc", &mut count).is_kept);
    }

    #[test]
    fn where_one_input_ends_and_the_next_begins_matters() {
        let hash = |parts: [&str; 2]| {
            StageInputs::of("1").and(parts[0].as_bytes()).and(parts[1].as_bytes()).hash()
        };
        assert_ne!(hash(["ab", "c"]), hash(["a", "bc"]));
    }
}
