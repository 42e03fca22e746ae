use nalgebra::{Rotation3, Vector3};
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use crate::arms::electronics::Electronics;
use crate::arms::make::Make;
use crate::corner::{ArmClass, EffortClass};
use crate::dice::{between, direction, round_to_digits, weighted_index};
use crate::robot_files::RobotFiles;

/// An arm with its nominal model, its electronics and the limits of its motions.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SampledArm {
    /// The true arm.
    pub truth: RobotFiles,
    /// The user's model.
    pub nominal: RobotFiles,
    /// The true arm: bodies, rotors, springs, gravity, limits.
    pub robot: Robot,
    /// Its controller and signals.
    pub electronics: Electronics,
    /// Position gain of each joint (N m/rad or N/m).
    pub kp: Vec<f64>,
    /// Largest torque of each joint (N m or N).
    pub limits: Vec<f64>,
    /// Accelerations of everyday motions (rad/s^2 or m/s^2).
    pub accelerations: Vec<f64>,
}

impl SampledArm {
    /// Typical Coulomb friction of each drive (N m or N).
    pub(crate) fn friction(&self, class: ArmClass, random: &mut ChaCha8Rng) -> Vec<f64> {
        let make = Make::of(class);
        let of = |limit: &f64| round_to_digits(limit * between(random, make.friction), 3);
        self.limits.iter().map(of).collect()
    }
}

/// How a base is mounted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Base {
    Upright,
    Tilted,
    Hanging,
}

impl Base {
    pub(crate) fn draw(random: &mut ChaCha8Rng) -> Self {
        match weighted_index(random, &[0.7, 0.15, 0.15]) {
            0 => Self::Upright,
            1 => Self::Tilted,
            _ => Self::Hanging,
        }
    }

    /// Gravity in the base frame (m/s^2); tilts are of 5 to 90 degrees about a level axis.
    pub(crate) fn gravity(self, random: &mut ChaCha8Rng) -> [f64; 3] {
        match self {
            Self::Upright => [0.0, 0.0, -9.81],
            Self::Hanging => [0.0, 0.0, 9.81],
            Self::Tilted => {
                let level = direction(random).cross(&Vector3::z());
                let axis = nalgebra::Unit::new_normalize(level + 1e-9 * Vector3::x());
                let tilt = Rotation3::from_axis_angle(&axis, between(random, [0.09, 1.57]));
                let g = tilt * Vector3::new(0.0, 0.0, -9.81);
                [g.x, g.y, g.z].map(|g| round_to_digits(g, 6))
            }
        }
    }
}

/// Whether a user's model has the rotors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RotorsKnown {
    All,
    None,
}

impl RotorsKnown {
    /// A joint torque sensor sits behind the rotor, so a model of its reading has no rotor.
    pub(crate) fn draw(electronics: &Electronics, random: &mut ChaCha8Rng) -> Self {
        let known = weighted_index(random, &[0.6, 0.4]) == 0;
        if known && electronics.effort != EffortClass::JointTorque { Self::All } else { Self::None }
    }
}

/// Error of a nominal model relative to the usual errors; zero in one arm of five.
pub(crate) fn error_level(random: &mut ChaCha8Rng) -> f64 {
    match weighted_index(random, &[0.2, 0.8]) {
        0 => 0.0,
        _ => between(random, [0.1, 1.0]),
    }
}

/// Values of `<dynamics>` in a URDF: usually none, otherwise an unmeasured dummy.
pub(crate) fn dummy_dynamics(class: ArmClass, random: &mut ChaCha8Rng) -> Option<[f64; 2]> {
    let sizes = match class {
        ArmClass::Hobby => [[0.0, 0.0], [0.01, 0.01], [0.1, 0.0]],
        ArmClass::Cobot | ArmClass::Wam => [[0.0, 0.0], [0.1, 0.1], [1.0, 0.0]],
        ArmClass::Industrial => [[0.0, 0.0], [1.0, 1.0], [10.0, 0.0]],
    };
    sizes.get(weighted_index(random, &[0.3, 0.08, 0.07, 0.55])).copied()
}
