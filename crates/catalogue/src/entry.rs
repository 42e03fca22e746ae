use crate::EffectKind;

/// One parameter of an effect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Name, as in `diagnosis.json`.
    pub name: &'static str,
    /// Unit for a revolute joint.
    pub unit: &'static str,
    /// Unit for a prismatic joint.
    pub unit_prismatic: &'static str,
    /// What it is.
    pub meaning: &'static str,
}

/// What is known about an effect, in words.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// The effect.
    pub kind: EffectKind,
    /// What it adds to the torque.
    pub equation: &'static str,
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// How it shows in a log.
    pub signature: &'static str,
    /// What a log needs to show it.
    pub needs: &'static str,
    /// Effects that can produce the same torque.
    pub confused_with: &'static [EffectKind],
    /// The motion that tells it from those.
    pub told_apart_by: &'static str,
    /// Where the model comes from.
    pub source: &'static str,
}

const fn parameter(
    name: &'static str,
    unit: &'static str,
    unit_prismatic: &'static str,
    meaning: &'static str,
) -> Parameter {
    Parameter { name, unit, unit_prismatic, meaning }
}

const INERTIA: &[Parameter] = &[
    parameter("mass", "kg", "kg", "mass"),
    parameter("com_x", "m", "m", "centre of mass in the link frame, x"),
    parameter("com_y", "m", "m", "centre of mass in the link frame, y"),
    parameter("com_z", "m", "m", "centre of mass in the link frame, z"),
];

impl EffectKind {
    /// What is known about this effect.
    pub fn entry(self) -> Entry {
        match self {
            Self::ViscousFriction | Self::CoulombFriction | Self::AsymmetricFriction => {
                friction(self)
            }
            Self::TorqueOffset | Self::TorqueConstant => reading(self),
            Self::RotorInertia | Self::InertialParameters | Self::Payload => inertia(self),
            Self::CableSpring | Self::GravityDirection => surroundings(self),
        }
    }
}

fn friction(kind: EffectKind) -> Entry {
    use EffectKind::{
        AsymmetricFriction, CableSpring, CoulombFriction, TorqueConstant, TorqueOffset,
        ViscousFriction,
    };
    match kind {
        ViscousFriction => Entry {
            kind,
            equation: "viscous qd",
            parameters: const {
                &[parameter(
                    "viscous",
                    "N m s/rad",
                    "N s/m",
                    "friction torque per unit of velocity",
                )]
            },
            signature: "the residual grows in proportion to velocity and vanishes at rest",
            needs: "motion at more than one speed",
            confused_with: &[CoulombFriction],
            told_apart_by: "constant speeds, slow and fast, in both directions",
            source: "Armstrong-Helouvry, Dupont & Canudas de Wit 1994",
        },
        CoulombFriction => Entry {
            kind,
            equation: "coulomb sign(qd)",
            parameters: const { &[parameter("level", "N m", "N", "friction torque while moving")] },
            signature: "the residual jumps when the joint reverses, whatever the speed",
            needs: "reversals",
            confused_with: &[ViscousFriction, AsymmetricFriction],
            told_apart_by: "constant speeds, slow and fast, in both directions",
            source: "Armstrong-Helouvry, Dupont & Canudas de Wit 1994",
        },
        _ => Entry {
            kind: AsymmetricFriction,
            equation: "forward for qd > 0, -backward for qd < 0",
            parameters: const {
                &[
                    parameter("forward", "N m", "N", "friction torque against positive motion"),
                    parameter("backward", "N m", "N", "friction torque against negative motion"),
                ]
            },
            signature: "the jump at a reversal is not centred on zero, and the shift is gone at standstill",
            needs: "reversals and standstill",
            confused_with: &[CoulombFriction, TorqueOffset, CableSpring, TorqueConstant],
            told_apart_by: "a dwell of a second or more at standstill between motions in both directions",
            source: "Armstrong-Helouvry, Dupont & Canudas de Wit 1994",
        },
    }
}

