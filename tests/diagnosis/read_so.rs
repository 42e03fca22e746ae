//! Logs that are wrong as a whole, and that only one reading puts right.

use diagnosis::Verdict;
use logs::Run;

use crate::world::{World, against_nominal, named, sign};

/// A WAM with dry friction at its elbow and viscous friction at its shoulder.
fn rubbing() -> Vec<Run> {
    let dry = |[_, qd, _]: [f64; 3]| 1.5 * sign(qd);
    let viscous = |[_, qd, _]: [f64; 3]| 2.0 * qd;
    World::nominal().torque(3, dry).torque(1, viscous).log(7)
}

/// What is wrong with a run.
type Fault = fn(&mut Run);

fn scale(signal: &mut [f64], by: f64) {
    signal.iter_mut().for_each(|x| *x *= by);
}

/// What is named is what the logs name as they should be, and the answer stays open: only who recorded them
/// knows how they are to be read.
#[test]
fn logs_that_one_reading_puts_right_name_what_they_would_name() {
    let right = against_nominal(&rubbing());
    assert!(right.read.is_none());
    assert_eq!(right.diagnosis.verdict, Verdict::Explained);
    let spoil: [(&str, Fault); 4] = [
        ("disagree on what a second is", |run| scale(&mut run.time, 1e3)),
        ("other sign", |run| scale(&mut run.joints[1].effort, -1.0)),
        ("another unit", |run| run.joints.iter_mut().for_each(|j| scale(&mut j.effort, 1e3))),
        ("exchanged", |run| {
            let effort = run.joints[1].effort.clone();
            run.joints[1].effort = std::mem::replace(&mut run.joints[3].effort, effort);
        }),
    ];
    for (what, spoil) in spoil {
        let mut runs = rubbing();
        runs.iter_mut().for_each(spoil);
        let answer = against_nominal(&runs);
        let warnings = &answer.diagnosis.warnings;
        let told = |w: &String| w.contains(what) && w.ends_with("Until then the logs are read so.");
        assert!(warnings.iter().any(told), "{what}: {warnings:?}");
        assert_eq!(named(&answer.diagnosis), named(&right.diagnosis), "{what}");
        assert_eq!(answer.diagnosis.verdict, Verdict::PartlyExplained, "{what}");
        let read = answer.read.expect(what);
        let apart = |(a, b): (&f64, &f64)| (a - b).abs();
        let efforts = |j: usize| {
            let read = read.iter().flat_map(|run| &run.joints[j].effort).copied();
            let right = rubbing();
            let right: Vec<f64> =
                right.iter().flat_map(|run| run.joints[j].effort.clone()).collect();
            (read.collect::<Vec<f64>>(), right)
        };
        for j in 0..7 {
            let (read, right) = efforts(j);
            let most = read.iter().zip(&right).map(apart).fold(0.0, f64::max);
            assert!(most < 1e-9, "{what}: {most} N m at joint {j}");
        }
    }
}

/// A clock that is off by a factor that is no unit may be off for other reasons: no cause is sought.
#[test]
fn a_clock_that_is_off_by_no_unit_is_not_put_right() {
    let mut runs = rubbing();
    runs.iter_mut().for_each(|run| scale(&mut run.time, 1.3));
    let answer = against_nominal(&runs);
    assert!(answer.read.is_none());
    assert_eq!(answer.diagnosis.verdict, Verdict::DataInadequate);
}
