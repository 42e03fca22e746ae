use catalogue::EffectKind;
use diagnosis::EffectAt;
use dynamics::PARAMETERS_PER_LINK;
use robot::Robot;

use crate::baselines::scales::Scales;
use crate::baselines::shape::Shape;

/// Fewest and most periods of a ripple in a turn.
const RIPPLES: std::ops::RangeInclusive<u8> = 4..=30;

/// Periods in a turn of friction that varies with position.
const FRICTION_PERIODS: u8 = 2;

/// Evidence that a name with many frequencies to choose from pays for the choice (nats).
const RIPPLE_PRICE: f64 = 3.689;

/// Evidence that a name with many columns pays beforehand (nats).
const WIDE_PRICE: f64 = 1.609;

/// Largest amount by which a weight may reduce the nominal value below zero, as a share of that value.
const SLACK: f64 = 0.1;

/// A cause that may be named, with its columns at every joint.
pub(super) struct Candidate {
    /// The cause.
    pub at: EffectAt,
    /// Joints, and the shapes at each.
    pub parts: Vec<(usize, Vec<Shape>)>,
    /// Evidence that the name pays before it is tested (nats).
    pub price: f64,
    /// The joint at which the weight of the first shape has a least value, and that value.
    pub least: Option<(usize, f64)>,
}

/// Every cause that the logs could show. A joint that does not move has only the causes in which its drive adds to
/// the reported effort.
pub(super) fn candidates(robot: &Robot, scales: &Scales) -> Vec<Candidate> {
    let mut all = Vec::new();
    for j in 0..robot.joint_count() {
        all.extend(of_drive(robot, j));
        if scales.moves[j] {
            all.extend(of_motion(robot, j));
            all.push(elasticity(robot, j));
        }
    }
    let joints = || 0..robot.joint_count();
    let everywhere = |effect, shapes: &[Shape]| Candidate {
        at: EffectAt { effect, joint: None, link: None },
        parts: joints().map(|j| (j, shapes.to_vec())).collect(),
        price: 0.0,
        least: None,
    };
    if robot.joint_count() > 1 {
        all.push(everywhere(EffectKind::TimeSkew, &[Shape::NominalRate]));
    }
    if robot.gravity_in_base().norm() > 0.0 {
        let tilt = [Shape::Tilt(0), Shape::Tilt(1)];
        all.push(everywhere(EffectKind::GravityDirection, &tilt));
    }
    all.extend(joints().map(|link| body(robot, link)));
    all
}

fn of_joint(robot: &Robot, j: usize, effect: EffectKind, shapes: &[Shape]) -> Candidate {
    Candidate {
        at: EffectAt { effect, joint: Some(robot.links()[j].joint.name.clone()), link: None },
        parts: vec![(j, shapes.to_vec())],
        price: 0.0,
        least: None,
    }
}

/// Causes of a drive that show whether it moves or not.
fn of_drive(robot: &Robot, j: usize) -> Vec<Candidate> {
    let plain = |effect, shapes: &[Shape]| of_joint(robot, j, effect, shapes);
    let delay = plain(EffectKind::ActuatorDelay, &[Shape::NominalRate]);
    vec![
        plain(EffectKind::TorqueOffset, &[Shape::One]),
        plain(EffectKind::TorqueConstant, &[Shape::Nominal]),
        Candidate { least: Some((j, 0.0)), ..delay },
    ]
}

/// Causes that show in a joint's motion.
fn of_motion(robot: &Robot, j: usize) -> Vec<Candidate> {
    let a = &robot.links()[j].actuator;
    let candidate = |effect, shapes: &[Shape], nominal: f64| Candidate {
        least: Some((j, -(1.0 + SLACK) * nominal)),
        ..of_joint(robot, j, effect, shapes)
    };
    let coulomb = 0.5 * (a.coulomb_forward + a.coulomb_backward);
    let spring = [Shape::Position, Shape::One];
    let mut all = vec![
        candidate(EffectKind::ViscousFriction, &[Shape::Velocity], a.viscous),
        candidate(EffectKind::CoulombFriction, &[Shape::Sign], coulomb),
        candidate(EffectKind::RotorInertia, &[Shape::Acceleration], a.rotor_inertia),
        of_joint(robot, j, EffectKind::AsymmetricFriction, &[Shape::Sign, Shape::One]),
        candidate(EffectKind::CableSpring, &spring, a.spring_stiffness),
        candidate(EffectKind::LoadDependentFriction, &[Shape::LoadSign], a.load_friction),
    ];
    let k = FRICTION_PERIODS;
    let wave = [Shape::SineSign(k), Shape::CosineSign(k), Shape::Sign];
    let wave = of_joint(robot, j, EffectKind::PositionDependentFriction, &wave);
    all.push(Candidate { price: WIDE_PRICE, ..wave });
    all.extend(RIPPLES.map(|k| {
        let waves = [Shape::Sine(k), Shape::Cosine(k)];
        let ripple = of_joint(robot, j, EffectKind::TorqueRipple, &waves);
        Candidate { price: RIPPLE_PRICE, ..ripple }
    }));
    all
}

/// A spring in the transmission, with columns at its joint and at the neighbours.
fn elasticity(robot: &Robot, j: usize) -> Candidate {
    let links = robot.links();
    let near = |i: &usize| *i == j || links[j].parent == Some(*i) || links[*i].parent == Some(j);
    let parts = (0..links.len()).filter(near).map(|i| (i, vec![Shape::Spring { joint: j }]));
    Candidate {
        parts: parts.collect(),
        price: WIDE_PRICE,
        least: Some((j, 0.0)),
        ..of_joint(robot, j, EffectKind::JointElasticity, &[])
    }
}

/// The body of a link, with columns at every joint that carries it. For the last link a change of the described body
/// is a payload.
fn body(robot: &Robot, link: usize) -> Candidate {
    let links = robot.links();
    let is_last = link + 1 == links.len();
    let shapes: Vec<Shape> =
        (0..PARAMETERS_PER_LINK).map(|parameter| Shape::Body { link, parameter }).collect();
    let carriers = std::iter::successors(Some(link), |at| links[*at].parent);
    let mut parts: Vec<(usize, Vec<Shape>)> = carriers.map(|j| (j, shapes.clone())).collect();
    parts.reverse();
    let effect = if is_last { EffectKind::Payload } else { EffectKind::InertialParameters };
    let at = EffectAt { effect, joint: None, link: Some(links[link].name.clone()) };
    Candidate { at, parts, price: 0.0, least: None }
}
