use catalogue::EffectKind;
use nalgebra::DMatrix;
use robot::Robot;
use simulator::Truth;

/// The torque that something adds along the motion: for every run a row a sample, a column a joint.
pub(crate) type Torque = Vec<DMatrix<f64>>;

/// A column of the oracle's regression.
#[derive(Debug, Clone)]
pub(crate) struct TorqueColumn {
    /// What it stands for: causes that are of the same stand-in leave one another out.
    pub stands_for: StandIn,
    /// Its torque (N m or N) at a size of one.
    pub torque: Torque,
    /// What is known of its size beforehand, as `1 / deviation^2`; none of a cause.
    pub prior: f64,
}

/// What a column stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StandIn {
    /// Friction that has the sign of the velocity, at a joint.
    Dry(usize),
    /// Friction in proportion to the velocity, at a joint.
    Viscous(usize),
    /// A constant at a joint.
    Offset(usize),
    /// Inertia of a joint's rotor.
    Rotor(usize),
    /// The body of a link.
    Body(usize),
    /// Nothing but itself.
    Itself,
}

impl StandIn {
    /// What a hidden cause is itself among the stand-ins, so that it does not explain itself away.
    pub fn of(truth: &Truth, robot: &Robot) -> Self {
        let joint = truth.joint.as_deref().and_then(|name| robot.joint_index(name));
        match (truth.effect, joint) {
            (EffectKind::CoulombFriction, Some(j)) => Self::Dry(j),
            (EffectKind::ViscousFriction, Some(j)) => Self::Viscous(j),
            (EffectKind::TorqueOffset, Some(j)) => Self::Offset(j),
            (EffectKind::RotorInertia, Some(j)) => Self::Rotor(j),
            _ => Self::Itself,
        }
    }
}
