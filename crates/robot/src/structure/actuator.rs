use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::structure::control::PdGain;

/// Where the position of a joint is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SensingSide {
    /// At the motor, before transmission and elasticity.
    Motor,
    /// At the link, after the transmission.
    Link,
    /// Not stated; where the two sides differ it counts as the motor's.
    #[default]
    Unknown,
}

/// What the `effort` of a log is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum TorqueSource {
    /// A torque sensor at the joint.
    Measured,
    /// The torque that was commanded.
    Commanded,
    /// Motor current times a torque constant.
    Current,
    /// Not stated.
    #[default]
    Unknown,
}

/// Dry friction near rest beyond the Coulomb level.
///
/// ```text
/// excess exp(-(qd / velocity)²)
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stribeck {
    /// Breakaway minus Coulomb level, not below 0 (N·m or N).
    pub excess: f64,
    /// Velocity at which 1/e of the excess is left (rad/s or m/s).
    pub velocity: f64,
}

/// How the Coulomb level varies with the position of the motor.
///
/// ```text
/// 1 + share cos(periods q + phase)
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrictionWave {
    /// Amplitude over the mean, from 0 to 1.
    pub share: f64,
    /// Periods in a turn of the joint; phase per way at a prismatic one (rad/m).
    pub periods: f64,
    /// Phase at position zero (rad).
    pub phase: f64,
}

/// Cogging and torque ripple: torque that depends on the position of the motor alone.
///
/// ```text
/// amplitude sin(periods q + phase)
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ripple {
    /// Amplitude (N·m or N).
    pub amplitude: f64,
    /// Periods in a turn of the joint; phase per way at a prismatic one (rad/m).
    pub periods: f64,
    /// Phase at position zero (rad).
    pub phase: f64,
}

/// A spring or counterweight that balances part of the weight of a link.
///
/// ```text
/// amplitude sin(q + phase)
/// ```
///
/// A spring of stiffness `k` and no free length between points at `a` and `b` from the axis gives
/// `amplitude = k a b`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CounterbalanceTerm {
    /// Largest torque that the drive needs against it (N·m).
    pub amplitude: f64,
    /// Phase at position zero (rad).
    pub phase: f64,
}

/// Friction that falls while a drive warms up.
///
/// ```text
/// viscous(t) = viscous - viscous_lost (1 - exp(-t / time_constant))
/// coulomb(t) = coulomb - coulomb_lost (1 - exp(-t / time_constant))
/// ```
///
/// `t` is the time since the drive was cold.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Warming {
    /// Viscous friction of the cold drive minus that of the warm one (N·m·s/rad or N·s/m).
    pub viscous_lost: f64,
    /// Coulomb friction of the cold drive minus that of the warm one, in both directions (N·m or N).
    pub coulomb_lost: f64,
    /// Time constant of warming up (s).
    pub time_constant_s: f64,
}

/// A differential: two motors that drive this joint and another one together.
///
/// ```text
/// w_sum = qd + ratio qd_other,   w_difference = qd - ratio qd_other
/// friction(w) = viscous w + level sign(w) + inertia wd
/// tau       += friction_sum + friction_difference
/// tau_other += ratio (friction_sum - friction_difference)
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coupling {
    /// Index of the other joint.
    pub other: usize,
    /// Motor rotation per unit of the other joint over motor rotation per unit of this joint.
    pub ratio: f64,
    /// Dry friction of the sum motor and of the difference motor, referred to this joint (N·m or N).
    pub level: [f64; 2],
    /// Their viscous friction (N·m·s/rad or N·s/m).
    pub viscous: [f64; 2],
}

