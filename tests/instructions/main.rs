//! Instructions of the hot loops, counted by valgrind and held to 2 % of the figures in `loops.rs`, so that a loop that no
//! longer fits the registers or is no longer inlined fails on a busy machine too.
//!
//! ```text
//! cargo test --release -p checks --test instructions -- --nocapture
//! ```
//!
//! prints every count beside its figure. The figures are those of one compiler in `release` on x86-64 with AVX2 (valgrind
//! knows no AVX-512), and the test skips, saying so, elsewhere and where there is no valgrind.
#![allow(clippy::unwrap_used, reason = "a broken fixture should stop the test")]

mod loops;

use std::process::Command;

use loops::{LOOPS, Loop};

/// The compiler of the figures in `loops.rs`, as it names itself in what it builds.
const COMPILER: &str = "rustc version 1.95.0 ";

/// Largest difference of a count from its figure, as a share of the figure.
const TOLERANCE: f64 = 0.02;

/// Says which loop [`counted`] runs, and how many rounds of it: `inverse_dynamics 200`.
const ASKED: &str = "PLUMBLINE_COUNTED";

#[test]
fn no_hot_loop_takes_more_instructions_than_its_figure_says_or_fewer() {
    if let Some(reason) = skipped() {
        println!("skipped: {reason}");
        return;
    }
    let counts: Vec<f64> = LOOPS.iter().map(per_unit).collect();
    let lines = LOOPS.iter().zip(&counts).map(|(l, count)| {
        let share = count / l.figure - 1.0;
        let line = format!(
            "{}: {count:.0} instructions a {}, {:+.1} % of the figure {}",
            l.name,
            l.unit,
            1e2 * share,
            l.figure
        );
        println!("{line}");
        (share, line)
    });
    let off: Vec<String> =
        lines.filter(|(share, _)| share.abs() > TOLERANCE).map(|(_, line)| line).collect();
    assert!(off.is_empty(), "\n{}\n", off.join("\n"));
}

/// What the test above has valgrind count; alone it does nothing.
#[test]
fn counted() {
    let Some(asked) = std::env::var_os(ASKED) else { return };
    let asked = asked.into_string().unwrap();
    let (name, rounds) = asked.split_once(' ').unwrap();
    let l = LOOPS.iter().find(|l| l.name == name).unwrap();
    let mut round = (l.prepare)();
    (0..rounds.parse().unwrap()).for_each(|_| round());
}

/// The reason for which nothing can be held here.
fn skipped() -> Option<String> {
    if cfg!(debug_assertions) {
        return Some("the figures are those of --release".to_owned());
    }
    #[cfg(target_arch = "x86_64")]
    let vectors =
        std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma");
    #[cfg(not(target_arch = "x86_64"))]
    let vectors = false;
    if !vectors {
        return Some("the figures are those of x86-64 with AVX2 and FMA".to_owned());
    }
    let own = std::fs::read(std::env::current_exe().unwrap()).unwrap();
    if !own.windows(COMPILER.len()).any(|bytes| bytes == COMPILER.as_bytes()) {
        return Some(format!("the figures are those of {COMPILER}"));
    }
    match Command::new("valgrind").arg("--version").output() {
        Ok(answer) if answer.status.success() => None,
        _ => Some("there is no valgrind here: apt-get install valgrind".to_owned()),
    }
}

/// Instructions of a unit of work: the difference of two counts, in which all that prepares the loop is the same.
fn per_unit(l: &Loop) -> f64 {
    let [few, many] = std::thread::scope(|scope| {
        let counts = [l.rounds, 2 * l.rounds].map(|rounds| scope.spawn(move || count(l, rounds)));
        counts.map(|count| count.join().unwrap())
    });
    (many - few) / (l.rounds * l.units) as f64
}

/// Instructions of a process that runs so many rounds.
fn count(l: &Loop, rounds: usize) -> f64 {
    let answer = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", "counted", "--test-threads=1"])
        .env(ASKED, format!("{} {rounds}", l.name))
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&answer.stderr);
    let collected = said.lines().find_map(|line| line.split_once("Collected :"));
    assert!(answer.status.success() && collected.is_some(), "{}: {said}", l.name);
    collected.unwrap().1.trim().parse().unwrap()
}
