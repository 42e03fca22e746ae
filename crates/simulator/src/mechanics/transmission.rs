use robot::Actuator;

/// Damping of a described transmission whose damping is unknown, as a share of critical damping against the
/// rotor. Cable drives and harmonic gears have 0.5 to 5 %.
const DAMPING_RATIO: f64 = 0.02;

/// The transmission between motor and link of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Transmission {
    /// Torque per unit of deflection (N m/rad or N/m); `None` for a rigid one.
    pub stiffness: Option<f64>,
    /// Torque per unit of deflection velocity (N m s/rad or N s/m).
    pub damping: f64,
    /// Free play between motor and link, full width (rad or m).
    pub gap: f64,
}

impl Transmission {
    /// The transmission of a described actuator: its stiffness, its free play, and its damping, or 2 % of critical
    /// damping.
    pub fn of_actuator(actuator: &Actuator) -> Self {
        let inertia = actuator.rotor_inertia;
        let damping = |stiffness| {
            actuator
                .elasticity_damping
                .unwrap_or_else(|| damping(DAMPING_RATIO, stiffness, inertia))
        };
        Self {
            stiffness: actuator.elasticity,
            damping: actuator.elasticity.map_or(0.0, damping),
            gap: actuator.backlash,
        }
    }

    /// Static deflection of the link against its motor under a load (rad or m), negative for a positive
    /// load:
    ///
    /// ```text
    /// q - theta = -(load / stiffness + (gap / 2) sign(load))
    /// ```
    pub fn deflection_under(&self, load: f64) -> f64 {
        if load.abs() <= 0.0 {
            return 0.0;
        }
        -(self.stiffness.map_or(0.0, |k| load / k) + 0.5 * self.gap.copysign(load))
    }

    /// Torque on the link from an elastic transmission with free play (N m or N):
    ///
    /// ```text
    /// outside the gap: -k (delta -+ gap/2) - d delta_dot, never pulling;  inside: 0
    /// ```
    pub(crate) fn contact(&self, deflection: f64, velocity: f64) -> f64 {
        let half = 0.5 * self.gap;
        let pressed = deflection - deflection.clamp(-half, half);
        if pressed.abs() <= 0.0 {
            return 0.0;
        }
        let torque = -self.stiffness.unwrap_or(0.0) * pressed - self.damping * velocity;
        if pressed > 0.0 { torque.min(0.0) } else { torque.max(0.0) }
    }

    /// Whether motor and link are rigidly coupled.
    pub fn is_rigid(&self) -> bool {
        self.stiffness.is_none() && self.gap <= 0.0
    }
}

/// Damping (N m s/rad or N s/m) that is `ratio` of critical for a rotor on a spring:
///
/// ```text
/// d = 2 ratio sqrt(k J)
/// ```
pub(crate) fn damping(ratio: f64, stiffness: f64, rotor_inertia: f64) -> f64 {
    2.0 * ratio * (stiffness * rotor_inertia.max(0.0)).sqrt()
}
