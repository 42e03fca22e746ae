//! Friction: what resists the motion of one joint.

use crate::entry::{EffectEntry, TORQUE, always, parameter, phase};
use crate::family::Family;
use crate::kind::EffectKind::{
    ActuatorDelay, ActuatorLag, AsymmetricFriction, Backlash, CableSpring, CoulombFriction,
    DifferentialCoupling, FrictionTemperatureDrift, GoalDelay, JointElasticity,
    LoadDependentFriction, PositionDependentFriction, PreslidingFriction, StribeckFriction,
    TimeSkew, TorqueConstant, TorqueOffset, TorqueRipple, ViscousFriction,
};

pub(crate) const VISCOUS: EffectEntry = EffectEntry {
    kind: ViscousFriction,
    family: Family::Friction,
    words: "viscous friction",
    summary: "torque proportional to velocity",
    equation: "viscous qd",
    parameters: &[parameter(
        "viscous",
        ["N m s/rad", "N s/m"],
        "friction torque per unit of velocity",
        (0.25, 2.4),
    )],
    signature: "the residual grows in proportion to velocity and vanishes at rest",
    needs: "motion at more than one speed",
    confused_with: &[
        CoulombFriction,
        FrictionTemperatureDrift,
        ActuatorLag,
        ActuatorDelay,
        TimeSkew,
        GoalDelay,
    ],
    told_apart_by: "constant speeds, slow and fast, in both directions",
    source: "Armstrong-Helouvry, Dupont & Canudas de Wit 1994",
};

pub(crate) const COULOMB: EffectEntry = EffectEntry {
    kind: CoulombFriction,
    family: Family::Friction,
    words: "Coulomb friction",
    summary: "constant torque against the motion",
    equation: "coulomb sign(qd)",
    parameters: &[parameter("level", TORQUE, "friction torque while moving", (0.35, 2.7))],
    signature: "the residual jumps when the joint reverses, whatever the speed",
    needs: "reversals",
    confused_with: &[
        ViscousFriction,
        AsymmetricFriction,
        StribeckFriction,
        PreslidingFriction,
        LoadDependentFriction,
        PositionDependentFriction,
        FrictionTemperatureDrift,
        Backlash,
        DifferentialCoupling,
    ],
    told_apart_by: "constant speeds, slow and fast, in both directions",
    source: "Armstrong-Helouvry, Dupont & Canudas de Wit 1994",
};

pub(crate) const ASYMMETRIC: EffectEntry = EffectEntry {
    kind: AsymmetricFriction,
    family: Family::Friction,
    words: "asymmetric friction",
    summary: "dry friction that differs by direction",
    equation: "forward for qd > 0, -backward for qd < 0",
    parameters: &[
        parameter("forward", TORQUE, "friction torque against positive motion", (0.35, 2.7)),
        parameter("backward", TORQUE, "friction torque against negative motion", (0.35, 2.7)),
    ],
    signature: "the jump at a reversal is not centred on zero, and the shift is gone at standstill",
    needs: "reversals and standstill",
    confused_with: &[CoulombFriction, TorqueOffset, CableSpring, TorqueConstant],
    told_apart_by: "a dwell of a second or more at standstill between motions in both directions",
    source: "Armstrong-Helouvry, Dupont & Canudas de Wit 1994",
};

pub(crate) const STRIBECK: EffectEntry = EffectEntry {
    kind: StribeckFriction,
    family: Family::Friction,
    words: "Stribeck friction",
    summary: "dry friction that is largest near rest",
    equation: "(coulomb + (breakaway - coulomb) exp(-(qd / stribeck_velocity)^2)) sign(qd)",
    parameters: &[
        parameter("coulomb", TORQUE, "friction torque at higher speed", (0.35, 2.7)),
        parameter("breakaway", TORQUE, "torque that starts a joint at rest", (0.5, 3.3)),
        parameter(
            "stribeck_velocity",
            ["rad/s", "m/s"],
            "velocity at which 1/e of the excess over Coulomb is left",
            (0.01, 0.1),
        ),
    ],
    signature: "slow motion needs more torque than fast motion, and may stick and slip",
    needs: "reversals and speeds below a tenth of a radian a second",
    confused_with: &[CoulombFriction, PreslidingFriction, Backlash, TorqueRipple],
    told_apart_by: "constant speeds from 0.001 to 0.3 rad/s in equal ratios, in both directions",
    source: "Armstrong-Helouvry, Dupont & Canudas de Wit 1994",
};

