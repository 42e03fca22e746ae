//! Drive: from the commanded effort to the torque that acts.

use crate::entry::{EffectEntry, TORQUE, always, parameter, phase};
use crate::family::Family;
use crate::kind::EffectKind::{
    ActuatorDelay, ActuatorLag, AsymmetricFriction, CableSpring, ExternalDisturbance,
    FrictionTemperatureDrift, GoalDelay, GravityDirection, InertialParameters, JointElasticity,
    LoadDependentFriction, Payload, PositionDependentFriction, RotorInertia, StribeckFriction,
    TimeSkew, TorqueConstant, TorqueOffset, TorqueRipple, TorqueSaturation, TransmissionRatio,
    ViscousFriction,
};

pub(crate) const TORQUE_RIPPLE: EffectEntry = EffectEntry {
    kind: TorqueRipple,
    family: Family::Drive,
    words: "torque ripple",
    summary: "torque that varies with the motor angle",
    equation: "amplitude sin(periods_per_turn q + phase)",
    parameters: &[
        parameter("amplitude", TORQUE, "amplitude of the torque", (0.05, 0.5)),
        parameter(
            "periods_per_turn",
            ["1", "rad/m"],
            "periods in a turn of the joint, or phase per metre of its way",
            (108.0, 1512.0),
        ),
        phase("phase at position zero"),
    ],
    signature: "the residual oscillates with a frequency that is proportional to speed",
    needs: "constant speeds slow enough for the sampling rate",
    confused_with: &[
        StribeckFriction,
        PositionDependentFriction,
        JointElasticity,
        ExternalDisturbance,
    ],
    told_apart_by: "several constant speeds, and the spectrum of the torque over position",
    source: "Holtz & Springob 1996",
};

pub(crate) const TORQUE_CONSTANT: EffectEntry = EffectEntry {
    kind: TorqueConstant,
    family: Family::Drive,
    words: "torque constant",
    summary: "reported effort off by a factor",
    equation: "torque_gain tau",
    parameters: &[parameter(
        "gain",
        always("1"),
        "reported effort per unit of torque",
        (0.89, 1.11),
    )],
    signature: "every term of the joint's torque is off by the same factor",
    needs: "a known load",
    confused_with: &[
        InertialParameters,
        Payload,
        AsymmetricFriction,
        LoadDependentFriction,
        FrictionTemperatureDrift,
        TorqueSaturation,
        TransmissionRatio,
        RotorInertia,
    ],
    told_apart_by: "the same motion with and without a payload of known mass",
    source: "Gautier & Briot 2014",
};

pub(crate) const TORQUE_OFFSET: EffectEntry = EffectEntry {
    kind: TorqueOffset,
    family: Family::Drive,
    words: "torque offset",
    summary: "reported effort off by a constant",
    equation: "offset",
    parameters: &[parameter("offset", TORQUE, "effort reported at zero torque", (-0.3, 0.3))],
    signature: "the residual has a mean that depends on nothing",
    needs: "poses with different gravity torque",
    confused_with: &[
        AsymmetricFriction,
        CableSpring,
        InertialParameters,
        Payload,
        GravityDirection,
    ],
    told_apart_by: "static poses on both sides of the vertical, \
                    where gravity changes sign and an offset does not",
    source: "Sousa & Cortesao 2014",
};

pub(crate) const ACTUATOR_LAG: EffectEntry = EffectEntry {
    kind: ActuatorLag,
    family: Family::Drive,
    words: "actuator lag",
    summary: "torque that lags behind its command",
    equation: "time_constant d(tau)/dt",
    parameters: &[parameter(
        "time_constant",
        always("s"),
        "time in which the torque covers 63 % of a step",
        (0.0002, 0.005),
    )],
    signature: "the residual follows the rate of the torque, and fast commands lose amplitude",
    needs: "torque that changes fast, and a log of the command",
    confused_with: &[ViscousFriction, JointElasticity, ActuatorDelay, TimeSkew],
    told_apart_by: "a chirp to high frequencies, where a lag loses amplitude and a delay none",
    source: "first-order low-pass",
};

pub(crate) const ACTUATOR_DELAY: EffectEntry = EffectEntry {
    kind: ActuatorDelay,
    family: Family::Drive,
    words: "actuator delay",
    summary: "torque a fixed time after its command",
    equation: "tau(t + delay) - tau(t)",
    parameters: &[parameter("delay", always("s"), "time from command to torque", (0.002, 0.01))],
    signature: "the residual follows the rate of the torque, the more so the faster it is",
    needs: "torque that changes fast, and a log of the command",
    confused_with: &[ViscousFriction, JointElasticity, ActuatorLag, TimeSkew],
    told_apart_by: "a chirp to high frequencies, with the torque measured beside the command",
    source: "transport delay",
};

pub(crate) const GOAL_DELAY: EffectEntry = EffectEntry {
    kind: GoalDelay,
    family: Family::Drive,
    words: "goal delay",
    summary: "goals that reach the position loop late",
    equation: "kp (goal(t) - goal(t - delay))",
    parameters: &[parameter(
        "delay",
        always("s"),
        "time from the row of a goal to the position loop",
        (0.01, 0.06),
    )],
    signature: "efforts computed from goals follow the rate of the goals, at every joint by its stiffness",
    needs: "a log of goals without efforts, and the gains of the position loops",
    confused_with: &[ViscousFriction, TimeSkew],
    told_apart_by: "fast and slow starts: a goal that leaps shows when the joint follows, friction only how fast",
    source: "transport delay before a PD loop",
};

pub(crate) const TORQUE_SATURATION: EffectEntry = EffectEntry {
    kind: TorqueSaturation,
    family: Family::Drive,
    words: "torque saturation",
    summary: "torque that ends at a limit",
    equation: "(|effort| - limit) sign(effort) where |effort| > limit",
    parameters: &[parameter("limit", TORQUE, "largest torque of the drive", (29.0, 102.0))],
    signature: "above a level of effort the arm accelerates no faster",
    needs: "commands beyond the limit",
    confused_with: &[TorqueConstant, ExternalDisturbance],
    told_apart_by: "the same motion slowed down until the effort stays below the level",
    source: "clamp of the command",
};
