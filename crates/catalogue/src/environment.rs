//! Environment: the mounting of the arm, and forces from outside.

use crate::entry::{EffectEntry, POSITION, TORQUE, always, parameter, phase};
use crate::family::Family;
use crate::kind::EffectKind::{
    AsymmetricFriction, CableSpring, Counterbalance, EncoderOffset, ExternalDisturbance,
    GravityDirection, InertialParameters, Payload, PositionDependentFriction, PreslidingFriction,
    TorqueOffset, TorqueRipple, TorqueSaturation,
};

pub(crate) const GRAVITY_DIRECTION: EffectEntry = EffectEntry {
    kind: GravityDirection,
    family: Family::Environment,
    words: "gravity direction",
    summary: "a tilted base: gravity points elsewhere",
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

pub(crate) const CABLE_SPRING: EffectEntry = EffectEntry {
    kind: CableSpring,
    family: Family::Environment,
    words: "cable spring",
    summary: "a hose or cable that pulls at a joint",
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
        Counterbalance,
    ],
    told_apart_by: "a sweep over the whole range, \
                    where gravity follows a sine and a spring does not",
    source: "linear elasticity; the loop: Al-Bender, Lampaert & Swevers 2005",
};

pub(crate) const EXTERNAL_DISTURBANCE: EffectEntry = EffectEntry {
    kind: ExternalDisturbance,
    family: Family::Environment,
    words: "external disturbance",
    summary: "a force from outside",
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

pub(crate) const COUNTERBALANCE: EffectEntry = EffectEntry {
    kind: Counterbalance,
    family: Family::Environment,
    words: "counterbalance",
    summary: "a spring that carries part of a weight",
    equation: "amplitude sin(q + phase)",
    parameters: &[
        parameter("amplitude", TORQUE, "largest torque that it gives", (0.5, 30.0)),
        phase("its phase at position zero"),
    ],
    signature: "the residual follows a sine of the joint's own position, and no acceleration",
    needs: "half a turn of the joint, fast and slow",
    confused_with: &[InertialParameters, Payload, CableSpring],
    told_apart_by: "fast and slow motion of the joints before it, \
                    to which a wrong mass adds inertia and a counterbalance none",
    source: "Herder 2001: a spring of no free length between two points balances a weight exactly",
};
