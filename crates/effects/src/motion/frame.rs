use logs::{JointNoise, Prepared, rest_speeds};
use robot::Actuator;

use crate::motion::compliance::Spring;

/// Reference values of the joints that all runs of a diagnosis share.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Speed below which a joint counts as at rest (rad/s or m/s).
    pub rest_speed: Vec<f64>,
    /// Middle of the range of each joint over all runs (rad or m).
    pub centre: Vec<f64>,
    /// Half that range (rad or m).
    pub reach: Vec<f64>,
    /// Change of position that the logs resolve (rad or m): the step of the encoder, or two standard deviations of
    /// its noise below four times the cut-off, whichever is larger.
    pub resolution: Vec<f64>,
    /// Trial gap of each joint (rad or m), about which the column of a drive without a gap is taken; 0 where none is set.
    /// [`ShapedRobot`](crate::ShapedRobot) has the best ones.
    pub trial_gaps: Vec<f64>,
    /// Trial spring of each rigid joint, whose column is then the twist of that spring; `None` where none is set.
    pub trial_springs: Vec<Option<TrialSpring>>,
    /// Trial time by which goals are later than described (s), about which its column is taken; 0 for none.
    pub trial_lateness_s: f64,
}

/// A damped spring between the motor and the link of a joint, near whose resonance a motion is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrialSpring {
    /// Torque per unit of twist (N·m/rad or N/m).
    pub stiffness: f64,
    /// Torque per unit of the speed of the twist (N·m·s/rad or N·s/m).
    pub damping: f64,
}

impl TrialSpring {
    pub(crate) fn spring(self) -> Spring {
        let compliance = self.stiffness.recip();
        Spring { compliance, damping_s: Some(self.damping * compliance) }
    }

    /// Gives a drive this spring.
    pub(crate) fn set(self, drive: &mut Actuator) {
        (drive.elasticity, drive.elasticity_damping) = (Some(self.stiffness), Some(self.damping));
    }
}

impl Frame {
    /// The reference values of some logs, without trial gaps.
    pub fn of_logs(logs: &Prepared) -> Self {
        let rest_speed = rest_speeds(logs);
        let spans = (0..rest_speed.len()).map(|j| logs.span(j));
        let (centre, reach) =
            spans.map(|(low, high)| (0.5 * (low + high), 0.5 * (high - low))).unzip();
        let resolution = logs.noise.iter().map(|noise| resolution(noise, logs.cutoff_hz)).collect();
        let trial_gaps = vec![0.0; rest_speed.len()];
        let trial_springs = vec![None; rest_speed.len()];
        Self {
            rest_speed,
            centre,
            reach,
            resolution,
            trial_gaps,
            trial_springs,
            trial_lateness_s: 0.0,
        }
    }
}

/// Change of position that a joint's encoder resolves (rad or m).
fn resolution(noise: &JointNoise, cutoff_hz: f64) -> f64 {
    let deviation = (4.0 * cutoff_hz * noise.position.density).sqrt();
    noise.position.step.unwrap_or(0.0).max(2.0 * deviation)
}
