//! Efforts that lack gravity, of arms with friction.

use dynamics::Dynamics;
use inspection::{ObservationKind, correct, inspect};
use logs::Run;
use robot::Robot;

use crate::arms_with_friction::{ARMS, arm, runs};

fn take_gravity_off(robot: &Robot, runs: &mut [Run]) {
    let dynamics = Dynamics::new(robot);
    let still = vec![0.0; robot.joint_count()];
    for run in runs {
        for t in 0..run.time.len() {
            let q: Vec<f64> = run.joints.iter().map(|joint| joint.position[t]).collect();
            let held = dynamics.inverse_dynamics(&q, &still, &still).unwrap();
            run.joints
                .iter_mut()
                .zip(held.iter())
                .for_each(|(joint, held)| joint.effort[t] -= held);
        }
    }
}

/// It is told and read so, and of whole efforts nothing is told: with no friction, a third, all and twice of it.
#[test]
fn efforts_without_gravity_are_told_and_read_so_whatever_the_friction() {
    for (name, coulomb, viscous) in ARMS {
        let robot = arm(name);
        for (friction, seed) in
            [0.0, 0.3, 1.0, 2.0].into_iter().flat_map(|f| (0..5).map(move |s| (f, s)))
        {
            let whole = runs(&robot, [coulomb, viscous], friction, 300 + seed);
            let of = format!("{name}, friction x {friction}, seed {seed}");
            assert_eq!(inspect(&robot, &whole), [], "{of}: whole efforts");
            let mut without = whole.clone();
            take_gravity_off(&robot, &mut without);
            let read = correct(&robot, &without);
            let told: Vec<ObservationKind> = read.mended.iter().map(|o| o.kind).collect();
            assert_eq!(told, [ObservationKind::EffortWithoutGravity], "{of}: {:?}", read.left);
            let read = read.runs.unwrap();
            let apart = |(a, b): (&Run, &Run)| -> f64 {
                let joints = a.joints.iter().zip(&b.joints);
                let efforts = joints.flat_map(|(a, b)| a.effort.iter().zip(&b.effort));
                efforts.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            assert!(read.iter().zip(&whole).map(apart).fold(0.0, f64::max) < 1e-3, "{of}");
        }
    }
}
