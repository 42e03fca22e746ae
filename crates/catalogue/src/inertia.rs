//! Inertia: the bodies that a drive moves and carries.

use crate::entry::{EffectEntry, Parameter, always, parameter};
use crate::family::Family;
use crate::kind::EffectKind::{
    CableSpring, Counterbalance, EncoderOffset, ExternalDisturbance, GravityDirection,
    InertialParameters, Payload, RotorInertia, TorqueConstant, TorqueOffset, TransmissionRatio,
};

/// Mass and centre of mass of a body, with their plausible ranges (kg, m).
const fn body(mass: (f64, f64), com: (f64, f64)) -> [Parameter; 4] {
    [
        parameter("mass", always("kg"), "mass", mass),
        parameter("com_x", always("m"), "centre of mass in the link frame, x", com),
        parameter("com_y", always("m"), "centre of mass in the link frame, y", com),
        parameter("com_z", always("m"), "centre of mass in the link frame, z", com),
    ]
}

pub(crate) const PAYLOAD: EffectEntry = EffectEntry {
    kind: Payload,
    family: Family::Inertia,
    words: "payload",
    summary: "a body carried by the last link",
    equation: "Y_last(q, qd, qdd) pi_payload",
    parameters: &body((0.1, 3.0), (-0.15, 0.15)),
    signature: "gravity torque changes at every joint between the base and the last link",
    needs: "poses with different gravity torque",
    confused_with: &[
        InertialParameters,
        TorqueOffset,
        GravityDirection,
        TorqueConstant,
        ExternalDisturbance,
        Counterbalance,
    ],
    told_apart_by: "the same motion before and after the load is put on",
    source: "Gautier & Khalil 1990",
};

pub(crate) const INERTIAL_PARAMETERS: EffectEntry = EffectEntry {
    kind: InertialParameters,
    family: Family::Inertia,
    words: "inertial parameters",
    summary: "mass or centre of mass of a link",
    equation: "Y_link(q, qd, qdd) (pi - pi_nominal)",
    parameters: &body((0.07, 11.0), (-0.25, 0.25)),
    signature: "the residual lies in the span of the link's regressor",
    needs: "motion of the joints before the link, in many poses",
    confused_with: &[
        InertialParameters,
        Payload,
        RotorInertia,
        CableSpring,
        TorqueOffset,
        GravityDirection,
        TorqueConstant,
        EncoderOffset,
        Counterbalance,
    ],
    told_apart_by: "an exciting motion over the whole range of every joint",
    source: "Gautier & Khalil 1990; Wensing, Kim & Slotine 2018",
};

pub(crate) const ROTOR_INERTIA: EffectEntry = EffectEntry {
    kind: RotorInertia,
    family: Family::Inertia,
    words: "rotor inertia",
    summary: "inertia of rotor and gear at the joint",
    equation: "rotor_inertia qdd",
    parameters: &[parameter(
        "inertia",
        ["kg m^2", "kg"],
        "inertia of rotor and gear seen at the joint",
        (0.035, 0.21),
    )],
    signature: "the residual follows the joint's own acceleration, whatever the pose",
    needs: "acceleration in poses with different mass matrix",
    confused_with: &[InertialParameters, TorqueConstant, TransmissionRatio],
    told_apart_by: "the same acceleration with the arm stretched and folded",
    source: "Featherstone 2008",
};
