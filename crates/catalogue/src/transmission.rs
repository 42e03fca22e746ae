//! Transmission: between motor and link.

use crate::entry::{EffectEntry, POSITION, TORQUE, always, parameter};
use crate::family::Family;
use crate::kind::EffectKind::{
    ActuatorDelay, ActuatorLag, Backlash, CoulombFriction, DifferentialCoupling, EncoderOffset,
    JointElasticity, PreslidingFriction, RotorInertia, StribeckFriction, TorqueConstant,
    TorqueRipple, TransmissionRatio,
};

pub(crate) const BACKLASH: EffectEntry = EffectEntry {
    kind: Backlash,
    family: Family::Transmission,
    words: "backlash",
    summary: "play between motor and link",
    equation: "no torque while |theta - q| < gap / 2, theta the position of the motor",
    parameters: &[parameter("gap", POSITION, "play from one end to the other", (0.0002, 0.003))],
    signature: "where the load changes sign, the motor moves by the gap without the link",
    needs: "motion in which the torque carried changes sign; \
            a second encoder at the link shows much smaller gaps",
    confused_with: &[CoulombFriction, StribeckFriction, PreslidingFriction, JointElasticity],
    told_apart_by: "reversals without load, and under a gravity load that keeps the gap closed; \
                    a second encoder at the link shows the gap itself",
    source: "Nordin & Gutman 2002",
};

pub(crate) const JOINT_ELASTICITY: EffectEntry = EffectEntry {
    kind: JointElasticity,
    family: Family::Transmission,
    words: "joint elasticity",
    summary: "a spring between motor and link",
    equation: "stiffness (theta - q) + damping (thetad - qd) at the link, theta the motor's",
    parameters: &[
        parameter("stiffness", ["N m/rad", "N/m"], "torque per unit of twist", (320.0, 5.9e4)),
        parameter(
            "damping",
            ["N m s/rad", "N s/m"],
            "torque per unit of the speed of twist",
            (0.06, 30.0),
        ),
    ],
    signature: "an antiresonance and a resonance; motor and link part with the torque",
    needs: "motion up to the resonance, or a second encoder at the link",
    confused_with: &[PreslidingFriction, Backlash, TorqueRipple, ActuatorLag, ActuatorDelay],
    told_apart_by: "a chirp from 1 to 60 Hz, with and without a payload: resonances move; \
                    a second encoder at the link shows the twist itself",
    source: "Spong 1987",
};

pub(crate) const DIFFERENTIAL_COUPLING: EffectEntry = EffectEntry {
    kind: DifferentialCoupling,
    family: Family::Transmission,
    words: "differential coupling",
    summary: "friction of motors shared by two joints",
    equation: "T^T (level_sum, level_difference) sign(T (qd_a, qd_b)), T = (1 ratio; 1 -ratio)",
    parameters: &[
        parameter(
            "ratio",
            always("1"),
            "turn of a motor by joint b over that by joint a",
            (0.5, 1.0),
        ),
        parameter(
            "level_sum",
            TORQUE,
            "friction of the motor that turns with the sum, at joint a",
            (0.15, 1.3),
        ),
        parameter(
            "level_difference",
            TORQUE,
            "friction of the motor that turns with the difference, at joint a",
            (0.15, 1.3),
        ),
        parameter(
            "viscous_sum",
            ["N m s/rad", "N s/m"],
            "viscous friction of the motor that turns with the sum, at joint a",
            (0.0, 2.4),
        ),
        parameter(
            "viscous_difference",
            ["N m s/rad", "N s/m"],
            "viscous friction of the motor that turns with the difference, at joint a",
            (0.0, 2.4),
        ),
    ],
    signature: "friction at one joint of a pair changes when the other begins to move",
    needs: "both joints of a differential pair in motion, together and alone",
    confused_with: &[CoulombFriction],
    told_apart_by: "each joint alone, then both so that one motor turns and one rests",
    source: "virtual work over the differential",
};

pub(crate) const TRANSMISSION_RATIO: EffectEntry = EffectEntry {
    kind: TransmissionRatio,
    family: Family::Transmission,
    words: "transmission ratio",
    summary: "a gear ratio that is not the stated one",
    equation: "ratio tau(ratio q, ratio qd, ratio qdd) - tau(q, qd, qdd)",
    parameters: &[parameter(
        "ratio",
        always("1"),
        "true over reported position, and effort over true torque",
        (0.957, 1.043),
    )],
    signature: "torque is off by a factor, gravity torque by more the farther from zero",
    needs: "the whole range of the joint",
    confused_with: &[TorqueConstant, EncoderOffset, RotorInertia],
    told_apart_by: "both end stops of the joint, or poses measured from outside, far from zero; \
                    a second encoder at the link",
    source: "equal power on both sides of the gear",
};
