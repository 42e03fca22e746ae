use std::collections::BTreeMap;
use std::f64::consts::PI;

use nalgebra::Vector3;

use crate::motion_samples::MotionSamples;
use crate::observation::{CountedTogether, ObservationKind, Rival};

/// A way to read logs other than as they stand.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LogReading {
    /// As they stand.
    AsIs,
    /// The effort of a joint, or of all of them, has the other sign.
    EffortSign(Option<usize>),
    /// The position of a joint, or of all of them, has the other sign.
    PositionSign(Option<usize>),
    /// Position and effort of a joint are counted the other way round than its axis is described.
    AxisSign(usize),
    /// The logged position of a joint is so much more than the true one (rad).
    Offset(usize, f64),
    /// The position of a joint is counted together with that of the joint before it.
    CountedTogether(CountedTogether),
    /// Two joints have each other's columns.
    Exchanged(usize, usize),
    /// Two joints have each other's effort.
    EffortsExchanged(usize, usize),
    /// The position of a joint, or of all of them, is degrees.
    Degrees(Option<usize>),
    /// Logged efforts per N m (or N) of each joint; `None` where they are in another unit and do not show it.
    Unit(Vec<Option<f64>>),
    /// The position loop of each joint follows the velocity of its goal, and damps the difference: `kd / kp` (s), zero where
    /// there is none.
    GoalVelocity(Vec<f64>),
    /// The efforts lack the torque of gravity.
    WithoutGravity,
    /// Acceleration of free fall in the base frame (m/s²).
    Gravity(Vector3<f64>),
    /// Logged time per second.
    Time(f64),
    /// Joints that are locked stand elsewhere than described: name and position (rad).
    LockedAt(BTreeMap<String, f64>),
}

impl LogReading {
    /// The samples as this reading has them; the torque of gravity is no part of samples.
    pub fn apply(&self, samples: &MotionSamples) -> MotionSamples {
        let mut read = samples.clone();
        let n = read.joints;
        let scale = |signal: &mut [f64], joint: Option<usize>, by: f64| match joint {
            Some(j) => signal.iter_mut().skip(j).step_by(n).for_each(|x| *x *= by),
            None => signal.iter_mut().for_each(|x| *x *= by),
        };
        match self {
            Self::AsIs | Self::WithoutGravity | Self::Gravity(_) | Self::LockedAt(_) => {}
            Self::EffortSign(joint) => {
                scale(&mut read.effort, *joint, -1.0);
                scale(&mut read.goal_rate, *joint, -1.0);
            }
            Self::GoalVelocity(ratios) => {
                let rates = samples.goal_rate.iter().zip(ratios.iter().cycle());
                read.effort.iter_mut().zip(rates).for_each(|(e, (rate, ratio))| *e += ratio * rate);
            }
            Self::PositionSign(joint) => {
                read.motion.iter_mut().for_each(|signal| scale(signal, *joint, -1.0));
            }
            Self::AxisSign(joint) => {
                let joint = Some(*joint);
                read.motion.iter_mut().for_each(|signal| scale(signal, joint, -1.0));
                scale(&mut read.effort, joint, -1.0);
                scale(&mut read.goal_rate, joint, -1.0);
            }
            Self::Degrees(joint) => {
                read.motion.iter_mut().for_each(|signal| scale(signal, *joint, PI / 180.0));
            }
            Self::Offset(j, offset) => {
                read.motion[0].iter_mut().skip(*j).step_by(n).for_each(|q| *q -= offset);
            }
            Self::CountedTogether(counted) => {
                let CountedTogether { joint, with, sign, is_driven } = *counted;
                read.motion.iter_mut().for_each(|signal| add(signal, n, [with, joint], -sign));
                if is_driven {
                    add(&mut read.effort, n, [joint, with], sign);
                }
            }
            Self::Exchanged(a, b) => {
                read.motion.iter_mut().for_each(|signal| exchange(signal, n, *a, *b));
                exchange(&mut read.effort, n, *a, *b);
                exchange(&mut read.goal_rate, n, *a, *b);
            }
            Self::EffortsExchanged(a, b) => {
                exchange(&mut read.effort, n, *a, *b);
                exchange(&mut read.goal_rate, n, *a, *b);
            }
            Self::Unit(factors) => {
                for (j, factor) in factors.iter().enumerate() {
                    scale(&mut read.effort, Some(j), 1.0 / factor.unwrap_or(1.0));
                    scale(&mut read.goal_rate, Some(j), 1.0 / factor.unwrap_or(1.0));
                }
            }
            Self::Time(factor) => {
                scale(&mut read.motion[1], None, *factor);
                scale(&mut read.motion[2], None, factor * factor);
                scale(&mut read.goal_rate, None, *factor);
            }
        }
        read
    }