pub(crate) const PRESLIDING: EffectEntry = EffectEntry {
    kind: PreslidingFriction,
    family: Family::Friction,
    words: "presliding friction",
    summary: "dry friction, springy before it slides",
    equation: "stiffness z + damping zd, zd = qd - stiffness |qd| z / level",
    parameters: &[
        parameter(
            "stiffness",
            ["N m/rad", "N/m"],
            "stiffness of the bristles, z their deflection",
            (300.0, 1e4),
        ),
        parameter("level", TORQUE, "friction torque while sliding", (0.35, 2.7)),
        parameter("damping", ["N m s/rad", "N s/m"], "damping of the bristles", (2.0, 250.0)),
    ],
    signature: "after a reversal the torque follows the position for a while before it settles",
    needs: "reversals, with positions finer than a tenth of a milliradian",
    confused_with: &[CoulombFriction, StribeckFriction, Backlash, JointElasticity, CableSpring],
    told_apart_by: "slow sinusoids below a milliradian: the loop is closed and keeps its shape",
    source: "Canudas de Wit, Olsson, Astrom & Lischinsky 1995",
};

pub(crate) const LOAD_DEPENDENT: EffectEntry = EffectEntry {
    kind: LoadDependentFriction,
    family: Family::Friction,
    words: "load-dependent friction",
    summary: "dry friction that grows with the load",
    equation: "coefficient |load| sign(qd), load the torque that the joint carries",
    parameters: &[parameter(
        "coefficient",
        always("1"),
        "friction torque per unit of torque carried",
        (0.01, 0.1),
    )],
    signature: "the jump at a reversal grows with the gravity torque",
    needs: "reversals under different loads",
    confused_with: &[CoulombFriction, PositionDependentFriction, TorqueConstant],
    told_apart_by: "slow sweeps both ways over the same positions, with and without a payload",
    source: "Bittencourt & Gunnarsson 2012",
};

pub(crate) const POSITION_DEPENDENT: EffectEntry = EffectEntry {
    kind: PositionDependentFriction,
    family: Family::Friction,
    words: "position-dependent friction",
    summary: "dry friction that varies with position",
    equation: "level (1 + share cos(periods_per_turn q + phase)) sign(qd)",
    parameters: &[
        parameter("level", TORQUE, "friction torque, mean over the positions", (0.35, 2.7)),
        parameter("share", always("1"), "amplitude of its variation over its mean", (0.1, 0.5)),
        parameter(
            "periods_per_turn",
            ["1", "rad/m"],
            "periods in a turn of the joint, or phase per metre of its way",
            (1.0, 42.0),
        ),
        phase("phase at position zero"),
    ],
    signature: "the jump at a reversal depends on where it happens",
    needs: "reversals all over the range of the joint",
    confused_with: &[CoulombFriction, LoadDependentFriction, CableSpring, TorqueRipple],
    told_apart_by: "slow sweeps both ways over the whole range, with and without a payload",
    source: "Armstrong-Helouvry, Dupont & Canudas de Wit 1994",
};

pub(crate) const TEMPERATURE_DRIFT: EffectEntry = EffectEntry {
    kind: FrictionTemperatureDrift,
    family: Family::Friction,
    words: "friction temperature drift",
    summary: "friction that falls as the drive warms",
    equation: "-(viscous_lost qd + coulomb_lost sign(qd)) (1 - exp(-t / time_constant))",
    parameters: &[
        parameter(
            "viscous_lost",
            ["N m s/rad", "N s/m"],
            "viscous friction that a warm drive has lost",
            (0.02, 2.0),
        ),
        parameter(
            "coulomb_lost",
            TORQUE,
            "Coulomb friction that a warm drive has lost",
            (0.02, 4.0),
        ),
        parameter("time_constant", always("s"), "time constant of warming up", (300.0, 2400.0)),
        parameter(
            "share",
            always("1"),
            "share of the cold friction at 1 rad/s lost when warm",
            (0.05, 0.6),
        ),
    ],
    signature: "friction is largest at the start of a session and falls to a constant",
    needs: "the same motion at the start of a session and half an hour later",
    confused_with: &[ViscousFriction, CoulombFriction, TorqueConstant],
    told_apart_by: "one motion repeated for an hour, from cold, with dwells under gravity load",
    source: "Bittencourt & Gunnarsson 2012",
};
