//! Task rhythms: the point really follows the figure, by a chain multiplied out here.

use std::f64::consts::TAU;

use checks::synthetic::wam;
use motion::{Motion, MotionError};
use nalgebra::{Isometry3, Point3};
use robot::Robot;

use crate::support::{build, gantry, rhythm};

fn tip(robot: &Robot, q: &[f64]) -> Point3<f64> {
    let joints = robot.links().iter().zip(q);
    let pose = joints
        .fold(Isometry3::identity(), |pose, (link, &q)| pose * link.joint.parent_from_child(q));
    pose * Point3::new(0.0, 0.0, 0.06)
}

/// The point's path between the fades, from its middle: (time of the figure, offset).
fn path(robot: &Robot, motion: &Motion) -> Vec<(f64, nalgebra::Vector3<f64>)> {
    let posture = [0.0, 0.6, 0.0, 1.4, 0.0, 0.0, 0.0];
    let centre = tip(robot, &posture);
    // A fade of 2 s takes 1 s of the figure.
    let times = (0..=1000).map(|k| 2.0 + 6.0 * f64::from(k) / 1000.0);
    times.map(|t| (t - 1.0, tip(robot, &motion.at(t).q) - centre)).collect()
}

#[test]
fn the_point_follows_every_figure_in_every_plane_within_a_tenth_of_a_millimetre() {
    let wam = wam();
    for (figure, radius) in [("circle", 0.12), ("eight", 0.15), ("line", 0.12)] {
        for (plane, [u, v, w]) in [("xy", [0, 1, 2]), ("yz", [1, 2, 0]), ("zx", [2, 0, 1])] {
            let motion = build(&wam, &rhythm(figure, plane, radius)).unwrap();
            for (t, offset) in path(&wam, &motion) {
                let phi = TAU * 0.25 * t;
                let (first, second) = match figure {
                    "circle" => (phi.cos(), phi.sin()),
                    "eight" => (phi.sin(), 0.5 * (2.0 * phi).sin()),
                    _ => (phi.sin(), 0.0),
                };
                let miss = [offset[u] - radius * first, offset[v] - radius * second, offset[w]];
                let miss = miss.iter().map(|m| m * m).sum::<f64>().sqrt();
                assert!(miss < 1e-5, "{figure} {plane}: {miss:e} m at {t} s");
            }
        }
    }
}

#[test]
fn a_rhythm_returns_to_the_same_posture_after_every_cycle() {
    let motion = build(&wam(), &rhythm("eight", "yz", 0.15)).unwrap();
    let (first, second) = (motion.at(2.5).q, motion.at(6.5).q);
    let far = first.iter().zip(&second).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(far < 1e-12, "{far:e}");
}

#[test]
fn a_figure_out_of_reach_is_refused_with_the_point_that_is_missed() {
    let wam = wam();
    let error = build(&wam, &rhythm("circle", "xy", 3.0)).unwrap_err();
    let MotionError::Unreachable { key, point_m, miss_m, .. } = &error else {
        panic!("{error}");
    };
    assert_eq!(key, "rhythm.radius_m");
    // The upper arm, the forearm and the palm are 0.55 m, 0.3 m and 0.06 m long.
    let shoulder = Point3::new(0.0, 0.0, 0.346);
    let reach = 0.55_f64.hypot(0.045) + 0.3_f64.hypot(0.045) + 0.06;
    let beyond = (Point3::from(*point_m) - shoulder).norm() - reach;
    assert!(*miss_m >= beyond && *miss_m < 1.1 * beyond, "{miss_m} beside {beyond}: {error}");
}

#[test]
fn an_arm_with_too_few_joints_is_told_that_it_cannot_reach() {
    // The gantry's arm turns about its own point: nothing moves it upwards.
    let toml = "[rhythm]\nfigure = \"line\"\nplane = \"zx\"\nradius_m = 0.1\ncycle_hz = 0.2\n\
                duration_s = 10.0";
    let error = build(&gantry(), toml).unwrap_err();
    assert!(matches!(error, MotionError::Unreachable { .. }), "{error}");
}
