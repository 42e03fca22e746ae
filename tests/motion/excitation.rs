//! The excitation of the WAM shows all its base parameters, by singular values alone.

use std::path::{Path, PathBuf};

use checks::synthetic::wam;
use dynamics::{ColumnSet, Dynamics};
use motion::{Motion, MotionSpec};
use nalgebra::DMatrix;

/// Base parameters of the WAM with rotors, friction and offsets (Sousa & Cortesao 2014).
const RANK: usize = 69;
/// What the excitation is held to.
const LARGEST_CONDITION: f64 = 50.0;
/// States over one period of 10 s; the search took 200.
const STATES: usize = 370;

/// A choice of columns for the base parameters, as published: of the moments of inertia the
/// first is kept, of the last link all; rotors from the third on; every friction and offset.
const COLUMNS: [&str; 7] = [
    "mx2 Ixx2 Ixy2 Iyy2 Ixz2 Iyz2 mx3 Ixx3 Ixy3 Iyy3 Ixz3 Iyz3",
    "mx4 mz4 Ixx4 Ixy4 Iyy4 Ixz4 Iyz4 mx5 mz5 Ixx5 Ixy5 Iyy5 Ixz5 Iyz5",
    "mx6 mz6 Ixx6 Ixy6 Iyy6 Ixz6 Iyz6 m7 mx7 my7 mz7 Ixx7 Ixy7 Iyy7 Ixz7 Iyz7 Izz7",
    "Ia3 Ia4 Ia5 Ia6 Ia7",
    "fv1 fv2 fv3 fv4 fv5 fv6 fv7",
    "fc1 fc2 fc3 fc4 fc5 fc6 fc7",
    "fo1 fo2 fo3 fo4 fo5 fo6 fo7",
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots/wam7")
}

fn excitation(duration_s: f64, fade_s: f64) -> Motion {
    let toml = format!(
        "[fourier]\ncoefficients.file = \"excitation.toml\"\nduration_s = {duration_s:?}\n\
        fade_s = {fade_s:?}"
    );
    let spec: MotionSpec = toml::from_str(&toml).unwrap();
    spec.build(&wam(), &folder()).unwrap()
}

/// The regressor over one period: inertial columns by `dynamics`, the others written here.
fn stacked(motion: &Motion, from_s: f64) -> DMatrix<f64> {
    let dynamics = Dynamics::new(&wam());
    let n = motion.joint_count();
    let mut w = DMatrix::zeros(STATES * n, 14 * n);
    for state in 0..STATES {
        let x = motion.at(from_s + 10.0 * state as f64 / STATES as f64);
        let y = dynamics.torque_regressor(&x.q, &x.qd, &x.qdd).unwrap();
        w.view_mut((state * n, 0), (n, 10 * n)).copy_from(&y);
        for i in 0..n {
            let drive = [x.qdd[i], x.qd[i], x.qd[i].signum(), 1.0];
            for (family, value) in drive.into_iter().enumerate() {
                w[(state * n + i, (10 + family) * n + i)] = value;
            }
        }
    }
    w
}

fn singular_values(w: DMatrix<f64>) -> Vec<f64> {
    let mut values: Vec<f64> = w.svd(false, false).singular_values.iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

#[test]
fn the_base_regressor_of_the_excitation_has_a_condition_number_of_fifty_at_most() {
    let w = stacked(&excitation(10.0, 0.0), 0.0);
    // Whatever columns stand for them: the base parameters span what the singular values show.
    let values = singular_values(w.clone());
    let condition = values[0] / values[RANK - 1];
    assert!(values[RANK] < 1e-9 * values[0], "more than {RANK}: {:e}", values[RANK]);
    assert!(condition <= LARGEST_CONDITION, "{condition}");

    let text = std::fs::read_to_string(folder().join("excitation.toml")).unwrap();
    let (_, rest) = text.split_once("condition number ").unwrap();
    let printed: f64 = rest.split_once(". Written").unwrap().0.parse().unwrap();
    assert!((condition / printed - 1.0).abs() < 0.02, "{condition}, the file says {printed}");

    // With the columns of a published choice.
    let names: Vec<String> = ColumnSet::ALL.columns(7).iter().map(ToString::to_string).collect();
    let kept = COLUMNS.iter().flat_map(|line| line.split(' '));
    let kept: Vec<usize> = kept.map(|c| names.iter().position(|n| n == c).unwrap()).collect();
    let values = singular_values(w.select_columns(&kept));
    assert_eq!(values.len(), RANK);
    let condition = values[0] / values[RANK - 1];
    assert!(condition <= LARGEST_CONDITION, "{condition}");
}

#[test]
fn the_excitation_is_the_same_period_again_and_again_between_its_fades() {
    let motion = excitation(24.0, 2.0);
    for k in 0..100 {
        let t = 2.0 + 0.1 * f64::from(k);
        let (first, second) = (motion.at(t), motion.at(t + 10.0));
        let pairs = first.q.iter().chain(&first.qdd).zip(second.q.iter().chain(&second.qdd));
        assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-12), "at {t} s");
    }
    // So a period between the fades shows as much.
    let values = singular_values(stacked(&motion, 7.0));
    assert!(values[0] / values[RANK - 1] <= LARGEST_CONDITION);
}
