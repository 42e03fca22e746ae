//! Every reader is given inputs that a few mistakes turned into others: no panic, an end within 20 s, less than
//! 1 GiB, and a refusal that names a file.
//!
//! The short round is the same every time. The long one takes fresh seeds:
//! `PLUMBLINE_LONG=1 cargo test --release --workspace --test readers -- --nocapture`.
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

mod documents;
mod logs_of_kinds;
mod robots;
mod tables;

use std::path::Path;
use std::time::Instant;

use checks::round::{self, Counts};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// What an input of some kB may take at a time (bytes).
const MEMORY: u64 = 1 << 30;

/// Inputs of the long round.
const LONG: u64 = 200_000;

/// A reader and what it is tried on.
struct Reader {
    name: &'static str,
    /// The name of the file that it is given.
    file: &'static str,
    /// Inputs of the short round.
    short: u64,
    /// Puts files that inputs refer to into the folder, and gives good inputs.
    seeds: fn(&Path) -> Vec<Vec<u8>>,
    change: fn(&[u8], &mut ChaCha8Rng) -> Vec<u8>,
    read: fn(&Path) -> Result<(), String>,
}

fn readers() -> Vec<Reader> {
    let mut readers = logs_of_kinds::readers();
    readers.extend(robots::readers());
    readers.extend(documents::readers());
    readers.extend(tables::readers());
    readers
}

impl Reader {
    /// Counts, or what went wrong.
    fn round(&self, first: u64, inputs: u64) -> Result<Counts, String> {
        let folder = tempfile::tempdir().unwrap();
        let seeds = (self.seeds)(folder.path());
        let change = |random: &mut ChaCha8Rng| {
            let seed = &seeds[random.random_range(0..seeds.len())];
            (self.change)(seed, random)
        };
        let read = |path: &Path| {
            let mut result = Ok(());
            let taken = allocation_counter::measure(|| result = (self.read)(path));
            assert!(taken.bytes_max < MEMORY, "{} bytes at a time", taken.bytes_max);
            result
        };
        let file = folder.path().join(self.file);
        for (number, seed) in seeds.iter().enumerate() {
            std::fs::write(&file, seed).unwrap();
            assert_eq!(read(&file), Ok(()), "{}: good input {number}", self.name);
        }
        round::run(self.name, first..first + inputs, &file, change, read)
    }
}

/// Gives every reader as many inputs as it says, and prints what became of them as rows of a table.
fn try_all(first: u64, inputs: impl Fn(&Reader) -> u64 + Sync) {
    let readers = readers();
    let told = |reader: &Reader| {
        let start = Instant::now();
        let counts = reader.round(first, inputs(reader))?;
        let (read, refused) = (counts.read, counts.refused);
        println!(
            "| {} | {read} | {refused} | {:.1} s |",
            reader.name,
            start.elapsed().as_secs_f64()
        );
        // Where all pass or all are refused, the round tries too little.
        let few = (read + refused) / 50;
        if read > few && refused > few {
            Ok(())
        } else {
            Err(format!("{}: {counts:?}", reader.name))
        }
    };
    let defects: Vec<String> = readers.par_iter().filter_map(|r| told(r).err()).collect();
    assert!(defects.is_empty(), "{}", defects.join("\n"));
}

/// The short round, or the long one with fresh seeds.
#[test]
fn no_input_ends_or_stops_a_reader() {
    match round::fresh_seeds() {
        None => try_all(0, |reader| reader.short),
        Some(first) => {
            let each = LONG.div_ceil(readers().len() as u64);
            try_all(first, |_| each);
        }
    }
}