/// The drive of one joint: what it adds to the rigid-body torque, and how its sensors report it.
///
/// With `tau_rb` the rigid-body torque, the model expects this effort in a log:
///
/// ```text
/// load   = tau_rb + spring_stiffness x + spring_cubic x³ + h + counterbalance(q),   x = q - spring_rest
/// dh     = spring_stiffness dq while |h| < spring_hysteresis, else 0
/// tau    = load + rotor_inertia qdd + viscous qd + level s + ripple(q)
///          + presliding_damping (qd - |qd| s)
/// effort = transmission_ratio torque_gain tau + torque_offset
///
/// level  = coulomb (1 + friction_wave(q)) + stribeck(qd) + load_friction |load|
/// coulomb = coulomb_forward for s > 0, coulomb_backward for s < 0
/// s       = sign(qd), 0 at rest; with presliding ds = (dq - |dq| s) / presliding
/// ```
///
/// [`FrictionWave`], [`Stribeck`], [`Warming`], [`Ripple`] and [`CounterbalanceTerm`] define the other terms.
/// `viscous` and `coulomb` are those of the cold drive. `tau_rb`, the spring and the counterbalance
/// act at the link, all other terms at the motor.
///
/// The transmission between motor and link may be compliant, and the torque may lag its command.
/// With `theta` the motor position referred to the joint,
///
/// ```text
/// theta - q = s + x,   elasticity s + elasticity_damping sd = load,   |x| <= backlash / 2
/// lag d(tau)/dt + tau = command(t - delay)
/// ```
///
/// A sensor may be mounted or configured wrongly. With `q` the true position,
///
/// ```text
/// q_reported = q / transmission_ratio + encoder_offset,   qd_reported = qd / transmission_ratio
/// ```
///
/// The log may record efforts late: `effort_logged(t) = effort(t - effort_skew)`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Actuator {
    /// Inertia of rotor and gear referred to the joint (kg m² or kg).
    pub rotor_inertia: f64,
    /// Viscous friction (N·m·s/rad or N·s/m).
    pub viscous: f64,
    /// Coulomb friction against positive motion (N·m or N).
    pub coulomb_forward: f64,
    /// Coulomb friction against negative motion (N·m or N).
    pub coulomb_backward: f64,
    /// Dry friction near rest beyond the Coulomb level; `None` without it.
    pub stribeck: Option<Stribeck>,
    /// Dry friction per unit of load that the joint carries, not below 0.
    pub load_friction: f64,
    /// Displacement over which dry friction builds up after a reversal (rad or m); `None` where it
    /// acts at once.
    pub presliding: Option<f64>,
    /// Damping of the presliding displacement (N·m·s/rad or N·s/m), not below 0; `None` where it is
    /// unknown.
    pub presliding_damping: Option<f64>,
    /// Variation of the Coulomb level with position; `None` without it.
    pub friction_wave: Option<FrictionWave>,
    /// Friction lost while the drive warms up; `None` for friction that stays.
    pub warming: Option<Warming>,
    /// Torque ripple of the motor; `None` without it.
    pub ripple: Option<Ripple>,
    /// Friction of the motors shared with another joint; `None` for a motor of its own.
    pub coupling: Option<Coupling>,
    /// Stiffness of a hose or cable along the joint (N·m/rad or N/m).
    pub spring_stiffness: f64,
    /// Position at which that spring is slack (rad or m).
    pub spring_rest: f64,
    /// Torque of that spring per cube of displacement (N·m/rad³ or N/m³).
    pub spring_cubic: f64,
    /// Half the width of that spring's hysteresis loop (N·m or N), not below 0.
    pub spring_hysteresis: f64,
    /// Spring or counterweight that balances part of the weight; `None` without it.
    pub counterbalance: Option<CounterbalanceTerm>,
    /// Reported effort per unit of true torque.
    pub torque_gain: f64,
    /// Effort reported at zero torque (N·m or N).
    pub torque_offset: f64,
    /// Free play between motor and link, full width (rad or m).
    pub backlash: f64,
    /// Stiffness of the transmission (N·m/rad or N/m); `None` for a rigid one.
    pub elasticity: Option<f64>,
    /// Damping of that spring (N·m·s/rad or N·s/m), above 0; `None` where it is unknown.
    pub elasticity_damping: Option<f64>,
    /// Time from command to torque (s).
    pub delay_s: f64,
    /// Time constant of the torque behind its command (s): 63 % of a step is then reached.
    pub lag_s: f64,
    /// Position reported at true position zero (rad or m).
    pub encoder_offset: f64,
    /// True over reported position. The reported effort carries the same factor on top of the gain.
    pub transmission_ratio: f64,
    /// Time by which the log records effort later than position (s).
    pub effort_skew_s: f64,
    /// Where the position is measured.
    pub sensing: SensingSide,
    /// What the log's effort is.
    pub torque_source: TorqueSource,
    /// Gains from which missing efforts are computed, `effort = kp (goal(t - goal delay) - q) - kd qd`; `None` where
    /// efforts are logged.
    pub position_loop: Option<PdGain>,
    /// Time from the row of a goal to the position loop (s), where efforts are computed from goals.
    pub goal_delay_s: f64,
    /// Time for which the position loop holds a goal (s); `None` where goals count as followed when they are logged.
    pub goal_hold_s: Option<f64>,
}