fn reading(kind: EffectKind) -> Entry {
    use EffectKind::{
        AsymmetricFriction, CableSpring, GravityDirection, InertialParameters, Payload,
        TorqueConstant, TorqueOffset,
    };
    match kind {
        TorqueOffset => Entry {
            kind,
            equation: "offset",
            parameters: const { &[parameter("offset", "N m", "N", "effort reported at zero torque")] },
            signature: "the residual has a mean that depends on nothing",
            needs: "poses with different gravity torque",
            confused_with: &[
                AsymmetricFriction,
                CableSpring,
                InertialParameters,
                Payload,
                GravityDirection,
            ],
            told_apart_by: "static poses on both sides of the vertical, where gravity changes sign and an offset does not",
            source: "Sousa & Cortesao 2014",
        },
        _ => Entry {
            kind: TorqueConstant,
            equation: "torque_gain tau",
            parameters: const { &[parameter("gain", "1", "1", "reported effort per unit of torque")] },
            signature: "every term of the joint's torque is off by the same factor",
            needs: "a known load",
            confused_with: &[InertialParameters, Payload, AsymmetricFriction],
            told_apart_by: "the same motion with and without a payload of known mass",
            source: "Gautier & Briot 2014",
        },
    }
}

fn inertia(kind: EffectKind) -> Entry {
    use EffectKind::{
        CableSpring, GravityDirection, InertialParameters, Payload, RotorInertia, TorqueConstant,
        TorqueOffset,
    };
    match kind {
        RotorInertia => Entry {
            kind,
            equation: "rotor_inertia qdd",
            parameters: const {
                &[parameter(
                    "inertia",
                    "kg m^2",
                    "kg",
                    "inertia of rotor and gear seen at the joint",
                )]
            },
            signature: "the residual follows the joint's own acceleration, whatever the pose",
            needs: "acceleration in poses with different mass matrix",
            confused_with: &[InertialParameters],
            told_apart_by: "the same acceleration with the arm stretched and folded",
            source: "Featherstone 2008",
        },
        Payload => Entry {
            kind,
            equation: "Y_last(q, qd, qdd) pi_payload",
            parameters: INERTIA,
            signature: "gravity torque changes at every joint between the base and the last link",
            needs: "poses with different gravity torque",
            confused_with: &[InertialParameters, TorqueOffset, GravityDirection, TorqueConstant],
            told_apart_by: "the same motion before and after the load is put on",
            source: "Gautier & Khalil 1990",
        },
        _ => Entry {
            kind: InertialParameters,
            equation: "Y_link(q, qd, qdd) (pi - pi_nominal)",
            parameters: INERTIA,
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
            ],
            told_apart_by: "an exciting motion over the whole range of every joint",
            source: "Gautier & Khalil 1990; Wensing, Kim & Slotine 2018",
        },
    }
}

fn surroundings(kind: EffectKind) -> Entry {
    use EffectKind::{
        AsymmetricFriction, CableSpring, GravityDirection, InertialParameters, Payload,
        TorqueOffset,
    };
    match kind {
        CableSpring => Entry {
            kind,
            equation: "stiffness (q - rest)",
            parameters: const {
                &[
                    parameter("stiffness", "N m/rad", "N/m", "torque per unit of displacement"),
                    parameter("rest", "rad", "m", "position at which the spring is slack"),
                ]
            },
            signature: "the residual follows the joint's own position and no other joint's",
            needs: "a wide range of the joint, in different poses of the others",
            confused_with: &[InertialParameters, TorqueOffset, AsymmetricFriction],
            told_apart_by: "a sweep over the whole range, where gravity follows a sine and a spring does not",
            source: "linear elasticity",
        },
        _ => Entry {
            kind: GravityDirection,
            equation: "G(q) (g - g_nominal)",
            parameters: const {
                &[
                    parameter("tilt_1", "rad", "rad", "tilt about the first horizontal axis"),
                    parameter("tilt_2", "rad", "rad", "tilt about the second horizontal axis"),
                ]
            },
            signature: "a joint with a vertical axis carries a gravity torque",
            needs: "a sweep of the first joint with the arm stretched",
            confused_with: &[InertialParameters, TorqueOffset, Payload],
            told_apart_by: "a full turn of the first joint with the arm stretched out",
            source: "Featherstone 2008",
        },
    }
}
