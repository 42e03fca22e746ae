//! Every reader is given inputs that a few mistakes turned into others: no panic, an end, less than
//! 1 GiB, and a refusal that names a file.
//!
//! The short round is the same every time. The long one takes fresh seeds:
//! `PLUMBLINE_LONG=1 cargo test --release --workspace --test readers -- --nocapture`.
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

mod fuzz;
mod targets;

use std::path::Path;
use std::time::Instant;

use checks::round::{self, Counts};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::targets::{Reader, readers};

/// What an input of some kB may take at a time (bytes).
const MEMORY: u64 = 1 << 30;

/// Inputs of the long round.
const LONG: u64 = 200_000;

/// What a round makes of a reader.
trait Round {
    fn round(&self, first: u64, inputs: u64) -> Result<Counts, String>;
}

impl Round for Reader {
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
    let mut readers = readers();
    readers.retain(|reader| reader.short > 0);
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

/// Inputs of each reader in the short round.
const FUZZED: u64 = 1000;

/// The short round of `cargo run --release -p checks --example fuzz`.
#[test]
fn no_spliced_input_ends_a_reader() {
    for reader in readers() {
        let outcome = fuzz::fuzz(&reader, 0, FUZZED);
        assert_eq!(outcome.defects, Vec::<String>::new());
        assert_eq!(outcome.read + outcome.refused, FUZZED, "{}", reader.name);
        assert!(outcome.peak_mb * 1_000_000 < 2 * MEMORY, "{}: {outcome:?}", reader.name);
        let slowest = outcome.slowest.0.as_millis();
        println!("| {} | {} | {} | {slowest} ms |", reader.name, outcome.read, outcome.refused);
    }
}
