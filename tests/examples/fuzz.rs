//! Reads so many inputs with every reader of files, or with those that are named, and prints what became of them.
//!
//! ```sh
//! cargo run --release -p checks --example fuzz -- 1000000 0          # inputs a reader, from seed 0
//! cargo run --release -p checks --example fuzz -- 1 4711 CSV         # the input of seed 4711 again
//! cargo run --release -p checks --example fuzz -- --corpus out CSV   # inputs to begin with, for cargo fuzz
//! ```
#![allow(clippy::unwrap_used, reason = "a command for those who work on the readers")]

#[path = "../readers/fuzz.rs"]
mod fuzz;
#[path = "../readers/targets.rs"]
#[allow(dead_code, reason = "the tests have rounds of their own")]
mod targets;

use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [how, from, names @ ..] = &arguments[..] else {
        eprintln!("error: say how many inputs a reader, and from which seed: 1000000 0");
        return ExitCode::from(2);
    };
    let mut readers = targets::readers();
    readers.retain(|reader| names.is_empty() || names.iter().any(|name| name == reader.name));
    if how == "--corpus" {
        readers.iter().for_each(|reader| write_corpus(reader, Path::new(from)));
        return ExitCode::SUCCESS;
    }
    let (Ok(inputs), Ok(first)) = (how.parse(), from.parse()) else {
        eprintln!("error: {how} {from}: two numbers were expected");
        return ExitCode::from(2);
    };
    // A panic is told with its seed.
    std::panic::set_hook(Box::new(|_| {}));
    let mut defects = Vec::new();
    println!("| reader | read | refused | time (s) | slowest (ms), its seed | peak (MB) |");
    println!("|---|---|---|---|---|---|");
    for reader in &readers {
        let start = Instant::now();
        let outcome = fuzz::fuzz(reader, first, inputs);
        let (read, refused, peak) = (outcome.read, outcome.refused, outcome.peak_mb);
        let (slowest, seed) = (outcome.slowest.0.as_millis(), outcome.slowest.1);
        let time = start.elapsed().as_secs_f64();
        println!(
            "| {} | {read} | {refused} | {time:.1} | {slowest}, {seed} | {peak} |",
            reader.name
        );
        defects.extend(outcome.defects);
        defects.extend(outcome.slow);
    }
    defects.iter().for_each(|defect| eprintln!("{defect}"));
    if defects.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Good inputs of a reader, and some with mistakes, a file each.
fn write_corpus(reader: &targets::Reader, folder: &Path) {
    let target = fuzz::Target::new(reader);
    let folder = folder.join(reader.name.replace(' ', "_"));
    std::fs::create_dir_all(&folder).unwrap();
    for (number, good) in target.seeds.iter().enumerate() {
        std::fs::write(folder.join(format!("good_{number}")), good).unwrap();
    }
    for seed in 0..100 {
        std::fs::write(folder.join(format!("seed_{seed}")), target.input(seed)).unwrap();
    }
}
