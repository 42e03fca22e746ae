//! What the arm carries and what acts on it from outside.

use crate::EffectKind::{
    AsymmetricFriction, CableSpring, EncoderOffset, ExternalDisturbance, GravityDirection,
    InertialParameters, Payload, PositionDependentFriction, PreslidingFriction, RotorInertia,
    TorqueConstant, TorqueOffset, TorqueRipple, TorqueSaturation,
};
use crate::entry::{POSITION, TORQUE, always, parameter, phase};
use crate::{Entry, Parameter};

/// Mass and centre of mass of a body, with their plausible ranges (kg, m).
const fn body(mass: (f64, f64), com: (f64, f64)) -> [Parameter; 4] {
    [
        parameter("mass", always("kg"), "mass", mass),
        parameter("com_x", always("m"), "centre of mass in the link frame, x", com),
        parameter("com_y", always("m"), "centre of mass in the link frame, y", com),
        parameter("com_z", always("m"), "centre of mass in the link frame, z", com),
    ]
}

pub(crate) const PAYLOAD: Entry = Entry {
    kind: Payload,
    name: "payload",
    words: "payload",
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
    ],
    told_apart_by: "the same motion before and after the load is put on",
    source: "Gautier & Khalil 1990",
};

pub(crate) const INERTIAL_PARAMETERS: Entry = Entry {
    kind: InertialParameters,
    name: "inertial_parameters",
    words: "inertial parameters",
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
    ],
    told_apart_by: "an exciting motion over the whole range of every joint",
    source: "Gautier & Khalil 1990; Wensing, Kim & Slotine 2018",
};

pub(crate) const GRAVITY_DIRECTION: Entry = Entry {
    kind: GravityDirection,
    name: "gravity_direction",
    words: "gravity direction",
    equation: "G(q) (g - g_nominal)",
    parameters: &[
        parameter("tilt_1", always("rad"), "tilt about the first horizontal axis", (-0.05, 0.05)),
        parameter("tilt_2", always("rad"), "tilt about the second horizontal axis", (-0.05, 0.05)),
    ],
    signature: "a joint with a vertical axis carries a gravity torque",
    needs: "a sweep of the first joint with the arm stretched",
    confused_with: &[InertialParameters, TorqueOffset, Payload, EncoderOffset],
    told_apart_by: "a full turn of the first joint with the arm stretched out",
    source: "Featherstone 2008",
};

pub(crate) const CABLE_SPRING: Entry = Entry {
    kind: CableSpring,
    name: "cable_spring",
    words: "cable spring",
    equation: "stiffness (q - rest); a hose adds cubic (q - rest)^3 + h, \
               hd = stiffness qd, |h| <= hysteresis",
    parameters: &[
        parameter("stiffness", ["N m/rad", "N/m"], "torque per unit of displacement", (0.1, 2.0)),
        parameter("rest", POSITION, "position at which the spring is slack", (-2.0, 2.0)),
        parameter("cubic", ["N m/rad^3", "N/m^3"], "torque per cube of displacement", (0.0, 0.2)),
        parameter(
            "hysteresis",
            TORQUE,
            "half the width of the loop of torque over position",
            (0.0, 0.6),
        ),
    ],
    signature: "the residual follows the joint's own position and no other joint's",
    needs: "a wide range of the joint, in different poses of the others",
    confused_with: &[
        InertialParameters,
        TorqueOffset,
        AsymmetricFriction,
        PreslidingFriction,
        PositionDependentFriction,
    ],
    told_apart_by: "a sweep over the whole range, \
                    where gravity follows a sine and a spring does not",
    source: "linear elasticity; the loop: Al-Bender, Lampaert & Swevers 2005",
};

pub(crate) const EXTERNAL_DISTURBANCE: Entry = Entry {
    kind: ExternalDisturbance,
    name: "external_disturbance",
    words: "external disturbance",
    equation: "-amplitude sin(2 pi frequency t + phase), or -J^T force from start for duration",
    parameters: &[
        parameter("amplitude", TORQUE, "amplitude of the torque on the link", (0.05, 2.0)),
        parameter("frequency", always("Hz"), "its frequency", (0.2, 60.0)),
        phase("its phase at the start of the log"),
        parameter(
            "force_x",
            always("N"),
            "force at the last link's origin, base frame, x",
            (-30.0, 30.0),
        ),
        parameter(
            "force_y",
            always("N"),
            "force at the last link's origin, base frame, y",
            (-30.0, 30.0),
        ),
        parameter(
            "force_z",
            always("N"),
            "force at the last link's origin, base frame, z",
            (-30.0, 30.0),
        ),
        parameter("start", always("s"), "time from the start of the log to the push", (0.0, 20.0)),
        parameter("duration", always("s"), "how long the push lasts", (0.1, 2.0)),
    ],
    signature: "the residual keeps to the clock and not to the state of the arm",
    needs: "the same motion more than once, begun at different times",
    confused_with: &[Payload, TorqueRipple, TorqueSaturation],
    told_apart_by: "the same motion begun anew at other times, and at another speed",
    source: "virtual work of the force",
};
