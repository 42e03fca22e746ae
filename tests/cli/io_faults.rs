//! Every call to the disk is refused once: a write that is refused ends the command with 2 and the name of the file, one
//! that is interrupted or cut short changes nothing, and nothing is half-written under its name.
//!
//! The long form: `PLUMBLINE_LONG=1 cargo test --release --workspace --test cli io_faults -- --nocapture`, and
//! `--test bench_cli`.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::disk::{Call, Disk, Fault};
use crate::program::Answer;
use crate::undisturbed::Undisturbed;
use crate::writers::{FURTHER, ONCE, SLOW, WALKED};

/// Faults of each command in the short round.
const SHORT: usize = 10;

/// Commands that take longer have one fault a call in the long round, one after the other of those that it can have.
const QUICK: Duration = Duration::from_millis(600);

/// Those that take longer than this have faults of so many calls.
const PATIENCE: Duration = Duration::from_secs(5);
const CALLS_OF_SLOW: usize = 60;

/// How many faults are tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Round {
    Short,
    Long,
}

/// Calls of each operation that a command makes, and faults that were tried.
#[derive(Debug, Default)]
struct Counts {
    calls: BTreeMap<String, usize>,
    refused: usize,
    went_on: usize,
}

/// Refuses calls of a command.
fn walk(disk: &Disk, command: &'static str, round: Round) -> Counts {
    let undisturbed = Undisturbed::new(command);
    undisturbed.prepare();
    let (answer, calls) = disk.run(undisturbed.path(), &undisturbed.words(), None);
    assert_eq!(answer.code, undisturbed.code, "{command}: {}", answer.err);
    let mut counts = Counts::default();
    for call in &calls {
        *counts.calls.entry(call.operation.clone()).or_default() += 1;
    }
    for (place, (call, fault)) in chosen(&calls, undisturbed.took, round).into_iter().enumerate() {
        let is_started_again = place % 4 == 0 || (round == Round::Long && undisturbed.took < QUICK);
        let went_on = match try_fault(disk, &undisturbed, (call, fault)) {
            Some(code) => code <= 1,
            None => continue,
        };
        *(if went_on { &mut counts.went_on } else { &mut counts.refused }) += 1;
        if is_started_again && !(went_on && ONCE.contains(&command)) {
            undisturbed.assert_same_again(&format!("{} {fault:?}", call.operation));
        }
    }
    counts
}

/// The faults of a round: all of a quick command in the long round, else one a call, or of some calls.
fn chosen(calls: &[Call], took: Duration, round: Round) -> Vec<(&Call, Fault)> {
    if round == Round::Long && took < QUICK {
        let all = |call| Call::faults(call).iter().map(move |fault| (call, *fault));
        return calls.iter().flat_map(all).collect();
    }
    let can_fail = calls.iter().filter(|call| !call.faults().is_empty());
    let each: Vec<(&Call, Fault)> = can_fail
        .enumerate()
        .map(|(place, call)| (call, call.faults()[place % call.faults().len()]))
        .collect();
    let most = match (round, took < PATIENCE) {
        (Round::Long, true) => each.len(),
        (Round::Long, false) => CALLS_OF_SLOW,
        (Round::Short, _) => SHORT,
    };
    let step = each.len().div_ceil(most).max(1);
    each.into_iter().skip(step / 2).step_by(step).collect()
}

/// Runs a command with a fault and looks at what it says and leaves. Returns its exit code, or nothing where it did not
/// come to the call.
fn try_fault(disk: &Disk, undisturbed: &Undisturbed, (call, fault): (&Call, Fault)) -> Option<i32> {
    undisturbed.prepare();
    let words = undisturbed.words();
    let (answer, calls) = disk.run(undisturbed.path(), &words, Some((call.number, fault)));
    // Threads may come in another order, so that a call is refused which cannot fail like this.
    let met = calls.iter().find(|call| call.is_refused)?;
    if !met.faults().contains(&fault) {
        return None;
    }
    let what = format!("call {}, {} {}, {fault:?}", met.number, met.operation, met.path.display());
    let about = format!("{}: {what}: exit {}, {}", undisturbed.command, answer.code, answer.err);
    assert!(expected(met, fault, undisturbed.code).contains(&answer.code), "{about}");
    if answer.code == undisturbed.code {
        undisturbed.assert_same(&what);
    } else {
        assert_one_error(&answer, met, &about);
        undisturbed.assert_nothing_half(&what);
    }
    Some(answer.code)
}

/// The exit codes that a fault may end in.
fn expected(call: &Call, fault: Fault, undisturbed: i32) -> Vec<i32> {
    match (call.operation.as_str(), fault) {
        (_, Fault::Interrupted | Fault::Short) | ("close", _) => vec![undisturbed],
        ("read" | "look", _) => vec![undisturbed, 2, 3],
        // What a killed run has left and cannot be removed hinders nobody.
        ("remove", _) => vec![undisturbed, 2],
        _ => vec![2],
    }
}

/// One error, which names the file or one in the same folder that it becomes.
fn assert_one_error(answer: &Answer, call: &Call, about: &str) {
    let errors: Vec<&str> = answer.err.lines().filter(|line| line.starts_with("error: ")).collect();
    assert_eq!(errors.len(), 1, "{about}");
    let name = call.path.file_name().unwrap().to_string_lossy().into_owned();
    let is_in_out = call.path.components().any(|part| part.as_os_str() == "out");
    let names = answer.err.contains(&name) || (is_in_out && errors[0].starts_with("error: out/"));
    assert!(names && !answer.err.contains(".plumbline-"), "{about}");
}

#[test]
fn a_disk_that_refuses_a_call_ends_a_command_with_2_and_leaves_nothing_half_written() {
    let Some(disk) = Disk::build() else {
        println!("skipped: there is no compiler cc");
        return;
    };
    let is_long = checks::round::fresh_seeds().is_some();
    let round = if is_long { Round::Long } else { Round::Short };
    let told = |command: &&'static str| {
        let start = Instant::now();
        let counts = walk(&disk, command, round);
        let calls: usize = counts.calls.values().sum();
        let Counts { refused, went_on, .. } = counts;
        let seconds = start.elapsed().as_secs_f64();
        println!("| `{command}` | {calls} | {refused} | {went_on} | {seconds:.0} |");
        assert!(refused > 0, "{command}: {counts:?}");
    };
    let slow = if is_long { &SLOW[..] } else { &[] };
    WALKED.par_iter().chain(&FURTHER).chain(slow).for_each(told);
}
