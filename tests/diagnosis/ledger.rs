//! Hypotheses outside an answer: what refuses them is about that answer.

use std::path::Path;

use checks::arms::wam;
use checks::recorded::folder;
use diagnosis::{Diagnosis, Settings, Silent, diagnose};
use logs::{ReadOptions, Run, read_run};

use crate::world::{World, against_nominal, named, sign};

/// The effect that a reason says does the work of the one that is ruled out.
fn taker(because: &str) -> Option<&str> {
    let before = |words: &str| because.find(words).map(|end| &because[..end]);
    before(" takes its torque")
        .and_then(|words| words.rsplit(": ").next())
        .or_else(|| before(" changes the same numbers"))
        .or_else(|| before(" by ").and_then(|words| words.split("does worse than ").nth(1)))
}

/// Reasons that contradict an answer: those that name an effect which has no torque in it, and hypotheses that no rule
/// refuses.
fn contradictions(diagnosis: &Diagnosis) -> Vec<String> {
    let negligible = diagnosis.negligible.iter().map(|n| n.at.words());
    let mut there: Vec<String> = diagnosis.findings.iter().map(|f| f.at.words()).collect();
    there.extend(negligible);
    // What varies is there without a name, and so is what a joint would have that keeps its description.
    let is_nameless = |because: &str| {
        because.contains("would have to vary") || because.contains("keeps its description")
    };
    let nameless = diagnosis.ruled_out.iter().filter(|r| is_nameless(&r.because));
    there.extend(nameless.map(|r| r.at.words()));
    let contradicts = |because: &str| {
        because.contains("no rule refuses it")
            || taker(because).is_some_and(|taker| !there.iter().any(|words| words == taker))
    };
    let all = diagnosis.ruled_out.iter().filter(|r| contradicts(&r.because));
    all.map(|r| format!("{}: {}", r.at.words(), r.because)).collect()
}

fn runs(folder: &Path, names: &[&str]) -> Vec<Run> {
    let options = ReadOptions::default();
    let read = |name: &&str| read_run(&folder.join(format!("{name}.parquet")), &wam(), &options);
    names.iter().map(read).collect::<Result<_, _>>().unwrap()
}

#[test]
fn a_reason_names_the_effect_that_does_the_work() {
    let adds = "it adds 1.2 to the log evidence, 3 are needed: FR01 viscous friction at a takes its torque";
    assert_eq!(taker(adds), Some("FR01 viscous friction at a"));
    assert_eq!(
        taker("IN02 inertial parameters at a changes the same numbers"),
        Some("IN02 inertial parameters at a")
    );
    let twin = "about the robot that has it, it does worse than AC02 delay at a by 3.4 standard errors, 2 decide";
    assert_eq!(taker(twin), Some("AC02 delay at a"));
    assert_eq!(taker("these logs cannot show it"), None);
}

/// Friction at two joints, friction whose size varies, and an offset with a mass.
#[test]
fn no_reason_contradicts_the_answer_to_a_simulated_log() {
    let worlds = [
        World::nominal().torque(1, |[_, qd, _]| 1.5 * sign(qd)).torque(3, |[_, qd, _]| 0.6 * qd),
        World::nominal().torque(3, |[q, qd, _]| 0.6 * (1.0 + 1.5 * (2.0 * (q - 1.1)).sin()) * qd),
        World::nominal()
            .torque(0, |[_, _, qdd]| 0.08 * qdd)
            .reading(1, |effort| 1.1 * effort + 0.7),
    ];
    for (world, seed) in worlds.iter().zip(2400..) {
        let answer = against_nominal(&world.log(seed)).diagnosis;
        let wrong = contradictions(&answer);
        println!("{:?}", named(&answer));
        assert!(!answer.ruled_out.is_empty() && wrong.is_empty(), "{wrong:#?}");
    }
}

#[test]
fn no_reason_contradicts_the_answer_to_a_recorded_log() {
    let Some(folder) = folder() else { return };
    let runs = runs(&folder.join("barrett_wam"), &["shoulder_elbow_sweep"]);
    let answer = diagnose(&wam(), &runs, &Settings::default(), &Silent).unwrap().diagnosis;
    let wrong = contradictions(&answer);
    assert!(!answer.findings.is_empty() && wrong.is_empty(), "{wrong:#?}");
}

/// Drives of which all are 8 ms late, by another engine: one skew explains the logs, and nothing is left for other
/// causes. About the robot without it rotors, gains and bodies would enter.
#[test]
fn no_other_cause_does_the_work_where_one_skew_does_it_all() {
    let Some(folder) = folder() else { return };
    let folder = folder.join("mujoco_wam/actuator_delay");
    if !folder.is_dir() {
        return println!("skipped: no {}", folder.display());
    }
    let runs = runs(&folder, &["run_0", "run_1", "run_2", "run_3"]);
    let answer = diagnose(&wam(), &runs, &Settings::default(), &Silent).unwrap().diagnosis;
    let wrong = contradictions(&answer);
    assert_eq!(answer.findings.len(), 1, "{:?}", named(&answer));
    assert!(wrong.is_empty(), "{wrong:#?}");
    let may_be_described = |r: &&diagnosis::RuledOut| r.because.contains("may be the described");
    assert!(answer.ruled_out.iter().filter(may_be_described).count() >= 5);
}
