//! Sensors: what is reported for what is there.

use crate::EffectKind::{
    ActuatorDelay, ActuatorLag, EncoderOffset, GravityDirection, InertialParameters, TimeSkew,
    TorqueConstant, TransmissionRatio, ViscousFriction,
};
use crate::Entry;
use crate::entry::{POSITION, always, parameter};

pub(crate) const ENCODER_OFFSET: Entry = Entry {
    kind: EncoderOffset,
    name: "encoder_offset",
    words: "encoder offset",
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
    told_apart_by: "static poses over the whole range, or a pose measured from outside",
    source: "substitution of the true position",
};

pub(crate) const TRANSMISSION_RATIO: Entry = Entry {
    kind: TransmissionRatio,
    name: "transmission_ratio",
    words: "transmission ratio",
    equation: "ratio tau(ratio q, ratio qd, ratio qdd) - tau(q, qd, qdd)",
    parameters: &[parameter(
        "ratio",
        always("1"),
        "true over reported position, and effort over true torque",
        (0.957, 1.043),
    )],
    signature: "torque is off by a factor, gravity torque by more the farther from zero",
    needs: "the whole range of the joint",
    confused_with: &[TorqueConstant, EncoderOffset],
    told_apart_by: "both end stops of the joint, or poses measured from outside, far from zero",
    source: "equal power on both sides of the gear",
};

pub(crate) const TIME_SKEW: Entry = Entry {
    kind: TimeSkew,
    name: "time_skew",
    words: "time skew",
    equation: "tau(t - skew) - tau(t)",
    parameters: &[parameter(
        "skew",
        always("s"),
        "time by which the log has effort later than position",
        (-0.002, 0.002),
    )],
    signature: "the residual follows the rate of the torque, and a shift of the effort undoes it",
    needs: "torque that changes fast",
    confused_with: &[ViscousFriction, ActuatorLag, ActuatorDelay],
    told_apart_by: "a knock at rest, which position and measured torque should show together",
    source: "substitution of the true time",
};
