//! Joints that are counted the other way round than their axes: position, velocity and effort with the other sign.

use inspection::{ObservationKind, correct, inspect};

use crate::arms_with_friction::{ARMS, arm, runs};

/// Joints and the largest friction with which their torque tells which way round they are counted: a wrist of a UR5e with
/// twice its friction hides 1 N m of gravity, and a flange that carries nothing is the same both ways round.
const JOINTS: [&[(usize, f64)]; 2] = [
    &[(1, 2.0), (2, 2.0), (3, 1.0), (4, 0.3)],
    &[(1, 2.0), (2, 2.0), (3, 2.0), (4, 2.0), (5, 2.0)],
];

/// Joint 2 of a Panda the other way round is joint 3 half a turn off: the same arm.
const TWO_WAYS: (&str, usize) = ("panda", 1);

#[test]
fn an_axis_that_is_turned_is_one_reading_at_any_friction() {
    for ((name, coulomb, viscous), joints) in ARMS.into_iter().zip(JOINTS) {
        let robot = arm(name);
        for (friction, seed) in [0.0, 0.3, 1.0, 2.0].into_iter().zip(700..) {
            let whole = runs(&robot, [coulomb, viscous], friction, seed);
            assert_eq!(inspect(&robot, &whole), [], "{name}, friction x {friction}");
            for &(j, most) in joints.iter().filter(|(_, most)| friction <= *most) {
                let mut logged = whole.clone();
                for run in &mut logged {
                    let joint = &mut run.joints[j];
                    let signals = [Some(&mut joint.position), Some(&mut joint.effort)];
                    let signals = signals.into_iter().chain([joint.velocity.as_mut()]).flatten();
                    signals.flatten().for_each(|x| *x = -*x);
                }
                let told = inspect(&robot, &logged);
                let of = format!("{name}, joint {j}, friction x {friction} of {most}: {told:?}");
                assert!(told.len() == 1 && told[0].kind == ObservationKind::AxisSign, "{of}");
                assert_eq!(told[0].joints, [j], "{of}");
                let read = correct(&robot, &logged);
                if (name, j) == TWO_WAYS {
                    let half = |kind| matches!(kind, ObservationKind::PositionOffset { .. });
                    let other = &told[0].or[..];
                    assert!(other.len() == 1 && half(other[0].kind), "{of}");
                    assert_eq!((other[0].joints.as_slice(), read.runs), (&[2][..], None), "{of}");
                } else {
                    assert_eq!(read.runs.unwrap(), whole, "{of}");
                }
            }
        }
    }
}
