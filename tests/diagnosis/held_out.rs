//! The parts of the logs that a diagnosis holds out in turn, and the robots found without them.

use checks::synthetic::Noise;
use diagnosis::{Diagnosis, DiagnosisRun, HeldOutPart, Settings, Silent, Verdict, diagnose};
use logs::Run;

use crate::grafts;
use crate::world::{World, named, sign};

fn diagnosed(runs: &[Run]) -> DiagnosisRun {
    diagnose(&World::nominal().robot, runs, &Settings::default(), &Silent).unwrap()
}

#[test]
fn the_parts_are_held_out_in_turn_and_their_robots_know_nothing_of_them() {
    let world = World::nominal().torque(3, |[_, qd, _]| 0.5 * sign(qd));
    let runs = world.log(7000);
    let outcome = diagnosed(&runs);
    let tested: Vec<Vec<usize>> =
        outcome.held_out.iter().map(|p| p.test.iter().map(|s| s.run).collect()).collect();
    assert_eq!(tested, [[0], [1], [2]]);
    for (k, part) in outcome.held_out.iter().enumerate() {
        let trained: Vec<usize> = part.train.iter().map(|s| s.run).collect();
        assert_eq!(trained, (0..3).filter(|r| *r != k).collect::<Vec<_>>());
        let run = &outcome.prepared.runs[k];
        let [from, to] = part.test[0].time_s;
        assert!(from <= run.time[0] && run.time[run.time.len() - 1] < to + 0.1, "{from} to {to}");
    }
    // Another first run: what is found without it stays, what is found with it does not.
    let mut changed = runs.clone();
    changed[0].joints[3].effort.iter_mut().for_each(|e| *e *= 1.05);
    let other = diagnosed(&changed);
    let levels = |outcome: &DiagnosisRun| -> Vec<f64> {
        let level = |p: &HeldOutPart| p.extended.links()[3].actuator.coulomb_forward;
        outcome.held_out.iter().map(level).collect()
    };
    let (before, after) = (levels(&outcome), levels(&other));
    println!("{before:?} and {after:?}");
    assert!(before.iter().all(|level| (level - 0.5).abs() < 0.05));
    let moved: Vec<f64> = before.iter().zip(&after).map(|(a, b)| (a - b).abs()).collect();
    // The priors are as wide as all efforts are large, hence the rest.
    assert!(moved[0] < 1e-6 && moved[1] > 1e-3 && moved[2] > 1e-3, "{moved:?}");
}

#[test]
fn one_run_is_held_out_part_by_part_with_a_gap() {
    let world = World::nominal();
    let runs = world.runs(1, 40.0, &Noise::of_a_wam(), 7010);
    let parts = diagnosed(&runs).held_out;
    assert_eq!(parts.len(), 5);
    for part in &parts {
        let [test] = part.test.as_slice() else { panic!("{:?}", part.test) };
        for train in &part.train {
            let apart = (test.time_s[0] - train.time_s[1]).max(train.time_s[0] - test.time_s[1]);
            assert!(apart > 0.5, "{test:?} {train:?}");
        }
    }
    let covered: f64 = parts.iter().flat_map(|p| &p.test).map(|s| s.time_s[1] - s.time_s[0]).sum();
    assert!((37.0..40.5).contains(&covered), "{covered}");
}

/// Efforts a tenth of a second late: their rate times that is much more, and less, than what they
/// lack. Every run is predicted by what the others say, and by the robot that has it.
#[test]
fn what_is_late_by_a_tenth_of_a_second_is_explained_wholly() {
    let mut runs = World::nominal().log(7200);
    let late_s = grafts::shift(&mut runs, 0.1);
    let outcome = diagnosed(&runs);
    let Diagnosis { findings, gain, verdict, .. } = &outcome.diagnosis;
    let [finding] = findings.as_slice() else { panic!("{:?}", named(&outcome.diagnosis)) };
    let found = finding.parameters.iter().find(|p| p.name == "skew").unwrap();
    assert!((found.value - late_s).abs() < 1e-3, "{} s for {late_s} s", found.value);
    assert!(finding.share_explained > 0.99, "{}", finding.share_explained);
    assert_eq!(*verdict, Verdict::Explained);
    let of_joints = gain.inverse.rms_before_nm.iter().zip(&gain.inverse.rms_after_nm);
    // The effort of the palm is noise.
    for (joint, (before, after)) in of_joints.enumerate().take(6) {
        assert!(*after < 0.1 * before, "{after} of {before} N m at joint {joint}");
    }
}
