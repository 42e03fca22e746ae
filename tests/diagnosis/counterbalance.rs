//! A counterbalance that is of another strength than the robot says.

use catalogue::EffectKind;
use checks::arms::wam;
use diagnosis::{Diagnosis, Verdict};
use robot::{CounterbalanceTerm, Robot};

use crate::blind::{diagnosed, read, simulate};

const AT: &str = "j4_elbow_pitch";
const PHASE: f64 = 0.4;

/// The WAM with a counterbalance at its elbow (N·m).
fn described(amplitude: f64) -> Robot {
    let mut robot = wam();
    let elbow = robot.joint_index(AT).unwrap();
    let balance = CounterbalanceTerm { amplitude, phase: PHASE };
    robot.link_mut(elbow).unwrap().actuator.counterbalance = Some(balance);
    robot
}

/// Of 5 N·m where 3 are described, and where 5 are.
#[test]
fn blind_a_counterbalance_of_another_strength_is_named_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let effect =
        "effect=[{ counterbalance={ joint='j4_elbow_pitch', amplitude_nm=5.0, phase_rad=0.4 } }]";
    simulate(folder.path(), &["seed=6", effect]);
    let runs = read(folder.path());
    let stronger = diagnosed(&described(3.0), &runs).diagnosis;
    let [found] = &stronger.findings[..] else { panic!("{:?}", stronger.findings) };
    assert_eq!(
        (found.at.effect, found.at.joint.as_deref()),
        (EffectKind::Counterbalance, Some(AT))
    );
    for (estimate, truth) in found.parameters.iter().zip([5.0, PHASE]) {
        assert!((estimate.value - truth).abs() < 0.02, "{estimate:?}, not {truth}");
        let [low, high] = estimate.noise95;
        assert!((low..=high).contains(&truth), "{estimate:?}, not {truth}");
    }
    let verdict = |of: &Diagnosis| of.joints.iter().find(|j| j.name == AT).unwrap().verdict;
    assert_eq!(verdict(&stronger), Verdict::Explained, "{:?}", stronger.joints);
    let right = diagnosed(&described(5.0), &runs).diagnosis;
    assert_eq!(right.findings, []);
    assert_eq!(verdict(&right), Verdict::Consistent, "{:?}", right.joints);
}
