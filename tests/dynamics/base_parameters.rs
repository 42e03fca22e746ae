//! Counts of base parameters of the WAM, and what they promise.

use dynamics::{ColumnSet, Dynamics, base_parameters};
use nalgebra::{DVector, Rotation3, Vector3};
use robot::Robot;

use checks::arms::{GRAVITY, data, draw, generator, random_tree, wam};

const FRICTION: ColumnSet = ColumnSet { rotor: false, viscous: true, coulomb: true, offset: false };
const ROTOR: ColumnSet = ColumnSet { rotor: true, ..ColumnSet::INERTIAL };
const NO_ROTOR: ColumnSet = ColumnSet { rotor: false, ..ColumnSet::ALL };

fn counts(robot: &Robot) -> [usize; 5] {
    [ColumnSet::INERTIAL, ROTOR, FRICTION, NO_ROTOR, ColumnSet::ALL]
        .map(|set| base_parameters(robot, set).rank())
}

#[test]
fn the_wam_has_the_known_numbers_of_base_parameters() {
    let tilt = Rotation3::from_axis_angle(&Vector3::x_axis(), 0.2);
    assert_eq!(counts(&wam()), [43, 48, 57, 64, 69]);
    assert_eq!(counts(&wam().with_gravity(tilt * GRAVITY)), [45, 50, 59, 66, 71]);
    assert_eq!(counts(&wam().with_gravity(Vector3::zeros())), [39, 44, 53, 60, 65]);
}

#[test]
fn the_count_of_the_wam_stands_on_a_wide_gap() {
    let base = base_parameters(&wam(), ColumnSet::ALL);
    let (kept, next) = (base.singular_values[68], base.singular_values[69]);
    assert!(kept > 1e-2 && next < 1e-12, "{kept} and {next}");
}

/// The base of its URDF is turned by 3.1416: a tilt of 7e-6 rad reveals nothing in practice.
#[test]
fn angles_with_five_digits_reveal_no_parameter_of_the_kinova_gen3() {
    let Some(urdf) = data("kinova_gen3/robot.urdf") else { return };
    assert_eq!(counts(&Robot::load(&urdf).unwrap().robot), [43, 48, 57, 64, 69]);
}

#[test]
fn base_parameters_reproduce_the_torque_of_the_full_ones() {
    for robot in [wam(), random_tree(5)] {
        let base = base_parameters(&robot, ColumnSet::ALL);
        let (dynamics, n) = (Dynamics::new(&robot), robot.joint_count());
        let width = base.columns.len();
        let mut rng = generator(11);
        let pi = draw(&mut rng, width, 1.0);
        let pi_base = base.project(&pi).unwrap();
        let mut y = vec![0.0; n * width];
        for _ in 0..20 {
            let (q, qd, qdd) =
                (draw(&mut rng, n, 3.0), draw(&mut rng, n, 2.0), draw(&mut rng, n, 5.0));
            dynamics.columns_into(
                &mut dynamics.workspace(),
                [&q, &qd, &qdd],
                ColumnSet::ALL,
                &mut y,
            );
            for row in y.chunks_exact(width) {
                let full: f64 = row.iter().zip(&pi).map(|(y, p)| y * p).sum();
                let y_base = base.independent.iter().map(|&c| row[c]);
                let short = DVector::from_iterator(base.rank(), y_base).dot(&pi_base);
                assert!((full - short).abs() < 1e-9, "{full} and {short}");
            }
        }
    }
}

#[test]
fn the_wam_keeps_the_last_link_and_the_drives_and_loses_what_the_base_hides() {
    let base = base_parameters(&wam(), ColumnSet::ALL);
    let names = |indices: &[usize]| -> Vec<String> {
        indices.iter().map(|&c| base.columns[c].to_string()).collect()
    };
    let kept = names(&base.independent);
    for name in ["Izz7", "mx7", "my7", "fv1", "fc4", "fo7", "Ia3", "Ia7"] {
        assert!(kept.iter().any(|k| k == name), "{name} is not kept: {kept:?}");
    }
    let invisible = names(&base.invisible());
    for name in ["m1", "mx1", "Ixx1", "m2", "mz2", "m3"] {
        assert!(invisible.iter().any(|k| k == name), "{name} is not invisible: {invisible:?}");
    }
}
