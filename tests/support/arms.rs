//! Robots and states that the tests share.

use std::path::PathBuf;

use nalgebra::{Isometry3, Matrix3, Translation3, Unit, UnitQuaternion, Vector3};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use robot::{Actuator, Inertia, Joint, JointKind, Limits, Link, Robot};

/// Gravity as the arms of these tests feel it (m/s²).
pub const GRAVITY: Vector3<f64> = Vector3::new(0.0, 0.0, -9.81);

/// The folder of `Cargo.lock`.
pub fn workspace_root() -> PathBuf {
    let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().find(|folder| folder.join("Cargo.lock").exists()).unwrap().to_owned()
}

/// The folder of the recorded arms, which is not part of this project.
pub fn data(file: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("PLUMBLINE_DATA")
        .map_or_else(|| workspace_root().join("../shared/data"), PathBuf::from);
    let path = folder.join(file);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: {} is absent, set PLUMBLINE_DATA to the data folder", path.display());
    None
}

/// The Barrett WAM of this workspace, with its rotors.
pub fn wam() -> Robot {
    Robot::load(&workspace_root().join("robots/wam7/robot.toml")).unwrap().robot
}

/// A generator of its own for every test.
pub fn generator(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// `n` numbers between -`half_range` and `half_range`.
pub fn draw(rng: &mut impl Rng, n: usize, half_range: f64) -> Vec<f64> {
    (0..n).map(|_| rng.random_range(-half_range..half_range)).collect()
}

/// A vector with entries between -`half_range` and `half_range`.
pub fn draw_vector(rng: &mut impl Rng, half_range: f64) -> Vector3<f64> {
    Vector3::from_iterator(draw(rng, 3, half_range))
}

/// A physical inertia: a few point masses.
pub fn draw_inertia(rng: &mut impl Rng) -> Inertia {
    let points: Vec<(f64, Vector3<f64>)> =
        (0..6).map(|_| (rng.random_range(0.1..1.0), draw_vector(rng, 0.3))).collect();
    let mass: f64 = points.iter().map(|(m, _)| m).sum();
    let com = points.iter().map(|(m, x)| x * *m).sum::<Vector3<f64>>() / mass;
    let about_com = points
        .iter()
        .map(|(m, x)| {
            let r = x - com;
            (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * *m
        })
        .sum();
    Inertia { mass, com_in_link: com, about_com }
}

/// A link with a plain actuator.
pub fn link(name: &str, parent: Option<usize>, joint: Joint, inertia: Inertia) -> Link {
    Link {
        name: name.to_owned(),
        parent,
        joint,
        inertia,
        actuator: Actuator::default(),
        merged: Vec::new(),
    }
}

/// A tree of eight links with random axes; every third joint is prismatic, link 3 and
/// link 5 branch off link 1, and link 6 is a second tree on the base.
pub fn random_tree(seed: u64) -> Robot {
    let mut rng = generator(seed);
    let parents = [None, Some(0), Some(1), Some(1), Some(3), Some(1), None, Some(6)];
    let gravity = draw_vector(&mut rng, 9.81);
    let links = parents.iter().enumerate().map(|(i, &parent)| {
        let turn = UnitQuaternion::from_scaled_axis(draw_vector(&mut rng, 2.0));
        let joint = Joint {
            name: format!("joint {i}"),
            kind: if i % 3 == 1 { JointKind::Prismatic } else { JointKind::Revolute },
            parent_from_joint: Isometry3::from_parts(
                Translation3::from(draw_vector(&mut rng, 0.5)),
                turn,
            ),
            axis_in_joint: Unit::new_normalize(draw_vector(&mut rng, 1.0)),
            limits: Limits::default(),
        };
        let mut link = link(&format!("link {i}"), parent, joint, draw_inertia(&mut rng));
        link.actuator.rotor_inertia = rng.random_range(0.01..0.2);
        link
    });
    Robot::new("tree", gravity, links.collect()).unwrap()
}

/// Pose of every link in the base frame: the robot's own kinematics, not those of `dynamics`.
pub fn base_from_links(robot: &Robot, q: &[f64]) -> Vec<Isometry3<f64>> {
    let mut poses: Vec<Isometry3<f64>> = Vec::new();
    for (link, &q) in robot.links().iter().zip(q) {
        let parent = link.parent.map_or_else(Isometry3::identity, |p| poses[p]);
        poses.push(parent * link.joint.parent_from_child(q));
    }
    poses
}

/// `V(q) = -sum m g . c` (J).
pub fn potential_energy(robot: &Robot, q: &[f64]) -> f64 {
    let poses = base_from_links(robot, q);
    let weight = robot.links().iter().zip(poses).map(|(link, pose)| {
        let com = pose * nalgebra::Point3::from(link.inertia.com_in_link);
        -link.inertia.mass * robot.gravity_in_base().dot(&com.coords)
    });
    weight.sum()
}

/// `T = sum 1/2 m v_c . v_c + 1/2 w . I w` (J), with velocities carried outward in the base frame.
pub fn kinetic_energy(robot: &Robot, q: &[f64], qd: &[f64]) -> f64 {
    let poses = base_from_links(robot, q);
    let mut rates: Vec<(Vector3<f64>, Vector3<f64>)> = Vec::new();
    let mut energy = 0.0;
    for (i, link) in robot.links().iter().enumerate() {
        let here = poses[i].translation.vector;
        let axis = poses[i].rotation * link.joint.axis_in_joint.into_inner();
        let (mut w, mut v) = link.parent.map_or((Vector3::zeros(), Vector3::zeros()), |p| {
            let (w, v): (Vector3<f64>, Vector3<f64>) = rates[p];
            (w, v + w.cross(&(here - poses[p].translation.vector)))
        });
        if link.joint.kind.is_rotation() {
            w += axis * qd[i];
        } else {
            v += axis * qd[i];
        }
        rates.push((w, v));
        let at_com = v + w.cross(&(poses[i].rotation * link.inertia.com_in_link));
        let w_in_link = poses[i].rotation.inverse() * w;
        energy += 0.5 * link.inertia.mass * at_com.norm_squared()
            + 0.5 * w_in_link.dot(&(link.inertia.about_com * w_in_link));
    }
    energy
}

/// Everything that can be found in a drive.
pub fn put_in_everything(drive: &mut Actuator) {
    drive.stribeck = Some(robot::Stribeck { excess: 0.2, velocity: 0.05 });
    drive.friction_wave = Some(robot::FrictionWave { share: 0.3, periods: 5.0, phase: 0.7 });
    drive.viscous = 0.3;
    drive.warming =
        Some(robot::Warming { viscous_lost: 0.1, coulomb_lost: 0.2, time_constant_s: 900.0 });
    drive.ripple = Some(robot::Ripple { amplitude: 0.1, periods: 40.0, phase: 0.2 });
    (drive.load_friction, drive.presliding) = (0.07, Some(0.001));
    (drive.coulomb_forward, drive.coulomb_backward) = (0.5, 0.4);
    (drive.backlash, drive.elasticity) = (0.002, Some(900.0));
    (drive.delay_s, drive.lag_s, drive.effort_skew_s) = (0.003, 0.001, -0.002);
    (drive.encoder_offset, drive.transmission_ratio) = (0.01, 1.02);
}