    /// Whether it changes efforts alone, so that the nominal torque stays.
    pub fn is_of_efforts(&self) -> bool {
        matches!(
            self,
            Self::EffortSign(_)
                | Self::EffortsExchanged(..)
                | Self::Unit(_)
                | Self::GoalVelocity(_)
        )
    }

    /// The joints that it exchanges.
    pub fn exchanged_joints(&self) -> Vec<usize> {
        match self {
            Self::Exchanged(a, b) | Self::EffortsExchanged(a, b) => vec![*a, *b],
            _ => Vec::new(),
        }
    }

    /// Whether it turns a sign.
    pub fn is_sign(&self) -> bool {
        matches!(self, Self::EffortSign(_) | Self::PositionSign(_) | Self::AxisSign(_))
    }

    /// Whether it concerns every joint; more than one of them must confirm it then.
    pub fn is_of_whole_arm(&self) -> bool {
        match self {
            Self::EffortSign(joint) | Self::PositionSign(joint) | Self::Degrees(joint) => {
                joint.is_none()
            }
            Self::Unit(factors) => factors.iter().all(|f| f.is_none_or(is_another_unit)),
            Self::WithoutGravity
            | Self::Gravity(_)
            | Self::Time(_)
            | Self::GoalVelocity(_)
            | Self::LockedAt(_) => true,
            _ => false,
        }
    }

    /// The error that it corrects; `None` for logs as they stand. Gravity within `aligned` (rad) of the nominal direction
    /// differs in size.
    pub fn rival(&self, joints: usize, nominal: Vector3<f64>, aligned: f64) -> Option<Rival> {
        use ObservationKind as K;
        let own = |joint: &Option<usize>| joint.map_or_else(|| (0..joints).collect(), |j| vec![j]);
        let all = || (0..joints).collect();
        let (kind, joints) = match self {
            Self::AsIs => return None,
            Self::EffortSign(j) => (K::EffortSign, own(j)),
            Self::PositionSign(j) => (K::PositionSign, own(j)),
            Self::AxisSign(j) => (K::AxisSign, vec![*j]),
            Self::Offset(j, offset) => (K::PositionOffset { offset: *offset }, vec![*j]),
            Self::CountedTogether(counted) => (K::CountedTogether(*counted), vec![counted.joint]),
            Self::Exchanged(a, b) => (K::JointsExchanged, vec![*a, *b]),
            Self::EffortsExchanged(a, b) => (K::EffortsExchanged, vec![*a, *b]),
            Self::Degrees(j) => (K::Degrees, own(j)),
            Self::Unit(factors) => {
                let known = factors.iter().enumerate().filter_map(|(j, f)| f.map(|f| (j, f)));
                let (which, mut those): (Vec<usize>, Vec<f64>) =
                    known.filter(|(_, f)| is_another_unit(*f)).unzip();
                those.sort_unstable_by(f64::total_cmp);
                (K::EffortUnit { factor: *those.get(those.len() / 2)? }, which)
            }
            Self::GoalVelocity(_) => (K::GoalVelocity, all()),
            Self::WithoutGravity => (K::EffortWithoutGravity, all()),
            Self::Gravity(g) => {
                let angle = g.angle(&nominal);
                let turned = K::GravityDirection { gravity_in_base: *g, angle };
                let other = K::GravityValue { value: g.norm() };
                (if angle > aligned { turned } else { other }, all())
            }
            Self::Time(factor) => (K::TimeUnit { factor: *factor }, all()),
            Self::LockedAt(_) => (K::LockedElsewhere, all()),
        };
        Some(Rival { kind, joints })
    }
}

/// Whether logged efforts per N m (or N) are other than one.
pub(crate) fn is_another_unit(factor: f64) -> bool {
    (factor - 1.0).abs() > 1e-9
}

/// Adds `factor` times the signal of one joint to that of another.
fn add(signal: &mut [f64], joints: usize, [from, to]: [usize; 2], factor: f64) {
    for row in signal.chunks_exact_mut(joints) {
        row[to] += factor * row[from];
    }
}

fn exchange(signal: &mut [f64], joints: usize, a: usize, b: usize) {
    for row in signal.chunks_exact_mut(joints) {
        row.swap(a, b);
    }
}
