//! What was put into a simulation is for scoring alone: only what writes it, what tells people
//! where it lies and what scores by it names its file.

use crate::assert_kept;
use crate::tree::{rust_files, text};

/// The file.
const SEALED: &str = "truth.json";

/// Sources that may name it: folders, and files of the program.
const KEEPERS: [&str; 6] = [
    "crates/simulator/",
    "crates/experiment/src/scoring/blinded.rs",
    "crates/bench_cli/src/commands/export.rs",
    "crates/benchmark/src/trials/",
    "crates/cli/src/help_texts.rs",
    "crates/cli/src/commands/simulate.rs",
];

fn broken(file: &str, source: &str) -> Option<String> {
    let keeps = KEEPERS.iter().any(|keeper| file.starts_with(keeper));
    (!keeps && source.contains(SEALED)).then(|| format!("{file} names {SEALED}"))
}

#[test]
fn nothing_that_explains_a_log_names_the_sealed_truth() {
    let files = rust_files("crates");
    assert_kept(&files.iter().filter_map(|file| broken(file, &text(file))).collect::<Vec<_>>());
    for keeper in KEEPERS {
        let named = |file: &&String| file.starts_with(keeper) && text(file).contains(SEALED);
        assert!(files.iter().any(|file| named(&file)), "{keeper} has nothing to keep");
    }
}

#[test]
fn a_diagnosis_that_names_the_sealed_truth_is_reported() {
    let source = format!("let path = folder.join(\"{SEALED}\");");
    let files = [
        "crates/diagnosis/src/diagnose.rs",
        "crates/logs/src/read.rs",
        "crates/cli/src/commands/diagnose.rs",
        "crates/experiment/src/models/learned.rs",
    ];
    for file in files {
        assert_eq!(broken(file, &source), Some(format!("{file} names {SEALED}")));
        assert_eq!(broken(file, "let path = folder.join(\"run_1.parquet\");"), None);
    }
    assert_eq!(broken("crates/benchmark/src/trials/trial.rs", &source), None);
}
