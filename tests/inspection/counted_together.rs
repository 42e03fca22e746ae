//! The elbow of a UR5e counted to the horizontal, as by controllers whose bars drive the forearm from the base.

use inspection::{ObservationKind, correct, inspect};
use logs::Run;

use crate::arms_with_friction::{ARMS, arm, runs};

const SHOULDER: usize = 1;
const ELBOW: usize = 2;

/// Adds `factor` times one signal to another.
fn add(to: &mut [f64], from: &[f64], factor: f64) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to += factor * from);
}

/// Logs of a joint that is counted together with the one before it; by virtual work a drive that does not carry that of the
/// joint has `tau_before - sign tau`.
fn counted(run: &mut Run, (sign, is_driven): (f64, bool)) {
    let before = run.joints[SHOULDER].clone();
    let own = &mut run.joints[ELBOW];
    add(&mut own.position, &before.position, sign);
    if let (Some(own), Some(before)) = (&mut own.velocity, &before.velocity) {
        add(own, before, sign);
    }
    if is_driven {
        let effort = run.joints[ELBOW].effort.clone();
        add(&mut run.joints[SHOULDER].effort, &effort, -sign);
    }
}

#[test]
fn a_joint_counted_to_the_horizontal_is_told_and_read_so() {
    let (name, coulomb, viscous) = ARMS[0];
    let robot = arm(name);
    let cases = [0.0, 0.3, 1.0, 2.0].into_iter().flat_map(|f| (0..5).map(move |s| (f, s)));
    let ways = [(1.0, false), (-1.0, false), (1.0, true), (-1.0, true)];
    let logs = cases.map(|(friction, seed)| {
        (friction, seed, runs(&robot, [coulomb, viscous], friction, 500 + seed))
    });
    for ((friction, seed, whole), (sign, is_driven)) in
        logs.flat_map(|logs| ways.map(|way| (logs.clone(), way)))
    {
        let mut logged = whole.clone();
        logged.iter_mut().for_each(|run| counted(run, (sign, is_driven)));
        let read = correct(&robot, &logged);
        let of = format!("friction x {friction}, seed {seed}, {sign}, {is_driven}");
        let Some(runs) = &read.runs else { panic!("{of}: {:?}", inspect(&robot, &logged)) };
        let is_told = |o: &inspection::Observation| match o.kind {
            ObservationKind::CountedTogether(c) => {
                [c.joint, c.with] == [ELBOW, SHOULDER]
                    && c.sign * sign > 0.0
                    && c.is_driven == is_driven
            }
            _ => false,
        };
        assert!(read.mended.len() == 1 && is_told(&read.mended[0]), "{of}: {:?}", read.mended);
        for (read, whole) in
            runs.iter().zip(&whole).flat_map(|(a, b)| a.joints.iter().zip(&b.joints))
        {
            let apart = |a: &[f64], b: &[f64]| {
                a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            assert!(apart(&read.position, &whole.position) < 1e-12, "{of}");
            assert!(apart(&read.effort, &whole.effort) < 1e-9, "{of}");
        }
    }
}
