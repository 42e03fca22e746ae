//! A round of mutated inputs over one reader.

use std::any::Any;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use rand_chacha::ChaCha8Rng;

use crate::arms::generator;
use crate::watch::Watch;

/// Defects after which a round ends.
const ENOUGH: usize = 5;

/// What became of the inputs.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Counts {
    /// Inputs that were read to their end.
    pub read: u64,
    /// Inputs that were refused in words.
    pub refused: u64,
}

/// Writes an input for every seed into the file and reads it.
///
/// Ends the program where one hangs.
///
/// # Errors
///
/// The seeds with what is wrong with what became of them.
pub fn run(
    reader: &str,
    seeds: Range<u64>,
    file: &Path,
    change: impl Fn(&mut ChaCha8Rng) -> Vec<u8>,
    read: impl Fn(&Path) -> Result<(), String>,
) -> Result<Counts, String> {
    let watch = Watch::start(reader);
    let mut counts = Counts::default();
    let mut defects = Vec::new();
    for seed in seeds {
        watch.begin(seed);
        let input = change(&mut generator(seed));
        std::fs::write(file, &input).unwrap();
        let outcome = catch_unwind(AssertUnwindSafe(|| read(file)));
        let defect = match outcome {
            Ok(Ok(())) => {
                counts.read += 1;
                None
            }
            Ok(Err(told)) => {
                counts.refused += 1;
                (!names_a_file(&told, file, &input)).then(|| format!("no file is named: {told}"))
            }
            Err(panic) => Some(format!("panic: {}", words(&*panic))),
        };
        defects.extend(defect.map(|words| format!("{reader}, seed {seed}: {words}")));
        if defects.len() == ENOUGH {
            break;
        }
    }
    if defects.is_empty() { Ok(counts) } else { Err(defects.join("\n")) }
}

/// The first of fresh seeds where `PLUMBLINE_LONG` asks for the long form of a test.
pub fn fresh_seeds() -> Option<u64> {
    std::env::var_os("PLUMBLINE_LONG")?;
    let first = std::time::UNIX_EPOCH.elapsed().unwrap().as_secs() << 20;
    println!("seeds from {first}");
    Some(first)
}

/// Whether what is told names the file of the input, or begins with another one that is there and that the input names.
fn names_a_file(told: &str, file: &Path, input: &[u8]) -> bool {
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let other = told.split_once(':').map(|(path, _)| Path::new(path)).filter(|path| path.is_file());
    let is_named = |path: &Path| String::from_utf8_lossy(input).contains(&name(path));
    told.contains(&name(file)) || other.is_some_and(is_named)
}

fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().cloned();
    text.or_else(|| panic.downcast_ref::<&str>().map(|&s| s.to_owned())).unwrap_or_default()
}
