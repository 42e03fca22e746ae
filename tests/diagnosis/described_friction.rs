//! Friction that a description has and the arm has not: many descriptions state damping and friction for the sake of a
//! simulation.

use checks::synthetic::Noise;
use diagnosis::{Settings, Silent, Verdict, diagnose};

use crate::world::{World, finding, named, sign};

/// The palm of the WAM.
const PALM: usize = 6;

/// A palm with .03 N m of dry friction and .005 N m s/rad of damping, described with 1 and .1, in two fast runs and two that are
/// near rest for much of their time. How far the law of the described friction may err there follows from what is left of it:
/// by all of it nothing small would be found.
#[test]
fn described_friction_that_is_not_there_hides_nothing() {
    let world = World::nominal().torque(PALM, |[_, qd, _]| 0.03 * sign(qd) + 0.005 * qd);
    let mut described = world.robot.clone();
    let drive = &mut described.link_mut(PALM).unwrap().actuator;
    (drive.coulomb_forward, drive.coulomb_backward, drive.viscous) = (1.0, 1.0, 0.1);
    for seed in [3200, 3201] {
        let runs = world.paced(&[1.0, 1.0, 0.1, 0.1], 16.0, &Noise::of_a_wam(), seed);
        let answer = diagnose(&described, &runs, &Settings::default(), &Silent).unwrap().diagnosis;
        let size = |words: &str| {
            let found = finding(&answer, words).unwrap_or_else(|| panic!("{:?}", named(&answer)));
            (found.parameters[0].value, found.parameters[0].ci95)
        };
        let holds = |(value, [low, high]): (f64, [f64; 2]), truth: f64| {
            assert!(
                low <= truth && truth <= high && high - low < truth,
                "{value} ({low} to {high})"
            );
        };
        holds(size("FR02 Coulomb friction at j7_palm_yaw"), 0.03);
        holds(size("FR01 viscous friction at j7_palm_yaw"), 0.005);
        assert_eq!(answer.joints[PALM].verdict, Verdict::Explained);
    }
}
