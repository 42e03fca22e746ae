use logs::LogError;

use crate::signals::along::Along;
use crate::signals::look::Look;

/// What the logs say of one run, whatever robot is evaluated along it; signals are low-passed, at the rate of
/// the regression.
#[derive(Debug, Clone)]
pub(crate) struct Readings {
    /// Efforts, or in a design of twists what the first encoder reports beyond the position of the link,
    /// `[joint][sample]`.
    pub measured: Vec<Vec<f64>>,
    /// See [`JointDesign::tells`](crate::columns::run_design::JointDesign::tells), `[joint][sample]`.
    pub tells: Vec<Vec<bool>>,
    /// See [`JointDesign::slides`](crate::columns::run_design::JointDesign::slides), `[joint][sample]`.
    pub slides: Vec<Vec<bool>>,
}

impl Readings {
    /// Reads a run.
    pub fn new(along: &Along, look: Look) -> Result<Self, LogError> {
        let joints = 0..along.motion.effort.len();
        let samples = along.time().len();
        let tells = |j: usize| match look {
            Look::Effort => along.tells(j),
            Look::Twist => vec![true; samples],
        };
        Ok(Self {
            measured: match look {
                Look::Effort => along.measured()?,
                Look::Twist => along.twists()?,
            },
            tells: joints.clone().map(tells).collect(),
            slides: joints.map(|j| along.slides(j)).collect(),
        })
    }
}
