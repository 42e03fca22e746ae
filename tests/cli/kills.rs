//! Commands that are killed at any moment, some several times in a row: once the next one has come to its end, the folder
//! holds what it holds where nothing disturbs, and nothing else.
//!
//! The long form: `PLUMBLINE_LONG=1 cargo test --release --workspace --test cli kills -- --nocapture`, and
//! `--test bench_cli`. `PLUMBLINE_COMMANDS=learn,export` kills those commands alone, which begin so.

use std::process::Stdio;
use std::thread::sleep;
use std::time::Instant;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::program::{PROGRAM, run};
use crate::undisturbed::Undisturbed;
use crate::writers::{KILLS, WALKED};

/// Kills a command so many times that it has not come to its end before, and lets it come there after one in two.
fn kill(command: &'static str, kills: usize, seed: u64) {
    let start = Instant::now();
    let undisturbed = Undisturbed::new(command);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (mut killed, mut ended, mut in_a_row) = (0, 0, 0);
    undisturbed.prepare();
    while killed < kills || in_a_row > 0 {
        let mut child = checks::program::command(PROGRAM)
            .current_dir(undisturbed.path())
            .args(undisturbed.words())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        sleep(undisturbed.took.mul_f64(random.random_range(0.0..1.0)));
        child.kill().unwrap();
        if child.wait().unwrap().code().is_none() {
            killed += 1;
            in_a_row += 1;
        }
        if random.random_ratio(1, 2) {
            let answer = run(undisturbed.path(), &undisturbed.words());
            let after = format!("{in_a_row} kills, {killed} in all, seed {seed}");
            assert_eq!(answer.code, undisturbed.code, "{command}, {after}: {}", answer.err);
            undisturbed.assert_same(&after);
            ended += 1;
            in_a_row = 0;
            undisturbed.prepare();
        }
    }
    println!("| `{command}` | {killed} | {ended} | {:.0} |", start.elapsed().as_secs_f64());
}

#[test]
fn what_a_killed_command_leaves_is_gone_after_the_next() {
    let (seed, kills) = match checks::round::fresh_seeds() {
        None => (1, 3),
        Some(seed) => (seed, KILLS),
    };
    let only = std::env::var("PLUMBLINE_COMMANDS").unwrap_or_default();
    let is_meant = |command: &&&str| only.split(',').any(|word| command.starts_with(word));
    // Workers of its own: another test's may end by a panic.
    let workers = rayon::ThreadPoolBuilder::new().build().unwrap();
    let all: Vec<&&str> = WALKED.iter().filter(is_meant).collect();
    workers.install(|| all.par_iter().for_each(|command| kill(command, kills, seed)));
}
