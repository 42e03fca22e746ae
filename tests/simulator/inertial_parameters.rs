use std::f64::consts::TAU;

use crate::rig::{FINE, GRAVITY, crossings, pendulum, period, run, simulator};

const TRUE_LINK: &str = "[[effect]]\ninertial_parameters = { link = 'joint_link', mass_kg = 2.6, com_m = [0.42, 0.01, 0.1], inertia_kg_m2 = [0.03, 0.05, 0.04, 0.002, 0.001, 0.0] }\n";
const BOB: &str = "[[effect]]\npayload = { link = 'joint_link', mass_kg = 0.5, com_m = [0.6, 0.0, -0.2], inertia_kg_m2 = [0.01, 0.01, 0.01, 0.0, 0.0, 0.0] }\n";

/// `T = 2 pi sqrt(I / (g |sum m c|))` about where the centre of mass hangs lowest, whatever the
/// description says; what else is fixed to the link adds, in either order.
#[test]
fn oracle_a_pendulum_swings_with_its_true_inertia_and_with_what_it_carries() {
    let about_joint = |m: f64, x: f64, z: f64, own: f64| m * (x * x + z * z) + own;
    let link = about_joint(2.6, 0.42, 0.1, 0.05);
    let bob = about_joint(0.5, 0.6, -0.2, 0.01);
    let (x, z): (f64, f64) = (2.6 * 0.42, 2.6 * 0.1);
    let (x_both, z_both) = (x + 0.5 * 0.6, z - 0.5 * 0.2);
    let cases = [
        (TRUE_LINK.to_owned(), link, x, z),
        (TRUE_LINK.to_owned() + BOB, link + bob, x_both, z_both),
        (BOB.to_owned() + TRUE_LINK, link + bob, x_both, z_both),
    ];
    for (effects, inertia, x, z) in cases {
        let mut arm = simulator(&pendulum(2.0, 0.5), &effects, FINE).unwrap();
        let lowest = x.atan2(-z);
        arm.start(&[lowest + 1e-3]);
        let rows = run(&mut arm, 8.0, |_| vec![0.0]).unwrap();
        let found = period(&crossings(&rows, |r| r.q_true[0] - lowest));
        let expected = TAU * (inertia / (GRAVITY * x.hypot(z))).sqrt();
        assert!((found / expected - 1.0).abs() < 1e-5, "{found} s, not {expected} s");
    }
}
