//! A body held by a link that weighs almost nothing, as the jaw of a small gripper or a frame with a placeholder for its
//! inertia.

use diagnosis::{Settings, Silent, diagnose};
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use robot::{Inertia, Robot};

use crate::world::{World, finding, named, sign};

/// Mass (kg) and centre of mass (m) of the body that is held.
const MASS_KG: f64 = 0.5;
const CENTRE_M: [f64; 3] = [-0.09, -0.01, 0.03];

/// The robot with a palm of 12 g.
fn with_light_palm(mut robot: Robot) -> Robot {
    let palm = robot.joint_count() - 1;
    let about_com = Matrix3::identity() * 1e-6;
    let link = robot.link_mut(palm).unwrap();
    link.inertia = Inertia { mass: 0.012, com_in_link: Vector3::new(0.0, 0.0, 0.01), about_com };
    robot
}

/// The same that holds a point mass, which lies at the edge of what is physical.
fn with_point_mass(robot: Robot) -> Robot {
    let mut robot = with_light_palm(robot);
    let palm = robot.joint_count() - 1;
    let link = robot.link_mut(palm).unwrap();
    let about_com = Matrix3::zeros();
    let point = Inertia { mass: MASS_KG, com_in_link: CENTRE_M.into(), about_com };
    link.inertia = link.inertia.with_body(&point);
    robot
}

/// Mass and centre lie in their intervals, and a friction beside them is found.
#[test]
fn a_point_mass_on_a_link_of_grams_is_found_where_it_is() {
    let world = World::nominal()
        .body(with_point_mass)
        .torque(4, |[_, qd, _]| if qd > 0.0 { 0.3 } else { 0.15 * sign(qd) });
    let described = with_light_palm(World::nominal().robot);
    let wrong: Vec<String> = (2700..2708)
        .into_par_iter()
        .filter_map(|seed| {
            let runs = world.log(seed);
            let answer = diagnose(&described, &runs, &Settings::default(), &Silent).unwrap();
            let found = &answer.diagnosis;
            let truth = [MASS_KG, CENTRE_M[0], CENTRE_M[1], CENTRE_M[2]];
            let is_inside = finding(found, "IN01 payload at palm").is_some_and(|payload| {
                truth
                    .iter()
                    .zip(&payload.parameters)
                    .all(|(value, p)| (p.ci95[0]..=p.ci95[1]).contains(value))
            });
            let has_friction = finding(found, "FR03 asymmetric friction at j5_wrist_yaw").is_some();
            let payload = finding(found, "IN01 payload at palm").map(|p| &p.parameters);
            let words = || format!("{seed}: {:?} {payload:?}", named(found));
            (!is_inside || !has_friction).then(words)
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}