impl Actuator {
    /// Limits the friction lost by warming to the friction of the cold drive.
    pub fn limit_warming(&self, warming: Warming) -> Warming {
        let level = self.coulomb_forward.min(self.coulomb_backward);
        Warming {
            viscous_lost: warming.viscous_lost.min(self.viscous.max(0.0)),
            coulomb_lost: warming.coulomb_lost.min(level.max(0.0)),
            ..warming
        }
    }

    /// The drive `since_cold_s` seconds after a cold start, with the friction that it still loses:
    ///
    /// ```text
    /// left = exp(-since_cold / time_constant)
    /// friction' = friction - lost (1 - left),   lost' = lost left
    /// ```
    pub fn after_warming(&self, since_cold_s: f64) -> Self {
        let Some(cold) = self.warming else { return self.clone() };
        let left = (-since_cold_s.max(0.0) / cold.time_constant_s).exp();
        let Warming { viscous_lost, coulomb_lost, time_constant_s } = cold;
        let warming = Warming {
            viscous_lost: viscous_lost * left,
            coulomb_lost: coulomb_lost * left,
            time_constant_s,
        };
        Self {
            viscous: self.viscous - viscous_lost * (1.0 - left),
            coulomb_forward: self.coulomb_forward - coulomb_lost * (1.0 - left),
            coulomb_backward: self.coulomb_backward - coulomb_lost * (1.0 - left),
            warming: Some(warming),
            ..self.clone()
        }
    }
}

impl Default for Actuator {
    /// An ideal drive: no friction, no rotor, a rigid transmission, a perfect torque sensor.
    fn default() -> Self {
        Self {
            rotor_inertia: 0.0,
            viscous: 0.0,
            coulomb_forward: 0.0,
            coulomb_backward: 0.0,
            stribeck: None,
            load_friction: 0.0,
            presliding: None,
            presliding_damping: None,
            friction_wave: None,
            warming: None,
            ripple: None,
            coupling: None,
            spring_stiffness: 0.0,
            spring_rest: 0.0,
            spring_cubic: 0.0,
            spring_hysteresis: 0.0,
            counterbalance: None,
            torque_gain: 1.0,
            torque_offset: 0.0,
            backlash: 0.0,
            elasticity: None,
            elasticity_damping: None,
            delay_s: 0.0,
            lag_s: 0.0,
            encoder_offset: 0.0,
            transmission_ratio: 1.0,
            effort_skew_s: 0.0,
            sensing: SensingSide::default(),
            torque_source: TorqueSource::default(),
            position_loop: None,
            goal_delay_s: 0.0,
            goal_hold_s: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `friction(t) = cold - lost (1 - exp(-t / time_constant))`, whenever one begins to count.
    #[test]
    fn a_drive_that_has_warmed_up_goes_on_as_it_would_have() {
        let warming = Warming { viscous_lost: 0.1, coulomb_lost: 0.2, time_constant_s: 600.0 };
        let cold = Actuator {
            viscous: 0.4,
            coulomb_forward: 0.5,
            coulomb_backward: 0.3,
            warming: Some(warming),
            ..Actuator::default()
        };
        let later = cold.after_warming(200.0).after_warming(400.0);
        let share = 1.0 - (-1.0_f64).exp();
        for (found, expected) in [
            (later.viscous, 0.4 - 0.1 * share),
            (later.coulomb_forward, 0.5 - 0.2 * share),
            (later.coulomb_backward, 0.3 - 0.2 * share),
        ] {
            assert!((found - expected).abs() < 1e-15, "{found}, not {expected}");
        }
        let warm = later.after_warming(f64::INFINITY);
        assert!((warm.viscous - 0.3).abs() < 1e-15 && (warm.coulomb_backward - 0.1).abs() < 1e-15);
        assert_eq!(warm.warming.map(|w| (w.viscous_lost, w.coulomb_lost)), Some((0.0, 0.0)));
    }
}
