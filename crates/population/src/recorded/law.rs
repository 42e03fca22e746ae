use std::f64::consts::TAU;

use logs::Run;
use robot::Robot;

use crate::recorded::point_mass::{PointMass, point_mass_torque};
use crate::recorded::signals::{at, velocity};

/// Speed below which dry friction is proportional to it (rad/s or m/s), since clock and encoder do not resolve
/// the direction of slower motion.
const CREEP: f64 = 0.01;

/// The torque that a cause adds to efforts, as a closed form of the columns of a log.
///
/// `q` and `effort` are the columns, `qd` is the slope of `q` over 20 ms to either side, and
/// `dry(qd) = qd / 0.01 rad/s`, limited to -1 and 1. Units are SI. A positive torque increases the effort of the
/// drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AddedLaw {
    /// `level dry(qd)`.
    Coulomb {
        /// Level (N m).
        level: f64,
    },
    /// `viscous qd`.
    Viscous {
        /// Torque per velocity (N m s/rad).
        viscous: f64,
    },
    /// `forward dry(qd)` for `qd > 0`, `backward dry(qd)` for `qd < 0`.
    Asymmetric {
        /// Level against positive motion (N m).
        forward: f64,
        /// Level against negative motion (N m).
        backward: f64,
    },
    /// `offset`.
    Offset {
        /// Torque (N m).
        offset: f64,
    },
    /// `(gain - 1) effort`.
    Gain {
        /// Reported effort per unit of torque.
        gain: f64,
    },
    /// `stiffness (q - rest)`.
    Spring {
        /// Torque per displacement (N m/rad).
        stiffness: f64,
        /// Position at which the spring is slack (rad).
        rest: f64,
    },
    /// `coefficient |effort| dry(qd)`.
    Load {
        /// Friction per torque carried.
        coefficient: f64,
    },
    /// `amplitude sin(periods q + phase)`, where a turn of the joint has `periods` periods.
    Ripple {
        /// Amplitude (N m).
        amplitude: f64,
        /// Periods in a turn of the joint.
        periods: f64,
        /// Phase at position zero (rad).
        phase: f64,
    },
    /// `coefficient qd |qd|`, drag with the square of speed.
    Drag {
        /// Torque per square of velocity (N m s²/rad²).
        coefficient: f64,
    },
    /// `peak x exp((1 - x²) / 2)` with `x = (q - centre) / width`: a magnet's pull back into a narrow well,
    /// largest, `peak`, a width from its middle.
    Well {
        /// Largest torque (N m).
        peak: f64,
        /// Middle of the well (rad).
        centre: f64,
        /// Distance from the middle at which the torque is largest (rad).
        width: f64,
    },
    /// The torque of a point mass on the last link at all joints, see [`point_mass_torque`].
    PointMass(PointMass),
    /// `effort(t - skew) - effort(t)` at all joints, linear between rows and held at the ends.
    Late {
        /// Time by which efforts come later (s).
        skew: f64,
    },
}

impl AddedLaw {
    /// The torque that it adds to each joint of a run; a law of one joint acts at `joint`.
    pub fn torque(&self, robot: &Robot, run: &Run, joint: usize) -> Vec<Vec<f64>> {
        match self {
            Self::PointMass(body) => point_mass_torque(robot, run, body),
            Self::Late { skew } => {
                let late = |effort: &Vec<f64>| -> Vec<f64> {
                    let before = |t: &f64| at(&run.time, effort, t - skew);
                    run.time.iter().zip(effort).map(|(t, now)| before(t) - now).collect()
                };
                run.joints.iter().map(|channels| late(&channels.effort)).collect()
            }
            _ => {
                let mut all = vec![vec![0.0; run.time.len()]; run.joints.len()];
                if let (Some(torque), Some(channels)) = (all.get_mut(joint), run.joints.get(joint))
                {
                    let qd = velocity(&run.time, &channels.position);
                    let rows = channels.position.iter().zip(&qd).zip(&channels.effort);
                    for (torque, ((q, qd), effort)) in torque.iter_mut().zip(rows) {
                        *torque = self.of_row(*q, *qd, *effort);
                    }
                }
                all
            }
        }
    }

    /// The torque of a law of one joint in one row; 0 for laws of all joints.
    fn of_row(&self, q: f64, qd: f64, effort: f64) -> f64 {
        match *self {
            Self::Coulomb { level } => level * dry(qd),
            Self::Viscous { viscous } => viscous * qd,
            Self::Asymmetric { forward, backward } => {
                forward * dry(qd).max(0.0) + backward * dry(qd).min(0.0)
            }
            Self::Offset { offset } => offset,
            Self::Gain { gain } => (gain - 1.0) * effort,
            Self::Spring { stiffness, rest } => stiffness * (q - rest),
            Self::Load { coefficient } => coefficient * effort.abs() * dry(qd),
            Self::Ripple { amplitude, periods, phase } => amplitude * (periods * q + phase).sin(),
            Self::Drag { coefficient } => coefficient * qd * qd.abs(),
            Self::Well { peak, centre, width } => {
                let x = (q - centre) / width;
                peak * x * (0.5 * (1.0 - x * x)).exp()
            }
            Self::PointMass(_) | Self::Late { .. } => 0.0,
        }
    }

    /// The same law with its torque, or its skew, scaled by `factor`.
    pub(super) fn times(self, factor: f64) -> Self {
        match self {
            Self::Coulomb { level } => Self::Coulomb { level: factor * level },
            Self::Viscous { viscous } => Self::Viscous { viscous: factor * viscous },
            Self::Asymmetric { forward, backward } => {
                Self::Asymmetric { forward: factor * forward, backward: factor * backward }
            }
            Self::Offset { offset } => Self::Offset { offset: factor * offset },
            Self::Gain { gain } => Self::Gain { gain: 1.0 + factor * (gain - 1.0) },
            Self::Spring { stiffness, rest } => {
                Self::Spring { stiffness: factor * stiffness, rest }
            }
            Self::Load { coefficient } => Self::Load { coefficient: factor * coefficient },
            Self::Ripple { amplitude, periods, phase } => {
                Self::Ripple { amplitude: factor * amplitude, periods, phase }
            }
            Self::Drag { coefficient } => Self::Drag { coefficient: factor * coefficient },
            Self::Well { peak, centre, width } => Self::Well { peak: factor * peak, centre, width },
            Self::PointMass(body) => {
                Self::PointMass(PointMass { mass: factor * body.mass, ..body })
            }
            Self::Late { skew } => Self::Late { skew: factor * skew },
        }
    }
}

/// Direction of a motion, in proportion to its velocity where it creeps.
pub(super) fn dry(qd: f64) -> f64 {
    (qd / CREEP).clamp(-1.0, 1.0)
}

/// Highest number of periods per turn that a log resolves, with six samples per period at the given speed
/// (rad/s).
pub(super) fn most_periods(rate_hz: f64, speed: f64) -> f64 {
    const SAMPLES: f64 = 6.0;
    TAU * rate_hz / (SAMPLES * speed)
}
