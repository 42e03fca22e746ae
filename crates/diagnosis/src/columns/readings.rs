use crate::signals::along::Along;
use crate::signals::response::Response;

/// The readings of one run, which do not depend on the evaluated robot. Signals are low-passed, at the rate of the
/// regression.
#[derive(Debug, Clone)]
pub(crate) struct Readings {
    /// Efforts, `[joint][sample]`. In a design of the twist: the position that the first encoder reports minus that
    /// of the link.
    pub measured: Vec<Vec<f64>>,
    /// See [`JointDesign::is_informative`](crate::columns::run_design::JointDesign::is_informative), `[joint][sample]`.
    pub is_informative: Vec<Vec<bool>>,
    /// See [`JointDesign::slides`](crate::columns::run_design::JointDesign::slides), `[joint][sample]`.
    pub slides: Vec<Vec<bool>>,
}

impl Readings {
    /// Reads a run.
    pub fn new(along: &Along, response: Response) -> Self {
        let joints = 0..along.motion.effort.len();
        let samples = along.time().len();
        let is_informative = |j: usize| match response {
            Response::Effort => along.is_informative(j),
            Response::Twist => vec![true; samples],
        };
        Self {
            measured: match response {
                Response::Effort => along.measured_effort(),
                Response::Twist => along.twists(),
            },
            is_informative: joints.clone().map(is_informative).collect(),
            slides: joints.map(|j| along.slides(j)).collect(),
        }
    }
}
