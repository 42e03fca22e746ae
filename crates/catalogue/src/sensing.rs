//! Sensing: from true values to reported ones.

use crate::entry::{EffectEntry, POSITION, always, parameter};
use crate::family::Family;
use crate::kind::EffectKind::{
    ActuatorDelay, ActuatorLag, EncoderOffset, GoalDelay, GravityDirection, InertialParameters,
    TimeSkew, TransmissionRatio, ViscousFriction,
};

pub(crate) const ENCODER_OFFSET: EffectEntry = EffectEntry {
    kind: EncoderOffset,
    family: Family::Sensing,
    words: "encoder offset",
    summary: "reported position off by a constant",
    equation: "tau(q - offset) - tau(q)",
    parameters: &[parameter(
        "offset",
        POSITION,
        "position reported at true position zero",
        (-0.02, 0.02),
    )],
    signature: "gravity torque is that of a neighbouring pose at every joint",
    needs: "gravity torque that changes with the joint",
    confused_with: &[InertialParameters, GravityDirection, TransmissionRatio],
    told_apart_by: "static poses over the whole range, or a pose measured from outside; \
                    a second encoder at the link",
    source: "substitution of the true position",
};

pub(crate) const TIME_SKEW: EffectEntry = EffectEntry {
    kind: TimeSkew,
    family: Family::Sensing,
    words: "time skew",
    summary: "effort and position not of one instant",
    equation: "tau(t - skew) - tau(t)",
    parameters: &[parameter(
        "skew",
        always("s"),
        "time by which the log has effort later than position",
        (-0.002, 0.002),
    )],
    signature: "the residual follows the rate of the torque, and a shift of the effort undoes it",
    needs: "torque that changes fast",
    confused_with: &[ViscousFriction, ActuatorLag, ActuatorDelay, GoalDelay],
    told_apart_by: "a knock at rest, which position and measured torque should show together",
    source: "substitution of the true time",
};
