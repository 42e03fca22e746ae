use crate::entry::EffectEntry;
use crate::family::Family;
use crate::kind::EffectKind;
use crate::{drive, environment, friction, inertia, sensing, transmission};

impl EffectKind {
    /// The description of this effect.
    pub const fn entry(self) -> &'static EffectEntry {
        match self {
            Self::ViscousFriction => &friction::VISCOUS,
            Self::CoulombFriction => &friction::COULOMB,
            Self::AsymmetricFriction => &friction::ASYMMETRIC,
            Self::StribeckFriction => &friction::STRIBECK,
            Self::PreslidingFriction => &friction::PRESLIDING,
            Self::LoadDependentFriction => &friction::LOAD_DEPENDENT,
            Self::PositionDependentFriction => &friction::POSITION_DEPENDENT,
            Self::FrictionTemperatureDrift => &friction::TEMPERATURE_DRIFT,
            Self::Backlash => &transmission::BACKLASH,
            Self::JointElasticity => &transmission::JOINT_ELASTICITY,
            Self::RotorInertia => &inertia::ROTOR_INERTIA,
            Self::DifferentialCoupling => &transmission::DIFFERENTIAL_COUPLING,
            Self::Payload => &inertia::PAYLOAD,
            Self::InertialParameters => &inertia::INERTIAL_PARAMETERS,
            Self::GravityDirection => &environment::GRAVITY_DIRECTION,
            Self::CableSpring => &environment::CABLE_SPRING,
            Self::TorqueRipple => &drive::TORQUE_RIPPLE,
            Self::TorqueConstant => &drive::TORQUE_CONSTANT,
            Self::TorqueOffset => &drive::TORQUE_OFFSET,
            Self::ActuatorLag => &drive::ACTUATOR_LAG,
            Self::ActuatorDelay => &drive::ACTUATOR_DELAY,
            Self::TorqueSaturation => &drive::TORQUE_SATURATION,
            Self::EncoderOffset => &sensing::ENCODER_OFFSET,
            Self::TransmissionRatio => &transmission::TRANSMISSION_RATIO,
            Self::TimeSkew => &sensing::TIME_SKEW,
            Self::ExternalDisturbance => &environment::EXTERNAL_DISTURBANCE,
            Self::GoalDelay => &drive::GOAL_DELAY,
            Self::Counterbalance => &environment::COUNTERBALANCE,
        }
    }

    /// The family.
    pub const fn family(self) -> Family {
        self.entry().family
    }

    /// The name in words, for sentences.
    pub const fn words(self) -> &'static str {
        self.entry().words
    }

    /// The motion that distinguishes it from `rivals`; `None` without rivals. With a payload among them it is the
    /// payload's, since only a second log can decide then.
    pub fn distinguishing_motion(
        self,
        rivals: impl IntoIterator<Item = Self>,
    ) -> Option<&'static str> {
        let mut rivals = rivals.into_iter().peekable();
        rivals.peek()?;
        let payload = rivals.find(|kind| *kind == Self::Payload);
        Some(payload.unwrap_or(self).entry().told_apart_by)
    }

    /// Code and name in words, such as `FR02 Coulomb friction`.
    pub fn label(self) -> String {
        format!("{} {}", self.code(), self.words())
    }
}
