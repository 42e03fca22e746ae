//! Readers in this process, some 10^4 inputs a second: each input is a good one with a few mistakes, and every one is known
//! by its seed.

use std::any::Any;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::Duration;

use checks::arms::generator;
use checks::spliced::spliced;
use checks::watch::{ThreadClock, Watch};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use tempfile::TempDir;

use crate::targets::Reader;

/// An input that takes the processor for longer is slow.
const PATIENCE: Duration = Duration::from_secs(1);
/// Inputs that a thread takes at a time.
const PIECE: u64 = 256;
/// One in so many inputs is made by the reader's own mistakes, which pack and add up what they change.
const STRUCTURED: u32 = 24;

/// A reader with its folder in memory and its good inputs.
pub struct Target<'a> {
    reader: &'a Reader,
    folder: TempDir,
    /// Its good inputs.
    pub seeds: Vec<Vec<u8>>,
}

/// What became of the inputs of a reader.
#[derive(Debug, Default)]
pub struct Outcome {
    /// Inputs that were read.
    pub read: u64,
    /// Inputs that were refused in words.
    pub refused: u64,
    /// The slowest input: its time on the processor and its seed.
    pub slowest: (Duration, u64),
    /// Memory of the whole program at its peak (MB), where the system tells it.
    pub peak_mb: u64,
    /// Seeds of slow inputs, with their time on the processor.
    pub slow: Vec<String>,
    /// Seeds with what is wrong with what became of them.
    pub defects: Vec<String>,
}

impl<'a> Target<'a> {
    /// A folder of its own.
    pub fn new(reader: &'a Reader) -> Self {
        let memory = Path::new("/dev/shm");
        let folder =
            if memory.is_dir() { tempfile::tempdir_in(memory) } else { tempfile::tempdir() }
                .unwrap();
        let seeds = reader.parsed.unwrap_or(reader.seeds)(folder.path());
        Self { reader, folder, seeds }
    }

    fn file(&self) -> PathBuf {
        self.folder.path().join(self.reader.file)
    }

    /// The input of a seed.
    pub fn input(&self, seed: u64) -> Vec<u8> {
        let random: &mut ChaCha8Rng = &mut generator(seed);
        let good = &self.seeds[random.random_range(0..self.seeds.len())];
        if random.random_ratio(1, STRUCTURED) {
            (self.reader.change)(good, random)
        } else {
            spliced(good, &self.seeds, self.reader.words, random)
        }
    }

    /// Reads bytes as a file of the kind, as a target of `cargo fuzz` does.
    pub fn fuzz_target(&self, data: &[u8]) -> Result<(), String> {
        fs::write(self.file(), data).unwrap();
        (self.reader.parse)(&self.file())
    }

    /// Good inputs are read.
    fn check(&self) -> Result<(), String> {
        let of = |seed: &Vec<u8>| self.fuzz_target(seed);
        self.seeds.iter().try_for_each(of).map_err(|e| format!("{}: {e}", self.reader.name))
    }

    /// Reads the input of a seed.
    fn tried(&self, seed: u64, clock: &mut ThreadClock, outcome: &mut Outcome) {
        let input = self.input(seed);
        let start = clock.now();
        let ended = catch_unwind(AssertUnwindSafe(|| self.fuzz_target(&input)));
        let took = clock.now().zip(start).map_or(Duration::ZERO, |(end, start)| end - start);
        let name = self.reader.name;
        match ended {
            Ok(Ok(())) => outcome.read += 1,
            Ok(Err(_)) => outcome.refused += 1,
            Err(panic) => {
                outcome.defects.push(format!("{name}, seed {seed}: panic: {}", words(&*panic)));
            }
        }
        if took > PATIENCE {
            outcome.slow.push(format!("{name}, seed {seed}: {took:?}"));
        }
        outcome.slowest = outcome.slowest.max((took, seed));
    }
}

/// Reads the inputs of seeds on all processors.
pub fn fuzz(reader: &Reader, first: u64, inputs: u64) -> Outcome {
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let next = AtomicU64::new(first);
    let _ = fs::write("/proc/self/clear_refs", "5");
    let work = || {
        let mut outcome = Outcome::default();
        let target = Target::new(reader);
        let (watch, mut clock) = (Watch::start(reader.name), ThreadClock::of_this_thread());
        outcome.defects.extend(target.check().err());
        loop {
            let from = next.fetch_add(PIECE, Ordering::Relaxed);
            for seed in from..(from + PIECE).min(first + inputs) {
                watch.begin(seed);
                target.tried(seed, &mut clock, &mut outcome);
            }
            if from >= first + inputs {
                return outcome;
            }
        }
    };
    let all: Vec<thread::Result<Outcome>> = thread::scope(|scope| {
        let handles: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        handles.into_iter().map(thread::ScopedJoinHandle::join).collect()
    });
    let mut outcome = all.into_iter().map(Result::unwrap).reduce(Outcome::with).unwrap_or_default();
    outcome.peak_mb = peak_mb().unwrap_or_default();
    outcome
}

impl Outcome {
    fn with(mut self, other: Self) -> Self {
        self.read += other.read;
        self.refused += other.refused;
        self.slowest = self.slowest.max(other.slowest);
        self.slow.extend(other.slow);
        self.defects.extend(other.defects);
        self
    }
}

/// Most memory that the program has taken since it was asked to forget it (MB; `VmHWM` of proc(5)).
fn peak_mb() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024)
}

fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().cloned();
    text.or_else(|| panic.downcast_ref::<&str>().map(|&s| s.to_owned())).unwrap_or_default()
}
